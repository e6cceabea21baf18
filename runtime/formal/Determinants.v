(* SPDX-License-Identifier: Apache-2.0 *)
(** Elimination: a determinant is a pivot times the determinant of a smaller matrix. *)
From Coq Require Import Reals Lra Lia Arith Bool.
From Regulus Require Import LinearAlgebra.
Open Scope R_scope.

Lemma determinant_ext n : forall a b,
  (forall i j, (i < n)%nat -> (j < n)%nat -> a i j = b i j) -> determinant n a = determinant n b.
Proof.
  induction n as [|n IH]; intros a b H; [reflexivity|].
  apply sum_ext. intros j J. rewrite (H O j) by lia. do 2 f_equal. apply IH. intros i k P Q.
  apply H; [lia|]. unfold skip. destruct (Nat.ltb_spec k j); lia.
Qed.

(** ** Columns *)

(** The matrix with u as its column p. *)
Definition with_column (p : nat) (u : nat -> R) (a : nat -> nat -> R) (i j : nat) : R :=
  if Nat.eqb j p then u i else a i j.

(** Where column p is after column j is left out. *)
Definition place (j p : nat) : nat := if p <? j then p else pred p.

Lemma minor_with_column j p u a i k : j <> p ->
  with_column p u a i (skip j k) =
  with_column (place j p) u (fun i k => a i (skip j k)) i k.
Proof.
  intros D. unfold with_column, place, skip.
  destruct (Nat.ltb_spec k j), (Nat.ltb_spec p j);
    destruct (Nat.eqb_spec k p), (Nat.eqb_spec k (pred p)), (Nat.eqb_spec (S k) p),
      (Nat.eqb_spec (S k) (pred p)); try reflexivity; try lia.
Qed.

(** A determinant is linear in each column. *)
Lemma determinant_linear n : forall p u w c a, (p < n)%nat ->
  determinant n (with_column p (fun i => u i + c * w i) a) =
  determinant n (with_column p u a) + c * determinant n (with_column p w a).
Proof.
  induction n as [|n IH]; intros p u w c a P; [lia|].
  set (term := fun v j => (-1) ^ j * (with_column p v a O j *
    determinant n (fun i k => with_column p v a (S i) (skip j k)))).
  change (sum (S n) (term (fun i => u i + c * w i)) = sum (S n) (term u) + c * sum (S n) (term w)).
  rewrite <- sum_scale, <- sum_plus. apply sum_ext. intros j J. unfold term.
  destruct (Nat.eq_dec j p) as [->|D].
  - assert (M : forall v, determinant n (fun i k => with_column p v a (S i) (skip p k)) =
                          determinant n (fun i k => a (S i) (skip p k))).
    { intros v. apply determinant_ext. intros i k _ _. unfold with_column, skip.
      destruct (Nat.ltb_spec k p), (Nat.eqb_spec k p), (Nat.eqb_spec (S k) p);
        try reflexivity; lia. }
    rewrite !M. unfold with_column. rewrite Nat.eqb_refl. generalize ((-1) ^ p). intros. ring.
  - assert (M : forall v, determinant n (fun i k => with_column p v a (S i) (skip j k)) =
      determinant n (with_column (place j p) (fun i => v (S i)) (fun i k => a (S i) (skip j k)))).
    { intros v. apply determinant_ext. intros i k _ _.
      exact (minor_with_column j p (fun i => v (S i)) (fun i k => a (S i) k) i k D). }
    rewrite !M, IH.
    + assert (E : forall v, with_column p v a O j = a O j).
      { intros v. unfold with_column. destruct (Nat.eqb_spec j p); [lia|reflexivity]. }
      rewrite !E.
      generalize ((-1) ^ j). intros. ring.
    + unfold place. destruct (Nat.ltb_spec p j); lia.
Qed.

Lemma sum_pair n p f : (S p < n)%nat ->
  (forall j, (j < n)%nat -> j <> p -> j <> S p -> f j = 0) -> sum n f = f p + f (S p).
