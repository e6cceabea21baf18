(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** Singular values that are known by hand, of matrices with scales and factors and over the branch
    of a closure: what is false must not be proved, by any method, and what is true next to it is. *)
From Coq Require Import List Bool Arith PrimFloat.
From Regulus Require Import Expressions Questions Search Closures Tubes Branches Rates Slopes Parts.
From Regulus Require Import SingularValues.
From Regulus Require Import Notations.
Import ListNotations.

Definition methods : list method :=
  flat_map (fun s => map (Method s) [0; 1; 6]%nat) [0; 2; 99]%nat.

Definition x := Name 0.
Definition y := Name 1.

(** x is in [1, 2], and y in [-1, 1]. *)
Definition over (constraints : list expression) (n : nat) (matrix : list (list expression)) :=
  Question [(1, 2); (-1, 1)] [] constraints [] matrix n.

Record claim := Claim {
  what : spectral; robot : question; scales : list expression; factors : list expression;
  limit : expression }.

Definition holds_by (m : method) (c : claim) : bool :=
  check_spectrum (what c) (robot c) (scales c) (factors c) (limit c) m.
Definition refused (c : claim) : bool := forallb (fun m => negb (holds_by m c)) methods.
Definition proved (c : claim) : bool := holds_by (Method 2 30) c.

(** The singular values are 2 and x: the ratio is at most 2. *)
Definition diagonal := over [] 2 [[2; 0]; [0; x]].
Definition turned_left := over [] 2 [[2*cos y; - x*sin y]; [2*sin y; x*cos y]].
Definition turned_right := over [] 2 [[2*cos y; 2*sin y]; [- x*sin y; x*cos y]].
(** More rows than columns. The square is [4 + 9x^2, 9x^2; 9x^2, 10x^2]; the singular values are
    1.541 and 4.541 at x = 1, and 2 and 8.718 at x = 2, of the ratio 4.359. *)
Definition long := over [] 2 [[2; 0]; [0; x]; [3*x; 3*x]].
(** Three equal values, x; and one value of two rows, sqrt (x^2 + 9). *)
Definition equal := over [] 3 [[x; 0; 0]; [0; 0; x]; [0; - x; 0]].
Definition single := over [] 1 [[x]; [3]].

Definition all_of (q : question) (s f : list expression) (above below ratio : expression) :=
  [Claim Values_above q s f above; Claim Values_below q s f below; Claim Ratio_below q s f ratio].

Definition true_claims : list claim :=
  all_of diagonal [1; 1] [1; 1] 0.999 2.001 2.001
  ++ all_of turned_left [1; 1] [1; 1] 0.99 2.01 2.01
  ++ all_of turned_right [1; 1] [1; 1] 0.99 2.01 2.01
  (* Scales and factors, of which one depends on the pose: 10 and 3x, 10 and 3, 2 and x*x. *)
  ++ all_of diagonal [5; 3] [1; 1] 2.999 10.001 3.334
  ++ all_of diagonal [5; 1] [1; 3] 2.999 10.001 3.334
  ++ all_of diagonal [5; 3/x] [1; 1] 2.999 10.001 3.334
  ++ all_of diagonal [-1; x] [1; -1] 0.999 4.001 2.001
  ++ all_of long [1; 1; 1] [1; 1] 1.541 8.718 4.36
  ++ all_of equal [1; 1; 1] [1; 1; 1] 0.999 2.001 1.001
  ++ all_of single [1; 1] [1] 3.16 3.61 1.001
  ++ [ (* A constraint leaves the part up to 3/2, or from it. *)
    Claim Values_below (over [x - 3/2] 1 [[x]]) [1] [1] 1.501;
    Claim Ratio_below (over [3/2 - x] 2 [[2; 0]; [0; x]]) [1; 1] [1; 1] 1.334;
    (* Beyond the constraint nothing needs to have a value. *)
    Claim Ratio_below (over [3/2 - x] 2 [[2; 0]; [0; 1/(x - 1)]]) [1; 1] [1; 1] 2.001;
    (* All values are at most 0 where the matrix is 0; 0 is above no value. *)
    Claim Values_below (over [] 1 [[0]]) [1] [1] 1e-9 ].

