(* SPDX-License-Identifier: Apache-2.0 *)
(** Poses of a platform on six legs in space. A theorem of algebraic geometry says how many poses a
    platform can have if their numbers may be complex. Where so many are shown to be different and
    simple, there is no other; those whose numbers are real are the poses. *)
From Coquelicot Require Import Coquelicot.
From Coq Require Import Reals QArith Qreals Lra Lia List PArith Bool.
From Coq Require Import PrimFloat.
From Regulus Require Import Sizes.
From Regulus Require Import Expressions Intervals Forms Evaluation Boxes Hints Regularity.
From Regulus Require Import Derivatives LinearAlgebra Existence Questions Search Closures Tubes.
From Regulus Require Import Branches Solutions.
Import ListNotations.
Open Scope R_scope.

(** ** The claim *)

(** Real numbers, complex numbers, or others that can be added and multiplied. *)
Record kind := Kind {
  numbers : Type;
  nought : numbers;
  unity : numbers;
  plus : numbers -> numbers -> numbers;
  less : numbers -> numbers -> numbers;
  times : numbers -> numbers -> numbers }.

Definition reals : kind := Kind R 0%R 1%R Rplus Rminus Rmult.
Definition complexes : kind := Kind Complex.C (RtoC 0) (RtoC 1) Cplus Cminus Cmult.

