(* SPDX-License-Identifier: Apache-2.0 *)
(** Boxes: an interval for each variable, and the coordinates of a point in it. *)
From Coq Require Import Reals Lra Lia List PArith Bool.
From Coq Require PrimFloat.
From Regulus Require Import Expressions Intervals Forms Evaluation.
Import ListNotations.
Open Scope R_scope.

Definition box := list interval.

Definition in_box (b : box) (x : list R) : Prop :=
  length b = length x /\ forall k, encloses (nth k b I.nai) (nth k x 0).

(** The k-th variable is m + r t with |t| <= 1. Any m and r would do: [varies] checks them. *)
Definition middle (i : interval) : F.type := I.midpoint i.
Definition radius (i : interval) : F.type :=
  let m := middle i in
  let r := PrimFloat.sub (I.upper i) m in
  let s := PrimFloat.sub m (I.lower i) in
  PrimFloat.mul (if PrimFloat.ltb r s then s else r) (Nat.iter 8 PrimFloat.next_up PrimFloat.one).

Definition scaled (i : interval) : interval :=
  divide (subtract i (point (middle i))) (point (radius i)).

Definition varies (i : interval) : bool :=
  is_positive (point (radius i)) && is_not_positive (subtract (scaled i) one)
  && is_not_negative (add (scaled i) one).

Definition number_of (k : positive) : nat := pred (Pos.to_nat k).

Definition coordinate (b : box) (x : list R) (k : positive) : R :=
  let i := nth (number_of k) b I.nai in
  if varies i then (nth (number_of k) x 0 - real_of (middle i)) / real_of (radius i) else 0.

Lemma varies_bounds i x : varies i = true -> encloses i x ->
  real_of (radius i) <> 0 /\ Rabs ((x - real_of (middle i)) / real_of (radius i)) <= 1.
Proof.
  unfold varies. intros H X. apply andb_prop in H as [H B]. apply andb_prop in H as [P A].
  pose proof (is_positive_correct _ _ P (point_encloses _)) as R.
  assert (S : encloses (scaled i) ((x - real_of (middle i)) / real_of (radius i))).
  { apply divide_encloses; [lra| |apply point_encloses].
    apply subtract_encloses; [exact X|apply point_encloses]. }
  split; [lra|]. apply Rabs_le. split.
  - pose proof (is_not_negative_correct _ _ B (add_encloses _ _ _ _ S (integer_encloses 1))). lra.
  - pose proof (is_not_positive_correct _ _ A (subtract_encloses _ _ _ _ S (integer_encloses 1))).
    lra.
Qed.

Lemma coordinate_in_unit_box b x : in_box b x -> in_unit_box (coordinate b x).
Proof.
  intros [_ B] k. unfold coordinate. destruct varies eqn:V; [|rewrite Rabs_R0; lra].
  apply varies_bounds; [exact V|apply B].
Qed.

(** The first [full] variables are kept to the second order, the others to the first order. *)
Definition variable (full k : nat) (i : interval) : option enclosure :=
  Some (if varies i then
    let t := [([Pos.of_succ_nat k], point (radius i))] in
    let m := point (middle i) in
    Enclosure i (if Nat.ltb k full then Form m t [] [] else Form m [] [] t)
  else enclose_constant i).

Fixpoint variables_from (full k : nat) (b : box) : list (option enclosure) :=
  match b with [] => [] | i :: l => variable full k i :: variables_from full (S k) l end.

Definition variables (full : nat) (b : box) : list (option enclosure) := variables_from full 0 b.

Lemma variables_from_nth full b : forall j k, nth k (variables_from full j b) None =
  if Nat.ltb k (length b) then variable full (j + k) (nth k b I.nai) else None.
Proof.
  induction b as [|i b IH]; intros j k; simpl; [destruct k; reflexivity|].
  destruct k; simpl; [rewrite Nat.add_0_r; reflexivity|]. rewrite IH.
  replace (j + S k)%nat with (S j + k)%nat by lia. reflexivity.
Qed.

