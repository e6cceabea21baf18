// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/hostile_platforms.hpp"

namespace regulus::detail::test {
namespace {

TEST(ManyHostilePlatforms, AreNeverFalselyComplete) { expect_no_false_list_of_poses(9, 2000); }

}  // namespace
}  // namespace regulus::detail::test
