(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** Theorems about pavings keep parts of a set. What is false in one of these parts is refused,
    and what is true next to it is proved. *)
From Coq Require Import List.
From Coq Require Import PrimFloat.
From Regulus Require Import Expressions Questions Search Singularity Threshold Forces Limits.
From Regulus Require Import Closures Tubes Branches Ways Rates Parts.
From Regulus Require Import Notations.
Import ListNotations.

(** x > place, x <= place, and between two places; x is variable 0. *)
Definition cut (variable : nat) (place : float) : parts -> parts -> parts := Parted variable place.
Definition above (place : float) : parts := cut 0 place LeftOut Kept.
Definition up_to (place : float) : parts := cut 0 place Kept LeftOut.
Definition between (a b : float) : parts := cut 0 a LeftOut (up_to b).

(** ** Forces within limits: F_1 = w/2 and F_2 = 3/x for x in [1, 2]; F_2 <= 2 from 3/2 on *)

Definition robot : question :=
  Question [(1, 2); (-1, 1)] [] [] [] [[2; 0]; [0; Name 0]] 2.
Definition limits : list (expression * expression) := [(-0.51, 0.51); (0, 2.01)].
Definition holds_in_parts (w : parts) : bool :=
  check_limits_in robot w [1; 1] [Name 1; 3] limits (Method 2 12).

Goal map holds_in_parts [above 1.5; above 1.75; between 1.5 1.75; LeftOut;
    (* w is variable 1. *)
    cut 1 0 (above 1.5) (above 1.75)] = repeat true 5.
Proof. vm_compute. reflexivity. Qed.

Goal map holds_in_parts [Kept; up_to 1.5; above 1.375; between 1.375 1.5; between 1.125 1.25;
    cut 0 1.5 (between 1.25 1.3125) Kept; cut 0 1.5 (up_to 1.0625) Kept;
    cut 1 0 (above 1.5) Kept; cut 1 (-2) LeftOut Kept;
    (* No variable has this number: its value is 0. *)
    cut 7 1 Kept LeftOut; cut 7 (-1) LeftOut Kept;
    (* These are no numbers. *)
    above nan; above neg_infinity; cut 0 infinity LeftOut Kept] = repeat false 14.
Proof. vm_compute. reflexivity. Qed.

Definition by_trees (w : parts) (ts : list Search.tree) : bool :=
  check_limits_trees robot w [1; 1] [Name 1; 3] limits (Method 2 12) ts.
Definition halves : Search.tree := Split 0 (Split 0 Leaf Leaf) (Split 0 Leaf Leaf).
Definition two : parts := cut 0 1.75 (above 1.5) Kept.
Goal (by_trees (above 1.5) [halves], by_trees two [halves; halves]) = (true, true).
Proof. vm_compute. reflexivity. Qed.
Goal [by_trees (above 1.5) []; by_trees (above 1.5) [halves; halves]; by_trees two [halves];
      by_trees Kept [halves]; by_trees (above 1.25) [halves]] = repeat false 5.
Proof. vm_compute. reflexivity. Qed.

(** ** A branch: p^2 = x + 1 for x in [-2, 1/4], p near 1 at x = 0. Both roots meet at x = -1. *)

Definition x := Name 0.
Definition p := Name 1.
Definition slider (l : expression) (constraints : list expression) : closure :=
  Closure (Question [(l, 1/4)] [] constraints [] [] 0) 1 [] [p^2 - x - 1] [] [0] [(1, 1/2)].
Definition the_slider := slider (-2) [].
Definition the_method := Method 1 6.
Definition lower : tubes := (Held (Tube [0] [1] [[0x1p-1]] [0x1p-4]))%float.
Definition upper : tubes := (Held (Tube [0x1p-3] [0x1.0fp+0] [[0x1.ep-2]] [0x1p-6]))%float.
Definition negative : tubes := (Held (Tube [0x1p-3] [-0x1.0fp+0] [[-0x1.ep-2]] [0x1p-6]))%float.
Definition known : tubes := Cut 0 0%float lower upper.
Definition the_tubes : tubes := Cut 0 (-0.25)%float NoTube known.
Definition branch (w : parts) (g : tubes) : bool := check_closure_in the_slider w the_method g.

