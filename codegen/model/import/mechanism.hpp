// SPDX-License-Identifier: GPL-3.0-or-later
// The kinematics of a robot as files of other programs have it: links and joints between them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codegen/model/import/exact_number.hpp"

namespace regulus::detail {

/// The way in which an orientation is written.
enum class OrientationForm {
  kNone,
  kRpy,         ///< roll, pitch, yaw: Rz(yaw)·Ry(pitch)·Rx(roll)
  kQuaternion,  ///< w, x, y, z of any length but zero
  kRotation,    ///< the nine entries of a rotation matrix, by rows
};

struct Pose {
  std::array<WrittenNumber, 3> xyz{};
  OrientationForm orientation = OrientationForm::kNone;
  std::vector<WrittenNumber> angles{};  ///< or the quaternion's components

  [[nodiscard]] bool is_identity() const;
};

enum class JointType { kRevolute, kContinuous, kPrismatic, kFixed, kOther };

struct JointLimits {
  WrittenNumber lower, upper;
};

/// The value of a joint that follows another: multiplier · q + offset.
struct FollowingRule {
  WrittenNumber multiplier = whole(1), offset{};
};

/// A joint: `origin` places its frame in that of the link `parent`; the frame of `child` is this
/// frame, moved about or along `axis`.
struct ImportedJoint {
  std::string name;
  JointType type = JointType::kFixed;
  std::string type_name;  ///< as in the file
  std::string parent, child;
  Pose origin;
  std::array<WrittenNumber, 3> axis = {whole(0), whole(0), whole(1)};
  std::optional<JointLimits> limits;
  std::optional<std::string> mimics{};  ///< the joint that this one follows
  std::optional<FollowingRule> rule{};  ///< nullopt for a rule of another kind
  int line = 0;
};

[[nodiscard]] inline bool moves(const ImportedJoint& joint) {
  return joint.type != JointType::kFixed;
}

[[nodiscard]] inline bool turns(const ImportedJoint& joint) {
  return joint.type == JointType::kRevolute || joint.type == JointType::kContinuous;
}

/// A loop that two links close.
struct ImportedLoop {
  std::string type;  ///< as in the file: "connect" holds two points together
  std::string first, second;
  std::array<WrittenNumber, 3> anchor{};  ///< the point, in the frame of the first link
  /// The point, or the frame, is that of both links, and the zero pose may be open. Otherwise the
  /// loop holds what the zero pose has there.
  bool origins_meet = false;
  int line = 0;
  std::optional<Pose> relative{};  ///< of "weld": the second link in the frame of the first
};

/// The part of a file that is read.
struct Mechanism {
  std::string format;  ///< "URDF"
  std::string name;
  std::vector<std::string> links;
  std::vector<ImportedJoint> joints;
  std::vector<ImportedLoop> loops;
  std::vector<std::string> actuated;   ///< joints that the file says are driven
  std::map<std::string, int> ignored;  ///< elements without meaning for the kinematics, and counts
  std::vector<std::string> notes;      ///< what was assumed

  [[nodiscard]] bool has_link(const std::string& link) const;
  /// True if links and joints make no tree.
  [[nodiscard]] bool has_loops() const;
};

}  // namespace regulus::detail
