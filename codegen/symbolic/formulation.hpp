// SPDX-License-Identifier: GPL-3.0-or-later
// The symbolic stage: from a model and one of its motions to the rewritten expressions of every
// kernel function, and on to a Module.
#pragma once

#include <string>
#include <vector>

#include "regulus/codegen/model/model.hpp"
#include "regulus/codegen/program/module.hpp"
#include "regulus/codegen/symbolic/expression.hpp"

namespace regulus::codegen {

enum class VariableKind {
  kMotion,     // a motion parameter t_j
  kGeometry,   // an uncertain constant of the robot
  kControl,    // the control error of a pose parameter
};

/// An input of every kernel function. Motion parameters come first.
struct Variable {
  std::string name;
  std::string unit;
  VariableKind kind = VariableKind::kMotion;
  Range range;
  int ball = -1;       ///< Model::balls index when its range is one axis of a ball
};

/// Everything a kernel computes, after substitution of the motion variety and rewriting.
/// K's entries are the symbols k_1_1 … (n×m), row-major.
struct Formulation {
  std::string model;
  std::string motion;
  std::vector<Variable> variables;
  int rows = 0;
  int columns = 0;
  std::vector<Expression> matrix;         ///< A, m·n, row-major
  std::vector<Expression> left_product;   ///< K·A, n·n
  std::vector<Expression> left_derivatives;  ///< ∂_k(K·A), variables·n·n
  std::vector<Expression> right_product;  ///< A·K, m·m; empty unless m = n
  std::vector<Expression> row_scale;      ///< one entry, the product of the row scales; empty if none
  std::vector<Expression> constraints;
  std::vector<Expression> pose;
};

/// Throws InputError when the model and the motion do not fit together.
[[nodiscard]] Formulation formulate(const Model& model, const Motion& motion);

/// The program of every function, in canonical order.
[[nodiscard]] Module lower(const Formulation& formulation);

}  // namespace regulus::codegen
