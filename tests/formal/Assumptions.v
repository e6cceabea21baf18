(* SPDX-License-Identifier: GPL-3.0-or-later *)
From Regulus Require Import Search Singularity Threshold Forces Geometry.
Definition theorems := (check_correct, check_tree_correct, check_pieces_correct,
  check_piece_trees_correct, check_singularity_correct, check_determinant_correct,
  check_determinant_tree_correct,
  check_determinant_pieces_correct, check_determinant_piece_trees_correct, check_point_correct,
  check_crossing_correct, check_force_within_correct, check_force_below_correct,
  check_force_within_tree_correct, check_force_below_tree_correct,
  full_rank_of_claim, cube_of_ball, degrees_of_degrees).
Print Assumptions theorems.