Definition false_claims : list claim :=
  all_of diagonal [1; 1] [1; 1] 1.001 1.999 1.999
  ++ all_of turned_left [1; 1] [1; 1] 1.001 1.999 1.999
  ++ all_of turned_right [1; 1] [1; 1] 1.001 1.999 1.999
  ++ all_of diagonal [5; 3] [1; 1] 3.001 9.999 3.333
  ++ all_of diagonal [5; 1] [1; 3] 3.001 9.999 3.333
  ++ all_of diagonal [5; 3/x] [1; 1] 3.001 9.999 3.333
  ++ all_of diagonal [-1; x] [1; -1] 1.001 3.999 1.999
  ++ all_of long [1; 1; 1] [1; 1] 1.542 8.717 4.358
  (* The ratio is 1, and not less. *)
  ++ all_of equal [1; 1; 1] [1; 1; 1] 1.001 1.999 1
  ++ all_of single [1; 1] [1] 3.17 3.6 1
  (* A scale or a factor too few, or too many; one that is 0 or has no value. *)
  ++ flat_map (fun u => all_of diagonal (fst u) (snd u) 0.0001 1e9 1e9)
      [([1], [1; 1]); ([1; 1; 1], [1; 1]); ([1; 1], [1]); ([1; 1], [1; 1; 1]); ([], [1; 1]);
       ([1; 1], []); ([1; 1], [1; 0]); ([1; 1], [1; 1/0]); ([1; 1/(x - 2)], [1; 1]);
       ([1; sqrt y], [1; 1]); ([1; Name 7], [1; 1]); ([1; 1], [1; x])]
  (* A limit without a value, or beside all numbers. *)
  ++ all_of diagonal [1; 1] [1; 1] (1/0) (1/0) (1/0)
  ++ all_of diagonal [1; 1] [1; 1] x x x
  ++ all_of diagonal [1; 1] [1; 1] 2 (-3) (-3)
  ++ all_of diagonal [1; 1] [1; 1] 2 0 0
  (* Singular at one end, at x = 3/2, everywhere; fewer rows than columns; rows that are too short;
     no rows. *)
  ++ flat_map (fun a => let q := over [] 2 a in let s := map (fun _ => 1) a in
        [Claim Values_above q s [1; 1] 1e-9; Claim Ratio_below q s [1; 1] 1e9])
      [[[x - 1; 0]; [0; 1]]; [[2*x - 3; 0]; [0; 1]]; [[x; 1]; [x*x; x]]; [[1; 0]];
       [[1]; [1]]; [[1; 0]; [0]]; []]
  ++ [ (* The constraint does not exclude enough; an entry has no value. *)
    Claim Values_below (over [x - 3/2] 1 [[x]]) [1] [1] 1.499;
    Claim Ratio_below (over [3/2 - x] 2 [[2; 0]; [0; x]]) [1; 1] [1; 1] 1.333;
    Claim Values_below (over [] 1 [[1/(x - 1)]]) [1] [1] 1e9;
    Claim Values_below (over [] 1 [[sqrt y]]) [1] [1] 1e9;
    Claim Values_below (over [] 1 [[0]]) [1] [1] 0 ].

Goal map proved true_claims = map (fun _ => true) true_claims.
Proof. vm_compute. reflexivity. Qed.

Goal map refused false_claims = map (fun _ => true) false_claims.
Proof. vm_compute. reflexivity. Qed.

(** Six singular values from 1/8 to 4, of a matrix that is turned on both sides; 32 is their
    ratio. *)
Definition turn (n k : nat) (angle : expression) (i j : nat) : expression :=
  if Nat.eqb i j then if Nat.eqb i k || Nat.eqb i (S k) then cos angle else 1
  else if Nat.eqb i k && Nat.eqb j (S k) then - sin angle
  else if Nat.eqb i (S k) && Nat.eqb j k then sin angle else 0.