Theorem the_paving : one_branch_in the_slider (above (-0.25)).
Proof. apply (check_closure_in_correct _ _ the_method the_tubes). vm_compute. reflexivity. Qed.

(** The parts need not be cut where the tubes are. *)
Goal map (fun w => branch w the_tubes) [above (-0.25); above (-0.125); between (-0.25) 0.125;
    cut 0 (-0.25) LeftOut Kept; cut 0 0 (above (-0.25)) Kept;
    cut 0 (-0.5) LeftOut (above (-0.25)); cut 0 0.125 (above (-0.25)) Kept;
    cut 0 0.125 (above (-0.25)) LeftOut] = repeat true 8.
Proof. vm_compute. reflexivity. Qed.

(** A part without a tube is kept; the start is left out, or at the end of what is left out. *)
Goal map (fun w => branch w the_tubes) [Kept; above (-0.5); up_to (-0.25); between (-1.5) (-1);
    cut 0 (-0.25) (between (-0.5) (-0.375)) Kept; LeftOut; above 0.125; up_to (-0.125);
    above 0; up_to 0; cut 0 (-0.25) LeftOut (cut 0 0.0625 LeftOut Kept)] = repeat false 11.
Proof. vm_compute. reflexivity. Qed.

(** No tube at the start; the other branch there, or next to it; a tube where both roots meet. *)
Goal map (branch (above (-0.25))) [NoTube; Cut 0 (-0.25)%float NoTube NoTube;
    Cut 0 (-0.25)%float NoTube (Cut 0 0%float NoTube upper);
    Cut 0 (-0.25)%float NoTube negative;
    Cut 0 (-0.25)%float NoTube (Cut 0 0%float lower negative);
    Cut 0 (-0.25)%float lower known; Cut 0 (-0.25)%float Excluded known;
    Cut 0 (-0.5)%float NoTube known; Cut 0 (-0.25)%float known NoTube] =
  [false; false; false; false; false; false; false; true; false].
Proof. vm_compute. reflexivity. Qed.

(** Without parts nothing may be without a tube, but for what is excluded. *)
Goal [check_closure the_slider the_method the_tubes;
      check_closure (slider (-2) [- x - 1/8]) the_method the_tubes;
      check_closure_in (slider (-2) [- x - 1/8]) (above (-0.125)) the_method the_tubes;
      check_closure (slider (-2) [- x - 1/8]) the_method (Cut 0 (-0.25)%float Excluded known)] =
  [false; false; true; true].
Proof. vm_compute. reflexivity. Qed.

(** ** Along a way: x goes from 0 to 1/4, and from there to -2 *)

Definition on_way (piece : list expression) : closure :=
  Closure (Question [(0, 1)]
             [nth 0 piece no_entry; nth 1 piece no_entry; Name 1 + Name 0 * Name 2] [] [] [] 0)
    1 [] [Name 4 ^ 2 - Name 3 - 1] [] [0] [(1, 1/2)].
Definition way := segments [[0]; [1/4]; [-2]].
Definition up : tubes := (Held (Tube [0x1p-1] [0x1.0f8p+0] [[0x1.ep-4]] [0x1p-6]))%float.
Definition begin (sign : float) : tubes :=
  (Held (Tube [0x1p-4] [sign * 0x1.0dap+0] [[sign * (-0x1.116p+0)]] [0x1p-6]))%float.
Definition down : tubes := Cut 0 0.125%float (begin 1) NoTube.
Definition along (ws : list parts) (gs : list tubes) : bool :=
  check_closure_along_in on_way way ws the_method gs.

Theorem the_paving_of_a_way : one_branch_along_in on_way way [Kept; up_to 0.125].
Proof.
  apply (check_closure_along_in_correct _ _ _ the_method [up; down]). vm_compute. reflexivity.
Qed.

Goal map (fun ws => along ws [up; down]) [[Kept; up_to 0.125]; [Kept; up_to 0.0625];
    [Kept; LeftOut]; [up_to 0.5; LeftOut]] = repeat true 4.
Proof. vm_compute. reflexivity. Qed.
Goal map (fun ws => along ws [up; down]) [[Kept; Kept]; [Kept; up_to 0.25]; [Kept; above 0.125];
    [LeftOut; up_to 0.125]; [above 0.125; up_to 0.125]; [Kept]; [Kept; LeftOut; LeftOut]; []] =
  repeat false 8.
