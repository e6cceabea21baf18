// SPDX-License-Identifier: GPL-3.0-or-later
// The ends of a bracket: exact numbers, and decimals that claim no more than they do.
#pragma once

#include <ginac/ginac.h>

#include <string>

namespace regulus::detail {

enum class RoundTo { kBelow, kAbove };

/// One end of a bracket.
struct BoundEnd {
  GiNaC::ex exact;  ///< a constant
  double approx = 0;
};

[[nodiscard]] BoundEnd end_at(const GiNaC::ex& exact);

/// Returns a decimal of `digits` digits that is not above, or not below, the constant. If its
/// decimals cannot be compared with the constant, the text of the nearest double beyond it.
[[nodiscard]] std::string rounded_text(const BoundEnd& end, RoundTo side, int digits = 5);

/// Returns a double that is not above, or not below, the constant.
[[nodiscard]] double rounded_number(const BoundEnd& end, RoundTo side);

}  // namespace regulus::detail
