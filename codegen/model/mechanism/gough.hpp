// SPDX-License-Identifier: GPL-3.0-or-later
// The Gough family: a platform on six legs, each between an anchor A_i of the base and B_i of the
// platform.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/mechanism/orientation.hpp"

namespace regulus::detail {

struct Gough {
  std::string unit = "1";  ///< of lengths
  Orientation orientation = Orientation::kEulerZxz;
  std::string angle_unit = "rad";   ///< of the pose; "deg": a pose parameter is a number of degrees
  std::array<Point, 6> base{};      ///< A_i in the reference frame, by the model's constants
  std::array<Point, 6> platform{};  ///< B_i in the mobile frame, whose origin C is the pose's x y z
};

/// Adds the pose parameters to a model.
void add_pose_of_gough(Model& model, const Gough& robot);

/// Adds twist, matrix, row scales, conditions and drawing. Row i of the matrix is
///
///   M_i = (A_iB_i, CB_i × A_iB_i), row_scale 1/ρ_i,   and CB × AB = CB × (C − A),
///
/// and the code uses the right-hand side: it has fewer occurrences of the pose.
///
/// A quaternion need not have norm 1: q and λq are the same orientation, so ranges and control
/// errors may leave the unit sphere. The rows are multiplied by |q|² to remain polynomials
/// (row_scale 1/(|q|²ρ_i)), and 1/|q|² must be defined: at q = 0 there is no orientation, so a
/// motion that may reach it is undefined there.
///
/// Shape     6×6, rows by leg, columns by twist (velocity of C, angular velocity).
/// Units     columns 0–2 unit (unit·|q|² likewise), columns 3–5 unit².
/// Ensures   row i is zero if ρ_i = 0, so a regular matrix has a defined row scale.
/// Source    Merlet, T-RO 2007, Eqs. (5)–(7).
/// Requires  the pose parameters as the first ones of the model.
void add_matrix_of_gough(Model& model, const Gough& robot);

}  // namespace regulus::detail
