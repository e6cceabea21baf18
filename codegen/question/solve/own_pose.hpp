// SPDX-License-Identifier: GPL-3.0-or-later
// Poses in space by the pose parameters of the model. They are found as x y z and a unit quaternion.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/model/mechanism/orientation.hpp"
#include "codegen/model/model.hpp"
#include "codegen/question/solve/solutions.hpp"

namespace regulus::detail {

/// The angles by which a model turns its platform. A model with a quaternion has none.
class OwnPose {
 public:
  explicit OwnPose(const Model& model);

  /// False if the numbers of a solution are told as they are.
  [[nodiscard]] bool has_angles() const noexcept { return orientation_.has_value(); }
  /// Returns x, y, z and the angles, with their units.
  ///
  /// Requires  has_angles().
  [[nodiscard]] std::vector<SolvedUnknown> parameters() const;

  /// Encloses them for a pose x y z qw qx qy qz. An angle is within half a turn of 0; one that the
  /// rotation does not determine is enclosed by a whole turn.
  ///
  /// Requires  has_angles(); the quaternion has norm 1.
  /// Rounding  outward; any MXCSR.
  [[nodiscard]] std::vector<Interval> at(std::span<const Interval> pose) const;
  /// True if the rotation of this pose does not determine all angles.
  [[nodiscard]] bool is_ambiguous(std::span<const Interval> pose) const;

 private:
  [[nodiscard]] std::vector<Interval> angles_at(std::span<const Interval> pose) const;

  std::optional<Orientation> orientation_;
  std::vector<SolvedUnknown> parameters_;
};

}  // namespace regulus::detail
