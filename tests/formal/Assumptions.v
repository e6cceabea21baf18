(* SPDX-License-Identifier: GPL-3.0-or-later *)
From Regulus Require Import Search Singularity Threshold Forces Geometry Matrices Legs.
From Regulus Require Import Existence Branches Ways Limits Rates Slopes Distances Solutions Poses.
From Regulus Require Import Arms.
Definition theorems := (check_correct, check_tree_correct, check_pieces_correct,
  check_piece_trees_correct, check_singularity_correct, check_determinant_correct,
  check_determinant_tree_correct,
  check_determinant_pieces_correct, check_determinant_piece_trees_correct, check_point_correct,
  check_crossing_correct, check_force_within_correct, check_force_below_correct,
  check_force_within_tree_correct, check_force_below_tree_correct,
  check_force_within_pieces_correct, check_force_below_pieces_correct,
  check_force_within_piece_trees_correct, check_force_below_piece_trees_correct,
  check_limits_correct, check_limits_tree_correct, check_limits_pieces_correct,
  check_limits_piece_trees_correct, check_branch_within_correct, check_branch_below_correct,
  check_branch_above_correct, check_branch_within_limits_correct,
  check_closure_along_correct, check_branch_within_along_correct,
  check_branch_below_along_correct, check_branch_above_along_correct,
  check_branch_within_limits_along_correct,
  check_finite_error_within_correct, check_finite_error_within_along_correct,
  check_limits_in_correct, check_limits_trees_correct, check_closure_in_correct,
  check_closure_along_in_correct, check_branch_within_limits_in_correct,
  check_branch_within_limits_along_in_correct,
  check_branch_determinant_correct, check_branch_determinant_along_correct,
  check_branch_determinant_in_correct, check_branch_determinant_along_in_correct,
  check_branch_condition_correct, check_branch_condition_along_correct,
  check_no_forces_correct, determinant_of_arm, determinant_of_rows, dependent_arm, large_of_claim, small_of_certificate,
  check_all_solutions_correct, check_some_solutions_correct, check_solutions_at_correct,
  check_some_poses_correct, check_forty_poses_correct, check_sixteen_poses_correct,
  full_rank_of_claim, cube_of_ball, degrees_of_degrees, inverse_of_root,
  full_rank_of_names, above_of_names, singular_of_names, small_of_names, angle_45, angle_to_180,
  root_of_multiple, inverse_of_multiple, crank_fits, carriage_fits, named_point,
  exactly_one, check_closure_correct, linear_roll_pitch_yaw, linear_euler_zxz, linear_quaternion, linear_about_z).
Print Assumptions theorems.
