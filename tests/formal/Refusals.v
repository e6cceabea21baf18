(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** Questions whose answer is known: what is false must not be proved, by any method. *)
From Coq Require Import List Bool Arith PrimFloat.
From Regulus Require Import Expressions Questions Search Singularity Threshold Forces Notations.
Import ListNotations.

Definition methods : list method :=
  flat_map (fun s => map (Method s) [0; 1; 7; 12]%nat) [0; 1; 2; 99]%nat.

Definition refused (q : question) : bool := forallb (fun m => negb (check q m)) methods.
Definition proved (q : question) : bool := check q (Method 99 30).

Definition x := Name 0.
Definition y := Name 1.

(** A matrix over x in [-1, 1] and y in [0, 2]. *)
Definition over (constraints : list expression) (matrix : list (list expression)) : question :=
  Question [(-1, 1); (0, 2)] [] constraints [] matrix 2.
Definition square := over [].
Definition value (e : expression) : question :=
  Question [(-1, 1); (0, 2)] [] [] [e] [[1]] 1.

Definition false_claims : list question := [
  (* Singular everywhere, along a line, at a point, and at one end of the set. *)
  square [[1; 1]; [1; 1]];
  square [[1; x]; [1; y]];
  square [[x; y]; [- y; x]];
  square [[y; 0]; [0; 1]];
  square [[x - 1; 0]; [0; 1]];
  square [[sin x - x; 0]; [0; 1]];
  square [[x ^ 2 + y ^ 2; 0]; [0; 1]];
  (* A root that no interval of doubles around it excludes. *)
  square [[(x - 1/3) ^ 2; 0]; [0; 1]];
  (* More rows than columns, dependent columns. *)
  square [[x; 2*x]; [y; 2*y]; [1; 2]];
  (* Fewer rows than columns. *)
  square [[1; 0]];
  (* A row with too few or too many entries. *)
  square [[1]; [0; 1]];
  square [[1; 0; 0]; [0; 1]];
  (* Undefined at a point, at an end of the set, or by a name that is not declared. *)
  value (1/x);
  value (1/y);
  value (sqrt x);
  value (sqrt (y - 1/10));
  value (log y);
  value (x/x);
  value (tan (2*x));
  value (acos y);
  value (Name 2);
  (* Precedence: a sign binds less than a power; quotients and differences are taken from the left. *)
  value (sqrt (3 + -2^2));
  value (sqrt (8/2/4 - 2));
  value (sqrt (5 - 3 - 3));
  value (sqrt (-1 * -1 * -1));
  Question [(-1, 1)] [1/x] [] [] [[1]] 1;
  Question [(-1, 1)] [Name 1] [] [] [[1]] 1;
  (* A constraint that does not exclude the singular point, or excludes it just so. *)
  over [x - 2] [[x; 0]; [0; 1]];
  over [- x] [[x; 0]; [0; 1]];
  over [1/x] [[x; 0]; [0; 1]];
  over [1/10 - x] [[log x; 0]; [0; 1]];
  (* An end of a range without a value. *)
  Question [(0, 1/0)] [] [] [] [[1]] 1 ].

Definition true_claims : list question := [
  square [[1; 1]; [1; 1 + 1e-6]];
  square [[1; 1]; [1; 1.000001]];
  square [[y + 1e-3; 0]; [0; 1]];
  square [[x - 1.001; 0]; [0; 1]];
  square [[x ^ 2 + y ^ 2 + 1e-2; 0]; [0; 1]];
  square [[x; 1]; [1; - x]];
  square [[x; y]; [1; 0]; [0; 1]];
  value (1/(x + 1.001));
  value (sqrt (y + 1e-6));
  value (sqrt y);
  value (log (y + 1e-6));
  value (sqrt (0 - -2^2));
  value (sqrt (-2 * -1 + 1.5e0 - 3.4999));
  value (atan2(x, y + 1));
  value (atan x + exp y + abs x + tan x);
  value (asin (x/2) + acos (x/2));
  over [1/10 - x] [[x; 0]; [0; 1]];
  (* Beyond the constraint nothing needs to be defined. *)
  over [1/10 - x] [[sqrt x; 0]; [0; 1]];
  Question [(1/2, 1)] [1/x] [] [] [[Name 1]] 1 ].

