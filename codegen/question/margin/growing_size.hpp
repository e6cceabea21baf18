// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace regulus::detail {

/// The sizes that the words of a command line let grow, "LO:HI"; empty: another one grows.
struct GrowingSize {
  std::string scale{};      ///< of the ranges of a box variety
  std::string parameter{};  ///< "p=LO:HI": p is in [its declared low end, v]
};

}  // namespace regulus::detail
