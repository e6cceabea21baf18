// SPDX-License-Identifier: GPL-3.0-or-later
// Frames in frames.
#pragma once

#include "codegen/model/exact/exact_algebra.hpp"

namespace regulus::detail {

/// A rotation R and a translation p: a point x of the moved frame is R·x + p in the other.
struct Placement {
  GiNaC::matrix R = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Point p = {0, 0, 0};
};

/// Returns the frame that `second` has in the frame of which `first` is the frame.
///
/// Throws    ParseRefusal if an entry has more than kMostEntryTerms terms.
[[nodiscard]] Placement compose(const Placement& first, const Placement& second);

/// Turns of angles that are not multiples of pi/12 multiply the terms of their products.
constexpr std::size_t kMostEntryTerms = 200;

}  // namespace regulus::detail
