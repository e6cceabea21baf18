(* SPDX-License-Identifier: GPL-3.0-or-later *)
(** Lists of configurations that are known by hand: what is false is refused, and what is true next
    to it is proved. *)
From Coq Require Import Reals Qreals Lra Lia List.
From Coq Require Import PrimFloat.
From Regulus Require Import Expressions Questions Search Closures Tubes Branches Solutions.
From Regulus Require Import Notations.
Import ListNotations.

Definition x := Name 0.
Definition p := Name 1.

(** p² = x + 1 for x from l to 1/4, where p is looked for within r of c. *)
Definition roots (l c r : expression) (also : list expression) (e : expression) : closure :=
  Closure (Question [(l, 1/4)] [] [] [] [] 0) 1 [] [e] also [0] [(c, r)].
Definition both := roots (-1/4) 0 2 [] (p^2 - x - 1).
(** ±√(3/4) = ±0.8660…, ±√(5/4) = ±1.1180… *)
Definition positive : line := [(0.85, 1.135)].
Definition negative : line := [(-1.135, -0.85)].

Definition is_all (c : closure) (lines : list line) := check_all_solutions c (Method 2 60) lines.
Definition are_some (c : closure) (lines : list line) := check_some_solutions c (Method 2 60) lines.

Theorem both_roots : all_solutions both [negative; positive].
Proof. apply (check_all_solutions_correct _ (Method 2 60)). vm_compute. reflexivity. Qed.

(** One is missing, one is twice there, or both are in one line. *)
Goal map (is_all both) [[positive]; [negative]; []; [positive; positive]; [[(-1.135, 1.135)]];
  [positive; [(0.849, 1.14)]; negative]] = [false; false; false; false; false; false].
Proof. vm_compute. reflexivity. Qed.
Goal map (are_some both) [[positive]; [negative]; []; [positive; negative];
  [positive; [(0.849, 1.14)]]; [[(-1.135, 1.135)]]] = [true; true; true; true; false; false].
Proof. vm_compute. reflexivity. Qed.
(** Where only one of them is looked for. *)
Goal map (is_all (roots (-1/4) 1 (1/2) [] (p^2 - x - 1))) [[positive]; [negative; positive]; []]
  = [true; false; false].
Proof. vm_compute. reflexivity. Qed.
(** A line that does not hold the root for all x, one without a root, one without a width, one
    without an end, and one with an end too many. *)
Goal map (fun l => are_some both [l]) [[(0.867, 1.135)]; [(0.85, 1.118)]; [(1.2, 1.3)]; [(1, 1)];
  [(0.85, 1/0)]; []; [(0.85, 1.135); (0, 1)]] = [false; false; false; false; false; false; false].
Proof. vm_compute. reflexivity. Qed.
(** A root at an end of the range may be beyond it. *)
Goal map (fun r => is_all (roots (-1/4) 0 r [] (p^2 - x - 1)) [negative; positive]) [1.14; 1.1]
  = [true; false].
Proof. vm_compute. reflexivity. Qed.

(** At x = -1 both roots meet; beyond there is none. *)
Goal is_all (roots (-1) 0 2 [] (p^2 - x - 1)) [negative; positive] = false.
Proof. vm_compute. reflexivity. Qed.
Goal are_some (roots (-1/4) 0 2 [] (p^2)) [[(-0.1, 0.1)]] = false.
Proof. vm_compute. reflexivity. Qed.
Goal is_all (roots (-1/4) 0 2 [] (p^2 - x - 1)) [] = false.
Proof. vm_compute. reflexivity. Qed.
Theorem none : all_solutions (roots (-1/4) 0 2 [] (p^2 - x + 1)) [].
Proof. apply (check_all_solutions_correct _ (Method 2 60)). vm_compute. reflexivity. Qed.

(** 1/(p - 1) has no value at x = 0, and 1/(p - 3) has one everywhere. *)
Goal map (fun e => is_all (roots (-1/4) 0 2 [e] (p^2 - x - 1)) [negative; positive])
  [1/(p - 1); 1/(p - 3)] = [false; true].
Proof. vm_compute. reflexivity. Qed.
(** An equation without a value in a part of the range decides nothing there. *)
Goal is_all (roots (-1/4) 0 2 [] (p^2 - x - 1 + 0*sqrt(p))) [negative; positive] = false.
Proof. vm_compute. reflexivity. Qed.

(** The ranges of the unknowns: as many as unknowns, with a radius that is positive. *)
Definition ranged (near : list (expression * expression)) : closure :=
  Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 1 [] [p^2 - x - 1] [] [0] near.
Goal map (fun near => is_all (ranged near) []) [[]; [(0, -1)]; [(0, 0)]; [(0, 1/0)]; [(1/2, 0.1)]]
  = [false; false; false; false; true].
Proof. vm_compute. reflexivity. Qed.
(** As many equations as unknowns. *)
Goal map (fun e => is_all (Closure (Question [(-1/4, 1/4)] [] [] [] [] 0) 1 [] e [] [0] [(0, 2)])
                     [negative; positive])
  [[p^2 - x - 1]; []; [p^2 - x - 1; p^2 - x - 1]] = [true; false; false].
Proof. vm_compute. reflexivity. Qed.

(** ** The claims mean what they say: without any check *)

Open Scope R_scope.

Lemma root_solves (s : R) : s * s = 1 -> solves both [0] [s] /\ is_near both [s].
Proof.
  intros S. assert (-1 <= s <= 1) by (split; nra). split.
  - split; [reflexivity|]. intros [|i] I; [|simpl in I; lia].
    unfold equation_at, names_at, both, roots, Q2R. simpl. unfold Q2R. simpl. lra.
  - constructor; [|constructor]. simpl. unfold Q2R. simpl. apply Rabs_le. lra.
Qed.

Lemma zero_in_set : in_set (places both) [0].
Proof.
  split; [|intros e []]. constructor; [|constructor]. unfold in_range. simpl.
  unfold Q2R. simpl. lra.
Qed.

(** A list with one root is not all. *)
Theorem one_is_missing : forall l, ~ all_solutions both [l].
Proof.
  intros l [_ H]. destruct (H [0] zero_in_set) as (ps & _ & F & A).
  destruct (root_solves 1 ltac:(lra)) as [S1 N1]. destruct (root_solves (-1) ltac:(lra)) as [S2 N2].
  inversion F as [|? q ? qs _ G E1 E2]. subst. inversion G. subst.
  destruct (proj1 (A [1]) (conj S1 N1)) as [E|[]].
  destruct (proj1 (A [-1]) (conj S2 N2)) as [E'|[]].
  rewrite E in E'. injection E'. lra.
Qed.

(** What [both_roots] says of x = 0. *)
Theorem roots_of_1 : forall s, s * s = 1 -> -1.135 <= s <= -0.85 \/ 0.85 <= s <= 1.135.
Proof.
  intros s S. destruct (proj2 both_roots [0] zero_in_set) as (ps & _ & F & A).
  pose proof (proj1 (A [s]) (root_solves s S)) as I.
  inversion F as [|? q ? qs Q G E1 E2]. subst. inversion G as [|? q' ? qs' Q' G' E1 E2]. subst.
  inversion G'. subst.
  destruct I as [->|[->|[]]]; [left; destruct Q as [Q _]; inversion Q as [|? ? ? ? B]
    |right; destruct Q' as [Q' _]; inversion Q' as [|? ? ? ? B]]; subst;
    unfold in_range in B; simpl in B; unfold Q2R in B; simpl in B; lra.
Qed.
