(* SPDX-License-Identifier: Apache-2.0 *)
(** The geometry of a robot in real numbers, and how a theorem about it follows from one about the
    question of a certificate. The definitions are those to read: points, rotations, legs. *)
From Coq Require Export Reals List.
From Coq Require Import QArith Qreals Lra Lia.
From Regulus Require Export LinearAlgebra.
From Interval Require Import Tactic.
From Regulus Require Import Expressions Questions Regularity Determinants.
Export ListNotations.
Global Open Scope R_scope.

Notation pi := PI.
(** An angle of so many degrees is a multiple of this. *)
Definition deg : R := PI / 180.

(** ** Points, which are also vectors *)

Definition point : Type := R * R * R.
Definition first (p : point) : R := fst (fst p).
Definition second (p : point) : R := snd (fst p).
Definition third (p : point) : R := snd p.

Definition plus (u v : point) : point :=
  let '(a, b, c) := u in let '(d, e, f) := v in (a + d, b + e, c + f).
Definition minus (u v : point) : point :=
  let '(a, b, c) := u in let '(d, e, f) := v in (a - d, b - e, c - f).
Definition cross (u v : point) : point :=
  let '(a, b, c) := u in let '(d, e, f) := v in (b * f - c * e, c * d - a * f, a * e - b * d).

(** ** What is close to what: numbers, and points by coordinates or by their distance *)

Definition near (e c x : R) : Prop := c - e <= x <= c + e.
Definition in_cube (e : R) (c p : point) : Prop :=
  near e (first c) (first p) /\ near e (second c) (second p) /\ near e (third c) (third p).
Definition in_ball (e : R) (c p : point) : Prop :=
  (first p - first c) ^ 2 + (second p - second c) ^ 2 + (third p - third c) ^ 2 <= e ^ 2.

(** ** Rotations *)

Definition about_x (t : R) (u : point) : point :=
  let '(a, b, c) := u in (a, cos t * b - sin t * c, sin t * b + cos t * c).
Definition about_y (t : R) (u : point) : point :=
  let '(a, b, c) := u in (cos t * a + sin t * c, b, cos t * c - sin t * a).
Definition about_z (t : R) (u : point) : point :=
  let '(a, b, c) := u in (cos t * a - sin t * b, sin t * a + cos t * b, c).

Definition euler_zxz (psi theta phi : R) (u : point) : point :=
  about_z psi (about_x theta (about_z phi u)).
Definition roll_pitch_yaw (roll pitch yaw : R) (u : point) : point :=
  about_z yaw (about_y pitch (about_x roll u)).

(** The rotation of the quaternion q0 + q1 i + q2 j + q3 k, which may have any length but 0. *)
Definition quaternion (q0 q1 q2 q3 : R) (u : point) : point :=
  let '(a, b, c) := u in
  let n := q0 ^ 2 + q1 ^ 2 + q2 ^ 2 + q3 ^ 2 in
  (((q0 ^ 2 + q1 ^ 2 - q2 ^ 2 - q3 ^ 2) * a + 2 * (q1 * q2 - q0 * q3) * b
    + 2 * (q1 * q3 + q0 * q2) * c) / n,
   (2 * (q1 * q2 + q0 * q3) * a + (q0 ^ 2 - q1 ^ 2 + q2 ^ 2 - q3 ^ 2) * b
    + 2 * (q2 * q3 - q0 * q1) * c) / n,
   (2 * (q1 * q3 - q0 * q2) * a + 2 * (q2 * q3 + q0 * q1) * b
    + (q0 ^ 2 - q1 ^ 2 - q2 ^ 2 + q3 ^ 2) * c) / n).

(** ** Platforms on six legs, or more *)

(** The anchor on the base and the anchor on the platform. *)
Definition leg : Type := point * point.

(** A platform is at [p], turned by [turn]. The row of a leg is the vector d from anchor to anchor,
    and its moment about the centre of the platform. *)
