// SPDX-License-Identifier: GPL-3.0-or-later
// Robots on legs: each leg a chain of joints between the base and the platform, by its points, axes
// and lengths. They are written out as the expressions that a model file would have.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "codegen/model/exact/formula.hpp"

namespace regulus::detail {

/// The part of a leg that changes its length or holds the end of its rod.
enum class LegKind {
  kTelescopic,  ///< a prismatic joint between the base and the platform
  kCrank,       ///< a revolute joint of the base, a crank, a rod
  kSlider,      ///< a prismatic joint of the base, a rod
};

struct LegType {
  const char* name;
  LegKind kind;
  bool planar;
  /// True if the leg keeps the platform from turning, by one moment: UPU and Delta legs.
  bool keeps_orientation;
  /// True if a revolute joint keeps the leg in a plane, by one force: RPS and PRS legs.
  bool is_hinged = false;
};

/// The types, in the order of the manual.
[[nodiscard]] std::span<const LegType> leg_types();

using FormulaPoint = std::array<Formula, 3>;

/// An axis, or another direction. It need not have length 1.
struct LegAxis {
  FormulaPoint direction;
  /// For an axis of exact numbers: f and g, so that f, g and the direction are a right-handed
  /// orthonormal frame.
  std::optional<std::pair<FormulaPoint, FormulaPoint>> across{};
};

/// The range of the actuated joint.
struct JointRange {
  Formula lo, hi;
};

struct Leg {
  const LegType* type = nullptr;
  int actuated = 0;         ///< the joint's number from the base; 0: none
  FormulaPoint base{};      ///< A, in the reference frame
  FormulaPoint platform{};  ///< B, in the platform's frame
  Formula crank{}, rod{};   ///< lengths
  LegAxis axis{};           ///< of the motor, of the slider; for UPU: of the outer joints
  FormulaPoint bar{};       ///< of the parallelogram: along its short sides
  FormulaPoint hinge{};     ///< the axis of the revolute joint of a hinged leg
  /// True if the hinge is across the rail for all values of the uncertain quantities.
  bool hinge_is_across = false;
  std::optional<FormulaPoint> zero{};  ///< where the crank points at the angle 0
  bool mode = true;                    ///< working mode "+"
  std::optional<JointRange> range{};
};

/// The robot's legs and its platform. Its pose parameters are named as the columns of `rotation` use
/// them, and x, y, z.
struct Legs {
  bool planar = false;
  bool point = false;  ///< the platform is a point, its twist a velocity
  /// R; in the plane the entries (1,1), (1,2), (2,1), (2,2) count. Not read for a point.
  std::array<FormulaPoint, 3> rotation{};
  std::vector<Leg> legs;
};

/// A row of the inverse Jacobian; J⁻¹ row = scale · row.
struct LegRow {
  std::vector<Formula> entries;
  Formula scale;
  bool motor = true;    ///< false: of a constraint
  std::size_t leg = 0;  ///< index of its leg
};

/// The joints of a leg from the base to the platform: A, C and B, or A and B.
struct LegPoints {
  LegKind kind;
  std::vector<FormulaPoint> points;
  int row = -1;  ///< of its motor; −1: none
};

/// A robot on legs as the text of a model file.
struct WrittenLegs {
  std::vector<std::pair<std::string, Formula>> let;
  std::vector<LegRow> rows;       ///< those of motors first, in the order of the legs
  std::vector<Formula> ranges;    ///< each ≤ 0 where the actuated joints are within their ranges
  std::vector<LegPoints> points;  ///< of each leg, in the names of `let`
};

/// Writes the robot out.
///
/// The rows of a leg are a basis of the wrenches that are reciprocal to the twists of its passive
/// joints: of forces along the rod, or along another line that all passive joints cross or are
/// parallel to; of a moment, if the leg keeps the platform from turning; and of a force along its
/// hinge, if it has one. In leg i,
///
///   r_i = R·B_i, e_i = A_iB_i, d_i = C_iB_i the rod, rho_i = |e_i|, s_i the position of the slider,
///   w_i the root of its working mode, 0 where the motor is at a dead point,
///   off_i for a hinge along h: h·e_i, but h·d_i on a rail that may be oblique to h; 0 where B_i is
///   in the leg's plane,
///
/// and these names, with _x, _y, _z for coordinates, can be used in constraints.
///
/// Units     columns of velocity: the unit of lengths (moments: 1); the others times that unit.
/// Ensures   scale · row is the rate of the joint for each twist, up to its sign; rows and scales are
///           undefined where the leg is out of reach, or its motor at a dead point.
/// Requires  for a leg that keeps orientation: `axis` and `bar` have the same direction in the base
///           and in the platform at all poses.
[[nodiscard]] WrittenLegs write_legs(const Legs& robot);

}  // namespace regulus::detail
