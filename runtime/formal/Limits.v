(* SPDX-License-Identifier: Apache-2.0 *)
(** Forces that hold a load within their limits: in each box, forces are found that balance the load
    at every point of it. The matrix may have more rows than columns. *)
From Coq Require Import Reals QArith Lra Lia List PArith Bool.
From Coq Require PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Questions LinearAlgebra Intervals Forms Evaluation Boxes.
From Regulus Require Import Parts Hints Regularity Search Singularity Threshold Forces.
Import ListNotations.
Open Scope R_scope.

(** ** The claim *)

(** The forces F of the rows hold the load w: M^T D F = w, where D has the scales s of the rows. *)
Definition holds (rows columns : nat) (m : nat -> nat -> R) (s F w : nat -> R) : Prop :=
  forall j, (j < columns)%nat -> sum rows (fun i => m i j * (s i * F i)) = w j.

(** The value of expression k of a list. *)
Definition value_of (names : list R) (l : list expression) (k : nat) : R :=
  value names (nth k l no_entry).

(** The ranges and the limits are defined, and there are as many scales, components and limits as
    needed. *)
Definition is_load_given (q : question) (scales load : list expression)
    (limits : list (expression * expression)) : Prop :=
  ends_defined q /\ length scales = rows q /\ length load = columns q /\
  length limits = rows q /\
  Forall (fun l => defined [] (fst l) /\ defined [] (snd l)) limits.

(** At the point x everything is defined, and there are forces that hold the load, each between the
    limits of its row. *)
Definition are_within_limits (q : question) (scales load : list expression)
    (limits : list (expression * expression)) (x : list R) : Prop :=
  let names := extend x (definitions q) in
  model_defined q x /\ Forall (defined names) scales /\ Forall (defined names) load /\
  exists F : nat -> R,
    holds (rows q) (columns q) (entry q names) (value_of names scales) F
      (value_of names load) /\
    forall i, (i < rows q)%nat ->
      value_of [] (map fst limits) i <= F i <= value_of [] (map snd limits) i.

(** FEASIBLE: it is so at every point of the set. *)
Definition forces_within_limits (q : question) (scales load : list expression)
    (limits : list (expression * expression)) : Prop :=
  is_load_given q scales load limits /\
  forall x, in_set q x -> are_within_limits q scales load limits x.

(** PAVING: it is so at every point of the set in the parts that are kept. *)
Definition forces_within_limits_in (q : question) (w : parts) (scales load : list expression)
    (limits : list (expression * expression)) : Prop :=
  is_load_given q scales load limits /\
  forall x, in_set q x -> is_kept w x -> are_within_limits q scales load limits x.

(** INFEASIBLE: at some point of the set everything is defined, and no forces hold the load of which
    each is between the limits of its row. *)
Definition no_forces_within_limits (q : question) (scales load : list expression)
    (limits : list (expression * expression)) : Prop :=
  is_load_given q scales load limits /\
  exists x, in_set q x /\
    let names := extend x (definitions q) in
    model_defined q x /\ Forall (defined names) scales /\ Forall (defined names) load /\
    forall F : nat -> R,
      holds (rows q) (columns q) (entry q names) (value_of names scales) F
        (value_of names load) ->
      ~ forall i, (i < rows q)%nat ->
          value_of [] (map fst limits) i <= F i <= value_of [] (map snd limits) i.

(** ** Linear algebra *)

Lemma solvable n (a : nat -> nat -> R) (w : nat -> R) : full_column_rank n n a ->
  exists y, forall i, (i < n)%nat -> sum n (fun j => a i j * y j) = w i.
Proof.
  intros R.
  destruct (underdetermined n (S n) (fun i j => if Nat.eqb j n then - w i else a i j))
    as (y & E & p & P & N); [lia|].
  assert (F : forall i, (i < n)%nat -> sum n (fun j => a i j * y j) = w i * y n).
  { intros i I. specialize (E i I). simpl in E. rewrite Nat.eqb_refl in E.
    rewrite (sum_ext n _ (fun j => a i j * y j)) in E; [lra|].
    intros j J. destruct (Nat.eqb_spec j n); [lia|reflexivity]. }
  assert (Y : y n <> 0).
  { intros Z. assert (K : forall j, (j < n)%nat -> y j = 0).
    { apply R. intros i I. rewrite F by exact I. rewrite Z. ring. }
    destruct (Nat.eq_dec p n) as [->|D]; [exact (N Z)|]. apply N, K. lia. }
  exists (fun j => / y n * y j). intros i I.
  rewrite (sum_ext n _ (fun j => / y n * (a i j * y j))) by (intros; ring).
  rewrite sum_scale, F by exact I. field. exact Y.
Qed.

(** With |E|^T (|r| + y) < y, each solution of (I + E)^T q = r is within y of r. *)
Lemma correction_bound n (e : nat -> nat -> R) (r y q : nat -> R) :
  (forall k, (k < n)%nat -> 0 < y k) ->
  (forall k, (k < n)%nat -> sum n (fun j => Rabs (e j k) * (Rabs (r j) + y j)) < y k) ->
  (forall k, (k < n)%nat -> q k + sum n (fun j => e j k * q j) = r k) ->
  forall k, (k < n)%nat -> Rabs (q k - r k) <= y k.
