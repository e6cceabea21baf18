(* SPDX-License-Identifier: Apache-2.0 *)
(* The command regulus-formal. *)

let help =
  "usage: regulus-formal [options] FILE.v\n\n\
   Proves the claim of a file that 'regulus-verify --coq' wrote, by the checks of its library,\n\
   compiled. A theorem about the robot of a model file, after the claim, is for coqc alone.\n\
   The answer is the line on standard output:\n\
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

let write_comparison u text (file : Reader.file) =
  let pieces = if file.has_pieces then file.pieces else [ [] ] in
  let questions = List.map (fun p -> Print.question (file.question p)) pieces in
  Files.write u.compare
    (Printf.sprintf
       "%s\nFrom Coq Require Import QArith.\nGoal %s = [\n%s].\nProof. vm_compute. reflexivity. Qed.\n"
       (Prove.text_before_theorem text)
       (if file.has_pieces then "map the_question pieces" else "[the_question]")
       (String.concat ";\n" questions)
    ^
    if List.mem "the_factors" file.typed then
      Printf.sprintf "Goal (the_scales, the_factors, the_limit) = (%s, %s, %s).\nProof. reflexivity. Qed.\n"
        (Print.list Print.expression file.scales) (Print.list Print.expression file.factors)
        (Print.expression file.limit)
    else if not (List.mem "the_load" file.typed) then ""
    else if List.mem "the_limits" file.typed then
      Printf.sprintf "Goal (the_scales, the_load, the_limits) = (%s, %s, %s).\nProof. reflexivity. Qed.\n"
        (Print.list Print.expression file.scales) (Print.list Print.expression file.load)
        (Print.list Print.pair file.limits)
      ^ if not (Prove.is_paving file) then ""
        else Printf.sprintf "Goal the_parts = %s.\nProof. reflexivity. Qed.\n" (Print.parts file.parts)
    else
      Printf.sprintf "Goal (the_row, the_load, the_limit) = (%d%%nat, %s, %s).\nProof. reflexivity. Qed.\n"
        (Search.number_of file.row) (Print.list Print.expression file.load) (Print.expression file.limit))

let report u seconds verdict =
  let say text = if not u.quiet then Printf.eprintf "%s: %s, %.2f s\n%!" u.file text seconds in
  match verdict with
  | Prove.Proved { what; how; hinted } ->
      if u.hints <> "" then Files.write u.hints hinted;
      say how;
      print_endline ("PROVED" ^ what);
      0
  | Rejected why -> say why; print_endline "REJECTED"; 1
  | Unproved why -> say why; print_endline "NOT PROVED"; 2

let show_line text = Printf.eprintf "\r\027[K%s%!" text

let prove u text =
  let is_shown = (not u.quiet) && Unix.isatty Unix.stderr in
  let show = if is_shown then Some show_line else None in
  let verdict = Prove.answer { time_limit = u.time_limit; max_leaves = u.max_leaves; show } text in
  if is_shown then show_line "";
  report u (Sys.time ()) verdict

let run u =
  let text = Files.read u.file in
  if u.compare = "" then prove u text
  else
    let claim, _ = Reader.split text in
    try write_comparison u claim (Reader.read claim); 0
    with Tokens.Fault (line, what) ->
      report u 0. (Rejected (Printf.sprintf "line %d: %s" line what))

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
