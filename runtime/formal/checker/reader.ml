(* SPDX-License-Identifier: Apache-2.0 *)
(* Reads a file that `regulus-verify --coq` writes, as Coq reads it. Any other sentence is a fault. *)
open Checker
open Tokens

type file = {
  typed : string list;  (* those of typed_names that the file defines *)
  question : expression list -> question;  (* of the constants of a piece *)
  has_pieces : bool;
  pieces : expression list list;  (* the constants of each *)
  method_ : method0;
  parts : parts;  (* that a theorem about a paving keeps *)
  trees : tree list;
  points : (string * Float64.t list) list;  (* `negative` and `positive`, or `the_point` *)
  scales : expression list;
  threshold : expression;
  row : nat;  (* of the force *)
  load : expression list;
  factors : expression list;  (* of the columns *)
  limit : expression;
  limits : (expression * expression) list;  (* of the forces, by row *)
  statement : string;  (* of the theorem, its words separated by spaces *)
  proof : string;  (* the theorem of the library that is applied *)
}

let typed_names =
  [ "the_question"; "the_method"; "pieces"; "the_tree"; "the_trees"; "negative"; "positive"; "the_point";
    "the_scales"; "the_threshold"; "the_row"; "the_load"; "the_factors"; "the_limit"; "the_limits"; "the_parts" ]

(* Where the reader is, and the names that have a meaning. *)
type state = {
  tokens : (token * int) array;
  mutable at : int;
  names : (string, expression) Hashtbl.t;
  mutable defined : string list;
  mutable depth : int;
}

let most_nested = 1000
let most_power = 1000
let peek s = fst s.tokens.(s.at)
let peek_next s = if s.at + 1 < Array.length s.tokens then fst s.tokens.(s.at + 1) else End
let fault s what = raise (Fault (snd s.tokens.(s.at), what))
let advance s = if s.at + 1 < Array.length s.tokens then s.at <- s.at + 1
let expected s what = fault s ("found " ^ show (peek s) ^ ", expected " ^ what)

let take s token =
  if peek s = token then advance s else expected s (show token)

let accept s token = peek s = token && (advance s; true)
let take_words s text = List.iter (fun w -> take s (Word w)) (String.split_on_char ' ' text)

let rec nat_of n = if n = 0 then O else S (nat_of (n - 1))

let take_count s most =
  match peek s with
  | Number digits -> (
      match int_of_string_opt digits with
      | Some n when n <= most -> advance s; n
      | _ -> expected s (Printf.sprintf "a number up to %d" most))
  | _ -> expected s "a number"

(* [item; item; ...] *)
let take_list s item =
  take s (Symbol "[");
  if accept s (Symbol "]") then []
  else
    let rec more found =
      let found = item s :: found in
      if accept s (Symbol ";") then more found else (take s (Symbol "]"); List.rev found)
    in
    more []

(* ---- Expressions ---- *)

let digits_of text =
  let digit c rest =
    match c with
    | '0' -> D0 rest | '1' -> D1 rest | '2' -> D2 rest | '3' -> D3 rest | '4' -> D4 rest
    | '5' -> D5 rest | '6' -> D6 rest | '7' -> D7 rest | '8' -> D8 rest | _ -> D9 rest
  in
  String.fold_right digit text Nil

(* The rational number of a decimal, as Notations.v defines it. *)
let constant ?(is_negative = false) text =
  let split mark text =
    match String.index_opt text mark with
    | None -> (text, "")
    | Some i -> (String.sub text 0 i, String.sub text (i + 1) (String.length text - i - 1))
  in
  let mantissa, exponent = split 'e' text in
  let integer, fraction = split '.' mantissa in
  let exponent =
    match split '-' exponent with
    | "", digits when exponent <> "" && exponent.[0] = '-' -> Neg (digits_of digits)
    | _ when exponent <> "" && exponent.[0] = '+' -> Pos (digits_of (snd (split '+' exponent)))
    | _ -> Pos (digits_of (if exponent = "" then "0" else exponent))
  in
  let digits = digits_of integer in
  let signed = if is_negative then Neg digits else Pos digits in
  Constant (rational_of signed (digits_of fraction) exponent)

