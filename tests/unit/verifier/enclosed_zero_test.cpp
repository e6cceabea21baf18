// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the proof that a matrix loses rank in a small box, with its null vector.
#include "runtime/verifier/enclosed_zero.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/support/certificate_texts.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

struct Claim {
  std::vector<std::string> entries;
  std::size_t columns = 2;
  std::string x = "-1 : 2", y = "1/2 : 3/2";
  std::string more = "", alpha = "0";
};

/// A matrix over x and y, and a proof.
verifier::Verification of(const Claim& claim, const std::string& proof) {
  const std::string rows = std::to_string(claim.entries.size() / claim.columns);
  const std::string columns = std::to_string(claim.columns);
  const bool is_about_rank = claim.alpha == "0";
  std::string text = "regulus-certificate 1\nverdict SINGULARITY\nclaim " +
                     std::string(is_about_rank ? "" : "|det| of ") + "the full " + rows + 'x' +
                     columns + " matrix of the model is " +
                     (is_about_rank ? "singular" : "at most alpha") +
                     " at some pose of the variety\nmodel by hand\nsha256 -\nmotion only\nalpha " +
                     claim.alpha + "\nparameter x in " + claim.x + "\nparameter y in " + claim.y +
                     "\npose x = x\npose y = y\nmatrix " + rows + ' ' + columns + '\n';
  for (const std::string& entry : claim.entries) text += "entry " + entry + '\n';
  return verify_text(text + claim.more + "proof\nreason " + proof + "\nend\n");
}

/// "LO:HI" about a number.
std::string about(double x, double radius = 1e-11) {
  char text[64];
  std::snprintf(text, sizeof text, "%a:%a", x - radius, x + radius);
  return text;
}

std::string proof_at(const std::string& x, const std::string& y, const std::string& v,
                     const std::string& chosen = "0 1") {
  return "null-vector\npoint 0 " + x + ' ' + y + "\nchosen " + chosen + "\nvector " + v;
}

/// Rank 1 where x² = 2 and x·y = 1 alone: the last two entries of the second column are 2 and 1.
const Claim kTall{{"x^2", "2", "2", "2", "x*y", "1"}};
const double kX = 1.4142135623730951, kY = 0.70710678118654757;
const std::string kV = about(-1) + " 0x1p+0";

TEST(EnclosedZero, IsVerified) {
  const auto found = of(kTall, proof_at(about(kX), about(kY), kV));
  EXPECT_EQ(found.outcome, Outcome::kVerified) << found.reason;
  EXPECT_EQ(of(kTall, proof_at(about(kX), about(kY), "0x1p+0 " + about(-1))).outcome,
            Outcome::kVerified);
  EXPECT_EQ(
      of(kTall, proof_at(about(kX, 1e-5), about(kY, 1e-5), about(-1, 1e-5) + " 0x1p+0")).outcome,
      Outcome::kVerified);
}

TEST(EnclosedZero, OfASquareMatrixNeedsOneVariable) {
  const Claim square{{"x", "y", "y", "x"}};  // det = x² − y²
  EXPECT_EQ(of(square, proof_at(about(1), "0x1p+0", "0x1p+0 " + about(-1), "0")).outcome,
            Outcome::kVerified);
  EXPECT_EQ(of(square, proof_at("0x1p+0", about(1), "0x1p+0 " + about(-1), "1")).outcome,
            Outcome::kVerified);
  // The other variable may have any value of an interval.
  EXPECT_EQ(of(square, proof_at(about(1), about(1, 1e-12), "0x1p+0 " + about(-1), "0")).outcome,
            Outcome::kVerified);
}

TEST(EnclosedZero, IsNotVerifiedElsewhere) {
  for (const double away : {1e-9, -1e-9, 1e-3, 0.1}) {
    EXPECT_NE(of(kTall, proof_at(about(kX + away), about(kY), kV)).outcome, Outcome::kVerified);
    EXPECT_NE(of(kTall, proof_at(about(kX), about(kY + away), kV)).outcome, Outcome::kVerified);
    EXPECT_NE(of(kTall, proof_at(about(kX), about(kY), about(-1 + away) + " 0x1p+0")).outcome,
              Outcome::kVerified);
  }
  EXPECT_EQ(of(kTall, proof_at(about(1), about(1), kV)).outcome, Outcome::kRejected);
}

