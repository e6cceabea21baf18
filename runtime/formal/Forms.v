(* SPDX-License-Identifier: Apache-2.0 *)
(** Functions over a box as polynomials of second order with intervals as coefficients.

    The k-th variable of a box is m_k + r_k t_k with |t_k| <= 1. A form holds a function of the t_k:
    its value at t is one of those that the form has if each coefficient is any number of its
    interval. Products of three and more variables become part of the constant interval. *)
From Coq Require Import Reals Lra Lia List PArith Bool.
From Regulus Require Import Intervals.
Import ListNotations.
Open Scope R_scope.

(** A product of variables, their numbers in ascending order. *)
Definition monomial := list positive.

Fixpoint monomial_value (t : positive -> R) (m : monomial) : R :=
  match m with [] => 1 | k :: l => t k * monomial_value t l end.

Fixpoint precedes (m n : monomial) : comparison :=
  match m, n with
  | [], [] => Eq
  | [], _ => Lt
  | _, [] => Gt
  | i :: m', j :: n' => match Pos.compare i j with Eq => precedes m' n' | c => c end
  end.

Definition monomial_product (m n : monomial) : monomial :=
  match m, n with
  | [i], [j] => if Pos.leb i j then [i; j] else [j; i]
  | _, _ => m ++ n
  end.

(** A sum of monomials with coefficients. *)
Definition terms := list (monomial * interval).

Inductive terms_enclose (t : positive -> R) : terms -> R -> Prop :=
  | no_terms : terms_enclose t [] 0
  | one_more_term m i l c r : encloses i c -> terms_enclose t l r ->
      terms_enclose t ((m, i) :: l) (c * monomial_value t m + r).

Lemma terms_equal t l x y : terms_enclose t l x -> x = y -> terms_enclose t l y.
Proof. intros H <-. exact H. Qed.

Lemma precedes_equal m n : precedes m n = Eq -> m = n.
Proof.
  revert n. induction m as [|i m IH]; intros [|j n]; simpl; try discriminate; [reflexivity|].
  destruct (Pos.compare_spec i j) as [->| |]; try discriminate. intros H. f_equal. auto.
Qed.

Lemma monomial_product_value t m n :
  monomial_value t (monomial_product m n) = monomial_value t m * monomial_value t n.
Proof.
  assert (A : monomial_value t (m ++ n) = monomial_value t m * monomial_value t n).
  { induction m as [|i m IH]; simpl; [ring|]. rewrite IH. ring. }
  unfold monomial_product. destruct m as [|i [|]]; try exact A. destruct n as [|j [|]]; try exact A.
  destruct (i <=? j)%positive; simpl; ring.
Qed.

(** Sums of ordered terms are ordered, so equal monomials meet. *)
Fixpoint add_terms (l : terms) : terms -> terms :=
  fix merge (k : terms) : terms :=
    match l, k with
    | [], _ => k
    | _, [] => l
    | (m, i) :: l', (n, j) :: k' =>
        match precedes m n with
        | Lt => (m, i) :: add_terms l' k
        | Gt => (n, j) :: merge k'
        | Eq => (m, add i j) :: add_terms l' k'
        end
    end.

Lemma add_terms_enclose t l k x y :
  terms_enclose t l x -> terms_enclose t k y -> terms_enclose t (add_terms l k) (x + y).
Proof.
  intros X. revert k y. induction X as [|m i l c r C X IH]; intros k y Y.
  - replace (0 + y) with y by ring. destruct Y; simpl; constructor; assumption.
  - induction Y as [|n j k d s D Y IHY].
    + simpl. eapply terms_equal; [constructor; eassumption|ring].
    + simpl. destruct (precedes m n) eqn:O.
      * apply precedes_equal in O as <-. eapply terms_equal.
        -- constructor; [apply add_encloses; eassumption|apply IH; eassumption].
        -- ring.
      * eapply terms_equal.
        -- constructor; [eassumption|apply IH; constructor; eassumption].
        -- ring.
      * eapply terms_equal; [constructor; [eassumption|exact IHY]|ring].