Definition row_of_leg (p : point) (turn : point -> point) (l : leg) : list R :=
  let (a, b) := l in
  let arm := turn b in
  let d := minus (plus p arm) a in
  let m := cross arm d in
  [first d; second d; third d; first m; second m; third m].

Definition matrix_of (m : list (list R)) (i j : nat) : R := nth j (nth i m []) 0.

Definition gough (legs : list leg) (p : point) (turn : point -> point) : nat -> nat -> R :=
  matrix_of (map (row_of_leg p turn) legs).

(** With unit vectors along the legs, as a threshold takes them. *)
Definition length_of_leg (p : point) (turn : point -> point) (l : leg) : R :=
  let (a, b) := l in
  let d := minus (plus p (turn b)) a in
  sqrt (first d ^ 2 + second d ^ 2 + third d ^ 2).

Definition divided (s : list R) (m : nat -> nat -> R) (i j : nat) : R := m i j / nth i s 1.

Definition inverse_jacobian (legs : list leg) (p : point) (turn : point -> point) :
    nat -> nat -> R :=
  divided (map (length_of_leg p turn) legs) (gough legs p turn).

(** ** From the question of a certificate *)

Lemma in_set_of_lists q x : Forall2 in_range x (ranges q) ->
  Forall (fun c => value (extend x (definitions q)) c <= 0) (constraints q) -> in_set q x.
Proof.
  intros R C. split; [exact R|]. intros c I. simpl. intros _.
  rewrite Forall_forall in C. exact (C c I).
Qed.

Lemma entry_of_values q names i j :
  entry q names i j = matrix_of (map (map (value names)) (matrix q)) i j.
Proof.
  unfold entry, matrix_of.
  change (@nil R) with (map (value names) []). rewrite map_nth.
  replace 0 with (value names no_entry) by (unfold no_entry, Q2R; simpl; lra).
  rewrite map_nth. reflexivity.
Qed.

Lemma matrix_of_multiple c m i j :
  matrix_of (map (map (Rmult c)) m) i j = c * matrix_of m i j.
Proof.
  unfold matrix_of.
  change (@nil R) with (map (Rmult c) []) at 1. rewrite map_nth.
  replace 0 with (c * 0) at 1 by lra. rewrite map_nth. reflexivity.
Qed.

Fixpoint all_of (l : list Prop) : Prop :=
  match l with [] => True | p :: rest => p /\ all_of rest end.

Lemma all_of_forall {A} (P : A -> Prop) l : Forall P l -> all_of (map P l).
Proof. induction 1; simpl; auto. Qed.

(** The matrix of the question may be a multiple of that of the robot. *)
Lemma full_rank_of_claim q x c l m n : no_singularity q -> in_set q x ->
  (all_of (map (defined (extend x (definitions q))) (also_defined q)) ->
   map (map (value (extend x (definitions q)))) (matrix q) = map (map (Rmult c)) l) ->
  rows q = m -> columns q = n -> full_column_rank m n (matrix_of l).
Proof.
  intros [_ N] S E <- <- y Y. destruct (N x S) as [[_ [D _]] K].
  specialize (E (all_of_forall _ _ D)). apply K. intros i I.
  rewrite (sum_ext _ _ (fun j => c * (matrix_of l i j * y j))).
  - rewrite sum_scale, Y by exact I. lra.
  - intros j _. rewrite entry_of_values, E, matrix_of_multiple. lra.
Qed.

Fixpoint product_of (n : nat) (s : nat -> R) : R :=
  match n with O => 1 | S m => s O * product_of m (fun i => s (S i)) end.

Lemma determinant_of_multiples n : forall s a,
  determinant n (fun i j => s i * a i j) = product_of n s * determinant n a.
Proof.
  induction n as [|n IH]; intros s a; [simpl; lra|].
  cbn [determinant product_of]. rewrite <- sum_scale. apply sum_ext. intros j _.
  rewrite (IH (fun i => s (S i)) (fun i k => a (S i) (skip j k))). lra.
Qed.

Lemma product_of_inverses s :
  product (map Rinv s) = product_of (length s) (fun i => / nth i s 1).
