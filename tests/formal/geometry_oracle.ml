(* SPDX-License-Identifier: GPL-3.0-or-later *)
(* Writes claims for Coq: the matrices that Geometry.v gives random platforms are close to those of
   another kind of computation. Here an orientation is a unit quaternion, and the row of a leg is the
   derivative of half of its squared length along the six velocities of the platform, by differences. The
   Jacobian that Arms.v gives random arms is close to the derivatives of place and orientation. The rows
   that Legs.v gives random legs are close to the derivatives of motors' places, which are found by
   halving: an angle of a crank, a place of a carriage, at which the rod has its length. *)

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

(* ---- Legs ---- *)

let minus u v = add u (scaled (-1.) v)
let norm u = sqrt (dot u u)
let unit u = scaled (1. /. norm u) u
let exact n parts = { value = float n /. float parts; text = Printf.sprintf "(%d/%d)" n parts }
let rounded x = exact (int_of_float (Float.round (8. *. x))) 8
let text_of_point l = "(" ^ texts ", " l ^ ")"

type chain = {
  kind : string; planar : bool; base : exact list; top : exact list; axis : exact list;
  hinge : exact list; crank : exact; rod : exact; mode : int }

(* The place at which an increasing function has a value. *)
let rec halved f value low high =
  let middle = (low +. high) /. 2. in
  if high -. low < 1e-13 then middle
  else if f middle < value then halved f value middle high
  else halved f value low middle

(* Two directions across the axis, such that the first is along the projected e. *)
let frame n e =
  let n = unit n in
  let u = unit (minus e (scaled (dot e n) n)) in
  (u, cross n u)

(* The crank at an angle from the projected e. *)
let crank_at leg n e angle =
  let u, v = frame n e in
  scaled leg.crank.value (add (scaled (cos angle) u) (scaled (sin angle) v))
let angle_from_line leg n e =
  let length t = norm (minus e (crank_at leg n e t)) in
  float leg.mode *. halved length leg.rod.value 0. Float.pi
(* The place from the foot of the perpendicular. *)
let place_from_foot leg n e =
  let n = unit n in
  let foot = dot e n in
  let length s = norm (minus e (scaled (foot +. s) n)) in
  float leg.mode *. halved length leg.rod.value 0. (2. *. leg.rod.value)

let span leg p q = minus (add p (turned q (point leg.top))) (point leg.base)
let is_crank leg = List.mem leg.kind [ "RUS"; "RRR"; "delta" ]
let is_carriage leg = List.mem leg.kind [ "PUS"; "PRR"; "PRS"; "linear_delta" ]

