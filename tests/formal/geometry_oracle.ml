(* SPDX-License-Identifier: GPL-3.0-or-later *)
(* Writes claims for Coq: the matrices that Geometry.v gives random platforms are close to those of
   another kind of computation. Here an orientation is a unit quaternion, and the row of a leg is the
   derivative of half of its squared length along the six velocities of the platform, by differences. The
   Jacobian that Arms.v gives random arms is close to the derivatives of place and orientation. *)

let step = 1e-4
let tolerance = "(1/1000)"
let legs = 3 (* each has its own row *)

(* ---- Vectors and quaternions (w, v) ---- *)

let add (a, b, c) (d, e, f) = (a +. d, b +. e, c +. f)
let scaled k (a, b, c) = (k *. a, k *. b, k *. c)
let dot (a, b, c) (d, e, f) = (a *. d) +. (b *. e) +. (c *. f)
let cross (a, b, c) (d, e, f) = ((b *. f) -. (c *. e), (c *. d) -. (a *. f), (a *. e) -. (b *. d))

let times (w, v) (w', v') =
  ((w *. w') -. dot v v', add (add (scaled w v') (scaled w' v)) (cross v v'))

let turned (w, v) u =
  let size = (w *. w) +. dot v v in
  scaled (1. /. size) (snd (times (times (w, v) (0., u)) (w, scaled (-1.) v)))

let axes = [| (1., 0., 0.); (0., 1., 0.); (0., 0., 1.) |]
let about axis angle = (cos (angle /. 2.), scaled (sin (angle /. 2.)) axes.(axis))

(* ---- Random numbers, which are exact both here and in Coq ---- *)

type exact = { value : float; text : string }

let random most parts =
  let n = Random.int ((2 * most * parts) + 1) - (most * parts) in
  { value = float n /. float parts; text = Printf.sprintf "(%d/%d)" n parts }

let values l = List.map (fun e -> e.value) l
let texts between l = String.concat between (List.map (fun e -> e.text) l)
let point l = match values l with [ a; b; c ] -> (a, b, c) | _ -> assert false

let conventions =
  [ ("euler_zxz", 3, fun q -> times (about 2 q.(0)) (times (about 0 q.(1)) (about 2 q.(2))));
    ("roll_pitch_yaw", 3, fun q -> times (about 2 q.(2)) (times (about 1 q.(1)) (about 0 q.(0))));
    ("quaternion", 4, fun q -> (q.(0), (q.(1), q.(2), q.(3)))) ]

(* ---- Rows ---- *)

let half_square a b p q =
  let d = add (add p (turned q b)) (scaled (-1.) a) in
  dot d d /. 2.

let row a b p q =
  let along move = (move step -. move (-.step)) /. (2. *. step) in
  List.init 6 (fun k ->
      if k < 3 then along (fun h -> half_square a b (add p (scaled h axes.(k))) q)
      else along (fun h -> half_square a b p (times (about (k - 3) h) q)))

let platform (word, angles, orientation) =
  let coordinates most = List.init 3 (fun _ -> random most 8) in
  let anchors most = List.init legs (fun _ -> coordinates most) in
  let base = anchors 20 and top = anchors 10 in
  let p = coordinates 30 and q = List.init angles (fun _ -> random 3 16) in
  let turn = orientation (Array.of_list (values q)) in
  let leg a b = Printf.sprintf "((%s), (%s))" (texts ", " a) (texts ", " b) in
  Printf.printf "Definition legs_of_%s := [%s].\n" word (String.concat "; " (List.map2 leg base top));
  let matrix = List.map2 (fun a b -> row (point a) (point b) (point p) turn) base top in
  Printf.printf "Goal ";
  List.iteri
    (fun i entries ->
      List.iteri
        (fun j entry ->
          Printf.printf "%snear %s (%.6f)\n  (gough legs_of_%s (%s) (%s %s) %d %d)"
            (if i + j > 0 then " /\\ " else "") tolerance entry word (texts ", " p) word (texts " " q) i j)
        entries)
    matrix;
  print_string ".\nProof. unfold near. repeat split; computed; interval. Qed.\n"

(* ---- Arms ---- *)

type part =
  | Shift of exact list
  | Turn of int * exact (* about an axis: 0 to 2; 3 to 5 are the opposite ones *)
  | Along of int * exact * exact
  | Joint of { slides : bool; number : int; axis : int; rate : exact option; value : exact }

let vector axis = scaled (if axis > 2 then -1. else 1.) axes.(axis mod 3)
let rotation axis angle = about (axis mod 3) (if axis > 2 then -.angle else angle)

(* The place and the orientation of the end; joint k has moved by h. *)
let end_of arm k h =
  let next (p, o) part =
    let moved v = add p (turned o v) in
    match part with
    | Shift v -> (moved (point v), o)
    | Turn (axis, angle) -> (p, times o (rotation axis angle.value))
    | Along (axis, length, angle) ->
        (moved (scaled length.value axes.(axis)), times o (about axis angle.value))
    | Joint j ->
        let rate = match j.rate with Some r -> r.value | None -> 1. in
        let value = if j.number = k then j.value.value +. (h *. rate) else j.value.value in
        if j.slides then (moved (scaled value (vector j.axis)), o)
        else (p, times o (rotation j.axis value))
  in
  List.fold_left next ((0., 0., 0.), (1., (0., 0., 0.))) arm

let column arm k =
  let p, o = end_of arm k step and q, (w, v) = end_of arm k (-.step) in
  let velocity = scaled (1. /. (2. *. step)) (add p (scaled (-1.) q)) in
  (* Between the orientations is a rotation by twice the step. *)
  let spin = scaled (1. /. step) (snd (times o (w, scaled (-1.) v))) in
  let list (a, b, c) = [ a; b; c ] in
  list velocity @ list spin

let text_of_axis axis =
  let word = [| "x_axis"; "y_axis"; "z_axis" |].(axis mod 3) in
  if axis > 2 then "(opposite " ^ word ^ ")" else word

let text_of_part = function
  | Shift v -> Printf.sprintf "shift_by (%s)" (texts ", " v)
  | Turn (axis, angle) -> Printf.sprintf "turn_by %s %s" (text_of_axis axis) angle.text
  | Along (axis, length, angle) ->
      Printf.sprintf "along_%s %s %s" (if axis = 0 then "x" else "z") length.text angle.text
  | Joint j -> (
      let kind = if j.slides then "prismatic" else "revolute" in
      let joint = Printf.sprintf "%s %d %s %s" kind j.number (text_of_axis j.axis) j.value.text in
      match j.rate with
      | Some r -> Printf.sprintf "follower %s (%s)" r.text joint
      | None -> joint)

let joint ?rate slides number =
  Joint { slides; number; axis = Random.int 6; rate; value = random 2 8 }

let arms =
  let size () = random 3 8 and angle () = random 3 16 in
  [ (fun () -> [ joint false 1; Along (0, size (), angle ()); Along (2, size (), angle ());
                 joint false 2; Along (0, size (), angle ()); joint true 3; Shift [ size (); size (); size () ] ]);
    (fun () -> [ Shift [ size (); size (); size () ]; Turn (Random.int 6, angle ()); joint true 2;
                 joint false 1; Turn (Random.int 6, angle ()); joint ~rate:(random 2 4) false 2;
                 Shift [ size (); size (); size () ] ]);
    (fun () -> [ joint false 2; Along (2, size (), angle ()); joint false 1; Along (0, size (), angle ());
                 joint ~rate:(random 2 4) false 1; Along (0, size (), angle ()) ]) ]

let write_arm number arm =
  let columns = List.sort_uniq compare (List.filter_map (function Joint j -> Some j.number | _ -> None) arm) in
  Printf.printf "Definition arm_%d := [%s].\nGoal " number (String.concat "; " (List.map text_of_part arm));
  List.iter
    (fun k ->
      List.iteri
        (fun i entry ->
          Printf.printf "%snear %s (%.6f)\n  (jacobian arm_%d %d %d)"
            (if i + k > 1 then " /\\ " else "") tolerance entry number i (k - 1))
        (column arm k))
    columns;
  print_string ".\nProof. unfold near. repeat split; computed; interval. Qed.\n"

let () =
  Random.init 20;
  print_string "From Interval Require Import Tactic.\nFrom Regulus Require Import Arms.\n";
  List.iter platform conventions;
  List.iteri (fun number make -> write_arm number (make ())) arms