TEST(EnclosedZero, IsNotVerifiedForPoints) {
  EXPECT_NE(of(kTall, proof_at("0x1.6a09e667f3bcdp+0", about(kY), kV)).outcome, Outcome::kVerified);
  EXPECT_NE(of(kTall, proof_at(about(kX), about(kY), "-1 0x1p+0")).outcome, Outcome::kVerified);
}

TEST(EnclosedZero, IsNotVerifiedWhereTheRankIsAlmostLost) {
  for (const char* gap : {"1e-9", "1e-12", "1e-30"}) {
    // det = x² + gap² in the first two rows.
    const Claim miss{{"x", gap, "-" + std::string(gap), "x", "y - 1", "0"}};
    for (const double radius : {1e-6, 1e-9, 1e-11})
      EXPECT_NE(of(miss, proof_at(about(0, radius), about(1, radius), "0x1p+0 " + about(0, radius)))
                    .outcome,
                Outcome::kVerified)
          << gap;
  }
}

TEST(EnclosedZero, IsNotVerifiedWhereADeterminantTouchesZero) {
  const Claim touches{{"x", "1", "0", "x"}};
  for (const double radius : {1e-3, 1e-9, 1e-11})
    EXPECT_NE(of(touches, proof_at(about(0, radius), "0x1p+0", "0x1p+0 " + about(0, radius), "0"))
                  .outcome,
              Outcome::kVerified);
}

/// A solution for some value in an interval says nothing about another value.
TEST(EnclosedZero, NeedsUnknownsInsideTheirRanges) {
  Claim claim = kTall;
  claim.x = "sqrt(2) : sqrt(2)";
  EXPECT_EQ(of(claim, proof_at(about(kX), about(kY), kV)).outcome, Outcome::kRejected);
  claim.x = "0 : 1.41421356237";  // ends before the root
  EXPECT_NE(of(claim, proof_at(about(kX), about(kY), kV)).outcome, Outcome::kVerified);
  EXPECT_NE(of(claim, proof_at("upper", about(kY), kV)).outcome, Outcome::kVerified);
  claim.x = "0 : sqrt(2)";  // ends at the root
  EXPECT_NE(of(claim, proof_at(about(kX), about(kY), kV)).outcome, Outcome::kVerified);
  EXPECT_EQ(of(claim, proof_at("upper", about(kY), kV)).outcome, Outcome::kRejected);
}

/// x is fixed at the end of its range, where y and another variable reach the root.
TEST(EnclosedZero, MayBeAtAnEndThatIsNoUnknown) {
  Claim square{{"x*y", "1", "1", "1"}};  // det = x·y − 1
  square.x = "1 : sqrt(2)";
  EXPECT_EQ(of(square, proof_at("upper", about(kY), "0x1p+0 " + about(-1), "1")).outcome,
            Outcome::kVerified);
  EXPECT_NE(of(square, proof_at("lower", about(kY), "0x1p+0 " + about(-1), "1")).outcome,
            Outcome::kVerified);
}

TEST(EnclosedZero, IsWithinTheConstraintsWhereTheMatrixIsDefined) {
  const std::string proof = proof_at(about(kX), about(kY), kV);
  Claim claim = kTall;
  claim.more = "constraint x - 3/2\n";
  EXPECT_EQ(of(claim, proof).outcome, Outcome::kVerified);
  claim.more = "constraint x - 1414/1000\n";
  EXPECT_NE(of(claim, proof).outcome, Outcome::kVerified);
  claim.more = "constraint x^2 - 2\n";  // it holds in half of the box
  EXPECT_NE(of(claim, proof).outcome, Outcome::kVerified);
  claim.more = "defined 1/(x^2 - 2)\n";
  EXPECT_NE(of(claim, proof).outcome, Outcome::kVerified);
}

