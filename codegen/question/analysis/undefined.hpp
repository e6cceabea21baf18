// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the expressions of a model without a value at a pose: a leg of length 0, the root of a
// negative number, a denominator 0.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "codegen/kernel/program/program.hpp"
#include "codegen/question/engine/pipeline.hpp"

namespace regulus::detail {

/// An operation that is not certainly defined although its argument is.
struct UndefinedExpression {
  std::string text;      ///< "sqrt(x^2 - 4)"
  std::string argument;  ///< "x^2 - 4"; empty if there are two
  Interval enclosure;    ///< of the argument
};

/// The undefined expressions, and their place.
struct Undefined {
  std::vector<Interval> variables;  ///< the middle of a box if undefined there, else the box
  std::vector<Interval> pose;       ///< its enclosure; empty if the pose has none
  std::vector<UndefinedExpression> expressions;  ///< empty: a value exceeds the doubles
};

/// Evaluates every root, denominator … of a model over boxes of one motion.
class Definedness {
 public:
  explicit Definedness(const Formulation& formulation);

  /// Encloses them over a box: an expression in the result may still be defined everywhere on it.
  [[nodiscard]] Undefined look_at(std::span<const Interval> box) const;
  /// Ensures   true only if every expression has a value everywhere on the box.
  [[nodiscard]] bool certain_on(std::span<const Interval> box) const;

 private:
  struct Operation {
    std::string text, argument_text;
    Program whole, argument;
  };
  [[nodiscard]] std::vector<UndefinedExpression> undefined_over(
      std::span<const Interval> box) const;
  [[nodiscard]] std::vector<Interval> pose_over(std::span<const Interval> box) const;

  std::vector<Operation> operations_;
  Program pose_;
};

[[nodiscard]] Undefined find_undefined(const PreparedSearch& preparation,
                                       std::span<const Interval> box);

}  // namespace regulus::detail
