(* SPDX-License-Identifier: Apache-2.0 *)
(** Tubes over the parts of a set, and whether they hold one continuous configuration. Boxes that
    touch must have the same configuration where they do. The theorem [check_closure_correct] at the
    end says that the mechanism has one branch if the check answers true. *)
From Coquelicot Require Import Coquelicot.
From Coq Require Import Reals QArith Qreals Lra Lia List PArith Bool Classical.
From Coq Require PrimFloat.
From Interval Require Import Real.Xreal Interval.Interval.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Intervals Forms Evaluation Boxes Hints Regularity.
From Regulus Require Import Continuity Existence Derivatives LinearAlgebra Questions Search
  Closures Tubes Parts.
Import ListNotations.
Open Scope R_scope.

(** ** The claim about a paving *)

(** PAVING of a closure: what NO SINGULARITY says, of the places in the parts that are kept. The
    start is in one of them. *)
Definition one_branch_in (c : closure) (w : parts) : Prop :=
  is_given c /\ is_kept w (the_start c) /\
  exists p, is_branch_among (fun x => in_set (places c) x /\ is_kept w x) c p.

(** ** Tubes *)

Inductive tubes :=
  | Excluded            (** a constraint is positive everywhere in the box *)
  | NoTube              (** nothing is known of the box *)
  | Held (t : tube)     (** the configuration is in the tube *)
  | Cut (variable : nat) (place : F.type) (lower upper : tubes).

Definition leaf := (option tube * box)%type.

Fixpoint leaves_of (g : tubes) (b : box) : list leaf :=
  match g with
  | Excluded | NoTube => [(None, b)]
  | Held t => [(Some t, b)]
  | Cut k p l u => leaves_of l (lower_part b k p) ++ leaves_of u (upper_part b k p)
  end.

Definition apart (i j : interval) : bool := is_not_zero (subtract i j).

Definition boxes_apart (a b : box) : bool :=
  existsb (fun k => apart (nth k a I.nai) (nth k b I.nai)) (seq 0 (length a)).

Definition meet_boxes (a b : box) : box :=
  map (fun k => I.meet (nth k a I.nai) (nth k b I.nai)) (seq 0 (length a)).