let is_zero text = String.for_all (fun c -> c = '0' || c = '.') (List.hd (String.split_on_char 'e' text))

let functions =
  [ ("sqrt", fun a -> Sqrt a); ("sin", fun a -> Sin a); ("cos", fun a -> Cos a);
    ("atan", fun a -> Atan a); ("exp", fun a -> Exp a); ("log", fun a -> Log a);
    ("abs", fun a -> Abs a); ("tan", tangent); ("asin", arcsine); ("acos", arccosine) ]

let left_associative s operand operators =
  let rec more a =
    match List.assoc_opt (peek s) operators with
    | Some apply -> advance s; more (apply a (operand s))
    | None -> a
  in
  more (operand s)

(* Reads a part of something: the depth is bounded, because each level uses the stack. *)
let enter s part =
  if s.depth >= most_nested then fault s "this is nested too deep";
  s.depth <- s.depth + 1;
  let result = part () in
  s.depth <- s.depth - 1;
  result

let rec expression s =
  enter s (fun () ->
      left_associative s product
        [ (Symbol "+", fun a b -> Add (a, b)); (Symbol "-", fun a b -> Subtract (a, b)) ])

and product s =
  left_associative s signed
    [ (Symbol "*", fun a b -> Multiply (a, b)); (Symbol "/", fun a b -> Divide (a, b)) ]

(* A sign binds more than a product and less than a power. Before a number it is part of it. *)
and signed s =
  if not (accept s (Symbol "-")) then power s
  else
    match (peek s, peek_next s) with
    | Number text, after when after <> Symbol "^" && not (is_zero text) ->
        advance s;
        constant ~is_negative:true text
    | _ -> enter s (fun () -> Negate (signed s))

and power s =
  let base = application s in
  if accept s (Symbol "^") then Power (base, nat_of (take_count s most_power)) else base

and application s =
  match peek s with
  | Word "atan2" -> advance s; arctangent2 (pair s)
  | Word w when List.mem_assoc w functions -> advance s; (List.assoc w functions) (atom s)
  | _ -> atom s

and atom s =
  match peek s with
  | Number text -> advance s; constant text
  | Word "pi" -> advance s; Pi
  | Word w when Hashtbl.mem s.names w -> advance s; Hashtbl.find s.names w
  | Word w -> fault s ("the name '" ^ w ^ "' is not declared")
  | Symbol "(" ->
      advance s;
      let e = expression s in
      take s (Symbol ")");
      e
  | _ -> expected s "an expression"

and pair s =
  take s (Symbol "(");
  let a = expression s in
  take s (Symbol ",");
  let b = expression s in
  take s (Symbol ")");
  (a, b)

(* ---- Definitions ---- *)

let range s =
  if accept s (Word "within") then
    let middle = atom s in
    within middle (atom s)
  else pair s

(* `nth k piece no_entry`, if the question has pieces, or an expression. *)
let definition piece s =
  match piece with
  | Some constants when accept s (Word "nth") -> (
      let k = take_count s 1_000_000 in
      take_words s "piece no_entry";
      match List.nth_opt constants k with Some e -> e | None -> no_entry)
  | _ -> expression s

let question s piece =
  take s (Word "Question");
  let ranges = take_list s range in
  let definitions = take_list s (definition piece) in
  let constraints = take_list s expression in
  let also_defined = take_list s expression in
  let matrix = take_list s (fun s -> take_list s expression) in
  { ranges; definitions; constraints; also_defined; matrix; columns = nat_of (take_count s 1000) }