Lemma variables_known full b x : in_box b x -> known (coordinate b x) (variables full b) x.
Proof.
  intros B. split.
  - rewrite <- (proj1 B). unfold variables. generalize 0%nat.
    induction b; intros j; simpl; [reflexivity|]. f_equal. clear - b.
    revert j. induction b; intros j; simpl; [reflexivity|]. f_equal. apply IHb.
  - intros k v E. unfold variables in E. rewrite variables_from_nth in E.
    destruct (Nat.ltb k (length b)); [|discriminate]. simpl in E. injection E as <-.
    set (i := nth k b I.nai). assert (X : encloses i (nth k x 0)) by apply B.
    destruct (varies i) eqn:V; [|apply enclose_constant_represents, X].
    split; [exact X|]. simpl.
    destruct (varies_bounds i _ V X) as [R _].
    assert (C : coordinate b x (Pos.of_succ_nat k)
                = (nth k x 0 - real_of (middle i)) / real_of (radius i)).
    { unfold coordinate, number_of. rewrite SuccNat2Pos.id_succ. simpl. fold i. rewrite V.
      reflexivity. }
    assert (T : terms_enclose (coordinate b x) [([Pos.of_succ_nat k], point (radius i))]
                  (nth k x 0 - real_of (middle i))).
    { eapply terms_equal; [constructor; [apply point_encloses|constructor]|].
      simpl. rewrite C. field. exact R. }
    destruct (Nat.ltb k full).
    + exists (real_of (middle i)), (nth k x 0 - real_of (middle i)), 0, 0.
      repeat split; try constructor; [apply point_encloses|exact T|ring].
    + exists (real_of (middle i)), 0, 0, (nth k x 0 - real_of (middle i)).
      repeat split; try constructor; [apply point_encloses|exact T|ring].
Qed.

(** ** Parts of a box *)

Fixpoint replace {A} (k : nat) (y : A) (l : list A) : list A :=
  match l, k with
  | [], _ => []
  | _ :: l', O => y :: l'
  | x :: l', S k' => x :: replace k' y l'
  end.

Lemma replace_length {A} k (y : A) l : length (replace k y l) = length l.
Proof. revert k. induction l; intros [|k]; simpl; auto. Qed.

Lemma replace_nth {A} k n (y z : A) l :
  nth n (replace k y l) z = if Nat.eqb n k then (if Nat.ltb k (length l) then y else z)
                            else nth n l z.
Proof.
  revert k n. induction l; intros k n; simpl.
  - destruct k, n; simpl; try reflexivity; destruct (Nat.eqb _ _); reflexivity.
  - destruct k, n; simpl; auto; rewrite IHl; reflexivity.
Qed.

Lemma in_box_replace b x k i :
  in_box b x -> encloses i (nth k x 0) -> in_box (replace k i b) x.
Proof.
  intros [L B] X. split; [rewrite replace_length; exact L|].
  intros n. rewrite replace_nth. destruct (Nat.eqb_spec n k) as [->|]; [|apply B].
  destruct (Nat.ltb_spec k (length b)); [exact X|].
  rewrite <- (nth_overflow b I.nai (n := k)) by assumption. apply B.
Qed.

Definition lower_part (b : box) (k : nat) (c : F.type) : box :=
  replace k (I.meet (nth k b I.nai) (I.lower_extent (point c))) b.
Definition upper_part (b : box) (k : nat) (c : F.type) : box :=
  replace k (I.meet (nth k b I.nai) (I.upper_extent (point c))) b.

Lemma in_lower_part b k p x : in_box b x -> nth k x 0 <= real_of p -> in_box (lower_part b k p) x.
Proof.
  intros B L. apply in_box_replace; [exact B|]. apply meet_encloses; [apply B|].
  exact (I.lower_extent_correct _ _ _ (point_encloses p) L).
Qed.

Lemma in_upper_part b k p x :
  in_box b x -> ~ nth k x 0 <= real_of p -> in_box (upper_part b k p) x.
Proof.
  intros B L. apply in_box_replace; [exact B|]. apply meet_encloses; [apply B|].
  refine (I.upper_extent_correct _ _ _ (point_encloses p) _). lra.
Qed.

Lemma parts_cover b x k c :
  in_box b x -> in_box (lower_part b k c) x \/ in_box (upper_part b k c) x.
Proof.
  intros B. destruct (Rle_dec (nth k x 0) (real_of c)) as [L|L].
  - left. exact (in_lower_part b k c x B L).
  - right. exact (in_upper_part b k c x B L).
Qed.
