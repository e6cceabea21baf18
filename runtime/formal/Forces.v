(* SPDX-License-Identifier: Apache-2.0 *)
(** The largest force of a row, as a question of regularity. Let M be the matrix and v the load.
    Row p of M is replaced by m_p - r v. Where this matrix is regular for each r in a range, no
    force F of row p has r F = 1 with r in the range. *)
From Coq Require Import Reals QArith Lra Lia List Arith Bool.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Questions LinearAlgebra Determinants Intervals Evaluation.
From Regulus Require Import Boxes Regularity Search Singularity Threshold.
Import ListNotations.
Open Scope R_scope.

(** ** The question *)

(** The expression with one more name before the others. *)
Fixpoint shift (e : expression) : expression :=
  match e with
  | Constant q => Constant q
  | Pi => Pi
  | Name k => Name (S k)
  | Negate a => Negate (shift a)
  | Add a b => Add (shift a) (shift b)
  | Subtract a b => Subtract (shift a) (shift b)
  | Multiply a b => Multiply (shift a) (shift b)
  | Divide a b => Divide (shift a) (shift b)
  | Power a n => Power (shift a) n
  | Sqrt a => Sqrt (shift a)
  | Sin a => Sin (shift a)
  | Cos a => Cos (shift a)
  | Atan a => Atan (shift a)
  | Exp a => Exp (shift a)
  | Log a => Log (shift a)
  | Abs a => Abs (shift a)
  end.

(** m - r v, where r is name 0. *)
Definition border (mv : expression * expression) : expression :=
  Subtract (shift (fst mv)) (Multiply (Name O) (shift (snd mv))).

Definition bordered_rows (p : nat) (load : list expression) (m : list (list expression)) :=
  map (map shift) (firstn p m) ++
  map border (combine (nth p m []) load) :: map (map shift) (skipn (S p) m).

(** The question about the replaced matrix. The first variable is r. *)
Definition bordered (q : question) (p : nat) (load : list expression)
    (ends : expression * expression) : question :=
  Question (ends :: ranges q) (map shift (definitions q)) (map shift (constraints q))
    (map shift (also_defined q)) (bordered_rows p load (matrix q)) (columns q).

Definition bordered_method (m : method) : method := Method (S (second_order m)) (deepest m).

