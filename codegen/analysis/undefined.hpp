// SPDX-License-Identifier: GPL-3.0-or-later
// Which expressions of a model have no value at a pose: a leg of length 0, a negative root, a
// denominator that vanishes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "codegen/engine/pipeline.hpp"
#include "codegen/program/program.hpp"

namespace regulus::inline analysis {

/// An operation that is not certainly defined although its argument is.
struct UndefinedExpression {
  std::string text;      ///< "sqrt(x^2 - 4)"
  std::string argument;  ///< "x^2 - 4"; empty where there are two
  Interval enclosure;    ///< of the argument
};

/// Where, and what.
struct Undefined {
  std::vector<Interval> variables;  ///< the middle of a box if undefined there, else all of it
  std::vector<Interval> pose;       ///< its enclosure; empty where the pose has none
  std::vector<UndefinedExpression> expressions;  ///< empty: a value is beyond the doubles
};

/// Every root, denominator … of a model over one motion, ready to be looked at over boxes.
class Definedness {
 public:
  explicit Definedness(const Formulation& formulation);

  /// Encloses over a box: an expression that is found may still be defined in all of it.
  [[nodiscard]] Undefined look_at(std::span<const Interval> box) const;

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

}  // namespace regulus::inline analysis
