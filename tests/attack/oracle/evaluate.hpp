// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates the text of a model file at one point, with a reader and an evaluator of its own.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/attack/oracle/attack.hpp"
#include "tests/attack/oracle/value.hpp"

namespace regulus::detail::attack {

using Point = std::map<std::string, Value>;

/// Returns the value of an expression of the model language; `lets` are names for expressions.
/// Throws std::invalid_argument if the text is not an expression.
[[nodiscard]] Value evaluate(std::string_view text, const Point& at,
                             const std::map<std::string, std::string>& lets = {});

/// Returns the exact number that a TOML integer or float means, in any of its spellings. Throws
/// std::invalid_argument.
[[nodiscard]] Rational toml_number(std::string_view text);

using Matrix = std::vector<std::vector<Value>>;

/// The values of all expressions in the question, at one point of the axes.
struct Sample {
  Matrix matrix;
  std::vector<Value> scale;
  std::vector<Value> constraints;
  bool defined = true;  ///< every expression has a value there, and every scale is positive

  /// Returns that of J⁻¹ if there are scales; Σ minors² if there are more rows than columns.
  [[nodiscard]] Value determinant() const;
  [[nodiscard]] bool certain_inside() const;   ///< every constraint holds
  [[nodiscard]] bool certain_outside() const;  ///< some constraint does not hold
};

[[nodiscard]] Sample sample(const Attack& attack, const Point& axes);

/// Returns the point that an attack has planted.
[[nodiscard]] Point planted(const Planted& at);

[[nodiscard]] Value determinant(Matrix matrix);

}  // namespace regulus::detail::attack