Proof.
  induction n as [|n IH]; intros P H; [lia|]. simpl.
  destruct (Nat.eq_dec n (S p)) as [->|D].
  - simpl. rewrite (sum_zero p); [ring|]. intros j J. apply H; lia.
  - rewrite IH; [|lia|intros; apply H; lia]. rewrite (H n) by lia. ring.
Qed.

Lemma adjacent_columns_equal n : forall p a, (S p < n)%nat ->
  (forall i, (i < n)%nat -> a i p = a i (S p)) -> determinant n a = 0.
Proof.
  induction n as [|n IH]; intros p a P E; [lia|]. simpl determinant.
  change (sum (S n) (fun j => (-1) ^ j * (a O j * determinant n (fun i k => a (S i) (skip j k))))
    = 0).
  rewrite (sum_pair _ p); [|exact P|].
  - rewrite (E O) by lia.
    rewrite (determinant_ext n (fun i k => a (S i) (skip p k)) (fun i k => a (S i) (skip (S p) k))).
    + simpl. generalize ((-1) ^ p). intros. ring.
    + intros i k I K. unfold skip. destruct (Nat.ltb_spec k p), (Nat.ltb_spec k (S p));
        try reflexivity; try lia.
      replace k with p by lia. symmetry. apply E. lia.
  - intros j J D1 D2. rewrite (IH (place j p)); [ring| |].
    + unfold place. destruct (Nat.ltb_spec p j); lia.
    + intros i I. unfold place, skip.
      destruct (Nat.ltb_spec p j).
      * destruct (Nat.ltb_spec p j), (Nat.ltb_spec (S p) j); try lia. apply E. lia.
      * destruct (Nat.ltb_spec (pred p) j), (Nat.ltb_spec (S (pred p)) j); try lia.
        replace (S (pred p)) with p by lia. apply E. lia.
Qed.

(** Two equal columns, d columns apart. *)
Lemma equal_columns d : forall n p a, (p + S d < n)%nat ->
  (forall i, (i < n)%nat -> a i p = a i (p + S d)%nat) -> determinant n a = 0.
Proof.
  induction d as [|d IH]; intros n p a P E.
  { apply (adjacent_columns_equal n p); [lia|]. intros i I. rewrite (E i I). f_equal. lia. }
  (* With u and w as the last two columns of these, the determinant changes its sign if they are
     exchanged; then the equal ones are closer. *)
  set (q := (p + S d)%nat).
  set (m := fun u w => with_column q u (with_column (S q) w a)).
  assert (Z : forall u, determinant n (m u u) = 0).
  { intros u. apply (adjacent_columns_equal n q); [lia|]. intros i _. unfold m, with_column.
    rewrite !Nat.eqb_refl. destruct (Nat.eqb_spec (S q) q); [lia|reflexivity]. }
  set (u := fun i => a i q). set (w := fun i => a i (S q)).
  assert (L : forall v x y,
    determinant n (m (fun i => x i + 1 * y i) v)
    = determinant n (m x v) + 1 * determinant n (m y v)).
  { intros v x y. apply determinant_linear. lia. }
  assert (R : forall v x y,
    determinant n (m v (fun i => x i + 1 * y i))
    = determinant n (m v x) + 1 * determinant n (m v y)).
  { intros v x y.
    assert (C : forall z, determinant n (m v z) =
                          determinant n (with_column (S q) z (with_column q v a))).
    { intros z. apply determinant_ext. intros i j _ _. unfold m, with_column.
      destruct (Nat.eqb_spec j q), (Nat.eqb_spec j (S q)); try reflexivity; lia. }
    rewrite !C. apply determinant_linear. lia. }
  pose proof (Z (fun i => u i + 1 * w i)) as H. rewrite L, !R, !Z in H.
  assert (W : determinant n (m w u) = 0).
  { apply (IH n p); [lia|]. intros i I. fold q. unfold m, with_column.
    rewrite Nat.eqb_refl. destruct (Nat.eqb_spec p q), (Nat.eqb_spec p (S q)); try lia.
    unfold w. rewrite (E i I). f_equal. lia. }
  rewrite (determinant_ext n a (m u w)); [lra|].
  intros i j _ _. unfold m, with_column, u, w.
  destruct (Nat.eqb_spec j q) as [->|]; [reflexivity|].
  destruct (Nat.eqb_spec j (S q)) as [->|]; reflexivity.
