(* SPDX-License-Identifier: Apache-2.0 *)
(** Lengths of lists, by names that versions of Coq's library do not change. *)
From Coq Require Import List.
Import ListNotations.

Lemma map_size [A B] (f : A -> B) l : length (map f l) = length l.
Proof. induction l as [|x l IH]; simpl; [|rewrite IH]; reflexivity. Qed.

Lemma app_size [A] (l l' : list A) : length (l ++ l') = length l + length l'.
Proof. induction l as [|x l IH]; simpl; [|rewrite IH]; reflexivity. Qed.

Lemma seq_size count start : length (seq start count) = count.
Proof.
  revert start. induction count as [|n IH]; intros start; simpl; [|rewrite IH]; reflexivity.
Qed.

Lemma firstn_size [A] n (l : list A) : length (firstn n l) = Nat.min n (length l).
Proof. revert l. induction n; intros [|x l]; simpl; f_equal; auto. Qed.

Lemma combine_size [A B] (l : list A) (l' : list B) :
  length (combine l l') = Nat.min (length l) (length l').
Proof. revert l'. induction l; intros [|y l']; simpl; f_equal; auto. Qed.
