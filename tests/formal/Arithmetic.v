(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** Results of every primitive operation that the checks use. Coq and the program that it writes must
    have the same ones. *)
From Coq Require Import List FloatClass PrimFloat PrimInt63.
From Regulus Require Primitives.
Import ListNotations.
Local Open Scope uint63_scope.

Definition tiny := PrimFloat.ldshiftexp PrimFloat.one 1027.

Definition doubles : list PrimFloat.float := [
  0; -0; 1; -1; 0.1; -0.1; 1.5; 3; -7.25; 9007199254740991; 9007199254740993; 4503599627370497.5;
  1e300; -1e300; 1e-300; 1.7976931348623157e308; -1.7976931348623157e308; 2.2250738585072014e-308;
  2.2250738585072009e-308; 3.3e-310; PrimFloat.infinity; PrimFloat.neg_infinity; PrimFloat.nan
]%float ++ [tiny; PrimFloat.opp tiny; PrimFloat.next_up tiny].

Definition integers : list int := [
  0; 1; 2; 3; 52; 62; 63; 64; 1027; 2100; 2101; 2154; 3125; 4201; 4202; 4203;
  9007199254740993; 9007199254740995; 4611686018427387903; 4611686018427387904;
  4611686018427388416; 4611686018427388417; 4611686018427388928; 4611686018427389440;
  9223372036854775295; 9223372036854775296; 9223372036854775807 ].

Definition of_bool (b : bool) : int := if b then 1 else 0.

Definition of_class (c : float_class) : int :=
  match c with
  | PNormal => 1 | NNormal => 2 | PSubn => 3 | NSubn => 4 | PZero => 5 | NZero => 6 | PInf => 7
  | NInf => 8 | NaN => 9
  end.

Definition of_comparison (c : PrimFloat.float_comparison) : int :=
  match c with
  | PrimFloat.FEq => 1 | PrimFloat.FLt => 2 | PrimFloat.FGt => 3 | PrimFloat.FNotComparable => 4
  end.

(** Every double has other numbers. *)
Definition of_double (x : PrimFloat.float) : list int :=
  let (m, e) := PrimFloat.frshiftexp x in
  [of_class (PrimFloat.classify x); PrimFloat.normfr_mantissa m; e].

Definition pairs {A B C} (f : A -> B -> list C) (l : list A) (k : list B) : list C :=
  flat_map (fun x => flat_map (f x) k) l.

Definition unary (x : PrimFloat.float) : list int :=
  of_double x ++ of_double (PrimFloat.abs x) ++ of_double (PrimFloat.sqrt x)
  ++ of_double (PrimFloat.opp x) ++ of_double (PrimFloat.next_up x)
  ++ of_double (PrimFloat.next_down x) ++ [PrimFloat.normfr_mantissa x].

Definition binary (x y : PrimFloat.float) : list int :=
  of_double (PrimFloat.add x y) ++ of_double (PrimFloat.sub x y) ++ of_double (PrimFloat.mul x y)
  ++ of_double (PrimFloat.div x y)
  ++ [of_comparison (PrimFloat.compare x y); of_bool (PrimFloat.eqb x y);
      of_bool (PrimFloat.ltb x y); of_bool (PrimFloat.leb x y)].

Definition of_integers (x y : int) : list int :=
  [add x y; sub x y; land x y; lor x y; lsl x y; lsr x y; of_bool (eqb x y); of_bool (ltb x y);
   of_bool (leb x y)].

Definition results : list int :=
  flat_map unary doubles ++ pairs binary doubles doubles
  ++ pairs (fun x e => of_double (PrimFloat.ldshiftexp x e)) doubles integers
  ++ flat_map (fun i => of_double (PrimFloat.of_uint63 i)) integers
  ++ pairs of_integers integers integers.
