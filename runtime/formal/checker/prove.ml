(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves the theorem of a file by the checks that Coq has proved. *)
open Checker

type bounds = {
  time_limit : Float.t;  (* seconds *)
  max_leaves : int;
  show : (string -> unit) option;  (* shows progress, a few times a second *)
}

exception Stopped of string

(* Calls f. Meanwhile the clock ends it after the time limit, and shows progress on a terminal. *)
let with_clock bounds show f =
  let start = Unix.gettimeofday () in
  let tick _ =
    let seconds = Unix.gettimeofday () -. start in
    if seconds > bounds.time_limit then raise (Stopped "the time limit is reached");
    Option.iter (fun print -> print (Printf.sprintf "%s, %.0f s" (show ()) seconds)) bounds.show
  in
  let every interval = ignore (Unix.setitimer ITIMER_REAL { it_interval = interval; it_value = interval }) in
  Sys.set_signal Sys.sigalrm (Signal_handle tick);
  every (Float.min 0.2 bounds.time_limit);
  Fun.protect f ~finally:(fun () -> every 0.)

type verdict =
  | Proved of { what : string; how : string; hinted : string }  (* the file with the splits, if there are any *)
  | Rejected of string
  | Unproved of string

(* A statement for all points of the set: the test of a box, the check of the splits of all pieces,
   and the theorems of the library that prove it with and without splits. *)
type claim = {
  searched : question -> question;  (* whose set is split *)
  boxes : box -> box list;  (* those parts of the box of its ranges that the statement is about *)
  test : question -> box -> answer;
  check : expression list list -> tree list -> bool;
  hinted : string;
  plain : string;
}

(* The splits of each box of each piece. *)
let find_trees bounds (file : Reader.file) claim pieces =
  let found = ref 0 in
  let count () =
    incr found;
    if !found > bounds.max_leaves then raise (Search.Open "the most leaves are reached")
  in
  let trees piece =
    let q = claim.searched (file.question piece) in
    match enclose_ranges q.ranges with
    | None -> raise (Search.Open "an end of a range has no value")
    | Some root ->
        List.map (Search.splits ~count (claim.test q) (Search.number_of file.method_.deepest) root) (claim.boxes root)
  in
  with_clock bounds (fun () -> Printf.sprintf "searching: %d leaves" !found) (fun () -> List.concat_map trees pieces)

let is_paving (file : Reader.file) = List.mem "the_parts" file.typed

let text_before_theorem text =
  let mark = "\nTheorem the_claim" in
  let rec find i =
    if i < 0 then raise (Tokens.Fault (1, "no line begins with Theorem the_claim"))
    else if String.sub text i (String.length mark) = mark then i
    else find (i - 1)
  in
  String.sub text 0 (find (String.length text - String.length mark))

(* Words that the reader has separated, as a person writes them. *)
let rec close_parentheses = function
  | "(" :: word :: rest -> close_parentheses (("(" ^ word) :: rest)
  | word :: ")" :: rest -> close_parentheses ((word ^ ")") :: rest)
  | word :: rest -> word :: close_parentheses rest
  | [] -> []

let tidy words = String.concat " " (close_parentheses (String.split_on_char ' ' words))

(* The file once more, with the splits. *)
let with_hints text (file : Reader.file) claim trees =
  let list = Buffer.create 65536 in
  List.iteri (fun i t -> if i > 0 then Buffer.add_string list ";\n   "; Search.print_tree list t) trees;
  let name, kind, opening, closing =
    if file.has_pieces || is_paving file then ("the_trees", "list tree", "[", "]") else ("the_tree", "tree", "", "")
  in
  Printf.sprintf
    "%s\n(** How the boxes are split. *)\nDefinition %s : %s :=\n  %s%s%s.\n\n\
     Theorem the_claim : %s.\nProof.\n  apply (%s).\n  vm_cast_no_check (eq_refl true).\nQed.\n"
    (text_before_theorem text) name kind opening (Buffer.contents list) closing (tidy file.statement)
    claim.hinted

let for_all_points bounds text (file : Reader.file) ~has_trees claim =
  let pieces = if file.has_pieces then file.pieces else [ [] ] in
  let trees = if has_trees then file.trees else find_trees bounds file claim pieces in
  let count = List.fold_left (fun n t -> n + Search.leaves t) 0 trees in
  let check () = claim.check pieces trees in
  if not (with_clock bounds (fun () -> Printf.sprintf "checking %d leaves" count) check) then
    Rejected "the splits do not prove the theorem"
  else
    let hinted = if has_trees then text else with_hints text file claim trees in
    Proved { what = ""; how = Printf.sprintf "%d leaves" count; hinted }

(* How Coq calls the check with trees, and that without. *)
let theorems (file : Reader.file) kind arguments =
  if file.has_pieces then
    ( Printf.sprintf "check%s_piece_trees_correct the_question %s pieces the_trees" kind arguments,
      Printf.sprintf "check%s_pieces_correct the_question %s pieces" kind arguments )
  else
    ( Printf.sprintf "check%s_tree_correct the_question %s the_tree" kind arguments,
      Printf.sprintf "check%s_correct the_question %s" kind arguments )

let whole box = [ box ]

let regular (file : Reader.file) =
  let hinted, plain = theorems file "" "the_method" in
  { searched = Fun.id; boxes = whole; test = (fun q -> test q file.method_);
    check = check_piece_trees file.question file.method_; hinted; plain }

let above (file : Reader.file) =
  let hinted, plain = theorems file "_determinant" "the_scales the_threshold the_method" in
  { searched = Fun.id; boxes = whole; test = (fun q -> test_determinant q file.scales file.threshold file.method_);
    check = check_determinant_piece_trees file.question file.scales file.threshold file.method_;
    hinted; plain }

