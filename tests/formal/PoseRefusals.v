(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** Poses of a platform that are known by hand: what is false is refused, and what is true next to it
    is proved. *)
From Coq Require Import Reals Qreals Lra Lia List.
From Coq Require Import PrimFloat.
From Regulus Require Geometry.
From Regulus Require Import Expressions Questions Search Closures Tubes Branches Poses.
From Regulus Require Import Notations.
Import ListNotations.

(** The platform is at (1, 2, 6), and its frame has the directions of that of the base. The squared
    length of the last leg varies by e. *)
Definition from_to (e : expression) : question := Question [(35 - e, 35 + e)] [] [] [] [] 0.
Definition others : list (leg written) :=
  [((0, 0, 0), (0, 0, 0), 41);
   ((10, 0, 0), (3, 1, 0), 81);
   ((5, 8, 0), (1, 4, 0), 49);
   ((1, 7, 3), (-2, 2, 1), 29);
   ((-3, 2, 1), (-1, -3, 2), 67)].
Definition last : leg written := ((4, -5, 2), (2, -2, -1), Name 0).
Definition platform : list (leg written) := others ++ [last].

(** x, y, z and the directions of two axes, each within w. *)
Definition about (x y z w : expression) : line :=
  map (fun c => within c w) [x; y; z; 1; 0; 0; 0; 1; 0].
Definition here : line := about 1 2 6 0.01.

Definition are_some (q : question) (legs : list (leg written)) (lines : list line) :=
  check_some_poses q legs (Method 1 0) lines.

Theorem one_pose : some_poses (from_to 0.0001) platform [here].
Proof. apply (check_some_poses_correct _ _ (Method 1 0)). vm_compute. reflexivity. Qed.

(** A line that does not hold the pose for all lengths, one beside it, one without a width, one with
    an end without a value, one with a number too few, and the same line twice. *)
Goal map (are_some (from_to 0.0001) platform)
  [[about 1 2 6 0.0000001]; [about 1.1 2 6 0.01]; [about 1 2 6 0]; [about 1 2 6 (1/0)]; [tl here];
   [here; here]; [here; about 1 2 6 0.011]; []]
  = [false; false; false; false; false; false; false; true].
Proof. vm_compute. reflexivity. Qed.

(** Five legs, seven, a leg without a length, and one whose other end is where its anchor is: then
    the pose is not regular. *)
Goal map (fun legs => are_some (from_to 0.0001) legs [here])
  [others; last :: platform; others ++ [(fst last, Name 0/0)];
   others ++ [((4, -5, 2), (3, -7, -4), Name 0 - 35)]] = [false; false; false; false].
Proof. vm_compute. reflexivity. Qed.
(** An expression of the question has no value. *)
Goal map (fun e => are_some (Question [(35, 35)] [e] [] [] [] 0) platform [here]) [1/0; 1/2]
  = [false; true].
Proof. vm_compute. reflexivity. Qed.

(** ** Roots that are not real, and the count *)

(** The pose as a root: all its imaginary parts are 0. *)
Definition at_pose (x : float) : root :=
  ([x; 0; 2; 0; 6; 0; 1; 0; 0; 0; 0; 0; 0; 0; 1; 0; 0; 0],
   [0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10;
    0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10; 0x1p-10])%float.
Definition found (r : root) : bool :=
  match check_roots (complex_mechanism (from_to 0) platform) 1 [Intervals.integer 35] [r] with
  | Some _ => true
  | None => false
  end.
(** It is a root, and at another place there is none. *)
Goal map found [at_pose 1; at_pose 1.5] = [true; false].
Proof. vm_compute. reflexivity. Qed.

(** One pose is one; it is not two, and none. A real root is no pair of roots. *)
Goal map (fun n => check_count n (from_to 0) platform (Method 1 0) [here] []) [0; 1; 2; 40]%nat
  = [false; true; false; false].
Proof. vm_compute. reflexivity. Qed.
Goal check_count 3 (from_to 0) platform (Method 1 0) [here] [at_pose 1] = false.
Proof. vm_compute. reflexivity. Qed.
Goal check_forty_poses (from_to 0) platform (Method 1 0) [here] [] = false.
Proof. vm_compute. reflexivity. Qed.

(** Legs are in pairs only if each has one beside it. *)
Definition a : vector written := (0, 0, 0).
Definition b : vector written := (0, 1, 0).
Definition with_anchors (l : list (vector written)) : list (leg written) :=
  map (fun v => (b, v, 1) : leg written) l.
Goal map are_in_pairs
  [with_anchors [a; a; b; b; a; a]; with_anchors [a; b; b; a; a; a]; platform; []]
  = [true; true; false; false].
Proof. vm_compute. reflexivity. Qed.
Goal map (fun l => are_in_pairs (map (fun v => (v, (0, Name (length l), 1), 1) : leg written) l))
  [[a; a; b; b]; []] = [false; false].
Proof. vm_compute. reflexivity. Qed.

(** ** The claims mean what they say: without any check *)

Open Scope R_scope.

Definition real_platform : list (leg reals) :=
  [((0, 0, 0), (0, 0, 0), 41);
   ((10, 0, 0), (3, 1, 0), 81);
   ((5, 8, 0), (1, 4, 0), 49);
   ((1, 7, 3), (-2, 2, 1), 29);
   ((-3, 2, 1), (-1, -3, 2), 67);
   ((4, -5, 2), (2, -2, -1), 35)].
Definition the_pose : pose reals := ((1, 2, 6), (1, 0, 0), (0, 1, 0)).

Theorem it_is_a_pose : is_pose reals real_platform the_pose.
Proof.
  unfold is_pose. simpl. repeat (apply Forall_cons; [change (nought reals) with 0; lra|]).
  apply Forall_nil.
Qed.

(** A reflected axis is no pose, nor is another length. *)
Theorem no_other_axis : ~ is_pose reals real_platform ((1, 2, 6), (1, 0, 0), (0, -1, 0)).
Proof.
  intros P. unfold is_pose in P. simpl in P. rewrite !Forall_cons_iff in P. lra.
Qed.

(** The hypotheses are about these numbers: no poses are not all, as this platform has one. *)
Theorem none_are_not_all : ~ are_all 0 (fun _ => True).
Proof.
  intros H. apply (H real_platform [] eq_refl Logic.I eq_refl (NoDup_nil _) (Forall_nil _)
    (complex_pose the_pose)).
  exact (pose_kept _ _ _ real_keeps _ _ it_is_a_pose).
Qed.

(** What a rotation of Geometry.v does is what the images of two axes say. *)
Definition along_axes (turn : Geometry.point -> Geometry.point) (p : Geometry.point) : pose reals :=
  (p, turn (1, 0, 0), turn (0, 1, 0)).

Theorem quaternions_turn (q0 q1 q2 q3 : R) (p c : Geometry.point) :
  q0 ^ 2 + q1 ^ 2 + q2 ^ 2 + q3 ^ 2 <> 0 ->
  moved reals (along_axes (Geometry.quaternion q0 q1 q2 q3) p) c
  = Geometry.plus p (Geometry.quaternion q0 q1 q2 q3 c).
Proof.
  intros N. destruct p as [[x y] z], c as [[d e] f]. simpl in *.
  apply same_parts; match goal with |- ?e = ?g => change (@eq R e g) end; field;
    intros Z; apply N; rewrite <- Z; ring.
Qed.
