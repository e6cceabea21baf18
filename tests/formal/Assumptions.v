(* SPDX-License-Identifier: GPL-3.0-or-later *)
From Regulus Require Import Search Singularity.
Definition theorems := (check_correct, check_pieces_correct, check_singularity_correct).
Print Assumptions theorems.
