(* SPDX-License-Identifier: Apache-2.0 *)
(** Intervals of doubles with outward rounding: those of coq-interval, for real numbers. *)
From Coq Require Import Reals QArith Qreals Lra Lia List.
From Interval Require Import Real.Xreal Missing.Stdlib.
From Interval Require Import Interval.Interval Interval.Float_full.
From Interval Require Import Float.Primitive_ops Float.Basic.
From Regulus Require Hints.
From Regulus Require Import LinearAlgebra.
Import ListNotations.
Open Scope R_scope.

Module F := PrimitiveFloat.
Module I := FloatIntervalFull F.

Notation interval := I.type.
Definition precision := F.PtoP 53.

(** The interval contains the number. *)
Definition encloses (i : interval) (r : R) : Prop := contains (I.convert i) (Xreal r).

Definition add := I.add precision.
Definition subtract := I.sub precision.
Definition multiply := I.mul precision.
Definition divide := I.div precision.
Definition square := I.sqr precision.
Definition integer := I.fromZ precision.
Definition point (x : F.type) : interval := I.singleton x.
Definition real_of (x : F.type) : R := proj_val (F.toX x).
Definition rational (q : Q) : interval :=
  match Qden q with
  | xH => integer (Qnum q)
  | d => divide (integer (Qnum q)) (integer (Zpos d))
  end.
Definition zero : interval := integer 0.
Definition one : interval := integer 1.
Definition unit_interval : interval := I.join (integer 0) (integer 1).
Definition symmetric : interval := I.join (integer (-1)) (integer 1).

Lemma add_encloses i j x y : encloses i x -> encloses j y -> encloses (add i j) (x + y).
Proof. exact (I.add_correct precision i j (Xreal x) (Xreal y)). Qed.

Lemma subtract_encloses i j x y : encloses i x -> encloses j y -> encloses (subtract i j) (x - y).
Proof. exact (I.sub_correct precision i j (Xreal x) (Xreal y)). Qed.

Lemma multiply_encloses i j x y : encloses i x -> encloses j y -> encloses (multiply i j) (x * y).
Proof. exact (I.mul_correct precision i j (Xreal x) (Xreal y)). Qed.

Lemma square_encloses i x : encloses i x -> encloses (square i) (x * x).
Proof. exact (I.sqr_correct precision i (Xreal x)). Qed.

Lemma negate_encloses i x : encloses i x -> encloses (I.neg i) (- x).
Proof. exact (I.neg_correct i (Xreal x)). Qed.

Lemma absolute_encloses i x : encloses i x -> encloses (I.abs i) (Rabs x).
Proof. exact (I.abs_correct i (Xreal x)). Qed.

Lemma integer_encloses n : encloses (integer n) (IZR n).
Proof. exact (I.fromZ_correct precision n). Qed.

Lemma point_encloses x : encloses (point x) (real_of x).
Proof. exact (I.singleton_correct x). Qed.

Lemma divide_encloses i j x y :
  y <> 0 -> encloses i x -> encloses j y -> encloses (divide i j) (x / y).
Proof.
  intros N X Y. pose proof (I.div_correct precision i j (Xreal x) (Xreal y) X Y) as H.
  unfold encloses, divide. simpl in H. unfold Xdiv' in H.
  destruct (is_zero_spec y); [contradiction|exact H].
Qed.

Lemma rational_encloses q : encloses (rational q) (Q2R q).
Proof.
  assert (D : encloses (divide (integer (Qnum q)) (integer (Zpos (Qden q)))) (Q2R q)).
  { apply divide_encloses; try apply integer_encloses. apply not_0_IZR. discriminate. }
  unfold rational. destruct q as [n [d|d|]]; try exact D.
  unfold Q2R. simpl. rewrite Rinv_1, Rmult_1_r. apply integer_encloses.
Qed.

Lemma meet_encloses i j x : encloses i x -> encloses j x -> encloses (I.meet i j) x.
Proof. exact (I.meet_correct i j (Xreal x)). Qed.

Lemma join_encloses i j x : encloses i x \/ encloses j x -> encloses (I.join i j) x.
Proof. exact (I.join_correct i j (Xreal x)). Qed.

Lemma between_enclosed i x y z : encloses i x -> encloses i y -> x <= z <= y -> encloses i z.
Proof. intros X Y Z. exact (contains_connected (I.convert i) x y X Y z Z). Qed.

Lemma unit_interval_encloses x : 0 <= x <= 1 -> encloses unit_interval x.
Proof.
  apply between_enclosed; apply join_encloses; [left|right];
    [exact (integer_encloses 0)|exact (integer_encloses 1)].
Qed.

Lemma symmetric_encloses x : Rabs x <= 1 -> encloses symmetric x.
Proof.
  intros H. assert (B : -1 <= x <= 1) by (unfold Rabs in H; destruct Rcase_abs; lra).
  revert B.
  apply between_enclosed; apply join_encloses; [left|right];
    [exact (integer_encloses (-1))|exact (integer_encloses 1)].
Qed.

(** ** Signs *)

Definition is_positive (i : interval) : bool :=
  match I.sign_strict i with Xgt => true | _ => false end.
Definition is_negative (i : interval) : bool :=
  match I.sign_strict i with Xlt => true | _ => false end.
