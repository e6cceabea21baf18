(* SPDX-License-Identifier: Apache-2.0 *)
(** Tubes along a way of several pieces. Where a piece ends, the next one begins: the check shows
    that both have the same equations there, and that their tubes hold the same configuration. *)
From Coquelicot Require Import Coquelicot.
From Coq Require Import Reals QArith Qreals Lra Lia List PArith Bool FunctionalExtensionality.
From Coq Require PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Intervals Forms Evaluation Boxes Hints Regularity.
From Regulus Require Import Continuity Existence Derivatives LinearAlgebra Questions Search
  Closures Tubes Parts Branches.
Import ListNotations.
Open Scope R_scope.

(** ** The claim about a paving *)

(** The mechanism of piece k is c, and x is a place of its set in a part that is kept: the parts of
    piece k are number k of a list, the first one being number 0. *)
Definition is_kept_on (way : list closure) (ws : list parts) (x : list R) (k : nat) (c : closure) :
    Prop :=
  is_on way x k c /\ is_kept (nth k ws LeftOut) (on_piece k x).

(** The start, on the first piece, is in a part that is kept. *)
Definition starts_in (way : list closure) (ws : list parts) : Prop :=
  match way with c :: _ => is_kept (nth 0 ws LeftOut) (the_start c) | [] => False end.

(** PAVING of a closure along a way: what NO SINGULARITY says, of the places in the parts that are
    kept. *)
Definition one_branch_along_in (c : list expression -> closure) (pieces : list (list expression))
    (ws : list parts) : Prop :=
  let way := map c pieces in
  is_way way /\ starts_in way ws /\ exists p, is_branch_along_among (is_kept_on way ws) way p.

(** ** Exact numbers: polynomials in pi with rational coefficients *)

Fixpoint number_value (l : list Q) : R :=
  match l with [] => 0 | a :: l' => Q2R a + PI * number_value l' end.

Fixpoint add_numbers (a b : list Q) : list Q :=
  match a, b with
  | [], _ => b
  | _, [] => a
  | x :: a', y :: b' => Qred (x + y) :: add_numbers a' b'
  end.

Definition scale_number (q : Q) (a : list Q) : list Q := map (fun x => Qred (q * x)) a.

Fixpoint multiply_numbers (a b : list Q) : list Q :=
  match a with
  | [] => []
  | x :: a' => add_numbers (scale_number x b) ((0 # 1) :: multiply_numbers a' b)
  end.

