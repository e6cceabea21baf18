(* SPDX-License-Identifier: Apache-2.0 *)
(** A robot by a matrix of its own: how a theorem about the matrix as a model file writes it follows
    from one about the question of a certificate. The definitions are those to read. *)
From Coq Require Import QArith Qreals Lra Lia.
From Regulus Require Export Geometry.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Questions Regularity Determinants.

(** The rows of a matrix, each multiplied by its scale. *)
Definition scaled (s : list R) (m : nat -> nat -> R) (i j : nat) : R := nth i s 1 * m i j.

(** ** The names of a question have values that are written in another way *)

Fixpoint uses_below (n : nat) (e : expression) : bool :=
  match e with
  | Constant _ | Pi => true
  | Name k => Nat.ltb k n
  | Add a b | Subtract a b | Multiply a b | Divide a b => uses_below n a && uses_below n b
  | Negate a | Power a _ | Sqrt a | Sin a | Cos a | Atan a | Exp a | Log a | Abs a => uses_below n a
  end.

Fixpoint well_named (n : nat) (l : list expression) : bool :=
  match l with [] => true | d :: later => uses_below n d && well_named (S n) later end.

Lemma value_of_first names more e :
  uses_below (length names) e = true -> value (names ++ more) e = value names e.
Proof.
  induction e; simpl; intros U;
    try (apply andb_prop in U as [U V]; rewrite IHe1, IHe2 by assumption; reflexivity);
    try (rewrite IHe by assumption; reflexivity); try reflexivity.
  apply Nat.ltb_lt in U. apply app_nth1, U.
Qed.

Lemma extend_to l : forall names values, well_named (length names) l = true ->
  map (value (names ++ values)) l = values -> extend names l = names ++ values.
Proof.
  induction l as [|d l IH]; intros names values W E; simpl in *; subst; [symmetry;
    apply app_nil_r|].
  apply andb_prop in W as [U W]. destruct values as [|w values]; [discriminate E|].
  injection E as D E. rewrite (value_of_first _ _ _ U) in D. subst w.
  change (names ++ value names d :: values) with (names ++ [value names d] ++ values) in *.
  rewrite app_assoc in *. apply IH; [|exact E].
  rewrite app_size, Nat.add_comm. exact W.
Qed.

Lemma product_of_ones n : forall s, (forall i, s i = 1) -> product_of n s = 1.
Proof.
  induction n as [|n IH]; intros s E; [reflexivity|]. simpl. rewrite E, IH; [lra|].
  intros i. apply E.
Qed.

Lemma product_of_scales s n : s = [] \/ length s = n ->
  product_of n (fun i => nth i s 1) = product s.
Proof.
  intros [->|<-].
  - apply product_of_ones. intros [|i]; reflexivity.
  - induction s as [|a s IH]; [reflexivity|]. simpl. rewrite IH. reflexivity.
Qed.

Lemma determinant_scaled s n m : s = [] \/ length s = n ->
  determinant n (scaled s m) = determinant n m * product s.
Proof.
  intros L. unfold scaled. rewrite determinant_of_multiples, product_of_scales by exact L. lra.
Qed.

Lemma unscaled n m : determinant n (scaled [] m) = determinant n m.
Proof. rewrite determinant_scaled by (left; reflexivity). simpl. lra. Qed.

(** The rows, and the scales, as they are compared. *)
Definition same_matrix (q : question) (scales : list expression) (names : list R)
    (l : list (list R)) (s : list R) : Prop :=
  all_of (map (defined names) (also_defined q)) ->
  map (map (value names)) (matrix q) = l /\ map (value names) scales = s.

Lemma full_rank_of_names q x names m n l : no_singularity q -> in_set q x ->
  extend x (definitions q) = names -> rows q = m -> columns q = n -> same_matrix q [] names l [] ->
  full_column_rank m n (matrix_of l).
Proof.
  intros [_ N] S <- <- <- E. destruct (N x S) as [[_ [U _]] K].
  destruct (E (all_of_forall _ _ U)) as [M _]. intros y Y. apply K. intros i I.
  rewrite <- (Y i I). apply sum_ext. intros j _. rewrite entry_of_values, M. reflexivity.
