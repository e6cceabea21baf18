(* SPDX-License-Identifier: Apache-2.0 *)
(** The geometry of an arm in real numbers, and how a theorem about its Jacobian follows from one
    about the question of a certificate. The definitions are those to read: parts, joints, the
    Jacobian. *)
From Coq Require Import QArith Qreals Lra Lia.
From Regulus Require Export Geometry.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Questions Regularity Determinants Forces.

(** ** Parts of an arm *)

Definition times (c : R) (u : point) : point := let '(a, b, d) := u in (c * a, c * b, c * d).
Definition at_origin : point := (0, 0, 0).

Inductive axis : Type := x_axis | y_axis | z_axis | opposite (a : axis).

Fixpoint unit_vector (a : axis) : point :=
  match a with
  | x_axis => (1, 0, 0)
  | y_axis => (0, 1, 0)
  | z_axis => (0, 0, 1)
  | opposite b => times (-1) (unit_vector b)
  end.

Fixpoint turned (a : axis) (t : R) (u : point) : point :=
  match a with
  | x_axis => about_x t u
  | y_axis => about_y t u
  | z_axis => about_z t u
  | opposite b => turned b (- t) u
  end.

(** An arm is a list of parts from the base to the tool. Each moves the frame of all later ones: by
    a vector; by an angle about an axis; along and about x, or z, as Denavit and Hartenberg do.
    A joint turns about an axis by an angle, or slides along one. Its number is that of a column of
    the Jacobian. A follower has the number of the joint that it follows, and moves so many times as
    fast. *)
Inductive part : Type :=
  | shift_by (v : point)
  | turn_by (a : axis) (angle : R)
  | along_x (a alpha : R)
  | along_z (d theta : R)
  | revolute (number : nat) (a : axis) (angle : R)
  | prismatic (number : nat) (a : axis) (length : R)
  | follower (rate : R) (joint : part).

(** From coordinates in the frame behind a part to those in the frame before it. *)
Fixpoint move (p : part) (u : point) : point :=
  match p with
  | shift_by v => plus v u
  | turn_by a angle => turned a angle u
  | along_x a alpha => plus (a, 0, 0) (about_x alpha u)
  | along_z d theta => plus (0, 0, d) (about_z theta u)
  | revolute _ a angle => turned a angle u
  | prismatic _ a length => plus (times length (unit_vector a)) u
  | follower _ joint => move joint u
  end.

(** ** The Jacobian *)

(** The velocity of a point, and the angular velocity. *)
Definition twist : Type := point * point.
Definition faster (c : R) (t : twist) : twist := (times c (fst t), times c (snd t)).

(** The frame before a joint is at [F]: a function from coordinates in it to those in the base. The
    joint at unit speed gives the point [P] and the links behind it this twist, which belongs to the
    column of this number. *)
Fixpoint twist_of (F : point -> point) (P : point) (p : part) : list (nat * twist) :=
  match p with
  | revolute number a _ =>
      let z := minus (F (unit_vector a)) (F at_origin) in
      [(number, (cross z (minus P (F at_origin)), z))]
  | prismatic number a _ => [(number, (minus (F (unit_vector a)) (F at_origin), at_origin))]
  | follower rate joint => map (fun t => (fst t, faster rate (snd t))) (twist_of F P joint)
  | _ => []
  end.

Fixpoint twists (F : point -> point) (P : point) (arm : list part) : list (nat * twist) :=
  match arm with
  | [] => []
  | p :: rest => twist_of F P p ++ twists (fun u => F (move p u)) P rest
  end.

(** Where the origin of the last frame is. *)
Fixpoint end_of (arm : list part) : point :=
  match arm with [] => at_origin | p :: rest => move p (end_of rest) end.

Definition coordinates_of (t : twist) : list R :=
  [first (fst t); second (fst t); third (fst t); first (snd t); second (snd t); third (snd t)].

(** The sum of the twists of this number. *)
Fixpoint row_of_column (i number : nat) (l : list (nat * twist)) : R :=
  match l with
  | [] => 0
  | (k, t) :: rest =>
      (if Nat.eqb k number then nth i (coordinates_of t) 0 else 0) + row_of_column i number rest
  end.

(** Six rows: the velocity of the end of the arm, then the angular velocity of its last link. A
    column for each number, the first being 1. *)
Definition jacobian (arm : list part) (i j : nat) : R :=
  row_of_column i (S j) (twists (fun u => u) (end_of arm) arm).

(** The columns depend on each other: some motion of the joints does not move the tool. *)
Definition columns_depend (m n : nat) (a : nat -> nat -> R) : Prop :=
  exists y : nat -> R,
    (forall i, (i < m)%nat -> sum n (fun j => a i j * y j) = 0) /\
    exists j, (j < n)%nat /\ y j <> 0.

(** The rows are independent: the tool can move in every direction. *)
Definition full_row_rank (m n : nat) (a : nat -> nat -> R) : Prop :=
  full_column_rank n m (fun i j => a j i).

(** From coordinates in the frame behind the first [k] parts to those in the base. *)
Fixpoint behind (k : nat) (arm : list part) (u : point) : point :=
  match k, arm with S m, p :: rest => move p (behind m rest u) | _, _ => u end.

Definition dot (u v : point) : R := first u * first v + second u * second v + third u * third v.

(** The components of a vector along the three axes of a frame. *)
Definition components (F : point -> point) (v : point) : point :=
  let along u := dot (minus (F u) (F at_origin)) v in
  (along (1, 0, 0), along (0, 1, 0), along (0, 0, 1)).

Definition along_axes (F : point -> point) (t : twist) : twist :=
  (components F (fst t), components F (snd t)).

(** The Jacobian as seen from the frame behind the first [k] parts: the velocity of that point of
    the last link which is at the point [Q] of this frame, and the angular velocity, by components
    along the axes of this frame. *)
Definition jacobian_seen (k : nat) (Q : point) (arm : list part) (i j : nat) : R :=
  let F := behind k arm in
  row_of_column i (S j)
    (map (fun t => (fst t, along_axes F (snd t))) (twists (fun u => u) (F Q) arm)).

(** The numbers of its rows, and the matrix of some of them. *)
Definition v_x : nat := 0.
Definition v_y : nat := 1.
Definition v_z : nat := 2.
Definition w_x : nat := 3.
Definition w_y : nat := 4.
Definition w_z : nat := 5.
Definition rows_of (rows : list nat) (a : nat -> nat -> R) (i j : nat) : R :=
  a (nth i rows 0%nat) j.

(** ** Rigid motions *)

Lemma same_point (a b c d e f : R) : a = d -> b = e -> c = f -> (a, b, c) = (d, e, f).
Proof. intros; subst; reflexivity. Qed.

Ltac by_coordinates :=
  repeat match goal with u : point |- _ => destruct u as [[? ?] ?] end;
  cbv [plus minus times cross at_origin first second third fst snd about_x about_y about_z];
  apply same_point; ring.

Record rotation (r : point -> point) : Prop := {
  of_sum : forall u v, r (plus u v) = plus (r u) (r v);
  of_multiple : forall c u, r (times c u) = times c (r u);
  of_product : forall u v, r (cross u v) = cross (r u) (r v) }.

Lemma rotation_ext r s : (forall u, r u = s u) -> rotation r -> rotation s.
Proof. intros E [A B C]. split; intros; rewrite <- !E; auto. Qed.

Lemma rotations_follow r s : rotation r -> rotation s -> rotation (fun u => r (s u)).
Proof.
  intros [A B C] [D E F]. split; intros.
  - rewrite D, A. reflexivity.
  - rewrite E, B. reflexivity.
  - rewrite F, C. reflexivity.
Qed.

Lemma no_turn : rotation (fun u => u).
Proof. split; reflexivity. Qed.

Lemma pythagoras t : sin t ^ 2 = 1 - cos t ^ 2.
Proof. pose proof (sin2_cos2 t) as H. unfold Rsqr in H. nra. Qed.

Ltac by_pythagoras t :=
  repeat match goal with u : point |- _ => destruct u as [[? ?] ?] end;
  cbv [plus minus times cross at_origin first second third fst snd about_x about_y about_z];
  pose proof (pythagoras t) as E; apply same_point; ring [E].

Lemma rotation_x t : rotation (about_x t).
Proof. split; intros; by_pythagoras t. Qed.
Lemma rotation_y t : rotation (about_y t).
Proof. split; intros; by_pythagoras t. Qed.
Lemma rotation_z t : rotation (about_z t).
Proof. split; intros; by_pythagoras t. Qed.
Lemma back_x t u : about_x t (about_x (- t) u) = u.
Proof. unfold about_x. destruct u as [[? ?] ?]. rewrite cos_neg, sin_neg. by_pythagoras t. Qed.
Lemma back_y t u : about_y t (about_y (- t) u) = u.
Proof. unfold about_y. destruct u as [[? ?] ?]. rewrite cos_neg, sin_neg. by_pythagoras t. Qed.
Lemma back_z t u : about_z t (about_z (- t) u) = u.
Proof. unfold about_z. destruct u as [[? ?] ?]. rewrite cos_neg, sin_neg. by_pythagoras t. Qed.

Lemma turned_rotation a : forall t, rotation (turned a t).
Proof.
  induction a; intros t; [apply rotation_x|apply rotation_y|apply rotation_z|apply IHa].
Qed.

Lemma turned_back a : forall t u, turned a t (turned a (- t) u) = u.
Proof.
  induction a; intros t u; [apply back_x|apply back_y|apply back_z|apply IHa].
Qed.

Lemma turned_axis a : forall t, turned a t (unit_vector a) = unit_vector a.
Proof.
  induction a; intros t.
  - cbv [turned unit_vector]. by_coordinates.
  - cbv [turned unit_vector]. by_coordinates.
  - cbv [turned unit_vector]. by_coordinates.
  - simpl. rewrite (of_multiple _ (turned_rotation _ _)), IHa. reflexivity.
Qed.

Lemma of_origin r : rotation r -> r at_origin = at_origin.
Proof.
  intros H. replace at_origin with (times 0 at_origin) by (by_coordinates).
  rewrite (of_multiple _ H). destruct (r at_origin) as [[a b] c]. by_coordinates.
Qed.

Lemma minus_times u v : minus u v = plus u (times (-1) v).
Proof. by_coordinates. Qed.

Lemma of_difference r u v : rotation r -> r (minus u v) = minus (r u) (r v).
Proof. intros H. rewrite !minus_times, (of_sum _ H), (of_multiple _ H). reflexivity. Qed.

(** A rotation, and then a translation. *)
Definition rigid (F r : point -> point) : Prop :=
  rotation r /\ forall u, F u = plus (F at_origin) (r u).

Lemma rigid_difference F r u v : rigid F r -> minus (F u) (F v) = r (minus u v).
Proof.
  intros [H E]. rewrite (E u), (E v), of_difference by exact H.
  generalize (F at_origin) (r u) (r v). intros. by_coordinates.
Qed.

Lemma rigid_follow F r G s : rigid F r -> rigid G s -> rigid (fun u => F (G u)) (fun u => r (s u)).
Proof.
  intros [H E] [K D]. split; [exact (rotations_follow r s H K)|]. intros u.
  rewrite (E (G u)), (E (G at_origin)), (D u), (of_sum _ H).
  generalize (F at_origin) (r (G at_origin)) (r (s u)). intros. by_coordinates.
