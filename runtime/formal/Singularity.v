(* SPDX-License-Identifier: Apache-2.0 *)
(** SINGULARITY: a segment in the set, at whose ends the determinant has opposite signs. *)
From Coq Require Import Reals Ranalysis5 Lra Lia List PArith Bool.
From Coq Require PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Questions LinearAlgebra Intervals Forms Evaluation Boxes.
From Regulus Require Import Hints Regularity Search Continuity.
Import ListNotations.
Open Scope R_scope.

(** Doubles, a coordinate for each variable. *)
Definition coordinates := list F.type.

Definition along (a b : coordinates) (s : R) : list R :=
  map (fun u => real_of (fst u) + s * (real_of (snd u) - real_of (fst u))) (combine a b).

Definition hull (a b : coordinates) : box :=
  map (fun u => I.join (point (fst u)) (point (snd u))) (combine a b).

Definition method_of_segment : method := Method 99 0.

Definition is_in_range (i : interval) (ends : expression * expression) : bool :=
  match evaluate [] (fst ends), evaluate [] (snd ends) with
  | Some l, Some u =>
      I.subset i (I.upper_complement (range l)) && I.subset i (I.lower_complement (range u))
  | _, _ => false
  end.

Definition is_satisfied (names : list (option enclosure)) (c : expression) : bool :=
  match evaluate names c with Some v => is_not_positive (range v) | None => false end.

Fixpoint determinant_range (n : nat) (a : nat -> nat -> interval) : interval :=
  match n with
  | O => one
  | S m => interval_sum n (fun j => multiply (integer ((-1) ^ Z.of_nat j))
             (multiply (a O j) (determinant_range m (fun i k => a (S i) (skip j k)))))
  end.

Definition range_of (v : option enclosure) : interval :=
  match v with Some w => range w | None => I.nai end.

(** The determinant at a point. *)
Definition determinant_at (q : question) (b : box) : interval :=
  let names := evaluate_definitions (variables 99 b) (definitions q) in
  let a := map (map (fun e => range_of (evaluate names e))) (matrix q) in
  determinant_range (columns q) (fun i j => nth j (nth i a []) I.nai).

(** Each row has an entry for each column. *)
Definition in_set_and_known (q : question) (b : box) : bool :=
  let names := evaluate_definitions (variables 99 b) (definitions q) in
  let a := map (map (evaluate names)) (matrix q) in
  Nat.eqb (length b) (length (ranges q)) &&
  forallb (fun u => is_in_range (fst u) (snd u)) (combine b (ranges q)) &&
  forallb (is_satisfied names) (constraints q) &&
  forallb is_known names && forallb (fun e => is_known (evaluate names e)) (also_defined q) &&
  forallb (forallb is_known) a &&
  forallb (fun r => Nat.eqb (length r) (columns q)) (matrix q).

Definition in_set_and_defined (q : question) (b : box) : bool :=
  in_set_and_known q b && Nat.eqb (rows q) (columns q).

Definition check_segment (q : question) (a b : coordinates) : bool :=
  Nat.eqb (length a) (length b) && in_set_and_defined q (hull a b) &&
  is_negative (determinant_at q (hull a a)) && is_positive (determinant_at q (hull b b)).

(** The points of a certificate are so close that the sign is not certain in doubles. Their distance
    is made larger, 2^k times, for several k. *)
Definition moved (a b : coordinates) (c : PrimFloat.float) : coordinates :=
  map (fun u => PrimFloat.add (fst u) (PrimFloat.mul c (PrimFloat.sub (fst u) (snd u))))
    (combine a b).

Definition powers_of_two (n : nat) : list PrimFloat.float :=
  let two := PrimFloat.add PrimFloat.one PrimFloat.one in
  PrimFloat.zero :: map (fun k => Nat.iter k (PrimFloat.mul two) PrimFloat.one) (seq 0 n).