(* `side`: "within" for the absolute force, "below" for the force. *)
let force (file : Reader.file) side ends =
  let hinted, plain = theorems file ("_force_" ^ side) "the_row the_load the_limit the_method" in
  { searched = (fun q -> bordered q file.row file.load (ends file.limit)); boxes = whole;
    test = (fun q -> test q (bordered_method file.method_));
    check = check_force_piece_trees ends file.question file.row file.load file.limit file.method_;
    hinted; plain }

let limits (file : Reader.file) =
  let hinted, plain = theorems file "_limits" "the_scales the_load the_limits the_method" in
  { searched = Fun.id; boxes = whole;
    test = (fun q -> test_limits q file.scales file.load file.limits file.method_);
    check = check_limits_piece_trees file.question file.scales file.load file.limits file.method_;
    hinted; plain }

let limits_in_parts (file : Reader.file) =
  let arguments = "the_question the_parts the_scales the_load the_limits the_method" in
  let q = file.question [] in
  { searched = Fun.id; boxes = kept_boxes file.parts;
    test = (fun q -> test_limits q file.scales file.load file.limits file.method_);
    check = (fun _ -> check_limits_trees q file.parts file.scales file.load file.limits file.method_);
    hinted = Printf.sprintf "check_limits_trees_correct %s the_trees" arguments;
    plain = Printf.sprintf "check_limits_in_correct %s" arguments }

(* Each bound of singular values, and its name. *)
let spectra =
  [ (Values_above, "singular_values_above"); (Values_below, "singular_values_below");
    (Ratio_below, "condition_2_below") ]

let spectrum (file : Reader.file) (what, name) =
  let hinted, plain = theorems file ("_" ^ name) "the_scales the_factors the_limit the_method" in
  { searched = Fun.id; boxes = whole;
    test = (fun q -> test_spectrum what q file.scales file.factors file.limit file.method_);
    check = check_spectrum_piece_trees what file.question file.scales file.factors file.limit file.method_;
    hinted; plain }

let at_points bounds text how check =
  if with_clock bounds (fun () -> "checking") check then Proved { what = ""; how; hinted = text }
  else Unproved "the bounds at the points of the file do not suffice"

let point (file : Reader.file) name = try List.assoc name file.points with Not_found -> []

(* Coq refuses a theorem about something that the file does not define. *)
let require_definitions (file : Reader.file) =
  let require word =
    if List.mem word Reader.typed_names && not (List.mem word file.typed) then
      raise (Tokens.Fault (1, "the file does not define '" ^ word ^ "'"))
  in
  List.iter require (String.split_on_char ' ' (file.statement ^ " " ^ file.proof))

(* Each statement with the theorem of the library that proves it, as regulus-verify writes them. *)
let prove bounds text (file : Reader.file) =
  require_definitions file;
  let applies theorem = file.proof = "apply ( " ^ theorem ^ " )" in
  let states what =
    file.statement
    = if file.has_pieces then Printf.sprintf "Forall ( fun piece => %s ) pieces" (what "( the_question piece )")
      else what "the_question"
  in
  let all claim =
    if applies claim.plain then for_all_points bounds text file ~has_trees:false claim
    else if applies claim.hinted then for_all_points bounds text file ~has_trees:true claim
    else Rejected "the statement is not that of the theorem that is applied"
  in
  if states (Printf.sprintf "no_singularity %s") then all (regular file)
  else if states (Printf.sprintf "determinant_above %s the_scales the_threshold") then all (above file)
  else if states (Printf.sprintf "force_within %s the_row the_load the_limit") then
    all (force file "within" range_within)
  else if states (Printf.sprintf "force_below %s the_row the_load the_limit") then
    all (force file "below" range_below)
  else if states (Printf.sprintf "forces_within_limits %s the_scales the_load the_limits") then all (limits file)
  else if
    (not file.has_pieces) && states (Printf.sprintf "forces_within_limits_in %s the_parts the_scales the_load the_limits")
  then all (limits_in_parts file)
  else
  match
    List.find_opt
      (fun (_, name) -> states (fun q -> name ^ " " ^ q ^ " the_scales the_factors the_limit"))
      spectra
  with
  | Some bound -> all (spectrum file bound)
  | None ->
  match (file.has_pieces, file.statement) with
  | false, "singularity the_question"
    when applies "check_singularity_correct the_question negative positive" ->
      at_points bounds text "the determinant changes its sign along a segment" (fun () ->
          check_singularity (file.question []) (point file "negative") (point file "positive"))
  | false, "determinant_not_above the_question the_scales the_threshold"
    when applies "check_crossing_correct the_question the_scales the_threshold negative positive" ->
      at_points bounds text "the determinant changes its sign along a segment" (fun () ->
          check_crossing (file.question []) file.scales file.threshold (point file "negative")
            (point file "positive"))
  | false, "determinant_not_above the_question the_scales the_threshold"
    when applies "check_point_correct the_question the_scales the_threshold the_point" ->
      at_points bounds text "the determinant is not above the threshold at a point" (fun () ->
          check_point (file.question []) file.scales file.threshold (point file "the_point"))
  | _ -> Rejected "the theorem is not one of regulus-verify"

let answer bounds text =
  let claim, robot = Reader.split text in
  try
    match prove bounds claim (Reader.read claim) with
    | Proved p when robot <> "" ->
        Proved { what = " the_claim; the theorem about the robot is for coqc"; how = p.how; hinted = p.hinted ^ robot }
    | verdict -> verdict
  with
  | Tokens.Fault (line, what) -> Rejected (Printf.sprintf "line %d: %s" line what)
  | Search.Open why | Stopped why -> Unproved why
  | Stack_overflow -> Rejected "the file is nested too deep"