Qed.

Lemma two_columns_equal n p q a : (p < n)%nat -> (q < n)%nat -> p <> q ->
  (forall i, (i < n)%nat -> a i p = a i q) -> determinant n a = 0.
Proof.
  intros P Q D E. destruct (Nat.lt_ge_cases p q).
  - apply (equal_columns (q - p - 1) n p); [lia|]. intros i I. rewrite (E i I). f_equal. lia.
  - apply (equal_columns (p - q - 1) n q); [lia|]. intros i I. rewrite <- (E i I). f_equal. lia.
Qed.

(** A multiple of column p may be added to another column. *)
Lemma add_to_column n p q c a : (p < n)%nat -> (q < n)%nat -> p <> q ->
  determinant n (with_column q (fun i => a i q + c * a i p) a) = determinant n a.
Proof.
  intros P Q D. rewrite determinant_linear by exact Q.
  rewrite (two_columns_equal n p q (with_column q (fun i => a i p) a)); try assumption.
  - rewrite Rmult_0_r, Rplus_0_r. apply determinant_ext. intros i j _ _. unfold with_column.
    destruct (Nat.eqb_spec j q) as [->|]; reflexivity.
  - intros i _. unfold with_column. rewrite Nat.eqb_refl.
    destruct (Nat.eqb_spec p q); [lia|reflexivity].
Qed.

(** Multiples of column p may be added to all the others. *)
Lemma add_to_columns n p c a : (p < n)%nat ->
  determinant n (fun i j => if Nat.eqb j p then a i p else a i j + c j * a i p) =
  determinant n a.
Proof.
  intros P.
  (* The first m columns are done. *)
  set (b := fun m i j => if (j <? m) && negb (j =? p) then a i j + c j * a i p else a i j).
  assert (B : forall m, (m <= n)%nat -> determinant n (b m) = determinant n a).
  { induction m as [|m IH]; intros M; [apply determinant_ext; reflexivity|].
    rewrite <- IH by lia. destruct (Nat.eq_dec m p) as [->|D].
    - apply determinant_ext. intros i j _ _. unfold b.
      destruct (Nat.ltb_spec j (S p)), (Nat.ltb_spec j p), (Nat.eqb_spec j p);
        try reflexivity; lia.
    - rewrite <- (add_to_column n p m (c m) (b m)) by lia.
      apply determinant_ext. intros i j _ _. unfold b, with_column.
      destruct (Nat.eqb_spec j m) as [->|E].
      + rewrite (proj2 (Nat.ltb_lt m (S m))), Nat.ltb_irrefl by lia.
        rewrite (Nat.eqb_refl p). destruct (Nat.eqb_spec m p); [lia|].
        rewrite Bool.andb_false_r. reflexivity.
      + destruct (Nat.ltb_spec j (S m)), (Nat.ltb_spec j m); try reflexivity; lia. }
  rewrite <- (B n ltac:(lia)). apply determinant_ext. intros i j _ J. unfold b.
  destruct (Nat.ltb_spec j n), (Nat.eqb_spec j p) as [->|]; try reflexivity; lia.
Qed.

(** ** Elimination *)

(** What remains if column p is subtracted from the others such that the first row becomes 0. *)
Definition complement (p : nat) (a : nat -> nat -> R) (i k : nat) : R :=
  a (S i) (skip p k) - a O (skip p k) / a O p * a (S i) p.

Lemma sum_one n p f : (p < n)%nat ->
  (forall j, (j < n)%nat -> j <> p -> f j = 0) -> sum n f = f p.
