(* SPDX-License-Identifier: Apache-2.0 *)
(** |det A| beyond a threshold: the determinant of a box as a polynomial, by elimination. *)
From Coq Require Import Reals Lra Lia List PArith Bool.
From Coq Require PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Questions LinearAlgebra Determinants Intervals Forms.
From Regulus Require Import Evaluation Boxes Hints Regularity Search Singularity.
Import ListNotations.
Open Scope R_scope.

(** The column whose first entry is largest in the middle. Any column would do. *)
Definition pivot_of (a : forms) : nat :=
  match largest_of (map (fun f => PrimFloat.abs (I.midpoint (constant f))) (nth 0 a [])) with
  | Some p => p
  | None => O
  end.

Definition complement_forms (m p : nat) (inverse : form) (a : forms) : forms :=
  let factors := map (fun k => multiply_forms (form_at a 0 (skip p k)) inverse) (seq 0 m) in
  tabulate m m (fun i k =>
    subtract_forms (form_at a (S i) (skip p k))
      (multiply_forms (nth k factors (constant_form I.nai)) (form_at a (S i) p))).

(** None: no pivot that is not 0 was found. *)
Fixpoint determinant_form (n : nat) (a : forms) : option form :=
  match n with
  | O => Some (constant_form one)
  | S m =>
      let p := pivot_of a in
      let pivot := form_at a 0 p in
      let v := Enclosure (form_range pivot) pivot in
      if Nat.ltb p n && is_not_zero (range v) then
        match determinant_form m (complement_forms m p (polynomial (enclose_inverse v)) a) with
        | Some d =>
            let f := multiply_forms pivot d in Some (if Nat.even p then f else negate_form f)
        | None => None
        end
      else None
  end.

(** Multiples of row p are added to the others, which does not change the determinant. *)
Definition add_row (n : nat) (a : forms) (step : nat * list F.type) : forms :=
  let (p, factors) := step in
  if Nat.ltb p n then
    tabulate n n (fun i j =>
      if Nat.eqb i p then form_at a p j
      else add_forms (form_at a i j) (scale_form (point (nth i factors F.nan)) (form_at a p j)))
  else a.

(** First, the matrix in the middle of the box is made a diagonal one, up to the order of the
    rows: elimination then has small terms outside the diagonal. *)
Definition determinant_in_box (n : nat) (a : forms) : option form :=
  let middle := tabulate n n (midpoints a) in
  determinant_form n (fold_left (add_row n) (clearing n n [] 0 middle) a).

(** The forms of the scales and of the determinant, multiplied. *)
Definition product_form (d : form) (scales : list (option enclosure)) : form :=
  multiply_forms d (fold_right (fun s f => multiply_forms (form_of s) f) (constant_form one)
    scales).

Definition test_determinant (q : question) (scales : list expression) (threshold : expression)
    (m : method) (b : box) : answer :=
  let names := evaluate_definitions (variables (second_order m) b) (definitions q) in
  if existsb (is_excluded names) (constraints q) then Outside
  else
    let a := map (map (evaluate names)) (matrix q) in
    let s := map (evaluate names) scales in
    if is_model_known q names a && forallb is_known s then
      match determinant_in_box (columns q) (map (map form_of) a), evaluate [] threshold with
      | Some d, Some l =>
          let f := product_form d s in
          if is_positive (subtract (I.abs (form_range f)) (range l)) then Regular
          else Open (Attempt [[f]] [] [PrimFloat.one])
      | _, _ => Open (attempt_at (rows q) (columns q) (map (map form_of) a))
      end
    else Undefined.

Definition is_square (q : question) (threshold : expression) : bool :=
  Nat.eqb (rows q) (columns q) && is_known (evaluate [] threshold).

Definition check_determinant (q : question) (scales : list expression) (threshold : expression)
    (m : method) : bool :=
  is_square q threshold &&
  match enclose_ranges (ranges q) with
  | Some root =>
      match search (test_determinant q scales threshold m) root (deepest m) root with
      | Some _ => true
      | None => false
      end
  | None => false
  end.

Definition check_determinant_tree (q : question) (scales : list expression)
    (threshold : expression) (m : method) (t : tree) : bool :=
  is_square q threshold &&
  match enclose_ranges (ranges q) with
  | Some root => check_parts (test_determinant q scales threshold m) t root
  | None => false
  end.

