(* SPDX-License-Identifier: Apache-2.0 *)
(** Forces, errors and speeds over the branch of a closure: bounds of the derivatives of the
    unknowns by the motors, over each tube. *)
From Coquelicot Require Import Coquelicot.
From Coq Require Import Reals QArith Qreals Lra Lia List PArith Bool.
From Coq Require PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Intervals Forms Evaluation Boxes Hints Regularity.
From Regulus Require Import Continuity Existence Derivatives LinearAlgebra Questions Search Forces.
From Regulus Require Import Limits Closures Tubes Parts Branches Ways.
Import ListNotations.
Open Scope R_scope.

(** ** The claims *)

(** A matrix that the mechanism has at the place x in the configuration p. *)
Definition matrix_at : Type := closure -> list R -> list R -> (nat -> nat -> R) -> Prop.

(** The derivatives of the equations by the unknowns, which are a regular matrix. *)
Definition has_slopes : matrix_at := fun c x p a =>
  (forall i j, (i < unknowns c)%nat -> (j < unknowns c)%nat ->
     derivable_pt_lim (fun s => equation_at c x (put j s p) i) (nth j p 0) (a i j)) /\
  full_column_rank (unknowns c) (unknowns c) a.

(** J has the derivatives of the unknowns by the motors, which are variables of the places: with the
    derivatives a of the equations by the unknowns, and b by the motors, a J = -b. *)
Definition has_rates (motors : list nat) : matrix_at := fun c x p J =>
  exists a b : nat -> nat -> R,
    has_slopes c x p a /\
    (forall i k, (i < unknowns c)%nat -> (k < length motors)%nat ->
       let v := nth k motors O in
       derivable_pt_lim (fun s => equation_at c (put v s x) p i) (nth v x 0) (b i k)) /\
    forall i k, (i < unknowns c)%nat -> (k < length motors)%nat ->
      sum (unknowns c) (fun j => a i j * J j k) = - b i k.

(** A set of vectors: a middle and a spread of each component, and balls about 0, each with its
    radius and its components. *)
Record vectors := Vectors {
  components : list (expression * expression);
  balls : list (expression * list nat) }.

Definition is_member (k : nat) (l : list nat) : bool := existsb (Nat.eqb k) l.

Definition vectors_defined (s : vectors) : Prop :=
  Forall (fun u => defined [] (fst u) /\ defined [] (snd u)) (components s) /\
  Forall (fun u => defined [] (fst u)) (balls s).

(** w is the sum of the middles, of d within the spreads, and of a vector of each ball. *)
Definition in_vectors (s : vectors) (w : nat -> R) : Prop :=
  let n := length (components s) in
  let radius l := value [] (fst (nth l (balls s) (no_entry, []))) in
  let part l k := if is_member k (snd (nth l (balls s) (no_entry, []))) then 1 else 0 in
  exists (d : nat -> R) (v : nat -> nat -> R),
    (forall k, (k < n)%nat -> Rabs (d k) <= value_of [] (map snd (components s)) k) /\
    (forall l, (l < length (balls s))%nat ->
       sum n (fun k => part l k * (v l k * v l k)) <= radius l * radius l) /\
    forall k, (k < n)%nat ->
      w k = value_of [] (map fst (components s)) k + d k
            + sum (length (balls s)) (fun l => part l k * v l k).

(** What is measured: the force of a motor that holds the load w; how an unknown moves if the motors
    move by w; or how it moves if the motors give way to the load w by their forces divided by their
    stiffness. *)
Inductive measured :=
  | Force (motor : nat)
  | Motion (unknown : nat)
  | Deflection (unknown : nat) (stiffness : list expression).

Definition measure (n d : nat) (J : nat -> nat -> R) (q : measured) (w : nat -> R) : R :=
  match q with
  | Force k => sum n (fun j => J j k * w j)
  | Motion i => sum d (fun k => J i k * w k)
  | Deflection i c =>
      sum d (fun k => J i k * (sum n (fun j => J j k * w j) / value_of [] c k))
  end.

(** The set has as many components as there are unknowns, or motors. *)
Definition fits (n d : nat) (q : measured) (s : vectors) : Prop :=
  match q with
  | Force k => (k < d)%nat /\ length (components s) = n
  | Motion i => (i < n)%nat /\ length (components s) = d
  | Deflection i c => (i < n)%nat /\ length (components s) = n /\ length c = d /\
      Forall (fun e => defined [] e /\ 0 < value [] e) c
  end.

(** The closure has one branch p, and P is true of the matrix that it has along it. *)
Definition over_branch (has : matrix_at) (P : (nat -> nat -> R) -> Prop) (c : closure) : Prop :=
  is_given c /\ exists p, is_branch c p /\
    forall x, in_set (places c) x -> exists J, has c x (p x) J /\ P J.

(** The same along a way, on each piece. *)
Definition over_branch_along (has : matrix_at) (P : (nat -> nat -> R) -> Prop)
    (c : list expression -> closure) (pieces : list (list expression)) : Prop :=
  let way := map c pieces in
  is_way way /\ exists p, is_branch_along way p /\
    forall x k d, is_on way x k d -> exists J, has d (on_piece k x) (p x) J /\ P J.

(** PAVING: the parts of w keep the places with the branch, as in [one_branch_in], and P is true of
    the matrix at those that v keeps, too. *)
Definition over_branch_in (w v : parts) (has : matrix_at) (P : (nat -> nat -> R) -> Prop)
    (c : closure) : Prop :=
  is_given c /\ is_kept w (the_start c) /\
  exists p, is_branch_among (fun x => in_set (places c) x /\ is_kept w x) c p /\
    forall x, in_set (places c) x -> is_kept w x -> is_kept v x ->
      exists J, has c x (p x) J /\ P J.

(** The same along a way, with the parts of each piece. *)
Definition over_branch_along_in (ws vs : list parts) (has : matrix_at)
    (P : (nat -> nat -> R) -> Prop) (c : list expression -> closure)
    (pieces : list (list expression)) : Prop :=
  let way := map c pieces in
  is_way way /\ starts_in way ws /\
  exists p, is_branch_along_among (is_kept_on way ws) way p /\
    forall x k d, is_kept_on way ws x k d -> is_kept (nth k vs LeftOut) (on_piece k x) ->
      exists J, has d (on_piece k x) (p x) J /\ P J.

(** All pieces have as many unknowns. *)
Definition unknowns_along (c : list expression -> closure) (pieces : list (list expression)) :=
  match map c pieces with d :: _ => unknowns d | [] => O end.

(** [over P] says that P is true of J everywhere, for n unknowns and d motors. *)
Definition is_bounded_over (over : ((nat -> nat -> R) -> Prop) -> Prop) (n d : nat)
    (bound : R -> Prop) (q : measured) (s : vectors) : Prop :=
  fits n d q s /\ vectors_defined s /\
  over (fun J => forall w, in_vectors s w -> bound (measure n d J q w)).

Definition is_within_over over n d q s (limit : expression) : Prop :=
  defined [] limit /\ is_bounded_over over n d (fun y => Rabs y < value [] limit) q s.
Definition is_below_over over n d q s (limit : expression) : Prop :=
  defined [] limit /\ is_bounded_over over n d (fun y => y < value [] limit) q s.
Definition is_above_over over n d q s (limit : expression) : Prop :=
  defined [] limit /\ is_bounded_over over n d (fun y => value [] limit < y) q s.

(** The force of each motor is between its limits, for each load. *)
Definition keeps_limits_over (over : ((nat -> nat -> R) -> Prop) -> Prop) (n d : nat)
    (load : vectors) (limits : list (expression * expression)) : Prop :=
  length (components load) = n /\ length limits = d /\
  vectors_defined load /\ Forall (fun l => defined [] (fst l) /\ defined [] (snd l)) limits /\
  over (fun J => forall w, in_vectors load w -> forall k, (k < d)%nat ->
    value_of [] (map fst limits) k <= measure n d J (Force k) w
      <= value_of [] (map snd limits) k).

Definition branch_within (c : closure) (motors : list nat) :=
  is_within_over (fun P => over_branch (has_rates motors) P c) (unknowns c) (length motors).
Definition branch_below (c : closure) (motors : list nat) :=
  is_below_over (fun P => over_branch (has_rates motors) P c) (unknowns c) (length motors).
Definition branch_above (c : closure) (motors : list nat) :=
  is_above_over (fun P => over_branch (has_rates motors) P c) (unknowns c) (length motors).
Definition branch_within_limits (c : closure) (motors : list nat) :=
  keeps_limits_over (fun P => over_branch (has_rates motors) P c) (unknowns c) (length motors).

Definition branch_within_limits_in (c : closure) (w v : parts) (motors : list nat) :=
  keeps_limits_over (fun P => over_branch_in w v (has_rates motors) P c) (unknowns c)
    (length motors).

Definition branch_within_along (c : list expression -> closure) pieces (motors : list nat) :=
  is_within_over (fun P => over_branch_along (has_rates motors) P c pieces)
    (unknowns_along c pieces) (length motors).
Definition branch_below_along (c : list expression -> closure) pieces (motors : list nat) :=
  is_below_over (fun P => over_branch_along (has_rates motors) P c pieces)
    (unknowns_along c pieces) (length motors).
Definition branch_above_along (c : list expression -> closure) pieces (motors : list nat) :=
  is_above_over (fun P => over_branch_along (has_rates motors) P c pieces)
    (unknowns_along c pieces) (length motors).
Definition branch_within_limits_along (c : list expression -> closure) pieces
    (motors : list nat) :=
  keeps_limits_over (fun P => over_branch_along (has_rates motors) P c pieces)
    (unknowns_along c pieces) (length motors).
Definition branch_within_limits_along_in (c : list expression -> closure) pieces
    (ws vs : list parts) (motors : list nat) :=
  keeps_limits_over (fun P => over_branch_along_in ws vs (has_rates motors) P c pieces)
    (unknowns_along c pieces) (length motors).

(** ** The derivatives of the equations by variable k of m *)

