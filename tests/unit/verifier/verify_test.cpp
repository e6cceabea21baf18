// SPDX-License-Identifier: GPL-3.0-or-later
// Small certificates; each tests one thing that the verifier must distinguish.
#include <gtest/gtest.h>

#include <cfenv>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

Outcome outcome_of(const std::string& text) { return verify_text(text).outcome; }

Outcome of_scalar(const std::string& entry, const std::string& range = "1 : 2") {
  return outcome_of(scalar_question(entry, range) + kOneLeaf);
}

TEST(AnEntryWithoutZero, IsVerified) {
  for (const char* entry :
       {"x", "x^2 - 1/2", "sin(x)", "1/x", "sqrt(x) - 3", "exp(-x)", "log(x + 1)", "atan2(x, -x)",
        "-abs(x)", "x - x + 1", "asin(x/3)", "acos(x/3)", "tan(x/2)", "cos(pi*x) - 3/2", "1e-3*x"})
    EXPECT_EQ(of_scalar(entry), Outcome::kVerified) << entry;
}

TEST(AnEntryThatChangesItsSign, IsRejected) {
  for (const char* entry : {"x - 3/2", "sin(2*x)", "x^2 - 2", "1 - log(x + 1)"})
    EXPECT_EQ(of_scalar(entry), Outcome::kRejected) << entry;
}

TEST(AnEntryThatTouchesZero, IsUnfinished) {
  for (const char* entry : {"(x - 3/2)^2", "x - 1", "abs(x - 3/2)", "x - x", "2 - x"})
    EXPECT_EQ(of_scalar(entry), Outcome::kUnfinished) << entry;
}

TEST(AnEntryThatIsNotDefinedSomewhere, IsNotVerified) {
  for (const char* entry :
       {"1/(x - 3/2)^2", "sqrt(x - 3/2) + 1", "2 + log(x - 1)", "3 + asin(x)", "x*(1/(x - 1))",
        "tan(pi*x/2)^2 + 1", "9 + atan2(x - 3/2, -x)", "3 + 0*sqrt(x - 3/2)"})
    EXPECT_NE(of_scalar(entry), Outcome::kVerified) << entry;
}

TEST(AConditionThatIsNotDefined, IsNotVerified) {
  EXPECT_EQ(outcome_of(scalar_question("x") + "defined sqrt(x - 5/4)\n" + kOneLeaf),
            Outcome::kUnfinished);
  EXPECT_EQ(outcome_of(scalar_question("x") + "defined sqrt(x - 1)\n" + kOneLeaf),
            Outcome::kVerified);
  EXPECT_NE(outcome_of(scalar_question("x") + "motion-defined 1/(x - 3/2)\n" + kOneLeaf),
            Outcome::kVerified);
}

TEST(ARangeWithIrrationalEnds, IsEnclosedFromOutside) {
  EXPECT_EQ(of_scalar("x - pi/12 - 1e-12", "0 : pi/12"), Outcome::kVerified);
  EXPECT_NE(of_scalar("x - pi/12", "0 : pi/12"), Outcome::kVerified);
  EXPECT_NE(of_scalar("x - 1/10", "0 : 1/10"), Outcome::kVerified);
}

TEST(AnEmptyRange, IsRejected) { EXPECT_EQ(of_scalar("x", "2 : 1"), Outcome::kRejected); }

TEST(PosesOutsideAConstraint, AreNotClaimed) {
  const std::string constraint = "constraint 3/2 - x\n";  // x ≥ 3/2
  EXPECT_EQ(outcome_of(scalar_question("x - 5/4") + constraint + kOneLeaf), Outcome::kVerified);
  EXPECT_NE(outcome_of(scalar_question("x - 7/4") + constraint + kOneLeaf), Outcome::kVerified);
  // No pose is outside a constraint that is undefined there.
  EXPECT_NE(
      outcome_of(scalar_question("x - 5/4") + "constraint 1/(5/4 - x) + 9 + 3/2 - x\n" + kOneLeaf),
      Outcome::kVerified);
}

/// Makes four rows: the verifier tries forms of the determinant only after many cuts of a leaf.
std::string four_by_four(const std::string& alpha, const std::string& corner,
                         const std::string& claim) {
  std::string text = "regulus-certificate 1\nverdict NO SINGULARITY\nclaim " + claim +
                     "\nmodel m\nsha256 -\nmotion only\nalpha " + alpha +
                     "\nparameter x in 1/3 : 1\nparameter y in -1/9 : 1/9\npose x = x\n"
                     "pose y = y\nmatrix 4 4\n";
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) text += "entry " + (i == j ? corner : std::string("y")) + '\n';
  return text + "proof\nl 0 h-matrix\nend 1\n";
}