(** A point at which the scaled determinant is at most the threshold. Coordinates that are not in
    their ranges are moved to the ends. *)
Definition check_point (q : question) (scales : list expression) (threshold : expression)
    (point : coordinates) : bool :=
  let a := map (fun u => clamp (fst u) (snd u)) (combine point (ranges q)) in
  let b := hull a a in
  let names := evaluate_definitions (variables 99 b) (definitions q) in
  let s := map (evaluate names) scales in
  let d := fold_right (fun s i => multiply (range_of s) i) (determinant_at q b) s in
  in_set_and_defined q b && forallb is_known s &&
  match evaluate [] threshold with
  | Some l => is_not_positive (subtract (I.abs d) (range l))
  | None => false
  end.

(** A segment on which the determinant is 0 somewhere. *)
Definition with_scales (q : question) (scales : list expression) : question :=
  Question (ranges q) (definitions q) (constraints q) (also_defined q ++ scales) (matrix q)
    (columns q).

Definition check_crossing (q : question) (scales : list expression) (threshold : expression)
    (a b : coordinates) : bool :=
  match evaluate [] threshold with
  | Some l => is_not_negative (range l) && check_singularity (with_scales q scales) a b
  | None => false
  end.

(** ** It is correct *)

Lemma complement_encloses t m p g a A : in_unit_box t -> (p < S m)%nat ->
  (forall i j, (i < S m)%nat -> (j < S m)%nat -> form_encloses t (form_at a i j) (A i j)) ->
  form_encloses t g (1 / A O p) -> forall i k, (i < m)%nat -> (k < m)%nat ->
  form_encloses t (form_at (complement_forms m p g a) i k) (complement p A i k).
Proof.
  intros T P H G i k I K. unfold complement_forms, complement.
  rewrite tabulate_at by assumption.
  assert (S : (skip p k < S m)%nat) by (unfold skip; destruct (k <? p)%nat; lia).
  apply subtract_forms_enclose; [apply H; lia|].
  apply multiply_forms_enclose; [exact T| |apply H; lia].
  rewrite (nth_indep _ _ (multiply_forms (form_at a 0 (skip p O)) g))
    by (rewrite map_size, seq_size; exact K).
  rewrite (map_nth (fun k => multiply_forms (form_at a 0 (skip p k)) g)), seq_nth by exact K.
  replace (A O (skip p k) / A O p) with (A O (skip p k) * (1 / A O p)) by (unfold Rdiv; ring).
  apply multiply_forms_enclose; [exact T|apply H; lia|exact G].
Qed.

Lemma power_of_minus_one p : (-1) ^ p = if Nat.even p then 1 else -1.
Proof.
  induction p as [|p IH]; [reflexivity|]. rewrite <- tech_pow_Rmult, IH, Nat.even_succ,
    <- Nat.negb_even. destruct (Nat.even p); simpl; ring.
Qed.

Theorem determinant_form_encloses t n : forall a A d, in_unit_box t ->
  (forall i j, (i < n)%nat -> (j < n)%nat -> form_encloses t (form_at a i j) (A i j)) ->
  determinant_form n a = Some d -> form_encloses t d (determinant n A).
Proof.
  induction n as [|n IH]; intros a A d T H E.
  { injection E as <-. apply constant_form_encloses, (integer_encloses 1). }
  cbn [determinant_form] in E. set (p := pivot_of a) in *.
  destruct (Nat.ltb p (S n)) eqn:P; [|discriminate]. apply Nat.ltb_lt in P.
  cbn [andb range] in E. destruct is_not_zero eqn:Z; [|discriminate].
  set (v := Enclosure (form_range (form_at a 0 p)) (form_at a 0 p)) in *.
  assert (V : represents t v (A O p)).
  { split; [apply (form_range_encloses t); [exact T|]|]; apply H; lia. }
  assert (N : A O p <> 0) by exact (is_not_zero_correct _ _ Z (proj1 V)).
  destruct determinant_form as [e|] eqn:D; [|discriminate]. injection E as <-.
  rewrite (elimination n p A P N), power_of_minus_one.
  assert (M : form_encloses t (multiply_forms (form_at a 0 p) e)
                (A O p * determinant n (complement p A))).
  { apply multiply_forms_enclose; [exact T|apply H; lia|].
    refine (IH _ _ _ T _ D). apply complement_encloses; try assumption.
    exact (proj2 (inverse_represents t v _ N T V)). }
  destruct (Nat.even p).
  - rewrite Rmult_1_l. exact M.
  - replace (-1 * (A O p * determinant n (complement p A)))
      with (- (A O p * determinant n (complement p A))) by ring.
    apply negate_form_encloses, M.
