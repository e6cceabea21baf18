// SPDX-License-Identifier: GPL-3.0-or-later
// The notation of numbers and verdicts in the tables.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "runtime/problem/result.hpp"

namespace regulus::detail::test {

inline const char* letter(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoSingularity:
      return "N";
    case Verdict::kSingularity:
      return "S";
    case Verdict::kPossibleProblem:
      return "P";
  }
  return "";
}

/// Prints up to five digits in full; rounds larger numbers to thousands.
inline std::string count(std::uint64_t boxes) {
  constexpr std::uint64_t kThousand = 1000;
  return boxes < 100 * kThousand ? fmt::format("{}", boxes)
                                 : fmt::format("{} k", (boxes + kThousand / 2) / kThousand);
}

}  // namespace regulus::detail::test
