(* SPDX-License-Identifier: GPL-3.0-or-later *)
(* The program refuses what is false, whatever the hints say. Arguments: a file about a singular
   question, then files with hints that prove theirs. *)
open Checker

let failures = ref 0
let tried = ref 0

let expect what is_right =
  incr tried;
  if not is_right then begin
    incr failures;
    if !failures <= 20 then prerr_endline ("FAILED: " ^ what)
  end

let bounds = { Prove.time_limit = 20.; max_leaves = 300; show = None }
let is_proved text = match Prove.answer bounds text with Prove.Proved _ -> true | _ -> false
let pick l = List.nth l (Random.int (List.length l))

(* ---- Files ---- *)

let imports = String.concat ".\n" Reader.imports ^ ".\n"

let declarations =
  imports
  ^ "Definition _x := Name 0.\nDefinition _y := Name 1.\nDefinition the_question : question := Question\n\
     \  [(-1, 1); (0, 2)] [] "

let theorem statement proof =
  Printf.sprintf "\nTheorem the_claim : %s.\nProof.\n  apply (%s).\n  vm_cast_no_check (eq_refl true).\nQed.\n"
    statement proof

let question constraints matrix =
  Printf.sprintf "%s[%s] [] %s 2.\n" declarations constraints matrix

let print_tree tree =
  let buffer = Buffer.create 1000 in
  Search.print_tree buffer tree;
  Buffer.contents buffer

let hints second_order tree =
  Printf.sprintf "Definition the_method : method := Method %d 12.\nDefinition the_tree : tree := %s.\n"
    second_order (print_tree tree)

let regular = theorem "no_singularity the_question" "check_tree_correct the_question the_method the_tree"

let above =
  theorem "determinant_above the_question the_scales the_threshold"
    "check_determinant_tree_correct the_question the_scales the_threshold the_method the_tree"

let threshold scales alpha =
  Printf.sprintf
    "Definition the_scales : list expression := [%s].\nDefinition the_threshold : expression := %s.\n" scales
    alpha

(* Singular at a point, along a line, at an end of the set; undefined at a point; not excluded. *)
let false_questions =
  List.map (fun (c, m) -> question c m)
    [ ("", "[[_x; _y]; [- _y; _x]]"); ("", "[[1; _x]; [1; _y]]"); ("", "[[_x - 1/3; 0]; [0; 1]]");
      ("", "[[_x - 1; 0]; [0; 1]]"); ("", "[[sin _x - _x; 0]; [0; 1]]"); ("", "[[1; 1]; [1; 1]]");
      ("", "[[_x; 2*_x]; [_y; 2*_y]; [1; 2]]"); ("", "[[1; 0]]"); ("", "[[1]; [0; 1]]");
      ("", "[[1/_x; 0]; [0; 1]]"); ("", "[[2 + sqrt(_x + 9/10); 0]; [0; 1]]"); ("", "[[_x/_x; 0]; [0; 1]]");
      ("_x - 2", "[[_x; 0]; [0; 1]]"); ("- _x", "[[_x; 0]; [0; 1]]"); ("1/_x", "[[_x; 0]; [0; 1]]") ]

(* Of |det| = x + 2 in [1, 3]. *)
let false_thresholds =
  List.map (fun (s, a) -> question "" "[[_x + 2; 0]; [_y; 1]]" ^ threshold s a)
    [ ("", "1"); ("", "1 + 1e-6"); ("", "3"); ("1/2; 2", "1"); ("1/10; 1", "1/10"); ("1; _x", "0"); ("", "1/0") ]

(* ---- Trees ---- *)

let rec random_tree depth =
  if depth = 0 || Random.int 3 = 0 then Leaf
  else
    let k = Reader.nat_of (Random.int 4) in
    let lower = random_tree (depth - 1) in
    Split (k, lower, random_tree (depth - 1))

(* The boxes that no test closes are split to the depth, and then left open. *)
let partial_tree q method_ depth =
  let rec grow root depth box =
    let answer = test q method_ box in
    if is_closed answer || depth = 0 then Leaf
    else
      match variable_to_split root box answer with
      | None -> Leaf
      | Some k ->
          let middle = I.midpoint (Search.nth k box) in
          let lower = grow root (depth - 1) (lower_part box k middle) in
          Split (k, lower, grow root (depth - 1) (upper_part box k middle))
  in
  match enclose_ranges q.ranges with None -> Leaf | Some root -> grow root depth root

let rec damage tree =
  match (tree, Random.int 8) with
  | Leaf, _ -> if Random.bool () then random_tree 3 else Leaf
  | Split _, 0 -> Leaf
  | Split (k, lower, upper), 1 -> Split (k, upper, lower)
  | Split (_, lower, upper), 2 -> Split (Reader.nat_of (Random.int 9), lower, upper)
  | Split (k, lower, _), 3 -> Split (k, lower, lower)
  | Split (k, lower, upper), n when n < 6 -> Split (k, damage lower, upper)
  | Split (k, lower, upper), _ -> Split (k, lower, damage upper)

(* All trees in which one Split has become a Leaf. *)
let rec prunings = function
  | Leaf -> []
  | Split (k, lower, upper) ->
      (Leaf :: List.map (fun t -> Split (k, t, upper)) (prunings lower))
      @ List.map (fun t -> Split (k, lower, t)) (prunings upper)