Qed.

Lemma add_row_encloses t n step a A :
  (forall i j, (i < n)%nat -> (j < n)%nat -> form_encloses t (form_at a i j) (A i j)) ->
  exists B, determinant n B = determinant n A /\
    forall i j, (i < n)%nat -> (j < n)%nat ->
      form_encloses t (form_at (add_row n a step) i j) (B i j).
Proof.
  destruct step as [p factors]. unfold add_row. intros H.
  destruct (Nat.ltb_spec p n) as [P|P]; [|exists A; split; [reflexivity|exact H]].
  exists (fun i j => if Nat.eqb i p then A p j else A i j + real_of (nth i factors F.nan) * A p j).
  split; [exact (add_to_rows n p (fun i => real_of (nth i factors F.nan)) A P)|]. intros i j I J.
  rewrite tabulate_at by assumption.
  destruct (Nat.eqb i p); [apply H; assumption|].
  apply add_forms_enclose; [apply H; assumption|].
  apply scale_form_encloses; [apply point_encloses|apply H; assumption].
Qed.

Theorem determinant_in_box_encloses t n a A d : in_unit_box t ->
  (forall i j, (i < n)%nat -> (j < n)%nat -> form_encloses t (form_at a i j) (A i j)) ->
  determinant_in_box n a = Some d -> form_encloses t d (determinant n A).
Proof.
  intros T. unfold determinant_in_box.
  generalize (clearing n n [] 0 (tabulate n n (midpoints a))) as steps. intros steps.
  revert a A. induction steps as [|step l IH]; intros a A H D.
  - exact (determinant_form_encloses t n a A d T H D).
  - destruct (add_row_encloses t n step a A H) as (B & <- & E). exact (IH _ B E D).
Qed.

Lemma scales_known t vs names scales : in_unit_box t -> known t vs names ->
  forallb is_known (map (evaluate vs) scales) = true ->
  Forall (defined names) scales /\
  form_encloses t (fold_right (fun s f => multiply_forms (form_of s) f) (constant_form one)
                     (map (evaluate vs) scales)) (product (map (value names) scales)) /\
  (forall i x, encloses i x ->
    encloses (fold_right (fun s i => multiply (range_of s) i) i (map (evaluate vs) scales))
      (x * product (map (value names) scales))).
Proof.
  intros T K. induction scales as [|s l IH]; intros D.
  { unfold product. simpl. split; [constructor|]. split.
    - apply constant_form_encloses, (integer_encloses 1).
    - intros i x X. rewrite Rmult_1_r. exact X. }
  cbn [map forallb] in D. apply andb_prop in D as [D1 D2]. destruct (IH D2) as (A & B & C).
  destruct (evaluate vs s) as [v|] eqn:V; [|discriminate].
  destruct (evaluate_correct t vs names s v T K V) as [DS [R F]].
  split; [constructor; assumption|]. cbn [map fold_right]. rewrite V.
  change (product (value names s :: map (value names) l))
    with (value names s * product (map (value names) l)). split.
  - apply multiply_forms_enclose; [exact T|exact F|exact B].
  - intros i x X. replace (x * (value names s * product (map (value names) l)))
      with (value names s * (x * product (map (value names) l))) by ring.
    apply multiply_encloses; [exact R|apply C, X].
Qed.

Lemma threshold_known threshold l : evaluate [] threshold = Some l ->
  defined [] threshold /\ encloses (range l) (value [] threshold).
