// SPDX-License-Identifier: GPL-3.0-or-later
// How often a random test tries.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <vector>

namespace regulus::detail::test {

/// `all` where the environment has REGULUS_ALL_TRIALS, as `make test-all` does; otherwise `few`.
inline int trials(int few, int all) {
  return std::getenv("REGULUS_ALL_TRIALS") != nullptr ? all : few;
}

/// The half of some values that begins with the first or, with `at` = 1, the second of them.
template <class T>
std::vector<T> every_second(const std::vector<T>& values, std::size_t at) {
  std::vector<T> half;
  for (; at < values.size(); at += 2) half.push_back(values[at]);
  return half;
}

}  // namespace regulus::detail::test