/// √ has no derivative at 0, and asin none at 1.
TEST(AMatrixWithoutDerivatives, IsVerifiedByItsEnclosure) {
  const std::string full =
      "the full 4x4 matrix of the model is defined and has full rank at every pose of the variety";
  const std::string beyond =
      "|det| of the full 4x4 matrix of the model exceeds alpha at every pose of the variety";
  for (const std::string corner : {"3 + sqrt(x - 1/3)", "3 + asin(3*x - 2)", "4 - acos(x)"}) {
    verifier::Options one;
    one.max_boxes = 1;
    EXPECT_EQ(verify_text(four_by_four("0", corner, full), one).outcome, Outcome::kVerified)
        << corner;
    EXPECT_EQ(verify_text(four_by_four("1/2", corner, beyond)).outcome, Outcome::kVerified)
        << corner;
    EXPECT_NE(verify_text(four_by_four("900", corner, beyond)).outcome, Outcome::kVerified)
        << corner;
  }
}

std::string two_by_two(const std::string& alpha, const std::string& entries,
                       const std::string& words) {
  return "regulus-certificate 1\nverdict NO SINGULARITY\nclaim " + words +
         "\nmodel m\nsha256 -\nmotion only\nalpha " + alpha +
         "\nparameter x in -1 : 1\nuncertain a = 2 +- 1/4\nuncertain b = 2 +- 1/4\nball a b\n"
         "pose x = x +- 1/8\nmatrix 2 2\n" +
         entries + kOneLeaf;
}

constexpr const char* kAbove =
    "|det| of the full 2x2 matrix of the model exceeds alpha at every pose and value of the 3 "
    "uncertain quantities of the variety";

TEST(AThreshold, IsExceededWithUncertainQuantitiesInABallAndAControlError) {
  // det = a·b − x², |x| ≤ 9/8, (a, b) within 1/4 of (2, 2): at least (2 − √2/8)² − (9/8)² = 2.058,
  // and without the ball (7/4)² − (9/8)² = 1.797.
  const std::string entries = "entry a\nentry x\nentry x\nentry b\n";
  EXPECT_EQ(outcome_of(two_by_two("19/10", entries, kAbove)), Outcome::kVerified);
  EXPECT_NE(outcome_of(two_by_two("21/10", entries, kAbove)), Outcome::kVerified);
  EXPECT_EQ(outcome_of(two_by_two("4", entries, kAbove)), Outcome::kRejected);
}

TEST(AThreshold, IsAboutTheScaledRows) {
  const std::string entries = "entry a\nentry x\nentry x\nentry b\nscale 1/10\nscale 10\n";
  EXPECT_EQ(outcome_of(two_by_two("19/10", entries, kAbove)), Outcome::kVerified);
  const std::string smaller = "entry a\nentry x\nentry x\nentry b\nscale 1/10\nscale 9\n";
  EXPECT_NE(outcome_of(two_by_two("19/10", smaller, kAbove)), Outcome::kVerified);
}

TEST(AMatrixWithMoreRowsThanColumns, IsVerifiedForFullColumnRank) {
  const auto text = [](const std::string& second) {
    return "regulus-certificate 1\nverdict NO SINGULARITY\nclaim the full 2x1 matrix of the model "
           "is defined and has full rank at every pose of the variety\nmodel m\nsha256 -\nmotion "
           "only\nalpha 0\nparameter x in -1 : 1\npose x = x\nmatrix 2 1\nentry x\nentry " +
           second + "\n" + kOneLeaf;
  };
  EXPECT_EQ(outcome_of(text("1 - x")), Outcome::kVerified);
  EXPECT_NE(outcome_of(text("2*x")), Outcome::kVerified);
}

/// Makes (1 1; 1 -1) plus `factor` times entries known up to `spread`, x in [-1/2, 1/2]. With
/// factor 1 it is singular from spread 1 on; its norm, however scaled, decides only up to 1/2.
Outcome of_spread(const std::string& spread, const std::string& factor = "1") {
  std::string text =
      "regulus-certificate 1\nverdict NO SINGULARITY\nclaim the full 2x2 matrix of the model is "
      "defined and has full rank at every pose and value of the 4 uncertain quantities of the "
      "variety\nmodel by hand\nsha256 -\nmotion only\nalpha 0\nparameter x in -1/2 : 1/2\n";
  for (const char* name : {"a", "b", "c", "d"})
    text += "uncertain " + std::string(name) + " = 0 +- " + spread + "\n";
  text += "pose x = x\nmatrix 2 2\n";
  for (const char* entry : {"1 + a*", "1 + b*", "1 + c*", "-1 + d*"})
    text += "entry " + std::string(entry) + factor + "\n";
  verifier::Options one_box;
  one_box.max_boxes = 1;
  return verify_text(text + kOneLeaf, one_box).outcome;
}

TEST(ASpreadOfEntries, IsVerifiedUpToTheCriticalOne) {
  for (const char* safe : {"0.49", "0.9", "0.95"})
    EXPECT_EQ(of_spread(safe), Outcome::kVerified) << safe;
  for (const char* critical : {"1", "1.01"})
    EXPECT_NE(of_spread(critical), Outcome::kVerified) << critical;
}

