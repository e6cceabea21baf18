// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "runtime/kernel/self_test.hpp"
#include "tests/property/kernel/pack_variants.hpp"

namespace regulus::detail::test {
namespace {

TEST(SelfTestFlags, FailsForOptimisedCodeCompiledWithoutTheRoundingFlags) {
  if (!supported(Isa::kAvx2)) GTEST_SKIP() << "needs AVX2";
  ASSERT_FALSE(unflagged_self_tests().empty());
  for (const Unflagged& program : unflagged_self_tests())
    EXPECT_TRUE(check_self_test(program.self_test, Isa::kAvx2)) << program.compiler;
}

}  // namespace
}  // namespace regulus::detail::test
