(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** The derivatives of the equations by the unknowns, whose determinant and condition number are
    known by hand, and deflections: what is false is refused, and what is true next to it is
    proved. *)
From Coq Require Import List.
From Coq Require Import PrimFloat.
From Regulus Require Import Expressions Questions Search Closures Tubes Branches Rates Slopes Parts.
From Regulus Require Import Notations.
Import ListNotations.

Definition x := Name 0.
Definition p := Name 1.
Definition the_method := Method 1 6.
Definition lower : tubes := (Held (Tube [0] [1] [[0x1p-1]] [0x1p-4]))%float.
Definition upper : tubes := (Held (Tube [0x1p-3] [0x1.0fp+0] [[0x1.ep-2]] [0x1p-6]))%float.
Definition the_tubes := Cut 0 0%float lower upper.

(** p^2 = x + 1 for x in [-1/4, 1/4]. The derivative 2p is in [1.73205, 2.23607]. *)
Definition slider (e : expression) : closure :=
  Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 1 [] [e] [] [0] [(1, 1/2)].
Definition of (e : expression) (s : side) (limit : expression) : bool :=
  check_branch_determinant (slider e) s limit the_method the_tubes.
Definition one_way := of (p^2 - x - 1).
Definition other_way := of (x + 1 - p^2).

Goal [one_way Beyond 1.73; one_way Above 1.73; one_way Within 2.24; one_way Below 2.24;
      one_way Above (-1); one_way Beyond (-1); other_way Beyond 1.73; other_way Below (-1.73);
      other_way Above (-2.24); other_way Within 2.24] = repeat true 10.
Proof. vm_compute. reflexivity. Qed.

Goal [one_way Beyond 1.733; one_way Above 1.733; one_way Within 2.236; one_way Below 2.236;
      one_way Below (-1.73); one_way Within (-1); one_way Within 1; other_way Beyond 1.733;
      other_way Above 1; other_way Below (-1.733); other_way Above (-2.236);
      other_way Within 2.236; one_way Above (1/0); one_way Beyond (sqrt (-1))] = repeat false 14.
Proof. vm_compute. reflexivity. Qed.

(** No branch, no bound: nothing is held; both roots meet at x = -1/4; a root has no value. *)
Goal [check_branch_determinant (slider (p^2 - x - 1)) Above (-9) the_method Excluded;
      of (p^2 - 4*x - 1) Above (-9); of (p^2 - x - 1 + 0*sqrt(x)) Above (-9)] = repeat false 3.
Proof. vm_compute. reflexivity. Qed.

(** In the part below x = 0 the derivative is at most 2, in the other one at least that. *)
Definition below_0 : parts := (Parted 0 0 Kept LeftOut)%float.
Definition above_0 : parts := (Parted 0 0 LeftOut Kept)%float.
Definition part (v : parts) (s : side) (limit : expression) : bool :=
  check_branch_determinant_in (slider (p^2 - x - 1)) Kept v s limit the_method the_tubes.
Goal [part below_0 Below 2.001; part above_0 Above 1.999; part LeftOut Below (-9);
      part below_0 Below 1.999; part above_0 Above 2.001; part Kept Above 1.999] =
  [true; true; true; false; false; false].
Proof. vm_compute. reflexivity. Qed.

(** A single number has the condition number 1. *)
Definition condition (factors : list expression) (limit : expression) : bool :=
  check_branch_condition (slider (p^2 - x - 1)) factors limit the_method the_tubes.
Goal [condition [1] 1.1; condition [7] 1.1; condition [1] 1; condition [1] 0.99;
      condition [-1] 1.1; condition [0] 1.1; condition [] 1.1; condition [1; 1] 1.1;
      condition [1] (1/0); condition [1/0] 1.1] =
  [true; true; false; false; false; false; false; false; false; false].
Proof. vm_compute. reflexivity. Qed.

(** Two equations, 2 p + q = x and p - q = 0: the matrix is [2 1; 1 -1], of determinant -3, and its
    inverse is [1 1; 1 -2]/3. The norms are 3 and 1; with the factors 1 and 2 they are 4 and 2/3;
    with the factors 2 and 1, 5 and 1. At x = 0 both unknowns are 0. *)
Definition a := Name 1.
Definition b := Name 2.
Definition two : closure :=
  Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 2 [] [2*a + b - x; a - b] [] [0]
    [(0, 1/2); (0, 1/2)].
Definition of_two : tubes :=
  (Held (Tube [0] [0; 0] [[0x1.5555555555555p-2]; [0x1.5555555555555p-2]] [0x1p-8; 0x1p-8]))%float.
Definition condition_of_two (factors : list expression) (limit : expression) : bool :=
  check_branch_condition two factors limit the_method of_two.
Goal map (fun u => (condition_of_two (fst u) (snd u + 1e-9),
                    condition_of_two (fst u) (snd u - 1e-9)))
    [([1; 1], 3); ([1; 2], 8/3); ([2; 1], 5)] = repeat (true, false) 3.
Proof. vm_compute. reflexivity. Qed.
Goal map (fun u => check_branch_determinant two (fst u) (snd u) the_method of_two)
    [(Above, -3 - 1e-9); (Below, -3 + 1e-9); (Beyond, 3 - 1e-9); (Within, 3 + 1e-9);
     (Above, -3 + 1e-9); (Below, -3 - 1e-9); (Beyond, 3 + 1e-9); (Within, 3 - 1e-9)] =
  [true; true; true; true; false; false; false; false].
Proof. vm_compute. reflexivity. Qed.

(** A motor of stiffness 10 gives way: the deflection is w/(40 p^2), w in [1, 3]: in
    [0.02, 0.1]. *)
Definition motor : list nat := [0]%nat.
Definition load := Vectors [(2, 1)] [].
Definition deflects (which : side) (stiffness : list expression) (limit : expression) : bool :=
  check_measure which (slider (p^2 - x - 1)) motor (Deflection 0 stiffness) load limit the_method
    the_tubes.
Goal [deflects Within [10] 0.1001; deflects Below [10] 0.1001; deflects Above [10] 0.0199;
      deflects Within [20] 0.0501] = repeat true 4.
Proof. vm_compute. reflexivity. Qed.
Goal [deflects Within [10] 0.0999; deflects Below [10] 0.0999; deflects Above [10] 0.0201;
      deflects Within [20] 0.0499; deflects Within [] 9; deflects Within [0] 9;
      deflects Within [-10] 9; deflects Within [10; 10] 9; deflects Within [1/0] 9;
      check_measure Within (slider (p^2 - x - 1)) motor (Deflection 1 [10]) load 9 the_method
        the_tubes;
      check_measure Within (slider (p^2 - x - 1)) motor (Deflection 0 [10]) (Vectors [] []) 9
        the_method the_tubes] = repeat false 11.
Proof. vm_compute. reflexivity. Qed.

(** With two unknowns, a = b = x/3 move by 1/3 of the motor: unknown 1 deflects by
    (1/3) (w_0 + w_1)/3 / 5, which is 1/45 times 4 + 5. *)
Definition both := Vectors [(4, 0); (5, 0)] [].
Definition deflects_two (u : side * expression) : bool :=
  check_measure (fst u) two motor (Deflection 1 [5]) both (snd u) the_method of_two.
Goal map deflects_two
    [(Below, 0.2 + 1e-9); (Above, 0.2 - 1e-9); (Below, 0.2 - 1e-9); (Above, 0.2 + 1e-9)] =
  [true; true; false; false].
Proof. vm_compute. reflexivity. Qed.
