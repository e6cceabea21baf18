(* SPDX-License-Identifier: Apache-2.0 *)
(** A robot on legs in real numbers, and how a theorem about it follows from one about the question
    of a certificate. The definitions are those to read: legs by their joints, elbows, rods, rows.
    *)
From Coq Require Import Lra.
From Regulus Require Export Matrices.

Definition dot (u v : point) : R :=
  let '(a, b, c) := u in let '(d, e, f) := v in a * d + b * e + c * f.
Definition times (k : R) (u : point) : point := let '(a, b, c) := u in (k * a, k * b, k * c).

(** ** Legs by their joints, from the base to the platform *)

(** [base] is the first joint, [platform] the last one, seen from the platform. A crank turns about
    [axis]; a carriage moves along [rail]; the rod is behind it. A hinge is a revolute joint, and is
    across the rail if there is one. [bar] is along the short sides of a parallelogram. [mode] is 1
    or -1: of the two elbows, or places of the carriage, that the length of the rod permits. *)
Inductive robot_leg : Type :=
| UPS (base platform : point)
| RUS (base platform axis : point) (crank rod mode : R)
| PUS (base platform rail : point) (rod mode : R)
| RPS (base platform hinge : point)
| PRS (base platform rail hinge : point) (rod mode : R)
| UPU (base platform axis : point)
| delta (base platform axis : point) (crank rod mode : R)
| linear_delta (base platform rail bar : point) (rod mode : R).

Definition SPS := UPS.
Definition RSS := RUS.
Definition PSS := PUS.

(** In the plane. *)
Definition flat (u : R * R) : point := (fst u, snd u, 0).
Definition RPR (base platform : R * R) : robot_leg := UPS (flat base) (flat platform).
Definition RRR (base platform : R * R) (crank rod mode : R) : robot_leg :=
  RUS (flat base) (flat platform) (0, 0, 1) crank rod mode.
Definition PRR (base platform rail : R * R) (rod mode : R) : robot_leg :=
  PUS (flat base) (flat platform) (flat rail) rod mode.

Definition base_of (l : robot_leg) : point :=
  match l with
  | UPS a _ | RUS a _ _ _ _ _ | PUS a _ _ _ _ | RPS a _ _ | PRS a _ _ _ _ _ | UPU a _ _
  | delta a _ _ _ _ _ | linear_delta a _ _ _ _ _ => a
  end.
Definition platform_of (l : robot_leg) : point :=
  match l with
  | UPS _ b | RUS _ b _ _ _ _ | PUS _ b _ _ _ | RPS _ b _ | PRS _ b _ _ _ _ | UPU _ b _
  | delta _ b _ _ _ _ | linear_delta _ b _ _ _ _ => b
  end.

(** ** Elbows *)

(** [e] leads from the first joint of a leg to the last one. The crank, from the first joint to the
    elbow, is across the axis [n]; [crank_fits] below says that this is the one. *)
Definition crank_plane (n e : point) : R := dot n n * dot e e - dot e n ^ 2.
Definition crank_along (crank rod : R) (e : point) : R :=
  (dot e e + crank ^ 2 - rod ^ 2) / (2 * crank).
Definition crank_height (n e : point) (crank rod : R) : R :=
  crank_plane n e - dot n n * crank_along crank rod e ^ 2.
Definition crank_vector (n e : point) (crank rod mode : R) : point :=
  times (crank / crank_plane n e)
    (plus (times (crank_along crank rod e) (minus (times (dot n n) e) (times (dot e n) n)))
       (times (mode * sqrt (crank_height n e crank rod)) (cross n e))).

(** The carriage is at [place * n]; [carriage_fits] below says that this is the place. *)
Definition carriage_height (n e : point) (rod : R) : R :=
  dot e n ^ 2 - dot n n * (dot e e - rod ^ 2).
Definition carriage_place (n e : point) (rod mode : R) : R :=
  (dot e n + mode * sqrt (carriage_height n e rod)) / dot n n.

