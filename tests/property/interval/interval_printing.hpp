// SPDX-License-Identifier: GPL-3.0-or-later
// Prints intervals exactly in the messages of failed tests.
#pragma once

#include <ostream>

#include "runtime/interval/type.hpp"

namespace regulus {

inline void PrintTo(const Interval& x, std::ostream* out) {
  *out << std::hexfloat << '[' << x.lo << ", " << x.hi << ']' << std::defaultfloat;
}

}  // namespace regulus