Qed.

Lemma above_of_names q scales threshold x names limit l s n :
  determinant_above q scales threshold -> in_set q x -> extend x (definitions q) = names ->
  columns q = n -> s = [] \/ length s = n -> limit <= value [] threshold ->
  same_matrix q scales names l s ->
  limit < Rabs (determinant n (scaled s (matrix_of l))).
Proof.
  intros [_ [_ [_ A]]] S <- <- L T E. destruct (A x S) as [[_ [U _]] [_ D]].
  destruct (E (all_of_forall _ _ U)) as [M F]. unfold scaled_determinant in D.
  rewrite (determinant_of_values _ _ _ M), F in D. rewrite determinant_scaled by exact L. lra.
Qed.

(** A pose of a certificate, and what is true there. *)
Definition all_defined_at (q : question) (v : list R) : Prop :=
  all_of (map (defined (extend v (definitions q))) (also_defined q)).

Lemma pose_of_singularity q : singularity q -> exists v, Forall2 in_range v (ranges q) /\
  all_defined_at q v /\ determinant (columns q) (entry q (extend v (definitions q))) = 0.
Proof.
  intros [v [[F _] [[_ [U _]] [_ D]]]]. exists v. split; [exact F|]. split; [|exact D].
  exact (all_of_forall _ _ U).
Qed.

Lemma pose_of_small q scales threshold : determinant_not_above q scales threshold ->
  exists v, Forall2 in_range v (ranges q) /\
    all_defined_at q v /\ small_determinant q scales v <= value [] threshold.
Proof.
  intros [_ [_ [v [[F _] [[_ [U _]] [_ D]]]]]]. exists v. split; [exact F|]. split; [|exact D].
  exact (all_of_forall _ _ U).
Qed.

Lemma singular_of_names q x names l n : all_defined_at q x ->
  determinant (columns q) (entry q (extend x (definitions q))) = 0 ->
  extend x (definitions q) = names -> columns q = n -> same_matrix q [] names l [] ->
  determinant n (matrix_of l) = 0.
Proof.
  intros U D <- <- E. destruct (E U) as [M _].
  rewrite <- D. symmetry. apply determinant_of_values, M.
Qed.

Lemma small_of_names q scales x names l s n limit threshold : all_defined_at q x ->
  small_determinant q scales x <= value [] threshold -> extend x (definitions q) = names ->
  columns q = n -> s = [] \/ length s = n -> value [] threshold <= limit ->
  same_matrix q scales names l s -> Rabs (determinant n (scaled s (matrix_of l))) <= limit.
Proof.
  unfold small_determinant. intros U D <- <- L T E. destruct (E U) as [M F].
  rewrite (determinant_of_values _ _ _ M), F in D. rewrite determinant_scaled by exact L. lra.
Qed.

(** ** Equal numbers *)

Lemma named {A} (v : A) (P : A -> Prop) : (forall x, x = v -> P x) -> P v.
Proof. intros H. exact (H v eq_refl). Qed.

Lemma root_of_multiple a b c : 0 < c -> a = c * c * b -> sqrt a = c * sqrt b.
Proof.
  intros C ->. rewrite sqrt_mult_alt by nra. rewrite sqrt_square by lra. reflexivity.
Qed.

Lemma inverse_of_multiple n a c b : n <> 0 -> c <> 0 -> c * a = n * b -> n * / a = c * / b.
Proof.
  intros N C E. replace a with (n * / c * b).
  - rewrite !Rinv_mult, Rinv_inv. transitivity ((n * / n) * (c * / b)); [ring|].
    rewrite Rinv_r by exact N. ring.
  - apply (Rmult_eq_reg_l c); [rewrite E; field; exact C|exact C].
Qed.

(** *** Cosines and sines of multiples of 30 and of 45 degrees *)

Definition at_angle (a c s : R) : Prop := cos a = c /\ sin a = s.

