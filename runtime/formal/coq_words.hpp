// SPDX-License-Identifier: Apache-2.0
// The words of theorems about a robot. Each has one meaning, that of Geometry.v,
// Arms.v, Legs.v or Matrices.v.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace regulus::verifier {

/// The words of its definitions and statements, in the meaning of Geometry.v.
inline constexpr auto kRealWords = std::to_array<std::string_view>(
    {"pi",   "deg",       "sqrt",           "sin",       "cos",     "tan",   "atan",   "exp",
     "ln",   "Rabs",      "near",           "in_cube",   "in_ball", "first", "second", "third",
     "True", "euler_zxz", "roll_pitch_yaw", "quaternion"});
/// The parts of an arm, in the meaning of Arms.v.
inline constexpr auto kPartWords = std::to_array<std::string_view>(
    {"shift_by", "turn_by", "along_x", "along_z", "revolute", "prismatic", "follower", "x_axis",
     "y_axis", "z_axis", "opposite"});
/// Legs, and the matrix that they make, in the meaning of Legs.v.
inline constexpr auto kLegWords =
    std::to_array<std::string_view>({"UPS", "SPS", "RUS", "RSS", "PUS", "PSS", "RPS", "PRS", "UPU",
                                     "delta", "linear_delta", "RPR", "RRR", "PRR"});
inline constexpr auto kMatrixOfLegsWords = std::to_array<std::string_view>(
    {"in_space", "in_plane", "of_point", "of_point_in_plane", "rates_in_space", "rates_in_plane",
     "rates_of_point", "rates_of_point_in_plane", "fixed"});
/// More words of a proof: they have a meaning for Coq, and none for a reader.
inline constexpr auto kProofWords = std::to_array<std::string_view>({"intros",
                                                                     "S",
                                                                     "by_geometry",
                                                                     "by_threshold",
                                                                     "by_singularity",
                                                                     "by_point",
                                                                     "destruct",
                                                                     "as",
                                                                     "v",
                                                                     "exists",
                                                                     "quantity",
                                                                     "singular_of_claim",
                                                                     "by_small_determinant",
                                                                     "small_of_claim",
                                                                     "the_scales",
                                                                     "the_threshold",
                                                                     "no_quantities",
                                                                     "the_question",
                                                                     "the_claim",
                                                                     "by_arm",
                                                                     "by_rows_of_arm",
                                                                     "by_large_arm",
                                                                     "by_singular_arm",
                                                                     "by_small_arm",
                                                                     "at_point",
                                                                     "name_argument",
                                                                     "name_lets",
                                                                     "name_quantity",
                                                                     "in_ranges",
                                                                     "by_matrix",
                                                                     "by_large_matrix",
                                                                     "by_singular_matrix",
                                                                     "by_small_matrix",
                                                                     "unnamed",
                                                                     "no_names",
                                                                     "F",
                                                                     "D",
                                                                     "pose_of_singularity",
                                                                     "pose_of_small",
                                                                     "open_legs",
                                                                     "name_leg",
                                                                     "close_legs",
                                                                     "the_matrix",
                                                                     "the_inverse_jacobian"});
inline constexpr auto kRealSymbols = std::to_array<std::string_view>(
    {"(", ")", "[", "]", ";", ",", "+", "-", "*", "/", "^", "<=", "/\\"});

/// Quantities of a robot but for the parameters of its motion, which begin with '_'.
[[nodiscard]] inline bool is_quantity(std::string_view name) {
  constexpr auto kPose = std::to_array<std::string_view>(
      {"x", "y", "z", "psi", "theta", "phi", "roll", "pitch", "yaw", "q0", "q1", "q2", "q3"});
  constexpr std::string_view kCommanded = "_commanded";
  if (name.starts_with('_')) return name.size() > 1;
  if (name.size() == 2 && (name[0] == 'a' || name[0] == 'b'))
    return '1' <= name[1] && name[1] <= '6';
  if (name.ends_with(kCommanded)) name.remove_suffix(kCommanded.size());
  return std::ranges::find(kPose, name) != kPose.end();
}

}  // namespace regulus::verifier
