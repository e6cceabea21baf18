(* SPDX-License-Identifier: Apache-2.0 *)
(* The integers of 63 bits of Coq: those of OCaml on a machine of 64 bits, read without a sign. *)
let () = assert (Sys.int_size = 63)

type t = int

let of_int (i : int) : t = i
let add (x : t) (y : t) : t = x + y
let sub (x : t) (y : t) : t = x - y
let l_and (x : t) (y : t) : t = x land y
let l_or (x : t) (y : t) : t = x lor y
let l_sl (x : t) (y : t) : t = if 0 <= y && y < 63 then x lsl y else 0
let l_sr (x : t) (y : t) : t = if 0 <= y && y < 63 then x lsr y else 0
let equal (x : t) (y : t) : bool = x = y
let le (x : t) (y : t) : bool = x lxor min_int <= y lxor min_int
let lt (x : t) (y : t) : bool = x lxor min_int < y lxor min_int
