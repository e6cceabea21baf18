// SPDX-License-Identifier: Apache-2.0
// A robot and its motion as the verifier's reader finds them in a model file, in the words of Geometry.v,
// Arms.v, Legs.v and Matrices.v.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "runtime/formal/coq_arm.hpp"
#include "runtime/formal/coq_legs.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/formal/known_robot.hpp"
#include "runtime/verifier/model/model_file.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

struct CoqModel {
  WrittenValues values;
  /// Options may have changed ranges, tolerances and errors: they are those of the certificate.
  bool may_differ = false;
};

/// A quantity of the theorem: its identifier, a value in the set, and its value at the pose of a
/// certificate, which is empty if that does not have it.
struct CoqQuantity {
  std::string name, witness, of_pose;
  bool is_point = false;
};

/// A pose parameter: its name in the file, and its commanded value as a node of the robot's graph.
struct CoqPose {
  std::string name;
  NodeId commanded = kNoNode;
  bool has_error = false;
};

struct RobotOfModel {
  RobotKind kind = RobotKind::kPlatform;
  std::vector<CoqQuantity> quantities;
  std::vector<std::string> conditions;  ///< what the set is
  std::vector<std::string> pose;  ///< the actual pose: x, y, z, then the orientation; or the joints
  std::vector<CoqItem> legs;
  std::vector<CoqPart> parts;
  std::vector<CoqLeg> chains;       ///< of [legs]
  bool is_geometry_certain = true;  ///< legs or parts are numbers
  std::string orientation;          ///< as in the file
  std::string threshold;
  bool is_middle_in_set = false;  ///< the witnesses satisfy the constraints
  /// The value of a variable of the certificate, by its name.
  std::map<std::string, std::string> of_certificate;

  // For a matrix and for legs, the expressions themselves.
  Question own;                    ///< its graph has them
  std::vector<std::string> names;  ///< by the number of a variable of the graph
  std::vector<CoqPose> poses;
  std::map<std::string, std::string> constants;           ///< certain ones, and their places
  std::vector<std::pair<std::string, NodeId>> uncertain;  ///< the other ones
};

/// Throws Unfinished for what Geometry.v has no word for, and for a key that it does not know.
[[nodiscard]] RobotOfModel read_robot(const Question& question, const CoqModel& model);

}  // namespace regulus::verifier
