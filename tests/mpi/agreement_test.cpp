// SPDX-License-Identifier: GPL-3.0-or-later
// Tests which instruction set the ranks of a job agree on, and which ranks they refuse.
#include "codegen/use/mpi/agreement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace regulus::detail {
namespace {

using testing::HasSubstr;

TEST(Agreement, IsTheBestSetThatAllHave) {
  const std::vector<RankIdentity> two = {{"a", "build", Isa::kAvx512}, {"b", "build", Isa::kAvx2}};
  EXPECT_EQ(compare(two, std::nullopt).isa, Isa::kAvx2);
  EXPECT_EQ(compare(two, Isa::kPortable).isa, Isa::kPortable);
  EXPECT_EQ(compare(two, Isa::kPortable).refusal, "");
  EXPECT_THAT(compare(two, Isa::kAvx512).refusal,
              HasSubstr("rank 1 on b: this processor cannot run avx512"));
}

TEST(Agreement, NamesARankOfAnotherBuild) {
  const std::vector<RankIdentity> three = {
      {"a", "build", Isa::kAvx2}, {"a", "build", Isa::kAvx2}, {"c", "other", Isa::kAvx2}};
  EXPECT_THAT(compare(three, std::nullopt).refusal,
              HasSubstr("rank 2 on c runs another build of regulus-mpi than rank 0 on a"));
}

}  // namespace
}  // namespace regulus::detail