Proof. induction s as [|a s IH]; [reflexivity|]. simpl. rewrite <- IH. reflexivity. Qed.

Lemma determinant_divided s m :
  determinant (length s) (divided s m) = determinant (length s) m * product (map Rinv s).
Proof.
  rewrite product_of_inverses, Rmult_comm, <- determinant_of_multiples.
  apply determinant_ext. intros i j _ _. unfold divided. lra.
Qed.

Lemma determinant_of_values q x l :
  map (map (value (extend x (definitions q)))) (matrix q) = l ->
  determinant (columns q) (entry q (extend x (definitions q)))
  = determinant (columns q) (matrix_of l).
Proof. intros <-. apply determinant_ext. intros i j _ _. apply entry_of_values. Qed.

Lemma above_of_claim q scales threshold x limit l s n : determinant_above q scales threshold ->
  in_set q x -> map (map (value (extend x (definitions q)))) (matrix q) = l ->
  map (value (extend x (definitions q))) scales = map Rinv s ->
  columns q = n -> length s = n -> limit <= value [] threshold ->
  limit < Rabs (determinant n (divided s (matrix_of l))).
Proof.
  intros [_ [_ [_ A]]] S M E <- L T. destruct (A x S) as [_ [_ D]].
  unfold scaled_determinant in D. rewrite (determinant_of_values _ _ _ M), E in D.
  rewrite <- L, determinant_divided, L. lra.
Qed.

(** The k-th quantity of a certificate. *)
Definition quantity (v : list R) (k : nat) : R := nth k v 0.
Definition no_quantities : list R := [].

Lemma singular_of_claim q : singularity q -> exists v, Forall2 in_range v (ranges q) /\
  determinant (columns q) (entry q (extend v (definitions q))) = 0.
Proof. intros [v [[F _] [_ [_ D]]]]. exists v. auto. Qed.

Lemma singular_of_values q x l n : columns q = n ->
  map (map (value (extend x (definitions q)))) (matrix q) = l ->
  determinant (columns q) (entry q (extend x (definitions q))) = 0 ->
  determinant n (matrix_of l) = 0.
Proof. intros <- E. rewrite (determinant_of_values _ _ _ E). auto. Qed.

Definition small_determinant (q : question) (scales : list expression) (v : list R) : R :=
  Rabs (determinant (columns q) (entry q (extend v (definitions q)))
        * product (map (value (extend v (definitions q))) scales)).

Lemma small_of_claim q scales threshold : determinant_not_above q scales threshold ->
  exists v, Forall2 in_range v (ranges q) /\
    small_determinant q scales v <= value [] threshold.
Proof. intros [_ [_ [v [[F _] [_ [_ D]]]]]]. exists v. auto. Qed.

Lemma small_of_values q scales x l s n limit threshold : columns q = n ->
  map (map (value (extend x (definitions q)))) (matrix q) = l ->
  map (value (extend x (definitions q))) scales = map Rinv s -> length s = n ->
  value [] threshold <= limit -> small_determinant q scales x <= value [] threshold ->
  Rabs (determinant n (divided s (matrix_of l))) <= limit.
Proof.
  unfold small_determinant. intros <- M E L T D.
  rewrite (determinant_of_values _ _ _ M), E in D. rewrite <- L, determinant_divided, L. lra.
Qed.

Lemma quantities_of_ranges {A B} (P : A -> B -> Prop) v b m : Forall2 P v (b :: m) ->
  exists a w, v = a :: w /\ P a b /\ Forall2 P w m.
Proof. intros F. inversion F. eauto. Qed.

Lemma no_more_quantities {A B} (P : A -> B -> Prop) v : Forall2 P v [] -> v = [].
Proof. intros F. inversion F. reflexivity. Qed.