TEST(EnclosedZero, IsNoProofAboutAThreshold) {
  Claim square{{"x", "y", "y", "x"}};
  square.alpha = "1";
  EXPECT_EQ(of(square, proof_at(about(1), "0x1p+0", "0x1p+0 " + about(-1), "0")).outcome,
            Outcome::kRejected);
}

TEST(EnclosedZero, WithWrongLinesIsRejected) {
  const std::string x = about(kX), y = about(kY), v = kV;
  for (const std::string& proof :
       {proof_at(x, y, v, ""), proof_at(x, y, v, "0 1 1"), proof_at(x, y, v, "1 0"),
        proof_at(x, y, v, "0 0"), proof_at(x, y, v, "0 2"), proof_at(x, y, v, "0 -1"),
        proof_at(x, y, v, "0 x"), proof_at(x, y, "0x1p+0"),
        proof_at(x, y, about(-1) + ' ' + about(1)), proof_at(x, y, v + " 0x1p+0"),
        proof_at(x, y, "nan 0x1p+0"), proof_at(x, y, "inf 0x1p+0"), proof_at(x, y, "1:-1 0x1p+0"),
        "null-vector\npoint 0 " + x + ' ' + y,
        "null-vector\npoint 0 " + x + ' ' + y + "\nvector " + v,
        proof_at(x, y, v) + "\npath segment"})
    EXPECT_EQ(of(kTall, proof).outcome, Outcome::kRejected) << proof;
}

/// Three columns, of which the third takes no part: two rows and one variable are left.
TEST(EnclosedZero, MayConcernFewColumns) {
  Claim claim{{"x^2", "2", "0", "2", "2", "0", "0", "0", "1", "0", "0", "y"}, 3};
  const std::string v = kV + " 0x0p+0";
  EXPECT_EQ(of(claim, proof_at(about(kX), "0x1p+0", v, "0")).outcome, Outcome::kVerified);
  EXPECT_NE(of(claim, proof_at(about(kX), "0x1p+0", v, "1")).outcome, Outcome::kVerified);
  EXPECT_NE(of(claim, proof_at(about(kX), "0x1p+0", kV + ' ' + about(0), "0")).outcome,
            Outcome::kVerified);
  EXPECT_NE(of(claim, proof_at(about(kX + 1e-9), "0x1p+0", v, "0")).outcome, Outcome::kVerified);
  for (const char* entry : {"y - 3/4", "1e-300", "x - x + 1e-9"}) {
    claim.entries[6] = entry;  // no row of zeros any more
    EXPECT_NE(of(claim, proof_at(about(kX), "0x1p+0", v, "0")).outcome, Outcome::kVerified);
  }
}

TEST(EnclosedZero, NeedsAsManyVariablesAsEquationsAreLeft) {
  EXPECT_NE(of(kTall, proof_at(about(kX), about(kY), kV, "0")).outcome, Outcome::kVerified);
  EXPECT_NE(of({{"x", "y", "y", "x"}}, proof_at(about(1), about(1), "0x1p+0 " + about(-1))).outcome,
            Outcome::kVerified);
}

/// Boxes and vectors at random about and beside the root: VERIFIED only if they hold it.
TEST(ManyEnclosedZeros, AreVerifiedOnlyWithTheRoot) {
  RandomSource random(5);
  const auto part = [&] { return double(random.below(2001)) / 1000 - 1; };
  int verified = 0;
  for (int round = 0; round < 2000; ++round) {
    const double radius = std::pow(10.0, -double(random.below(12)) - 1);
    const double x = kX + 2 * radius * part(), y = kY + 2 * radius * part(),
                 v = -1 + 2 * radius * part();
    const auto outcome =
        of(kTall, proof_at(about(x, radius), about(y, radius), about(v, radius) + " 0x1p+0"))
            .outcome;
    if (outcome != Outcome::kVerified) continue;
    ++verified;
    EXPECT_LE(std::fabs(x - kX), radius + 1e-15);
    EXPECT_LE(std::fabs(y - kY), radius + 1e-15);
    EXPECT_LE(std::fabs(v + 1), radius + 1e-15);
  }
  EXPECT_GT(verified, 40);
}

}  // namespace
}  // namespace regulus::detail::test