(* The motor's place; an angle is counted from a direction that does not move. *)
let motor leg zero p q =
  let e = span leg p q in
  if is_crank leg then
    let n = point leg.axis in
    let u, v = frame n zero in
    let c = crank_at leg n e (angle_from_line leg n e) in
    atan2 (dot c v) (dot c u)
  else if is_carriage leg then
    let n = point leg.axis in
    dot e (unit n) +. place_from_foot leg n e
  else norm e

let rod_at leg p q =
  let e = span leg p q and n = point leg.axis in
  if is_crank leg then minus e (crank_at leg n e (angle_from_line leg n e))
  else if is_carriage leg then
    minus e (scaled (dot e (unit n) +. place_from_foot leg n e) (unit n))
  else e

let list_of (a, b, c) = [ a; b; c ]
let gradient f p q =
  let along move = (move step -. move (-.step)) /. (2. *. step) in
  List.init 6 (fun k ->
      if k < 3 then along (fun h -> f (add p (scaled h axes.(k))) q)
      else along (fun h -> f p (times (about (k - 3) h) q)))

let motor_row leg p q =
  let zero = if is_crank leg then crank_at leg (point leg.axis) (span leg p q) 1. else (0., 0., 0.) in
  let sign = if is_crank leg || is_carriage leg then -. float leg.mode else 1. in
  List.map (( *. ) sign) (gradient (motor leg zero) p q)

(* A hinge keeps B in a plane; a parallelogram and two universal joints keep a direction from turning. *)
let constraint_rows leg p q =
  match leg.kind with
  | "RPS" | "PRS" -> [ gradient (fun p q -> dot (span leg p q) (point leg.hinge)) p q ]
  | "delta" -> [ [ 0.; 0.; 0. ] @ list_of (cross (point leg.axis) (rod_at leg p q)) ]
  | "linear_delta" -> [ [ 0.; 0.; 0. ] @ list_of (cross (point leg.hinge) (rod_at leg p q)) ]
  | "UPU" ->
      let n = point leg.axis and e = span leg p q in
      [ [ 0.; 0.; 0. ] @ list_of (cross (cross n e) n) ]
  | _ -> []

let text_of_leg leg =
  let place l = if leg.planar then text_of_point (List.filteri (fun i _ -> i < 2) l) else text_of_point l in
  let mode = Printf.sprintf "(%d)" leg.mode in
  let rest =
    match leg.kind with
    | "RUS" | "delta" -> [ place leg.axis; leg.crank.text; leg.rod.text; mode ]
    | "RRR" -> [ leg.crank.text; leg.rod.text; mode ]
    | "PUS" | "PRR" -> [ place leg.axis; leg.rod.text; mode ]
    | "PRS" | "linear_delta" -> [ place leg.axis; place leg.hinge; leg.rod.text; mode ]
    | "RPS" -> [ place leg.hinge ]
    | "UPU" -> [ place leg.axis ]
    | _ -> []
  in
  String.concat " " ([ leg.kind; place leg.base; place leg.top ] @ rest)

(* A leg that reaches from its base to the platform. *)
let random_leg kind planar is_point p q =
  let coordinates most =
    [ random most 8; random most 8; (if planar then exact 0 1 else random most 8) ] in
  let whole () = List.init 3 (fun _ -> exact (1 + Random.int 6) 1) in
  let cross_of u v =
    let a, b, c = cross (point u) (point v) in
    List.map (fun x -> exact (int_of_float x) 1) [ a; b; c ] in
  let base = coordinates 20 in
  let top = if is_point then List.init 3 (fun _ -> exact 0 1) else coordinates 10 in
  let axis =
    if planar && kind = "RRR" then [ exact 0 1; exact 0 1; exact 1 1 ]
    else if planar then [ exact 3 1; exact (Random.int 5) 1; exact 0 1 ]
    else whole () in
  let leg = { kind; planar; base; top; axis; hinge = cross_of axis [ exact 1 1; exact (-2) 1; exact 5 1 ];
              crank = exact 9 2; rod = exact 0 1; mode = (if Random.bool () then 1 else -1) } in
  let e = span leg p q and n = point axis in
  let across = norm (minus e (scaled (dot e (unit n)) (unit n))) in
  if is_crank leg then
    let length t = norm (minus e (crank_at leg n e t)) in
    { leg with rod = rounded ((length 0. +. length Float.pi) /. 2.) }
  else { leg with rod = rounded (across +. 6.) }

let write_legs name kinds columns matrix p q planar is_point =
  let legs = List.map (fun kind -> random_leg kind planar is_point p q) kinds in
  let rows =
    List.map (fun leg -> motor_row leg p q) legs
    @ List.concat_map (fun leg -> constraint_rows leg p q) legs in
  let of_row row = "[" ^ String.concat "; " (List.map (fun j -> Printf.sprintf "%.6f" (List.nth row j)) columns) ^ "]" in
  Printf.printf "Definition %s := [%s].\nGoal are_near [%s]\n  (%s).\nProof.\n  open_legs.\n" name
    (String.concat "; " (List.map text_of_leg legs))
    (String.concat ";\n  " (List.map of_row rows))
    (matrix name);
  List.iteri (fun i _ -> Printf.printf "  name_leg as _%d.\n" (i + 1)) legs;
  print_string "  bounds. unfold are_near, near. computed. repeat split; interval.\nQed.\n"

let all_columns = [ 0; 1; 2; 3; 4; 5 ]
let legs_in_space (word, angles, orientation) =
  let p = List.init 3 (fun _ -> random 30 8) and q = List.init angles (fun _ -> random 3 16) in
  let matrix name = Printf.sprintf "rates_in_space %s (%s) (%s %s)" name (texts ", " p) word (texts " " q) in
  let kinds = match word with "euler_zxz" -> [ "RUS"; "RPS" ] | "quaternion" -> [ "PUS"; "UPS" ] | _ -> [ "RUS"; "PRS" ] in
  write_legs ("chains_of_" ^ word) kinds all_columns matrix (point p)
    (orientation (Array.of_list (values q))) false false

let no_turn = (1., (0., 0., 0.))
let legs_without_angles () =
  let p = List.init 3 (fun _ -> random 30 8) in
  write_legs "level_chains" [ "delta"; "UPU"; "linear_delta" ] all_columns
    (fun name -> Printf.sprintf "rates_in_space %s (%s) fixed" name (texts ", " p))
    (point p) no_turn false false;
  write_legs "chains_to_a_point" [ "RUS"; "PUS"; "UPS" ] [ 0; 1; 2 ]
    (fun name -> Printf.sprintf "rates_of_point %s (%s)" name (texts ", " p))
    (point p) no_turn false true
let legs_in_plane () =
  let x = random 30 8 and y = random 30 8 and phi = random 3 16 in
  let p = (x.value, y.value, 0.) and place = texts ", " [ x; y ] in
  write_legs "flat_chains" [ "RRR"; "RPR"; "PRR" ] [ 0; 1; 5 ]
    (fun name -> Printf.sprintf "rates_in_plane %s (%s) %s" name place phi.text)
    p (about 2 phi.value) true false;
  write_legs "flat_chains_to_a_point" [ "RRR"; "PRR" ] [ 0; 1 ]
    (fun name -> Printf.sprintf "rates_of_point_in_plane %s (%s)" name place)
    p no_turn true true

let () =
  Random.init 20;
  print_string "From Interval Require Import Tactic.\nFrom Regulus Require Import Arms Legs.\n";
  Printf.printf "Definition are_near (l : list (list R)) (m : nat -> nat -> R) : Prop :=\n\
    \  all_of (map (fun i => all_of (map (fun j => near %s (matrix_of l i j) (m i j)) (seq 0 (length (nth 0 l [])))))\n\
    \    (seq 0 (length l))).\n\
     Ltac bounds := repeat match reverse goal with E : ?v = ?e |- _ =>\n\
    \  lazymatch e with\n\
    \  | IZR _ => rewrite E in *; clear E\n\
    \  | _ => let B := fresh in interval_intro e as B; rewrite <- E in B; clear E end end.\n" tolerance;
  List.iter platform conventions;
  List.iteri (fun number make -> write_arm number (make ())) arms;
  List.iter legs_in_space conventions;
  legs_without_angles ();
  legs_in_plane ()
