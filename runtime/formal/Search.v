(* SPDX-License-Identifier: Apache-2.0 *)
(** Branch and prune: a box that is not decided is split. The theorem [check_correct] at the end
    says that there is no singularity if the check of a question answers true. *)
From Coq Require Import Reals Lra Lia List PArith Bool.
From Coq Require PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Questions LinearAlgebra Intervals Forms Evaluation Boxes.
From Regulus Require Import Hints Regularity.
Import ListNotations.
Open Scope R_scope.

(** How boxes are tested. No choice can make the check answer true wrongly. *)
Record method := Method {
  second_order : nat;  (** the first so many variables are kept to the second order *)
  deepest : nat }.     (** the most splits one after the other *)

(** The box of the ranges: None if an end has no value. *)
Definition enclose_range (ends : expression * expression) : option interval :=
  match evaluate [] (fst ends), evaluate [] (snd ends) with
  | Some l, Some u => Some (I.join (range l) (range u))
  | _, _ => None
  end.

Fixpoint enclose_ranges (l : list (expression * expression)) : option box :=
  match l with
  | [] => Some []
  | e :: l' =>
      match enclose_range e, enclose_ranges l' with
      | Some i, Some b => Some (i :: b)
      | _, _ => None
      end
  end.

Definition form_of (v : option enclosure) : form :=
  match v with Some w => polynomial w | None => constant_form I.nai end.

(** ** The test of a box *)

Definition is_excluded (names : list (option enclosure)) (c : expression) : bool :=
  match evaluate names c with Some v => is_positive (range v) | None => false end.

Inductive answer :=
  | Outside             (** a constraint is positive everywhere in the box *)
  | Regular             (** everything is defined, and the matrix has full rank *)
  | Undefined           (** something is not shown to be defined *)
  | Open (x : attempt)  (** the rank is not shown to be full *).

(** Everything that the model needs has a value, and each row has an entry for each column. *)
Definition is_model_known (q : question) (names : list (option enclosure))
    (a : list (list (option enclosure))) : bool :=
  forallb is_known names && forallb (fun e => is_known (evaluate names e)) (also_defined q)
  && forallb (forallb is_known) a && forallb (fun r => Nat.eqb (length r) (columns q)) a.

Definition test (q : question) (m : method) (b : box) : answer :=
  let names := evaluate_definitions (variables (second_order m) b) (definitions q) in
  if existsb (is_excluded names) (constraints q) then Outside
  else
    let a := map (map (evaluate names)) (matrix q) in
    if is_model_known q names a then
      let a := map (map form_of) a in
      let n := columns q in
      let x := attempt_at (rows q) n a in
      if succeeds n x then Regular else Open x
    else Undefined.

(** ** Where an open box is split: approximate, nothing is proved of it *)

Definition variables_of (m : monomial) (k : positive) : bool := existsb (Pos.eqb k) m.

Definition influence_on_form (k : positive) (f : form) : PrimFloat.float :=
  let of_term (u : monomial * interval) :=
    if variables_of (fst u) k then I.upper (I.abs (snd u)) else PrimFloat.zero in
  float_sum (map of_term (linear f ++ quadratic f ++ single f)).

Definition influence (x : attempt) (k : positive) : PrimFloat.float :=
  let usable := forallb (fun v => PrimFloat.ltb PrimFloat.zero v) (vector x) in
  let v i := if usable then nth i (vector x) PrimFloat.one else PrimFloat.one in
  let n := length (vector x) in
  float_sum (map float_sum (tabulate n n (fun i j =>
    PrimFloat.mul (influence_on_form k (form_at (error x) i j)) (PrimFloat.div (v j) (v i))))).

Definition relative_widths (root b : box) : list PrimFloat.float :=
  let width i := PrimFloat.sub (I.upper i) (I.lower i) in
  map (fun p => PrimFloat.div (width (snd p)) (width (fst p))) (combine root b).

Definition variable_to_split (root b : box) (a : answer) : option nat :=
  match a with
  | Open x =>
      let by_influence := map (influence x) (map Pos.of_succ_nat (seq 0 (length b))) in
      match largest_of by_influence with
      | Some k => Some k
      | None => largest_of (relative_widths root b)
      end
  | _ => largest_of (relative_widths root b)
  end.

(** ** The search *)

Definition is_closed (a : answer) : bool :=
  match a with Outside | Regular => true | _ => false end.