Proof.
  intros Y S E i I.
  set (d := fun k => Rabs (q k - r k)).
  assert (D : forall k, (k < n)%nat -> d k <= sum n (fun j => Rabs (e j k) * (Rabs (r j) + d j))).
  { intros k K. unfold d. replace (q k - r k) with (- sum n (fun j => e j k * q j))
      by (specialize (E k K); lra).
    rewrite Rabs_Ropp. eapply Rle_trans; [apply sum_abs|]. apply sum_le. intros j J.
    rewrite Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|].
    replace (q j) with (r j + (q j - r j)) at 1 by ring. apply Rabs_triang. }
  destruct (largest n (fun k => d k / y k)) as [p [P M]]; [lia|]. simpl in M.
  set (m := d p / y p) in *.
  assert (B : forall j, (j < n)%nat -> d j <= m * y j).
  { intros j J. specialize (M j J). pose proof (Y j J).
    apply (Rmult_le_compat_r (y j)) in M; [|lra].
    unfold Rdiv in M at 1. rewrite Rmult_assoc, Rinv_l in M by lra. lra. }
  assert (Ep : d p = m * y p).
  { unfold m, Rdiv. rewrite Rmult_assoc, Rinv_l; [ring|]. specialize (Y p P). lra. }
  destruct (Rle_dec m 1) as [L|L].
  - specialize (B i I). fold (d i). pose proof (Y i I).
    assert (m * y i <= 1 * y i) by (apply Rmult_le_compat_r; lra). lra.
  - exfalso. specialize (S p P). specialize (D p P).
    apply (Rmult_lt_compat_l m) in S; [|lra]. rewrite <- sum_scale in S.
    enough (d p <= sum n (fun j => m * (Rabs (e j p) * (Rabs (r j) + y j)))) by lra.
    eapply Rle_trans; [exact D|]. apply sum_le. intros j J.
    replace (m * (Rabs (e j p) * (Rabs (r j) + y j)))
      with (Rabs (e j p) * (m * Rabs (r j) + m * y j)) by ring.
    apply Rmult_le_compat_l; [apply Rabs_pos|]. specialize (B j J).
    assert (1 * Rabs (r j) <= m * Rabs (r j)) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
    lra.
Qed.

(** And there is one. *)
Lemma correction n (e : nat -> nat -> R) (r y : nat -> R) :
  (forall k, (k < n)%nat -> 0 < y k) ->
  (forall k, (k < n)%nat -> sum n (fun j => Rabs (e j k) * (Rabs (r j) + y j)) < y k) ->
  exists q, (forall k, (k < n)%nat -> q k + sum n (fun j => e j k * q j) = r k) /\
            forall k, (k < n)%nat -> Rabs (q k - r k) <= y k.
Proof.
  intros Y S.
  assert (R : full_column_rank n n (fun k j => identity k j + e j k)).
  { apply (dominated n (fun k j => e j k) y Y). intros k K. eapply Rle_lt_trans; [|exact (S k K)].
    apply sum_le. intros j J. apply Rmult_le_compat_l; [apply Rabs_pos|].
    pose proof (Rabs_pos (r j)). lra. }
  destruct (solvable n _ r R) as [q Q].
  assert (E : forall k, (k < n)%nat -> q k + sum n (fun j => e j k * q j) = r k).
  { intros k K. rewrite <- (Q k K), <- (sum_identity n k q K) at 1. rewrite <- sum_plus.
    apply sum_ext. intros. ring. }
  exists q. split; [exact E|exact (correction_bound n e r y q Y S E)].
Qed.

(** ** Forces that hold a load, over a box *)

Definition list_of {A} (n : nat) (f : nat -> A) : list A := map f (seq 0 n).

Lemma list_of_nth {A} n (f : nat -> A) k d : (k < n)%nat -> nth k (list_of n f) d = f k.
Proof.
  intros K. unfold list_of. rewrite (nth_indep _ d (f O)) by (rewrite map_size, seq_size;
    exact K). rewrite map_nth, seq_nth by exact K. reflexivity.
Qed.

Definition form_of_list (l : list form) (k : nat) : form := nth k l (constant_form I.nai).

(** What is not held by forces g, near those that hold all of it: r = w - A^T g. *)
Definition rest (m n : nat) (g : list F.type) (a : forms) (w : list form) : list form :=
  list_of n (fun j => subtract_forms (form_of_list w j)
    (form_sum m (fun i => scale_form (point (nth i g F.nan)) (form_at a i j)))).

(** Approximate numbers. Nothing is proved of them. *)
Module Hint.
  Import Coq.Floats.PrimFloat.
  Open Scope float_scope.

  (** y with |E|^T (|r| + y) < y. *)
  Definition correction (n : nat) (p : nat -> nat -> float) (r : nat -> float) : list float :=
    let grain := add (mul (float_sum (list_of n r)) 0x1p-44) 0x1p-200 in
    let step y := list_of n (fun k =>
      float_sum (list_of n (fun j => mul (p j k) (add (r j) (nth j y nan))))) in
    map (fun x => add (mul x 0x1.04p+0) grain) (Nat.iter 8 step (list_of n (fun _ => zero))).

  Definition sum_of (n : nat) (f : nat -> float) : float := float_sum (list_of n f).
  Definition at_ (l : list float) (k : nat) : float := nth k l nan.

  (** K with KA = I, such that the forces K^T w have the least sum of squares by the weights. *)
  Definition shared (m n : nat) (a : list (list float)) (weight : list float) : list (list float) :=
    let weighted := tabulate m n (fun i j => mul (get a i j) (at_ weight i)) in
    let square := tabulate n n (fun j k =>
      sum_of m (fun i => mul (get weighted i j) (get a i k))) in
    let inverse := left_inverse n n (get square) in
    tabulate n m (fun k i => sum_of n (fun j => mul (get inverse k j) (get weighted i j))).

  (** The forces nearest to the middles that hold w. *)
  Definition nearest (m n : nat) (a : list (list float)) (w middles weight : list float) :
      list float :=
    let k := shared m n a weight in
    let r := list_of n (fun j =>
      sub (at_ w j) (sum_of m (fun i => mul (get a i j) (at_ middles i)))) in
    list_of m (fun i => add (at_ middles i) (sum_of n (fun j => mul (get k j i) (at_ r j)))).

  (** A step towards the forces whose largest distance from the middles, in the units, is least. *)
  Definition even_out (m n : nat) (a : list (list float)) (w middles units g : list float) :
      list float :=
    let ratio := list_of m (fun i =>
      abs (div (sub (at_ g i) (at_ middles i)) (at_ units i))) in
    let most := fold_left larger ratio 0x1p-60 in
    let weight := list_of m (fun i =>
      let x := div (at_ ratio i) most in
      div (mul (at_ units i) (at_ units i)) (add (mul (mul x x) (mul x x)) 0x1p-14)) in
    let h := nearest m n a w middles weight in
    list_of m (fun i => add (at_ g i) (div (sub (at_ h i) (at_ g i)) 5)).

  (** K and forces that hold w in the middle, if there are any within limits. *)
  Definition forces (m n : nat) (a : list (list float)) (w middles units : list float) :
      list (list float) * list float :=
    if Nat.eqb m n then
      let k := left_inverse n n (get a) in
      (k, list_of n (fun i => sum_of n (fun j => mul (get k j i) (at_ w j))))
    else
      let weight := map (fun u => mul u u) units in
      (shared m n a weight,
       Nat.iter 16 (even_out m n a w middles units) (nearest m n a w middles weight)).

  Definition half_sum (x y : float) : float := mul 0x1p-1 (add x y).
  Definition half_difference (x y : float) : float := abs (mul 0x1p-1 (sub y x)).
  Definition towards (x y : float) : float := add x (mul 0x1p-4 (sub y x)).
  Definition over (f : form) (u : float) : form := scale_form (point (div 1 u)) f.
