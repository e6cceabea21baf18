(* SPDX-License-Identifier: Apache-2.0 *)
(* The words of a file that `regulus-verify --coq` writes: a small part of the language of Coq. *)

(* A line of the file, and what is wrong there. *)
exception Fault of int * string

type token =
  | Word of string  (* a name, or a word of Coq *)
  | Number of string  (* a decimal without sign, as written *)
  | Double of float  (* a hexadecimal number *)
  | Symbol of string
  | End  (* of the file *)

let show = function
  | Word s | Number s | Symbol s -> "'" ^ s ^ "'"
  | Double x -> Printf.sprintf "'%h'" x
  | End -> "the end of the file"

let is_digit c = '0' <= c && c <= '9'
let is_letter c = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c = '_'
let is_hexadecimal c = is_digit c || ('a' <= c && c <= 'f')

(* The longest numbers: Coq, too, works long on larger ones. *)
let most_digits = 2000
let most_exponent = 2000

(* The first position from i on at which the character does not satisfy `is_part`. *)
let rec skip text is_part i =
  if i < String.length text && is_part text.[i] then skip text is_part (i + 1) else i

(* The position after an exponent `mark`, sign and digits at i, or i if there is none. *)
let skip_exponent text mark i =
  let at k = if k < String.length text then text.[k] else ' ' in
  if at i <> mark then i
  else
    let first = if at (i + 1) = '-' || at (i + 1) = '+' then i + 2 else i + 1 in
    if is_digit (at first) then skip text is_digit first else i

let check_size line text =
  let too_large () = raise (Fault (line, "the number " ^ String.sub text 0 20 ^ "... is too long")) in
  if String.length text > most_digits then too_large ();
  match String.index_opt text 'e' with
  | None -> ()
  | Some i -> (
      let digits = String.sub text (i + 1) (String.length text - i - 1) in
      match int_of_string_opt digits with
      | Some e when abs e <= most_exponent -> ()
      | _ -> raise (Fault (line, "the exponent of " ^ text ^ " is too large")))

(* The token of a number at i, and the position after it. *)
let number line text i =
  let at k = if k < String.length text then text.[k] else ' ' in
  let fraction is_part k = if at k = '.' && is_part (at (k + 1)) then skip text is_part (k + 1) else k in
  if at i = '0' && at (i + 1) = 'x' then
    let stop = skip_exponent text 'p' (fraction is_hexadecimal (skip text is_hexadecimal (i + 2))) in
    match float_of_string_opt (String.sub text i (stop - i)) with
    | Some x -> (Double x, stop)
    | None -> raise (Fault (line, "this is not a hexadecimal number"))
  else
    let stop = skip_exponent text 'e' (fraction is_digit (skip text is_digit i)) in
    let digits = String.sub text i (stop - i) in
    check_size line digits;
    (Number digits, stop)

(* The position after a comment that begins at i, and its number of lines. Comments nest. To Coq, a
   comment does not end between quotation marks: there are none. *)
let comment line text i =
  let rec follow depth lines i =
    if i + 1 >= String.length text then raise (Fault (line, "this comment has no end"))
    else if text.[i] = '*' && text.[i + 1] = ')' then
      if depth = 1 then (i + 2, lines) else follow (depth - 1) lines (i + 2)
    else if text.[i] = '(' && text.[i + 1] = '*' then follow (depth + 1) lines (i + 2)
    else if text.[i] = '"' then raise (Fault (line + lines, "a comment may not contain quotation marks"))
    else follow depth (if text.[i] = '\n' then lines + 1 else lines) (i + 1)
  in
  follow 0 0 i

let symbol line text i =
  let two = if i + 1 < String.length text then String.sub text i 2 else "" in
  if two = ":=" || two = "=>" then (Symbol two, i + 2)
  else if String.contains "()[];,.:+-*/^%" text.[i] then (Symbol (String.make 1 text.[i]), i + 1)
  else raise (Fault (line, Printf.sprintf "the character '%s' has no meaning here" (Char.escaped text.[i])))

(* All tokens, each with its line. *)
let tokens text =
  let is_part c = is_letter c || is_digit c || c = '\'' in
  let rec next found line i =
    if i >= String.length text then List.rev ((End, line) :: found)
    else
      let c = text.[i] in
      if c = '\n' then next found (line + 1) (i + 1)
      else if c = ' ' then next found line (i + 1)
      else if c = '(' && i + 1 < String.length text && text.[i + 1] = '*' then
        let stop, lines = comment line text i in
        next found (line + lines) stop
      else
        let token, stop =
          if is_letter c then
            let stop = skip text is_part i in
            (Word (String.sub text i (stop - i)), stop)
          else if is_digit c then number line text i
          else symbol line text i
        in
        next ((token, line) :: found) line stop
  in
  Array.of_list (next [] 1 0)
