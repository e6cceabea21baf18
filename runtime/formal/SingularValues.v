(* SPDX-License-Identifier: Apache-2.0 *)
(** Singular values, and the condition number in the 2-norm. Let X be the matrix over a box, V any
    matrix with columns near its right singular vectors in the middle, and Z a left inverse of X V.
    If d V^T V - (X V)^T X V is positive definite, then |X v|^2 < d |v|^2 for all v; in the same way
    |w|^2 < e |X w|^2 is shown by Z. d and e are functions over the box that follow the singular
    values, and d e is the square of the limit. *)
From Coq Require Import Reals QArith Lra Lia List PArith Bool.
From Coq Require PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Questions LinearAlgebra Determinants Intervals Forms.
From Regulus Require Import Evaluation Boxes Hints Regularity Search Threshold Limits.
Import ListNotations.
Open Scope R_scope.

(** ** The claims *)

(** The length of a vector of n numbers. *)
Definition euclidean_norm (n : nat) (v : nat -> R) : R := sqrt (sum n (fun i => v i * v i)).

(** X v, where X has n columns. *)
Definition image (n : nat) (x : nat -> nat -> R) (v : nat -> R) (i : nat) : R :=
  sum n (fun j => x i j * v j).

(** A singular value of X is an extreme or stationary value of |X v| / |v|. All are above the
    limit if the least value of this quotient is, and below it if the largest value is. X has m rows
    and n columns. *)
Definition values_are_above (m n : nat) (limit : R) (x : nat -> nat -> R) : Prop :=
  forall v, 0 < euclidean_norm n v ->
    limit * euclidean_norm n v < euclidean_norm m (image n x v).

Definition values_are_below (m n : nat) (limit : R) (x : nat -> nat -> R) : Prop :=
  forall v, 0 < euclidean_norm n v ->
    euclidean_norm m (image n x v) < limit * euclidean_norm n v.

(** The largest singular value is less than the limit times the least one: for all v and w that are
    not 0, |X v| / |v| is less than the limit times |X w| / |w|. So X has full column rank. *)
Definition ratio_is_below (m n : nat) (limit : R) (x : nat -> nat -> R) : Prop :=
  forall v w, 0 < euclidean_norm n v -> 0 < euclidean_norm n w ->
    euclidean_norm m (image n x v) * euclidean_norm n w
    < limit * (euclidean_norm m (image n x w) * euclidean_norm n v).

(** X = diag(s) A diag(f). *)
Definition scaled_matrix (s f : nat -> R) (a : nat -> nat -> R) (i j : nat) : R :=
  s i * a i j * f j.

(** The ranges are defined, and there is a scale for each row, and a factor for each column, which
    is not 0. At every point of the set, everything is defined, and the matrix with its scales and
    factors satisfies a bound. *)
Definition matrix_satisfies (bound : nat -> nat -> R -> (nat -> nat -> R) -> Prop) (q : question)
    (scales factors : list expression) (limit : expression) : Prop :=
  defined [] limit /\ ends_defined q /\ length scales = rows q /\ length factors = columns q /\
  Forall (fun e => defined [] e /\ value [] e <> 0) factors /\
  forall x, in_set q x ->
    let names := extend x (definitions q) in
    model_defined q x /\ Forall (defined names) scales /\
    bound (rows q) (columns q) (value [] limit)
      (scaled_matrix (value_of names scales) (value_of [] factors) (entry q names)).

Definition singular_values_above := matrix_satisfies values_are_above.
Definition singular_values_below := matrix_satisfies values_are_below.
Definition condition_2_below := matrix_satisfies ratio_is_below.

(** ** Linear algebra *)

Definition quadratic_value (n : nat) (a : nat -> nat -> R) (v : nat -> R) : R :=
  sum n (fun i => sum n (fun j => a i j * (v i * v j))).

Definition is_nonzero_vector (n : nat) (v : nat -> R) : Prop := exists i, (i < n)%nat /\ v i <> 0.

Definition is_definite (n : nat) (a : nat -> nat -> R) : Prop :=
  forall v, is_nonzero_vector n v -> 0 < quadratic_value n a v.

(** What remains if the last unknown is eliminated. *)
Definition remainder (n : nat) (a : nat -> nat -> R) (i j : nat) : R :=
  a i j - a n i * (1 / a n n) * a n j.

Lemma sum_squares_not_negative n v : 0 <= sum n (fun i => v i * v i).
Proof. induction n; simpl; [lra|]. nra. Qed.

Lemma sum_times n c f : sum n (fun i => f i * c) = sum n f * c.
Proof. induction n; simpl; [ring|]. rewrite IHn. ring. Qed.

Lemma quadratic_value_ext n a b v :
  (forall i j, (i < n)%nat -> (j < n)%nat -> a i j = b i j) ->
  quadratic_value n a v = quadratic_value n b v.
Proof.
  intros E. apply sum_ext. intros i I. apply sum_ext. intros j J. rewrite E by assumption.
  reflexivity.
Qed.

Lemma complete_square n a v : a n n <> 0 ->
  (forall i, (i < n)%nat -> a i n = a n i) ->
  quadratic_value (S n) a v = quadratic_value n (remainder n a) v
    + a n n * ((v n + sum n (fun i => a n i * v i) / a n n)
               * (v n + sum n (fun i => a n i * v i) / a n n)).
Proof.
  intros N S. set (s := sum n (fun i => a n i * v i)).
  assert (E : quadratic_value n (remainder n a) v = quadratic_value n a v - s * (1 / a n n) * s).
  { transitivity (quadratic_value n a v
      + sum n (fun i => sum n (fun j => a n j * v j) * (- (1 / a n n) * (a n i * v i)))).
    - unfold quadratic_value. rewrite <- sum_plus. apply sum_ext. intros i _.
      rewrite <- sum_times, <- sum_plus. apply sum_ext. intros j _. unfold remainder. ring.
    - fold s. rewrite sum_scale, sum_scale. fold s. ring. }
  rewrite E. unfold quadratic_value. simpl. rewrite sum_plus.
  rewrite (sum_ext n (fun i => a i n * (v i * v n)) (fun i => a n i * v i * v n)).
  2: { intros i I. rewrite S by exact I. ring. }
  rewrite (sum_ext n (fun j => a n j * (v n * v j)) (fun j => a n j * v j * v n))
    by (intros; ring).
  rewrite !sum_times. fold s. field. exact N.
Qed.

Lemma definite_by_elimination n a : 0 < a n n ->
  (forall i, (i < n)%nat -> a i n = a n i) ->
  is_definite n (remainder n a) -> is_definite (S n) a.
Proof.
  intros P S D v [k [K N]]. rewrite complete_square by (lra || exact S).
  set (y := v n + sum n (fun i => a n i * v i) / a n n).
  destruct (some_nonzero n v) as [Z|E].
  - assert (Y : y = v n).
    { unfold y. rewrite (sum_zero n); [field; lra|]. intros i I. rewrite Z by exact I. ring. }
    assert (V : v n <> 0).
    { destruct (Nat.eq_dec k n) as [<-|]; [exact N|]. elim N. apply Z. lia. }
    rewrite Y. unfold quadratic_value. rewrite (sum_zero n).
    + assert (0 < v n * v n) by nra. nra.
    + intros i I. apply sum_zero. intros j J. rewrite (Z i I). ring.
  - pose proof (D v E). assert (0 <= y * y) by nra. nra.
Qed.

(** The columns of A V, and the products of these columns with each other. *)
Definition times (n : nat) (v a : nat -> nat -> R) (i j : nat) : R :=
  sum n (fun l => v l j * a i l).
Definition products (m : nat) (a : nat -> nat -> R) (i j : nat) : R :=
  sum m (fun h => a h i * a h j).

Lemma products_value m n a y :
  quadratic_value n (products m a) y = sum m (fun h => image n a y h * image n a y h).
Proof.
  unfold quadratic_value, products.
  rewrite (sum_ext n _ (fun i => sum m (fun h => sum n (fun j => a h i * a h j * (y i * y j))))).
  2: { intros i _. rewrite sum_swap. apply sum_ext. intros j _. symmetry. apply sum_times. }
  rewrite sum_swap. apply sum_ext. intros h _. unfold image.
  rewrite <- sum_times. apply sum_ext. intros i _.
  rewrite <- sum_scale. apply sum_ext. intros j _. ring.
Qed.

Lemma image_of_product n v a y h : image n (times n v a) y h = image n a (image n v y) h.
Proof.
  unfold image, times.
  rewrite (sum_ext n _ (fun j => sum n (fun l => v l j * a h l * y j)))
    by (intros; symmetry; apply sum_times).
  rewrite sum_swap. apply sum_ext. intros l _. rewrite <- sum_scale.
  apply sum_ext. intros. ring.