Proof. vm_compute. reflexivity. Qed.
(** The other branch on the second piece; no tube on a piece; a tree too few. *)
Goal [along [Kept; up_to 0.125] [up; Cut 0 0.125%float (begin (-1)) NoTube];
      along [Kept; up_to 0.125] [up; NoTube]; along [Kept; LeftOut] [up; NoTube];
      along [Kept; LeftOut] [NoTube; NoTube]; along [Kept; LeftOut] [up];
      check_closure_along on_way way the_method [up; down]] =
  [false; false; true; false; false; false].
Proof. vm_compute. reflexivity. Qed.

(** ** Limits over a branch: the load is in [1, 3], and the force is w/(2p) <= 3/2 for x >= 0 *)

Definition load := Vectors [(2, 1)] [].
Definition fine : tubes :=
  Cut 0 (-0.25)%float NoTube (Cut 0 0%float lower (Cut 0 0.0625%float upper upper)).
Definition kept_within (limit : expression) (v : parts) : bool :=
  check_branch_within_limits_in the_slider (above (-0.25)) v [0]%nat load [(0, limit)] the_method
    fine.

Goal (kept_within 1.5 (above 0.0625), kept_within 1.5 LeftOut, kept_within 1.74 (above (-0.25)),
      kept_within 1.6 (above 0)) = (true, true, true, true).
Proof. vm_compute. reflexivity. Qed.
Goal [kept_within 1.5 Kept; kept_within 1.5 (above (-0.25)); kept_within 1.5 (above (-0.125));
      kept_within 1.5 (up_to 0.0625); kept_within 1.4 (above 0.0625);
      kept_within 1.74 Kept; kept_within 1.74 (above (-0.5));
      kept_within 1.5 (cut 0 0.0625 (between (-0.1875) (-0.125)) Kept)] = repeat false 8.
Proof. vm_compute. reflexivity. Qed.
(** The branch is not where it is claimed to be. *)
Goal check_branch_within_limits_in the_slider Kept (above 0.0625) [0]%nat load [(0, 1.5)] the_method
  fine = false.
Proof. vm_compute. reflexivity. Qed.

Definition motor_on_way (piece : list expression) : closure :=
  Closure (Question [(0, 1); (0, 0)]
             [nth 0 piece no_entry; nth 1 piece no_entry; Name 2 + Name 0 * Name 3;
              Name 4 + Name 1] [] [] [] 0)
    1 [] [Name 6 ^ 2 - Name 5 - 1] [] [0; 0] [(1, 1/2)].
(** The same tubes; the error of the motor is one more variable. *)
Fixpoint with_error (g : tubes) : tubes :=
  match g with
  | Held t => Held (Tube (foot t ++ [zero]) (axis_at t) (map (fun r => r ++ [zero]) (tilt t))
                      (reach t))
  | Cut k q l u => Cut k q (with_error l) (with_error u)
  | _ => g
  end.
Definition along_within (limit : expression) (ws vs : list parts) : bool :=
  check_branch_within_limits_along_in motor_on_way way ws vs [1]%nat load [(0, limit)] the_method
    [with_error up; with_error down].

(** On the first piece the force is at most 1.5, and on the begin of the second one 1.52. *)
Goal (along_within 1.51 [Kept; up_to 0.125] [Kept; LeftOut],
      along_within 1.53 [Kept; up_to 0.125] [Kept; up_to 0.125],
      along_within 1.53 [Kept; up_to 0.0625] [Kept; up_to 0.125]) = (true, true, true).
Proof. vm_compute. reflexivity. Qed.
Goal [along_within 1.51 [Kept; up_to 0.125] [Kept; up_to 0.125];
      along_within 1.49 [Kept; up_to 0.125] [Kept; LeftOut];
      along_within 1.53 [Kept; up_to 0.125] [Kept; Kept];
      along_within 1.53 [Kept; up_to 0.125] [Kept]; along_within 1.53 [Kept; Kept] [Kept; LeftOut];
      along_within 1.53 [Kept; up_to 0.125] []] = repeat false 6.
Proof. vm_compute. reflexivity. Qed.
