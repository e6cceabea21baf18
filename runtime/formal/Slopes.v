(* SPDX-License-Identifier: Apache-2.0 *)
(** The derivatives of the equations by the unknowns over the branch of a closure: bounds of their
    determinant, and of the condition number of their matrix. *)
From Coq Require Import Reals QArith Lra Lia List Arith Bool.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Intervals Forms Evaluation Boxes Hints Regularity.
From Regulus Require Import LinearAlgebra Determinants Questions Search Threshold Limits.
From Regulus Require Import SingularValues.
From Regulus Require Import Closures Tubes Parts Branches Ways Rates.
Import ListNotations.
Open Scope R_scope.

(** ** The claims *)

(** On this side of a limit. *)
Definition on_side (s : side) (limit y : R) : Prop :=
  match s with
  | Within => Rabs y < limit
  | Below => y < limit
  | Above => limit < y
  | Beyond => limit < Rabs y
  end.

(** [over P] says that P is true of the derivatives of the n equations by the unknowns,
    everywhere. *)
Definition determinant_over (over : ((nat -> nat -> R) -> Prop) -> Prop) (n : nat) (s : side)
    (limit : expression) : Prop :=
  defined [] limit /\ over (fun a => on_side s (value [] limit) (determinant n a)).

Definition branch_determinant (c : closure) :=
  determinant_over (fun P => over_branch has_slopes P c) (unknowns c).
Definition branch_determinant_along (c : list expression -> closure) pieces :=
  determinant_over (fun P => over_branch_along has_slopes P c pieces) (unknowns_along c pieces).
Definition branch_determinant_in (c : closure) (w v : parts) :=
  determinant_over (fun P => over_branch_in w v has_slopes P c) (unknowns c).
Definition branch_determinant_along_in (c : list expression -> closure) pieces ws vs :=
  determinant_over (fun P => over_branch_along_in ws vs has_slopes P c pieces)
    (unknowns_along c pieces).

(** X = a diag(f). *)
Definition with_factors (f : nat -> R) (a : nat -> nat -> R) (i j : nat) : R := a i j * f j.

Definition is_inverse (n : nat) (a b : nat -> nat -> R) : Prop :=
  forall i k, (i < n)%nat -> (k < n)%nat -> sum n (fun j => a i j * b j k) = identity i k.

(** In the maximum norm the norm of a matrix is the largest sum of the magnitudes of a row: so the
    product of the norms of X and of its inverse is less than the limit if that of any two rows
    is. *)
Definition row_sum (n : nat) (a : nat -> nat -> R) (i : nat) : R := sum n (fun j => Rabs (a i j)).
Definition condition_is_below (n : nat) (limit : R) (x : nat -> nat -> R) : Prop :=
  exists y, is_inverse n x y /\
    forall i k, (i < n)%nat -> (k < n)%nat -> row_sum n x i * row_sum n y k < limit.

Definition condition_over (over : ((nat -> nat -> R) -> Prop) -> Prop) (n : nat)
    (factors : list expression) (limit : expression) : Prop :=
  defined [] limit /\ length factors = n /\
  Forall (fun e => defined [] e /\ 0 < value [] e) factors /\
  over (fun a => condition_is_below n (value [] limit) (with_factors (value_of [] factors) a)).

Definition branch_condition (c : closure) :=
  condition_over (fun P => over_branch has_slopes P c) (unknowns c).
Definition branch_condition_along (c : list expression -> closure) pieces :=
  condition_over (fun P => over_branch_along has_slopes P c pieces) (unknowns_along c pieces).

(** The bounds of singular values and of the condition number in the 2-norm that SingularValues.v
    defines, of a diag(f). *)
Definition spectrum_over (bound : nat -> nat -> R -> (nat -> nat -> R) -> Prop)
    (over : ((nat -> nat -> R) -> Prop) -> Prop) (n : nat) (factors : list expression)
    (limit : expression) : Prop :=
  defined [] limit /\ length factors = n /\
  Forall (fun e => defined [] e /\ 0 < value [] e) factors /\
  over (fun a => bound n n (value [] limit) (with_factors (value_of [] factors) a)).

