(* SPDX-License-Identifier: Apache-2.0 *)
(** Expressions over a box: an interval and a form that enclose them, if they are defined. *)
From Coq Require Import Reals QArith Qreals Lra Lia List PArith Bool.
From Coq Require PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Intervals Taylor Forms.
Import ListNotations.
Open Scope R_scope.

Record enclosure := Enclosure { range : interval; polynomial : form }.

Definition represents (t : positive -> R) (v : enclosure) (x : R) : Prop :=
  encloses (range v) x /\ form_encloses t (polynomial v) x.

(** Both enclosures bound the range. *)
Definition enclose (i : interval) (f : form) : enclosure :=
  if is_constant f then Enclosure (I.meet i (constant f)) f
  else Enclosure (I.meet i (form_range f)) f.

Definition enclose_constant (i : interval) : enclosure := Enclosure i (constant_form i).

Lemma enclose_represents t i f x :
  in_unit_box t -> encloses i x -> form_encloses t f x -> represents t (enclose i f) x.
Proof.
  intros T X Y. unfold enclose. destruct (is_constant f) eqn:K; split; try exact Y;
    apply meet_encloses; try exact X.
  - eapply is_constant_encloses; eassumption.
  - eapply form_range_encloses; eassumption.
Qed.

Lemma enclose_constant_represents t i x : encloses i x -> represents t (enclose_constant i) x.
Proof. intros X. split; [exact X|apply constant_form_encloses, X]. Qed.

(** ** Functions of one operand *)

(** The range, and with it the point around which a function is expanded. *)
Definition center (v : enclosure) : F.type := I.midpoint (range v).
Definition expansion_range (v : enclosure) : interval := I.join (range v) (point (center v)).

Definition half (i : interval) : interval := divide i (integer 2).

