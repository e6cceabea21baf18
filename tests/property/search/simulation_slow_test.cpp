// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/simulations.hpp"

namespace regulus::detail::test {
namespace {

/// 10 002 searches.
TEST(SimulationOfMany, DelaysLossesRepetitionsAndDeathsChangeNothing) {
  expect_simulations_change_nothing(1667);
}

}  // namespace
}  // namespace regulus::detail::test
