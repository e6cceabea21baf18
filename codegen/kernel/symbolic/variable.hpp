// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/model/model.hpp"

namespace regulus::detail {

enum class VariableKind {
  kMotion,    // a motion parameter t_j
  kGeometry,  // an uncertain constant of the robot
  kControl,   // the control error of a pose parameter
};

/// An input of every kernel function. Motion parameters come first.
struct Variable {
  std::string name;
  std::string unit;
  VariableKind kind = VariableKind::kMotion;
  Range range;
  int ball = -1;  ///< Model::balls index if its range is one axis of a ball
};

}  // namespace regulus::detail