Definition branch_singular_values_above (c : closure) :=
  spectrum_over values_are_above (fun P => over_branch has_slopes P c) (unknowns c).
Definition branch_singular_values_below (c : closure) :=
  spectrum_over values_are_below (fun P => over_branch has_slopes P c) (unknowns c).
Definition branch_condition_2 (c : closure) :=
  spectrum_over ratio_is_below (fun P => over_branch has_slopes P c) (unknowns c).
Definition branch_singular_values_above_along (c : list expression -> closure) pieces :=
  spectrum_over values_are_above (fun P => over_branch_along has_slopes P c pieces)
    (unknowns_along c pieces).
Definition branch_singular_values_below_along (c : list expression -> closure) pieces :=
  spectrum_over values_are_below (fun P => over_branch_along has_slopes P c pieces)
    (unknowns_along c pieces).
Definition branch_condition_2_along (c : list expression -> closure) pieces :=
  spectrum_over ratio_is_below (fun P => over_branch_along has_slopes P c pieces)
    (unknowns_along c pieces).

(** ** The checks *)

Definition is_limit_kept (s : side) (limit : expression) (y : interval) : bool :=
  obeys s y (range_or_none (evaluate [] limit)).

Lemma is_limit_kept_correct s limit i y : is_known (evaluate [] limit) = true ->
  is_limit_kept s limit i = true -> encloses i y -> on_side s (value [] limit) y.
Proof.
  intros K H Y. destruct (evaluate [] limit) as [v|] eqn:V; [|discriminate].
  unfold is_limit_kept in H. rewrite V in H.
  pose proof (proj2 (threshold_known _ _ V)) as L. destruct s; simpl in *.
  - pose proof (is_negative_correct _ _ H
      (subtract_encloses _ _ _ _ (absolute_encloses _ _ Y) L)). lra.
  - pose proof (is_negative_correct _ _ H (subtract_encloses _ _ _ _ Y L)). lra.
  - pose proof (is_positive_correct _ _ H (subtract_encloses _ _ _ _ Y L)). lra.
  - pose proof (is_positive_correct _ _ H
      (subtract_encloses _ _ _ _ (absolute_encloses _ _ Y) L)). lra.
Qed.

(** As lists, of which Coq computes each entry once. *)
Definition as_lists (n : nat) (F : nat -> nat -> form) : forms := tabulate n n F.

Lemma as_lists_enclose t n F J :
  (forall j k, (j < n)%nat -> (k < n)%nat -> form_encloses t (F j k) (J j k)) ->
  forall j k, (j < n)%nat -> (k < n)%nat -> form_encloses t (form_at (as_lists n F) j k) (J j k).
Proof. intros E j k H K. unfold as_lists. rewrite tabulate_at by assumption. exact (E j k H K). Qed.

Definition check_determinant_over (tests : ((nat -> nat -> form) -> bool) -> bool) (n : nat)
    (s : side) (limit : expression) : bool :=
  is_known (evaluate [] limit)
  && tests (fun F => match determinant_in_box n (as_lists n F) with
                     | Some d => is_limit_kept s limit (form_range d)
                     | None => false
                     end).

Lemma check_determinant_over_correct tests over valid n s limit : shows tests over valid n n ->
  check_determinant_over tests n s limit = true -> determinant_over over n s limit.
Proof.
  unfold check_determinant_over. intros S H. apply andb_prop in H as [K H].
  split; [exact (closed_value _ K)|]. refine (S _ _ _ H). intros t F J T _ E G.
  destruct determinant_in_box as [d|] eqn:D; [|discriminate].
  apply (is_limit_kept_correct s limit (form_range d)); [exact K|exact G|].
  apply (form_range_encloses t); [exact T|].
  exact (determinant_in_box_encloses t n _ J d T (as_lists_enclose t n F J E) D).