Definition times_expression (n : nat) (a b : nat -> nat -> expression) (i j : nat) : expression :=
  fold_right (fun l e => a i l * b l j + e) 0 (seq 0 n).
Definition of_six (i j : nat) : expression :=
  if Nat.eqb i j then nth i [1/8; 4; 1; 2; 1/2; 1/4] 0 else 0.
Definition six : question :=
  let a := times_expression 6 (turn 6 0 (x/10)) (times_expression 6 (turn 6 3 y)
    (times_expression 6 of_six (times_expression 6 (turn 6 2 (y/8)) (turn 6 0 (x/10))))) in
  Question [(1, 2); (-1/10, 1/10)] [] [] []
    (map (fun i => map (a i) (seq 0 6)) (seq 0 6)) 6.
Definition ones : list expression := repeat 1 6.
Goal map (fun u => proved (Claim (fst u) six ones ones (snd u)))
    [(Values_above, 0.124); (Values_below, 4.01); (Ratio_below, 32.3)] = repeat true 3.
Proof. vm_compute. reflexivity. Qed.
Goal map (fun u => holds_by (Method 2 1) (Claim (fst u) six ones ones (snd u)))
    [(Values_above, 0.1251); (Values_below, 3.999); (Ratio_below, 31.99)] = repeat false 3.
Proof. vm_compute. reflexivity. Qed.

(** Trees: the splits that prove it, and others. *)
Definition by_tree (t : tree) : bool :=
  check_spectrum_tree Ratio_below diagonal [1; 1] [1; 1] 2.001 (Method 2 30) t.
Fixpoint halved (n : nat) : tree :=
  match n with O => Leaf | S k => Split 0 (halved k) (halved k) end.
Goal (map (fun n => by_tree (halved n)) [0; 1; 6]%nat, by_tree (Split 7 Leaf Leaf)) =
  ([false; false; true], false).
Proof. vm_compute. reflexivity. Qed.

(** Along pieces: x goes from the constant of a piece by 1. *)
Definition along (piece : list expression) : question :=
  Question [(0, 1)] [nth 0 piece no_entry; Name 0 + Name 1] [] [] [[2; 0]; [0; Name 2]] 2.
Definition of_pieces (w : spectral) (piece limit : expression) : bool :=
  check_spectrum_pieces w along [1; 1] [1; 1] limit (Method 2 30) [[1]; [piece]].
Goal [of_pieces Ratio_below 2 2.001; of_pieces Ratio_below 2 1.999; of_pieces Ratio_below 4 2.501;
      of_pieces Ratio_below 4 2.499; of_pieces Ratio_below (-1/2) 9e9;
      of_pieces Values_above 2 0.999; of_pieces Values_above (1/2) 0.999;
      of_pieces Values_below 2 3.001; of_pieces Values_below 3 3.001] =
  [true; false; true; false; false; true; false; true; false].
Proof. vm_compute. reflexivity. Qed.

(** A tree for each piece, neither fewer nor more. *)
Definition by_trees (trees : list tree) : bool :=
  check_spectrum_piece_trees Values_below along [1; 1] [1; 1] 4 (Method 2 30) [[1]; [2]] trees.
Goal map by_trees [[Leaf; Leaf]; [Leaf]; [Leaf; Leaf; Leaf]; []] = [true; false; false; false].
Proof. vm_compute. reflexivity. Qed.

(** ** Over a branch *)

(** p^2 = x + 1 for x in [-1/4, 1/4]. The derivative 2p is in [1.73205, 2.23607]. *)
Definition the_method := Method 1 6.
Definition p := Name 1.
Definition slider : closure :=
  Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 1 [] [p^2 - x - 1] [] [0] [(1, 1/2)].
Definition lower : tubes := (Held (Tube [0] [1] [[0x1p-1]] [0x1p-4]))%float.
Definition upper : tubes := (Held (Tube [0x1p-3] [0x1.0fp+0] [[0x1.ep-2]] [0x1p-6]))%float.
Definition the_tubes := Cut 0 0%float lower upper.
Definition of_slider (w : spectral) (factors : list expression) (limit : expression) : bool :=
  check_branch_spectrum w slider factors limit the_method the_tubes.