(* ---- Tests ---- *)

let refuse_false_questions () =
  let attack claim text =
    let q = (Reader.read (text ^ hints 2 Leaf ^ claim)).question [] in
    let honest = partial_tree q { second_order = Reader.nat_of 2; deepest = O } 10 in
    for i = 1 to 500 do
      let tree = if i mod 2 = 0 then random_tree 8 else damage (damage honest) in
      let file = text ^ hints (pick [ 0; 1; 2; 99 ]) tree ^ claim in
      expect ("proved: " ^ file) (not (is_proved file))
    done
  in
  List.iter (attack regular) false_questions;
  List.iter (attack above) false_thresholds

let refuse_false_segments () =
  let coordinate () =
    pick [ "0x0p+0"; "0x1p+0"; "(-0x1p+0)"; "0x1.8p+0"; "(-0x1p-30)"; "0x1p-1074"; "infinity"; "neg_infinity";
           "0x1p+1023"; Printf.sprintf "0x%xp-12" (Random.int 10000) ]
  in
  let claim =
    theorem "singularity the_question" "check_singularity_correct the_question negative positive"
  in
  let attack matrix =
    for _ = 1 to 300 do
      let point name =
        let numbers = List.init (pick [ 2; 2; 2; 2; 2; 1; 3 ]) (fun _ -> coordinate ()) in
        Printf.sprintf "Definition %s : coordinates := [%s]%%float.\n" name (String.concat "; " numbers)
      in
      let file = question "" matrix ^ point "negative" ^ point "positive" ^ claim in
      expect ("proved: " ^ file) (not (is_proved file))
    done
  in
  List.iter attack
    [ "[[_x + 2; 0]; [0; 1]]"; "[[_x - 2; 0]; [0; 1]]"; "[[1/_x; 0]; [0; 1]]"; "[[_x; 0]]"; "[[_x^2 + 1; 0]; [0; 1]]" ]

let refuse_singular_robot name =
  let file = Reader.read (Files.read name) in
  let q = file.question [] in
  let method_ = { second_order = Reader.nat_of 6; deepest = O } in
  let honest = partial_tree q method_ 5 in
  for _ = 1 to 100 do
    let tree = damage (damage honest) in
    expect ("the singular question of " ^ name) (not (check_tree q method_ tree))
  done

(* What a change of 1e-6 in one entry makes of a question. *)
let see_small_changes () =
  let file matrix = question "" matrix ^ hints 2 Leaf ^ regular in
  expect "a regular matrix" (is_proved (file "[[1; 1]; [1; 1 + 1e-6]]"));
  expect "a singular matrix" (not (is_proved (file "[[1; 1]; [1; 1]]")));
  expect "an entry within its bounds" (is_proved (file "[[_x + 1 + 1e-6; 0]; [0; 1]]"));
  expect "an entry beyond them" (not (is_proved (file "[[_x + 1 - 1e-6; 0]; [0; 1]]")))

let refuse_missing_leaves name =
  let text = Files.read name in
  let file = Reader.read text in
  expect (name ^ " is proved") (is_proved text);
  let pieces = if file.has_pieces then file.pieces else [ [] ] in
  let check = check_piece_trees file.question file.method_ pieces in
  expect (name ^ " without a tree") (not (check (List.tl file.trees)));
  expect (name ^ " with one tree too many") (not (check (Leaf :: file.trees)));
  List.iteri
    (fun i tree ->
      let with_tree t = List.mapi (fun j u -> if j = i then t else u) file.trees in
      List.iter (fun t -> expect (name ^ " without a split") (not (check (with_tree t)))) (prunings tree))
    file.trees;
  let mark = "Leaf" in
  for i = 0 to String.length text - 5 do
    if String.sub text i 4 = mark && i > String.length text / 2 then
      let rest = String.sub text (i + 4) (String.length text - i - 4) in
      expect (name ^ " without a leaf") (not (is_proved (String.sub text 0 i ^ rest)))
  done

(* Bytes are changed anywhere. A file may still be true, but is always answered. *)
let answer_damaged_files name =
  let text = Files.read name in
  for _ = 1 to 700 do
    let bytes = Bytes.of_string text in
    for _ = 1 to 1 + Random.int 3 do
      let c = pick [ '('; ')'; '['; ']'; ';'; '.'; '0'; '9'; '-'; '*'; 'e'; ' '; '\n'; '\000'; '"'; '\255' ] in
      Bytes.set bytes (Random.int (Bytes.length bytes)) c
    done;
    let cut = if Random.int 4 = 0 then Random.int (Bytes.length bytes) else Bytes.length bytes in
    let damaged = Bytes.sub_string bytes 0 cut in
    match Prove.answer { bounds with time_limit = 2. } damaged with
    | _ -> expect "" true
    | exception e -> expect (name ^ ": " ^ Printexc.to_string e) false
  done

let () =
  Random.init 22;
  match List.tl (Array.to_list Sys.argv) with
  | [] -> exit 64
  | singular :: proved ->
      refuse_false_questions ();
      refuse_false_segments ();
      refuse_singular_robot singular;
      see_small_changes ();
      List.iter refuse_missing_leaves proved;
      List.iter answer_damaged_files proved;
      Printf.printf "%d files and hints, %d wrong answers\n" !tried !failures;
      exit (if !failures = 0 then 0 else 1)
