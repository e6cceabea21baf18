(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** Forces within limits, and forces along pieces: what is false must not be proved, by any method.
    The forces of these robots are known by hand. *)
From Coq Require Import List Bool Arith PrimFloat.
From Regulus Require Import Expressions Questions Search Singularity Threshold Forces Limits.
From Regulus Require Import Notations.
Import ListNotations.

Definition methods : list method :=
  flat_map (fun s => map (Method s) [0; 1; 7; 12]%nat) [0; 1; 2; 99]%nat.

Definition x := Name 0.
Definition w := Name 1.

(** x in [1, 2] is a pose, and w in [-1, 1] the load. *)
Definition over (constraints : list expression) (n : nat) (matrix : list (list expression)) :=
  Question [(1, 2); (-1, 1)] [] constraints [] matrix n.

Record claim := Claim {
  robot : question; scales : list expression; load : list expression;
  limits : list (expression * expression) }.

Definition holds_by (m : method) (c : claim) : bool :=
  check_limits (robot c) (scales c) (load c) (limits c) m.
Definition refused (c : claim) : bool := forallb (fun m => negb (holds_by m c)) methods.
Definition proved (c : claim) : bool := holds_by (Method 1 30) c.

(** F_1 = w/(2 s_1), and F_2 = 3/(x s_2). *)
Definition diagonal (s load : list expression) (limits : list (expression * expression)) :=
  Claim (over [] 2 [[2; 0]; [0; x]]) s load limits.

(** F_1 + F_2 = the load, or cos(x) F_1 + sin(x) F_2 and so on: more rows than columns. *)
Definition pull (load : expression) (limits : list (expression * expression)) :=
  Claim (over [] 1 [[1]; [1]]) [1; 1] [load] limits.

(** Three ropes in the plane, 120 degrees apart and turned by x; each pulls with 1 to 10. *)
Definition ropes (load : list expression) (least largest : expression) :=
  Claim (over [] 2 [[cos x; sin x]; [cos (x + 2*pi/3); sin (x + 2*pi/3)];
                    [cos (x - 2*pi/3); sin (x - 2*pi/3)]]) [1; 1; 1] load
    [(least, largest); (least, largest); (least, largest)].

Definition true_claims : list claim := [
  diagonal [1; 1] [w; 3] [(-0.501, 0.501); (1.49, 3.01)];
  diagonal [1; 1/x] [w; 3] [(-0.501, 0.501); (2.99, 3.01)];
  diagonal [2; 1/x] [w; 3*x] [(-0.251, 0.251); (2.99, 6.01)];
  (* The load depends on the pose, and is constant after all. *)
  diagonal [1; 1] [w; 3*x] [(-1, 1); (2.99, 3.01)];
  (* A constraint leaves a part. *)
  Claim (over [x - 3/2] 2 [[2; 0]; [0; x]]) [1; 1] [w; 3] [(-1, 1); (1.99, 3.01)];
  (* Beyond the constraint nothing needs to have a value. *)
  Claim (over [3/2 - x] 2 [[2; 0]; [0; 1/(x - 1)]]) [1; 1] [w; 3] [(-1, 1); (1.4, 3.1)];
  pull (3 + w) [(0.99, 2.01); (0.99, 2.01)];
  pull (w - 3) [(-2.01, -0.99); (-2.01, -0.99)];
  (* Only together: one of them pushes. *)
  pull (10 + w) [(0, 100); (-5, -4)];
  ropes [w; 0] 1 10;
  ropes [w; w] 1 3.1 ].

