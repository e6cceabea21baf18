// SPDX-License-Identifier: GPL-3.0-or-later
// The Gough family: a platform on six legs, each between an anchor A_i of the base and B_i of the
// platform.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/mechanism/orientation.hpp"

namespace regulus {

/// The meaning of an anchor's tolerance: ± on each coordinate, or the radius of a ball.
enum class ToleranceShape { kBox, kBall };

struct Gough {
  std::string name;
  std::string source;
  std::string unit = "1";  ///< of lengths
  Orientation orientation = Orientation::kEulerZxz;
  std::string angle_unit = "rad";   ///< of the pose; "deg": a pose parameter is a number of degrees
  std::array<Point, 6> base{};      ///< A_i in the reference frame
  std::array<Point, 6> platform{};  ///< B_i in the mobile frame, whose origin C is the pose's x y z
  GiNaC::ex base_tolerance = 0;
  GiNaC::ex platform_tolerance = 0;
  ToleranceShape tolerance_shape = ToleranceShape::kBox;
};

/// The model of a six-legged platform, without motions.
///
/// Its anchors are geometry parameters a1_x … a6_z of group "base" and b1_x … b6_z of group
/// "platform", even if they are exact, so that a tolerance can be set later. Row i of the matrix is
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
[[nodiscard]] Model gough_model(const Gough& robot);

}  // namespace regulus
