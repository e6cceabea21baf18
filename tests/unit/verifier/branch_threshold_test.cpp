// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds of the branch p = √(1 + x) of p² = x + 1, where the derivative by p is 2p: from √3 at −1/4 to
// √5 at 1/4, and 0 at −1, where the branch ends.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;
using verifier::Verification;

std::string tube_of_root(double lo, double hi) {
  const double middle = (lo + hi) / 2, c = std::sqrt(1 + middle), half = (hi - lo) / 2;
  return fmt::format(" {:a} {:a} {:a} {:a}\n", middle, c, 1 / (2 * c),
                     1.5 * half * half / (8 * c * c * c) + 1e-6);
}

struct AskedThreshold {
  std::string alpha, verdict = "NO SINGULARITY";
  std::string value{};  ///< the line after `proof`
  std::string first = "tube", last = "tube", lines{}, motion = "-1/4 : 1/4";
  bool has_threshold = true;  ///< in the claim
};

std::string head_of(const AskedThreshold& a) {
  const format::ClaimedSet set{1, 1, 0, a.has_threshold};
  return fmt::format(
      "regulus-certificate 1\nverdict {}\nclaim {}\nmodel slider\nsha256 -\nmotion m\nalpha {}\n"
      "parameter x in {}\npose x = x\nunknown p = 1 +- 1/2\nstart 0\nequation p^2 - x - 1\n{}"
      "proof\n",
      a.verdict,
      a.verdict == "PAVING" ? format::describe_branch_paving(set, "")
                            : format::describe_closure_claim(set, a.verdict == "SINGULARITY"),
      a.alpha, a.motion, a.lines);
}

/// The boxes −1/4 : −1/8, −1/8 : 0, 0 : 1/8 and 1/8 : 1/4.
Verification answer_about(const AskedThreshold& a) {
  return verify_text(fmt::format(
      "{}{}s 0 0 0x0p+0\ns 1 0 -0x1p-3\ns 2 0 0x1p-3\nl 3 {}{}l 4 tube{}l 5 tube{}l 6 {}{}end 4\n",
      head_of(a), a.value, a.first, tube_of_root(-0.25, -0.125), tube_of_root(-0.125, 0),
      tube_of_root(0, 0.125), a.last, tube_of_root(0.125, 0.25)));
}

void expect_answer(Outcome outcome, const AskedThreshold& a, const std::string& why = "") {
  const Verification v = answer_about(a);
  EXPECT_EQ(v.outcome, outcome) << a.alpha << '\n' << describe(v);
  EXPECT_THAT(v.reason, HasSubstr(why));
}

TEST(AThresholdOverABranch, IsVerifiedIfItIsExceeded) {
  const Verification v = answer_about({"173/100"});
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.claim,
            "the mechanism has exactly one configuration on its branch, and the equation is "
            "defined there, and |det of the equations' derivatives by the unknowns| exceeds "
            "alpha, at every pose of the variety");
  EXPECT_THAT(describe(v), HasSubstr("bound      about 1.73\n"));
  expect_answer(Outcome::kVerified, {"0*7"});
  expect_answer(Outcome::kRejected, {"174/100"}, "beyond the bound");
  expect_answer(Outcome::kRejected, {"100"}, "beyond the bound");
  expect_answer(Outcome::kUnfinished, {"sqrt(3)"});  // it is reached, and not exceeded
  expect_answer(Outcome::kUnfinished, {"-1"}, "not certainly 0 or positive");
}

TEST(AThresholdOverABranch, IsNotExceededAtAPlace) {
  const auto at = [](const std::string& alpha, const std::string& place) {
    return AskedThreshold{alpha, "SINGULARITY", "value " + place + "\n"};
  };
  expect_answer(Outcome::kVerified, at("174/100", "-0x1p-2"));
  expect_answer(Outcome::kVerified, at("3", "0x1p-2"));
  expect_answer(Outcome::kUnfinished, at("173/100", "-0x1p-2"), "not shown that the value");
  expect_answer(Outcome::kUnfinished, at("174/100", "0x0p+0"), "not shown that the value");
  expect_answer(Outcome::kRejected, at("174/100", "-0x1.1p-2"), "outside the ranges");
  expect_answer(Outcome::kRejected, {"174/100", "SINGULARITY"}, "expected the word 'value'");
}

TEST(AThresholdOverABranch, StandsInTheClaimAndInItsLine) {
  AskedThreshold other{"173/100"};
  other.has_threshold = false;
  expect_answer(Outcome::kRejected, other, "the claim is not about");
  other = {"0"};
  expect_answer(Outcome::kRejected, other, "the claim is not about");
  other = {"173/100"};
  other.lines = "quantity determinant\nside least\nbound 1\n";
  expect_answer(Outcome::kRejected, other, "expected the line 'proof'");
  expect_answer(Outcome::kRejected, {"173/100", "FEASIBLE"}, "about singularity");
}

/// 2p = 2 where x = 0.
TEST(AThresholdOverABranch, IsPaved) {
  const auto paved = [](const std::string& first, const std::string& last) {
    return AskedThreshold{"2", "PAVING", "", first, last};
  };
  const Verification v = answer_about(paved("infeasible", "feasible"));
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_THAT(v.claim, HasSubstr("in a leaf with a tube; |det of the equations' derivatives by "
                                 "the unknowns| exceeds alpha in a leaf 'feasible', and is at "
                                 "most alpha in a leaf 'infeasible'"));
  EXPECT_THAT(describe(v), HasSubstr("1 feasible, 1 infeasible, 2 tube"));
  expect_answer(Outcome::kRejected, paved("feasible", "feasible"), "beyond the bound");
  expect_answer(Outcome::kRejected, paved("infeasible", "infeasible"), "|det| exceeds alpha");
}

const std::string kEndOfRoot =
    "reason fold\ntowards -0x1p+1\n"
    "arc 0 0x0p+0 : 0x1p-2 0x1p-3 0x1.bb67aep-1 -0x1.279a74p+0 0x1p-4\n"
    "arc 1 -0x1p-2 : 0x1.9p-1 0x1p-2 0x1.ep-2 -0x1p-2 0x1.4p-2\n"
    "fold 0x1p-1 0x0p+0 0x1p+0 0x1p-20 0x1p-20 0x1p-20 0x1p+0\nend\n";

TEST(AThresholdOverABranch, IsNotExceededWhereTheBranchEnds) {
  AskedThreshold end{"1/1000", "SINGULARITY"};
  end.motion = "-2 : 1";
  const Verification v = verify_text(head_of(end) + kEndOfRoot);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.claim,
            "configurations of the mechanism lead from the start to one where |det of the "
            "equations' derivatives by the unknowns| is at most alpha, at some pose of the "
            "variety");
  end.verdict = "NO SINGULARITY";
  EXPECT_EQ(verify_text(head_of(end) + kEndOfRoot).outcome, Outcome::kRejected);
  end.verdict = "SINGULARITY";
  end.motion = "-1/2 : 1";
  EXPECT_EQ(verify_text(head_of(end) + kEndOfRoot).outcome, Outcome::kRejected);
}

}  // namespace
}  // namespace regulus::detail::test