Proof.
  intros E. assert (K : known (fun _ => 0) [] []).
  { split; [reflexivity|]. intros [|k] v; discriminate. }
  assert (T : in_unit_box (fun _ => 0)) by (intros k; rewrite Rabs_R0; lra).
  destruct (evaluate_correct _ _ _ _ _ T K E) as [D [R _]]. split; assumption.
Qed.

Definition is_above_at (q : question) (scales : list expression) (threshold : expression)
    (x : list R) : Prop :=
  in_set q x -> model_defined q x /\ scales_defined q scales x /\
    value [] threshold < scaled_determinant q scales x.

Lemma test_determinant_correct q scales threshold m : rows q = columns q -> forall b x,
  in_box b x -> is_closed (test_determinant q scales threshold m b) = true ->
  is_above_at q scales threshold x.
Proof.
  intros Q b x B. unfold test_determinant.
  set (vs := evaluate_definitions (variables (second_order m) b) (definitions q)).
  destruct existsb eqn:E; [intros _ S; elim (outside_correct q m b x B E S)|].
  set (a := map (map (evaluate vs)) (matrix q)). unfold is_model_known.
  destruct (forallb is_known vs) eqn:D1; [|discriminate].
  destruct (forallb (fun e => is_known (evaluate vs e)) (also_defined q)) eqn:D2; [|discriminate].
  destruct (forallb (forallb is_known) a) eqn:D3; [|discriminate].
  destruct (forallb (fun r => Nat.eqb (length r) (columns q)) a) eqn:D4; [|discriminate].
  cbn [andb]. destruct (forallb is_known (map (evaluate vs) scales)) eqn:D5; [|discriminate].
  destruct determinant_in_box as [d|] eqn:D; [|discriminate].
  destruct (evaluate [] threshold) as [l|] eqn:L; [|discriminate].
  destruct is_positive eqn:P; [|discriminate]. intros _ _.
  pose proof (coordinate_in_unit_box b x B) as T.
  pose proof (known_definitions _ (definitions q) _ _ T (variables_known (second_order m) b x B))
    as K.
  destruct (scales_known _ vs _ scales T K D5) as (S & F & _).
  split; [apply (everything_defined q m b x B); assumption|]. split; [exact S|].
  assert (G : encloses (I.abs (form_range (product_form d (map (evaluate vs) scales))))
                (scaled_determinant q scales x)).
  { apply absolute_encloses, (form_range_encloses (coordinate b x)); [exact T|].
    apply multiply_forms_enclose; [exact T| |exact F].
    eapply determinant_in_box_encloses; [exact T| |exact D]. intros i j I J.
    apply (entries_enclosed q m b x B i j D3 D4); [rewrite Q|]; assumption. }
  pose proof (is_positive_correct _ _ P
    (subtract_encloses _ _ _ _ G (proj2 (threshold_known _ _ L)))) as H. lra.
Qed.

Lemma is_square_correct q threshold : is_square q threshold = true ->
  defined [] threshold /\ rows q = columns q.
Proof.
  unfold is_square. intros H. apply andb_prop in H as [H L].
  destruct (evaluate [] threshold) as [l|] eqn:E; [|discriminate].
  split; [exact (proj1 (threshold_known _ _ E))|apply Nat.eqb_eq, H].
Qed.

Theorem check_determinant_correct q scales threshold m :
  check_determinant q scales threshold m = true -> determinant_above q scales threshold.
Proof.
  unfold check_determinant. intros H. apply andb_prop in H as [S H].
  apply is_square_correct in S as [D Q]. split; [exact D|]. split; [exact Q|].
  destruct enclose_ranges as [root|] eqn:R; [|discriminate].
  destruct search as [n|] eqn:L; [|discriminate].
  split; [exact (enclose_ranges_defined q root R)|]. intros x X.
  refine (search_correct _ (is_above_at q scales threshold)
    (test_determinant_correct q scales threshold m Q) _ _ _ x n _ L X).
  eapply enclose_ranges_correct; [exact R|exact (proj1 X)].
Qed.

(** The same with a hint. *)
Theorem check_determinant_tree_correct q scales threshold m t :
  check_determinant_tree q scales threshold m t = true -> determinant_above q scales threshold.