Lemma angle_0 a : a = 0 -> at_angle a 1 0.
Proof. intros ->. split; [apply cos_0|apply sin_0]. Qed.
Lemma angle_30 a : a = PI / 6 -> at_angle a (sqrt 3 / 2) (1 / 2).
Proof. intros ->. split; [apply cos_PI6|apply sin_PI6]. Qed.
Lemma angle_45 a : a = PI / 4 -> at_angle a (sqrt 2 / 2) (sqrt 2 / 2).
Proof.
  intros ->. assert (E : 1 / sqrt 2 = sqrt 2 / 2).
  { pose proof (sqrt_lt_R0 2 ltac:(lra)) as P. pose proof (sqrt_sqrt 2 ltac:(lra)) as Q.
    apply (Rmult_eq_reg_l (sqrt 2)); [|lra]. field_simplify; [|lra]. simpl. lra. }
  split; [rewrite cos_PI4; exact E|rewrite sin_PI4; exact E].
Qed.
Lemma angle_60 a : a = PI / 3 -> at_angle a (1 / 2) (sqrt 3 / 2).
Proof. intros ->. split; [apply cos_PI3|apply sin_PI3]. Qed.
Lemma angle_90 a : a = PI / 2 -> at_angle a 0 1.
Proof. intros ->. split; [apply cos_PI2|apply sin_PI2]. Qed.

Lemma angle_back a b c s : a = - b -> at_angle b c s -> at_angle a c (- s).
Proof. intros -> [<- <-]. split; [apply cos_neg|apply sin_neg]. Qed.
Lemma angle_beyond a b c s : a = b + PI -> at_angle b c s -> at_angle a (- c) (- s).
Proof. intros -> [<- <-]. split; [apply neg_cos|apply neg_sin]. Qed.
Lemma angle_to_180 a b c s : a = PI - b -> at_angle b c s -> at_angle a (- c) s.
Proof.
  intros -> [<- <-]. split; [|apply sin_PI_x].
  replace (PI - b) with (- b + PI) by lra. rewrite neg_cos, cos_neg. reflexivity.
Qed.

(** The angle r + p * PI as (r, p), as far as it is one. This finds angles, and proves nothing. *)
Definition times_parts (a b : Q * Q) : Q * Q :=
  (Qmult (fst a) (fst b), Qplus (Qmult (fst a) (snd b)) (Qmult (snd a) (fst b))).
Definition plus_parts (a b : Q * Q) : Q * Q := (Qplus (fst a) (fst b), Qplus (snd a) (snd b)).
Definition is_multiple_of_15_degrees (a : Q * Q) : bool :=
  Qeq_bool (fst a) 0 && Z.eqb (Z.modulo (12 * Qnum (snd a)) (Zpos (Qden (snd a)))) 0.

Ltac parts_of_angle a := lazymatch a with
  | PI => constr:((0%Q, 1%Q))
  | IZR ?n => constr:((inject_Z n, 0%Q))
  | ?x + ?y => let s := parts_of_angle x in let t := parts_of_angle y in constr:(plus_parts s t)
  | ?x - ?y => parts_of_angle (x + (-1) * y)
  | - ?x => parts_of_angle ((-1) * x)
  | ?x * ?y => let s := parts_of_angle x in let t := parts_of_angle y in constr:(times_parts s t)
  | / ?x => let s := parts_of_angle x in constr:((Qinv (fst s), 0%Q))
  | ?x / ?y => parts_of_angle (x * / y)
  end.

Ltac exact_angle a :=
  first
  [ apply angle_0; lra | apply angle_90; lra | apply angle_60; lra | apply angle_30; lra
  | apply angle_45; lra
  | tryif assert (a < 0) by lra then (apply (angle_back a (- a)); [lra | exact_angle (- a)])
    else tryif assert (a >= PI) by lra
    then (apply (angle_beyond a (a - PI)); [lra | exact_angle (a - PI)])
    else (assert (a > PI / 2) by lra; apply (angle_to_180 a (PI - a)); [lra | exact_angle (PI - a)])
  ].
