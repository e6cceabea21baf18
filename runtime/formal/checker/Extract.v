(* SPDX-License-Identifier: Apache-2.0 *)
(** The checks as a program of OCaml. *)
From Coq Require Extraction.
From Regulus Require Import Intervals Questions Boxes Parts Search Singularity Threshold Forces Limits
  SingularValues Notations.
From Regulus Require Primitives.

(** Shorter names for functions that are not constructors. *)
Definition tangent := tan.
Definition arcsine := asin.
Definition arccosine := acos.
Definition arctangent2 := atan2.

Set Warnings "-extraction-opaque-accessed".
Extraction "checker.ml" check_tree check_piece_trees check_determinant_piece_trees check_singularity
  check_force_piece_trees range_within range_below bordered bordered_method
  check_limits_piece_trees check_limits_trees kept_boxes test_limits
  check_spectrum_piece_trees test_spectrum
  check_point check_crossing test test_determinant is_closed variable_to_split I.midpoint lower_part upper_part enclose_ranges
  no_entry rational_of within tangent arcsine arccosine arctangent2.
