(* SPDX-License-Identifier: Apache-2.0 *)
(** The test of a box: with K the inverse at the middle, KA = I + E. L is the linear part of E, and
    (I - L)KA = I + E' with E' = E - L - LE. If |E'| v < v, then A has full column rank. *)
From Coq Require Import Reals Lra Lia List PArith Bool.
From Coq Require PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import LinearAlgebra Intervals Forms Hints.
Import ListNotations.
Open Scope R_scope.

Definition forms := list (list form).

Definition form_at (a : forms) (i j : nat) : form := nth j (nth i a []) (constant_form I.nai).

Lemma tabulate_nth {A} m n (f : nat -> nat -> A) i j d d' : (i < m)%nat -> (j < n)%nat ->
  nth j (nth i (tabulate m n f) d) d' = f i j.
Proof.
  intros P Q. unfold tabulate.
  rewrite (nth_indep _ d (map (f O) (seq 0 n))) by (rewrite map_size, seq_size; exact P).
  rewrite (map_nth (fun i => map (f i) (seq 0 n)) (seq 0 m) O i), seq_nth by exact P.
  rewrite (nth_indep _ d' (f (0 + i)%nat O)) by (rewrite map_size, seq_size; exact Q).
  rewrite (map_nth (f (0 + i)%nat) (seq 0 n) O j), seq_nth by exact Q. reflexivity.
Qed.

Lemma map_tabulate {A B} (g : A -> B) m n f :
  map (map g) (tabulate m n f) = tabulate m n (fun i j => g (f i j)).
Proof.
  unfold tabulate. rewrite map_map. apply map_ext. intros i. rewrite map_map. reflexivity.
Qed.

Lemma tabulate_at m n f i j : (i < m)%nat -> (j < n)%nat -> form_at (tabulate m n f) i j = f i j.
Proof. apply tabulate_nth. Qed.

(** f 0 + … + f (n - 1). *)
Fixpoint form_sum (n : nat) (f : nat -> form) : form :=
  match n with
  | O => constant_form zero
  | S O => f O
  | S k => add_forms (form_sum k f) (f k)
  end.

Lemma form_sum_encloses t n f g :
  (forall i, (i < n)%nat -> form_encloses t (f i) (g i)) ->
  form_encloses t (form_sum n f) (sum n g).
Proof.
  induction n as [|n IH]; intros H; [apply constant_form_encloses, (integer_encloses 0)|].
  destruct n; [simpl; rewrite Rplus_0_l; apply H; lia|].
  change (form_encloses t (add_forms (form_sum (S n) f) (f (S n))) (sum (S n) g + g (S n))).
  apply add_forms_enclose; [apply IH; intros; apply H; lia|apply H; lia].
Qed.

(** ** A linear part with numbers as coefficients *)

Definition exact_terms (l : terms) : terms :=
  map (fun t => (fst t, point (I.midpoint (snd t)))) l.

Definition exact_value (t : positive -> R) (l : terms) : R :=
  fold_right (fun u r => real_of (I.midpoint (snd u)) * monomial_value t (fst u) + r) 0 l.

Lemma exact_terms_enclose t l : terms_enclose t (exact_terms l) (exact_value t l).
Proof.
  induction l as [|[m i] l IH]; [constructor|]. simpl.
  constructor; [apply point_encloses|exact IH].
Qed.

Definition linear_form (l : terms) : form := Form zero l [] [].

Lemma linear_form_encloses t l x : terms_enclose t l x -> form_encloses t (linear_form l) x.
Proof.
  intros X. exists 0, x, 0, 0. refine (conj _ (conj X (conj _ (conj _ _))));
    [exact (integer_encloses 0)|apply no_terms|apply no_terms|ring].
Qed.

Definition multiply_linear (l : terms) (f : form) : form :=
  match l with
  | [] => constant_form zero
  | _ => Form (multiply (terms_range l) (add (terms_range (quadratic f)) (terms_range (single f))))
           (scale_terms (constant f) l) (multiply_terms l (linear f)) []
  end.

Lemma multiply_linear_encloses t l f x y : in_unit_box t ->
  terms_enclose t l x -> form_encloses t f y -> form_encloses t (multiply_linear l f) (x * y).
Proof.
  intros T X Y. destruct l as [|u l].
  { inversion X. rewrite Rmult_0_l. apply constant_form_encloses, (integer_encloses 0). }
  destruct Y as (a & b & c & d & A & B & C & D & ->).
  exists (x * (c + d)), (a * x), (x * b), 0.
  refine (conj _ (conj _ (conj _ (conj _ _)))); [| | |constructor|ring].
  - apply multiply_encloses; [|apply add_encloses]; eapply terms_range_encloses; eassumption.
  - apply scale_terms_enclose; assumption.
  - apply multiply_terms_enclose; assumption.
Qed.

(** ** The test *)

Definition midpoints (a : forms) (i j : nat) : F.type := I.midpoint (constant (form_at a i j)).

Definition identity_interval (i j : nat) : interval := if Nat.eqb i j then one else zero.

Lemma identity_interval_encloses i j : encloses (identity_interval i j) (identity i j).
Proof.
  unfold identity_interval, identity. destruct Nat.eqb;
    [exact (integer_encloses 1)|exact (integer_encloses 0)].
Qed.

(** E = KA - I *)
Definition product_error (m n : nat) (k : list (list F.type)) (a : forms) : forms :=
  tabulate n n (fun i j =>
    subtract_forms (form_sum m (fun l => scale_form (point (get k i l)) (form_at a l j)))
      (constant_form (identity_interval i j))).

(** E' = E - L - LE *)
Definition corrected_error (n : nat) (e : forms) : forms :=
  let l := map (map (fun f => exact_terms (linear f))) e in
  let at_ i j := nth j (nth i l []) [] in
  tabulate n n (fun i j =>
    subtract_forms (subtract_forms (form_at e i j) (linear_form (at_ i j)))
      (form_sum n (fun k => multiply_linear (at_ i k) (form_at e k j)))).

(** |E'| v - v is negative. *)
Definition is_dominated (n : nat) (bounds : nat -> nat -> interval) (v : list F.type) : bool :=
  forallb (fun i =>
    let vi := point (nth i v F.nan) in
    is_positive vi &&
    is_negative (subtract (interval_sum n (fun j => multiply (bounds i j)
                                                      (point (nth j v F.nan)))) vi)) (seq 0 n).

Record attempt := Attempt {
  error : forms;
  bounds : list (list interval);
  vector : list F.type }.

Definition attempt_at (m n : nat) (a : forms) : attempt :=
  let e := corrected_error n (product_error m n (left_inverse m n (midpoints a)) a) in
  let p := map (map (fun f => I.abs (form_range f))) e in
  Attempt e p (dominating_vector n (fun i j => I.upper (nth j (nth i p []) I.nai))).

Definition succeeds (n : nat) (x : attempt) : bool :=
  is_dominated n (fun i j => nth j (nth i (bounds x) []) I.nai) (vector x).

Lemma full_column_rank_ext m n a b :
  (forall i j, (i < m)%nat -> (j < n)%nat -> a i j = b i j) ->
  full_column_rank m n a -> full_column_rank m n b.
Proof.
  intros E H y Hy. apply H. intros i L. rewrite <- (Hy i L). apply sum_ext. intros.
  rewrite E by assumption. reflexivity.
Qed.

Section Correct.
  Variables (t : positive -> R) (m n : nat) (a : forms) (A : nat -> nat -> R).
  Hypothesis T : in_unit_box t.
  Hypothesis a_encloses :
    forall i j, (i < m)%nat -> (j < n)%nat -> form_encloses t (form_at a i j) (A i j).
  Variable k : list (list F.type).

  Let K i l := real_of (get k i l).
  Let E i j := sum m (fun l => K i l * A l j) - identity i j.
  Let e := product_error m n k a.

  Lemma product_error_encloses i j : (i < n)%nat -> (j < n)%nat ->
    form_encloses t (form_at e i j) (E i j).
  Proof.
    intros P Q. unfold e, product_error. rewrite tabulate_at by assumption.
    apply subtract_forms_enclose.
    - apply form_sum_encloses. intros l H. apply scale_form_encloses; [apply point_encloses|].
      apply a_encloses; assumption.
    - apply constant_form_encloses, identity_interval_encloses.
  Qed.

  Let l := map (map (fun f => exact_terms (linear f))) e.
  Let at_ i j := nth j (nth i l []) [].
  (** L: the same numbers for every j. *)
  Let L i j := exact_value t (linear (form_at e i j)).

  Lemma at_encloses i j : (i < n)%nat -> (j < n)%nat -> terms_enclose t (at_ i j) (L i j).
  Proof.
    intros P Q. unfold at_, l, L, e, product_error.
    rewrite map_tabulate, tabulate_nth, tabulate_at by assumption. apply exact_terms_enclose.
  Qed.

  Let E' i j := E i j - L i j - sum n (fun k => L i k * E k j).

  Lemma corrected_error_encloses i j : (i < n)%nat -> (j < n)%nat ->
    form_encloses t (form_at (corrected_error n e) i j) (E' i j).
  Proof.
    intros P Q. unfold corrected_error. rewrite tabulate_at by assumption.
    fold l. change (nth j (nth i l []) []) with (at_ i j).
    apply subtract_forms_enclose; [apply subtract_forms_enclose|].
    - apply product_error_encloses; assumption.
    - apply linear_form_encloses, at_encloses; assumption.
    - apply form_sum_encloses. intros h H. apply multiply_linear_encloses; [exact T| |].
      + apply at_encloses; assumption.
      + apply product_error_encloses; assumption.
  Qed.

  Lemma full_rank_of_error :
    full_column_rank n n (fun i j => identity i j + E' i j) -> full_column_rank m n A.
  Proof.
    intros H. apply (full_rank_of_product n m n K).
    apply (full_rank_of_product n n n (fun i h => identity i h - L i h)).
    eapply full_column_rank_ext; [|exact H]. intros i j P Q.
    set (KA := fun h j => sum m (fun g => K h g * A g j)).
    transitivity (sum n (fun h => identity i h * KA h j)
                  + (-1) * (sum n (fun h => L i h * E h j)
                            + sum n (fun h => identity j h * L i h))).
    - rewrite !sum_identity by assumption. unfold E', E. fold (KA i j). ring.
    - rewrite <- sum_plus, <- sum_scale, <- sum_plus. apply sum_ext. intros h _.
      unfold E. fold (KA h j). unfold identity. rewrite (Nat.eqb_sym j h). ring.
  Qed.
End Correct.

Lemma is_dominated_correct n p v (e : nat -> nat -> R) :
  (forall i j, (i < n)%nat -> (j < n)%nat -> encloses (p i j) (Rabs (e i j))) ->
  is_dominated n p v = true -> full_column_rank n n (fun i j => identity i j + e i j).
Proof.
  intros P D. unfold is_dominated in D. rewrite forallb_forall in D.
  apply (dominated n e (fun i => real_of (nth i v F.nan))).
  - intros i L. specialize (D i ltac:(apply in_seq; lia)). apply andb_prop in D as [D _].
    exact (is_positive_correct _ _ D (point_encloses _)).
  - intros i L. specialize (D i ltac:(apply in_seq; lia)). apply andb_prop in D as [_ D].
    eapply is_negative_correct in D.
    + apply Rminus_lt. exact D.
    + apply subtract_encloses; [|apply point_encloses].
      apply (interval_sum_encloses n _ (fun j => Rabs (e i j) * real_of (nth j v F.nan))).
      intros j M. apply multiply_encloses; [apply P; assumption|apply point_encloses].
Qed.

Theorem attempt_correct t m n a A : in_unit_box t ->
  (forall i j, (i < m)%nat -> (j < n)%nat -> form_encloses t (form_at a i j) (A i j)) ->
  succeeds n (attempt_at m n a) = true -> full_column_rank m n A.
Proof.
  intros T H S.
  apply (full_rank_of_error t m n a A (left_inverse m n (midpoints a))).
  eapply is_dominated_correct; [|exact S]. intros i j P Q.
  unfold attempt_at. cbn [bounds]. unfold corrected_error.
  rewrite map_tabulate, tabulate_nth by assumption.
  apply absolute_encloses. eapply form_range_encloses; [exact T|].
  pose proof (corrected_error_encloses t m n a A T H (left_inverse m n (midpoints a)) i j P Q) as C.
  unfold corrected_error in C. rewrite tabulate_at in C by assumption. exact C.
Qed.