Section Platform.
  Variable k : kind.
  Local Infix "+" := (plus k).
  Local Infix "-" := (less k).
  Local Infix "*" := (times k).

  Definition vector : Type := (numbers k * numbers k * numbers k)%type.

  Definition sum_of (u v : vector) : vector :=
    let '(a, b, c) := u in let '(d, e, f) := v in (a + d, b + e, c + f).
  Definition difference (u v : vector) : vector :=
    let '(a, b, c) := u in let '(d, e, f) := v in (a - d, b - e, c - f).
  Definition multiple (s : numbers k) (v : vector) : vector :=
    let '(a, b, c) := v in (s * a, s * b, s * c).
  Definition dot (u v : vector) : numbers k :=
    let '(a, b, c) := u in let '(d, e, f) := v in a * d + b * e + c * f.
  Definition cross (u v : vector) : vector :=
    let '(a, b, c) := u in let '(d, e, f) := v in (b * f - c * e, c * d - a * f, a * e - b * d).

  (** The anchor on the base, that on the platform in its own frame, and the squared length. *)
  Definition leg : Type := (vector * vector * numbers k)%type.
  Definition base (l : leg) : vector := fst (fst l).
  Definition anchor (l : leg) : vector := snd (fst l).
  Definition square (l : leg) : numbers k := snd l.

  (** Where the origin of the platform is, and the directions of two axes of its frame. That of the
      third axis is their cross product. *)
  Definition pose : Type := (vector * vector * vector)%type.

  (** Where the point b of the platform is. *)
  Definition moved (z : pose) (b : vector) : vector :=
    let '(p, u, v) := z in let '(b1, b2, b3) := b in
    sum_of (sum_of (sum_of p (multiple b1 u)) (multiple b2 v)) (multiple b3 (cross u v)).

  Definition along (z : pose) (l : leg) : vector := difference (moved z (anchor l)) (base l).

  (** What is 0 if the axes have the length 1 and are perpendicular, and each leg has its length. *)
  Definition errors (legs : list leg) (z : pose) : list (numbers k) :=
    let '(_, u, v) := z in
    dot u u - unity k :: dot v v - unity k :: dot u v
    :: map (fun l => dot (along z l) (along z l) - square l) legs.

  Definition is_pose (legs : list leg) (z : pose) : Prop :=
    Forall (fun e => e = nought k) (errors legs z).

  (** How fast the point b moves if the origin and the axes move with the velocities d. *)
  Definition velocity (z d : pose) (b : vector) : vector :=
    let '(_, u, v) := z in let '(p, u', v') := d in let '(b1, b2, b3) := b in
    sum_of (sum_of (sum_of p (multiple b1 u')) (multiple b2 v'))
      (multiple b3 (sum_of (cross u' v) (cross u v'))).

  (** How fast the errors change, some of them by half. *)
  Definition changes (legs : list leg) (z d : pose) : list (numbers k) :=
    let '(_, u, v) := z in let '(_, u', v') := d in
    dot u u' :: dot v v' :: dot u' v + dot u v'
    :: map (fun l => dot (along z l) (velocity z d (anchor l))) legs.

  Definition no_vector : vector := (nought k, nought k, nought k).

  (** No velocities but 0 leave all errors as they are: the pose is regular. *)
  Definition is_simple (legs : list leg) (z : pose) : Prop :=
    forall d, Forall (fun c => c = nought k) (changes legs z d) ->
      d = (no_vector, no_vector, no_vector).

  Definition numbers_of (z : pose) : list (numbers k) :=
    let '((a, b, c), (d, e, f), (g, h, i)) := z in [a; b; c; d; e; f; g; h; i].
  Definition numbers_of_leg (l : leg) : list (numbers k) :=
    let '((a, b, c), (d, e, f), g) := l in [a; b; c; d; e; f; g].
End Platform.

(** The same with other numbers. *)
Section Other_numbers.
  Variables (k k' : kind) (h : numbers k -> numbers k').
  Definition map_vector (v : vector k) : vector k' := let '(a, b, c) := v in (h a, h b, h c).
  Definition map_leg (l : leg k) : leg k' :=
    (map_vector (base k l), map_vector (anchor k l), h (square k l)).
  Definition map_pose (z : pose k) : pose k' :=
    let '(p, u, v) := z in (map_vector p, map_vector u, map_vector v).
End Other_numbers.

Definition complex_leg : leg reals -> leg complexes := map_leg reals complexes RtoC.
Definition complex_pose : pose reals -> pose complexes := map_pose reals complexes RtoC.

(** Of each platform of a family: if n poses differ and are simple, every pose, real or complex, is
    one of them. *)
Definition are_all (n : nat) (family : list (leg reals) -> Prop) : Prop :=
  forall (legs : list (leg reals)) (zs : list (pose complexes)),
    let same := map complex_leg legs in
    length legs = 6%nat -> family legs -> length zs = n -> NoDup zs ->
    Forall (fun z => is_pose complexes same z /\ is_simple complexes same z) zs ->
    forall z, is_pose complexes same z -> In z zs.

(** Ronga and Vust 1995, Lazard 1993, Mourrain 1993: six legs in general position have 40 complex
    poses. PROOF.md, "All poses", derives from this that 40 simple ones are all. *)
Definition forty_poses : Prop := are_all 40 (fun _ => True).

(** Legs in pairs: those of a pair have the same anchor on the platform, or all on the base. *)
Definition in_pairs (legs : list (leg reals)) : Prop :=
  match legs with
  | [a; b; c; d; e; f] =>
      (anchor reals a = anchor reals b /\ anchor reals c = anchor reals d /\
       anchor reals e = anchor reals f) \/
      (base reals a = base reals b /\ base reals c = base reals d /\ base reals e = base reals f)
  | _ => False
  end.

(** PROOF.md, "All poses", derives that legs in pairs have at most 16 simple poses, and that 16 are
    all. *)
Definition sixteen_poses : Prop := are_all 16 in_pairs.

(** The numbers of a leg, as a certificate writes them. *)
Definition written : kind :=
  Kind expression (Constant (0 # 1)) (Constant (1 # 1)) Add Subtract Multiply.

Definition legs_at (q : question) (legs : list (leg written)) (x : list R) : list (leg reals) :=
  map (map_leg written reals (value (extend x (definitions q)))) legs.

(** Every expression has a value. *)
Definition legs_defined (q : question) (legs : list (leg written)) (x : list R) : Prop :=
  let names := extend x (definitions q) in
  all_defined x (definitions q) /\ Forall (defined names) (also_defined q) /\
  Forall (fun l => Forall (defined names) (numbers_of_leg written l)) legs.

(** z is the only pose within the line, which has an interval for each number of a pose; it is
    simple. *)
Definition is_the_pose (legs : list (leg reals)) (l : line) (z : pose reals) : Prop :=
  Forall2 in_range (numbers_of reals z) l /\ is_pose reals legs z /\
  is_simple complexes (map complex_leg legs) (complex_pose z) /\
  forall y, Forall2 in_range (numbers_of reals y) l -> is_pose reals legs y -> y = z.

(** At each place x of the set, which means for all values of the uncertain quantities, there are as
    many poses as lines, one within each; they differ. *)
Definition has_poses (more : list (leg reals) -> list (pose reals) -> Prop) (q : question)
    (legs : list (leg written)) (lines : list line) : Prop :=
  ends_defined q /\ length legs = 6%nat /\
  Forall (Forall (fun ends => defined [] (fst ends) /\ defined [] (snd ends))) lines /\
  forall x, in_set q x -> legs_defined q legs x /\ exists zs,
    NoDup zs /\ Forall2 (is_the_pose (legs_at q legs x)) lines zs /\ more (legs_at q legs x) zs.

(** COMPLETE, and NONE if there are no lines: they are all. *)
Definition all_poses : question -> list (leg written) -> list line -> Prop :=
  has_poses (fun legs zs => forall z, is_pose reals legs z <-> In z zs).

(** INCOMPLETE: there are at least these. *)
Definition some_poses : question -> list (leg written) -> list line -> Prop :=
  has_poses (fun _ _ => True).

(** ** The check *)

(** The pose with these numbers. *)
Definition pose_with (k : kind) (f : nat -> numbers k) : pose k :=
  ((f 0%nat, f 1%nat, f 2%nat), (f 3%nat, f 4%nat, f 5%nat), (f 6%nat, f 7%nat, f 8%nat)).

Definition is_nought (e : expression) : bool :=
  match e with Constant (0 # 1) => true | _ => false end.

(** Complex numbers, as their real and imaginary parts are written. *)
Definition times_pair (a b : expression * expression) : expression * expression :=
  if is_nought (snd a) then (Multiply (fst a) (fst b), Multiply (fst a) (snd b))
  else (Subtract (Multiply (fst a) (fst b)) (Multiply (snd a) (snd b)),
        Add (Multiply (fst a) (snd b)) (Multiply (snd a) (fst b))).
Definition with_nought (e : expression) : expression * expression := (e, nought written).
Definition pairs : kind :=
  Kind (expression * expression) (with_nought (nought written)) (with_nought (unity written))
    (fun a b => (Add (fst a) (fst b), Add (snd a) (snd b)))
    (fun a b => (Subtract (fst a) (fst b), Subtract (snd a) (snd b))) times_pair.

Section Check.
  Variables (q : question) (legs : list (leg written)).

  Definition first_unknown : nat := (length (ranges q) + length (definitions q))%nat.

  Definition mechanism (n : nat) (es : list expression) : closure :=
    Closure (Question (ranges q) (definitions q) (constraints q)
               (also_defined q ++ flat_map (numbers_of_leg written) legs) [] 0)
      n [] es [] [] (repeat (Constant (0 # 1), Constant (2 ^ 100 # 1)) n).

  (** The unknowns are the numbers of a pose. *)
  Definition real_mechanism : closure :=
    mechanism 9 (errors written legs (pose_with written (fun i => Name (first_unknown + i)))).

  (** The unknowns are the real and the imaginary part of each number. *)
  Definition complex_mechanism : closure :=
    mechanism 18 (flat_map (fun e => [fst e; snd e])
      (errors pairs (map (map_leg written pairs with_nought) legs)
         (pose_with pairs (fun i =>
            (Name (first_unknown + 2 * i), Name (first_unknown + (2 * i + 1))))))).

  Variables (full : nat) (b : box).

  (** Tubes about a line may be so much wider: what is half as wide is tried next. *)
  Definition around_line (lb : box) : box :=
    map (fun i => multiply (subtract i i) (point 0x1p4%float)) lb.

  Definition check_pose (l : line) : option (box * tube) :=
    match enclose_ranges l, enclose_values (map fst (near real_mechanism)),
          enclose_values (map snd (near real_mechanism)) with
    | Some lb, Some middles, Some radii =>
        check_line real_mechanism full b (around_line lb) middles radii l
    | _, _, _ => None
    end.

  Fixpoint check_poses (lines : list line) : option (list (box * tube)) :=
    match lines with
    | [] => Some []
    | l :: later =>
        match check_pose l, check_poses later with
        | Some f, Some fs =>
            if forallb (fun g => boxes_apart (fst f) (fst g)) fs then Some (f :: fs) else None
        | _, _ => None
        end
    end.
End Check.

(** Where a root is that is not real: the parts of its numbers, and how far they may be off. Nothing
    is proved of the choice. *)
Definition root : Type := list F.type * list F.type.

Section Check_roots.
  Variables (c : closure) (full : nat) (b : box).
  Let n := unknowns c.

  Definition tube_at (r : root) (factor : F.type) : tube :=
    let zeros := map (fun _ => PrimFloat.zero) b in
    Tube zeros (fst r) (map (fun _ => zeros) (fst r)) (map (PrimFloat.mul factor) (snd r)).

  (** Where the one root in a tube is. *)
  Definition root_in (t : tube) : option box :=
    match test_tube c full t b with
    | Some v => Some (map (solution_range c full b t v) (seq 0 n))
    | None => None
    end.

  Fixpoint first_box (r : root) (factors : list F.type) : option box :=
    match factors with
    | [] => None
    | f :: later =>
        match root_in (tube_at r f) with
        | Some found => Some found
        | None =>
            let tilt := match b with
                        | [] => None
                        | _ => root_in (tilted c full b (tube_at r f))
                        end in
            match tilt with Some found => Some found | None => first_box r later end
        end
    end.

  Definition check_root (r : root) : option box :=
    first_box r [0x1p0; 0x1p-8; 0x1p8; 0x1p-4; 0x1p4; 0x1p-12; 0x1p12]%float.

  Fixpoint check_roots (roots : list root) : option (list box) :=
    match roots with
    | [] => Some []
    | r :: later =>
        match check_root r, check_roots later with
        | Some f, Some fs => Some (f :: fs)
        | _, _ => None
        end
    end.
End Check_roots.

Definition conjugate_box (l : box) : box :=
  map (fun i => let part := nth i l I.nai in if Nat.odd i then I.neg part else part)
    (seq 0 (length l)).

Fixpoint all_apart (l : list box) : bool :=
  match l with
  | [] => true
  | f :: later => forallb (boxes_apart f) later && all_apart later
  end.

Definition has_all_values (q : question) (legs : list (leg written)) (full : nat) (b : box) :
    bool :=
  let names := evaluate_definitions (variables full b) (definitions q) in
  forallb is_known names
  && forallb (fun e => is_known (evaluate names e)) (also_defined q)
  && forallb (fun l => forallb (fun e => is_known (evaluate names e)) (numbers_of_leg written l))
       legs.

Definition check_some_poses (q : question) (legs : list (leg written)) (w : method)
    (lines : list line) : bool :=
  let full := second_order w in
  match enclose_ranges (ranges q) with
  | Some b => Nat.eqb (length legs) 6 && has_all_values q legs full b
              && match check_poses q legs full b lines with Some _ => true | None => false end
  | None => false
  end.

Lemma same_expression (a b : expression) : {a = b} + {a <> b}.
Proof.
  decide equality; try apply Nat.eq_dec. decide equality; [apply Pos.eq_dec|apply Z.eq_dec].
Defined.

Definition same_vector (u v : vector written) : bool :=
  let '(a, b, c) := u in let '(d, e, f) := v in
  if same_expression a d then if same_expression b e then if same_expression c f then true
  else false else false else false.

Definition are_in_pairs (legs : list (leg written)) : bool :=
  match legs with
  | [a; b; c; d; e; f] =>
      let by_ (of : leg written -> vector written) :=
        same_vector (of a) (of b) && same_vector (of c) (of d) && same_vector (of e) (of f) in
      by_ (anchor written) || by_ (base written)
  | _ => false
  end.

(** There are n poses: each root that is not real stands for itself and its conjugate. *)
Definition check_count (n : nat) (q : question) (legs : list (leg written)) (w : method)
    (lines : list line) (roots : list root) : bool :=
  check_some_poses q legs w lines
  && Nat.eqb (length lines + 2 * length roots) n
  && match enclose_ranges (ranges q) with
     | Some b =>
         match check_roots (complex_mechanism q legs) (second_order w) b roots with
         | Some boxes => all_apart (boxes ++ map conjugate_box boxes)
         | None => false
         end
     | None => false
     end.

Definition check_forty_poses := check_count 40.
Definition check_sixteen_poses (q : question) (legs : list (leg written)) (w : method)
    (lines : list line) (roots : list root) : bool :=
  are_in_pairs legs && check_count 16 q legs w lines roots.

(** ** Steep equations: they change at least as much as the unknowns *)

Definition shifted (n : nat) (p : list R) (s : R) (w : nat -> R) : list R :=
  map (fun i => nth i p 0 + s * w i) (seq 0 n).

Definition is_steep (c : closure) (x p : list R) : Prop :=
  forall w,
    (forall i, (i < unknowns c)%nat -> exists m, forall s, 0 < s <= 1 ->
       Rabs (equation_at c x (shifted (unknowns c) p s w) i) <= m * s ^ 2) ->
    forall i, (i < unknowns c)%nat -> w i = 0.

Lemma soon_for_all n (P : nat -> R -> Prop) :
  (forall i, (i < n)%nat -> exists m, 0 < m /\ forall s, 0 < s <= m -> P i s) ->
  exists m, 0 < m /\ forall i, (i < n)%nat -> forall s, 0 < s <= m -> P i s.
Proof.
  induction n as [|n IH]; intros H.
  - exists 1. split; [lra|]. intros i I. lia.
  - destruct IH as (m & M & A); [intros i I; apply H; lia|].
    destruct (H n ltac:(lia)) as (m' & M' & A').
    exists (Rmin m m'). split; [apply Rmin_glb_lt; assumption|]. intros i I s [S1 S2].
    pose proof (Rmin_l m m'). pose proof (Rmin_r m m').
    destruct (Nat.eq_dec i n) as [->|N]; [apply A'; lra|apply A; [lia|lra]].
Qed.

Lemma sum_of_small n (k : nat -> R) (f : R -> nat -> R) :
  (forall l, (l < n)%nat -> exists m, forall s, 0 < s <= 1 -> Rabs (f s l) <= m * s ^ 2) ->
  exists m, forall s, 0 < s <= 1 -> Rabs (sum n (fun l => k l * f s l)) <= m * s ^ 2.
Proof.
  induction n as [|n IH]; intros H.
  - exists 0. intros s _. simpl. rewrite Rabs_R0. lra.
  - destruct IH as [m M]; [intros l L; apply H; lia|]. destruct (H n ltac:(lia)) as [m' M'].
    exists (m + Rabs (k n) * m'). intros s S. simpl sum. eapply Rle_trans; [apply Rabs_triang|].
    rewrite Rabs_mult. specialize (M s S). specialize (M' s S). pose proof (Rabs_pos (k n)). nra.
Qed.

Lemma steep_in_tube c full t b v x : test_tube c full t b = Some v -> in_box b x ->
  is_steep c x (tube_solution c t v x).
Proof.
  intros T B w H i I. set (n := unknowns c) in *. set (p := tube_solution c t v x) in *.
  destruct (Req_dec (w i) 0) as [Z|N]; [exact Z|]. exfalso.
  set (rest := fun i => reach_of t i - sum n (fun j => spread_of v i j * reach_of t j)).
  assert (Rest : forall i, (i < n)%nat -> 0 < rest i).
  { intros k K. pose proof (contracts_here c full t b v x T B k K). unfold rest, n. lra. }
  assert (Reach : 0 < reach_of t i).
  { destruct (solution_within c full t b v x T B i I) as (d & _ & D1 & D2).
    pose proof (Rabs_pos (nth i (tube_solution c t v x) 0 - axis t x i)). lra. }
  set (eta := Rabs (w i) / (2 * reach_of t i)).
  assert (Eta : 0 < eta).
  { apply Rdiv_lt_0_compat; [apply Rabs_pos_lt, N|lra]. }
  set (u := fun s k => nth k p 0 + s * w k - axis t x k).
  destruct (soon_for_all n (fun k s =>
    Rabs (u s k) <= reach_of t k /\
    Rabs (image n (error_at c t x) (inverse_of_middle v) (u s) k) <= s * eta * rest k))
    as (m & M & A).
  { intros k K. destruct (solution_within c full t b v x T B k K) as (d & _ & D1 & D2).
    destruct (sum_of_small n (inverse_of_middle v k) (fun s l => error_at c t x (u s) l))
      as [m' M'].
    { intros l L. destruct (H l L) as [m'' M'']. exists m''. intros s S.
      replace (error_at c t x (u s) l) with (equation_at c x (shifted n p s w) l); [auto|].
      unfold error_at. f_equal. apply map_ext. intros j. unfold u. ring. }
    set (big := Rabs m' + 1).
    assert (Big : 0 < big) by (unfold big; pose proof (Rabs_pos m'); lra).
    set (wide := Rabs (w k) + 1).
    assert (Wide : 0 < wide) by (unfold wide; pose proof (Rabs_pos (w k)); lra).
    pose proof (Rest k K) as Rk.
    exists (Rmin 1 (Rmin ((reach_of t k - d) / wide) (eta * rest k / big))).
    assert (Q1 : 0 < (reach_of t k - d) / wide) by (apply Rdiv_lt_0_compat; lra).
    assert (Q2 : 0 < eta * rest k / big).
    { apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat; assumption|exact Big]. }
    split; [repeat apply Rmin_glb_lt; lra|]. intros s [S1 S2].
    assert (S3 : s <= 1) by (eapply Rle_trans; [exact S2|apply Rmin_l]).
    assert (S4 : s <= (reach_of t k - d) / wide).
    { eapply Rle_trans; [exact S2|]. eapply Rle_trans; [apply Rmin_r|apply Rmin_l]. }
    assert (S5 : s <= eta * rest k / big).
    { eapply Rle_trans; [exact S2|]. eapply Rle_trans; [apply Rmin_r|apply Rmin_r]. }
    assert (S6 : s * wide <= reach_of t k - d).
    { apply (Rmult_le_compat_r wide) in S4; [|lra]. unfold Rdiv in S4.
      rewrite Rmult_assoc, Rinv_l, Rmult_1_r in S4 by lra. exact S4. }
    assert (S7 : s * big <= eta * rest k).
    { apply (Rmult_le_compat_r big) in S5; [|lra]. unfold Rdiv in S5.
      rewrite Rmult_assoc, Rinv_l, Rmult_1_r in S5 by lra. exact S5. }
    split.
    - unfold u. replace (nth k p 0 + s * w k - axis t x k)
        with ((nth k p 0 - axis t x k) + s * w k) by ring.
      eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_mult, (Rabs_right s) by lra.
      fold p in D1. assert (s * Rabs (w k) <= s * wide); [|lra].
      apply Rmult_le_compat_l; [lra|unfold wide; lra].
    - unfold image. eapply Rle_trans; [apply (M' s); lra|].
      assert (m' <= big) by (unfold big; pose proof (Rle_abs m'); lra).
      assert (m' * s ^ 2 <= big * s ^ 2) by (apply Rmult_le_compat_r; [nra|assumption]).
      assert (big * s ^ 2 = s * (s * big)) by ring.
      assert (s * (s * big) <= s * (eta * rest k)) by (apply Rmult_le_compat_l; lra). lra. }
  pose proof (near_tube_solution c full t b v x T B p (u m) (m * eta)
    (solution_in_tube c full t b v x T B) (tube_solution_solves c full t b v x T B)) as Near.
  fold n in Near.
  specialize (Near (fun k K => proj1 (A k K m ltac:(lra))) (fun k K => proj2 (A k K m ltac:(lra)))
    i I).
  unfold u in Near.
  replace (nth i p 0 - axis t x i - (nth i p 0 + m * w i - axis t x i)) with (- (m * w i))
    in Near by ring.
  rewrite Rabs_Ropp, Rabs_mult, (Rabs_right m) in Near by lra.
  assert (E : m * eta * reach_of t i = m * (Rabs (w i) / 2)) by (unfold eta; field; lra).
  rewrite E in Near. pose proof (Rabs_pos_lt _ N) as P.
  apply Rmult_le_reg_l in Near; lra.
Qed.

(** ** Other numbers *)

(** h keeps sums, differences and products. *)
Record keeps (k k' : kind) (h : numbers k -> numbers k') : Prop := Keeps {
  keeps_nought : h (nought k) = nought k';
  keeps_unity : h (unity k) = unity k';
  keeps_plus : forall a b, h (plus k a b) = plus k' (h a) (h b);
  keeps_less : forall a b, h (less k a b) = less k' (h a) (h b);
  keeps_times : forall a b, h (times k a b) = times k' (h a) (h b) }.

Ltac take_parts := repeat match goal with
  | v : vector _ |- _ => destruct v as [[? ?] ?]
  | v : pose _ |- _ => destruct v as [[? ?] ?]
  | v : leg _ |- _ => destruct v as [[? ?] ?]
  end.

Section Keeping.
  Variables (k k' : kind) (h : numbers k -> numbers k').
  Hypothesis H : keeps k k' h.

  Ltac push := repeat first
    [rewrite (keeps_plus _ _ _ H)|rewrite (keeps_less _ _ _ H)|rewrite (keeps_times _ _ _ H)
    |rewrite (keeps_unity _ _ _ H)|rewrite (keeps_nought _ _ _ H)].

  Lemma along_kept z l : map_vector k k' h (along k z l)
    = along k' (map_pose k k' h z) (map_leg k k' h l).
  Proof.
    take_parts. unfold along, map_leg, base, anchor, square. simpl. push. reflexivity.
  Qed.

  Lemma velocity_kept z d b : map_vector k k' h (velocity k z d b)
    = velocity k' (map_pose k k' h z) (map_pose k k' h d) (map_vector k k' h b).
  Proof. take_parts. simpl. push. reflexivity. Qed.

  Lemma dot_kept u v : h (dot k u v) = dot k' (map_vector k k' h u) (map_vector k k' h v).
  Proof. take_parts. simpl. push. reflexivity. Qed.

  Lemma errors_kept legs z : map h (errors k legs z)
    = errors k' (map (map_leg k k' h) legs) (map_pose k k' h z).
  Proof.
    unfold errors. destruct z as [[p u] v] eqn:Z. cbn [map_pose map].
    rewrite !(keeps_less _ _ _ H), !(keeps_unity _ _ _ H), !dot_kept. repeat f_equal.
    rewrite !map_map. apply map_ext. intros l.
    rewrite (keeps_less _ _ _ H), dot_kept, along_kept. reflexivity.
  Qed.

  Lemma changes_kept legs z d : map h (changes k legs z d)
    = changes k' (map (map_leg k k' h) legs) (map_pose k k' h z) (map_pose k k' h d).
  Proof.
    unfold changes. destruct z as [[p u] v] eqn:Z. destruct d as [[p' u'] v'] eqn:D.
    cbn [map_pose map]. rewrite !(keeps_plus _ _ _ H), !dot_kept. repeat f_equal.
    rewrite !map_map. apply map_ext. intros l.
    rewrite dot_kept, along_kept, velocity_kept. reflexivity.
  Qed.

  Lemma all_nought es : Forall (fun e => e = nought k) es ->
    Forall (fun e => e = nought k') (map h es).
  Proof.
    intros F. apply Forall_map. eapply Forall_impl; [|exact F]. intros e ->. apply H.
  Qed.

  Lemma pose_kept legs z : is_pose k legs z ->
    is_pose k' (map (map_leg k k' h) legs) (map_pose k k' h z).
  Proof. unfold is_pose. rewrite <- errors_kept. apply all_nought. Qed.
End Keeping.

Lemma conjugate_keeps : keeps complexes complexes Cconj.
Proof.
  split; intros; apply injective_projections; simpl; ring.
Qed.

Lemma real_keeps : keeps reals complexes RtoC.
Proof.
  split; intros; apply injective_projections; simpl; ring.
Qed.

Lemma value_keeps names : keeps written reals (value names).
Proof. split; simpl; intros; unfold Q2R; simpl; lra. Qed.

Definition pair_value (names : list R) (e : expression * expression) : Complex.C :=
  (value names (fst e), value names (snd e)).

Lemma is_nought_value names e : is_nought e = true -> value names e = 0.
Proof.
  destruct e as [[[|n|n] [d|d|]]| | | | | | | | | | | | | | |]; simpl; try discriminate.
  intros _. unfold Q2R. simpl. lra.
Qed.

Lemma pair_keeps names : keeps pairs complexes (pair_value names).
Proof.
  split; intros; unfold pair_value; simpl; unfold Q2R; simpl.
  - unfold RtoC. f_equal; lra.
  - unfold RtoC. f_equal; lra.
  - reflexivity.
  - unfold Cminus, Cplus, Copp. simpl. f_equal; ring.
  - unfold times_pair. destruct (is_nought (snd a)) eqn:N; simpl; [|reflexivity].
    rewrite (is_nought_value names _ N). unfold Cmult. simpl. f_equal; ring.
Qed.

(** ** Simple poses *)

Definition displaced (k : kind) (z : pose k) (s : numbers k) (d : pose k) : pose k :=
  let '(p, u, v) := z in let '(p', u', v') := d in
  (sum_of k p (multiple k s p'), sum_of k u (multiple k s u'), sum_of k v (multiple k s v')).

(** What is left of an error after a small displacement. *)
Definition is_small (f : R -> Complex.C) : Prop :=
  exists m, forall s, 0 < s <= 1 -> Cmod (f s) <= m * s ^ 2.

Lemma small_square (a b c : Complex.C) : is_small (fun s =>
  let s := RtoC s in (s * (s * (a + s * b + s * s * c)))%C).
Proof.
  exists (Cmod a + Cmod b + Cmod c). intros s [S1 S2]. cbv zeta. rewrite !Cmod_mult, Cmod_R.
  rewrite Rabs_right by lra.
  assert (Cmod (a + RtoC s * b + RtoC s * RtoC s * c)%C <= Cmod a + Cmod b + Cmod c).
  { eapply Rle_trans; [apply Cmod_triangle|].
    assert (Cmod (a + RtoC s * b)%C <= Cmod a + Cmod b).
    { eapply Rle_trans; [apply Cmod_triangle|]. rewrite Cmod_mult, Cmod_R, Rabs_right by lra.
      pose proof (Cmod_ge_0 b). nra. }
    rewrite !Cmod_mult, Cmod_R, Rabs_right by lra. pose proof (Cmod_ge_0 c).
    assert (s * s <= 1) by nra. assert (s * s * Cmod c <= 1 * Cmod c); [|lra].
    apply Rmult_le_compat_r; assumption. }
  replace ((Cmod a + Cmod b + Cmod c) * s ^ 2) with (s * (s * (Cmod a + Cmod b + Cmod c))) by ring.
  repeat (apply Rmult_le_compat_l; [lra|]). assumption.
Qed.

Lemma small_ext f g : (forall s, f s = g s) -> is_small g -> is_small f.
Proof. intros E [m M]. exists m. intros s S. rewrite E. auto. Qed.

(** The parts of the second order of an error. *)
Definition bend (z d : pose complexes) (b : vector complexes) : vector complexes :=
  let '(_, u', v') := d in let '(_, _, b3) := b in multiple complexes b3 (cross complexes u' v').

Lemma same_parts {A} (a b c d e f : A) : a = d -> b = e -> c = f -> (a, b, c) = (d, e, f).
Proof. intros -> -> ->. reflexivity. Qed.

Ltac complex_ring := match goal with |- @eq _ ?a ?b => change (@eq Complex.C a b) end; ring.

Lemma along_displaced z d s l : along complexes (displaced complexes z s d) l
  = sum_of complexes (along complexes z l)
      (multiple complexes s (sum_of complexes (velocity complexes z d (anchor complexes l))
        (multiple complexes s (bend z d (anchor complexes l))))).
Proof.
  take_parts. cbv [along displaced velocity bend anchor base moved sum_of multiple difference cross
    plus less times complexes fst snd]. apply same_parts; complex_ring.
Qed.

Lemma dot_displaced (a w y : vector complexes) (s : Complex.C) :
  dot complexes a w = RtoC 0 ->
  dot complexes
    (sum_of complexes a (multiple complexes s (sum_of complexes w (multiple complexes s y))))
    (sum_of complexes a (multiple complexes s (sum_of complexes w (multiple complexes s y))))
  = (dot complexes a a
     + s * (s * ((dot complexes w w + (1 + 1) * dot complexes a y)
                 + s * ((1 + 1) * dot complexes w y) + s * s * dot complexes y y)))%C.
Proof.
  intros O.
  transitivity (dot complexes a a + s * ((1 + 1) * dot complexes a w)
     + s * (s * ((dot complexes w w + (1 + 1) * dot complexes a y)
                 + s * ((1 + 1) * dot complexes w y) + s * s * dot complexes y y)))%C.
  - clear O. take_parts.
    cbv [dot sum_of multiple plus times complexes]. complex_ring.
  - rewrite O. complex_ring.
Qed.

Lemma errors_are_small legs z d : is_pose complexes legs z ->
  Forall (fun c => c = RtoC 0) (changes complexes legs z d) ->
  forall j, is_small (fun s =>
    nth j (errors complexes legs (displaced complexes z (RtoC s) d)) (RtoC 0)).
Proof.
  intros P C j. destruct z as [[p u] v] eqn:Z. destruct d as [[p' u'] v'] eqn:D.
  unfold is_pose in P. cbn [errors] in P. cbn [changes] in C.
  inversion P as [|? ? P1 P']. subst. inversion P' as [|? ? P2 P'']. subst.
  inversion P'' as [|? ? P3 P4]. subst. clear P P' P''.
  inversion C as [|? ? C1 C']. subst. inversion C' as [|? ? C2 C'']. subst.
  inversion C'' as [|? ? C3 C4]. subst. clear C C' C''.
  change (nought complexes) with (RtoC 0) in *.
  destruct j as [|[|[|j]]]; cbn [errors displaced nth].
  - apply (small_ext _ (fun s => let s := RtoC s in
      (s * (s * (dot complexes u' u' + s * 0 + s * s * 0)))%C)); [|apply small_square].
    intros s. cbv zeta.
    transitivity (dot complexes u u - 1 + RtoC s * ((1 + 1) * dot complexes u u')
      + RtoC s * (RtoC s * dot complexes u' u'))%C.
    { clear. take_parts. cbv [dot sum_of multiple plus less times unity complexes]. complex_ring. }
    change ((dot complexes u u - 1)%C = RtoC 0) in P1. rewrite P1, C1. complex_ring.
  - apply (small_ext _ (fun s => let s := RtoC s in
      (s * (s * (dot complexes v' v' + s * 0 + s * s * 0)))%C)); [|apply small_square].
    intros s. cbv zeta.
    transitivity (dot complexes v v - 1 + RtoC s * ((1 + 1) * dot complexes v v')
      + RtoC s * (RtoC s * dot complexes v' v'))%C.
    { clear. take_parts. cbv [dot sum_of multiple plus less times unity complexes]. complex_ring. }
    change ((dot complexes v v - 1)%C = RtoC 0) in P2. rewrite P2, C2. complex_ring.
  - apply (small_ext _ (fun s => let s := RtoC s in
      (s * (s * (dot complexes u' v' + s * 0 + s * s * 0)))%C)); [|apply small_square].
    intros s. cbv zeta.
    transitivity (dot complexes u v
      + RtoC s * (dot complexes u' v + dot complexes u v')
      + RtoC s * (RtoC s * dot complexes u' v'))%C.
    { clear. take_parts. cbv [dot sum_of multiple plus less times unity complexes]. complex_ring. }
    change ((dot complexes u' v + dot complexes u v')%C = RtoC 0) in C3.
    rewrite P3, C3. complex_ring.
  - set (z := ((p, u), v) : pose complexes) in *. set (d := ((p', u'), v') : pose complexes) in *.
    destruct (Nat.lt_ge_cases j (length legs)) as [J|J].
    + destruct legs as [|l0 legs'] eqn:E; [simpl in J; lia|]. rewrite <- E in *. clear E legs'.
      set (l := nth j legs l0).
      assert (I : In l legs) by (apply nth_In, J).
      rewrite Forall_forall in P4, C4.
      specialize (P4 _ (in_map _ _ _ I)). specialize (C4 _ (in_map _ _ _ I)). cbv beta in P4, C4.
      set (a := along complexes z l) in *.
      set (w := velocity complexes z d (anchor complexes l)) in *.
      set (y := bend z d (anchor complexes l)).
      apply (small_ext _ (fun s => let s := RtoC s in
        (s * (s * ((dot complexes w w + (1 + 1) * dot complexes a y)
                 + s * ((1 + 1) * dot complexes w y) + s * s * dot complexes y y)))%C));
        [|apply small_square].
      intros s. cbv zeta.
      set (g := fun l => less complexes
        (dot complexes (along complexes (displaced complexes z (RtoC s) d) l)
           (along complexes (displaced complexes z (RtoC s) d) l)) (square complexes l)).
      change (nth j (map g legs) (RtoC 0) = (RtoC s * (RtoC s * (dot complexes w w
        + (1 + 1) * dot complexes a y + RtoC s * ((1 + 1) * dot complexes w y)
        + RtoC s * RtoC s * dot complexes y y)))%C).
      rewrite (nth_indep _ _ (g l0)) by (rewrite map_size; exact J). rewrite map_nth. fold l.
      unfold g. rewrite along_displaced. fold a w y. rewrite (dot_displaced a w y _ C4).
      change (less complexes) with Cminus in *.
      transitivity ((dot complexes a a - square complexes l)
        + (RtoC s * (RtoC s * (dot complexes w w + (1 + 1) * dot complexes a y
        + RtoC s * ((1 + 1) * dot complexes w y) + RtoC s * RtoC s * dot complexes y y))))%C;
        [complex_ring|]. rewrite P4. complex_ring.
    + exists 0. intros s _. rewrite nth_overflow by (rewrite map_size; exact J).
      rewrite Cmod_0. lra.
Qed.

(** ** The mechanisms *)

Lemma value_before names more e : defined names e -> value (names ++ more) e = value names e.
Proof.
  induction e; simpl; intros D; try reflexivity; try (apply app_nth1; exact D);
    rewrite ?IHe by tauto; rewrite ?IHe1 by tauto; rewrite ?IHe2 by tauto; reflexivity.
Qed.

Lemma nth_of_pairs {A} (l : list (A * A)) d j : (j < length l)%nat ->
  nth (2 * j) (flat_map (fun e => [fst e; snd e]) l) d = fst (nth j l (d, d)) /\
  nth (2 * j + 1) (flat_map (fun e => [fst e; snd e]) l) d = snd (nth j l (d, d)).
Proof.
  revert j. induction l as [|a l IH]; intros j J; [simpl in J; lia|]. destruct j as [|j].
  - split; reflexivity.
  - replace (2 * S j)%nat with (S (S (2 * j))) by lia.
    replace (S (S (2 * j)) + 1)%nat with (S (S (2 * j + 1))) by lia. simpl in J.
    exact (IH j ltac:(lia)).
Qed.

Lemma length_of_pairs {A} (l : list (A * A)) :
  length (flat_map (fun e => [fst e; snd e]) l) = (2 * length l)%nat.
Proof. induction l; simpl in *; lia. Qed.

Section At_place.
  Variables (q : question) (legs : list (leg written)) (x : list R).
  Hypothesis size : length x = length (ranges q).
  Hypothesis six : length legs = 6%nat.
  Hypothesis values : legs_defined q legs x.
  Let names := extend x (definitions q).
  Let L := legs_at q legs x.

  Definition pose_of (p : list R) : pose reals := pose_with reals (fun i => nth i p 0).
  Definition complex_of (p : list R) : pose complexes :=
    pose_with complexes (fun i => (nth (2 * i) p 0, nth (2 * i + 1) p 0)).

  Lemma unknown_value p i : value (names ++ p) (Name (first_unknown q + i)) = nth i p 0.
  Proof.
    simpl. rewrite app_nth2; unfold names, first_unknown; rewrite extend_length, size; [|lia].
    f_equal. lia.
  Qed.

  Lemma leg_values p l : In l legs ->
    map_leg written reals (value (names ++ p)) l = map_leg written reals (value names) l.
  Proof.
    intros I. destruct values as (_ & _ & V). rewrite Forall_forall in V. specialize (V l I).
    fold names in V. take_parts. unfold map_leg, base, anchor, square. simpl in *.
    repeat match goal with F : Forall _ (_ :: _) |- _ => inversion F; subst; clear F end.
    rewrite !value_before by assumption. reflexivity.
  Qed.

  Lemma real_errors p : map (value (names ++ p)) (equations (real_mechanism q legs))
    = errors reals L (pose_of p).
  Proof.
    unfold real_mechanism, mechanism. cbn [equations].
    rewrite (errors_kept written reals _ (value_keeps (names ++ p))). f_equal.
    - apply map_ext_in, leg_values.
    - unfold pose_with, map_pose, map_vector, pose_of, pose_with.
      rewrite !unknown_value. reflexivity.
  Qed.

  Lemma complex_errors p : map (pair_value (names ++ p))
      (errors pairs (map (map_leg written pairs with_nought) legs) (pose_with pairs (fun i =>
         (Name (first_unknown q + 2 * i), Name (first_unknown q + (2 * i + 1))))))
    = errors complexes (map complex_leg L) (complex_of p).
  Proof.
    rewrite (errors_kept pairs complexes _ (pair_keeps (names ++ p))). f_equal.
    - unfold L, legs_at. rewrite !map_map. apply map_ext_in. intros l I. fold names.
      rewrite <- (leg_values p l I). take_parts.
      unfold complex_leg, map_leg, base, anchor, square, map_vector, pair_value, with_nought, RtoC.
      simpl. unfold Q2R. simpl. replace (0 * / 1) with 0 by lra. reflexivity.
    - unfold pose_with, map_pose, map_vector, complex_of, pose_with, pair_value.
      cbn [fst snd]. rewrite !unknown_value. reflexivity.
  Qed.

  Lemma real_equation p i : (i < 9)%nat ->
    equation_at (real_mechanism q legs) x p i = nth i (errors reals L (pose_of p)) 0.
  Proof.
    intros I. rewrite <- real_errors. unfold equation_at.
    change (names_at (real_mechanism q legs) x p) with (names ++ p).
    rewrite (nth_indep _ 0 (value (names ++ p) no_entry)).
    - rewrite map_nth. reflexivity.
    - rewrite map_size. unfold real_mechanism, mechanism. cbn [equations errors pose_with].
      cbn [length]. rewrite map_size, six. exact I.
  Qed.

  Lemma complex_equation p j : (j < 9)%nat ->
    let e := nth j (errors complexes (map complex_leg L) (complex_of p)) (RtoC 0) in
    equation_at (complex_mechanism q legs) x p (2 * j) = fst e /\
    equation_at (complex_mechanism q legs) x p (2 * j + 1) = snd e.
  Proof.
    intros J. rewrite <- complex_errors. unfold equation_at.
    change (names_at (complex_mechanism q legs) x p) with (names ++ p).
    unfold complex_mechanism, mechanism. cbn [equations].
    match goal with |- context [map (pair_value _) ?l] => set (es := l) end.
    assert (Le : length es = 9%nat).
    { unfold es. cbn [errors pose_with length]. rewrite map_size, map_size, six. reflexivity. }
    assert (Je : (j < length es)%nat) by (rewrite Le; exact J).
    destruct (nth_of_pairs es no_entry j) as [E1 E2].
    { exact Je. }
    rewrite E1, E2.
    rewrite (nth_indep _ (RtoC 0) (pair_value (names ++ p) (no_entry, no_entry)))
      by (rewrite map_size; exact Je).
    rewrite map_nth. split; reflexivity.
  Qed.

  Lemma errors_length k (l : list (leg k)) z : length (errors k l z) = (3 + length l)%nat.
  Proof. destruct z as [[a u] v]. simpl. rewrite map_size. reflexivity. Qed.

  Lemma all_are_nought {A} (l : list A) (d : A) : (forall i, (i < length l)%nat -> nth i l d = d) ->
    Forall (fun e => e = d) l.
  Proof.
    intros H. apply Forall_forall. intros e E. destruct (In_nth _ _ d E) as (i & I & <-). auto.
  Qed.

  Lemma nought_at {A} (l : list A) (d : A) i : Forall (fun e => e = d) l -> nth i l d = d.
  Proof.
    intros H. destruct (Nat.lt_ge_cases i (length l)) as [I|I]; [|apply nth_overflow, I].
    rewrite Forall_forall in H. apply H, nth_In, I.
  Qed.

  Lemma solves_real p : length p = 9%nat ->
    (solves (real_mechanism q legs) x p <-> is_pose reals L (pose_of p)).
  Proof.
    intros Lp. assert (LL : length L = 6%nat) by (unfold L, legs_at; rewrite map_size; exact six).
    split.
    - intros [_ H]. apply all_are_nought. rewrite errors_length, LL. intros i I.
      change (nought reals) with 0. rewrite <- real_equation by exact I. exact (H i I).
    - intros H. split; [exact Lp|]. intros i I. rewrite real_equation by exact I.
      apply nought_at. exact H.
  Qed.

  Lemma solves_complex p : solves (complex_mechanism q legs) x p ->
    is_pose complexes (map complex_leg L) (complex_of p).
  Proof.
    assert (LL : length L = 6%nat) by (unfold L, legs_at; rewrite map_size; exact six).
    intros [_ H]. apply all_are_nought. rewrite errors_length, map_size, LL. intros j J.
    destruct (complex_equation p j J) as [E1 E2].
    change (nought complexes) with (RtoC 0).
    apply injective_projections; [rewrite <- E1|rewrite <- E2]; apply H; simpl unknowns; lia.
  Qed.

  (** *** Steep equations are those of a simple pose *)

  Definition parts_of (d : pose complexes) (i : nat) : R :=
    let c := nth (Nat.div2 i) (numbers_of complexes d) (RtoC 0) in
    if Nat.even i then fst c else snd c.

  Lemma complex_of_parts d :
    pose_with complexes (fun i => (parts_of d (2 * i), parts_of d (2 * i + 1))) = d.
  Proof.
    destruct d as [[[[a b] c] [[e f] g]] [[h i] j]]. unfold pose_with, parts_of. simpl.
    rewrite <- !surjective_pairing. reflexivity.
  Qed.

  Lemma complex_of_shifted p s d : complex_of (shifted 18 p s (parts_of d))
    = displaced complexes (complex_of p) (RtoC s) d.
  Proof.
    rewrite <- (complex_of_parts d) at 2. unfold complex_of, pose_with.
    cbn [displaced]. cbv [sum_of multiple plus times complexes].
    apply same_parts; apply same_parts; apply injective_projections; simpl; ring.
  Qed.

  Lemma complex_pose_is_simple p : is_steep (complex_mechanism q legs) x p ->
    solves (complex_mechanism q legs) x p ->
    is_simple complexes (map complex_leg L) (complex_of p).
  Proof.
    intros St So d C. pose proof (solves_complex p So) as P.
    assert (Z : forall i, (i < 18)%nat -> parts_of d i = 0).
    { apply (St (parts_of d)). simpl unknowns. intros i I.
      destruct (errors_are_small _ _ d P C (Nat.div2 i)) as [m M]. exists m. intros s S.
      specialize (M s S). rewrite <- complex_of_shifted in M.
      eapply Rle_trans; [|exact M]. eapply Rle_trans; [|apply Rmax_Cmod].
      destruct (Nat.Even_or_Odd i) as [[j ->]|[j ->]].
      - rewrite Nat.div2_double. rewrite (proj1 (complex_equation _ j ltac:(lia))). apply Rmax_l.
      - replace (Nat.div2 (2 * j + 1)) with j
          by (rewrite Nat.add_1_r, Nat.div2_succ_double; reflexivity).
        rewrite (proj2 (complex_equation _ j ltac:(lia))). apply Rmax_r. }
    rewrite <- (complex_of_parts d). unfold pose_with, no_vector.
    rewrite !Z by lia. reflexivity.
  Qed.

  Lemma pose_of_shifted p s (d : pose reals) :
    pose_of (shifted 9 p s (fun i => nth i (numbers_of reals d) 0))
    = displaced reals (pose_of p) s d.
  Proof. destruct d as [[[[? ?] ?] [[? ?] ?]] [[? ?] ?]]. reflexivity. Qed.

  Lemma displaced_kept z s d : complex_pose (displaced reals z s d)
    = displaced complexes (complex_pose z) (RtoC s) (complex_pose d).
  Proof.
    take_parts. unfold complex_pose. cbv [map_pose displaced sum_of multiple map_vector].
    rewrite !(keeps_plus _ _ _ real_keeps), !(keeps_times _ _ _ real_keeps). reflexivity.
  Qed.

  (** Velocities that are real. *)
  Lemma no_real_velocity p (d : pose reals) : is_steep (real_mechanism q legs) x p ->
    solves (real_mechanism q legs) x p ->
    Forall (fun c => c = 0) (changes reals L (pose_of p) d) ->
    d = (no_vector reals, no_vector reals, no_vector reals).
  Proof.
    intros St So C. pose proof (proj1 (solves_real p (proj1 So)) So) as P.
    apply (pose_kept _ _ _ real_keeps) in P.
    apply (all_nought _ _ _ real_keeps) in C. rewrite (changes_kept _ _ _ real_keeps) in C.
    assert (Z : forall i, (i < 9)%nat -> nth i (numbers_of reals d) 0 = 0).
    { apply (St (fun i => nth i (numbers_of reals d) 0)). simpl unknowns. intros i I.
      destruct (errors_are_small _ _ _ P C i) as [m M]. exists m. intros s S. specialize (M s S).
      fold complex_pose in M. rewrite <- displaced_kept, <- pose_of_shifted in M.
      unfold complex_pose in M. rewrite <- (errors_kept _ _ _ real_keeps) in M.
      change (RtoC 0) with (RtoC (nought reals)) in M. rewrite map_nth in M.
      rewrite Cmod_R in M. rewrite real_equation by exact I. exact M. }
    destruct d as [[[[a b] c] [[e f] g]] [[h i] j]].
    pose proof (Z 0%nat ltac:(lia)). pose proof (Z 1%nat ltac:(lia)).
    pose proof (Z 2%nat ltac:(lia)). pose proof (Z 3%nat ltac:(lia)).
    pose proof (Z 4%nat ltac:(lia)). pose proof (Z 5%nat ltac:(lia)).
    pose proof (Z 6%nat ltac:(lia)). pose proof (Z 7%nat ltac:(lia)).
    pose proof (Z 8%nat ltac:(lia)).
    simpl in *. subst. reflexivity.
  Qed.
End At_place.

(** The real and the imaginary part of a velocity. *)
Section Part_of_velocity.
  Variable h : Complex.C -> R.
  Hypothesis h_plus : forall a b, h (a + b)%C = h a + h b.
  Hypothesis h_minus : forall a b, h (a - b)%C = h a - h b.
  Hypothesis h_left : forall a b, h (RtoC a * b)%C = a * h b.
  Hypothesis h_right : forall a b, h (a * RtoC b)%C = h a * b.

  Ltac push := repeat first [rewrite h_plus|rewrite h_minus|rewrite h_left|rewrite h_right].

  Lemma part_of_changes legs z d :
    map h (changes complexes (map complex_leg legs) (complex_pose z) d)
    = changes reals legs z (map_pose complexes reals h d).
  Proof.
    unfold changes. destruct z as [[p u] v] eqn:Z. destruct d as [[p' u'] v'] eqn:D.
    unfold complex_pose. cbn [map_pose map].
    assert (Left : forall a w, h (dot complexes (map_vector reals complexes RtoC a) w)
      = dot reals a (map_vector complexes reals h w)).
    { intros a w. take_parts. cbv [dot map_vector plus times complexes reals]. push. reflexivity. }
    assert (Right : forall a w, h (dot complexes w (map_vector reals complexes RtoC a))
      = dot reals (map_vector complexes reals h w) a).
    { intros a w. take_parts. cbv [dot map_vector plus times complexes reals]. push. reflexivity. }
    change (plus complexes) with Cplus. rewrite h_plus, !Left, Right.
    apply (f_equal (cons _)), (f_equal (cons _)), (f_equal (cons _)).
    rewrite !map_map. apply map_ext. intros l.
    change (complex_leg l) with (map_leg reals complexes RtoC l).
    replace (along complexes (map_vector reals complexes RtoC p, map_vector reals complexes RtoC u,
      map_vector reals complexes RtoC v) (map_leg reals complexes RtoC l))
      with (map_vector reals complexes RtoC (along reals (p, u, v) l))
      by (rewrite (along_kept _ _ _ real_keeps); reflexivity).
    rewrite Left. f_equal. clear Left Right Z D. take_parts.
    cbv [velocity map_vector map_leg anchor base square sum_of multiple cross plus times less
      complexes reals fst snd].
    apply same_parts; push; reflexivity.
  Qed.
End Part_of_velocity.

Lemma real_pose_is_simple q legs x p : length x = length (ranges q) -> length legs = 6%nat ->
  legs_defined q legs x -> is_steep (real_mechanism q legs) x p ->
  solves (real_mechanism q legs) x p ->
  is_simple complexes (map complex_leg (legs_at q legs x)) (complex_pose (pose_of p)).
Proof.
  intros Sx Sl V St So d C.
  assert (Part : forall h : Complex.C -> R, (forall a b, h (a + b)%C = h a + h b) ->
    (forall a b, h (a - b)%C = h a - h b) -> (forall a b, h (RtoC a * b)%C = a * h b) ->
    (forall a b, h (a * RtoC b)%C = h a * b) -> h (RtoC 0) = 0 ->
    map_pose complexes reals h d = (no_vector reals, no_vector reals, no_vector reals)).
  { intros h H1 H2 H3 H4 H5. apply (no_real_velocity q legs x Sx Sl V p _ St So).
    rewrite <- (part_of_changes h H1 H2 H3 H4). apply Forall_map.
    eapply Forall_impl; [|exact C]. intros c ->. exact H5. }
  pose proof (Part fst ltac:(intros; simpl; ring) ltac:(intros; simpl; ring)
    ltac:(intros; simpl; ring) ltac:(intros; simpl; ring) eq_refl) as Re.
  pose proof (Part snd ltac:(intros; simpl; ring) ltac:(intros; simpl; ring)
    ltac:(intros; simpl; ring) ltac:(intros; simpl; ring) eq_refl) as Im.
  clear Part C. take_parts.
  repeat match goal with c : numbers complexes |- _ => destruct c as [? ?] end.
  cbv [map_pose map_vector no_vector nought reals fst snd] in Re, Im.
  injection Re as ? ? ? ? ? ? ? ? ?. injection Im as ? ? ? ? ? ? ? ? ?. subst. reflexivity.
Qed.

(** ** The lists *)

Lemma same_length {A A'} (P : A -> A' -> Prop) l m : Forall2 P l m -> length l = length m.
Proof. intros F. induction F; simpl; congruence. Qed.

Lemma numbers_of_pose p : length p = 9%nat -> numbers_of reals (pose_of p) = p.
Proof.
  intros L. do 9 (destruct p as [|? p]; [discriminate|]). destruct p; [reflexivity|discriminate].
Qed.

Lemma pose_of_numbers z : pose_of (numbers_of reals z) = z.
Proof. destruct z as [[[[? ?] ?] [[? ?] ?]] [[? ?] ?]]. reflexivity. Qed.

Lemma length_of_numbers z : length (numbers_of reals z) = 9%nat.
Proof. destruct z as [[[[? ?] ?] [[? ?] ?]] [[? ?] ?]]. reflexivity. Qed.

Section Lists.
  Variables (q : question) (legs : list (leg written)) (full : nat) (b : box) (x : list R).
  Hypothesis B : in_box b x.
  Hypothesis size : length x = length (ranges q).
  Hypothesis six : length legs = 6%nat.
  Hypothesis values : legs_defined q legs x.
  Let L := legs_at q legs x.
  Let rm := real_mechanism q legs.
  Let cm := complex_mechanism q legs.

  Lemma check_line_steep root middles radii l f p :
    check_line rm full b root middles radii l = Some f ->
    in_box (fst f) p -> solves rm x p -> is_steep rm x p.
  Proof.
    unfold check_line. intros H P So.
    destruct (enclose_ranges l) as [lb|]; [|discriminate].
    destruct (enclose_values (map fst l)); [|discriminate].
    destruct (enclose_values (map snd l)); [|discriminate].
    destruct (find _ (narrow_tubes _ _ _ _)) as [s|]; [|discriminate].
    match type of H with match ?w with _ => _ end = _ =>
      destruct w as [t|] eqn:W; [|discriminate] end.
    injection H as <-. apply find_some in W as [_ W]. apply andb_prop in W as [W C].
    unfold is_tested in W. destruct (test_tube rm full t b) as [v|] eqn:T; [|discriminate].
    rewrite (only_solution rm full t b v x T B p (covers_correct rm full b x B t lb p C P) So).
    exact (steep_in_tube rm full t b v x T B).
  Qed.

  (** p is the pose of a line, in the box of the line. *)
  Definition is_found (f : box * tube) (p : list R) : Prop :=
    in_box (fst f) p /\ is_steep rm x p.

  Lemma check_pose_correct l f : check_pose q legs full b l = Some f ->
    exists p, is_the_one rm x l p /\ is_found f p.
  Proof.
    unfold check_pose. fold rm. intros H.
    destruct (enclose_ranges l) as [lb|]; [|discriminate].
    destruct (enclose_values (map fst (near rm))) as [middles|] eqn:M; [|discriminate].
    destruct (enclose_values (map snd (near rm))) as [radii|] eqn:D; [|discriminate].
    apply enclose_values_correct in M as [_ M]. apply enclose_values_correct in D as [_ D].
    destruct (line_correct rm full b x B _ middles radii eq_refl M D l f H) as (p & P & In_f & _).
    exists p. split; [exact P|split; [exact In_f|]].
    exact (check_line_steep _ _ _ _ _ _ H In_f (proj1 (proj2 P))).
  Qed.

  Lemma check_poses_correct lines : forall fs, check_poses q legs full b lines = Some fs ->
    exists ps, NoDup ps /\ Forall2 (is_the_one rm x) lines ps /\ Forall2 is_found fs ps.
  Proof.
    induction lines as [|l lines IH]; intros fs H; simpl in H.
    - injection H as <-. exists []. repeat constructor.
    - destruct (check_pose q legs full b l) as [f|] eqn:F; [|discriminate].
      destruct (check_poses q legs full b lines) as [gs|]; [|discriminate].
      destruct (forallb _ gs) eqn:A; [|discriminate]. injection H as <-.
      destruct (check_pose_correct l f F) as (p & P & Q).
      destruct (IH gs eq_refl) as (ps & N & Ps & G).
      exists (p :: ps). split; [|split; constructor; assumption]. constructor; [|exact N].
      intros I. rewrite forallb_forall in A. clear - A G I Q.
      induction G as [|g r gs rs K G IH]; [exact I|]. destruct I as [->|I].
      + refine (boxes_apart_correct _ _ p (A g _) (proj1 Q) (proj1 K)). left. reflexivity.
      + apply IH; [|exact I]. intros y Y. apply A. right. exact Y.
  Qed.

  (** A line of the theorem. *)
  Lemma the_pose l p : is_the_one rm x l p -> is_steep rm x p -> is_the_pose L l (pose_of p).
  Proof.
    intros (R & So & _ & _ & _ & One) St. pose proof (proj1 So) as Lp. simpl unknowns in Lp.
    split; [rewrite numbers_of_pose by exact Lp; exact R|].
    split; [exact (proj1 (solves_real q legs x size six values p Lp) So)|].
    split; [exact (real_pose_is_simple q legs x p size six values St So)|].
    intros y Ry Py. rewrite <- (pose_of_numbers y). f_equal. apply One; [exact Ry|].
    apply (solves_real q legs x size six values); [apply length_of_numbers|].
    rewrite pose_of_numbers. exact Py.
  Qed.

  Lemma the_poses lines fs ps : Forall2 (is_the_one rm x) lines ps -> Forall2 is_found fs ps ->
    Forall2 (is_the_pose L) lines (map pose_of ps).
  Proof.
    intros P. revert fs. induction P as [|l p lines ps H P IH]; intros fs F; simpl; [constructor|].
    inversion F as [|f ? gs ? Ff Fs]. subst. constructor; [|exact (IH gs Fs)].
    apply the_pose; [exact H|apply Ff].
  Qed.

  Lemma different_poses lines ps : Forall2 (is_the_one rm x) lines ps -> NoDup ps ->
    NoDup (map pose_of ps).
  Proof.
    intros P N. assert (Long : Forall (fun p => length p = 9%nat) ps).
    { clear N. induction P as [|l p lines ps H P IH]; constructor; [apply H|exact IH]. }
    clear P. induction N as [|p ps I N IH]; simpl; [constructor|].
    inversion Long as [|? ? Lp Ls]. subst. constructor; [|exact (IH Ls)].
    intros J. apply in_map_iff in J as (r & E & J). apply I.
    rewrite Forall_forall in Ls. rewrite <- (numbers_of_pose p Lp), <- E,
      (numbers_of_pose r (Ls r J)). exact J.
  Qed.

  (** *** Roots that are not real *)

  Definition is_root (f : box) (r : list R) : Prop :=
    in_box f r /\ length f = 18%nat /\ solves cm x r /\ is_steep cm x r.

  Lemma root_in_correct t f : root_in cm full b t = Some f -> exists r, is_root f r.
  Proof.
    unfold root_in. destruct (test_tube cm full t b) as [v|] eqn:T; [|discriminate].
    intros H. injection H as <-. exists (tube_solution cm t v x).
    pose proof (tube_solution_solves cm full t b v x T B) as So.
    split; [|split; [reflexivity|split; [exact So|exact (steep_in_tube cm full t b v x T B)]]].
    split; [rewrite (proj1 So); reflexivity|]. intros i.
    change (encloses (nth i (map (solution_range cm full b t v) (seq 0 18)) I.nai)
              (nth i (tube_solution cm t v x) 0)).
    destruct (Nat.lt_ge_cases i 18) as [I|I].
    - rewrite (nth_indep _ I.nai (solution_range cm full b t v 0))
        by (rewrite map_size, seq_size; exact I).
      rewrite (map_nth (solution_range cm full b t v)), seq_nth by exact I.
      exact (solution_range_encloses cm full b x B t v i T I).
    - rewrite (nth_overflow _ I.nai) by (rewrite map_size, seq_size; exact I).
      apply unknown_encloses.
  Qed.

  Lemma first_box_correct r factors f : first_box cm full b r factors = Some f ->
    exists p, is_root f p.
  Proof.
    induction factors as [|k factors IH]; simpl; [discriminate|].
    destruct (root_in cm full b (tube_at b r k)) as [g|] eqn:G.
    { intros [= <-]. exact (root_in_correct _ _ G). }
    set (tilt := match b with [] => None | _ :: _ =>
      root_in cm full b (tilted cm full b (tube_at b r k)) end).
    assert (Tilt : forall g, tilt = Some g ->
      root_in cm full b (tilted cm full b (tube_at b r k)) = Some g).
    { unfold tilt. clear. intros g H. destruct b; [discriminate|exact H]. }
    destruct tilt as [g|]; [|exact IH]. intros [= <-]. exact (root_in_correct _ _ (Tilt g eq_refl)).
  Qed.

  Lemma check_roots_correct roots : forall fs, check_roots cm full b roots = Some fs ->
    exists rs, Forall2 is_root fs rs.
  Proof.
    induction roots as [|r roots IH]; intros fs H; simpl in H.
    - injection H as <-. exists []. constructor.
    - destruct (check_root cm full b r) as [f|] eqn:F; [|discriminate].
      destruct (check_roots cm full b roots) as [gs|]; [|discriminate]. injection H as <-.
      destruct (first_box_correct _ _ _ F) as [p P]. destruct (IH gs eq_refl) as [rs Rs].
      exists (p :: rs). constructor; assumption.
  Qed.

  Definition conjugate (r : list R) : list R :=
    map (fun i => let part := nth i r 0 in if Nat.odd i then - part else part) (seq 0 (length r)).

  Lemma conjugate_in_box f r : in_box f r -> in_box (conjugate_box f) (conjugate r).
  Proof.
    intros [Lf F]. split.
    { unfold conjugate, conjugate_box. rewrite !map_size, !seq_size. exact Lf. }
    intros i. unfold conjugate, conjugate_box. destruct (Nat.lt_ge_cases i (length r)) as [I|I].
    - match goal with |- encloses (nth i (map ?g _) _) (nth i (map ?h _) _) =>
        rewrite (nth_indep _ I.nai (g 0%nat)) by (rewrite map_size, seq_size; lia);
        rewrite (nth_indep _ 0 (h 0%nat)) by (rewrite map_size, seq_size; lia);
        rewrite (map_nth g), (map_nth h), !seq_nth by lia end.
      simpl. destruct (Nat.odd i); [apply negate_encloses|]; apply F.
    - rewrite (nth_overflow _ I.nai) by (rewrite map_size, seq_size; lia).
      apply unknown_encloses.
  Qed.

  Lemma conjugate_length r : length (conjugate r) = length r.
  Proof. unfold conjugate. rewrite map_size, seq_size. reflexivity. Qed.

  Definition conjugate_pose : pose complexes -> pose complexes :=
    map_pose complexes complexes Cconj.

  Lemma complex_of_conjugate r : length r = 18%nat ->
    complex_of (conjugate r) = conjugate_pose (complex_of r).
  Proof. intros E. unfold conjugate. rewrite E. reflexivity. Qed.

  Lemma complex_of_injective r s : length r = 18%nat -> length s = 18%nat ->
    complex_of r = complex_of s -> r = s.
  Proof.
    intros Lr Ls H. do 18 (destruct r as [|? r]; [discriminate|]). destruct r; [|discriminate].
    do 18 (destruct s as [|? s]; [discriminate|]). destruct s; [|discriminate].
    cbv [complex_of pose_with nth Nat.mul Nat.add] in H. injection H. intros. subst. reflexivity.
  Qed.

  Lemma conjugate_twice z : conjugate_pose (conjugate_pose z) = z.
  Proof.
    assert (T : forall c, Cconj (Cconj c) = c).
    { intros [a i]. unfold Cconj. simpl. rewrite Ropp_involutive. reflexivity. }
    take_parts. unfold conjugate_pose. cbv [map_pose map_vector]. rewrite !T. reflexivity.
  Qed.

  Lemma conjugate_legs (l : list (leg reals)) :
    map (map_leg complexes complexes Cconj) (map complex_leg l) = map complex_leg l.
  Proof.
    rewrite map_map. apply map_ext. intros [[[[? ?] ?] [[? ?] ?]] ?].
    unfold complex_leg, map_leg, base, anchor, square, map_vector, Cconj, RtoC. simpl.
    rewrite !Ropp_0. reflexivity.
  Qed.

  Lemma conjugate_is_pose z : is_pose complexes (map complex_leg L) z ->
    is_pose complexes (map complex_leg L) (conjugate_pose z).
  Proof.
    intros H. rewrite <- (conjugate_legs L). exact (pose_kept _ _ _ conjugate_keeps _ _ H).
  Qed.

  Lemma conjugate_is_simple z : is_simple complexes (map complex_leg L) z ->
    is_simple complexes (map complex_leg L) (conjugate_pose z).
  Proof.
    intros S d C. apply (all_nought _ _ _ conjugate_keeps) in C.
    rewrite (changes_kept _ _ _ conjugate_keeps), conjugate_legs in C.
    fold (conjugate_pose (conjugate_pose z)) in C. rewrite conjugate_twice in C. apply S in C.
    rewrite <- (conjugate_twice d). change (map_pose complexes complexes Cconj d) with
      (conjugate_pose d) in C. rewrite C.
    unfold conjugate_pose, map_pose, no_vector, map_vector.
    rewrite !(keeps_nought _ _ _ conjugate_keeps). reflexivity.
  Qed.

  Lemma conjugate_of_real z : conjugate_pose (complex_pose z) = complex_pose z.
  Proof.
    take_parts. unfold conjugate_pose, complex_pose. cbv [map_pose map_vector].
    unfold Cconj, RtoC. simpl. rewrite !Ropp_0. reflexivity.
  Qed.

  Lemma complex_pose_injective y z : complex_pose y = complex_pose z -> y = z.
  Proof.
    take_parts. unfold complex_pose. cbv [map_pose map_vector]. unfold RtoC. intros H.
    injection H. intros. subst. reflexivity.
  Qed.

  Lemma all_apart_correct fs rs : all_apart fs = true -> Forall2 in_box fs rs -> NoDup rs.
  Proof.
    intros A F. induction F as [|f r fs rs H F IH]; [constructor|]. simpl in A.
    apply andb_prop in A as [A1 A2]. constructor; [|exact (IH A2)]. intros I.
    rewrite forallb_forall in A1. clear - A1 F I H.
    induction F as [|g s fs rs K F IH]; [exact I|]. destruct I as [->|I].
    - refine (boxes_apart_correct _ _ r (A1 g _) H K). left. reflexivity.
    - apply IH; [|exact I]. intros y Y. apply A1. right. exact Y.
  Qed.

  (** With the conjugates. *)
  Lemma all_roots fs rs : Forall2 is_root fs rs -> all_apart (fs ++ map conjugate_box fs) = true ->
    let zs := map complex_of (rs ++ map conjugate rs) in
    NoDup zs /\ length zs = (2 * length fs)%nat /\
    Forall (fun z => is_pose complexes (map complex_leg L) z /\
                     is_simple complexes (map complex_leg L) z) zs /\
    forall z, ~ In (complex_pose z) zs.
  Proof.
    intros F A zs.
    assert (Long : Forall (fun r => length r = 18%nat) rs).
    { clear A zs. induction F as [|f r fs rs H F IH]; constructor; [|exact IH].
      destruct H as ([E _] & E' & _). congruence. }
    assert (Long' : forall r, In r (rs ++ map conjugate rs) -> length r = 18%nat).
    { rewrite Forall_forall in Long. intros r I. apply in_app_or in I as [I|I]; [auto|].
      apply in_map_iff in I as (s & <- & I). rewrite conjugate_length. auto. }
    assert (N : NoDup (rs ++ map conjugate rs)).
    { apply (all_apart_correct _ _ A). apply Forall2_app.
      - clear - F B size six values. induction F as [|f r fs rs H F IH];
          constructor; [apply H|exact IH].
      - clear - F B size six values. induction F as [|f r fs rs H F IH]; constructor; [|exact IH].
        apply conjugate_in_box, H. }
    assert (P : forall r, In r rs -> is_pose complexes (map complex_leg L) (complex_of r) /\
      is_simple complexes (map complex_leg L) (complex_of r)).
    { clear - F B size six values. induction F as [|f r fs rs H F IH]; intros s [].
      - subst. destruct H as (_ & _ & So & St).
        split; [exact (solves_complex q legs x size six values s So)|].
        exact (complex_pose_is_simple q legs x size six values s St So).
      - auto. }
    split; [|split; [|split]].
    - unfold zs. clear - N Long'. induction N as [|r l I N IH]; simpl; [constructor|].
      constructor; [|apply IH; intros s S; apply Long'; right; exact S].
      intros J. apply in_map_iff in J as (s & E & J). apply I.
      rewrite <- (complex_of_injective s r); [exact J| | |exact E]; apply Long'; [right; exact J|].
      left. reflexivity.
    - unfold zs. rewrite map_size, app_size, map_size.
      assert (length fs = length rs) by (eapply same_length; exact F). lia.
    - apply Forall_forall. intros z Z. apply in_map_iff in Z as (r & <- & I).
      apply in_app_or in I as [I|I]; [exact (P r I)|]. apply in_map_iff in I as (s & <- & I).
      rewrite complex_of_conjugate by (rewrite Forall_forall in Long; auto).
      destruct (P s I). split; [apply conjugate_is_pose|apply conjugate_is_simple]; assumption.
    - intros z Z. apply in_map_iff in Z as (r & E & I).
      assert (S : exists s, In s rs /\ complex_of s = complex_pose z).
      { apply in_app_or in I as [I|I]; [eauto|]. apply in_map_iff in I as (s & <- & I).
        exists s. split; [exact I|].
        rewrite complex_of_conjugate in E by (rewrite Forall_forall in Long; auto).
        rewrite <- (conjugate_twice (complex_of s)), E. apply conjugate_of_real. }
      destruct S as (s & I' & E'). rewrite Forall_forall in Long.
      assert (C : conjugate s = s).
      { apply complex_of_injective; [rewrite conjugate_length; auto|auto|].
        rewrite complex_of_conjugate by auto. rewrite E'. apply conjugate_of_real. }
      apply in_split in I' as (l1 & l2 & ->).
      rewrite map_app in N. simpl in N. rewrite C in N.
      rewrite <- app_assoc in N. simpl in N. apply NoDup_remove_2 in N. apply N.
      apply in_or_app. right. apply in_or_app. right. apply in_or_app. right. left. reflexivity.
  Qed.
End Lists.

Lemma has_all_values_correct q legs full b x : has_all_values q legs full b = true ->
  in_box b x -> legs_defined q legs x.
Proof.
  unfold has_all_values. intros H B. apply andb_prop in H as [H H3].
  apply andb_prop in H as [H1 H2].
  pose proof (coordinate_in_unit_box b x B) as T.
  pose proof (variables_known full b x B) as V.
  pose proof (known_definitions (coordinate b x) (definitions q) _ _ T V) as K.
  split; [eapply definitions_are_defined; [exact T|exact V|exact H1]|].
  split; [eapply known_all_defined; [exact T|exact K|exact H2]|].
  rewrite forallb_forall in H3. apply Forall_forall. intros l I.
  eapply known_all_defined; [exact T|exact K|exact (H3 l I)].
Qed.

Lemma check_some_poses_found q legs w lines : check_some_poses q legs w lines = true ->
  ends_defined q /\ length legs = 6%nat /\
  Forall (Forall (fun ends => defined [] (fst ends) /\ defined [] (snd ends))) lines /\
  forall x, in_set q x -> legs_defined q legs x /\ exists zs,
    NoDup zs /\ Forall2 (is_the_pose (legs_at q legs x)) lines zs.
Proof.
  unfold check_some_poses. set (full := second_order w).
  destruct (enclose_ranges (ranges q)) as [b|] eqn:Rb; [|discriminate]. intros H.
  apply andb_prop in H as [H H3]. apply andb_prop in H as [H1 H2]. apply Nat.eqb_eq in H1.
  destruct (check_poses q legs full b lines) as [fs|] eqn:F; [|discriminate].
  split; [exact (enclose_ranges_defined q b Rb)|split; [exact H1|split]].
  - clear - F. revert fs F. induction lines as [|l lines IH]; intros fs F; [constructor|].
    simpl in F. destruct (check_pose q legs full b l) as [f|] eqn:P; [|discriminate].
    destruct (check_poses q legs full b lines) as [gs|]; [|discriminate].
    constructor; [|exact (IH gs eq_refl)]. unfold check_pose in P.
    destruct (enclose_ranges l) as [lb|] eqn:Z; [|discriminate].
    exact (enclose_ranges_defined (Question l [] [] [] [] 0) lb Z).
  - intros x X.
    assert (B : in_box b x) by (eapply enclose_ranges_correct; [exact Rb|apply X]).
    assert (S : length x = length (ranges q)) by (eapply same_length; apply X).
    pose proof (has_all_values_correct q legs full b x H2 B) as V. split; [exact V|].
    destruct (check_poses_correct q legs full b x B lines fs F) as (ps & N & P & G).
    exists (map pose_of ps). split; [eapply different_poses; eassumption|].
    eapply the_poses; eassumption.
Qed.

Lemma NoDup_app_of {A} (l m : list A) : NoDup l -> NoDup m -> (forall a, In a l -> ~ In a m) ->
  NoDup (l ++ m).
Proof.
  intros L M D. induction L as [|a l I L IH]; simpl; [exact M|]. constructor.
  - intros J. apply in_app_or in J as [J|J]; [contradiction|].
    apply (D a); [left; reflexivity|exact J].
  - apply IH. intros b B. apply D. right. exact B.
Qed.

Theorem check_some_poses_correct q legs w lines :
  check_some_poses q legs w lines = true -> some_poses q legs lines.
Proof.
  intros H. destruct (check_some_poses_found q legs w lines H) as (E & S & D & A).
  split; [exact E|split; [exact S|split; [exact D|]]]. intros x X.
  destruct (A x X) as (V & zs & N & F). split; [exact V|]. exists zs. auto.
Qed.

Lemma check_count_correct n (family : list (leg reals) -> Prop) q legs w lines roots :
  (forall x, family (legs_at q legs x)) -> check_count n q legs w lines roots = true ->
  are_all n family -> all_poses q legs lines.
Proof.
  unfold check_count. intros Fam H all. apply andb_prop in H as [H H3].
  apply andb_prop in H as [H1 H2]. apply Nat.eqb_eq in H2.
  destruct (check_some_poses_found q legs w lines H1) as (E & S & D & A).
  split; [exact E|split; [exact S|split; [exact D|]]]. intros x X.
  destruct (A x X) as (V & zs & N & F). split; [exact V|]. exists zs. split; [exact N|].
  split; [exact F|].
  destruct (enclose_ranges (ranges q)) as [b|] eqn:Rb; [|discriminate].
  destruct (check_roots (complex_mechanism q legs) (second_order w) b roots) as [fs|] eqn:Fs;
    [|discriminate].
  assert (B : in_box b x) by (eapply enclose_ranges_correct; [exact Rb|apply X]).
  assert (Sx : length x = length (ranges q)) by (eapply same_length; apply X).
  destruct (check_roots_correct q legs (second_order w) b x B roots fs Fs) as [rs Rs].
  destruct (all_roots q legs x Sx S V fs rs Rs H3) as (N' & Ln & Ps & Not_real).
  set (cs := map complex_of (rs ++ map conjugate rs)) in *.
  set (L := legs_at q legs x) in *.
  assert (Lf : length fs = length roots).
  { clear - Fs. revert fs Fs. induction roots as [|r roots IH]; intros fs Fs; simpl in Fs.
    - injection Fs as <-. reflexivity.
    - destruct (check_root _ _ _ r); [|discriminate].
      destruct (check_roots _ _ _ roots) as [gs|]; [|discriminate]. injection Fs as <-.
      simpl. f_equal. exact (IH gs eq_refl). }
  assert (Lz : length zs = length lines) by (symmetry; eapply same_length; exact F).
  assert (In_zs : forall z, In z zs -> is_pose reals L z /\
    is_simple complexes (map complex_leg L) (complex_pose z)).
  { clear - F. induction F as [|l y lines zs H F IH]; intros z [].
    - subst. destruct H as (_ & P & Si & _). auto.
    - auto. }
  intros z. split; [|intros I; apply In_zs, I]. intros P.
  assert (C : In (complex_pose z) (map complex_pose zs ++ cs)).
  { apply (all L).
    - unfold L, legs_at. rewrite map_size. exact S.
    - apply Fam.
    - rewrite app_size, map_size. lia.
    - apply NoDup_app_of; [| exact N' |].
      + clear - N. induction N as [|y l I N IH]; simpl; [constructor|]. constructor; [|exact IH].
        intros J. apply in_map_iff in J as (s & E & J). apply complex_pose_injective in E.
        subst. contradiction.
      + intros c I. apply in_map_iff in I as (y & <- & _). apply Not_real.
    - apply Forall_app. split; [|exact Ps]. apply Forall_map, Forall_forall. intros y I.
      destruct (In_zs y I) as [Py Sy]. split; [|exact Sy].
      exact (pose_kept _ _ _ real_keeps L y Py).
    - exact (pose_kept _ _ _ real_keeps L z P). }
  apply in_app_or in C as [C|C]; [|destruct (Not_real z C)].
  apply in_map_iff in C as (y & Ey & I). apply complex_pose_injective in Ey. subst. exact I.
Qed.

Theorem check_forty_poses_correct q legs w lines roots :
  check_forty_poses q legs w lines roots = true -> forty_poses -> all_poses q legs lines.
Proof. apply check_count_correct. intros x. exact Logic.I. Qed.

Lemma same_vector_correct u v : same_vector u v = true -> u = v.
Proof.
  destruct u as [[a b] c], v as [[d e] f]. unfold same_vector.
  destruct (same_expression a d) as [->|]; [|discriminate].
  destruct (same_expression b e) as [->|]; [|discriminate].
  destruct (same_expression c f) as [->|]; [|discriminate]. reflexivity.
Qed.

Lemma are_in_pairs_correct q legs x : are_in_pairs legs = true -> in_pairs (legs_at q legs x).
Proof.
  unfold are_in_pairs. do 6 (destruct legs as [|? legs]; [discriminate|]).
  destruct legs; [|discriminate]. intros H. unfold legs_at, in_pairs. cbn [map].
  apply orb_prop in H as [H|H]; [left|right]; apply andb_prop in H as [H H3];
    apply andb_prop in H as [H1 H2]; apply same_vector_correct in H1, H2, H3;
    unfold map_leg, anchor, base in *; cbn [fst snd] in *; rewrite H1, H2, H3; auto.
Qed.

Theorem check_sixteen_poses_correct q legs w lines roots :
  check_sixteen_poses q legs w lines roots = true -> sixteen_poses -> all_poses q legs lines.
Proof.
  unfold check_sixteen_poses. intros H. apply andb_prop in H as [P H].
  apply (check_count_correct 16 in_pairs q legs w lines roots); [|exact H].
  intros x. apply are_in_pairs_correct, P.
Qed.