Lemma cube_of_ball e c p : 0 <= e -> in_ball e c p -> in_cube e c p.
Proof.
  unfold in_ball, in_cube, near. intros P B.
  set (a := first p - first c) in *. set (b := second p - second c) in *.
  set (d := third p - third c) in *.
  assert (T : forall t, t ^ 2 <= e ^ 2 -> - e <= t <= e).
  { intros t H. split; [apply Rnot_lt_le; intros L|apply Rnot_lt_le; intros L]; nra. }
  pose proof (pow2_ge_0 a). pose proof (pow2_ge_0 b). pose proof (pow2_ge_0 d).
  specialize (T a ltac:(lra)) as A. specialize (T b ltac:(lra)) as B'.
  specialize (T d ltac:(lra)) as D. unfold a, b, d in *. lra.
Qed.

Lemma degrees_of_degrees a : a * (PI / 180) / (PI / 180) = a.
Proof. field. exact PI_neq0. Qed.

Lemma inverse_of_root n : 0 < n -> / R_sqrt.sqrt n = R_sqrt.sqrt n * / n.
Proof.
  intros P. pose proof (sqrt_lt_R0 n P) as Q. rewrite <- (sqrt_sqrt n) at 3 by lra.
  field. lra.
Qed.

(** ** How the proofs of a file go: what the certificate computes and what the geometry says are the
    same polynomials in coordinates, sines and cosines. *)

Lemma same_head {A} (a b : A) l m : a = b -> l = m -> a :: l = b :: m.
Proof. intros; subst; reflexivity. Qed.

Lemma same_end {A} : @nil A = [].
Proof. reflexivity. Qed.

(** Numbers of a file are real. *)
Ltac natural k := lazymatch k with IZR ?z => let n := eval cbv in (Z.to_nat z) in n end.

(** Computes all that is not an operation on real numbers. *)
Ltac computed := cbv -[Rplus Rminus Rmult Ropp Rinv Rdiv Rle Rlt Rabs IZR PI sin cos atan exp ln
  R_sqrt.sqrt].
Ltac computed_in S := cbv -[Rplus Rminus Rmult Ropp Rinv Rdiv Rle Rlt Rabs IZR PI sin cos atan exp
  ln R_sqrt.sqrt] in S.

(** Values of functions become variables, one for equal arguments. Otherwise lra would compare how
    the functions are defined. *)
Ltac hide_value f a :=
  match goal with
  | v := f ?b |- _ => let E := fresh in assert (E : f a = v) by (unfold v; f_equal; lra);
                      rewrite E in *; clear E
  | _ => let v := fresh "v" in set (v := f a) in *
  end.
Ltac hide_values_of f :=
  repeat match goal with
  | |- context [f ?a] => hide_value f a
  | S : context [f ?a] |- _ => lazymatch S with _ => hide_value f a end
  end.
Ltac hide_values :=
  hide_values_of cos; hide_values_of sin; hide_values_of R_sqrt.sqrt; hide_values_of atan;
  hide_values_of exp; hide_values_of ln; hide_values_of Rabs;
  repeat match goal with v := _ : R |- _ => clearbody v end.
Ltac linear := hide_values; lra.

(** Takes points and conditions apart. *)
Ltac conditions S :=
  hnf in S; repeat match goal with S : _ /\ _ |- _ => destruct S end;
  repeat match goal with S : in_ball ?e ?c ?p |- _ =>
    assert (in_cube e c p) by (apply cube_of_ball; [computed; linear | exact S]);
    computed_in S end;
  repeat match goal with S : _ |- _ => progress computed_in S end.
Ltac coordinates :=
  repeat match goal with p : point |- _ => destruct p as [[? ?] ?] end.
Ltac inverses_of_roots :=
  repeat match goal with
  | |- context [/ R_sqrt.sqrt (IZR ?n)] => rewrite (inverse_of_root (IZR n)) by lra
  | S : context [/ R_sqrt.sqrt (IZR ?n)] |- _ => rewrite (inverse_of_root (IZR n)) in S by lra
  end.
Ltac hide_inverses_of_sums :=
  repeat match goal with
  | |- context [/ ?a] => lazymatch a with _ + _ => hide_value Rinv a end
  | S : context [/ ?a] |- _ => lazymatch a with _ + _ => hide_value Rinv a end
  end.