Fixpoint exact (names : list (option (list Q))) (e : expression) : option (list Q) :=
  let both f a b := match exact names a, exact names b with
                    | Some x, Some y => f x y | _, _ => None end in
  match e with
  | Constant q => Some [q]
  | Pi => Some [0 # 1; 1 # 1]
  | Name k => nth k names None
  | Negate a => option_map (scale_number (-1 # 1)) (exact names a)
  | Add a b => both (fun x y => Some (add_numbers x y)) a b
  | Subtract a b => both (fun x y => Some (add_numbers x (scale_number (-1 # 1) y))) a b
  | Multiply a b => both (fun x y => Some (multiply_numbers x y)) a b
  | Divide a b => both (fun x y => match y with
      | [q] => if Qeq_bool q 0 then None else Some (scale_number (/ q) x)
      | _ => None end) a b
  | Power a n => option_map (fun x => Nat.iter n (multiply_numbers x) [1 # 1]) (exact names a)
  | _ => None
  end.

Definition are_equal (a b : list Q) : bool :=
  forallb (Qeq_bool 0) (add_numbers a (scale_number (-1 # 1) b)).

Lemma reduced q : Q2R (Qred q) = Q2R q.
Proof. apply Qeq_eqR, Qred_correct. Qed.

Lemma add_numbers_value a : forall b,
  number_value (add_numbers a b) = number_value a + number_value b.
Proof.
  induction a as [|x a IH]; intros [|y b]; cbn [number_value add_numbers]; try ring.
  rewrite IH, reduced, Q2R_plus. ring.
Qed.

Lemma scale_number_value q a : number_value (scale_number q a) = Q2R q * number_value a.
Proof.
  induction a as [|x a IH]; cbn [number_value scale_number map]; [ring|].
  change (map (fun x => Qred (q * x)) a) with (scale_number q a). rewrite IH, reduced, Q2R_mult.
  ring.
Qed.

Lemma multiply_numbers_value a b :
  number_value (multiply_numbers a b) = number_value a * number_value b.
Proof.
  induction a as [|x a IH]; cbn [number_value multiply_numbers]; [ring|].
  rewrite add_numbers_value, scale_number_value. cbn [number_value]. rewrite IH.
  replace (Q2R (0 # 1)) with 0 by (unfold Q2R; simpl; ring). ring.
Qed.

Lemma are_equal_correct a b : are_equal a b = true -> number_value a = number_value b.
Proof.
  unfold are_equal. intros H. apply Rminus_diag_uniq.
  replace (number_value a - number_value b)
    with (number_value (add_numbers a (scale_number (-1 # 1) b))).
  2: { rewrite add_numbers_value, scale_number_value. unfold Q2R. simpl. field. }
  rewrite forallb_forall in H.
  induction (add_numbers a (scale_number (-1 # 1) b)) as [|q l IH]; [reflexivity|]. simpl.
  rewrite IH by (intros x X; apply H; right; exact X).
  pose proof (Qeq_eqR _ _ (Qeq_bool_eq _ _ (H q (or_introl eq_refl)))) as E. rewrite <- E.
  unfold Q2R. simpl. ring.
Qed.

Definition known_exactly (names : list (option (list Q))) (x : list R) : Prop :=
  forall k a, nth k names None = Some a -> nth k x 0 = number_value a.

Lemma exact_correct names x : known_exactly names x ->
  forall e a, exact names e = Some a -> value x e = number_value a.
Proof.
  intros K. assert (minus : Q2R (-1 # 1) = -1) by (unfold Q2R; simpl; field).
  induction e; simpl; intros r H; try discriminate.
  - injection H as <-. simpl. ring.
  - injection H as <-. simpl. unfold Q2R. simpl. field.
  - apply K, H.
  - destruct (exact names e) as [a|]; [|discriminate]. injection H as <-.
    rewrite (IHe a eq_refl), scale_number_value, minus. ring.
  - destruct (exact names e1) as [a|]; [|discriminate].
    destruct (exact names e2) as [b|]; [|discriminate]. injection H as <-.
    rewrite (IHe1 a eq_refl), (IHe2 b eq_refl), add_numbers_value. ring.
  - destruct (exact names e1) as [a|]; [|discriminate].
    destruct (exact names e2) as [b|]; [|discriminate]. injection H as <-.
    rewrite (IHe1 a eq_refl), (IHe2 b eq_refl), add_numbers_value, scale_number_value, minus. ring.
  - destruct (exact names e1) as [a|]; [|discriminate].
    destruct (exact names e2) as [b|]; [|discriminate]. injection H as <-.
    rewrite (IHe1 a eq_refl), (IHe2 b eq_refl), multiply_numbers_value. ring.
  - destruct (exact names e1) as [a|]; [|discriminate].
    destruct (exact names e2) as [[|q [|]]|]; try discriminate.
    destruct (Qeq_bool q 0) eqn:Z; [discriminate|]. injection H as <-.
    apply Qeq_bool_neq in Z.
    rewrite (IHe1 a eq_refl), (IHe2 _ eq_refl), scale_number_value, Q2R_inv by exact Z.
    simpl. rewrite Rmult_0_r, Rplus_0_r. unfold Rdiv. ring.
  - destruct (exact names e) as [a|]; [|discriminate]. injection H as <-.
    rewrite (IHe a eq_refl). clear. induction n as [|n IH]; simpl.
    + unfold Q2R. simpl. field.
    + rewrite multiply_numbers_value, <- IH. ring.
Qed.

(** ** Names that have the same value in two lists *)

Definition expression_eq_dec (a b : expression) : {a = b} + {a <> b}.
Proof.
  decide equality; try apply Nat.eq_dec.
  decide equality; [apply Pos.eq_dec|apply Z.eq_dec].
Defined.

Definition range_eq_dec (a b : expression * expression) : {a = b} + {a <> b}.
Proof. decide equality; apply expression_eq_dec. Defined.

Definition is {A} {a b : A} (e : {a = b} + {a <> b}) : bool := if e then true else false.

Lemma is_correct A (a b : A) (e : {a = b} + {a <> b}) : is e = true -> a = b.
Proof. destruct e; [auto|discriminate]. Qed.

Fixpoint uses_only (same : list bool) (e : expression) : bool :=
  match e with
  | Constant _ | Pi => true
  | Name k => nth k same false
  | Negate a | Power a _ | Sqrt a | Sin a | Cos a | Atan a | Exp a | Log a | Abs a =>
      uses_only same a
  | Add a b | Subtract a b | Multiply a b | Divide a b => uses_only same a && uses_only same b
  end.

Definition agree (same : list bool) (x y : list R) : Prop :=
  length x = length same /\ length y = length same /\
  forall k, nth k same false = true -> nth k x 0 = nth k y 0.

Lemma uses_only_correct same x y : agree same x y ->
  forall e, uses_only same e = true -> value x e = value y e.
Proof.
  intros (_ & _ & A). induction e; simpl; intros H;
    try (apply andb_prop in H as [H1 H2]; rewrite IHe1, IHe2 by assumption);
    try rewrite IHe by assumption; try reflexivity. apply A, H.
Qed.

Lemma agree_append same x y b v w : agree same x y -> (b = true -> v = w) ->
  agree (same ++ [b]) (x ++ [v]) (y ++ [w]).
Proof.
  intros (L & M & A) E. split; [|split]; [rewrite !app_size, L; reflexivity|
    rewrite !app_size, M; reflexivity|].
  intros k H. destruct (Nat.lt_trichotomy k (length same)) as [K|[K|K]].
  - rewrite app_nth1 in H by exact K. rewrite !app_nth1 by lia. apply A, H.
  - subst k. rewrite app_nth2, Nat.sub_diag in H by lia.
    rewrite (app_nth2 x), (app_nth2 y), L, M, Nat.sub_diag by lia. exact (E H).
  - rewrite nth_overflow in H; [discriminate|]. rewrite app_size. simpl. lia.
Qed.

Definition is_same (same : list bool) (l r : list (option (list Q))) (d e : expression) : bool :=
  (is (expression_eq_dec d e) && uses_only same d)
  || match exact l d, exact r e with Some a, Some b => are_equal a b | _, _ => false end.

(** Which names are the same after these definitions. *)
Fixpoint same_after (same : list bool) (l r : list (option (list Q))) (ds es : list expression) :
    option (list bool) :=
  match ds, es with
  | [], [] => Some same
  | d :: ds', e :: es' =>
      same_after (same ++ [is_same same l r d e]) (l ++ [exact l d]) (r ++ [exact r e]) ds' es'
  | _, _ => None
  end.

Lemma known_exactly_append names x e : length names = length x -> known_exactly names x ->
  known_exactly (names ++ [exact names e]) (x ++ [value x e]).
Proof.
  intros L K k a H. destruct (Nat.lt_trichotomy k (length names)) as [I|[I|I]].
  - rewrite app_nth1 in H by exact I. rewrite app_nth1 by lia. exact (K k a H).
  - subst k. rewrite app_nth2, Nat.sub_diag in H by lia. rewrite app_nth2, L, Nat.sub_diag by lia.
    exact (exact_correct names x K e a H).
  - rewrite nth_overflow in H; [discriminate|]. rewrite app_size. simpl. lia.
Qed.

Lemma same_after_correct ds : forall es same l r x y after,
  same_after same l r ds es = Some after -> agree same x y ->
  length l = length x -> length r = length y -> known_exactly l x -> known_exactly r y ->
  agree after (extend x ds) (extend y es).
Proof.
  induction ds as [|d ds IH]; intros [|e es] same l r x y after H A L M K J; try discriminate.
  - injection H as <-. exact A.
  - simpl in H |- *. eapply IH; [exact H|..].
    + apply agree_append; [exact A|]. intros S. apply orb_prop in S as [S|S].
      * apply andb_prop in S as [S1 S2]. apply is_correct in S1 as <-.
        exact (uses_only_correct same x y A d S2).
      * destruct (exact l d) as [a|] eqn:D; [|discriminate].
        destruct (exact r e) as [b|] eqn:E; [|discriminate].
        rewrite (exact_correct l x K d a D), (exact_correct r y J e b E).
        apply are_equal_correct, S.
    + rewrite !app_size, L. reflexivity.
    + rewrite !app_size, M. reflexivity.
    + apply known_exactly_append; assumption.
    + apply known_exactly_append; assumption.
Qed.

(** ** The end of a piece and the begin of the next one *)

Definition nothing_exact (same : list bool) : list (option (list Q)) := map (fun _ => None) same.

Lemma nothing_known_exactly same x : known_exactly (nothing_exact same) x.
Proof.
  unfold nothing_exact. intros k a H. exfalso. revert k H.
  induction same as [|b same IH]; intros [|k] H; try discriminate. exact (IH k H).
Qed.

Definition joins (c d : closure) : bool :=
  let others := repeat true (length (tl (ranges (places c)))) in
  is (list_eq_dec range_eq_dec (tl (ranges (places c))) (tl (ranges (places d))))
  && Nat.eqb (unknowns c) (unknowns d)
  && is (list_eq_dec expression_eq_dec (equations c) (equations d))
  && match same_after (false :: others) (Some [1 # 1] :: nothing_exact others)
             (Some [0 # 1] :: nothing_exact others)
             (definitions (places c)) (definitions (places d)) with
     | Some base =>
         let all := base ++ repeat true (unknowns c) in
         match same_after all (nothing_exact all) (nothing_exact all) (further c) (further d) with
         | Some names => forallb (uses_only names) (equations c)
         | None => false
         end
     | None => false
     end.

Lemma agree_refl n p : length p = n -> agree (repeat true n) p p.
Proof. intros L. unfold agree. rewrite repeat_length. auto. Qed.

Lemma agree_app s t x y u v : agree s x y -> agree t u v -> agree (s ++ t) (x ++ u) (y ++ v).
Proof.
  intros (L & M & A) (L' & M' & A').
  split; [rewrite !app_size; congruence|]. split; [rewrite !app_size; congruence|].
  intros k H. destruct (Nat.lt_ge_cases k (length s)) as [K|K].
  - rewrite app_nth1 in H by exact K. rewrite !app_nth1 by lia. apply A, H.
  - rewrite app_nth2 in H by exact K. rewrite !app_nth2 by lia. rewrite L, M. apply A', H.
Qed.

Lemma known_exactly_cons a x l y : x = number_value a -> known_exactly l y ->
  known_exactly (Some a :: l) (x :: y).
Proof. intros E K [|k] b H; [injection H as <-; exact E|exact (K k b H)]. Qed.

Lemma joins_correct c d : ranges (places c) <> [] -> joins c d = true -> are_joined c d.
Proof.
  unfold joins. intros N H. apply andb_prop in H as [H D]. apply andb_prop in H as [H E].
  apply andb_prop in H as [R U]. apply is_correct in R, E. apply Nat.eqb_eq in U.
  split; [exact U|]. split; [exact R|]. intros y p L.
  set (others := repeat true (length (tl (ranges (places c))))) in *.
  assert (Lo : length others = length y).
  { unfold others. rewrite repeat_length. destruct (ranges (places c)); [contradiction|].
    simpl in L |- *. lia. }
  destruct (same_after (false :: others) _ _ (definitions (places c)) (definitions (places d)))
    as [base|] eqn:B; [|discriminate].
  assert (A : agree (false :: others) (1 :: y) (0 :: y)).
  { split; [simpl; lia|]. split; [simpl; lia|]. intros [|k] K; [discriminate|reflexivity]. }
  apply (same_after_correct _ _ _ _ _ (1 :: y) (0 :: y)) in B; [|exact A|..].
  2, 3: simpl; unfold nothing_exact; rewrite map_size; lia.
  2, 3: apply known_exactly_cons; [simpl; unfold Q2R; simpl; field|apply nothing_known_exactly].
  set (all := base ++ repeat true (unknowns c)) in *.
  destruct (same_after all _ _ (further c) (further d)) as [names|] eqn:F; [|discriminate].
  assert (same : length p = unknowns c -> forall i, equation_at c (1 :: y) p i
                                                 = equation_at d (0 :: y) p i).
  { intros Lp i. pose proof (agree_app _ _ _ _ _ _ B (agree_refl _ p Lp)) as A2. fold all in A2.
    apply (same_after_correct _ _ _ _ _
      (extend (1 :: y) (definitions (places c)) ++ p)
      (extend (0 :: y) (definitions (places d)) ++ p)) in F; [|exact A2|..].
    2, 3: unfold nothing_exact; rewrite map_size; symmetry; apply A2.
    2, 3: apply nothing_known_exactly.
    unfold equation_at, names_at. rewrite <- E. apply (uses_only_correct names _ _ F).
    destruct (nth_in_or_default i (equations c) no_entry) as [I| ->]; [|reflexivity].
    rewrite forallb_forall in D. apply D, I. }
  unfold solves. rewrite <- U. split; intros [Lp S]; (split; [exact Lp|]); intros i I;
    specialize (S i I); [rewrite <- same|rewrite same]; assumption.
Qed.

(** ** The tubes where two pieces meet *)

Definition joint_box (e : interval) (a b : box) : box := e :: meet_boxes (tl a) (tl b).

(** A leaf of c and one of d. *)
Definition linked_at_joint (c d : closure) (full : nat) (x y : leaf) : bool :=
  match fst x, fst y with
  | Some s, Some t =>
      if is_positive (nth 0 (snd y) I.nai) || boxes_apart (tl (snd x)) (tl (snd y)) then true
      else
        let e := joint_box one (snd x) (snd y) in
        let b := joint_box zero (snd x) (snd y) in
        if leads_to c full e b s t then true else if leads_to d full b e t s then true
        else existsb (fun u => leads c full e u s
          && leads_to c full e b u t) (Fit.narrow c full e s)
  | _, _ => true
  end.

Definition linked_joint (c d : closure) (full : nat) (ends begins : list leaf) : bool :=
  forallb (fun x => if is_negative (subtract (nth 0 (snd x) I.nai) one) then true
                    else forallb (linked_at_joint c d full x) begins) ends.

Lemma in_box_cons i b u x : encloses i u -> in_box b x -> in_box (i :: b) (u :: x).
Proof. intros E [L B]. split; [simpl; f_equal; exact L|]. intros [|k]; [exact E|apply B]. Qed.

Lemma in_box_tail b u x : in_box b (u :: x) -> in_box (tl b) x.
Proof.
  intros [L B]. destruct b as [|i b]; [discriminate|]. split; [simpl in L |- *; lia|].
  intros k. exact (B (S k)).
Qed.

Lemma same_coordinates b y : coordinate (one :: b) (1 :: y) = coordinate (zero :: b) (0 :: y).
Proof.
  apply functional_extensionality. intros k. unfold coordinate.
  destruct (number_of k) as [|j]; [|reflexivity]. simpl.
  replace (varies one) with false by (symmetry; vm_compute; reflexivity).
  replace (varies zero) with false by (symmetry; vm_compute; reflexivity). reflexivity.
Qed.

Lemma linked_joint_correct c d full ends begins s a v t b w y :
  are_joined c d -> linked_joint c d full ends begins = true ->
  S (length y) = length (ranges (places c)) ->
  In (Some s, a) ends -> In (Some t, b) begins ->
  test_tube c full s a = Some v -> test_tube d full t b = Some w ->
  in_box a (1 :: y) -> in_box b (0 :: y) ->
  tube_solution c s v (1 :: y) = tube_solution d t w (0 :: y).
Proof.
  intros (U & _ & J) H L Ia Ib T W A B. unfold linked_joint in H. rewrite forallb_forall in H.
  specialize (H _ Ia). cbn [snd] in H. apply orb_prop in H as [H|H].
  { pose proof (is_negative_correct _ _ H (subtract_encloses _ _ _ _ (proj2 A 0%nat)
      (integer_encloses 1))) as Z. simpl in Z. lra. }
  rewrite forallb_forall in H. specialize (H _ Ib). unfold linked_at_joint in H. cbn [fst snd] in H.
  apply orb_prop in H as [H|H].
  { apply orb_prop in H as [H|H].
    - pose proof (is_positive_correct _ _ H (proj2 B 0%nat)) as Z. simpl in Z. lra.
    - elim (boxes_apart_correct _ _ y H (in_box_tail _ _ _ A) (in_box_tail _ _ _ B)). }
  pose proof (meet_boxes_correct _ _ y (in_box_tail _ _ _ A) (in_box_tail _ _ _ B)) as M.
  pose proof (in_box_cons one _ 1 y (integer_encloses 1) M) as E1.
  pose proof (in_box_cons zero _ 0 y (integer_encloses 0) M) as E0.
  pose proof (tube_solution_solves c full s a v _ T A) as S1.
  pose proof (tube_solution_solves d full t b w _ W B) as S0.
  assert (in_t : forall p, in_tube (unknowns c) t (0 :: y) p -> solves c (1 :: y) p ->
            p = tube_solution d t w (0 :: y)).
  { intros p P Sp. rewrite U in P. apply (only_solution d full t b w _ W B _ P), J; assumption. }
  apply orb_prop in H as [H|H].
  { exact (in_t _ (leads_to_correct c full _ _ s t _ _ _ H E1 E0 (same_coordinates _ y)
      (solution_in_tube c full s a v _ T A) S1) S1). }
  apply orb_prop in H as [H|H].
  - symmetry.
    pose proof (leads_to_correct d full _ _ t s _ _ _ H E0 E1 (eq_sym (same_coordinates _ y))
      (solution_in_tube d full t b w _ W B) S0) as Q. rewrite <- U in Q.
    apply (only_solution c full s a v _ T A _ Q). apply J; assumption.
  - apply existsb_exists in H as (u & _ & H). apply andb_prop in H as [H1 H2].
    pose proof H1 as Z. unfold leads, leads_to in Z.
    destruct (test_tube c full u _) as [z|] eqn:Tu; [clear Z|discriminate].
    pose proof (solution_in_tube c full u _ z _ Tu E1) as P.
    pose proof (tube_solution_solves c full u _ z _ Tu E1) as Q.
    rewrite <- (leads_correct c full _ u s v _ _ H1 E1 P Q a T A).
    exact (in_t _ (leads_to_correct c full _ _ u t _ _ _ H2 E1 E0 (same_coordinates _ y) P Q) Q).
Qed.

(** ** All pieces *)

(** A piece: its mechanism, the parts that are kept, its tubes, and the box of its ranges. *)
Record stretch := Stretch { mechanism : closure; kept : parts; tree : tubes; root : box }.

Definition leaves_on (s : stretch) : list leaf := leaves_of (tree s) (root s).

Fixpoint stretches (full fuel : nat) (cs : list closure) (ws : list parts) (gs : list tubes) :
    option (list stretch) :=
  match cs, ws, gs with
  | [], [], [] => Some []
  | c :: cs', w :: ws', g :: gs' =>
      match enclose_ranges (ranges (places c)), stretches full fuel cs' ws' gs' with
      | Some b, Some l => Some (Stretch c w (refined_tubes c full fuel g b) b :: l)
      | _, _ => None
      end
  | _, _, _ => None
  end.

Definition is_zero_to_one (c : closure) : bool :=
  match ranges (places c) with
  | (Constant a, Constant b) :: _ => Qeq_bool a 0 && Qeq_bool b 1
  | _ => false
  end.

(** Each piece has the ranges of the other variables and the number of unknowns of the first one. *)
Definition is_checked (full : nat) (others : list (expression * expression)) (n : nat)
    (s : stretch) : bool :=
  let c := mechanism s in
  is_zero_to_one c && is (list_eq_dec range_eq_dec (tl (ranges (places c))) others)
  && Nat.eqb (unknowns c) n && Nat.eqb (length (equations c)) (unknowns c)
  && check_tubes c full (tree s) (root s) && has_tubes_in (kept s) (tree s) (root s).

Fixpoint are_linked (full : nat) (l : list stretch) : bool :=
  match l with
  | s :: ((t :: _) as later) =>
      joins (mechanism s) (mechanism t)
      && linked_joint (mechanism s) (mechanism t) full (leaves_on s) (leaves_on t)
      && are_linked full later
  | _ => true
  end.

Definition starts_on_first (c : closure) : bool :=
  match start c with
  | e :: _ => match exact [] e with Some [q] => Qle_bool 0 q && Qle_bool q 1 | _ => false end
  | [] => false
  end.

Definition check_stretches (full : nat) (l : list stretch) : bool :=
  match l with
  | [] => false
  | s :: _ =>
      let c := mechanism s in
      match enclose_values (start c), enclose_values (map fst (near c)),
            enclose_values (map snd (near c)) with
      | Some b, Some middles, Some radii =>
          let around := around_start c middles radii (length b) in
          check_branch_in c full around (tight_start c full b around) (kept s) (tree s)
          && starts_on_first c
          && forallb (is_checked full (tl (ranges (places c))) (unknowns c)) l
          && are_linked full l
      | _, _, _ => false
      end
  end.

Definition is_unit (x : list R) : Prop := match x with u :: _ => 0 <= u <= 1 | [] => False end.

Definition is_unit_dec (x : list R) : {is_unit x} + {~ is_unit x}.
Proof.
  unfold is_unit. destruct x as [|u x]; [right; tauto|].
  destruct (Rle_dec 0 u); [|right; tauto]. destruct (Rle_dec u 1); [left|right]; tauto.
Defined.

(** The configuration at place x of the way, whose first piece here is piece k. *)
Fixpoint along (full k : nat) (l : list stretch) (x : list R) : list R :=
  match l with
  | [] => []
  | s :: later =>
      let y := on_piece k x in
      match is_unit_dec y, is_without_tube_at (tree s) y with
      | left _, false => configuration (mechanism s) full (tree s) (root s) y
      | _, _ => along full (S k) later x
      end
  end.

Lemma enclose_ranges_length r : forall b, enclose_ranges r = Some b -> length b = length r.
Proof.
  induction r as [|a r IH]; intros b E; simpl in E; [injection E as <-; reflexivity|].
  destruct (enclose_range a); [|discriminate]. destruct (enclose_ranges r); [|discriminate].
  injection E as <-. simpl. f_equal. apply IH. reflexivity.
Qed.

Lemma in_range_length x r : Forall2 in_range x r -> length x = length r.
Proof. induction 1; simpl; congruence. Qed.

Lemma next_linked full l : are_linked full l = true -> forall k s t,
  nth_error l k = Some s -> nth_error l (S k) = Some t ->
  joins (mechanism s) (mechanism t) = true /\
  linked_joint (mechanism s) (mechanism t) full (leaves_on s) (leaves_on t) = true.
Proof.
  induction l as [|a l IH]; intros H k s t S T; [destruct k; discriminate|].
  destruct l as [|b l]; [destruct k as [|[|]]; discriminate|].
  simpl in H. apply andb_prop in H as [H H3]. apply andb_prop in H as [H1 H2].
  destruct k as [|k].
  - injection S as <-. injection T as <-. auto.
  - exact (IH H3 k s t S T).
Qed.

Definition are_enclosed (l : list stretch) : Prop :=
  forall s, In s l -> enclose_ranges (ranges (places (mechanism s))) = Some (root s).

Section Pieces.
  Variables (full : nat) (l : list stretch) (others : list (expression * expression)) (n : nat).
  Hypothesis enclosed : are_enclosed l.
  Hypothesis checked : forallb (is_checked full others n) l = true.
  Hypothesis linked : are_linked full l = true.

  Record is_piece (s : stretch) : Prop := {
    from_0_to_1 : goes_from_0_to_1 (mechanism s);
    has_others : tl (ranges (places (mechanism s))) = others;
    has_unknowns : unknowns (mechanism s) = n;
    has_equations : length (equations (mechanism s)) = unknowns (mechanism s);
    are_tubes : check_tubes (mechanism s) full (tree s) (root s) = true;
    has_tubes : has_tubes_in (kept s) (tree s) (root s) = true;
    has_root : enclose_ranges (ranges (places (mechanism s))) = Some (root s) }.

  Lemma are_pieces s : In s l -> is_piece s.
  Proof.
    intros I. rewrite forallb_forall in checked. pose proof (checked s I) as H.
    pose proof (enclosed s I) as E.
    unfold is_checked in H. apply andb_prop in H as [H H6]. apply andb_prop in H as [H H5].
    apply andb_prop in H as [H H4].
    apply andb_prop in H as [H H3]. apply andb_prop in H as [H1 H2].
    apply is_correct in H2. apply Nat.eqb_eq in H3, H4.
    split; try assumption. unfold is_zero_to_one, goes_from_0_to_1 in *.
    destruct (ranges (places (mechanism s))) as [|[a b] r]; [discriminate|].
    destruct a; try discriminate. destruct b; try discriminate.
    apply andb_prop in H1 as [A B]. apply Qeq_bool_eq, Qeq_eqR in A, B.
    simpl. rewrite A, B. unfold Q2R. simpl. split; field.
  Qed.

  Lemma has_ranges s : is_piece s -> ranges (places (mechanism s)) <> [].
  Proof.
    intros P N. pose proof (from_0_to_1 s P) as Z. unfold goes_from_0_to_1 in Z.
    rewrite N in Z. exact Z.
  Qed.

  Lemma root_length s : is_piece s -> length (root s) = S (length others).
  Proof.
    intros P. rewrite (enclose_ranges_length _ _ (has_root s P)), <- (has_others s P).
    pose proof (has_ranges s P). destruct (ranges (places (mechanism s))); [contradiction|].
    reflexivity.
  Qed.

  (** The ranges of a piece. *)
  Lemma in_ranges s u y : is_piece s ->
    Forall2 in_range (u :: y) (ranges (places (mechanism s))) <->
    0 <= u <= 1 /\ Forall2 in_range y others.
  Proof.
    intros P. pose proof (from_0_to_1 s P) as Z. pose proof (has_others s P) as O.
    unfold goes_from_0_to_1 in Z. destruct (ranges (places (mechanism s))) as [|[a b] r]; [tauto|].
    simpl in O. subst r. destruct Z as [A B]. split.
    - intros F. inversion F; subst. unfold in_range in *. simpl in *. rewrite A, B in *. auto.
    - intros [U F]. constructor; [|exact F]. unfold in_range. simpl. rewrite A, B. exact U.
  Qed.

  Definition held_on (k : nat) (s : stretch) (x p : list R) : Prop :=
    nth_error l k = Some s /\ is_unit (on_piece k x) /\
    held_at (mechanism s) full (leaves_on s) (on_piece k x) p.

  Lemma held_agree_next k s t x p q : held_on k s x p -> held_on (S k) t x q -> p = q.
  Proof.
    intros (S1 & U1 & H1) (S2 & U2 & H2).
    pose proof (are_pieces s (nth_error_In _ _ S1)) as P1.
    pose proof (are_pieces t (nth_error_In _ _ S2)) as P2.
    destruct H1 as (s1 & a & v & A1 & A2 & A3 & ->).
    destruct H2 as (t1 & b & w & B1 & B2 & B3 & ->).
    destruct (next_linked full l linked k s t S1 S2) as [J K].
    destruct x as [|u y]; [contradiction|]. unfold on_piece in *. rewrite S_INR in *.
    unfold is_unit in U1, U2.
    assert (V : u - INR k = 1) by lra. assert (W : u - (INR k + 1) = 0) by lra.
    rewrite V in *. rewrite W in *.
    apply (linked_joint_correct _ _ full (leaves_on s) (leaves_on t) s1 a v t1 b w y);
      try assumption.
    - apply joins_correct; [exact (has_ranges s P1)|exact J].
    - rewrite <- (enclose_ranges_length _ _ (has_root s P1)).
      rewrite <- (leaves_length _ _ _ _ A1). symmetry. apply A2.
  Qed.

  Lemma held_agree j k s t x p q : held_on j s x p -> held_on k t x q -> p = q.
  Proof.
    intros H1 H2. destruct x as [|u y]; [destruct H1 as (_ & [] & _)|].
    pose proof H1 as (S1 & U1 & L1). pose proof H2 as (S2 & U2 & L2). simpl in U1, U2.
    assert (order : forall j k, 0 <= u - INR j <= 1 -> 0 <= u - INR k <= 1 -> (j < k)%nat ->
              k = S j).
    { clear. intros j k U V L. assert (K : INR k <= INR (S j)) by (rewrite S_INR; lra).
      apply INR_le in K. lia. }
    destruct (Nat.lt_trichotomy j k) as [L|[E|L]].
    - rewrite (order j k U1 U2 L) in H2. exact (held_agree_next j s t _ p q H1 H2).
    - subst k. rewrite S1 in S2. injection S2 as <-.
      pose proof (are_pieces s (nth_error_In _ _ S1)) as P.
      exact (leaves_agree _ full (tree s) (root s) _ p q (are_tubes s P) L1 L2).
    - rewrite (order k j U2 U1 L) in H1. symmetry.
      exact (held_agree_next k t s _ q p H2 H1).
  Qed.

  (** ** The configuration at each place *)

  Definition way : list closure := map mechanism l.
  Definition on (x : list R) (k : nat) (c : closure) : Prop := is_kept_on way (map kept l) x k c.

  Lemma piece_of x k c : on x k c -> exists s, nth_error l k = Some s /\ mechanism s = c /\
    in_set (places (mechanism s)) (on_piece k x) /\ is_kept (kept s) (on_piece k x).
  Proof.
    intros [[E S] W]. unfold way in E. rewrite nth_error_map in E.
    destruct (nth_error l k) as [s|] eqn:T; [|discriminate]. injection E as <-.
    rewrite (nth_error_nth (map kept l) k LeftOut (x := kept s)) in W
      by (rewrite nth_error_map, T; reflexivity).
    exists s. auto.
  Qed.

  Lemma along_held x k s : nth_error l k = Some s ->
    in_set (places (mechanism s)) (on_piece k x) -> is_kept (kept s) (on_piece k x) ->
    exists j t, held_on j t x (along full 0 l x).
  Proof.
    intros E S Q0. pose proof (are_pieces s (nth_error_In _ _ E)) as P.
    destruct x as [|u y]; [destruct S as [F _]; simpl in F; pose proof (has_ranges s P);
      inversion F; congruence|].
    assert (R : forall j t, nth_error l j = Some t -> is_unit (on_piece j (u :: y)) ->
              in_box (root t) (on_piece j (u :: y))).
    { intros j t T U. pose proof (are_pieces t (nth_error_In _ _ T)) as Pt.
      apply (enclose_ranges_correct _ _ _ (has_root t Pt)). apply (in_ranges t _ y Pt).
      split; [exact U|]. apply (in_ranges s (u - INR k) y P), S. }
    assert (U : is_unit (on_piece k (u :: y))).
    { apply (in_ranges s (u - INR k) y P), S. }
    destruct (held_in_set _ full (kept s) (tree s) (root s) _ (are_tubes s P) (has_tubes s P)
      (R k s E U) S Q0) as [N _].
    assert (find : forall later i, (forall j t, nth_error later j = Some t ->
                nth_error l (i + j) = Some t) ->
              forall j, nth_error later j = Some s -> (i + j)%nat = k ->
              exists j t, held_on j t (u :: y) (along full i later (u :: y))).
    { induction later as [|t later IH]; intros i M j J Q; [destruct j; discriminate|].
      cbn [along]. pose proof (M O t eq_refl) as T. rewrite Nat.add_0_r in T.
      assert (next : (exists j', j = Datatypes.S j') ->
                exists j t, held_on j t (u :: y) (along full (Datatypes.S i) later (u :: y))).
      { intros [j' ->]. apply (IH (Datatypes.S i)) with (j := j'); [|exact J|lia].
        intros h w W. specialize (M (Datatypes.S h) w W).
        rewrite <- M. f_equal. lia. }
      destruct (is_unit_dec (on_piece i (u :: y))) as [V|V].
      - destruct (is_without_tube_at (tree t) (on_piece i (u :: y))) eqn:X.
        + apply next. destruct j as [|j]; [|eauto]. injection J as ->.
          rewrite Nat.add_0_r in Q. subst i. congruence.
        + exists i, t. split; [exact T|]. split; [exact V|].
          pose proof (are_pieces t (nth_error_In _ _ T)) as Pt.
          exact (configuration_held _ full (tree t) (root t) _ (are_tubes t Pt) (R i t T V) X).
      - apply next. destruct j as [|j]; [|eauto]. rewrite Nat.add_0_r in Q. subst i.
        contradiction. }
    apply (find l O (fun j t H => H) k E). reflexivity.
  Qed.

  (** On each piece it is in the tube of a leaf of this piece; f is true of it, if it is over the
      parts of w. *)
  Lemma along_in_part f w x k s : nth_error l k = Some s ->
    in_set (places (mechanism s)) (on_piece k x) -> is_kept (kept s) (on_piece k x) ->
    holds_in f w (tree s) (root s) = true -> is_kept w (on_piece k x) -> exists t b v,
      In (Some t, b) (leaves_on s) /\ in_box b (on_piece k x) /\ is_unit (on_piece k x) /\
      test_tube (mechanism s) full t b = Some v /\
      along full 0 l x = tube_solution (mechanism s) t v (on_piece k x) /\ f t b = true.
  Proof.
    intros T S W F G. pose proof (are_pieces s (nth_error_In _ _ T)) as P.
    assert (U : is_unit (on_piece k x)).
    { destruct S as [R _]. pose proof (has_ranges s P).
      destruct x as [|u y]; [simpl in R; inversion R; congruence|].
      apply (in_ranges s (u - INR k) y P), R. }
    assert (B : in_box (root s) (on_piece k x)).
    { apply (enclose_ranges_correct _ _ _ (has_root s P)), S. }
    destruct (held_in_part _ full f (tree s) w (root s) _ (are_tubes s P) F B S G)
      as (_ & t & b & v & I & B1 & V & X & Y).
    destruct (along_held x k s T S W) as (j & t1 & A).
    assert (H : held_on k s x (configuration (mechanism s) full (tree s) (root s) (on_piece k x))).
    { split; [exact T|]. split; [exact U|]. exists t, b, v. auto. }
    exists t, b, v. rewrite (held_agree j k t1 s x _ _ A H). auto 6.
  Qed.

  Lemma along_on_piece x k c : on x k c -> exists s t b v,
    nth_error l k = Some s /\ mechanism s = c /\ In (Some t, b) (leaves_on s) /\
    in_box b (on_piece k x) /\ is_unit (on_piece k x) /\ test_tube c full t b = Some v /\
    along full 0 l x = tube_solution c t v (on_piece k x).
  Proof.
    intros O. apply piece_of in O as (s & T & <- & S & W).
    pose proof (are_pieces s (nth_error_In _ _ T)) as P.
    destruct (along_in_part _ (kept s) x k s T S W (has_tubes s P) W)
      as (t & b & v & I & B & U & V & X & _).
    exists s, t, b, v. auto 8.
  Qed.

  (** ** Motions *)

  Definition way_chart := (nat * stretch * held_leaf)%type.

  Fixpoint way_charts (k : nat) (later : list stretch) : list way_chart :=
    match later with
    | [] => []
    | s :: rest => map (fun a => (k, s, a)) (held_leaves (mechanism s) full (leaves_on s))
                   ++ way_charts (S k) rest
    end.

  Lemma in_way_charts later : forall i k s t b v, In (k, s, (t, b, v)) (way_charts i later) <->
    exists j, k = (i + j)%nat /\ nth_error later j = Some s /\
      In (Some t, b) (leaves_on s) /\ test_tube (mechanism s) full t b = Some v.
  Proof.
    induction later as [|a later IH]; intros i k s t b v.
    - split; [intros []|]. intros (j & _ & N & _). destruct j; discriminate.
    - simpl. rewrite in_app_iff, IH, in_map_iff. split.
      + intros [(x & [= <- <- ->] & I)|(j & -> & N & R)].
        * exists O. rewrite Nat.add_0_r. apply in_held_leaves in I. auto.
        * exists (S j). split; [lia|]. auto.
      + intros ([|j] & -> & N & R).
        * left. injection N as <-. exists (t, b, v). rewrite Nat.add_0_r.
          split; [reflexivity|]. apply in_held_leaves, R.
        * right. exists j. split; [lia|]. auto.
  Qed.

  Variable m : R -> list R.
  Hypothesis C : continuous_motion m.
  Hypothesis goes : forall t, exists k c, on (m t) k c.

  Lemma motion_length t : length (m t) = S (length others).
  Proof.
    destruct (goes t) as (k & c & O). apply piece_of in O as (s & T & _ & [F _] & _).
    pose proof (are_pieces s (nth_error_In _ _ T)) as P. apply in_range_length in F.
    rewrite <- (enclose_ranges_length _ _ (has_root s P)), (root_length s P) in F.
    destruct (m t); simpl in *; lia.
  Qed.

  Lemma motion_on_piece k : continuous_motion (fun t => on_piece k (m t)).
  Proof.
    intros [|j] s.
    - apply (continuity_pt_ext (fun t => nth 0 (m t) 0 - INR k)).
      + intros t. pose proof (motion_length t). destruct (m t); [discriminate|reflexivity].
      + apply (continuity_pt_minus (fun t => nth 0 (m t) 0)); [apply C|apply continuous_constant].
    - apply (continuity_pt_ext (fun t => nth (S j) (m t) 0)); [|apply C].
      intros t. destruct (m t); reflexivity.
  Qed.

  Lemma stays_off k s : ~ is_unit (on_piece k (m s)) ->
    locally s (fun r => ~ is_unit (on_piece k (m r))).
  Proof.
    intros N. pose proof (motion_on_piece k O s) as K. rewrite continuity_pt_locally in K.
    assert (first : forall t, is_unit (on_piece k (m t)) <->
              0 <= nth 0 (on_piece k (m t)) 0 <= 1).
    { intros t. pose proof (motion_length t). destruct (m t); [discriminate|]. reflexivity. }
    rewrite first in N. set (f := nth 0 (on_piece k (m s)) 0) in *.
    assert (O : f < 0 \/ 1 < f) by lra. destruct O as [O|O].
    - assert (P : 0 < - f) by lra. generalize (K (mkposreal _ P)). apply filter_imp. simpl.
      intros r X Y. apply first in Y. apply Rabs_lt_between in X. lra.
    - assert (P : 0 < f - 1) by lra. generalize (K (mkposreal _ P)). apply filter_imp. simpl.
      intros r X Y. apply first in Y. apply Rabs_lt_between in X. lra.
  Qed.

  Let within (a : way_chart) (r : R) : Prop :=
    let '(k, s, (t, b, v)) := a in in_box b (on_piece k (m r)) /\ is_unit (on_piece k (m r)).
  Let chart (a : way_chart) (r : R) : list R :=
    let '(k, s, (t, b, v)) := a in tube_solution (mechanism s) t v (on_piece k (m r)).
  Let p (r : R) : list R := along full 0 l (m r).

  Lemma way_agrees a r : In a (way_charts 0 l) -> within a r -> p r = chart a r.
  Proof.
    destruct a as [[k s] [[t b] v]]. intros I [B U].
    apply in_way_charts in I as (j & -> & N & I & T). simpl in B, U |- *.
    destruct (goes r) as (i & c & O). apply piece_of in O as (w & W & _ & S & K).
    destruct (along_held (m r) i w W S K) as (h & z & H).
    apply (held_agree h j z s (m r) _ _ H). split; [exact N|]. split; [exact U|].
    exists t, b, v. auto.
  Qed.

  Lemma way_covered (q : R -> list R) :
    (forall t k c, on (m t) k c -> solves c (on_piece k (m t)) (q t)) ->
    forall r, exists a, In a (way_charts 0 l) /\ within a r /\
      (let '(k, s, _) := a in solves (mechanism s) (on_piece k (m r)) (q r)).
  Proof.
    intros Sq r. destruct (goes r) as (k & c & O).
    destruct (along_on_piece (m r) k c O) as (s & t & b & v & N & <- & I & B & U & T & _).
    exists (k, s, (t, b, v)). split; [|split; [split; assumption|exact (Sq r k _ O)]].
    apply in_way_charts. exists k. auto.
  Qed.

  Lemma along_solves t k c : on (m t) k c -> solves c (on_piece k (m t)) (p t).
  Proof.
    intros O. destruct (along_on_piece (m t) k c O) as (s & u & b & v & _ & _ & _ & B & _ & T & E).
    unfold p. rewrite E. exact (tube_solution_solves c full u b v _ T B).
  Qed.

  Lemma solution_length (q : R -> list R) :
    (forall t k c, on (m t) k c -> solves c (on_piece k (m t)) (q t)) ->
    forall t, length (q t) = n.
  Proof.
    intros Sq t. destruct (goes t) as (k & c & O). rewrite (proj1 (Sq t k c O)).
    apply piece_of in O as (s & T & <- & _).
    exact (has_unknowns s (are_pieces s (nth_error_In _ _ T))).
  Qed.

  Lemma leaf_length k s t b : nth_error l k = Some s -> In (Some t, b) (leaves_on s) ->
    forall r, length (on_piece k (m r)) = length b.
  Proof.
    intros N I r. pose proof (are_pieces s (nth_error_In _ _ N)) as P.
    rewrite (leaves_length _ _ _ _ I), (root_length s P), <- (motion_length r).
    destruct (m r); reflexivity.
  Qed.

  Lemma way_chart_continuous a s : In a (way_charts 0 l) -> forall eps : posreal,
    locally s (fun r => within a r ->
      forall i, (i < n)%nat -> Rabs (nth i (chart a r) 0 - nth i (p s) 0) < eps).
  Proof.
    intros I eps. pose proof (way_agrees a s I) as G. destruct a as [[k w] [[t b] v]].
    apply in_way_charts in I as (j & -> & N & I & T). simpl in G |- *.
    destruct (is_unit_dec (on_piece j (m s))) as [U|U].
    2: { generalize (stays_off j s U). apply filter_imp. intros r X [_ Y]. contradiction. }
    generalize (leaf_continuous (mechanism w) full t b v T (fun r => on_piece j (m r)) s
      (fun i => motion_on_piece j i s) (leaf_length j w t b N I) (p s) (fun B => G (conj B U)) eps).
    apply filter_imp. intros r X [B _].
    rewrite (has_unknowns w (are_pieces w (nth_error_In _ _ N))) in X. exact (X B).
  Qed.

  Theorem way_continuous : continuous_motion p.
  Proof.
    apply (charts_continuous _ (way_charts 0 l) n within
      (fun a r => let '(k, s, _) := a in solves (mechanism s) (on_piece k (m r)) (p r)) chart).
    - apply way_covered, along_solves.
    - exact way_agrees.
    - apply solution_length, along_solves.
    - exact way_chart_continuous.
  Qed.

  Theorem way_unique q : continuous_motion q ->
    (forall t k c, on (m t) k c -> solves c (on_piece k (m t)) (q t)) ->
    forall s, q s = p s -> forall t, q t = p t.
  Proof.
    intros Cq Sq.
    apply (charts_unique _ (way_charts 0 l) n within
      (fun a r => let '(k, s, _) := a in solves (mechanism s) (on_piece k (m r)) (q r)) chart).
    - apply way_covered, Sq.
    - exact way_agrees.
    - apply solution_length, along_solves.
    - exact way_chart_continuous.
    - exact Cq.
    - apply solution_length, Sq.
    - intros a s I E. pose proof (way_agrees a s I) as G. destruct a as [[k w] [[t b] v]].
      apply in_way_charts in I as (j & -> & N & I & T). simpl in G |- *.
      destruct (is_unit_dec (on_piece j (m s))) as [U|U].
      2: { generalize (stays_off j s U). apply filter_imp. intros r X [_ Y]. contradiction. }
      generalize (leaf_unique (mechanism w) full t b v T (fun r => on_piece j (m r)) s
        (fun i => motion_on_piece j i s) (leaf_length j w t b N I) q (fun i => Cq i s)
        (fun B => eq_trans E (G (conj B U)))).
      apply filter_imp. intros r X [B _] Sr. exact (X B Sr).
  Qed.
End Pieces.

(** ** The whole check *)

Lemma stretches_correct full fuel cs : forall ws gs l, stretches full fuel cs ws gs = Some l ->
  map mechanism l = cs /\ map kept l = ws /\ are_enclosed l.
Proof.
  induction cs as [|c cs IH]; intros [|w ws] [|g gs] l H; simpl in H; try discriminate.
  - injection H as <-. split; [reflexivity|]. split; [reflexivity|intros s []].
  - destruct (enclose_ranges (ranges (places c))) as [b|] eqn:E; [|discriminate].
    destruct (stretches full fuel cs ws gs) as [r|] eqn:R; [|discriminate]. injection H as <-.
    destruct (IH ws gs r R) as (M & K & F). split; [simpl; f_equal; exact M|].
    split; [simpl; f_equal; exact K|]. intros s [<-|I]; [exact E|exact (F s I)].
Qed.

Lemma are_linked_joined full others n l : Forall (is_piece full others n) l ->
  are_linked full l = true -> all_joined (map mechanism l).
Proof.
  induction l as [|s l IH]; intros P H; [exact Logic.I|].
  destruct l as [|t l]; [exact Logic.I|]. inversion P as [|? ? P1 P2]. subst.
  simpl in H. apply andb_prop in H as [H H3]. apply andb_prop in H as [H1 H2].
  split; [|exact (IH P2 H3)]. apply joins_correct; [|exact H1].
  exact (has_ranges full others n s P1).
Qed.

Theorem check_stretches_correct full l :
  are_enclosed l -> check_stretches full l = true ->
  is_way (map mechanism l) /\ starts_in (map mechanism l) (map kept l) /\
  is_branch_along_among (is_kept_on (map mechanism l) (map kept l)) (map mechanism l)
    (along full 0 l) /\
  exists others n, forallb (is_checked full others n) l = true /\ are_linked full l = true.
Proof.
  intros E H. destruct l as [|s later]; [discriminate|]. unfold check_stretches in H.
  set (c := mechanism s) in *. set (l := s :: later) in *.
  destruct (enclose_values (start c)) as [b|]; [|discriminate].
  destruct (enclose_values (map fst (near c))) as [middles|]; [|discriminate].
  destruct (enclose_values (map snd (near c))) as [radii|]; [|discriminate].
  apply andb_prop in H as [H L]. apply andb_prop in H as [H K]. apply andb_prop in H as [B O].
  set (others := tl (ranges (places c))) in *. set (n := unknowns c) in *.
  assert (P : forall w, In w l -> is_piece full others n w)
    by exact (are_pieces full l others n E K).
  apply check_branch_holds in B as (G & W & b0 & R & _ & (_ & Q & _) & X0 & N0).
  assert (Rs : enclose_ranges (ranges (places c)) = Some (root s))
    by (apply E; left; reflexivity).
  rewrite Rs in R. injection R as <-.
  split; [|split; [|split; [|exists others, n; auto]]].
  - split; [apply G|]. split.
    + apply Forall_forall. intros d D. apply in_map_iff in D as (w & <- & I).
      pose proof (P w I) as Pw. split; [|split].
      * exact (enclose_ranges_defined _ _ (has_root _ _ _ w Pw)).
      * exact (has_equations _ _ _ w Pw).
      * exact (from_0_to_1 _ _ _ w Pw).
    + apply (are_linked_joined full others n); [apply Forall_forall; exact P|exact L].
  - exact W.
  - split; [|split].
    + intros x k d D. cbv zeta.
      destruct (along_on_piece full l others n E K L x k d D)
        as (w & t & a & v & _ & _ & _ & A & _ & T & ->).
      split; [exact (tube_solution_solves d full t a v _ T A)|].
      apply (regular_in_tube d full t a v _ T A). exact (solution_in_tube d full t a v _ T A).
    + change (forall q, solves c (the_start c) q /\ is_near c q <->
                q = along full 0 l (the_start c)).
      replace (along full 0 l (the_start c))
        with (configuration c full (tree s) (root s) (the_start c)); [exact Q|].
      unfold l. cbn [along]. unfold starts_on_first in O.
      assert (Z : is_unit (the_start c)).
      { unfold the_start. destruct (start c) as [|e r]; [discriminate|].
        destruct (exact [] e) as [[|q [|]]|] eqn:X; try discriminate.
        apply exact_correct with (x := []) in X; [|intros k a N; destruct k; discriminate].
        apply andb_prop in O as [O1 O2]. apply Qle_bool_iff, Qle_Rle in O1, O2. simpl in X |- *.
        rewrite X, Rmult_0_r, Rplus_0_r.
        replace (Q2R 0) with 0 in O1 by (unfold Q2R; simpl; field).
        replace (Q2R 1) with 1 in O2 by (unfold Q2R; simpl; field). split; assumption. }
      assert (Y : on_piece 0 (the_start c) = the_start c).
      { destruct (the_start c) as [|u y]; [contradiction|]. simpl. f_equal. ring. }
      rewrite Y, N0. destruct (is_unit_dec (the_start c)); [reflexivity|contradiction].
    + intros m C I. split; [exact (way_continuous full l others n E K L m C I)|].
      intros q Cq Sq t0 T0. exact (way_unique full l others n E K L m C I q Cq Sq t0 T0).
Qed.

Lemma is_branch_along_same (on same : list R -> nat -> closure -> Prop) way p :
  (forall x k c, on x k c <-> same x k c) ->
  is_branch_along_among on way p -> is_branch_along_among same way p.
Proof.
  intros F (V & S & M). split; [intros x k c O; apply V, F, O|]. split; [exact S|]. intros m C I.
  destruct (M m C) as [Cp U].
  { intros t. destruct (I t) as (k & c & O). exists k, c. apply F, O. }
  split; [exact Cp|]. intros q Cq Sq. apply U; [exact Cq|]. intros t k c O. apply Sq, F, O.
Qed.

(** The check with the tubes of a certificate, a tree for each piece. *)
Definition check_closure_along_in (c : list expression -> closure)
    (pieces : list (list expression)) (ws : list parts) (m : method) (gs : list tubes) : bool :=
  match stretches (second_order m) (deepest m) (map c pieces) ws gs with
  | Some l => check_stretches (second_order m) l
  | None => false
  end.

Theorem check_closure_along_in_correct c pieces ws m gs :
  check_closure_along_in c pieces ws m gs = true -> one_branch_along_in c pieces ws.
Proof.
  unfold check_closure_along_in.
  destruct (stretches (second_order m) (deepest m) (map c pieces) ws gs) as [l|] eqn:L;
    [|discriminate].
  apply stretches_correct in L as (M & K & E). intros H.
  apply (check_stretches_correct _ _ E) in H as (W & S & B & _). rewrite M, K in *.
  split; [exact W|]. split; [exact S|]. eexists. exact B.
Qed.

(** The whole way is kept. *)
Definition all_kept (pieces : list (list expression)) : list parts := map (fun _ => Kept) pieces.

Definition check_closure_along (c : list expression -> closure)
    (pieces : list (list expression)) : method -> list tubes -> bool :=
  check_closure_along_in c pieces (all_kept pieces).

Lemma on_all_kept (c : list expression -> closure) pieces x k d :
  is_on (map c pieces) x k d <-> is_kept_on (map c pieces) (all_kept pieces) x k d.
Proof.
  split; [|intros [O _]; exact O]. intros O. split; [exact O|]. destruct O as [E _].
  rewrite nth_error_map in E. destruct (nth_error pieces k) as [piece|] eqn:T; [|discriminate].
  rewrite (nth_error_nth (all_kept pieces) k LeftOut (x := Kept)); [exact Logic.I|].
  unfold all_kept. rewrite nth_error_map, T. reflexivity.
Qed.

Lemma branch_of_all_kept (c : list expression -> closure) pieces p :
  is_branch_along_among (is_kept_on (map c pieces) (all_kept pieces)) (map c pieces) p ->
  is_branch_along (map c pieces) p.
Proof.
  apply is_branch_along_same. intros x k d. symmetry. apply on_all_kept.
Qed.

Theorem check_closure_along_correct c pieces m gs :
  check_closure_along c pieces m gs = true -> one_branch_along c pieces.
Proof.
  intros H. apply check_closure_along_in_correct in H as (W & _ & p & B).
  split; [exact W|]. exists p. exact (branch_of_all_kept c pieces p B).
Qed.