Qed.

Lemma image_ext n a v w i : (forall j, (j < n)%nat -> v j = w j) -> image n a v i = image n a w i.
Proof. intros E. apply sum_ext. intros j J. rewrite E by exact J. reflexivity. Qed.

(** The number y^T (c V^T V - P^T P) y. *)
Definition pencil (m n : nat) (p v : nat -> nat -> R) (c : R) (i j : nat) : R :=
  c * products n v i j - products m p i j.

Lemma pencil_value m n p v c y : quadratic_value n (pencil m n p v c) y
  = c * sum n (fun i => image n v y i * image n v y i)
    - sum m (fun h => image n p y h * image n p y h).
Proof.
  rewrite <- !products_value. unfold quadratic_value, Rminus.
  rewrite <- sum_scale, <- (Rmult_1_l (- sum n _)), Ropp_mult_distr_r_reverse,
    Ropp_mult_distr_l, <- sum_scale, <- sum_plus.
  apply sum_ext. intros i _. rewrite <- !sum_scale, <- sum_plus. apply sum_ext. intros j _.
  unfold pencil. ring.
Qed.

Lemma image_of_zero n a y i : (forall j, (j < n)%nat -> y j = 0) -> image n a y i = 0.
Proof. intros Z. apply sum_zero. intros j J. rewrite (Z j J). ring. Qed.

Lemma squares_of_zero n y : (forall j, (j < n)%nat -> y j = 0) -> sum n (fun i => y i * y i) = 0.
Proof. intros Z. apply sum_zero. intros j J. rewrite (Z j J). ring. Qed.

(** If V is regular, each vector is V y. *)
Lemma as_image n v w : (forall y, (forall i, (i < n)%nat -> image n v y i = 0) ->
    forall j, (j < n)%nat -> y j = 0) -> is_nonzero_vector n w ->
  exists y, is_nonzero_vector n y /\ forall i, (i < n)%nat -> image n v y i = w i.
Proof.
  intros R (i & I & N). destruct (solvable n v w R) as [y Y]. exists y. split; [|exact Y].
  destruct (some_nonzero n y) as [Z|H]; [|exact H]. elim N. rewrite <- (Y i I).
  apply image_of_zero, Z.
Qed.

(** |X w|^2 < c |w|^2, if c V^T V - (X V)^T X V is positive definite. Then V is regular. *)
Theorem below_by_pencil m n v a c : is_definite n (pencil m n (times n v a) v c) ->
  forall w, is_nonzero_vector n w ->
    sum m (fun h => image n a w h * image n a w h) < c * sum n (fun i => w i * w i).
Proof.
  intros D w W.
  destruct (as_image n v w) as (y & N & Y); [|exact W|].
  { intros y Z j J. destruct (Req_dec (y j) 0) as [|N]; [assumption|]. exfalso.
    specialize (D y (ex_intro _ j (conj J N))). rewrite pencil_value in D.
    rewrite (squares_of_zero n _ Z) in D. rewrite (squares_of_zero m) in D; [lra|].
    intros h _. rewrite image_of_product. apply image_of_zero, Z. }
  specialize (D y N). rewrite pencil_value in D.
  rewrite (sum_ext n _ (fun i => w i * w i)) in D by (intros i I; rewrite (Y i I); reflexivity).
  rewrite (sum_ext m _ (fun h => image n a w h * image n a w h)) in D; [lra|].
  intros h _. rewrite image_of_product, (image_ext n a _ w h Y). reflexivity.
Qed.

(** |w|^2 < c |X w|^2, if Z X V = I and c V^T V - T^T T is positive definite with
    T = Z^T V^T V: with w = V y, the square of w is (T y) (X w). *)
Definition weighted (n : nat) (v z : nat -> nat -> R) (h j : nat) : R :=
  sum n (fun i => products n v i j * z i h).

Lemma products_symmetric m a i j : products m a i j = products m a j i.
Proof. apply sum_ext. intros. ring. Qed.

Lemma image_of_weighted n v z y h :
  image n (weighted n v z) y h = sum n (fun i => image n (products n v) y i * z i h).
Proof.
  unfold image, weighted.
  rewrite (sum_ext n _ (fun j => sum n (fun i => products n v i j * z i h * y j)))
    by (intros; symmetry; apply sum_times).
  rewrite sum_swap. apply sum_ext. intros i _. rewrite <- sum_times. apply sum_ext. intros. ring.
Qed.

Lemma square_of_image n v y : sum n (fun i => image n v y i * image n v y i)
  = sum n (fun i => image n (products n v) y i * y i).
Proof.
  rewrite <- products_value. unfold quadratic_value. apply sum_ext. intros i _. unfold image.
  rewrite <- sum_times. apply sum_ext. intros. ring.
Qed.

Theorem above_by_pencil m n v a z c :
  (forall i j, (i < n)%nat -> (j < n)%nat ->
     sum m (fun h => z i h * times n v a h j) = identity i j) ->
  is_definite n (pencil m n (weighted n v z) v c) -> forall w, is_nonzero_vector n w ->
    sum n (fun i => w i * w i) < c * sum m (fun h => image n a w h * image n a w h).
Proof.
  intros I D w W.
  assert (ZX : forall y i, (i < n)%nat -> sum m (fun h => z i h * image n a (image n v y) h) = y i).
  { intros y i Hi. rewrite <- (sum_identity n i y Hi).
    rewrite (sum_ext n _ (fun j => sum m (fun h => z i h * times n v a h j) * y j))
      by (intros j J; rewrite (I i j Hi J); reflexivity).
    rewrite (sum_product m n). apply sum_ext. intros h _. rewrite <- image_of_product.
    reflexivity. }
  destruct (as_image n v w) as (y & N & Y); [|exact W|].
  { intros y Z j J. rewrite <- (ZX y j J). apply sum_zero. intros h _.
    rewrite (image_of_zero n a _ h Z). ring. }
  specialize (D y N). rewrite pencil_value in D.
  set (p := image n (weighted n v z) y) in *. set (u := image n a w).
  assert (S : sum n (fun i => image n v y i * image n v y i) = sum n (fun i => w i * w i))
    by (apply sum_ext; intros i Hi; rewrite (Y i Hi); reflexivity).
  assert (Q : sum n (fun i => w i * w i) = sum m (fun h => p h * u h)).
  { rewrite <- S, square_of_image.
    rewrite (sum_ext n _ (fun i => sum m (fun h =>
      image n (products n v) y i * z i h * u h))).
    - rewrite sum_swap. apply sum_ext. intros h _. unfold p. rewrite image_of_weighted.
      rewrite <- sum_times. reflexivity.
    - intros i Hi. rewrite <- (ZX y i Hi), <- sum_scale. apply sum_ext. intros h _.
      unfold u. rewrite (image_ext n a _ w h Y). ring. }
  rewrite S in D. pose proof (cauchy m p u) as C. rewrite <- Q in C.
  assert (P : 0 < sum n (fun i => w i * w i)).
  { destruct W as (i & Hi & K). clear - Hi K. induction n as [|n IH]; [lia|]. simpl.
    pose proof (sum_squares_not_negative n w). destruct (Nat.eq_dec i n) as [<-|].
    - assert (0 < w i * w i) by nra. lra.
    - assert (0 < sum n (fun i => w i * w i)) by (apply IH; lia). nra. }
  set (s := sum n (fun i => w i * w i)) in *. set (q := sum m (fun h => p h * p h)) in *.
  pose proof (sum_squares_not_negative m u) as U. fold (image n a w) in U. fold u in U.
  set (r := sum m (fun h => u h * u h)) in *.
  change (sum m (fun h => image n a w h * image n a w h)) with r.
  apply (Rmult_lt_reg_l s); [exact P|]. apply Rle_lt_trans with (1 := C).
  assert (0 < r).
  { destruct (Req_dec r 0) as [Z|]; [|lra]. rewrite Z in C. nra. }
  nra.
Qed.

Lemma nonzero_of_norm n v : 0 < euclidean_norm n v -> is_nonzero_vector n v.
Proof.
  intros P. destruct (some_nonzero n v) as [Z|N]; [|exact N]. unfold euclidean_norm in P.
  rewrite (sum_zero n), sqrt_0 in P; [lra|]. intros i I. rewrite (Z i I). ring.
Qed.

Lemma norm_square n v : euclidean_norm n v * euclidean_norm n v = sum n (fun i => v i * v i).
Proof. apply sqrt_sqrt, sum_squares_not_negative. Qed.

Lemma less_of_squares x y : 0 <= y -> x * x < y * y -> x < y.
Proof. intros. nra. Qed.

