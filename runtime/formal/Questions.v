(* SPDX-License-Identifier: Apache-2.0 *)
(** What a certificate claims. These are the definitions to read in order to know what is proved. *)
From Coq Require Import Reals QArith List.
From Regulus Require Import Expressions LinearAlgebra.
Import ListNotations.
Open Scope R_scope.

Record question := Question {
  (** The ends of the range of each variable: parameters, uncertain quantities, control errors. *)
  ranges : list (expression * expression);
  (** Constants, poses and shared expressions. The variables are names 0, 1, …, and each definition
      is the next name. *)
  definitions : list expression;
  (** Each is at most 0 at every pose of the set. *)
  constraints : list expression;
  (** More expressions that must have a value for the model to mean something. *)
  also_defined : list expression;
  (** The rows of the matrix, and the number of its columns. *)
  matrix : list (list expression);
  columns : nat }.

Definition rows (q : question) : nat := length (matrix q).

Definition no_entry : expression := Constant (0 # 1).

(** The entry of row i and column j. *)
Definition entry (q : question) (names : list R) (i j : nat) : R :=
  value names (nth j (nth i (matrix q) []) no_entry).

Definition in_range (x : R) (ends : expression * expression) : Prop :=
  value [] (fst ends) <= x <= value [] (snd ends).

(** Both ends of each range have a value. Otherwise the set would mean nothing. *)
Definition ends_defined (q : question) : Prop :=
  Forall (fun ends => defined [] (fst ends) /\ defined [] (snd ends)) (ranges q).

(** The set that the question is about. A constraint without a value excludes nothing. *)
Definition in_set (q : question) (x : list R) : Prop :=
  Forall2 in_range x (ranges q) /\
  forall c, In c (constraints q) ->
    let names := extend x (definitions q) in defined names c -> value names c <= 0.

(** Every expression of the model has a value. *)
Definition model_defined (q : question) (x : list R) : Prop :=
  let names := extend x (definitions q) in
  all_defined x (definitions q) /\
  Forall (defined names) (also_defined q) /\
  Forall (Forall (defined names)) (matrix q).

(** NO SINGULARITY: the ranges are defined, and at every point of the set, everything is defined and
    the matrix has full column rank. *)
Definition no_singularity (q : question) : Prop :=
  ends_defined q /\ forall x, in_set q x ->
    model_defined q x /\
    full_column_rank (rows q) (columns q) (entry q (extend x (definitions q))).

(** SINGULARITY: at some point of the set, everything is defined and the determinant is 0. *)
Definition singularity (q : question) : Prop :=
  exists x, in_set q x /\ model_defined q x /\ rows q = columns q /\
    determinant (columns q) (entry q (extend x (definitions q))) = 0.

Definition product (l : list R) : R := fold_right Rmult 1 l.

(** |det A| times the scales of its rows: a number that can be compared with a threshold. *)
Definition scaled_determinant (q : question) (scales : list expression) (x : list R) : R :=
  let names := extend x (definitions q) in
  Rabs (determinant (columns q) (entry q names) * product (map (value names) scales)).

Definition scales_defined (q : question) (scales : list expression) (x : list R) : Prop :=
  Forall (defined (extend x (definitions q))) scales.

(** NO SINGULARITY by a threshold: the ranges are defined, and at every point of the set,
    everything is defined and the scaled determinant is larger than the threshold. *)
Definition determinant_above (q : question) (scales : list expression) (threshold : expression) :=
  defined [] threshold /\ rows q = columns q /\ ends_defined q /\
  forall x, in_set q x ->
    model_defined q x /\ scales_defined q scales x /\
    value [] threshold < scaled_determinant q scales x.

(** SINGULARITY by a threshold: at some point of the set, everything is defined and the scaled
    determinant is at most the threshold. *)
Definition determinant_not_above (q : question) (scales : list expression)
    (threshold : expression) :=
  defined [] threshold /\ rows q = columns q /\
  exists x, in_set q x /\ model_defined q x /\ scales_defined q scales x /\
    scaled_determinant q scales x <= value [] threshold.

(** ** Forces *)

(** The forces F of the rows balance a load w: M^T D F = w, where D has the scales s of the rows. *)
Definition in_balance (n : nat) (m : nat -> nat -> R) (s F w : nat -> R) : Prop :=
  forall j, (j < n)%nat -> sum n (fun i => m i j * (s i * F i)) = w j.

(** The ranges are defined. At every point of the set, everything is defined, the matrix is square
    and regular, and the force of a row, the first being row 0, satisfies a bound. The load is
    divided by the scale of this row; whatever the scales are, then, the forces are those under the
    load. *)
Definition force_satisfies (bound : R -> Prop) (q : question) (row : nat)
    (load : list expression) :=
  rows q = columns q /\ (row < columns q)%nat /\ length load = columns q /\ ends_defined q /\
  forall x, in_set q x ->
    let names := extend x (definitions q) in
    model_defined q x /\ Forall (defined names) load /\
    full_column_rank (rows q) (columns q) (entry q names) /\
    forall s F, s row <> 0 ->
      in_balance (columns q) (entry q names) s F
        (fun j => s row * value names (nth j load no_entry)) ->
      bound (F row).

Definition force_within (q : question) (row : nat) (load : list expression) (limit : expression) :=
  defined [] limit /\ force_satisfies (fun f => Rabs f < value [] limit) q row load.

Definition force_below (q : question) (row : nat) (load : list expression) (limit : expression) :=
  defined [] limit /\ force_satisfies (fun f => f < value [] limit) q row load.