Ltac known_angle a A :=
  let parts := parts_of_angle a in
  lazymatch eval vm_compute in (is_multiple_of_15_degrees parts) with
  | true => eassert (A : at_angle a _ _) by (pose proof PI_RGT_0; exact_angle a)
  end.
Ltac simpler_angles_in E :=
  repeat match type of E with
  | context [cos ?a] => let A := fresh in known_angle a A; rewrite (proj1 A) in E; clear A
  | context [sin ?a] => let A := fresh in known_angle a A; rewrite (proj2 A) in E; clear A
  end.
Ltac simpler_angles :=
  repeat match goal with
  | |- context [cos ?a] => let A := fresh in known_angle a A; rewrite (proj1 A); clear A
  | |- context [sin ?a] => let A := fresh in known_angle a A; rewrite (proj2 A); clear A
  end.

(** ** How the proofs of a file go: the constants and the names of [let] become variables with the
    equations of their values. A definition of the certificate is a number times such a name, or it
    is computed. So the numbers to compare are short expressions in variables. *)

(** A definition of the question that is not given another name. *)
Definition unnamed : R := 0.
Definition no_names : list R := [].

Ltac real_numbers t :=
  eval cbv -[Rplus Rminus Rmult Ropp Rinv Rdiv Rle Rlt Rabs IZR PI sin cos atan exp ln R_sqrt.sqrt
    pow] in t.
Ltac real_in E := cbv -[Rplus Rminus Rmult Ropp Rinv Rdiv Rle Rlt Rabs IZR PI sin cos atan exp ln
  R_sqrt.sqrt pow] in E.
Ltac real := cbv -[Rplus Rminus Rmult Ropp Rinv Rdiv Rle Rlt Rabs IZR PI sin cos atan exp ln
  R_sqrt.sqrt pow].

Ltac matrix_of_goal := lazymatch goal with
  | |- full_column_rank _ _ ?m => m
  | |- context [determinant _ ?m] => m
  end.

(** The application with [x] in the place of its argument with this number, from the last one on. *)
Ltac with_argument k t x := lazymatch t with
  | ?f ?a => lazymatch k with
             | O => constr:(f x)
             | S ?n => let g := with_argument n f x in constr:(g a)
             end
  end.
Ltac argument k t := lazymatch t with
  | ?f ?a => lazymatch k with O => a | S ?n => argument n f end
  end.

(** An argument of the matrix becomes a variable. *)
Tactic Notation "name_argument" constr(k) "as" ident(x) :=
  let n := natural k in
  let m := matrix_of_goal in
  let v := argument n m in
  let E := fresh "E" in
  pose (x := v);
  let m' := with_argument n m x in
  change m with m'; pose proof (eq_refl : x = v) as E; clearbody x; real_in E.

Ltac simpler_numbers_in E := rewrite ?Rinv_1, ?Rmult_1_r in E.

(** Succeeds for a number of rational numbers and roots of natural numbers. *)
Ltac is_radical v := lazymatch v with
  | IZR _ => idtac
  | R_sqrt.sqrt (IZR _) => idtac
  | ?a + ?b => is_radical a; is_radical b
  | ?a - ?b => is_radical a; is_radical b
  | ?a * ?b => is_radical a; is_radical b
  | ?a / ?b => is_radical a; is_radical b
  | - ?a => is_radical a
  | / ?a => is_radical a
  | ?a ^ _ => is_radical a
  end.

(** Each name of the matrix becomes a variable, but for those of such numbers. *)
Ltac name_lets m :=
  cbv beta delta [m];
  repeat lazymatch goal with
  | |- context C [let x := ?v in @?b x] =>
      let w := real_numbers v in
      tryif is_radical w then (let g := context C [b w] in change g; cbv beta)
      else
        (let E := fresh "E" in
         pose (x := v);
         let g := context C [b x] in change g; cbv beta;
         pose proof (eq_refl : x = v) as E; clearbody x;
         real_in E; simpler_numbers_in E; simpler_angles_in E)
  end.

(** These names give way to their values. *)
Ltac without_names names := lazymatch names with
  | ?x :: ?more => lazymatch goal with E : x = _ |- _ => rewrite E end; without_names more
  | _ => idtac
  end.