Definition false_claims : list claim := [
  (* A limit that is exceeded, at either end. *)
  diagonal [1; 1] [w; 3] [(-0.499, 0.501); (1.49, 3.01)];
  diagonal [1; 1] [w; 3] [(-0.501, 0.499); (1.49, 3.01)];
  diagonal [1; 1] [w; 3] [(-0.501, 0.501); (1.51, 3.01)];
  diagonal [1; 1] [w; 3] [(-0.501, 0.501); (1.49, 2.99)];
  diagonal [1; 1/x] [w; 3] [(-0.501, 0.501); (3.01, 4)];
  diagonal [1/2; 1] [w; 3] [(-0.501, 0.501); (1.49, 3.01)];
  (* The limits of the other row; limits in the wrong order. *)
  diagonal [1; 1] [w; 3] [(1.49, 3.01); (-0.501, 0.501)];
  diagonal [1; 1] [w; 3] [(0.501, -0.501); (1.49, 3.01)];
  (* A scale or a limit too few, or too many; a component too few. *)
  diagonal [1] [w; 3] [(-1, 1); (1, 4)];
  diagonal [1; 1; 1] [w; 3] [(-1, 1); (1, 4)];
  diagonal [1; 1] [w] [(-1, 1); (1, 4)];
  diagonal [1; 1] [w; 3] [(-1, 1)];
  diagonal [1; 1] [w; 3] [(-1, 1); (1, 4); (1, 4)];
  (* A scale is 0, or has no value; the same of a component and of a limit. *)
  diagonal [1; x - 1] [w; 3] [(-1, 1); (-100, 100)];
  diagonal [1; 1/(x - 2)] [w; 3] [(-1, 1); (-100, 100)];
  diagonal [1; 1] [w; sqrt w] [(-1, 1); (-100, 100)];
  diagonal [1; 1] [w; Name 7] [(-1, 1); (-100, 100)];
  diagonal [1; 1] [w; 3] [(-1, 1/0); (-100, 100)];
  (* The constraint does not exclude enough. *)
  Claim (over [x - 3/2] 2 [[2; 0]; [0; x]]) [1; 1] [w; 3] [(-1, 1); (2.01, 3.01)];
  (* A matrix that is singular at one end; one that has fewer rows than columns. *)
  Claim (over [] 2 [[x - 1; 0]; [0; 1]]) [1; 1] [w; 3] [(-1e9, 1e9); (-1e9, 1e9)];
  Claim (over [] 2 [[1; 0]]) [1] [w; 0] [(-10, 10)];
  Claim (over [] 2 [[1; 0]; [0]]) [1; 1] [w; 0] [(-10, 10); (-10, 10)];
  (* 2.01 is more than what both can pull with, and less than what they must. *)
  pull (3 + w) [(1, 1.99); (1, 2)];
  pull (3 + w) [(1.01, 2.01); (1, 2.01)];
  pull (3 + w) [(-2.01, -1); (-2.01, -1)];
  pull (10 + w) [(0, 5); (-5, -4)];
  (* The ropes of a star push nowhere. *)
  ropes [w; 0] 0 0.99;
  ropes [100*w; 0] 1 10 ].

Goal map proved true_claims = map (fun _ => true) true_claims.
Proof. vm_compute. reflexivity. Qed.

Goal map refused false_claims = map (fun _ => true) false_claims.
Proof. vm_compute. reflexivity. Qed.

(** Trees: the splits that prove it, and others. *)
Definition by_tree (t : tree) : bool :=
  let c := diagonal [1; 1] [w; 3] [(-0.501, 0.501); (1.49, 3.01)] in
  check_limits_tree (robot c) (scales c) (load c) (limits c) (Method 1 30) t.
Fixpoint halved (n : nat) : tree :=
  match n with O => Leaf | S k => Split 0 (halved k) (halved k) end.
Goal (map (fun n => by_tree (halved n)) [0; 1; 5]%nat, by_tree (Split 7 Leaf Leaf)) =
  ([false; false; true], false).
Proof. vm_compute. reflexivity. Qed.

(** ** Along pieces: x goes from the constant of a piece by 1 *)

Definition along (piece : list expression) : question :=
  Question [(0, 1); (-1, 1)] [nth 0 piece no_entry; Name 0 + Name 2] [] []
    [[2; 0]; [0; Name 3]] 2.
Definition of_load (piece limit : expression) : bool :=
  check_limits_pieces along [1; 1] [w; 3] [(-1, 1); (0, limit)] (Method 1 30) [[1]; [piece]].
Goal (of_load 2 3.01, of_load 2 2.99, of_load (1/2) 3.01, of_load (1/2) 6.01, of_load (-1/2) 9e9) =
  (true, false, false, true, false).
Proof. vm_compute. reflexivity. Qed.

(** |F_2| = 3/x is below 3.01 for x from 1 to 3, and below 6.01 from 1/2. *)
Definition of_force (piece limit : expression) : bool * bool :=
  (check_force_pieces range_within along 1 [w; 3] limit (Method 2 30) [[1]; [piece]],
   check_force_pieces range_below along 1 [w; -3] limit (Method 2 30) [[1]; [piece]]).
Goal (of_force 2 3.01, of_force 2 2.99, of_force (1/2) 3.01, of_force (1/2) 6.01,
      of_force (-1/2) 9e9) =
  ((true, true), (false, true), (false, true), (true, true), (false, false)).
Proof. vm_compute. reflexivity. Qed.

