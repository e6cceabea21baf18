// SPDX-License-Identifier: GPL-3.0-or-later
// Decides by values at points if two certificates ask the same question. It shares no code with the
// verifier or the front end.
#pragma once

#include <string>

namespace regulus::attack {

/// Returns the first difference; empty if the lines of both are the same, or have the same values at
/// some points. What does not count: labels, names that are exchanged wherever they stand, shorthands,
/// the order of quantities and conditions, and lines that do not change the claim. Lines about definedness count together, at points within the
/// ranges and beyond: `verified` must not say that there is a value where `asked` has none. Without a
/// threshold, a load or a quantity, square matrices may differ if their determinants have one ratio.
/// `any_spread`: an option has set tolerances.
[[nodiscard]] std::string difference(const std::string& verified, const std::string& asked,
                                     bool any_spread);

}  // namespace regulus::attack
