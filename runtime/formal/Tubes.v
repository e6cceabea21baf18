(* SPDX-License-Identifier: Apache-2.0 *)
(** The test of a tube: over a box of places x, the unknowns are p = c + S (x - x0) + u, |u| <= r.
    With K the inverse of the derivatives at the middle, KF(0) and KD - I are bounded over the tube,
    and the theorem of Existence.v is applied at each x. *)
From Coquelicot Require Import Coquelicot.
From Coq Require Import Reals QArith Qreals Lra Lia List PArith Bool.
From Coq Require PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Intervals Forms Evaluation Boxes Hints Regularity.
From Regulus Require Import Continuity Existence Derivatives LinearAlgebra Questions Search
  Closures.
Import ListNotations.
Open Scope R_scope.

Record tube := Tube {
  foot : list F.type;           (** x0 *)
  axis_at : list F.type;        (** c *)
  tilt : list (list F.type);    (** S *)
  reach : list F.type           (** r *) }.

Definition number (l : list F.type) (i : nat) : F.type := nth i l F.nan.

Definition axis (t : tube) (x : list R) (i : nat) : R :=
  real_of (number (axis_at t) i)
  + sum (length x) (fun j => real_of (get (tilt t) i j) * (nth j x 0 - real_of (number (foot t)
    j))).

(** The unknowns beside the axis. *)
Definition beside (n : nat) (t : tube) (x : list R) (u : nat -> R) : list R :=
  map (fun i => axis t x i + u i) (seq 0 n).

Definition in_tube (n : nat) (t : tube) (x p : list R) : Prop :=
  length p = n /\ forall i, (i < n)%nat -> Rabs (nth i p 0 - axis t x i) <= real_of (number (reach
    t) i).

(** ** Enclosures *)

Definition axis_form (t : tube) (vs : list (option enclosure)) (m i : nat) : form :=
  add_forms (constant_form (point (number (axis_at t) i)))
    (form_sum m (fun j => scale_form (point (get (tilt t) i j))
       (subtract_forms (form_of (nth j vs None)) (constant_form (point (number (foot t) j)))))).

Definition of_form (f : form) : option enclosure := Some (Enclosure (form_range f) f).

(** All names, where u encloses the distances from the axis. *)
Definition tube_names (c : closure) (t : tube) (vs : list (option enclosure)) (m : nat)
    (u : nat -> form) : list (option enclosure) :=
  evaluate_definitions
    (evaluate_definitions vs (definitions (places c))
     ++ map (fun i => of_form (add_forms (axis_form t vs m i) (u i))) (seq 0 (unknowns c)))
    (further c).

Lemma form_of_encloses t vs names k : known t vs names ->
  form_encloses t (form_of (nth k vs None)) (nth k names 0).
Proof.
  intros [_ K]. destruct (nth k vs None) as [v|] eqn:E; simpl; [apply (K k v E)|].
  apply constant_form_encloses, unknown_encloses.
Qed.

Lemma axis_form_encloses s t vs x i : known s vs x ->
  form_encloses s (axis_form t vs (length x) i) (axis t x i).
Proof.
  intros K. apply add_forms_enclose; [apply constant_form_encloses, point_encloses|].
  apply form_sum_encloses. intros j _. apply scale_form_encloses; [apply point_encloses|].
  apply subtract_forms_enclose; [apply form_of_encloses, K|].
  apply constant_form_encloses, point_encloses.
Qed.

Lemma known_map s n (f : nat -> form) (g : nat -> R) vs names : in_unit_box s -> known s vs names ->
  (forall i, (i < n)%nat -> form_encloses s (f i) (g i)) ->
  known s (vs ++ map (fun i => of_form (f i)) (seq 0 n)) (names ++ map g (seq 0 n)).
Proof.
  intros T K H. induction n as [|n IH]; [simpl; rewrite !app_nil_r; exact K|].
  rewrite seq_S, !map_app, !app_assoc. simpl. apply known_append; [apply IH; auto|].
  intros w [= <-]. split; [apply (form_range_encloses s); [exact T|]|]; apply H; lia.
Qed.

Lemma known_left s vs ws x y : length vs = length x -> known s (vs ++ ws) (x ++ y) -> known s vs x.
Proof.
  intros L [_ H]. split; [exact L|]. intros k v E.
  destruct (Nat.lt_ge_cases k (length vs)) as [K|K].
  - specialize (H k v). rewrite !app_nth1 in H by lia. apply H, E.
  - rewrite nth_overflow in E by exact K. discriminate.
Qed.

Lemma tube_names_known c s t vs x u g : in_unit_box s -> known s vs x ->
  (forall i, (i < unknowns c)%nat -> form_encloses s (u i) (g i)) ->
  known s (tube_names c t vs (length x) u) (names_at c x (beside (unknowns c) t x g)).
Proof.
  intros T K U. unfold tube_names, names_at, beside. apply known_definitions; [exact T|].
  apply (known_map s _ (fun i => add_forms (axis_form t vs (length x) i) (u i))); [exact T| |].
  - apply known_definitions; assumption.
  - intros i I. apply add_forms_enclose; [apply axis_form_encloses, K|apply U, I].
Qed.

(** ** The derivatives of the equations by unknown j, with m variables *)

