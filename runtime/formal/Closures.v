(* SPDX-License-Identifier: Apache-2.0 *)
(** What a certificate claims of a mechanism that is closed by equations. These are the definitions
    to read, with those of Questions.v and Expressions.v. *)
From Coq Require Import Reals QArith List.
From Regulus Require Import Expressions LinearAlgebra Questions.
Import ListNotations.
Open Scope R_scope.

Record closure := Closure {
  (** The variables x, the definitions that use no unknowns, and the set. There is no matrix. *)
  places : question;
  (** The number of unknowns: the next names after those of [places]. *)
  unknowns : nat;
  (** Definitions that use unknowns. *)
  further : list expression;
  (** As many as unknowns. Each is 0 in a configuration. *)
  equations : list expression;
  (** More expressions that must have a value. *)
  also : list expression;
  (** Where the mechanism starts: a value for each variable. *)
  start : list expression;
  (** For each unknown its value at the start, roughly, and a radius about it. *)
  near : list (expression * expression) }.

(** The values of all names where the variables are x and the unknowns p. *)
Definition names_at (c : closure) (x p : list R) : list R :=
  extend (extend x (definitions (places c)) ++ p) (further c).

Definition equation_at (c : closure) (x p : list R) (i : nat) : R :=
  value (names_at c x p) (nth i (equations c) no_entry).

(** p is a configuration of the mechanism at x. *)
Definition solves (c : closure) (x p : list R) : Prop :=
  length p = unknowns c /\ forall i, (i < unknowns c)%nat -> equation_at c x p i = 0.

(** Every expression of the model has a value. *)
Definition has_values (c : closure) (x p : list R) : Prop :=
  let names := extend x (definitions (places c)) in
  all_defined x (definitions (places c)) /\
  Forall (defined names) (also_defined (places c)) /\
  all_defined (names ++ p) (further c) /\
  Forall (defined (names_at c x p)) (equations c) /\
  Forall (defined (names_at c x p)) (also c).

(** The list with s in place j. *)
Fixpoint put (j : nat) (s : R) (l : list R) : list R :=
  match l, j with
  | [], _ => []
  | _ :: l', O => s :: l'
  | x :: l', S j' => x :: put j' s l'
  end.

(** The derivatives of the equations by the unknowns exist, and their matrix is regular. *)
Definition regular_at (c : closure) (x p : list R) : Prop :=
  exists a : nat -> nat -> R,
    (forall i j, (i < unknowns c)%nat -> (j < unknowns c)%nat ->
       derivable_pt_lim (fun s => equation_at c x (put j s p) i) (nth j p 0) (a i j)) /\
    full_column_rank (unknowns c) (unknowns c) a.

(** Each number moves continuously. *)
Definition continuous_motion (m : R -> list R) : Prop :=
  forall k t, continuity_pt (fun t => nth k (m t) 0) t.

Definition the_start (c : closure) : list R := map (value []) (start c).

(** p is within the radii of the values at the start. *)
Definition is_near (c : closure) (p : list R) : Prop :=
  Forall2 (fun s u => Rabs (s - value [] (fst u)) <= value [] (snd u)) p (near c).

Definition start_defined (c : closure) : Prop :=
  Forall (defined []) (start c) /\
  Forall (fun u => defined [] (fst u) /\ defined [] (snd u)) (near c).

(** There is a configuration p x for each place x of a set. Everything has a value there, and the
    equations are regular. At the start it is the only configuration near the values that the model
    gives. However the mechanism moves in the set, p moves continuously, and a configuration that
    moves continuously is p all the time if it is p once. *)
Definition is_branch_among (among : list R -> Prop) (c : closure) (p : list R -> list R) : Prop :=
  (forall x, among x -> solves c x (p x) /\ has_values c x (p x) /\ regular_at c x (p x)) /\
  (forall q, solves c (the_start c) q /\ is_near c q <-> q = p (the_start c)) /\
  (forall m, continuous_motion m -> (forall t, among (m t)) ->
     continuous_motion (fun t => p (m t)) /\
     forall q, continuous_motion q -> (forall t, solves c (m t) (q t)) ->
       forall t0, q t0 = p (m t0) -> forall t, q t = p (m t)).

(** NO SINGULARITY of a closure: the same for each place of its set. *)
Definition is_branch (c : closure) : (list R -> list R) -> Prop :=
  is_branch_among (in_set (places c)) c.

(** The ends of the ranges and the start have values. *)
Definition is_given (c : closure) : Prop :=
  ends_defined (places c) /\ length (equations c) = unknowns c /\ start_defined c.

Definition one_branch (c : closure) : Prop := is_given c /\ exists p, is_branch c p.

(** ** All configurations at one place *)

(** A line of a list: the ends of an interval for each unknown. *)
Definition line := list (expression * expression).

(** Here [near] of the closure says where configurations are looked for: within the second number of
    the first one, for each unknown. *)
Definition is_searched (c : closure) (lines : list line) : Prop :=
  is_given c /\ length (near c) = unknowns c /\
  Forall (fun u => 0 < value [] (snd u)) (near c) /\
  Forall (Forall (fun ends => defined [] (fst ends) /\ defined [] (snd ends))) lines.

(** p is the only configuration within the line, it is where configurations are looked for,
    everything has a value there, and the equations are regular. *)
