// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/engine/agreement.hpp"
#include "tests/support/parameter_name.hpp"

namespace regulus::detail::test {
namespace {

constexpr Effort kMuch{4000, 1.5, 100000};

class MethodsOn : public testing::TestWithParam<AgreementCase> {};

TEST_P(MethodsOn, Agree) {
  Agreement agreement(GetParam());
  agreement.expect_of_all(kMuch);
  EXPECT_GE(agreement.decided, 2);
}

constexpr auto kFree = Verdict::kNoSingularity;
constexpr auto kSingular = Verdict::kSingularity;

INSTANTIATE_TEST_SUITE_P(
    Robots, MethodsOn,
    testing::Values(AgreementCase{"robot_1", "table4_1", "base,platform=0.05", 0, kFree},
                    AgreementCase{"robot_1", "table4_5", "base,platform=0.05", 0, kFree},
                    AgreementCase{"robot_1", "wide_15", "", 0, kFree},
                    AgreementCase{"robot_1", "wide_40", "", 0, kSingular},
                    AgreementCase{"robot_1", "table6_5_5", "base,platform=0.05", 0, kFree},
                    AgreementCase{"robot_1", "table6_5_15", "base,platform=0.05", 0, kFree},
                    AgreementCase{"robot_1", "table6_15_15", "base,platform=0.5", 0, kSingular},
                    AgreementCase{"robot_1", "T1", "base=0.05", 0, kFree},
                    AgreementCase{"robot_1", "T2_errors", "base,platform=0.05", 0, kFree},
                    AgreementCase{"robot_2", "table5_20", "base,platform=5", 0, kFree},
                    AgreementCase{"robot_2", "table5_40", "base,platform=5", 0, kSingular},
                    AgreementCase{"planar_3rpr", "regular", "base,platform=0.1"},
                    AgreementCase{"planar_3rpr", "crossing", "base=0.1", 0, kSingular},
                    AgreementCase{"planar_3rpr", "reach", "base,platform=0.05", 0, kFree}),
    parameter_name);

TEST(Methods, AgreeOnManyRandomModels) {
  int decided = 0;
  for (std::uint64_t seed = 100; seed < 200; ++seed) {
    const AgreementCase random{"", "only", "", seed};
    Agreement agreement(random);
    agreement.expect_of_all({1000, 0.2, 20000});
    decided += agreement.decided;
  }
  EXPECT_GE(decided, 1000);
}

}  // namespace
}  // namespace regulus::detail::test