Section By_variable.
  Variables (c : closure) (m : nat).
  Definition variable_moves (k : nat) : list bool := map (Nat.eqb k) (seq 0 m).
  Definition variable_slopes (k : nat) : list Q :=
    map (fun i => if Nat.eqb k i then 1 # 1 else 0 # 1) (seq 0 m).
  Definition moving_before (k : nat) : list bool :=
    moving_names (all_names c m) (variable_moves k) (definitions (places c)) ++ repeat false
      (unknowns c).
  Definition motor_definitions (k : nat) : list expression :=
    map Constant (variable_slopes k)
    ++ slopes (all_names c m) (variable_moves k) (definitions (places c))
    ++ map Constant (repeat (0 # 1) (unknowns c))
    ++ slopes (all_names c m) (moving_before k) (further c).
  Definition motor_expressions (k : nat) : list expression :=
    let moving := moving_names (all_names c m) (moving_before k) (further c) in
    map (fun e => slope_or_zero (slope (all_names c m) moving e)) (equations c).
End By_variable.

Definition by_motor (c : closure) (x p : list R) (k i : nat) : R :=
  value (extend (names_at c x p) (motor_definitions c (length x) k))
    (nth i (motor_expressions c (length x) k) no_entry).

Section Motor_derivative.
  Variables (c : closure) (x p : list R) (k : nat).
  Let m := length x.
  Let n := unknowns c.
  Let base := extend x (definitions (places c)).
  Let names := names_at c x p.
  Hypothesis K : (k < m)%nat.
  Hypothesis size : length p = n.
  Hypothesis has_all : length (equations c) = n.
  Hypothesis places_defined : all_defined x (definitions (places c)).
  Hypothesis further_defined : all_defined (base ++ p) (further c).
  Hypothesis equations_defined : Forall (defined names) (equations c).

  Lemma motor_is_derivative i : (i < n)%nat ->
    all_defined names (motor_definitions c m k) ->
    defined (extend names (motor_definitions c m k)) (nth i (motor_expressions c m k) no_entry) ->
    is_derive (fun s => equation_at c (put k s x) p i) (nth k x 0) (by_motor c x p k i).
  Proof.
    intros I D De.
    assert (Lb : length base = before c m) by (unfold base; rewrite extend_length; reflexivity).
    assert (Ln : length names = all_names c m).
    { unfold names, names_at. rewrite extend_length, app_size, size. fold base.
      rewrite Lb. reflexivity. }
    set (s0 := nth k x 0).
    assert (X0 : put k s0 x = x).
    { apply list_equal; [apply put_length|]. rewrite put_length. intros l L. rewrite put_nth.
      destruct (Nat.eqb_spec l k) as [->|]; [|reflexivity].
      destruct (Nat.ltb_spec k (length x)); [reflexivity|lia]. }
    set (w := map Q2R (variable_slopes m k)).
    assert (Lw : length w = m).
    { unfold w, variable_slopes. rewrite !map_size, seq_size. reflexivity. }
    assert (moving_at : forall l, nth l (variable_moves m k) false = true -> l = k).
    { intros l H. unfold variable_moves in H.
      destruct (Nat.lt_ge_cases l m) as [L|L].
      - rewrite (nth_indep _ false (Nat.eqb k 0)) in H
          by (rewrite map_size, seq_size; exact L).
        rewrite (map_nth (Nat.eqb k)), seq_nth in H by exact L. simpl in H.
        apply Nat.eqb_eq in H. congruence.
      - rewrite nth_overflow in H by (rewrite map_size, seq_size; exact L). discriminate. }
    assert (C0 : on_curve (fun s => put k s x) s0 (variable_moves m k) w).
    { split.
      - intros s. rewrite put_length, Lw. reflexivity.
      - unfold variable_moves. rewrite map_size, seq_size, Lw. reflexivity.
      - intros l H. apply moving_at in H. subst l.
        apply (is_derive_ext (fun s => s)).
        { intros s. rewrite put_nth, Nat.eqb_refl.
          destruct (Nat.ltb_spec k (length x)); [reflexivity|lia]. }
        replace (nth k w 0) with 1; [apply @is_derive_id|].
        unfold w, variable_slopes. rewrite map_map.
        rewrite (nth_indep _ 0 (Q2R (if Nat.eqb k 0 then 1 # 1 else 0 # 1)))
          by (rewrite map_size, seq_size; exact K).
        rewrite (map_nth (fun i => Q2R (if Nat.eqb k i then 1 # 1 else 0 # 1))), seq_nth by exact K.
        simpl. rewrite Nat.eqb_refl. unfold Q2R. simpl. field.
      - intros l H s. rewrite !put_nth. destruct (Nat.eqb_spec l k) as [->|]; [|reflexivity].
        unfold variable_moves in H.
        rewrite (nth_indep _ false (Nat.eqb k 0)) in H
          by (rewrite map_size, seq_size; exact K).
        rewrite (map_nth (Nat.eqb k)), seq_nth in H by exact K. simpl in H.
        rewrite Nat.eqb_refl in H. discriminate. }
    unfold motor_definitions in D, De.
    apply all_defined_app in D as [_ D]. apply all_defined_app in D as [D1 D].
    apply all_defined_app in D as [_ D2].
    rewrite (extend_constants (variable_slopes m k)) in D1, D2.
    rewrite extend_constants in D2. fold w in D1, D2. rewrite <- Ln in D1, D2.
    destruct (extend_prefix (further c) (base ++ p)) as [rest R].
    destruct (slopes_correct (definitions (places c)) (fun s => put k s x) s0 _ w names
      (p ++ rest) C0) as [w1 [E1 C1]].
    { rewrite X0. fold base. unfold names, names_at. fold base. rewrite R, app_assoc.
      reflexivity. }
    { rewrite X0. exact places_defined. }
    { exact D1. }
    rewrite E1 in D2.
    set (zeros := map Q2R (repeat (0 # 1) n)) in *.
    set (curve := fun s => extend (put k s x) (definitions (places c)) ++ p).
    assert (C2 : on_curve curve s0 (moving_before c m k) (w1 ++ zeros)).
    { assert (Lz : length zeros = n).
      { unfold zeros. rewrite map_size, repeat_length. reflexivity. }
      assert (L1 : forall s, length (extend (put k s x) (definitions (places c))) = length w1)
        by apply (same_length _ _ _ _ C1).
      assert (M1 : length (moving_names (all_names c m) (variable_moves m k)
                (definitions (places c))) = length w1).
      { rewrite <- Ln. apply (moving_length _ _ _ _ C1). }
      unfold curve, moving_before. fold n. split.
      - intros s. rewrite !app_size, L1, Lz, size. reflexivity.
      - rewrite !app_size, M1, repeat_length, Lz. reflexivity.
      - intros l H. destruct (Nat.lt_ge_cases l (length w1)) as [L|L].
        + rewrite app_nth1 in H by lia. rewrite app_nth1 by lia.
          apply (is_derive_ext (fun s => nth l (extend (put k s x) (definitions (places c))) 0)).
          { intros s. rewrite app_nth1; [reflexivity|]. rewrite L1. exact L. }
          apply (those_that_move _ _ _ _ C1). rewrite Ln. exact H.
        + rewrite app_nth2 in H by lia. rewrite nth_repeat in H. discriminate.
      - intros l H s. destruct (Nat.lt_ge_cases l (length w1)) as [L|L].
        + rewrite app_nth1 in H by lia. rewrite !app_nth1 by (rewrite L1; exact L).
          apply (those_that_stay _ _ _ _ C1). rewrite Ln. exact H.
        + rewrite !app_nth2 by (rewrite L1; exact L). rewrite !L1. reflexivity. }
    assert (EL : names = extend (curve s0) (further c)).
    { unfold names, names_at, curve. rewrite X0. reflexivity. }
    rewrite <- app_assoc in D2.
    destruct (slopes_correct (further c) curve s0 _ (w1 ++ zeros) names [] C2) as [w2 [E2 C3]].
    { rewrite app_nil_r. exact EL. }
    { unfold curve. rewrite X0. exact further_defined. }
    { rewrite Ln in D2 |- *. exact D2. }
    assert (EA : extend names (motor_definitions c m k) = names ++ w2).
    { unfold motor_definitions. rewrite !extend_app, (extend_constants (variable_slopes m k)).
      fold w. rewrite <- Ln, E1.
      rewrite extend_constants. fold n. fold zeros. rewrite <- app_assoc. exact E2. }
    unfold motor_definitions in EA. rewrite EA in De.
    unfold by_motor. fold m. fold names. unfold motor_definitions. rewrite EA.
    unfold motor_expressions in De |- *. rewrite <- Ln in De |- *.
    set (mv := moving_names (length names) (moving_before c m k) (further c)) in *.
    set (eq := nth i (equations c) no_entry).
    assert (Ei : nth i (map (fun e => slope_or_zero (slope (length names) mv e)) (equations c))
      no_entry = slope_or_zero (slope (length names) mv eq)).
    { rewrite (nth_indep _ no_entry (slope_or_zero (slope (length names) mv no_entry)))
        by (rewrite map_size, has_all; exact I).
      rewrite (map_nth (fun e => slope_or_zero (slope (length names) mv e))). reflexivity. }
    rewrite Ei in De |- *. rewrite slope_or_zero_value. apply slope_or_zero_defined in De.
    change (is_derive (fun s => value (extend (curve s) (further c)) eq) s0
              (slope_value (names ++ w2) (slope (length names) mv eq))).
    apply (slope_correct (length names) mv (fun s => extend (curve s) (further c))).
    - intros l L. rewrite <- EL in *. apply app_nth1, L.
    - intros l L. rewrite app_nth2 by lia.
      replace (length names + l - length names)%nat with l by lia. apply C3, L.
    - apply C3.
    - rewrite <- EL. rewrite Forall_forall in equations_defined. apply equations_defined, nth_In.
      rewrite has_all. exact I.
    - exact De.
  Qed.
End Motor_derivative.

(** ** A solution of n equations, over a box *)

(** z with A z = b. K is any matrix, at best an approximate inverse of A. *)
Definition solved (n : nat) (k : list (list F.type)) (a : forms) (b : list form) :
    option (list form) :=
  let e := product_error n n k a in
  let p := map (map (fun f => I.abs (form_range f))) (corrected_error n e) in
  let l := map (map (fun f => exact_terms (linear f))) e in
  let at_ i j := nth j (nth i l []) [] in
  let u := list_of n (fun i =>
    form_sum n (fun h => scale_form (point (get k i h)) (form_of_list b h))) in
  let z := list_of n (fun i => subtract_forms (form_of_list u i)
    (form_sum n (fun h => multiply_linear (at_ i h) (form_of_list u h)))) in
  let sizes := map (fun f => I.abs (form_range f)) z in
  let of_p j i := nth j (nth i p []) I.nai in
  let of_r j := nth j sizes I.nai in
  let y := Hint.correction n (fun i j => I.upper (of_p i j)) (fun j => I.upper (of_r j)) in
  if corrects n of_p of_r y then
    Some (list_of n (fun i => add_forms (form_of_list z i)
      (constant_form (multiply symmetric (point (nth i y F.nan))))))
  else None.

Section Solved.
  Variables (t : positive -> R) (n : nat) (a : forms) (b : list form).
  Variables (A : nat -> nat -> R) (B : nat -> R).
  Hypothesis T : in_unit_box t.
  Hypothesis a_encloses :
    forall i j, (i < n)%nat -> (j < n)%nat -> form_encloses t (form_at a i j) (A i j).
  Hypothesis b_encloses :
    forall j, (j < n)%nat -> form_encloses t (form_of_list b j) (B j).
  Variable k : list (list F.type).

  Let K i l := real_of (get k i l).
  Let E i j := sum n (fun l => K i l * A l j) - identity i j.
  Let e := product_error n n k a.
  Let l := map (map (fun f => exact_terms (linear f))) e.
  Let L i j := exact_value t (linear (form_at e i j)).
  Let E' i j := E i j - L i j - sum n (fun k => L i k * E k j).
  Let U i := sum n (fun h => K i h * B h).
  Let Z i := U i - sum n (fun h => L i h * U h).

  Lemma solution_of_corrected c : (forall i, (i < n)%nat -> sum n (fun j => A i j * c j) = B i) ->
    forall i, (i < n)%nat -> c i + sum n (fun j => E' i j * c j) = Z i.
  Proof.
    intros C i I. rewrite <- (sum_identity n i c I) at 1. rewrite <- sum_plus.
    rewrite (sum_ext n _ (fun j =>
      sum n (fun h => (identity i h - L i h) * sum n (fun f => K h f * A f j)) * c j)).
    2: { intros j J.
         pose proof (corrected_product t n n a A k i j I J) as P. cbv zeta beta in P.
         unfold E', E, L, e, K in *. rewrite P. ring. }
    rewrite (sum_product n n (fun h => identity i h - L i h)
      (fun h j => sum n (fun f => K h f * A f j)) c).
    rewrite (sum_ext n _ (fun h => identity i h * U h + (-1) * (L i h * U h))).
    2: { intros h H. rewrite (sum_product n n (K h) A c). fold (U h).
         rewrite (sum_ext n _ (fun l => K h l * B l)) by (intros f F; rewrite C by exact F;
           reflexivity).
         unfold U. ring. }
    rewrite sum_plus, sum_scale, sum_identity by exact I. unfold Z. ring.
  Qed.

  Theorem solved_correct f c : solved n k a b = Some f ->
    (forall i, (i < n)%nat -> sum n (fun j => A i j * c j) = B i) ->
    forall i, (i < n)%nat -> form_encloses t (form_of_list f i) (c i).
  Proof.
    unfold solved. fold e. fold l.
    set (p := map (map (fun f => I.abs (form_range f))) (corrected_error n e)).
    set (u := list_of n (fun i =>
      form_sum n (fun h => scale_form (point (get k i h)) (form_of_list b h)))).
    set (zf := fun i => subtract_forms (form_of_list u i)
      (form_sum n (fun h => multiply_linear (nth h (nth i l []) []) (form_of_list u h)))).
    set (z := list_of n zf).
    set (sizes := map (fun f => I.abs (form_range f)) z).
    cbv zeta. set (y := Hint.correction _ _ _).
    destruct (corrects n _ _ y) eqn:C; [|discriminate]. intros [= <-] S i I.
    unfold corrects in C. rewrite forallb_forall in C.
    assert (PE : forall i j, (i < n)%nat -> (j < n)%nat ->
              encloses (nth j (nth i p []) I.nai) (Rabs (E' i j))).
    { intros i' j I' J. unfold p, corrected_error.
      rewrite map_tabulate, tabulate_nth by assumption.
      apply absolute_encloses, (form_range_encloses t); [exact T|].
      pose proof (corrected_error_encloses t n n a A T a_encloses k i' j I' J) as H.
      unfold corrected_error in H. rewrite tabulate_at in H by assumption. exact H. }
    assert (UE : forall h, (h < n)%nat -> form_encloses t (form_of_list u h) (U h)).
    { intros h H. unfold form_of_list, u. rewrite list_of_nth by exact H.
      apply form_sum_encloses. intros f F. apply scale_form_encloses; [apply point_encloses|].
      apply b_encloses, F. }
    assert (ZE : forall h, (h < n)%nat -> form_encloses t (zf h) (Z h)).
    { intros h H. apply subtract_forms_enclose; [apply UE, H|].
      apply form_sum_encloses. intros f F.
      apply multiply_linear_encloses; [exact T| |apply UE, F].
      exact (at_encloses t n n a k h f H F). }
    assert (SE : forall j, (j < n)%nat -> encloses (nth j sizes I.nai) (Rabs (Z j))).
    { intros j J. unfold sizes, z, list_of. rewrite map_map.
      rewrite (nth_indep _ I.nai ((fun x => I.abs (form_range (zf x))) O))
        by (rewrite map_size, seq_size; exact J).
      rewrite (map_nth (fun x => I.abs (form_range (zf x)))), seq_nth by exact J.
      apply absolute_encloses, (form_range_encloses t); [exact T|exact (ZE j J)]. }
    pose proof (correction_bound n (fun j i => E' i j) Z (fun j => real_of (nth j y F.nan)) c) as D.
    unfold form_of_list at 1. rewrite list_of_nth by exact I.
    replace (c i) with (Z i + (c i - Z i)) by ring.
    apply add_forms_enclose.
    - unfold form_of_list, z. rewrite list_of_nth by exact I. exact (ZE i I).
    - apply constant_form_encloses, (spread_encloses _ (real_of (nth i y F.nan)));
        [apply point_encloses|].
      apply D; [| |exact (solution_of_corrected c S)|exact I].
      + intros h H. specialize (C h ltac:(apply in_seq; lia)). apply andb_prop in C as [C _].
        exact (is_positive_correct _ _ C (point_encloses _)).
      + intros h H. specialize (C h ltac:(apply in_seq; lia)). apply andb_prop in C as [_ C].
        apply Rminus_lt. refine (is_negative_correct _ _ C _).
        apply subtract_encloses; [|apply point_encloses]. apply interval_sum_encloses. intros j J.
        apply multiply_encloses; [apply PE; assumption|].
        apply add_encloses; [apply SE, J|apply point_encloses].
  Qed.
End Solved.

(** ** Bounds over a set of vectors *)

Lemma root_bound x y r : 0 <= y -> x * x <= y * (r * r) -> Rabs x <= sqrt y * Rabs r.
Proof.
  intros Y H. apply Rsqr_incr_0_var.
  - rewrite Rsqr_mult, Rsqr_sqrt, <- !Rsqr_abs by exact Y. unfold Rsqr. lra.
  - apply Rmult_le_pos; [apply sqrt_pos|apply Rabs_pos].
Qed.

Definition radius_range (s : vectors) (l : nat) : interval :=
  nth l (bounds_of_limits (map fst (balls s))) I.nai.

(** The sum of g k w k, over the vectors w. *)
Definition range_over (s : vectors) (g : nat -> form) : interval :=
  let n := length (components s) in
  let middles := bounds_of_limits (map fst (components s)) in
  let spreads := bounds_of_limits (map snd (components s)) in
  let size k := I.abs (form_range (g k)) in
  let part l k := is_member k (snd (nth l (balls s) (no_entry, []))) in
  add (form_range (form_sum n (fun k => scale_form (nth k middles I.nai) (g k))))
    (multiply symmetric
      (add (interval_sum n (fun k => multiply (size k) (nth k spreads I.nai)))
        (interval_sum (length (balls s)) (fun l =>
          multiply
            (I.sqrt precision
              (interval_sum n (fun k => if part l k then square (size k) else zero)))
            (I.abs (radius_range s l)))))).

Definition are_vectors_known (s : vectors) : bool :=
  forallb (fun u => is_known (evaluate [] (fst u)) && is_known (evaluate [] (snd u))) (components s)
  && forallb (fun u => is_known (evaluate [] (fst u))) (balls s).

Lemma closed_value e : is_known (evaluate [] e) = true -> defined [] e.
Proof.
  intros E. destruct (evaluate [] e) as [v|] eqn:V; [|discriminate].
  exact (proj1 (Threshold.threshold_known _ _ V)).
Qed.

Lemma are_vectors_known_correct s : are_vectors_known s = true -> vectors_defined s /\
  Forall (fun e => is_known (evaluate [] e) = true) (map fst (components s)) /\
  Forall (fun e => is_known (evaluate [] e) = true) (map snd (components s)) /\
  Forall (fun e => is_known (evaluate [] e) = true) (map fst (balls s)).
Proof.
  unfold are_vectors_known. intros H. apply andb_prop in H as [H1 H2].
  rewrite forallb_forall in H1, H2. split; [split|split; [|split]]; rewrite Forall_forall.
  - intros u M. specialize (H1 u M). apply andb_prop in H1 as [A B].
    split; apply closed_value; assumption.
  - intros u M. apply closed_value, H2, M.
  - intros e M. apply in_map_iff in M as (u & <- & M). specialize (H1 u M).
    apply andb_prop in H1 as [A _]. exact A.
  - intros e M. apply in_map_iff in M as (u & <- & M). specialize (H1 u M).
    apply andb_prop in H1 as [_ A]. exact A.
  - intros e M. apply in_map_iff in M as (u & <- & M). exact (H2 u M).
Qed.

Lemma range_over_correct t s g c w : in_unit_box t -> are_vectors_known s = true ->
  (forall k, (k < length (components s))%nat -> form_encloses t (g k) (c k)) ->
  in_vectors s w -> encloses (range_over s g) (sum (length (components s)) (fun k => c k * w k)).
Proof.
  intros T K G (d & v & D & V & W). apply are_vectors_known_correct in K as (_ & K1 & K2 & K3).
  set (n := length (components s)) in *. unfold range_over. fold n.
  set (middle := value_of [] (map fst (components s))) in *.
  set (spread := value_of [] (map snd (components s))) in *.
  set (part := fun l k => if is_member k (snd (nth l (balls s) (no_entry, []))) then 1 else 0).
  set (radius := fun l => value [] (fst (nth l (balls s) (no_entry, [])))).
  set (b := length (balls s)) in *.
  set (x := sum n (fun k => Rabs (c k) * spread k)
            + sum b (fun l => sqrt (sum n (fun k => part l k * (Rabs (c k) * Rabs (c k))))
                              * Rabs (radius l))).
  assert (part_cases : forall l k, part l k = 0 \/ part l k = 1).
  { intros l k. unfold part. destruct is_member; auto. }
  replace (sum n (fun k => c k * w k)) with
    (sum n (fun k => middle k * c k)
     + (sum n (fun k => c k * d k) + sum b (fun l => sum n (fun k => part l k * (c k * v l k))))).
  2: { rewrite (sum_swap b n), <- !sum_plus. apply sum_ext. intros k H. rewrite (W k H).
       fold (middle k). rewrite (sum_ext b _ (fun l => c k * (part l k * v l k)))
         by (intros; ring).
       rewrite sum_scale. fold b. unfold part. ring. }
  apply add_encloses.
  - apply (form_range_encloses t); [exact T|]. apply form_sum_encloses. intros k H.
    apply scale_form_encloses; [|apply G, H].
    apply bound_of_limit; [rewrite map_size; exact H|exact K1].
  - apply (spread_encloses _ x).
    + apply add_encloses.
      * apply interval_sum_encloses. intros k H. apply multiply_encloses.
        { apply absolute_encloses, (form_range_encloses t); [exact T|apply G, H]. }
        apply bound_of_limit; [rewrite map_size; exact H|exact K2].
      * apply interval_sum_encloses. intros l H. apply multiply_encloses.
        { apply sqrt_encloses, interval_sum_encloses. intros k Hk. unfold part.
          destruct is_member.
          - rewrite Rmult_1_l. apply square_encloses, absolute_encloses, (form_range_encloses t);
              [exact T|apply G, Hk].
          - rewrite Rmult_0_l. exact (integer_encloses 0). }
        apply absolute_encloses. unfold radius_range.
        replace (radius l) with (value_of [] (map fst (balls s)) l).
        { apply bound_of_limit; [rewrite map_size; exact H|exact K3]. }
        unfold value_of, radius.
        rewrite (nth_indep _ no_entry (fst (no_entry, @nil nat)))
          by (rewrite map_size; exact H).
        rewrite (map_nth fst). reflexivity.
    + eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat.
      * eapply Rle_trans; [apply sum_abs|]. apply sum_le. intros k H. rewrite Rabs_mult.
        apply Rmult_le_compat_l; [apply Rabs_pos|exact (D k H)].
      * eapply Rle_trans; [apply sum_abs|]. apply sum_le. intros l H.
        assert (S0 : 0 <= sum n (fun k => part l k * (Rabs (c k) * Rabs (c k)))).
        { rewrite <- (sum_zero n (fun _ => 0)) by reflexivity. apply sum_le. intros k _.
          pose proof (Rabs_pos (c k)). destruct (part_cases l k) as [->| ->]; nra. }
        apply root_bound; [exact S0|].
        pose proof (cauchy n (fun k => part l k * c k) (fun k => part l k * v l k)) as Q.
        cbv beta in Q.
        rewrite (sum_ext n (fun k => part l k * c k * (part l k * v l k))
          (fun k => part l k * (c k * v l k))) in Q
          by (intros k _; destruct (part_cases l k) as [->| ->]; ring).
        rewrite (sum_ext n (fun k => part l k * c k * (part l k * c k))
          (fun k => part l k * (Rabs (c k) * Rabs (c k)))) in Q.
        2: { intros k _. rewrite <- Rabs_mult, Rabs_pos_eq by nra.
             destruct (part_cases l k) as [->| ->]; ring. }
        rewrite (sum_ext n (fun k => part l k * v l k * (part l k * v l k))
          (fun k => part l k * (v l k * v l k))) in Q
          by (intros k _; destruct (part_cases l k) as [->| ->]; ring).
        eapply Rle_trans; [exact Q|]. apply Rmult_le_compat_l; [exact S0|exact (V l H)].
Qed.

(** ** The derivatives by the motors, over a tube *)

Fixpoint all_some {A} (l : list (option A)) : option (list A) :=
  match l with
  | [] => Some []
  | Some a :: l' => match all_some l' with Some r => Some (a :: r) | None => None end
  | None :: _ => None
  end.

Lemma all_some_nth {A} (l : list (option A)) : forall r d, all_some l = Some r ->
  length r = length l /\
  forall k, (k < length l)%nat -> nth k l None = Some (nth k r d).
Proof.
  induction l as [|[a|] l IH]; intros r d H; simpl in H; try discriminate.
  { injection H as <-. split; [reflexivity|]. intros k K. simpl in K. lia. }
  destruct (all_some l) as [r'|]; [|discriminate]. injection H as <-.
  destruct (IH r' d eq_refl) as [L N]. split; [simpl; f_equal; exact L|].
  intros [|k] K; simpl; [reflexivity|]. apply N. simpl in K. lia.
Qed.

Lemma columns_exist n (a : nat -> nat -> R) (rhs : nat -> nat -> R) d :
  full_column_rank n n a -> exists J : nat -> nat -> R,
  forall i k, (i < n)%nat -> (k < d)%nat ->
    sum n (fun j => a i j * J j k) = rhs i k.
Proof.
  intros F. induction d as [|d [J IH]]; [exists (fun _ _ => 0); lia|].
  destruct (solvable n a (fun i => rhs i d) F) as [y Y].
  exists (fun j k => if Nat.eqb k d then y j else J j k). intros i k I K.
  destruct (Nat.eqb_spec k d) as [->|D]; [exact (Y i I)|]. apply IH; [exact I|lia].
Qed.

Section Over_tube.
  Variables (c : closure) (full : nat) (motors : list nat).
  Let n := unknowns c.

  (** All names over the tube, as [bounds_of] has them. *)
  Definition names_over (t : tube) (b : box) : list (option enclosure) :=
    let vs := variables full (tube_box c t b) in
    tube_names c t (firstn (length b) vs) (length b)
      (fun i => form_of (nth (length b + i) vs None)).

  Definition slopes_over (t : tube) (b : box) : forms :=
    tabulate n n (fun i j =>
      form_of (nth i (nth j (entries c (length b) (names_over t b)) []) None)).

  (** The equations by one variable. *)
  Definition column_by (t : tube) (b : box) (v : nat) : list (option enclosure) :=
    let names := evaluate_definitions (names_over t b) (motor_definitions c (length b) v) in
    if forallb is_known names then map (evaluate names) (motor_expressions c (length b) v) else [].

  Definition is_column (l : list (option enclosure)) : bool :=
    forallb is_known l && Nat.eqb (length l) n.

  (** By motor, the derivatives of the unknowns. *)
  Definition rates_over (t : tube) (b : box) : option (list (list form)) :=
    let a := slopes_over t b in
    let k := left_inverse n n (midpoints a) in
    let columns := map (column_by t b) motors in
    if forallb is_column columns && forallb (fun v => Nat.ltb v (length b)) motors then
      all_some (map (fun l => solved n k a (map (fun e => negate_form (form_of e)) l)) columns)
    else None.

  (** The same tube about the axis, nearly as narrow as the configuration shows it to be. *)
  Definition narrowed (t : tube) (v : tube_bounds) : tube :=
    Tube (foot t) (axis_at t) (tilt t)
      (list_of n (fun i => Hint.towards (I.upper (departure n t v i)) (number (reach t) i))).

  Definition is_narrowed (t s : tube) (v : tube_bounds) : bool :=
    forallb (fun i =>
      is_not_positive (subtract (departure n t v i) (point (number (reach s) i)))) (seq 0 n).

  (** The narrower tube, if it holds. *)
  Fixpoint tightest (fuel : nat) (t : tube) (b : box) : tube :=
    match fuel, test_tube c full t b with
    | S fuel', Some v =>
        let s := narrowed t v in
        if is_narrowed t s v && is_tested c full s b then tightest fuel' s b else t
    | _, _ => t
    end.

  Definition form_of_rates (l : list (list form)) (j k : nat) : form := form_of_list (nth k l []) j.

  (** What encloses the matrix over a tube. *)
  Variable find : tube -> box -> option (nat -> nat -> form).

  (** A tube about the configurations as they are over this box, if they are shown to be in it. *)
  Fixpoint first_leading (candidates : list tube) (t : tube) (b : box) : option tube :=
    match candidates with
    | [] => None
    | u :: others => if leads c full b u t then Some u else first_leading others t b
    end.
  Definition refitted (t : tube) (b : box) : option tube :=
    match first_leading (Fit.narrow c full b t) t b with
    | Some u => Some (tightest 3 u b)
    | None => None
    end.

  (** The same tube, twice as wide. What is nearly as narrow as can be over a box may be too narrow
      for the test of a part of it, whose middle is another one. *)
  Definition loosened (t : tube) : tube :=
    let s := Fit.widened t (PrimFloat.add PrimFloat.one PrimFloat.one) in
    if forallb (fun i => is_not_positive
         (subtract (point (number (reach t) i)) (point (number (reach s) i)))) (seq 0 n)
    then s else t.

  Definition is_shown_over (good : (nat -> nat -> form) -> bool) (t : tube) (b : box) : bool :=
    if is_tested c full t b then match find t b with Some F => good F | None => false end
    else false.

  (** The property is shown over the tube, over a better one, or over each half of the box. With
      `&&` and `||` Coq would compute both sides. *)
  Fixpoint shown (good : (nat -> nat -> form) -> bool) (fuel : nat) (t : tube) (b : box) : bool :=
    let s := tightest 3 t b in
    if is_tested c full s b then
      if is_shown_over good s b then true
      else
        let better := refitted s b in
        if match better with Some u => is_shown_over good u b | None => false end then true
        else
          let u := loosened match better with Some u => u | None => s end in
          match fuel, largest_of (map (fun i => PrimFloat.sub (I.upper i) (I.lower i)) b) with
          | S fuel', Some k =>
              let p := I.midpoint (nth k b I.nai) in
              if shown good fuel' u (lower_part b k p) then shown good fuel' u (upper_part b k p)
              else false
          | _, _ => false
          end
    else false.

  (** ** Why it is right *)

  Section At_configuration.
    Variables (t : tube) (b : box) (v : tube_bounds) (x p : list R).
    Hypothesis tested : test_tube c full t b = Some v.
    Hypothesis B : in_box b x.
    Hypothesis P : in_tube n t x p.
    Let u i := nth i p 0 - axis t x i.
    Let U : inside n (reach_of t) u := distances_inside c t x p P.
    Let s := coordinate (tube_box c t b) (x ++ map u (seq 0 n)).
    Let T : in_unit_box s := coordinate_in_unit_box _ _ (in_tube_box c t b x B u U).

    Lemma names_over_known : known s (names_over t b) (names_at c x p).
    Proof.
      rewrite <- (beside_of n t x p (proj1 P)).
      exact (names_known c full t b x B u U).
    Qed.

    Lemma column_encloses k : (k < length x)%nat -> is_column (column_by t b k) = true ->
      forall i, (i < n)%nat ->
        derivable_pt_lim (fun s => equation_at c (put k s x) p i) (nth k x 0) (by_motor c x p k i)
        /\ form_encloses s (form_of (nth i (column_by t b k) None)) (by_motor c x p k i).
    Proof.
      intros K H i I. unfold is_column in H. apply andb_prop in H as [H1 H2].
      apply Nat.eqb_eq in H2. unfold column_by in *.
      set (names := evaluate_definitions (names_over t b) (motor_definitions c (length b) k)) in *.
      destruct (forallb is_known names) eqn:N; [|simpl in H2; lia].
      rewrite map_size in H2.
      assert (S : length b = length x) by apply B.
      pose proof (known_definitions s (motor_definitions c (length b) k) _ _ T names_over_known)
        as KN. fold names in KN.
      set (e := nth i (motor_expressions c (length b) k) no_entry).
      assert (Ie : In e (motor_expressions c (length b) k)) by (apply nth_In; rewrite H2; exact I).
      assert (Ke : is_known (evaluate names e) = true).
      { rewrite forallb_forall in H1. apply H1, in_map, Ie. }
      destruct (values_inside c full t b v x tested B u U) as (V1 & V2 & V3 & V4 & V5).
      fold n in V3, V4. unfold u in V3, V4. rewrite (beside_of n t x p (proj1 P)) in V3, V4.
      split.
      - apply is_derive_Reals. apply motor_is_derivative; try assumption; try exact (proj1 P).
        + apply (everything_known c full t b v tested).
        + rewrite <- S. eapply definitions_are_defined; [exact T|exact names_over_known|exact N].
        + rewrite <- S. exact (known_defined s names _ e T KN Ke).
      - rewrite (nth_indep _ None (evaluate names no_entry)) by (rewrite map_size, H2; exact I).
        rewrite (map_nth (evaluate names)). fold e. unfold by_motor. rewrite <- S. fold e.
        apply form_of_value; [exact T|exact KN].
    Qed.

    Lemma rates_over_correct l : rates_over t b = Some l ->
      exists J, has_rates motors c x p J /\
        forall j k, (j < n)%nat -> (k < length motors)%nat ->
          form_encloses s (form_of_rates l j k) (J j k).
    Proof.
      unfold rates_over. intros H.
      destruct (forallb is_column (map (column_by t b) motors)
                && forallb (fun v => Nat.ltb v (length b)) motors) eqn:C; [|discriminate].
      apply andb_prop in C as [C1 C2]. rewrite forallb_forall in C1, C2.
      set (a := slopes_over t b) in *. set (k0 := left_inverse n n (midpoints a)) in *.
      destruct (slopes_in_tube c full t b v x tested B p P) as [D F]. fold n in D, F.
      set (A := slopes_at c t x (fun i => nth i p 0 - axis t x i)) in *.
      assert (AE : forall i j, (i < n)%nat -> (j < n)%nat ->
                form_encloses s (form_at a i j) (A i j)).
      { intros i j I J. exact (proj2 (partial_in_columns c full t b v x tested B u U i j I J)). }
      destruct (columns_exist n A (fun i k => - by_motor c x p (nth k motors O) i)
        (length motors) F) as [J HJ].
      assert (Col : forall k, (k < length motors)%nat ->
                is_column (column_by t b (nth k motors O)) = true /\
                (nth k motors O < length x)%nat).
      { intros k K. split.
        - apply C1, in_map, nth_In, K.
        - rewrite <- (proj1 B). apply Nat.ltb_lt, C2, nth_In, K. }
      exists J. split.
      - exists A, (fun i k => by_motor c x p (nth k motors O) i).
        split; [exact (conj D F)|]. split; [|exact HJ].
        intros i k I K w. destruct (Col k K) as [C3 C4].
        exact (proj1 (column_encloses _ C4 C3 i I)).
      - intros j k Hj K. destruct (all_some_nth _ l [] H) as [_ N].
        rewrite !map_size in N. specialize (N k K).
        rewrite map_map in N.
        rewrite (nth_indep _ None ((fun v => solved n k0 a
          (map (fun e => negate_form (form_of e)) (column_by t b v))) O)) in N
          by (rewrite map_size; exact K).
        rewrite (map_nth (fun v => solved n k0 a
          (map (fun e => negate_form (form_of e)) (column_by t b v)))) in N.
        destruct (Col k K) as [C3 C4].
        refine (solved_correct s n a _ A (fun i => - by_motor c x p (nth k motors O) i) T AE _ k0
          (nth k l []) (fun j => J j k) N _ j Hj).
        + intros i I. unfold form_of_list.
          rewrite (nth_indep _ _ (negate_form (form_of None))).
          2: { rewrite map_size. apply andb_prop in C3 as [_ C3]. apply Nat.eqb_eq in C3. lia. }
          rewrite (map_nth (fun e => negate_form (form_of e))).
          apply negate_form_encloses. exact (proj2 (column_encloses _ C4 C3 i I)).
        + intros i I. exact (HJ i k I K).
    Qed.
  End At_configuration.

  Lemma tightest_holds fuel b x p : in_box b x -> solves c x p -> forall t,
    in_tube n t x p -> in_tube n (tightest fuel t b) x p.
  Proof.
    intros B S. induction fuel as [|fuel IH]; intros t P; [exact P|]. simpl.
    destruct (test_tube c full t b) as [v|] eqn:V; [|exact P].
    destruct (is_narrowed t (narrowed t v) v && is_tested c full (narrowed t v) b) eqn:N;
      [|exact P].
    apply andb_prop in N as [N1 N2]. apply IH.
    split; [apply P|]. intros i I.
    destruct (solution_within c full t b v x V B i I) as (d & De & Q & _).
    rewrite <- (only_solution c full t b v x V B p P S) in Q.
    unfold is_narrowed in N1. rewrite forallb_forall in N1.
    specialize (N1 i ltac:(apply in_seq; fold n in I; lia)).
    pose proof (is_not_positive_correct _ _ N1 (subtract_encloses _ _ _ _ De (point_encloses _))).
    change (axis (narrowed t v) x i) with (axis t x i). lra.
  Qed.

  Variables (has : list R -> list R -> (nat -> nat -> R) -> Prop)
    (valid : (nat -> nat -> R) -> Prop) (d : nat).
  Hypothesis found : forall t b v x p F, test_tube c full t b = Some v -> in_box b x ->
    in_tube n t x p -> find t b = Some F ->
    exists J s, has x p J /\ valid J /\ in_unit_box s /\
      forall j k, (j < n)%nat -> (k < d)%nat -> form_encloses s (F j k) (J j k).
  Variables (good : (nat -> nat -> form) -> bool) (holds : (nat -> nat -> R) -> Prop).
  Hypothesis good_holds : forall s F J, in_unit_box s -> valid J ->
    (forall j k, (j < n)%nat -> (k < d)%nat -> form_encloses s (F j k) (J j k)) ->
    good F = true -> holds J.

  Lemma refitted_holds t b v x p u : test_tube c full t b = Some v -> in_box b x ->
    in_tube n t x p -> solves c x p -> refitted t b = Some u -> in_tube n u x p.
  Proof.
    intros V B P S. unfold refitted.
    destruct (first_leading (Fit.narrow c full b t) t b) as [w|] eqn:F; [|discriminate].
    intros E. replace u with (tightest 3 w b) by congruence. clear E.
    apply tightest_holds; [exact B|exact S|].
    revert F. induction (Fit.narrow c full b t) as [|y l IH]; simpl; [discriminate|].
    destruct (leads c full b y t) eqn:L; [|exact IH]. intros [= <-].
    pose proof L as W. unfold leads, leads_to in W.
    destruct (test_tube c full y b) as [z|] eqn:Z; [clear W|discriminate].
    pose proof (solution_in_tube c full y b z x Z B) as Q.
    rewrite (only_solution c full t b v x V B p P S).
    rewrite <- (leads_correct c full b y t v x _ L B Q
      (tube_solution_solves c full y b z x Z B) b V B).
    exact Q.
  Qed.

  Lemma loosened_holds t x p : in_tube n t x p -> in_tube n (loosened t) x p.
  Proof.
    unfold loosened. intros P. destruct forallb eqn:F; [|exact P]. rewrite forallb_forall in F.
    split; [apply P|]. intros i I. specialize (F i ltac:(apply in_seq; lia)).
    pose proof (is_not_positive_correct _ _ F
      (subtract_encloses _ _ _ _ (point_encloses _) (point_encloses _))).
    pose proof (proj2 P i I) as D.
    set (two := PrimFloat.add PrimFloat.one PrimFloat.one) in *.
    change (axis (Fit.widened t two) x i) with (axis t x i). lra.
  Qed.

  Lemma is_shown_over_correct t b x p : is_shown_over good t b = true -> in_box b x ->
    in_tube n t x p -> exists J, has x p J /\ holds J.
  Proof.
    unfold is_shown_over, is_tested. intros H B P.
    destruct (test_tube c full t b) as [v|] eqn:V; [|discriminate].
    destruct (find t b) as [F|] eqn:E; [|discriminate].
    destruct (found t b v x p F V B P E) as (J & u & HJ & K & U & N).
    exists J. split; [exact HJ|]. exact (good_holds u F J U K N H).
  Qed.

  Lemma shown_correct fuel x p : solves c x p -> forall t b,
    shown good fuel t b = true -> in_box b x -> in_tube n t x p ->
    exists J, has x p J /\ holds J.
  Proof.
    intros S. induction fuel as [|fuel IH]; intros t b H B P;
      pose proof (tightest_holds 3 b x p B S t P) as P1;
      cbn [shown] in H; cbv zeta in H; set (s := tightest 3 t b) in *;
      destruct (is_tested c full s b) eqn:H1; try discriminate;
      (destruct (is_shown_over good s b) eqn:G;
        [exact (is_shown_over_correct s b x p G B P1)|]);
      unfold is_tested in H1; destruct (test_tube c full s b) as [v|] eqn:V; try discriminate;
      destruct (refitted s b) as [u|] eqn:R.
    all: try (pose proof (refitted_holds s b v x p u V B P1 S R) as P2;
      destruct (is_shown_over good u b) eqn:G2;
        [exact (is_shown_over_correct u b x p G2 B P2)|]).
    all: try discriminate.
    all: destruct largest_of as [k|]; [|discriminate];
      destruct (shown good fuel _ (lower_part _ _ _)) eqn:HL; [|discriminate];
      destruct (parts_cover b x k (I.midpoint (nth k b I.nai)) B) as [D|D].
    - exact (IH _ _ HL D (loosened_holds u x p P2)).
    - exact (IH _ _ H D (loosened_holds u x p P2)).
    - exact (IH _ _ HL D (loosened_holds s x p P1)).
    - exact (IH _ _ H D (loosened_holds s x p P1)).
  Qed.
End Over_tube.

(** ** What a claim is about: a matrix, and what encloses it over a tube *)

Definition finder : Type := closure -> nat -> tube -> box -> option (nat -> nat -> form).

(** [valid n] is true of all matrices [has] for n unknowns; they have [width n] columns. *)
Definition finds (has : matrix_at) (valid : nat -> (nat -> nat -> R) -> Prop) (width : nat -> nat)
    (find : finder) : Prop :=
  forall c full t b v x p F, test_tube c full t b = Some v -> in_box b x ->
    in_tube (unknowns c) t x p -> find c full t b = Some F ->
    exists J s, has c x p J /\ valid (unknowns c) J /\ in_unit_box s /\
      forall j k, (j < unknowns c)%nat -> (k < width (unknowns c))%nat ->
        form_encloses s (F j k) (J j k).

Lemma place_in_unit_box c t b x p : in_box b x -> in_tube (unknowns c) t x p ->
  in_unit_box (coordinate (tube_box c t b)
    (x ++ map (fun i => nth i p 0 - axis t x i) (seq 0 (unknowns c)))).
Proof.
  intros B P. apply coordinate_in_unit_box, in_tube_box; [exact B|].
  exact (distances_inside c t x p P).
Qed.

Definition find_rates (motors : list nat) : finder := fun c full t b =>
  option_map form_of_rates (rates_over c full motors t b).

Lemma find_rates_correct motors :
  finds (has_rates motors) (fun _ _ => True) (fun _ => length motors) (find_rates motors).
Proof.
  intros c full t b v x p F V B P E. unfold find_rates in E.
  destruct (rates_over c full motors t b) as [l|] eqn:R; [|discriminate]. injection E as <-.
  destruct (rates_over_correct c full motors t b v x p V B P l R) as (J & HJ & N).
  eexists J, _. split; [exact HJ|]. split; [exact Logic.I|].
  split; [exact (place_in_unit_box c t b x p B P)|exact N].
Qed.

Definition find_slopes : finder := fun c full t b => Some (form_at (slopes_over c full t b)).

Lemma find_slopes_correct :
  finds has_slopes (fun n => full_column_rank n n) (fun n => n) find_slopes.
Proof.
  intros c full t b v x p F V B P E. injection E as <-.
  destruct (slopes_in_tube c full t b v x V B p P) as [D R].
  exists (slopes_at c t x (fun i => nth i p 0 - axis t x i)). eexists.
  split; [exact (conj D R)|]. split; [exact R|].
  split; [exact (place_in_unit_box c t b x p B P)|]. intros i j I J.
  exact (proj2 (partial_in_columns c full t b v x V B _ (distances_inside c t x p P) i j I J)).
Qed.

(** ** The checks *)

(** [good F] is a reason for [holds J], where the forms F enclose the matrix J. *)
Definition is_reason (valid : (nat -> nat -> R) -> Prop) (n d : nat)
    (good : (nat -> nat -> form) -> bool) (holds : (nat -> nat -> R) -> Prop) : Prop :=
  forall s F J, in_unit_box s -> valid J ->
    (forall j k, (j < n)%nat -> (k < d)%nat -> form_encloses s (F j k) (J j k)) ->
    good F = true -> holds J.

Section Checked.
Variables (has : matrix_at) (valid : nat -> (nat -> nat -> R) -> Prop) (width : nat -> nat).
Variable find : finder.
Hypothesis found : finds has valid width find.

(** The tubes over the parts of w are linked as for [one_branch_in], and the property is shown over
    each tube that is over the parts of v. *)
Definition check_over_in (halvings : nat) (good : (nat -> nat -> form) -> bool) (c : closure)
    (w v : parts) (m : method) (g : tubes) : bool :=
  let full := second_order m in
  match enclose_values (start c), enclose_values (map fst (near c)),
        enclose_values (map snd (near c)), enclose_ranges (ranges (places c)) with
  | Some b, Some middles, Some radii, Some root =>
      let around := around_start c middles radii (length b) in
      let h := refined c full (deepest m) g in
      check_branch_in c full around (tight_start c full b around) w h
      && holds_in (shown c full (find c full) good halvings) v h root
  | _, _, _, _ => false
  end.

Lemma check_over_in_correct halvings good (holds : (nat -> nat -> R) -> Prop) c w v m g :
  is_reason (valid (unknowns c)) (unknowns c) (width (unknowns c)) good holds ->
  check_over_in halvings good c w v m g = true -> over_branch_in w v has holds c.
Proof.
  intros G. unfold check_over_in. destruct (enclose_values (start c)) as [b|]; [|discriminate].
  destruct (enclose_values (map fst (near c))) as [middles|]; [|discriminate].
  destruct (enclose_values (map snd (near c))) as [radii|]; [|discriminate].
  destruct (enclose_ranges (ranges (places c))) as [root|] eqn:R; [|discriminate].
  set (full := second_order m). set (h := refined c full (deepest m) g). intros H.
  apply andb_prop in H as [H1 H2].
  apply check_branch_holds in H1 as (Gi & K & root' & R' & Ct & Br & _). rewrite R in R'.
  injection R' as <-. split; [exact Gi|]. split; [exact K|].
  exists (configuration c full h root). split; [exact Br|].
  intros x X _ W. assert (B : in_box root x) by (eapply enclose_ranges_correct; [exact R|apply X]).
  destruct (held_in_part c full _ h v root x Ct H2 B X W)
    as (_ & t & b' & u & _ & B' & V & E & Sh).
  rewrite E. refine (shown_correct c full (find c full) (has c) _ _ (found c full) good holds G
    halvings x _ _ t b' Sh B' _).
  - exact (tube_solution_solves c full t b' u x V B').
  - exact (solution_in_tube c full t b' u x V B').
Qed.

(** The same along a way. *)
Definition holds_along (f : closure -> tube -> box -> bool) (vs : list parts) (l : list stretch) :
    bool :=
  Nat.eqb (length vs) (length l)
  && forallb (fun u => let s := snd u in holds_in (f (mechanism s)) (fst u) (tree s) (root s))
       (combine vs l).

Definition check_over_along_in (halvings : nat) (good : (nat -> nat -> form) -> bool)
    (c : list expression -> closure) (pieces : list (list expression)) (ws vs : list parts)
    (m : method) (gs : list tubes) : bool :=
  let full := second_order m in
  match stretches full (deepest m) (map c pieces) ws gs with
  | Some l =>
      check_stretches full l
      && holds_along (fun c => shown c full (find c full) good halvings) vs l
  | None => false
  end.

Lemma holds_along_correct f vs l k s : holds_along f vs l = true -> nth_error l k = Some s ->
  holds_in (f (mechanism s)) (nth k vs LeftOut) (tree s) (root s) = true.
Proof.
  unfold holds_along. intros H N. apply andb_prop in H as [L H]. apply Nat.eqb_eq in L.
  rewrite forallb_forall in H. apply (H (nth k vs LeftOut, s)).
  rewrite <- (nth_error_nth l k s N), <- combine_nth by exact L. apply nth_In.
  rewrite combine_size, L, Nat.min_id. apply nth_error_Some. congruence.
Qed.

Lemma check_over_along_in_correct halvings good (holds : (nat -> nat -> R) -> Prop) c pieces ws vs
    m gs :
  let n := unknowns_along c pieces in
  is_reason (valid n) n (width n) good holds ->
  check_over_along_in halvings good c pieces ws vs m gs = true ->
  over_branch_along_in ws vs has holds c pieces.
Proof.
  intros n G. unfold check_over_along_in. set (full := second_order m).
  destruct (stretches full (deepest m) (map c pieces) ws gs) as [l|] eqn:L; [|discriminate].
  apply stretches_correct in L as (M & Kw & E). intros H. apply andb_prop in H as [H1 H2].
  apply (check_stretches_correct _ _ E) in H1 as (W & S & B & others & size & K & Li).
  assert (U : forall s, In s l -> unknowns (mechanism s) = unknowns_along c pieces).
  { unfold unknowns_along. rewrite <- M. intros s I.
    rewrite (has_unknowns _ _ _ s (are_pieces full l others size E K s I)).
    destruct l as [|s0 l0]; [destruct I|]. simpl. symmetry.
    exact (has_unknowns _ _ _ s0 (are_pieces full _ others size E K s0 (or_introl eq_refl))). }
  unfold over_branch_along_in. rewrite <- M, <- Kw. split; [exact W|]. split; [exact S|].
  exists (along full 0 l). split; [exact B|]. intros x k d D Dv.
  apply piece_of in D as (s & N & <- & In_s & Ks).
  destruct (along_in_part full l others size E K Li _ _ x k s N In_s Ks
              (holds_along_correct _ vs l k s H2 N) Dv)
    as (t & b & v & _ & Bx & _ & V & -> & Sh).
  unfold n in G. rewrite <- (U s (nth_error_In _ _ N)) in G.
  refine (shown_correct (mechanism s) full (find (mechanism s) full) (has (mechanism s)) _ _
    (found (mechanism s) full) good holds G halvings _ _ _ t b Sh Bx _).
  - exact (tube_solution_solves (mechanism s) full t b v _ V Bx).
  - exact (solution_in_tube (mechanism s) full t b v _ V Bx).
Qed.

(** The whole set is kept. *)
Lemma over_whole_branch holds c : over_branch_in Kept Kept has holds c -> over_branch has holds c.
Proof.
  intros (G & _ & p & B & H). split; [exact G|]. exists p. split.
  - revert B. apply is_branch_among_fewer. intros x X. exact (conj X Logic.I).
  - intros x X. exact (H x X Logic.I Logic.I).
Qed.

Lemma over_whole_way holds c pieces :
  over_branch_along_in (all_kept pieces) (all_kept pieces) has holds c pieces ->
  over_branch_along has holds c pieces.
Proof.
  intros (W & _ & p & B & H). split; [exact W|]. exists p.
  split; [exact (branch_of_all_kept c pieces p B)|]. intros x k d O.
  apply (on_all_kept c pieces) in O. exact (H x k d O (proj2 O)).
Qed.
End Checked.

Definition most_halvings : nat := 12.

(** What w is multiplied by in the measure. *)
Definition part_of (d : nat) (F : nat -> nat -> form) (q : measured) (k : nat) : form :=
  match q with
  | Force i => F k i
  | Motion i => F i k
  | Deflection i c =>
      let stiffness := bounds_of_limits c in
      form_sum d (fun l => scale_form (divide one (nth l stiffness I.nai))
        (multiply_forms (F i l) (F k l)))
  end.

Definition is_fitting (n d : nat) (q : measured) (s : vectors) : bool :=
  match q with
  | Force k => Nat.ltb k d && Nat.eqb (length (components s)) n
  | Motion i => Nat.ltb i n && Nat.eqb (length (components s)) d
  | Deflection i c => Nat.ltb i n && Nat.eqb (length (components s)) n && Nat.eqb (length c) d
      && forallb (fun e => is_positive (range_or_none (evaluate [] e))) c
  end.

Lemma positive_value e : is_positive (range_or_none (evaluate [] e)) = true ->
  defined [] e /\ 0 < value [] e.
Proof.
  intros P. destruct (evaluate [] e) as [v|] eqn:V; [|discriminate].
  destruct (Threshold.threshold_known _ _ V) as [D E].
  exact (conj D (is_positive_correct _ _ P E)).
Qed.

Lemma is_fitting_correct n d q s : is_fitting n d q s = true -> fits n d q s.
Proof.
  destruct q; simpl; intros H.
  1, 2: apply andb_prop in H as [H1 H2]; split; [apply Nat.ltb_lt, H1|apply Nat.eqb_eq, H2].
  apply andb_prop in H as [H P]. apply andb_prop in H as [H L]. apply andb_prop in H as [H M].
  split; [apply Nat.ltb_lt, H|]. split; [apply Nat.eqb_eq, M|]. split; [apply Nat.eqb_eq, L|].
  apply Forall_forall. intros e E. rewrite forallb_forall in P. apply positive_value, P, E.
Qed.

Lemma measured_encloses t n d q s F J w : in_unit_box t -> are_vectors_known s = true ->
  is_fitting n d q s = true ->
  (forall j k, (j < n)%nat -> (k < d)%nat -> form_encloses t (F j k) (J j k)) ->
  in_vectors s w -> encloses (range_over s (part_of d F q)) (measure n d J q w).
Proof.
  intros T K Q E W. pose proof (is_fitting_correct _ _ _ _ Q) as Fit.
  destruct q as [i|i|i c]; simpl in Fit.
  1, 2: destruct Fit as [I L]; simpl; rewrite <- L;
    refine (range_over_correct t s _ _ w T K _ W); intros k Hk; apply E; lia.
  destruct Fit as (I & L & M & P). simpl in Q. apply andb_prop in Q as [_ Q].
  rewrite forallb_forall in Q. simpl.
  replace (sum d (fun k => J i k * (sum n (fun j => J j k * w j) / value_of [] c k)))
    with (sum (length (components s)) (fun j =>
      sum d (fun k => 1 / value_of [] c k * (J i k * J j k)) * w j)).
  - refine (range_over_correct t s _ _ w T K _ W). intros j Hj. apply form_sum_encloses.
    intros k Hk. apply scale_form_encloses.
    + apply divide_encloses; [|exact (integer_encloses 1)|].
      * rewrite Forall_forall in P. unfold value_of.
        destruct (P (nth k c no_entry)) as [_ N]; [apply nth_In; lia|lra].
      * apply bound_of_limit; [lia|]. apply Forall_forall. intros e He. specialize (Q e He).
        destruct (evaluate [] e); [reflexivity|discriminate].
    + apply multiply_forms_enclose; [exact T| |]; apply E; lia.
  - rewrite L. rewrite (sum_ext n _ (fun j =>
      sum d (fun k => J i k * (J j k * w j / value_of [] c k)))).
    2: { intros j _. rewrite Rmult_comm, <- sum_scale. apply sum_ext. intros k _.
         unfold Rdiv. ring. }
    rewrite sum_swap. apply sum_ext. intros k _. rewrite sum_scale. f_equal.
    unfold Rdiv at 2. rewrite (Rmult_comm (sum n _)), <- sum_scale. apply sum_ext. intros j _.
    unfold Rdiv. ring.
Qed.

Inductive side := Within | Below | Above | Beyond.

Definition obeys (s : side) (i limit : interval) : bool :=
  match s with
  | Within => is_negative (subtract (I.abs i) limit)
  | Below => is_negative (subtract i limit)
  | Above => is_positive (subtract i limit)
  | Beyond => is_positive (subtract (I.abs i) limit)
  end.

(** [tests good] shows [over holds], if good F is a reason for holds J where F encloses J. *)
Definition shows (tests : ((nat -> nat -> form) -> bool) -> bool)
    (over : ((nat -> nat -> R) -> Prop) -> Prop) (valid : (nat -> nat -> R) -> Prop) (n d : nat) :
    Prop :=
  forall good holds, is_reason valid n d good holds -> tests good = true -> over holds.

Definition check_measure_over (which : side) (tests : ((nat -> nat -> form) -> bool) -> bool)
    (n d : nat) (q : measured) (s : vectors) (limit : expression) : bool :=
  is_fitting n d q s && are_vectors_known s && is_known (evaluate [] limit)
  && tests (fun F =>
       obeys which (range_over s (part_of d F q)) (range_or_none (evaluate [] limit))).

Section Measures.
  Variables (tests : ((nat -> nat -> form) -> bool) -> bool)
    (over : ((nat -> nat -> R) -> Prop) -> Prop) (n d : nat).
  Hypothesis shown_over : shows tests over (fun _ => True) n d.

  Lemma check_measure_over_correct which (bound : R -> Prop) q s limit :
    (forall i y, obeys which i (range_or_none (evaluate [] limit)) = true -> encloses i y ->
       encloses (range_or_none (evaluate [] limit)) (value [] limit) -> bound y) ->
    check_measure_over which tests n d q s limit = true ->
    defined [] limit /\ is_bounded_over over n d bound q s.
  Proof.
    intros O H. unfold check_measure_over in H.
    apply andb_prop in H as [H C]. apply andb_prop in H as [H L]. apply andb_prop in H as [Q K].
    split; [exact (closed_value _ L)|].
    split; [exact (is_fitting_correct _ _ _ _ Q)|].
    split; [apply are_vectors_known_correct, K|].
    refine (shown_over _ _ _ C). intros t F J T _ E G w W.
    apply (O _ _ G); [exact (measured_encloses t _ _ q s F J w T K Q E W)|].
    destruct (evaluate [] limit) as [v|] eqn:V; [|discriminate].
    exact (proj2 (Threshold.threshold_known _ _ V)).
  Qed.

  Lemma check_within_over q s limit : check_measure_over Within tests n d q s limit = true ->
    is_within_over over n d q s limit.
  Proof.
    apply check_measure_over_correct. intros i y H Y L.
    pose proof (is_negative_correct _ _ H (subtract_encloses _ _ _ _ (absolute_encloses _ _ Y) L)).
    lra.
  Qed.

  Lemma check_below_over q s limit : check_measure_over Below tests n d q s limit = true ->
    is_below_over over n d q s limit.
  Proof.
    apply check_measure_over_correct. intros i y H Y L.
    pose proof (is_negative_correct _ _ H (subtract_encloses _ _ _ _ Y L)). lra.
  Qed.

  Lemma check_above_over q s limit : check_measure_over Above tests n d q s limit = true ->
    is_above_over over n d q s limit.
  Proof.
    apply check_measure_over_correct. intros i y H Y L.
    pose proof (is_positive_correct _ _ H (subtract_encloses _ _ _ _ Y L)). lra.
  Qed.
End Measures.

Definition check_limits_over (tests : ((nat -> nat -> form) -> bool) -> bool) (n d : nat)
    (load : vectors) (limits : list (expression * expression)) : bool :=
  Nat.eqb (length (components load)) n
  && Nat.eqb (length limits) d && are_vectors_known load
  && forallb (fun l => is_known (evaluate [] (fst l)) && is_known (evaluate [] (snd l))) limits
  && tests (fun F => forallb (fun k =>
       let i := range_over load (part_of d F (Force k)) in
       is_not_negative (subtract i (nth k (bounds_of_limits (map fst limits)) I.nai))
       && is_not_positive (subtract i (nth k (bounds_of_limits (map snd limits)) I.nai)))
       (seq 0 d)).

Lemma check_limits_over_correct tests over n d load limits :
  shows tests over (fun _ => True) n d ->
  check_limits_over tests n d load limits = true -> keeps_limits_over over n d load limits.
Proof.
  unfold check_limits_over. intros S H.
  apply andb_prop in H as [H C]. apply andb_prop in H as [H L]. apply andb_prop in H as [H K].
  apply andb_prop in H as [A D]. apply Nat.eqb_eq in A, D. rewrite forallb_forall in L.
  split; [exact A|]. split; [exact D|]. split; [apply are_vectors_known_correct, K|]. split.
  { apply Forall_forall. intros l In_l. specialize (L l In_l). apply andb_prop in L as [L1 L2].
    split; apply closed_value; assumption. }
  refine (S _ _ _ C). intros t F J T _ E G w W k Hk.
  rewrite forallb_forall in G. specialize (G k ltac:(apply in_seq; lia)). cbv zeta in G.
  apply andb_prop in G as [G1 G2].
  assert (Q : is_fitting n d (Force k) load = true).
  { simpl. rewrite A, Nat.eqb_refl. apply Nat.ltb_lt in Hk. rewrite Hk. reflexivity. }
  pose proof (measured_encloses t _ _ (Force k) load F J w T K Q E W) as R.
  assert (N : forall f : expression * expression -> expression,
             (forall l, In l limits -> is_known (evaluate [] (f l)) = true) ->
             encloses (nth k (bounds_of_limits (map f limits)) I.nai)
               (value_of [] (map f limits) k)).
  { intros f Hf. apply bound_of_limit; [rewrite map_size, D; exact Hk|].
    apply Forall_forall. intros e In_e. apply in_map_iff in In_e as (l & <- & In_l).
    exact (Hf l In_l). }
  split.
  - apply Rminus_le_0. refine (is_not_negative_correct _ _ G1 (subtract_encloses _ _ _ _ R _)).
    apply N. intros l In_l. specialize (L l In_l). apply andb_prop in L as [L1 _]. exact L1.
  - apply Rminus_le. refine (is_not_positive_correct _ _ G2 (subtract_encloses _ _ _ _ R _)).
    apply N. intros l In_l. specialize (L l In_l). apply andb_prop in L as [_ L2]. exact L2.
Qed.

(** How a matrix is tested over the ranges of one mechanism, along the pieces of a way, and in the
    parts of a paving. *)
Definition over_ranges find c m g good : bool :=
  check_over_in find most_halvings good c Kept Kept m g.
Definition over_way find c pieces m gs good : bool :=
  check_over_along_in find most_halvings good c pieces (all_kept pieces) (all_kept pieces) m gs.
Definition over_parts find c w v m g good : bool :=
  check_over_in find most_halvings good c w v m g.
Definition over_parts_of_way find c pieces ws vs m gs good : bool :=
  check_over_along_in find most_halvings good c pieces ws vs m gs.

Section Shown.
  Variables (has : matrix_at) (valid : nat -> (nat -> nat -> R) -> Prop) (width : nat -> nat).
  Variable find : finder.
  Hypothesis found : finds has valid width find.

  Lemma shown_over_ranges c m g : shows (over_ranges find c m g) (fun P => over_branch has P c)
    (valid (unknowns c)) (unknowns c) (width (unknowns c)).
  Proof.
    intros good holds G H. apply over_whole_branch.
    exact (check_over_in_correct has valid width find found _ _ _ c Kept Kept m g G H).
  Qed.

  Lemma shown_over_way c pieces m gs : let n := unknowns_along c pieces in
    shows (over_way find c pieces m gs) (fun P => over_branch_along has P c pieces) (valid n) n
      (width n).
  Proof.
    intros n good holds G H. apply over_whole_way.
    exact (check_over_along_in_correct has valid width find found _ _ _ c pieces _ _ m gs G H).
  Qed.

  Lemma shown_over_parts c w v m g :
    shows (over_parts find c w v m g) (fun P => over_branch_in w v has P c)
      (valid (unknowns c)) (unknowns c) (width (unknowns c)).
  Proof.
    intros good holds G H.
    exact (check_over_in_correct has valid width find found _ _ _ c w v m g G H).
  Qed.

  Lemma shown_over_parts_of_way c pieces ws vs m gs : let n := unknowns_along c pieces in
    shows (over_parts_of_way find c pieces ws vs m gs)
      (fun P => over_branch_along_in ws vs has P c pieces) (valid n) n (width n).
  Proof.
    intros n good holds G H.
    exact (check_over_along_in_correct has valid width find found _ _ _ c pieces ws vs m gs G H).
  Qed.
End Shown.

Definition check_measure (which : side) c motors q s limit m g : bool :=
  check_measure_over which (over_ranges (find_rates motors) c m g) (unknowns c) (length motors) q s
    limit.
Definition check_branch_within_limits c motors load limits m g : bool :=
  check_limits_over (over_ranges (find_rates motors) c m g) (unknowns c) (length motors) load
    limits.

Section Ranges.
  Variables (c : closure) (motors : list nat).
  Let shown_over m g := shown_over_ranges _ _ _ _ (find_rates_correct motors) c m g.

  Theorem check_branch_within_correct q s limit m g :
    check_measure Within c motors q s limit m g = true -> branch_within c motors q s limit.
  Proof. exact (check_within_over _ _ _ _ (shown_over m g) q s limit). Qed.
  Theorem check_branch_below_correct q s limit m g :
    check_measure Below c motors q s limit m g = true -> branch_below c motors q s limit.
  Proof. exact (check_below_over _ _ _ _ (shown_over m g) q s limit). Qed.
  Theorem check_branch_above_correct q s limit m g :
    check_measure Above c motors q s limit m g = true -> branch_above c motors q s limit.
  Proof. exact (check_above_over _ _ _ _ (shown_over m g) q s limit). Qed.
  Theorem check_branch_within_limits_correct load limits m g :
    check_branch_within_limits c motors load limits m g = true ->
    branch_within_limits c motors load limits.
  Proof. exact (check_limits_over_correct _ _ _ _ load limits (shown_over m g)). Qed.
End Ranges.

Definition check_measure_along (which : side) c pieces motors q s limit m gs : bool :=
  check_measure_over which (over_way (find_rates motors) c pieces m gs) (unknowns_along c pieces)
    (length motors) q s limit.
Definition check_limits_along c pieces motors load limits m gs : bool :=
  check_limits_over (over_way (find_rates motors) c pieces m gs) (unknowns_along c pieces)
    (length motors) load limits.

Section Way.
  Variables (c : list expression -> closure) (pieces : list (list expression)).
  Variable motors : list nat.
  Let shown_over m gs := shown_over_way _ _ _ _ (find_rates_correct motors) c pieces m gs.

  Theorem check_branch_within_along_correct q s limit m gs :
    check_measure_along Within c pieces motors q s limit m gs = true ->
    branch_within_along c pieces motors q s limit.
  Proof. exact (check_within_over _ _ _ _ (shown_over m gs) q s limit). Qed.
  Theorem check_branch_below_along_correct q s limit m gs :
    check_measure_along Below c pieces motors q s limit m gs = true ->
    branch_below_along c pieces motors q s limit.
  Proof. exact (check_below_over _ _ _ _ (shown_over m gs) q s limit). Qed.
  Theorem check_branch_above_along_correct q s limit m gs :
    check_measure_along Above c pieces motors q s limit m gs = true ->
    branch_above_along c pieces motors q s limit.
  Proof. exact (check_above_over _ _ _ _ (shown_over m gs) q s limit). Qed.
  Theorem check_branch_within_limits_along_correct load limits m gs :
    check_limits_along c pieces motors load limits m gs = true ->
    branch_within_limits_along c pieces motors load limits.
  Proof. exact (check_limits_over_correct _ _ _ _ load limits (shown_over m gs)). Qed.
End Way.

(** Pavings. *)
Definition check_branch_within_limits_in c w v motors load limits m g : bool :=
  check_limits_over (over_parts (find_rates motors) c w v m g) (unknowns c) (length motors) load
    limits.
Definition check_branch_within_limits_along_in c pieces ws vs motors load limits m gs : bool :=
  check_limits_over (over_parts_of_way (find_rates motors) c pieces ws vs m gs)
    (unknowns_along c pieces) (length motors) load limits.

Theorem check_branch_within_limits_in_correct c w v motors load limits m g :
  check_branch_within_limits_in c w v motors load limits m g = true ->
  branch_within_limits_in c w v motors load limits.
Proof.
  exact (check_limits_over_correct _ _ _ _ load limits
    (shown_over_parts _ _ _ _ (find_rates_correct motors) c w v m g)).
Qed.

Theorem check_branch_within_limits_along_in_correct c pieces ws vs motors load limits m gs :
  check_branch_within_limits_along_in c pieces ws vs motors load limits m gs = true ->
  branch_within_limits_along_in c pieces ws vs motors load limits.
Proof.
  exact (check_limits_over_correct _ _ _ _ load limits
    (shown_over_parts_of_way _ _ _ _ (find_rates_correct motors) c pieces ws vs m gs)).
Qed.