(** Segments that show no singularity: each with the two points of the claim. *)
Definition false_segments : list (question * coordinates * coordinates) := [
  (* The determinant does not change its sign, or only beyond the set. *)
  (square [[x + 2; 0]; [0; 1]], [-1; 1]%float, [1; 1]%float);
  (square [[x - 2; 0]; [0; 1]], [1; 1]%float, [3; 1]%float);
  (square [[x ^ 2; 0]; [0; 1]], [-1; 1]%float, [1; 1]%float);
  (* It jumps over 0. *)
  (square [[1/x; 0]; [0; 1]], [-1; 1]%float, [1; 1]%float);
  (value (1/x), [-1; 1]%float, [1; 1]%float);
  (* The singular point is excluded. *)
  (over [1/10 - x] [[x; 0]; [0; 1]], [-0.5; 1]%float, [0.5; 1]%float);
  (over [y - x - 1/2] [[x; 0]; [0; 1]], [-0.5; 1]%float, [0.5; 1]%float);
  (* Not a square matrix; a number of coordinates that is not that of the variables. *)
  (square [[x; 0]], [-1; 1]%float, [1; 1]%float);
  (square [[x; 0]; [0; 1]; [0; 2]], [-1; 1]%float, [1; 1]%float);
  (square [[x; 0]; [0; 1]], [-1]%float, [1]%float);
  (square [[x; 0]; [0; 1]], []%float, []%float);
  (* No numbers. *)
  (square [[x; 0]; [0; 1]], [-infinity; 1]%float, [nan; 1]%float) ].

Definition true_segments : list (question * coordinates * coordinates) := [
  (square [[x; 0]; [0; 1]], [-1; 1]%float, [1; 1]%float);
  (Question [(-1, 1); (0, 2)] [] [] [] [[0; 1; 0]; [x; 0; 0]; [0; 0; 1]] 3, [-1; 1]%float, [1; 1]%float);
  (square [[x; y]; [1; 2]], [-1; 1]%float, [1; 1]%float);
  (square [[x - 1 + 1e-6; 0]; [0; 1]], [-1; 1]%float, [1; 1]%float);
  (over [x - y] [[x; 0]; [0; 1]], [-0.5; 1]%float, [0.5; 1]%float) ].

(** |det| = x + 2 in [1, 3], times the scales, is not above these thresholds. *)
Definition slope : question := square [[x + 2; 0]; [y; 1]].

Definition false_thresholds : list (question * list expression * expression) := [
  (slope, [], 1);
  (slope, [], 1 + 1e-6);
  (slope, [1/2; 2], 1);
  (slope, [1; x], 0);
  (slope, [1; 1/x], 0);
  (slope, [], 1/0);
  (square [[x; 0]; [0; 1]], [], 0);
  (square [[x; y]; [1; 0]; [0; 1]], [], 0);
  (over [x - 1/10] [[x - 1/2; 0]; [0; 1]], [], 4/10) ].

Definition true_thresholds : list (question * list expression * expression) := [
  (slope, [], 1 - 1e-6);
  (slope, [1/2; 2], 0.999);
  (slope, [y + 1; 1], 0.999);
  (square [[0; x + 2]; [1; y]], [], 0.999);
  (square [[x; 1]; [1; - x]], [], 0.999);
  (over [x - 1/10] [[x - 1/2; 0]; [0; 1]], [], 0.399) ].

Definition is_above (s : question * list expression * expression) (m : method) : bool :=
  let '(q, scales, threshold) := s in check_determinant q scales threshold m.

(** A point that shows that |det| is not above a threshold; coordinates beyond a range mean its end. *)
Definition is_not_above (s : coordinates) (threshold : expression) : bool :=
  check_point slope [] threshold s.

Goal map (fun s => existsb (is_above s) methods) false_thresholds = map (fun _ => false) false_thresholds.
Proof. vm_compute. reflexivity. Qed.

Goal map (fun s => is_above s (Method 99 30)) true_thresholds = map (fun _ => true) true_thresholds.
Proof. vm_compute. reflexivity. Qed.

Goal map (fun s => is_not_above s (3/2)) [[-1; 1]; [-0.6; 0]; [neg_infinity; 2]]%float = [true; true; true].
Proof. vm_compute. reflexivity. Qed.

Goal map (fun s => is_not_above s (3/2)) [[0; 1]; [-0.4; 0]; [infinity; 2]; []; [-1]; [nan; 0]]%float
  = map (fun _ => false) (seq 0 6).
Proof. vm_compute. reflexivity. Qed.

(** |det| = |x| or |x| + 1 between -1 and 1. *)
Definition crosses (f : expression) (scales : list expression) (threshold : expression) : bool :=
  check_crossing (square [[f; 0]; [0; 1]]) scales threshold [-1; 1]%float [1; 1]%float.

Goal [crosses x [] 0; crosses x [y; 1] (1/10)] = [true; true].
Proof. vm_compute. reflexivity. Qed.

Goal [crosses x [] (- 1/10); crosses x [1/x; 1] 1; crosses (abs x + 1) [] 2; crosses x [] (1/0)]
  = [false; false; false; false].
Proof. vm_compute. reflexivity. Qed.

(** Forces F with M^T F = v. *)
Definition sheared : question := square [[1; x]; [0; 1]].

Record force_claim := on { of : question; row : nat; load : list expression; limit : expression }.

