// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/engine/agreement.hpp"

namespace regulus::detail::test {
namespace {

constexpr Effort kLittle{80, 0, 20000};

TEST(Methods, AgreeOnThePlanarRobotWithTolerances) {
  const AgreementCase cases[] = {
      {"planar_3rpr", "regular", "base,platform=0.01", 0, Verdict::kNoSingularity},
      {"planar_3rpr", "crossing", "base,platform=0.01", 0, Verdict::kSingularity},
      {"planar_3rpr", "circle", "base,platform=0.01", 0, Verdict::kNoSingularity},
      {"planar_3rpr", "reach", "base=0.05", 0, Verdict::kNoSingularity}};
  for (const AgreementCase& c : cases) {
    Agreement agreement(c);
    agreement.expect_of_all(kLittle);
    EXPECT_GE(agreement.decided, 5) << c.motion;
  }
}

TEST(Methods, AgreeOnRandomModels) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const AgreementCase random{"", "only", "", seed};
    Agreement agreement(random);
    agreement.expect_of_all(kLittle);
    EXPECT_GE(agreement.decided + agreement.empty, 1) << seed;
  }
}

}  // namespace
}  // namespace regulus::detail::test
