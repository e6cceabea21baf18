(* SPDX-License-Identifier: Apache-2.0 *)
(** Matrices as functions of row and column: rank, and conditions that are enough for it. *)
From Coq Require Import Reals Lra Lia Arith.
Open Scope R_scope.

Fixpoint sum (n : nat) (f : nat -> R) : R :=
  match n with O => 0 | S k => sum k f + f k end.

(** The columns of the matrix are independent. *)
Definition full_column_rank (rows columns : nat) (a : nat -> nat -> R) : Prop :=
  forall y : nat -> R,
    (forall i, (i < rows)%nat -> sum columns (fun j => a i j * y j) = 0) ->
    forall j, (j < columns)%nat -> y j = 0.

Definition identity (i j : nat) : R := if Nat.eqb i j then 1 else 0.

Lemma sum_le n f g : (forall i, (i < n)%nat -> f i <= g i) -> sum n f <= sum n g.
Proof.
  induction n; simpl; intros H; [lra|].
  assert (sum n f <= sum n g) by (apply IHn; intros; apply H; lia).
  specialize (H n ltac:(lia)). lra.
Qed.

Lemma sum_ext n f g : (forall i, (i < n)%nat -> f i = g i) -> sum n f = sum n g.
Proof.
  induction n; simpl; intros H; [reflexivity|].
  rewrite IHn by (intros; apply H; lia). rewrite H by lia. reflexivity.
Qed.

Lemma sum_abs n f : Rabs (sum n f) <= sum n (fun i => Rabs (f i)).
Proof.
  induction n; simpl; [rewrite Rabs_R0; lra|].
  eapply Rle_trans; [apply Rabs_triang|lra].
Qed.

Lemma sum_scale n c f : sum n (fun i => c * f i) = c * sum n f.
Proof. induction n; simpl; [lra|]. rewrite IHn. lra. Qed.

Lemma sum_plus n f g : sum n (fun i => f i + g i) = sum n f + sum n g.
Proof. induction n; simpl; [lra|]. rewrite IHn. lra. Qed.

Lemma sum_zero n f : (forall i, (i < n)%nat -> f i = 0) -> sum n f = 0.
Proof.
  induction n; simpl; intros H; [reflexivity|].
  rewrite IHn by (intros; apply H; lia). rewrite H by lia. lra.
Qed.

Lemma sum_swap m n f :
  sum m (fun i => sum n (fun j => f i j)) = sum n (fun j => sum m (fun i => f i j)).
Proof.
  induction m; simpl; [symmetry; apply sum_zero; reflexivity|].
  rewrite IHm, <- sum_plus. reflexivity.
Qed.

Lemma sum_identity n i f : (i < n)%nat -> sum n (fun j => identity i j * f j) = f i.
Proof.
  unfold identity. induction n; intros H; [lia|]. simpl.
  destruct (Nat.eq_dec i n) as [->|D].
  - rewrite Nat.eqb_refl, (sum_zero n); [lra|].
    intros j J. destruct (Nat.eqb_spec n j); [lia|lra].
  - rewrite IHn by lia. destruct (Nat.eqb_spec i n); [lia|lra].
Qed.

(** (KA)y = K(Ay). *)
Lemma sum_product m n (k : nat -> R) (a : nat -> nat -> R) (y : nat -> R) :
  sum n (fun j => sum m (fun l => k l * a l j) * y j)
  = sum m (fun l => k l * sum n (fun j => a l j * y j)).
Proof.
  rewrite (sum_ext n _ (fun j => sum m (fun l => k l * (a l j * y j)))).
  - rewrite sum_swap. apply sum_ext. intros. apply sum_scale.
  - intros j _. rewrite Rmult_comm, <- sum_scale. apply sum_ext. intros. ring.
Qed.

Lemma cauchy n (x y : nat -> R) :
  sum n (fun k => x k * y k) * sum n (fun k => x k * y k)
  <= sum n (fun k => x k * x k) * sum n (fun k => y k * y k).
Proof.
  assert (P : forall n x, 0 <= sum n (fun k => x k * x k)).
  { clear. intros n x. induction n as [|n IH]; simpl; [lra|]. nra. }
  induction n as [|n IH]; [simpl; lra|]. simpl.
  set (s := sum n (fun k => x k * y k)) in *. set (p := sum n (fun k => x k * x k)) in *.
  set (q := sum n (fun k => y k * y k)) in *. set (a := x n). set (b := y n).
  assert (0 <= p) by apply P. assert (0 <= q) by apply P.
  enough (2 * (s * (a * b)) <= p * (b * b) + q * (a * a)) by nra.
  destruct (Rle_dec (2 * (s * (a * b))) (p * (b * b) + q * (a * a))) as [H1|H1]; [exact H1|].
  exfalso. set (g := p * (b * b) + q * (a * a)) in *. set (h := 2 * (s * (a * b))) in *.
  assert (0 <= g) by (unfold g; nra).
  assert (G : 4 * ((p * q) * ((a * b) * (a * b))) <= g * g).
  { unfold g. pose proof (Rle_0_sqr (p * (b * b) - q * (a * a))) as Q. unfold Rsqr in Q. lra. }
  assert (Hh : h * h <= 4 * ((p * q) * ((a * b) * (a * b)))).
  { unfold h. pose proof (Rle_0_sqr (a * b)) as Q. unfold Rsqr in Q.
    pose proof (Rmult_le_compat_r _ _ _ Q IH). lra. }
  assert (g * g < h * h) by (apply Rmult_le_0_lt_compat; lra). lra.