End Hint.

Definition corrects (n : nat) (p : nat -> nat -> interval) (r : nat -> interval)
    (y : list F.type) : bool :=
  forallb (fun k =>
    let yk := point (nth k y F.nan) in
    is_positive yk &&
    is_negative (subtract (interval_sum n (fun j => multiply (p j k)
                   (add (r j) (point (nth j y F.nan))))) yk)) (seq 0 n).

(** Forces with A^T G = w, near g. K is any matrix, at best an approximate left inverse of A. *)
Definition balanced (m n : nat) (k : list (list F.type)) (g : list F.type) (a : forms)
    (w : list form) : option (list form) :=
  let e := product_error m n k a in
  let p := map (map (fun f => I.abs (form_range f))) (corrected_error n e) in
  let l := map (map (fun f => exact_terms (linear f))) e in
  let at_ i j := nth j (nth i l []) [] in
  let r := rest m n g a w in
  let sizes := map (fun f => I.abs (form_range f)) r in
  let of_p i j := nth j (nth i p []) I.nai in
  let of_r j := nth j sizes I.nai in
  let y := Hint.correction n (fun i j => I.upper (of_p i j)) (fun j => I.upper (of_r j)) in
  let of_y j := point (nth j y F.nan) in
  if corrects n of_p of_r y then
    let z := list_of n (fun i =>
      let eta := add (of_y i) (interval_sum n (fun h => multiply (I.abs (terms_range (at_ h i)))
                                                 (of_y h))) in
      add_forms (subtract_forms (form_of_list r i)
          (form_sum n (fun h => multiply_linear (at_ h i) (form_of_list r h))))
        (constant_form (multiply symmetric eta))) in
    Some (list_of m (fun i => add_forms (constant_form (point (nth i g F.nan)))
      (form_sum n (fun h => scale_form (point (get k h i)) (form_of_list z h)))))
  else None.

Lemma spread_encloses i x y : encloses i x -> Rabs y <= x -> encloses (multiply symmetric i) y.
Proof.
  intros X Y. destruct (Req_dec x 0) as [Z|N].
  - assert (y = 0).
    { destruct (Req_dec y 0) as [E|E]; [exact E|]. pose proof (Rabs_pos_lt _ E). lra. }
    subst. replace 0 with (0 * 0) by ring.
    apply multiply_encloses; [apply symmetric_encloses; rewrite Rabs_R0; lra|exact X].
  - pose proof (Rabs_pos y). replace y with (y / x * x) by (field; exact N).
    apply multiply_encloses; [|exact X]. apply symmetric_encloses.
    unfold Rdiv. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq x) by lra.
    apply (Rmult_le_reg_r x); [lra|]. rewrite Rmult_assoc, Rinv_l by lra. lra.
Qed.

