(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** Quantities over the branch of a closure, whose values are known by hand: what is false is refused,
    and what is true next to it is proved. *)
From Coq Require Import List.
From Coq Require Import PrimFloat.
From Regulus Require Import Expressions Questions Search Closures Tubes Branches Rates.
From Regulus Require Import Notations.
Import ListNotations.

Definition x := Name 0.
Definition p := Name 1.
Definition the_method := Method 1 6.
Definition lower : tubes := (Held (Tube [0] [1] [[0x1p-1]] [0x1p-4]))%float.
Definition upper : tubes := (Held (Tube [0x1p-3] [0x1.0fp+0] [[0x1.ep-2]] [0x1p-6]))%float.
Definition the_tubes := Cut 0 0%float lower upper.

(** p^2 = x + 1 for x in [-1/4, 1/4]. J = dp/dx = 1/(2p) is in [0.44721, 0.57736]. *)
Definition slider (e : expression) : closure :=
  Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 1 [] [e] [] [0] [(1, 1/2)].
Definition the_slider := slider (p^2 - x - 1).
Definition motor : list nat := [0]%nat.

Definition measured_by (which : side) (c : closure) (motors : list nat) (q : measured)
    (s : vectors) (limit : expression) : bool :=
  check_measure which c motors q s limit the_method the_tubes.

(** The load is in [1, 3] by its spread, or by two balls, or by both: J w is in [0.44721, 1.73206]. *)
Definition by_spread := Vectors [(2, 1)] [].
Definition by_balls := Vectors [(2, 0)] [(1/2, [0]%nat); (1/2, [0; 5]%nat)].
Definition by_both := Vectors [(2, 1/2)] [(1/2, [0]%nat); (100, [1]%nat)].
Definition loads := [by_spread; by_balls; by_both].

Goal map (fun s => (measured_by Within the_slider motor (Force 0) s 1.74,
                    measured_by Below the_slider motor (Force 0) s 1.74,
                    measured_by Above the_slider motor (Force 0) s 0.44)) loads =
  map (fun _ => (true, true, true)) loads.
Proof. vm_compute. reflexivity. Qed.

Goal map (fun s => (measured_by Within the_slider motor (Force 0) s 1.73,
                    measured_by Below the_slider motor (Force 0) s 1.73,
                    measured_by Above the_slider motor (Force 0) s 0.45)) loads =
  map (fun _ => (false, false, false)) loads.
Proof. vm_compute. reflexivity. Qed.

(** The load pulls the other way: J w is in [-1.73206, -0.44721]. *)
Definition pulling := Vectors [(-2, 1)] [].
Goal (measured_by Within the_slider motor (Force 0) pulling 1.74,
      measured_by Below the_slider motor (Force 0) pulling (-0.44),
      measured_by Above the_slider motor (Force 0) pulling (-1.74)) = (true, true, true).
Proof. vm_compute. reflexivity. Qed.
Goal (measured_by Within the_slider motor (Force 0) pulling 1.73,
      measured_by Below the_slider motor (Force 0) pulling (-0.45),
      measured_by Above the_slider motor (Force 0) pulling (-1.73)) = (false, false, false).
Proof. vm_compute. reflexivity. Qed.

(** The motor moves by up to 1/10: p moves by up to 0.0577351. *)
Definition step := Vectors [(0, 1/10)] [].
Goal (measured_by Within the_slider motor (Motion 0) step 0.058,
      measured_by Within the_slider motor (Motion 0) step 0.0577) = (true, false).
Proof. vm_compute. reflexivity. Qed.

(** Motors and unknowns that are not there; a component too many; values that are none. *)
Goal [measured_by Within the_slider motor (Force 1) by_spread 9;
      measured_by Within the_slider motor (Motion 1) step 9;
      measured_by Within the_slider [] (Force 0) by_spread 9;
      measured_by Within the_slider [1]%nat (Force 0) by_spread 9;
      measured_by Within the_slider motor (Force 0) (Vectors [] []) 9;
      measured_by Within the_slider motor (Force 0) (Vectors [(2, 1); (0, 0)] []) 9;
      measured_by Within the_slider motor (Force 0) (Vectors [(1/0, 1)] []) 9;
      measured_by Within the_slider motor (Force 0) (Vectors [(2, sqrt (-1))] []) 9;
      measured_by Within the_slider motor (Force 0) (Vectors [(2, 1)] [(1/0, []%nat)]) 9;
      measured_by Within the_slider motor (Force 0) by_spread (1/0)] = repeat false 10.
Proof. vm_compute. reflexivity. Qed.

(** One tube is widened and halved until it holds. No branch, no bound: nothing is held; both roots meet
    at x = -1/4; a root has no value. *)
Goal [check_measure Within the_slider motor (Force 0) by_spread 9 the_method lower;
      check_measure Within the_slider motor (Force 0) by_spread 9 the_method Excluded;
      measured_by Within (slider (p^2 - 4*x - 1)) motor (Force 0) by_spread 1e9;
      measured_by Within (slider (p^2 - x - 1 + 0*sqrt(x))) motor (Force 0) by_spread 9] =
  [true; false; false; false].
Proof. vm_compute. reflexivity. Qed.

(** The motor moves a definition that a later one uses: q = 2 x + 1/x' with x' = x + 2, p^2 = q + 1/2,
    so that p = 1 and J = (2 - 1/4)/2 = 7/8 at x = 0. The range is hardly more than that place. *)
Definition chain (l : expression) : closure :=
  Closure (Question [(-l, l)] [Name 0 + 2; 2*Name 0 + 1/Name 1] [] [1/Name 1] [] 0) 1
    [Name 3 * Name 3] [Name 4 - Name 2 - 1/2] [] [0] [(1, 1/2)].
Definition of_chain : tubes := (Held (Tube [0] [1] [[0x1.cp-1]] [0x1p-8]))%float.
Goal (check_measure Within (chain 1e-6) motor (Motion 0) (Vectors [(1, 0)] []) 0.8751 the_method
        of_chain,
      check_measure Above (chain 1e-6) motor (Motion 0) (Vectors [(1, 0)] []) 0.8749 the_method
        of_chain,
      check_measure Within (chain 1e-6) motor (Motion 0) (Vectors [(1, 0)] []) 0.8749 the_method
        of_chain) = (true, true, false).
Proof. vm_compute. reflexivity. Qed.

(** Limits of the force of each motor. *)
Definition within (load : vectors) (limits : list (expression * expression)) : bool :=
  check_branch_within_limits the_slider motor load limits the_method the_tubes.
Goal [within by_spread [(0.44, 1.74)]; within by_balls [(0.44, 1.74)];
      within pulling [(-1.74, -0.44)]] = [true; true; true].
Proof. vm_compute. reflexivity. Qed.
Goal [within by_spread [(0.45, 1.74)]; within by_spread [(0.44, 1.73)]; within by_both [(0.45, 2)];
      within pulling [(0.44, 1.74)]; within by_spread []; within by_spread [(0, 2); (0, 2)];
      within by_spread [(2, 0)]; within by_spread [(0, 1/0)]] = repeat false 8.
Proof. vm_compute. reflexivity. Qed.
