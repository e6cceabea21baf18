(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** Finite errors whose values are known by hand: what is false is refused, and what is true next to
    it is proved. *)
From Coq Require Import List.
From Coq Require Import PrimFloat.
From Regulus Require Import Expressions Questions Search Closures Tubes Branches Distances.
From Regulus Require Import Notations.
Import ListNotations.

Definition x := Name 0.
Definition g := Name 1.
Definition p := Name 2.
Definition the_method := Method 2 6.
Definition lower : tubes := (Held (Tube [-0x1p-3; 1] [0x1.dfp-1; 0x1.dfp-1]
  [[0x1.11p-1; 0x1.11p-1]; [0x1.11p-1; 0]] [0x1p-6; 0x1p-6]))%float.
Definition upper : tubes := (Held (Tube [0x1p-3; 1] [0x1.0fp+0; 0x1.0fp+0]
  [[0x1.ep-2; 0x1.ep-2]; [0x1.ep-2; 0]] [0x1p-6; 0x1p-6]))%float.
Definition the_tubes := Cut 0 0%float lower upper.

(** p^2 = x + g for x in [-1/4, 1/4] and g in [9/10, 11/10]. Without errors g is 1. The largest
    distance is sqrt(3/4) - sqrt(13/20) = 0.0597997, at x = -1/4. *)
Definition slider (e : expression) : closure :=
  Closure (Question [(-1/4, 1/4); within 1 (1/10)] [] [] [] [] 0) 1 [] [e] [] [0; 1] [(1, 1/2)].
Definition the_slider := slider (p^2 - x - g).

Definition within_of (c : closure) (errors : list nat) (limit : expression) : bool :=
  check_finite_error_within c errors 0 limit the_method the_tubes.

Goal (within_of the_slider [1]%nat 0.0599, within_of the_slider [1]%nat 0.0597) = (true, false).
Proof. vm_compute. reflexivity. Qed.

(** Twice the same mechanism: the distance is 0. It is not less than 0. *)
Goal (within_of the_slider []%nat 0.01, within_of the_slider []%nat 0) = (true, false).
Proof. vm_compute. reflexivity. Qed.

(** x has an error, too: without errors x is 0 and p is 1, and p is in [0.806, 1.162]. *)
Definition both_narrow : tubes := (Held (Tube [0; 1] [1; 1]
  [[0x1p-1; 0x1p-1]; [0; 0]] [0x1p-3; 0x1p-3]))%float.
Goal (check_finite_error_within the_slider [0; 1]%nat 0 0.196 the_method both_narrow,
      check_finite_error_within the_slider [0; 1]%nat 0 0.193 the_method both_narrow)
  = (true, false).
Proof. vm_compute. reflexivity. Qed.

(** The middle of a range, not the value at the start, and not 0: g in [1, 12/10] is 11/10 without
    errors. The distance is largest at x = -1/4: sqrt(17/20) - sqrt(3/4) = 0.0559289. *)
Definition shifted : closure :=
  Closure (Question [(-1/4, 1/4); (1, 6/5)] [] [] [] [] 0) 1 [] [p^2 - x - g] [] [0; 11/10]
    [(1.05, 1/2)].
Definition of_shifted : tubes := (Cut 0 0
  (Held (Tube [-0x1p-3; 0x1.19999ap+0] [0x1.f9861p-1; 0x1.f9861p-1]
    [[0x1.037p-1; 0x1.037p-1]; [0x1.037p-1; 0]] [0x1p-6; 0x1p-6]))
  (Held (Tube [0x1p-3; 0x1.19999ap+0] [0x1.1b5fcp+0; 0x1.1b5fcp+0]
    [[0x1.cep-2; 0x1.cep-2]; [0x1.cep-2; 0]] [0x1p-6; 0x1p-6])))%float.
Goal (check_finite_error_within shifted [1]%nat 0 0.0561 the_method of_shifted,
      check_finite_error_within shifted [1]%nat 0 0.0558 the_method of_shifted) = (true, false).