Lemma above_of_squares m n limit a : 0 < limit ->
  (forall w, is_nonzero_vector n w -> sum n (fun i => w i * w i)
     < 1 / (limit * limit) * sum m (fun h => image n a w h * image n a w h)) ->
  values_are_above m n limit a.
Proof.
  intros P D v V. specialize (D v (nonzero_of_norm n v V)). rewrite <- !norm_square in D.
  apply less_of_squares; [apply sqrt_pos|].
  set (x := euclidean_norm m (image n a v)) in *. set (p := euclidean_norm n v) in *.
  assert (L : 0 < limit * limit) by nra. apply (Rmult_lt_compat_l (limit * limit)) in D; [|exact L].
  replace (limit * limit * (1 / (limit * limit) * (x * x))) with (x * x) in D by (field; lra).
  lra.
Qed.

Lemma below_of_squares m n limit a : 0 <= limit ->
  (forall w, is_nonzero_vector n w -> sum m (fun h => image n a w h * image n a w h)
     < limit * limit * sum n (fun i => w i * w i)) -> values_are_below m n limit a.
Proof.
  intros P D v V. specialize (D v (nonzero_of_norm n v V)). rewrite <- !norm_square in D.
  apply less_of_squares; [apply Rmult_le_pos; lra|]. lra.
Qed.

Lemma ratio_of_squares m n limit a c : 0 < limit -> c <> 0 ->
  (forall w, is_nonzero_vector n w ->
     sum n (fun i => w i * w i) < c * sum m (fun h => image n a w h * image n a w h)) ->
  (forall w, is_nonzero_vector n w -> sum m (fun h => image n a w h * image n a w h)
     < limit * limit * (1 / c) * sum n (fun i => w i * w i)) -> ratio_is_below m n limit a.