TEST(ASpreadThatGrowsWithThePose, CountsAtItsLargest) {
  EXPECT_EQ(of_spread("0.45", "(1 + x)"), Outcome::kVerified);
  EXPECT_NE(of_spread("0.7", "(1 + x)"), Outcome::kVerified);
}

TEST(ATree, IsVerifiedLeafByLeaf) {
  const std::string question = scalar_question("x - 1/2");
  const auto v = verify_text(question +
                             "proof\ns 0 0 0x1.8p+0\ns 2 0 0x1.cp+0\nl 4 filter\nl 1 "
                             "multiprecision\nl 3 outside\nend 3\n");
  EXPECT_EQ(v.outcome, Outcome::kVerified) << v.reason;
  EXPECT_EQ(v.leaves, 3u);
}

TEST(AWitnessOfOppositeSigns, IsVerifiedIfTheMatrixIsDefinedInBetween) {
  const std::string points =
      "proof\nreason opposite-signs\npoint + 0x1p+1\npoint - 0x1p+0\npath segment\nend\n";
  const auto question = [](const std::string& entry, const std::string& more = "") {
    return scalar_question(entry, "0 : 3", kSingular1) + more;
  };
  EXPECT_EQ(outcome_of(question("x - 3/2") + points), Outcome::kVerified);
  EXPECT_EQ(outcome_of(question("1/(x - 3/2)") + points), Outcome::kUnfinished) << "a pole";
  EXPECT_EQ(outcome_of(question("x - 1/2") + points), Outcome::kRejected);
  EXPECT_EQ(outcome_of(question("x - 3/2", "constraint 1/100 - (x - 3/2)^2\n") + points),
            Outcome::kUnfinished)
      << "the segment leaves the variety";
  EXPECT_EQ(outcome_of(question("x - 3/2", "constraint (x - 3/2)^2 - 1\n") + points),
            Outcome::kVerified);
}

TEST(AWitnessOfASmallDeterminant, IsVerifiedAtOnePoint) {
  const std::string head =
      "regulus-certificate 1\nverdict SINGULARITY\nclaim |det| of the full 1x1 matrix of the model "
      "is at most alpha at some pose of the variety\nmodel m\nsha256 -\nmotion only\nalpha 1/2\n"
      "parameter x in 0 : 3\npose x = x\nmatrix 1 1\nentry x\nscale 2\nproof\nreason "
      "small-determinant\npoint 0 ";
  EXPECT_EQ(outcome_of(head + "0x1p-2\nend\n"), Outcome::kVerified);
  EXPECT_EQ(outcome_of(head + "0x1.1p-2\nend\n"), Outcome::kRejected);
  EXPECT_EQ(outcome_of(head + "-0x1p-2\nend\n"), Outcome::kRejected) << "outside the range";
}

TEST(EffortThatIsBounded, LeavesAProofUnfinished) {
  verifier::Options options;
  options.max_boxes = 3;
  const std::string text = scalar_question("1 + sin(20*x)*cos(20*x)") + kOneLeaf;
  EXPECT_EQ(verify_text(text, options).outcome, Outcome::kUnfinished);
  EXPECT_EQ(verify_text(text).outcome, Outcome::kVerified);
}

TEST(ARoundingMode, IsToNearestForTheTimeOfTheCheckAndThenAsBefore) {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const Outcome safe = outcome_of(scalar_question("x") + kOneLeaf);
    const Outcome singular = outcome_of(scalar_question("x - 1") + kOneLeaf);
    EXPECT_EQ(std::fegetround(), mode);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(safe, Outcome::kVerified);
    EXPECT_NE(singular, Outcome::kVerified);
  }
}

#ifdef __SSE2__
TEST(AnArithmeticThatFlushesToZero, IsNotThatOfTheCheck) {
  const unsigned usual = _mm_getcsr();
  for (const unsigned mode : {0x8000U, 0x0040U}) {  // these flush results, or operands
    _mm_setcsr(usual | mode);
    const Outcome outcome = outcome_of(scalar_question("x") + kOneLeaf);
    EXPECT_EQ(_mm_getcsr() & mode, mode);
    _mm_setcsr(usual);
    EXPECT_EQ(outcome, Outcome::kVerified);
  }
}

/// Otherwise an overflow, a division by 0 and an inexact result would each stop the process.
TEST(ExceptionsThatStopTheProcess, AreMaskedForTheTimeOfTheCheck) {
  const unsigned usual = _mm_getcsr();
  _mm_setcsr(usual & ~0x1f80U & ~0x3fU);
  const Outcome outcome = outcome_of(scalar_question("exp(x)/3 + 1/x") + kOneLeaf);
  const unsigned after = _mm_getcsr();
  _mm_setcsr(usual);
  EXPECT_EQ(outcome, Outcome::kVerified);
  EXPECT_EQ(after & 0x1f80U, 0U);
}
#endif

}  // namespace
}  // namespace regulus::detail::test