Definition reciprocal (limit : expression) : expression := Divide (Constant (1 # 1)) limit.
Definition range_within (limit : expression) := (Negate (reciprocal limit), reciprocal limit).
Definition range_below (limit : expression) := (no_entry, reciprocal limit).

Definition is_force_known (q : question) (p : nat) (load : list expression) (limit : expression) :=
  Nat.eqb (rows q) (columns q) && Nat.ltb p (columns q) && Nat.eqb (length load) (columns q) &&
  Nat.eqb (length (nth p (matrix q) [])) (columns q) &&
  match evaluate [] limit with Some l => is_positive (range l) | None => false end.

Definition check_force (ends : expression -> expression * expression) (q : question) (p : nat)
    (load : list expression) (limit : expression) (m : method) : bool :=
  is_force_known q p load limit && check (bordered q p load (ends limit)) (bordered_method m).

Definition check_force_tree (ends : expression -> expression * expression) (q : question) (p : nat)
    (load : list expression) (limit : expression) (m : method) (t : tree) : bool :=
  is_force_known q p load limit &&
  check_tree (bordered q p load (ends limit)) (bordered_method m) t.

(** ** One more name *)

Lemma value_shift r names e : value (r :: names) (shift e) = value names e.
Proof. induction e; simpl; congruence. Qed.

Lemma defined_shift r names e : defined (r :: names) (shift e) <-> defined names e.
Proof. induction e; simpl; rewrite ?value_shift; try tauto. lia. Qed.

Lemma extend_shift r l : forall x, extend (r :: x) (map shift l) = r :: extend x l.
Proof.
  induction l as [|d l IH]; intros x; [reflexivity|]. simpl. rewrite value_shift.
  exact (IH (x ++ [value x d])).
Qed.

Lemma all_defined_shift r l : forall x, all_defined (r :: x) (map shift l) -> all_defined x l.
Proof.
  induction l as [|d l IH]; intros x; [trivial|]. simpl. rewrite value_shift, defined_shift.
  intros [D A]. split; [exact D|]. exact (IH (x ++ [value x d]) A).
Qed.

Lemma all_defined_list r names l : Forall (defined (r :: names)) (map shift l) ->
  Forall (defined names) l.
Proof.
  rewrite !Forall_forall. intros H e E. apply (defined_shift r), H, in_map, E.
Qed.

(** ** Fewer equations than unknowns have a solution that is not 0 *)

Lemma sum_skip n : forall p f, (p < S n)%nat -> sum (S n) f = f p + sum n (fun k => f (skip p k)).
Proof.
  induction n as [|n IH]; intros p f P.
  - replace p with O by lia. simpl. ring.
  - destruct (Nat.eq_dec p (S n)) as [->|D].
    + change (sum (S (S n)) f) with (sum (S n) f + f (S n)). rewrite Rplus_comm. f_equal.
      apply sum_ext. intros k K. unfold skip. destruct (Nat.ltb_spec k (S n)); [reflexivity|lia].
    + change (sum (S (S n)) f) with (sum (S n) f + f (S n)). rewrite (IH p) by lia.
      change (sum (S n) (fun k => f (skip p k)))
        with (sum n (fun k => f (skip p k)) + f (skip p n)).
      unfold skip at 3. destruct (Nat.ltb_spec n p); [lia|]. ring.
Qed.

(** The vector y with c before its element p. *)
Definition insert (p : nat) (c : R) (y : nat -> R) (j : nat) : R :=
  if Nat.eqb j p then c else if j <? p then y j else y (pred j).

Lemma insert_skip p c y k : insert p c y (skip p k) = y k.
Proof.
  unfold insert, skip. destruct (Nat.ltb_spec k p) as [H|H].
  - rewrite (proj2 (Nat.eqb_neq k p)), (proj2 (Nat.ltb_lt k p)) by lia. reflexivity.
  - rewrite (proj2 (Nat.eqb_neq (S k) p)), (proj2 (Nat.ltb_ge (S k) p)) by lia. reflexivity.
Qed.

Lemma sum_insert n p c y a : (p < S n)%nat ->
  sum (S n) (fun j => a j * insert p c y j) = a p * c + sum n (fun k => a (skip p k) * y k).
Proof.
  intros P. rewrite (sum_skip n p) by exact P. f_equal.
  - unfold insert. rewrite Nat.eqb_refl. reflexivity.
  - apply sum_ext. intros k _. rewrite insert_skip. reflexivity.
Qed.

(** A vector of the kernel beside a pivot, with a coordinate for the pivot. *)
Lemma kernel_beside_pivot m n p a y : (p < S n)%nat -> a O p <> 0 ->
  (forall i, (i < m)%nat -> sum n (fun k => complement p a i k * y k) = 0) ->
  (exists j, (j < n)%nat /\ y j <> 0) ->
  exists x, (forall i, (i < S m)%nat -> sum (S n) (fun j => a i j * x j) = 0) /\
            exists j, (j < S n)%nat /\ x j <> 0.
Proof.
  intros P N E (j & J & Y).
  set (c := - sum n (fun k => a O (skip p k) / a O p * y k)). exists (insert p c y). split.
  - intros i I. rewrite sum_insert by exact P. destruct i as [|i].
    + unfold c. rewrite (sum_ext n (fun k => a O (skip p k) * y k)
        (fun k => a O p * (a O (skip p k) / a O p * y k))) by (intros; field; exact N).
      rewrite sum_scale. ring.
    + assert (F := E i ltac:(lia)). unfold complement in F.
      rewrite (sum_ext n _ (fun k => a (S i) (skip p k) * y k +
        (- a (S i) p) * (a O (skip p k) / a O p * y k))) in F by (intros; ring).
      rewrite sum_plus, sum_scale in F. unfold c. lra.
  - exists (skip p j). rewrite insert_skip. split; [|exact Y]. unfold skip.
    destruct (j <? p)%nat; lia.
Qed.

Lemma underdetermined m : forall n a, (m < n)%nat ->
  exists y, (forall i, (i < m)%nat -> sum n (fun j => a i j * y j) = 0) /\
            exists j, (j < n)%nat /\ y j <> 0.
Proof.
  induction m as [|m IH]; intros n a L.
  { exists (fun _ => 1). split; [lia|]. exists O. split; [exact L|lra]. }
  destruct n as [|n]; [lia|]. destruct (some_nonzero (S n) (a O)) as [Z|[p [P N]]].
  - destruct (IH (S n) (fun i => a (S i))) as (y & E & Y); [lia|]. exists y. split; [|exact Y].
    intros [|i] I; [|apply (E i); lia]. apply sum_zero. intros j J. rewrite Z by exact J. ring.
  - destruct (IH n (complement p a)) as (y & E & j & J & Y); [lia|].
    exact (kernel_beside_pivot m n p a y P N E (ex_intro _ j (conj J Y))).
Qed.

(** A row that is a combination of the others: the matrix is singular. *)
Lemma dependent_row n p b z : (p < S n)%nat ->
  (forall j, (j < S n)%nat -> b p j = sum n (fun k => z k * b (skip p k) j)) ->
  ~ full_column_rank (S n) (S n) b.
Proof.
  intros P D R. destruct (underdetermined n (S n) (fun k => b (skip p k))) as (y & E & j & J & Y);
    [lia|].
  apply Y, (R y); [|exact J]. intros i I.
  destruct (Nat.eq_dec i p) as [->|N].
  - rewrite (sum_ext _ _ (fun j => sum n (fun k => z k * b (skip p k) j) * y j))
      by (intros k K; rewrite D by exact K; reflexivity).
    rewrite (sum_product n (S n) z (fun k => b (skip p k)) y).
    apply sum_zero. intros k K. rewrite E by exact K. ring.
  - assert (S : exists k, i = skip p k /\ (k < n)%nat).
    { destruct (Nat.lt_ge_cases i p) as [H|H].
      - exists i. unfold skip. rewrite (proj2 (Nat.ltb_lt i p)) by exact H.
        split; [reflexivity|lia].
      - exists (pred i). unfold skip. rewrite (proj2 (Nat.ltb_ge (pred i) p)) by lia. split; lia. }
    destruct S as (k & -> & K). exact (E k K).
Qed.

(** ** Forces *)

Theorem bordered_matrix_regular n p m v r s F : (p < n)%nat -> s p <> 0 ->
  in_balance n m s F (fun j => s p * v j) ->
  full_column_rank n n (fun i j => if Nat.eqb i p then m p j - r * v j else m i j) ->
  r * F p <> 1.
Proof.
  intros P S B R E. destruct n as [|n]; [lia|].
  refine (dependent_row n p _ (fun k => - (r / s p) * (s (skip p k) * F (skip p k))) P _ R).
  intros j J. rewrite Nat.eqb_refl. specialize (B j J). rewrite (sum_skip n p) in B by exact P.
  rewrite (sum_ext n _ (fun k => - (r / s p) * (m (skip p k) j * (s (skip p k) * F (skip p k))))).
  - rewrite sum_scale.
    replace (sum n (fun k => m (skip p k) j * (s (skip p k) * F (skip p k))))
      with (s p * v j - m p j * (s p * F p)) by lra.
    replace (m p j) with (m p j * (r * F p)) at 1 by (rewrite E; ring). field. exact S.
  - intros k _. assert (N : skip p k <> p) by (unfold skip; destruct (Nat.ltb_spec k p); lia).
    apply Nat.eqb_neq in N. rewrite N. ring.
Qed.

Section Bordered.
  Variables (q : question) (p : nat) (load : list expression) (ends : expression * expression).
  Hypothesis Square : rows q = columns q.
  Hypothesis P : (p < columns q)%nat.
  Hypothesis L : length load = columns q.
  Hypothesis W : length (nth p (matrix q) []) = columns q.
  Let b := bordered q p load ends.

  Lemma split_matrix :
    matrix q = firstn p (matrix q) ++ nth p (matrix q) [] :: skipn (S p) (matrix q).
  Proof.
    assert (H : (p < length (matrix q))%nat) by (unfold rows in Square; rewrite Square; exact P).
    revert H. generalize (matrix q). clear. induction p as [|k IH]; intros [|r l] H; simpl in *;
      try lia; [reflexivity|]. f_equal. apply IH. lia.
  Qed.

  Lemma length_before : length (map (map shift) (firstn p (matrix q))) = p.
  Proof. rewrite map_size, firstn_size. unfold rows in Square. lia. Qed.

  Lemma bordered_square : rows b = columns b.
  Proof.
    change (length (bordered_rows p load (matrix q)) = columns q). rewrite <- Square.
    unfold rows. rewrite split_matrix at 2. unfold bordered_rows.
    rewrite !app_size. simpl. rewrite !map_size. reflexivity.
  Qed.

  Lemma bordered_row i : nth i (bordered_rows p load (matrix q)) [] =
    if Nat.eqb i p then map border (combine (nth p (matrix q) []) load)
    else map shift (nth i (matrix q) []).
  Proof.
    unfold bordered_rows. destruct (Nat.lt_trichotomy i p) as [C|[->|C]].
    - rewrite app_nth1 by (rewrite length_before; exact C).
      rewrite (proj2 (Nat.eqb_neq i p)) by lia.
      change (@nil expression) with (map shift []) at 1. rewrite map_nth. f_equal.
      rewrite split_matrix at 2. rewrite app_nth1; [reflexivity|].
      rewrite <- (map_size (map shift)), length_before. exact C.
    - rewrite app_nth2 by (rewrite length_before; lia).
      rewrite length_before, Nat.sub_diag, Nat.eqb_refl. reflexivity.
    - rewrite app_nth2 by (rewrite length_before; lia). rewrite length_before.
      rewrite (proj2 (Nat.eqb_neq i p)) by lia. destruct (i - p)%nat as [|k] eqn:K; [lia|].
      simpl. change (@nil expression) with (map shift []) at 1. rewrite map_nth. f_equal.
      rewrite split_matrix at 2. rewrite app_nth2; rewrite firstn_size; unfold rows in Square;
        [|lia].
      replace (i - Nat.min p (length (matrix q)))%nat with (S k) by lia. reflexivity.
  Qed.

  Lemma nth_border j l v names r : length l = length v ->
    value (r :: names) (nth j (map border (combine l v)) no_entry) =
    value names (nth j l no_entry) - r * value names (nth j v no_entry).
  Proof.
    revert j v. induction l as [|e l IH]; intros j [|f v] H; try discriminate.
    - destruct j; simpl; unfold Q2R; simpl; ring.
    - destruct j as [|j]; simpl; [rewrite !value_shift; reflexivity|]. apply IH. simpl in H. lia.
  Qed.

  Lemma bordered_entry r names i j : entry b (r :: names) i j =
    if Nat.eqb i p then entry q names p j - r * value names (nth j load no_entry)
    else entry q names i j.
  Proof.
    unfold entry. change (matrix b) with (bordered_rows p load (matrix q)). rewrite bordered_row.
    destruct (Nat.eqb i p).
    - apply nth_border. congruence.
    - change no_entry with (shift no_entry) at 1. rewrite map_nth. apply value_shift.
  Qed.

  Lemma bordered_set r x : in_range r ends -> in_set q x -> in_set b (r :: x).
  Proof.
    intros I [A C]. split; [constructor; assumption|]. intros c M. simpl in M.
    apply in_map_iff in M as (e & <- & M). change (definitions b) with (map shift (definitions q)).
    cbn zeta. rewrite extend_shift, defined_shift, value_shift. exact (C e M).
  Qed.

  Lemma defined_border l v names r : length l = length v ->
    Forall (defined (r :: names)) (map border (combine l v)) ->
    Forall (defined names) l /\ Forall (defined names) v.
  Proof.
    revert v. induction l as [|e l IH]; intros [|f v] H D; try discriminate; [split; constructor|].
    simpl in D. inversion D as [|? ? D1 D2]; subst. destruct D1 as (D1 & _ & D3).
    apply defined_shift in D1, D3. destruct (IH v ltac:(simpl in H; lia) D2).
    split; constructor; assumption.
  Qed.

  Lemma bordered_defined r x : model_defined b (r :: x) ->
    model_defined q x /\ Forall (defined (extend x (definitions q))) load.
  Proof.
    intros (A & B & C). change (definitions b) with (map shift (definitions q)) in *.
    rewrite extend_shift in B, C. apply all_defined_shift in A. apply all_defined_list in B.
    change (matrix b) with (bordered_rows p load (matrix q)) in C. unfold bordered_rows in C.
    apply Forall_app in C as [C1 C2]. inversion C2 as [|? ? C3 C4]; subst.
    apply defined_border in C3 as [C5 C6]; [|congruence]. split; [|exact C6].
    assert (S : forall l,
      Forall (Forall (defined (r :: extend x (definitions q)))) (map (map shift) l) ->
                  Forall (Forall (defined (extend x (definitions q)))) l).
    { intros l H. rewrite Forall_forall in *. intros e E.
      apply (all_defined_list r), H, in_map, E. }
    split; [exact A|]. split; [exact B|]. rewrite split_matrix. apply Forall_app.
    split; [exact (S _ C1)|]. constructor; [exact C5|exact (S _ C4)].
  Qed.

  Theorem forces_of_bordered (bound : R -> Prop) : in_range 0 ends ->
    (forall f, (forall r, in_range r ends -> r * f <> 1) -> bound f) ->
    no_singularity b -> force_satisfies bound q p load.
  Proof.
    intros Z B [D N]. assert (Ends : ends_defined q) by (inversion D; assumption).
    do 3 (split; [assumption|]). split; [exact Ends|]. repeat split; cbn zeta.
    - apply (bordered_defined 0), N, bordered_set; assumption.
    - apply (bordered_defined 0), N, bordered_set; assumption.
    - apply (bordered_defined 0), N, bordered_set; assumption.
    - apply (bordered_defined 0), N, bordered_set; assumption.
    - destruct (N (0 :: x)) as [_ K]; [apply bordered_set; assumption|].
      rewrite bordered_square in K. change (definitions b) with (map shift (definitions q)) in K.
      rewrite extend_shift in K. rewrite Square. intros y Y. apply K. intros i I.
      etransitivity; [|exact (Y i I)]. apply sum_ext. intros j _. rewrite bordered_entry.
      destruct (Nat.eqb_spec i p) as [->|]; ring.
    - intros s F S E. apply B. intros r I. destruct (N (r :: x)) as [_ K]; [apply bordered_set;
        assumption|].
      rewrite bordered_square in K. change (definitions b) with (map shift (definitions q)) in K.
      rewrite extend_shift in K.
      refine (bordered_matrix_regular (columns q) p _ _ r s F P S E _).
      intros y Y. apply K. intros i I'. etransitivity; [|exact (Y i I')]. apply sum_ext. intros j _.
      rewrite bordered_entry. reflexivity.
  Qed.