Section Balanced.
  Variables (t : positive -> R) (m n : nat) (a : forms) (w : list form).
  Variables (A : nat -> nat -> R) (W : nat -> R).
  Hypothesis T : in_unit_box t.
  Hypothesis a_encloses :
    forall i j, (i < m)%nat -> (j < n)%nat -> form_encloses t (form_at a i j) (A i j).
  Hypothesis w_encloses :
    forall j, (j < n)%nat -> form_encloses t (form_of_list w j) (W j).
  Variables (k : list (list F.type)) (g : list F.type).

  Let K i l := real_of (get k i l).
  Let G0 i := real_of (nth i g F.nan).
  Let E i j := sum m (fun l => K i l * A l j) - identity i j.
  Let e := product_error m n k a.
  Let l := map (map (fun f => exact_terms (linear f))) e.
  Let at_ i j := nth j (nth i l []) [].
  Let L i j := exact_value t (linear (form_at e i j)).
  Let E' i j := E i j - L i j - sum n (fun k => L i k * E k j).
  Let r := rest m n g a w.
  Let Rest j := W j - sum m (fun i => G0 i * A i j).

  Lemma rest_encloses j : (j < n)%nat -> form_encloses t (form_of_list r j) (Rest j).
  Proof.
    intros J. unfold form_of_list, r, rest. rewrite list_of_nth by exact J.
    apply subtract_forms_enclose; [exact (w_encloses j J)|].
    apply form_sum_encloses. intros i I. apply scale_form_encloses; [apply point_encloses|].
    apply a_encloses; assumption.
  Qed.

  (** (I - L) K A = I + E'. *)
  Lemma corrected_product i j : (i < n)%nat -> (j < n)%nat ->
    sum n (fun h => (identity i h - L i h) * sum m (fun f => K h f * A f j))
    = identity i j + E' i j.
  Proof.
    intros P Q. set (KA := fun h j => sum m (fun f => K h f * A f j)).
    transitivity (sum n (fun h => identity i h * KA h j)
                  + (-1) * (sum n (fun h => L i h * E h j)
                            + sum n (fun h => identity j h * L i h))).
    - rewrite <- sum_plus, <- sum_scale, <- sum_plus. apply sum_ext. intros h _.
      unfold E. fold (KA h j). unfold identity. rewrite (Nat.eqb_sym j h). ring.
    - rewrite !sum_identity by assumption. unfold E', E. fold (KA i j). ring.
  Qed.

  (** G = g + K^T (q - L^T q) with (I + E')^T q = r. *)
  Definition forces_by (q : nat -> R) (i : nat) : R :=
    G0 i + sum n (fun h => K h i * (q h - sum n (fun f => L f h * q f))).

  Lemma forces_balance q :
    (forall j, (j < n)%nat -> q j + sum n (fun h => E' h j * q h) = Rest j) ->
    forall j, (j < n)%nat -> sum m (fun i => A i j * forces_by q i) = W j.
  Proof.
    intros Q j J. unfold forces_by.
    rewrite (sum_ext m _ (fun i => G0 i * A i j + sum n (fun h =>
      (q h - sum n (fun f => L f h * q f)) * (K h i * A i j)))).
    2: { intros i I. rewrite Rmult_plus_distr_l. f_equal; [ring|]. rewrite <- sum_scale.
         apply sum_ext. intros. ring. }
    rewrite sum_plus, (sum_swap m n).
    rewrite (sum_ext n _ (fun h => (q h - sum n (fun f => L f h * q f))
      * sum m (fun i => K h i * A i j))) by (intros; apply sum_scale).
    enough (H : sum n (fun h => (q h - sum n (fun f => L f h * q f))
                * sum m (fun i => K h i * A i j)) = Rest j) by (rewrite H; unfold Rest; ring).
    rewrite <- (Q j J). set (KA := fun h => sum m (fun i => K h i * A i j)).
    transitivity (sum n (fun h => q h * (KA h - sum n (fun f => L h f * KA f)))).
    - rewrite (sum_ext n _ (fun h => q h * KA h + (-1) * sum n (fun f => L f h * q f * KA h))).
      2: { intros h _. rewrite (sum_ext n (fun f => L f h * q f * KA h)
             (fun f => KA h * (L f h * q f))) by (intros; ring).
           rewrite sum_scale. unfold KA. ring. }
      rewrite sum_plus, sum_scale, (sum_swap n n).
      rewrite <- sum_scale, <- sum_plus. apply sum_ext. intros h _.
      rewrite (sum_ext n (fun f => L h f * q h * KA f) (fun f => q h * (L h f * KA f)))
        by (intros; ring).
      rewrite sum_scale. ring.
    - rewrite <- (sum_identity n j q J) at 1. rewrite <- sum_plus. apply sum_ext. intros h H.
      replace (KA h - sum n (fun f => L h f * KA f)) with (identity h j + E' h j).
      + unfold identity. rewrite (Nat.eqb_sym j h). ring.
      + rewrite <- corrected_product by assumption. fold KA.
        rewrite (sum_ext n _ (fun f => identity h f * KA f + (-1) * (L h f * KA f)))
          by (intros; unfold KA; ring).
        rewrite sum_plus, sum_scale, sum_identity by exact H. ring.
  Qed.

  Theorem balanced_correct f : balanced m n k g a w = Some f ->
    exists G, (forall j, (j < n)%nat -> sum m (fun i => A i j * G i) = W j) /\
      forall i, (i < m)%nat -> form_encloses t (form_of_list f i) (G i).
  Proof.
    unfold balanced. fold e. fold r. fold l.
    set (p := map (map (fun f => I.abs (form_range f))) (corrected_error n e)).
    set (sizes := map (fun f => I.abs (form_range f)) r).
    cbv zeta. set (y := Hint.correction _ _ _).
    destruct (corrects n _ _ y) eqn:C; [|discriminate]. intros [= <-].
    unfold corrects in C. rewrite forallb_forall in C.
    set (Y := fun j => real_of (nth j y F.nan)).
    assert (PE : forall i j, (i < n)%nat -> (j < n)%nat ->
              encloses (nth j (nth i p []) I.nai) (Rabs (E' i j))).
    { intros i j I J. unfold p, corrected_error. rewrite map_tabulate, tabulate_nth by assumption.
      apply absolute_encloses, (form_range_encloses t); [exact T|].
      pose proof (corrected_error_encloses t m n a A T a_encloses k i j I J) as H.
      unfold corrected_error in H. rewrite tabulate_at in H by assumption. exact H. }
    assert (SE : forall j, (j < n)%nat -> encloses (nth j sizes I.nai) (Rabs (Rest j))).
    { intros j J. unfold sizes, r, rest, list_of. rewrite map_map.
      rewrite (nth_indep _ I.nai ((fun x => I.abs (form_range (subtract_forms (form_of_list w x)
        (form_sum m (fun i => scale_form (point (nth i g F.nan)) (form_at a i x)))))) O))
        by (rewrite map_size, seq_size; exact J).
      rewrite (map_nth (fun x => I.abs (form_range (subtract_forms (form_of_list w x)
        (form_sum m (fun i => scale_form (point (nth i g F.nan)) (form_at a i x))))))), seq_nth
        by exact J.
      apply absolute_encloses, (form_range_encloses t); [exact T|].
      pose proof (rest_encloses j J) as H. unfold form_of_list, r, rest in H.
      rewrite list_of_nth in H by exact J. exact H. }
    destruct (correction n E' Rest Y) as (q & Q & D).
    { intros h H. specialize (C h ltac:(apply in_seq; lia)). apply andb_prop in C as [C _].
      exact (is_positive_correct _ _ C (point_encloses _)). }
    { intros h H. specialize (C h ltac:(apply in_seq; lia)). apply andb_prop in C as [_ C].
      apply Rminus_lt. refine (is_negative_correct _ _ C _).
      apply subtract_encloses; [|apply point_encloses]. apply interval_sum_encloses. intros j J.
      apply multiply_encloses; [apply PE; assumption|].
      apply add_encloses; [apply SE, J|apply point_encloses]. }
    exists (forces_by q). split; [exact (forces_balance q Q)|]. intros i I.
    unfold form_of_list at 1. rewrite list_of_nth by exact I. unfold forces_by.
    apply add_forms_enclose; [apply constant_form_encloses, point_encloses|].
    apply form_sum_encloses. intros h H. apply scale_form_encloses; [apply point_encloses|].
    unfold form_of_list at 1. rewrite list_of_nth by exact H.
    assert (AE : forall f, (f < n)%nat -> terms_enclose t (nth h (nth f l []) []) (L f h)).
    { intros f F. exact (at_encloses t m n a k f h F H). }
    replace (q h - sum n (fun f => L f h * q f)) with
      ((Rest h - sum n (fun f => L f h * Rest f))
       + (q h - Rest h - sum n (fun f => L f h * (q f - Rest f)))).
    2: { rewrite (sum_ext n (fun f => L f h * (q f - Rest f))
           (fun f => L f h * q f + (-1) * (L f h * Rest f))) by (intros; ring).
         rewrite sum_plus, sum_scale. ring. }
    apply add_forms_enclose.
    - apply subtract_forms_enclose; [apply rest_encloses, H|]. apply form_sum_encloses. intros f F.
      apply multiply_linear_encloses; [exact T|exact (AE f F)|apply rest_encloses, F].
    - apply constant_form_encloses.
      apply (spread_encloses _ (Y h + sum n (fun f => Rabs (L f h) * Y f))).
      + apply add_encloses; [apply point_encloses|]. apply interval_sum_encloses. intros f F.
        apply multiply_encloses; [|apply point_encloses].
        apply absolute_encloses. eapply terms_range_encloses; [exact T|exact (AE f F)].
      + unfold Rminus at 1. eapply Rle_trans; [apply Rabs_triang|].
        apply Rplus_le_compat; [exact (D h H)|]. rewrite Rabs_Ropp.
        eapply Rle_trans; [apply sum_abs|]. apply sum_le. intros f F. rewrite Rabs_mult.
        apply Rmult_le_compat_l; [apply Rabs_pos|exact (D f F)].
  Qed.
End Balanced.

(** ** The test of a box *)

Definition range_or_none (v : option enclosure) : interval :=
  match v with Some w => range w | None => I.nai end.
Definition is_nonzero (v : option enclosure) : bool := is_not_zero (range_or_none v).

Definition inverse_form (v : option enclosure) : form :=
  match v with Some w => polynomial (enclose_inverse w) | None => constant_form I.nai end.

(** The forces of the rows: D F = G. *)
Definition row_forces (m : nat) (s : list (option enclosure)) (g : list form) : list form :=
  list_of m (fun i => multiply_forms (inverse_form (nth i s None)) (form_of_list g i)).

Definition is_between (lower upper : interval) (f : form) : bool :=
  let i := form_range f in
  is_not_negative (subtract i lower) && is_not_positive (subtract i upper).

Definition bounds_of_limits (l : list expression) : list interval :=
  map (fun e => range_or_none (evaluate [] e)) l.

(** What makes the forces that are not shown to be within their limits vary. *)
Definition attempt_of_forces (f : list form) (inside : nat -> bool) (units : list F.type) :
    attempt :=
  let open := filter (fun i => negb (inside i)) (seq 0 (length f)) in
  let scaled := map (fun i => Hint.over (form_of_list f i) (nth i units F.nan)) open in
  let all (part : form -> terms) := flat_map part scaled in
  Attempt [[Form zero (all linear) (all quadratic) (all single)]] [] [PrimFloat.one].

Definition test_limits (q : question) (scales load : list expression)
    (limits : list (expression * expression)) (m : method) (b : box) : answer :=
  let names := evaluate_definitions (variables (second_order m) b) (definitions q) in
  if existsb (is_excluded names) (constraints q) then Outside
  else
    let a := map (map (evaluate names)) (matrix q) in
    let s := map (evaluate names) scales in
    let w := map (evaluate names) load in
    if is_model_known q names a && forallb is_known s && forallb is_known w
       && forallb is_nonzero s
    then
      let a := map (map form_of) a in
      let w := map form_of w in
      let lower := bounds_of_limits (map fst limits) in
      let upper := bounds_of_limits (map snd limits) in
      let middle l := map I.midpoint l in
      let of_rows f := list_of (rows q) (fun i =>
        PrimFloat.mul (I.midpoint (range_or_none (nth i s None)))
          (f (nth i (middle lower) F.nan) (nth i (middle upper) F.nan))) in
      let units := of_rows Hint.half_difference in
      let hint := Hint.forces (rows q) (columns q) (tabulate (rows q) (columns q) (midpoints a))
        (map (fun f => I.midpoint (constant f)) w) (of_rows Hint.half_sum) units in
      match balanced (rows q) (columns q) (fst hint) (snd hint) a w with
      | Some g =>
          let f := row_forces (rows q) s g in
          let inside i :=
            is_between (nth i lower I.nai) (nth i upper I.nai) (form_of_list f i) in
          if forallb inside (seq 0 (rows q)) then Regular
          else Open (attempt_of_forces f inside units)
      | None => Open (attempt_at (rows q) (columns q) a)
      end
    else Undefined.

(** There is a scale and there are limits for each row, and a component of the load for each
    column. *)
Definition is_load_known (q : question) (scales load : list expression)
    (limits : list (expression * expression)) : bool :=
  Nat.eqb (length scales) (rows q) && Nat.eqb (length load) (columns q)
  && Nat.eqb (length limits) (rows q)
  && forallb (fun l => is_known (evaluate [] (fst l)) && is_known (evaluate [] (snd l))) limits.

(** A search in each part that is kept. *)
Definition check_limits_in (q : question) (w : parts) (scales load : list expression)
    (limits : list (expression * expression)) (m : method) : bool :=
  is_load_known q scales load limits &&
  match enclose_ranges (ranges q) with
  | Some root =>
      forallb (fun b => match search (test_limits q scales load limits m) root (deepest m) b with
                        | Some _ => true
                        | None => false
                        end) (kept_boxes w root)
  | None => false
  end.

(** The splits of each part that is kept. *)
Definition check_limits_trees (q : question) (w : parts) (scales load : list expression)
    (limits : list (expression * expression)) (m : method) (ts : list tree) : bool :=
  is_load_known q scales load limits &&
  match enclose_ranges (ranges q) with
  | Some root =>
      let bs := kept_boxes w root in
      Nat.eqb (length bs) (length ts) &&
      forallb (fun u => check_parts (test_limits q scales load limits m) (snd u) (fst u))
        (combine bs ts)
  | None => false
  end.

(** The whole set is kept. *)
Definition check_limits (q : question) := check_limits_in q Kept.

Definition check_limits_tree (q : question) (scales load : list expression)
    (limits : list (expression * expression)) (m : method) (t : tree) : bool :=
  check_limits_trees q Kept scales load limits m [t].

(** ** It is correct *)

Lemma all_known_represent t vs names es : in_unit_box t -> known t vs names ->
  forallb is_known (map (evaluate vs) es) = true -> Forall (defined names) es /\
  forall k, (k < length es)%nat ->
    exists v, nth k (map (evaluate vs) es) None = Some v /\ represents t v (value_of names es k).
Proof.
  intros T K. induction es as [|e es IH]; intros D; [split; [constructor|simpl; lia]|].
  simpl in D. apply andb_prop in D as [D1 D2]. destruct (IH D2) as [F V].
  destruct (evaluate vs e) as [v|] eqn:E; [|discriminate].
  destruct (evaluate_correct t vs names e v T K E) as [De R].
  split; [constructor; assumption|]. intros [|k] Hk; simpl.
  - exists v. split; [exact E|exact R].
  - apply V. simpl in Hk. lia.
Qed.

Lemma bound_of_limit l k : (k < length l)%nat ->
  Forall (fun e => is_known (evaluate [] e) = true) l ->
  encloses (nth k (bounds_of_limits l) I.nai) (value_of [] l k).
Proof.
  intros K H. unfold bounds_of_limits, value_of.
  rewrite (nth_indep _ I.nai (range_or_none (evaluate [] no_entry)))
    by (rewrite map_size; exact K).
  rewrite (map_nth (fun e => range_or_none (evaluate [] e))). rewrite Forall_forall in H.
  specialize (H (nth k l no_entry) (nth_In _ _ K)).
  destruct (evaluate [] (nth k l no_entry)) as [v|] eqn:E; [|discriminate].
  exact (proj2 (threshold_known _ _ E)).
Qed.

Lemma is_load_known_correct q scales load limits : is_load_known q scales load limits = true ->
  length scales = rows q /\ length load = columns q /\ length limits = rows q /\
  Forall (fun l => defined [] (fst l) /\ defined [] (snd l)) limits /\
  Forall (fun e => is_known (evaluate [] e) = true) (map fst limits) /\
  Forall (fun e => is_known (evaluate [] e) = true) (map snd limits).
Proof.
  unfold is_load_known. intros H. apply andb_prop in H as [H K].
  repeat match goal with H : _ && _ = true |- _ => apply andb_prop in H as [H ?] end.
  rewrite forallb_forall in K.
  repeat (split; [apply Nat.eqb_eq; assumption|]).
  assert (D : forall e, is_known (evaluate [] e) = true -> defined [] e).
  { intros e E. destruct (evaluate [] e) as [v|] eqn:V; [|discriminate].
    exact (proj1 (threshold_known _ _ V)). }
  split; [|split]; rewrite Forall_forall.
  - intros l In_l. specialize (K l In_l). apply andb_prop in K as [K1 K2]. split; apply D;
      assumption.
  - intros e In_e. apply in_map_iff in In_e as (l & <- & In_l). specialize (K l In_l).
    apply andb_prop in K as [K1 _]. exact K1.
  - intros e In_e. apply in_map_iff in In_e as (l & <- & In_l). specialize (K l In_l).
    apply andb_prop in K as [_ K2]. exact K2.
Qed.

Lemma is_between_correct t lower upper f x l u : in_unit_box t ->
  is_between lower upper f = true -> form_encloses t f x -> encloses lower l -> encloses upper u ->
  l <= x <= u.
Proof.
  unfold is_between. intros T H F A B. apply andb_prop in H as [H1 H2].
  pose proof (form_range_encloses t f x T F) as R.
  pose proof (is_not_negative_correct _ _ H1 (subtract_encloses _ _ _ _ R A)).
  pose proof (is_not_positive_correct _ _ H2 (subtract_encloses _ _ _ _ R B)). lra.
Qed.

Definition are_within_at (q : question) (scales load : list expression)
    (limits : list (expression * expression)) (x : list R) : Prop :=
  in_set q x -> are_within_limits q scales load limits x.

Theorem test_limits_correct q scales load limits m :
  is_load_known q scales load limits = true -> forall b x, in_box b x ->
  is_closed (test_limits q scales load limits m b) = true ->
  are_within_at q scales load limits x.
Proof.
  intros Q b x B. apply is_load_known_correct in Q as (Ls & Lw & Ll & _ & Kl & Ku).
  unfold test_limits.
  set (vs := evaluate_definitions (variables (second_order m) b) (definitions q)).
  destruct existsb eqn:E; [intros _ S; elim (outside_correct q m b x B E S)|].
  set (a := map (map (evaluate vs)) (matrix q)). unfold is_model_known.
  destruct (forallb is_known vs) eqn:D1; [|discriminate].
  destruct (forallb (fun e => is_known (evaluate vs e)) (also_defined q)) eqn:D2; [|discriminate].
  destruct (forallb (forallb is_known) a) eqn:D3; [|discriminate].
  destruct (forallb (fun r => Nat.eqb (length r) (columns q)) a) eqn:D4; [|discriminate].
  cbn [andb]. set (s := map (evaluate vs) scales). set (w := map (evaluate vs) load).
  destruct (forallb is_known s) eqn:D5; [|discriminate].
  destruct (forallb is_known w) eqn:D6; [|discriminate].
  destruct (forallb is_nonzero s) eqn:D7; [|discriminate]. cbn [andb].
  destruct (balanced _ _ _ _ _ _) as [g|] eqn:G; [|discriminate].
  set (f := row_forces (rows q) s g).
  destruct (forallb _ (seq 0 (rows q))) eqn:L; [|discriminate]. intros _ _.
  pose proof (coordinate_in_unit_box b x B) as T.
  pose proof (known_definitions _ (definitions q) _ _ T (variables_known (second_order m) b x B))
    as K.
  set (names := extend x (definitions q)) in *.
  destruct (all_known_represent _ vs names scales T K D5) as [Ds Vs].
  destruct (all_known_represent _ vs names load T K D6) as [Dw Vw].
  unfold are_within_limits. fold names.
  split; [apply (everything_defined q m b x B); assumption|]. split; [exact Ds|].
  split; [exact Dw|].
  destruct (balanced_correct (coordinate b x) (rows q) (columns q) (map (map form_of) a)
    (map form_of w) (entry q names) (value_of names load) T
    (fun i j => entries_enclosed q m b x B i j D3 D4)) with (2 := G) as (R & Bal & En).
  { intros j J. unfold form_of_list.
    rewrite (nth_indep _ _ (form_of None)) by (unfold w; rewrite !map_size, Lw; exact J).
    rewrite map_nth. destruct (Vw j) as (v & V & Rv); [rewrite Lw; exact J|].
    unfold w. rewrite V. apply Rv. }
  assert (N : forall i, (i < rows q)%nat -> value_of names scales i <> 0).
  { intros i I. destruct (Vs i) as (v & V & Rv); [rewrite Ls; exact I|].
    rewrite forallb_forall in D7. specialize (D7 (nth i s None)). unfold is_nonzero in D7.
    fold s in V. rewrite V in D7. apply (is_not_zero_correct (range v)); [|apply Rv].
    apply D7. rewrite <- V. apply nth_In. unfold s. rewrite map_size, Ls. exact I. }
  exists (fun i => 1 / value_of names scales i * R i). split.
  - intros j J. rewrite <- (Bal j J). apply sum_ext. intros i I. field. exact (N i I).
  - intros i I. rewrite forallb_forall in L. specialize (L i ltac:(apply in_seq; lia)).
    refine (is_between_correct (coordinate b x) _ _ _ _ _ _ T L _ _ _);
      try (apply bound_of_limit; [rewrite map_size, Ll; exact I|assumption]).
    unfold f, row_forces, form_of_list at 1. rewrite list_of_nth by exact I.
    apply multiply_forms_enclose; [exact T| |exact (En i I)].
    destruct (Vs i) as (v & V & Rv); [rewrite Ls; exact I|]. fold s in V. rewrite V.
    exact (proj2 (inverse_represents _ v _ (N i I) T Rv)).
Qed.

Lemma limits_of_boxes q w scales load limits root :
  is_load_known q scales load limits = true -> enclose_ranges (ranges q) = Some root ->
  (forall b x, In b (kept_boxes w root) -> in_box b x -> are_within_at q scales load limits x) ->
  forces_within_limits_in q w scales load limits.
Proof.
  intros K R H. apply is_load_known_correct in K as (A & B & C & D & _).
  split; [exact (conj (enclose_ranges_defined q root R) (conj A (conj B (conj C D))))|].
  intros x X W.
  destruct (kept_boxes_correct w root x) as (b & I & Bx); [|exact W|exact (H b x I Bx X)].
  eapply enclose_ranges_correct; [exact R|exact (proj1 X)].
Qed.

Theorem check_limits_in_correct q w scales load limits m :
  check_limits_in q w scales load limits m = true ->
  forces_within_limits_in q w scales load limits.
Proof.
  unfold check_limits_in. intros H. apply andb_prop in H as [K H].
  destruct enclose_ranges as [root|] eqn:R; [|discriminate]. rewrite forallb_forall in H.
  apply (limits_of_boxes _ _ _ _ _ root K R). intros b x I B. specialize (H b I).
  destruct search as [n|] eqn:L; [|discriminate].
  exact (search_correct _ (are_within_at q scales load limits)
    (test_limits_correct q scales load limits m K) _ _ b x n B L).
Qed.

(** The same with hints. *)
Theorem check_limits_trees_correct q w scales load limits m ts :
  check_limits_trees q w scales load limits m ts = true ->
  forces_within_limits_in q w scales load limits.
Proof.
  unfold check_limits_trees. intros H. apply andb_prop in H as [K H].
  destruct enclose_ranges as [root|] eqn:R; [|discriminate]. apply andb_prop in H as [N H].
  apply Nat.eqb_eq in N. rewrite forallb_forall in H.
  apply (limits_of_boxes _ _ _ _ _ root K R). intros b x I B.
  destruct (In_nth _ _ [] I) as (k & Hk & E).
  assert (J : In (b, nth k ts Leaf) (combine (kept_boxes w root) ts)).
  { rewrite <- E, <- combine_nth by exact N. apply nth_In.
    rewrite combine_size, <- N, Nat.min_id. exact Hk. }
  exact (check_parts_correct _ (are_within_at q scales load limits)
    (test_limits_correct q scales load limits m K) _ b x B (H _ J)).
Qed.

(** The same of the whole set. *)
Lemma limits_of_kept q scales load limits : forces_within_limits_in q Kept scales load limits ->
  forces_within_limits q scales load limits.
Proof. intros [G H]. split; [exact G|]. intros x X. exact (H x X Logic.I). Qed.

Theorem check_limits_correct q scales load limits m :
  check_limits q scales load limits m = true -> forces_within_limits q scales load limits.
Proof. intros H. exact (limits_of_kept _ _ _ _ (check_limits_in_correct _ _ _ _ _ _ H)). Qed.

Theorem check_limits_tree_correct q scales load limits m t :
  check_limits_tree q scales load limits m t = true -> forces_within_limits q scales load limits.
Proof. intros H. exact (limits_of_kept _ _ _ _ (check_limits_trees_correct _ _ _ _ _ _ _ H)). Qed.

(** The same for a trajectory, without and with a hint for each piece. *)
Definition check_limits_pieces (q : list expression -> question) (scales load : list expression)
    (limits : list (expression * expression)) (m : method) (pieces : list (list expression)) :
    bool := forallb (fun piece => check_limits (q piece) scales load limits m) pieces.

Theorem check_limits_pieces_correct q scales load limits m pieces :
  check_limits_pieces q scales load limits m pieces = true ->
  Forall (fun piece => forces_within_limits (q piece) scales load limits) pieces.
Proof.
  unfold check_limits_pieces. rewrite forallb_forall. intros H. apply Forall_forall.
  intros piece P. apply (check_limits_correct (q piece) scales load limits m), H, P.
Qed.

Definition check_limits_piece_trees (q : list expression -> question)
    (scales load : list expression) (limits : list (expression * expression)) (m : method) :
    list (list expression) -> list tree -> bool :=
  check_each (fun q => check_limits_tree q scales load limits m) q.

Theorem check_limits_piece_trees_correct q scales load limits m pieces trees :
  check_limits_piece_trees q scales load limits m pieces trees = true ->
  Forall (fun piece => forces_within_limits (q piece) scales load limits) pieces.
Proof.
  apply (check_each_correct _ (fun q => forces_within_limits q scales load limits)).
  intros q' t. apply check_limits_tree_correct.
Qed.

(** ** A load that no forces hold *)

(** Along the direction y the load needs more than the forces of all rows can give: twice the sum of
    w_j y_j is more than the sum of c_i (l_i + u_i) + |c_i| (u_i - l_i), where c_i is s_i times the
    sum of m_ij y_j. *)
Definition check_no_forces (q : question) (scales load : list expression)
    (limits : list (expression * expression)) (position direction : coordinates) : bool :=
  let a := map (fun u => clamp (fst u) (snd u)) (combine position (ranges q)) in
  let b := hull a a in
  let names := evaluate_definitions (variables 99 b) (definitions q) in
  let y j := point (nth j direction F.nan) in
  let along (l : list expression) :=
    interval_sum (columns q) (fun j =>
      multiply (range_or_none (evaluate names (nth j l no_entry))) (y j)) in
  let lower i := nth i (bounds_of_limits (map fst limits)) I.nai in
  let upper i := nth i (bounds_of_limits (map snd limits)) I.nai in
  let gift i :=
    let c := multiply (range_or_none (evaluate names (nth i scales no_entry)))
      (along (nth i (matrix q) [])) in
    add (multiply c (add (lower i) (upper i)))
      (multiply (I.abs c) (subtract (upper i) (lower i))) in
  let need := along load in
  match enclose_ranges (ranges q) with Some _ => true | None => false end
  && is_load_known q scales load limits && in_set_and_known q b
  && forallb is_known (map (evaluate names) scales) && forallb is_known (map (evaluate names) load)
  && is_positive (subtract (add need need) (interval_sum (rows q) gift)).

Lemma value_enclosed t vs names e : in_unit_box t -> known t vs names ->
  encloses (range_or_none (evaluate vs e)) (value names e).
Proof.
  intros T K. destruct (evaluate vs e) as [v|] eqn:E; [|apply unknown_encloses].
  exact (proj1 (proj2 (evaluate_correct t vs names e v T K E))).
Qed.

Lemma most_of_force c f l u : l <= f <= u ->
  c * f + c * f <= c * (l + u) + Rabs c * (u - l).
Proof.
  intros [L U]. destruct (Rle_dec 0 c) as [P|N].
  - rewrite Rabs_pos_eq by exact P. nra.
  - rewrite Rabs_left by lra. nra.
Qed.

Theorem check_no_forces_correct q scales load limits position direction :
  check_no_forces q scales load limits position direction = true ->
  no_forces_within_limits q scales load limits.
Proof.
  unfold check_no_forces. set (a := map _ (combine position (ranges q))). set (b := hull a a).
  set (vs := evaluate_definitions (variables 99 b) (definitions q)). cbv zeta. intros H.
  apply andb_prop in H as [H C]. apply andb_prop in H as [H L]. apply andb_prop in H as [H S].
  apply andb_prop in H as [G H]. apply andb_prop in G as [Q G].
  pose proof (is_load_known_correct _ _ _ _ G) as (G1 & G2 & G3 & G4 & G5 & G6).
  assert (B : in_box b (along a a 0)) by (apply hull_contains; lra).
  set (x := along a a 0) in *. destruct (in_set_and_known_correct q b x B H) as [X M].
  pose proof (coordinate_in_unit_box b x B) as T.
  pose proof (known_definitions _ (definitions q) _ _ T (variables_known 99 b x B)) as K.
  fold vs in K. set (names := extend x (definitions q)) in *.
  destruct (enclose_ranges (ranges q)) as [root|] eqn:R; [|discriminate].
  apply (enclose_ranges_defined q root) in R.
  split; [exact (conj R (conj G1 (conj G2 (conj G3 G4))))|]. exists x. split; [exact X|].
  fold names. split; [exact M|].
  split; [exact (proj1 (all_known_represent _ vs names scales T K S))|].
  split; [exact (proj1 (all_known_represent _ vs names load T K L))|].
  intros F HF W.
  set (y := fun j => real_of (nth j direction F.nan)).
  set (c := fun i => value_of names scales i
    * sum (columns q) (fun j => entry q names i j * y j)).
  assert (N : forall l, encloses (interval_sum (columns q) (fun j =>
      multiply (range_or_none (evaluate vs (nth j l no_entry))) (point (nth j direction F.nan))))
    (sum (columns q) (fun j => value_of names l j * y j))).
  { intros l. apply interval_sum_encloses. intros j J. apply multiply_encloses;
      [|apply point_encloses]. exact (value_enclosed _ vs names _ T K). }
  set (lower := value_of [] (map fst limits)) in *.
  set (upper := value_of [] (map snd limits)) in *.
  set (gift := fun i => c i * (lower i + upper i) + Rabs (c i) * (upper i - lower i)).
  assert (P : 0 < sum (columns q) (fun j => value_of names load j * y j)
                + sum (columns q) (fun j => value_of names load j * y j)
                - sum (rows q) gift).
  { refine (is_positive_correct _ _ C (subtract_encloses _ _ _ _ (add_encloses _ _ _ _ (N load)
      (N load)) (interval_sum_encloses (rows q) _ gift _))).
    intros i I.
    assert (Ci : encloses (multiply (range_or_none (evaluate vs (nth i scales no_entry)))
        (interval_sum (columns q) (fun j => multiply
          (range_or_none (evaluate vs (nth j (nth i (matrix q) []) no_entry)))
          (point (nth j direction F.nan))))) (c i)).
    { apply multiply_encloses; [exact (value_enclosed _ vs names _ T K)|].
      exact (N (nth i (matrix q) [])). }
    assert (Li : encloses (nth i (bounds_of_limits (map fst limits)) I.nai) (lower i)).
    { apply bound_of_limit; [rewrite map_size; lia|exact G5]. }
    assert (Ui : encloses (nth i (bounds_of_limits (map snd limits)) I.nai) (upper i)).
    { apply bound_of_limit; [rewrite map_size; lia|exact G6]. }
    apply add_encloses; apply multiply_encloses.
    - exact Ci.
    - apply add_encloses; assumption.
    - apply absolute_encloses, Ci.
    - apply subtract_encloses; assumption. }
  assert (E : sum (columns q) (fun j => value_of names load j * y j)
              = sum (rows q) (fun i => c i * F i)).
  { rewrite (sum_ext (columns q) _ (fun j =>
      sum (rows q) (fun i => entry q names i j * (value_of names scales i * F i) * y j))).
    - rewrite sum_swap. apply sum_ext. intros i _. unfold c.
      rewrite (sum_ext (columns q) _ (fun j =>
        value_of names scales i * F i * (entry q names i j * y j))) by (intros; ring).
      rewrite sum_scale. ring.
    - intros j J. rewrite <- (HF j J), Rmult_comm, <- sum_scale. apply sum_ext. intros. ring. }
  rewrite E, <- sum_plus in P.
  assert (Le : sum (rows q) (fun i => c i * F i + c i * F i) <= sum (rows q) gift).
  { apply sum_le. intros i I. apply most_of_force, W, I. }
  lra.
Qed.
