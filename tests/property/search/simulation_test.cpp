// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/simulations.hpp"

namespace regulus::detail::test {
namespace {

TEST(Simulation, DelaysLossesRepetitionsAndDeathsChangeNothing) {
  expect_simulations_change_nothing(60);
}

}  // namespace
}  // namespace regulus::detail::test