End Bordered.

(** ** The checks are correct *)

Lemma is_force_known_correct q p load limit : is_force_known q p load limit = true ->
  (rows q = columns q /\ (p < columns q)%nat /\ length load = columns q /\
   length (nth p (matrix q) []) = columns q) /\ defined [] limit /\ 0 < value [] limit.
Proof.
  unfold is_force_known. intros H. apply andb_prop in H as [H V].
  repeat match goal with H : _ && _ = true |- _ => apply andb_prop in H as [H ?] end.
  destruct (evaluate [] limit) as [l|] eqn:E; [|discriminate].
  destruct (threshold_known _ _ E) as [D G]. pose proof (is_positive_correct _ _ V G).
  repeat split; try assumption; try (apply Nat.eqb_eq; assumption). apply Nat.ltb_lt. assumption.
Qed.

Lemma value_reciprocal limit : value [] (reciprocal limit) = / value [] limit.
Proof. unfold reciprocal, Rdiv. simpl. unfold Q2R, Rdiv. simpl. rewrite Rinv_1. ring. Qed.

Lemma below_of_reciprocals l f : 0 < l -> (forall r, 0 <= r <= / l -> r * f <> 1) -> f < l.
Proof.
  intros L H. destruct (Rlt_dec f l) as [|N]; [assumption|]. exfalso. apply (H (/ f)).
  - split; [left; apply Rinv_0_lt_compat; lra|]. apply Rinv_le_contravar; lra.
  - apply Rinv_l. lra.