let rec tree s =
  enter s (fun () ->
      if accept s (Symbol "(") then begin
        let t = tree s in
        take s (Symbol ")");
        t
      end
      else if accept s (Word "Leaf") then Leaf
      else begin
        take_words s "Split";
        let k = nat_of (take_count s 1000) in
        let lower = operand s in
        Split (k, lower, operand s)
      end)

(* Coq wants parentheses around a Split inside a Split. *)
and operand s = if peek s = Word "Split" then expected s "'('" else tree s

let double s =
  let signed s =
    let sign = if accept s (Symbol "-") then -1. else 1. in
    match peek s with
    | Double x -> advance s; sign *. x
    | Number digits -> advance s; sign *. float_of_string digits
    | Word "infinity" -> advance s; sign *. infinity
    | Word "neg_infinity" -> advance s; -. (sign *. infinity)
    | _ -> expected s "a double"
  in
  if accept s (Symbol "(") then begin
    let x = signed s in
    take s (Symbol ")");
    x
  end
  else signed s

let rec parts s =
  enter s (fun () ->
      match peek s with
      | Word "Kept" -> advance s; Kept
      | Word "LeftOut" -> advance s; LeftOut
      | Symbol "(" ->
          advance s;
          let w = parted s in
          take s (Symbol ")");
          w
      | _ -> expected s "'Kept', 'LeftOut' or '('")

and parted s =
  if not (accept s (Word "Parted")) then parts s
  else
    let k = nat_of (take_count s 1000) in
    let place = double s in
    let lower = parts s in
    Parted (k, place, lower, parts s)

(* The tokens before `last`, separated by spaces. *)
let words_until s last =
  let rec more found =
    match peek s with
    | t when t = last -> String.concat " " (List.rev found)
    | Word w | Number w | Symbol w when w <> "." -> advance s; more (w :: found)
    | _ -> expected s (show last)
  in
  more []

(* Theorem the_claim : statement. Proof. proof. vm_cast_no_check (eq_refl true). Qed *)
let theorem s =
  let period = Symbol "." in
  let sentence () =
    let words = words_until s period in
    take s period;
    words
  in
  take_words s "the_claim";
  take s (Symbol ":");
  let statement = sentence () in
  if sentence () <> "Proof" then fault s "expected the sentence Proof";
  let proof = sentence () in
  if sentence () <> "vm_cast_no_check ( eq_refl true )" then
    fault s "expected the sentence vm_cast_no_check (eq_refl true)";
  take_words s "Qed";
  (statement, proof)

(* Definition _name := Name k. Coq gives the names of its library their meaning, and none of those
   that a file uses begins so. *)
let declare s name =
  if String.length name < 2 || name.[0] <> '_' then
    fault s ("the name '" ^ name ^ "' does not begin with '_'");
  take_words s "Name";
  Hashtbl.add s.names name (Name (nat_of (take_count s 1_000_000)))

let of_doubles s item =
  let value = item s in
  take s (Symbol "%"); take_words s "float";
  value

let coordinates s = of_doubles s (fun s -> take_list s double)

(* Definition the_question (piece : list expression) : question := ... *)
let question_definition s ~has_pieces =
  let start = s.at in
  let constants piece = if has_pieces then Some piece else None in
  ignore (question s (constants []));
  fun piece -> question { s with at = start; depth = 0 } (constants piece)