Section Partial.
  Variables (c : closure) (m : nat).
  Definition before : nat := (m + length (definitions (places c)))%nat.
  Definition all_names : nat := (before + unknowns c + length (further c))%nat.
  Definition first_moving (j : nat) : list bool :=
    repeat false before ++ map (Nat.eqb j) (seq 0 (unknowns c)).
  Definition first_slopes (j : nat) : list Q :=
    repeat (0 # 1) before
    ++ map (fun i => if Nat.eqb j i then 1 # 1 else 0 # 1) (seq 0 (unknowns c)).
  Definition slope_definitions (j : nat) : list expression :=
    map Constant (first_slopes j) ++ slopes all_names (first_moving j) (further c).
  Definition partial_expressions (j : nat) : list expression :=
    let moving := moving_names all_names (first_moving j) (further c) in
    map (fun e => slope_or_zero (slope all_names moving e)) (equations c).
End Partial.

(** Column by column. *)
Definition partial_at (c : closure) (x p : list R) (i j : nat) : R :=
  value (extend (names_at c x p) (slope_definitions c (length x) j))
    (nth i (partial_expressions c (length x) j) no_entry).

Lemma put_length j s l : length (put j s l) = length l.
Proof. revert j. induction l; intros [|j]; simpl; auto. Qed.

Lemma put_nth j s l k : nth k (put j s l) 0 =
  if Nat.eqb k j then (if Nat.ltb j (length l) then s else 0) else nth k l 0.
Proof.
  revert j k. induction l; intros j k; simpl.
  - destruct j, k; simpl; try reflexivity; destruct (Nat.eqb _ _); reflexivity.
  - destruct j, k; simpl; auto; rewrite IHl; reflexivity.
Qed.

(** ** The test *)

(** The next double, because differences are rounded. *)
Definition bound_of (i : interval) : F.type := PrimFloat.next_up (I.upper i).
Definition is_bounded (i : interval) : bool := is_not_negative (subtract (point (bound_of i)) i).

Lemma bound_of_correct i x : is_bounded i = true -> encloses i x -> x <= real_of (bound_of i).
Proof.
  unfold is_bounded. intros B X.
  pose proof (is_not_negative_correct _ _ B (subtract_encloses _ _ _ _ (point_encloses _) X)). lra.
Qed.

Definition around (r : F.type) : interval := I.join (I.neg (point r)) (point r).

Lemma around_encloses r u : Rabs u <= real_of r -> encloses (around r) u.
Proof.
  intros H. apply Rabs_le_between in H. revert H.
  apply between_enclosed; apply join_encloses; [left; apply negate_encloses|right];
    apply point_encloses.
Qed.

Definition tube_box (c : closure) (t : tube) (b : box) : box :=
  b ++ map (fun i => around (number (reach t) i)) (seq 0 (unknowns c)).

Record tube_bounds := TubeBounds {
  inverse : list (list F.type);       (** K *)
  spreads : list (list interval);     (** of |KD - I| *)
  offsets : list interval             (** of |KF(0)| *) }.

Definition at_ (l : list (list interval)) (i j : nat) : interval := nth j (nth i l []) I.nai.

(** How far the configuration is from the axis, at most. *)
Definition departure (n : nat) (t : tube) (v : tube_bounds) (i : nat) : interval :=
  add (point (bound_of (nth i (offsets v) I.nai)))
    (interval_sum n (fun j => multiply (point (bound_of (at_ (spreads v) i j)))
                                (point (number (reach t) j)))).

Definition departures (n : nat) (t : tube) (v : tube_bounds) : list interval :=
  map (departure n t v) (seq 0 n).

(** How far it is from the next point of Newton's method: no farther than its distances from the
    axis times the spreads. *)
Definition rest_of (n : nat) (v : tube_bounds) (d : list interval) (i : nat) : interval :=
  interval_sum n (fun j => multiply (point (bound_of (at_ (spreads v) i j))) (nth j d I.nai)).

(** The equations on the axis, and the next point of Newton's method from it. *)
Definition residuals (c : closure) (full : nat) (t : tube) (b : box) : list form :=
  let middle := tube_names c t (variables full b) (length b) (fun _ => constant_form zero) in
  map (fun e => form_of (evaluate middle e)) (equations c).

Definition newton_form (n full : nat) (t : tube) (b : box) (v : tube_bounds) (f : list form)
    (i : nat) : form :=
  subtract_forms (axis_form t (variables full b) (length b) i)
    (form_sum n (fun l => scale_form (point (get (inverse v) i l))
                            (nth l f (constant_form I.nai)))).

Definition entries (c : closure) (m : nat) (names : list (option enclosure)) : list (list (option
  enclosure)) :=
  map (fun j => let names' := evaluate_definitions names (slope_definitions c m j) in
                if forallb is_known names' then map (evaluate names') (partial_expressions c m j)
                else [])
    (seq 0 (unknowns c)).

Definition bounds_of (c : closure) (full : nat) (t : tube) (b : box) : option tube_bounds :=
  let m := length b in
  let n := unknowns c in
  let vs := variables full (tube_box c t b) in
  let places_only := firstn m vs in
  let base := evaluate_definitions places_only (definitions (places c)) in
  let names := tube_names c t places_only m (fun i => form_of (nth (m + i) vs None)) in
  let columns := entries c m names in
  if forallb is_known names
     && forallb (fun e => is_known (evaluate base e)) (also_defined (places c))
     && forallb (fun e => is_known (evaluate names e)) (equations c)
     && forallb (fun e => is_known (evaluate names e)) (also c)
     && forallb (fun l => forallb is_known l && Nat.eqb (length l) n) columns
     && Nat.eqb (length (equations c)) n
  then
    let a := tabulate n n (fun i j => form_of (nth i (nth j columns []) None)) in
    let k := left_inverse n n (midpoints a) in
    let e := product_error n n k a in
    let middle := tube_names c t (variables full b) m (fun _ => constant_form zero) in
    let f := map (fun e => form_of (evaluate middle e)) (equations c) in
    Some (TubeBounds k
      (map (map (fun f => I.abs (form_range f))) e)
      (map (fun i => I.abs (form_range (form_sum n (fun l =>
               scale_form (point (get k i l)) (nth l f (constant_form I.nai)))))) (seq 0 n)))
  else None.

Definition holds_tube (n : nat) (t : tube) (v : tube_bounds) : bool :=
  forallb (fun i =>
    is_positive (point (number (reach t) i))
    && is_bounded (nth i (offsets v) I.nai)
    && forallb (fun j => is_bounded (at_ (spreads v) i j)) (seq 0 n)
    && is_negative (subtract (departure n t v i) (point (number (reach t) i)))) (seq 0 n).

Definition test_tube (c : closure) (full : nat) (t : tube) (b : box) : option tube_bounds :=
  match bounds_of c full t b with
  | Some v => if holds_tube (unknowns c) t v then Some v else None
  | None => None
  end.

(** ** Why it is right *)

Lemma all_defined_app ds : forall names later,
  all_defined names (ds ++ later) <-> all_defined names ds /\ all_defined (extend names ds) later.
Proof.
  induction ds as [|d ds IH]; intros names later; simpl; [tauto|]. rewrite IH. tauto.
Qed.

Lemma form_of_value s vs names e : in_unit_box s -> known s vs names ->
  form_encloses s (form_of (evaluate vs e)) (value names e).
Proof.
  intros T K. destruct (evaluate vs e) as [w|] eqn:E; simpl.
  - apply (evaluate_correct s vs names e w T K E).
  - apply constant_form_encloses, unknown_encloses.
Qed.

Lemma known_defined s vs names e : in_unit_box s -> known s vs names ->
  is_known (evaluate vs e) = true -> defined names e.
Proof.
  intros T K. destruct (evaluate vs e) as [w|] eqn:E; [|discriminate]. intros _.
  apply (evaluate_correct s vs names e w T K E).
Qed.

Lemma known_all_defined s vs names es : in_unit_box s -> known s vs names ->
  forallb (fun e => is_known (evaluate vs e)) es = true -> Forall (defined names) es.
Proof.
  intros T K H. rewrite forallb_forall in H. apply Forall_forall. intros e E.
  eapply known_defined; [exact T|exact K|apply H, E].
Qed.

Lemma slope_or_zero_value A o : value A (slope_or_zero o) = slope_value A o.
Proof. destruct o; [reflexivity|]. simpl. unfold Q2R. simpl. ring. Qed.

Lemma slope_or_zero_defined A o : defined A (slope_or_zero o) -> slope_defined A o.
Proof. destruct o; simpl; tauto. Qed.

Lemma beside_nth n t x u i : (i < n)%nat -> nth i (beside n t x u) 0 = axis t x i + u i.
Proof.
  intros I. unfold beside. rewrite (nth_indep _ 0 (axis t x 0 + u 0%nat))
    by (rewrite map_size, seq_size; exact I).
  rewrite (map_nth (fun i => axis t x i + u i)), seq_nth by exact I. reflexivity.
Qed.

Lemma beside_length n t x u : length (beside n t x u) = n.
Proof. unfold beside. rewrite map_size, seq_size. reflexivity. Qed.

Lemma beside_ext n t x u w : (forall i, (i < n)%nat -> u i = w i) -> beside n t x u = beside n t x
  w.
Proof.
  intros H. apply map_ext_in. intros i I. apply in_seq in I. rewrite H by lia. reflexivity.
Qed.

Lemma list_equal (a b : list R) : length a = length b ->
  (forall i, (i < length a)%nat -> nth i a 0 = nth i b 0) -> a = b.
Proof. intros L H. apply (nth_ext a b 0 0 L H). Qed.

Lemma beside_of n t x p : length p = n -> beside n t x (fun i => nth i p 0 - axis t x i) = p.
Proof.
  intros L. apply list_equal; [rewrite beside_length; auto|]. rewrite beside_length. intros i I.
  rewrite beside_nth by exact I. ring.
Qed.

Section Partial_derivative.
  Variables (c : closure) (t : tube) (x : list R) (u : nat -> R).
  Let n := unknowns c.
  Let m := length x.
  Let base := extend x (definitions (places c)).
  Let names := names_at c x (beside n t x u).
  Hypothesis has_all : length (equations c) = n.
  Hypothesis further_defined : all_defined (base ++ beside n t x u) (further c).
  Hypothesis equations_defined : Forall (defined names) (equations c).

  Lemma partial_is_derivative i j : (i < n)%nat -> (j < n)%nat ->
    all_defined names (slope_definitions c m j) ->
    defined (extend names (slope_definitions c m j)) (nth i (partial_expressions c m j) no_entry) ->
    is_derive (fun s => equation_at c x (beside n t x (update u j s)) i) (u j)
      (partial_at c x (beside n t x u) i j).
  Proof.
    intros I J D De.
    assert (Lb : length base = before c m) by (unfold base; rewrite extend_length; reflexivity).
    assert (Ln : length names = all_names c m).
    { unfold names, names_at. rewrite extend_length, app_size, beside_length. fold base.
      rewrite Lb. reflexivity. }
    set (curve := fun s => base ++ beside n t x (update u j s)).
    assert (U : beside n t x (update u j (u j)) = beside n t x u).
    { apply beside_ext. intros k _. unfold update. destruct (Nat.eqb_spec k j) as [->|];
      reflexivity. }
    set (w := map Q2R (first_slopes c m j)).
    assert (Lw : length w = (before c m + n)%nat).
    { unfold w, first_slopes. rewrite map_size, app_size, repeat_length, map_size, seq_size.
      reflexivity. }
    assert (moving_at : forall k, nth k (first_moving c m j) false
                        = (Nat.leb (before c m) k && Nat.eqb j (k - before c m))%bool).
    { intros k. unfold first_moving. destruct (Nat.leb_spec (before c m) k) as [K|K].
      - rewrite app_nth2; rewrite repeat_length; [|exact K]. simpl.
        destruct (Nat.lt_ge_cases (k - before c m) n) as [Q|Q].
        + rewrite (nth_indep _ false (Nat.eqb j 0)) by (rewrite map_size, seq_size; exact Q).
          rewrite (map_nth (Nat.eqb j)), seq_nth by exact Q. reflexivity.
        + rewrite nth_overflow by (rewrite map_size, seq_size; exact Q).
          symmetry. apply Nat.eqb_neq. lia.
      - rewrite app_nth1 by (rewrite repeat_length; exact K). apply nth_repeat. }
    assert (C : on_curve curve (u j) (first_moving c m j) w).
    { split.
      - intros s. unfold curve. rewrite app_size, beside_length, Lw, Lb. reflexivity.
      - unfold first_moving. rewrite Lw, app_size, repeat_length, map_size, seq_size.
        reflexivity.
      - intros k K. rewrite moving_at in K. apply andb_prop in K as [K1 K2].
        apply Nat.leb_le in K1. apply Nat.eqb_eq in K2.
        replace k with (before c m + j)%nat by lia.
        apply (is_derive_ext (fun s => axis t x j + s)).
        { intros s. unfold curve. rewrite app_nth2 by lia. rewrite Lb.
          replace (before c m + j - before c m)%nat with j by lia.
          rewrite beside_nth by exact J. unfold update. rewrite Nat.eqb_refl. reflexivity. }
        replace (nth (before c m + j) w 0) with 1.
        { auto_derive; [exact Logic.I|ring]. }
        unfold w, first_slopes. rewrite map_app, app_nth2; rewrite map_size, repeat_length;
          [|lia].
        replace (before c m + j - before c m)%nat with j by lia. rewrite map_map.
        rewrite (nth_indep _ 0 (Q2R (if Nat.eqb j 0 then 1 # 1 else 0 # 1)))
          by (rewrite map_size, seq_size; exact J).
        rewrite (map_nth (fun i => Q2R (if Nat.eqb j i then 1 # 1 else 0 # 1))), seq_nth by exact J.
        simpl. rewrite Nat.eqb_refl. unfold Q2R. simpl. field.
      - intros k K s. rewrite moving_at in K. unfold curve.
        destruct (Nat.lt_ge_cases k (before c m)) as [Q|Q].
        { rewrite !app_nth1 by lia. reflexivity. }
        rewrite !app_nth2 by lia. rewrite Lb.
        destruct (Nat.leb_spec (before c m) k); [|lia]. simpl in K. apply Nat.eqb_neq in K.
        destruct (Nat.lt_ge_cases (k - before c m) n) as [P|P].
        + rewrite !beside_nth by exact P. unfold update.
          destruct (Nat.eqb_spec (k - before c m) j); [lia|reflexivity].
        + rewrite !nth_overflow by (rewrite beside_length; exact P). reflexivity. }
    unfold slope_definitions in D, De. apply all_defined_app in D as [_ D].
    rewrite extend_constants in D. rewrite extend_app, extend_constants in De. fold w in D, De.
    rewrite <- Ln in D, De.
    assert (EL : names = extend (curve (u j)) (further c)).
    { unfold names, names_at, curve. rewrite U. reflexivity. }
    destruct (slopes_correct (further c) curve (u j) _ w names [] C) as [w' [E C']].
    { rewrite app_nil_r. exact EL. }
    { unfold curve. rewrite U. exact further_defined. }
    { exact D. }
    rewrite E in De.
    unfold partial_at, slope_definitions. fold n. fold names. fold m.
    rewrite extend_app, extend_constants. fold w. rewrite <- Ln, E.
    unfold partial_expressions in De |- *.
    rewrite <- Ln in De |- *.
    set (mv := moving_names (length names) (first_moving c m j) (further c)) in *.
    set (eq := nth i (equations c) no_entry).
    assert (Ei : nth i (map (fun e => slope_or_zero (slope (length names) mv e)) (equations c))
      no_entry
                 = slope_or_zero (slope (length names) mv eq)).
    { rewrite (nth_indep _ no_entry (slope_or_zero (slope (length names) mv no_entry)))
        by (rewrite map_size, has_all; exact I).
      rewrite (map_nth (fun e => slope_or_zero (slope (length names) mv e))). reflexivity. }
    rewrite Ei in De |- *. rewrite slope_or_zero_value. apply slope_or_zero_defined in De.
    change (is_derive (fun s => value (extend (curve s) (further c)) eq) (u j)
              (slope_value (names ++ w') (slope (length names) mv eq))).
    apply (slope_correct (length names) mv (fun s => extend (curve s) (further c))).
    - intros k K. rewrite <- EL in *. apply app_nth1, K.
    - intros k K. rewrite app_nth2 by lia. replace (length names + k - length names)%nat with k by
      lia.
      apply C', K.
    - apply C'.
    - rewrite <- EL. rewrite Forall_forall in equations_defined. apply equations_defined, nth_In.
      rewrite has_all. exact I.
    - exact De.
  Qed.
End Partial_derivative.

(** A place of the box, and the tube over it. *)
Section At_place.
  Variables (c : closure) (full : nat) (t : tube) (b : box) (v : tube_bounds) (x : list R).
  Hypothesis tested : test_tube c full t b = Some v.
  Hypothesis B : in_box b x.
  Let n := unknowns c.

  Definition reach_of (i : nat) : R := real_of (number (reach t) i).
  Definition spread_of (i j : nat) : R := real_of (bound_of (at_ (spreads v) i j)).
  Definition offset_of (i : nat) : R := real_of (bound_of (nth i (offsets v) I.nai)).
  Definition inverse_of_middle (i l : nat) : R := real_of (get (inverse v) i l).
  Definition error_at (u : nat -> R) (i : nat) : R := equation_at c x (beside n t x u) i.
  Definition slopes_at (u : nat -> R) : nat -> nat -> R := partial_at c x (beside n t x u).

  Let m := length b.
  Let vs := variables full (tube_box c t b).

  Lemma size_of_place : length x = m.
  Proof. unfold m. symmetry. apply B. Qed.

  Lemma in_tube_box u : inside n reach_of u ->
    in_box (tube_box c t b) (x ++ map u (seq 0 n)).
  Proof.
    intros U. unfold tube_box. split.
    - rewrite !app_size, !map_size, !seq_size. f_equal. apply B.
    - intros k. pose proof size_of_place as S. unfold m in S.
      destruct (Nat.lt_ge_cases k (length b)) as [K|K].
      + rewrite !app_nth1 by lia. apply B.
      + rewrite !app_nth2 by lia. rewrite S. fold n. set (i := (k - length b)%nat).
        destruct (Nat.lt_ge_cases i n) as [I|I].
        * rewrite (nth_indep _ I.nai (around (number (reach t) 0)))
            by (rewrite map_size, seq_size; exact I).
          rewrite (map_nth (fun i => around (number (reach t) i))), seq_nth by exact I.
          rewrite (nth_indep _ 0 (u 0%nat)) by (rewrite map_size, seq_size; exact I).
          rewrite (map_nth u), seq_nth by exact I. apply around_encloses, U, I.
        * rewrite (nth_overflow _ I.nai) by (rewrite map_size, seq_size; exact I).
          apply unknown_encloses.
  Qed.

  (** What the test has found. *)
  Lemma found : bounds_of c full t b = Some v /\ holds_tube n t v = true.
  Proof.
    unfold test_tube in tested. destruct (bounds_of c full t b) as [w|]; [|discriminate].
    fold n in tested. destruct (holds_tube n t w) eqn:H; [|discriminate].
    injection tested as ->. auto.
  Qed.

  Let places_only := firstn m vs.
  Let base := evaluate_definitions places_only (definitions (places c)).
  Let names := tube_names c t places_only m (fun i => form_of (nth (m + i) vs None)).
  Let columns := entries c m names.
  Let a := tabulate n n (fun i j => form_of (nth i (nth j columns []) None)).
  Let k := left_inverse n n (midpoints a).
  Let middle := tube_names c t (variables full b) m (fun _ => constant_form zero).

  Lemma everything_known :
    forallb is_known names = true /\
    forallb (fun e => is_known (evaluate base e)) (also_defined (places c)) = true /\
    forallb (fun e => is_known (evaluate names e)) (equations c) = true /\
    forallb (fun e => is_known (evaluate names e)) (also c) = true /\
    forallb (fun l => forallb is_known l && Nat.eqb (length l) n) columns = true /\
    length (equations c) = n /\
    v = TubeBounds k (map (map (fun f => I.abs (form_range f))) (product_error n n k a))
      (map (fun i => I.abs (form_range (form_sum n (fun l =>
               scale_form (point (get k i l))
                 (nth l (map (fun e => form_of (evaluate middle e)) (equations c))
                    (constant_form I.nai)))))) (seq 0 n)).
  Proof.
    destruct found as [H _]. unfold bounds_of in H. fold n in H. fold m in H. fold vs in H.
    fold places_only in H. fold base in H. fold names in H. fold columns in H.
    match type of H with (if ?p then _ else _) = _ => destruct p eqn:P; [|discriminate] end.
    injection H as H. apply andb_prop in P as [P P6]. apply andb_prop in P as [P P5].
    apply andb_prop in P as [P P4]. apply andb_prop in P as [P P3].
    apply andb_prop in P as [P1 P2]. apply Nat.eqb_eq in P6.
    repeat split; try assumption. symmetry. exact H.
  Qed.

  Lemma tests i : (i < n)%nat ->
    0 < reach_of i /\ is_bounded (nth i (offsets v) I.nai) = true /\
    (forall j, (j < n)%nat -> is_bounded (at_ (spreads v) i j) = true) /\
    offset_of i + sum n (fun j => spread_of i j * reach_of j) < reach_of i.
  Proof.
    intros I. destruct found as [_ H]. unfold holds_tube in H. rewrite forallb_forall in H.
    specialize (H i ltac:(apply in_seq; lia)). apply andb_prop in H as [H H4].
    apply andb_prop in H as [H H3]. apply andb_prop in H as [H1 H2].
    split; [exact (is_positive_correct _ _ H1 (point_encloses _))|]. split; [exact H2|].
    split.
    - intros j J. rewrite forallb_forall in H3. apply H3, in_seq. lia.
    - apply Rminus_lt. refine (is_negative_correct _ _ H4 _).
      apply subtract_encloses; [|apply point_encloses].
      apply add_encloses; [apply point_encloses|]. apply interval_sum_encloses. intros j J.
      apply multiply_encloses; apply point_encloses.
  Qed.

  Section Inside.
    Variable u : nat -> R.
    Hypothesis U : inside n reach_of u.
    Let xu := x ++ map u (seq 0 n).
    Let s := coordinate (tube_box c t b) xu.
    Let T : in_unit_box s := coordinate_in_unit_box _ _ (in_tube_box u U).

    Lemma places_known : known s places_only x.
    Proof.
      pose proof (variables_known full _ _ (in_tube_box u U)) as K. fold vs xu s in K.
      apply (known_left s places_only (skipn m vs) x (map u (seq 0 n))).
      - unfold places_only. rewrite firstn_size, (proj1 K). unfold xu.
        rewrite app_size, size_of_place. lia.
      - unfold places_only. rewrite firstn_skipn. exact K.
    Qed.

    Lemma names_known : known s names (names_at c x (beside n t x u)).
    Proof.
      unfold names. rewrite <- size_of_place. apply tube_names_known; [exact T|apply places_known|].
      intros i I. pose proof (variables_known full _ _ (in_tube_box u U)) as K. fold vs xu s in K.
      replace (u i) with (nth (length x + i) xu 0); [apply form_of_encloses, K|].
      unfold xu. rewrite app_nth2 by lia. replace (length x + i - length x)%nat with i by lia.
      rewrite (nth_indep _ 0 (u 0%nat)) by (rewrite map_size, seq_size; exact I).
      rewrite (map_nth u), seq_nth by exact I. reflexivity.
    Qed.

    Lemma values_inside : has_values c x (beside n t x u).
    Proof.
      destruct everything_known as (K1 & K2 & K3 & K4 & _).
      assert (KB : known s base (extend x (definitions (places c)))).
      { apply known_definitions; [exact T|apply places_known]. }
      unfold names, tube_names in K1. fold base in K1. fold n in K1.
      destruct (evaluate_definitions_prefix (further c)
        (base ++ map (fun i => of_form (add_forms (axis_form t places_only m i)
                        (form_of (nth (m + i) vs None)))) (seq 0 n))) as [l L].
      assert (K1' := K1). rewrite L, !forallb_app in K1'. apply andb_prop in K1' as [K1' _].
      apply andb_prop in K1' as [K1' _].
      split; [|split; [|split; [|split]]].
      - eapply definitions_are_defined; [exact T|apply places_known|exact K1'].
      - exact (known_all_defined s base _ _ T KB K2).
      - eapply definitions_are_defined; [exact T| |exact K1].
        apply (known_map s n (fun i => add_forms (axis_form t places_only m i)
                        (form_of (nth (m + i) vs None)))); [exact T|exact KB|].
        intros i I. apply add_forms_enclose.
        + rewrite <- size_of_place. apply axis_form_encloses, places_known.
        + pose proof (variables_known full _ _ (in_tube_box u U)) as K. fold vs xu s in K.
          replace (u i) with (nth (m + i) xu 0); [apply form_of_encloses, K|].
          unfold xu. rewrite <- size_of_place, app_nth2 by lia.
          replace (length x + i - length x)%nat with i by lia.
          rewrite (nth_indep _ 0 (u 0%nat)) by (rewrite map_size, seq_size; exact I).
          rewrite (map_nth u), seq_nth by exact I. reflexivity.
      - exact (known_all_defined s names _ _ T names_known K3).
      - exact (known_all_defined s names _ _ T names_known K4).
    Qed.

    Lemma column_known j : (j < n)%nat ->
      let names' := evaluate_definitions names (slope_definitions c m j) in
      forallb is_known names' = true /\
      nth j columns [] = map (evaluate names') (partial_expressions c m j) /\
      forallb is_known (map (evaluate names') (partial_expressions c m j)) = true.
    Proof.
      intros J names'. destruct everything_known as (_ & _ & _ & _ & K5 & _ & _).
      rewrite forallb_forall in K5.
      assert (E : nth j columns [] = if forallb is_known names'
                  then map (evaluate names') (partial_expressions c m j) else []).
      { unfold columns, entries. fold n.
        match goal with |- nth j (map ?g _) _ = _ => rewrite (nth_indep _ [] (g 0%nat))
          by (rewrite map_size, seq_size; exact J); rewrite (map_nth g), seq_nth by exact J end.
        reflexivity. }
      assert (In_j : In (nth j columns []) columns).
      { apply nth_In. unfold columns, entries. rewrite map_size, seq_size. exact J. }
      specialize (K5 _ In_j). apply andb_prop in K5 as [K5 L]. apply Nat.eqb_eq in L.
      rewrite E in K5, L. destruct (forallb is_known names') eqn:N; [auto|].
      simpl in L. lia.
    Qed.

    Lemma slope_names_known j :
      known s (evaluate_definitions names (slope_definitions c m j))
        (extend (names_at c x (beside n t x u)) (slope_definitions c m j)).
    Proof. apply known_definitions; [exact T|apply names_known]. Qed.

    Lemma partial_in_columns i j : (i < n)%nat -> (j < n)%nat ->
      defined (extend (names_at c x (beside n t x u)) (slope_definitions c m j))
        (nth i (partial_expressions c m j) no_entry) /\
      form_encloses s (form_at a i j) (slopes_at u i j).
    Proof.
      intros I J. destruct (column_known j J) as (N & E & K).
      destruct everything_known as (_ & _ & _ & _ & _ & L & _).
      set (names' := evaluate_definitions names (slope_definitions c m j)) in *.
      assert (Le : length (partial_expressions c m j) = n).
      { unfold partial_expressions. rewrite map_size. exact L. }
      set (e := nth i (partial_expressions c m j) no_entry).
      assert (Ie : In e (partial_expressions c m j)) by (apply nth_In; rewrite Le; exact I).
      assert (Ke : is_known (evaluate names' e) = true).
      { rewrite forallb_forall in K. apply K, in_map, Ie. }
      split; [exact (known_defined s names' _ e T (slope_names_known j) Ke)|].
      unfold a. rewrite tabulate_at by assumption. rewrite E.
      rewrite (nth_indep _ None (evaluate names' no_entry)) by (rewrite map_size, Le; exact I).
      rewrite (map_nth (evaluate names')). fold e. unfold slopes_at, partial_at.
      rewrite size_of_place. fold e. apply form_of_value; [exact T|apply slope_names_known].
    Qed.

    Lemma partial_inside i j : (i < n)%nat -> (j < n)%nat ->
      is_derive (fun r => error_at (update u j r) i) (u j) (slopes_at u i j).
    Proof.
      intros I J. destruct (column_known j J) as (N & _ & _).
      destruct everything_known as (_ & _ & _ & _ & _ & L & _).
      destruct values_inside as (_ & _ & V3 & V4 & _).
      apply partial_is_derivative; try assumption.
      - rewrite size_of_place. eapply definitions_are_defined; [exact T|apply names_known|exact N].
      - rewrite size_of_place. apply partial_in_columns; assumption.
    Qed.

    Lemma spread_inside i j : (i < n)%nat -> (j < n)%nat ->
      Rabs (sum n (fun l => inverse_of_middle i l * slopes_at u l j) - identity i j)
      <= spread_of i j.
    Proof.
      intros I J. unfold spread_of. apply bound_of_correct; [apply tests; assumption|].
      destruct everything_known as (_ & _ & _ & _ & _ & _ & E).
      unfold inverse_of_middle, at_. rewrite E. cbn [spreads inverse].
      pose proof (product_error_encloses s n n a (slopes_at u)
        (fun i j I J => proj2 (partial_in_columns i j I J)) k i j I J) as P.
      unfold product_error in P |- *. rewrite map_tabulate, tabulate_nth by assumption.
      rewrite tabulate_at in P by assumption.
      apply absolute_encloses, (form_range_encloses s); [exact T|exact P].
    Qed.
  End Inside.

  Lemma offset_at_axis i : (i < n)%nat ->
    Rabs (image n error_at inverse_of_middle (fun _ => 0) i) <= offset_of i.
  Proof.
    intros I. unfold offset_of. apply bound_of_correct; [apply tests; assumption|].
    destruct everything_known as (_ & _ & _ & _ & _ & L & E).
    unfold image, inverse_of_middle. rewrite E. cbn [offsets inverse].
    match goal with |- encloses (nth i (map ?g _) _) _ => rewrite (nth_indep _ I.nai (g 0%nat))
      by (rewrite map_size, seq_size; exact I); rewrite (map_nth g), seq_nth by exact I end.
    pose proof (coordinate_in_unit_box b x B) as T. simpl.
    apply absolute_encloses, (form_range_encloses (coordinate b x)); [exact T|].
    apply form_sum_encloses. intros l Ll. apply scale_form_encloses; [apply point_encloses|].
    assert (K : known (coordinate b x) middle (names_at c x (beside n t x (fun _ => 0)))).
    { unfold middle. rewrite <- size_of_place. apply tube_names_known; [exact T| |].
      - apply variables_known, B.
      - intros. apply constant_form_encloses, (integer_encloses 0). }
    rewrite (nth_indep _ _ (form_of (evaluate middle no_entry)))
      by (rewrite map_size, L; exact Ll).
    rewrite (map_nth (fun e => form_of (evaluate middle e))). apply form_of_value; assumption.
  Qed.

  Lemma spread_nonnegative i j : (i < n)%nat -> (j < n)%nat -> 0 <= spread_of i j.
  Proof.
    intros I J.
    assert (O : inside n reach_of (fun _ => 0)).
    { intros l Ll. rewrite Rabs_R0. left. apply tests, Ll. }
    eapply Rle_trans; [apply Rabs_pos|apply (spread_inside _ O i j I J)].
  Qed.

  Lemma contracts_here i : (i < n)%nat -> sum n (fun j => spread_of i j * reach_of j) < reach_of i.
  Proof.
    intros I. destruct (tests i I) as (_ & _ & _ & H). pose proof (offset_at_axis i I) as O.
    pose proof (Rabs_pos (image n error_at inverse_of_middle (fun _ => 0) i)). lra.
  Qed.

  Lemma error_ext u w i : (forall j, (j < n)%nat -> u j = w j) -> (i < n)%nat ->
    error_at u i = error_at w i.
  Proof. intros H _. unfold error_at. rewrite (beside_ext n t x u w H). reflexivity. Qed.

  (** The configuration in the tube. *)
  Definition tube_solution : list R :=
    beside n t x (solution n error_at inverse_of_middle).

  Let positive i I := proj1 (tests i I).

  Definition departure_of (i : nat) : R :=
    offset_of i + sum n (fun j => spread_of i j * reach_of j).

  Lemma departure_encloses i : encloses (departure n t v i) (departure_of i).
  Proof.
    apply add_encloses; [apply point_encloses|]. apply interval_sum_encloses. intros j J.
    apply multiply_encloses; apply point_encloses.
  Qed.

  Lemma solution_departs i : (i < n)%nat ->
    Rabs (nth i tube_solution 0 - axis t x i) <= departure_of i.
  Proof.
    intros I. unfold tube_solution. rewrite beside_nth by exact I.
    replace (axis t x i + solution n error_at inverse_of_middle i - axis t x i)
      with (solution n error_at inverse_of_middle i) by ring.
    apply (solution_strict n error_at slopes_at inverse_of_middle spread_of reach_of offset_of);
      try assumption; try exact error_ext; try exact contracts_here;
      try exact offset_at_axis; intros; first [apply partial_inside|apply spread_inside|apply
        tests];
      assumption.
  Qed.

  Lemma solution_within i : (i < n)%nat -> exists d, encloses (departure n t v i) d /\
    Rabs (nth i tube_solution 0 - axis t x i) <= d /\ d < reach_of i.
  Proof.
    intros I. exists (departure_of i). split; [apply departure_encloses|].
    split; [exact (solution_departs i I)|apply tests, I].
  Qed.

  Lemma solution_in_tube : in_tube n t x tube_solution.
  Proof.
    split; [apply beside_length|]. intros i I. destruct (solution_within i I) as (d & _ & H & D).
    fold (reach_of i). lra.
  Qed.

  Lemma distances_inside p : in_tube n t x p -> inside n reach_of (fun i => nth i p 0 - axis t x i).
  Proof. intros [_ H] i I. apply H, I. Qed.

  Lemma tube_solution_solves : solves c x tube_solution.
  Proof.
    split; [apply beside_length|]. fold n. intros i I.
    change (error_at (solution n error_at inverse_of_middle) i = 0).
    apply (solution_solves n error_at slopes_at inverse_of_middle spread_of reach_of offset_of);
      try assumption; try exact error_ext; try exact contracts_here;
      try exact offset_at_axis; intros; first [apply partial_inside|apply spread_inside|apply
        tests];
      assumption.
  Qed.

  Lemma errors_vanish p : in_tube n t x p -> solves c x p ->
    forall i, (i < n)%nat -> error_at (fun i => nth i p 0 - axis t x i) i = 0.
  Proof.
    intros [L _] [_ H] i I. unfold error_at. rewrite (beside_of n t x p L). apply H, I.
  Qed.

  (** A configuration of the tube is as near to this one as the equations are to 0 beside it. *)
  Lemma near_tube_solution p u e : in_tube n t x p -> solves c x p -> inside n reach_of u ->
    (forall i, (i < n)%nat -> Rabs (image n error_at inverse_of_middle u i)
       <= e * (reach_of i - sum n (fun j => spread_of i j * reach_of j))) ->
    forall i, (i < n)%nat -> Rabs (nth i p 0 - axis t x i - u i) <= e * reach_of i.
  Proof.
    intros P S U H i I.
    apply (near_solution n error_at slopes_at inverse_of_middle spread_of reach_of)
      with (p := fun i => nth i p 0 - axis t x i); try assumption; try exact error_ext;
      try exact contracts_here; try (apply distances_inside; exact P);
      try (apply errors_vanish; assumption); intros;
      first [apply partial_inside|apply spread_inside|apply tests]; assumption.
  Qed.

  Lemma only_solution p : in_tube n t x p -> solves c x p -> p = tube_solution.
  Proof.
    intros P S. apply list_equal; [rewrite (proj1 P); symmetry; apply beside_length|].
    rewrite (proj1 P). intros i I.
    assert (H : Rabs (nth i p 0 - axis t x i - (nth i tube_solution 0 - axis t x i))
                <= 0 * reach_of i).
    { apply near_tube_solution with (u := fun i => nth i tube_solution 0 - axis t x i);
        try assumption; [apply distances_inside, solution_in_tube|]. intros l Ll. unfold image.
      rewrite sum_zero; [rewrite Rabs_R0; lra|]. intros h Hh.
      rewrite (errors_vanish tube_solution solution_in_tube tube_solution_solves) by exact Hh.
        ring. }
    rewrite Rmult_0_l in H.
    destruct (Req_dec (nth i p 0 - axis t x i - (nth i tube_solution 0 - axis t x i)) 0) as [Z|N];
      [lra|]. pose proof (Rabs_pos_lt _ N). lra.
  Qed.

  (** The next point of Newton's method, and how far the configuration is from it. *)
  Lemma near_newton_form p i : in_tube n t x p -> solves c x p -> (i < n)%nat -> exists y d,
    form_encloses (coordinate b x) (newton_form n full t b v (residuals c full t b) i) y /\
    encloses (rest_of n v (departures n t v) i) d /\ Rabs (nth i p 0 - y) <= d.
  Proof.
    intros P S I. pose proof (coordinate_in_unit_box b x B) as T.
    set (u := fun j => nth j p 0 - axis t x j).
    exists (axis t x i - image n error_at inverse_of_middle (fun _ => 0) i),
      (sum n (fun j => spread_of i j * departure_of j)).
    split; [|split].
    - apply subtract_forms_enclose.
      { rewrite (proj1 B). apply axis_form_encloses, variables_known, B. }
      unfold image. apply form_sum_encloses. intros l Ll.
      apply scale_form_encloses; [apply point_encloses|].
      assert (K : known (coordinate b x) middle (names_at c x (beside n t x (fun _ => 0)))).
      { unfold middle. rewrite <- size_of_place. apply tube_names_known; [exact T| |].
        - apply variables_known, B.
        - intros. apply constant_form_encloses, (integer_encloses 0). }
      unfold residuals. change (tube_names c t (variables full b) (length b) _) with middle.
      destruct everything_known as (_ & _ & _ & _ & _ & L & _).
      rewrite (nth_indep _ _ (form_of (evaluate middle no_entry)))
        by (rewrite map_size, L; exact Ll).
      rewrite (map_nth (fun e => form_of (evaluate middle e))). apply form_of_value; assumption.
    - apply interval_sum_encloses. intros j J. apply multiply_encloses; [apply point_encloses|].
      unfold departures. rewrite (nth_indep _ _ (departure n t v 0))
        by (rewrite map_size, seq_size; exact J).
      rewrite (map_nth (departure n t v)), seq_nth by exact J. apply departure_encloses.
    - assert (Z : image n error_at inverse_of_middle u i = 0).
      { unfold image. apply sum_zero. intros l Ll.
        change (fun j => nth j p 0 - axis t x j) with u.
        rewrite (errors_vanish p P S l Ll : error_at u l = 0). ring. }
      replace (nth i p 0 - (axis t x i - image n error_at inverse_of_middle (fun _ => 0) i))
        with (step n error_at inverse_of_middle u i
              - step n error_at inverse_of_middle (fun _ => 0) i)
        by (unfold step; rewrite Z; unfold u; ring).
      eapply Rle_trans.
      { apply (step_contracts n error_at slopes_at inverse_of_middle spread_of reach_of);
          try exact I; try exact (distances_inside p P); try exact contracts_here;
          try exact error_ext;
          try (intros l Ll; rewrite Rabs_R0; left; apply tests, Ll); intros;
          first [apply partial_inside|apply spread_inside|apply tests]; assumption. }
      apply sum_le. intros j J. apply Rmult_le_compat_l; [exact (spread_nonnegative i j I J)|].
      rewrite Rminus_0_r. unfold u. rewrite (only_solution p P S). exact (solution_departs j J).
  Qed.

  (** The derivatives of the equations at a configuration of the tube. *)
  Lemma slopes_in_tube p : in_tube n t x p ->
    let a := slopes_at (fun i => nth i p 0 - axis t x i) in
    (forall i j, (i < n)%nat -> (j < n)%nat ->
       derivable_pt_lim (fun s => equation_at c x (put j s p) i) (nth j p 0) (a i j)) /\
    full_column_rank n n a.
  Proof.
    intros P. pose proof (distances_inside p P) as U. set (u := fun i => nth i p 0 - axis t x i) in
      *.
    assert (E : beside n t x u = p) by apply beside_of, P.
    split.
    - intros i j I J. apply is_derive_Reals.
      apply (is_derive_ext (fun s => error_at (update u j (s - axis t x j)) i)).
      { intros s. unfold error_at. f_equal. rewrite <- E. apply list_equal.
        - rewrite beside_length, put_length, beside_length. reflexivity.
        - rewrite beside_length. intros l Ll. rewrite beside_nth by exact Ll. rewrite put_nth.
          rewrite beside_length. unfold update.
          destruct (Nat.eqb_spec l j) as [->|]; [|symmetry; apply beside_nth, Ll].
          destruct (Nat.ltb_spec j n); [ring|lia]. }
      apply is_derive_value with (1 * slopes_at u i j); [ring|].
      apply (is_derive_comp (fun s => error_at (update u j s) i) (fun s => s - axis t x j)).
      + exact (partial_inside u U i j I J).
      + auto_derive; [exact Logic.I|ring].
    - apply (regular_inside n slopes_at inverse_of_middle spread_of reach_of);
        try assumption; try exact error_ext; try exact contracts_here; intros;
        first [apply partial_inside|apply spread_inside|apply tests]; assumption.
  Qed.

  Lemma regular_in_tube p : in_tube n t x p -> has_values c x p /\ regular_at c x p.
  Proof.
    intros P. split.
    - rewrite <- (beside_of n t x p) by apply P. apply values_inside, distances_inside, P.
    - eexists. exact (slopes_in_tube p P).
  Qed.
End At_place.
