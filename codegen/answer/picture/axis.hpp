// SPDX-License-Identifier: GPL-3.0-or-later
// An axis of a picture: its range, its name with unit, and a power of ten that keeps the numbers
// along it short. For drawing only.
#pragma once

#include <string>

#include "codegen/question/engine/search_subject.hpp"

namespace regulus {

class Axis {
 public:
  Axis(Interval range, const std::string& name, const std::string& unit);

  [[nodiscard]] const Interval& range() const noexcept { return range_; }
  /// Returns "z (cm)", "det J⁻¹ (× 10⁵)".
  [[nodiscard]] const std::string& label() const noexcept { return label_; }
  /// Returns both ends in the numbers along the axis, with a space between them.
  [[nodiscard]] std::string ends(Interval x) const;
  /// Returns the command that sets the range of gnuplot's axis, "x" or "y".
  [[nodiscard]] std::string range_command(const char* axis) const;

 private:
  Interval range_;
  double factor_ = 1;
  std::string label_;
};

/// Returns the axis of a variable.
[[nodiscard]] Axis axis_of(const SearchSubject& preparation, std::size_t variable);

}  // namespace regulus
