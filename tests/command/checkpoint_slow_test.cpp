// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/interrupted_runs.hpp"

namespace regulus::detail::test {
namespace {

TEST(Checkpoint, TwoHundredKillsChangeNothing) { expect_kills_change_nothing(40, 5); }

}  // namespace
}  // namespace regulus::detail::test
