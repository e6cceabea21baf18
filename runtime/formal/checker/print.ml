(* SPDX-License-Identifier: Apache-2.0 *)
(* A question as it was read, in the constructors of Coq, so that Coq can compare it. *)
open Checker

let rec bits = function XH -> [ true ] | XO p -> false :: bits p | XI p -> true :: bits p

let hexadecimal p =
  let rec digits = function
    | [] -> []
    | bits ->
        let rec take n value weight = function
          | b :: rest when n > 0 -> take (n - 1) (if b then value + weight else value) (2 * weight) rest
          | rest -> (value, rest)
        in
        let digit, rest = take 4 0 1 bits in
        Printf.sprintf "%x" digit :: digits rest
  in
  "0x" ^ String.concat "" (List.rev (digits (bits p)))

let integer = function
  | Z0 -> "0"
  | Zpos p -> hexadecimal p
  | Zneg p -> "(-" ^ hexadecimal p ^ ")"

let rec expression e =
  let unary name a = Printf.sprintf "(%s %s)" name (expression a) in
  let binary name a b = Printf.sprintf "(%s %s %s)" name (expression a) (expression b) in
  match e with
  | Constant { qnum; qden } ->
      Printf.sprintf "(Constant (Qmake %s%%Z %s%%positive))" (integer qnum) (hexadecimal qden)
  | Pi -> "Pi"
  | Name k -> Printf.sprintf "(Name %d%%nat)" (Search.number_of k)
  | Negate a -> unary "Negate" a
  | Add (a, b) -> binary "Add" a b
  | Subtract (a, b) -> binary "Subtract" a b
  | Multiply (a, b) -> binary "Multiply" a b
  | Divide (a, b) -> binary "Divide" a b
  | Power (a, n) -> Printf.sprintf "(Power %s %d%%nat)" (expression a) (Search.number_of n)
  | Sqrt a -> unary "Sqrt" a
  | Sin a -> unary "Sin" a
  | Cos a -> unary "Cos" a
  | Atan a -> unary "Atan" a
  | Exp a -> unary "Exp" a
  | Log a -> unary "Log" a
  | Abs a -> unary "Abs" a

let list item l = "[" ^ String.concat "; " (List.map item l) ^ "]"
let pair (a, b) = "(" ^ expression a ^ ", " ^ expression b ^ ")"

let question q =
  String.concat "\n  "
    [ "Question"; list pair q.ranges; list expression q.definitions; list expression q.constraints;
      list expression q.also_defined; list (list expression) q.matrix;
      Printf.sprintf "%d%%nat" (Search.number_of q.columns) ]

let rec parts = function
  | Kept -> "Kept"
  | LeftOut -> "LeftOut"
  | Parted (k, place, lower, upper) ->
      Printf.sprintf "(Parted %d%%nat (%h)%%float %s %s)" (Search.number_of k) place (parts lower) (parts upper)