Qed.

(** The columns of the inverse. *)
Definition inverse_forms (n : nat) (a : forms) : option (list (list form)) :=
  let k := left_inverse n n (midpoints a) in
  all_some (map (fun j => solved n k a
    (list_of n (fun i => constant_form (if Nat.eqb i j then one else zero)))) (seq 0 n)).

Lemma inverse_forms_enclose t n a A l : in_unit_box t ->
  (forall i j, (i < n)%nat -> (j < n)%nat -> form_encloses t (form_at a i j) (A i j)) ->
  full_column_rank n n A -> inverse_forms n a = Some l ->
  exists B, is_inverse n A B /\
    forall j k, (j < n)%nat -> (k < n)%nat -> form_encloses t (form_of_rates l j k) (B j k).
Proof.
  intros T E F H. unfold inverse_forms in H.
  destruct (columns_exist n A (fun i k => identity i k) n F) as [B HB].
  exists B. split; [exact HB|]. intros j k Hj Hk.
  destruct (all_some_nth _ l [] H) as [_ N]. rewrite map_size, seq_size in N.
  specialize (N k Hk).
  set (g := fun j => solved n (left_inverse n n (midpoints a)) a
    (list_of n (fun i => constant_form (if Nat.eqb i j then one else zero)))) in *.
  rewrite (nth_indep _ None (g O)) in N by (rewrite map_size, seq_size; exact Hk).
  rewrite (map_nth g), seq_nth in N by exact Hk. simpl in N.
  refine (solved_correct t n a _ A (fun i => identity i k) T E _ _ _ (fun j => B j k) N _ j Hj).
  - intros i Hi. unfold form_of_list. rewrite list_of_nth by exact Hi.
    apply constant_form_encloses. unfold identity.
    destruct (Nat.eqb i k); [exact (integer_encloses 1)|exact (integer_encloses 0)].
  - intros i Hi. exact (HB i k Hi Hk).
Qed.

(** The sums of the rows of a diag(f), and of its inverse. *)
Definition sum_of_row (n : nat) (F : nat -> nat -> form) (f : nat -> interval) (i : nat) :
    interval :=
  interval_sum n (fun j => multiply (I.abs (form_range (F i j))) (f j)).

Definition check_condition_over (tests : ((nat -> nat -> form) -> bool) -> bool) (n : nat)
    (factors : list expression) (limit : expression) : bool :=
  let f k := nth k (bounds_of_limits factors) I.nai in
  is_known (evaluate [] limit) && Nat.eqb (length factors) n
  && forallb (fun e => is_positive (range_or_none (evaluate [] e))) factors
  && tests (fun F =>
       let a := as_lists n F in
       match inverse_forms n a with
       | Some l =>
           let rows := map (sum_of_row n (form_at a) f) (seq 0 n) in
           let others := map (fun k =>
             divide (sum_of_row n (form_of_rates l) (fun _ => one) k) (f k)) (seq 0 n) in
           forallb (fun r =>
             forallb (fun u => is_limit_kept Below limit (multiply r u)) others) rows
       | None => false
       end).

Lemma sum_of_row_encloses t n F J f e i : in_unit_box t ->
  (forall j, (j < n)%nat -> form_encloses t (F i j) (J i j)) ->
  (forall j, (j < n)%nat -> encloses (f j) (e j)) ->
  encloses (sum_of_row n F f i) (sum n (fun j => Rabs (J i j) * e j)).
Proof.
  intros T E G. apply interval_sum_encloses. intros j Hj. apply multiply_encloses; [|apply G, Hj].
  apply absolute_encloses, (form_range_encloses t); [exact T|apply E, Hj].
Qed.

Lemma check_condition_over_correct tests over n factors limit :
  shows tests over (full_column_rank n n) n n ->
  check_condition_over tests n factors limit = true -> condition_over over n factors limit.
