(* SPDX-License-Identifier: GPL-3.0-or-later *)
From Regulus Require Import Search.
Print Assumptions check_correct.
