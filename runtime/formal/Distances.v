(* SPDX-License-Identifier: Apache-2.0 *)
(** Finite errors: how far all errors together move the configuration of a closure. The check is
    made of one closure that has the mechanism twice, with its errors and without them. *)
From Coquelicot Require Import Coquelicot.
From Coq Require Import Reals QArith Qreals Lra Lia List PArith Bool.
From Coq Require PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Intervals Forms Evaluation Boxes Hints Regularity.
From Regulus Require Import Continuity Existence Derivatives LinearAlgebra Questions Search.
From Regulus Require Import Limits Closures Tubes Parts Branches Ways Rates.
Import ListNotations.
Open Scope R_scope.

(** ** The claims *)

Definition middle_of_range (c : closure) (k : nat) : expression :=
  let ends := nth k (ranges (places c)) (no_entry, no_entry) in
  Divide (Add (fst ends) (snd ends)) (Constant (2 # 1)).

(** The place x without errors: the variables with these numbers are in the middles of their
    ranges. *)
Definition without_errors (errors : list nat) (c : closure) (x : list R) : list R :=
  map (fun k => if is_member k errors then value [] (middle_of_range c k) else nth k x 0)
    (seq 0 (length x)).

(** What [is_branch] says, where the mechanism is at g x if the place is x. *)
Definition is_branch_at (g : list R -> list R) (c : closure) (p : list R -> list R) : Prop :=
  (forall x, in_set (places c) x ->
     solves c (g x) (p x) /\ has_values c (g x) (p x) /\ regular_at c (g x) (p x)) /\
  (forall q, solves c (g (the_start c)) q /\ is_near c q <-> q = p (the_start c)) /\
  (forall m, continuous_motion m -> (forall t, in_set (places c) (m t)) ->
     continuous_motion (fun t => p (m t)) /\
     forall q, continuous_motion q -> (forall t, solves c (g (m t)) (q t)) ->
       forall t0, q t0 = p (m t0) -> forall t, q t = p (m t)).

(** The mechanism has a branch p, and without errors a branch p0. At each place of the set, unknown
    i, the first one being unknown 0, differs by less than the limit. *)
Definition finite_error_within (c : closure) (errors : list nat) (i : nat) (limit : expression) :
    Prop :=
  defined [] limit /\ (i < unknowns c)%nat /\ is_given c /\ exists p p0,
    is_branch c p /\ is_branch_at (without_errors errors c) c p0 /\
    forall x, in_set (places c) x -> Rabs (nth i (p x) 0 - nth i (p0 x) 0) < value [] limit.

(** What [is_branch_along] says, where the mechanism of a piece c is at g c x if the place is x. *)
Definition is_branch_along_at (g : closure -> list R -> list R) (way : list closure)
    (p : list R -> list R) : Prop :=
  (forall x k c, is_on way x k c -> let y := g c (on_piece k x) in
     solves c y (p x) /\ has_values c y (p x) /\ regular_at c y (p x)) /\
  match way with
  | [] => False
  | c :: _ => forall q, solves c (g c (the_start c)) q /\ is_near c q <-> q = p (the_start c)
  end /\
  (forall m, continuous_motion m -> (forall t, exists k c, is_on way (m t) k c) ->
     continuous_motion (fun t => p (m t)) /\
     forall q, continuous_motion q ->
       (forall t k c, is_on way (m t) k c -> solves c (g c (on_piece k (m t))) (q t)) ->
       forall t0, q t0 = p (m t0) -> forall t, q t = p (m t)).

(** The same along a way, at each place of each piece. *)
Definition finite_error_within_along (c : list expression -> closure)
    (pieces : list (list expression)) (errors : list nat) (i : nat) (limit : expression) : Prop :=
  let way := map c pieces in
  defined [] limit /\ (i < unknowns_along c pieces)%nat /\ is_way way /\ exists p p0,
    is_branch_along way p /\ is_branch_along_at (without_errors errors) way p0 /\
    forall x k d, is_on way x k d -> Rabs (nth i (p x) 0 - nth i (p0 x) 0) < value [] limit.

(** ** Expressions with other names *)

Fixpoint renamed (r : nat -> expression) (e : expression) : expression :=
  match e with
  | Constant _ | Pi => e
  | Name k => r k
  | Negate a => Negate (renamed r a)
  | Add a b => Add (renamed r a) (renamed r b)
  | Subtract a b => Subtract (renamed r a) (renamed r b)
  | Multiply a b => Multiply (renamed r a) (renamed r b)
  | Divide a b => Divide (renamed r a) (renamed r b)
  | Power a n => Power (renamed r a) n
  | Sqrt a => Sqrt (renamed r a)
  | Sin a => Sin (renamed r a)
  | Cos a => Cos (renamed r a)
  | Atan a => Atan (renamed r a)
  | Exp a => Exp (renamed r a)
  | Log a => Log (renamed r a)
  | Abs a => Abs (renamed r a)
  end.

(** Each name k has the value of r k among other names; and r k is no name there if k is none. *)
Record follows (r : nat -> expression) (names others : list R) : Prop := {
  values_follow : forall k, (k < length names)%nat ->
    defined others (r k) /\ value others (r k) = nth k names 0;
  absences_follow : forall k, (length names <= k)%nat ->
    exists j, r k = Name j /\ (length others <= j)%nat }.

Lemma renamed_correct r names others : follows r names others -> forall e,
  value others (renamed r e) = value names e /\
  (defined others (renamed r e) <-> defined names e).
Proof.
  intros F. induction e; simpl; try tauto;
    try (destruct IHe as [-> D]; tauto);
    try (destruct IHe1 as [-> D1], IHe2 as [-> D2]; tauto).
  destruct (Nat.lt_ge_cases k (length names)) as [K|K].
  - destruct (values_follow _ _ _ F k K). tauto.
  - destruct (absences_follow _ _ _ F k K) as (j & -> & J). simpl.
    rewrite !nth_overflow by assumption. split; [reflexivity|lia].
Qed.

Lemma value_before names l e : defined names e ->
  value (names ++ l) e = value names e /\ defined (names ++ l) e.
Proof.
  induction e; simpl; intros D; try tauto;
    try (destruct (IHe ltac:(tauto)) as [-> D1]; tauto);
    try (destruct (IHe1 ltac:(tauto)) as [-> D1], (IHe2 ltac:(tauto)) as [-> D2]; tauto).
  rewrite app_nth1 by exact D. rewrite app_size. split; [reflexivity|lia].
Qed.

Lemma follows_more r names others l : follows r names others ->
  (forall k, (length names <= k)%nat ->
     exists j, r k = Name j /\ (length (others ++ l) <= j)%nat) ->
  follows r names (others ++ l).
Proof.
  intros F A. split; [|exact A]. intros k K.
  destruct (values_follow _ _ _ F k K) as [D E].
  destruct (value_before others l (r k) D) as [-> D']. auto.
Qed.

(** Definitions that are the next names on both sides. *)
Lemma follows_definitions r ds : forall names others, follows r names others ->
  (forall i, (i < length ds)%nat -> r (length names + i)%nat = Name (length others + i)) ->
  (forall k, (length names + length ds <= k)%nat ->
     exists j, r k = Name j /\ (length others + length ds <= j)%nat) ->
  follows r (extend names ds) (extend others (map (renamed r) ds)) /\
  (all_defined others (map (renamed r) ds) <-> all_defined names ds).
Proof.
  induction ds as [|d ds IH]; intros names others F N A; simpl; [split; [exact F|tauto]|].
  destruct (renamed_correct r names others F d) as [V D].
  assert (F' : follows r (names ++ [value names d]) (others ++ [value others (renamed r d)])).
  { split; intros k K; rewrite app_size in K; simpl in K.
    - destruct (Nat.eq_dec k (length names)) as [->|Q].
      + specialize (N O ltac:(simpl; lia)). rewrite !Nat.add_0_r in N. rewrite N. simpl.
        rewrite app_size, !nth_middle, V. simpl. split; [lia|reflexivity].
      + destruct (values_follow _ _ _ F k ltac:(lia)) as [D' E].
        destruct (value_before others [value others (renamed r d)] (r k) D') as [-> D''].
        rewrite app_nth1 by lia. auto.
    - rewrite app_size. simpl.
      destruct (Nat.lt_ge_cases k (length names + S (length ds))) as [Q|Q].
      + exists (length others + (k - length names))%nat. split; [|lia].
        rewrite <- N by (simpl; lia). f_equal. lia.
      + destruct (A k ltac:(simpl; lia)) as (j & E & J). exists j. split; [exact E|].
        simpl in J. lia. }
  destruct (IH _ _ F') as [IH1 IH2].
  - intros i I. rewrite !app_size. simpl. specialize (N (S i) ltac:(simpl; lia)).
    replace (length names + 1 + i)%nat with (length names + S i)%nat by lia. rewrite N.
    f_equal. lia.
  - intros k K. rewrite app_size in K |- *. simpl in K |- *.
    destruct (A k ltac:(simpl; lia)) as (j & E & J). exists j. split; [exact E|]. simpl in J. lia.
  - split; [exact IH1|]. tauto.
Qed.

(** ** Lists and matrices of two parts *)

Lemma sum_of_parts n k g : sum (n + k) g = sum n g + sum k (fun j => g (n + j)%nat).
Proof.
  induction k as [|k IH]; [rewrite Nat.add_0_r; simpl; ring|].
  rewrite Nat.add_succ_r. simpl. rewrite IH. ring.
Qed.

Lemma ranks_of_parts n (a : nat -> nat -> R) : full_column_rank (n + n) (n + n) a ->
  (forall i j, (i < n)%nat -> (j < n)%nat -> a (n + i)%nat j = 0 /\ a i (n + j)%nat = 0) ->
  full_column_rank n n a /\ full_column_rank n n (fun i j => a (n + i) (n + j))%nat.
Proof.
  intros F Z. split; intros y Y j J.
  - set (z := fun j => if Nat.ltb j n then y j else 0).
    assert (Zn : z j = 0).
    { apply F; [|lia]. intros i I. rewrite sum_of_parts.
      rewrite (sum_zero n (fun j => a i (n + j)%nat * z (n + j)%nat)).
      2: { intros k K. unfold z. destruct (Nat.ltb_spec (n + k) n); [lia|ring]. }
      rewrite (sum_ext n _ (fun j => a i j * y j)).
      2: { intros k K. unfold z. destruct (Nat.ltb_spec k n); [reflexivity|lia]. }
      rewrite Rplus_0_r. destruct (Nat.lt_ge_cases i n) as [Q|Q]; [exact (Y i Q)|].
      apply sum_zero. intros k K. replace i with (n + (i - n))%nat by lia.
      rewrite (proj1 (Z (i - n)%nat k ltac:(lia) K)). ring. }
    unfold z in Zn. destruct (Nat.ltb_spec j n); [exact Zn|lia].
  - set (z := fun j => if Nat.ltb j n then 0 else y (j - n)%nat).
    assert (Zn : z (n + j)%nat = 0).
    { apply F; [|lia]. intros i I. rewrite sum_of_parts.
      rewrite (sum_zero n (fun j => a i j * z j)).
      2: { intros k K. unfold z. destruct (Nat.ltb_spec k n); [ring|lia]. }
      rewrite (sum_ext n _ (fun j => a i (n + j)%nat * y j)).
      2: { intros k K. unfold z. destruct (Nat.ltb_spec (n + k) n); [lia|]. do 2 f_equal. lia. }
      rewrite Rplus_0_l. destruct (Nat.lt_ge_cases i n) as [Q|Q].
      - apply sum_zero. intros k K. rewrite (proj2 (Z i k Q K)). ring.
      - replace i with (n + (i - n))%nat by lia. apply Y. lia. }
    unfold z in Zn. destruct (Nat.ltb_spec (n + j) n); [lia|].
    replace (n + j - n)%nat with j in Zn by lia. exact Zn.
Qed.

Lemma put_first j s l k : (j < length l)%nat -> put j s (l ++ k) = put j s l ++ k.
Proof.
  revert j. induction l as [|x l IH]; intros j J; simpl in J; [lia|].
  destruct j; simpl; [reflexivity|]. rewrite IH by lia. reflexivity.
Qed.

Lemma put_second j s l k : put (length l + j) s (l ++ k) = l ++ put j s k.
Proof. induction l as [|x l IH]; simpl; [reflexivity|]. rewrite IH. reflexivity. Qed.

Lemma derivative_ext g h x l : (forall s, g s = h s) ->
  derivable_pt_lim g x l -> derivable_pt_lim h x l.
Proof.
  intros E D e P. destruct (D e P) as [r Q]. exists r. intros s. rewrite <- !E. apply Q.
Qed.

Lemma pairs_length {A B} (P : A -> B -> Prop) l k : Forall2 P l k -> length l = length k.
Proof. induction 1; simpl; congruence. Qed.

Lemma same_parts {A} (a : list A) : forall x b y,
  a ++ b = x ++ y -> length a = length x -> a = x /\ b = y.
Proof.
  induction a as [|u a IH]; intros [|v x] b y E L; simpl in *; try discriminate; [auto|].
  injection E as -> E. injection L as L. destruct (IH x b y E L) as [-> ->]. auto.
Qed.

Lemma nth_firstn n k (l : list R) : nth k (firstn n l) 0 = if Nat.ltb k n then nth k l 0 else 0.
Proof.
  revert k l. induction n as [|n IH]; intros k l; [destruct k; reflexivity|].
  destruct l, k; simpl; try reflexivity.
  - destruct (Nat.ltb _ _); reflexivity.
  - apply IH.
Qed.

Lemma nth_skipn n k (l : list R) : nth k (skipn n l) 0 = nth (n + k) l 0.
Proof.
  revert l. induction n as [|n IH]; intros l; [reflexivity|].
  destruct l; simpl; [destruct k; reflexivity|apply IH].
Qed.

(** ** The mechanism twice *)

Section Doubled.
  Variables (errors : list nat) (c : closure).
  Let m := length (ranges (places c)).
  Let d := length (definitions (places c)).
  Let n := unknowns c.
  Let f := length (further c).

  (** The names are the variables, the definitions and their copies, the unknowns and their copies,
      the definitions that use unknowns and their copies. The last names are no names. *)
  Definition no_name (k : nat) : expression := Name (k + 2 * (d + n + f)).

  (** The name k of a mechanism with u unknowns and g definitions that use them. *)
  Definition original (u g k : nat) : expression :=
    if Nat.ltb k (m + d) then Name k
    else if Nat.ltb k (m + d + u) then Name (k + d)
    else if Nat.ltb k (m + d + u + g) then Name (k + d + n)
    else no_name k.

  (** The same of the copy, which has no errors. *)
  Definition copied (u g k : nat) : expression :=
    if Nat.ltb k m then if is_member k errors then middle_of_range c k else Name k
    else if Nat.ltb k (m + d) then Name (k + d)
    else if Nat.ltb k (m + d + u) then Name (k + d + n)
    else if Nat.ltb k (m + d + u + g) then Name (k + d + n + f)
    else no_name k.

  Definition both (u g : nat) (l : list expression) : list expression :=
    map (renamed (original u g)) l ++ map (renamed (copied u g)) l.

  Definition doubled : closure :=
    let q := places c in
    Closure
      (Question (ranges q)
        (definitions q ++ map (renamed (copied 0 0)) (definitions q))
        (map (renamed (original 0 0)) (constraints q))
        (both 0 0 (also_defined q)) [] 0)
      (n + n) (both n f (further c)) (both n f (equations c)) (both n f (also c))
      (start c) (near c ++ near c).

  (** ** Why it is right *)

  Hypothesis ends : ends_defined (places c).
  Hypothesis has_all : length (equations c) = n.

  Section At_place.
    Variable x : list R.
    Hypothesis size : length x = m.
    Let x0 := without_errors errors c x.
    Let base := extend x (definitions (places c)).
    Let base0 := extend x0 (definitions (places c)).
    Let copies := map (renamed (copied 0 0)) (definitions (places c)).
    Let all_places := extend x (definitions (places doubled)).

    Lemma size0 : length x0 = m.
    Proof. unfold x0, without_errors. rewrite map_size, seq_size. exact size. Qed.

    Lemma nth0 k : (k < m)%nat -> nth k x0 0 =
      if is_member k errors then value [] (middle_of_range c k) else nth k x 0.
    Proof.
      intros K. set (g := fun k => if is_member k errors then value [] (middle_of_range c k)
                                   else nth k x 0).
      unfold x0, without_errors. fold g.
      rewrite (nth_indep _ 0 (g O)) by (rewrite map_size, seq_size, size; exact K).
      rewrite map_nth, seq_nth by (rewrite size; exact K). reflexivity.
    Qed.

    Lemma size_base : length base = (m + d)%nat.
    Proof. unfold base. rewrite extend_length, size. reflexivity. Qed.
    Lemma size_base0 : length base0 = (m + d)%nat.
    Proof. unfold base0. rewrite extend_length, size0. reflexivity. Qed.

    Lemma all_places_are : all_places = extend base copies.
    Proof. unfold all_places. simpl. apply extend_app. Qed.

    Lemma all_places_begin : exists l, length l = d /\ all_places = base ++ l.
    Proof.
      rewrite all_places_are. destruct (extend_prefix copies base) as [l L]. exists l.
      split; [|exact L]. apply (f_equal (@length R)) in L. rewrite extend_length, app_size in L.
      unfold copies in L. rewrite map_size in L. fold d in L. lia.
    Qed.

    Lemma middle_known k : (k < m)%nat -> defined [] (middle_of_range c k).
    Proof.
      intros K. unfold ends_defined in ends. rewrite Forall_forall in ends.
      destruct (ends (nth k (ranges (places c)) (no_entry, no_entry)) (nth_In _ _ K)) as [A B].
      simpl. repeat split; try assumption. unfold Q2R. simpl. lra.
    Qed.

    Lemma original_places : follows (original 0 0) base all_places.
    Proof.
      destruct all_places_begin as (l & Ll & ->). pose proof size_base as Sb.
      split; intros k K; rewrite Sb in K; unfold original, no_name.
      - destruct (Nat.ltb_spec k (m + d)); [|lia]. simpl. rewrite app_size, app_nth1 by lia.
        split; [lia|reflexivity].
      - rewrite app_size, Sb, Ll. destruct (Nat.ltb_spec k (m + d)); [lia|].
        destruct (Nat.ltb_spec k (m + d + 0)); [lia|].
        destruct (Nat.ltb_spec k (m + d + 0 + 0)); [lia|]. eexists. split; [reflexivity|]. lia.
    Qed.

    Lemma copied_places : follows (copied 0 0) base0 all_places /\
      (all_defined base copies <-> all_defined x0 (definitions (places c))).
    Proof.
      rewrite all_places_are. pose proof size_base as Sb. apply follows_definitions.
      - split; intros k K; rewrite size0 in K; unfold copied, no_name.
        + destruct (Nat.ltb_spec k m); [|lia]. rewrite nth0 by exact K.
          destruct (is_member k errors).
          * destruct (value_before [] base _ (middle_known k K)). auto.
          * simpl. split; [lia|]. unfold base.
            destruct (extend_prefix (definitions (places c)) x) as [l ->].
            apply app_nth1. lia.
        + rewrite Sb. destruct (Nat.ltb_spec k m); [lia|].
          destruct (Nat.ltb_spec k (m + d)); [eexists; split; [reflexivity|]; lia|].
          destruct (Nat.ltb_spec k (m + d + 0)); [lia|].
          destruct (Nat.ltb_spec k (m + d + 0 + 0)); [lia|]. eexists. split; [reflexivity|]. lia.
      - intros i I. fold d in I. rewrite size0, Sb. unfold copied.
        destruct (Nat.ltb_spec (m + i) m); [lia|].
        destruct (Nat.ltb_spec (m + i) (m + d)); [|lia]. f_equal. lia.
      - intros k K. fold d in K. rewrite size0 in K. fold d. rewrite Sb. unfold copied, no_name.
        destruct (Nat.ltb_spec k m); [lia|]. destruct (Nat.ltb_spec k (m + d)); [lia|].
        destruct (Nat.ltb_spec k (m + d + 0)); [lia|].
        destruct (Nat.ltb_spec k (m + d + 0 + 0)); [lia|]. eexists. split; [reflexivity|]. lia.
    Qed.

    Section With_unknowns.
      Variables p p0 : list R.
      Hypothesis size_p : length p = n.
      Hypothesis size_p0 : length p0 = n.
      Let names := names_at c x p.
      Let names0 := names_at c x0 p0.
      Let all := names_at doubled x (p ++ p0).
      Let start_of_further := all_places ++ p ++ p0.
      Let firsts := map (renamed (original n f)) (further c).
      Let seconds := map (renamed (copied n f)) (further c).
      Let middle := extend start_of_further firsts.

      Lemma size_all_places : length all_places = (m + d + d)%nat.
      Proof.
        destruct all_places_begin as (l & Ll & ->). rewrite app_size, size_base, Ll. reflexivity.
      Qed.

      Lemma all_are : all = extend middle seconds.
      Proof. unfold all, names_at. simpl. unfold both. rewrite extend_app. reflexivity. Qed.

      Lemma size_middle : length middle = (m + d + d + n + n + f)%nat.
      Proof.
        unfold middle, firsts, start_of_further.
        rewrite extend_length, map_size, !app_size, size_all_places, size_p, size_p0. fold f.
        lia.
      Qed.

      (** The original is among all names. *)
      Lemma original_follows : follows (original n f) names all /\
        (all_defined start_of_further firsts <-> all_defined (base ++ p) (further c)).
      Proof.
        assert (F : follows (original n f) (base ++ p) start_of_further).
        { destruct all_places_begin as (l & Ll & E). pose proof size_base as Sb.
          unfold start_of_further. rewrite E.
          split; intros k K; rewrite app_size, Sb, size_p in K; unfold original, no_name.
          - destruct (Nat.ltb_spec k (m + d)).
            + simpl. rewrite !app_size, <- !app_assoc, !app_nth1 by lia. split; [lia|reflexivity].
            + destruct (Nat.ltb_spec k (m + d + n)); [|lia]. simpl.
              rewrite !app_size. split; [lia|]. rewrite <- app_assoc.
              rewrite (app_nth2 base p) by lia. rewrite (app_nth2 base) by lia.
              rewrite (app_nth2 l) by lia. rewrite app_nth1 by lia. f_equal. lia.
          - rewrite !app_size, Sb, Ll, size_p, size_p0.
            destruct (Nat.ltb_spec k (m + d)); [lia|].
            destruct (Nat.ltb_spec k (m + d + n)); [lia|].
            destruct (Nat.ltb_spec k (m + d + n + f)); eexists; (split; [reflexivity|]); lia. }
        pose proof size_all_places as Sa. pose proof size_base as Sb.
        destruct (follows_definitions (original n f) (further c) _ _ F) as [F1 D1].
        - intros i I. fold f in I. unfold start_of_further.
          rewrite !app_size, Sa, Sb, size_p, size_p0. unfold original.
          destruct (Nat.ltb_spec (m + d + n + i) (m + d)); [lia|].
          destruct (Nat.ltb_spec (m + d + n + i) (m + d + n)); [lia|].
          destruct (Nat.ltb_spec (m + d + n + i) (m + d + n + f)); [|lia]. f_equal. lia.
        - intros k K. fold f in K |- *. unfold start_of_further.
          rewrite !app_size in *. rewrite Sa, size_p, size_p0. rewrite Sb, size_p in K.
          unfold original, no_name. destruct (Nat.ltb_spec k (m + d)); [lia|].
          destruct (Nat.ltb_spec k (m + d + n)); [lia|].
          destruct (Nat.ltb_spec k (m + d + n + f)); [lia|]. eexists. split; [reflexivity|]. lia.
        - split; [|exact D1]. rewrite all_are. destruct (extend_prefix seconds middle) as [l L].
          rewrite L. apply follows_more; [exact F1|].
          intros k K. rewrite <- L, extend_length, size_middle. unfold seconds.
          rewrite map_size. fold f. unfold names, names_at in K.
          rewrite extend_length, app_size in K. fold base f in K. rewrite Sb, size_p in K.
          unfold original, no_name. destruct (Nat.ltb_spec k (m + d)); [lia|].
          destruct (Nat.ltb_spec k (m + d + n)); [lia|].
          destruct (Nat.ltb_spec k (m + d + n + f)); [lia|]. eexists. split; [reflexivity|]. lia.
      Qed.

      (** So is the copy. *)
      Lemma copied_follows : follows (copied n f) names0 all /\
        (all_defined middle seconds <-> all_defined (base0 ++ p0) (further c)).
      Proof.
        pose proof size_base0 as Sb. pose proof size_all_places as Sa. pose proof size_middle as Sm.
        assert (begins : exists l, length l = f /\ middle = all_places ++ p ++ p0 ++ l).
        { unfold middle. destruct (extend_prefix firsts start_of_further) as [l L]. exists l.
          rewrite L. unfold start_of_further. rewrite <- !app_assoc. split; [|reflexivity].
          apply (f_equal (@length R)) in L. fold middle in L. rewrite Sm, app_size in L.
          unfold start_of_further in L. rewrite !app_size, Sa, size_p, size_p0 in L. lia. }
        rewrite all_are. apply follows_definitions.
        - split; intros k K; rewrite app_size, Sb, size_p0 in K.
          + destruct (Nat.lt_ge_cases k (m + d)) as [Q|Q].
            * replace (copied n f k) with (copied 0 0 k).
              2: { unfold copied. destruct (Nat.ltb_spec k m); [reflexivity|].
                   destruct (Nat.ltb_spec k (m + d)); [reflexivity|lia]. }
              destruct (values_follow _ _ _ (proj1 copied_places) k ltac:(lia)) as [D E].
              destruct begins as (l & _ & ->).
              destruct (value_before all_places (p ++ p0 ++ l) _ D) as [-> D'].
              rewrite app_nth1 by lia. auto.
            * unfold copied. destruct (Nat.ltb_spec k m); [lia|].
              destruct (Nat.ltb_spec k (m + d)); [lia|].
              destruct (Nat.ltb_spec k (m + d + n)); [|lia]. simpl. split; [lia|].
              destruct begins as (l & _ & ->).
              rewrite (app_nth2 base0) by lia. rewrite (app_nth2 all_places) by lia.
              rewrite (app_nth2 p) by lia. rewrite app_nth1 by lia. f_equal. lia.
          + rewrite Sm. unfold copied, no_name. destruct (Nat.ltb_spec k m); [lia|].
            destruct (Nat.ltb_spec k (m + d)); [lia|].
            destruct (Nat.ltb_spec k (m + d + n)); [lia|].
            destruct (Nat.ltb_spec k (m + d + n + f)); eexists; (split; [reflexivity|]); lia.
        - intros i I. fold f in I. rewrite app_size, Sb, size_p0, Sm. unfold copied.
          destruct (Nat.ltb_spec (m + d + n + i) m); [lia|].
          destruct (Nat.ltb_spec (m + d + n + i) (m + d)); [lia|].
          destruct (Nat.ltb_spec (m + d + n + i) (m + d + n)); [lia|].
          destruct (Nat.ltb_spec (m + d + n + i) (m + d + n + f)); [|lia]. f_equal. lia.
        - intros k K. fold f in K |- *. rewrite app_size, Sb, size_p0 in K. rewrite Sm.
          unfold copied, no_name. destruct (Nat.ltb_spec k m); [lia|].
          destruct (Nat.ltb_spec k (m + d)); [lia|]. destruct (Nat.ltb_spec k (m + d + n)); [lia|].
          destruct (Nat.ltb_spec k (m + d + n + f)); [lia|]. eexists. split; [reflexivity|]. lia.
      Qed.

      Lemma equations_both i : (i < n)%nat ->
        equation_at doubled x (p ++ p0) i = equation_at c x p i /\
        equation_at doubled x (p ++ p0) (n + i) = equation_at c x0 p0 i.
      Proof.
        intros I. unfold equation_at. fold all names names0. simpl. unfold both.
        rewrite app_nth1 by (rewrite map_size, has_all; exact I).
        rewrite app_nth2 by (rewrite map_size, has_all; lia). rewrite map_size, has_all.
        replace (n + i - n)%nat with i by lia.
        assert (N : forall r, nth i (map (renamed r) (equations c)) no_entry
                              = renamed r (nth i (equations c) no_entry)).
        { intros r. rewrite <- (map_nth (renamed r)). apply nth_indep.
          rewrite map_size, has_all. exact I. }
        rewrite !N. split.
        - exact (proj1 (renamed_correct _ _ _ (proj1 original_follows) _)).
        - exact (proj1 (renamed_correct _ _ _ (proj1 copied_follows) _)).
      Qed.

      Lemma solves_both : solves doubled x (p ++ p0) <-> solves c x p /\ solves c x0 p0.
      Proof.
        unfold solves. simpl. fold n. rewrite app_size, size_p, size_p0. split.
        - intros [_ S]. split; (split; [reflexivity|]); intros i I.
          + rewrite <- (proj1 (equations_both i I)). apply S. lia.
          + rewrite <- (proj2 (equations_both i I)). apply S. lia.
        - intros [[_ S] [_ S0]]. split; [reflexivity|]. intros i I.
          destruct (Nat.lt_ge_cases i n) as [K|K].
          + rewrite (proj1 (equations_both i K)). exact (S i K).
          + replace i with (n + (i - n))%nat by lia.
            rewrite (proj2 (equations_both (i - n) ltac:(lia))). apply S0. lia.
      Qed.

      Lemma defined_all r names' others l : follows r names' others ->
        Forall (defined others) (map (renamed r) l) -> Forall (defined names') l.
      Proof.
        intros F. rewrite !Forall_forall. intros H e E.
        apply (renamed_correct r names' others F), H, in_map, E.
      Qed.

      Lemma values_both : has_values doubled x (p ++ p0) ->
        has_values c x p /\ has_values c x0 p0.
      Proof.
        intros (H1 & H2 & H3 & H4 & H5).
        change (all_defined x (definitions (places c) ++ copies)) in H1.
        apply all_defined_app in H1 as [H1 H1']. fold base in H1'.
        change (Forall (defined all_places) (both 0 0 (also_defined (places c)))) in H2.
        change (all_defined start_of_further (firsts ++ seconds)) in H3.
        apply all_defined_app in H3 as [H3 H3'].
        change (Forall (defined all) (both n f (equations c))) in H4.
        change (Forall (defined all) (both n f (also c))) in H5.
        unfold both in H2, H4, H5. apply Forall_app in H2 as [H2 H2'].
        apply Forall_app in H4 as [H4 H4']. apply Forall_app in H5 as [H5 H5'].
        destruct original_follows as [F D], copied_follows as [F' D'].
        destruct copied_places as [P' E'].
        split; (split; [|split; [|split; [|split]]]).
        - exact H1.
        - exact (defined_all _ _ _ _ original_places H2).
        - apply D, H3.
        - exact (defined_all _ _ _ _ F H4).
        - exact (defined_all _ _ _ _ F H5).
        - apply E', H1'.
        - exact (defined_all _ _ _ _ P' H2').
        - apply D', H3'.
        - exact (defined_all _ _ _ _ F' H4').
        - exact (defined_all _ _ _ _ F' H5').
      Qed.
    End With_unknowns.

    (** The derivatives of an equation by the unknowns of the other one are 0. *)
    Lemma regular_both p p0 : length p = n -> length p0 = n ->
      regular_at doubled x (p ++ p0) -> regular_at c x p /\ regular_at c x0 p0.
    Proof.
      intros size_p size_p0 (a & D & F). simpl in D, F. fold n in D, F.
      assert (first : forall i j, (i < n)%nat -> (j < n)%nat ->
        derivable_pt_lim (fun s => equation_at c x (put j s p) i) (nth j p 0) (a i j) /\
        a (n + i)%nat j = 0).
      { intros i j I J.
        assert (E : forall s k, (k < n)%nat ->
          equation_at doubled x (put j s (p ++ p0)) k = equation_at c x (put j s p) k /\
          equation_at doubled x (put j s (p ++ p0)) (n + k) = equation_at c x0 p0 k).
        { intros s k K. rewrite put_first by lia.
          apply equations_both; [rewrite put_length|..]; assumption. }
        pose proof (D i j ltac:(lia) ltac:(lia)) as D1.
        pose proof (D (n + i)%nat j ltac:(lia) ltac:(lia)) as D2.
        rewrite app_nth1 in D1, D2 by lia. split.
        - apply (derivative_ext _ _ _ _ (fun s => proj1 (E s i I)) D1).
        - apply (derivative_ext _ _ _ _ (fun s => proj2 (E s i I))) in D2.
          exact (uniqueness_limite _ _ _ _ D2 (derivable_pt_lim_const _ _)). }
      assert (second : forall i j, (i < n)%nat -> (j < n)%nat ->
        derivable_pt_lim (fun s => equation_at c x0 (put j s p0) i) (nth j p0 0)
          (a (n + i) (n + j))%nat /\ a i (n + j)%nat = 0).
      { intros i j I J.
        assert (E : forall s k, (k < n)%nat ->
          equation_at doubled x (put (n + j) s (p ++ p0)) k = equation_at c x p k /\
          equation_at doubled x (put (n + j) s (p ++ p0)) (n + k)
            = equation_at c x0 (put j s p0) k).
        { intros s k K. replace (put (n + j) s (p ++ p0)) with (p ++ put j s p0)
            by (rewrite <- size_p; symmetry; apply put_second).
          apply equations_both; [|rewrite put_length|]; assumption. }
        pose proof (D i (n + j)%nat ltac:(lia) ltac:(lia)) as D1.
        pose proof (D (n + i)%nat (n + j)%nat ltac:(lia) ltac:(lia)) as D2.
        replace (nth (n + j) (p ++ p0) 0) with (nth j p0 0) in D1, D2
          by (rewrite app_nth2 by lia; f_equal; lia). split.
        - apply (derivative_ext _ _ _ _ (fun s => proj2 (E s i I)) D2).
        - apply (derivative_ext _ _ _ _ (fun s => proj1 (E s i I))) in D1.
          exact (uniqueness_limite _ _ _ _ D1 (derivable_pt_lim_const _ _)). }
      destruct (ranks_of_parts n a F) as [F1 F2].
      { intros i j I J. split; [apply first|apply second]; assumption. }
      split; [exists a|exists (fun i j => a (n + i) (n + j))%nat]; (split; [|assumption]);
        intros i j I J; [apply first|apply second]; assumption.
    Qed.

    Lemma set_of_both : in_set (places doubled) x <-> in_set (places c) x.
    Proof.
      pose proof (renamed_correct _ _ _ original_places) as E. unfold in_set. simpl.
      change (extend x (definitions (places c) ++ copies)) with all_places. fold base.
      split; intros [R C]; (split; [exact R|]).
      - intros e I D. destruct (E e) as [V [_ D']]. rewrite <- V.
        apply (C _ (in_map (renamed (original 0 0)) _ _ I)), D', D.
      - intros e I D. apply in_map_iff in I as (e' & <- & I). destruct (E e') as [V [D' _]].
        change (value all_places (renamed (original 0 0) e') <= 0). rewrite V.
        apply C; [exact I|exact (D' D)].
    Qed.

    Lemma parts_solve q : solves doubled x q ->
      length (firstn n q) = n /\ length (skipn n q) = n /\ firstn n q ++ skipn n q = q /\
      solves c x (firstn n q) /\ solves c x0 (skipn n q).
    Proof.
      intros S. assert (L : length q = (n + n)%nat) by apply S.
      assert (L1 : length (firstn n q) = n) by (rewrite firstn_size; lia).
      assert (L2 : length (skipn n q) = n) by (rewrite skipn_length; lia).
      pose proof (firstn_skipn n q) as E. split; [exact L1|]. split; [exact L2|].
      split; [exact E|]. rewrite <- E in S. exact (proj1 (solves_both _ _ L1 L2) S).
    Qed.
  End At_place.

  Lemma lengths_in_set x : in_set (places c) x -> length x = m.
  Proof. intros [F _]. exact (pairs_length _ _ _ F). Qed.

  Lemma parts_hold x q : length x = m ->
    solves doubled x q /\ has_values doubled x q /\ regular_at doubled x q ->
    (solves c x (firstn n q) /\ has_values c x (firstn n q) /\ regular_at c x (firstn n q)) /\
    let y := without_errors errors c x in
    solves c y (skipn n q) /\ has_values c y (skipn n q) /\ regular_at c y (skipn n q).
  Proof.
    intros L (S & V & G). destruct (parts_solve x L q S) as (L1 & L2 & E & S1 & S2).
    rewrite <- E in V, G. destruct (values_both x L _ _ L1 L2 V) as [V1 V2].
    destruct (regular_both x L _ _ L1 L2 G) as [G1 G2]. auto 10.
  Qed.

  Lemma near_both p p0 : length p = length (near c) ->
    is_near doubled (p ++ p0) <-> is_near c p /\ is_near c p0.
  Proof.
    unfold is_near. simpl. intros L. split.
    - intros H. apply Forall2_app_inv_l in H as (a & b & A & B & E).
      destruct (same_parts _ _ _ _ E) as [-> ->]; [|auto].
      rewrite <- L. exact (pairs_length _ _ _ A).
    - intros [A B]. apply Forall2_app; assumption.
  Qed.

  (** The start. *)
  Lemma parts_start q : length (the_start c) = m ->
    (forall r, solves doubled (the_start c) r /\ is_near doubled r <-> r = q) ->
    (forall r, solves c (the_start c) r /\ is_near c r <-> r = firstn n q) /\
    (forall r, solves c (without_errors errors c (the_start c)) r /\ is_near c r
       <-> r = skipn n q).
  Proof.
    intros L H. destruct (proj2 (H q) eq_refl) as [S N].
    destruct (parts_solve _ L q S) as (L1 & L2 & E & S1 & S2).
    assert (Ln : length (near c) = n).
    { apply pairs_length in N. simpl in N. rewrite app_size, <- E, app_size in N. lia. }
    rewrite <- E in N. apply near_both in N as [N1 N2]; [|lia].
    split; intros r; (split; [intros [Sr Nr]|intros ->; auto]);
      assert (Lr : length r = n) by apply Sr.
    - assert (Q : r ++ skipn n q = q).
      { apply H. split; [apply solves_both; auto|apply near_both; [lia|auto]]. }
      exact (proj1 (same_parts _ _ _ _ (eq_trans Q (eq_sym E)) (eq_trans Lr (eq_sym L1)))).
    - assert (Q : firstn n q ++ r = q).
      { apply H. split; [apply solves_both; auto|apply near_both; [lia|auto]]. }
      exact (proj2 (same_parts _ _ _ _ (eq_trans Q (eq_sym E)) eq_refl)).
  Qed.
End Doubled.

(** ** Motions *)

(** How [is_branch] says that p moves continuously, and that it is alone. *)
Definition moves_alone (inside : list R -> Prop) (solve : list R -> list R -> Prop)
    (p : list R -> list R) : Prop :=
  forall m, continuous_motion m -> (forall t, inside (m t)) ->
    continuous_motion (fun t => p (m t)) /\
    forall q, continuous_motion q -> (forall t, solve (m t) (q t)) ->
      forall t0, q t0 = p (m t0) -> forall t, q t = p (m t).

Lemma first_continuous n (q : R -> list R) : continuous_motion q ->
  continuous_motion (fun t => firstn n (q t)).
Proof.
  intros C k t. destruct (Nat.ltb k n) eqn:K.
  - apply (continuity_pt_ext (fun t => nth k (q t) 0)); [|apply C].
    intros s. rewrite nth_firstn, K. reflexivity.
  - apply (continuity_pt_ext (fun _ => 0)); [|apply continuous_constant].
    intros s. rewrite nth_firstn, K. reflexivity.
Qed.

Lemma second_continuous n (q : R -> list R) : continuous_motion q ->
  continuous_motion (fun t => skipn n (q t)).
Proof.
  intros C k t. apply (continuity_pt_ext (fun t => nth (n + k) (q t) 0)); [|apply C].
  intros s. symmetry. apply nth_skipn.
Qed.

Lemma both_continuous n (p q : R -> list R) : (forall t, length (p t) = n) ->
  continuous_motion p -> continuous_motion q -> continuous_motion (fun t => p t ++ q t).
Proof.
  intros L P Q k t. destruct (Nat.lt_ge_cases k n) as [K|K].
  - apply (continuity_pt_ext (fun t => nth k (p t) 0)); [|apply P].
    intros s. rewrite app_nth1 by (rewrite L; exact K). reflexivity.
  - apply (continuity_pt_ext (fun t => nth (k - n) (q t) 0)); [|apply Q].
    intros s. rewrite app_nth2, L by (rewrite L; exact K). reflexivity.
Qed.

Lemma parts_move (inside : list R -> Prop) n (solve first second : list R -> list R -> Prop) q :
  (forall x, inside x -> solve x (q x)) ->
  (forall x r, inside x -> solve x r -> length (firstn n r) = n /\
     firstn n r ++ skipn n r = r /\ first x (firstn n r) /\ second x (skipn n r)) ->
  (forall x p p0, inside x -> first x p -> second x p0 -> length p = n /\ solve x (p ++ p0)) ->
  moves_alone inside solve q ->
  moves_alone inside first (fun x => firstn n (q x)) /\
  moves_alone inside second (fun x => skipn n (q x)).
Proof.
  intros S A B H. split; intros m C I; destruct (H m C I) as [D U];
    assert (P : forall t, _) by exact (fun t => A (m t) (q (m t)) (I t) (S (m t) (I t)));
    (split; [first [apply first_continuous|apply second_continuous]; exact D|]);
    intros r Cr Sr t0 E t.
  - assert (Lr : forall t, length (r t) = n).
    { intros s. exact (proj1 (B _ _ _ (I s) (Sr s) (proj2 (proj2 (proj2 (P s)))))). }
    assert (Q : forall t, r t ++ skipn n (q (m t)) = q (m t)).
    { apply (U (fun t => r t ++ skipn n (q (m t)))) with (t0 := t0).
      - apply (both_continuous n); [exact Lr|exact Cr|apply second_continuous, D].
      - intros s. apply B; [exact (I s)|exact (Sr s)|apply P].
      - rewrite E. apply P. }
    destruct (P t) as (L & E1 & _).
    exact (proj1 (same_parts _ _ _ _ (eq_trans (Q t) (eq_sym E1)) (eq_trans (Lr t) (eq_sym L)))).
  - assert (Q : forall t, firstn n (q (m t)) ++ r t = q (m t)).
    { apply (U (fun t => firstn n (q (m t)) ++ r t)) with (t0 := t0).
      - apply (both_continuous n); [intros s; apply P|apply first_continuous, D|exact Cr].
      - intros s. apply B; [exact (I s)|apply P|exact (Sr s)].
      - rewrite E. apply P. }
    destruct (P t) as (_ & E1 & _).
    exact (proj2 (same_parts _ _ _ _ (eq_trans (Q t) (eq_sym E1)) eq_refl)).
Qed.

(** ** The distance of two unknowns, over a tube *)

Section Over_tube.
  Variables (c : closure) (full i j : nat) (limit : interval).
  Let n := unknowns c.

  Definition is_near_over (t : tube) (b : box) : bool :=
    match test_tube c full t b with
    | Some v =>
        let f := residuals c full t b in
        let d := departures n t v in
        let gap := form_range (subtract_forms (newton_form n full t b v f i)
                     (newton_form n full t b v f j)) in
        is_negative (subtract (add (I.abs gap) (add (rest_of n v d i) (rest_of n v d j))) limit)
    | None => false
    end.

  (** It is shown over the tube, over a narrower one, or over each half of the box. *)
  Fixpoint stays_near (fuel : nat) (t : tube) (b : box) : bool :=
    if is_near_over t b then true
    else
      let s := tightest c full 3 t b in
      if is_near_over s b then true
      else
        match fuel, largest_of (map (fun i => PrimFloat.sub (I.upper i) (I.lower i)) b) with
        | S fuel', Some k =>
            let p := I.midpoint (nth k b I.nai) in
            if stays_near fuel' s (lower_part b k p) then stays_near fuel' s (upper_part b k p)
            else false
        | _, _ => false
        end.

  Hypothesis I : (i < n)%nat.
  Hypothesis J : (j < n)%nat.

  Lemma is_near_over_correct t b x p y : encloses limit y -> is_near_over t b = true ->
    in_box b x -> in_tube n t x p -> solves c x p -> Rabs (nth i p 0 - nth j p 0) < y.
  Proof.
    intros L H B P S. unfold is_near_over in H.
    destruct (test_tube c full t b) as [v|] eqn:T; [|discriminate].
    destruct (near_newton_form c full t b v x T B p i P S I) as (a & d & A & D & Q).
    destruct (near_newton_form c full t b v x T B p j P S J) as (a' & d' & A' & D' & Q').
    pose proof (form_range_encloses _ _ _ (coordinate_in_unit_box b x B)
      (subtract_forms_enclose _ _ _ _ _ A A')) as G.
    pose proof (is_negative_correct _ _ H (subtract_encloses _ _ _ _
      (add_encloses _ _ _ _ (absolute_encloses _ _ G) (add_encloses _ _ _ _ D D')) L)) as Z.
    replace (nth i p 0 - nth j p 0)
      with ((nth i p 0 - a) + ((a - a') - (nth j p 0 - a'))) by ring.
    eapply Rle_lt_trans; [apply Rabs_triang|].
    pose proof (Rabs_triang (a - a') (- (nth j p 0 - a'))) as Y. rewrite Rabs_Ropp in Y.
    unfold Rminus in *. lra.
  Qed.

  Lemma stays_near_correct x p y : encloses limit y -> solves c x p -> forall fuel t b,
    stays_near fuel t b = true -> in_box b x -> in_tube n t x p ->
    Rabs (nth i p 0 - nth j p 0) < y.
  Proof.
    intros L S. induction fuel as [|fuel IH]; intros t b H B P; cbn [stays_near] in H;
      destruct (is_near_over t b) eqn:N; try exact (is_near_over_correct t b x p y L N B P S);
      clear N; pose proof (tightest_holds c full 3 b x p B S t P) as P1;
      cbv zeta in H; set (s := tightest c full 3 t b) in *;
      destruct (is_near_over s b) eqn:N; try exact (is_near_over_correct s b x p y L N B P1 S).
    - discriminate.
    - destruct largest_of as [k|]; [|discriminate].
      destruct (stays_near fuel s _) eqn:HL; [|discriminate].
      destruct (parts_cover b x k (I.midpoint (nth k b I.nai)) B) as [D|D].
      + exact (IH s _ HL D P1).
      + exact (IH s _ H D P1).
  Qed.
End Over_tube.

(** ** Hints *)

(** Widens a tube in the unknowns of which the test shows too little: those of the copy hardly move,
    and the tubes of certificates are as narrow. Halves the box if that is not enough. Nothing is
    proved of it. *)
Definition fitted_tube (c : closure) (full : nat) (t : tube) (b : box) : tube :=
  match bounds_of c full t b with
  | Some v =>
      Tube (foot t) (axis_at t) (tilt t)
        (map (fun i =>
           let r := number (reach t) i in
           let d := I.upper (departure (unknowns c) t v i) in
           if PrimFloat.ltb r d then PrimFloat.add d d else r) (seq 0 (unknowns c)))
  | None => t
  end.

Fixpoint fitted_leaf (c : closure) (full fuel : nat) (t : tube) (b : box) : tubes :=
  let s := fitted_tube c full t b in
  if is_tested c full s b then Held s
  else
    match fuel, largest_of (map (fun i => PrimFloat.sub (I.upper i) (I.lower i)) b) with
    | S fuel', Some k =>
        let p := I.midpoint (nth k b I.nai) in
        Cut k p (fitted_leaf c full fuel' t (lower_part b k p))
          (fitted_leaf c full fuel' t (upper_part b k p))
    | _, _ => Held s
    end.

Fixpoint fitted_tubes (c : closure) (full fuel : nat) (g : tubes) (b : box) : tubes :=
  match g with
  | Excluded => Excluded
  | NoTube => NoTube
  | Held t => fitted_leaf c full fuel t b
  | Cut k p l u => Cut k p (fitted_tubes c full fuel l (lower_part b k p))
                     (fitted_tubes c full fuel u (upper_part b k p))
  end.

Definition fitted (c : closure) (m : method) (g : tubes) : tubes :=
  match enclose_ranges (ranges (places c)) with
  | Some root => fitted_tubes c (second_order m) (deepest m) g root
  | None => g
  end.

Fixpoint all_fitted (cs : list closure) (m : method) (gs : list tubes) : list tubes :=
  match cs, gs with
  | c :: cs', g :: gs' => fitted c m g :: all_fitted cs' m gs'
  | _, _ => []
  end.

(** ** The checks *)

(** Unknowns i and j are near each other in the tubes of all these leaves. *)
Definition all_near (halvings : nat) (d : closure) (full i j : nat) (limit : expression)
    (ls : list leaf) : bool :=
  let y := range_or_none (evaluate [] limit) in
  forallb (fun u : leaf => match fst u with
    | Some t => stays_near d full i j y halvings t (snd u)
    | None => true
    end) ls.

Definition check_finite_error_within (c : closure) (errors : list nat) (i : nat)
    (limit : expression) (m : method) (g : tubes) : bool :=
  let full := second_order m in
  let d := doubled errors c in
  if is_known (evaluate [] limit) && Nat.ltb i (unknowns c) then
    match enclose_values (start d), enclose_values (map fst (near d)),
          enclose_values (map snd (near d)), enclose_ranges (ranges (places d)) with
    | Some b, Some middles, Some radii, Some root =>
        let around := around_start d middles radii (length b) in
        let h := refined d full (deepest m) (fitted d m g) in
        if check_branch_in d full around (tight_start d full b around) Kept h
        then all_near most_halvings d full i (unknowns c + i) limit (leaves_of h root)
        else false
    | _, _, _, _ => false
    end
  else false.

Lemma check_branch_tubes d full around tight w g root :
  check_branch_in d full around tight w g = true ->
  enclose_ranges (ranges (places d)) = Some root -> has_tubes_in w g root = true.
Proof.
  unfold check_branch_in. intros H R. rewrite R in H.
  destruct (enclose_values (start d)); [|discriminate].
  destruct (enclose_values (map fst (near d))); [|discriminate].
  destruct (enclose_values (map snd (near d))); [|discriminate].
  do 2 (apply andb_prop in H as [H _]). apply andb_prop in H as [_ H]. exact H.
Qed.

Lemma limit_known limit : is_known (evaluate [] limit) = true -> defined [] limit /\
  encloses (range_or_none (evaluate [] limit)) (value [] limit).
Proof.
  intros K. destruct (evaluate [] limit) as [v|] eqn:V; [|discriminate].
  exact (Threshold.threshold_known _ _ V).
Qed.

Lemma given_of_both errors c :
  ends_defined (places (doubled errors c)) /\
  length (equations (doubled errors c)) = unknowns (doubled errors c) ->
  ends_defined (places c) /\ length (equations c) = unknowns c.
Proof.
  intros [E L]. split; [exact E|]. simpl in L. unfold both in L.
  rewrite app_size, !map_size in L. lia.
Qed.

Lemma start_of_both errors c : start_defined (doubled errors c) -> start_defined c.
Proof. intros [S N]. split; [exact S|]. simpl in N. apply Forall_app in N. apply N. Qed.

(** The distance in the tube of a leaf, in which the configuration is. *)
Lemma all_near_correct halvings d full i j limit ls t b x p :
  (i < unknowns d)%nat -> (j < unknowns d)%nat -> is_known (evaluate [] limit) = true ->
  all_near halvings d full i j limit ls = true -> In (Some t, b) ls ->
  in_box b x -> in_tube (unknowns d) t x p -> solves d x p ->
  Rabs (nth i p 0 - nth j p 0) < value [] limit.
Proof.
  intros I J K H In_l B P S. unfold all_near in H. rewrite forallb_forall in H.
  specialize (H _ In_l). cbn [fst snd] in H.
  exact (stays_near_correct d full i j _ I J x p _ (proj2 (limit_known _ K)) S halvings t b H B P).
Qed.

Lemma parts_distance n i q : (i < n)%nat ->
  nth i (firstn n q) 0 - nth i (skipn n q) 0 = nth i q 0 - nth (n + i) q 0.
Proof.
  intros I. rewrite nth_firstn, nth_skipn. destruct (Nat.ltb_spec i n); [reflexivity|lia].
Qed.

Theorem check_finite_error_within_correct c errors i limit m g :
  check_finite_error_within c errors i limit m g = true -> finite_error_within c errors i limit.
Proof.
  unfold check_finite_error_within. set (full := second_order m). set (d := doubled errors c).
  intros C. destruct (is_known (evaluate [] limit) && Nat.ltb i (unknowns c)) eqn:H;
    [|discriminate]. apply andb_prop in H as [K I]. apply Nat.ltb_lt in I.
  destruct (enclose_values (start d)) as [b|]; [|discriminate].
  destruct (enclose_values (map fst (near d))) as [middles|]; [|discriminate].
  destruct (enclose_values (map snd (near d))) as [radii|]; [|discriminate].
  destruct (enclose_ranges (ranges (places d))) as [root|] eqn:R; [|discriminate].
  cbv zeta in C. set (h := refined d full (deepest m) (fitted d m g)) in *.
  destruct (check_branch_in d full _ _ Kept h) eqn:C1; [|discriminate]. rename C into C2.
  pose proof (check_branch_tubes _ _ _ _ _ _ _ C1 R) as Tu.
  apply check_branch_holds in C1 as (G & _ & root' & R' & Ct & Br & X0 & _).
  apply (is_branch_among_fewer _ (in_set (places d))) in Br;
    [|intros x X; exact (conj X Logic.I)].
  destruct Br as (Br & St & Mo).
  rewrite R in R'. injection R' as <-. destruct G as (G1 & G2 & G3).
  destruct (given_of_both errors c (conj G1 G2)) as [E L].
  set (n := unknowns c) in *. set (q := configuration d full h root) in *.
  assert (size : forall x, in_set (places c) x -> length x = length (ranges (places c)))
    by (intros x; apply lengths_in_set).
  assert (both_sets : forall x, in_set (places c) x -> in_set (places d) x).
  { intros x X. apply (set_of_both errors c L x (size x X)), X. }
  assert (S0 : length (the_start c) = length (ranges (places c))).
  { change (the_start d) with (the_start c) in X0.
    rewrite <- (proj1 X0). exact (enclose_ranges_length _ _ R). }
  destruct (parts_start errors c E L (q (the_start c)) S0 St) as [St1 St2].
  destruct (parts_move (in_set (places c)) n (solves d) (solves c)
              (fun x => solves c (without_errors errors c x)) q) as [Mo1 Mo2].
  { intros x X. apply Br, both_sets, X. }
  { intros x r X Sr. destruct (parts_solve errors c E L x (size x X) r Sr) as (P1 & _ & P2 & P3).
    auto. }
  { intros x p p0 X Sp Sp0. split; [apply Sp|].
    apply solves_both; auto; [apply Sp|apply Sp0]. }
  { intros w Cw Iw. apply Mo; [exact Cw|]. intros t. apply both_sets, Iw. }
  assert (Parts : forall x, in_set (places c) x -> _)
    by exact (fun x X => parts_hold errors c E L x (q x) (size x X) (Br x (both_sets x X))).
  split; [exact (proj1 (limit_known _ K))|]. split; [exact I|].
  split; [split; [exact E|split; [exact L|exact (start_of_both errors c G3)]]|].
  exists (fun x => firstn n (q x)), (fun x => skipn n (q x)).
  split; [|split].
  - split; [|split; [exact St1|exact Mo1]]. intros x X. apply (Parts x X).
  - split; [|split; [exact St2|exact Mo2]]. intros x X. apply (Parts x X).
  - intros x X. rewrite parts_distance by exact I.
    assert (B : in_box root x).
    { eapply enclose_ranges_correct; [exact R|]. apply (both_sets x X). }
    destruct (held_in_set d full Kept h root x Ct Tu B (both_sets x X) Logic.I)
      as [_ (t & b' & v & In_l & B' & V & Q)].
    change (configuration d full h root x) with (q x) in Q. rewrite Q.
    apply (all_near_correct most_halvings d full i (n + i) limit (leaves_of h root) t b' x);
      try assumption; try (simpl; fold n; lia).
    + exact (solution_in_tube d full t b' v x V B').
    + exact (tube_solution_solves d full t b' v x V B').
Qed.

(** Along a way. *)
Fixpoint all_join (way : list closure) : bool :=
  match way with
  | c :: ((d :: _) as later) => joins c d && all_join later
  | _ => true
  end.

Lemma all_join_correct way : Forall goes_from_0_to_1 way -> all_join way = true -> all_joined way.
Proof.
  induction way as [|c way IH]; intros Z H; [exact Logic.I|].
  destruct way as [|d way]; [exact Logic.I|]. inversion Z as [|? ? Z1 Z2]. subst.
  change (joins c d && all_join (d :: way) = true) in H. apply andb_prop in H as [H1 H2].
  split; [|exact (IH Z2 H2)]. apply joins_correct; [|exact H1].
  unfold goes_from_0_to_1 in Z1. destruct (ranges (places c)); [contradiction|discriminate].
Qed.

Definition check_finite_error_within_along (c : list expression -> closure)
    (pieces : list (list expression)) (errors : list nat) (i : nat) (limit : expression)
    (m : method) (gs : list tubes) : bool :=
  let full := second_order m in
  let way := map c pieces in
  let n := unknowns_along c pieces in
  if is_known (evaluate [] limit) && Nat.ltb i n && all_join way then
    match stretches full (deepest m) (map (doubled errors) way) (all_kept pieces)
            (all_fitted (map (doubled errors) way) m gs) with
    | Some l =>
        if check_stretches full l then
          forallb (fun s =>
            all_near most_halvings (mechanism s) full i (n + i) limit (leaves_on s)) l
        else false
    | None => false
    end
  else false.

Section Along.
  Variables (errors : list nat) (way : list closure) (n : nat) (q : list R -> list R).
  Let both_ways := map (doubled errors) way.
  Hypothesis is_way_of_both : is_way both_ways.
  Hypothesis same_unknowns : forall c, In c way -> unknowns c = n.
  Hypothesis branch : is_branch_along both_ways q.

  Lemma pieces_are c : In c way ->
    ends_defined (places c) /\ length (equations c) = unknowns c /\ goes_from_0_to_1 c.
  Proof.
    intros I. destruct is_way_of_both as (_ & F & _). rewrite Forall_forall in F.
    destruct (F _ (in_map (doubled errors) _ _ I)) as (E & L & Z).
    destruct (given_of_both errors c (conj E L)). auto.
  Qed.

  Lemma on_both x k c : is_on way x k c -> is_on both_ways x k (doubled errors c) /\
    In c way /\ length (on_piece k x) = length (ranges (places c)).
  Proof.
    intros [N S]. pose proof (nth_error_In _ _ N) as I. destruct (pieces_are c I) as (E & L & _).
    pose proof (lengths_in_set c _ S) as Z. split; [|auto]. split.
    - unfold both_ways. rewrite nth_error_map, N. reflexivity.
    - apply (set_of_both errors c L _ Z), S.
  Qed.

  Lemma on_one x k d : is_on both_ways x k d -> exists c, d = doubled errors c /\ is_on way x k c.
  Proof.
    intros [N S]. unfold both_ways in N. rewrite nth_error_map in N.
    destruct (nth_error way k) as [c|] eqn:M; [|discriminate]. injection N as <-.
    exists c. split; [reflexivity|]. split; [exact M|].
    destruct (pieces_are c (nth_error_In _ _ M)) as (E & L & _).
    apply (set_of_both errors c L); [|exact S]. exact (pairs_length _ _ _ (proj1 S)).
  Qed.

  Lemma parts_along : length (match way with c :: _ => the_start c | [] => [] end)
      = length (match way with c :: _ => ranges (places c) | [] => [] end) ->
    is_branch_along way (fun x => firstn n (q x)) /\
    is_branch_along_at (without_errors errors) way (fun x => skipn n (q x)).
  Proof.
    intros S0. destruct branch as (Br & St & Mo).
    assert (Parts : forall x k c, is_on way x k c ->
      let y := on_piece k x in let z := without_errors errors c y in
      (solves c y (firstn n (q x)) /\ has_values c y (firstn n (q x)) /\
       regular_at c y (firstn n (q x))) /\
      solves c z (skipn n (q x)) /\ has_values c z (skipn n (q x)) /\
      regular_at c z (skipn n (q x))).
    { intros x k c O. destruct (on_both x k c O) as (O2 & I & Z).
      destruct (pieces_are c I) as (E & L & _). pose proof (same_unknowns c I) as <-.
      exact (parts_hold errors c E L _ (q x) Z (Br x k _ O2)). }
    destruct (parts_move (fun x => exists k c, is_on way x k c) n
      (fun x r => forall k d, is_on both_ways x k d -> solves d (on_piece k x) r)
      (fun x r => forall k c, is_on way x k c -> solves c (on_piece k x) r)
      (fun x r => forall k c, is_on way x k c ->
         solves c (without_errors errors c (on_piece k x)) r) q) as [Mo1 Mo2].
    { intros x _ k d D. apply (Br x k d D). }
    { intros x r (k & c & O) H.
      assert (Every : forall k c, is_on way x k c ->
        length (firstn n r) = n /\ firstn n r ++ skipn n r = r /\
        solves c (on_piece k x) (firstn n r) /\
        solves c (without_errors errors c (on_piece k x)) (skipn n r)).
      { intros k' c' O'. destruct (on_both x k' c' O') as (O2 & I & Z).
        destruct (pieces_are c' I) as (E & L & _). pose proof (same_unknowns c' I) as <-.
        destruct (parts_solve errors c' E L _ Z r (H k' _ O2)) as (P1 & _ & P2 & P3). auto. }
      destruct (Every k c O) as (L1 & E1 & _). split; [exact L1|]. split; [exact E1|].
      split; intros k' c' O'; apply (Every k' c' O'). }
    { intros x p p0 (k & c & O) H H0.
      assert (Lp : length p = n).
      { rewrite <- (same_unknowns c (nth_error_In _ _ (proj1 O))). apply (H k c O). }
      split; [exact Lp|]. intros k' d D. destruct (on_one x k' d D) as (c' & -> & O').
      destruct (on_both x k' c' O') as (_ & I & Z). destruct (pieces_are c' I) as (E & L & _).
      pose proof (same_unknowns c' I) as <-.
      apply (solves_both errors c' E L _ Z p p0 Lp); [apply (H0 k' c' O')|].
      split; [exact (H k' c' O')|exact (H0 k' c' O')]. }
    { intros w Cw Iw. destruct (Mo w Cw) as [D U].
      - intros t. destruct (Iw t) as (k & c & O). destruct (on_both _ k c O) as (O2 & _). eauto.
      - split; [exact D|]. intros r Cr Sr. apply U; [exact Cr|].
        intros t k d O. exact (Sr t k d O). }
    assert (Start : forall c later, way = c :: later ->
      (forall r, solves c (the_start c) r /\ is_near c r <-> r = firstn n (q (the_start c))) /\
      forall r, solves c (without_errors errors c (the_start c)) r /\ is_near c r
        <-> r = skipn n (q (the_start c))).
    { intros c later W. unfold both_ways in St. rewrite W in St, S0.
      assert (I : In c way) by (rewrite W; left; reflexivity).
      destruct (pieces_are c I) as (E & L & _). pose proof (same_unknowns c I) as <-.
      exact (parts_start errors c E L _ S0 St). }
    assert (Some_piece : way <> [])
      by (unfold both_ways in St; destruct way; [elim St|discriminate]).
    split; (split; [intros x k c O; apply (Parts x k c O)|split]).
    - destruct way as [|c later]; [contradiction|apply (Start c later eq_refl)].
    - intros w Cw Iw. destruct (Mo1 w Cw Iw) as [D U]. split; [exact D|].
      intros r Cr Sr. apply U; [exact Cr|exact Sr].
    - destruct way as [|c later]; [contradiction|apply (Start c later eq_refl)].
    - intros w Cw Iw. destruct (Mo2 w Cw Iw) as [D U]. split; [exact D|].
      intros r Cr Sr. apply U; [exact Cr|exact Sr].
  Qed.
End Along.

Lemma check_stretches_start full l : are_enclosed l -> check_stretches full l = true ->
  match map mechanism l with
  | d :: _ => length (the_start d) = length (ranges (places d))
  | [] => True
  end.
Proof.
  intros E H. destruct l as [|s later]; [exact Logic.I|]. unfold check_stretches in H.
  destruct (enclose_values (start (mechanism s))) as [b|]; [|discriminate].
  destruct (enclose_values (map fst (near (mechanism s)))) as [middles|]; [|discriminate].
  destruct (enclose_values (map snd (near (mechanism s)))) as [radii|]; [|discriminate].
  do 3 (apply andb_prop in H as [H _]).
  apply check_branch_holds in H as (_ & _ & b0 & R & _ & _ & X0 & _). simpl.
  rewrite <- (proj1 X0). exact (enclose_ranges_length _ _ R).
Qed.

Theorem check_finite_error_within_along_correct c pieces errors i limit m gs :
  check_finite_error_within_along c pieces errors i limit m gs = true ->
  finite_error_within_along c pieces errors i limit.
Proof.
  unfold check_finite_error_within_along. set (full := second_order m). set (way := map c pieces).
  set (n := unknowns_along c pieces). intros C.
  destruct (is_known (evaluate [] limit) && Nat.ltb i n && all_join way) eqn:H; [|discriminate].
  apply andb_prop in H as [H J]. apply andb_prop in H as [K I]. apply Nat.ltb_lt in I.
  destruct (stretches full (deepest m) (map (doubled errors) way) _ _) as [l|] eqn:L;
    [|discriminate].
  destruct (check_stretches full l) eqn:C1; [|discriminate]. rename C into C2.
  apply stretches_correct in L as (M & Kw & E).
  pose proof (check_stretches_start full l E C1) as S0.
  apply (check_stretches_correct _ _ E) in C1 as (W & _ & B & others & n2 & Kl & Li).
  assert (MW : map (doubled errors) way = map (fun piece => doubled errors (c piece)) pieces)
    by (unfold way; apply map_map).
  assert (U2 : forall s, In s l -> unknowns (mechanism s) = n2).
  { intros s Is. exact (has_unknowns _ _ _ s (are_pieces full l others n2 E Kl s Is)). }
  assert (U : forall d, In d way -> unknowns d = n).
  { assert (T : forall d, In d way -> (unknowns d + unknowns d = n2)%nat).
    { intros d D. apply (in_map (doubled errors)) in D. rewrite <- M in D.
      apply in_map_iff in D as (s & Es & Is). rewrite <- (U2 s Is), Es. reflexivity. }
    intros d D. pose proof (T d D). unfold n, unknowns_along. fold way.
    destruct way as [|e later]; [destruct D|]. pose proof (T e (or_introl eq_refl)). lia. }
  rewrite M in W, B, S0. rewrite Kw, MW in B. apply branch_of_all_kept in B. rewrite <- MW in B.
  assert (Pieces : forall d, In d way -> _) by exact (pieces_are errors way W).
  unfold finite_error_within_along. fold way.
  split; [exact (proj1 (limit_known _ K))|]. split; [exact I|]. split.
  { split; [|split].
    - destruct W as (W & _). destruct way; [exact W|]. exact (start_of_both errors _ W).
    - apply Forall_forall. exact Pieces.
    - apply all_join_correct; [|exact J]. apply Forall_forall. intros d D. apply (Pieces d D). }
  exists (fun x => firstn n (along full 0 l x)), (fun x => skipn n (along full 0 l x)).
  destruct (parts_along errors way n (along full 0 l) W U B) as [P1 P2].
  { destruct way; [reflexivity|exact S0]. }
  split; [exact P1|]. split; [exact P2|]. intros x k d D. rewrite parts_distance by exact I.
  destruct (on_both errors way W x k d D) as (D2 & In_d & _). rewrite MW in D2.
  apply on_all_kept in D2. rewrite <- MW, <- M, <- Kw in D2.
  destruct (along_on_piece full l others n2 E Kl Li x k _ D2)
    as (s & t & b & v & N & Es & In_l & Bx & _ & V & ->).
  pose proof (nth_error_In _ _ N) as In_s. rewrite forallb_forall in C2.
  specialize (C2 s In_s). rewrite Es in C2.
  apply (all_near_correct most_halvings (doubled errors d) full i (n + i) limit (leaves_on s) t b
           (on_piece k x)); try assumption; try (simpl; rewrite (U d In_d); lia).
  - exact (solution_in_tube (doubled errors d) full t b v _ V Bx).
  - exact (tube_solution_solves (doubled errors d) full t b v _ V Bx).
Qed.
