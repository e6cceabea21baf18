(* SPDX-License-Identifier: GPL-3.0-or-later *)
(* Writes the results of this program as a claim that Coq checks. *)
let () =
  print_string
    "From Coq Require Import List Uint63.\nRequire Import Arithmetic.\nImport ListNotations.\n\
     Goal results = [";
  List.iteri (fun i n -> Printf.printf "%s%u" (if i > 0 then ";\n" else "") n) Arithmetic.results;
  print_string "]%uint63.\nProof. vm_compute. reflexivity. Qed.\n"