Qed.

(** One of finitely many numbers is the largest. *)
Lemma largest n (f : nat -> R) :
  (0 < n)%nat -> exists k, (k < n)%nat /\ forall i, (i < n)%nat -> f i <= f k.
Proof.
  induction n; intros H; [lia|]. destruct n.
  - exists 0%nat. split; [lia|]. intros i I. replace i with 0%nat by lia. lra.
  - destruct IHn as [k [K M]]; [lia|]. destruct (Rle_dec (f k) (f (S n))).
    + exists (S n). split; [lia|]. intros i I.
      destruct (Nat.eq_dec i (S n)) as [->|]; [lra|]. specialize (M i ltac:(lia)). lra.
    + exists k. split; [lia|]. intros i I.
      destruct (Nat.eq_dec i (S n)) as [->|]; [lra|]. apply M; lia.
Qed.

(** If |E| v < v for some v > 0, then I + E is regular. *)
Theorem dominated n (e : nat -> nat -> R) (v : nat -> R) :
  (forall i, (i < n)%nat -> 0 < v i) ->
  (forall i, (i < n)%nat -> sum n (fun j => Rabs (e i j) * v j) < v i) ->
  full_column_rank n n (fun i j => identity i j + e i j).
Proof.
  intros Hv He x Hx.
  assert (Hx' : forall i, (i < n)%nat -> x i + sum n (fun j => e i j * x j) = 0).
  { intros i L. rewrite <- (Hx i L), <- (sum_identity n i x L) at 1. rewrite <- sum_plus.
    apply sum_ext. intros. ring. }
  clear Hx. intros i L.
  destruct (largest n (fun i => Rabs (x i) / v i)) as [k [K M]]; [lia|]. simpl in M.
  set (m := Rabs (x k) / v k) in *.
  assert (B : forall j, (j < n)%nat -> Rabs (x j) <= m * v j).
  { intros j J. specialize (M j J). pose proof (Hv j J).
    apply (Rmult_le_compat_r (v j)) in M; [|lra].
    unfold Rdiv in M at 1. rewrite Rmult_assoc, Rinv_l in M by lra. lra. }
  assert (m0 : 0 <= m).
  { unfold m, Rdiv. apply Rmult_le_pos; [apply Rabs_pos|].
    left. apply Rinv_0_lt_compat, Hv, K. }
  assert (Ek : Rabs (x k) = m * v k).
  { unfold m, Rdiv. rewrite Rmult_assoc, Rinv_l; [lra|]. specialize (Hv k K). lra. }
  destruct (Req_dec m 0) as [Z|NZ].
  - specialize (B i L). rewrite Z in B.
    destruct (Req_dec (x i) 0) as [|N]; [assumption|]. pose proof (Rabs_pos_lt _ N). lra.
  - exfalso. specialize (He k K). apply (Rmult_lt_compat_l m) in He; [|lra].
    enough (Rabs (x k) <= m * sum n (fun j => Rabs (e k j) * v j)) by lra.
    replace (x k) with (- sum n (fun j => e k j * x j)) by (specialize (Hx' k K); lra).
    rewrite Rabs_Ropp. eapply Rle_trans; [apply sum_abs|]. rewrite <- sum_scale.
    apply sum_le. intros j J. rewrite Rabs_mult.
    replace (m * (Rabs (e k j) * v j)) with (Rabs (e k j) * (m * v j)) by ring.
    apply Rmult_le_compat_l; [apply Rabs_pos|auto].
Qed.

(** Any matrix K shows by KA that A has full column rank. *)
Theorem full_rank_of_product p m n (k a : nat -> nat -> R) :
  full_column_rank p n (fun i j => sum m (fun l => k i l * a l j)) -> full_column_rank m n a.
Proof.
  intros H y Hy. apply H. intros i _. rewrite sum_product. apply sum_zero.
  intros l L. rewrite Hy by assumption. lra.
Qed.

(** ** Determinants *)

Definition skip (p i : nat) : nat := if i <? p then i else S i.

(** Expansion along the first row. *)
Fixpoint determinant (n : nat) (a : nat -> nat -> R) : R :=
  match n with
  | O => 1
  | S m => sum n (fun j => (-1) ^ j * (a O j * determinant m (fun i k => a (S i) (skip j k))))
  end.
