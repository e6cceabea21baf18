(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** The check of a closure refuses what is false, and accepts what is true next to it. *)
From Coq Require Import List.
From Coq Require Import PrimFloat.
From Regulus Require Import Expressions Questions Search Closures Tubes Branches.
From Regulus Require Import Notations.
Import ListNotations.

Definition x := Name 0.
Definition p := Name 1.

(** p² = x + 1 for x from l to 1/4; p is near c, within r, at x = 0. *)
Definition slider (l c r : expression) (constraints also : list expression) (e : expression) :=
  Closure (Question [(l, 1/4)] [] constraints [] [] 0) 1 [] [e] also [0] [(c, r)].
Definition true_slider := slider (-1/4) 1 (1/2) [] [] (p^2 - x - 1).
Definition the_method := Method 1 6.
Definition lower : tubes := (Held (Tube [0] [1] [[0x1p-1]] [0x1p-4]))%float.
Definition upper : tubes := (Held (Tube [0x1p-3] [0x1.0fp+0] [[0x1.ep-2]] [0x1p-6]))%float.
Definition true_tubes := Cut 0 0%float lower upper.
Definition negative : tubes := (Held (Tube [0x1p-3] [-0x1.0fp+0] [[-0x1.ep-2]] [0x1p-6]))%float.

Theorem the_slider : one_branch true_slider.
Proof. apply (check_closure_correct _ the_method true_tubes). vm_compute. reflexivity. Qed.

(** A tube of the other branch over one part: no link. *)
Goal check_closure true_slider the_method (Cut 0 0%float lower negative) = false.
Proof. vm_compute. reflexivity. Qed.
(** All tubes of the other branch: not that of the start. *)
Goal check_closure true_slider the_method negative = false.
Proof. vm_compute. reflexivity. Qed.
(** Both roots are within the radius. *)
Goal check_closure (slider (-1/4) 1 3 [] [] (p^2 - x - 1)) the_method true_tubes = false.
Proof. vm_compute. reflexivity. Qed.
(** No root is within the radius. *)
Goal check_closure (slider (-1/4) 2 (1/2) [] [] (p^2 - x - 1)) the_method true_tubes = false.
Proof. vm_compute. reflexivity. Qed.
(** At x = -1 both roots meet, and the derivative is 0. *)
Goal check_closure (slider (-1) 1 (1/2) [] [] (p^2 - x - 1)) the_method true_tubes = false.
Proof. vm_compute. reflexivity. Qed.
(** 1/(p - 1) has no value at x = 0. *)
Goal check_closure (slider (-1/4) 1 (1/2) [] [1/(p - 1)] (p^2 - x - 1)) the_method true_tubes =
  false.
Proof. vm_compute. reflexivity. Qed.
(** The root of p - 1 has no value at p = 1 and beyond. *)
Goal check_closure (slider (-1/4) 1 (1/2) [] [] (p^2 - x - 1 + 0*sqrt(p - 1))) the_method true_tubes
  = false.
Proof. vm_compute. reflexivity. Qed.
(** Nothing excludes the upper part; a constraint does, and then no tube is needed there. *)
Goal check_closure true_slider the_method (Cut 0 0x1p-4%float lower Excluded) = false.
Proof. vm_compute. reflexivity. Qed.
Goal check_closure (slider (-1/4) 1 (1/2) [x - 1/32] [] (p^2 - x - 1)) the_method
  (Cut 0 0x1p-4%float lower Excluded) = true.
Proof. vm_compute. reflexivity. Qed.
(** The start is in a box that is excluded. *)
Goal check_closure (slider (-1/4) 1 (1/2) [x + 1/32] [] (p^2 - x - 1)) the_method
  (Cut 0 (-0x1p-5)%float lower Excluded) = false.
Proof. vm_compute. reflexivity. Qed.
(** As many equations as unknowns. *)
Goal check_closure (Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 1 [] [p^2 - x - 1; p^2 - x - 1]
  []
  [0] [(1, 1/2)]) the_method true_tubes = false.
Proof. vm_compute. reflexivity. Qed.
Goal check_closure (Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 1 [] [p^2 - x - 1] [] [] [(1,
  1/2)])
  the_method true_tubes = false.
Proof. vm_compute. reflexivity. Qed.
Goal check_closure (Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 1 [] [p^2 - x - 1] [] [0] [])
  the_method true_tubes = false.
Proof. vm_compute. reflexivity. Qed.
(** A start beyond the range. *)
Goal check_closure (Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 1 [] [p^2 - x - 1] [] [1] [(1,
  1/2)])
  the_method true_tubes = false.
Proof. vm_compute. reflexivity. Qed.
