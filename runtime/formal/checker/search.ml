(* SPDX-License-Identifier: Apache-2.0 *)
(* Finds the splits of a proof. Nothing here is trusted: the splits are checked afterwards. *)
open Checker

exception Open of string  (* no proof was found, and why *)

let rec nth k list =
  match (k, list) with
  | O, x :: _ -> x
  | S k, _ :: rest -> nth k rest
  | _, [] -> raise (Open "a box has fewer intervals than the question has variables")

let rec number_of = function O -> 0 | S n -> 1 + number_of n

(* `count` is called for each leaf, and may raise Open. The box is part of the root. *)
let splits ~count test deepest root box =
  let rec search depth box =
    let answer = test box in
    if is_closed answer then (count (); Leaf)
    else if depth = 0 then raise (Open (Printf.sprintf "a box remains open after %d splits" deepest))
    else
      match variable_to_split root box answer with
      | None -> raise (Open "a box that remains open cannot be split")
      | Some k ->
          let middle = I.midpoint (nth k box) in
          let lower = search (depth - 1) (lower_part box k middle) in
          Split (k, lower, search (depth - 1) (upper_part box k middle))
  in
  search deepest box

let rec leaves = function Leaf -> 1 | Split (_, lower, upper) -> leaves lower + leaves upper

(* The tree as Coq reads it. *)
let print_tree buffer tree =
  let rec print is_operand = function
    | Leaf -> Buffer.add_string buffer "Leaf"
    | Split (k, lower, upper) ->
        if is_operand then Buffer.add_char buffer '(';
        Buffer.add_string buffer (Printf.sprintf "Split %d " (number_of k));
        print true lower;
        Buffer.add_char buffer ' ';
        print true upper;
        if is_operand then Buffer.add_char buffer ')'
  in
  print false tree
