// SPDX-License-Identifier: GPL-3.0-or-later
// The widths of expressions over boxes of a motion, to choose one of several forms. Widths are
// estimates for choices that no verdict depends on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/kernel/symbolic/expression.hpp"
#include "codegen/kernel/symbolic/variable.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

class SampleWidths {
 public:
  explicit SampleWidths(const std::vector<Variable>& variables);

  /// Returns the sum of the widths over boxes of a quarter of the motion's width; +∞ if the
  /// expression is undefined on one of them.
  [[nodiscard]] double approx_width(const Expression& e) const;

  /// Returns the values over the whole motion; nullopt if the expression is undefined there.
  [[nodiscard]] std::optional<Interval> over_motion(const Expression& e) const;

 private:
  [[nodiscard]] std::optional<Interval> over(const Expression& e,
                                             const std::vector<Interval>& box) const;

  std::vector<std::string> names_;
  std::vector<Interval> motion_;
  std::vector<std::vector<Interval>> samples_;
};

}  // namespace regulus::detail
