(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** The theorem of one solution, without any check: x² = 2 has one root within 1/4 of 3/2, the
    derivative is not 0 there. *)
From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Regulus Require Import LinearAlgebra Existence.
Open Scope R_scope.

Definition square_less_2 (p : nat -> R) (i : nat) : R := (3 / 2 + p 0%nat) ^ 2 - 2.
Definition its_slope (p : nat -> R) (i j : nat) : R := 2 * (3 / 2 + p 0%nat).

Theorem one_root :
  (exists p, inside 1 (fun _ => 1 / 4) p /\ (forall i, (i < 1)%nat -> square_less_2 p i = 0) /\
     forall q, inside 1 (fun _ => 1 / 4) q -> (forall i, (i < 1)%nat -> square_less_2 q i = 0) ->
       forall i, (i < 1)%nat -> q i = p i) /\
  forall p, inside 1 (fun _ => 1 / 4) p -> full_column_rank 1 1 (its_slope p).
Proof.
  apply (exactly_one 1 square_less_2 its_slope (fun _ _ => 1 / 3) (fun _ _ => 1 / 6)
           (fun _ => 1 / 4) (fun _ => 1 / 12)).
  - intros p q i H _. unfold square_less_2. rewrite H by lia. reflexivity.
  - intros p i j P I J. unfold square_less_2, its_slope.
    replace j with 0%nat by lia. unfold update. simpl. auto_derive; [exact Logic.I|ring].
  - intros; lra.
  - intros p i j P I J. specialize (P 0%nat ltac:(lia)). simpl. unfold its_slope, identity.
    replace i with 0%nat by lia. replace j with 0%nat by lia. simpl.
    apply Rabs_le_between in P. apply Rabs_le. lra.
  - intros i I. simpl. lra.
  - intros i I. unfold image, square_less_2. simpl. apply Rabs_le. lra.
  - intros i I. simpl. lra.
Qed.

(** Two roots: the theorem does not hold for a box that has both. *)
Theorem two_roots : forall e : nat -> nat -> R,
  (forall p i j, inside 1 (fun _ => 3) p -> (i < 1)%nat -> (j < 1)%nat ->
     Rabs (sum 1 (fun l => 1 / 3 * its_slope p l j) - identity i j) <= e i j) ->
  ~ (forall i, (i < 1)%nat -> sum 1 (fun j => e i j * 3) < 3).
Proof.
  intros e H C. specialize (C 0%nat ltac:(lia)). simpl in C.
  assert (B : inside 1 (fun _ : nat => 3) (fun _ => - (3 / 2))).
  { intros i _. apply Rabs_le. lra. }
  specialize (H _ 0%nat 0%nat B ltac:(lia) ltac:(lia)). unfold its_slope, identity in H.
  simpl in H. apply Rabs_le_between in H. lra.
Qed.