Qed.

Lemma within_of_reciprocals l f : 0 < l -> (forall r, - / l <= r <= / l -> r * f <> 1) ->
  Rabs f < l.
Proof.
  intros L H. pose proof (Rinv_0_lt_compat l L). apply Rabs_def1.
  - apply below_of_reciprocals; [exact L|]. intros r I. apply H. lra.
  - enough (- f < l) by lra. apply below_of_reciprocals; [exact L|]. intros r I E.
    apply (H (- r)); [lra|]. lra.
Qed.

Lemma within_correct q p load limit : is_force_known q p load limit = true ->
  no_singularity (bordered q p load (range_within limit)) -> force_within q p load limit.
Proof.
  intros K N. apply is_force_known_correct in K as ((A & B & C & D) & E & G).
  assert (H : forall r,
    in_range r (range_within limit) <-> - / value [] limit <= r <= / value [] limit).
  { intros r. unfold in_range, range_within. cbn [fst snd]. rewrite <- value_reciprocal.
    reflexivity. }
  split; [exact E|]. apply (forces_of_bordered q p load (range_within limit)); try assumption.
  - apply H. pose proof (Rinv_0_lt_compat _ G). lra.
  - intros f F. apply within_of_reciprocals; [exact G|]. intros r I. apply F, H, I.