Definition is_the_one (c : closure) (x : list R) (l : line) (p : list R) : Prop :=
  Forall2 in_range p l /\ solves c x p /\ is_near c p /\ has_values c x p /\ regular_at c x p /\
  forall q, Forall2 in_range q l -> solves c x q -> q = p.

(** COMPLETE, and NONE if there are no lines: at each place x of the set, which means for all values
    of the uncertain quantities, there are as many configurations as lines, one within each. They
    differ, and they are all. *)
Definition all_solutions (c : closure) (lines : list line) : Prop :=
  is_searched c lines /\
  forall x, in_set (places c) x -> exists ps,
    NoDup ps /\ Forall2 (is_the_one c x) lines ps /\
    forall p, solves c x p /\ is_near c p <-> In p ps.

(** INCOMPLETE: there are at least these. *)
Definition some_solutions (c : closure) (lines : list line) : Prop :=
  is_searched c lines /\
  forall x, in_set (places c) x -> exists ps, NoDup ps /\ Forall2 (is_the_one c x) lines ps.

(** What is listed at a place: all configurations, or some of them. *)
Inductive listed := All_of (lines : list line) | Some_of (lines : list line).

(** Along way-points: at each place what [all_solutions] or [some_solutions] says of the mechanism
    with the numbers of this place. Nothing is said of the way between them. *)
Definition solutions_at (c : list expression -> closure)
    (places : list (list expression * listed)) : Prop :=
  Forall (fun place =>
    match snd place with
    | All_of lines => all_solutions (c (fst place)) lines
    | Some_of lines => some_solutions (c (fst place)) lines
    end) places.

(** ** Ways *)

(** The numbers of the pieces of a straight way: for each number a at a way-point that is b at the
    next one, a and b - a. *)
Fixpoint segment (a b : list expression) : list expression :=
  match a, b with
  | x :: a', y :: b' => x :: Subtract y x :: segment a' b'
  | _, _ => []
  end.

Fixpoint segments (way_points : list (list expression)) : list (list expression) :=
  match way_points with
  | a :: ((b :: _) as later) => segment a b :: segments later
  | _ => []
  end.

(** A way is a list of pieces. The first variable goes from 0 to 1 on each, and where a piece ends,
    the next one begins. A place x of the way has the variables of a piece but for the first number,
    which is between 0 and the number of pieces; on piece k, the first one being piece 0, it is k
    more than the first variable of the piece. *)
Definition on_piece (k : nat) (x : list R) : list R :=
  match x with [] => [] | u :: y => u - INR k :: y end.

(** The mechanism of piece k is c, and x is a place of its set. *)
Definition is_on (way : list closure) (x : list R) (k : nat) (c : closure) : Prop :=
  nth_error way k = Some c /\ in_set (places c) (on_piece k x).

(** The range of the first variable. *)
Definition goes_from_0_to_1 (c : closure) : Prop :=
  match ranges (places c) with
  | (a, b) :: _ => value [] a = 0 /\ value [] b = 1
  | [] => False
  end.

(** They have as many unknowns, the other variables have the same ranges, and where c ends and d
    begins, they have the same configurations. *)
Definition are_joined (c d : closure) : Prop :=
  unknowns c = unknowns d /\ tl (ranges (places c)) = tl (ranges (places d)) /\
  forall y p, S (length y) = length (ranges (places c)) ->
    solves c (1 :: y) p <-> solves d (0 :: y) p.

Fixpoint all_joined (way : list closure) : Prop :=
  match way with
  | c :: ((d :: _) as later) => are_joined c d /\ all_joined later
  | _ => True
  end.

Definition is_way (way : list closure) : Prop :=
  match way with [] => False | c :: _ => start_defined c end /\
  Forall (fun c => ends_defined (places c) /\ length (equations c) = unknowns c /\
                   goes_from_0_to_1 c) way /\
  all_joined way.

(** The same of a way as [is_branch_among] of a mechanism: [on x k c] says that x is on piece k,
    whose mechanism is c. The start is on the first piece, and a motion may go along the way from
    piece to piece. *)
Definition is_branch_along_among (on : list R -> nat -> closure -> Prop) (way : list closure)
    (p : list R -> list R) : Prop :=
  (forall x k c, on x k c -> let y := on_piece k x in
     solves c y (p x) /\ has_values c y (p x) /\ regular_at c y (p x)) /\
  match way with
  | [] => False
  | c :: _ => forall q, solves c (the_start c) q /\ is_near c q <-> q = p (the_start c)
  end /\
  (forall m, continuous_motion m -> (forall t, exists k c, on (m t) k c) ->
     continuous_motion (fun t => p (m t)) /\
     forall q, continuous_motion q ->
       (forall t k c, on (m t) k c -> solves c (on_piece k (m t)) (q t)) ->
       forall t0, q t0 = p (m t0) -> forall t, q t = p (m t)).

Definition is_branch_along (way : list closure) : (list R -> list R) -> Prop :=
  is_branch_along_among (is_on way) way.

(** NO SINGULARITY of a closure along a way, where c is the mechanism on each piece. *)
Definition one_branch_along (c : list expression -> closure) (pieces : list (list expression)) :
    Prop :=
  is_way (map c pieces) /\ exists p, is_branch_along (map c pieces) p.