Definition false_forces : list force_claim := [
  (* The force of row 1 is -x: its bound is attained, or less than what is attained. *)
  on sheared 1 [1; 0] 1;
  on sheared 1 [1; 0] (999/1000);
  on sheared 1 [2; 0] 1.999;
  on sheared 0 [y; 0] 2;
  (* At some point no force balances the load, or each of many. *)
  on (square [[x; 0]; [0; 1]]) 0 [1; 0] 1000;
  on (square [[x; 0]; [0; 1]]) 1 [0; 0] 1;
  on (square [[x; 0]; [0; 1]]) 1 [0; 1] 1000;
  on (square [[1]; [0]]) 0 [1] 2;
  on (square [[1; 0]; [0; 1]; [0; 1]]) 0 [1; 0] 2;
  (* The load has no value, the limit has none, or is not positive. *)
  on sheared 1 [0; 1/x] 1000;
  on sheared 1 [1; 0] (1/0);
  on sheared 1 [1; 0] 0;
  on sheared 1 [1; 0] (- 2);
  (* No such row; too few or too many entries. *)
  on sheared 2 [1; 0] 2;
  on sheared 1 [1] 2;
  on sheared 1 [1; 0; 0] 2;
  on sheared 1 [] 2;
  on (square [[1; 0; 1/x]; [0; 1]]) 0 [1; 0] 2;
  on (square [[1; 0]; [0]]) 1 [0; 1] 2;
  (* A constraint that excludes too little. *)
  on (over [1/10 - x] [[x; 0]; [0; 1]]) 0 [1; 0] 10 ].

Definition true_forces : list force_claim := [
  on sheared 1 [1; 0] 1.001;
  on sheared 1 [y; 0] 2.001;
  on sheared 0 [y; 1/3] 2.001;
  on sheared 1 [0; 0] (1e-6);
  on (over [1/10 - x] [[x; 0]; [0; 1]]) 0 [1; 0] 10.1 ].

Definition is_within (s : force_claim) (m : method) : bool :=
  check_force range_within (of s) (row s) (load s) (limit s) m.

(** The force of row 0 is between -2 and 0: only the absolute force has a bound that is not small. *)
Definition is_below (limit : expression) : bool * bool :=
  (check_force range_below sheared 0 [- y; 0] limit (Method 99 30),
   check_force range_within sheared 0 [- y; 0] limit (Method 99 30)).

Goal map (fun s => existsb (is_within s) methods) false_forces = map (fun _ => false) false_forces.
Proof. vm_compute. reflexivity. Qed.

Goal map (fun s => is_within s (Method 99 30)) true_forces = map (fun _ => true) true_forces.
Proof. vm_compute. reflexivity. Qed.

Goal map is_below [1/1000; 2; 2.001; 0] = [(true, false); (true, false); (true, true); (false, false)].
Proof. vm_compute. reflexivity. Qed.

Goal map (check_force_tree range_within (over [1/10 - x] [[x; 0]; [0; 1]]) 0 [1; 0] 20 (Method 2 0))
  [Leaf; Split 0 Leaf Leaf; Split 2 Leaf Leaf] = [false; false; false].
Proof. vm_compute. reflexivity. Qed.

(** Trees that leave a box open, or split what is not there. *)
Definition false_trees : list tree :=
  [Leaf; Split 0 Leaf Leaf; Split 1 Leaf Leaf; Split 5 Leaf Leaf; Split 0 (Split 9 Leaf Leaf) Leaf].

Goal map (check_tree (square [[x + 1/10; 0]; [0; 1]]) (Method 2 0)) false_trees
  = map (fun _ => false) false_trees.
Proof. vm_compute. reflexivity. Qed.

(** Singular at -1/10, which is excluded. The last split is that of [-1/8, 0]. To split a
    variable that does not exist changes nothing. *)
Definition beside : question := over [- x - 1/20] [[x + 1/10; 0]; [0; 1]].
Definition last_part (t : tree) : tree :=
  Split 0 (Split 0 Leaf (Split 0 Leaf (Split 0 Leaf t))) Leaf.

Goal map (check_tree beside (Method 2 0)) (map last_part (Split 0 Leaf Leaf :: false_trees))
  = [true; false; true; false; false; true].
Proof. vm_compute. reflexivity. Qed.

Definition shown (s : question * coordinates * coordinates) : bool :=
  let '(q, a, b) := s in check_singularity q a b.

Goal map shown false_segments = map (fun _ => false) false_segments.
Proof. vm_compute. reflexivity. Qed.

Goal map shown true_segments = map (fun _ => true) true_segments.
Proof. vm_compute. reflexivity. Qed.

Goal map refused false_claims = map (fun _ => true) false_claims.
Proof. vm_compute. reflexivity. Qed.

Goal map proved true_claims = map (fun _ => true) true_claims.
Proof. vm_compute. reflexivity. Qed.

(** A range that means nothing makes a claim false, not empty. *)
Definition endless : question := Question [(0, 1/0)] [] [] [] [[1]] 1.
From Coq Require Import Reals Qreals Lra.
Goal ~ no_singularity endless.
Proof.
  intros [E _]. apply Forall_inv in E. destruct E as [_ (_ & _ & D)]. apply D.
  simpl. unfold Q2R. simpl. lra.
Qed.
