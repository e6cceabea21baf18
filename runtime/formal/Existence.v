(* SPDX-License-Identifier: Apache-2.0 *)
(** Exactly one solution of n equations with n unknowns in a box |p i| <= r i. K is any matrix. With
    D the derivatives of F, |KD - I| <= e all over the box, and |K F(0)| <= y: if y + e r < r in
    every component, F has one zero in the box, inside of it, and D is regular all over the box. *)
From Coq Require Import Reals Lra Lia Arith.
From Coquelicot Require Import Coquelicot.
From Regulus Require Import LinearAlgebra.
Open Scope R_scope.

(** ** More unknowns than equations *)

Lemma sum_split n p f : (p < n)%nat ->
  sum n f = f p + sum n (fun j => if Nat.eqb j p then 0 else f j).
Proof.
  induction n as [|n IH]; intros P; [lia|]. simpl. destruct (Nat.eqb_spec n p) as [->|D].
  - rewrite (sum_ext p (fun j => if Nat.eqb j p then 0 else f j) f); [ring|].
    intros j J. destruct (Nat.eqb_spec j p); [lia|reflexivity].
  - rewrite IH by lia. ring.
Qed.

Lemma sum_skip m p f : (p <= m)%nat ->
  sum (S m) (fun j => if Nat.eqb j p then 0 else f j) = sum m (fun l => f (skip p l)).
Proof.
  intros P. induction m as [|m IH].
  { simpl. replace p with 0%nat by lia. simpl. ring. }
  change (sum (S m) (fun j => if Nat.eqb j p then 0 else f j)
          + (if Nat.eqb (S m) p then 0 else f (S m))
          = sum m (fun l => f (skip p l)) + f (skip p m)).
  destruct (Nat.eqb_spec (S m) p) as [<-|D].
  - rewrite Rplus_0_r. change (sum m (fun l => f (skip (S m) l)) + f (skip (S m) m))
      with (sum (S m) (fun l => f (skip (S m) l))).
    apply sum_ext. intros j J. unfold skip. destruct (Nat.eqb_spec j (S m)); [lia|].
    destruct (Nat.ltb_spec j (S m)); [reflexivity|lia].
  - rewrite IH by lia. f_equal. unfold skip. destruct (Nat.ltb_spec m p); [lia|reflexivity].
Qed.

Lemma zero_or_not n (f : nat -> R) :
  (forall j, (j < n)%nat -> f j = 0) \/ exists p, (p < n)%nat /\ f p <> 0.
Proof.
  induction n as [|n IH]; [left; lia|]. destruct IH as [Z|[p [P N]]]; [|right; eauto].
  destruct (Req_dec (f n) 0) as [E|N]; [left|right; eauto].
  intros j J. destruct (Nat.eq_dec j n) as [->|D]; [exact E|apply Z; lia].
Qed.

(** m equations with m + 1 unknowns have a solution that is not 0. *)
Lemma kernel m : forall a : nat -> nat -> R, exists y : nat -> R,
  (forall i, (i < m)%nat -> sum (S m) (fun j => a i j * y j) = 0) /\
  exists j, (j < S m)%nat /\ y j <> 0.