Goal [of_slider Values_above [1] 1.732; of_slider Values_below [1] 2.2361;
      of_slider Values_above [2] 3.464; of_slider Values_below [2] 4.4722;
      of_slider Ratio_below [1] 1.001; of_slider Ratio_below [7] 1.001] = repeat true 6.
Proof. vm_compute. reflexivity. Qed.
Goal [of_slider Values_above [1] 1.733; of_slider Values_below [1] 2.236;
      of_slider Values_above [2] 3.466; of_slider Values_below [2] 4.472;
      of_slider Ratio_below [1] 1; of_slider Ratio_below [1] (-2);
      of_slider Ratio_below [-1] 2; of_slider Ratio_below [0] 2; of_slider Values_below [0] 2;
      of_slider Ratio_below [] 2; of_slider Ratio_below [1; 1] 2; of_slider Ratio_below [1/0] 2;
      of_slider Ratio_below [1] (1/0); of_slider Values_below [1] (-1);
      check_branch_spectrum Values_below slider [1] 9 the_method Excluded] = repeat false 15.
Proof. vm_compute. reflexivity. Qed.

(** 2 p + q = x and p - q = 0: the matrix [2 1; 1 -1] has the singular values (sqrt 13 + 1)/2 and
    (sqrt 13 - 1)/2, 2.302776 and 1.302776, of the ratio 1.767592. With the factors 1 and 2 it is
    [2 2; 1 -2], of the singular values 3 and 2. *)
Definition a := Name 1.
Definition b := Name 2.
Definition two : closure :=
  Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 2 [] [2*a + b - x; a - b] [] [0]
    [(0, 1/2); (0, 1/2)].
Definition of_two : tubes :=
  (Held (Tube [0] [0; 0] [[0x1.5555555555555p-2]; [0x1.5555555555555p-2]] [0x1p-8; 0x1p-8]))%float.
Definition spectrum_of_two (w : spectral) (factors : list expression) (limit : expression) : bool :=
  check_branch_spectrum w two factors limit the_method of_two.
Goal [spectrum_of_two Values_above [1; 1] 1.302775; spectrum_of_two Values_below [1; 1] 2.302777;
      spectrum_of_two Ratio_below [1; 1] 1.767593; spectrum_of_two Values_above [1; 2] 1.999999;
      spectrum_of_two Values_below [1; 2] 3.000001; spectrum_of_two Ratio_below [1; 2] 1.500001] =
  repeat true 6.
Proof. vm_compute. reflexivity. Qed.
Goal [spectrum_of_two Values_above [1; 1] 1.302777; spectrum_of_two Values_below [1; 1] 2.302775;
      spectrum_of_two Ratio_below [1; 1] 1.767591; spectrum_of_two Values_above [1; 2] 2.000001;
      spectrum_of_two Values_below [1; 2] 2.999999; spectrum_of_two Ratio_below [1; 2] 1.499999] =
  repeat false 6.
Proof. vm_compute. reflexivity. Qed.

(** The derivatives [2a, -1; 0, 1], whose larger singular value is at most 2.48849. A bound so close
    to it needs a tube that is fitted to parts of its box. *)
Definition curved : closure :=
  Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 2 [] [a^2 - x - 1 - b; b] [] [0]
    [(1, 1/2); (0, 1/2)].
Definition of_curved : tubes :=
  (Cut 0 0 (Held (Tube [-0x1p-3] [0x1.dfp-1; 0] [[0x1.1p-1]; [0]] [0x1p-5; 0x1p-8]))
     (Held (Tube [0x1p-3] [0x1.0fp+0; 0] [[0x1.ep-2]; [0]] [0x1p-5; 0x1p-8])))%float.
Goal map (fun l => check_branch_spectrum Values_below curved [1; 1] l the_method of_curved)
    [2.489; 2.4885; 2.4884; 2.48] = [true; true; false; false].
Proof. vm_compute. reflexivity. Qed.