Proof.
  induction n as [|n IH]; intros P H; [lia|]. simpl. destruct (Nat.eq_dec n p) as [->|D].
  - rewrite sum_zero; [ring|]. intros j J. apply H; lia.
  - rewrite IH; [|lia|intros; apply H; lia]. rewrite (H n) by lia. ring.
Qed.

Theorem elimination n p a : (p < S n)%nat -> a O p <> 0 ->
  determinant (S n) a = (-1) ^ p * (a O p * determinant n (complement p a)).
Proof.
  intros P N. rewrite <- (add_to_columns (S n) p (fun j => - (a O j / a O p)) a P).
  set (b := fun i j => if Nat.eqb j p then a i p else a i j + - (a O j / a O p) * a i p).
  change (sum (S n) (fun j => (-1) ^ j * (b O j * determinant n (fun i k => b (S i) (skip j k)))) =
          (-1) ^ p * (a O p * determinant n (complement p a))).
  rewrite (sum_one _ p); [|exact P|].
  - unfold b at 1. rewrite Nat.eqb_refl. do 2 f_equal. apply determinant_ext. intros i k I K.
    unfold b, complement, skip.
    destruct (Nat.ltb_spec k p); [destruct (Nat.eqb_spec k p)|destruct (Nat.eqb_spec (S k) p)];
      try lia; ring.
  - intros j J D. unfold b at 1. destruct (Nat.eqb_spec j p); [lia|]. field. exact N.
Qed.

(** ** Rows *)

(** The matrix with u as its row p. *)
Definition with_row (p : nat) (u : nat -> R) (a : nat -> nat -> R) (i j : nat) : R :=
  if Nat.eqb i p then u j else a i j.

(** A determinant is linear in each row. *)
Lemma determinant_linear_row n : forall p u w c a, (p < n)%nat ->
  determinant n (with_row p (fun j => u j + c * w j) a) =
  determinant n (with_row p u a) + c * determinant n (with_row p w a).
Proof.
  induction n as [|n IH]; intros p u w c a P; [lia|].
  set (term := fun v j => (-1) ^ j * (with_row p v a O j *
    determinant n (fun i k => with_row p v a (S i) (skip j k)))).
  change (sum (S n) (term (fun j => u j + c * w j)) = sum (S n) (term u) + c * sum (S n) (term w)).
  rewrite <- sum_scale, <- sum_plus. apply sum_ext. intros j J. unfold term.
  destruct p as [|p].
  - unfold with_row. simpl. generalize ((-1) ^ j). intros. ring.
  - assert (M : forall v, determinant n (fun i k => with_row (S p) v a (S i) (skip j k)) =
      determinant n (with_row p (fun k => v (skip j k)) (fun i k => a (S i) (skip j k)))).
    { intros v. apply determinant_ext. reflexivity. }
    rewrite !M, IH by lia. unfold with_row at 1 4 6. simpl. generalize ((-1) ^ j). intros. ring.
Qed.

Lemma row_of_zeros n : forall p a, (p < n)%nat ->
  (forall j, (j < n)%nat -> a p j = 0) -> determinant n a = 0.
Proof.
  induction n as [|n IH]; intros p a P Z; [lia|]. apply sum_zero. intros j J.
  destruct p as [|p]; [rewrite Z by exact J; ring|].
  rewrite (IH p); [ring|lia|]. intros k K. apply Z. unfold skip. destruct (k <? j); lia.
Qed.

Lemma some_nonzero n (f : nat -> R) :
  (forall j, (j < n)%nat -> f j = 0) \/ exists p, (p < n)%nat /\ f p <> 0.
Proof.
  induction n as [|n [Z|[p [P N]]]]; [left; lia| |right; exists p; split; [lia|exact N]].
  destruct (Req_dec (f n) 0) as [E|N]; [left|right; exists n; split; [lia|exact N]].
  intros j J. destruct (Nat.eq_dec j n) as [->|]; [exact E|apply Z; lia].