Qed.

Lemma below_correct q p load limit : is_force_known q p load limit = true ->
  no_singularity (bordered q p load (range_below limit)) -> force_below q p load limit.
Proof.
  intros K N. apply is_force_known_correct in K as ((A & B & C & D) & E & G).
  assert (H : forall r, in_range r (range_below limit) <-> 0 <= r <= / value [] limit).
  { intros r. unfold in_range, range_below. cbn [fst snd]. rewrite <- value_reciprocal.
    replace (value [] no_entry) with 0 by (simpl; unfold Q2R; simpl; ring). reflexivity. }
  split; [exact E|]. apply (forces_of_bordered q p load (range_below limit)); try assumption.
  - apply H. pose proof (Rinv_0_lt_compat _ G). lra.
  - intros f F. apply below_of_reciprocals; [exact G|]. intros r I. apply F, H, I.
Qed.

(** The absolute force of the row is below the limit. *)
Theorem check_force_within_correct q p load limit m :
  check_force range_within q p load limit m = true -> force_within q p load limit.
Proof.
  intros H. apply andb_prop in H as [K H]. exact (within_correct _ _ _ _ K (check_correct _ _ H)).
Qed.

(** The force of the row is below the limit, whatever its sign. *)
Theorem check_force_below_correct q p load limit m :
  check_force range_below q p load limit m = true -> force_below q p load limit.
