// SPDX-License-Identifier: GPL-3.0-or-later
// An axis of a picture: its range, its name with unit, and a power of ten that keeps the numbers
// along it short. Angles are in degrees. For drawing only.
#pragma once

#include <optional>
#include <string>

#include "codegen/question/engine/search_subject.hpp"

namespace regulus::detail {

class Axis {
 public:
  /// At most so many numbers stand along the axis; 0: the plot says where. `shown`: what the axis
  /// is for, with the range in it; nothing: the range.
  Axis(Interval range, const std::string& name, const std::string& unit, int most_ticks = 8,
       const std::optional<Interval>& shown = {});

  [[nodiscard]] const Interval& range() const noexcept { return range_; }
  [[nodiscard]] const Interval& shown() const noexcept { return shown_; }
  /// Returns what a value is multiplied by for the numbers along the axis.
  [[nodiscard]] double factor() const noexcept { return factor_; }
  /// Returns "z (cm)", "det J⁻¹ (× 10⁵)".
  [[nodiscard]] const std::string& label() const noexcept { return label_; }
  /// Returns both ends in the numbers along the axis, with a space between them.
  [[nodiscard]] std::string ends(Interval x) const;
  /// Returns the commands that set the range and the ticks of gnuplot's axis, "x" or "y".
  [[nodiscard]] std::string range_command(const char* axis) const;

 private:
  Interval range_, shown_;
  double factor_ = 1;
  bool is_angle_;
  int most_ticks_;
  std::string label_;
};

/// Returns the axis of a variable.
[[nodiscard]] Axis axis_of(const SearchSubject& preparation, std::size_t variable,
                           int most_ticks = 8, const std::optional<Interval>& shown = {});

/// Returns "phi = 25 deg", "x in [−2, 4] cm": six digits, for the text of a picture.
[[nodiscard]] std::string drawn_text(const VariableLabel& variable, const Interval& value);

}  // namespace regulus::detail