(** The nearest doubles that are certainly within the range. *)
Definition clamp (x : F.type) (ends : expression * expression) : F.type :=
  let l := I.upper (range_of (evaluate [] (fst ends))) in
  let u := I.lower (range_of (evaluate [] (snd ends))) in
  if PrimFloat.ltb x l then l else if PrimFloat.ltb u x then u else x.

Definition candidate (q : question) (a b : coordinates) (c : PrimFloat.float) : coordinates :=
  map (fun u => clamp (fst u) (snd u)) (combine (moved a b c) (ranges q)).

Definition check_either (q : question) (a b : coordinates) : bool :=
  if check_segment q a b then true else check_segment q b a.

Definition check_singularity (q : question) (a b : coordinates) : bool :=
  existsb (fun c => check_either q (candidate q a b c) (candidate q b a c)) (powers_of_two 50).

(** ** It is correct *)

Lemma hull_contains a b s : 0 <= s <= 1 -> in_box (hull a b) (along a b s).
Proof.
  intros H. split; [unfold hull, along; rewrite !map_size; reflexivity|].
  intros k. unfold hull, along. revert k.
  induction (combine a b) as [|[x y] l IH]; intros [|k]; simpl; try apply unknown_encloses;
    [|apply IH].
  assert (X : encloses (I.join (point x) (point y)) (real_of x)).
  { apply join_encloses. left. apply point_encloses. }
  assert (Y : encloses (I.join (point x) (point y)) (real_of y)).
  { apply join_encloses. right. apply point_encloses. }
  destruct (Rle_dec (real_of x) (real_of y)).
  - apply (between_enclosed _ _ _ _ X Y). nra.
  - apply (between_enclosed _ _ _ _ Y X). nra.
Qed.

Lemma determinant_range_encloses n : forall i a,
  (forall j k, (j < n)%nat -> (k < n)%nat -> encloses (i j k) (a j k)) ->
  encloses (determinant_range n i) (determinant n a).
Proof.
  induction n as [|n IH]; intros i a H; [exact (integer_encloses 1)|].
  change (determinant (S n) a) with (sum (S n) (fun j => (-1) ^ j *
    (a O j * determinant n (fun i k => a (S i) (skip j k))))).
  change (determinant_range (S n) i) with (interval_sum (S n) (fun j =>
    multiply (integer ((-1) ^ Z.of_nat j))
      (multiply (i O j) (determinant_range n (fun h k => i (S h) (skip j k)))))).
  apply interval_sum_encloses. intros j J. apply multiply_encloses.
  - replace ((-1) ^ j) with (IZR ((-1) ^ Z.of_nat j)); [apply integer_encloses|].
    rewrite <- (pow_IZR (-1) j). reflexivity.
  - apply multiply_encloses; [apply H; lia|]. apply IH. intros h k P Q. apply H; [lia|].
    unfold skip. destruct (k <? j)%nat; lia.
Qed.

Lemma determinant_at_encloses q b x : in_box b x -> rows q = columns q ->
  forallb (fun r => Nat.eqb (length r) (columns q)) (matrix q) = true ->
  encloses (determinant_at q b)
    (determinant (columns q) (entry q (extend x (definitions q)))).
Proof.
  intros B E S. apply determinant_range_encloses. intros i j P Q. unfold entry.
  set (vs := evaluate_definitions (variables 99 b) (definitions q)).
  rewrite forallb_forall in S. rewrite <- E in P.
  set (r := nth i (matrix q) []).
  assert (L : length r = columns q) by (apply Nat.eqb_eq, S, nth_In, P).
  rewrite (nth_indep _ [] (map (fun e => range_of (evaluate vs e)) []))
    by (rewrite map_size; exact P).
  rewrite (map_nth (map (fun e => range_of (evaluate vs e)))). fold r.
  rewrite (nth_indep _ _ (range_of (evaluate vs no_entry))) by (rewrite map_size, L; exact Q).
  rewrite (map_nth (fun e => range_of (evaluate vs e))).
  destruct (evaluate vs (nth j r no_entry)) as [v|] eqn:V; [|apply unknown_encloses].
  pose proof (coordinate_in_unit_box b x B) as T.
  apply (evaluate_correct _ vs _ _ v T
    (known_definitions _ _ _ _ T (variables_known 99 b x B)) V).
