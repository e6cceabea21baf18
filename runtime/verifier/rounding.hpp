// SPDX-License-Identifier: Apache-2.0
// Sums of products in plain doubles, rounded to nearest, with one bound for all their roundings.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace regulus::verifier {

/// Limits of such sums: at most kMostTerms terms, and numbers of magnitude at most kLargest.
inline constexpr int kMostTerms = 1 << 12;
inline constexpr double kLargest = 0x1p200;

/// Returns true if all are within them. Then underflow in a product stays negligible in its use.
[[nodiscard]] inline bool is_moderate(const std::vector<double>& numbers) noexcept {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](double x) { return std::fabs(x) <= kLargest; });
}

/// Σ x·y in any order differs from the exact sum by at most this part of Σ |x||y|: a term goes
/// through at most kMostTerms + 2 roundings, each of a part 2^-53 at most.
inline constexpr double kRounding = 0x1p-40;

/// Returns an upper bound of an exact sum of products of a few magnitudes, from the computed sum:
/// its at most 2^16 roundings have lost a part 2^-37 at most, and underflows are far below 2^-300.
[[nodiscard]] inline double inflate(double sum) noexcept { return sum * (1 + 0x1p-36) + 0x1p-300; }

}  // namespace regulus::verifier