(* Definition name : kind := ... *)
let typed s file name kind =
  match (name, kind) with
  | "the_question", ": question" ->
      { file with question = question_definition s ~has_pieces:false }
  | "the_question", "( piece : list expression ) : question" ->
      { file with question = question_definition s ~has_pieces:true; has_pieces = true }
  | "the_method", ": method" ->
      take_words s "Method";
      let second_order = nat_of (take_count s 10_000) in
      { file with method_ = { second_order; deepest = nat_of (take_count s most_nested) } }
  | "pieces", ": list ( list expression )" ->
      { file with pieces = take_list s (fun s -> take_list s expression) }
  | "the_parts", ": parts" -> { file with parts = of_doubles s parts }
  | "the_tree", ": tree" -> { file with trees = [ tree s ] }
  | "the_trees", ": list tree" -> { file with trees = take_list s tree }
  | ("negative" | "positive" | "the_point"), ": coordinates" ->
      { file with points = (name, coordinates s) :: file.points }
  | "the_scales", ": list expression" -> { file with scales = take_list s expression }
  | "the_threshold", ": expression" -> { file with threshold = expression s }
  | "the_row", ": nat" -> { file with row = nat_of (take_count s 1000) }
  | "the_load", ": list expression" -> { file with load = take_list s expression }
  | "the_factors", ": list expression" -> { file with factors = take_list s expression }
  | "the_limit", ": expression" -> { file with limit = expression s }
  | "the_limits", ": list ( expression * expression )" -> { file with limits = take_list s pair }
  | _ -> fault s ("'" ^ name ^ " " ^ kind ^ "' is not a definition of regulus-verify")

let read_definition s file =
  match peek s with
  | Word name ->
      advance s;
      if List.mem name s.defined then fault s ("'" ^ name ^ "' is defined twice");
      s.defined <- name :: s.defined;
      let kind = words_until s (Symbol ":=") in
      take s (Symbol ":=");
      if kind = "" then (declare s name; file)
      else typed s { file with typed = name :: file.typed } name kind
  | _ -> expected s "a name"

(* The libraries that give the words of a file their meaning; in another order they give another. *)
let imports =
  [ "From Coq Require Import List"; "From Coq Require Import PrimFloat";
    "From Regulus Require Import Expressions Questions Search Singularity Threshold Forces";
    "From Regulus Require Import Notations"; "Import ListNotations" ]

(* Forces within limits and singular values need one library more, and pavings of the former two. *)
let take_import s import =
  take_words s import;
  if String.ends_with ~suffix:" Forces" import then
    if accept s (Word "Limits") then ignore (accept s (Word "Parts")) else ignore (accept s (Word "SingularValues"));
  take s (Symbol ".")

let zero = Constant (rational_of (Pos (D0 Nil)) Nil (Pos (D0 Nil)))

let nothing =
  { typed = []; question = (fun _ -> raise (Fault (1, "the file does not define 'the_question'")));
    has_pieces = false; pieces = [];
    method_ = { second_order = O; deepest = O }; parts = Kept; trees = []; points = []; scales = [];
    threshold = zero; row = O; load = []; factors = []; limit = zero; limits = []; statement = ""; proof = "" }

(* The text up to the claim, and what follows if the file is about the robot of a model file: theorems in
   the words of Geometry.v, Arms.v or Matrices.v, which are for Coq alone. In a comment, the first line of these leaves a first
   part that is a fault. *)
let split text =
  let marks =
    List.map (Printf.sprintf "\nFrom Regulus Require Import %s.\n") [ "Geometry"; "Arms"; "Matrices" ]
  in
  let is_at i mark =
    i + String.length mark <= String.length text && String.sub text i (String.length mark) = mark
  in
  let rec find i =
    if i >= String.length text || List.exists (is_at i) marks then i else find (i + 1)
  in
  let stop = find 0 in
  (String.sub text 0 stop, String.sub text stop (String.length text - stop))

(* Reads the text of a file up to the claim. Raises Fault. *)
let read text =
  let s = { tokens = tokens text; at = 0; names = Hashtbl.create 100; defined = []; depth = 0 } in
  let rec sentences file =
    match peek s with
    | End -> file
    | _ when file.statement <> "" -> fault s "nothing may follow the theorem"
    | Word "Definition" -> advance s; close (read_definition s file)
    | Word "Theorem" ->
        advance s;
        let statement, proof = theorem s in
        close { file with statement; proof }
    | _ -> expected s "a sentence of regulus-verify"
  and close file =
    take s (Symbol ".");
    sentences file
  in
  List.iter (take_import s) imports;
  let file = sentences nothing in
  if file.statement = "" then fault s "the file has no theorem";
  file