(** A tree for each piece, neither fewer nor more. *)
Definition by_trees (trees : list tree) : bool * bool :=
  let pieces := [[1]; [2]]%list in
  (check_force_piece_trees range_within along 1 [w; 3] 4 (Method 2 30) pieces trees,
   check_limits_piece_trees along [1; 1] [w; 3] [(-1, 1); (0, 4)] (Method 1 30) pieces trees).
Goal (by_trees [Split 1 Leaf Leaf; Leaf], by_trees [Leaf], by_trees [Leaf; Leaf; Leaf],
      by_trees []) = ((true, true), (false, false), (false, false), (false, false)).
Proof. vm_compute. reflexivity. Qed.

(** A load that no forces hold, at a point and along a direction. F_1 = w/2 and F_2 = 3/x; then
    F_1 + F_2 = 3 + w, where each pulls. *)
Definition unheld (c : claim) (position direction : list float) : bool :=
  check_no_forces (robot c) (scales c) (load c) (limits c) position direction.
Definition of_two (limits : list (expression * expression)) : claim :=
  diagonal [1; 1] [w; 3] limits.
Goal [unheld (of_two [(-1, 1); (1.49, 2.99)]) [1; 0]%float [0; 1]%float;
      unheld (of_two [(-1, 1); (1.51, 9)]) [2; 0]%float [0; -1]%float;
      unheld (of_two [(-0.49, 1); (0, 9)]) [1; -1]%float [-1; 0]%float;
      unheld (of_two [(-0.49, 0.49); (0, 9)]) [1; infinity]%float [1; 0]%float;
      unheld (pull (3 + w) [(0, 1.9); (0, 1.9)]) [1; 1]%float [1]%float;
      unheld (pull (w - 3) [(0, 9); (0, 9)]) [1; 1]%float [-1]%float;
      unheld (diagonal [2; 1/x] [w; 3*x] [(-9, 9); (0, 5.9)]) [2; 0]%float [0; 1]%float;
      unheld (ropes [w; 0] 1 1) [1; 1]%float [1; 0]%float] = repeat true 8.
Proof. vm_compute. reflexivity. Qed.
Goal [unheld (of_two [(-1, 1); (1.49, 3.01)]) [1; 0]%float [0; 1]%float;
      unheld (of_two [(-1, 1); (1.49, 2.99)]) [1; 0]%float [0; -1]%float;
      unheld (of_two [(-1, 1); (1.49, 2.99)]) [1; 0]%float [1; 0]%float;
      unheld (of_two [(-1, 1); (1.49, 2.99)]) [1; 0]%float [0; 0]%float;
      unheld (of_two [(-1, 1); (1.49, 2.99)]) [1; 0]%float []%float;
      unheld (of_two [(-1, 1); (1.49, 2.99)]) [2; 0]%float [0; 1]%float;
      unheld (of_two [(-1, 1); (1.49, 2.99)]) []%float [0; 1]%float;
      unheld (of_two [(-1, 1)]) [1; 0]%float [0; 1]%float;
      unheld (of_two [(-1, 1); (0, 1/0)]) [1; 0]%float [0; 1]%float;
      unheld (of_two [(-0.49, 0.49); (0, 9)]) [1; 0]%float [1; 0]%float;
      unheld (of_two [(-0.51, 0.51); (0, 9)]) [1; infinity]%float [1; 0]%float;
      unheld (pull (3 + w) [(0, 2.1); (0, 2.1)]) [1; 1]%float [1]%float;
      unheld (pull (w - 3) [(-9, 9); (0, 9)]) [1; 1]%float [-1]%float;
      unheld (ropes [w; 0] 1 10) [1; 1]%float [1; 0]%float;
      (* Beyond the range, which ends at 2; and beyond a constraint. *)
      unheld (of_two [(-1, 1); (1.4, 9)]) [4; 0]%float [0; -1]%float;
      unheld (Claim (over [x - 3/2] 2 [[2; 0]; [0; x]]) [1; 1] [w; 3] [(-1, 1); (1.51, 9)])
        [2; 0]%float [0; -1]%float;
      (* Something has no value. *)
      unheld (Claim (over [] 2 [[2; 0]; [0; x]]) [1; 1/(x - 1)] [w; 3] [(-1, 1); (1.49, 2.99)])
        [1; 0]%float [0; 1]%float;
      unheld (Claim (over [] 2 [[2; 0]; [0; sqrt (1 - x)]]) [1; 1] [w; 3] [(-9, 9); (0, 9)])
        [2; 0]%float [0; 1]%float] = repeat false 18.
Proof. vm_compute. reflexivity. Qed.
