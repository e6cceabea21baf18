(* SPDX-License-Identifier: GPL-3.0-or-later *)
(* Writes claims for Coq: the matrices that Geometry.v gives random platforms are close to those of
   another kind of computation. Here an orientation is a unit quaternion, and the row of a leg is the
   derivative of half of its squared length along the six velocities of the platform, by differences. *)

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

let () =
  Random.init 20;
  print_string "From Interval Require Import Tactic.\nFrom Regulus Require Import Geometry.\n";
  List.iter platform conventions
