(* SPDX-License-Identifier: Apache-2.0 *)
(* The command regulus-formal: proves a file of `regulus-verify --coq` by the checks that Coq has
   proved, as a program of its own. *)
open Checker

let help =
  "usage: regulus-formal [options] FILE.v\n\n\
   Proves the theorem of a file that 'regulus-verify --coq' wrote, by the checks of its library,\n\
   compiled. The answer is the line on standard output:\n\
  \  PROVED      the theorem is true                            (exit 0)\n\
  \  REJECTED    not such a file, or its hints prove nothing    (exit 1)\n\
  \  NOT PROVED  no proof was found within the bounds below     (exit 2)\n\
   Other exit codes: 64 usage, 74 a file cannot be read or written, 130 interrupted.\n\n\
  \  --hints FILE     write the file once more with the splits of the boxes, so that Coq need not\n\
  \                   search them: coqc then takes less than half the time\n\
  \  --compare FILE   prove nothing, but write a file that Coq accepts if it reads the same\n\
  \                   question as this program\n\
  \  --time-limit S   stop after S seconds\n\
  \  --max-leaves N   stop after N boxes that need no split (default 1000000)\n\
  \  --quiet          print only the answer\n\
  \  --help           print this text\n"

type usage = {
  file : string;
  hints : string;
  compare : string;
  time_limit : Float.t;
  max_leaves : int;
  quiet : bool;
  help : bool;
}

exception Usage

let rec read_usage u = function
  | [] -> if u.file = "" && not u.help then raise Usage else u
  | ("--help" | "-h") :: rest -> read_usage { u with help = true } rest
  | "--quiet" :: rest -> read_usage { u with quiet = true } rest
  | "--hints" :: hints :: rest -> read_usage { u with hints } rest
  | "--compare" :: compare :: rest -> read_usage { u with compare } rest
  | "--time-limit" :: seconds :: rest -> (
      match float_of_string_opt seconds with
      | Some s when s > 0. -> read_usage { u with time_limit = s } rest
      | _ -> raise Usage)
  | "--max-leaves" :: n :: rest -> (
      match int_of_string_opt n with
      | Some n when n > 0 -> read_usage { u with max_leaves = n } rest
      | _ -> raise Usage)
  | file :: rest when file <> "" && file.[0] <> '-' && u.file = "" -> read_usage { u with file } rest
  | _ -> raise Usage

let read_file name =
  let channel = open_in_bin name in
  Fun.protect
    ~finally:(fun () -> close_in_noerr channel)
    (fun () ->
      let text = Buffer.create 65536 and part = Bytes.create 65536 in
      let rec read () =
        match input channel part 0 65536 with
        | 0 -> Buffer.contents text
        | n -> Buffer.add_subbytes text part 0 n; read ()
      in
      read ())

(* A file is there whole, or not at all. *)
let write_file name text =
  let partial = name ^ ".new" in
  let channel = open_out_bin partial in
  output_string channel text;
  close_out channel;
  Sys.rename partial name

exception Stopped of string

(* Calls f. Meanwhile the clock ends it after the time limit, and shows progress on a terminal. *)
let with_clock u show f =
  let start = Unix.gettimeofday () in
  let is_shown = (not u.quiet) && Unix.isatty Unix.stderr in
  let tick _ =
    let seconds = Unix.gettimeofday () -. start in
    if seconds > u.time_limit then raise (Stopped "the time limit is reached");
    if is_shown then Printf.eprintf "\r\027[K%s, %.0f s%!" (show ()) seconds
  in
  let every interval = ignore (Unix.setitimer ITIMER_REAL { it_interval = interval; it_value = interval }) in
  Sys.set_signal Sys.sigalrm (Signal_handle tick);
  every (Float.min 0.2 u.time_limit);
  Fun.protect f ~finally:(fun () ->
      every 0.;
      if is_shown then prerr_string "\r\027[K")

type verdict = Proved of string | Rejected of string | Unproved of string

(* A statement for all points of the set: the test of a box, the check of the splits of all pieces,
   and how Coq calls the latter. *)
type claim = {
  test : question -> box -> answer;
  check : expression list list -> tree list -> bool;
  theorem : string;
}

(* The splits of each piece. *)
let find_trees u (file : Reader.file) claim pieces =
  let found = ref 0 in
  let count () =
    incr found;
    if !found > u.max_leaves then raise (Search.Open "the most leaves are reached")
  in
  let tree piece =
    let q = file.question piece in
    match enclose_ranges q.ranges with
    | None -> raise (Search.Open "an end of a range has no value")
    | Some root -> Search.splits ~count (claim.test q) (Search.number_of file.method_.deepest) root
  in
  with_clock u (fun () -> Printf.sprintf "searching: %d leaves" !found) (fun () -> List.map tree pieces)

let text_before_theorem text =
  let mark = "\nTheorem the_claim" in
  let rec find i =
    if String.sub text i (String.length mark) = mark then i else find (i - 1)
  in
  String.sub text 0 (find (String.length text - String.length mark))

let write_hints u text (file : Reader.file) claim trees =
  let list = Buffer.create 65536 in
  List.iteri (fun i t -> if i > 0 then Buffer.add_string list ";\n   "; Search.print_tree list t) trees;
  let name, kind, opening, closing =
    if file.has_pieces then ("the_trees", "list tree", "[", "]") else ("the_tree", "tree", "", "")
  in
  write_file u.hints
    (Printf.sprintf
       "%s\n(** How the boxes are split. *)\nDefinition %s : %s :=\n  %s%s%s.\n\n\
        Theorem the_claim : %s.\nProof.\n  apply (%s).\n  vm_cast_no_check (eq_refl true).\nQed.\n"
       (text_before_theorem text) name kind opening (Buffer.contents list) closing file.statement
       claim.theorem)