Proof.
  unfold check_determinant_tree. intros H. apply andb_prop in H as [S H].
  apply is_square_correct in S as [D Q]. split; [exact D|]. split; [exact Q|].
  destruct enclose_ranges as [root|] eqn:R; [|discriminate].
  split; [exact (enclose_ranges_defined q root R)|]. intros x X.
  refine (check_parts_correct _ (is_above_at q scales threshold)
    (test_determinant_correct q scales threshold m Q) t _ x _ H X).
  eapply enclose_ranges_correct; [exact R|exact (proj1 X)].
Qed.

(** The same for a trajectory, without and with a hint for each piece. *)
Definition check_determinant_pieces (q : list expression -> question) (scales : list expression)
    (threshold : expression) (m : method) (pieces : list (list expression)) : bool :=
  forallb (fun piece => check_determinant (q piece) scales threshold m) pieces.

Theorem check_determinant_pieces_correct q scales threshold m pieces :
  check_determinant_pieces q scales threshold m pieces = true ->
  Forall (fun piece => determinant_above (q piece) scales threshold) pieces.
Proof.
  unfold check_determinant_pieces. rewrite forallb_forall. intros H. apply Forall_forall.
  intros piece P. apply (check_determinant_correct (q piece) scales threshold m), H, P.
Qed.

Definition check_determinant_piece_trees (q : list expression -> question)
    (scales : list expression) (threshold : expression) (m : method) :
    list (list expression) -> list tree -> bool :=
  check_each (fun q => check_determinant_tree q scales threshold m) q.

Theorem check_determinant_piece_trees_correct q scales threshold m pieces trees :
  check_determinant_piece_trees q scales threshold m pieces trees = true ->
  Forall (fun piece => determinant_above (q piece) scales threshold) pieces.
Proof.
  apply (check_each_correct _ (fun q => determinant_above q scales threshold)).
  intros q' t. apply check_determinant_tree_correct.
Qed.

Theorem check_point_correct q scales threshold point :
  check_point q scales threshold point = true -> determinant_not_above q scales threshold.
Proof.
  unfold check_point. set (a := map _ (combine point (ranges q))). set (b := hull a a). intros H.
  apply andb_prop in H as [H L]. apply andb_prop in H as [H S].
  destruct (evaluate [] threshold) as [l|] eqn:E; [|discriminate].
  destruct (threshold_known _ _ E) as [D G]. split; [exact D|].
  assert (Q : rows q = columns q /\
              forallb (fun r => Nat.eqb (length r) (columns q)) (matrix q) = true).
  { exact (has_square_matrix q b H). }
  destruct Q as [Q C]. split; [exact Q|].
  assert (B : in_box b (along a a 0)) by (apply hull_contains; lra).
  exists (along a a 0). destruct (in_set_and_defined_correct q b _ B H) as [X M].
  pose proof (coordinate_in_unit_box b _ B) as T.
  pose proof (known_definitions _ (definitions q) _ _ T (variables_known 99 b _ B)) as K.
  destruct (scales_known _ _ _ scales T K S) as (F & _ & I).
  repeat split; [exact (proj1 X)|exact (proj2 X)|apply M|apply M|apply M|exact F|].
  pose proof (absolute_encloses _ _ (I _ _ (determinant_at_encloses q b _ B Q C))) as Z.
  pose proof (is_not_positive_correct _ _ L (subtract_encloses _ _ _ _ Z G)) as P.
  unfold scaled_determinant. lra.
Qed.

Theorem check_crossing_correct q scales threshold a b :
  check_crossing q scales threshold a b = true -> determinant_not_above q scales threshold.
Proof.
  unfold check_crossing. destruct (evaluate [] threshold) as [l|] eqn:E; [|discriminate].
  destruct (threshold_known _ _ E) as [D G]. intros H. apply andb_prop in H as [L H].
  apply check_singularity_correct in H as (x & S & (M1 & M2 & M3) & Q & Z).
  apply Forall_app in M2 as [M2 M4]. split; [exact D|]. split; [exact Q|].
  exists x. split; [exact S|]. split; [repeat split; assumption|]. split; [exact M4|].
  change (determinant (columns q) (entry q (extend x (definitions q))) = 0) in Z.
  unfold scaled_determinant. rewrite Z, Rmult_0_l, Rabs_R0.
  exact (is_not_negative_correct _ _ L G).
Qed.