(** The number of boxes that were tested and needed no split. None: a box remains open. *)
Fixpoint search (test : box -> answer) (root : box) (fuel : nat) (b : box) : option N :=
  let a := test b in
  if is_closed a then Some 1%N
  else
    match fuel, variable_to_split root b a with
    | S fuel', Some k =>
        let c := I.midpoint (nth k b I.nai) in
        match search test root fuel' (lower_part b k c) with
        | Some x =>
            match search test root fuel' (upper_part b k c) with
            | Some y => Some (x + y)%N
            | None => None
            end
        | None => None
        end
    | _, _ => None
    end.

(** The splits that a search made. They are a hint: whoever has them need not test the boxes that
    are split. *)
Inductive tree :=
  | Leaf
  | Split (variable : nat) (lower upper : tree).

Fixpoint check_parts (test : box -> answer) (t : tree) (b : box) : bool :=
  match t with
  | Leaf => is_closed (test b)
  | Split k lower upper =>
      let c := I.midpoint (nth k b I.nai) in
      check_parts test lower (lower_part b k c) && check_parts test upper (upper_part b k c)
  end.

(** The number of leaves of the proof, or None if there is no proof. *)
Definition leaves (q : question) (m : method) : option N :=
  match enclose_ranges (ranges q) with
  | Some root => search (test q m) root (deepest m) root
  | None => None
  end.

Definition check (q : question) (m : method) : bool :=
  match leaves q m with Some _ => true | None => false end.

Definition check_tree (q : question) (m : method) (t : tree) : bool :=
  match enclose_ranges (ranges q) with
  | Some root => check_parts (test q m) t root
  | None => false
  end.

(** ** It is correct *)

Lemma enclose_range_correct e i x :
  enclose_range e = Some i -> in_range x e -> encloses i x.
Proof.
  unfold enclose_range, in_range.
  assert (K : known (fun _ => 0) [] []).
  { split; [reflexivity|]. intros k v. destruct k; discriminate. }
  assert (T : in_unit_box (fun _ => 0)) by (intros k; rewrite Rabs_R0; lra).
  destruct (evaluate [] (fst e)) as [l|] eqn:L; [|discriminate].
  destruct (evaluate [] (snd e)) as [u|] eqn:U; [|discriminate].
  intros [= <-]. apply (evaluate_correct _ _ _ _ _ T K) in L as [_ [L _]].
  apply (evaluate_correct _ _ _ _ _ T K) in U as [_ [U _]].
  apply between_enclosed; apply join_encloses; [left|right]; assumption.
Qed.

Lemma enclose_ranges_correct l : forall b x,
  enclose_ranges l = Some b -> Forall2 in_range x l -> in_box b x.
Proof.
  induction l as [|e l IH]; intros b x E F; simpl in E; inversion F; subst.
  - injection E as <-. split; [reflexivity|]. intros [|k]; apply unknown_encloses.
  - destruct (enclose_range e) as [i|] eqn:R; [|discriminate].
    destruct (enclose_ranges l) as [c|]; [|discriminate]. injection E as <-.
    destruct (IH c l0 eq_refl ltac:(assumption)) as [L C].
    split; [simpl; f_equal; exact L|]. intros [|k]; simpl; [|apply C].
    eapply enclose_range_correct; eassumption.
Qed.