Qed.

(** The rotation of a part. *)
Fixpoint spin (p : part) (u : point) : point :=
  match p with
  | turn_by a angle | revolute _ a angle => turned a angle u
  | along_x _ angle => about_x angle u
  | along_z _ angle => about_z angle u
  | follower _ joint => spin joint u
  | _ => u
  end.

Fixpoint reverse (p : part) : part :=
  match p with
  | shift_by v => shift_by (times (-1) v)
  | turn_by a angle => turn_by a (- angle)
  | along_x a angle => along_x (- a) (- angle)
  | along_z d angle => along_z (- d) (- angle)
  | revolute k a angle => revolute k a (- angle)
  | prismatic k a length => prismatic k a (- length)
  | follower rate joint => follower rate (reverse joint)
  end.

Lemma spin_rotation p : rotation (spin p).
Proof.
  induction p; simpl;
    try apply no_turn; try apply turned_rotation; try apply rotation_x; try apply rotation_z.
  exact IHp.
Qed.

Lemma part_rigid p : rigid (move p) (spin p).
Proof.
  split; [apply spin_rotation|]. induction p; intros u; simpl.
  - by_coordinates.
  - rewrite of_origin by apply turned_rotation. generalize (turned a angle u). intros.
    by_coordinates.
  - by_coordinates.
  - by_coordinates.
  - rewrite of_origin by apply turned_rotation. generalize (turned a angle u). intros.
    by_coordinates.
  - generalize (unit_vector a). intros. by_coordinates.
  - apply IHp.
Qed.

Lemma move_back p : forall u, move p (move (reverse p) u) = u.
Proof.
  induction p; intros u; cbn [move reverse].
  - by_coordinates.
  - apply turned_back.
  - rewrite <- (back_x alpha u) at 2. rewrite (of_sum _ (rotation_x alpha)).
    generalize (about_x alpha (about_x (- alpha) u)). intros. by_coordinates.
  - rewrite <- (back_z theta u) at 2. rewrite (of_sum _ (rotation_z theta)).
    generalize (about_z theta (about_z (- theta) u)). intros. by_coordinates.
  - apply turned_back.
  - generalize (unit_vector a). intros. by_coordinates.
  - apply IHp.
Qed.

Lemma spin_back p : forall u, spin p (spin (reverse p) u) = u /\ spin (reverse p) (spin p u) = u.
Proof.
  induction p; intros u; simpl; try (split; reflexivity).
  - split; [apply turned_back|]. rewrite <- (Ropp_involutive angle) at 2. apply turned_back.
  - split; [apply back_x|]. rewrite <- (Ropp_involutive alpha) at 2. apply back_x.
  - split; [apply back_z|]. rewrite <- (Ropp_involutive theta) at 2. apply back_z.
  - split; [apply turned_back|]. rewrite <- (Ropp_involutive angle) at 2. apply turned_back.
  - apply IHp.
Qed.

(** ** Twists in other frames *)

Definition carried (r : point -> point) (t : twist) : twist := (r (fst t), r (snd t)).
Definition with_number (f : twist -> twist) (t : nat * twist) : nat * twist := (fst t, f (snd t)).

Lemma twist_of_carried F r G Q p : rigid F r ->
  twist_of (fun u => F (G u)) (F Q) p = map (with_number (carried r)) (twist_of G Q p).
Proof.
  intros H. pose proof (proj1 H) as K. induction p; simpl; try reflexivity.
  - unfold with_number, carried. simpl.
    rewrite !(rigid_difference F r) by exact H. rewrite (of_product _ K). reflexivity.
  - unfold with_number, carried. simpl.
    rewrite !(rigid_difference F r) by exact H. rewrite (of_origin r K). reflexivity.
  - rewrite IHp, !map_map. apply map_ext. intros [k [v w]].
    unfold with_number, carried, faster. simpl. rewrite !(of_multiple _ K). reflexivity.
Qed.

Lemma twist_of_ext F G P p : (forall u, F u = G u) -> twist_of F P p = twist_of G P p.
Proof. intros E. induction p; simpl; rewrite ?E, ?IHp; reflexivity. Qed.

Lemma twists_ext l : forall F G P, (forall u, F u = G u) -> twists F P l = twists G P l.
Proof.
  induction l as [|p l IH]; intros F G P E; [reflexivity|]. simpl.
  rewrite (twist_of_ext F G) by exact E. f_equal. apply IH. intros u. apply E.
Qed.

Lemma twists_carried l : forall F r G Q, rigid F r ->
  twists (fun u => F (G u)) (F Q) l = map (with_number (carried r)) (twists G Q l).
Proof.
  induction l as [|p l IH]; intros F r G Q H; [reflexivity|]. simpl.
  rewrite map_app, (twist_of_carried F r) by exact H. f_equal.
  exact (IH F r (fun u => G (move p u)) Q H).
Qed.

