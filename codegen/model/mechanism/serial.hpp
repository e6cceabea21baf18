// SPDX-License-Identifier: GPL-3.0-or-later
// Serial arms: a chain of joints from a base to a tool.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "codegen/model/mechanism/placement.hpp"
#include "codegen/model/model.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

enum class JointKind { kRevolute, kPrismatic };

/// The value of a joint that follows another: multiplier · q + offset.
struct Following {
  std::size_t leader = 0;  ///< index of a joint that follows none
  GiNaC::ex multiplier = 1;
  GiNaC::ex offset = 0;
};

/// A joint that moves. It turns about, or slides along, an axis through the origin of its frame.
struct SerialJoint {
  std::string name;
  JointKind kind = JointKind::kRevolute;
  Placement origin;        ///< of the joint's frame in that of the joint before, all joints at zero
  Point axis = {0, 0, 1};  ///< in the joint's frame; a unit vector
  std::optional<Following> follows{};
};

struct Serial {
  std::string unit = "1";  ///< of lengths
  std::string angle_unit = "rad";
  std::vector<SerialJoint> joints;
  Placement tool{};  ///< in the frame of the last joint, for pictures only
};

/// The most joints that move. The matrix of more of them has too many terms.
constexpr std::size_t kMostJoints = 12;

/// Returns the value of each joint in the pose parameters of the model, which are those of the joints
/// that follow none, in their order.
[[nodiscard]] std::vector<GiNaC::ex> joint_values(const Model& model, const Serial& robot);

/// Fills pose, matrix, matrix_kind and matrix_notes of a model with a serial arm.
///
/// The matrix is the forward Jacobian J, a column for each joint that follows none: the velocity of a
/// point of the tool and its angular velocity that one unit of joint speed gives; its transpose if
/// there are more joints than rows. Point and frame do not change the rank: those of one link are
/// chosen for which the joint variables occur least often. So a first or last joint does not occur
/// at all.
///
/// A row that is a combination of other rows with constant coefficients at all poses does not change
/// the rank either. Exact algebra finds such rows, and they are left out: 3 remain of a planar arm.
///
/// If the matrix is square and its determinant factors, or that of a block on its diagonal, it becomes
/// Model::jacobian, and `matrix` has the factors on its diagonal (determinant_factors.hpp).
///
/// Requires  1 to kMostJoints joints; origins and axes are constants or depend on `model.geometry`.
/// Throws    ParseRefusal if the matrix has too many terms; what `meter`, if it is not null, throws.
/// Ensures   full column rank of the matrix at a pose ⇔ rank J = min(rows that remain, joints).
[[nodiscard]] Model serial_model(Model model, const Serial& robot, WorkMeter* meter = nullptr);

/// Makes the pose parameters of joints that turn numbers of degrees. Their ranges, if the model has
/// some, stay as they are.
///
/// Requires  no expression of the model but those of serial_model depends on them.
void set_angles_in_degrees(Model& model);

}  // namespace regulus::detail