Proof.
  unfold check_condition_over. intros S H. apply andb_prop in H as [H C].
  apply andb_prop in H as [H P]. apply andb_prop in H as [K L]. apply Nat.eqb_eq in L.
  rewrite forallb_forall in P. set (f := value_of [] factors).
  assert (Fp : Forall (fun e => defined [] e /\ 0 < value [] e) factors).
  { apply Forall_forall. intros e He. apply positive_value, P, He. }
  assert (Fpos : forall k, (k < n)%nat -> 0 < f k).
  { intros k Hk. rewrite Forall_forall in Fp. apply Fp, nth_In. lia. }
  assert (Fe : forall k, (k < n)%nat -> encloses (nth k (bounds_of_limits factors) I.nai) (f k)).
  { intros k Hk. apply bound_of_limit; [lia|]. apply Forall_forall. intros e He.
    specialize (P e He). destruct (evaluate [] e); [reflexivity|discriminate]. }
  split; [exact (closed_value _ K)|]. split; [exact L|]. split; [exact Fp|].
  refine (S _ _ _ C). intros t F J T R E G. cbv zeta in G.
  pose proof (as_lists_enclose t n F J E) as A. set (a := as_lists n F) in *.
  destruct inverse_forms as [l|] eqn:V; [|discriminate].
  destruct (inverse_forms_enclose t n a J l T A R V) as (B & HB & EB).
  exists (fun j k => B j k / f j). split.
  { intros i k Hi Hk. rewrite <- (HB i k Hi Hk). apply sum_ext. intros j Hj. unfold with_factors.
    fold f. cbv beta.
    field. specialize (Fpos j Hj). lra. }
  intros i k Hi Hk. fold f. rewrite forallb_forall in G.
  match type of G with forall r, In r (map ?g _) -> _ =>
    specialize (G (g i) (in_map g _ _ (proj2 (in_seq n 0 i) ltac:(lia)))) end.
  rewrite forallb_forall in G.
  match type of G with forall u, In u (map ?g _) -> _ =>
    specialize (G (g k) (in_map g _ _ (proj2 (in_seq n 0 k) ltac:(lia)))) end.
  refine (is_limit_kept_correct Below limit _ _ K G _). apply multiply_encloses.
  - replace (row_sum n (with_factors f J) i) with (sum n (fun j => Rabs (J i j) * f j)).
    + apply (sum_of_row_encloses t); [exact T|intros j Hj; apply A; assumption|exact Fe].
    + apply sum_ext. intros j Hj. unfold with_factors. rewrite Rabs_mult. f_equal. symmetry.
      apply Rabs_pos_eq. specialize (Fpos j Hj). lra.
  - replace (row_sum n (fun j k => B j k / f j) k) with (sum n (fun j => Rabs (B k j) * 1) / f k).
    + apply divide_encloses; [specialize (Fpos k Hk); lra| |apply Fe, Hk].
      apply (sum_of_row_encloses t n _ _ _ (fun _ => 1)); [exact T| |].
      * intros j Hj. apply EB; assumption.
      * intros j _. exact (integer_encloses 1).
    + unfold row_sum, Rdiv. rewrite Rmult_comm, <- sum_scale. apply sum_ext. intros j Hj.
      rewrite Rabs_mult, (Rabs_pos_eq (/ f k)); [ring|].
      left. apply Rinv_0_lt_compat, Fpos, Hk.
Qed.

Definition check_branch_determinant c s limit m g : bool :=
  check_determinant_over (over_ranges find_slopes c m g) (unknowns c) s limit.
Definition check_branch_determinant_along c pieces s limit m gs : bool :=
  check_determinant_over (over_way find_slopes c pieces m gs) (unknowns_along c pieces) s limit.
Definition check_branch_determinant_in c w v s limit m g : bool :=
  check_determinant_over (over_parts find_slopes c w v m g) (unknowns c) s limit.
Definition check_branch_determinant_along_in c pieces ws vs s limit m gs : bool :=
  check_determinant_over (over_parts_of_way find_slopes c pieces ws vs m gs)
    (unknowns_along c pieces) s limit.