(** f(m) + f'(m)(x - m) + f''(range)/2 (x - m)^2. *)
Definition expand (f f' f'' : interval -> interval) (v : enclosure) : form :=
  let m := point (center v) in
  let d := subtract_forms (polynomial v) (constant_form m) in
  add_forms (add_forms (constant_form (f m)) (scale_form (f' m) d))
    (scale_form (half (f'' (expansion_range v))) (multiply_forms d d)).

(** [smooth]: the function has two derivatives on the range of expansion. *)
Definition apply (smooth : bool) (f f' f'' : interval -> interval) (v : enclosure) : enclosure :=
  let i := f (range v) in
  if smooth && negb (is_constant (polynomial v)) then enclose i (expand f f' f'' v)
  else enclose_constant i.

Section Function.
  Variables (domain : R -> Prop) (f f' f'' : R -> R) (F F' F'' : interval -> interval).
  Hypothesis derivable : forall x, domain x -> twice_derivable f f' f'' x.
  Hypothesis F_encloses : forall i x, domain x -> encloses i x -> encloses (F i) (f x).
  Hypothesis F'_encloses : forall i x, domain x -> encloses i x -> encloses (F' i) (f' x).
  Hypothesis F''_encloses : forall i x, domain x -> encloses i x -> encloses (F'' i) (f'' x).

  Lemma expand_encloses t v x : in_unit_box t -> represents t v x ->
    (forall y, encloses (expansion_range v) y -> domain y) ->
    form_encloses t (expand F F' F'' v) (f x).
  Proof.
    intros T [X Y] D. set (m := real_of (center v)).
    assert (M : encloses (expansion_range v) m).
    { apply join_encloses. right. apply point_encloses. }
    assert (X' : encloses (expansion_range v) x) by (apply join_encloses; left; exact X).
    assert (between : forall y, Rmin m x <= y <= Rmax m x -> encloses (expansion_range v) y).
    { intros y. unfold Rmin, Rmax. destruct Rle_dec; apply between_enclosed; assumption. }
    destruct (taylor f f' f'' m x) as [y [B ->]].
    { intros y B. apply derivable, D, between, B. }
    assert (S : form_encloses t (subtract_forms (polynomial v) (constant_form (point (center v))))
                  (x - m)).
    { apply subtract_forms_enclose; [exact Y|]. apply constant_form_encloses, point_encloses. }
    unfold expand. apply add_forms_enclose; [apply add_forms_enclose|].
    - apply constant_form_encloses, F_encloses; [apply D, M|apply point_encloses].
    - apply scale_form_encloses; [|exact S]. apply F'_encloses; [apply D, M|apply point_encloses].
    - apply scale_form_encloses; [|apply multiply_forms_enclose; assumption].
      apply divide_encloses; [lra| |exact (integer_encloses 2)].
      apply F''_encloses; [apply D|]; apply between, B.
  Qed.

  Lemma apply_represents t v x smooth : in_unit_box t -> represents t v x -> domain x ->
    (smooth = true -> forall y, encloses (expansion_range v) y -> domain y) ->
    represents t (apply smooth F F' F'' v) (f x).
  Proof.
    intros T X D S. unfold apply. destruct smooth; simpl.
    - destruct is_constant; simpl.
      + apply enclose_constant_represents, F_encloses; [exact D|exact (proj1 X)].
      + apply enclose_represents; [exact T| |apply expand_encloses; auto].
        apply F_encloses; [exact D|exact (proj1 X)].
    - apply enclose_constant_represents, F_encloses; [exact D|exact (proj1 X)].
  Qed.
End Function.

(** ** Each operation *)

Definition always (v : enclosure) : bool := true.
Definition positive_range (v : enclosure) : bool := is_positive (expansion_range v).
Definition nonzero_range (v : enclosure) : bool := is_not_zero (expansion_range v).

Definition enclose_sin (v : enclosure) : enclosure :=
  apply true sine (I.cos precision) (fun i => I.neg (sine i)) v.
Definition enclose_cos (v : enclosure) : enclosure :=
  apply true (I.cos precision) (fun i => I.neg (sine i))
    (fun i => I.neg (I.cos precision i)) v.
Definition enclose_exp (v : enclosure) : enclosure :=
  apply true (I.exp precision) (I.exp precision) (I.exp precision) v.
Definition enclose_atan (v : enclosure) : enclosure :=
  apply true (I.atan precision) (fun i => divide one (add one (square i)))
    (fun i => I.neg (divide (multiply (integer 2) i) (square (add one (square i))))) v.
Definition enclose_inverse (v : enclosure) : enclosure :=
  apply (nonzero_range v) (divide one) (fun i => I.neg (divide one (square i)))
    (fun i => divide (integer 2) (multiply (square i) i)) v.
Definition enclose_log (v : enclosure) : enclosure :=
  apply (positive_range v) (I.ln precision) (divide one) (fun i => I.neg (divide one (square i))) v.
Definition enclose_sqrt (v : enclosure) : enclosure :=
  apply (positive_range v) (I.sqrt precision)
    (fun i => divide one (multiply (integer 2) (I.sqrt precision i)))
    (fun i => I.neg (divide one (multiply (integer 4) (multiply i (I.sqrt precision i))))) v.
Definition enclose_abs (v : enclosure) : enclosure :=
  if is_not_negative (range v) then v
  else if is_not_positive (range v) then Enclosure (I.neg (range v)) (negate_form (polynomial v))
  else enclose_constant (I.abs (range v)).

Fixpoint power_form (f : form) (n : nat) : form :=
  match n with
  | O => constant_form one
  | S O => f
  | S m => multiply_forms f (power_form f m)
  end.

Definition lift1 (f : enclosure -> enclosure) (a : option enclosure) : option enclosure :=
  match a with Some v => Some (f v) | None => None end.

Definition lift2 (f : enclosure -> enclosure -> enclosure) (a b : option enclosure) :=
  match a, b with Some v, Some w => Some (f v w) | _, _ => None end.

Definition demand (test : interval -> bool) (a : option enclosure) : option enclosure :=
  match a with Some v => if test (range v) then Some v else None | None => None end.

(** None: not shown to be defined all over the box. *)
Fixpoint evaluate (names : list (option enclosure)) (e : expression) : option enclosure :=
  let recurse := evaluate names in
  match e with
  | Constant q => Some (enclose_constant (rational q))
  | Pi => Some (enclose_constant (I.pi precision))
  | Name k => nth k names None
  | Negate a =>
      lift1 (fun v => Enclosure (I.neg (range v)) (negate_form (polynomial v))) (recurse a)
  | Add a b =>
      lift2 (fun v w => enclose (add (range v) (range w))
                          (add_forms (polynomial v) (polynomial w))) (recurse a) (recurse b)
  | Subtract a b =>
      lift2 (fun v w => enclose (subtract (range v) (range w))
                          (subtract_forms (polynomial v) (polynomial w))) (recurse a) (recurse b)
  | Multiply a b =>
      lift2 (fun v w => enclose (multiply (range v) (range w))
                          (multiply_forms (polynomial v) (polynomial w))) (recurse a) (recurse b)
  | Divide a b =>
      lift2 (fun v w => enclose (divide (range v) (range w))
                          (multiply_forms (polynomial v) (polynomial (enclose_inverse w))))
        (recurse a) (demand is_not_zero (recurse b))
  | Power a n =>
      lift1 (fun v => enclose (I.power_int precision (range v) (Z.of_nat n))
                        (power_form (polynomial v) n)) (recurse a)
  | Sqrt a => lift1 enclose_sqrt (demand is_not_negative (recurse a))
  | Sin a => lift1 enclose_sin (recurse a)
  | Cos a => lift1 enclose_cos (recurse a)
  | Atan a => lift1 enclose_atan (recurse a)
  | Exp a => lift1 enclose_exp (recurse a)
  | Log a => lift1 enclose_log (demand is_positive (recurse a))
  | Abs a => lift1 enclose_abs (recurse a)
  end.

Lemma power_form_encloses t f x n :
  in_unit_box t -> form_encloses t f x -> form_encloses t (power_form f n) (x ^ n).
Proof.
  intros T X. induction n as [|n IH]; [apply constant_form_encloses, (integer_encloses 1)|].
  destruct n; [simpl; rewrite Rmult_1_r; exact X|].
  change (form_encloses t (multiply_forms f (power_form f (S n))) (x * x ^ S n)).
  apply multiply_forms_enclose; assumption.
Qed.

Lemma negate_represents t v x : represents t v x ->
  represents t (Enclosure (I.neg (range v)) (negate_form (polynomial v))) (- x).
Proof. intros [X Y]. split; [apply negate_encloses, X|apply negate_form_encloses, Y]. Qed.

Ltac enclose_operations := intros; repeat first
  [ apply (integer_encloses 1) | apply (integer_encloses 2) | apply (integer_encloses 4)
  | assumption | apply negate_encloses | apply square_encloses | apply multiply_encloses
  | apply add_encloses | apply sqrt_encloses | apply sin_encloses | apply cos_encloses
  | apply exp_encloses | apply atan_encloses | apply log_encloses | apply divide_encloses ].

Lemma sin_represents t v x :
  in_unit_box t -> represents t v x -> represents t (enclose_sin v) (sin x).
Proof.
  intros T X. eapply (apply_represents (fun _ => True)); try exact T; try exact X; trivial;
    try (intros; apply sin_derivable); enclose_operations.
Qed.

Lemma cos_represents t v x :
  in_unit_box t -> represents t v x -> represents t (enclose_cos v) (cos x).
Proof.
  intros T X. eapply (apply_represents (fun _ => True)); try exact T; try exact X; trivial;
    try (intros; apply cos_derivable); enclose_operations.
Qed.

Lemma exp_represents t v x :
  in_unit_box t -> represents t v x -> represents t (enclose_exp v) (exp x).
Proof.
  intros T X. eapply (apply_represents (fun _ => True)); try exact T; try exact X; trivial;
    try (intros; apply exp_derivable); enclose_operations.
Qed.

Lemma atan_represents t v x :
  in_unit_box t -> represents t v x -> represents t (enclose_atan v) (atan x).
Proof.
  intros T X. eapply (apply_represents (fun _ => True)); try exact T; try exact X; trivial;
    try (intros; apply atan_derivable); enclose_operations; nra.
Qed.

Lemma inverse_represents t v x : x <> 0 ->
  in_unit_box t -> represents t v x -> represents t (enclose_inverse v) (1 / x).
Proof.
  intros N T X.
  eapply (apply_represents (fun x => x <> 0) (fun t => 1 / t));
    try exact T; try exact X; trivial; try (intros; apply inverse_derivable; assumption);
    enclose_operations; try (repeat apply Rmult_integral_contrapositive_currified; assumption).
  eapply is_not_zero_correct; eassumption.
Qed.

Lemma log_represents t v x : 0 < x ->
  in_unit_box t -> represents t v x -> represents t (enclose_log v) (ln x).
Proof.
  intros N T X.
  eapply (apply_represents (fun x => 0 < x)); try exact T; try exact X; trivial;
    try (intros; apply log_derivable; assumption); enclose_operations; try nra.
  eapply is_positive_correct; eassumption.
Qed.

Lemma sqrt_represents t v x : 0 <= x ->
  in_unit_box t -> represents t v x -> represents t (enclose_sqrt v) (sqrt x).
Proof.
  intros N T X. destruct (positive_range v) eqn:P.
  - unfold enclose_sqrt. rewrite P.
    assert (P' : forall y, encloses (expansion_range v) y -> 0 < y).
    { intros y Y. eapply is_positive_correct; eassumption. }
    eapply (apply_represents (fun x => 0 < x)); try exact T; try exact X; trivial;
      try (intros; apply sqrt_derivable; assumption).
    + intros. apply sqrt_encloses. assumption.
    + intros i y Py Y. pose proof (sqrt_lt_R0 y Py). enclose_operations. lra.
    + intros i y Py Y. pose proof (sqrt_lt_R0 y Py). enclose_operations. nra.
    + apply P', join_encloses. left. exact (proj1 X).
  - unfold enclose_sqrt, apply. rewrite P. simpl.
    apply enclose_constant_represents, sqrt_encloses, X.
Qed.

Lemma abs_represents t v x : represents t v x -> represents t (enclose_abs v) (Rabs x).
Proof.
  intros X. unfold enclose_abs. destruct (is_not_negative (range v)) eqn:P.
  { rewrite Rabs_pos_eq; [exact X|]. eapply is_not_negative_correct; [exact P|apply X]. }
  destruct (is_not_positive (range v)) eqn:Q.
  { rewrite Rabs_left1; [apply negate_represents, X|].
    eapply is_not_positive_correct; [exact Q|apply X]. }
  apply enclose_constant_represents, absolute_encloses, X.
Qed.

(** What is known of the names at the point t of the box. *)
Definition known (t : positive -> R) (vs : list (option enclosure)) (names : list R) : Prop :=
  length vs = length names /\
  forall k v, nth k vs None = Some v -> represents t v (nth k names 0).

Theorem evaluate_correct t vs names e v : in_unit_box t -> known t vs names ->
  evaluate vs e = Some v -> defined names e /\ represents t v (value names e).
Proof.
  intros T [L H]. revert v.
  assert (two : forall f a b v, lift2 f (evaluate vs a) (evaluate vs b) = Some v ->
    exists x y, evaluate vs a = Some x /\ evaluate vs b = Some y /\ v = f x y).
  { intros f a b v. unfold lift2. destruct (evaluate vs a), (evaluate vs b); try discriminate.
    intros [= <-]. eauto. }
  assert (one : forall f a v, lift1 f (evaluate vs a) = Some v ->
    exists x, evaluate vs a = Some x /\ v = f x).
  { intros f a v. unfold lift1. destruct (evaluate vs a); try discriminate.
    intros [= <-]. eauto. }
  assert (when : forall f g a v, lift1 f (demand g (evaluate vs a)) = Some v ->
    exists x, evaluate vs a = Some x /\ g (range x) = true /\ v = f x).
  { intros f g a v. unfold lift1, demand. destruct (evaluate vs a) as [x|]; try discriminate.
    destruct (g (range x)) eqn:G; try discriminate. intros [= <-]. eauto. }
  induction e; simpl; intros v E.
  - injection E as <-. split; [exact Logic.I|]. apply enclose_constant_represents,
      rational_encloses.
  - injection E as <-. split; [exact Logic.I|]. apply enclose_constant_represents, pi_encloses.
  - split; [|apply H, E]. rewrite <- L. destruct (Nat.lt_ge_cases k (length vs)) as [|G];
      [assumption|].
    rewrite nth_overflow in E by exact G. discriminate.
  - apply one in E as (x & X & ->). destruct (IHe x X). split; [assumption|].
    apply negate_represents. assumption.
  - apply two in E as (x & y & X & Y & ->).
    destruct (IHe1 x X) as [? []], (IHe2 y Y) as [? []]. split; [split; assumption|].
    apply enclose_represents; auto using add_encloses, add_forms_enclose.
  - apply two in E as (x & y & X & Y & ->).
    destruct (IHe1 x X) as [? []], (IHe2 y Y) as [? []]. split; [split; assumption|].
    apply enclose_represents; auto using subtract_encloses, subtract_forms_enclose.
  - apply two in E as (x & y & X & Y & ->).
    destruct (IHe1 x X) as [? []], (IHe2 y Y) as [? []]. split; [split; assumption|].
    apply enclose_represents; auto using multiply_encloses, multiply_forms_enclose.
  - unfold lift2, demand in E. destruct (evaluate vs e1) as [x|] eqn:X; [|discriminate].
    destruct (evaluate vs e2) as [y|] eqn:Y; [|discriminate].
    destruct (is_not_zero (range y)) eqn:N; [|discriminate]. injection E as <-.
    destruct (IHe1 x eq_refl) as [? [A B]], (IHe2 y eq_refl) as [? [C D]].
    pose proof (is_not_zero_correct _ _ N C) as Z. split; [repeat split; assumption|].
    apply enclose_represents; [exact T|apply divide_encloses; assumption|].
    unfold Rdiv. rewrite <- (Rmult_1_l (/ value names e2)).
    apply multiply_forms_enclose; [exact T|exact B|].
    apply (inverse_represents t y (value names e2) Z T (conj C D)).
  - apply one in E as (x & X & ->). destruct (IHe x X) as [? [A B]]. split; [assumption|].
    apply enclose_represents; [exact T|apply power_encloses, A|].
    apply power_form_encloses; assumption.
  - apply when in E as (x & X & N & ->). destruct (IHe x X) as [D R].
    pose proof (is_not_negative_correct _ _ N (proj1 R)).
    split; [split; assumption|]. apply sqrt_represents; assumption.
  - apply one in E as (x & X & ->). destruct (IHe x X). split; auto using sin_represents.
  - apply one in E as (x & X & ->). destruct (IHe x X). split; auto using cos_represents.
  - apply one in E as (x & X & ->). destruct (IHe x X). split; auto using atan_represents.
  - apply one in E as (x & X & ->). destruct (IHe x X). split; auto using exp_represents.
  - apply when in E as (x & X & N & ->). destruct (IHe x X) as [D R].
    pose proof (is_positive_correct _ _ N (proj1 R)).
    split; [split; assumption|]. apply log_represents; assumption.
  - apply one in E as (x & X & ->). destruct (IHe x X). split; auto using abs_represents.
Qed.

(** ** Definitions *)

Fixpoint evaluate_definitions (vs : list (option enclosure)) (ds : list expression) :=
  match ds with
  | [] => vs
  | d :: later => evaluate_definitions (vs ++ [evaluate vs d]) later
  end.

Definition is_known (v : option enclosure) : bool :=
  match v with Some _ => true | None => false end.

Lemma known_append t vs names v x : known t vs names ->
  (forall w, v = Some w -> represents t w x) -> known t (vs ++ [v]) (names ++ [x]).
Proof.
  intros [L H] X. split; [rewrite !app_size, L; reflexivity|]. intros k w E.
  destruct (Nat.lt_trichotomy k (length vs)) as [K|[->|K]].
  - rewrite app_nth1 in E by exact K. rewrite app_nth1 by (rewrite <- L; exact K). auto.
  - rewrite app_nth2, Nat.sub_diag in E by lia. rewrite L, app_nth2, Nat.sub_diag by lia. auto.
  - rewrite nth_overflow in E by (rewrite app_size; simpl; lia). discriminate.
Qed.

Lemma known_definitions t ds : forall vs names, in_unit_box t -> known t vs names ->
  known t (evaluate_definitions vs ds) (extend names ds).
Proof.
  induction ds as [|d ds IH]; intros vs names T K; simpl; [exact K|].
  apply IH; [exact T|]. apply known_append; [exact K|]. intros w E.
  apply (evaluate_correct t vs names d w T K E).
Qed.

Lemma evaluate_definitions_prefix ds : forall vs,
  exists l, evaluate_definitions vs ds = vs ++ l.
Proof.
  induction ds as [|d ds IH]; intros vs; simpl; [exists []; rewrite app_nil_r; reflexivity|].
  destruct (IH (vs ++ [evaluate vs d])) as [l E]. rewrite E, <- app_assoc. eauto.
Qed.

Lemma definitions_are_defined t ds : forall vs names, in_unit_box t -> known t vs names ->
  forallb is_known (evaluate_definitions vs ds) = true -> all_defined names ds.
Proof.
  induction ds as [|d ds IH]; intros vs names T K A; simpl; [exact Logic.I|]. simpl in A.
  assert (D : exists w, evaluate vs d = Some w).
  { destruct (evaluate_definitions_prefix ds (vs ++ [evaluate vs d])) as [l E].
    rewrite E, !forallb_app in A. simpl in A.
    destruct (evaluate vs d) as [w|]; [eauto|]. rewrite !andb_false_r in A. discriminate. }
  destruct D as [w E]. destruct (evaluate_correct t vs names d w T K E) as [D R].
  split; [exact D|]. eapply IH; [exact T| |exact A].
  apply known_append; [exact K|]. rewrite E. intros u [= <-]. exact R.
Qed.
