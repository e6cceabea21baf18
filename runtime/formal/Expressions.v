(* SPDX-License-Identifier: Apache-2.0 *)
(** Expressions of a certificate, and what they mean: real numbers, exactly. *)
From Coq Require Import Reals QArith Qreals List.
Import ListNotations.
Open Scope R_scope.

Inductive expression :=
  | Constant (q : Q)
  | Pi
  | Name (k : nat)  (** the k-th of the variables and definitions *)
  | Negate (a : expression)
  | Add (a b : expression)
  | Subtract (a b : expression)
  | Multiply (a b : expression)
  | Divide (a b : expression)
  | Power (a : expression) (n : nat)
  | Sqrt (a : expression)
  | Sin (a : expression)
  | Cos (a : expression)
  | Atan (a : expression)
  | Exp (a : expression)
  | Log (a : expression)
  | Abs (a : expression).

(** The value of an expression. It means something only where the expression is [defined]. *)
Fixpoint value (names : list R) (e : expression) : R :=
  match e with
  | Constant q => Q2R q
  | Pi => PI
  | Name k => nth k names 0
  | Negate a => - value names a
  | Add a b => value names a + value names b
  | Subtract a b => value names a - value names b
  | Multiply a b => value names a * value names b
  | Divide a b => value names a / value names b
  | Power a n => value names a ^ n
  | Sqrt a => sqrt (value names a)
  | Sin a => sin (value names a)
  | Cos a => cos (value names a)
  | Atan a => atan (value names a)
  | Exp a => exp (value names a)
  | Log a => ln (value names a)
  | Abs a => Rabs (value names a)
  end.

(** No division by zero, no root of a negative number, no logarithm of a number that is not
    positive, and no name that is not declared. *)
Fixpoint defined (names : list R) (e : expression) : Prop :=
  match e with
  | Constant _ | Pi => True
  | Name k => (k < length names)%nat
  | Add a b | Subtract a b | Multiply a b => defined names a /\ defined names b
  | Divide a b => defined names a /\ defined names b /\ value names b <> 0
  | Sqrt a => defined names a /\ 0 <= value names a
  | Log a => defined names a /\ 0 < value names a
  | Negate a | Power a _ | Sin a | Cos a | Atan a | Exp a | Abs a => defined names a
  end.

(** Definitions may use the names before them: each appends its value to the list. *)
Fixpoint extend (names : list R) (definitions : list expression) : list R :=
  match definitions with
  | [] => names
  | d :: later => extend (names ++ [value names d]) later
  end.

Fixpoint all_defined (names : list R) (definitions : list expression) : Prop :=
  match definitions with
  | [] => True
  | d :: later => defined names d /\ all_defined (names ++ [value names d]) later
  end.
