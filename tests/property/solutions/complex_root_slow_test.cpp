// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/planted_complex_roots.hpp"

namespace regulus::detail::test {
namespace {

TEST(ManyPlantedComplexRoots, AreNeverTakenForOthers) { expect_no_false_root(2, 2'000'000); }

}  // namespace
}  // namespace regulus::detail::test