Definition check_branch_condition c factors limit m g : bool :=
  check_condition_over (over_ranges find_slopes c m g) (unknowns c) factors limit.
Definition check_branch_condition_along c pieces factors limit m gs : bool :=
  check_condition_over (over_way find_slopes c pieces m gs) (unknowns_along c pieces) factors
    limit.

Theorem check_branch_determinant_correct c s limit m g :
  check_branch_determinant c s limit m g = true -> branch_determinant c s limit.
Proof.
  exact (check_determinant_over_correct _ _ _ _ s limit
    (shown_over_ranges _ _ _ _ find_slopes_correct c m g)).
Qed.
Theorem check_branch_determinant_along_correct c pieces s limit m gs :
  check_branch_determinant_along c pieces s limit m gs = true ->
  branch_determinant_along c pieces s limit.
Proof.
  exact (check_determinant_over_correct _ _ _ _ s limit
    (shown_over_way _ _ _ _ find_slopes_correct c pieces m gs)).
Qed.
Theorem check_branch_determinant_in_correct c w v s limit m g :
  check_branch_determinant_in c w v s limit m g = true -> branch_determinant_in c w v s limit.
Proof.
  exact (check_determinant_over_correct _ _ _ _ s limit
    (shown_over_parts _ _ _ _ find_slopes_correct c w v m g)).
Qed.
Theorem check_branch_determinant_along_in_correct c pieces ws vs s limit m gs :
  check_branch_determinant_along_in c pieces ws vs s limit m gs = true ->
  branch_determinant_along_in c pieces ws vs s limit.
Proof.
  exact (check_determinant_over_correct _ _ _ _ s limit
    (shown_over_parts_of_way _ _ _ _ find_slopes_correct c pieces ws vs m gs)).
Qed.
Theorem check_branch_condition_correct c factors limit m g :
  check_branch_condition c factors limit m g = true -> branch_condition c factors limit.
Proof.
  exact (check_condition_over_correct _ _ _ factors limit
    (shown_over_ranges _ _ _ _ find_slopes_correct c m g)).
Qed.
Theorem check_branch_condition_along_correct c pieces factors limit m gs :
  check_branch_condition_along c pieces factors limit m gs = true ->
  branch_condition_along c pieces factors limit.
Proof.
  exact (check_condition_over_correct _ _ _ factors limit
    (shown_over_way _ _ _ _ find_slopes_correct c pieces m gs)).
Qed.

(** ** Singular values *)

Definition check_spectrum_over (what : spectral) (tests : ((nat -> nat -> form) -> bool) -> bool)
    (n : nat) (factors : list expression) (limit : expression) : bool :=
  let l := range_or_none (evaluate [] limit) in
  let f := bounds_of_limits factors in
  fits_bound what l && is_known (evaluate [] limit) && Nat.eqb (length factors) n
  && forallb (fun e => is_positive (range_or_none (evaluate [] e))) factors
  && tests (fun F =>
       let x := as_lists n (fun i j => scale_form (nth j f I.nai) (F i j)) in
       are_definite n (definite_forms what n n l x)).

Lemma check_spectrum_over_correct what tests over valid n factors limit :
  shows tests over valid n n -> check_spectrum_over what tests n factors limit = true ->
  spectrum_over (spectral_bound what) over n factors limit.
