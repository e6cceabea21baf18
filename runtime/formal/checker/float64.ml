(* SPDX-License-Identifier: Apache-2.0 *)
(* The primitive doubles of Coq: those of OCaml, which are those of the processor. The operations
   are not inlined, so that no compiler makes one operation with one rounding out of two. *)
type t = float

type float_comparison = FEq | FLt | FGt | FNotComparable
type float_class = PNormal | NNormal | PSubn | NSubn | PZero | NZero | PInf | NInf | NaN

let of_float (x : float) : t = x
let add (x : t) (y : t) : t = x +. y [@@inline never]
let sub (x : t) (y : t) : t = x -. y [@@inline never]
let mul (x : t) (y : t) : t = x *. y [@@inline never]
let div (x : t) (y : t) : t = x /. y [@@inline never]
let sqrt (x : t) : t = Float.sqrt x
let opp (x : t) : t = Float.neg x
let abs (x : t) : t = Float.abs x
let eq (x : t) (y : t) : bool = x = y
let lt (x : t) (y : t) : bool = x < y
let le (x : t) (y : t) : bool = x <= y

let compare (x : t) (y : t) : float_comparison =
  if x < y then FLt else if x > y then FGt else if x = y then FEq else FNotComparable

let classify (x : t) : float_class =
  let by_sign positive negative = if Float.sign_bit x then negative else positive in
  match Float.classify_float x with
  | FP_normal -> by_sign PNormal NNormal
  | FP_subnormal -> by_sign PSubn NSubn
  | FP_zero -> by_sign PZero NZero
  | FP_infinite -> by_sign PInf NInf
  | FP_nan -> NaN

let next_up (x : t) : t = Float.succ x
let next_down (x : t) : t = Float.pred x

(* An integer of 63 bits is halved, and its last bit is kept, so that it is rounded only once. *)
let of_uint63 (i : Uint63.t) : t =
  if i >= 0 then float_of_int i else 2. *. float_of_int ((i lsr 1) lor (i land 1))

(* The 53 bits of a number in [1/2, 1). *)
let normfr_mantissa (x : t) : Uint63.t =
  let x = Float.abs x in
  if 0.5 <= x && x < 1. then int_of_float (Float.ldexp x 53) else 0

(* Exponents are stored with this shift, so that they are never negative: FloatOps.shift. *)
let shift = 2101

let frshiftexp (x : t) : t * Uint63.t =
  match Float.classify_float x with
  | FP_zero | FP_infinite | FP_nan -> (x, 0)
  | FP_normal | FP_subnormal ->
      let fraction, exponent = Float.frexp x in
      (fraction, exponent + shift)

let ldshiftexp (x : t) (exponent : Uint63.t) : t =
  let largest = 2 * shift in
  Float.ldexp x ((if Uint63.le exponent largest then exponent else largest) - shift)