(** The joint's own motion does not move its axis. *)
Lemma twist_of_moved F r P p : rigid F r -> twist_of (fun u => F (move p u)) P p = twist_of F P p.
Proof.
  intros H. induction p; simpl; try reflexivity.
  - rewrite turned_axis, of_origin by apply turned_rotation. reflexivity.
  - do 3 f_equal. rewrite !(rigid_difference F r) by exact H. f_equal.
    generalize (unit_vector a). intros. by_coordinates.
  - f_equal. exact IHp.
Qed.

(** From the last part of a list that ends at the base. *)
Fixpoint through (l : list part) (u : point) : point :=
  match l with [] => u | p :: rest => through rest (move p u) end.
Fixpoint spins (l : list part) (u : point) : point :=
  match l with [] => u | p :: rest => spins rest (spin p u) end.
Fixpoint spins_back (l : list part) (u : point) : point :=
  match l with [] => u | p :: rest => spin (reverse p) (spins_back rest u) end.

Lemma through_rigid l : rigid (through l) (spins l).
Proof.
  induction l as [|p l IH].
  - split; [exact no_turn|]. intros u. simpl. by_coordinates.
  - exact (rigid_follow _ _ _ _ IH (part_rigid p)).
Qed.

Lemma spins_there l : forall u, spins l (spins_back l u) = u.
Proof. induction l as [|p l IH]; intros u; simpl; [reflexivity|]. rewrite (proj1 (spin_back p _)).
  apply IH. Qed.
Lemma spins_and_back l : forall u, spins_back l (spins l u) = u.
Proof. induction l as [|p l IH]; intros u; simpl; [reflexivity|]. rewrite IH. apply spin_back. Qed.

Lemma twists_of_both a : forall F P b,
  twists F P (a ++ b) = twists F P a ++ twists (fun u => F (through (rev a) u)) P b.
Proof.
  induction a as [|p a IH]; intros F P b; [reflexivity|]. simpl.
  rewrite IH, app_assoc. f_equal. apply twists_ext. intros u. f_equal.
  clear. revert p u. induction (rev a) as [|c l IH]; intros p u; [reflexivity|]. apply IH.
Qed.

(** The joints before a link, the last one first, seen from the link. *)
Fixpoint inward (F : point -> point) (Q : point) (l : list part) : list (nat * twist) :=
  match l with
  | [] => []
  | p :: rest => twist_of F Q p ++ inward (fun u => F (move (reverse p) u)) Q rest
  end.

Fixpoint total (number : nat) (l : list (nat * twist)) : twist :=
  match l with
  | [] => (at_origin, at_origin)
  | (k, t) :: rest =>
      let later := total number rest in
      if Nat.eqb k number then (plus (fst t) (fst later), plus (snd t) (snd later)) else later
  end.

Lemma total_app k a b :
  total k (a ++ b) = (plus (fst (total k a)) (fst (total k b)),
                       plus (snd (total k a)) (snd (total k b))).
Proof.
  induction a as [|[m [v w]] a IH].
  - simpl. destruct (total k b) as [v w]. simpl. f_equal; by_coordinates.
  - simpl. destruct (Nat.eqb m k); rewrite IH; [|reflexivity]. simpl.
    generalize (total k a) (total k b). intros [c d] [e f]. simpl. f_equal; by_coordinates.
Qed.

Lemma inward_seen l : forall F Q W r k, rigid W r -> (forall u, W (F u) = through l u) ->
  total k (twists (fun u => u) (W Q) (rev l))
  = total k (map (with_number (carried r)) (inward F Q l)).
Proof.
  induction l as [|p l IH]; intros F Q W r k H E; [reflexivity|]. simpl rev. simpl inward.
  rewrite twists_of_both, rev_involutive, map_app, !total_app. simpl.
  rewrite app_nil_r, (twist_of_ext _ (through l)) by reflexivity.
  rewrite <- (twist_of_moved (through l) (spins l)) by apply through_rigid.
  rewrite <- (twist_of_ext (fun u => W (F u)) (fun u => through l (move p u))) by exact E.
  rewrite (twist_of_carried W r F) by exact H.
  rewrite (IH (fun u => F (move (reverse p) u)) Q W r k H).
  - f_equal; generalize (total k (map (with_number (carried r)) (twist_of F Q p)))
      (total k (map (with_number (carried r)) (inward (fun u => F (move (reverse p) u)) Q l)));
    intros [? ?] [? ?]; simpl; by_coordinates.
  - intros u. rewrite E. simpl. rewrite move_back. reflexivity.
Qed.

(** The joints before a link and those after it. *)
Definition seen (Q : point) (before after : list part) : list (nat * twist) :=
  inward (fun u => u) Q before ++ twists (fun u => u) Q after.

Definition moved (d : point) (t : twist) : twist := (plus (fst t) (cross (snd t) d), snd t).

Lemma twists_of_other_point F P Q l :
  twists F P l = map (with_number (moved (minus P Q))) (twists F Q l).
Proof.
  revert F. induction l as [|p l IH]; intros F; [reflexivity|]. simpl. rewrite map_app, <- IH.
  f_equal.
  clear IH. induction p; simpl; try reflexivity.
  - unfold with_number, moved. simpl. generalize (F (unit_vector a)) (F at_origin). intros.
    apply (f_equal (fun t => [(number, t)])), f_equal2; by_coordinates.
  - unfold with_number, moved. simpl. generalize (F (unit_vector a)) (F at_origin). intros.
    apply (f_equal (fun t => [(number, t)])), f_equal2; by_coordinates.
  - rewrite IHp, !map_map. apply map_ext. intros [k [v w]]. unfold with_number, moved, faster.
    simpl.
    apply (f_equal (fun t => (k, t))), f_equal2; by_coordinates.
Qed.

(** ** Linear maps of twists *)

Definition both (t s : twist) : twist := (plus (fst t) (fst s), plus (snd t) (snd s)).
Definition no_twist : twist := (at_origin, at_origin).

Record linear_map (f : twist -> twist) : Prop := {
  map_sum : forall t s, f (both t s) = both (f t) (f s);
  map_multiple : forall c t, f (faster c t) = faster c (f t) }.

Lemma map_no_twist f : linear_map f -> f no_twist = no_twist.
Proof.
  intros H. replace no_twist with (faster 0 no_twist)
    by (unfold faster, no_twist; simpl; f_equal; by_coordinates).
  rewrite (map_multiple _ H). destruct (f no_twist) as [v w]. unfold faster. simpl.
  f_equal; by_coordinates.
Qed.

Lemma total_of_map f k l : linear_map f -> total k (map (with_number f) l) = f (total k l).
Proof.
  intros H. induction l as [|[m t] l IH].
  - symmetry. exact (map_no_twist f H).
  - simpl. destruct (Nat.eqb m k); [|exact IH]. rewrite IH.
    change (both (f t) (f (total k l)) = f (both t (total k l))). symmetry. apply (map_sum _ H).
Qed.

(** From the frame of a link, and its point Q, to that of the base, and the end of the arm. *)
Definition to_base (l : list part) (d : point) (t : twist) : twist := moved d (carried (spins l) t).
Definition from_base (l : list part) (d : point) (t : twist) : twist :=
  carried (spins_back l) (moved (times (-1) d) t).

Lemma spins_linear l : forall u v, spins l (plus u v) = plus (spins l u) (spins l v).
Proof. exact (of_sum _ (proj1 (through_rigid l))). Qed.

Lemma to_base_linear l d : linear_map (to_base l d).
Proof.
  pose proof (proj1 (through_rigid l)) as H. split.
  - intros [a b] [e f]. unfold to_base, moved, carried, both. simpl. rewrite !(of_sum _ H).
    f_equal. generalize (spins l a) (spins l b) (spins l e) (spins l f). intros. by_coordinates.
  - intros c [a b]. unfold to_base, moved, carried, faster. simpl. rewrite !(of_multiple _ H).
    f_equal. generalize (spins l a) (spins l b). intros. by_coordinates.
Qed.

Lemma to_base_there l d t : to_base l d (from_base l d t) = t.
Proof.
  destruct t as [v w]. unfold to_base, from_base, moved, carried. simpl. rewrite !spins_there.
  f_equal. by_coordinates.
Qed.
Lemma to_base_and_back l d t : from_base l d (to_base l d t) = t.
Proof.
  destruct t as [v w]. unfold to_base, from_base, moved, carried. simpl. rewrite spins_and_back.
  f_equal. rewrite <- (spins_and_back l v) at 2. f_equal.
  generalize (spins l v) (spins l w). intros. by_coordinates.
Qed.

Lemma seen_from_base l Q P after k :
  total k (twists (fun u => u) P (rev l ++ after))
  = to_base l (minus P (through l Q)) (total k (seen Q l after)).
Proof.
  rewrite <- total_of_map by apply to_base_linear.
  rewrite (twists_of_other_point _ P (through l Q)).
  assert (M : linear_map (moved (minus P (through l Q)))).
  { generalize (minus P (through l Q)). intros d. split.
    - intros [? ?] [? ?]. unfold moved, both. simpl. f_equal. by_coordinates.
    - intros c [? ?]. unfold moved, faster. simpl. f_equal. by_coordinates. }
  rewrite total_of_map by exact M.
  replace (total k (map (with_number (to_base l (minus P (through l Q)))) (seen Q l after)))
    with (moved (minus P (through l Q))
      (total k (map (with_number (carried (spins l))) (seen Q l after)))).
  2: { rewrite <- total_of_map by exact M. rewrite map_map. reflexivity. }
  f_equal. rewrite twists_of_both, rev_involutive. unfold seen. rewrite map_app, !total_app.
  rewrite (inward_seen l (fun u => u) Q (through l) (spins l)) by (try apply through_rigid;
    reflexivity).
  rewrite (twists_carried after (through l) (spins l) (fun u => u)) by apply through_rigid.
  reflexivity.
Qed.

(** ** Ranks *)

Definition coordinate (i : nat) (t : twist) : R := nth i (coordinates_of t) 0.

Ltac each_coordinate i :=
  do 6 (destruct i as [|i]; [unfold coordinate; simpl; try reflexivity; try ring|]);
  unfold coordinate; simpl; destruct i; try reflexivity; ring.

Lemma coordinate_both i t s : coordinate i (both t s) = coordinate i t + coordinate i s.
Proof. destruct t as [[[? ?] ?] [[? ?] ?]], s as [[[? ?] ?] [[? ?] ?]]. each_coordinate i. Qed.
Lemma coordinate_faster i c t : coordinate i (faster c t) = c * coordinate i t.
Proof. destruct t as [[[? ?] ?] [[? ?] ?]]. each_coordinate i. Qed.
Lemma coordinate_none i : coordinate i no_twist = 0.
Proof. each_coordinate i. Qed.

Lemma row_of_total i k l : row_of_column i k l = coordinate i (total k l).
Proof.
  induction l as [|[m t] l IH]; simpl; [symmetry; exact (coordinate_none i)|]. rewrite IH.
  destruct (Nat.eqb m k); [|ring].
  change (coordinate i t + coordinate i (total k l) = coordinate i (both t (total k l))).
  symmetry. apply coordinate_both.
Qed.

Fixpoint sum_of_twists (n : nat) (f : nat -> twist) : twist :=
  match n with O => no_twist | S m => both (sum_of_twists m f) (f m) end.

Lemma coordinate_sum i n f : coordinate i (sum_of_twists n f) = sum n (fun j => coordinate i (f j)).
Proof.
  induction n as [|n IH]; simpl; [apply coordinate_none|]. rewrite coordinate_both, IH. reflexivity.
Qed.

Lemma map_of_sum g n f : linear_map g -> g (sum_of_twists n f) = sum_of_twists n (fun j => g (f j)).
Proof.
  intros H. induction n as [|n IH]; simpl; [exact (map_no_twist g H)|].
  rewrite (map_sum _ H), IH. reflexivity.
Qed.

Lemma sum_of_twists_ext n f g : (forall j, f j = g j) -> sum_of_twists n f = sum_of_twists n g.
Proof. intros E. induction n as [|n IH]; simpl; [reflexivity|]. rewrite IH, E. reflexivity. Qed.

Lemma no_coordinates t : (forall i, (i < 6)%nat -> coordinate i t = 0) -> t = no_twist.
Proof.
  destruct t as [[[a b] c] [[d e] f]]. intros H. unfold no_twist, at_origin.
  pose proof (H 0%nat ltac:(lia)). pose proof (H 1%nat ltac:(lia)). pose proof (H 2%nat ltac:(lia)).
  pose proof (H 3%nat ltac:(lia)). pose proof (H 4%nat ltac:(lia)). pose proof (H 5%nat ltac:(lia)).
  clear H. cbv [coordinate nth coordinates_of first second third fst snd] in *. subst. reflexivity.
Qed.

Lemma from_base_none l d : from_base l d no_twist = no_twist.
Proof.
  rewrite <- (to_base_and_back l d no_twist) at 2. f_equal. symmetry.
  apply map_no_twist, to_base_linear.
Qed.

(** What a matrix of twists does to the speeds of the joints. *)
Definition motion_at (l : list (nat * twist)) (n : nat) (y : nat -> R) : twist :=
  sum_of_twists n (fun j => faster (y j) (total (S j) l)).

Lemma coordinate_motion i l n y :
  coordinate i (motion_at l n y) = sum n (fun j => row_of_column i (S j) l * y j).
Proof.
  unfold motion_at. rewrite coordinate_sum. apply sum_ext. intros j _.
  rewrite coordinate_faster, row_of_total. ring.
Qed.

Lemma motion_seen l Q P after n y :
  motion_at (twists (fun u => u) P (rev l ++ after)) n y
  = to_base l (minus P (through l Q)) (motion_at (seen Q l after) n y).
Proof.
  unfold motion_at. rewrite map_of_sum by apply to_base_linear. apply sum_of_twists_ext. intros j.
  rewrite (map_multiple _ (to_base_linear _ _)). rewrite (seen_from_base l Q). reflexivity.
Qed.

Lemma no_motion_seen l Q after n y :
  (forall i, (i < 6)%nat -> sum n (fun j => jacobian (rev l ++ after) i j * y j) = 0) <->
  motion_at (seen Q l after) n y = no_twist.
Proof.
  assert (E : forall i, sum n (fun j => jacobian (rev l ++ after) i j * y j) = coordinate i
    (to_base l (minus (end_of (rev l ++ after)) (through l Q)) (motion_at (seen Q l after) n y))).
  { intros i. rewrite <- motion_seen, coordinate_motion. reflexivity. }
  split.
  - intros H. rewrite <- (to_base_and_back l (minus (end_of (rev l ++ after)) (through l Q))
      (motion_at (seen Q l after) n y)).
    rewrite (no_coordinates (to_base _ _ _)); [apply from_base_none|].
    intros i I. rewrite <- E. exact (H i I).
  - intros Z i _. rewrite E, Z, map_no_twist by apply to_base_linear. apply coordinate_none.
Qed.

(** The rows of these numbers, as seen from a link. *)
Definition view (rows : list nat) (n : nat) (l : list (nat * twist)) : list (list R) :=
  map (fun i => map (fun j => row_of_column i (S j) l) (seq 0 n)) rows.
(** All six rows, each joint in a row of its own. *)
Definition view_by_joints (n : nat) (l : list (nat * twist)) : list (list R) :=
  map (fun j => map (fun i => row_of_column i (S j) l) (seq 0 6)) (seq 0 n).

Lemma nth_map_seq {A} (f : nat -> A) n j d : (j < n)%nat -> nth j (map f (seq 0 n)) d = f j.
Proof.
  intros L. rewrite (nth_indep _ d (f 0%nat)) by (rewrite map_size, seq_size; exact L).
  rewrite map_nth, seq_nth by exact L. reflexivity.
Qed.

Theorem full_rank_of_view n l Q after rows : Forall (fun i => i < 6)%nat rows ->
  full_column_rank (length rows) n (matrix_of (view rows n (seen Q l after))) ->
  full_column_rank 6 n (jacobian (rev l ++ after)).
Proof.
  intros B F y H. apply no_motion_seen with (Q := Q) in H. apply F. intros i I.
  pose proof (coordinate_motion (nth i rows 0%nat) (seen Q l after) n y) as C.
  rewrite H, coordinate_none in C. rewrite C. apply sum_ext. intros j J.
  unfold matrix_of, view.
  rewrite (nth_indep _ [] (map (fun j => row_of_column 0 (S j) (seen Q l after)) (seq 0 n)))
    by (rewrite map_size; exact I).
  rewrite (map_nth (fun i => map (fun j => row_of_column i (S j) (seen Q l after)) (seq 0 n))
    rows 0%nat i).
  rewrite nth_map_seq by exact J. reflexivity.
Qed.

Lemma sum_delta n k (f : nat -> R) : (k < n)%nat ->
  sum n (fun i => f i * (if Nat.eqb i k then 1 else 0)) = f k.
Proof.
  intros K. rewrite <- (sum_identity n k f K). apply sum_ext. intros i _. unfold identity.
  rewrite Nat.eqb_sym. destruct (Nat.eqb k i); ring.
Qed.

Definition unit_twist (i : nat) : twist :=
  let d k := if Nat.eqb k i then 1 else 0 in
  ((d 0%nat, d 1%nat, d 2%nat), (d 3%nat, d 4%nat, d 5%nat)).

Lemma twist_of_units t : sum_of_twists 6 (fun i => faster (coordinate i t) (unit_twist i)) = t.
Proof.
  destruct t as [[[a b] c] [[d e] f]].
  cbv -[Rplus Rmult IZR]. apply f_equal2; apply same_point; ring.
Qed.

Theorem full_row_rank_of_view n l Q after :
  full_column_rank n 6 (matrix_of (view_by_joints n (seen Q l after))) ->
  full_row_rank 6 n (jacobian (rev l ++ after)).
Proof.
  intros F x H i I. set (arm := rev l ++ after) in *.
  set (to := to_base l (minus (end_of arm) (through l Q))).
  assert (L : linear_map to) by apply to_base_linear.
  set (of := fun t => sum 6 (fun i => coordinate i t * x i)).
  assert (O : forall t, of (to t) = sum 6 (fun k => coordinate k t * of (to (unit_twist k)))).
  { intros t. rewrite <- (twist_of_units t) at 1. rewrite (map_of_sum to) by exact L. unfold of.
    symmetry.
    rewrite (sum_ext 6 _ (fun k =>
      sum 6 (fun i => coordinate k t * (coordinate i (to (unit_twist k)) * x i))))
      by (intros k _; rewrite sum_scale; reflexivity).
    rewrite sum_swap. apply sum_ext. intros k _. rewrite coordinate_sum, Rmult_comm, <- sum_scale.
    apply sum_ext. intros m _. rewrite (map_multiple _ L), coordinate_faster. ring. }
  assert (Z : forall k, (k < 6)%nat -> of (to (unit_twist k)) = 0).
  { apply F. intros j J. rewrite <- (H j J).
    rewrite (sum_ext 6 _ (fun k =>
      coordinate k (total (S j) (seen Q l after)) * of (to (unit_twist k)))).
    - rewrite <- O. unfold of, to, arm. rewrite <- (seen_from_base l Q). apply sum_ext. intros m _.
      unfold jacobian. rewrite row_of_total. reflexivity.
    - intros k K. unfold matrix_of, view_by_joints. rewrite nth_map_seq by exact J.
      rewrite nth_map_seq by exact K. rewrite row_of_total. reflexivity. }
  specialize (O (from_base l (minus (end_of arm) (through l Q)) (unit_twist i))).
  rewrite (sum_zero 6) in O by (intros k K; rewrite Z by exact K; ring).
  unfold to in O. rewrite to_base_there in O. unfold of in O. rewrite <- O.
  rewrite (sum_ext 6 _ (fun m => x m * (if Nat.eqb m i then 1 else 0))).
  - symmetry. apply sum_delta, I.
  - intros m M. rewrite Rmult_comm. f_equal. unfold unit_twist, coordinate. simpl.
    do 6 (destruct m as [|m]; [reflexivity|]). lia.
Qed.

(** ** Regular matrices are those with a determinant *)

Theorem full_rank_of_determinant n : forall a, determinant n a <> 0 -> full_column_rank n n a.
Proof.
  induction n as [|n IH]; intros a D y H j J; [lia|].
  destruct (some_nonzero (S n) (a O)) as [Z|[p [P N]]].
  { exfalso. apply D, (row_of_zeros (S n) 0 a); [lia|exact Z]. }
  rewrite (elimination n p a P N) in D.
  assert (C : forall k, (k < n)%nat -> y (skip p k) = 0).
  { apply (IH (complement p a)).
    - intros E. apply D. rewrite E. ring.
    - intros i I. pose proof (H O ltac:(lia)) as H0. pose proof (H (S i) ltac:(lia)) as Hi.
      rewrite (sum_skip n p) in H0, Hi by exact P. unfold complement.
      rewrite (sum_ext n _ (fun k => a (S i) (skip p k) * y (skip p k)
        + (- a (S i) p / a O p) * (a O (skip p k) * y (skip p k)))) by (intros; field; exact N).
      rewrite sum_plus, sum_scale.
      replace (sum n (fun k => a O (skip p k) * y (skip p k))) with (- (a O p * y p)) by lra.
      replace (sum n (fun k => a (S i) (skip p k) * y (skip p k)))
        with (- (a (S i) p * y p)) by lra.
      field. exact N. }
  assert (Y : y p = 0).
  { pose proof (H O ltac:(lia)) as H0. rewrite (sum_skip n p), (sum_zero n) in H0;
    [|intros k K|exact P].
    - apply (Rmult_eq_reg_l (a O p)); [lra|exact N].
    - rewrite C by exact K. ring. }
  destruct (Nat.lt_trichotomy j p) as [L|[->|L]]; [|exact Y|].
  - specialize (C j ltac:(lia)). unfold skip in C. rewrite (proj2 (Nat.ltb_lt j p) L) in C. exact C.
  - specialize (C (pred j) ltac:(lia)). unfold skip in C.
    rewrite (proj2 (Nat.ltb_ge (pred j) p)) in C by lia. replace (S (pred j)) with j in C by lia.
    exact C.
Qed.

Lemma kernel_of_determinant n : forall a, determinant n a = 0 ->
  exists y, (forall i, (i < n)%nat -> sum n (fun j => a i j * y j) = 0) /\
            exists j, (j < n)%nat /\ y j <> 0.
Proof.
  induction n as [|n IH]; intros a D; [simpl in D; lra|].
  destruct (some_nonzero (S n) (a O)) as [Z|[p [P N]]].
  - destruct (underdetermined n (S n) (fun i => a (S i)) ltac:(lia)) as (y & E & Y). exists y.
    split; [|exact Y].
    intros [|i] I; [|apply (E i); lia]. apply sum_zero. intros j J. rewrite Z by exact J. ring.
  - rewrite (elimination n p a P N) in D.
    destruct (IH (complement p a)) as (y & E & j & J & Y).
    { apply Rmult_integral in D as [D|D]; [exfalso; revert D; apply pow_nonzero; lra|].
      apply Rmult_integral in D as [D|D]; [contradiction|exact D]. }
    exact (kernel_beside_pivot n n p a y P N E (ex_intro _ j (conj J Y))).
Qed.

Theorem determinant_of_full_rank n a : full_column_rank n n a -> determinant n a <> 0.
Proof.
  intros F D. destruct (kernel_of_determinant n a D) as (y & E & j & J & Y). exact (Y (F y E j J)).
Qed.

(** ** Determinants of matrices with many zeros *)

Definition number (e : option R) : R := match e with Some r => r | None => 0 end.

Definition signed (j : nat) (e : option R) : option R :=
  match e with Some r => Some (if Nat.even j then r else - r) | None => None end.

Fixpoint sparse_sum (n : nat) (f : nat -> option R) : option R :=
  match n with
  | O => None
  | S k => match sparse_sum k f, f k with
           | Some a, Some b => Some (a + b)
           | None, e | e, None => e
           end
  end.

Fixpoint sparse_determinant (n : nat) (a : nat -> nat -> option R) : option R :=
  match n with
  | O => Some 1
  | S m => sparse_sum n (fun j =>
      match a O j with
      | None => None
      | Some r => match sparse_determinant m (fun i k => a (S i) (skip j k)) with
                  | None => None
                  | Some d => signed j (Some (r * d))
                  end
      end)
  end.

Lemma sparse_sum_correct n f : number (sparse_sum n f) = sum n (fun k => number (f k)).
Proof.
  induction n as [|n IH]; [reflexivity|]. simpl. rewrite <- IH.
  destruct (sparse_sum n f), (f n); simpl; ring.
Qed.

Lemma sign_of j : (-1) ^ j = if Nat.even j then 1 else -1.
Proof.
  induction j as [|j IH]; [reflexivity|]. rewrite Nat.even_succ, <- Nat.negb_even. simpl pow.
  rewrite IH.
  destruct (Nat.even j); simpl; ring.
Qed.

Lemma sparse_determinant_correct n : forall a,
  determinant n (fun i j => number (a i j)) = number (sparse_determinant n a).
Proof.
  induction n as [|n IH]; intros a; [reflexivity|].
  change (sparse_determinant (S n) a) with (sparse_sum (S n) (fun j =>
    match a O j with
    | None => None
    | Some r => match sparse_determinant n (fun i k => a (S i) (skip j k)) with
                | None => None
                | Some d => signed j (Some (r * d))
                end
    end)).
  transitivity (sum (S n) (fun j => (-1) ^ j *
    (number (a O j) * determinant n (fun i k => number (a (S i) (skip j k)))))); [reflexivity|].
  rewrite sparse_sum_correct. apply sum_ext. intros j _.
  rewrite (IH (fun i k => a (S i) (skip j k))), sign_of. destruct (a O j) as [r|]; simpl; [|ring].
  destruct (sparse_determinant n _) as [d|]; simpl; [|ring]. destruct (Nat.even j); ring.
Qed.

Definition sparse_matrix (m : list (list (option R))) (i j : nat) : option R :=
  nth j (nth i m []) None.

Lemma determinant_of_sparse n m :
  determinant n (matrix_of (map (map number) m)) = number (sparse_determinant n (sparse_matrix m)).
Proof.
  rewrite <- sparse_determinant_correct. apply determinant_ext. intros i j _ _.
  unfold matrix_of, sparse_matrix. change (@nil R) with (map number []). rewrite map_nth.
  change 0 with (number None). rewrite map_nth. reflexivity.
Qed.

(** ** The determinant as seen from a link *)

Lemma determinant_of_combination n p u w x y a : (p < n)%nat ->
  determinant n (with_row p (fun j => x * u j + y * w j) a)
  = x * determinant n (with_row p u a) + y * determinant n (with_row p w a).
Proof.
  intros P. rewrite (determinant_linear_row n p (fun j => x * u j) w y a P). f_equal.
  rewrite (determinant_ext n (with_row p (fun j => x * u j) a)
    (with_row p (fun j => 0 + x * u j) a)).
  - rewrite (determinant_linear_row n p (fun _ => 0) u x a P).
    rewrite (row_of_zeros n p (with_row p (fun _ => 0) a) P); [ring|].
    intros j _. unfold with_row. rewrite Nat.eqb_refl. reflexivity.
  - intros i j _ _. unfold with_row. destruct (Nat.eqb i p); ring.
Qed.

(** The matrix with two rows turned. *)
Lemma determinant_of_turned n p q c s a : (p < n)%nat -> (q < n)%nat -> p <> q ->
  s ^ 2 = 1 - c ^ 2 ->
  determinant n (with_row p (fun j => c * a p j + - s * a q j)
    (with_row q (fun j => s * a p j + c * a q j) a)) = determinant n a.
Proof.
  intros P Q D E.
  set (f := fun u w : nat -> R => determinant n (with_row p u (with_row q w a))).
  assert (L : forall u w x y z,
    f (fun j => x * u j + y * w j) z = x * f u z + y * f w z).
  { intros u w x y z. apply determinant_of_combination, P. }
  assert (S : forall u w, f u w = determinant n (with_row q w (with_row p u a))).
  { intros u w. apply determinant_ext. intros i j _ _. unfold with_row.
    destruct (Nat.eqb_spec i p), (Nat.eqb_spec i q); try reflexivity. lia. }
  assert (R : forall u w x y z,
    f z (fun j => x * u j + y * w j) = x * f z u + y * f z w).
  { intros u w x y z. rewrite !S. apply determinant_of_combination, Q. }
  assert (Z : forall u, f u u = 0).
  { intros u. apply (two_rows_equal n p q); try assumption. intros j _. unfold with_row.
    rewrite !Nat.eqb_refl. destruct (Nat.eqb_spec q p); [lia|reflexivity]. }
  assert (A : f (a q) (a p) = - f (a p) (a q)).
  { pose proof (Z (fun j => 1 * a p j + 1 * a q j)) as H. rewrite L, !R, !Z in H. lra. }
  change (f (fun j => c * a p j + - s * a q j) (fun j => s * a p j + c * a q j)
    = determinant n a).
  rewrite L, !R, !Z, A. replace (determinant n a) with (f (a p) (a q)).
  - ring [E].
  - apply determinant_ext. intros i j _ _. unfold with_row.
    destruct (Nat.eqb_spec i p) as [->|]; [reflexivity|].
    destruct (Nat.eqb_spec i q) as [->|]; reflexivity.
Qed.

(** Six twists as the columns of a matrix. *)
Definition of_twists (t : nat -> twist) (i j : nat) : R := coordinate i (t j).

Lemma of_twists_ext (s t : nat -> twist) :
  (forall j, s j = t j) -> determinant 6 (of_twists s) = determinant 6 (of_twists t).
Proof.
  intros E. apply determinant_ext. intros i j _ _. unfold of_twists. rewrite E. reflexivity.
Qed.

Ltac each_row i :=
  do 6 (destruct i as [|i]; [cbv -[Rplus Rminus Rmult Ropp IZR cos sin]; ring|]); lia.

Lemma determinant_of_other_point d t :
  determinant 6 (of_twists (fun j => moved d (t j))) = determinant 6 (of_twists t).
Proof.
  destruct d as [[x y] z]. set (a := of_twists t).
  set (a1 := with_row 0 (fun j => a 0%nat j + z * a 4%nat j) a).
  set (a2 := with_row 0 (fun j => a1 0%nat j + - y * a1 5%nat j) a1).
  set (a3 := with_row 1 (fun j => a2 1%nat j + x * a2 5%nat j) a2).
  set (a4 := with_row 1 (fun j => a3 1%nat j + - z * a3 3%nat j) a3).
  set (a5 := with_row 2 (fun j => a4 2%nat j + y * a4 3%nat j) a4).
  transitivity (determinant 6 (with_row 2 (fun j => a5 2%nat j + - x * a5 4%nat j) a5)).
  - apply determinant_ext. intros i j I _. unfold a5, a4, a3, a2, a1, a, of_twists.
    destruct (t j) as [[[v0 v1] v2] [[w0 w1] w2]] eqn:T.
    unfold with_row, coordinate. rewrite T. each_row i.
  - rewrite add_to_row by lia. unfold a5. rewrite add_to_row by lia. unfold a4.
    rewrite add_to_row by lia. unfold a3. rewrite add_to_row by lia. unfold a2.
    rewrite add_to_row by lia. unfold a1. rewrite add_to_row by lia. reflexivity.
Qed.

Ltac by_turned_rows p q c s P :=
  let t := fresh "t" in intros t; set (a := of_twists t);
  set (b := with_row p (fun j => c * a p j + - s * a q j)
    (with_row q (fun j => s * a p j + c * a q j) a));
  let p' := eval cbv in (3 + p)%nat in let q' := eval cbv in (3 + q)%nat in
  transitivity (determinant 6 (with_row p' (fun j => c * b p' j + - s * b q' j)
    (with_row q' (fun j => s * b p' j + c * b q' j) b)));
  [ apply determinant_ext; intros i j I _; unfold b, a, of_twists;
    destruct (t j) as [[[v0 v1] v2] [[w0 w1] w2]] eqn:T;
    unfold with_row, coordinate; rewrite T; each_row i
  | rewrite determinant_of_turned by (try exact P; lia); unfold b;
    rewrite determinant_of_turned by (try exact P; lia); reflexivity ].

Definition keeps_determinants (r : point -> point) : Prop := forall t : nat -> twist,
  determinant 6 (of_twists (fun j => carried r (t j))) = determinant 6 (of_twists t).

Lemma determinant_about_x angle : keeps_determinants (about_x angle).
Proof. by_turned_rows 1%nat 2%nat (cos angle) (sin angle) (pythagoras angle). Qed.
Lemma determinant_about_y angle : keeps_determinants (about_y angle).
Proof. by_turned_rows 2%nat 0%nat (cos angle) (sin angle) (pythagoras angle). Qed.
Lemma determinant_about_z angle : keeps_determinants (about_z angle).
Proof. by_turned_rows 0%nat 1%nat (cos angle) (sin angle) (pythagoras angle). Qed.

Lemma determinant_of_no_turn : keeps_determinants (fun u => u).
Proof. intros t. apply of_twists_ext. intros j. unfold carried. destruct (t j). reflexivity. Qed.

Lemma determinant_of_spin p : keeps_determinants (spin p).
Proof.
  assert (T : forall a angle, keeps_determinants (turned a angle)).
  { induction a as [| | |a IH]; intros angle; [apply determinant_about_x|apply determinant_about_y
    |apply determinant_about_z|apply IH]. }
  induction p; simpl; try apply determinant_of_no_turn; try apply T; try apply determinant_about_x;
    try apply determinant_about_z.
  exact IHp.
Qed.

Lemma determinant_of_spins l : keeps_determinants (spins l).
Proof.
  induction l as [|p l IH]; [exact determinant_of_no_turn|]. intros t.
  rewrite <- (determinant_of_spin p t). exact (IH (fun j => carried (spin p) (t j))).
Qed.

(** It is that of the Jacobian. *)
Theorem determinant_seen l Q after :
  determinant 6 (jacobian (rev l ++ after))
  = determinant 6 (fun i j => row_of_column i (S j) (seen Q l after)).
Proof.
  set (d := minus (end_of (rev l ++ after)) (through l Q)).
  set (t := fun j => total (S j) (seen Q l after)).
  transitivity (determinant 6 (of_twists (fun j => to_base l d (t j)))).
  - apply determinant_ext. intros i j _ _. unfold jacobian, of_twists, t, d.
    rewrite row_of_total, (seen_from_base l Q). reflexivity.
  - unfold to_base. rewrite determinant_of_other_point, determinant_of_spins.
    apply determinant_ext. intros i j _ _. unfold of_twists, t. rewrite row_of_total. reflexivity.
Qed.

Lemma same_length_of_spin p u v : dot (spin p u) (spin p v) = dot u v.
Proof.
  assert (X : forall t, dot (about_x t u) (about_x t v) = dot u v).
  { intros t. pose proof (pythagoras t) as E. destruct u as [[? ?] ?], v as [[? ?] ?].
    cbv [dot about_x first second third fst snd]. ring [E]. }
  assert (Y : forall t, dot (about_y t u) (about_y t v) = dot u v).
  { intros t. pose proof (pythagoras t) as E. destruct u as [[? ?] ?], v as [[? ?] ?].
    cbv [dot about_y first second third fst snd]. ring [E]. }
  assert (Z : forall t, dot (about_z t u) (about_z t v) = dot u v).
  { intros t. pose proof (pythagoras t) as E. destruct u as [[? ?] ?], v as [[? ?] ?].
    cbv [dot about_z first second third fst snd]. ring [E]. }
  assert (T : forall a t, dot (turned a t u) (turned a t v) = dot u v).
  { induction a; intros t; [apply X|apply Y|apply Z|apply IHa]. }
  induction p; simpl; auto.
Qed.

Lemma dot_of_spins l : forall u v, dot (spins l u) (spins l v) = dot u v.
Proof.
  induction l as [|p l IH]; intros u v; [reflexivity|]. simpl. rewrite IH.
  apply same_length_of_spin.
Qed.

Lemma behind_through l after : forall u, behind (length l) (rev l ++ after) u = through l u.
Proof.
  assert (L : forall a p u, through (a ++ [p]) u = move p (through a u)).
  { induction a as [|q a IH]; intros p u; [reflexivity|]. apply (IH p (move q u)). }
  assert (B : forall a b u, behind (length a) (a ++ b) u = through (rev a) u).
  { induction a as [|p a IH]; intros b u; [destruct b; reflexivity|]. simpl. rewrite IH, L.
    reflexivity. }
  intros u. rewrite <- (rev_length l), B, rev_involutive. reflexivity.
Qed.

Lemma components_in_link l v : components (through l) (spins l v) = v.
Proof.
  unfold components. rewrite !(rigid_difference _ _ _ _ (through_rigid l)), !dot_of_spins.
  destruct v as [[a b] c].
  cbv [dot minus at_origin first second third fst snd]. apply same_point; ring.
Qed.

Lemma components_linear F : linear_map (along_axes F).
Proof.
  assert (P : forall u v, components F (plus u v) = plus (components F u) (components F v)).
  { intros u v. unfold components.
    generalize (minus (F (1, 0, 0)) (F at_origin)) (minus (F (0, 1, 0)) (F at_origin))
      (minus (F (0, 0, 1)) (F at_origin)). intros.
    repeat match goal with u : point |- _ => destruct u as [[? ?] ?] end.
    cbv [dot plus first second third fst snd]. apply same_point; ring. }
  assert (M : forall c u, components F (times c u) = times c (components F u)).
  { intros c u. unfold components.
    generalize (minus (F (1, 0, 0)) (F at_origin)) (minus (F (0, 1, 0)) (F at_origin))
      (minus (F (0, 0, 1)) (F at_origin)). intros.
    repeat match goal with u : point |- _ => destruct u as [[? ?] ?] end.
    cbv [dot times first second third fst snd]. apply same_point; ring. }
  split.
  - intros [a b] [c d]. unfold along_axes, both. simpl. rewrite !P. reflexivity.
  - intros c [a b]. unfold along_axes, faster. simpl. rewrite !M. reflexivity.
Qed.

Theorem same_as_seen l Q after i j :
  jacobian_seen (length l) Q (rev l ++ after) i j = row_of_column i (S j) (seen Q l after).
Proof.
  unfold jacobian_seen. rewrite !row_of_total. f_equal.
  set (F := behind (length l) (rev l ++ after)).
  change (map _ (twists (fun u => u) (F Q) (rev l ++ after))) with
    (map (with_number (along_axes F)) (twists (fun u => u) (F Q) (rev l ++ after))).
  rewrite total_of_map by apply components_linear.
  replace (F Q) with (through l Q) by (symmetry; apply behind_through).
  rewrite (seen_from_base l Q).
  assert (E : forall v, components F v = components (through l) v).
  { intros v. unfold components, F. rewrite !behind_through. reflexivity. }
  unfold along_axes. rewrite !E. destruct (total (S j) (seen Q l after)) as [v w].
  unfold to_base, moved, carried. simpl.
  replace (plus (spins l v) (cross (spins l w) (minus (through l Q) (through l Q))))
    with (spins l v).
  - rewrite !components_in_link. reflexivity.
  - generalize (spins l v) (spins l w) (through l Q). intros. by_coordinates.
Qed.

(** ** Frames by their coordinates *)

(** The origin of a frame and its three axes. *)
Definition frame : Type := point * point * point * point.
Definition located (f : frame) (u : point) : point :=
  let '(o, x, y, z) := f in
  let '(a, b, c) := u in plus o (plus (times a x) (plus (times b y) (times c z))).

Definition base_frame : frame := ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)).

Definition direction (f : frame) (u : point) : point :=
  let '(o, x, y, z) := f in
  let '(a, b, c) := u in plus (times a x) (plus (times b y) (times c z)).

Definition next_frame (f : frame) (p : part) : frame :=
  (located f (move p at_origin), direction f (spin p (1, 0, 0)), direction f (spin p (0, 1, 0)),
   direction f (spin p (0, 0, 1))).

Lemma located_base u : u = located base_frame u.
Proof. unfold located, base_frame. by_coordinates. Qed.

Lemma located_next f p u : located f (move p u) = located (next_frame f p) u.
Proof.
  rewrite (proj2 (part_rigid p)). unfold next_frame. pose proof (spin_rotation p) as H.
  replace (spin p u) with (plus (times (first u) (spin p (1, 0, 0)))
    (plus (times (second u) (spin p (0, 1, 0))) (times (third u) (spin p (0, 0, 1))))).
  - generalize (move p at_origin) (spin p (1, 0, 0)) (spin p (0, 1, 0)) (spin p (0, 0, 1)). intros.
    destruct f as [[[? ?] ?] ?]. unfold located, direction. by_coordinates.
  - rewrite <- !(of_multiple _ H), <- !(of_sum _ H). f_equal. by_coordinates.
Qed.

(** The twists as seen from a link, with the frames as coordinates. *)
Fixpoint twist_in (f : frame) (Q : point) (p : part) : list (nat * twist) :=
  match p with
  | revolute number a _ =>
      let z := direction f (unit_vector a) in
      [(number, (cross z (minus Q (fst (fst (fst f)))), z))]
  | prismatic number a _ => [(number, (direction f (unit_vector a), at_origin))]
  | follower rate joint => map (fun t => (fst t, faster rate (snd t))) (twist_in f Q joint)
  | _ => []
  end.

Lemma twist_in_frame f Q p : twist_of (located f) Q p = twist_in f Q p.
Proof.
  destruct f as [[[o x] y] z].
  assert (D : forall u, minus (located (o, x, y, z) u) (located (o, x, y, z) at_origin)
                        = direction (o, x, y, z) u).
  { intros u. unfold located, direction. by_coordinates. }
  assert (O : located (o, x, y, z) at_origin = o) by (unfold located; by_coordinates).
  induction p; cbn [twist_of twist_in fst]; rewrite ?D, ?O, ?IHp; reflexivity.
Qed.

Lemma twists_start Q l r : twists (located base_frame) Q l = r -> twists (fun u => u) Q l = r.
Proof. intros <-. apply twists_ext, located_base. Qed.

Lemma twists_next f Q p l g t r : twist_in f Q p = t -> next_frame f p = g ->
  twists (located g) Q l = r -> twists (located f) Q (p :: l) = t ++ r.
Proof.
  intros <- <- <-. simpl. rewrite twist_in_frame. f_equal. apply twists_ext. apply located_next.
Qed.

Lemma inward_ext l : forall F G Q, (forall u, F u = G u) -> inward F Q l = inward G Q l.
Proof.
  induction l as [|p l IH]; intros F G Q E; [reflexivity|]. simpl.
  rewrite (twist_of_ext F G) by exact E. f_equal. apply IH. intros u. apply E.
Qed.

Lemma inward_start Q l r : inward (located base_frame) Q l = r -> inward (fun u => u) Q l = r.
Proof. intros <-. apply inward_ext, located_base. Qed.

Lemma inward_next f Q p l g t r : twist_in f Q p = t -> next_frame f (reverse p) = g ->
  inward (located g) Q l = r -> inward (located f) Q (p :: l) = t ++ r.
Proof.
  intros <- <- <-. simpl. rewrite twist_in_frame. f_equal. apply inward_ext. intros u.
  apply located_next.
Qed.

Lemma seen_parts Q l after r s : inward (fun u => u) Q l = r -> twists (fun u => u) Q after = s ->
  seen Q l after = r ++ s.
Proof. intros <- <-. reflexivity. Qed.

(** ** From the question of a certificate *)

Lemma rank_of_claim q x m n k : no_singularity q -> in_set q x ->
  map (map (value (extend x (definitions q)))) (matrix q) = m -> rows q = n -> columns q = k ->
  full_column_rank n k (matrix_of m).
Proof.
  intros N S <- <- <-. destruct (proj2 N x S) as [_ K]. intros y Y. apply K. intros i I.
  rewrite <- (Y i I). apply sum_ext. intros j _. rewrite entry_of_values. reflexivity.
Qed.

Lemma extend_next names d n l v r : value names d = v -> extend (names ++ [v]) l = r ->
  n = d :: l -> extend names n = r.
Proof. intros <- <- ->. reflexivity. Qed.

Lemma regular_arm arm l Q after rows n t v m c d e :
  arm = rev l ++ after -> seen Q l after = t -> Forall (fun i => i < 6)%nat rows ->
  length rows = n -> view rows n t = map (map number) v ->
  full_column_rank n n (matrix_of (map (map number) m)) ->
  sparse_determinant n (sparse_matrix v) = Some d ->
  sparse_determinant n (sparse_matrix m) = Some e ->
  d = c * e -> c <> 0 -> full_column_rank 6 n (jacobian arm).
Proof.
  intros -> <- B L V M D E Q' C. apply (full_rank_of_view n l Q after rows B). rewrite L, V.
  apply full_rank_of_determinant. apply determinant_of_full_rank in M.
  rewrite determinant_of_sparse, E in M. rewrite determinant_of_sparse, D. simpl in *. subst d.
  apply Rmult_integral_contrapositive_currified; assumption.
Qed.

(** ** The determinant, which is a multiple of that of the certificate *)

Lemma entry_of_view rows n t i j : (i < length rows)%nat -> (j < n)%nat ->
  matrix_of (view rows n t) i j = row_of_column (nth i rows 0%nat) (S j) t.
Proof.
  intros I J. unfold matrix_of, view.
  rewrite (nth_indep _ [] (map (fun j => row_of_column 0 (S j) t) (seq 0 n)))
    by (rewrite map_size; exact I).
  rewrite (map_nth (fun i => map (fun j => row_of_column i (S j) t) (seq 0 n)) rows 0%nat i).
  apply (nth_map_seq (fun j => row_of_column (nth i rows 0%nat) (S j) t)), J.
Qed.

Lemma determinant_of_view rows n t v m c d e :
  length rows = n -> view rows n t = map (map number) v ->
  sparse_determinant n (sparse_matrix v) = Some d ->
  sparse_determinant n (sparse_matrix m) = Some e -> d = c * e ->
  determinant n (fun i j => row_of_column (nth i rows 0%nat) (S j) t)
  = c * determinant n (matrix_of (map (map number) m)).
Proof.
  intros L V D E C. rewrite !determinant_of_sparse, E. simpl. rewrite <- C.
  change d with (number (Some d)). rewrite <- D, <- determinant_of_sparse, <- V.
  apply determinant_ext. intros i j I J. rewrite entry_of_view by (rewrite ?L; assumption).
  reflexivity.
Qed.

Lemma determinant_of_arm arm l Q after rows t v m c d e :
  arm = rev l ++ after -> seen Q l after = t -> rows = seq 0 6 ->
  view rows 6 t = map (map number) v ->
  sparse_determinant 6 (sparse_matrix v) = Some d ->
  sparse_determinant 6 (sparse_matrix m) = Some e -> d = c * e ->
  determinant 6 (jacobian arm) = c * determinant 6 (matrix_of (map (map number) m)).
Proof.
  intros -> <- -> V D E C. rewrite (determinant_seen l Q).
  rewrite <- (determinant_of_view (seq 0 6) 6 _ v m c d e eq_refl V D E C).
  apply determinant_ext. intros i j I _. rewrite seq_nth by exact I. reflexivity.
Qed.

Lemma determinant_of_rows arm l Q after k rows n t v m c d e :
  arm = rev l ++ after -> seen Q l after = t -> length l = k -> length rows = n ->
  view rows n t = map (map number) v ->
  sparse_determinant n (sparse_matrix v) = Some d ->
  sparse_determinant n (sparse_matrix m) = Some e -> d = c * e ->
  determinant n (rows_of rows (jacobian_seen k Q arm))
  = c * determinant n (matrix_of (map (map number) m)).
Proof.
  intros -> <- <- L V D E C. rewrite <- (determinant_of_view rows n _ v m c d e L V D E C).
  apply determinant_ext. intros i j _ _. apply same_as_seen.
Qed.

(** The other rows are zeros. *)
Lemma dependent_arm arm l Q after rows others n t v m c d e :
  arm = rev l ++ after -> seen Q l after = t -> length rows = n ->
  forallb (fun i => existsb (Nat.eqb i) (rows ++ others)) (seq 0 6) = true ->
  view others n t = map (fun _ => map (fun _ => 0) (seq 0 n)) others ->
  view rows n t = map (map number) v ->
  sparse_determinant n (sparse_matrix v) = Some d ->
  sparse_determinant n (sparse_matrix m) = Some e -> d = c * e ->
  determinant n (matrix_of (map (map number) m)) = 0 ->
  columns_depend 6 n (jacobian arm).
Proof.
  intros -> <- L B Z V D E C M.
  pose proof (determinant_of_view rows n _ v m c d e L V D E C) as H. rewrite M, Rmult_0_r in H.
  destruct (kernel_of_determinant n _ H) as (y & K & Y). exists y. split; [|exact Y].
  apply (no_motion_seen l Q). apply no_coordinates. intros i I.
  rewrite coordinate_motion. rewrite forallb_forall in B.
  specialize (B i (proj2 (in_seq 6 0 i) ltac:(lia))). apply existsb_exists in B as (h & A & B).
  apply Nat.eqb_eq in B. subst h. apply in_app_or in A as [A|A].
  - destruct (In_nth rows i 0%nat A) as (p & P & <-). apply K. rewrite <- L. exact P.
  - destruct (In_nth others i 0%nat A) as (p & P & <-). apply sum_zero. intros k N.
    rewrite <- (entry_of_view others n) by assumption. rewrite Z. unfold matrix_of.
    rewrite (nth_indep _ [] (map (fun _ => 0) (seq 0 n))) by (rewrite map_size; exact P).
    rewrite (map_nth (fun _ => map (fun _ => 0) (seq 0 n)) others 0%nat p).
    rewrite (nth_map_seq (fun _ => 0)) by exact N. ring.
Qed.

Lemma large_of_claim q scales threshold x m n : determinant_above q scales threshold ->
  in_set q x -> map (map (value (extend x (definitions q)))) (matrix q) = m -> columns q = n ->
  product (map (value (extend x (definitions q))) scales) = 1 ->
  value [] threshold < Rabs (determinant n (matrix_of m)).
Proof.
  intros [_ [_ [_ A]]] S <- <- P. destruct (A x S) as [_ [_ D]].
  unfold scaled_determinant in D. rewrite (determinant_of_values _ _ _ eq_refl), P, Rmult_1_r in D.
  exact D.
Qed.

Lemma small_of_certificate q scales x m n u :
  map (map (value (extend x (definitions q)))) (matrix q) = m -> columns q = n ->
  product (map (value (extend x (definitions q))) scales) = 1 ->
  small_determinant q scales x <= u -> Rabs (determinant n (matrix_of m)) <= u.
Proof.
  intros <- <- P D. unfold small_determinant in D.
  rewrite (determinant_of_values _ _ _ eq_refl), P, Rmult_1_r in D. exact D.
Qed.

Lemma large_multiple a c d u limit : a = c * d -> u < Rabs d -> c <> 0 -> limit <= Rabs c * u ->
  limit < Rabs a.
Proof.
  intros -> D C L. rewrite Rabs_mult. pose proof (Rabs_pos_lt c C). nra.
Qed.
Lemma small_multiple a c d u limit : a = c * d -> Rabs d <= u -> Rabs c * u <= limit ->
  Rabs a <= limit.
Proof. intros -> D L. rewrite Rabs_mult. pose proof (Rabs_pos c). nra. Qed.
Lemma zero_multiple a c d : a = c * d -> d = 0 -> a = 0.
Proof. intros -> ->. ring. Qed.

(** ** How the proofs of a file go: the sines and cosines of all angles of the arm and of the
    question become variables, or numbers; then both matrices consist of polynomials. *)

Lemma value_of_angle a : exists c s, cos a = c /\ sin a = s /\ s ^ 2 = 1 - c ^ 2.
Proof. exists (cos a), (sin a). repeat split. apply pythagoras. Qed.

Lemma value_of_inverse d : exists i, / d = i.
Proof. exists (/ d). reflexivity. Qed.

Lemma no_angle a : a = 0 -> cos a = 1 /\ sin a = 0.
Proof. intros ->. split; [apply cos_0|apply sin_0]. Qed.
Lemma right_angle a : a = PI / 2 -> cos a = 0 /\ sin a = 1.
Proof. intros ->. split; [apply cos_PI2|apply sin_PI2]. Qed.
Lemma half_turn a : a = PI -> cos a = -1 /\ sin a = 0.
Proof. intros ->. split; [apply cos_PI|apply sin_PI]. Qed.

Lemma negative_angle a c s t : cos a = c -> sin a = s -> t = - a -> cos t = c /\ sin t = - s.
Proof. intros <- <- ->. split; [apply cos_neg|apply sin_neg]. Qed.

Lemma three_right_angles a : a = 3 * (PI / 2) -> cos a = 0 /\ sin a = -1.
Proof. intros ->. split; [apply cos_3PI2|apply sin_3PI2]. Qed.
Lemma whole_turn a : a = 2 * PI -> cos a = 1 /\ sin a = 0.
Proof. intros ->. split; [apply cos_2PI|apply sin_2PI]. Qed.

Lemma right_angle_back a : a = - (PI / 2) -> cos a = 0 /\ sin a = -1.
Proof. intros ->. rewrite cos_neg, sin_neg, cos_PI2, sin_PI2. split; ring. Qed.
Lemma half_turn_back a : a = - PI -> cos a = -1 /\ sin a = 0.
Proof. intros ->. rewrite cos_neg, sin_neg, cos_PI, sin_PI. split; ring. Qed.
Lemma three_right_angles_back a : a = - (3 * (PI / 2)) -> cos a = 0 /\ sin a = 1.
Proof. intros ->. rewrite cos_neg, sin_neg, cos_3PI2, sin_3PI2. split; ring. Qed.

Lemma equal_angle a b c s : cos b = c -> sin b = s -> a = b -> cos a = c /\ sin a = s.
Proof. intros <- <- ->. split; reflexivity. Qed.

Lemma sum_of_angles a b ca sa cb sb : cos a = ca -> sin a = sa -> cos b = cb -> sin b = sb ->
  cos (a + b) = ca * cb - sa * sb /\ sin (a + b) = sa * cb + ca * sb.
Proof. intros <- <- <- <-. split; [apply cos_plus|apply sin_plus]. Qed.

Lemma difference_of_angles a b ca sa cb sb : cos a = ca -> sin a = sa -> cos b = cb -> sin b = sb ->
  cos (a - b) = ca * cb + sa * sb /\ sin (a - b) = sa * cb - ca * sb.
Proof. intros <- <- <- <-. split; [apply cos_minus|apply sin_minus]. Qed.

Ltac simpler H :=
  lazymatch type of H with _ = ?e => ring_simplify e in H end.

Ltac keep_values V :=
  let C := fresh "C" in let S := fresh "S" in destruct V as [C S]; try simpler C; try simpler S.

Ltac special_angle a :=
  let V := fresh in
  first [ pose proof (no_angle a ltac:(lra)) as V
        | pose proof (right_angle a ltac:(lra)) as V
        | pose proof (right_angle_back a ltac:(lra)) as V
        | pose proof (half_turn a ltac:(lra)) as V
        | pose proof (half_turn_back a ltac:(lra)) as V
        | pose proof (three_right_angles a ltac:(lra)) as V
        | pose proof (three_right_angles_back a ltac:(lra)) as V
        | pose proof (whole_turn a ltac:(lra)) as V ];
  destruct V.

Ltac equal_to_known a :=
  match goal with
  | C : cos ?b = ?c, S : sin ?b = ?s |- _ =>
      let V := fresh in pose proof (equal_angle a b c s C S ltac:(lra)) as V; destruct V
  end.

Ltac opposite_to_known a :=
  match goal with
  | C : cos ?b = ?c, S : sin ?b = ?s |- _ =>
      let V := fresh in pose proof (negative_angle b c s a C S ltac:(lra)) as V; keep_values V
  end.

(** Adds hypotheses about the cosine and the sine of an angle. *)
Ltac know_angle a :=
  lazymatch goal with
  | _ : cos a = _ |- _ => idtac
  | _ =>
    lazymatch a with
    | - ?b => know_angle b;
        match goal with C : cos b = ?c, S : sin b = ?s |- _ =>
          let V := fresh in pose proof (negative_angle b c s a C S eq_refl) as V; keep_values V end
    | _ =>
      first
      [ is_var a
      | special_angle a
      | lazymatch a with
        | ?b + ?d => know_angle b; know_angle d;
          match goal with C : cos b = ?c, S : sin b = ?s, C' : cos d = ?c', S' : sin d = ?s' |- _ =>
            let V := fresh in
            pose proof (sum_of_angles b d c s c' s' C S C' S') as V; keep_values V end
        | ?b - ?d => know_angle b; know_angle d;
          match goal with C : cos b = ?c, S : sin b = ?s, C' : cos d = ?c', S' : sin d = ?s' |- _ =>
            let V := fresh in
            pose proof (difference_of_angles b d c s c' s' C S C' S') as V; keep_values V end
        end
      | equal_to_known a
      | opposite_to_known a
      | idtac ];
      lazymatch goal with
      | _ : cos a = _ |- _ => idtac
      | _ => let c := fresh "c" in let s := fresh "s" in let P := fresh "P" in
             let C := fresh "C" in let S := fresh "S" in
             destruct (value_of_angle a) as [c [s [C [S P]]]]
      end
    end
  end.

Ltac know_angles_of_goal :=
  repeat match goal with
  | |- context [along_x _ ?a] =>
      lazymatch goal with _ : cos a = _ |- _ => fail | _ => know_angle a end
  | |- context [along_z _ ?a] =>
      lazymatch goal with _ : cos a = _ |- _ => fail | _ => know_angle a end
  | |- context [turn_by _ ?a] =>
      lazymatch goal with _ : cos a = _ |- _ => fail | _ => know_angle a end
  | |- context [revolute _ _ ?a] =>
      lazymatch goal with _ : cos a = _ |- _ => fail | _ => know_angle a end
  end.

Ltac know_angles_of M :=
  repeat match type of M with context [cos ?a] => know_angle a;
    match goal with C : cos a = _ |- _ => rewrite C in M end end;
  repeat match type of M with context [sin ?a] => know_angle a;
    match goal with S : sin a = _ |- _ => rewrite S in M end end.

Ltac hide_inverses :=
  unfold Rdiv in *;
  repeat match goal with |- context [/ IZR ?d] =>
    let I := fresh "I" in let i := fresh "i" in destruct (value_of_inverse (IZR d)) as [i I];
    rewrite I;
    repeat match goal with
    | C : cos ?a = _ |- _ => lazymatch a with context [/ IZR d] => rewrite I in C end
    | S : sin ?a = _ |- _ => lazymatch a with context [/ IZR d] => rewrite I in S end
    end
  end.

Ltac known_values :=
  rewrite ?cos_neg, ?sin_neg;
  repeat match goal with
  | C : cos ?a = _ |- context [cos ?a] => rewrite C
  | S : sin ?a = _ |- context [sin ?a] => rewrite S
  end.

Ltac arm_computed := cbv -[Rplus Rminus Rmult Ropp Rinv Rdiv Rle Rlt Rabs IZR PI sin cos atan exp ln
  R_sqrt.sqrt].

Ltac normal_number :=
  known_values; match goal with |- ?a = _ => try ring_simplify a end; reflexivity.
Ltac normal_point := apply same_point; normal_number.

Lemma same_frame (a b c d e f g h : point) : a = e -> b = f -> c = g -> d = h ->
  (a, b, c, d) = (e, f, g, h).
Proof. intros; subst; reflexivity. Qed.
Lemma same_twist (k : nat) (v w x y : point) : v = x -> w = y -> [(k, (v, w))] = [(k, (x, y))].
Proof. intros; subst; reflexivity. Qed.

Ltac normal_frame := arm_computed; apply same_frame; normal_point.
Ltac normal_twist := arm_computed; first [exact (eq_refl []) | apply same_twist; normal_point].

Ltac all_twists :=
  lazymatch goal with
  | |- twists (located _) _ [] = _ => exact (eq_refl [])
  | |- inward (located _) _ [] = _ => exact (eq_refl [])
  | |- twists (located ?f) ?Q (?p :: ?l) = _ =>
      eapply (twists_next f Q p l); [normal_twist | normal_frame | all_twists]
  | |- inward (located ?f) ?Q (?p :: ?l) = _ =>
      eapply (inward_next f Q p l); [normal_twist | normal_frame | all_twists]
  end.
Ltac twists_seen :=
  apply seen_parts; [apply inward_start | apply twists_start]; all_twists.

Ltac sparse_entry e := lazymatch e with 0 => constr:(@None R) | _ => constr:(Some e) end.
Ltac sparse_row r := lazymatch r with
  | ?e :: ?l => let a := sparse_entry e in let b := sparse_row l in constr:(a :: b)
  | _ => constr:(@nil (option R)) end.
Ltac sparse_rows m := lazymatch m with
  | ?r :: ?l => let a := sparse_row r in let b := sparse_rows l in constr:(a :: b)
  | _ => constr:(@nil (list (option R))) end.

Ltac normal_rows := arm_computed; repeat apply same_head;
  first [apply same_end | (match goal with |- ?a = _ => try ring_simplify a end; reflexivity)].

Ltac names_of words :=
  lazymatch goal with |- extend ?n ?l = _ =>
    let l' := eval hnf in l in
    lazymatch l' with
    | [] => exact (eq_refl n)
    | ?d :: ?rest => first
      [ lazymatch words with ?w :: ?more =>
          eapply (extend_next n d l rest); [| | reflexivity];
          [instantiate (1 := w); computed; linear | cbv [app]; names_of more] end
      | let v := eval cbv -[Rplus Rminus Rmult Ropp Rinv Rdiv Rle Rlt Rabs IZR PI sin cos atan exp
           ln R_sqrt.sqrt] in (value n d) in
        apply (extend_next n d l rest v); [reflexivity | cbv [app]; names_of words | reflexivity] ]
    end
  end.
Ltac arm_computed_in M := cbv -[Rplus Rminus Rmult Ropp Rinv Rdiv Rle Rlt Rabs IZR PI sin cos atan
  exp ln R_sqrt.sqrt full_column_rank matrix_of determinant] in M.

(** The facts s^2 = 1 - c^2, as many as [ring] is given below. *)
Ltac name_square E :=
  first [ match goal with P : ?s ^ 2 = 1 - ?c ^ 2 |- _ =>
            lazymatch goal with _ : (s ^ 2 = 1 - c ^ 2) /\ True |- _ => fail | _ => idtac end;
            pose proof (conj P Coq.Init.Logic.I) as E; clear P end
        | let P := fresh in
          destruct (value_of_angle 1) as [? [? [_ [_ P]]]];
          pose proof (conj P Coq.Init.Logic.I) as E;
          clear P ].
Ltac same_polynomial :=
  let E1 := fresh in let E2 := fresh in let E3 := fresh in let E4 := fresh in
  let E5 := fresh in let E6 := fresh in let E7 := fresh in let E8 := fresh in
  let E9 := fresh in let E10 := fresh in
  name_square E1; name_square E2; name_square E3; name_square E4; name_square E5; name_square E6;
  name_square E7; name_square E8; name_square E9; name_square E10;
  destruct E1 as [E1 _], E2 as [E2 _], E3 as [E3 _], E4 as [E4 _], E5 as [E5 _], E6 as [E6 _],
    E7 as [E7 _], E8 as [E8 _], E9 as [E9 _], E10 as [E10 _];
  field [E1 E2 E3 E4 E5 E6 E7 E8 E9 E10].
Ltac show_inverses := repeat match goal with I : / IZR ?d = ?i |- _ => subst i end.

Lemma tall_arm arm l Q after rows n t m r :
  arm = rev l ++ after -> seen Q l after = t -> Forall (fun i => i < 6)%nat rows ->
  length rows = r -> view rows n t = m -> full_column_rank r n (matrix_of m) ->
  full_column_rank 6 n (jacobian arm).
Proof. intros -> <- B <- <- M. exact (full_rank_of_view n l Q after rows B M). Qed.

Lemma wide_arm arm l Q after n t m :
  arm = rev l ++ after -> seen Q l after = t -> view_by_joints n t = m ->
  full_column_rank n 6 (matrix_of m) -> full_row_rank 6 n (jacobian arm).
Proof. intros -> <- <- M. exact (full_row_rank_of_view n l Q after M). Qed.

(** Numbers of a file are real. *)
Ltac naturals l := lazymatch l with
  | ?k :: ?more => let n := natural k in let rest := naturals more in constr:(n :: rest)
  | _ => constr:(@nil nat) end.

Ltac hide_words words := lazymatch words with
  | ?w :: ?more => first [is_var w | let u := fresh "u" in set (u := w) in *; clearbody u];
    hide_words more
  | _ => idtac end.

(** [M] is about the matrix of the question [q] at [x], by the values [words] of its joints. *)
Ltac in_words q x words M :=
  let N := fresh in
  eassert (N : extend x (definitions q) = _) by names_of words; rewrite N in M; clear N;
  hide_words words; coordinates; arm_computed_in M; rewrite ?Rinv_1, ?Rmult_1_r, ?Rmult_0_l in M;
  know_angles_of M.

(** What a claim says of the matrix of the certificate, by the quantities of the robot: its rank, or
    the size of its determinant. *)
Ltac no_scales := computed; first [reflexivity | ring |
  fail 1 "no proof that the rows of the certificate have no scales"].
Ltac matrix_of_certificate claim x words S M :=
  let I := fresh in
  lazymatch type of claim with
  | no_singularity ?q =>
    assert (I : in_set q x) by in_certificate S;
    pose proof (rank_of_claim q x _ _ _ claim I eq_refl eq_refl eq_refl) as M; clear S I;
    in_words q x words M
  | determinant_above ?q ?scales ?threshold =>
    assert (I : in_set q x) by in_certificate S;
    pose proof (large_of_claim q scales threshold x _ _ claim I eq_refl eq_refl
      ltac:(no_scales)) as M; clear S I;
    in_words q x words M
  end.

(** The arm as a list, and its twists as seen from behind its first [k] parts at the point [Q]. *)
Ltac arm_of_goal := lazymatch goal with
  | |- context [jacobian ?a] => a
  | |- context [jacobian_seen _ _ ?a] => a end.
Ltac arm_in_parts k Q A V :=
  let a := arm_of_goal in
  let a' := eval cbv -[Rplus Rminus Rmult Ropp Rinv Rdiv IZR PI sin cos atan exp ln R_sqrt.sqrt
      Rabs] in a in
  change a with a';
  know_angles_of_goal;
  let P := fresh in pose proof (eq_refl Q) as P; revert P; hide_inverses; intros P;
  lazymatch type of P with ?Q' = _ => clear P;
    let a := arm_of_goal in
    let n := natural k in
    let b := eval cbv [firstn rev app] in (rev (firstn n a)) in
    let e := eval cbv [skipn] in (skipn n a) in
    eassert (V : seen Q' b e = _) by twists_seen; cbv [app] in V;
    assert (A : a = rev b ++ e) by reflexivity
  end.

Ltac same_jacobian := show_inverses; same_polynomial.
Ltac other_jacobian := fail 2
  "no proof that the matrix of the certificate is that of the arm of the model file".

(** The zeros of both matrices. *)
Ltac arm_matrices rows M V W :=
  lazymatch type of M with context [matrix_of ?m] =>
    lazymatch type of V with _ = ?t =>
      let n := lazymatch type of M with
        | full_column_rank _ ?n _ => n | context [determinant ?n _] => n end in
      eassert (W : view rows n t = _) by normal_rows end;
    lazymatch type of W with _ = ?v =>
      let v' := sparse_rows v in change v with (map (map number) v') in W end;
    let m' := sparse_rows m in change m with (map (map number) m') in M
  end.

