// SPDX-License-Identifier: GPL-3.0-or-later
// Makes rows of K in the form that the ABI demands: on a grid.
#pragma once

#include <cmath>
#include <vector>

#include "runtime/kernel/abi.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

/// Returns a row of multiples of one power of two, at most 2^largest_exponent. Half of the rows
/// have entries near the limits of the grid.
inline std::vector<double> corner_row(RandomSource& random, std::size_t length,
                                      int largest_exponent) {
  constexpr std::uint64_t kEnd = std::uint64_t{1} << REGULUS_POINT_BITS;
  const int spread = largest_exponent > 60 ? 700 : 40;
  const int exponent = largest_exponent - REGULUS_POINT_BITS -
                       static_cast<int>(random.below(static_cast<std::uint64_t>(spread)));
  std::vector<double> row;
  for (std::size_t i = 0; i < length; ++i) {
    const std::uint64_t corners[] = {0, 1, 3, kEnd / 2, kEnd / 2 + 1, kEnd - 1};
    const std::uint64_t size = random.one_in(2) ? corners[random.below(6)] : random.below(kEnd);
    const double sign = random.one_in(2) ? -1.0 : 1.0;
    row.push_back(sign * std::ldexp(static_cast<double>(size), exponent));
  }
  return row;
}

}  // namespace regulus::detail::test