Qed.

Definition scale_terms (a : interval) (l : terms) : terms :=
  map (fun t => (fst t, multiply a (snd t))) l.

Lemma scale_terms_enclose t a c l x :
  encloses a c -> terms_enclose t l x -> terms_enclose t (scale_terms a l) (c * x).
Proof.
  intros A X. induction X as [|m i l d r D X IH]; simpl.
  - eapply terms_equal; [constructor|ring].
  - eapply terms_equal.
    + constructor; [apply multiply_encloses; eassumption|exact IH].
    + ring.
Qed.

Definition negate_terms (l : terms) : terms := map (fun t => (fst t, I.neg (snd t))) l.

Lemma negate_terms_enclose t l x :
  terms_enclose t l x -> terms_enclose t (negate_terms l) (- x).
Proof.
  intros X. induction X as [|m i l d r D X IH]; simpl.
  - eapply terms_equal; [constructor|ring].
  - eapply terms_equal; [constructor; [apply negate_encloses; eassumption|exact IH]|ring].
Qed.

Definition multiply_term (m : monomial) (a : interval) (l : terms) : terms :=
  map (fun t => (monomial_product m (fst t), multiply a (snd t))) l.

Fixpoint multiply_terms (l k : terms) : terms :=
  match l with
  | [] => []
  | (m, a) :: l' => add_terms (multiply_term m a k) (multiply_terms l' k)
  end.

Lemma multiply_terms_enclose t l k x y :
  terms_enclose t l x -> terms_enclose t k y -> terms_enclose t (multiply_terms l k) (x * y).
Proof.
  intros X Y. induction X as [|m a l c r C X IH]; simpl.
  - eapply terms_equal; [constructor|ring].
  - eapply terms_equal.
    + apply add_terms_enclose; [|exact IH]. instantiate (1 := c * monomial_value t m * y).
      clear - C Y. induction Y as [|n i k d r D Y IH]; simpl.
      * eapply terms_equal; [constructor|ring].
      * eapply terms_equal.
        -- constructor; [apply multiply_encloses; eassumption|exact IH].
        -- rewrite monomial_product_value. ring.
    + ring.
Qed.

(** ** Bounds *)

Definition in_unit_box (t : positive -> R) : Prop := forall k, Rabs (t k) <= 1.

Definition monomial_range (m : monomial) : interval :=
  match m with
  | [i; j] => if Pos.eqb i j then unit_interval else symmetric
  | _ => symmetric
  end.

Lemma monomial_range_encloses t m :
  in_unit_box t -> encloses (monomial_range m) (monomial_value t m).
Proof.
  intros T.
  assert (S : encloses symmetric (monomial_value t m)).
  { apply symmetric_encloses. induction m as [|k m IH]; simpl; [rewrite Rabs_R1; lra|].
    rewrite Rabs_mult. rewrite <- (Rmult_1_r 1).
    apply Rmult_le_compat; auto using Rabs_pos. }
  unfold monomial_range. destruct m as [|i [|j [|]]]; try exact S.
  destruct (Pos.eqb_spec i j) as [<-|]; [|exact S].
  apply unit_interval_encloses. specialize (T i). simpl.
  assert (-1 <= t i <= 1) by (unfold Rabs in T; destruct Rcase_abs; lra). split; nra.
Qed.

Fixpoint terms_range (l : terms) : interval :=
  match l with
  | [] => zero
  | [(m, i)] => multiply i (monomial_range m)
  | (m, i) :: l' => add (multiply i (monomial_range m)) (terms_range l')
  end.

Lemma terms_range_encloses t l x :
  in_unit_box t -> terms_enclose t l x -> encloses (terms_range l) x.
