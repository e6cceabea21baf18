(* SPDX-License-Identifier: Apache-2.0 *)
(** Approximate linear algebra in doubles. Nothing is proved of it, nor needs to be: the tests that
    use these numbers are sound for any numbers. *)
From Coq Require Import List PrimFloat.
Import ListNotations.

(** More than rounding makes of an enclosure of a sine. *)
Definition width_of_rounding : float := 0x1p-40.

Definition get (a : list (list float)) (i j : nat) : float := nth j (nth i a []) nan.

Definition tabulate {A} (m n : nat) (f : nat -> nat -> A) : list (list A) :=
  map (fun i => map (f i) (seq 0 n)) (seq 0 m).

Definition larger (x y : float) : float := if ltb x y then y else x.

Fixpoint take_largest (j : nat) (best : list float) (others rows : list (list float)) :=
  match rows with
  | [] => (best, others)
  | r :: rows' =>
      if ltb (abs (nth j best nan)) (abs (nth j r nan)) then take_largest j r (best :: others) rows'
      else take_largest j best (r :: others) rows'
  end.

Fixpoint subtract_multiple (c : float) (p r : list float) : list float :=
  match p, r with
  | x :: p', y :: r' => sub y (mul c x) :: subtract_multiple c p' r'
  | _, _ => []
  end.

(** Elimination with row pivoting, n columns from column j on. *)
Fixpoint eliminate (n j : nat) (reduced rows : list (list float)) : list (list float) :=
  match n, rows with
  | S n', r :: rows' =>
      let (p, others) := take_largest j r [] rows' in
      let p' := map (fun x => div x (nth j p nan)) p in
      let clear := fun r => subtract_multiple (nth j r nan) p' r in
      eliminate n' (S j) (map clear reduced ++ [p']) (map clear others)
  | _, _ => reduced
  end.

(** K with KA = I, roughly, for an m x n matrix A with m >= n. *)
Definition left_inverse (m n : nat) (a : nat -> nat -> float) : list (list float) :=
  let row i := map (a i) (seq 0 n) ++ map (fun l => if Nat.eqb i l then one else zero) (seq 0 m) in
  map (skipn n) (eliminate n 0 [] (map row (seq 0 m))).

Definition float_sum (l : list float) : float := fold_left add l zero.

(** v with Pv < v, if there is one. *)
Definition dominating_vector (n : nat) (p : nat -> nat -> float) : list float :=
  let difference i j := sub (if Nat.eqb i j then one else zero) (p i j) in
  map float_sum (left_inverse n n difference).

(** The number of the largest of these, if any is positive. *)
Definition largest_of (l : list float) : option nat :=
  let step '(best, k, i) x := if ltb best x then (x, Some i, S i) else (best, k, S i) in
  snd (fst (fold_left step l (zero, None, O))).

(** For each column of an n x n matrix a row p, and the factors by which row p is added to the
    others such that the rest of the column becomes 0. *)
Fixpoint clearing (columns n : nat) (used : list nat) (column : nat) (a : list (list float)) :
    list (nat * list float) :=
  match columns with
  | O => []
  | S columns' =>
      let size i := if existsb (Nat.eqb i) used then zero else abs (get a i column) in
      match largest_of (map size (seq 0 n)) with
      | None => []
      | Some p =>
          let factors :=
            map (fun i => opp (div (get a i column) (get a p column))) (seq 0 n) in
          let entry i j := if Nat.eqb i p then get a p j
                           else add (get a i j) (mul (nth i factors zero) (get a p j)) in
          (p, factors) :: clearing columns' n (p :: used) (S column) (tabulate n n entry)
      end
  end.