Proof.
  induction m as [|m IH]; intros a.
  { exists (fun _ => 1). split; [intros; lia|]. exists 0%nat. split; [lia|lra]. }
  destruct (zero_or_not (S (S m)) (a m)) as [Z|[p [P N]]].
  - destruct (IH a) as [y [Y [j [J Nj]]]].
    exists (fun j => if Nat.eqb j (S m) then 0 else y j). split.
    + intros i I. destruct (Nat.eq_dec i m) as [->|D].
      { apply sum_zero. intros l L. rewrite Z by exact L. ring. }
      change (sum (S m) (fun j => a i j * (if Nat.eqb j (S m) then 0 else y j))
              + a i (S m) * (if Nat.eqb (S m) (S m) then 0 else y (S m)) = 0).
      rewrite Nat.eqb_refl, Rmult_0_r, Rplus_0_r, <- (Y i) by lia. apply sum_ext. intros l L.
      destruct (Nat.eqb_spec l (S m)); [lia|reflexivity].
    + exists j. split; [lia|]. destruct (Nat.eqb_spec j (S m)); [lia|exact Nj].
  - (* Unknown p is eliminated with the last equation. *)
    set (b := fun i j => a i (skip p j) - a i p / a m p * a m (skip p j)).
    destruct (IH b) as [y [Y [j [J Nj]]]].
    set (back := fun l => if Nat.ltb l p then l else pred l).
    set (z := - sum (S m) (fun j => a m (skip p j) * y j) / a m p).
    set (x := fun l => if Nat.eqb l p then z else y (back l)).
    assert (S0 : forall l, skip p l <> p).
    { intros l. unfold skip. destruct (Nat.ltb_spec l p); lia. }
    assert (B : forall l, x (skip p l) = y l).
    { intros l. unfold x. destruct (Nat.eqb_spec (skip p l) p); [elim (S0 l e)|]. f_equal.
      unfold back, skip. destruct (Nat.ltb_spec l p) as [L|L].
      - destruct (Nat.ltb_spec l p); lia.
      - destruct (Nat.ltb_spec (S l) p); lia. }
    assert (X : forall i, sum (S (S m)) (fun l => a i l * x l)
                = a i p * z + sum (S m) (fun l => a i (skip p l) * y l)).
    { intros i. rewrite (sum_split _ p) by exact P. f_equal.
      - unfold x. rewrite Nat.eqb_refl. reflexivity.
      - rewrite (sum_skip (S m) p (fun l => a i l * x l)) by lia. apply sum_ext. intros l L.
        rewrite B. reflexivity. }
    exists x. split.
    + intros i I. rewrite X. destruct (Nat.eq_dec i m) as [->|D].
      { unfold z. field. exact N. }
      specialize (Y i ltac:(lia)). unfold b in Y.
      rewrite (sum_ext (S m) _ (fun j => a i (skip p j) * y j
        + (- (a i p / a m p)) * (a m (skip p j) * y j))) in Y by (intros; ring).
      rewrite sum_plus, sum_scale in Y. unfold z.
      set (s := sum (S m) (fun j => a m (skip p j) * y j)) in *.
      replace (sum (S m) (fun l => a i (skip p l) * y l)) with (a i p / a m p * s) by lra.
      field. exact N.
    + exists (skip p j). split; [unfold skip; destruct (Nat.ltb_spec j p); lia|].
      rewrite B. exact Nj.
Qed.

(** If KA is regular, then K z = 0 for z = 0 alone. *)
Lemma left_factor_regular n (k a : nat -> nat -> R) z :
  full_column_rank n n (fun i j => sum n (fun l => k i l * a l j)) ->
  (forall i, (i < n)%nat -> sum n (fun l => k i l * z l) = 0) ->
  forall i, (i < n)%nat -> z i = 0.
