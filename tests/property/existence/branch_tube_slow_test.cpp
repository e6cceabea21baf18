// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/planted_cases.hpp"

namespace regulus::detail::test {
namespace {

TEST(ManyPlantedRoots, AreNeverTakenForOne) { expect_no_false_one(7, 100000); }

}  // namespace
}  // namespace regulus::detail::test
