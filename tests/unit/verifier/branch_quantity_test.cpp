// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds over the branch p = √(1 + x) of p² = x + 1, −1/4 ≤ x ≤ 1/4, where J = 1/(2p) and A = 2p.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <string>

#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;
using verifier::Verification;

/// The tubes of 32 boxes.
std::string tree() {
  struct Box {
    int number;
    double lo, hi;
    int depth;
  };
  std::deque<Box> waiting{{0, -0.25, 0.25, 0}};
  std::string splits, leaves;
  int next = 1, count = 0;
  for (; !waiting.empty(); waiting.pop_front()) {
    const auto [number, lo, hi, depth] = waiting.front();
    const double middle = (lo + hi) / 2, c = std::sqrt(1 + middle), half = (hi - lo) / 2;
    if (depth < 5) {
      splits += fmt::format("s {} 0 {:a}\n", number, middle);
      waiting.push_back({next++, lo, middle, depth + 1});
      waiting.push_back({next++, middle, hi, depth + 1});
    } else {
      ++count;
      leaves += fmt::format("l {} tube {:a} {:a} {:a} {:a}\n", number, middle, c, 1 / (2 * c),
                            1.5 * half * half / (8 * c * c * c) + 1e-6);
    }
  }
  return fmt::format("{}{}end {}\n", splits, leaves, count);
}

struct Asked {
  std::string quantity, side, lines, bound;
  std::string place{};  ///< where the bound is attained; empty: it is kept
  std::string poses = "pose x = x\n", equation = "y - x - 1";
};

Verification answer(const Asked& asked) {
  format::ClaimedBound words{asked.quantity, asked.side, "", "", "", "", asked.bound, true};
  const auto has = [&](const char* line) { return asked.lines.find(line) != std::string::npos; };
  if (has("row 1")) words.row = "1";
  if (has("column 1")) words.columns = "1";
  if (has("load L")) words.set = "L";
  const bool is_attained = !asked.place.empty();
  const std::string text = fmt::format(
      "regulus-certificate 1\nverdict {}\nclaim {}\nmodel slider\nsha256 -\nmotion m\n"
      "alpha 0\nparameter x in -1/4 : 1/4\n{}unknown p = 1 +- 1/2\nstart 0\n"
      "let y = p*p\nequation {}\nquantity {}\nside {}\n{}bound {}\nproof\n{}{}",
      is_attained ? "SINGULARITY" : "NO SINGULARITY",
      format::describe_bound_claim({1, 1}, words, is_attained), asked.poses, asked.equation,
      asked.quantity, asked.side, asked.lines, asked.bound,
      is_attained ? "value " + asked.place + '\n' : "", tree());
  return verify_text(text);
}

void expect(Outcome outcome, const Asked& asked) {
  const Verification v = answer(asked);
  EXPECT_EQ(v.outcome, outcome) << asked.quantity << ' ' << asked.bound << '\n' << describe(v);
}

const std::string kError = "column 1\nmotor-error 1/10\n", kSpeed = "column 1\nmotor-speed 2\n",
                  kForce = "row 1\nload L\nwrench 1 +- 2\n",
                  kDeflection = "column 1\nload L\nwrench 1 +- 2\nstiffness 10\n";

/// J is between 0.4472 and 0.5774, A between 1.7320 and 2.2361.
TEST(ABoundOverABranch, IsVerifiedIfItIsKept) {
  for (const Asked& kept :
       {Asked{"error", "absolute", kError, "578/10000"},
        Asked{"speed", "absolute", kSpeed, "116/100"}, Asked{"determinant", "least", "", "173/100"},
        Asked{"determinant-max", "largest", "", "224/100"},
        Asked{"determinant-max", "least", "", "173/100"},
        Asked{"condition", "absolute", "factor 3\n", "101/100"},
        Asked{"force", "absolute", kForce, "174/100"}, Asked{"force", "largest", kForce, "174/100"},
        Asked{"force", "least", kForce, "-58/100"},
        Asked{"deflection", "absolute", kDeflection, "101/1000"}})
    expect(Outcome::kVerified, kept);
}

TEST(ABoundOverABranch, IsRejectedIfItIsNot) {
  for (const Asked& exceeded :
       {Asked{"error", "absolute", kError, "577/10000"},
        Asked{"speed", "absolute", kSpeed, "115/100"}, Asked{"determinant", "least", "", "174/100"},
        Asked{"determinant-max", "largest", "", "223/100"},
        Asked{"force", "absolute", kForce, "173/100"}, Asked{"force", "least", kForce, "-57/100"},
        Asked{"deflection", "absolute", kDeflection, "99/1000"}})
    expect(Outcome::kRejected, exceeded);
}

TEST(AValueOverABranch, IsVerifiedWhereItIsAttained) {
  const std::string low = "-0x1p-2", high = "0x1p-2";
  expect(Outcome::kVerified, {"error", "absolute", kError, "577/10000", low});
  expect(Outcome::kUnfinished, {"error", "absolute", kError, "577/10000", high});
  expect(Outcome::kUnfinished, {"error", "absolute", kError, "578/10000", low});
  expect(Outcome::kVerified, {"determinant", "least", "", "174/100", low});
  expect(Outcome::kUnfinished, {"determinant", "least", "", "173/100", low});
  expect(Outcome::kVerified, {"determinant-max", "largest", "", "223/100", high});
  expect(Outcome::kVerified, {"force", "least", kForce, "-57/100", low});
  expect(Outcome::kUnfinished, {"force", "least", kForce, "-58/100", low});
  // The place is one of the motion, and not one value alone.
  expect(Outcome::kRejected, {"error", "absolute", kError, "577/10000", "-0x1.1p-2"});
  expect(Outcome::kRejected, {"error", "absolute", kError, "577/10000", "-"});
}

TEST(ABoundOverABranch, HasDataThatMeanSomething) {
  expect(Outcome::kRejected, {"error", "least", kError, "1/100"});
  expect(Outcome::kRejected, {"sigma-max", "largest", "factor 1\n", "9"});
  expect(Outcome::kUnfinished, {"error", "absolute", "column 1\nmotor-error -1/10\n", "1"});
  expect(Outcome::kUnfinished, {"condition", "absolute", "factor 0\n", "2"});
  expect(Outcome::kRejected, {"error", "absolute", "column 2\nmotor-error 1/10\n", "1"});
}

TEST(ABoundOverABranch, HasTheDerivativesByEachMotor) {
  const std::string two = "pose x = x\npose q = 0\n",
                    errors = "column 1\nmotor-error 1/10\nmotor-error 1/10\n";
  // 0.1·(1 + 1/10)/(2p) is at most 0.0636.
  const std::string equation = "y - x - 1 - q/10", kink = "y - x - 1 - abs(q)/10";
  expect(Outcome::kVerified, {"error", "absolute", errors, "637/10000", "", two, equation});
  expect(Outcome::kRejected, {"error", "absolute", errors, "634/10000", "", two, equation});
  // |q| has no derivative at the only value of q.
  expect(Outcome::kUnfinished, {"error", "absolute", errors, "637/10000", "", two, kink});
}

}  // namespace
}  // namespace regulus::detail::test