(** Inverses become variables, those of products products of them. *)
Ltac hide_inverses :=
  unfold Rdiv; repeat first [rewrite Rinv_mult | rewrite Rinv_inv | rewrite <- pow_inv];
  repeat match goal with |- context [/ ?d] =>
    lazymatch d with
    | IZR _ => fail
    | _ => let i := fresh "i" in generalize (/ d); intros i
    end end.

(** The squares of roots of numbers are known. *)
Ltac known_roots :=
  repeat match goal with |- context [R_sqrt.sqrt (IZR ?n)] =>
    let r := fresh "r" in let E := fresh in
    pose proof (sqrt_sqrt (IZR n) ltac:(lra)) as E;
    set (r := R_sqrt.sqrt (IZR n)) in *; clearbody r; revert E end;
  intros.
Ltac by_field :=
  first [ field
        | clear; known_roots;
          first [ match goal with A : ?a * ?a = IZR _, B : ?b * ?b = IZR _ |- _ => field [A B] end
                | match goal with A : ?a * ?a = IZR _ |- _ => field [A] end ] ].

(** Functions of equal numbers are equal. *)
Ltac equal_arguments f :=
  repeat match goal with |- context [f ?a] =>
    lazymatch a with IZR _ => fail | _ => idtac end;
    match goal with |- context [f ?b] =>
      lazymatch b with IZR _ => fail | _ => idtac end;
      tryif constr_eq a b then fail else
      (let E := fresh in
       assert (E : a = b) by (clear; hide_inverses; by_field); rewrite E; clear E) end end.
Ltac equal_functions :=
  equal_arguments Rinv; equal_arguments cos; equal_arguments sin; equal_arguments R_sqrt.sqrt;
    equal_arguments atan;
  equal_arguments exp; equal_arguments ln; equal_arguments Rabs.

(** What divides is not 0, as the certificate says. *)
Ltac nonzero :=
  repeat match goal with D : all_of _ |- _ => real_in D end;
  repeat match goal with D : _ /\ _ |- _ => destruct D end;
  repeat split;
  first [ clear; lra
        | match goal with N : ?a = 0 -> False |- _ =>
            let Z := fresh in intros Z; apply N; revert Z;
            repeat match goal with E : ?x = _ |- _ =>
              is_var x; match goal with |- context [x] => rewrite E end end;
            clear; intros Z; lra end ].

Ltac same_number :=
  unfold Rdiv; rewrite ?Rinv_1, ?Rmult_1_r; simpler_angles;
  first
  [ reflexivity
  | solve [hide_inverses; by_field]
  | lazymatch goal with
    | |- R_sqrt.sqrt _ = ?c * R_sqrt.sqrt _ => apply root_of_multiple; [lra | same_number]
    | |- ?n * / _ = ?c * / _ => apply inverse_of_multiple; [lra | lra | same_number]
    end
  | solve [equal_functions; hide_inverses; by_field]
  | solve [progress rewrite ?cos_neg, ?sin_neg; same_number]
  | solve [field; nonzero] ].

(** Compares the numbers of a list, each without some names. *)
Ltac same_numbers_without names :=
  lazymatch goal with
  | |- _ :: _ = _ :: _ =>
      lazymatch names with ?some :: ?more =>
        apply same_head; [without_names some; same_number | same_numbers_without more] end
  | |- _ => reflexivity
  end.
Ltac same_rows_without names :=
  lazymatch goal with
  | |- _ :: _ = _ :: _ =>
      lazymatch names with ?row :: ?more =>
        apply same_head; [same_numbers_without row | same_rows_without more] end
  | |- _ => reflexivity
  end.

Ltac values_of words names l :=
  lazymatch l with
  | ?d :: ?rest =>
      lazymatch words with (?w, _) :: ?more =>
        let v := lazymatch w with unnamed => real_numbers (value names d) | _ => w end in
        let next := eval cbv [app] in (names ++ [v]) in
        let values := values_of more next rest in constr:(v :: values) end
  | _ => constr:(@nil R)
  end.