Proof.
  unfold check_spectrum_over. intros S H. apply andb_prop in H as [H C].
  apply andb_prop in H as [H P]. apply andb_prop in H as [H L]. apply andb_prop in H as [B K].
  apply Nat.eqb_eq in L. rewrite forallb_forall in P.
  split; [exact (closed_value _ K)|]. split; [exact L|]. split.
  { apply Forall_forall. intros e He. apply positive_value, P, He. }
  refine (S _ _ _ C). intros t F J T _ E G.
  refine (definite_forms_correct what t n n _ _ _ _ T _ _ B G).
  - apply (as_lists_enclose t n (fun i j =>
      scale_form (nth j (bounds_of_limits factors) I.nai) (F i j))).
    intros i j I J'. unfold with_factors. rewrite Rmult_comm.
    apply scale_form_encloses; [|exact (E i j I J')]. apply bound_of_limit; [lia|].
    apply Forall_forall. intros e He. specialize (P e He).
    destruct (evaluate [] e); [reflexivity|discriminate].
  - destruct (evaluate [] limit) as [v|] eqn:V; [|discriminate].
    exact (proj2 (threshold_known _ _ V)).
Qed.

Definition check_branch_spectrum what c factors limit m g : bool :=
  check_spectrum_over what (over_ranges find_slopes c m g) (unknowns c) factors limit.
Definition check_branch_spectrum_along what c pieces factors limit m gs : bool :=
  check_spectrum_over what (over_way find_slopes c pieces m gs) (unknowns_along c pieces) factors
    limit.

Lemma check_branch_spectrum_correct what c factors limit m g :
  check_branch_spectrum what c factors limit m g = true ->
  spectrum_over (spectral_bound what) (fun P => over_branch has_slopes P c) (unknowns c) factors
    limit.
Proof.
  exact (check_spectrum_over_correct what _ _ _ _ factors limit
    (shown_over_ranges _ _ _ _ find_slopes_correct c m g)).
Qed.
Lemma check_branch_spectrum_along_correct what c pieces factors limit m gs :
  check_branch_spectrum_along what c pieces factors limit m gs = true ->
  spectrum_over (spectral_bound what) (fun P => over_branch_along has_slopes P c pieces)
    (unknowns_along c pieces) factors limit.
Proof.
  exact (check_spectrum_over_correct what _ _ _ _ factors limit
    (shown_over_way _ _ _ _ find_slopes_correct c pieces m gs)).
Qed.

Definition check_branch_singular_values_above := check_branch_spectrum Values_above.
Definition check_branch_singular_values_below := check_branch_spectrum Values_below.
Definition check_branch_condition_2 := check_branch_spectrum Ratio_below.
Definition check_branch_singular_values_above_along := check_branch_spectrum_along Values_above.
Definition check_branch_singular_values_below_along := check_branch_spectrum_along Values_below.
Definition check_branch_condition_2_along := check_branch_spectrum_along Ratio_below.

Theorem check_branch_singular_values_above_correct c factors limit m g :
  check_branch_singular_values_above c factors limit m g = true ->
  branch_singular_values_above c factors limit.
Proof. exact (check_branch_spectrum_correct Values_above c factors limit m g). Qed.
Theorem check_branch_singular_values_below_correct c factors limit m g :
  check_branch_singular_values_below c factors limit m g = true ->
  branch_singular_values_below c factors limit.
Proof. exact (check_branch_spectrum_correct Values_below c factors limit m g). Qed.
Theorem check_branch_condition_2_correct c factors limit m g :
  check_branch_condition_2 c factors limit m g = true -> branch_condition_2 c factors limit.
Proof. exact (check_branch_spectrum_correct Ratio_below c factors limit m g). Qed.

Theorem check_branch_singular_values_above_along_correct c pieces factors limit m gs :
  check_branch_singular_values_above_along c pieces factors limit m gs = true ->
  branch_singular_values_above_along c pieces factors limit.
Proof. exact (check_branch_spectrum_along_correct Values_above c pieces factors limit m gs). Qed.
Theorem check_branch_singular_values_below_along_correct c pieces factors limit m gs :
  check_branch_singular_values_below_along c pieces factors limit m gs = true ->
  branch_singular_values_below_along c pieces factors limit.
Proof. exact (check_branch_spectrum_along_correct Values_below c pieces factors limit m gs). Qed.
Theorem check_branch_condition_2_along_correct c pieces factors limit m gs :
  check_branch_condition_2_along c pieces factors limit m gs = true ->
  branch_condition_2_along c pieces factors limit.
Proof. exact (check_branch_spectrum_along_correct Ratio_below c pieces factors limit m gs). Qed.