Ltac numbers :=
  computed; rewrite ?degrees_of_degrees in *; unfold Rdiv in *; rewrite ?Rinv_1, ?Rmult_1_r in *;
  inverses_of_roots;
  hide_inverses_of_sums; linear.

(** What divides is not 0, as the certificate says. *)
Ltac quotients D :=
  computed_in D; repeat match goal with S : _ /\ _ |- _ => destruct S end; hide_values;
  repeat apply same_head;
  first [apply same_end | lra
        | field; match goal with N : ?a = 0 -> False |- _ => intros Z; apply N; lra end].

Ltac in_certificate S :=
  coordinates; conditions S; repeat match goal with S : _ /\ _ |- _ => destruct S end;
  apply in_set_of_lists;
  [ computed; repeat apply Forall2_cons; try apply Forall2_nil;
    first [numbers | fail 1 "no proof that a range of the model file is in that of the certificate"]
  | computed; repeat apply Forall_cons; try apply Forall_nil;
    first [numbers | fail 1 "no proof that a constraint of the certificate is in the model file"] ].

Ltac same_numbers := hide_values; repeat apply same_head; first [apply same_end | lra].
Ltac same_entries D := coordinates; computed;
  first [ clear D; same_numbers | quotients D
        | fail 1 "no proof that an entry of the certificate is that of the model file" ].

(** [claim] is about the question of a certificate, at the point [x] of its set; [S] says that the
    quantities of the robot are in theirs. The matrix of the question is [c] times that of the
    robot. *)
Ltac by_geometry claim x c S :=
  apply (full_rank_of_claim _ x c _ _ _ claim);
  [ in_certificate S | let D := fresh in intros D; clear S; same_entries D
  | reflexivity | reflexivity ].

(** The same for a threshold. *)
Ltac same_scales := coordinates; computed;
  first [ same_numbers
        | fail 1 "no proof that a scale of the certificate is that of the model file" ].
Ltac lower_threshold := first [numbers |
  fail 1 "no proof that the threshold of the certificate is good enough for the model file"].
Ltac by_threshold claim x S :=
  apply (above_of_claim _ _ _ x _ _ _ _ claim);
  [ in_certificate S | clear S; let N := fresh in pose proof I as N; same_entries N
  | clear S; same_scales | reflexivity | reflexivity | lower_threshold ].

(** [S] is about a point of the set of a certificate. *)
Ltac by_pose S close :=
  let F := fresh "F" in let D := fresh "D" in destruct S as [F D];
  match type of F with Forall2 _ _ ?r => let l := eval hnf in r in change r with l in F end;
  repeat (apply quantities_of_ranges in F;
    let x := fresh "x" in let w := fresh "w" in let r := fresh "r" in
    destruct F as [x [w [-> [r F]]]]; computed_in r);
  apply no_more_quantities in F; rewrite F in *; clear F;
  split;
  [ repeat match goal with r : _ /\ _ |- _ => destruct r end; hnf; computed; repeat split;
    first [numbers | fail 1 "no proof that a range of the certificate is in that of the model file"]
  | close D ].

(** At this point the determinant is 0; or at most the threshold. *)
Ltac by_singularity S := by_pose S ltac:(fun D =>
  refine (singular_of_values _ _ _ _ _ _ D);
  [reflexivity | let N := fresh in pose proof I as N; same_entries N]).
Ltac by_small_determinant S := by_pose S ltac:(fun D =>
  refine (small_of_values _ _ _ _ _ _ _ _ _ _ _ _ _ D);
  [ reflexivity | let N := fresh in pose proof I as N; clear D; same_entries N
  | clear D; same_scales | reflexivity | clear D; lower_threshold ]).

(** A point of the set has been named. *)
Ltac by_point :=
  hnf; computed; rewrite ?degrees_of_degrees; repeat split;
  first [ lra | pose proof PI_RGT_0; hide_values; lra | interval
        | fail 1 "no proof that the point is in the set" ].
