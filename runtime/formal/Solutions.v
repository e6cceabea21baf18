(* SPDX-License-Identifier: Apache-2.0 *)
(** Lists of the configurations of a mechanism at one place, for each value of the uncertain
    quantities. Each line of a list is within a tube that holds exactly one configuration, and the
    ranges of the unknowns are searched for others. Closures.v has the claims. *)
From Coquelicot Require Import Coquelicot.
From Coq Require Import Reals QArith Lra Lia List PArith Bool.
From Coq Require Import PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Intervals Forms Evaluation Boxes Hints Regularity.
From Regulus Require Import LinearAlgebra Questions Search Closures Tubes Branches.
Import ListNotations.
Open Scope R_scope.

(** ** The check *)

(** The approximate coefficient of variable k. *)
Fixpoint coefficient (k : positive) (l : terms) : F.type :=
  match l with
  | [] => PrimFloat.zero
  | ([j], i) :: l' => if Pos.eqb j k then I.midpoint i else coefficient k l'
  | _ :: l' => coefficient k l'
  end.

(** A combination of equations: their numbers and factors. *)
Definition combination := list (nat * F.type).

Fixpoint combine_forms (fs : list form) (l : combination) : form :=
  match l with
  | [] => constant_form zero
  | (i, w) :: l' =>
      add_forms (scale_form (point w) (nth i fs (constant_form I.nai))) (combine_forms fs l')
  end.

Section Check.
  Variables (c : closure) (full : nat) (b : box).
  Let n := unknowns c.
  Let m := length b.

  (** *** Tubes *)

  Definition axis_range (t : tube) (i : nat) : interval :=
    form_range (axis_form t (variables full b) m i).

  (** All of a box of unknowns is in the tube. *)
  Definition covers (t : tube) (pb : box) : bool :=
    Nat.eqb (length pb) n
    && forallb (fun i => is_not_positive
         (subtract (I.abs (subtract (nth i pb I.nai) (axis_range t i)))
                   (point (number (reach t) i)))) (seq 0 n).

  (** Where the configuration of a tube is. *)
  Definition solution_range (t : tube) (v : tube_bounds) (i : nat) : interval :=
    let d := departure n t v i in add (axis_range t i) (I.join (I.neg d) d).

  (** The configuration of the tube is within a line, and in the ranges of the unknowns. *)
  Definition is_within_line (t : tube) (lower upper middles radii : box) : bool :=
    match test_tube c full t b with
    | Some v => forallb (fun i =>
        let s := solution_range t v i in
        is_not_negative (subtract s (nth i lower I.nai))
        && is_not_positive (subtract s (nth i upper I.nai))
        && is_not_positive (subtract (I.abs (subtract s (nth i middles I.nai)))
                                     (nth i radii I.nai))) (seq 0 n)
    | None => false
    end.

  (** A tube about the middle of a line; nothing is proved of its choice. *)
  Definition tube_about (lb : box) (reaches : list F.type) : tube :=
    let zeros := map (fun _ => PrimFloat.zero) b in
    Tube zeros (map I.midpoint lb) (map (fun _ => zeros) lb) reaches.

  Definition half_widths (lb : box) (factor : F.type) : list F.type :=
    map (fun i => PrimFloat.mul factor (PrimFloat.sub (I.upper i) (I.lower i))) lb.

  (** The same, tilted as the configuration moves with the variables. *)
  Definition tilted (t : tube) : tube :=
    match bounds_of c full t b with
    | Some v =>
        let names := tube_names c t (variables full b) m (fun _ => constant_form zero) in
        let fs := map (fun e => form_of (evaluate names e)) (equations c) in
        let slope l k :=
          let a := coefficient (Pos.of_succ_nat k) (linear (nth l fs (constant_form zero))) in
          if PrimFloat.ltb PrimFloat.zero (PrimFloat.abs a)
          then PrimFloat.div a (radius (nth k b I.nai)) else PrimFloat.zero in
        let of_unknown i k := PrimFloat.opp (float_sum (map (fun l =>
          PrimFloat.mul (get (inverse v) i l) (slope l k)) (seq 0 n))) in
        Tube (map I.midpoint b) (axis_at t) (tabulate n m of_unknown) (reach t)
    | None => t
    end.

  (** Within the line. *)
  Definition narrow_tubes (lb : box) : list tube :=
    let flat := tube_about lb (half_widths lb 0x1p-1%float) in
    let t := tilted flat in
    flat :: map (fun k => Tube (foot t) (axis_at t) (tilt t)
      (half_widths lb (Nat.iter k (PrimFloat.mul 0x1p-1%float) PrimFloat.one))) (seq 1 20).

  (** About the line, from half of the ranges down to the line. *)
  Definition wide_tubes (root lb : box) : list tube :=
    map (fun k => tube_about lb
           (map (fun w => larger (fst w) (snd w))
              (combine (half_widths lb 0x1.01p-1%float)
                 (half_widths root (Nat.iter k (PrimFloat.mul 0x1p-1%float) PrimFloat.one)))))
        (seq 1 50).

  (** The box of a line, and a tube that covers it. *)
  Definition check_line (root middles radii : box) (l : line) : option (box * tube) :=
    match enclose_ranges l, enclose_values (map fst l), enclose_values (map snd l) with
    | Some lb, Some lower, Some upper =>
        match find (fun t => Nat.eqb (length l) n && is_within_line t lower upper middles radii)
                (narrow_tubes lb) with
        | Some _ =>
            match find (fun t => is_tested c full t b && covers t lb) (wide_tubes root lb) with
            | Some t => Some (lb, t)
            | None => None
            end
        | None => None
        end
    | _, _, _ => None
    end.

  Fixpoint check_lines (root middles radii : box) (lines : list line) :
      option (list (box * tube)) :=
    match lines with
    | [] => Some []
    | l :: later =>
        match check_line root middles radii l with
        | Some f =>
            match check_lines root middles radii later with
            | Some fs => if forallb (fun g => boxes_apart (fst f) (fst g)) fs then Some (f :: fs)
                         else None
            | None => None
            end
        | None => None
        end
    end.

  (** *** The search for others *)

  Definition unknown_form (vs : list (option enclosure)) (i : nat) : form :=
    form_of (nth (m + i) vs None).

  Definition names_over (vs : list (option enclosure)) : list (option enclosure) :=
    evaluate_definitions
      (evaluate_definitions (firstn m vs) (definitions (places c))
       ++ map (fun i => of_form (unknown_form vs i)) (seq 0 n)) (further c).

  Definition is_never_zero (v : option enclosure) : bool :=
    match v with Some w => is_not_zero (range w) | None => false end.

  (** Combinations of equations in which an unknown has the coefficient 1, and the others have 0 or
      what they have in one equation. *)
  Definition combinations (fs : list form) (pb : box) : list (nat * combination) :=
    let at_ l j := coefficient (Pos.of_succ_nat (m + j)) (linear (nth l fs (constant_form zero))) in
    let k := left_inverse n n at_ in
    let r j := radius (nth j pb I.nai) in
    flat_map (fun j => (j, map (fun l => (l, PrimFloat.mul (r j) (get k j l))) (seq 0 n))
      :: flat_map (fun l => let a := at_ l j in
                            if PrimFloat.ltb PrimFloat.zero (PrimFloat.abs a)
                            then [(j, [(l, PrimFloat.div (r j) a)])] else []) (seq 0 n)) (seq 0 n).

  Definition is_much_narrower (q pb : box) : bool :=
    existsb (fun w => PrimFloat.ltb w 0.75%float) (relative_widths pb q).

  (** How much of the change of all equations is that by each unknown. *)
  Definition shares (fs : list form) : list F.type :=
    let change f j := influence_on_form (Pos.of_succ_nat (m + j)) f in
    let parts := map (fun f =>
      let all := map (change f) (seq 0 n) in
      let whole := float_sum all in map (fun s => PrimFloat.div s whole) all) fs in
    map (fun j => float_sum (map (fun l => nth j l PrimFloat.zero) parts)) (seq 0 n).

  (** What is left of a box: where each unknown less each combination is that unknown. *)
  Fixpoint narrowed_by (vs : list (option enclosure)) (fs : list form)
      (steps : list (nat * combination)) (q : box) : option box :=
    match steps with
    | [] => Some q
    | (j, l) :: later =>
        let new := form_range (subtract_forms (unknown_form vs j) (combine_forms fs l)) in
        let old := nth j q I.nai in
        if apart old new then None
        else narrowed_by vs fs later (replace j (I.meet old new) q)
    end.

  (** What is left of a box, and which unknown is to be halved: None if there is no
      configuration. *)
  Definition narrowed (pb : box) : option (box * option nat) :=
    let vs := variables full (b ++ pb) in
    let es := map (evaluate (names_over vs)) (equations c) in
    if existsb is_never_zero es then None
    else
      let fs := map form_of es in
      match narrowed_by vs fs (combinations fs pb) pb with
      | Some q => Some (q, if is_much_narrower q pb then None else largest_of (shares fs))
      | None => None
      end.

  (** Each configuration of the box is in one of the tubes. *)
  Fixpoint clears (ts : list tube) (fuel : nat) (pb : box) : bool :=
    match narrowed pb with
    | None => true
    | Some (q, k) =>
        if existsb (fun t => covers t q) ts then true
        else match fuel, k with
        | O, _ => false
        | S fuel', None => clears ts fuel' q
        | S fuel', Some k =>
            let s := I.midpoint (nth k q I.nai) in
            if clears ts fuel' (lower_part q k s) then clears ts fuel' (upper_part q k s) else false
        end
    end.
End Check.

Definition range_of_unknown (u : expression * expression) : expression * expression :=
  (Subtract (fst u) (snd u), Add (fst u) (snd u)).

(** [all]: the ranges are searched for more. *)
Definition check_solutions (all : bool) (c : closure) (w : method) (lines : list line) : bool :=
  let full := second_order w in
  match enclose_ranges (ranges (places c)), enclose_values (start c),
        enclose_ranges (map range_of_unknown (near c)),
        enclose_values (map fst (near c)), enclose_values (map snd (near c)) with
  | Some b, Some _, Some root, Some middles, Some radii =>
      if Nat.eqb (length (equations c)) (unknowns c) && Nat.eqb (length (near c)) (unknowns c)
         && forallb is_positive radii
      then
        match check_lines c full b root middles radii lines with
        | Some fs => if all then clears c full b (map snd fs) (deepest w) root else true
        | None => false
        end
      else false
  | _, _, _, _, _ => false
  end.

Definition check_all_solutions := check_solutions true.
Definition check_some_solutions := check_solutions false.

Definition check_solutions_at (c : list expression -> closure) (w : method)
    (places : list (list expression * listed)) : bool :=
  forallb (fun place =>
    match snd place with
    | All_of lines => check_all_solutions (c (fst place)) w lines
    | Some_of lines => check_some_solutions (c (fst place)) w lines
    end) places.

(** ** Why it is right *)

Lemma range_lists (l : line) : forall p, Forall2 in_range p l <->
  length p = length l /\ forall i, (i < length l)%nat ->
    nth i (map (value []) (map fst l)) 0 <= nth i p 0 <= nth i (map (value []) (map snd l)) 0.
Proof.
  induction l as [|u l IH]; intros [|s p]; simpl.
  - split; [intros _; split; [reflexivity|lia]|constructor].
  - split; [intros H; inversion H|intros [H _]; discriminate].
  - split; [intros H; inversion H|intros [H _]; discriminate].
  - split.
    + intros H. inversion H; subst. destruct (proj1 (IH p) ltac:(assumption)) as [L B].
      split; [f_equal; exact L|]. intros [|i] I; [assumption|apply B; lia].
    + intros [L B]. constructor; [exact (B O ltac:(lia))|]. apply IH.
      split; [injection L; auto|]. intros i I. exact (B (S i) ltac:(lia)).
Qed.

Lemma is_near_ranges (l : list (expression * expression)) : forall p,
  Forall2 (fun s u => Rabs (s - value [] (fst u)) <= value [] (snd u)) p l ->
  Forall2 in_range p (map range_of_unknown l).
Proof.
  induction l as [|u l IH]; intros p H; inversion H; subst; simpl; constructor; [|auto].
  cbv beta in *. match goal with A : Rabs _ <= _ |- _ => apply Rabs_le_between in A end.
  unfold in_range. simpl. lra.
Qed.

Section Correct.
  Variables (c : closure) (full : nat) (b : box) (x : list R).
  Hypothesis B : in_box b x.
  Let n := unknowns c.
  Let m := length b.

  Lemma size_of_x : length x = m.
  Proof. symmetry. apply B. Qed.

  Lemma axis_range_encloses t i : encloses (axis_range full b t i) (axis t x i).
  Proof.
    apply (form_range_encloses (coordinate b x)); [apply coordinate_in_unit_box, B|].
    rewrite (proj1 B). apply axis_form_encloses, variables_known, B.
  Qed.

  Lemma covers_correct t pb p : covers c full b t pb = true -> in_box pb p -> in_tube n t x p.
  Proof.
    intros H [L P]. apply andb_prop in H as [H1 H2]. apply Nat.eqb_eq in H1.
    rewrite forallb_forall in H2. split; [rewrite <- L; exact H1|]. intros i I.
    specialize (H2 i ltac:(apply in_seq; fold n; lia)).
    pose proof (is_not_positive_correct _ _ H2 (subtract_encloses _ _ _ _
      (absolute_encloses _ _ (subtract_encloses _ _ _ _ (P i) (axis_range_encloses t i)))
      (point_encloses (number (reach t) i)))). lra.
  Qed.

  Lemma solution_range_encloses t v i : test_tube c full t b = Some v -> (i < n)%nat ->
    encloses (solution_range c full b t v i) (nth i (tube_solution c t v x) 0).
  Proof.
    intros T I. destruct (solution_within c full t b v x T B i I) as (d & D & Q & _).
    unfold solution_range.
    replace (nth i (tube_solution c t v x) 0)
      with (axis t x i + (nth i (tube_solution c t v x) 0 - axis t x i)) by ring.
    apply add_encloses; [apply axis_range_encloses|].
    apply (between_enclosed _ (- d) d); [| |apply Rabs_le_between, Q];
      apply join_encloses; [left; apply negate_encloses, D|right; exact D].
  Qed.

  (** *** The lines *)

  Section Lines.
    Variables (root middles radii : box).
    Hypothesis all_near : length (near c) = n.
    Hypothesis M : in_box middles (map (value []) (map fst (near c))).
    Hypothesis D : in_box radii (map (value []) (map snd (near c))).

    (** p is in the box of the line, and alone in the tube. *)
    Definition holds_alone (f : box * tube) (p : list R) : Prop :=
      in_box (fst f) p /\ forall q, in_tube n (snd f) x q -> solves c x q -> q = p.

    Lemma line_correct l f : check_line c full b root middles radii l = Some f ->
      exists p, is_the_one c x l p /\ holds_alone f p.
    Proof.
      unfold check_line. destruct (enclose_ranges l) as [lb|] eqn:L; [|discriminate].
      destruct (enclose_values (map fst l)) as [lower|] eqn:Lo; [|discriminate].
      destruct (enclose_values (map snd l)) as [upper|] eqn:Up; [|discriminate].
      match goal with |- match ?q with _ => _ end = _ -> _ => destruct q as [s|] eqn:Q;
        [|discriminate] end.
      match goal with |- match ?q with _ => _ end = _ -> _ => destruct q as [t|] eqn:W;
        [|discriminate] end.
      intros [= <-]. apply find_some in W as [_ W]. apply andb_prop in W as [W C].
      apply find_some in Q as [_ Q]. apply andb_prop in Q as [Q1 Q2]. apply Nat.eqb_eq in Q1.
      fold n in Q1. unfold is_within_line in Q2.
      destruct (test_tube c full s b) as [v|] eqn:T; [|discriminate].
      unfold is_tested in W. destruct (test_tube c full t b) as [w|] eqn:T'; [|discriminate].
      apply enclose_values_correct in Lo as [_ Lo]. apply enclose_values_correct in Up as [_ Up].
      set (p := tube_solution c s v x).
      pose proof (tube_solution_solves c full s b v x T B) as So. fold p in So.
      assert (Lp : length p = n) by apply So.
      rewrite forallb_forall in Q2.
      assert (bounds : forall i, (i < n)%nat ->
        nth i (map (value []) (map fst l)) 0 <= nth i p 0
          <= nth i (map (value []) (map snd l)) 0 /\
        Rabs (nth i p 0 - nth i (map (value []) (map fst (near c))) 0)
          <= nth i (map (value []) (map snd (near c))) 0).
      { intros i I. specialize (Q2 i ltac:(apply in_seq; fold n; lia)). cbv zeta in Q2.
        apply andb_prop in Q2 as [Q2 R3]. apply andb_prop in Q2 as [R1 R2].
        pose proof (solution_range_encloses s v i T I) as E. fold p in E.
        pose proof (is_not_negative_correct _ _ R1 (subtract_encloses _ _ _ _ E (proj2 Lo i))).
        pose proof (is_not_positive_correct _ _ R2 (subtract_encloses _ _ _ _ E (proj2 Up i))).
        pose proof (is_not_positive_correct _ _ R3 (subtract_encloses _ _ _ _
          (absolute_encloses _ _ (subtract_encloses _ _ _ _ E (proj2 M i))) (proj2 D i))).
        lra. }
      assert (In_line : Forall2 in_range p l).
      { apply range_lists. split; [congruence|]. intros i I. apply bounds. lia. }
      assert (line_box : forall q, Forall2 in_range q l -> in_box lb q).
      { intros q F. eapply enclose_ranges_correct; eassumption. }
      assert (one : forall q, in_tube n t x q -> solves c x q -> q = p).
      { intros q Tq Sq. rewrite (only_solution c full t b w x T' B q Tq Sq). symmetry.
        apply (only_solution c full t b w x T' B p); [|exact So].
        exact (covers_correct t lb p C (line_box p In_line)). }
      exists p. split; [|split; [exact (line_box p In_line)|exact one]].
      destruct (regular_in_tube c full s b v x T B p) as [V G].
      { exact (solution_in_tube c full s b v x T B). }
      split; [exact In_line|]. split; [exact So|]. split; [|split; [exact V|split; [exact G|]]].
      - apply near_lists. split; [congruence|]. intros i I. apply bounds. lia.
      - intros q Fq Sq. apply one; [|exact Sq]. exact (covers_correct t lb q C (line_box q Fq)).
    Qed.

    Lemma lines_correct lines : forall fs,
      check_lines c full b root middles radii lines = Some fs ->
      exists ps, NoDup ps /\ Forall2 (is_the_one c x) lines ps /\ Forall2 holds_alone fs ps.
    Proof.
      induction lines as [|l lines IH]; intros fs H; simpl in H.
      - injection H as <-. exists []. repeat constructor.
      - destruct (check_line c full b root middles radii l) as [f|] eqn:L; [|discriminate].
        destruct (check_lines c full b root middles radii lines) as [gs|]; [|discriminate].
        destruct (forallb _ gs) eqn:A; [|discriminate]. injection H as <-.
        destruct (line_correct l f L) as (p & P & H). destruct (IH gs eq_refl) as (ps & N & Q & G).
        exists (p :: ps). split; [|split; constructor; assumption]. constructor; [|exact N].
        intros I. rewrite forallb_forall in A. clear - A G I H.
        induction G as [|g q gs qs K G IH]; [exact I|]. destruct I as [->|I].
        + refine (boxes_apart_correct _ _ p (A g _) (proj1 H) (proj1 K)). left. reflexivity.
        + apply IH; [|exact I]. intros y Y. apply A. right. exact Y.
    Qed.
  End Lines.

  (** *** The search *)

  Section At_box.
    Variables (pb : box) (p : list R).
    Hypothesis P : in_box pb p.
    Hypothesis So : solves c x p.
    Let s := coordinate (b ++ pb) (x ++ p).
    Let vs := variables full (b ++ pb).

    Lemma in_both : in_box (b ++ pb) (x ++ p).
    Proof.
      split; [rewrite !app_size; f_equal; [apply B|apply P]|].
      pose proof size_of_x as S. unfold m in S. intros k.
      destruct (Nat.lt_ge_cases k (length b)) as [K|K].
      - rewrite !app_nth1 by lia. apply B.
      - rewrite !app_nth2 by lia. rewrite S. apply P.
    Qed.

    Let T : in_unit_box s := coordinate_in_unit_box _ _ in_both.
    Let K : known s vs (x ++ p) := variables_known full _ _ in_both.

    Lemma unknown_form_encloses i : form_encloses s (unknown_form b vs i) (nth i p 0).
    Proof.
      replace (nth i p 0) with (nth (m + i) (x ++ p) 0); [apply form_of_encloses, K|].
      pose proof size_of_x. rewrite app_nth2 by lia. f_equal. lia.
    Qed.

    Lemma names_over_known : known s (names_over c b vs) (names_at c x p).
    Proof.
      unfold names_over, names_at. apply known_definitions; [exact T|].
      assert (E : map (fun i => nth i p 0) (seq 0 (unknowns c)) = p).
      { destruct So as [L _]. apply list_equal; rewrite map_size, seq_size; [auto|].
        intros i I. rewrite (nth_indep _ 0 (nth 0 p 0))
          by (rewrite map_size, seq_size; exact I).
        rewrite (map_nth (fun i => nth i p 0)), seq_nth by exact I. reflexivity. }
      rewrite <- E. apply (known_map s _ (unknown_form b vs)); [exact T| |].
      - apply known_definitions; [exact T|].
        apply (known_left s _ (skipn (length b) vs) x p).
        + pose proof size_of_x as S. rewrite firstn_size, (proj1 K), app_size. unfold m in S.
          lia.
        + rewrite firstn_skipn. exact K.
      - intros i I. apply unknown_form_encloses.
    Qed.

    Let es := map (evaluate (names_over c b vs)) (equations c).

    Hypothesis as_many : length (equations c) = n.

    Lemma equation_value e : In e (equations c) -> value (names_at c x p) e = 0.
    Proof.
      intros E. destruct (In_nth _ _ no_entry E) as (i & I & <-).
      apply (proj2 So i). fold n. lia.
    Qed.

    Lemma never_zero_correct : existsb is_never_zero es = true -> False.
    Proof.
      intros H. apply existsb_exists in H as (v & V & H). apply in_map_iff in V as (e & <- & E).
      unfold is_never_zero in H.
      destruct (evaluate (names_over c b vs) e) as [w|] eqn:W; [|discriminate].
      destruct (evaluate_correct s _ _ e w T names_over_known W) as [_ [R _]].
      apply (is_not_zero_correct _ _ H R), equation_value, E.
    Qed.

    Lemma forms_enclose i : form_encloses s (nth i (map form_of es) (constant_form I.nai)) 0.
    Proof.
      unfold es. rewrite map_map. destruct (Nat.lt_ge_cases i (length (equations c))) as [I|I].
      - rewrite (nth_indep _ _ (form_of (evaluate (names_over c b vs) no_entry)))
          by (rewrite map_size; exact I).
        rewrite (map_nth (fun e => form_of (evaluate (names_over c b vs) e))).
        rewrite <- (equation_value (nth i (equations c) no_entry)) by (apply nth_In, I).
        apply form_of_value; [exact T|apply names_over_known].
      - rewrite nth_overflow by (rewrite map_size; exact I).
        apply constant_form_encloses, unknown_encloses.
    Qed.

    Lemma combination_encloses l : form_encloses s (combine_forms (map form_of es) l) 0.
    Proof.
      induction l as [|[i w] l IH]; simpl; [apply constant_form_encloses, (integer_encloses 0)|].
      replace 0 with (real_of w * 0 + 0) by ring. apply add_forms_enclose; [|exact IH].
      apply scale_form_encloses; [apply point_encloses|apply forms_enclose].
    Qed.

    Lemma narrowed_by_correct steps : forall q, in_box q p ->
      match narrowed_by b vs (map form_of es) steps q with
      | Some r => in_box r p
      | None => False
      end.
    Proof.
      induction steps as [|[j l] steps IH]; intros q Q; simpl; [exact Q|].
      set (new := form_range (subtract_forms (unknown_form b vs j)
                                (combine_forms (map form_of es) l))).
      assert (N : encloses new (nth j p 0)).
      { apply (form_range_encloses s); [exact T|].
        replace (nth j p 0) with (nth j p 0 - 0) by ring.
        apply subtract_forms_enclose; [apply unknown_form_encloses|apply combination_encloses]. }
      destruct (apart (nth j q I.nai) new) eqn:A.
      - exact (apart_correct _ _ _ A (proj2 Q j) N).
      - apply IH, in_box_replace; [exact Q|]. apply meet_encloses; [apply Q|exact N].
    Qed.

    Lemma narrowed_correct :
      match narrowed c full b pb with Some (q, _) => in_box q p | None => False end.
    Proof.
      unfold narrowed. fold vs. fold es. destruct (existsb is_never_zero es) eqn:Z.
      { exact (never_zero_correct Z). }
      pose proof (narrowed_by_correct (combinations c b (map form_of es) pb) pb P) as H.
      destruct (narrowed_by b vs (map form_of es) _ pb); exact H.
    Qed.
  End At_box.

  Lemma clears_correct ts fuel : length (equations c) = n -> forall pb p,
    clears c full b ts fuel pb = true -> in_box pb p -> solves c x p ->
    exists t, In t ts /\ in_tube n t x p.
  Proof.
    intros E. induction fuel as [|fuel IH]; intros pb p H P So; simpl in H;
      pose proof (narrowed_correct pb p P So E) as N;
      destruct (narrowed c full b pb) as [[q k]|]; try contradiction;
      (destruct (existsb _ ts) eqn:X;
        [apply existsb_exists in X as (t & I & C); exists t; split;
           [exact I|exact (covers_correct t q p C N)]|]).
    - discriminate.
    - destruct k as [k|]; [|exact (IH q p H N So)].
      set (mid := I.midpoint (nth k q I.nai)) in *.
      destruct (clears c full b ts fuel (lower_part q k mid)) eqn:L; [|discriminate].
      destruct (parts_cover q p k mid N) as [Q|Q]; [exact (IH _ p L Q So)|exact (IH _ p H Q So)].
  Qed.
End Correct.

Lemma check_solutions_correct all c w lines : check_solutions all c w lines = true ->
  is_searched c lines /\
  forall x, in_set (places c) x -> exists ps,
    NoDup ps /\ Forall2 (is_the_one c x) lines ps /\
    (all = true -> forall p, solves c x p -> is_near c p -> In p ps).
Proof.
  unfold check_solutions. set (full := second_order w).
  destruct (enclose_ranges (ranges (places c))) as [b|] eqn:R; [|discriminate].
  destruct (enclose_values (start c)) as [s|] eqn:S; [|discriminate].
  destruct (enclose_ranges (map range_of_unknown (near c))) as [root|] eqn:O; [|discriminate].
  destruct (enclose_values (map fst (near c))) as [middles|] eqn:M; [|discriminate].
  destruct (enclose_values (map snd (near c))) as [radii|] eqn:D; [|discriminate].
  match goal with |- (if ?q then _ else _) = _ -> _ => destruct q eqn:Q; [|discriminate] end.
  destruct (check_lines c full b root middles radii lines) as [fs|] eqn:L; [|discriminate].
  intros H. apply andb_prop in Q as [Q Q3]. apply andb_prop in Q as [Q1 Q2].
  apply Nat.eqb_eq in Q1, Q2.
  apply enclose_values_correct in S as [S1 _]. apply enclose_values_correct in M as [M1 M2].
  apply enclose_values_correct in D as [D1 D2].
  split.
  - split; [|split; [exact Q2|split]].
    + split; [exact (enclose_ranges_defined (places c) b R)|split; [exact Q1|]].
      split; [exact S1|]. rewrite Forall_forall in *. intros u U.
      split; [apply M1|apply D1]; apply in_map, U.
    + apply Forall_forall. intros u U. destruct (In_nth _ _ u U) as (i & I & E).
      rewrite forallb_forall in Q3. destruct D2 as [Ld D2]. rewrite !map_size in Ld.
      specialize (Q3 (nth i radii I.nai) ltac:(apply nth_In; lia)).
      pose proof (is_positive_correct _ _ Q3 (D2 i)) as Z.
      rewrite map_map in Z.
      rewrite (nth_indep _ 0 (value [] (snd u))) in Z by (rewrite map_size; exact I).
      rewrite (map_nth (fun u => value [] (snd u))), E in Z. exact Z.
    + clear - L. revert fs L. induction lines as [|l lines IH]; intros fs L; [constructor|].
      simpl in L. destruct (check_line c full b root middles radii l) as [f|] eqn:F;
        [|discriminate].
      destruct (check_lines c full b root middles radii lines) as [gs|]; [|discriminate].
      constructor; [|exact (IH gs eq_refl)]. unfold check_line in F.
      destruct (enclose_ranges l) as [lb|] eqn:Z; [|discriminate].
      exact (enclose_ranges_defined (Question l [] [] [] [] 0) lb Z).
  - intros x X.
    assert (B : in_box b x) by (eapply enclose_ranges_correct; [exact R|apply X]).
    destruct (lines_correct c full b x B root middles radii Q2 M2 D2 lines fs L)
      as (ps & N & F & G).
    exists ps. split; [exact N|split; [exact F|]]. intros -> p So Np.
    assert (P : in_box root p).
    { eapply enclose_ranges_correct; [exact O|apply is_near_ranges, Np]. }
    destruct (clears_correct c full b x B _ _ Q1 root p H P So) as (t & I & T).
    clear - G I T So. induction G as [|f q fs ps K G IH]; [destruct I|]. destruct I as [<-|I].
    + left. symmetry. exact (proj2 K p T So).
    + right. exact (IH I).
Qed.

Lemma the_ones c x lines ps p : Forall2 (is_the_one c x) lines ps -> In p ps ->
  solves c x p /\ is_near c p.
Proof.
  intros F I. induction F as [|l q lines ps K F IH]; [destruct I|]. destruct I as [->|I]; [|auto].
  destruct K as (_ & S & N & _). auto.
Qed.

Theorem check_all_solutions_correct c w lines :
  check_all_solutions c w lines = true -> all_solutions c lines.
Proof.
  intros H. apply check_solutions_correct in H as [G H]. split; [exact G|]. intros x X.
  destruct (H x X) as (ps & N & F & A). exists ps. split; [exact N|split; [exact F|]].
  intros p. split; [intros [S P]; exact (A eq_refl p S P)|apply (the_ones c x lines ps p F)].
Qed.

Theorem check_some_solutions_correct c w lines :
  check_some_solutions c w lines = true -> some_solutions c lines.
Proof.
  intros H. apply check_solutions_correct in H as [G H]. split; [exact G|]. intros x X.
  destruct (H x X) as (ps & N & F & _). exists ps. auto.
Qed.

Theorem check_solutions_at_correct c w places :
  check_solutions_at c w places = true -> solutions_at c places.
Proof.
  intros H. unfold check_solutions_at in H. rewrite forallb_forall in H. apply Forall_forall.
  intros place I. specialize (H place I). destruct (snd place).
  - exact (check_all_solutions_correct _ w _ H).
  - exact (check_some_solutions_correct _ w _ H).
Qed.