(** Tubes about the configurations of a box, by Newton's method. Nothing is proved of them. *)
Module Fit.
  Import Coq.Floats.PrimFloat.

  Definition widened (t : tube) (f : F.type) : tube :=
    Tube (foot t) (axis_at t) (tilt t) (map (fun r => mul r f) (reach t)).

  Definition equations_on_axis (c : closure) (full : nat) (b : box) (t : tube) : list form :=
    let names :=
      tube_names c t (variables full b) (length b) (fun _ => constant_form Intervals.zero)
      in
    map (fun e => form_of (evaluate names e)) (equations c).

  (** A step of Newton's method in the middle of the box. k is roughly the inverse of the
      derivatives. *)
  Definition newton_step (c : closure) (full : nat) (k : list (list F.type)) (b : box) (t : tube) :=
    let f := map (fun e => I.midpoint (constant e)) (equations_on_axis c full b t) in
    let change i := float_sum (map (fun l => mul (get k i l) (nth l f nan)) (seq 0 (unknowns c))) in
    Tube (foot t) (map (fun i => sub (number (axis_at t) i) (change i)) (seq 0 (unknowns c)))
      (tilt t) (reach t).

  (** The tube with its foot in the middle of the box. *)
  Definition moved_to (b : box) (t : tube) : tube :=
    let m := map (fun i => I.midpoint i) b in
    let shift row := float_sum (map (fun j =>
      mul (number row j) (sub (number m j) (number (foot t) j))) (seq 0 (length b))) in
    Tube m (map (fun u => add (fst u) (shift (snd u))) (combine (axis_at t) (tilt t))) (tilt t)
      (reach t).

  (** The axis turns about the foot such that the equations hardly change along it. *)
  Definition turned (c : closure) (full : nat) (k : list (list F.type)) (b : box)
    (t : tube) : tube :=
    let f := equations_on_axis c full b t in
    let slope j (e : form) := fold_left (fun s u => match fst u with
      | [v] => if Pos.eqb v (Pos.of_succ_nat j) then add s (I.midpoint (snd u)) else s
      | _ => s
      end) (linear e ++ single e) zero in
    let change i j :=
      let s := float_sum (map (fun l => mul (get k i l) (slope j (nth l f (constant_form I.nai))))
                            (seq 0 (unknowns c))) in
      if eqb s zero then zero else div s (radius (nth j b I.nai)) in
    Tube (foot t) (axis_at t)
      (tabulate (unknowns c) (length b) (fun i j => sub (get (tilt t) i j) (change i j))) (reach t).

  (** The tube about the configurations of the box, as they are in its middle. *)
  Definition fitted (c : closure) (full : nat) (b : box) (t : tube) : tube :=
    let s := moved_to b t in
    match bounds_of c full s b with
    | Some v =>
        let to_middle := Nat.iter 3 (newton_step c full (inverse v) b) in
        to_middle (turned c full (inverse v) b (to_middle s))
    | None => s
    end.

  Definition narrow (c : closure) (full : nat) (b : box) (t : tube) : list tube :=
    map (widened (fitted c full b t)) [0x1p-2; 0x1p-6]%float.

  (** The variable by which the axis changes most over the box. *)
  Definition steepest (b : box) (t : tube) : option nat :=
    largest_of (map (fun j =>
      let i := nth j b I.nai in
      mul (sub (I.upper i) (I.lower i)) (float_sum (map (fun row => abs (number row j)) (tilt t))))
      (seq 0 (length b))).
End Fit.

Section Check.
  Variables (c : closure) (full : nat).
  Let n := unknowns c.

  Definition is_tested (t : tube) (b : box) : bool :=
    match test_tube c full t b with Some _ => true | None => false end.

  (** Over a, the configuration in the first tube is in the second one at the same place of b. *)
  Definition leads_to (a b : box) (s t : tube) : bool :=
    match test_tube c full s a with
    | Some v =>
        let f := residuals c full s a in
        let d := departures n s v in
        forallb (fun i =>
          let gap := form_range (subtract_forms (newton_form n full s a v f i)
                       (axis_form t (variables full b) (length b) i)) in
          is_not_positive (subtract (add (I.abs gap) (rest_of n v d i))
                                    (point (number (reach t) i)))) (seq 0 n)
    | None => false
    end.

  Definition leads (b : box) (s t : tube) : bool := leads_to b b s t.

  (** Over b, or over each of its parts, one tube leads to the other, or a narrow one to both. *)
  Fixpoint agree (fuel : nat) (b : box) (s t : tube) : bool :=
    if leads b s t then true else if leads b t s then true
    else if existsb (fun u => leads b u s && leads b u t) (Fit.narrow c full b s) then true
    else
      match fuel, Fit.steepest b s with
      | S fuel', Some k =>
          let p := I.midpoint (nth k b I.nai) in
          if agree fuel' (lower_part b k p) s t then agree fuel' (upper_part b k p) s t else false
      | _, _ => false
      end.

  Definition most_halvings_of_link : nat := 5.

  Definition linked (x y : leaf) : bool :=
    match fst x, fst y with
    | Some s, Some t =>
        if boxes_apart (snd x) (snd y) then true
        else agree most_halvings_of_link (meet_boxes (snd x) (snd y)) s t
    | _, _ => true
    end.

  (** The leaves on both sides of a cut. *)
  Definition linked_across (k : nat) (p : F.type) (l u : list leaf) : bool :=
    let low := PrimFloat.next_down (PrimFloat.next_down p) in
    let high := PrimFloat.next_up (PrimFloat.next_up p) in
    let from q (x : leaf) := subtract (nth k (snd x) I.nai) (point q) in
    forallb (fun x => is_not_positive (from high x)) l
    && forallb (fun x => is_not_negative (from low x)) u
    && (let touching := filter (fun y => negb (is_positive (from high y))) u in
        forallb (fun x => if is_negative (from low x) then true
                          else forallb (linked x) touching) l).

  Fixpoint check_tubes (g : tubes) (b : box) : bool :=
    match g with
    | Excluded =>
        existsb (is_excluded (evaluate_definitions (variables full b) (definitions (places c))))
          (constraints (places c))
    | NoTube => true
    | Held t => is_tested t b
    | Cut k p l u =>
        let lb := lower_part b k p in
        let ub := upper_part b k p in
        if check_tubes l lb then
          if check_tubes u ub then linked_across k p (leaves_of l lb) (leaves_of u ub) else false
        else false
    end.

  (** ** The configurations at a place agree *)

  Definition held_at (ls : list leaf) (x p : list R) : Prop :=
    exists t b v, In (Some t, b) ls /\ in_box b x /\ test_tube c full t b = Some v /\
      p = tube_solution c t v x.

  Lemma apart_correct i j x : apart i j = true -> encloses i x -> encloses j x -> False.
  Proof.
    intros A X Y. apply (is_not_zero_correct _ _ A (subtract_encloses _ _ _ _ X Y)). ring.
  Qed.

  Lemma boxes_apart_correct a b x : boxes_apart a b = true -> in_box a x -> in_box b x -> False.
  Proof.
    intros H [_ A] [_ B]. apply existsb_exists in H as [k [_ H]].
    exact (apart_correct _ _ _ H (A k) (B k)).
  Qed.

  Lemma meet_boxes_correct a b x : in_box a x -> in_box b x -> in_box (meet_boxes a b) x.
  Proof.
    intros [L A] [_ B]. split; [unfold meet_boxes; rewrite map_size, seq_size; exact L|].
    intros k. unfold meet_boxes. destruct (Nat.lt_ge_cases k (length a)) as [K|K].
    - match goal with |- encloses (nth _ (map ?g _) _) _ => rewrite (nth_indep _ I.nai (g 0%nat))
        by (rewrite map_size, seq_size; exact K); rewrite (map_nth g), seq_nth by exact K end.
      apply meet_encloses; [apply A|apply B].
    - rewrite nth_overflow by (rewrite map_size, seq_size; exact K). apply unknown_encloses.
  Qed.

  Lemma leads_to_correct a b s t x y p : leads_to a b s t = true -> in_box a x -> in_box b y ->
    coordinate a x = coordinate b y -> in_tube n s x p -> solves c x p -> in_tube n t y p.
  Proof.
    unfold leads_to. destruct (test_tube c full s a) as [w|] eqn:T; [|discriminate].
    intros H A B Co P S. rewrite forallb_forall in H.
    split; [apply P|]. intros i I. specialize (H i ltac:(apply in_seq; fold n in I; lia)).
    destruct (near_newton_form c full s a w x T A p i P S I) as (q & d & Q & D & N).
    pose proof (coordinate_in_unit_box a x A) as U.
    assert (G : encloses (form_range (subtract_forms
        (newton_form n full s a w (residuals c full s a) i)
        (axis_form t (variables full b) (length b) i))) (q - axis t y i)).
    { apply (form_range_encloses (coordinate a x)); [exact U|].
      apply subtract_forms_enclose; [exact Q|].
      rewrite Co, (proj1 B). apply axis_form_encloses, variables_known, B. }
    pose proof (is_not_positive_correct _ _ H (subtract_encloses _ _ _ _
      (add_encloses _ _ _ _ (absolute_encloses _ _ G) D) (point_encloses (number (reach t) i)))) as
        Z.
    replace (nth i p 0 - axis t y i) with ((nth i p 0 - q) + (q - axis t y i)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. lra.
  Qed.

  Lemma leads_correct b s t v x p : leads b s t = true -> in_box b x ->
    in_tube n s x p -> solves c x p ->
    forall b', test_tube c full t b' = Some v -> in_box b' x -> p = tube_solution c t v x.
  Proof.
    intros H B P S b' T' B'. apply (only_solution c full t b' v x T' B'); [|exact S].
    exact (leads_to_correct b b s t x x p H B B eq_refl P S).
  Qed.

  Lemma agree_correct s a v t b w x : test_tube c full s a = Some v ->
    test_tube c full t b = Some w -> in_box a x -> in_box b x -> forall fuel m,
    agree fuel m s t = true -> in_box m x -> tube_solution c s v x = tube_solution c t w x.
  Proof.
    intros S T A B. induction fuel as [|fuel IH]; intros m H M; cbn [agree] in H;
      (destruct (leads m s t) eqn:L1;
       [exact (leads_correct m s t w x _ L1 M (solution_in_tube c full s a v x S A)
                 (tube_solution_solves c full s a v x S A) b T B)|]);
      (destruct (leads m t s) eqn:L2;
       [symmetry; exact (leads_correct m t s v x _ L2 M (solution_in_tube c full t b w x T B)
                           (tube_solution_solves c full t b w x T B) a S A)|]);
      (destruct (existsb _ _) eqn:N in H;
       [apply existsb_exists in N as (u & _ & N); apply andb_prop in N as [N1 N2];
        pose proof N1 as U; unfold leads, leads_to in U;
        destruct (test_tube c full u m) as [z|] eqn:Z; [clear U|discriminate];
        pose proof (solution_in_tube c full u _ z x Z M) as P;
        pose proof (tube_solution_solves c full u _ z x Z M) as Q;
        rewrite <- (leads_correct m u s v x _ N1 M P Q a S A);
        exact (leads_correct m u t w x _ N2 M P Q b T B)|]).
    - discriminate.
    - destruct (Fit.steepest m s) as [k|]; [|discriminate].
      destruct (agree fuel (lower_part _ _ _) s t) eqn:L; [|discriminate].
      destruct (parts_cover m x k (I.midpoint (nth k m I.nai)) M) as [D|D].
      + exact (IH _ L D).
      + exact (IH _ H D).
  Qed.

  Lemma linked_correct s a v t b w x : linked (Some s, a) (Some t, b) = true ->
    test_tube c full s a = Some v -> test_tube c full t b = Some w ->
    in_box a x -> in_box b x -> tube_solution c s v x = tube_solution c t w x.
  Proof.
    unfold linked. cbn [fst snd]. intros H S T A B. destruct (boxes_apart a b) eqn:D.
    - elim (boxes_apart_correct a b x D A B).
    - exact (agree_correct s a v t b w x S T A B _ _ H (meet_boxes_correct a b x A B)).
  Qed.

  Lemma linked_across_correct k p l u s a v t b w x : linked_across k p l u = true ->
    In (Some s, a) l -> In (Some t, b) u ->
    test_tube c full s a = Some v -> test_tube c full t b = Some w ->
    in_box a x -> in_box b x -> tube_solution c s v x = tube_solution c t w x.
  Proof.
    unfold linked_across. intros H L U S T A B.
    apply andb_prop in H as [H H3]. apply andb_prop in H as [H1 H2].
    rewrite forallb_forall in H1, H2, H3.
    specialize (H1 _ L). specialize (H2 _ U). specialize (H3 _ L). simpl in H1, H2, H3.
    set (low := PrimFloat.next_down (PrimFloat.next_down p)) in *.
    set (high := PrimFloat.next_up (PrimFloat.next_up p)) in *.
    assert (EA : forall q, encloses (subtract (nth k a I.nai) (point q)) (nth k x 0 - real_of q)).
    { intros q. apply subtract_encloses; [apply A|apply point_encloses]. }
    assert (EB : forall q, encloses (subtract (nth k b I.nai) (point q)) (nth k x 0 - real_of q)).
    { intros q. apply subtract_encloses; [apply B|apply point_encloses]. }
    pose proof (is_not_positive_correct _ _ H1 (EA high)).
    pose proof (is_not_negative_correct _ _ H2 (EB low)).
    apply orb_prop in H3 as [H3|H3].
    { pose proof (is_negative_correct _ _ H3 (EA low)). lra. }
    rewrite forallb_forall in H3.
    apply (linked_correct s a v t b w x); try assumption. apply H3, filter_In. split; [exact U|].
    simpl. destruct (is_positive (subtract (nth k b I.nai) (point high))) eqn:Q; [|reflexivity].
    pose proof (is_positive_correct _ _ Q (EB high)). lra.
  Qed.

  Lemma leaves_agree g : forall b x p q, check_tubes g b = true ->
    held_at (leaves_of g b) x p -> held_at (leaves_of g b) x q -> p = q.
  Proof.
    induction g as [| |t|k m l IHl u IHu]; intros b x p q H P Q.
    - destruct P as (t & b' & v & [E|[]] & _). discriminate.
    - destruct P as (t & b' & v & [E|[]] & _). discriminate.
    - destruct P as (t1 & b1 & v1 & [E1|[]] & B1 & T1 & ->).
      destruct Q as (t2 & b2 & v2 & [E2|[]] & B2 & T2 & ->).
      injection E1 as <- <-. injection E2 as <- <-. rewrite T1 in T2. injection T2 as <-.
      reflexivity.
    - simpl in H. apply andb_prop in H as [H1 H]. apply andb_prop in H as [H2 H3].
      assert (swap : forall p q, held_at (leaves_of l (lower_part b k m)) x p ->
                held_at (leaves_of u (upper_part b k m)) x q -> p = q).
      { intros p' q' (t1 & b1 & v1 & I1 & B1 & T1 & ->) (t2 & b2 & v2 & I2 & B2 & T2 & ->).
        eapply linked_across_correct; eassumption. }
      assert (side : forall p, held_at (leaves_of (Cut k m l u) b) x p ->
                held_at (leaves_of l (lower_part b k m)) x p \/
                held_at (leaves_of u (upper_part b k m)) x p).
      { intros r (t1 & b1 & v1 & I1 & B1 & T1 & ->). simpl in I1. apply in_app_or in I1 as [I1|I1];
          [left|right]; exists t1, b1, v1;
          (split; [exact I1|split; [exact B1|split; [exact T1|reflexivity]]]). }
      destruct (side p P) as [P'|P'], (side q Q) as [Q'|Q'].
      + exact (IHl _ x p q H1 P' Q').
      + exact (swap p q P' Q').
      + symmetry. exact (swap q p Q' P').
      + exact (IHu _ x p q H2 P' Q').
  Qed.

  (** ** The configuration at each place *)

  Fixpoint configuration (g : tubes) (b : box) (x : list R) : list R :=
    match g with
    | Excluded | NoTube => []
    | Held t => match test_tube c full t b with Some v => tube_solution c t v x | None => [] end
    | Cut k p l u =>
        if Rle_dec (nth k x 0) (real_of p) then configuration l (lower_part b k p) x
        else configuration u (upper_part b k p) x
    end.

  (** No tube holds the configuration at x. *)
  Fixpoint is_without_tube_at (g : tubes) (x : list R) : bool :=
    match g with
    | Excluded | NoTube => true
    | Held _ => false
    | Cut k p l u => if Rle_dec (nth k x 0) (real_of p) then is_without_tube_at l x
                     else is_without_tube_at u x
    end.

  Lemma configuration_held g : forall b x, check_tubes g b = true -> in_box b x ->
    is_without_tube_at g x = false -> held_at (leaves_of g b) x (configuration g b x).
  Proof.
    induction g as [| |t|k m l IHl u IHu]; intros b x H B N.
    - discriminate.
    - discriminate.
    - simpl in *. unfold is_tested in H. destruct (test_tube c full t b) as [v|] eqn:T;
      [|discriminate].
      exists t, b, v. split; [left; reflexivity|]. split; [exact B|]. split; [exact T|reflexivity].
    - simpl in H. apply andb_prop in H as [H1 H]. apply andb_prop in H as [H2 H3]. simpl in N |- *.
      destruct (Rle_dec (nth k x 0) (real_of m)) as [L|L].
      + destruct (IHl (lower_part b k m) x H1 (in_lower_part b k m x B L) N)
          as (t1 & b1 & v1 & I1 & R1).
        exists t1, b1, v1. split; [apply in_or_app; left; exact I1|exact R1].
      + destruct (IHu (upper_part b k m) x H2 (in_upper_part b k m x B L) N)
          as (t1 & b1 & v1 & I1 & R1).
        exists t1, b1, v1. split; [apply in_or_app; right; exact I1|exact R1].
  Qed.

  Lemma not_without_tube g : forall b x, in_box b x ->
    (forall b', In (None, b') (leaves_of g b) -> ~ in_box b' x) -> is_without_tube_at g x = false.
  Proof.
    induction g as [| |t|k m l IHl u IHu]; intros b x B N.
    - elim (N b); [left; reflexivity|exact B].
    - elim (N b); [left; reflexivity|exact B].
    - reflexivity.
    - simpl in N |- *. destruct (Rle_dec (nth k x 0) (real_of m)) as [L|L].
      + apply (IHl (lower_part b k m) x (in_lower_part b k m x B L)). intros b' I.
        apply N, in_or_app. left. exact I.
      + apply (IHu (upper_part b k m) x (in_upper_part b k m x B L)). intros b' I.
        apply N, in_or_app. right. exact I.
  Qed.

  (** Over each part of w that is kept there are tubes, and f is true of them; but for places that
      are excluded. *)
  Fixpoint holds_in (f : tube -> box -> bool) (w : parts) (g : tubes) (b : box) : bool :=
    match g with
    | Excluded => true
    | NoTube => negb (keeps_some w)
    | Held t => if keeps_some w then f t b else true
    | Cut k p l u => holds_in f (lower_side w k p) l (lower_part b k p)
                     && holds_in f (upper_side w k p) u (upper_part b k p)
    end.

  Lemma held_in_part f g : forall w b x, check_tubes g b = true -> holds_in f w g b = true ->
    in_box b x -> in_set (places c) x -> is_kept w x ->
    is_without_tube_at g x = false /\
    exists t b' v, In (Some t, b') (leaves_of g b) /\ in_box b' x /\
      test_tube c full t b' = Some v /\ configuration g b x = tube_solution c t v x /\
      f t b' = true.
  Proof.
    induction g as [| |t|k m l IHl u IHu]; intros w b x H F B S W; simpl in H, F |- *.
    - elim (outside_correct (places c) (Method full 0) b x B H S).
    - rewrite (keeps_some_correct w x W) in F. discriminate.
    - rewrite (keeps_some_correct w x W) in F. split; [reflexivity|]. unfold is_tested in H.
      destruct (test_tube c full t b) as [v|] eqn:T; [|discriminate]. exists t, b, v.
      split; [left; reflexivity|]. split; [exact B|]. split; [exact T|]. split; [|exact F].
      reflexivity.
    - apply andb_prop in H as [H1 H]. apply andb_prop in H as [H2 _].
      apply andb_prop in F as [F1 F2]. destruct (Rle_dec (nth k x 0) (real_of m)) as [L|L].
      + destruct (IHl _ _ x H1 F1 (in_lower_part b k m x B L) S (lower_side_correct w k m x L W))
          as (N & t & b' & v & I & R).
        split; [exact N|]. exists t, b', v. split; [apply in_or_app; left; exact I|exact R].
      + destruct (IHu _ _ x H2 F2 (in_upper_part b k m x B L) S (upper_side_correct w k m x L W))
          as (N & t & b' & v & I & R).
        split; [exact N|]. exists t, b', v. split; [apply in_or_app; right; exact I|exact R].
  Qed.

  (** There are tubes over each part that is kept. *)
  Definition has_tubes_in : parts -> tubes -> box -> bool := holds_in (fun _ _ => true).

  Lemma held_in_set w g b x : check_tubes g b = true -> has_tubes_in w g b = true ->
    in_box b x -> in_set (places c) x -> is_kept w x ->
    is_without_tube_at g x = false /\ held_at (leaves_of g b) x (configuration g b x).
  Proof.
    intros H F B S W. destruct (held_in_part _ g w b x H F B S W) as (N & t & b' & v & R).
    split; [exact N|]. exists t, b', v. split; [apply R|]. split; [apply R|]. split; apply R.
  Qed.

  Lemma leaves_length g : forall b t b', In (t, b') (leaves_of g b) -> length b' = length b.
  Proof.
    induction g as [| |t|k m l IHl u IHu]; intros b t' b' I.
    - destruct I as [E|[]]. injection E as <- <-. reflexivity.
    - destruct I as [E|[]]. injection E as <- <-. reflexivity.
    - destruct I as [E|[]]. injection E as <- <-. reflexivity.
    - simpl in I. apply in_app_or in I as [I|I]; [apply IHl in I|apply IHu in I]; rewrite I;
        apply replace_length.
  Qed.
End Check.

(** ** Motions *)

Lemma locally_in {A} (l : list A) (P : A -> R -> Prop) (s : R) :
  (forall a, In a l -> locally s (P a)) -> locally s (fun t => forall a, In a l -> P a t).
Proof.
  induction l as [|a l IH]; intros H; [apply filter_forall; intros t a []|].
  apply (filter_imp (fun t => P a t /\ forall b, In b l -> P b t)).
  - intros t [X Y] b [<-|B]; auto.
  - apply filter_and; [apply H; left; reflexivity|apply IH; intros; apply H; right; assumption].
Qed.

Lemma locally_below n (P : nat -> R -> Prop) (s : R) :
  (forall i, (i < n)%nat -> locally s (P i)) -> locally s (fun t => forall i, (i < n)%nat -> P i t).
Proof.
  intros H. apply (filter_imp (fun t => forall i, In i (seq 0 n) -> P i t)).
  - intros t X i I. apply X, in_seq. lia.
  - apply locally_in. intros i I. apply in_seq in I. apply H. lia.
Qed.

Definition continuous_at (m : R -> list R) (s : R) : Prop :=
  forall k, continuity_pt (fun t => nth k (m t) 0) s.

Lemma outside_stays b m s : continuous_at m s -> (forall t, length (m t) = length b) ->
  ~ in_box b (m s) -> locally s (fun t => ~ in_box b (m t)).
Proof.
  intros C L N.
  assert (E : exists k, ~ encloses (nth k b I.nai) (nth k (m s) 0)).
  { apply not_all_ex_not. intros A. apply N. split; [symmetry; apply L|exact A]. }
  destruct E as [k E].
  assert (H : locally s (fun t => ~ encloses (nth k b I.nai) (nth k (m t) 0))).
  2: { revert H. apply filter_imp. intros t Nt [_ B]. exact (Nt (B k)). }
  specialize (C k). rewrite continuity_pt_locally in C. set (x := nth k (m s) 0) in *.
  unfold encloses in *. destruct (I.convert (nth k b I.nai)) as [|l u]; simpl in *; [tauto|].
  assert (O : (exists r, l = Xreal r /\ x < r) \/ (exists r, u = Xreal r /\ r < x)
              ).
  { destruct l as [|l], u as [|u]; simpl in E.
    - tauto.
    - right. exists u. split; [reflexivity|]. apply Rnot_le_lt. tauto.
    - left. exists l. split; [reflexivity|]. apply Rnot_le_lt. tauto.
    - destruct (Rlt_dec x l); [left; eauto|right]. exists u. split; [reflexivity|].
      apply Rnot_le_lt. intros Q. apply E. split; lra. }
  destruct O as [(r & -> & Q)|(r & -> & Q)].
  - assert (P : 0 < r - x) by lra. generalize (C (mkposreal _ P)). apply filter_imp. simpl.
    intros t T [X _]. apply Rabs_lt_between in T. lra.
  - assert (P : 0 < x - r) by lra. generalize (C (mkposreal _ P)). apply filter_imp. simpl.
    intros t T [_ X]. apply Rabs_lt_between in T. lra.
Qed.

Lemma axis_continuous t m s i a : continuous_at m s -> (forall t, length (m t) = a) ->
  continuity_pt (fun r => axis t (m r) i) s.
Proof.
  intros C L.
  apply (continuity_pt_ext (fun r => real_of (number (axis_at t) i) + sum a (fun j =>
    real_of (get (tilt t) i j) * (nth j (m r) 0 - real_of (number (foot t) j))))).
  { intros r. unfold axis. rewrite L. reflexivity. }
  apply (continuity_pt_plus (fun _ => real_of (number (axis_at t) i))); [apply
    continuous_constant|].
  apply (sum_continuous a (fun j r => real_of (get (tilt t) i j)
                                      * (nth j (m r) 0 - real_of (number (foot t) j)))).
  intros j _. apply (continuity_pt_mult (fun _ => real_of (get (tilt t) i j)));
    [apply continuous_constant|].
  apply (continuity_pt_minus (fun r => nth j (m r) 0)); [apply C|apply continuous_constant].
Qed.

Lemma append_continuous (a b : R -> list R) s l : continuous_names a s -> continuous_names b s ->
  (forall t, length (a t) = l) -> continuous_names (fun t => a t ++ b t) s.
Proof.
  intros A B L k. destruct (Nat.lt_ge_cases k l) as [K|K].
  - apply (continuity_pt_ext (fun t => nth k (a t) 0)); [|apply A].
    intros t. rewrite app_nth1; [reflexivity|rewrite L; exact K].
  - apply (continuity_pt_ext (fun t => nth (k - l) (b t) 0)); [|apply B].
    intros t. rewrite app_nth2; rewrite L; [reflexivity|exact K].
Qed.

Lemma small_multiple n (f : nat -> R) (eps : posreal) : (forall i, (i < n)%nat -> 0 < f i) ->
  exists e, 0 < e /\ forall i, (i < n)%nat -> e * f i <= eps.
Proof.
  induction n as [|n IH]; intros H; [exists 1; split; [lra|lia]|].
  destruct IH as [e [E B]]; [intros; apply H; lia|]. pose proof (H n ltac:(lia)) as P.
  exists (Rmin e (eps / f n)). split.
  - apply Rmin_pos; [exact E|]. apply Rdiv_lt_0_compat; [apply eps|exact P].
  - intros i I. destruct (Nat.eq_dec i n) as [->|D].
    + apply Rle_trans with (eps / f n * f n); [|right; field; lra].
      apply Rmult_le_compat_r; [left; apply H; lia|apply Rmin_r].
    + eapply Rle_trans; [|apply (B i); lia]. apply Rmult_le_compat_r; [left; apply H; lia|apply
      Rmin_l].
Qed.

Section Leaf.
  Variables (c : closure) (full : nat) (t : tube) (b : box) (v : tube_bounds).
  Hypothesis tested : test_tube c full t b = Some v.
  Let n := unknowns c.
  Variables (m : R -> list R) (s : R).
  Hypothesis C : continuous_at m s.
  Hypothesis L : forall t, length (m t) = length b.

  Lemma errors_continuous u i : in_box b (m s) -> inside n (reach_of t) u -> (i < n)%nat ->
    continuity_pt (fun r => image n (error_at c t (m r)) (inverse_of_middle v) u i) s.
  Proof.
    intros B U I. unfold image.
    apply (sum_continuous n (fun l r => inverse_of_middle v i l * error_at c t (m r) u l)).
    intros l Ll. apply (continuity_pt_mult (fun _ => inverse_of_middle v i l));
      [apply continuous_constant|].
    destruct (values_inside c full t b v (m s) tested B u U) as (D1 & _ & D2 & D3 & _).
    unfold error_at, equation_at.
    apply (value_continuous (fun r => names_at c (m r) (beside (unknowns c) t (m r) u))).
    - unfold names_at.
      apply (extend_continuous (further c)
        (fun r => extend (m r) (definitions (places c)) ++ beside (unknowns c) t (m r) u)).
      + apply append_continuous with (length b + length (definitions (places c)))%nat.
        * apply (extend_continuous _ m); [exact C|intros; rewrite !L; reflexivity|exact D1].
        * intros k. destruct (Nat.lt_ge_cases k (unknowns c)) as [K|K].
          -- apply (continuity_pt_ext (fun r => axis t (m r) k + u k)).
             { intros r. rewrite beside_nth by exact K. reflexivity. }
             apply (continuity_pt_plus (fun r => axis t (m r) k)); [|apply continuous_constant].
             apply axis_continuous with (length b); assumption.
          -- apply (continuity_pt_ext (fun _ => 0)); [|apply continuous_constant].
             intros r. rewrite nth_overflow; [reflexivity|rewrite beside_length; exact K].
        * intros r. rewrite extend_length, L. reflexivity.
      + intros r. rewrite !app_size, !extend_length, !beside_length, !L. reflexivity.
      + exact D2.
    - rewrite Forall_forall in D3. apply D3, nth_In.
      destruct (everything_known c full t b v tested) as (_ & _ & _ & _ & _ & E & _).
      rewrite E. exact Ll.
  Qed.

  Lemma leaf_continuous p : (in_box b (m s) -> p = tube_solution c t v (m s)) ->
    forall eps : posreal, locally s (fun r => in_box b (m r) ->
      forall i, (i < n)%nat -> Rabs (nth i (tube_solution c t v (m r)) 0 - nth i p 0) < eps).
  Proof.
    intros P eps. destruct (classic (in_box b (m s))) as [B|N].
    2: { generalize (outside_stays b m s C L N). apply filter_imp. intros r X Y. contradiction. }
    specialize (P B).
    pose proof (solution_in_tube c full t b v (m s) tested B) as Q. rewrite <- P in Q.
    set (u := fun i => nth i p 0 - axis t (m s) i).
    assert (U : inside n (reach_of t) u) by (intros i I; apply Q, I).
    assert (E2 : 0 < eps / 2) by (pose proof (cond_pos eps); lra).
    destruct (small_multiple n (reach_of t) (mkposreal _ E2)) as [e [E S]].
    { intros i I. apply (tests c full t b v tested i I). }
    simpl in S.
    assert (H1 : locally s (fun r => forall i, (i < n)%nat ->
      Rabs (image n (error_at c t (m r)) (inverse_of_middle v) u i)
      <= e * (reach_of t i - sum n (fun j => spread_of v i j * reach_of t j)))).
    { apply locally_below. intros i I. pose proof (errors_continuous u i B U I) as K.
      rewrite continuity_pt_locally in K.
      assert (G : 0 < e * (reach_of t i - sum n (fun j => spread_of v i j * reach_of t j))).
      { apply Rmult_lt_0_compat; [exact E|].
        pose proof (contracts_here c full t b v (m s) tested B i I). fold n in H. lra. }
      generalize (K (mkposreal _ G)). apply filter_imp. simpl. intros r X.
      assert (Z : image n (error_at c t (m s)) (inverse_of_middle v) u i = 0).
      { unfold image. apply sum_zero. intros l Ll.
        unfold u. rewrite (errors_vanish c t (m s) p) with (i := l); try assumption; [ring|].
        rewrite P. exact (tube_solution_solves c full t b v (m s) tested B). }
      rewrite Z, Rminus_0_r in X. lra. }
    assert (H2 : locally s (fun r => forall i, (i < n)%nat ->
      Rabs (axis t (m r) i - axis t (m s) i) < eps / 2)).
    { apply locally_below. intros i I.
      pose proof (axis_continuous t m s i (length b) C L) as K. rewrite continuity_pt_locally in K.
      exact (K (mkposreal _ E2)). }
    generalize (filter_and _ _ H1 H2). apply filter_imp. intros r [X Y] Br i I.
    pose proof (near_tube_solution c full t b v (m r) tested Br _ u e
      (solution_in_tube c full t b v (m r) tested Br)
      (tube_solution_solves c full t b v (m r) tested Br) U X i I) as Z.
    specialize (Y i I). specialize (S i I). unfold u in Z.
    replace (nth i (tube_solution c t v (m r)) 0 - nth i p 0)
      with ((nth i (tube_solution c t v (m r)) 0 - axis t (m r) i - (nth i p 0 - axis t (m s) i))
            + (axis t (m r) i - axis t (m s) i)) by ring.
    eapply Rle_lt_trans; [apply Rabs_triang|]. lra.
  Qed.

  Lemma leaf_unique q : continuous_at q s ->
    (in_box b (m s) -> q s = tube_solution c t v (m s)) ->
    locally s (fun r => in_box b (m r) -> solves c (m r) (q r) ->
      q r = tube_solution c t v (m r)).
  Proof.
    intros Cq P. destruct (classic (in_box b (m s))) as [B|N].
    2: { generalize (outside_stays b m s C L N). apply filter_imp. intros r X Y. contradiction. }
    specialize (P B).
    assert (H : locally s (fun r => forall i, (i < n)%nat ->
              Rabs (nth i (q r) 0 - axis t (m r) i) <= reach_of t i)).
    { apply locally_below. intros i I.
      destruct (solution_within c full t b v (m s) tested B i I) as (d & _ & D & R).
      rewrite <- P in D.
      assert (K : continuity_pt (fun r => nth i (q r) 0 - axis t (m r) i) s).
      { apply (continuity_pt_minus (fun r => nth i (q r) 0)); [apply Cq|].
        apply axis_continuous with (length b); assumption. }
      rewrite continuity_pt_locally in K.
      assert (G : 0 < reach_of t i - d) by lra.
      generalize (K (mkposreal _ G)). apply filter_imp. simpl. intros r X.
      replace (nth i (q r) 0 - axis t (m r) i)
        with ((nth i (q r) 0 - axis t (m r) i - (nth i (q s) 0 - axis t (m s) i))
              + (nth i (q s) 0 - axis t (m s) i)) by ring.
      eapply Rle_trans; [apply Rabs_triang|]. lra. }
    revert H. apply filter_imp. intros r X Br Sq.
    apply (only_solution c full t b v (m r) tested Br); [|exact Sq].
    split; [apply Sq|exact X].
  Qed.
End Leaf.

(** p is what each chart says while the motion is in it. *)
Section Charts.
  Variables (A : Type) (charts : list A) (n : nat).
  Variables (within on : A -> R -> Prop) (chart : A -> R -> list R) (p : R -> list R).
  Hypothesis covered : forall r, exists a, In a charts /\ within a r /\ on a r.
  Hypothesis agrees : forall a r, In a charts -> within a r -> p r = chart a r.
  Hypothesis size : forall r, length (p r) = n.
  Hypothesis chart_continuous : forall a s, In a charts -> forall eps : posreal,
    locally s (fun r => within a r ->
      forall i, (i < n)%nat -> Rabs (nth i (chart a r) 0 - nth i (p s) 0) < eps).

  Lemma charts_continuous : continuous_motion p.
  Proof.
    intros k s. destruct (Nat.lt_ge_cases k n) as [K|K].
    2: { apply (continuity_pt_ext (fun _ => 0)); [|apply continuous_constant].
         intros r. rewrite nth_overflow; [reflexivity|]. rewrite size. exact K. }
    apply continuity_pt_locally. intros eps.
    generalize (locally_in charts _ s (fun a I => chart_continuous a s I eps)).
    apply filter_imp. intros r H. destruct (covered r) as (a & I & W & _).
    rewrite (agrees a r I W). exact (H a I W k K).
  Qed.

  Variable q : R -> list R.
  Hypothesis Cq : continuous_motion q.
  Hypothesis sizes : forall r, length (q r) = n.
  Hypothesis chart_unique : forall a s, In a charts -> q s = p s ->
    locally s (fun r => within a r -> on a r -> q r = chart a r).

  Lemma stays_equal s : q s = p s -> locally s (fun r => q r = p r).
  Proof.
    intros E. generalize (locally_in charts _ s (fun a I => chart_unique a s I E)).
    apply filter_imp. intros r H. destruct (covered r) as (a & I & W & O).
    rewrite (agrees a r I W). exact (H a I W O).
  Qed.

  Lemma stays_different s : q s <> p s -> locally s (fun r => q r <> p r).
  Proof.
    intros N.
    assert (E : exists i, nth i (q s) 0 <> nth i (p s) 0).
    { apply not_all_ex_not. intros B. apply N, list_equal; [|auto].
      rewrite size. apply sizes. }
    destruct E as [i E].
    assert (K : continuity_pt (fun r => nth i (q r) 0 - nth i (p r) 0) s).
    { apply (continuity_pt_minus (fun r => nth i (q r) 0)); [apply Cq|apply charts_continuous]. }
    rewrite continuity_pt_locally in K.
    assert (G : 0 < Rabs (nth i (q s) 0 - nth i (p s) 0)) by (apply Rabs_pos_lt; lra).
    generalize (K (mkposreal _ G)). apply filter_imp. simpl. intros r X Y. rewrite Y in X.
    rewrite Rminus_eq_0, Rminus_0_l, Rabs_Ropp in X. lra.
  Qed.

  Theorem charts_unique s : q s = p s -> forall t, q t = p t.
  Proof.
    intros E. set (f := fun r => if list_eq_dec Req_EM_T (q r) (p r) then 0 else 1).
    assert (D : forall r, is_derive f r 0).
    { intros r. destruct (list_eq_dec Req_EM_T (q r) (p r)) as [Y|Y].
      - apply (is_derive_ext_loc (fun _ => 0)); [|apply @is_derive_const].
        generalize (stays_equal r Y). apply filter_imp. intros t T. unfold f.
        destruct list_eq_dec; [reflexivity|contradiction].
      - apply (is_derive_ext_loc (fun _ => 1)); [|apply @is_derive_const].
        generalize (stays_different r Y). apply filter_imp. intros t T. unfold f.
        destruct list_eq_dec; [contradiction|reflexivity]. }
    assert (S : forall a b, a < b -> f a = f b) by (intros a b; apply eq_is_derive; auto).
    intros t. assert (F : f t = f s).
    { destruct (Rtotal_order t s) as [T|[->|T]]; [apply S, T|reflexivity|symmetry; apply S, T]. }
    unfold f in F. destruct (list_eq_dec Req_EM_T (q s) (p s)); [|contradiction].
    destruct (list_eq_dec Req_EM_T (q t) (p t)); [assumption|lra].
  Qed.
End Charts.

(** The leaves with tubes, and what the test says of them. *)
Definition held_leaf := (tube * box * tube_bounds)%type.

Definition held_leaves (c : closure) (full : nat) (ls : list leaf) : list held_leaf :=
  flat_map (fun x => match fst x with
    | Some t => match test_tube c full t (snd x) with Some v => [(t, snd x, v)] | None => [] end
    | None => []
    end) ls.

Lemma in_held_leaves c full ls t b v : In (t, b, v) (held_leaves c full ls) <->
  In (Some t, b) ls /\ test_tube c full t b = Some v.
Proof.
  unfold held_leaves. rewrite in_flat_map. split.
  - intros ([[s|] a] & I & E); simpl in E; [|contradiction].
    destruct (test_tube c full s a) as [w|] eqn:T; [|contradiction].
    destruct E as [[= <- <- <-]|[]]. auto.
  - intros [I T]. exists (Some t, b). split; [exact I|]. simpl. rewrite T. left. reflexivity.
Qed.

Section Branch.
  Variables (c : closure) (full : nat) (g : tubes) (root : box).
  Hypothesis checked : check_tubes c full g root = true.
  Let n := unknowns c.
  Let ls := leaves_of g root.
  Let p := configuration c full g root.
  Variable m : R -> list R.
  Hypothesis C : continuous_motion m.
  Hypothesis in_root : forall t, in_box root (m t).
  Hypothesis held : forall t, held_at c full ls (m t) (p (m t)).

  Lemma length_in_leaf t b : In (t, b) ls -> forall r, length (m r) = length b.
  Proof.
    intros I r. rewrite (leaves_length g root t b I). symmetry. apply in_root.
  Qed.

  Let within (a : held_leaf) (r : R) : Prop := in_box (snd (fst a)) (m r).
  Let chart (a : held_leaf) (r : R) : list R := tube_solution c (fst (fst a)) (snd a) (m r).

  Lemma leaves_cover (on : R -> Prop) : (forall r, on r) ->
    forall r, exists a, In a (held_leaves c full ls) /\ within a r /\ on r.
  Proof.
    intros O r. destruct (held r) as (t & b & v & I & B & T & _).
    exists (t, b, v). split; [apply in_held_leaves; auto|]. split; [exact B|apply O].
  Qed.

  Lemma leaf_agrees a r : In a (held_leaves c full ls) -> within a r -> p (m r) = chart a r.
  Proof.
    destruct a as [[t b] v]. intros I B. apply in_held_leaves in I as [I T].
    apply (leaves_agree c full g root (m r)); [exact checked|apply held|].
    exists t, b, v. auto.
  Qed.

  Lemma configuration_length r : length (p (m r)) = n.
  Proof.
    destruct (held r) as (t & b & v & _ & B & T & E). rewrite E. apply beside_length.
  Qed.

  Lemma leaves_continuous a s : In a (held_leaves c full ls) -> forall eps : posreal,
    locally s (fun r => within a r ->
      forall i, (i < n)%nat -> Rabs (nth i (chart a r) 0 - nth i (p (m s)) 0) < eps).
  Proof.
    intros I. pose proof (leaf_agrees a s I) as G. destruct a as [[t b] v].
    apply in_held_leaves in I as [I T].
    exact (leaf_continuous c full t b v T m s (fun k => C k s) (length_in_leaf _ _ I) (p (m s)) G).
  Qed.

  Lemma configuration_continuous : continuous_motion (fun t => p (m t)).
  Proof.
    exact (charts_continuous _ _ n within (fun _ _ => True) chart (fun t => p (m t))
      (leaves_cover (fun _ => True) (fun _ => Logic.I)) leaf_agrees configuration_length
      leaves_continuous).
  Qed.

  Theorem configuration_unique q : continuous_motion q -> (forall t, solves c (m t) (q t)) ->
    forall s, q s = p (m s) -> forall t, q t = p (m t).
  Proof.
    intros Cq Sq.
    apply (charts_unique _ _ n within (fun _ r => solves c (m r) (q r)) chart (fun t => p (m t))
      (leaves_cover (fun r => solves c (m r) (q r)) Sq) leaf_agrees configuration_length
      leaves_continuous q Cq); [intros r; apply Sq|].
    intros a s I E. pose proof (leaf_agrees a s I) as G. destruct a as [[t b] v].
    apply in_held_leaves in I as [I T].
    apply (leaf_unique c full t b v T m s (fun k => C k s) (length_in_leaf _ _ I) q
      (fun k => Cq k s)). intros B. rewrite E. exact (G B).
  Qed.
End Branch.

(** ** The start, and the whole check *)

Definition enclose_values (l : list expression) : option box :=
  let vs := map (evaluate []) l in
  if forallb is_known vs
  then Some (map (fun v => match v with Some w => range w | None => I.nai end) vs) else None.

Lemma nothing_known : known (fun _ => 0) [] [].
Proof. split; [reflexivity|]. intros k v. destruct k; discriminate. Qed.

Lemma origin_in_unit_box : in_unit_box (fun _ => 0).
Proof. intros k. rewrite Rabs_R0. lra. Qed.

Lemma enclose_values_correct l b : enclose_values l = Some b ->
  Forall (defined []) l /\ in_box b (map (value []) l).
Proof.
  unfold enclose_values. intros H.
  assert (K : forallb is_known (map (evaluate []) l) = true).
  { destruct (forallb is_known (map (evaluate []) l)); [reflexivity|discriminate]. }
  rewrite K in H. injection H as <-. revert K.
  induction l as [|e l IH]; intros K; [split; [constructor|split; [reflexivity|]]|].
  { intros [|k]; apply unknown_encloses. }
  simpl in K. apply andb_prop in K as [K1 K2]. destruct (IH K2) as [D [L B]].
  destruct (evaluate [] e) as [v|] eqn:E; [|discriminate].
  destruct (evaluate_correct _ _ _ e v origin_in_unit_box nothing_known E) as [De [R _]].
  split; [constructor; assumption|]. split; [simpl; f_equal; exact L|].
  intros [|k]; simpl; rewrite ?E; [exact R|apply B].
Qed.

Definition subset_boxes (a b : box) : bool :=
  Nat.eqb (length a) (length b)
  && forallb (fun k => I.subset (nth k a I.nai) (nth k b I.nai)) (seq 0 (length a)).

Lemma subset_boxes_correct a b x : subset_boxes a b = true -> in_box a x -> in_box b x.
Proof.
  unfold subset_boxes. intros H [L A]. apply andb_prop in H as [E H]. apply Nat.eqb_eq in E.
  rewrite forallb_forall in H. split; [lia|]. intros k.
  destruct (Nat.lt_ge_cases k (length a)) as [K|K].
  - exact (I.subset_correct _ _ _ (A k) (H k ltac:(apply in_seq; lia))).
  - rewrite nth_overflow by lia. apply unknown_encloses.
Qed.

(** The equations alone. Near the start nothing else needs a value but where the configuration is. *)
Definition bare (c : closure) : closure :=
  Closure (places c) (unknowns c) (further c) (equations c) [] (start c) (near c).

Section Start.
  Variables (c : closure) (full : nat).
  Let n := unknowns c.

  (** The place of the start is in b, and the values and radii of the unknowns in these boxes. *)
  Variables (b middles radii : box).

  Definition middle_of (i : nat) : interval := nth i middles I.nai.
  Definition radius_of (i : nat) : interval := nth i radii I.nai.

  (** Over b, the tube holds all that is within the radii. *)
  Definition holds_near (b : box) (t : tube) : bool :=
    let vs := variables full b in
    forallb (fun i =>
      let gap := subtract (middle_of i) (form_range (axis_form t vs (length b) i)) in
      is_not_positive (subtract (add (I.abs gap) (radius_of i)) (point (number (reach t) i))))
      (seq 0 n).

  (** Over b, the configuration in the tube is within the radii. *)
  Definition is_within (b : box) (t : tube) : bool :=
    match test_tube c full t b with
    | Some v =>
        let vs := variables full b in
        forallb (fun i =>
          let gap := subtract (form_range (axis_form t vs (length b) i)) (middle_of i) in
          is_not_positive (subtract (add (I.abs gap) (departure n t v i)) (radius_of i)))
          (seq 0 n)
    | None => false
    end.

  (** [around] holds what is within the radii; [tight] is within them, and has the configuration of
      each tube at the start. *)
  Definition starts (root : box) (around tight : tube) (ls : list leaf) : bool :=
    subset_boxes b root && is_tested (bare c) full around b && holds_near b around
    && Nat.eqb (length (near c)) n && is_within b tight
    && forallb (fun x => boxes_apart (snd x) b ||
         match fst x with
         | Some t => leads c full (meet_boxes (snd x) b) tight t
         | None => false
         end) ls.
End Start.

Lemma near_lists (l : list (expression * expression)) : forall p,
  Forall2 (fun s u => Rabs (s - value [] (fst u)) <= value [] (snd u)) p l <->
  length p = length l /\ forall i, (i < length l)%nat ->
    Rabs (nth i p 0 - nth i (map (value []) (map fst l)) 0) <= nth i (map (value []) (map snd l)) 0.
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

Definition check_branch_in (c : closure) (full : nat) (around tight : tube) (w : parts)
    (g : tubes) : bool :=
  match enclose_ranges (ranges (places c)), enclose_values (start c),
        enclose_values (map fst (near c)), enclose_values (map snd (near c)) with
  | Some root, Some b, Some middles, Some radii =>
      Nat.eqb (length (equations c)) (unknowns c) && check_tubes c full g root
      && has_tubes_in w g root && keeps_all w b
      && starts c full b middles radii root around tight (leaves_of g root)
  | _, _, _, _ => false
  end.

Lemma check_branch_holds c full around tight w g :
  check_branch_in c full around tight w g = true -> is_given c /\ is_kept w (the_start c) /\
  exists root, enclose_ranges (ranges (places c)) = Some root /\
    check_tubes c full g root = true /\
    is_branch_among (fun x => in_set (places c) x /\ is_kept w x) c
      (configuration c full g root) /\
    in_box root (the_start c) /\ is_without_tube_at g (the_start c) = false.
Proof.
  unfold check_branch_in. destruct (enclose_ranges (ranges (places c))) as [root|] eqn:R;
    [|discriminate].
  destruct (enclose_values (start c)) as [b|] eqn:S; [|discriminate].
  destruct (enclose_values (map fst (near c))) as [middles|] eqn:M; [|discriminate].
  destruct (enclose_values (map snd (near c))) as [radii|] eqn:D; [|discriminate].
  intros H. apply andb_prop in H as [H H3]. apply andb_prop in H as [H Ka].
  apply andb_prop in H as [H F]. apply andb_prop in H as [H1 H2]. apply Nat.eqb_eq in H1.
  apply enclose_values_correct in S as [S1 S2]. apply enclose_values_correct in M as [M1 M2].
  apply enclose_values_correct in D as [D1 D2].
  split; [split; [exact (enclose_ranges_defined (places c) root R)|split; [exact H1|]]|].
  { split; [exact S1|]. rewrite Forall_forall in *. intros u U.
    split; [apply M1|apply D1]; apply in_map, U. }
  split; [exact (keeps_all_correct w b _ Ka S2)|]. exists root. split; [reflexivity|].
  split; [exact H2|].
  assert (rooted : forall x, in_set (places c) x -> in_box root x).
  { intros x X. eapply enclose_ranges_correct; [exact R|apply X]. }
  assert (held : forall x, in_set (places c) x /\ is_kept w x ->
            held_at c full (leaves_of g root) x (configuration c full g root x)).
  { intros x [X W]. apply (held_in_set c full w g root x H2 F (rooted x X) X W). }
  apply and_comm. split.
  { unfold starts in H3. apply andb_prop in H3 as [H3 H8]. rewrite forallb_forall in H8.
    do 4 (apply andb_prop in H3 as [H3 _]).
    pose proof (subset_boxes_correct b root (the_start c) H3 S2) as X0. split; [exact X0|].
    apply (not_without_tube g root _ X0). intros b' I B. specialize (H8 _ I). simpl in H8.
    rewrite orb_false_r in H8. exact (boxes_apart_correct b' b _ H8 B S2). }
  split; [|split].
  - intros x X. destruct (held x X) as (t & b' & v & _ & B & T & E). rewrite E.
    split; [exact (tube_solution_solves c full t b' v x T B)|].
    apply (regular_in_tube c full t b' v x T B). exact (solution_in_tube c full t b' v x T B).
  - unfold starts in H3. set (n := unknowns c) in *.
    apply andb_prop in H3 as [H3 H8]. apply andb_prop in H3 as [H3 H9].
    apply andb_prop in H3 as [H3 H7].
    apply andb_prop in H3 as [H3 H6]. apply andb_prop in H3 as [H4 H5].
    apply Nat.eqb_eq in H7. unfold holds_near in H6. rewrite forallb_forall in H6, H8.
    unfold is_tested in H5.
    destruct (test_tube (bare c) full around b) as [h|] eqn:W; [|discriminate].
    change (map (value []) (start c)) with (the_start c) in S2. set (x0 := the_start c) in *.
    set (p0 := configuration c full g root x0).
    assert (X0 : in_box root x0) by exact (subset_boxes_correct b root x0 H4 S2).
    (* The configuration at the start is within the radii. *)
    assert (P0 : solves c x0 p0 /\ is_near c p0).
    { destruct (configuration_held c full g root x0 H2 X0) as (t & b' & v & I & B & T & E).
      { apply (not_without_tube g root x0 X0). intros b' I B. specialize (H8 _ I). simpl in H8.
        rewrite orb_false_r in H8. exact (boxes_apart_correct b' b x0 H8 B S2). }
      fold p0 in E. specialize (H8 _ I). simpl in H8. apply orb_prop in H8 as [H8|H8].
      { elim (boxes_apart_correct b' b x0 H8 B S2). }
      unfold is_within in H9. destruct (test_tube c full tight b) as [u|] eqn:U; [|discriminate].
      pose proof (tube_solution_solves c full tight b u x0 U S2) as So.
      rewrite E. rewrite <- (leads_correct c full _ tight t v x0 _ H8
        (meet_boxes_correct b' b x0 B S2) (solution_in_tube c full tight b u x0 U S2) So b' T B).
      split; [exact So|].
      rewrite forallb_forall in H9. apply near_lists. split.
      { unfold tube_solution. rewrite beside_length. symmetry. exact H7. }
      rewrite H7. intros i Ii. specialize (H9 i ltac:(apply in_seq; fold n; lia)).
      destruct (solution_within c full tight b u x0 U S2 i Ii) as (d & De & Q & _).
      assert (A : encloses (form_range (axis_form tight (variables full b) (length b) i))
                    (axis tight x0 i)).
      { apply (form_range_encloses (coordinate b x0)); [apply coordinate_in_unit_box, S2|].
        rewrite (proj1 S2). apply axis_form_encloses, variables_known, S2. }
      pose proof (is_not_positive_correct _ _ H9 (subtract_encloses _ _ _ _
        (add_encloses _ _ _ _ (absolute_encloses _ _ (subtract_encloses _ _ _ _ A (proj2 M2 i))) De)
        (proj2 D2 i))) as Z.
      set (s := nth i (tube_solution c tight u x0) 0) in *.
      match goal with |- Rabs (s - ?y) <= _ =>
        replace (s - y) with ((s - axis tight x0 i) + (axis tight x0 i - y)) by ring end.
      eapply Rle_trans; [apply Rabs_triang|]. lra. }
    (* What is within the radii is in the tube around. *)
    assert (near_in : forall q, solves c x0 q -> is_near c q -> in_tube n around x0 q).
    { intros q Sq Nq. apply near_lists in Nq as [L Nq]. split; [apply Sq|]. intros i Ii.
      specialize (Nq i ltac:(lia)). specialize (H6 i ltac:(apply in_seq; lia)). cbv beta zeta in H6.
      assert (A : encloses (form_range (axis_form around (variables full b) (length b) i))
                    (axis around x0 i)).
      { apply (form_range_encloses (coordinate b x0)); [apply coordinate_in_unit_box, S2|].
        rewrite (proj1 S2). apply axis_form_encloses, variables_known, S2. }
      pose proof (is_not_positive_correct _ _ H6 (subtract_encloses _ _ _ _
        (add_encloses _ _ _ _ (absolute_encloses _ _ (subtract_encloses _ _ _ _ (proj2 M2 i) A))
           (proj2 D2 i)) (point_encloses (number (reach around) i)))) as Z.
      set (y := nth i (map (value []) (map fst (near c))) 0) in *.
      replace (nth i q 0 - axis around x0 i) with ((nth i q 0 - y) + (y - axis around x0 i)) by
        ring.
      eapply Rle_trans; [apply Rabs_triang|]. lra. }
    intros q. split.
    + intros [Sq Nq].
      rewrite (only_solution (bare c) full around b h x0 W S2 q (near_in q Sq Nq) Sq).
      destruct P0 as [S0 N0].
      symmetry. exact (only_solution (bare c) full around b h x0 W S2 p0 (near_in p0 S0 N0) S0).
    + intros ->. exact P0.
  - intros m C I.
    assert (B : forall t, in_box root (m t)) by (intros; apply rooted; apply I).
    assert (Hm : forall t, held_at c full (leaves_of g root) (m t) (configuration c full g root (m
      t)))
      by (intros; apply held, I).
    split; [exact (configuration_continuous c full g root H2 m C B Hm)|].
    intros q Cq Sq t0 E. exact (configuration_unique c full g root H2 m C B Hm q Cq Sq t0 E).
Qed.

(** What is true among more places is true among fewer ones. *)
Lemma is_branch_among_fewer (among fewer : list R -> Prop) c p :
  (forall x, fewer x -> among x) -> is_branch_among among c p -> is_branch_among fewer c p.
Proof.
  intros F (V & S & M). split; [auto|]. split; [exact S|]. intros m C I. apply M; auto.
Qed.

(** ** Hints *)

(** Halves boxes whose tubes do not hold, and widens tubes as far as they do: a wider tube is easier
    to link. Nothing is proved of it. *)
From Coq Require Import PrimFloat.

(** The tube, as wide as it holds, or a narrower one that fits better. *)
Definition widest (c : closure) (full : nat) (t : tube) (b : box) : option tube :=
  let first_that_holds s factors :=
    find (fun u => is_tested c full u b) (map (Fit.widened s) factors)
    in
  match first_that_holds t [8; 3; 1.5; 1]%float with
  | Some s => Some s
  | None => first_that_holds (Fit.fitted c full b t) [1; 0.5; 0.25; 0.125; 0.0625]%float
  end.

Fixpoint refined_leaf (c : closure) (full fuel : nat) (t : tube) (b : box) : tubes :=
  match widest c full t b, fuel with
  | Some s, _ => Held s
  | None, O => Held t
  | None, S fuel' =>
      match largest_of (map (fun i => PrimFloat.sub (I.upper i) (I.lower i)) b) with
      | Some k =>
          let p := I.midpoint (nth k b I.nai) in
          Cut k p (refined_leaf c full fuel' t (lower_part b k p))
            (refined_leaf c full fuel' t (upper_part b k p))
      | None => Held t
      end
  end.

Fixpoint refined_tubes (c : closure) (full fuel : nat) (g : tubes) (b : box) : tubes :=
  match g with
  | Excluded => Excluded
  | NoTube => NoTube
  | Held t => refined_leaf c full fuel t b
  | Cut k p l u => Cut k p (refined_tubes c full fuel l (lower_part b k p))
                     (refined_tubes c full fuel u (upper_part b k p))
  end.

Definition refined (c : closure) (full fuel : nat) (g : tubes) : tubes :=
  match enclose_ranges (ranges (places c)) with
  | Some root => refined_tubes c full fuel g root
  | None => g
  end.

(** Both tubes of the start: what is within the radii; and a smaller one, by Newton's method. *)
Definition around_start (c : closure) (middles radii : box) (m : nat) : tube :=
  let zeros := map (fun _ => zero) (seq 0 m) in
  Tube zeros (map (fun i => I.midpoint i) middles) (map (fun _ => zeros) middles)
    (map (fun i => mul (I.upper i) 0x1.0001p+0) radii)%float.

Definition tight_start (c : closure) (full : nat) (b : box) (t : tube) : tube :=
  match bounds_of (bare c) full t b with
  | Some v =>
      let s := Nat.iter 20 (Fit.newton_step c full (inverse v) b) t in
      Tube (foot s) (axis_at s) (tilt s) (map (fun r => mul r 0x1p-10) (reach s))%float
  | None => t
  end.

(** The check with the tubes of a certificate. *)
Definition check_closure_in (c : closure) (w : parts) (m : method) (g : tubes) : bool :=
  let full := second_order m in
  match enclose_values (start c), enclose_values (map fst (near c)),
        enclose_values (map snd (near c)) with
  | Some b, Some middles, Some radii =>
      let around := around_start c middles radii (length b) in
      check_branch_in c full around (tight_start c full b around) w (refined c full (deepest m) g)
  | _, _, _ => false
  end.

Theorem check_closure_in_correct c w m g : check_closure_in c w m g = true -> one_branch_in c w.
Proof.
  unfold check_closure_in. destruct (enclose_values (start c)); [|discriminate].
  destruct (enclose_values (map fst (near c))); [|discriminate].
  destruct (enclose_values (map snd (near c))); [|discriminate].
  intros H. apply check_branch_holds in H as (G & K & root & _ & _ & B & _).
  split; [exact G|]. split; [exact K|]. exists (configuration c (second_order m)
    (refined c (second_order m) (deepest m) g) root). exact B.
Qed.

(** The whole set is kept. *)
Definition check_closure (c : closure) : method -> tubes -> bool := check_closure_in c Kept.

Theorem check_closure_correct c m g : check_closure c m g = true -> one_branch c.
Proof.
  intros H. apply check_closure_in_correct in H as (G & _ & p & B). split; [exact G|].
  exists p. revert B. apply is_branch_among_fewer. intros x X. exact (conj X Logic.I).
Qed.