Proof. vm_compute. reflexivity. Qed.

(** The names of a definition, of one that uses an unknown, and of a constraint are those of the
    copy beside those of the mechanism. h = g + 1 and k = p^2 + h: the same as above. *)
Definition named (constraint : expression) : closure :=
  Closure (Question [(-1/4, 1/4); within 1 (1/10)] [Name 1 + 1; Name 2 - 1] [constraint] [Name 3]
    [] 0) 1 [Name 4 ^ 2 + Name 2; Name 5 - Name 2] [Name 6 - x - Name 3] [Name 5] [0; 1] [(1, 1/2)].
Goal (within_of (named (x - 1)) [1]%nat 0.0599, within_of (named (x - 1)) [1]%nat 0.0597)
  = (true, false).
Proof. vm_compute. reflexivity. Qed.
(** A name that the constraint does not have is none in the copy either: it excludes nothing. *)
Goal check_finite_error_within (named (Name 4 + 9)) [1]%nat 0 0.0599 the_method
  (Cut 0 0%float lower Excluded) = false.
Proof. vm_compute. reflexivity. Qed.
(** One that excludes a part of the range, and a tube that does not reach all that is left. *)
Goal (check_finite_error_within (named (x + 1/100)) [1]%nat 0 0.0599 the_method
        (Cut 0 0x1p-6 lower Excluded)%float,
      check_finite_error_within (named (x + 1/100)) [1]%nat 0 0.0599 the_method
        (Cut 0 (-0x1p-6) lower Excluded)%float) = (true, false).
Proof. vm_compute. reflexivity. Qed.

Definition unhalved (c : closure) : bool :=
  check_finite_error_within c [1]%nat 0 9 (Method 2 0) the_tubes.

(** An unknown that is not there; limits that are none. Nothing is held; a root has no value; a root
    has none where g is least; both roots meet. *)
Goal [check_finite_error_within the_slider [1]%nat 1 9 the_method the_tubes;
      within_of the_slider [1]%nat (1/0);
      within_of the_slider [1]%nat (-1);
      check_finite_error_within the_slider [1]%nat 0 9 the_method Excluded;
      unhalved (slider (p^2 - x - g + 0*sqrt(x)));
      unhalved (slider (p^2 - x - g + 0*sqrt(g - 95/100)));
      unhalved (slider (p^2 - 4*x - g))] = repeat false 7.
Proof. vm_compute. reflexivity. Qed.

(** Along a way: x goes from -1/4 to 1/4 in two pieces that meet at 0. Where they do not meet, there
    is no way. *)
Definition moving (piece : list expression) : closure :=
  Closure (Question [(0, 1); within 1 (1/10)]
    [nth 0 piece no_entry + Name 0 * nth 1 piece no_entry] [] [] [] 0) 1 []
    [Name 3 ^ 2 - Name 2 - Name 1] [] [1/2; 1] [(0.93, 1/4)].
Definition first_half : tubes := (Held (Tube [0x1p-1; 1] [0x1.dfp-1; 0x1.dfp-1]
  [[0x1.11p-3; 0x1.11p-1]; [0x1.11p-3; 0]] [0x1p-6; 0x1p-6]))%float.
Definition second_half : tubes := (Held (Tube [0x1p-1; 1] [0x1.0fp+0; 0x1.0fp+0]
  [[0x1.ep-4; 0x1.ep-2]; [0x1.ep-4; 0]] [0x1p-6; 0x1p-6]))%float.
Definition along (a b c : expression) (limit : expression) : bool :=
  check_finite_error_within_along moving [[a; b - a]; [c; 1/4 - c]] [1]%nat 0 limit the_method
    [first_half; second_half].
Goal (along (-1/4) 0 0 0.0599, along (-1/4) 0 0 0.0597, along (-1/4) 0 (1/100) 0.0599)
  = (true, false, false).
Proof. vm_compute. reflexivity. Qed.
