(* SPDX-License-Identifier: GPL-3.0-or-later *)
From Coq Require Extraction.
From Regulus Require Primitives.
Require Import Arithmetic.
Extraction "arithmetic.ml" results.
