// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/certificate/certificate_tampering.hpp"

namespace regulus::detail::test {
namespace {

TEST(ManyRandomChanges, NeverLeadToAFalseClaimThatIsVerified) {
  RandomSource random(20261123);
  const std::string proof = certify(robot("robot_2", "table5_20", "20")).text;
  EXPECT_LT(judge_random_changes(proof, 3000, random), 2000)
      << "labels, rules and cuts can be changed, but not most of the bytes";
  judge_random_changes(certify(robot("planar_3rpr", "regular", "0.2")).text, 4000, random);
  ModelOptions threshold = robot("robot_1", "wide_15");
  threshold.alpha = "0.001";
  judge_random_changes(certify(threshold).text, 3000, random);
}

}  // namespace
}  // namespace regulus::detail::test