Proof.
  intros T X. induction X as [|m i l c r C X IH]; [exact (integer_encloses 0)|].
  pose proof (multiply_encloses _ _ _ _ C (monomial_range_encloses t m T)) as H.
  destruct l as [|u l].
  - inversion X. replace (c * monomial_value t m + 0) with (c * monomial_value t m) by ring.
    exact H.
  - change (encloses (add (multiply i (monomial_range m)) (terms_range (u :: l)))
              (c * monomial_value t m + r)).
    apply add_encloses; assumption.
Qed.

(** ** Forms *)

(** [linear] and [quadratic] are of the variables that are kept to the second order, [single] of
    those that are kept to the first order only. *)
Record form := Form {
  constant : interval;
  linear : terms;
  quadratic : terms;
  single : terms }.

Definition form_encloses (t : positive -> R) (f : form) (x : R) : Prop :=
  exists a b c d, encloses (constant f) a /\ terms_enclose t (linear f) b /\
    terms_enclose t (quadratic f) c /\ terms_enclose t (single f) d /\ x = a + b + c + d.

Definition constant_form (i : interval) : form := Form i [] [] [].

Definition add_forms (f g : form) : form :=
  Form (add (constant f) (constant g)) (add_terms (linear f) (linear g))
    (add_terms (quadratic f) (quadratic g)) (add_terms (single f) (single g)).

Definition scale_form (a : interval) (f : form) : form :=
  Form (multiply a (constant f)) (scale_terms a (linear f)) (scale_terms a (quadratic f))
    (scale_terms a (single f)).

Definition negate_form (f : form) : form :=
  Form (I.neg (constant f)) (negate_terms (linear f)) (negate_terms (quadratic f))
    (negate_terms (single f)).

Definition subtract_forms (f g : form) : form := add_forms f (negate_form g).

Definition varying_range (f : form) : interval :=
  add (terms_range (linear f)) (add (terms_range (quadratic f)) (terms_range (single f))).

Definition form_range (f : form) : interval := add (constant f) (varying_range f).

Definition is_constant (f : form) : bool :=
  match linear f, quadratic f, single f with [], [], [] => true | _, _, _ => false end.

(** The linear parts of f and g give the quadratic part; the other products of their varying parts
    go to the constant. *)
Definition multiply_varying (f g : form) : form :=
  let lf := terms_range (linear f) in
  let rest_f := add (terms_range (quadratic f)) (terms_range (single f)) in
  let rest_g := add (terms_range (quadratic g)) (terms_range (single g)) in
  Form (add (multiply (constant f) (constant g))
          (add (multiply lf rest_g) (multiply rest_f (varying_range g))))
    (add_terms (scale_terms (constant f) (linear g)) (scale_terms (constant g) (linear f)))
    (add_terms (add_terms (scale_terms (constant f) (quadratic g))
                  (scale_terms (constant g) (quadratic f)))
       (multiply_terms (linear f) (linear g)))
    (add_terms (scale_terms (constant f) (single g)) (scale_terms (constant g) (single f))).

Definition multiply_forms (f g : form) : form :=
  if is_constant f then scale_form (constant f) g
  else if is_constant g then scale_form (constant g) f
  else multiply_varying f g.

Lemma constant_form_encloses t i x : encloses i x -> form_encloses t (constant_form i) x.
Proof.
  intros H. exists x, 0, 0, 0. repeat split; try constructor; [exact H|]. simpl. ring.
Qed.

Lemma add_forms_enclose t f g x y :
  form_encloses t f x -> form_encloses t g y -> form_encloses t (add_forms f g) (x + y).
Proof.
  intros (a & b & c & d & A & B & C & D & ->) (a' & b' & c' & d' & A' & B' & C' & D' & ->).
  exists (a + a'), (b + b'), (c + c'), (d + d'). simpl.
  repeat split; auto using add_encloses, add_terms_enclose. ring.
Qed.

