// SPDX-License-Identifier: Apache-2.0
// The matrix of a model file with the names that the file gives its parts.
#pragma once

#include <string>
#include <vector>

#include "runtime/formal/coq_robot.hpp"

namespace regulus::verifier {

/// An argument of the matrix: a pose parameter, or an uncertain constant.
struct MatrixArgument {
  std::string name;        ///< its identifier in the definition
  NodeId variable;         ///< of the robot's graph
  NodeId value = kNoNode;  ///< at the pose of a proof; kNoNode: it is the quantity of this name
  bool is_number = false;  ///< the value has no names
};

/// A name of the file in the definition of the matrix, before those that use it.
struct MatrixName {
  NodeId variable, value;
  std::string text;   ///< of the value
  std::string place;  ///< in the file
  bool is_let = false;
  bool is_kept = false;  ///< it has a name in the proof even if it is a number
};

struct NamedMatrix {
  std::size_t rows = 0, columns = 0;
  std::vector<MatrixArgument> arguments;
  std::vector<MatrixName> names;
  std::vector<NodeId> entries;  ///< row-major
  std::vector<NodeId> scales;   ///< by row, or empty
  std::vector<std::string> entry_texts, scale_texts;
};

/// Adds the names to the graph and the names of `robot`. With `has_scales` it reads them. `of_pose`: the
/// pose with a control error is the commanded one and the error NAME'error, a variable of its own.
/// Throws Unfinished for a matrix that is not rectangular.
[[nodiscard]] NamedMatrix read_named_matrix(const WrittenValues& values, RobotOfModel& robot,
                                            bool has_scales, bool of_pose);

}  // namespace regulus::verifier
