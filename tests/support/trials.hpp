// SPDX-License-Identifier: GPL-3.0-or-later
// How often a random test tries.
#pragma once

#include <cstdlib>

namespace regulus::test {

/// `all` where the environment has REGULUS_ALL_TRIALS, as `make test-all` does; otherwise `few`.
inline int trials(int few, int all) {
  return std::getenv("REGULUS_ALL_TRIALS") != nullptr ? all : few;
}

}  // namespace regulus::test