Proof.
  intros H Z.
  destruct (kernel n (fun i j => if Nat.eqb j n then z i else a i j)) as [y [Y [j [J N]]]].
  assert (Y' : forall i, (i < n)%nat -> sum n (fun j => a i j * y j) + z i * y n = 0).
  { intros i I. specialize (Y i I). simpl in Y. rewrite Nat.eqb_refl in Y. rewrite <- Y. f_equal.
    apply sum_ext. intros l L. destruct (Nat.eqb_spec l n); [lia|reflexivity]. }
  assert (K0 : forall l, (l < n)%nat -> y l = 0).
  { apply H. intros i I. rewrite sum_product.
    rewrite (sum_ext n _ (fun l => (- y n) * (k i l * z l))).
    - rewrite sum_scale, Z by exact I. ring.
    - intros l L. specialize (Y' l L).
      replace (sum n (fun j => a l j * y j)) with (- (z l * y n)) by lra. ring. }
  assert (yn : y n <> 0).
  { destruct (Nat.eq_dec j n) as [<-|D]; [exact N|]. elim N. apply K0. lia. }
  intros i I. specialize (Y' i I). rewrite (sum_zero n) in Y' by (intros; rewrite K0; [ring|lia]).
  apply (Rmult_eq_reg_r (y n)); [lra|exact yn].
Qed.

(** ** One coordinate after the other *)

Definition update (p : nat -> R) (j : nat) (s : R) : nat -> R :=
  fun i => if Nat.eqb i j then s else p i.

Section OneSolution.
  Variables (n : nat) (F : (nat -> R) -> nat -> R) (D : (nat -> R) -> nat -> nat -> R).
  Variables (K e : nat -> nat -> R) (r y : nat -> R).

  Definition inside (p : nat -> R) : Prop := forall i, (i < n)%nat -> Rabs (p i) <= r i.

  Definition image (p : nat -> R) (i : nat) : R := sum n (fun l => K i l * F p l).
  (** Its fixed points are the zeros of F. *)
  Definition step (p : nat -> R) (i : nat) : R := p i - image p i.

  Hypothesis F_ext : forall p q i, (forall j, (j < n)%nat -> p j = q j) -> (i < n)%nat ->
    F p i = F q i.
  Hypothesis partial : forall p i j, inside p -> (i < n)%nat -> (j < n)%nat ->
    is_derive (fun s => F (update p j s) i) (p j) (D p i j).
  Hypothesis r_positive : forall i, (i < n)%nat -> 0 < r i.
  Hypothesis spread : forall p i j, inside p -> (i < n)%nat -> (j < n)%nat ->
    Rabs (sum n (fun l => K i l * D p l j) - identity i j) <= e i j.
  Hypothesis contracts : forall i, (i < n)%nat -> sum n (fun j => e i j * r j) < r i.

  Let origin : nat -> R := fun _ => 0.

  Lemma origin_inside : inside origin.
  Proof. intros i I. unfold origin. rewrite Rabs_R0. specialize (r_positive i I). lra. Qed.

  Lemma e_nonnegative i j : (i < n)%nat -> (j < n)%nat -> 0 <= e i j.
  Proof.
    intros I J. pose proof (spread origin i j origin_inside I J).
    pose proof (Rabs_pos (sum n (fun l => K i l * D origin l j) - identity i j)). lra.
  Qed.

  Theorem regular_inside p : inside p -> full_column_rank n n (D p).
  Proof.
    intros P. apply (full_rank_of_product n n n K).
    set (E := fun i j => sum n (fun l => K i l * D p l j) - identity i j).
    intros v V. refine (dominated n E r r_positive _ v _).
    - intros i I. eapply Rle_lt_trans; [|apply contracts, I]. apply sum_le. intros j J.
      apply Rmult_le_compat_r; [left; auto|]. apply spread; assumption.
    - intros i I. rewrite <- (V i I). apply sum_ext. intros j J. unfold E. ring.
  Qed.

  Lemma no_image p : inside p -> (forall i, (i < n)%nat -> image p i = 0) ->
    forall i, (i < n)%nat -> F p i = 0.
  Proof.
    intros P Z. apply (left_factor_regular n K (D p)); [|exact Z].
    set (E := fun i j => sum n (fun l => K i l * D p l j) - identity i j).
    intros v V. refine (dominated n E r r_positive _ v _).
    - intros i I. eapply Rle_lt_trans; [|apply contracts, I]. apply sum_le. intros j J.
      apply Rmult_le_compat_r; [left; auto|]. apply spread; assumption.
    - intros i I. rewrite <- (V i I). apply sum_ext. intros j J. unfold E. ring.
  Qed.

  Lemma image_derive p i j : inside p -> (i < n)%nat -> (j < n)%nat ->
    is_derive (fun s => image (update p j s) i) (p j) (sum n (fun l => K i l * D p l j)).
  Proof.
    intros P I J. unfold image.
    assert (H : forall m, (m <= n)%nat ->
      is_derive (fun s => sum m (fun l => K i l * F (update p j s) l)) (p j)
        (sum m (fun l => K i l * D p l j))).
    { induction m as [|m IH]; intros M; simpl; [apply @is_derive_const|].
      apply @is_derive_plus; [apply IH; lia|]. apply is_derive_scal. apply partial; [exact
        P|lia|exact J]. }
    apply H. lia.
  Qed.

  Lemma step_ext p q i : (forall j, (j < n)%nat -> p j = q j) -> (i < n)%nat ->
    step p i = step q i.
  Proof.
    intros H I. unfold step, image. rewrite (H i I). f_equal. apply sum_ext. intros l L.
    f_equal. apply F_ext; assumption.
  Qed.

  (** p and q differ in coordinate j alone. *)
  Lemma one_coordinate p j s i : inside p -> (i < n)%nat -> (j < n)%nat -> Rabs s <= r j ->
    Rabs (step (update p j s) i - step p i) <= e i j * Rabs (s - p j).
  Proof.
    intros P I J Sr.
    set (h := fun t => step (update p j t) i).
    assert (Pt : forall t, Rmin (p j) s <= t <= Rmax (p j) s -> inside (update p j t)).
    { intros t T k Kn. unfold update. destruct (Nat.eqb_spec k j) as [->|]; [|auto].
      specialize (P j J). apply Rabs_le_between in P, Sr. apply Rabs_le.
      unfold Rmin, Rmax in T. destruct Rle_dec; lra. }
    set (dh := fun t => identity i j - sum n (fun l => K i l * D (update p j t) l j)).
    assert (Dh : forall t, Rmin (p j) s <= t <= Rmax (p j) s -> is_derive h t (dh t)).
    { intros t T. unfold h, step, dh. apply @is_derive_minus.
      - unfold update, identity. rewrite (Nat.eqb_sym i j).
        destruct (Nat.eqb j i) eqn:E; [apply @is_derive_id|apply @is_derive_const].
      - pose proof (image_derive (update p j t) i j (Pt t T) I J) as H.
        replace (update p j t j) with t in H by (unfold update; rewrite Nat.eqb_refl; reflexivity).
        eapply is_derive_ext; [|exact H]. intros u. apply sum_ext. intros l L. f_equal.
        apply F_ext; [|exact L]. intros k _. unfold update. destruct (Nat.eqb k j); reflexivity. }
    destruct (MVT_gen h (p j) s dh) as [c [C E]].
    { intros t T. apply Dh. lra. }
    { intros t T. apply derivable_continuous_pt. exists (dh t). apply is_derive_Reals, Dh, T. }
    replace (step p i) with (h (p j)).
    2: { apply step_ext; [|exact I]. intros k _. unfold update.
         destruct (Nat.eqb_spec k j) as [->|]; reflexivity. }
    change (step (update p j s) i) with (h s). rewrite E, Rabs_mult.
    apply Rmult_le_compat_r; [apply Rabs_pos|]. unfold dh. rewrite Rabs_minus_sym.
    apply spread; auto.
  Qed.

  Lemma step_contracts p q i : inside p -> inside q -> (i < n)%nat ->
    Rabs (step p i - step q i) <= sum n (fun j => e i j * Rabs (p j - q j)).
  Proof.
    intros P Q I. set (mixed := fun m j => if Nat.ltb j m then p j else q j).
    assert (M : forall m, inside (mixed m)).
    { intros m j J. unfold mixed. destruct (Nat.ltb j m); auto. }
    assert (Sx : forall a b, (forall j, (j < n)%nat -> a j = b j) -> step a i = step b i).
    { intros a b H. apply step_ext; assumption. }
    assert (H : forall m, (m <= n)%nat ->
      Rabs (step (mixed m) i - step q i) <= sum m (fun j => e i j * Rabs (p j - q j))).
    { induction m as [|m IH]; intros L.
      - simpl. rewrite (Sx (mixed 0%nat) q) by (intros; reflexivity).
        unfold Rminus. rewrite Rplus_opp_r, Rabs_R0. lra.
      - simpl. replace (step (mixed (S m)) i - step q i)
          with ((step (mixed m) i - step q i) + (step (mixed (S m)) i - step (mixed m) i)) by ring.
        eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat; [apply IH; lia|].
        rewrite (Sx (mixed (S m)) (update (mixed m) m (p m))).
        + assert (Qm : mixed m m = q m).
          { unfold mixed. destruct (Nat.ltb_spec m m); [lia|reflexivity]. }
          rewrite <- Qm. apply one_coordinate; [apply M|exact I|lia|apply P; lia].
        + intros j _. unfold mixed, update. destruct (Nat.eqb_spec j m) as [->|N].
          * destruct (Nat.ltb_spec m (S m)); [reflexivity|lia].
          * destruct (Nat.ltb_spec j (S m)), (Nat.ltb_spec j m); try reflexivity; lia. }
    rewrite (Sx p (mixed n)); [apply H; lia|]. intros j J. unfold mixed.
    destruct (Nat.ltb_spec j n); [reflexivity|lia].
  Qed.

  (** A point is as near to a solution as its image is small. *)
  Theorem near_solution p q c : inside p -> inside q ->
    (forall i, (i < n)%nat -> F p i = 0) ->
    (forall i, (i < n)%nat -> Rabs (image q i) <= c * (r i - sum n (fun j => e i j * r j))) ->
    forall i, (i < n)%nat -> Rabs (p i - q i) <= c * r i.
  Proof.
    intros P Q Z C i I.
    destruct (largest n (fun i => Rabs (p i - q i) / r i)) as [k [Kn M]]; [lia|]. simpl in M.
    set (m := Rabs (p k - q k) / r k) in *.
    assert (B : forall j, (j < n)%nat -> Rabs (p j - q j) <= m * r j).
    { intros j J. specialize (M j J). pose proof (r_positive j J).
      apply (Rmult_le_compat_r (r j)) in M; [|lra].
      unfold Rdiv in M at 1. rewrite Rmult_assoc, Rinv_l in M by lra. lra. }
    assert (Ek : Rabs (p k - q k) = m * r k).
    { unfold m, Rdiv. pose proof (r_positive k Kn). field. lra. }
    assert (Zk : image p k = 0).
    { unfold image. apply sum_zero. intros l L. rewrite Z by exact L. ring. }
    assert (T : Rabs (p k - q k) <= m * sum n (fun j => e k j * r j)
                + c * (r k - sum n (fun j => e k j * r j))).
    { replace (p k - q k) with ((step p k - step q k) + - image q k)
        by (unfold step; rewrite Zk; ring).
      eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat.
      - eapply Rle_trans; [apply step_contracts; assumption|]. rewrite <- sum_scale.
        apply sum_le. intros j J. replace (m * (e k j * r j)) with (e k j * (m * r j)) by ring.
        apply Rmult_le_compat_l; [apply e_nonnegative; assumption|apply B, J].
      - rewrite Rabs_Ropp. apply C, Kn. }
    pose proof (contracts k Kn) as Ck.
    assert (m <= c).
    { apply Rnot_lt_le. intros L. rewrite Ek in T.
      assert (c * (r k - sum n (fun j => e k j * r j))
              < m * (r k - sum n (fun j => e k j * r j))) by (apply Rmult_lt_compat_r; lra). lra. }
    eapply Rle_trans; [apply B, I|]. apply Rmult_le_compat_r; [left; auto|assumption].
  Qed.

  Theorem at_most_one p q : inside p -> inside q ->
    (forall i, (i < n)%nat -> F p i = 0) -> (forall i, (i < n)%nat -> F q i = 0) ->
    forall i, (i < n)%nat -> p i = q i.
  Proof.
    intros P Q Zp Zq i I.
    assert (H : Rabs (p i - q i) <= 0 * r i).
    { apply near_solution; try assumption. intros k Kn. unfold image. rewrite sum_zero.
      - rewrite Rabs_R0. lra.
      - intros l L. rewrite Zq by exact L. ring. }
    rewrite Rmult_0_l in H. pose proof (Rabs_pos (p i - q i)).
    destruct (Req_dec (p i - q i) 0) as [|N]; [lra|]. pose proof (Rabs_pos_lt _ N). lra.
  Qed.

  (** ** Existence *)

  Hypothesis offset : forall i, (i < n)%nat -> Rabs (image origin i) <= y i.
  Hypothesis into : forall i, (i < n)%nat -> y i + sum n (fun j => e i j * r j) < r i.

  Lemma step_into p i : inside p -> (i < n)%nat ->
    Rabs (step p i) <= y i + sum n (fun j => e i j * r j).
  Proof.
    intros P I. replace (step p i) with (step origin i + (step p i - step origin i)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat.
    - unfold step. unfold origin at 1. rewrite Rminus_0_l, Rabs_Ropp. apply offset, I.
    - eapply Rle_trans; [apply step_contracts; [exact P|apply origin_inside|exact I]|].
      apply sum_le. intros j J. apply Rmult_le_compat_l; [apply e_nonnegative; assumption|].
      unfold origin. rewrite Rminus_0_r. apply P, J.
  Qed.

  Fixpoint iterate (m : nat) : nat -> R :=
    match m with O => fun _ => 0 | S k => step (iterate k) end.

  Lemma iterate_inside m : inside (iterate m).
  Proof.
    induction m as [|m IH]; [apply origin_inside|]. intros i I. simpl.
    pose proof (step_into _ i IH I). pose proof (into i I). lra.
  Qed.

  Definition solution (i : nat) : R := real (Lim_seq (fun m => iterate m i)).

  Lemma factor : exists q, 0 <= q < 1 /\
    forall i, (i < n)%nat -> sum n (fun j => e i j * r j) <= q * r i.
  Proof.
    destruct (Nat.eq_dec n 0) as [N|N]; [exists 0; split; [lra|lia]|].
    destruct (largest n (fun i => sum n (fun j => e i j * r j) / r i)) as [k [Kn M]]; [lia|].
    simpl in M. exists (sum n (fun j => e k j * r j) / r k). pose proof (r_positive k Kn) as Rk.
    assert (0 <= sum n (fun j => e k j * r j)).
    { replace 0 with (sum n (fun _ => 0)) by (apply sum_zero; reflexivity).
      apply sum_le. intros j J. apply Rmult_le_pos; [apply e_nonnegative; assumption|left; auto]. }
    split; [split|].
    - apply Rmult_le_pos; [assumption|left; apply Rinv_0_lt_compat; exact Rk].
    - apply (Rmult_lt_reg_r (r k)); [exact Rk|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. pose proof (contracts k Kn). lra.
    - intros i I. specialize (M i I). pose proof (r_positive i I).
      apply (Rmult_le_compat_r (r i)) in M; [|lra].
      unfold Rdiv in M at 1. rewrite Rmult_assoc, Rinv_l in M by lra. lra.
  Qed.

  Lemma iterate_step q m : 0 <= q ->
    (forall i, (i < n)%nat -> sum n (fun j => e i j * r j) <= q * r i) ->
    forall i, (i < n)%nat -> Rabs (iterate (S m) i - iterate m i) <= q ^ m * r i.
  Proof.
    intros Q H. induction m as [|m IH]; intros i I.
    - simpl. rewrite Rminus_0_r, Rmult_1_l. exact (iterate_inside 1 i I).
    - change (Rabs (step (iterate (S m)) i - step (iterate m) i) <= q ^ S m * r i).
      eapply Rle_trans; [apply step_contracts; try exact I; apply iterate_inside|].
      apply Rle_trans with (q ^ m * sum n (fun j => e i j * r j)).
      + rewrite <- sum_scale. apply sum_le. intros j J.
        replace (q ^ m * (e i j * r j)) with (e i j * (q ^ m * r j)) by ring.
        apply Rmult_le_compat_l; [apply e_nonnegative; assumption|apply IH, J].
      + simpl. replace (q * q ^ m * r i) with (q ^ m * (q * r i)) by ring.
        apply Rmult_le_compat_l; [apply pow_le, Q|apply H, I].
  Qed.

  Lemma iterate_converges i : (i < n)%nat -> is_lim_seq (fun m => iterate m i) (solution i).
  Proof.
    intros I. destruct factor as [q [[Q0 Q1] H]].
    assert (X : ex_series (fun m => iterate (S m) i - iterate m i)).
    { apply (ex_series_le (K := R_AbsRing) (V := R_CompleteNormedModule) _ (fun m => q ^ m * r i)).
      - intros m. apply (iterate_step q m Q0 H i I).
      - apply ex_series_scal_r. exists (/ (1 - q)). apply is_series_geom.
        rewrite Rabs_pos_eq; lra. }
    destruct X as [l L].
    assert (C : is_lim_seq (fun m => iterate (S m) i) l).
    { apply is_lim_seq_ext with (sum_n (fun m => iterate (S m) i - iterate m i)); [|exact L].
      induction n0 as [|m IH]; [rewrite sum_O; simpl; ring|].
      rewrite sum_Sn, IH. unfold plus. simpl. ring. }
    apply (is_lim_seq_incr_1 (fun m => iterate m i)) in C. unfold solution. rewrite
      (is_lim_seq_unique _ _ C). exact C.
  Qed.

  Lemma solution_strict i : (i < n)%nat ->
    Rabs (solution i) <= y i + sum n (fun j => e i j * r j).
  Proof.
    intros I. assert (C := iterate_converges i I). apply (is_lim_seq_incr_1 (fun m => iterate m
      i)), is_lim_seq_abs in C.
    simpl in C.
    apply (is_lim_seq_le (fun m => Rabs (step (iterate m) i))
             (fun _ => y i + sum n (fun j => e i j * r j)) (Rabs (solution i))
             (y i + sum n (fun j => e i j * r j))); [|exact C|apply is_lim_seq_const].
    intros m. apply step_into; [apply iterate_inside|exact I].
  Qed.

  Theorem solution_inside : inside solution.
  Proof. intros i I. pose proof (solution_strict i I). pose proof (into i I). lra. Qed.

  Lemma sum_limit (u : nat -> nat -> R) m :
    (forall j, (j < m)%nat -> is_lim_seq (u j) 0) -> is_lim_seq (fun k => sum m (fun j => u j k)) 0.
  Proof.
    induction m as [|m IH]; intros H; simpl; [apply is_lim_seq_const|].
    replace 0 with (0 + 0) by ring. apply (is_lim_seq_plus' (fun k => sum m (fun j => u j k)) (u
      m));
      [apply IH; auto|apply H; lia].
  Qed.

  Theorem solution_solves i : (i < n)%nat -> F solution i = 0.
  Proof.
    revert i. apply no_image; [apply solution_inside|]. intros i I.
    enough (Z : Rabs (solution i - step solution i) <= 0).
    { unfold step in Z. replace (solution i - (solution i - image solution i))
        with (image solution i) in Z by ring. pose proof (Rabs_pos (image solution i)).
      destruct (Req_dec (image solution i) 0) as [|N]; [assumption|].
      pose proof (Rabs_pos_lt _ N). lra. }
    assert (to_zero : forall j, (j < n)%nat ->
              is_lim_seq (fun m => Rabs (solution j - iterate m j)) 0).
    { intros j J. replace (Finite 0) with (Rbar_abs (solution j - solution j)).
      - apply is_lim_seq_abs. apply is_lim_seq_minus'; [apply is_lim_seq_const|].
        apply iterate_converges, J.
      - simpl. f_equal. rewrite Rminus_eq_0. apply Rabs_R0. }
    apply (is_lim_seq_le (fun _ => Rabs (solution i - step solution i))
      (fun m => Rabs (solution i - iterate (S m) i)
                + sum n (fun j => e i j * Rabs (solution j - iterate m j)))
      (Rabs (solution i - step solution i)) 0); [|apply is_lim_seq_const|].
    - intros m. replace (solution i - step solution i)
        with ((solution i - iterate (S m) i) + - (step solution i - step (iterate m) i))
        by (simpl; ring).
      eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat_l. rewrite Rabs_Ropp.
      apply step_contracts; [apply solution_inside|apply iterate_inside|exact I].
    - replace 0 with (0 + 0) by ring. apply is_lim_seq_plus'.
      + apply (is_lim_seq_incr_1 (fun m => Rabs (solution i - iterate m i))), to_zero, I.
      + apply (sum_limit (fun j m => e i j * Rabs (solution j - iterate m j))). intros j J.
        replace (Finite 0) with (Rbar_mult (e i j) 0) by (simpl; f_equal; ring).
        apply is_lim_seq_scal_l, to_zero, J.
  Qed.

  (** The theorem: exactly one solution in the box, and the derivatives are regular there. *)
  Theorem exactly_one :
    (exists p, inside p /\ (forall i, (i < n)%nat -> F p i = 0) /\
       forall q, inside q -> (forall i, (i < n)%nat -> F q i = 0) ->
         forall i, (i < n)%nat -> q i = p i) /\
    forall p, inside p -> full_column_rank n n (D p).
  Proof.
    split; [|exact regular_inside]. exists solution.
    split; [exact solution_inside|]. split; [exact solution_solves|].
    intros q Q Z. apply at_most_one; auto using solution_inside, solution_solves.
  Qed.
End OneSolution.