let for_all_points u text (file : Reader.file) ~has_trees claim =
  let pieces = if file.has_pieces then file.pieces else [ [] ] in
  let trees = if has_trees then file.trees else find_trees u file claim pieces in
  let count = List.fold_left (fun n t -> n + Search.leaves t) 0 trees in
  let check () = claim.check pieces trees in
  if not (with_clock u (fun () -> Printf.sprintf "checking %d leaves" count) check) then
    Rejected "the splits do not prove the theorem"
  else begin
    if u.hints <> "" then write_hints u text file claim trees;
    Proved (Printf.sprintf "%d leaves" count)
  end

let regular (file : Reader.file) theorem =
  { test = (fun q -> test q file.method_);
    check = check_piece_trees file.question file.method_; theorem }

let above (file : Reader.file) =
  let check _ = function
    | [ tree ] ->
        check_determinant_tree (file.question []) file.scales file.threshold file.method_ tree
    | _ -> false
  in
  { test = (fun q -> test_determinant q file.scales file.threshold file.method_); check;
    theorem = "check_determinant_tree_correct the_question the_scales the_threshold the_method the_tree" }

let at_points u why check = if with_clock u (fun () -> "checking") check then Proved why else
  Unproved "the bounds at the points of the file do not suffice"

let point (file : Reader.file) name = try List.assoc name file.points with Not_found -> []

(* Each statement with the theorem of the library that proves it, as regulus-verify writes them. *)
let prove u text (file : Reader.file) =
  let pieces = "Forall ( fun piece => no_singularity ( the_question piece ) ) pieces" in
  let proof_of_tree = "check_tree_correct the_question the_method the_tree" in
  let proof_of_trees = "check_piece_trees_correct the_question the_method pieces the_trees" in
  let applies theorem = file.proof = "apply ( " ^ theorem ^ " )" in
  let all ~hinted claim plain =
    if applies plain then for_all_points u text file ~has_trees:false claim
    else if applies hinted then for_all_points u text file ~has_trees:true claim
    else Rejected "the statement is not that of the theorem that is applied"
  in
  match (file.has_pieces, file.statement) with
  | false, "no_singularity the_question" ->
      all ~hinted:proof_of_tree (regular file proof_of_tree) "check_correct the_question the_method"
  | true, statement when statement = pieces ->
      all ~hinted:proof_of_trees (regular file proof_of_trees)
        "check_pieces_correct the_question the_method pieces"
  | false, "determinant_above the_question the_scales the_threshold" ->
      let claim = above file in
      all ~hinted:claim.theorem claim
        "check_determinant_correct the_question the_scales the_threshold the_method"
  | false, "singularity the_question"
    when applies "check_singularity_correct the_question negative positive" ->
      at_points u "the determinant changes its sign along a segment" (fun () ->
          check_singularity (file.question []) (point file "negative") (point file "positive"))
  | false, "determinant_not_above the_question the_scales the_threshold"
    when applies "check_point_correct the_question the_scales the_threshold the_point" ->
      at_points u "the determinant is not above the threshold at a point" (fun () ->
          check_point (file.question []) file.scales file.threshold (point file "the_point"))
  | _ -> Rejected "the theorem is not one of regulus-verify"

let write_comparison u text (file : Reader.file) =
  let pieces = if file.has_pieces then file.pieces else [ [] ] in
  let questions = List.map (fun p -> Print.question (file.question p)) pieces in
  write_file u.compare
    (Printf.sprintf
       "%s\nFrom Coq Require Import QArith.\nGoal %s = [\n%s].\nProof. vm_compute. reflexivity. Qed.\n"
       (text_before_theorem text)
       (if file.has_pieces then "map the_question pieces" else "[the_question]")
       (String.concat ";\n" questions))

let answer u text =
  try prove u text (Reader.read text) with
  | Tokens.Fault (line, what) -> Rejected (Printf.sprintf "line %d: %s" line what)
  | Search.Open why | Stopped why -> Unproved why
  | Stack_overflow -> Rejected "the file is nested too deep"

let report u seconds verdict =
  let say text = if not u.quiet then Printf.eprintf "%s: %s, %.2f s\n%!" u.file text seconds in
  match verdict with
  | Proved how -> say how; print_endline "PROVED"; 0
  | Rejected why -> say why; print_endline "REJECTED"; 1
  | Unproved why -> say why; print_endline "NOT PROVED"; 2

let run u =
  let text = read_file u.file in
  if u.compare <> "" then
    match Reader.read text with
    | file -> write_comparison u text file; 0
    | exception Tokens.Fault (line, what) ->
        report u 0. (Rejected (Printf.sprintf "line %d: %s" line what))
  else
    let verdict = answer u text in
    report u (Sys.time ()) verdict

let () =
  let none =
    { file = ""; hints = ""; compare = ""; time_limit = infinity; max_leaves = 1_000_000;
      quiet = false; help = false }
  in
  Sys.set_signal Sys.sigint (Signal_handle (fun _ -> exit 130));
  exit
    (match read_usage none (List.tl (Array.to_list Sys.argv)) with
    | exception Usage -> prerr_string help; 64
    | u when u.help -> print_string help; 0
    | u -> ( try run u with Sys_error why -> prerr_endline ("regulus-formal: " ^ why); 74))
