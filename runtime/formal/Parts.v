(* SPDX-License-Identifier: Apache-2.0 *)
(** Parts of a set: some are kept, and the others are left out. A theorem about a paving is about
    the points of the parts that are kept. *)
From Coq Require Import Reals Lra Lia List Bool.
From Interval Require Import Real.Xreal.
From Regulus Require Import Intervals Boxes.
Import ListNotations.
Open Scope R_scope.

Inductive parts :=
  | Kept      (** the theorem is about this part *)
  | LeftOut   (** it says nothing about this part *)
  | Parted (variable : nat) (place : F.type) (lower upper : parts).

(** The point x is in a part that is kept. Its variables are numbered from 0. Where a set is parted,
    the place itself belongs to the lower part. *)
Fixpoint is_kept (w : parts) (x : list R) : Prop :=
  match w with
  | Kept => True
  | LeftOut => False
  | Parted k p l u => if Rle_dec (nth k x 0) (real_of p) then is_kept l x else is_kept u x
  end.

(** ** The boxes of the parts that are kept *)

Fixpoint kept_boxes (w : parts) (b : box) : list box :=
  match w with
  | Kept => [b]
  | LeftOut => []
  | Parted k p l u => kept_boxes l (lower_part b k p) ++ kept_boxes u (upper_part b k p)
  end.

Lemma kept_boxes_correct w : forall b x, in_box b x -> is_kept w x ->
  exists c, In c (kept_boxes w b) /\ in_box c x.
Proof.
  induction w as [| |k p l IHl u IHu]; intros b x B W; simpl in W |- *.
  - exists b. auto.
  - contradiction.
  - destruct (Rle_dec (nth k x 0) (real_of p)) as [L|L].
    + destruct (IHl _ x (in_lower_part b k p x B L) W) as (c & I & C).
      exists c. split; [apply in_or_app; left; exact I|exact C].
    + destruct (IHu _ x (in_upper_part b k p x B L) W) as (c & I & C).
      exists c. split; [apply in_or_app; right; exact I|exact C].
Qed.

(** The parts keep each point of the box. *)
Fixpoint keeps_all (w : parts) (b : box) : bool :=
  match w with
  | Kept => true
  | LeftOut => false
  | Parted k p l u =>
      let i := subtract (nth k b I.nai) (point p) in
      (is_positive i || keeps_all l b) && (is_not_positive i || keeps_all u b)
  end.

Lemma keeps_all_correct w b x : keeps_all w b = true -> in_box b x -> is_kept w x.
Proof.
  intros H B. induction w as [| |k p l IHl u IHu]; simpl in H |- *; [auto|discriminate|].
  apply andb_prop in H as [L U].
  pose proof (subtract_encloses _ _ _ _ (proj2 B k) (point_encloses p)) as E.
  destruct (Rle_dec (nth k x 0) (real_of p)).
  - apply orb_prop in L as [L|L]; [|exact (IHl L)]. pose proof (is_positive_correct _ _ L E). lra.
  - apply orb_prop in U as [U|U]; [|exact (IHu U)].
    pose proof (is_not_positive_correct _ _ U E). lra.
Qed.

(** ** Both sides of a cut *)

Fixpoint keeps_some (w : parts) : bool :=
  match w with
  | Kept => true
  | LeftOut => false
  | Parted _ _ l u => keeps_some l || keeps_some u
  end.

Definition is_at_most (p q : F.type) : bool :=
  F.real p && F.real q && match F.cmp p q with Xlt | Xeq => true | _ => false end.

(** The parts of w on one side of a cut of variable k at p. *)
Fixpoint lower_side (w : parts) (k : nat) (p : F.type) : parts :=
  match w with
  | Parted j q l u => if Nat.eqb j k && is_at_most p q then lower_side l k p
                      else Parted j q (lower_side l k p) (lower_side u k p)
  | _ => w
  end.

Fixpoint upper_side (w : parts) (k : nat) (p : F.type) : parts :=
  match w with
  | Parted j q l u => if Nat.eqb j k && is_at_most q p then upper_side u k p
                      else Parted j q (upper_side l k p) (upper_side u k p)
  | _ => w
  end.

Lemma keeps_some_correct w x : is_kept w x -> keeps_some w = true.
Proof.
  induction w as [| |k p l IHl u IHu]; simpl; [auto|contradiction|]. intros H. apply orb_true_iff.
  destruct (Rle_dec (nth k x 0) (real_of p)); [left; exact (IHl H)|right; exact (IHu H)].
Qed.

Lemma is_at_most_correct p q : is_at_most p q = true -> real_of p <= real_of q.
Proof.
  unfold is_at_most, real_of. intros H. apply andb_prop in H as [H C].
  apply andb_prop in H as [P Q]. rewrite F.cmp_correct in C.
  rewrite (F.classify_correct p) in P. rewrite (F.classify_correct q) in Q.
  pose proof (F.classify_correct p) as P'. pose proof (F.classify_correct q) as Q'.
  destruct (F.classify p); try discriminate. destruct (F.classify q); try discriminate.
  rewrite F.real_correct in P', Q'.
  destruct (F.toX p) as [|a]; [discriminate|]. destruct (F.toX q) as [|b]; [discriminate|].
  simpl in C |- *. destruct (Raux.Rcompare_spec a b); [lra|lra|discriminate].
Qed.

Lemma lower_side_correct w k p x : nth k x 0 <= real_of p -> is_kept w x ->
  is_kept (lower_side w k p) x.
Proof.
  intros L. induction w as [| |j q l IHl u IHu]; simpl; auto. intros H.
  destruct (Nat.eqb j k && is_at_most p q) eqn:E.
  - apply andb_prop in E as [K E]. apply Nat.eqb_eq in K as ->. apply is_at_most_correct in E.
    destruct (Rle_dec (nth k x 0) (real_of q)); [exact (IHl H)|lra].
  - simpl. destruct (Rle_dec (nth j x 0) (real_of q)); [exact (IHl H)|exact (IHu H)].
Qed.

Lemma upper_side_correct w k p x : ~ nth k x 0 <= real_of p -> is_kept w x ->
  is_kept (upper_side w k p) x.
Proof.
  intros L. induction w as [| |j q l IHl u IHu]; simpl; auto. intros H.
  destruct (Nat.eqb j k && is_at_most q p) eqn:E.
  - apply andb_prop in E as [K E]. apply Nat.eqb_eq in K as ->. apply is_at_most_correct in E.
    destruct (Rle_dec (nth k x 0) (real_of q)); [lra|exact (IHu H)].
  - simpl. destruct (Rle_dec (nth j x 0) (real_of q)); [exact (IHl H)|exact (IHu H)].
Qed.