(** [claim] is about the question of a certificate, at the point [x] of its set; [S] says that the
    quantities of the arm are in theirs. Rows of the Jacobian, as seen from a link, have [c] times
    the determinant of the matrix of the certificate. *)
Ltac by_arm claim x words k Q rows c S :=
  let M := fresh "M" in let A := fresh "A" in let V := fresh "V" in let W := fresh "W" in
  matrix_of_certificate claim x words S M;
  arm_in_parts k Q A V;
  let rows' := naturals rows in
  arm_matrices rows' M V W;
  refine (regular_arm _ _ _ _ rows' _ _ _ _ c _ _ A V _ eq_refl W M _ _ _ _);
  [ repeat constructor | arm_computed; reflexivity | arm_computed; reflexivity
  | clear M V W A; first [same_jacobian | other_jacobian] | lra ].

(** A determinant of the goal is [c] times that of the matrix of the certificate. *)
Ltac arm_determinant rows c M A V W E :=
  let rows' := naturals rows in
  arm_matrices rows' M V W;
  let m := lazymatch type of M with context [map (map number) ?m] => m end in
  lazymatch goal with
  | |- context [jacobian_seen] =>
    epose proof (determinant_of_rows _ _ _ _ _ rows' _ _ _ m c _ _ A V eq_refl eq_refl W) as E
  | |- _ => epose proof (determinant_of_arm _ _ _ _ rows' _ _ m c _ _ A V eq_refl W) as E
  end;
  specialize (E ltac:(arm_computed; reflexivity) ltac:(arm_computed; reflexivity)
    ltac:(clear M V W A; first [same_jacobian | other_jacobian])).

Ltac size_of_number := first [rewrite Rabs_right by lra | rewrite Rabs_left by lra].
Ltac by_large_arm claim x words k Q rows c S :=
  let M := fresh "M" in let A := fresh "A" in let V := fresh "V" in let W := fresh "W" in
  let E := fresh "E" in
  matrix_of_certificate claim x words S M;
  arm_in_parts k Q A V; arm_determinant rows c M A V W E;
  refine (large_multiple _ c _ _ _ E M _ _); show_inverses; clear;
  [lra | size_of_number; lower_threshold].

(** The same where the rows of the certificate are those of the Jacobian, or its columns if there
    are more joints than six. *)
Ltac by_rows_of_arm claim x words k Q rows S :=
  let M := fresh "M" in let A := fresh "A" in let V := fresh "V" in
  matrix_of_certificate claim x words S M;
  arm_in_parts k Q A V;
  first [ let rows' := naturals rows in refine (tall_arm _ _ _ _ rows' _ _ _ _ A V _ eq_refl _ M);
          [repeat constructor |]
        | refine (wide_arm _ _ _ _ _ _ _ A V _ M) ];
  clear M V A; arm_computed; repeat apply same_head;
  first [apply same_end | same_jacobian | other_jacobian].

(** [D] is about the determinant of a certificate at a point of its set; [W] has the values of
    joints there. *)
Ltac at_pose_of_arm D W k Q rows c close :=
  repeat match goal with r : _ <= _ <= _ |- _ => clear r end;
  cbv [quantity nth] in W; cbv [quantity nth];
  let words := lazymatch type of W with ?w = _ => w end in clear W;
  let M := fresh "M" in let A := fresh "A" in let V := fresh "V" in let Z := fresh "Z" in
  lazymatch type of D with
  | determinant _ (entry ?q (extend ?x _)) = 0 =>
    pose proof (singular_of_values q x _ _ eq_refl eq_refl D) as M; clear D; in_words q x words M
  | small_determinant ?q ?scales ?x <= _ =>
    pose proof (small_of_certificate q scales x _ _ _ eq_refl eq_refl ltac:(no_scales) D) as M;
    clear D; in_words q x words M
  end;
  arm_in_parts k Q A V; close M A V Z.

(** The rows that the certificate leaves out are zeros. *)
Ltac dependent_columns rows c M A V W :=
  let rows' := naturals rows in
  let others := eval cbv in
    (filter (fun i => negb (existsb (Nat.eqb i) rows')) (seq 0 6)) in
  arm_matrices rows' M V W;
  refine (dependent_arm _ _ _ _ rows' others _ _ _ _ c _ _ A V eq_refl _ _ W _ _ _ M);
  [ reflexivity
  | first [arm_computed; repeat apply same_head; first [apply same_end | ring | same_jacobian]
          | fail 1 "no proof that the other rows of the Jacobian are zeros"]
  | arm_computed; reflexivity | arm_computed; reflexivity
  | clear M V W A; first [same_jacobian | other_jacobian] ].

(** At the pose [S] of a certificate the determinant of an arm is 0; or at most the threshold. *)
Ltac by_singular_arm S words k Q rows c :=
  let W := fresh "W" in pose proof (eq_refl words) as W;
  by_pose S ltac:(fun D => at_pose_of_arm D W k Q rows c ltac:(fun M A V Z =>
    lazymatch goal with
    | |- columns_depend _ _ _ => dependent_columns rows c M A V Z
    | |- _ => let E := fresh "E" in arm_determinant rows c M A V Z E;
              exact (zero_multiple _ c _ E M)
    end)).
Ltac by_small_arm S words k Q rows c :=
  let W := fresh "W" in pose proof (eq_refl words) as W;
  by_pose S ltac:(fun D => at_pose_of_arm D W k Q rows c ltac:(fun M A V Z =>
    let E := fresh "E" in arm_determinant rows c M A V Z E;
    refine (small_multiple _ c _ _ _ E M _); show_inverses; clear; size_of_number;
    lower_threshold)).
