// SPDX-License-Identifier: GPL-3.0-or-later
// The value of what a model file says, at one point: a reader and an evaluator of their own.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/attack/oracle/attack.hpp"
#include "tests/attack/oracle/value.hpp"

namespace regulus::attack {

using Point = std::map<std::string, Value>;

/// The value of an expression of the model language; `lets` are names for expressions. Throws
/// std::invalid_argument where the text is none.
[[nodiscard]] Value evaluate(std::string_view text, const Point& at,
                             const std::map<std::string, std::string>& lets = {});

/// The exact number that a TOML integer or float stands for, in any of its spellings. Throws
/// std::invalid_argument.
[[nodiscard]] Rational toml_number(std::string_view text);

using Matrix = std::vector<std::vector<Value>>;

/// Everything that is asked about, at one point of the axes.
struct Sample {
  Matrix matrix;
  std::vector<Value> scale;
  std::vector<Value> constraints;
  bool defined = true;  ///< every expression has a value there, and every scale is positive

  /// Of J⁻¹ if there are scales; of a matrix that has more rows, the sum of squares of its minors.
  [[nodiscard]] Value determinant() const;
  [[nodiscard]] bool certain_inside() const;   ///< every constraint holds
  [[nodiscard]] bool certain_outside() const;  ///< some constraint does not
};

[[nodiscard]] Sample sample(const Attack& attack, const Point& axes);

/// The point that an attack has planted.
[[nodiscard]] Point planted(const Planted& at);

[[nodiscard]] Value determinant(Matrix matrix);

}  // namespace regulus::attack
