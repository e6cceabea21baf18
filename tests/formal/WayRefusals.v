(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** The check of a way refuses what is false, and accepts what is true next to it. *)
From Coq Require Import List.
From Coq Require Import PrimFloat.
From Regulus Require Import Expressions Questions Search Closures Tubes Branches Ways.
From Regulus Require Import Notations.
Import ListNotations.

(** p² = x + 1, where x = a + s b moves along the way; at the start p is near 1. *)
Definition s := Name 0.
Definition x := Name 3.
Definition p := Name 4.
Definition mechanism (last first : expression) (e : expression) (piece : list expression) :=
  Closure (Question [(0, last)]
             [nth 0 piece no_entry; nth 1 piece no_entry; Name 1 + s * Name 2] [] [] [] 0)
    1 [] [e] [] [first] [(1, 1/2)].
Definition slider := mechanism 1 0 (p^2 - x - 1).
Definition the_method := Method 1 6.

(** x goes from 0 to 1/4, and from there to -1/4. *)
Definition way := segments [[0]; [1/4]; [-1/4]].
Definition up : tubes := (Held (Tube [0x1p-1] [0x1.0f8p+0] [[0x1.ep-4]] [0x1p-6]))%float.
Definition down : tubes := (Held (Tube [0x1p-1] [1] [[-0x1p-2]] [0x1p-5]))%float.
Definition negative : tubes := (Held (Tube [0x1p-1] [-1] [[0x1p-2]] [0x1p-5]))%float.

Theorem the_slider : one_branch_along slider way.
Proof. apply (check_closure_along_correct _ _ the_method [up; down]). vm_compute. reflexivity. Qed.

Definition check c pieces trees := check_closure_along c pieces the_method trees.

(** The other branch on the second piece, or on both. *)
Goal check slider way [up; negative] = false.
Proof. vm_compute. reflexivity. Qed.
Goal check slider (segments [[1/4]; [-1/4]]) [negative] = false.
Proof. vm_compute. reflexivity. Qed.
(** As many trees as pieces, and one at least. *)
Goal (check slider way [up], check slider way [up; down; down], check slider [] [])
  = (false, false, false).
Proof. vm_compute. reflexivity. Qed.
Goal ~ one_branch_along slider [].
Proof. intros [[[] _] _]. Qed.
(** The second piece begins elsewhere. Its tube alone holds. *)
Goal (check slider [[0; 1/4]; [1/4; -1/2]] [up; down],
      check slider [[0; 1/4]; [1/4 - 1e-9; -1/2]] [up; down]) = (true, false).
Proof. vm_compute. reflexivity. Qed.
(** Numbers with pi are compared exactly; a sine is not compared. *)
Goal (check slider [[0; pi/12]; [15 * deg; -pi/6]] [up; down],
      check slider [[0; pi/12]; [0.2617993877991494; -pi/6]] [up; down],
      check slider [[0; sin(1/4)]; [sin(1/4); -1/2]] [up; down]) = (true, false, false).
Proof. vm_compute. reflexivity. Qed.
(** The equation depends on s, or the name of a piece: it is another one where the next piece begins. *)
Goal (check (mechanism 1 0 (p^2 - x - 1 + 0 * s)) way [up; down],
      check (mechanism 1 0 (p^2 - x - 1 + 0 * Name 1)) way [up; down]) = (false, false).
Proof. vm_compute. reflexivity. Qed.
(** s goes from 0 to 1, and the start is on the first piece. *)
Goal (check (mechanism (9/10) 0 (p^2 - x - 1)) way [up; down],
      check (mechanism 1 (1/100) (p^2 - x - 1)) way [up; down],
      check (mechanism 1 (-1/1000000) (p^2 - x - 1)) way [up; down]) = (false, true, false).
Proof. vm_compute. reflexivity. Qed.
(** Where x is -1, both roots meet. *)
Goal check slider (segments [[0]; [1/4]; [-1]]) [up; down] = false.
Proof. vm_compute. reflexivity. Qed.