(** Where the platform can push the leg: along its rod, or along a leg of variable length. *)
Definition rod_of (l : robot_leg) (e : point) : point :=
  match l with
  | UPS _ _ | RPS _ _ _ | UPU _ _ _ => e
  | RUS _ _ n crank rod mode | delta _ _ n crank rod mode =>
      minus e (crank_vector n e crank rod mode)
  | PUS _ _ n rod mode | PRS _ _ n _ rod mode | linear_delta _ _ n _ rod mode =>
      minus e (times (carriage_place n e rod mode) n)
  end.

(** ** Rows *)

(** A force through the last joint, which is at [r] from the centre of the platform; a moment. *)
Definition force_row (r f : point) : list R :=
  let m := cross r f in [first f; second f; third f; first m; second m; third m].
Definition moment_row (m : point) : list R := [0; 0; 0; first m; second m; third m].

(** A platform is at [p], turned by [turn]. *)
Definition motor_row (p : point) (turn : point -> point) (l : robot_leg) : list R :=
  let r := turn (platform_of l) in
  force_row r (rod_of l (minus (plus p r) (base_of l))).

(** The moment that keeps the platform from turning; the force along a hinge. *)
Definition constraint_rows (p : point) (turn : point -> point) (l : robot_leg) : list (list R) :=
  let r := turn (platform_of l) in
  let e := minus (plus p r) (base_of l) in
  match l with
  | UPS _ _ | RUS _ _ _ _ _ _ | PUS _ _ _ _ _ => []
  | RPS _ _ hinge | PRS _ _ _ hinge _ _ => [force_row r hinge]
  | UPU _ _ n => [moment_row (minus (times (dot n n) e) (times (dot e n) n))]
  | delta _ _ n _ _ _ => [moment_row (cross n (rod_of l e))]
  | linear_delta _ _ _ bar _ _ => [moment_row (cross bar (rod_of l e))]
  end.

