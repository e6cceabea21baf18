// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the proof that a matrix with more rows than columns loses rank at a point.
#include <gtest/gtest.h>

#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

/// A 3×2 matrix over x in `range` and y in [1, 3/2], and a proof.
verifier::Verification of(const std::vector<std::string>& entries, const std::string& proof,
                          const std::string& range = "-1 : 2", const std::string& more = "") {
  std::string text =
      "regulus-certificate 1\nverdict SINGULARITY\nclaim the full 3x2 matrix of the model is "
      "singular at some pose of the variety\nmodel by hand\nsha256 -\nmotion only\nalpha 0\n"
      "parameter x in " +
      range + "\nparameter y in 1 : 3/2\npose x = x\npose y = y\nmatrix 3 2\n";
  for (const std::string& entry : entries) text += "entry " + entry + '\n';
  return verify_text(text + more + "proof\nreason " + proof + "\nend\n");
}

const std::vector<std::string> kAtZero{"x", "y", "2*x", "3*y", "x*y", "1"};
const std::vector<std::string> kAtQuarterTurn{"cos(x)", "y", "2*cos(x)", "3", "cos(x)*y", "1"};

TEST(LostRank, IsVerifiedAtItsPoint) {
  EXPECT_EQ(of(kAtZero, "lost-rank\npoint 0 0x0p+0 0x1p+0").outcome, Outcome::kVerified);
  EXPECT_EQ(of(kAtZero, "lost-rank\npoint 0 =0/1 =11/10").outcome, Outcome::kVerified);
  EXPECT_EQ(of(kAtZero, "lost-rank\npoint 0 lower upper", "0 : 1").outcome, Outcome::kVerified);
  EXPECT_EQ(of(kAtQuarterTurn, "lost-rank\npoint 0 =1*pi/2 0x1p+0").outcome, Outcome::kVerified);
}

TEST(LostRank, IsNotVerifiedElsewhere) {
  for (const char* point :
       {"0x1p-1000 0x1p+0", "=1/1000000000000000000000 0x1p+0", "0x1p-1 0x1p+0"})
    EXPECT_NE(of(kAtZero, std::string("lost-rank\npoint 0 ") + point).outcome, Outcome::kVerified)
        << point;
  // The double next to pi/2.
  EXPECT_NE(of(kAtQuarterTurn, "lost-rank\npoint 0 0x1.921fb54442d18p+0 0x1p+0").outcome,
            Outcome::kVerified);
}

TEST(LostRank, IsNotVerifiedWhereTheRankIsAlmostLost) {
  const std::vector<std::string> almost{"x", "y", "2*x", "3*y", "1e-300", "1"};
  EXPECT_NE(of(almost, "lost-rank\npoint 0 0x0p+0 0x1p+0").outcome, Outcome::kVerified);
}

TEST(LostRank, IsRejectedOutsideTheRanges) {
  EXPECT_EQ(of(kAtZero, "lost-rank\npoint 0 =0/1 =2/1").outcome, Outcome::kRejected);
  EXPECT_EQ(of(kAtZero, "lost-rank\npoint 0 =0/1 0x1p+0", "1/10 : 1").outcome, Outcome::kRejected);
  EXPECT_EQ(of(kAtQuarterTurn, "lost-rank\npoint 0 =1*pi/2 0x1p+0", "-1 : 3/2").outcome,
            Outcome::kRejected);
}

TEST(LostRank, NeedsAPointWithinTheConstraintsWhereTheMatrixIsDefined) {
  const std::string proof = "lost-rank\npoint 0 =0/1 0x1p+0";
  EXPECT_EQ(of(kAtZero, proof, "-1 : 2", "constraint x\n").outcome, Outcome::kVerified);
  EXPECT_NE(of(kAtZero, proof, "-1 : 2", "constraint 1e-300 - x\n").outcome, Outcome::kVerified);
  EXPECT_NE(of(kAtZero, proof, "-1 : 2", "defined 1/x\n").outcome, Outcome::kVerified);
}

TEST(LostRank, HasNumbersAsCoordinates) {
  for (const char* point : {"=1/0", "=y", "=sqrt(0-1)", "=", "=0/1:0/1", "0", "=0 =0 =0"})
    EXPECT_EQ(of(kAtZero, std::string("lost-rank\npoint 0 ") + point + " 0x1p+0").outcome,
              std::string(point) == "0" ? Outcome::kVerified : Outcome::kRejected)
        << point;
}

TEST(LostRank, IsTheOnlyReasonForMoreRowsThanColumns) {
  for (const char* reason : {"small-determinant", "always-singular"})
    EXPECT_EQ(of(kAtZero, std::string(reason) + "\npoint 0 0x0p+0 0x1p+0").outcome,
              Outcome::kRejected);
}

}  // namespace
}  // namespace regulus::detail::test