Qed.

Lemma is_in_range_correct i e x : is_in_range i e = true -> encloses i x -> in_range x e.
Proof.
  unfold is_in_range, in_range. intros H X.
  assert (K : known (fun _ => 0) [] []).
  { split; [reflexivity|]. intros k v. destruct k; discriminate. }
  assert (T : in_unit_box (fun _ => 0)) by (intros k; rewrite Rabs_R0; lra).
  destruct (evaluate [] (fst e)) as [l|] eqn:L; [|discriminate].
  destruct (evaluate [] (snd e)) as [u|] eqn:U; [|discriminate].
  apply (evaluate_correct _ _ _ _ _ T K) in L as [_ [L _]].
  apply (evaluate_correct _ _ _ _ _ T K) in U as [_ [U _]].
  apply andb_prop in H as [A B]. split.
  - exact (I.upper_complement_correct _ _ _ L (I.subset_correct _ _ _ X A)).
  - exact (I.lower_complement_correct _ _ _ U (I.subset_correct _ _ _ X B)).
Qed.

Lemma in_ranges b l x : length b = length l ->
  forallb (fun u => is_in_range (fst u) (snd u)) (combine b l) = true ->
  in_box b x -> Forall2 in_range x l.
Proof.
  revert l x. induction b as [|i b IH]; intros [|e l] x L F [N B]; try discriminate.
  - destruct x; [constructor|discriminate].
  - destruct x as [|y x]; [discriminate|]. simpl in F. apply andb_prop in F as [F1 F2].
    constructor; [exact (is_in_range_correct i e y F1 (B O))|].
    apply IH; [injection L; auto|exact F2|]. split; [injection N; auto|].
    intros k. exact (B (S k)).
Qed.

Lemma in_set_and_known_correct q b x : in_box b x -> in_set_and_known q b = true ->
  in_set q x /\ model_defined q x.
Proof.
  unfold in_set_and_known. intros B H.
  repeat match goal with H : _ && _ = true |- _ => apply andb_prop in H as [H ?] end.
  split.
  - split; [eapply in_ranges; eauto; apply Nat.eqb_eq; assumption|].
    intros c C names _.
    match goal with H : forallb (is_satisfied _) _ = true |- _ =>
      rewrite forallb_forall in H; specialize (H c C); unfold is_satisfied in H end.
    destruct evaluate as [v|] eqn:V; [|discriminate].
    pose proof (coordinate_in_unit_box b x B) as T.
    eapply is_not_positive_correct; [eassumption|].
    apply (evaluate_correct _ _ _ _ v T
      (known_definitions _ _ _ _ T (variables_known 99 b x B)) V).
  - apply (everything_defined q method_of_segment b x B); assumption.
Qed.

Lemma in_set_and_defined_correct q b x : in_box b x -> in_set_and_defined q b = true ->
  in_set q x /\ model_defined q x.
Proof. intros B H. apply andb_prop in H as [H _]. exact (in_set_and_known_correct q b x B H). Qed.

Lemma has_square_matrix q b : in_set_and_defined q b = true -> rows q = columns q /\
  forallb (fun r => Nat.eqb (length r) (columns q)) (matrix q) = true.
Proof.
  intros H. apply andb_prop in H as [H S]. apply andb_prop in H as [_ L].
  split; [apply Nat.eqb_eq, S|exact L].
Qed.

