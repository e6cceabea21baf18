// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/kernel/isa.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "runtime/kernel/abi.hpp"

namespace regulus::detail {
namespace {

using ::testing::Contains;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<std::string> flags(Isa isa) {
  const auto all = compile_flags(isa);
  return {all.begin(), all.end()};
}

TEST(Isa, NamesAreReadBack) {
  for (const Isa isa : kAllIsas) EXPECT_EQ(parse_isa(name(isa)), isa);
}

TEST(Isa, OtherWordsAreNoInstructionSet) {
  for (const char* word : {"", "AVX2", "avx", "avx512f", "native", "portable "})
    EXPECT_EQ(parse_isa(word), std::nullopt) << word;
}

TEST(Isa, TheBestOneIsSupportedAndNoFasterOneIs) {
  EXPECT_TRUE(supported(best_isa()));
  for (const Isa isa : kAllIsas) {
    if (isa == best_isa()) break;
    EXPECT_FALSE(supported(isa)) << name(isa);
  }
  EXPECT_TRUE(supported(Isa::kPortable));
}

TEST(Isa, FlagsDefineTheMacroThatChoosesThePack) {
  EXPECT_THAT(flags(Isa::kAvx512), Contains("-DREGULUS_ISA_AVX512"));
  EXPECT_THAT(flags(Isa::kAvx2), Contains("-DREGULUS_ISA_AVX2"));
  EXPECT_THAT(flags(Isa::kPortable), Contains("-DREGULUS_ISA_PORTABLE"));
}

TEST(Isa, PortableKernelsNeedNoParticularProcessor) {
  EXPECT_THAT(flags(Isa::kPortable), Not(Contains(StartsWith("-m"))));
}

TEST(Isa, OnlyAvx2NeedsUpwardRounding) {
  EXPECT_EQ(required_rounding(Isa::kAvx512), unsigned{REGULUS_ROUND_NEAREST});
  EXPECT_EQ(required_rounding(Isa::kAvx2), unsigned{REGULUS_ROUND_UPWARD});
  EXPECT_EQ(required_rounding(Isa::kPortable), unsigned{REGULUS_ROUND_NEAREST});
}

}  // namespace
}  // namespace regulus::detail
