(* SPDX-License-Identifier: Apache-2.0 *)
(** How Coq writes its primitive numbers as a program of OCaml. The lines [Extract] are part of
    what a verdict of this program trusts; the theorems do not need them. Other numbers of Coq (nat,
    positive, Z, Q) are left as they are defined there: none becomes an integer of the machine. *)
From Coq Require Extraction ExtrOcamlBasic.
From Coq Require PrimFloat PrimInt63 FloatClass ClassicalDedekindReals.

(** The primitive integers of 63 bits: uint63.ml. *)
Extract Constant PrimInt63.int => "Uint63.t".
Extraction Inline PrimInt63.int.
Extract Constant PrimInt63.add => "Uint63.add".
Extract Constant PrimInt63.sub => "Uint63.sub".
Extract Constant PrimInt63.land => "Uint63.l_and".
Extract Constant PrimInt63.lor => "Uint63.l_or".
Extract Constant PrimInt63.lsl => "Uint63.l_sl".
Extract Constant PrimInt63.lsr => "Uint63.l_sr".
Extract Constant PrimInt63.eqb => "Uint63.equal".
Extract Constant PrimInt63.leb => "Uint63.le".
Extract Constant PrimInt63.ltb => "Uint63.lt".

(** The primitive doubles: float64.ml. *)
Extract Inductive FloatClass.float_class => "Float64.float_class"
  [ "Float64.PNormal" "Float64.NNormal" "Float64.PSubn" "Float64.NSubn" "Float64.PZero"
    "Float64.NZero" "Float64.PInf" "Float64.NInf" "Float64.NaN" ].
Extract Inductive PrimFloat.float_comparison => "Float64.float_comparison"
  [ "Float64.FEq" "Float64.FLt" "Float64.FGt" "Float64.FNotComparable" ].
Extract Constant PrimFloat.float => "Float64.t".
Extraction Inline PrimFloat.float.
Extract Constant PrimFloat.classify => "Float64.classify".
Extract Constant PrimFloat.abs => "Float64.abs".
Extract Constant PrimFloat.sqrt => "Float64.sqrt".
Extract Constant PrimFloat.opp => "Float64.opp".
Extract Constant PrimFloat.eqb => "Float64.eq".
Extract Constant PrimFloat.ltb => "Float64.lt".
Extract Constant PrimFloat.leb => "Float64.le".
Extract Constant PrimFloat.compare => "Float64.compare".
Extract Constant PrimFloat.mul => "Float64.mul".
Extract Constant PrimFloat.add => "Float64.add".
Extract Constant PrimFloat.sub => "Float64.sub".
Extract Constant PrimFloat.div => "Float64.div".
Extract Constant PrimFloat.of_uint63 => "Float64.of_uint63".
Extract Constant PrimFloat.normfr_mantissa => "Float64.normfr_mantissa".
Extract Constant PrimFloat.frshiftexp => "Float64.frshiftexp".
Extract Constant PrimFloat.ldshiftexp => "Float64.ldshiftexp".
Extract Constant PrimFloat.next_up => "Float64.next_up".
Extract Constant PrimFloat.next_down => "Float64.next_down".

(** Real numbers are not computed with: coq-interval only has them in its specifications. *)
Extract Constant ClassicalDedekindReals.sig_forall_dec => "fun _ -> assert false".
