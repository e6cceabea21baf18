(* SPDX-License-Identifier: Apache-2.0 *)
(** Taylor's theorem of second order, and the functions of expressions that it is used for. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(** f, with the derivatives f' and f'', at every point of a convex set. *)
Definition twice_derivable (f f' f'' : R -> R) (t : R) : Prop :=
  is_derive f t (f' t) /\ is_derive f' t (f'' t).

Theorem taylor f f' f'' x y :
  (forall t, Rmin x y <= t <= Rmax x y -> twice_derivable f f' f'' t) ->
  exists t, Rmin x y <= t <= Rmax x y /\
    f y = f x + f' x * (y - x) + f'' t / 2 * ((y - x) * (y - x)).
Proof.
  intros H. destruct (Req_dec x y) as [<-|N].
  { exists x. split; [split; [apply Rmin_l|apply Rmax_l]|]. ring. }
  set (C := (f y - f x - f' x * (y - x)) / ((y - x) * (y - x))).
  set (g := fun t => f t + f' t * (y - t) + C * ((y - t) * (y - t))).
  set (g' := fun t => (y - t) * (f'' t - 2 * C)).
  assert (D : forall t, Rmin x y <= t <= Rmax x y -> derivable_pt_lim g t (g' t)).
  { intros t T. apply is_derive_Reals. destruct (H t T) as [D1 D2]. unfold g, g'.
    evar_last.
    - apply (is_derive_plus (fun t => f t + f' t * (y - t)) (fun t => C * ((y - t) * (y - t)))).
      + apply (is_derive_plus f (fun t => f' t * (y - t))); [exact D1|].
        apply (is_derive_mult f' (fun t => y - t) t (f'' t) (-1)).
        * exact D2.
        * auto_derive; [exact Logic.I|ring].
        * intros. apply Rmult_comm.
      + instantiate (1 := C * (- 2 * (y - t))). auto_derive; [exact Logic.I|ring].
    - unfold plus, mult. simpl. unfold plus, mult. simpl. ring. }
  assert (E : g x = g y).
  { unfold g, C. field. lra. }
  assert (Z : exists t, Rmin x y <= t <= Rmax x y /\ g' t = 0 /\ t <> y).
  { destruct (Rlt_dec x y) as [L|L].
    - rewrite Rmin_left, Rmax_right in * by lra.
      destruct (MVT_cor2 g g' x y L D) as [c [Q c1]]. exists c. split; [lra|]. split; [|lra].
      rewrite E in Q. nra.
    - rewrite Rmin_right, Rmax_left in * by lra.
      destruct (MVT_cor2 g g' y x) as [c [Q c1]]; [lra|exact D|]. exists c.
      split; [lra|]. split; [|lra]. rewrite E in Q. nra. }
  destruct Z as [t [T [Z M]]]. exists t. split; [exact T|].
  unfold g' in Z. apply Rmult_integral in Z as [Z|Z]; [lra|].
  replace (f'' t) with (2 * C) by lra. unfold C. field. lra.
Qed.

Lemma sin_derivable t : twice_derivable sin cos (fun t => - sin t) t.
Proof. split; auto_derive; trivial; ring. Qed.

Lemma cos_derivable t : twice_derivable cos (fun t => - sin t) (fun t => - cos t) t.
Proof. split; auto_derive; trivial; ring. Qed.

Lemma exp_derivable t : twice_derivable exp exp exp t.
Proof. split; auto_derive; trivial; ring. Qed.

Lemma inverse_derivable t : t <> 0 ->
  twice_derivable (fun t => 1 / t) (fun t => - (1 / (t * t))) (fun t => 2 / (t * t * t)) t.
Proof. intros N. split; auto_derive; trivial; try nra; field; trivial. Qed.

Lemma log_derivable t : 0 < t ->
  twice_derivable ln (fun t => 1 / t) (fun t => - (1 / (t * t))) t.
Proof. intros N. split; auto_derive; try lra; field; lra. Qed.

Lemma sqrt_derivable t : 0 < t ->
  twice_derivable sqrt (fun t => 1 / (2 * sqrt t)) (fun t => - (1 / (4 * (t * sqrt t)))) t.
Proof.
  intros P. pose proof (sqrt_lt_R0 t P) as S. pose proof (sqrt_sqrt t ltac:(lra)) as Q.
  split; auto_derive; try lra; try (repeat split; lra).
  replace (t * sqrt t) with (sqrt t * sqrt t * sqrt t) by (rewrite Q; ring). field. lra.
Qed.

Lemma atan_derivable t :
  twice_derivable atan (fun t => 1 / (1 + t * t))
    (fun t => - (2 * t / ((1 + t * t) * (1 + t * t)))) t.
Proof.
  assert (0 < 1 + t * t) by nra. split.
  - evar_last; [apply is_derive_Reals, derivable_pt_lim_atan|]. unfold Rsqr. field. lra.
  - auto_derive; [lra|]. field. lra.
Qed.