Qed.

Lemma rows_equal n : forall p q a, (p < q)%nat -> (q < n)%nat ->
  (forall j, (j < n)%nat -> a p j = a q j) -> determinant n a = 0.
Proof.
  induction n as [|n IH]; intros p q a P Q E; [lia|]. destruct q as [|q]; [lia|].
  destruct p as [|p].
  - destruct (some_nonzero (S n) (a O)) as [Z|[k [K N]]].
    + apply (row_of_zeros (S n) O); [lia|exact Z].
    + rewrite (elimination n k a K N), (row_of_zeros n q); [ring|lia|].
      intros j J. unfold complement. rewrite <- !E; [field; exact N|exact K|].
      unfold skip. destruct (j <? k); lia.
  - apply sum_zero. intros j J. rewrite (IH p q); [ring|lia|lia|].
    intros k K. apply E. unfold skip. destruct (k <? j); lia.
Qed.

Lemma two_rows_equal n p q a : (p < n)%nat -> (q < n)%nat -> p <> q ->
  (forall j, (j < n)%nat -> a p j = a q j) -> determinant n a = 0.
Proof.
  intros P Q D E. destruct (Nat.lt_ge_cases p q).
  - apply (rows_equal n p q); assumption.
  - apply (rows_equal n q p); [lia|assumption|]. intros j J. symmetry. apply E, J.
Qed.

(** A multiple of row p may be added to another row. *)
Lemma add_to_row n p q c a : (p < n)%nat -> (q < n)%nat -> p <> q ->
  determinant n (with_row q (fun j => a q j + c * a p j) a) = determinant n a.
Proof.
  intros P Q D. rewrite determinant_linear_row by exact Q.
  rewrite (two_rows_equal n p q (with_row q (a p) a)); try assumption.
  - rewrite Rmult_0_r, Rplus_0_r. apply determinant_ext. intros i j _ _. unfold with_row.
    destruct (Nat.eqb_spec i q) as [->|]; reflexivity.
  - intros j _. unfold with_row. rewrite Nat.eqb_refl.
    destruct (Nat.eqb_spec p q); [lia|reflexivity].
Qed.

(** Multiples of row p may be added to all the others. *)
Theorem add_to_rows n p c a : (p < n)%nat ->
  determinant n (fun i j => if Nat.eqb i p then a p j else a i j + c i * a p j) =
  determinant n a.
Proof.
  intros P.
  (* The first m rows are done. *)
  set (b := fun m i j => if (i <? m) && negb (i =? p) then a i j + c i * a p j else a i j).
  assert (B : forall m, (m <= n)%nat -> determinant n (b m) = determinant n a).
  { induction m as [|m IH]; intros M; [apply determinant_ext; reflexivity|].
    rewrite <- IH by lia. destruct (Nat.eq_dec m p) as [->|D].
    - apply determinant_ext. intros i j _ _. unfold b.
      destruct (Nat.ltb_spec i (S p)), (Nat.ltb_spec i p), (Nat.eqb_spec i p);
        try reflexivity; lia.
    - rewrite <- (add_to_row n p m (c m) (b m)) by lia.
      apply determinant_ext. intros i j _ _. unfold b, with_row.
      destruct (Nat.eqb_spec i m) as [->|E].
      + rewrite (proj2 (Nat.ltb_lt m (S m))), Nat.ltb_irrefl by lia.
        rewrite (Nat.eqb_refl p). destruct (Nat.eqb_spec m p); [lia|].
        rewrite Bool.andb_false_r. reflexivity.
      + destruct (Nat.ltb_spec i (S m)), (Nat.ltb_spec i m); try reflexivity; lia. }
  rewrite <- (B n ltac:(lia)). apply determinant_ext. intros i j I _. unfold b.
  destruct (Nat.ltb_spec i n), (Nat.eqb_spec i p) as [->|]; try reflexivity; lia.
Qed.
