// SPDX-License-Identifier: GPL-3.0-or-later
// Decides by values at points if two certificates ask the same question. It shares no code with the
// verifier or the front end.
#pragma once

#include <string>

namespace regulus::detail::attack {

/// What options have set may differ: the verifier is told of them.
struct SetByOptions {
  bool tolerances = false, alpha = false;
};

/// Returns the first difference; empty if the lines of both are the same, or have the same values at
/// some points. What does not count: labels, names that are exchanged wherever they stand, shorthands,
/// the order of quantities and conditions, and lines that do not change the claim. Lines about definedness count together, at points within the
/// ranges and beyond: `verified` must not say that there is a value where `asked` has none. Without a
/// threshold, a load or a quantity, square matrices may differ if their determinants have one ratio.
[[nodiscard]] std::string difference(const std::string& verified, const std::string& asked,
                                     const SetByOptions& any = {});

/// True if two model files have the same text but for the spelling of numbers.
[[nodiscard]] bool are_equal_files(const std::string& a, const std::string& b);

}  // namespace regulus::detail::attack