Lemma scale_form_encloses t i f x y :
  encloses i x -> form_encloses t f y -> form_encloses t (scale_form i f) (x * y).
Proof.
  intros X (a & b & c & d & A & B & C & D & ->).
  exists (x * a), (x * b), (x * c), (x * d). simpl.
  repeat split; auto using multiply_encloses, scale_terms_enclose. ring.
Qed.

Lemma negate_form_encloses t f x : form_encloses t f x -> form_encloses t (negate_form f) (- x).
Proof.
  intros (a & b & c & d & A & B & C & D & ->).
  exists (- a), (- b), (- c), (- d). simpl.
  repeat split; auto using negate_encloses, negate_terms_enclose. ring.
Qed.

Lemma subtract_forms_enclose t f g x y :
  form_encloses t f x -> form_encloses t g y -> form_encloses t (subtract_forms f g) (x - y).
Proof. intros X Y. apply add_forms_enclose; auto using negate_form_encloses. Qed.

Lemma varying_range_encloses t f b c d : in_unit_box t ->
  terms_enclose t (linear f) b -> terms_enclose t (quadratic f) c ->
  terms_enclose t (single f) d -> encloses (varying_range f) (b + (c + d)).
Proof. intros. repeat apply add_encloses; eapply terms_range_encloses; eassumption. Qed.

Lemma form_range_encloses t f x :
  in_unit_box t -> form_encloses t f x -> encloses (form_range f) x.
Proof.
  intros T (a & b & c & d & A & B & C & D & ->).
  replace (a + b + c + d) with (a + (b + (c + d))) by ring.
  apply add_encloses; [exact A|]. eapply varying_range_encloses; eassumption.
Qed.

Lemma is_constant_encloses t f x :
  is_constant f = true -> form_encloses t f x -> encloses (constant f) x.
Proof.
  intros H (a & b & c & d & A & B & C & D & ->). unfold is_constant in H.
  destruct (linear f); [|discriminate]. destruct (quadratic f); [|discriminate].
  destruct (single f); [|discriminate]. inversion B. inversion C. inversion D.
  replace (a + 0 + 0 + 0) with a by ring. exact A.
Qed.

Lemma multiply_forms_enclose t f g x y : in_unit_box t ->
  form_encloses t f x -> form_encloses t g y -> form_encloses t (multiply_forms f g) (x * y).
Proof.
  intros T X Y. unfold multiply_forms. destruct (is_constant f) eqn:KF.
  { apply scale_form_encloses; [|exact Y]. eapply is_constant_encloses; eassumption. }
  destruct (is_constant g) eqn:KG.
  { rewrite Rmult_comm. apply scale_form_encloses; [|exact X].
    eapply is_constant_encloses; eassumption. }
  destruct X as (a & b & c & d & A & B & C & D & ->).
  destruct Y as (a' & b' & c' & d' & A' & B' & C' & D' & ->).
  exists (a * a' + (b * (c' + d') + (c + d) * (b' + (c' + d')))).
  exists (a * b' + a' * b), (a * c' + a' * c + b * b'), (a * d' + a' * d).
  unfold multiply_varying; simpl.
  split; [|split; [|split; [|split]]].
  - apply add_encloses; [apply multiply_encloses; assumption|].
    apply add_encloses; apply multiply_encloses.
    + eapply terms_range_encloses; eassumption.
    + apply add_encloses; eapply terms_range_encloses; eassumption.
    + apply add_encloses; eapply terms_range_encloses; eassumption.
    + eapply varying_range_encloses; eassumption.
  - apply add_terms_enclose; apply scale_terms_enclose; assumption.
  - apply add_terms_enclose; [apply add_terms_enclose; apply scale_terms_enclose; assumption|].
    apply multiply_terms_enclose; assumption.
  - apply add_terms_enclose; apply scale_terms_enclose; assumption.
  - ring.
Qed.