Proof.
  intros P N A B v w V W. specialize (A w (nonzero_of_norm n w W)).
  specialize (B v (nonzero_of_norm n v V)). rewrite <- !norm_square in A, B.
  assert (U : 0 <= euclidean_norm m (image n a w)) by apply sqrt_pos.
  assert (T : 0 <= euclidean_norm m (image n a v)) by apply sqrt_pos.
  set (x := euclidean_norm m (image n a v)) in *. set (y := euclidean_norm m (image n a w)) in *.
  set (p := euclidean_norm n v) in *. set (r := euclidean_norm n w) in *.
  apply less_of_squares; [repeat apply Rmult_le_pos; lra|].
  set (d := limit * limit * (1 / c)) in *.
  assert (E : d * c = limit * limit) by (unfold d; field; exact N).
  assert (V2 : 0 < p * p) by nra. assert (W2 : 0 < r * r) by nra.
  assert (D : 0 < d * (p * p)) by nra.
  assert (B' : x * x * (r * r) < d * (p * p) * (r * r)) by (apply Rmult_lt_compat_r; lra).
  assert (A' : d * (p * p) * (r * r) < d * (p * p) * (c * (y * y)))
    by (apply Rmult_lt_compat_l; lra).
  replace (d * (p * p) * (c * (y * y))) with (limit * limit * (p * p) * (y * y)) in A'
    by (rewrite <- E; ring).
  lra.
Qed.

(** ** Positive definite matrices over a box *)

(** Of a symmetric matrix, row i has the entries up to column i. *)
Definition lower_triangle (n : nat) (f : nat -> nat -> form) : forms :=
  map (fun i => map (f i) (seq 0 (S i))) (seq 0 n).

Lemma lower_triangle_at n f i j : (i < n)%nat -> (j <= i)%nat ->
  form_at (lower_triangle n f) i j = f i j.
Proof.
  intros I J. unfold form_at, lower_triangle.
  rewrite (nth_indep _ [] (map (f O) (seq 0 1))) by (rewrite map_size, seq_size; exact I).
  rewrite (map_nth (fun i => map (f i) (seq 0 (S i))) (seq 0 n) O i), seq_nth by exact I.
  change (0 + i)%nat with i.
  rewrite (nth_indep _ _ (f i O)) by (rewrite map_size, seq_size; lia).
  rewrite (map_nth (f i)), seq_nth by lia. reflexivity.
Qed.

(** By elimination, from the last row on: each pivot is positive all over the box. *)
Fixpoint is_definite_form (n : nat) (a : forms) : bool :=
  match n with
  | O => true
  | S k =>
      let pivot := form_at a k k in
      let v := Enclosure (form_range pivot) pivot in
      if is_positive (range v) then
        let inverse := polynomial (enclose_inverse v) in
        let factors := map (fun i => multiply_forms (form_at a k i) inverse) (seq 0 k) in
        is_definite_form k (lower_triangle k (fun i j =>
          subtract_forms (form_at a i j)
            (multiply_forms (nth i factors (constant_form I.nai)) (form_at a k j))))
      else false
  end.

Theorem is_definite_form_correct t n : forall a A, in_unit_box t ->
  (forall i j, (i < n)%nat -> (j <= i)%nat -> form_encloses t (form_at a i j) (A i j)) ->
  (forall i j, (i < n)%nat -> (j < n)%nat -> A i j = A j i) ->
  is_definite_form n a = true -> is_definite n A.
Proof.
  induction n as [|k IH]; intros a A T H S E; [intros v (i & I & _); lia|].
  cbn [is_definite_form] in E.
  set (v := Enclosure (form_range (form_at a k k)) (form_at a k k)) in *.
  destruct is_positive eqn:P; [|discriminate].
  assert (V : represents t v (A k k)).
  { split; [apply (form_range_encloses t); [exact T|]|]; apply H; lia. }
  pose proof (is_positive_correct _ _ P (proj1 V)) as N.
  apply definite_by_elimination; [exact N|intros i I; apply S; lia|].
  assert (Y : forall i j, (i < k)%nat -> (j < k)%nat ->
            remainder k A i j = remainder k A j i).
  { intros i j I J. unfold remainder. rewrite (S i j) by lia. ring. }
  refine (IH _ _ T _ Y E). intros i j I J. rewrite lower_triangle_at by assumption.
  unfold remainder. apply subtract_forms_enclose; [apply H; lia|].
  apply multiply_forms_enclose; [exact T| |apply H; lia].
  rewrite (nth_indep _ _ (multiply_forms (form_at a k O) (polynomial (enclose_inverse v))))
    by (rewrite map_size, seq_size; exact I).
  rewrite (map_nth (fun i => multiply_forms (form_at a k i) (polynomial (enclose_inverse v)))),
    seq_nth by exact I.
  apply multiply_forms_enclose; [exact T|apply H; simpl; lia|].
  apply inverse_represents; [lra|exact T|exact V].
Qed.

(** ** The test of a matrix over a box *)

(** Approximate right singular vectors. Nothing is proved of them. *)
Module Directions.
  Import Coq.Floats.PrimFloat.
  Open Scope float_scope.

  Definition dot (l k : list float) : float :=
    fold_left (fun s u => add s (mul (fst u) (snd u))) (combine l k) zero.
  Definition mixed (a b : float) (l k : list float) : list float :=
    map (fun u => add (mul a (fst u)) (mul b (snd u))) (combine l k).

  (** A vector, and before it its image. *)
  Definition pair : Type := list float * list float.
  Definition size (u : pair) : float := dot (fst u) (fst u).

  (** Both are turned in their plane until their images are orthogonal. *)
  Definition orthogonal (u w : pair) : pair * pair :=
    let a := size u in
    let b := size w in
    let c := dot (fst u) (fst w) in
    if ltb (mul a (mul b 0x1p-106)) (mul c c) then
      let z := div (sub b a) (add c c) in
      let r := div one (add (abs z) (sqrt (add one (mul z z)))) in
      let tangent := if ltb z zero then opp r else r in
      let cosine := div one (sqrt (add one (mul tangent tangent))) in
      let sine := mul tangent cosine in
      ((mixed cosine (opp sine) (fst u) (fst w), mixed cosine (opp sine) (snd u) (snd w)),
       (mixed sine cosine (fst u) (fst w), mixed sine cosine (snd u) (snd w)))
    else (u, w).

  Fixpoint with_others (u : pair) (others : list pair) : pair * list pair :=
    match others with
    | [] => (u, [])
    | w :: later =>
        let (u', w') := orthogonal u w in
        let (u'', later') := with_others u' later in
        (u'', w' :: later')
    end.

  Fixpoint sweep (n : nat) (l : list pair) : list pair :=
    match n, l with
    | S k, u :: later => let (u', later') := with_others u later in u' :: sweep k later'
    | _, _ => l
    end.

  Fixpoint insert (u : pair) (l : list pair) : list pair :=
    match l with
    | w :: later => if ltb (size w) (size u) then w :: insert u later else u :: l
    | [] => [u]
    end.

  (** The vectors with their images, that of the least singular value first. *)
  Definition of (m n : nat) (a : nat -> nat -> float) : list pair :=
    let unit j := map (fun i => if Nat.eqb i j then one else zero) (seq 0 n) in
    let columns := map (fun j => (map (fun i => a i j) (seq 0 m), unit j)) (seq 0 n) in
    fold_right insert [] (Nat.iter 8 (sweep n) columns).

  (** The rows of a left inverse of the images. *)
  Definition inverse (l : list pair) : list (list float) :=
    map (fun u => map (fun x => div x (size u)) (fst u)) l.
End Directions.

(** A polynomial with numbers as coefficients, near the form. *)
Definition exact_form (f : form) : form :=
  Form (point (I.midpoint (constant f))) (exact_terms (linear f)) (exact_terms (quadratic f))
    (exact_terms (single f)).
Definition exact_form_value (t : positive -> R) (f : form) : R :=
  real_of (I.midpoint (constant f)) + exact_value t (linear f) + exact_value t (quadratic f)
  + exact_value t (single f).

Lemma exact_form_encloses t f : form_encloses t (exact_form f) (exact_form_value t f).
Proof.
  do 4 eexists. split; [apply point_encloses|].
  do 3 (split; [apply exact_terms_enclose|]). reflexivity.
Qed.

(** What is shown of the singular values. *)
Inductive spectral := Values_above | Values_below | Ratio_below.

Definition spectral_bound (what : spectral) : nat -> nat -> R -> (nat -> nat -> R) -> Prop :=
  match what with
  | Values_above => values_are_above
  | Values_below => values_are_below
  | Ratio_below => ratio_is_below
  end.

(** The vectors are rows: v_j has number j. *)
Definition vector_product (n : nat) (v : list (list F.type)) (i j : nat) : interval :=
  interval_sum n (fun l => multiply (point (get v i l)) (point (get v j l))).

(** X V. *)
Definition direction_forms (m n : nat) (v : list (list F.type)) (a : forms) : forms :=
  tabulate m n (fun i j => form_sum n (fun l => scale_form (point (get v j l)) (form_at a i l))).

(** A left inverse of Y over the box, where K is one in the middle. With K Y = I + E, the linear
    part L of E, and E' = E - L - L E, it is the matrix Z with (I + E') Z = (I - L) K. It is
    K - (L + E') K - E' (Z - K), and column h of Z is within y_h of that of (I - L) K. *)
Section Left_inverse.
  Variables (m n : nat) (k : list (list F.type)) (y : forms).
  Let e := product_error m n k y.
  Let l := map (map (fun f => exact_terms (linear f))) e.
  Let at_ i j := nth j (nth i l []) [].

  (** L K. *)
  Definition shift_range (i h : nat) : interval :=
    interval_sum n (fun f => multiply (terms_range (at_ i f)) (point (get k f h))).

  Definition left_inverse_forms : option forms :=
    let e' := corrected_error n e in
    let p := map (map (fun f => I.abs (form_range f))) e' in
    let of_p j i := nth j (nth i p []) I.nai in
    let both := tabulate n n (fun i j => add_forms (linear_form (at_ i j)) (form_at e' i j)) in
    let shifts := map (map I.abs) (tabulate n m shift_range) in
    let shift i h := nth h (nth i shifts []) I.nai in
    let size h i := add (I.abs (point (get k i h))) (shift i h) in
    let ys := list_of m (fun h =>
      Hint.correction n (fun i j => I.upper (of_p i j)) (fun i => I.upper (size h i))) in
    let y h := nth h ys [] in
    if Nat.ltb 0 m then
      if forallb (fun h => corrects n of_p (size h) (y h)) (seq 0 m) then
        Some (tabulate n m (fun i h =>
          let rest := interval_sum n (fun f =>
            multiply (of_p f i) (add (shift f h) (point (nth f (y h) F.nan)))) in
          add_forms
            (subtract_forms (constant_form (point (get k i h)))
              (form_sum n (fun f => scale_form (point (get k f h)) (form_at both i f))))
            (constant_form (multiply symmetric rest))))
      else None
    else None.
End Left_inverse.

Section Left_inverse_correct.
  Variables (t : positive -> R) (m n : nat) (y : forms) (Y : nat -> nat -> R).
  Hypothesis T : in_unit_box t.
  Hypothesis y_encloses :
    forall i j, (i < m)%nat -> (j < n)%nat -> form_encloses t (form_at y i j) (Y i j).
  Variable k : list (list F.type).

  Let K i l := real_of (get k i l).
  Let E i j := sum m (fun l => K i l * Y l j) - identity i j.
  Let e := product_error m n k y.
  Let l := map (map (fun f => exact_terms (linear f))) e.
  Let at_ i j := nth j (nth i l []) [].
  Let L i j := exact_value t (linear (form_at e i j)).
  Let E' i j := E i j - L i j - sum n (fun k => L i k * E k j).
  (** (I - L) K. *)
  Let S i h := sum n (fun f => L i f * K f h).
  Let W i h := K i h - S i h.

  Lemma start_product i j : (i < n)%nat -> (j < n)%nat ->
    sum m (fun h => W i h * Y h j) = identity i j + E' i j.
  Proof.
    intros I J. set (KY := fun f => sum m (fun h => K f h * Y h j)).
    transitivity (KY i - sum n (fun f => L i f * KY f)).
    - unfold W, S. rewrite (sum_ext m _ (fun h => K i h * Y h j
        + (-1) * sum n (fun f => L i f * (K f h * Y h j)))).
      2: { intros h _. rewrite (sum_ext n (fun f => L i f * (K f h * Y h j))
             (fun f => L i f * K f h * Y h j)) by (intros; ring).
           rewrite sum_times. ring. }
      rewrite sum_plus, sum_scale, sum_swap. unfold KY.
      rewrite (sum_ext n (fun f => sum m (fun h => L i f * (K f h * Y h j)))
        (fun f => L i f * sum m (fun h => K f h * Y h j))) by (intros; apply sum_scale).
      ring.
    - unfold E'. rewrite (sum_ext n (fun f => L i f * KY f)
        (fun f => L i f * E f j + identity j f * L i f)).
      + rewrite sum_plus, sum_identity by exact J. unfold E. fold (KY i). ring.
      + intros f _. unfold E. fold (KY f). unfold identity. rewrite (Nat.eqb_sym j f). ring.
  Qed.

  Lemma at_is_enclosed i j : (i < n)%nat -> (j < n)%nat -> terms_enclose t (at_ i j) (L i j).
  Proof. exact (at_encloses t m n y k i j). Qed.

  Lemma columns_of_inverse (b : nat -> nat -> R) count :
    (forall h, (h < count)%nat -> (forall i, (i < n)%nat -> 0 < b h i) /\
       forall i, (i < n)%nat -> sum n (fun j => Rabs (E' i j) * (Rabs (W j h) + b h j)) < b h i) ->
    exists Z : nat -> nat -> R, forall i h, (i < n)%nat -> (h < count)%nat ->
      Z i h + sum n (fun j => E' i j * Z j h) = W i h /\ Rabs (Z i h - W i h) <= b h i.
  Proof.
    induction count as [|c IH]; intros H; [exists (fun _ _ => 0); lia|].
    destruct IH as [Z HZ]; [intros h Hh; apply H; lia|].
    destruct (H c) as [P B]; [lia|].
    destruct (correction n (fun j i => E' i j) (fun i => W i c) (b c) P B) as (q & Q & D).
    exists (fun i h => if Nat.eqb h c then q i else Z i h). intros i h I Hh.
    destruct (Nat.eqb_spec h c) as [->|N]; [exact (conj (Q i I) (D i I))|].
    apply HZ; [exact I|lia].
  Qed.

  Theorem left_inverse_correct z : left_inverse_forms m n k y = Some z ->
    exists Z, (forall i j, (i < n)%nat -> (j < n)%nat ->
        sum m (fun h => Z i h * Y h j) = identity i j) /\
      forall i h, (i < n)%nat -> (h < m)%nat -> form_encloses t (form_at z i h) (Z i h).
  Proof.
    unfold left_inverse_forms. fold e. set (e' := corrected_error n e).
    set (p := map (map (fun f => I.abs (form_range f))) e'). cbv zeta.
    set (of_p := fun j i => nth j (nth i p []) I.nai).
    set (shifts := map (map I.abs) (tabulate n m (shift_range m n k y))).
    set (shift := fun i h => nth h (nth i shifts []) I.nai).
    set (size := fun h i => add (I.abs (point (get k i h))) (shift i h)).
    set (ys := list_of m _). destruct (Nat.ltb_spec 0 m) as [M|]; [|discriminate].
    destruct (forallb _ (seq 0 m)) eqn:C; [|discriminate]. intros [= <-].
    rewrite forallb_forall in C. set (b := fun h i => real_of (nth i (nth h ys []) F.nan)).
    assert (EE : forall i j, (i < n)%nat -> (j < n)%nat ->
              form_encloses t (form_at e' i j) (E' i j))
      by (intros i j I J; exact (corrected_error_encloses t m n y Y T y_encloses k i j I J)).
    assert (PE : forall i j, (i < n)%nat -> (j < n)%nat -> encloses (of_p j i) (Rabs (E' i j))).
    { intros i j I J. unfold of_p, p, e', corrected_error.
      rewrite map_tabulate, tabulate_nth by assumption.
      apply absolute_encloses, (form_range_encloses t); [exact T|].
      pose proof (EE i j I J) as H. unfold e', corrected_error in H.
      rewrite tabulate_at in H by assumption. exact H. }
    assert (SE : forall i h, (i < n)%nat -> (h < m)%nat -> encloses (shift i h) (Rabs (S i h))).
    { intros i h I H. unfold shift, shifts. rewrite map_tabulate, tabulate_nth by assumption.
      apply absolute_encloses, interval_sum_encloses. intros f F.
      apply multiply_encloses; [|apply point_encloses].
      apply (terms_range_encloses t); [exact T|exact (at_is_enclosed i f I F)]. }
    assert (Good : forall h, (h < m)%nat -> (forall i, (i < n)%nat -> 0 < b h i) /\
       forall i, (i < n)%nat ->
         sum n (fun j => Rabs (E' i j) * (Rabs (W j h) + b h j)) < b h i).
    { intros h H. specialize (C h ltac:(apply in_seq; lia)). unfold corrects in C.
      rewrite forallb_forall in C.
      split; intros i I; specialize (C i ltac:(apply in_seq; lia)); apply andb_prop in C as [C D].
      - exact (is_positive_correct _ _ C (point_encloses _)).
      - apply Rle_lt_trans with
          (sum n (fun j => Rabs (E' i j) * (Rabs (K j h) + Rabs (S j h) + b h j))).
        + apply sum_le. intros j J. apply Rmult_le_compat_l; [apply Rabs_pos|].
          unfold W. pose proof (Rabs_triang (K j h) (- S j h)) as Q. rewrite Rabs_Ropp in Q.
          unfold Rminus. lra.
        + apply Rminus_lt. refine (is_negative_correct _ _ D _).
          apply subtract_encloses; [|apply point_encloses]. apply interval_sum_encloses.
          intros j J. apply multiply_encloses; [apply PE; assumption|].
          apply add_encloses; [|apply point_encloses].
          apply add_encloses; [apply absolute_encloses, point_encloses|apply SE; assumption]. }
    destruct (columns_of_inverse b m Good) as [Z HZ].
    assert (R : full_column_rank n n (fun i j => identity i j + E' i j)).
    { destruct (Good O M) as [P B]. apply (dominated n E' (b O) P). intros i I.
      eapply Rle_lt_trans; [|exact (B i I)]. apply sum_le. intros j J.
      apply Rmult_le_compat_l; [apply Rabs_pos|]. pose proof (Rabs_pos (W j O)). lra. }
    exists Z. split.
    - intros i j I J. apply Rminus_diag_uniq.
      set (zy := fun f => sum m (fun h => Z f h * Y h j)).
      refine (R (fun f => zy f - identity f j) _ i I). intros f F. cbv beta.
      assert (Q : zy f + sum n (fun g => E' f g * zy g) = identity f j + E' f j).
      { rewrite <- start_product by assumption. unfold zy.
        rewrite <- (sum_product n m (E' f) Z (fun h => Y h j)), <- sum_plus.
        apply sum_ext. intros h H. rewrite <- (proj1 (HZ f h F H)). ring. }
      rewrite (sum_ext n _ (fun g => identity f g * (zy g - identity g j)
        + (E' f g * zy g + (-1) * (identity j g * E' f g)))).
      2: { intros g _. unfold identity. rewrite (Nat.eqb_sym g j). ring. }
      rewrite !sum_plus, sum_scale, !sum_identity by assumption. lra.
    - intros i h I H. rewrite tabulate_at by assumption. destruct (HZ i h I H) as [Q _].
      replace (Z i h) with (K i h - sum n (fun f => K f h * (L i f + E' i f))
        + - sum n (fun f => E' i f * (Z f h - K f h))).
      + apply add_forms_enclose; [apply subtract_forms_enclose|].
        * apply constant_form_encloses, point_encloses.
        * apply form_sum_encloses. intros f F. apply scale_form_encloses; [apply point_encloses|].
          rewrite tabulate_at by assumption. apply add_forms_enclose; [|apply EE; assumption].
          apply linear_form_encloses, at_is_enclosed; assumption.
        * apply constant_form_encloses, (spread_encloses _
            (sum n (fun f => Rabs (E' i f) * (Rabs (S f h) + b h f)))).
          -- apply interval_sum_encloses. intros f F.
             apply multiply_encloses; [apply PE; assumption|].
             apply add_encloses; [apply SE; assumption|apply point_encloses].
          -- rewrite Rabs_Ropp. eapply Rle_trans; [apply sum_abs|]. apply sum_le. intros f F.
             rewrite Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|].
             replace (Z f h - K f h) with (- S f h + (Z f h - W f h)) by (unfold W; ring).
             eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
             apply Rplus_le_compat_l, HZ; assumption.
      + rewrite (sum_ext n (fun f => E' i f * (Z f h - K f h))
          (fun f => E' i f * Z f h + (-1) * (E' i f * K f h))) by (intros; ring).
        rewrite (sum_ext n (fun f => K f h * (L i f + E' i f))
          (fun f => L i f * K f h + E' i f * K f h)) by (intros; ring).
        rewrite !sum_plus, sum_scale. fold (S i h).
        replace (Z i h) with (W i h - sum n (fun f => E' i f * Z f h)) by lra. unfold W. ring.
  Qed.
End Left_inverse_correct.

(** Z^T V^T V. The columns of V are nearly orthogonal, so all terms but one of each sum are
    small. *)
Definition weighted_forms (m n : nat) (v : list (list F.type)) (z : forms) : forms :=
  let ranges := map (map form_range) z in
  let weights := tabulate n n (vector_product n v) in
  let weight i j := nth j (nth i weights []) I.nai in
  tabulate m n (fun h j =>
    add_forms (scale_form (weight j j) (form_at z j h))
      (constant_form (interval_sum n (fun i =>
        if Nat.eqb i j then zero else multiply (weight i j) (nth h (nth i ranges []) I.nai))))).

(** The products of the columns of a matrix with each other. *)
Definition product_forms (m n : nat) (y : forms) : forms :=
  lower_triangle n (fun i j =>
    form_sum m (fun h => multiply_forms (form_at y h i) (form_at y h j))).

(** c V^T V - P^T P, with the vectors in an order in which the pivot that is next to 0 comes last; g
    has P^T P. *)
Definition pencil_forms (n : nat) (v : list (list F.type)) (order : nat -> nat) (g : forms)
    (c : form) : forms :=
  lower_triangle n (fun i j =>
    let p := Nat.max (order i) (order j) in
    let q := Nat.min (order i) (order j) in
    subtract_forms (scale_form (vector_product n v p q) c) (form_at g p q)).

Definition opposite_order (n i : nat) : nat := (n - 1 - i)%nat.
Definition same_order (i : nat) : nat := i.

Definition inverse_of_form (f : form) : form :=
  polynomial (enclose_inverse (Enclosure (form_range f) f)).

(** A polynomial between 1 / s^2 and N^2 / S^2, where s is the least singular value, S the largest
    one and N the limit. Any polynomial would do. *)
Definition level (n : nat) (square_of_limit : interval) (g h : forms) : form :=
  exact_form (scale_form (divide one (integer 2)) (add_forms (form_at h 0 0)
    (scale_form square_of_limit (inverse_of_form (form_at g (n - 1) (n - 1)))))).

(** The matrices whose definiteness shows the bound. *)
Definition definite_forms (what : spectral) (m n : nat) (limit : interval) (a : forms) :
    option (list forms) :=
  let u := Directions.of m n (midpoints a) in
  let v := map snd u in
  let y := direction_forms m n v a in
  let square_of_limit := square limit in
  match what with
  | Values_below =>
      Some [pencil_forms n v (opposite_order n) (product_forms m n y)
              (constant_form square_of_limit)]
  | _ =>
      match left_inverse_forms m n (Directions.inverse u) y with
      | Some z =>
          let h := product_forms m n (weighted_forms m n v z) in
          match what with
          | Ratio_below =>
              let g := product_forms m n y in
              let c := level n square_of_limit g h in
              if is_positive (form_range c) then
                Some [pencil_forms n v same_order h c;
                      pencil_forms n v (opposite_order n) g
                        (scale_form square_of_limit (inverse_of_form c))]
              else None
          | _ => Some [pencil_forms n v same_order h
                         (constant_form (divide one square_of_limit))]
          end
      | None => None
      end
  end.

Definition are_definite (n : nat) (l : option (list forms)) : bool :=
  match l with Some l => forallb (is_definite_form n) l | None => false end.

Definition fits_bound (what : spectral) (limit : interval) : bool :=
  match what with Values_below => is_not_negative limit | _ => is_positive limit end.

Section Shown.
  Variables (t : positive -> R) (m n : nat) (a : forms) (A : nat -> nat -> R).
  Variable v : list (list F.type).
  Hypothesis T : in_unit_box t.
  Hypothesis a_encloses :
    forall i j, (i < m)%nat -> (j < n)%nat -> form_encloses t (form_at a i j) (A i j).

  Let V i j := real_of (get v j i).
  Let y := direction_forms m n v a.

  Lemma direction_forms_enclose i j : (i < m)%nat -> (j < n)%nat ->
    form_encloses t (form_at y i j) (times n V A i j).
  Proof.
    intros I J. unfold y, direction_forms. rewrite tabulate_at by assumption.
    apply form_sum_encloses. intros l L.
    apply scale_form_encloses; [apply point_encloses|apply a_encloses; assumption].
  Qed.

  Lemma product_forms_enclose p P i j :
    (forall i j, (i < m)%nat -> (j < n)%nat -> form_encloses t (form_at p i j) (P i j)) ->
    (i < n)%nat -> (j <= i)%nat ->
    form_encloses t (form_at (product_forms m n p) i j) (products m P i j).
  Proof.
    intros E I J. unfold product_forms. rewrite lower_triangle_at by assumption.
    apply form_sum_encloses. intros h H. apply multiply_forms_enclose; [exact T| |]; apply E; lia.
  Qed.

  Lemma vector_product_encloses i j : encloses (vector_product n v i j) (products n V i j).
  Proof.
    apply interval_sum_encloses. intros l _. apply multiply_encloses; apply point_encloses.
  Qed.

  Lemma sum_but_one k j (f : nat -> R) : (j < k)%nat ->
    sum k f = f j + sum k (fun i => if Nat.eqb i j then 0 else f i).
  Proof.
    induction k as [|k IH]; intros J; [lia|]. simpl. destruct (Nat.eqb_spec k j) as [->|N].
    - rewrite (sum_ext j (fun i => if Nat.eqb i j then 0 else f i) f); [ring|].
      intros i I. destruct (Nat.eqb_spec i j); [lia|reflexivity].
    - rewrite IH by lia. ring.
  Qed.

  Lemma weighted_forms_enclose z Z h j :
    (forall i h, (i < n)%nat -> (h < m)%nat -> form_encloses t (form_at z i h) (Z i h)) ->
    length z = n -> (forall i, (i < n)%nat -> length (nth i z []) = m) ->
    (h < m)%nat -> (j < n)%nat ->
    form_encloses t (form_at (weighted_forms m n v z) h j) (weighted n V Z h j).
  Proof.
    intros E L M H J. unfold weighted_forms, weighted. rewrite tabulate_at by assumption.
    rewrite tabulate_nth by assumption.
    rewrite (sum_but_one n j) by exact J. apply add_forms_enclose.
    - apply scale_form_encloses; [apply vector_product_encloses|apply E; assumption].
    - apply constant_form_encloses, interval_sum_encloses. intros i I.
      destruct (Nat.eqb i j); [exact (integer_encloses 0)|]. rewrite tabulate_nth by assumption.
      apply multiply_encloses; [apply vector_product_encloses|].
      rewrite (nth_indep _ [] (map form_range [])) by (rewrite map_size, L; exact I).
      rewrite map_nth.
      rewrite (nth_indep _ I.nai (form_range (constant_form I.nai)))
        by (rewrite map_size, M by exact I; exact H).
      rewrite map_nth. apply (form_range_encloses t); [exact T|]. exact (E i h I H).
  Qed.

  Lemma pencil_forms_correct order g P f c : (forall i, (i < n)%nat -> (order i < n)%nat) ->
    (forall i j, (i < n)%nat -> (j <= i)%nat ->
       form_encloses t (form_at g i j) (products m P i j)) ->
    form_encloses t f c -> is_definite_form n (pencil_forms n v order g f) = true ->
    is_definite n (pencil m n (fun h j => P h (order j)) (fun i j => V i (order j)) c).
  Proof.
    intros O G C H. refine (is_definite_form_correct t n _ _ T _ _ H).
    - intros i j I J. unfold pencil_forms. rewrite lower_triangle_at by assumption. cbv zeta.
      unfold pencil.
      change (products m (fun h j => P h (order j)) i j) with (products m P (order i) (order j)).
      change (products n (fun h j => V h (order j)) i j) with (products n V (order i) (order j)).
      assert (Oi : (order i < n)%nat) by (apply O, I). assert (Oj : (order j < n)%nat)
        by (apply O; lia).
      destruct (Nat.le_ge_cases (order j) (order i)) as [Q|Q].
      + rewrite (Nat.max_l _ _ Q), (Nat.min_r _ _ Q), Rmult_comm.
        apply subtract_forms_enclose; [|apply G; assumption].
        apply scale_form_encloses; [apply vector_product_encloses|exact C].
      + rewrite (Nat.max_r _ _ Q), (Nat.min_l _ _ Q), Rmult_comm.
        rewrite (products_symmetric m), (products_symmetric n).
        apply subtract_forms_enclose; [|apply G; assumption].
        apply scale_form_encloses; [apply vector_product_encloses|exact C].
    - intros i j _ _. unfold pencil. rewrite (products_symmetric m), (products_symmetric n).
      reflexivity.
  Qed.

  Lemma below_by_forms f c : form_encloses t f c ->
    is_definite_form n (pencil_forms n v (opposite_order n) (product_forms m n y) f) = true ->
    forall w, is_nonzero_vector n w ->
      sum m (fun h => image n A w h * image n A w h) < c * sum n (fun i => w i * w i).
  Proof.
    intros C H. apply (below_by_pencil m n (fun i j => V i (opposite_order n j)) A).
    refine (pencil_forms_correct _ _ (times n V A) f c _ _ C H).
    - unfold opposite_order. lia.
    - intros i j I J. apply product_forms_enclose; [exact direction_forms_enclose| |]; assumption.
  Qed.

  Lemma above_by_forms k z f c : form_encloses t f c -> left_inverse_forms m n k y = Some z ->
    is_definite_form n (pencil_forms n v same_order
      (product_forms m n (weighted_forms m n v z)) f) = true ->
    forall w, is_nonzero_vector n w ->
      sum n (fun i => w i * w i) < c * sum m (fun h => image n A w h * image n A w h).
  Proof.
    intros C Z H.
    destruct (left_inverse_correct t m n y (times n V A) T direction_forms_enclose k z Z)
      as (B & U & E).
    apply (above_by_pencil m n V A B c U).
    refine (pencil_forms_correct same_order _ (weighted n V B) f c (fun i I => I) _ C H).
    intros i j I J. apply product_forms_enclose; [|exact I|exact J]. intros h l Hh Hl.
    assert (Size : length z = n /\ forall i, (i < n)%nat -> length (nth i z []) = m).
    { unfold left_inverse_forms in Z. cbv zeta in Z. destruct (Nat.ltb 0 m); [|discriminate].
      destruct (forallb _ _); [|discriminate]. injection Z as <-. unfold tabulate.
      split; [rewrite map_size, seq_size; reflexivity|]. intros i' I'.
      match goal with |- length (nth _ (map ?g _) _) = _ =>
        rewrite (nth_indep _ [] (g O)) by (rewrite map_size, seq_size; exact I');
        rewrite (map_nth g) end.
      rewrite map_size, seq_size. reflexivity. }
    apply weighted_forms_enclose; try assumption; apply Size.
  Qed.
End Shown.

Theorem definite_forms_correct what t m n limit l a A : in_unit_box t ->
  (forall i j, (i < m)%nat -> (j < n)%nat -> form_encloses t (form_at a i j) (A i j)) ->
  encloses limit l -> fits_bound what limit = true ->
  are_definite n (definite_forms what m n limit a) = true -> spectral_bound what m n l A.
Proof.
  intros T H L P. unfold definite_forms. set (u := Directions.of m n (midpoints a)).
  set (v := map snd u). set (y := direction_forms m n v a). cbv zeta.
  pose proof (square_encloses _ _ L) as L2.
  destruct what; simpl in P.
  - destruct left_inverse_forms as [z|] eqn:Z; [|discriminate]. intros D. simpl in D.
    rewrite andb_true_r in D. pose proof (is_positive_correct _ _ P L) as Q.
    apply above_of_squares; [exact Q|]. refine (above_by_forms t m n a A v T H _ z _ _ _ Z D).
    apply constant_form_encloses, (divide_encloses one _ 1 (l * l));
      [nra|exact (integer_encloses 1)|exact L2].
  - intros D. simpl in D. rewrite andb_true_r in D.
    apply below_of_squares; [exact (is_not_negative_correct _ _ P L)|].
    exact (below_by_forms t m n a A v T H _ _ (constant_form_encloses t _ _ L2) D).
  - destruct left_inverse_forms as [z|] eqn:Z; [|discriminate].
    set (c := level _ _ _ _). destruct (is_positive (form_range c)) eqn:C; [|discriminate].
    intros D. simpl in D. rewrite andb_true_r in D. apply andb_prop in D as [D1 D2].
    assert (E : exists r, form_encloses t c r) by (eexists; apply exact_form_encloses).
    destruct E as [r E]. pose proof (form_range_encloses t c r T E) as Er.
    pose proof (is_positive_correct _ _ C Er) as R0.
    apply (ratio_of_squares m n l A r); [exact (is_positive_correct _ _ P L)|lra| |].
    + exact (above_by_forms t m n a A v T H _ z _ _ E Z D1).
    + refine (below_by_forms t m n a A v T H _ _ _ D2).
      apply scale_form_encloses; [exact L2|]. unfold inverse_of_form.
      apply inverse_represents; [lra|exact T|exact (conj Er E)].
Qed.

(** ** The test of a box *)

(** What makes the matrices that are not shown to be definite vary, each by its own size. *)
Definition attempt_of_spectrum (n : nat) (l : list forms) : attempt :=
  let sizes g := map (fun i => PrimFloat.sqrt (PrimFloat.abs (midpoints g i i))) (seq 0 n) in
  let unit_forms g :=
    let s := sizes g in
    flat_map (fun i => map (fun j =>
      Hint.over (form_at g i j)
        (PrimFloat.mul (nth i s PrimFloat.nan) (nth j s PrimFloat.nan))) (seq 0 (S i)))
      (seq 0 n) in
  let all := flat_map unit_forms (filter (fun g => negb (is_definite_form n g)) l) in
  Attempt [[Form zero (flat_map linear all) (flat_map quadratic all) (flat_map single all)]] []
    [PrimFloat.one].

(** The forms of diag(s) A diag(f). *)
Definition scaled_forms (m n : nat) (s : list (option enclosure)) (f : list interval) (a : forms) :
    forms :=
  tabulate m n (fun i j =>
    scale_form (nth j f I.nai) (multiply_forms (form_of (nth i s None)) (form_at a i j))).

Definition test_spectrum (what : spectral) (q : question) (scales factors : list expression)
    (limit : expression) (m : method) (b : box) : answer :=
  let names := evaluate_definitions (variables (second_order m) b) (definitions q) in
  if existsb (is_excluded names) (constraints q) then Outside
  else
    let a := map (map (evaluate names)) (matrix q) in
    let s := map (evaluate names) scales in
    if is_model_known q names a && forallb is_known s then
      let x := scaled_forms (rows q) (columns q) s (bounds_of_limits factors)
        (map (map form_of) a) in
      let l := definite_forms what (rows q) (columns q) (range_or_none (evaluate [] limit)) x in
      if are_definite (columns q) l then Regular
      else
        match l with
        | Some l => Open (attempt_of_spectrum (columns q) l)
        | None => Open (attempt_at (rows q) (columns q) x)
        end
    else Undefined.

(** There is a scale for each row and a factor for each column. *)
Definition is_spectrum_known (what : spectral) (q : question) (scales factors : list expression)
    (limit : expression) : bool :=
  fits_bound what (range_or_none (evaluate [] limit)) && is_known (evaluate [] limit)
  && Nat.eqb (length scales) (rows q) && Nat.eqb (length factors) (columns q)
  && forallb (fun e => is_known (evaluate [] e) && is_nonzero (evaluate [] e)) factors.

Definition check_spectrum (what : spectral) (q : question) (scales factors : list expression)
    (limit : expression) (m : method) : bool :=
  is_spectrum_known what q scales factors limit &&
  match enclose_ranges (ranges q) with
  | Some root =>
      match search (test_spectrum what q scales factors limit m) root (deepest m) root with
      | Some _ => true
      | None => false
      end
  | None => false
  end.

Definition check_spectrum_tree (what : spectral) (q : question) (scales factors : list expression)
    (limit : expression) (m : method) (t : tree) : bool :=
  is_spectrum_known what q scales factors limit &&
  match enclose_ranges (ranges q) with
  | Some root => check_parts (test_spectrum what q scales factors limit m) t root
  | None => false
  end.

(** ** It is correct *)

Definition spectrum_holds_at (what : spectral) (q : question) (scales factors : list expression)
    (limit : expression) (x : list R) : Prop :=
  in_set q x ->
    let names := extend x (definitions q) in
    model_defined q x /\ Forall (defined names) scales /\
    spectral_bound what (rows q) (columns q) (value [] limit)
      (scaled_matrix (value_of names scales) (value_of [] factors) (entry q names)).

Lemma is_spectrum_known_correct what q scales factors limit :
  is_spectrum_known what q scales factors limit = true ->
  fits_bound what (range_or_none (evaluate [] limit)) = true /\
  (defined [] limit /\ encloses (range_or_none (evaluate [] limit)) (value [] limit)) /\
  length scales = rows q /\ length factors = columns q /\
  Forall (fun e => defined [] e /\ value [] e <> 0) factors /\
  Forall (fun e => is_known (evaluate [] e) = true) factors.
Proof.
  unfold is_spectrum_known. intros H. apply andb_prop in H as [H K].
  apply andb_prop in H as [H F]. apply andb_prop in H as [H S]. apply andb_prop in H as [P L].
  rewrite forallb_forall in K. split; [exact P|]. split.
  { destruct (evaluate [] limit) as [v|] eqn:V; [|discriminate]. exact (threshold_known _ _ V). }
  split; [apply Nat.eqb_eq, S|]. split; [apply Nat.eqb_eq, F|].
  split; apply Forall_forall; intros e E; specialize (K e E); apply andb_prop in K as [K N].
  - destruct (evaluate [] e) as [v|] eqn:V; [|discriminate].
    destruct (threshold_known _ _ V) as [D R]. split; [exact D|].
    exact (is_not_zero_correct _ _ N R).
  - exact K.
Qed.

Theorem test_spectrum_correct what q scales factors limit m :
  is_spectrum_known what q scales factors limit = true -> forall b x, in_box b x ->
  is_closed (test_spectrum what q scales factors limit m b) = true ->
  spectrum_holds_at what q scales factors limit x.
Proof.
  intros Q b x B. apply is_spectrum_known_correct in Q as (P & [_ Ll] & Ls & Lf & _ & Kf).
  unfold test_spectrum.
  set (vs := evaluate_definitions (variables (second_order m) b) (definitions q)).
  destruct existsb eqn:E; [intros _ S; elim (outside_correct q m b x B E S)|].
  set (a := map (map (evaluate vs)) (matrix q)). unfold is_model_known.
  destruct (forallb is_known vs) eqn:D1; [|discriminate].
  destruct (forallb (fun e => is_known (evaluate vs e)) (also_defined q)) eqn:D2; [|discriminate].
  destruct (forallb (forallb is_known) a) eqn:D3; [|discriminate].
  destruct (forallb (fun r => Nat.eqb (length r) (columns q)) a) eqn:D4; [|discriminate].
  cbn [andb]. set (s := map (evaluate vs) scales).
  destruct (forallb is_known s) eqn:D5; [|discriminate].
  set (y := scaled_forms _ _ _ _ _).
  destruct (are_definite (columns q) _) eqn:D; [|destruct definite_forms; discriminate].
  intros _ _.
  pose proof (coordinate_in_unit_box b x B) as T.
  pose proof (known_definitions _ (definitions q) _ _ T (variables_known (second_order m) b x B))
    as K.
  set (names := extend x (definitions q)) in *.
  destruct (all_known_represent _ vs names scales T K D5) as [Ds Vs]. cbv zeta. fold names.
  split; [apply (everything_defined q m b x B); assumption|]. split; [exact Ds|].
  refine (definite_forms_correct what _ _ _ _ _ _ _ T _ Ll P D). intros i j I J.
  unfold y, scaled_forms. rewrite tabulate_at by assumption. unfold scaled_matrix.
  rewrite Rmult_comm. apply scale_form_encloses; [apply bound_of_limit; [lia|exact Kf]|].
  apply multiply_forms_enclose; [exact T| |].
  - destruct (Vs i) as (v & V & Rv); [lia|]. unfold s. rewrite V. exact (proj2 Rv).
  - exact (entries_enclosed q m b x B i j D3 D4 I J).
Qed.

Lemma spectrum_of_boxes what q scales factors limit :
  is_spectrum_known what q scales factors limit = true ->
  ends_defined q -> (forall x, Forall2 in_range x (ranges q) ->
    spectrum_holds_at what q scales factors limit x) ->
  matrix_satisfies (spectral_bound what) q scales factors limit.
Proof.
  intros K R H. apply is_spectrum_known_correct in K as (_ & [Dl _] & Ls & Lf & F & _).
  split; [exact Dl|]. split; [exact R|]. split; [exact Ls|]. split; [exact Lf|].
  split; [exact F|]. intros x X. exact (H x (proj1 X) X).
Qed.

Theorem check_spectrum_correct what q scales factors limit m :
  check_spectrum what q scales factors limit m = true ->
  matrix_satisfies (spectral_bound what) q scales factors limit.
Proof.
  unfold check_spectrum. intros H. apply andb_prop in H as [K H].
  destruct enclose_ranges as [root|] eqn:R; [|discriminate].
  destruct search as [n|] eqn:L; [|discriminate].
  apply (spectrum_of_boxes _ _ _ _ _ K (enclose_ranges_defined q root R)). intros x X.
  refine (search_correct _ (spectrum_holds_at what q scales factors limit)
    (test_spectrum_correct what q scales factors limit m K) _ _ _ x n _ L).
  exact (enclose_ranges_correct _ root x R X).
Qed.

(** The same with a hint. *)
Theorem check_spectrum_tree_correct what q scales factors limit m t :
  check_spectrum_tree what q scales factors limit m t = true ->
  matrix_satisfies (spectral_bound what) q scales factors limit.
Proof.
  unfold check_spectrum_tree. intros H. apply andb_prop in H as [K H].
  destruct enclose_ranges as [root|] eqn:R; [|discriminate].
  apply (spectrum_of_boxes _ _ _ _ _ K (enclose_ranges_defined q root R)). intros x X.
  refine (check_parts_correct _ (spectrum_holds_at what q scales factors limit)
    (test_spectrum_correct what q scales factors limit m K) t _ x _ H).
  exact (enclose_ranges_correct _ root x R X).
Qed.

(** The same for a trajectory, without and with a hint for each piece. *)
Definition check_spectrum_pieces (what : spectral) (q : list expression -> question)
    (scales factors : list expression) (limit : expression) (m : method)
    (pieces : list (list expression)) : bool :=
  forallb (fun piece => check_spectrum what (q piece) scales factors limit m) pieces.

Theorem check_spectrum_pieces_correct what q scales factors limit m pieces :
  check_spectrum_pieces what q scales factors limit m pieces = true ->
  Forall (fun piece => matrix_satisfies (spectral_bound what) (q piece) scales factors limit)
    pieces.
Proof.
  unfold check_spectrum_pieces. rewrite forallb_forall. intros H. apply Forall_forall.
  intros piece P. apply (check_spectrum_correct what (q piece) scales factors limit m), H, P.
Qed.

Definition check_spectrum_piece_trees (what : spectral) (q : list expression -> question)
    (scales factors : list expression) (limit : expression) (m : method) :
    list (list expression) -> list tree -> bool :=
  check_each (fun q => check_spectrum_tree what q scales factors limit m) q.

Theorem check_spectrum_piece_trees_correct what q scales factors limit m pieces trees :
  check_spectrum_piece_trees what q scales factors limit m pieces trees = true ->
  Forall (fun piece => matrix_satisfies (spectral_bound what) (q piece) scales factors limit)
    pieces.
Proof.
  apply (check_each_correct _
    (fun q => matrix_satisfies (spectral_bound what) q scales factors limit)).
  intros q' t. apply check_spectrum_tree_correct.
Qed.

(** ** For each claim *)

Definition check_singular_values_above := check_spectrum Values_above.
Definition check_singular_values_above_tree := check_spectrum_tree Values_above.
Definition check_singular_values_above_pieces := check_spectrum_pieces Values_above.
Definition check_singular_values_above_piece_trees := check_spectrum_piece_trees Values_above.
Definition check_singular_values_below := check_spectrum Values_below.
Definition check_singular_values_below_tree := check_spectrum_tree Values_below.
Definition check_singular_values_below_pieces := check_spectrum_pieces Values_below.
Definition check_singular_values_below_piece_trees := check_spectrum_piece_trees Values_below.
Definition check_condition_2_below := check_spectrum Ratio_below.
Definition check_condition_2_below_tree := check_spectrum_tree Ratio_below.
Definition check_condition_2_below_pieces := check_spectrum_pieces Ratio_below.
Definition check_condition_2_below_piece_trees := check_spectrum_piece_trees Ratio_below.

Section Question.
  Variables (q : question) (scales factors : list expression) (limit : expression) (m : method).

  Theorem check_singular_values_above_correct :
    check_singular_values_above q scales factors limit m = true ->
    singular_values_above q scales factors limit.
  Proof. exact (check_spectrum_correct Values_above q scales factors limit m). Qed.
  Theorem check_singular_values_below_correct :
    check_singular_values_below q scales factors limit m = true ->
    singular_values_below q scales factors limit.
  Proof. exact (check_spectrum_correct Values_below q scales factors limit m). Qed.
  Theorem check_condition_2_below_correct :
    check_condition_2_below q scales factors limit m = true ->
    condition_2_below q scales factors limit.
  Proof. exact (check_spectrum_correct Ratio_below q scales factors limit m). Qed.

  Theorem check_singular_values_above_tree_correct t :
    check_singular_values_above_tree q scales factors limit m t = true ->
    singular_values_above q scales factors limit.
  Proof. exact (check_spectrum_tree_correct Values_above q scales factors limit m t). Qed.
  Theorem check_singular_values_below_tree_correct t :
    check_singular_values_below_tree q scales factors limit m t = true ->
    singular_values_below q scales factors limit.
  Proof. exact (check_spectrum_tree_correct Values_below q scales factors limit m t). Qed.
  Theorem check_condition_2_below_tree_correct t :
    check_condition_2_below_tree q scales factors limit m t = true ->
    condition_2_below q scales factors limit.
  Proof. exact (check_spectrum_tree_correct Ratio_below q scales factors limit m t). Qed.
End Question.

Section Pieces.
  Variables (q : list expression -> question) (scales factors : list expression).
  Variables (limit : expression) (m : method) (pieces : list (list expression)).

  Theorem check_singular_values_above_pieces_correct :
    check_singular_values_above_pieces q scales factors limit m pieces = true ->
    Forall (fun piece => singular_values_above (q piece) scales factors limit) pieces.
  Proof. exact (check_spectrum_pieces_correct Values_above q scales factors limit m pieces). Qed.
  Theorem check_singular_values_below_pieces_correct :
    check_singular_values_below_pieces q scales factors limit m pieces = true ->
    Forall (fun piece => singular_values_below (q piece) scales factors limit) pieces.
  Proof. exact (check_spectrum_pieces_correct Values_below q scales factors limit m pieces). Qed.
  Theorem check_condition_2_below_pieces_correct :
    check_condition_2_below_pieces q scales factors limit m pieces = true ->
    Forall (fun piece => condition_2_below (q piece) scales factors limit) pieces.
  Proof. exact (check_spectrum_pieces_correct Ratio_below q scales factors limit m pieces). Qed.

  Variable trees : list tree.
  Theorem check_singular_values_above_piece_trees_correct :
    check_singular_values_above_piece_trees q scales factors limit m pieces trees = true ->
    Forall (fun piece => singular_values_above (q piece) scales factors limit) pieces.
  Proof.
    exact (check_spectrum_piece_trees_correct Values_above q scales factors limit m pieces trees).
  Qed.
  Theorem check_singular_values_below_piece_trees_correct :
    check_singular_values_below_piece_trees q scales factors limit m pieces trees = true ->
    Forall (fun piece => singular_values_below (q piece) scales factors limit) pieces.
  Proof.
    exact (check_spectrum_piece_trees_correct Values_below q scales factors limit m pieces trees).
  Qed.
  Theorem check_condition_2_below_piece_trees_correct :
    check_condition_2_below_piece_trees q scales factors limit m pieces trees = true ->
    Forall (fun piece => condition_2_below (q piece) scales factors limit) pieces.
  Proof.
    exact (check_spectrum_piece_trees_correct Ratio_below q scales factors limit m pieces trees).
  Qed.
End Pieces.
