(* SPDX-License-Identifier: Apache-2.0 *)
(** Expressions written as in a certificate: [2*sin(x)^2 - 1/4*sqrt(y)]. *)
From Coq Require Import QArith List.
From Coq Require Decimal Number.
From Regulus Require Import Expressions.
Import ListNotations.

(** A decimal such as 12, 0.5 or 1e-3 is exactly this rational number. *)
Definition power_of_ten (n : Z) : Q :=
  if Z.leb 0 n then (10 ^ n) # 1 else 1 # Z.to_pos (10 ^ (- n)).

Definition rational_of (i : Decimal.int) (f : Decimal.uint) (e : Decimal.int) : Q :=
  inject_Z (Z.of_int (Decimal.app_int i f))
  * power_of_ten (Z.of_int e - Z.of_nat (Decimal.nb_digits f)).

Definition of_number (n : Number.number) : option expression :=
  match n with
  | Number.Decimal (Decimal.Decimal i f) => Some (Constant (rational_of i f (Z.to_int 0)))
  | Number.Decimal (Decimal.DecimalExp i f e) => Some (Constant (rational_of i f e))
  | Number.Hexadecimal _ => None
  end.

(** Numbers are read, never printed. *)
Definition to_number (e : expression) : option Number.number := None.

Declare Scope expression_scope.
Delimit Scope expression_scope with expression.
Bind Scope expression_scope with expression.
Number Notation expression of_number to_number : expression_scope.

Notation "- x" := (Negate x) : expression_scope.
Infix "+" := Add : expression_scope.
Infix "-" := Subtract : expression_scope.
Infix "*" := Multiply : expression_scope.
Infix "/" := Divide : expression_scope.
Notation "x ^ n" := (Power x n%nat) : expression_scope.

Notation pi := Pi.
Notation sqrt := Sqrt.
Notation sin := Sin.
Notation cos := Cos.
Notation atan := Atan.
Notation exp := Exp.
Notation log := Log.
Notation abs := Abs.

Open Scope expression_scope.

(** These are not defined at the ends of their domains: asin and acos at -1 and 1, and atan2 where
    y = 0 and x <= 0. *)
Definition tan (x : expression) : expression := sin x / cos x.
Definition asin (x : expression) : expression := atan (x / sqrt (1 - x ^ 2)).
Definition acos (x : expression) : expression := pi / 2 - asin x.
Definition atan2 (yx : expression * expression) : expression :=
  let (y, x) := yx in 2 * atan (y / (sqrt (x ^ 2 + y ^ 2) + x)).

(** An angle of so many degrees is a multiple of this. *)
Definition deg : expression := pi / 180.

(** The range middle +- spread. *)
Definition within (middle spread : expression) : expression * expression :=
  (middle - spread, middle + spread).