Lemma along_continuous a b s : continuous_names (along a b) s.
Proof.
  intros k. unfold along. revert k.
  induction (combine a b) as [|u l IH]; intros [|k]; simpl; try apply continuous_constant;
    [|apply IH].
  apply (continuity_pt_plus (fun _ => real_of (fst u))); [apply continuous_constant|].
  apply (continuity_pt_mult (fun t => t)); [apply derivable_continuous_pt,
    derivable_pt_id|apply continuous_constant].
Qed.

Lemma along_length a b s t : length (along a b s) = length (along a b t).
Proof. unfold along. rewrite !map_size. reflexivity. Qed.

Lemma entry_defined q names i j : Forall (Forall (defined names)) (matrix q) ->
  defined names (nth j (nth i (matrix q) []) no_entry).
Proof.
  intros F. rewrite Forall_forall in F.
  destruct (Nat.lt_ge_cases i (length (matrix q))) as [P|P].
  - specialize (F _ (nth_In _ [] P)). rewrite Forall_forall in F.
    destruct (Nat.lt_ge_cases j (length (nth i (matrix q) []))) as [Q|Q].
    + apply F, nth_In, Q.
    + rewrite nth_overflow by exact Q. exact Logic.I.
  - rewrite (nth_overflow (matrix q)) by exact P. destruct j; exact Logic.I.
Qed.

Lemma along_ends a b : length a = length b ->
  along a b 0 = along a a 0 /\ along a b 1 = along b b 0.
Proof.
  unfold along. revert b. induction a as [|x a IH]; intros [|y b] L; try discriminate.
  - split; reflexivity.
  - injection L as L. destruct (IH b L) as [P Q]. simpl. rewrite P, Q.
    split; f_equal; ring.
Qed.

Theorem check_segment_correct q a b : check_segment q a b = true -> singularity q.
Proof.
  unfold check_segment. intros H. apply andb_prop in H as [H D].
  apply andb_prop in H as [H C]. apply andb_prop in H as [L H]. apply Nat.eqb_eq in L.
  set (f := fun s => determinant (columns q) (entry q (extend (along a b s) (definitions q)))).
  assert (M : forall s, 0 <= s <= 1 -> in_set q (along a b s) /\ model_defined q (along a b s)).
  { intros s S. eapply in_set_and_defined_correct; [|exact H]. apply hull_contains, S. }
  assert (E : rows q = columns q /\
              forallb (fun r => Nat.eqb (length r) (columns q)) (matrix q) = true).
  { exact (has_square_matrix q _ H). }
  destruct E as [E1 E2]. destruct (along_ends a b L) as [P Q].
  assert (F0 : f 0 < 0).
  { unfold f. rewrite P. eapply is_negative_correct; [exact C|].
    apply determinant_at_encloses; [apply hull_contains; lra|exact E1|exact E2]. }
  assert (F1 : 0 < f 1).
  { unfold f. rewrite Q. eapply is_positive_correct; [exact D|].
    apply determinant_at_encloses; [apply hull_contains; lra|exact E1|exact E2]. }
  assert (K : forall s, 0 <= s <= 1 -> continuity_pt f s).
  { intros s S. destruct (M s S) as [_ [D1 [_ D2]]].
    apply (determinant_continuous (columns q)
      (fun s => entry q (extend (along a b s) (definitions q)))).
    intros i j _ _. apply value_continuous; [|apply entry_defined, D2].
    apply extend_continuous; [apply along_continuous| |exact D1]. intros. apply along_length. }
  destruct (IVT_interv f 0 1 K ltac:(lra) F0 F1) as [s [S Z]].
  exists (along a b s). destruct (M s S). auto.
Qed.

(** If the check answers true, then some point of the set is singular. *)
Theorem check_singularity_correct q a b : check_singularity q a b = true -> singularity q.
Proof.
  intros H. apply existsb_exists in H as [c [_ H]]. unfold check_either in H.
  destruct check_segment eqn:S; [exact (check_segment_correct _ _ _ S)|].
  exact (check_segment_correct _ _ _ H).
Qed.
