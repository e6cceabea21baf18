(* SPDX-License-Identifier: Apache-2.0 *)
(** Expressions are continuous where they are defined, and so are determinants. *)
From Coq Require Import Reals QArith Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions LinearAlgebra.
Import ListNotations.
Open Scope R_scope.

(** Names that depend on a parameter s, each continuous at s. *)
Definition continuous_names (names : R -> list R) (s : R) : Prop :=
  forall k, continuity_pt (fun t => nth k (names t) 0) s.

Lemma continuous_composition f g s :
  continuity_pt f s -> continuity_pt g (f s) -> continuity_pt (fun t => g (f t)) s.
Proof. exact (continuity_pt_comp f g s). Qed.

Lemma continuous_constant c s : continuity_pt (fun _ => c) s.
Proof. apply continuity_pt_const. intros x y. reflexivity. Qed.

Lemma continuous_power f n s : continuity_pt f s -> continuity_pt (fun t => f t ^ n) s.
Proof.
  intros H. induction n; simpl; [apply continuous_constant|].
  apply (continuity_pt_mult f (fun t => f t ^ n)); assumption.
Qed.

Theorem value_continuous names s e : continuous_names names s -> defined (names s) e ->
  continuity_pt (fun t => value (names t) e) s.
Proof.
  intros K. induction e; simpl; intros D.
  - apply continuous_constant.
  - apply continuous_constant.
  - apply K.
  - apply (continuity_pt_opp (fun t => value (names t) e)). auto.
  - destruct D. apply (continuity_pt_plus (fun t => value (names t) e1)); auto.
  - destruct D. apply (continuity_pt_minus (fun t => value (names t) e1)); auto.
  - destruct D. apply (continuity_pt_mult (fun t => value (names t) e1)); auto.
  - destruct D as (? & ? & ?). apply (continuity_pt_div (fun t => value (names t) e1)); auto.
  - apply continuous_power. auto.
  - destruct D. apply (continuous_composition _ sqrt); [auto|]. apply continuity_pt_sqrt.
    assumption.
  - apply (continuous_composition _ sin); [auto|]. apply continuity_sin.
  - apply (continuous_composition _ cos); [auto|]. apply continuity_cos.
  - apply (continuous_composition _ atan); [auto|].
    apply derivable_continuous_pt, derivable_pt_atan.
  - apply (continuous_composition _ exp); [auto|].
    apply derivable_continuous_pt, derivable_pt_exp.
  - destruct D. apply (continuous_composition _ ln); [auto|].
    apply derivable_continuous_pt. exists (/ value (names s) e). apply derivable_pt_lim_ln.
    assumption.
  - apply (continuous_composition _ Rabs); [auto|]. apply Rcontinuity_abs.
Qed.

Lemma extend_continuous ds : forall names s, continuous_names names s ->
  (forall t, length (names t) = length (names s)) -> all_defined (names s) ds ->
  continuous_names (fun t => extend (names t) ds) s.
Proof.
  induction ds as [|d ds IH]; intros names s K L D; simpl; [exact K|]. destruct D as [D1 D2].
  apply (IH (fun t => names t ++ [value (names t) d])).
  - intros k. destruct (Nat.lt_trichotomy k (length (names s))) as [H|[H|H]].
    + apply (continuity_pt_ext (fun t => nth k (names t) 0)); [|apply K].
      intros t. rewrite app_nth1; [reflexivity|]. rewrite L. exact H.
    + apply (continuity_pt_ext (fun t => value (names t) d)).
      * intros t. rewrite app_nth2, L, H, Nat.sub_diag; [reflexivity|]. rewrite L, H. lia.
      * apply value_continuous; assumption.
    + apply (continuity_pt_ext (fun _ => 0)); [|apply continuous_constant].
      intros t. rewrite nth_overflow; [reflexivity|]. rewrite app_size, L. simpl. lia.
  - intros t. rewrite !app_size, L. reflexivity.
  - exact D2.
Qed.

Lemma sum_continuous n (f : nat -> R -> R) s :
  (forall i, (i < n)%nat -> continuity_pt (f i) s) ->
  continuity_pt (fun t => sum n (fun i => f i t)) s.
Proof.
  induction n; intros H; simpl; [apply continuous_constant|].
  apply (continuity_pt_plus (fun t => sum n (fun i => f i t))); [apply IHn; auto|apply H; lia].
Qed.

Theorem determinant_continuous n : forall (a : R -> nat -> nat -> R) s,
  (forall i j, (i < n)%nat -> (j < n)%nat -> continuity_pt (fun t => a t i j) s) ->
  continuity_pt (fun t => determinant n (a t)) s.
Proof.
  induction n; intros a s H; simpl determinant; [apply continuous_constant|].
  apply (sum_continuous (S n)
    (fun j t => (-1) ^ j * (a t O j * determinant n (fun i k => a t (S i) (skip j k))))).
  intros j J. apply (continuity_pt_mult (fun _ => (-1) ^ j)); [apply continuous_constant|].
  apply (continuity_pt_mult (fun t => a t O j)); [apply H; lia|].
  apply (IHn (fun t i k => a t (S i) (skip j k))). intros i k I K. apply H; [lia|].
  unfold skip. destruct (k <? j); lia.
Qed.
