(* SPDX-License-Identifier: Apache-2.0 *)
let read name =
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
let write name text =
  let partial, channel =
    Filename.open_temp_file ~mode:[ Open_binary ] ~perms:0o666 ~temp_dir:(Filename.dirname name)
      (Filename.basename name ^ ".") ".regulus"
  in
  output_string channel text;
  close_out channel;
  Sys.rename partial name