Lemma enclose_ranges_defined q b : enclose_ranges (ranges q) = Some b -> ends_defined q.
Proof.
  unfold ends_defined. revert b. induction (ranges q) as [|e l IH]; intros b E; [constructor|].
  simpl in E. destruct (enclose_range e) as [i|] eqn:R; [|discriminate].
  destruct (enclose_ranges l) as [c|]; [|discriminate]. constructor; [|exact (IH c eq_refl)].
  unfold enclose_range in R.
  assert (K : known (fun _ => 0) [] []).
  { split; [reflexivity|]. intros k v. destruct k; discriminate. }
  assert (T : in_unit_box (fun _ => 0)) by (intros k; rewrite Rabs_R0; lra).
  destruct (evaluate [] (fst e)) as [l'|] eqn:L; [|discriminate].
  destruct (evaluate [] (snd e)) as [u|] eqn:U; [|discriminate].
  split; [apply (evaluate_correct _ _ _ _ _ T K L)|apply (evaluate_correct _ _ _ _ _ T K U)].
Qed.

Definition holds_at (q : question) (x : list R) : Prop :=
  in_set q x -> model_defined q x /\
    full_column_rank (rows q) (columns q) (entry q (extend x (definitions q))).

Section Test.
  Variables (q : question) (m : method) (b : box) (x : list R).
  Hypothesis B : in_box b x.
  Let t := coordinate b x.
  Let T : in_unit_box t := coordinate_in_unit_box b x B.
  Let vs := evaluate_definitions (variables (second_order m) b) (definitions q).
  Let names := extend x (definitions q).
  Let K : known t vs names :=
    known_definitions t (definitions q) _ _ T (variables_known (second_order m) b x B).
  Let a := map (map (evaluate vs)) (matrix q).

  Lemma outside_correct : existsb (is_excluded vs) (constraints q) = true -> ~ in_set q x.
  Proof.
    intros E [_ S]. apply existsb_exists in E as [c [C E]].
    unfold is_excluded in E. destruct (evaluate vs c) as [v|] eqn:V; [|discriminate].
    destruct (evaluate_correct t vs names c v T K V) as [D [R _]].
    pose proof (is_positive_correct _ _ E R). specialize (S c C D). fold names in S. lra.
  Qed.

  Lemma known_is_defined e : is_known (evaluate vs e) = true -> defined names e.
  Proof.
    destruct (evaluate vs e) as [v|] eqn:V; [|discriminate].
    intros _. apply (evaluate_correct t vs names e v T K V).
  Qed.

  Lemma entries_enclosed i j : forallb (forallb is_known) a = true ->
    forallb (fun r => Nat.eqb (length r) (columns q)) a = true ->
    (i < rows q)%nat -> (j < columns q)%nat ->
    form_encloses t (form_at (map (map form_of) a) i j) (entry q names i j).
  Proof.
    intros D S P Q. unfold form_at, entry, a. rewrite map_map.
    rewrite forallb_forall in D, S.
    set (r := nth i (matrix q) []).
    assert (In_r : In (map (evaluate vs) r) a) by (apply in_map, nth_In, P).
    specialize (D _ In_r). specialize (S _ In_r). apply Nat.eqb_eq in S.
    rewrite map_size in S.
    rewrite (nth_indep _ [] (map form_of (map (evaluate vs) []))) by (rewrite map_size; exact P).
    rewrite (map_nth (fun r => map form_of (map (evaluate vs) r))). fold r. rewrite map_map.
    rewrite (nth_indep _ _ (form_of (evaluate vs no_entry)))
      by (rewrite map_size, S; exact Q).
    rewrite (map_nth (fun e => form_of (evaluate vs e))).
    set (e := nth j r no_entry).
    assert (In_e : In (evaluate vs e) (map (evaluate vs) r)).
    { apply in_map, nth_In. rewrite S. exact Q. }
    rewrite forallb_forall in D. specialize (D _ In_e).
    destruct (evaluate vs e) as [v|] eqn:V; [|discriminate].
    apply (evaluate_correct t vs names e v T K V).
  Qed.

  Lemma everything_defined : forallb is_known vs = true ->
    forallb (fun e => is_known (evaluate vs e)) (also_defined q) = true ->
    forallb (forallb is_known) a = true -> model_defined q x.
  Proof.
    intros D1 D2 D3. split; [|split].
    - eapply definitions_are_defined; [exact T|apply variables_known, B|exact D1].
    - rewrite forallb_forall in D2. apply Forall_forall. intros e In_e.
      apply known_is_defined, D2, In_e.
    - rewrite forallb_forall in D3. apply Forall_forall. intros r In_r.
      apply Forall_forall. intros e In_e. specialize (D3 (map (evaluate vs) r)).
      rewrite forallb_forall in D3. apply known_is_defined, D3; apply in_map; assumption.
  Qed.

  Theorem test_correct : is_closed (test q m b) = true -> holds_at q x.
  Proof.
    unfold test. fold vs. destruct existsb eqn:E.
    { intros _ S. elim (outside_correct E S). }
    fold a. unfold is_model_known.
    destruct (forallb is_known vs) eqn:D1; [|discriminate].
    destruct (forallb (fun e => is_known (evaluate vs e)) (also_defined q)) eqn:D2;
      [|discriminate].
    destruct (forallb (forallb is_known) a) eqn:D3; [|discriminate].
    destruct (forallb (fun r => Nat.eqb (length r) (columns q)) a) eqn:D4; [|discriminate].
    cbn [andb]. destruct (succeeds _ _) eqn:S; [|discriminate].
    intros _ _. split; [apply everything_defined; assumption|].
    eapply (attempt_correct t); [exact T| |exact S].
    exact (fun i j => entries_enclosed i j D3 D4).
  Qed.
End Test.

Section Search.
  Variables (test : box -> answer) (holds : list R -> Prop).
  Hypothesis test_holds : forall b x, in_box b x -> is_closed (test b) = true -> holds x.

  Lemma search_correct root fuel : forall b x n,
    in_box b x -> search test root fuel b = Some n -> holds x.
  Proof.
    induction fuel as [|fuel IH]; intros b x n B E; simpl in E;
      destruct (is_closed (test b)) eqn:C; try exact (test_holds b x B C); try discriminate;
      destruct variable_to_split as [k|]; try discriminate;
      set (c := I.midpoint (nth k b I.nai)) in *;
      destruct (search test root fuel (lower_part b k c)) as [l|] eqn:L; try discriminate;
      destruct (search test root fuel (upper_part b k c)) as [u|] eqn:U; try discriminate;
      destruct (parts_cover b x k c B) as [D|D]; eauto.
  Qed.

  Lemma check_parts_correct t : forall b x,
    in_box b x -> check_parts test t b = true -> holds x.
  Proof.
    induction t as [|k l IHl u IHu]; intros b x B E; simpl in E; [exact (test_holds b x B E)|].
    apply andb_prop in E as [L U].
    destruct (parts_cover b x k (I.midpoint (nth k b I.nai)) B); eauto.
  Qed.
End Search.

Theorem check_correct q m : check q m = true -> no_singularity q.
Proof.
  unfold check, leaves. destruct (enclose_ranges (ranges q)) as [root|] eqn:R; [|discriminate].
  destruct (search (test q m) root (deepest m) root) as [n|] eqn:L; [|discriminate].
  intros _. split; [exact (enclose_ranges_defined q root R)|].
  intros x S. refine (search_correct _ (holds_at q) (test_correct q m) _ _ _ x n _ L S).
  eapply enclose_ranges_correct; [exact R|exact (proj1 S)].
Qed.

(** The same with a hint. *)
Theorem check_tree_correct q m t : check_tree q m t = true -> no_singularity q.
Proof.
  unfold check_tree. destruct (enclose_ranges (ranges q)) as [root|] eqn:R; [|discriminate].
  intros L. split; [exact (enclose_ranges_defined q root R)|].
  intros x S. refine (check_parts_correct _ (holds_at q) (test_correct q m) t _ x _ L S).
  eapply enclose_ranges_correct; [exact R|exact (proj1 S)].
Qed.

(** The same for a trajectory: one question, to which each piece gives some constants. *)
Definition check_pieces (q : list expression -> question) (m : method)
    (pieces : list (list expression)) : bool :=
  forallb (fun piece => check (q piece) m) pieces.

Theorem check_pieces_correct q m pieces : check_pieces q m pieces = true ->
  Forall (fun piece => no_singularity (q piece)) pieces.
Proof.
  unfold check_pieces. rewrite forallb_forall. intros H. apply Forall_forall. intros piece P.
  apply (check_correct (q piece) m), H, P.
Qed.

(** A tree for each piece. *)
Definition check_each (check : question -> tree -> bool) (q : list expression -> question)
    (pieces : list (list expression)) (trees : list tree) : bool :=
  Nat.eqb (length pieces) (length trees) &&
  forallb (fun u => check (q (fst u)) (snd u)) (combine pieces trees).

Lemma check_each_correct check (claim : question -> Prop) q pieces trees :
  (forall q t, check q t = true -> claim q) -> check_each check q pieces trees = true ->
  Forall (fun piece => claim (q piece)) pieces.
Proof.
  unfold check_each. intros C H. apply andb_prop in H as [L H]. apply Nat.eqb_eq in L.
  revert trees L H. induction pieces as [|p l IH]; intros [|t trees] L H; try discriminate;
    constructor; simpl in H; apply andb_prop in H as [H1 H2].
  - exact (C _ _ H1).
  - apply (IH trees); [injection L; auto|exact H2].
Qed.

Definition check_piece_trees (q : list expression -> question) (m : method) :
    list (list expression) -> list tree -> bool :=
  check_each (fun q => check_tree q m) q.

Theorem check_piece_trees_correct q m pieces trees :
  check_piece_trees q m pieces trees = true ->
  Forall (fun piece => no_singularity (q piece)) pieces.
Proof. apply check_each_correct. intros q' t. apply check_tree_correct. Qed.
