// SPDX-License-Identifier: GPL-3.0-or-later
// Pavings of the branch p = √(1 + x) of p² = x + 1, −2 ≤ x ≤ 1/4, which ends at −1, where p = 0. The force of
// the load 1 is 1/(2p).
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

/// Returns the numbers of a tube over a range; `side`: 1, or −1 for the branch −√(1 + x).
std::string tube(double lo, double hi, double side = 1) {
  const double middle = (lo + hi) / 2, c = std::sqrt(1 + middle), half = (hi - lo) / 2;
  return fmt::format(" {:a} {:a} {:a} {:a}", middle, side * c, side / (2 * c),
                     1.5 * half * half / (8 * c * c * c) + 1e-6);
}

const std::string kLimitsOfTurns =
    "quantity force-limits\nload L\nwrench 1 +- 0\nlimits -1 : 13/25\n";

/// The boxes −2 : −1/4, −1/4 : −1/8, −1/8 : 0 and 0 : 1/4 have these words, in which T is the tube.
struct Paved {
  std::string beyond = "undecided", first = "tubeT", second = "tubeT", third = "tubeT";
  std::string quantity{}, verdict = "PAVING", start = "0";
  double side = 1;  ///< of the tube of the third
};

Verification answer(const Paved& p) {
  const auto leaf = [](int box, std::string word, const std::string& numbers) {
    if (word.ends_with('T')) word = word.substr(0, word.size() - 1) + numbers;
    return fmt::format("l {} {}\n", box, word);
  };
  return verify_text(fmt::format(
      "regulus-certificate 1\nverdict {}\nclaim {}\nmodel slider\nsha256 -\nmotion m\nalpha 0\n"
      "parameter x in -2 : 1/4\npose x = x\nunknown p = 1 +- 1/2\nstart {}\n"
      "equation p^2 - x - 1\n{}proof\ns 0 0 -0x1p-2\n{}s 2 0 0x0p+0\ns 3 0 -0x1p-3\n{}{}{}end 4\n",
      p.verdict, format::describe_branch_paving({1, 1}, p.quantity.empty() ? "" : "L"), p.start,
      p.quantity, leaf(1, p.beyond, tube(-0.99, -0.25)), leaf(5, p.first, tube(-0.25, -0.125)),
      leaf(6, p.second, tube(-0.125, 0)), leaf(4, p.third, tube(0, 0.25, p.side))));
}

void expect_rejected(const Paved& paved, const std::string& why) {
  const Verification v = answer(paved);
  EXPECT_EQ(v.outcome, Outcome::kRejected) << describe(v);
  EXPECT_THAT(v.reason, HasSubstr(why));
}
void expect_open(const Paved& paved, const std::string& why = "") {
  const Verification v = answer(paved);
  EXPECT_NE(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_THAT(v.reason, HasSubstr(why));
}

TEST(APavingOfABranch, IsVerified) {
  const Verification v = answer({});
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.claim,
            "the mechanism has exactly one configuration on its branch, and the equation is "
            "defined and regular there, at every pose of the variety in a leaf with a tube");
  EXPECT_EQ(v.links, 2U);
  EXPECT_THAT(describe(v), HasSubstr("1 undecided, 3 tube"));
  // To leave out what the start does not need is a smaller claim.
  EXPECT_EQ(answer({.first = "undecided"}).outcome, Outcome::kVerified);
  EXPECT_EQ(answer({.first = "undecided", .second = "undecided", .start = "1/8"}).outcome,
            Outcome::kVerified);
}

TEST(APavingOfABranch, IsNotVerifiedIfItClaimsMore) {
  expect_open({.beyond = "tubeT"});
  expect_rejected({.beyond = "outside"}, "there is a pose of the variety");
  expect_rejected({.first = "outside"}, "there is a pose of the variety");
  expect_rejected({.first = "undecidedT"}, "expected 0 numbers");
  expect_rejected({.verdict = "NO SINGULARITY"}, "");
  expect_rejected({.verdict = "FEASIBLE"}, "");
}

TEST(APavingOfABranch, IsOneBranchThatHasTheStart) {
  expect_open({.second = "undecided", .start = "1/8"}, "no chain of neighbours");
  expect_rejected({.third = "undecided"}, "in a leaf without a tube");
  expect_rejected({.second = "undecided"}, "in a leaf without a tube");
  expect_rejected({.first = "undecided", .second = "undecided", .third = "undecided"},
                  "in a leaf without a tube");
  expect_rejected({.side = -1}, "another configuration");
  expect_open({.start = "-1/8", .side = -1}, "different configurations");
}

TEST(APavingOfALoadOnABranch, IsVerified) {
  const Verification v =
      answer({.first = "infeasibleT", .third = "feasibleT", .quantity = kLimitsOfTurns});
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_THAT(v.claim, HasSubstr("; the forces of all motors under the load L are within their "
                                 "limits for every vector of it in a leaf 'feasible', and that of "
                                 "some motor is beyond its limits"));
  EXPECT_THAT(describe(v), HasSubstr("1 feasible, 1 infeasible, 1 undecided, 1 tube"));
}

/// 1/(2p) = 13/25 where x = −0.075.
TEST(APavingOfALoadOnABranch, IsNotVerifiedIfItClaimsMore) {
  expect_rejected({.first = "feasibleT", .quantity = kLimitsOfTurns},
                  "the quantity is beyond the bound");
  expect_rejected({.third = "infeasibleT", .quantity = kLimitsOfTurns},
                  "all forces are within their limits");
  expect_open({.second = "feasibleT", .quantity = kLimitsOfTurns});
  expect_open({.second = "infeasibleT", .quantity = kLimitsOfTurns});
  expect_rejected({.beyond = "feasible", .quantity = kLimitsOfTurns}, "numbers after the word");
}

TEST(APavingOfABranch, HasNoOtherQuantity) {
  for (const char* word : {"feasibleT", "infeasibleT"})
    expect_rejected({.first = word}, "there is no rule");
  expect_rejected({.quantity = "quantity error\nside absolute\ncolumn 1\nmotor-error 1\nbound 9\n"},
                  "a paving of a branch has no bound of a quantity");
}

}  // namespace
}  // namespace regulus::detail::test