(** What a motor's rate is, as a multiple of its row. *)
Definition rate_of (p : point) (turn : point -> point) (l : robot_leg) : R :=
  let e := minus (plus p (turn (platform_of l))) (base_of l) in
  match l with
  | UPS _ _ | RPS _ _ _ | UPU _ _ _ => / sqrt (dot e e)
  | RUS _ _ n crank rod _ | delta _ _ n crank rod _ =>
      sqrt (dot n n) / (crank * sqrt (crank_height n e crank rod))
  | PUS _ _ n rod _ | PRS _ _ n _ rod _ | linear_delta _ _ n _ rod _ =>
      sqrt (dot n n) / sqrt (carriage_height n e rod)
  end.

(** ** Robots *)

(** A row for each motor, then one for each constraint. *)
Definition rows_of (p : point) (turn : point -> point) (legs : list robot_leg) : list (list R) :=
  map (motor_row p turn) legs ++ flat_map (constraint_rows p turn) legs.
Definition rates_of (p : point) (turn : point -> point) (legs : list robot_leg) : list R :=
  map (rate_of p turn) legs ++ map (fun _ => 1) (flat_map (constraint_rows p turn) legs).

(** Columns: three velocities, three spins. In the plane: two, and one. Of a point: the velocities.
    *)
Definition columns_of (c : list nat) (rows : list (list R)) : list (list R) :=
  map (fun row => map (fun j => nth j row 0) c) rows.

Definition in_space (legs : list robot_leg) (p : point) (turn : point -> point) :=
  matrix_of (rows_of p turn legs).
Definition in_plane (legs : list robot_leg) (p : R * R) (phi : R) :=
  matrix_of (columns_of [0; 1; 5]%nat (rows_of (flat p) (about_z phi) legs)).
Definition fixed (u : point) : point := u.
Definition of_point (legs : list robot_leg) (p : point) :=
  matrix_of (columns_of [0; 1; 2]%nat (rows_of p fixed legs)).
Definition of_point_in_plane (legs : list robot_leg) (p : R * R) :=
  matrix_of (columns_of [0; 1]%nat (rows_of (flat p) fixed legs)).

(** The same with the motors' rates, as a threshold takes them. *)
Definition rates_in_space (legs : list robot_leg) (p : point) (turn : point -> point) :=
  scaled (rates_of p turn legs) (in_space legs p turn).
Definition rates_in_plane (legs : list robot_leg) (p : R * R) (phi : R) :=
  scaled (rates_of (flat p) (about_z phi) legs) (in_plane legs p phi).
Definition rates_of_point (legs : list robot_leg) (p : point) :=
  scaled (rates_of p fixed legs) (of_point legs p).
Definition rates_of_point_in_plane (legs : list robot_leg) (p : R * R) :=
  scaled (rates_of (flat p) fixed legs) (of_point_in_plane legs p).

(** ** The elbow and the carriage are where the lengths say *)

Ltac destruct_points := repeat match goal with u : point |- _ => destruct u as [[? ?] ?] end.
Ltac by_coordinates :=
  destruct_points;
  cbv [dot times plus minus cross first second third fst snd crank_plane].

Lemma across_axis n e : dot (minus (times (dot n n) e) (times (dot e n) n)) n = 0.
Proof. by_coordinates. ring. Qed.
Lemma cross_axis n e : dot (cross n e) n = 0.
Proof. by_coordinates. ring. Qed.
Lemma square_of_sum (a k s : R) u v :
  dot (times a (plus (times k u) (times s v))) (times a (plus (times k u) (times s v)))
  = a ^ 2 * (k ^ 2 * dot u u + 2 * k * s * dot u v + s ^ 2 * dot v v).
Proof. by_coordinates. ring. Qed.
Lemma product_of_sum (a k s : R) u v w :
  dot (times a (plus (times k u) (times s v))) w = a * (k * dot u w + s * dot v w).
Proof. by_coordinates. ring. Qed.
Lemma square_across n e :
  let u := minus (times (dot n n) e) (times (dot e n) n) in
  dot u u = dot n n * crank_plane n e.
Proof. by_coordinates. ring. Qed.
Lemma square_cross n e : dot (cross n e) (cross n e) = crank_plane n e.
Proof. by_coordinates. ring. Qed.
Lemma across_cross n e :
  dot (minus (times (dot n n) e) (times (dot e n) n)) (cross n e) = 0.
Proof. by_coordinates. ring. Qed.
Lemma across_span n e :
  dot (minus (times (dot n n) e) (times (dot e n) n)) e = crank_plane n e.
Proof. by_coordinates. ring. Qed.
Lemma cross_span n e : dot (cross n e) e = 0.
Proof. by_coordinates. ring. Qed.
Lemma dot_comm u v : dot u v = dot v u.
Proof. by_coordinates. ring. Qed.
Lemma square_of_difference e c :
  dot (minus e c) (minus e c) = dot e e - 2 * dot c e + dot c c.
Proof. by_coordinates. ring. Qed.

(** The crank is across its axis, it and the rod have their lengths, and it is turned from the line
    between the joints in the sense of the axis if the mode is 1. *)
Theorem crank_fits n e crank rod mode : 0 < crank -> mode ^ 2 = 1 -> crank_plane n e <> 0 ->
  0 <= crank_height n e crank rod ->
  let c := crank_vector n e crank rod mode in
  dot c n = 0 /\ dot c c = crank ^ 2 /\ dot (minus e c) (minus e c) = rod ^ 2 /\
  dot (cross n e) c = mode * (crank * sqrt (crank_height n e crank rod)).
Proof.
  intros C M Q H c.
  assert (W : sqrt (crank_height n e crank rod) ^ 2 = crank_height n e crank rod).
  { simpl. rewrite Rmult_1_r. exact (sqrt_sqrt _ H). }
  assert (S : dot c c = crank ^ 2).
  { unfold c, crank_vector. rewrite square_of_sum, square_across, across_cross, square_cross.
    rewrite Rpow_mult_distr, W, M. unfold crank_height. field. exact Q. }
  assert (E : dot c e = crank * crank_along crank rod e).
  { unfold c, crank_vector. rewrite product_of_sum, across_span, cross_span. field. exact Q. }
  split; [|split; [exact S|split]].
  - unfold c, crank_vector. rewrite product_of_sum, across_axis, cross_axis. ring.
  - rewrite square_of_difference, S, E. unfold crank_along. field. lra.
  - rewrite dot_comm. unfold c, crank_vector.
    rewrite product_of_sum, across_cross, square_cross. field. exact Q.
Qed.

(** The rod has its length, and the carriage of mode 1 is the farther one along the rail. *)
Theorem carriage_fits n e rod mode : mode ^ 2 = 1 -> dot n n <> 0 ->
  0 <= carriage_height n e rod ->
  let d := minus e (times (carriage_place n e rod mode) n) in
  dot d d = rod ^ 2 /\ dot d n = - (mode * sqrt (carriage_height n e rod)).
Proof.
  intros M N H d.
  assert (W : sqrt (carriage_height n e rod) ^ 2 = carriage_height n e rod).
  { simpl. rewrite Rmult_1_r. exact (sqrt_sqrt _ H). }
  assert (P : forall t, dot (minus e (times t n)) n = dot e n - t * dot n n).
  { intros t. by_coordinates. ring. }
  assert (L : forall t, dot (minus e (times t n)) (minus e (times t n))
    = dot e e - 2 * t * dot e n + t ^ 2 * dot n n).
  { intros t. by_coordinates. ring. }
  split; unfold d.
  - rewrite L. unfold carriage_place. set (w := sqrt _) in *.
    transitivity (dot e e - (dot e n ^ 2 - mode ^ 2 * w ^ 2) / dot n n); [field; exact N|].
    rewrite M, W. unfold carriage_height. field. exact N.
  - rewrite P. unfold carriage_place. field. exact N.
Qed.

(** ** How the proofs of a file go: the vectors and numbers of each leg become variables with the
    equations of their values, as the names of a matrix do. *)

Lemma named_point (P : point -> Prop) v :
  (forall a b c, a = first v -> b = second v -> c = third v -> P (a, b, c)) -> P v.
Proof. destruct v as [[a b] c]. intros H. exact (H a b c eq_refl eq_refl eq_refl). Qed.

Ltac name_value E := real_in E; simpler_numbers_in E; simpler_angles_in E.
Ltac name_point v a b c :=
  pattern v; apply named_point; intros a b c;
  let A := fresh in intros A; name_value A;
  let B := fresh in intros B; name_value B;
  let C := fresh in intros C; name_value C; cbv beta.
Ltac name_number v a :=
  pattern v; apply named; intros a; let A := fresh in intros A; name_value A; cbv beta.

(** A rotation by what it makes of the axes. *)
Definition linear (a b c u : point) : point :=
  let '(d, e, f) := u in plus (plus (times d a) (times e b)) (times f c).

Ltac by_linearity := intros; destruct_points; cbv [linear plus times about_x about_y about_z
  roll_pitch_yaw euler_zxz quaternion Rdiv]; f_equal; [f_equal|]; ring.
Lemma linear_roll_pitch_yaw r p y u : roll_pitch_yaw r p y u =
  linear (roll_pitch_yaw r p y (1, 0, 0)) (roll_pitch_yaw r p y (0, 1, 0))
    (roll_pitch_yaw r p y (0, 0, 1)) u.
Proof. by_linearity. Qed.
Lemma linear_euler_zxz a b c u : euler_zxz a b c u =
  linear (euler_zxz a b c (1, 0, 0)) (euler_zxz a b c (0, 1, 0)) (euler_zxz a b c (0, 0, 1)) u.
Proof. by_linearity. Qed.
Lemma linear_quaternion a b c d u : quaternion a b c d u =
  linear (quaternion a b c d (1, 0, 0)) (quaternion a b c d (0, 1, 0))
    (quaternion a b c d (0, 0, 1)) u.
Proof. by_linearity. Qed.
Lemma linear_about_z a u :
  about_z a u = linear (about_z a (1, 0, 0)) (about_z a (0, 1, 0)) (about_z a (0, 0, 1)) u.
Proof. by_linearity. Qed.

(** The cosine and the sine of an angle get names, unless they are made of roots. *)
Ltac name_function f a v :=
  let E := fresh "E" in
  assert (E : exists x, x = f a) by eauto; destruct E as [v E]; real_in E; simpler_angles_in E;
  lazymatch type of E with _ = ?value =>
    tryif is_radical value then subst v else idtac end.
Ltac name_angle a c s := name_function cos a c; name_function sin a s.
Ltac known_angles E :=
  repeat match goal with C : ?c = cos _ |- _ => is_var c; progress rewrite <- C in E end;
  repeat match goal with S : ?s = sin _ |- _ => is_var s; progress rewrite <- S in E end.
Ltac name_column v a b c :=
  let A := fresh "A" in
  assert (A : exists x y z, v = (x, y, z)) by (destruct v as [[? ?] ?]; eauto);
  destruct A as [a [b [c A]]];
  let X := fresh in assert (X : a = first v) by (rewrite A; reflexivity);
  let Y := fresh in assert (Y : b = second v) by (rewrite A; reflexivity);
  let Z := fresh in assert (Z : c = third v) by (rewrite A; reflexivity);
  real_in X; known_angles X; simpler_angles_in X; real_in Y; known_angles Y; simpler_angles_in Y;
  real_in Z; known_angles Z; simpler_angles_in Z.
(** Of angles -a those of a. *)
Ltac positive_angles :=
  repeat match goal with
  | C : _ = cos (- ?a * ?b) |- _ => rewrite Ropp_mult_distr_l_reverse in C
  | S : _ = sin (- ?a * ?b) |- _ => rewrite Ropp_mult_distr_l_reverse in S
  | C : _ = cos (- ?a) |- _ => rewrite cos_neg in C
  | S : _ = sin (- ?a) |- _ => rewrite sin_neg in S
  end.

(** [L] says what the turn makes of a vector. *)
Ltac name_columns L t :=
  let a1 := fresh "_R_1_x" in let a2 := fresh "_R_1_y" in let a3 := fresh "_R_1_z" in
  let b1 := fresh "_R_2_x" in let b2 := fresh "_R_2_y" in let b3 := fresh "_R_2_z" in
  let c1 := fresh "_R_3_x" in let c2 := fresh "_R_3_y" in let c3 := fresh "_R_3_z" in
  name_column (t (1, 0, 0)) a1 a2 a3; name_column (t (0, 1, 0)) b1 b2 b3;
  name_column (t (0, 0, 1)) c1 c2 c3;
  let E := fresh "L" in pose proof L as E;
  repeat match goal with A : _ = (_, _, _) |- _ => rewrite A in E; clear A end.
Ltac name_three a b c :=
  let c1 := fresh "_cos_1" in let s1 := fresh "_sin_1" in name_angle a c1 s1;
  let c2 := fresh "_cos_2" in let s2 := fresh "_sin_2" in name_angle b c2 s2;
  let c3 := fresh "_cos_3" in let s3 := fresh "_sin_3" in name_angle c c3 s3.
Ltac name_turn t := lazymatch t with
  | roll_pitch_yaw ?a ?b ?c => name_three a b c; name_columns (linear_roll_pitch_yaw a b c) t
  | euler_zxz ?a ?b ?c => name_three a b c; name_columns (linear_euler_zxz a b c) t
  | about_z ?a =>
      let c1 := fresh "_cos_1" in let s1 := fresh "_sin_1" in name_angle a c1 s1;
      name_columns (linear_about_z a) t
  | quaternion ?a ?b ?c ?d => name_columns (linear_quaternion a b c d) t
  | _ => idtac
  end; positive_angles.

(** The rows of the robot, leg by leg. *)
Ltac open_legs :=
  cbv delta [in_space in_plane of_point of_point_in_plane rates_in_space rates_in_plane
    rates_of_point rates_of_point_in_plane rates_of rows_of]; cbv beta;
  lazymatch goal with |- context [map (motor_row _ _) ?l] =>
    let m := eval hnf in l in change l with m end;
  cbv beta iota delta [map flat_map app];
  lazymatch goal with |- context [motor_row _ ?turn _] => name_turn turn end.

Ltac turned t := try match goal with L : forall u, t u = linear _ _ _ u |- _ => rewrite !L end.

Ltac unfolded t := eval cbv beta iota zeta delta [motor_row constraint_rows rate_of rod_of base_of
  platform_of crank_vector crank_height carriage_place] in t.

Ltac open_leg p turn l m :=
  let row := unfolded (motor_row p turn m) in change (motor_row p turn l) with row;
  let rows := unfolded (constraint_rows p turn m) in change (constraint_rows p turn l) with rows;
  let rate := unfolded (rate_of p turn m) in change (rate_of p turn l) with rate.

Ltac name_crank n e crank rod mode q k h w c1 c2 c3 d1 d2 d3 :=
  name_number (crank_plane n e) q; name_number (crank_along crank rod e) k;
  name_number (q - dot n n * k ^ 2) h; name_number (R_sqrt.sqrt h) w;
  name_point (times (crank / q) (plus (times k (minus (times (dot n n) e) (times (dot e n) n)))
    (times (mode * w) (cross n e)))) c1 c2 c3;
  name_point (minus e (c1, c2, c3)) d1 d2 d3.
Ltac name_carriage n e rod mode h w t d1 d2 d3 :=
  name_number (carriage_height n e rod) h; name_number (R_sqrt.sqrt h) w;
  name_number ((dot e n + mode * w) / dot n n) t;
  name_point (minus e (times t n)) d1 d2 d3.

(** The next leg, whose names end in [i]: r, e; q, k, h, w, c of a crank; h, w, t of a carriage; d.
    *)
Tactic Notation "name_leg" "as" ident(i) :=
  lazymatch goal with |- context [motor_row ?p ?turn ?l] =>
    let m := eval hnf in l in
    open_leg p turn l m;
    let a := unfolded (base_of m) in let b := unfolded (platform_of m) in
    let r1 := fresh "_r" i "_x" in let r2 := fresh "_r" i "_y" in let r3 := fresh "_r" i "_z" in
    let e1 := fresh "_e" i "_x" in let e2 := fresh "_e" i "_y" in let e3 := fresh "_e" i "_z" in
    let d1 := fresh "_d" i "_x" in let d2 := fresh "_d" i "_y" in let d3 := fresh "_d" i "_z" in
    let c1 := fresh "_c" i "_x" in let c2 := fresh "_c" i "_y" in let c3 := fresh "_c" i "_z" in
    let q := fresh "_q" i in let k := fresh "_k" i in let t := fresh "_t" i in
    let h := fresh "_h" i in let w := fresh "_w" i in
    turned turn;
    (lazymatch goal with L : forall u, turn u = linear ?x ?y ?z u |- _ =>
       name_point (linear x y z b) r1 r2 r3
     | _ => name_point (turn b) r1 r2 r3 end); name_point (minus (plus p (r1, r2, r3)) a) e1 e2 e3;
    lazymatch m with
    | RUS _ _ ?n ?crank ?rod ?mode =>
        name_crank n (e1, e2, e3) crank rod mode q k h w c1 c2 c3 d1 d2 d3
    | delta _ _ ?n ?crank ?rod ?mode =>
        name_crank n (e1, e2, e3) crank rod mode q k h w c1 c2 c3 d1 d2 d3
    | PUS _ _ ?n ?rod ?mode => name_carriage n (e1, e2, e3) rod mode h w t d1 d2 d3
    | PRS _ _ ?n _ ?rod ?mode => name_carriage n (e1, e2, e3) rod mode h w t d1 d2 d3
    | linear_delta _ _ ?n _ ?rod ?mode => name_carriage n (e1, e2, e3) rod mode h w t d1 d2 d3
    | _ => name_number (dot (e1, e2, e3) (e1, e2, e3)) h; name_number (R_sqrt.sqrt h) w
    end
  end.

(** All legs have names. *)
Ltac close_legs :=
  cbv -[Rplus Rminus Rmult Ropp Rinv Rdiv Rle Rlt Rabs IZR PI sin cos atan exp ln R_sqrt.sqrt pow
    matrix_of scaled full_column_rank determinant];
  repeat match goal with |- context [R_sqrt.sqrt ?a] =>
    is_radical a; replace a with 1 by by_field; rewrite sqrt_1 end.
