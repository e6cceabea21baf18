// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of a mechanism as cycles of fixed frames and joints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/model/import/exact_pose.hpp"
#include "codegen/model/import/joint_ranges.hpp"

namespace regulus::detail {

/// A joint that follows none: its value is a variable of the mechanism.
struct LoopVariable {
  std::string name;  ///< in the file
  bool slides = false;
  int line = 0;
  std::optional<RangeOfJoint> limits{};  ///< of the joint and of those that follow it
};

/// A joint that a loop passes. Its value is multiplier·v + offset of a variable v.
struct LoopJoint {
  std::string name;
  bool slides = false;
  Point axis;  ///< of length 1
  std::array<double, 3> approx_axis{};
  std::size_t variable = 0;
  GiNaC::ex multiplier = 1, offset = 0;
  double approx_multiplier = 1, approx_offset = 0;
  bool follows = false;  ///< another joint

  [[nodiscard]] double value(const std::vector<double>& variables) const {
    return approx_multiplier * variables[variable] + approx_offset;
  }
};

/// A step from one frame of a loop to the next.
struct LoopStep {
  enum class Kind { kFixed, kJoint, kBall };
  Kind kind = Kind::kFixed;
  Placement frame{};                  ///< of a fixed step
  std::array<double, 12> approx{};    ///< the same: its rotation by rows, and its origin
  std::size_t joint = 0;              ///< of a joint
  bool reversed = false;              ///< from the joint's child to its parent
  std::vector<std::size_t> hinges{};  ///< that make a ball; empty: the file has a ball
  std::string name{};                 ///< of a ball
};

[[nodiscard]] LoopStep fixed_step(const Placement& frame);
/// Returns the steps back, from the last frame to the first.
[[nodiscard]] std::vector<LoopStep> reversed(const std::vector<LoopStep>& steps);

/// The frame after the last step is the first frame.
struct Loop {
  std::string name;
  int line = 0;
  std::vector<LoopStep> steps;
  std::size_t closes_at = 0;  ///< the step where the file's tree is closed
};

struct LoopGraph {
  std::vector<LoopVariable> variables;
  std::vector<LoopJoint> joints;
  std::vector<Loop> loops;
};

/// Finds the loops that the file declares and those that its joints close. Only joints of loops are
/// in the result. Two points that hold the same two links together are a hinge.
///
/// Throws    InputError for a joint of a loop that is of another type, or follows by no line.
[[nodiscard]] LoopGraph find_loops(const Mechanism& mechanism, const std::string& file);

}  // namespace regulus::detail
