// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates about singular configurations of closures: genuine ones, and forged ones.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/closure_cases.hpp"
#include "tests/support/damage.hpp"

namespace regulus::detail::test {
namespace {

const char kAlong[] = "arc 0 0x0p+0 : 0x1p-2 0x1p-3 0x1.bb67aep-1 -0x1.279a74p+0 0x1p-4\n";
const char kAcross[] = "arc 1 -0x1p-2 : 0x1.9p-1 0x1p-2 0x1.ep-2 -0x1p-2 0x1.4p-2\n";
const char kEnd[] =
    "fold 0x1p-1 0x0p+0 0x1p+0 0x1p-20 0x1p-20 0x1p-20 0x1p+0\n"
    "end\n";

/// p² = x + 1 from (0, 1), whose branch ends at (−1, 0).
std::string question(const std::string& range = "-2 : 1",
                     const std::string& equation = "p^2 - x - 1",
                     const std::string& unknown = "1 +- 1/2", const std::string& start = "0") {
  return "regulus-certificate 1\nverdict SINGULARITY\nclaim " +
         format::describe_closure_claim({1, 1}, true) +
         "\nmodel m\nsha256 -\nmotion m\nalpha 0\nparameter x in " + range +
         "\npose x = x\nunknown p = " + unknown + "\nstart " + start + "\nequation " + equation +
         "\nproof\n";
}

std::string with_proof(const std::string& head,
                       const std::string& arcs = std::string(kAlong) + kAcross,
                       const std::string& end = kEnd, const std::string& towards = "-0x1p+1") {
  return head + "reason fold\ntowards " + towards + '\n' + arcs + end;
}

TEST(ACertificateOfAFold, IsVerified) {
  const Verification v = verify_text(with_proof(question()));
  EXPECT_TRUE(is(Outcome::kVerified, v, ""));
  EXPECT_EQ(v.claim,
            "configurations of the mechanism lead from the start to one where the equation is "
            "singular, at some pose of the variety");
}

/// The start may be at an end of its range that no double is.
TEST(ACertificateOfAFold, MayStartAtAnEndOfTheRange) {
  const std::string shifted =
      question("-2 + pi/30 : pi/30", "p^2 - (x - pi/30) - 1", "1 +- 1/2", "pi/30");
  // The line ends at −1.8 and x is 1.8 + π/30 times t below the start: t = 1/(1.8 + π/30) at the fold.
  const std::string arcs =
      "arc 0 0 : 0.25 0.125 0.8733 -1.0910 0.0625\n"
      "arc 1 -0.25 : 0.79 0.25 0.492 -0.2624 0.3\n";
  const std::string fold = "fold 0.52497 0 1 0.001 0.001 0.001 1\nend\n";
  EXPECT_TRUE(is(Outcome::kVerified, verify_text(with_proof(shifted, arcs, fold, "-1.8")), ""));
  const std::string beside =
      question("-2 + pi/30 : pi/30", "p^2 - (x - pi/30) - 1", "1 +- 1/2", "pi/30 - 1e-40");
  EXPECT_TRUE(is(Outcome::kUnfinished, verify_text(with_proof(beside, arcs, fold, "-1.8")),
                 "the start may not be"));
}

TEST(AForgedFold, OfAnotherQuestionIsNotVerified) {
  // The range ends before the fold: the line leaves it.
  EXPECT_TRUE(
      is(Outcome::kRejected, verify_text(with_proof(question("-0.9 : 1"))), "outside the ranges"));
  // A line that ends within the range does not reach the fold.
  EXPECT_FALSE(is(Outcome::kVerified,
                  verify_text(with_proof(question("-0.9 : 1"), std::string(kAlong) + kAcross, kEnd,
                                         "-0x1.cp-1")),
                  ""));
  // No fold: the slope of p³ + p has one sign.
  EXPECT_FALSE(
      is(Outcome::kVerified, verify_text(with_proof(question("-2 : 1", "p^3 + p - x - 2"))), ""));
  // Another start, or two of them.
  EXPECT_FALSE(is(Outcome::kVerified,
                  verify_text(with_proof(question("-2 : 1", "p^2 - x - 1", "-1 +- 1/2"))), ""));
  EXPECT_FALSE(is(Outcome::kVerified,
                  verify_text(with_proof(question("-2 : 1", "p^2 - x - 1", "1 +- 3"))), ""));
  // The equation, or the motion, has no value on the way.
  for (const char* const line : {"defined 1/(p - 0.3)\n", "motion-defined log(x + 0.5)\n"}) {
    const std::string head = with_other(question(), "proof\n", line + std::string("proof\n"));
    EXPECT_FALSE(is(Outcome::kVerified, verify_text(with_proof(head)), "")) << line;
  }
  EXPECT_TRUE(
      is(Outcome::kUnfinished,
         verify_text(with_proof(with_other(question(), "proof\n", "constraint -x - 5\nproof\n"))),
         "constraints"));
}

TEST(AForgedFold, WithAGapIsNotVerified) {
  EXPECT_TRUE(is(Outcome::kUnfinished, verify_text(with_proof(question(), kAcross)), "start"));
  EXPECT_TRUE(is(Outcome::kUnfinished, verify_text(with_proof(question(), kAlong)), "last arc"));
  EXPECT_TRUE(is(Outcome::kRejected, verify_text(with_proof(question(), "")), "arc"));
  // The arc across begins beyond the one along the line.
  const std::string late = "arc 1 -0x1p-2 : 0x1p-1 0x1p-2 0x1.ep-2 -0x1p-2 0x1.4p-2\n";
  EXPECT_TRUE(is(Outcome::kUnfinished, verify_text(with_proof(question(), kAlong + late)),
                 "begins at a configuration"));
  // The mirrored branch is another part of the curve until the fold.
  const std::string mirror = "arc 0 0x0p+0 : 0x1p-2 0x1p-3 -0x1.bb67aep-1 0x1.279a74p+0 0x1p-4\n";
  EXPECT_TRUE(is(Outcome::kUnfinished, verify_text(with_proof(question(), mirror + kAcross)),
                 "may not hold the configuration at the start"));
  // A fold that is not on the arc, or beyond the line.
  EXPECT_FALSE(is(Outcome::kVerified, verify_text(with_proof(question(), kAlong, kEnd)), ""));
  EXPECT_FALSE(is(Outcome::kVerified,
                  verify_text(with_proof(question(), std::string(kAlong) + kAcross, kEnd, "-0.99")),
                  ""));
}

/// x = p³/3 − 3p²/2 + 2p has its first fold at x = 5/6, and the next one, beyond it, at x = 2/3. A motion
/// up to 0.7 reaches neither: the way to the second one leaves the motion.
TEST(AForgedFold, OnAWayThatLeavesTheMotionIsNotVerified) {
  const auto up_to = [](double end) {
    const std::string range = fmt::format("0 : {}", end);
    const std::string arcs =
        fmt::format("arc 0 0 : {} {} 0.1146 {} 0.06\narc 1 0.25 : 2.1 1 {} 0 {}\n", 0.42 / end,
                    0.21 / end, 0.5986 * end, 0.623 / end, 0.224 / end);
    return verify_text(
        with_proof(question(range, "x - p^3/3 + 3/2*p^2 - 2*p", "0 +- 1/10"), arcs,
                   fmt::format("fold {} 2 1 0.001 0.001 0.001 1\nend\n", 2 / (3 * end)),
                   fmt::format("{}", end)));
  };
  EXPECT_TRUE(is(Outcome::kVerified, up_to(1), ""));
  EXPECT_TRUE(is(Outcome::kUnfinished, up_to(0.7), "may leave the line"));
}

TEST(AForgedFold, OfAnotherFormatIsRefused) {
  const std::string good = with_proof(question());
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"reason fold", "reason lost-rank"},
           {"towards -0x1p+1", "towards"},
           {"towards -0x1p+1", "towards 0 0"},
           {"towards -0x1p+1", "towards inf"},
           {"arc 0 ", "arc 2 "},
           {"arc 0 ", "arc -1 "},
           {"arc 0 0x0p+0 : ", "arc 0 0x0p+0 "},
           {"arc 0 0x0p+0 : 0x1p-2", "arc 0 0x1p-2 : 0x0p+0"},
           {" 0x1p-4\n", " 0x0p+0\n"},
           {" 0x1p-4\n", " 0x1p-4 1\n"},
           {"fold 0x1p-1", "fold"},
           {"0x1p-20 0x1p-20 0x1p-20", "0x1p-20 0x0p+0 0x1p-20"},
           {"end\n", "end\nend\n"},
           {"end\n", ""}}) {
    EXPECT_TRUE(is(Outcome::kRejected, verify_text(with_other(good, from, to)), "")) << from << to;
  }
}

/// No damage to a proof makes it one of a false claim.
TEST(AForgedFold, OfAFalseClaimIsNotVerifiedAfterDamage) {
  const std::string regular = with_proof(question("-2 : 1", "p^3 + p - x - 2"));
  ASSERT_FALSE(is(Outcome::kVerified, verify_text(regular), ""));
  const std::size_t proof = regular.find("proof\n") + 6;
  const std::vector<std::string> splices = {"0", "-", "1", " 0x1p+3", "\n", kAlong, kAcross, kEnd};
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    const std::string damaged =
        regular.substr(0, proof) + Damage(seed, splices).done_to(regular.substr(proof));
    EXPECT_NE(verify_text(damaged).outcome, Outcome::kVerified) << damaged;
  }
}

}  // namespace
}  // namespace regulus::detail::test