Definition is_not_zero (i : interval) : bool := is_positive i || is_negative i.
Definition is_not_negative (i : interval) : bool :=
  match I.sign_large i with Xgt | Xeq => true | _ => false end.
Definition is_not_positive (i : interval) : bool :=
  match I.sign_large i with Xlt | Xeq => true | _ => false end.

Lemma is_positive_correct i x : is_positive i = true -> encloses i x -> 0 < x.
Proof.
  unfold is_positive. generalize (I.sign_strict_correct i).
  destruct I.sign_strict; try discriminate. intros H _ X. exact (proj2 (H _ X)).
Qed.

Lemma is_negative_correct i x : is_negative i = true -> encloses i x -> x < 0.
Proof.
  unfold is_negative. generalize (I.sign_strict_correct i).
  destruct I.sign_strict; try discriminate. intros H _ X. exact (proj2 (H _ X)).
Qed.

Lemma is_not_zero_correct i x : is_not_zero i = true -> encloses i x -> x <> 0.
Proof.
  intros H X. apply Bool.orb_prop in H as [H|H].
  - pose proof (is_positive_correct i x H X). lra.
  - pose proof (is_negative_correct i x H X). lra.
Qed.

Lemma is_not_negative_correct i x : is_not_negative i = true -> encloses i x -> 0 <= x.
Proof.
  unfold is_not_negative. generalize (I.sign_large_correct i).
  destruct I.sign_large; try discriminate; intros H _ X.
  - injection (H _ X) as ->. lra.
  - exact (proj2 (H _ X)).
Qed.

Lemma is_not_positive_correct i x : is_not_positive i = true -> encloses i x -> x <= 0.
Proof.
  unfold is_not_positive. generalize (I.sign_large_correct i).
  destruct I.sign_large; try discriminate; intros H _ X.
  - injection (H _ X) as ->. lra.
  - exact (proj2 (H _ X)).
Qed.

(** ** Functions *)

Lemma pi_encloses : encloses (I.pi precision) PI.
Proof. exact (I.pi_correct precision). Qed.

Lemma cos_encloses i x : encloses i x -> encloses (I.cos precision i) (cos x).
Proof. exact (I.cos_correct precision i (Xreal x)). Qed.

(** Of a number next to a half turn [I.sin] says that it is between -1 and 1, and near one it
    loses half of the digits. Then the cosine of the complement is better. *)
Definition sine (i : interval) : interval :=
  let width j := PrimFloat.sub (I.upper j) (I.lower j) in
  let s := I.sin precision i in
  let twice := PrimFloat.add (width i) (width i) in
  if PrimFloat.ltb (width s) (PrimFloat.add twice Hints.width_of_rounding) then s
  else I.meet s (I.cos precision (subtract (divide (I.pi precision) (integer 2)) i)).

Lemma sin_encloses i x : encloses i x -> encloses (sine i) (sin x).
Proof.
  intros X. assert (S : encloses (I.sin precision i) (sin x))
    by exact (I.sin_correct precision i (Xreal x) X).
  unfold sine. destruct PrimFloat.ltb; [exact S|].
  apply (I.meet_correct _ _ (Xreal (sin x)) S). rewrite <- (cos_shift x).
  apply cos_encloses, subtract_encloses; [|exact X].
  apply divide_encloses; [lra|exact pi_encloses|exact (integer_encloses 2)].
Qed.

Lemma atan_encloses i x : encloses i x -> encloses (I.atan precision i) (atan x).
Proof. exact (I.atan_correct precision i (Xreal x)). Qed.

Lemma exp_encloses i x : encloses i x -> encloses (I.exp precision i) (exp x).
Proof. exact (I.exp_correct precision i (Xreal x)). Qed.

Lemma sqrt_encloses i x : encloses i x -> encloses (I.sqrt precision i) (sqrt x).
Proof. exact (I.sqrt_correct precision i (Xreal x)). Qed.

Lemma log_encloses i x : 0 < x -> encloses i x -> encloses (I.ln precision i) (ln x).
Proof.
  intros P X. pose proof (I.ln_correct precision i (Xreal x) X) as H.
  simpl in H. unfold Xln' in H. destruct (is_positive_spec x); [exact H|lra].
Qed.

Lemma power_encloses n i x :
  encloses i x -> encloses (I.power_int precision i (Z.of_nat n)) (x ^ n).
Proof.
  intros X. pose proof (I.power_int_correct precision (Z.of_nat n) i (Xreal x) X) as H.
  unfold encloses. replace (Xreal (x ^ n)) with (Xpower_int (Xreal x) (Z.of_nat n)); [exact H|].
  destruct n; [reflexivity|]. simpl. f_equal. rewrite SuccNat2Pos.id_succ. reflexivity.
Qed.

(** ** Sums *)

Fixpoint interval_sum (n : nat) (f : nat -> interval) : interval :=
  match n with O => zero | S k => add (interval_sum k f) (f k) end.

Lemma interval_sum_encloses n f g :
  (forall i, (i < n)%nat -> encloses (f i) (g i)) -> encloses (interval_sum n f) (sum n g).
Proof.
  induction n; intros H; simpl; [exact (integer_encloses 0)|].
  apply add_encloses; [apply IHn; intros; apply H; lia|apply H; lia].
Qed.

Lemma unknown_encloses x : encloses I.nai x.
Proof. unfold encloses. rewrite I.nai_correct. exact Logic.I. Qed.
