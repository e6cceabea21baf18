(* SPDX-License-Identifier: Apache-2.0 *)
(** Derivatives of expressions, as expressions. The names move along a curve; the derivative of name
    k is the name N + k. A name that does not move has none. *)
From Coq Require Import Reals QArith Qreals Lra Lia List Bool.
From Coquelicot Require Import Coquelicot.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions.
Import ListNotations.
Open Scope R_scope.

Definition whole (n : Z) : expression := Constant (n # 1).

(** None: the expression does not move. *)
Definition add_slopes (a b : option expression) : option expression :=
  match a, b with
  | None, _ => b
  | _, None => a
  | Some x, Some y => Some (Add x y)
  end.

Definition times (e : expression) : option expression -> option expression :=
  option_map (Multiply e).

(** (a/b)' = (a' - a/b b')/b. *)
Definition quotient_slope (a b : expression) (x y : option expression) : option expression :=
  match x, y with
  | None, None => None
  | Some x, None => Some (Divide x b)
  | None, Some y => Some (Negate (Divide (Multiply (Divide a b) y) b))
  | Some x, Some y => Some (Divide (Subtract x (Multiply (Divide a b) y)) b)
  end.

Fixpoint slope (N : nat) (moving : list bool) (e : expression) : option expression :=
  let recurse := slope N moving in
  match e with
  | Constant _ | Pi => None
  | Name k => if nth k moving false then Some (Name (N + k)) else None
  | Negate a => option_map Negate (recurse a)
  | Add a b => add_slopes (recurse a) (recurse b)
  | Subtract a b => add_slopes (recurse a) (option_map Negate (recurse b))
  | Multiply a b => add_slopes (times b (recurse a)) (times a (recurse b))
  | Divide a b => quotient_slope a b (recurse a) (recurse b)
  | Power a n => times (Multiply (whole (Z.of_nat n)) (Power a (pred n))) (recurse a)
  | Sqrt a => option_map (fun x => Divide x (Multiply (whole 2) (Sqrt a))) (recurse a)
  | Sin a => times (Cos a) (recurse a)
  | Cos a => times (Negate (Sin a)) (recurse a)
  | Atan a => option_map (fun x => Divide x (Add (whole 1) (Power a 2))) (recurse a)
  | Exp a => times (Exp a) (recurse a)
  | Log a => option_map (fun x => Divide x a) (recurse a)
  | Abs a => times (Divide a (Abs a)) (recurse a)
  end.

Definition slope_value (names : list R) (s : option expression) : R :=
  match s with Some e => value names e | None => 0 end.
Definition slope_defined (names : list R) (s : option expression) : Prop :=
  match s with Some e => defined names e | None => True end.

Lemma whole_value names n : value names (whole n) = IZR n.
Proof. unfold whole. simpl. unfold Q2R. simpl. field. Qed.

Lemma add_slopes_value A x y :
  slope_value A (add_slopes x y) = slope_value A x + slope_value A y.
Proof. destruct x, y; simpl; ring. Qed.

Lemma add_slopes_defined A x y :
  slope_defined A (add_slopes x y) -> slope_defined A x /\ slope_defined A y.
Proof. destruct x, y; simpl; tauto. Qed.

Lemma times_value A e x : slope_value A (times e x) = value A e * slope_value A x.
Proof. destruct x; simpl; ring. Qed.

Lemma times_defined A e x : slope_defined A (times e x) -> slope_defined A x.
Proof. destruct x; simpl; tauto. Qed.

Lemma negate_value A x : slope_value A (option_map Negate x) = - slope_value A x.
Proof. destruct x; simpl; ring. Qed.

Lemma negate_defined A x : slope_defined A (option_map Negate x) -> slope_defined A x.
Proof. destruct x; simpl; tauto. Qed.

Lemma absolute_derive x : x <> 0 -> is_derive Rabs x (x / Rabs x).
Proof.
  intros N. apply is_derive_Reals. destruct (Rlt_dec 0 x) as [P|P].
  - rewrite Rabs_pos_eq by lra. replace (x / x) with 1 by (field; lra). apply Rabs_derive_1, P.
  - rewrite Rabs_left by lra. replace (x / - x) with (-1) by (field; lra).
    apply Rabs_derive_2. lra.
Qed.

Lemma is_derive_value (g : R -> R) (x d d' : R) : d = d' -> is_derive g x d -> is_derive g x d'.
Proof. intros <-. trivial. Qed.

Section Slope.
  Variables (N : nat) (moving : list bool) (names : R -> list R) (s : R) (A : list R).
  (** A begins with the names at s, and has their derivatives from place N on. *)
  Hypothesis same : forall k, (k < length (names s))%nat -> nth k A 0 = nth k (names s) 0.
  Hypothesis moves : forall k, nth k moving false = true ->
    is_derive (fun t => nth k (names t) 0) s (nth (N + k) A 0).
  Hypothesis stays : forall k, nth k moving false = false ->
    forall t, nth k (names t) 0 = nth k (names s) 0.

  Lemma value_same e : defined (names s) e -> value A e = value (names s) e.
  Proof.
    induction e; simpl; intros D; try reflexivity; try (apply same, D);
      repeat match goal with H : _ /\ _ |- _ => destruct H end;
      repeat match goal with H : ?P, IH : ?P -> value A _ = _ |- _ => rewrite (IH H); clear IH end;
      reflexivity.
  Qed.

  Lemma no_slope e : slope N moving e = None -> forall t, value (names t) e = value (names s) e.
  Proof.
    induction e; simpl; intros E t; try reflexivity.
    - destruct (nth k moving false) eqn:M; [discriminate|]. apply stays, M.
    - destruct (slope N moving e); [discriminate|]. rewrite IHe by reflexivity. reflexivity.
    - destruct (slope N moving e1), (slope N moving e2); try discriminate.
      rewrite IHe1, IHe2 by reflexivity. reflexivity.
    - destruct (slope N moving e1), (slope N moving e2); try discriminate.
      rewrite IHe1, IHe2 by reflexivity. reflexivity.
    - destruct (slope N moving e1), (slope N moving e2); try discriminate.
      rewrite IHe1, IHe2 by reflexivity. reflexivity.
    - destruct (slope N moving e1), (slope N moving e2); try discriminate.
      rewrite IHe1, IHe2 by reflexivity. reflexivity.
    - destruct (slope N moving e); [discriminate|]. rewrite IHe by reflexivity. reflexivity.
    - destruct (slope N moving e); [discriminate|]. rewrite IHe by reflexivity. reflexivity.
    - destruct (slope N moving e); [discriminate|]. rewrite IHe by reflexivity. reflexivity.
    - destruct (slope N moving e); [discriminate|]. rewrite IHe by reflexivity. reflexivity.
    - destruct (slope N moving e); [discriminate|]. rewrite IHe by reflexivity. reflexivity.
    - destruct (slope N moving e); [discriminate|]. rewrite IHe by reflexivity. reflexivity.
    - destruct (slope N moving e); [discriminate|]. rewrite IHe by reflexivity. reflexivity.
    - destruct (slope N moving e); [discriminate|]. rewrite IHe by reflexivity. reflexivity.
  Qed.

  Let f e t := value (names t) e.

  Lemma constant_derive e : slope N moving e = None -> is_derive (f e) s 0.
  Proof.
    intros E. apply (is_derive_ext (fun _ => f e s)); [|apply @is_derive_const].
    intros t. symmetry. apply no_slope, E.
  Qed.

  (** A function of one operand. *)
  Lemma compose g e d d' : is_derive g (value (names s) e) d' -> is_derive (f e) s d ->
    is_derive (fun t => g (f e t)) s (d * d').
  Proof. intros G E. exact (is_derive_comp g (f e) s d' d G E). Qed.

  Theorem slope_correct e : defined (names s) e -> slope_defined A (slope N moving e) ->
    is_derive (f e) s (slope_value A (slope N moving e)).
  Proof.
    induction e; intros D S.
    - apply constant_derive. reflexivity.
    - apply constant_derive. reflexivity.
    - simpl in *. destruct (nth k moving false) eqn:M; [apply moves, M|].
      apply constant_derive. simpl. rewrite M. reflexivity.
    - simpl in *. apply negate_defined in S. rewrite negate_value.
      apply @is_derive_opp. auto.
    - simpl in *. destruct D as [D1 D2]. apply add_slopes_defined in S as [S1 S2].
      rewrite add_slopes_value. apply @is_derive_plus; auto.
    - simpl in *. destruct D as [D1 D2]. apply add_slopes_defined in S as [S1 S2].
      rewrite add_slopes_value, negate_value. apply negate_defined in S2.
      apply @is_derive_minus; auto.
    - simpl in *. destruct D as [D1 D2]. apply add_slopes_defined in S as [S1 S2].
      apply times_defined in S1, S2. rewrite add_slopes_value, !times_value.
      rewrite (value_same e1), (value_same e2) by assumption.
      eapply is_derive_value; [|apply (is_derive_mult (f e1) (f e2)); [apply IHe1|apply IHe2|]];
        try assumption; [|intros; apply Rmult_comm].
      unfold f, plus, mult. simpl. ring.
    - destruct D as (D1 & D2 & Z).
      assert (S1 : slope_defined A (slope N moving e1)).
      { simpl in S. destruct (slope N moving e1), (slope N moving e2); simpl in *; tauto. }
      assert (S2 : slope_defined A (slope N moving e2)).
      { simpl in S. destruct (slope N moving e1), (slope N moving e2); simpl in *; tauto. }
      pose proof (is_derive_div (f e1) (f e2) s _ _ (IHe1 D1 S1) (IHe2 D2 S2) Z) as H.
      eapply is_derive_value; [|exact H]. unfold f. simpl.
      destruct (slope N moving e1), (slope N moving e2); simpl;
        rewrite ?(value_same e1), ?(value_same e2) by assumption; field; exact Z.
    - simpl in *. apply times_defined in S. rewrite times_value.
      eapply is_derive_value; [|apply (is_derive_pow (f e) n s _ (IHe D S))].
      simpl. rewrite (value_same e) by exact D. rewrite INR_IZR_INZ. unfold f, Q2R. simpl. field.
    - destruct D as [D P]. simpl in S.
      assert (S1 : slope_defined A (slope N moving e)).
      { destruct (slope N moving e); simpl in *; tauto. }
      simpl. destruct (slope N moving e) as [d|] eqn:E.
      + simpl in S. destruct S as (Sd & _ & Z). rewrite (value_same e) in Z by exact D.
        assert (0 < value (names s) e).
        { destruct P as [P|P]; [exact P|]. rewrite <- P, sqrt_0 in Z. lra. }
        simpl. rewrite (value_same e) by exact D.
        eapply is_derive_value; [|apply (compose sqrt e); [apply is_derive_Reals,
          derivable_pt_lim_sqrt; assumption|apply IHe; assumption]].
        simpl. unfold Q2R. simpl. pose proof (sqrt_lt_R0 _ H). field. lra.
      + apply constant_derive. simpl. rewrite E. reflexivity.
    - simpl in *. apply times_defined in S. rewrite times_value. simpl.
      rewrite (value_same e) by exact D.
      eapply is_derive_value; [|apply (compose sin e); [apply is_derive_Reals,
        derivable_pt_lim_sin|apply IHe; assumption]].
      ring.
    - simpl in *. apply times_defined in S. rewrite times_value. simpl.
      rewrite (value_same e) by exact D.
      eapply is_derive_value; [|apply (compose cos e); [apply is_derive_Reals,
        derivable_pt_lim_cos|apply IHe; assumption]].
      ring.
    - simpl in *.
      assert (S1 : slope_defined A (slope N moving e)).
      { destruct (slope N moving e); simpl in *; tauto. }
      eapply is_derive_value; [|apply (compose atan e); [apply is_derive_Reals,
        derivable_pt_lim_atan|apply IHe; assumption]].
      destruct (slope N moving e); simpl; [|ring]. rewrite (value_same e) by exact D.
      unfold Q2R, Rsqr. simpl. field. nra.
    - simpl in *. apply times_defined in S. rewrite times_value. simpl.
      rewrite (value_same e) by exact D.
      eapply is_derive_value; [|apply (compose exp e); [apply is_derive_Reals,
        derivable_pt_lim_exp|apply IHe; assumption]].
      ring.
    - destruct D as [D P]. simpl in S.
      assert (S1 : slope_defined A (slope N moving e)).
      { destruct (slope N moving e); simpl in *; tauto. }
      eapply is_derive_value; [|apply (compose ln e); [apply is_derive_Reals, derivable_pt_lim_ln;
        assumption|apply IHe; assumption]].
      simpl. destruct (slope N moving e); simpl; [|ring]. rewrite (value_same e) by exact D. field.
        lra.
    - simpl in *. destruct (slope N moving e) as [d|] eqn:E.
      + simpl in S. destruct S as ((_ & _ & Z) & Sd). rewrite (value_same e) in Z by exact D.
        simpl. rewrite (value_same e) by exact D.
        assert (value (names s) e <> 0) by (intros Q; apply Z; rewrite Q; apply Rabs_R0).
        eapply is_derive_value; [|apply (compose Rabs e); [apply absolute_derive; assumption|apply
          IHe; assumption]].
        simpl. ring.
      + apply constant_derive. simpl. rewrite E. reflexivity.
  Qed.
End Slope.

(** ** Definitions *)

Lemma extend_app ds : forall names later, extend names (ds ++ later) = extend (extend names ds)
  later.
Proof. induction ds as [|d ds IH]; intros names later; simpl; [reflexivity|apply IH]. Qed.

Lemma extend_prefix ds : forall names, exists l, extend names ds = names ++ l.
Proof.
  induction ds as [|d ds IH]; intros names; simpl; [exists []; rewrite app_nil_r; reflexivity|].
  destruct (IH (names ++ [value names d])) as [l E]. rewrite E, <- app_assoc. eauto.
Qed.

Lemma extend_length ds : forall names, length (extend names ds) = (length names + length ds)%nat.
Proof.
  induction ds as [|d ds IH]; intros names; simpl; [lia|]. rewrite IH, app_size. simpl. lia.
Qed.

Lemma extend_constants qs : forall names,
  extend names (map Constant qs) = names ++ map Q2R qs.
Proof.
  induction qs as [|q qs IH]; intros names; simpl; [rewrite app_nil_r; reflexivity|].
  rewrite IH, <- app_assoc. reflexivity.
Qed.

Definition moves_with (s : option expression) : bool :=
  match s with Some _ => true | None => false end.
Definition slope_or_zero (s : option expression) : expression :=
  match s with Some e => e | None => whole 0 end.

(** Which names move, if the first do as this list says. *)
Fixpoint moving_names (N : nat) (moving : list bool) (ds : list expression) : list bool :=
  match ds with
  | [] => moving
  | d :: later => moving_names N (moving ++ [moves_with (slope N moving d)]) later
  end.

(** The derivatives of definitions, which may use those before them. *)
Fixpoint slopes (N : nat) (moving : list bool) (ds : list expression) : list expression :=
  match ds with
  | [] => []
  | d :: later =>
      slope_or_zero (slope N moving d)
      :: slopes N (moving ++ [moves_with (slope N moving d)]) later
  end.

(** The names of a curve, which of them move, and their derivatives at s. *)
Record on_curve (names : R -> list R) (s : R) (moving : list bool) (w : list R) : Prop := {
  same_length : forall t, length (names t) = length w;
  moving_length : length moving = length w;
  those_that_move : forall k, nth k moving false = true ->
    is_derive (fun t => nth k (names t) 0) s (nth k w 0);
  those_that_stay : forall k, nth k moving false = false ->
    forall t, nth k (names t) 0 = nth k (names s) 0 }.

Lemma nth_append {A} (l : list A) x k d : nth k (l ++ [x]) d =
  if Nat.ltb k (length l) then nth k l d else if Nat.eqb k (length l) then x else d.
Proof.
  destruct (Nat.ltb_spec k (length l)); [apply app_nth1; assumption|].
  destruct (Nat.eqb_spec k (length l)) as [->|].
  - rewrite app_nth2, Nat.sub_diag by lia. reflexivity.
  - apply nth_overflow. rewrite app_size. simpl. lia.
Qed.

(** L begins with the names at s. *)
Theorem slopes_correct ds : forall names s moving w L rest,
  on_curve names s moving w -> L = extend (names s) ds ++ rest -> all_defined (names s) ds ->
  all_defined (L ++ w) (slopes (length L) moving ds) ->
  exists w', extend (L ++ w) (slopes (length L) moving ds) = L ++ w' /\
    on_curve (fun t => extend (names t) ds) s (moving_names (length L) moving ds) w'.
Proof.
  induction ds as [|d ds IH]; intros names s moving w L rest C E D S.
  { exists w. split; [reflexivity|]. exact C. }
  simpl in E, D, S |- *. destruct D as [D1 D2]. destruct S as [S1 S2].
  set (N := length L) in *. set (sl := slope N moving d) in *.
  assert (same : forall k, (k < length (names s))%nat -> nth k (L ++ w) 0 = nth k (names s) 0).
  { intros k K. destruct (extend_prefix (d :: ds) (names s)) as [l P]. simpl in P.
    rewrite E, P, <- !app_assoc. apply app_nth1, K. }
  assert (moves : forall k, nth k moving false = true ->
            is_derive (fun t => nth k (names t) 0) s (nth (N + k) (L ++ w) 0)).
  { intros k K. rewrite app_nth2 by (unfold N; lia). unfold N.
    replace (length L + k - length L)%nat with k by lia. apply C, K. }
  set (v := value (L ++ w) (slope_or_zero sl)).
  destruct (IH (fun t => names t ++ [value (names t) d]) s (moving ++ [moves_with sl]) (w ++ [v]) L
    rest) as [w' [E' C']].
  - split.
    + intros t. rewrite !app_size. simpl. rewrite (same_length _ _ _ _ C). reflexivity.
    + rewrite !app_size. simpl. rewrite (moving_length _ _ _ _ C). reflexivity.
    + intros k. rewrite !nth_append, (moving_length _ _ _ _ C).
      destruct (Nat.ltb_spec k (length w)) as [K|K].
      * intros M. apply (is_derive_ext (fun t => nth k (names t) 0)); [|apply C, M].
        intros t. rewrite nth_append, (same_length _ _ _ _ C).
        destruct (Nat.ltb_spec k (length w)); [reflexivity|lia].
      * destruct (Nat.eqb_spec k (length w)) as [->|]; [|discriminate]. intros M.
        apply (is_derive_ext (fun t => value (names t) d)).
        { intros t. rewrite nth_append, (same_length _ _ _ _ C), Nat.eqb_refl.
          destruct (Nat.ltb_spec (length w) (length w)); [lia|reflexivity]. }
        unfold v, sl in *. destruct (slope N moving d) as [e|] eqn:Sl; [|discriminate].
        pose proof (slope_correct N moving names s (L ++ w) same moves
                      (those_that_stay _ _ _ _ C) d D1) as H.
        rewrite Sl in H. apply H, S1.
    + intros k M t. rewrite !nth_append, !(same_length _ _ _ _ C).
      rewrite nth_append, (moving_length _ _ _ _ C) in M.
      destruct (Nat.ltb_spec k (length w)) as [K|K]; [apply C, M|].
      destruct (Nat.eqb_spec k (length w)) as [Q|Q]; [|reflexivity].
      unfold sl in M. destruct (slope N moving d) as [e|] eqn:Sl; [discriminate|].
      exact (no_slope N moving names s (those_that_stay _ _ _ _ C) d Sl t).
  - exact E.
  - exact D2.
  - rewrite app_assoc. exact S2.
  - exists w'. split; [|exact C']. rewrite <- E', app_assoc. reflexivity.
Qed.