Proof.
  intros H. apply andb_prop in H as [K H]. exact (below_correct _ _ _ _ K (check_correct _ _ H)).
Qed.

(** The same with a hint. *)
Theorem check_force_within_tree_correct q p load limit m t :
  check_force_tree range_within q p load limit m t = true -> force_within q p load limit.
Proof.
  intros H. apply andb_prop in H as [K H].
  exact (within_correct _ _ _ _ K (check_tree_correct _ _ t H)).
Qed.

Theorem check_force_below_tree_correct q p load limit m t :
  check_force_tree range_below q p load limit m t = true -> force_below q p load limit.
Proof.
  intros H. apply andb_prop in H as [K H].
  exact (below_correct _ _ _ _ K (check_tree_correct _ _ t H)).
Qed.

(** The same for a trajectory, without and with a hint for each piece. *)
Definition check_force_pieces (ends : expression -> expression * expression)
    (q : list expression -> question) (p : nat) (load : list expression) (limit : expression)
    (m : method) (pieces : list (list expression)) : bool :=
  forallb (fun piece => check_force ends (q piece) p load limit m) pieces.

Definition check_force_piece_trees (ends : expression -> expression * expression)
    (q : list expression -> question) (p : nat) (load : list expression) (limit : expression)
    (m : method) : list (list expression) -> list tree -> bool :=
  check_each (fun q => check_force_tree ends q p load limit m) q.

Theorem check_force_within_pieces_correct q p load limit m pieces :
  check_force_pieces range_within q p load limit m pieces = true ->
  Forall (fun piece => force_within (q piece) p load limit) pieces.
Proof.
  unfold check_force_pieces. rewrite forallb_forall. intros H. apply Forall_forall.
  intros piece P. exact (check_force_within_correct _ _ _ _ m (H piece P)).
Qed.

Theorem check_force_below_pieces_correct q p load limit m pieces :
  check_force_pieces range_below q p load limit m pieces = true ->
  Forall (fun piece => force_below (q piece) p load limit) pieces.
Proof.
  unfold check_force_pieces. rewrite forallb_forall. intros H. apply Forall_forall.
  intros piece P. exact (check_force_below_correct _ _ _ _ m (H piece P)).
Qed.

Theorem check_force_within_piece_trees_correct q p load limit m pieces trees :
  check_force_piece_trees range_within q p load limit m pieces trees = true ->
  Forall (fun piece => force_within (q piece) p load limit) pieces.
Proof.
  apply (check_each_correct _ (fun q => force_within q p load limit)).
  intros q' t. apply check_force_within_tree_correct.
Qed.

Theorem check_force_below_piece_trees_correct q p load limit m pieces trees :
  check_force_piece_trees range_below q p load limit m pieces trees = true ->
  Forall (fun piece => force_below (q piece) p load limit) pieces.
Proof.
  apply (check_each_correct _ (fun q => force_below q p load limit)).
  intros q' t. apply check_force_below_tree_correct.
Qed.