Ltac names_of_words words := lazymatch words with
  | (_, ?names) :: ?more => let rest := names_of_words more in constr:(names :: rest)
  | _ => constr:(@nil (list R))
  end.

(** The names of the question have the values [words]. *)
Ltac name_definitions q x words N :=
  let l := eval hnf in (definitions q) in
  let values := values_of words x l in
  assert (N : extend x (definitions q) = x ++ values);
  [ apply extend_to; [reflexivity | real; let names := names_of_words words in
      first [ same_numbers_without names
            | fail 2 "no proof that a definition of the certificate is that of the model file" ] ]
  | ].

Ltac same_rows names :=
  first [ same_rows_without names
        | fail 2 "no proof that an entry of the certificate is that of the model file" ].
Ltac same_scales names :=
  first [ same_numbers_without names
        | fail 2 "no proof that a scale of the certificate is that of the model file" ].

Ltac matrices entries scales :=
  let D := fresh "D" in intros D; real; split; [same_rows entries | same_scales scales].

(** [S] says that the quantities of the robot are in their set. *)
Ltac at_point claim x S :=
  let I := fresh in
  lazymatch type of claim with
  | no_singularity ?q => assert (I : in_set q x) by in_certificate S
  | determinant_above ?q _ _ => assert (I : in_set q x) by in_certificate S
  end; clear S; rename I into S.

(** The definitions of the certificate have the values [words], and its entries are those of the
    matrix, without some names. *)
Ltac by_matrix claim words entries S :=
  lazymatch type of S with in_set ?q ?x =>
    let N := fresh in name_definitions q x words N;
    apply (full_rank_of_names q x _ _ _ _ claim S N);
    [reflexivity | reflexivity | clear S N; matrices entries constr:(@nil (list R))] end.

(** The same for a threshold. *)
Ltac with_scales := lazymatch goal with
  | |- context [determinant _ (scaled _ _)] => idtac
  | |- context [determinant ?n ?m] => rewrite <- (unscaled n m)
  end.
Ltac scales_fit := first [right; reflexivity | left; reflexivity].

Ltac by_large_matrix claim words entries scales S :=
  with_scales;
  lazymatch type of S with in_set ?q ?x =>
    let N := fresh in name_definitions q x words N;
    apply (above_of_names q _ _ x _ _ _ _ _ claim S N);
    [reflexivity | scales_fit | clear S N; lower_threshold | clear S N;
      matrices entries scales] end.

(** A quantity of the certificate gets a name; [F] says that all are in their ranges. *)
Tactic Notation "name_quantity" hyp(F) "as" ident(x) :=
  lazymatch type of F with Forall2 _ _ ?r => let l := eval hnf in r in change r with l in F end;
  apply quantities_of_ranges in F;
  let w := fresh in let r := fresh "r" in destruct F as [x [w [-> [r F]]]]; computed_in r.

(** All have names: the ranges are those of the model file. *)
Ltac in_ranges F :=
  apply no_more_quantities in F; rewrite F in *; clear F;
  split;
  [ repeat match goal with r : _ /\ _ |- _ => destruct r end; hnf; computed; repeat split;
    first [numbers | fail 1 "no proof that a range of the certificate is in that of the model file"]
  | repeat match goal with r : _ <= _ <= _ |- _ => clear r end ].

Ltac by_singular_matrix D words entries :=
  let Z := fresh in destruct D as [D Z];
  lazymatch type of D with all_defined_at ?q ?x =>
    let N := fresh in name_definitions q x words N;
    apply (singular_of_names q x _ _ _ D Z N);
    [reflexivity | clear D Z N; matrices entries constr:(@nil (list R))] end.

Ltac by_small_matrix D words entries scales :=
  with_scales; let Z := fresh in destruct D as [D Z];
  lazymatch type of D with all_defined_at ?q ?x =>
    let N := fresh in name_definitions q x words N;
    apply (small_of_names q _ x _ _ _ _ _ _ D Z N);
    [ reflexivity | scales_fit | clear D Z N; lower_threshold | clear D Z N; matrices entries scales
      ]
  end.
