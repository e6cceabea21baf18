// SPDX-License-Identifier: GPL-3.0-or-later
// Finite errors over the branch p = √(x + g) of p² = x + g, −1/4 ≤ x ≤ 1/4, g = 1 ± 1/10. Without
// errors it is p° = √(x + 1), and |p − p°| is at most √0.75 − √0.65 = 0.0597996.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <deque>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test::finite_error_test {
namespace {

using verifier::Outcome;
using verifier::Verification;

/// Which solutions the tubes are about, and where.
struct Tree {
  double sign = 1, nominal_sign = 1;
  double of_nominal = 1;  ///< the value of g that the tubes of p° have
  std::array<double, 2> x{-0.25, 0.25}, g{0.9, 1.1};
  bool is_error = false;  ///< g stands for an error about 0
};

std::string text_of(const Tree& tree) {
  struct Box {
    int number;
    std::array<double, 2> lo, hi;
    int depth;
  };
  std::deque<Box> waiting{{0, {tree.x[0], tree.g[0]}, {tree.x[1], tree.g[1]}, 0}};
  std::string splits, leaves;
  const double shift = tree.is_error ? 1 : 0;
  int next = 1, count = 0;
  for (; !waiting.empty(); waiting.pop_front()) {
    const auto [number, lo, hi, depth] = waiting.front();
    const std::size_t k = depth % 2;
    const std::array<double, 2> middle{(lo[0] + hi[0]) / 2, (lo[1] + hi[1]) / 2};
    if (depth < 8) {
      splits += fmt::format("s {} {} {:a}\n", number, k, middle[k]);
      auto lower = hi, upper = lo;
      lower[k] = upper[k] = middle[k];
      waiting.push_back({next++, lo, lower, depth + 1});
      waiting.push_back({next++, upper, hi, depth + 1});
      continue;
    }
    const double p = std::sqrt(middle[0] + middle[1] + shift);
    const double nominal = std::sqrt(middle[0] + tree.of_nominal);
    const double hx = (hi[0] - lo[0]) / 2, h = hx + (hi[1] - lo[1]) / 2;
    const double slope = tree.sign / (2 * p), slope_of_nominal = tree.nominal_sign / (2 * nominal);
    ++count;
    leaves += fmt::format("l {} tube {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a}\n", number,
                          middle[0], middle[1], tree.sign * p, tree.nominal_sign * nominal, slope,
                          slope, slope_of_nominal, 0.0, 1.5 * h * h / (8 * p * p * p) + 1e-6,
                          1.5 * hx * hx / (8 * nominal * nominal * nominal) + 1e-6);
  }
  return fmt::format("{}{}end {}\n", splits, leaves, count);
}

struct Asked {
  std::string bound;
  std::string place{};  ///< where the bound is attained; empty: it is kept
  Tree tree{};
  std::string uncertain = "uncertain g = 1 +- 1/10\n", pose = "pose x = x\n",
              equation = "p^2 - x - g", lines = "column 1\n", side = "absolute", more{};
};

Verification answer(const Asked& asked) {
  format::ClaimedBound words{"finite-error", asked.side, "", "", "", "", asked.bound, true};
  words.columns = asked.lines.substr(7, 1);
  const bool is_attained = !asked.place.empty();
  return verify_text(
      fmt::format("regulus-certificate 1\nverdict {}\nclaim {}\nmodel slider\nsha256 -\nmotion m\n"
                  "alpha 0\nparameter x in -1/4 : 1/4\n{}{}unknown p = 1 +- 1/2\nstart 0\n"
                  "equation {}\n{}quantity finite-error\nside {}\n{}bound {}\nproof\n{}{}",
                  is_attained ? "SINGULARITY" : "NO SINGULARITY",
                  format::describe_bound_claim({1, 1, 1}, words, is_attained), asked.uncertain,
                  asked.pose, asked.equation, asked.more, asked.side, asked.lines, asked.bound,
                  is_attained ? "value " + asked.place + '\n' : "", text_of(asked.tree)));
}

void expect(Outcome outcome, const Asked& asked) {
  const Verification v = answer(asked);
  EXPECT_EQ(v.outcome, outcome) << asked.bound << '\n' << describe(v);
}

TEST(AFiniteError, IsThatOfThePage) {
  std::ostringstream page;
  page << std::ifstream(REGULUS_SOURCE_DIR "/runtime/proof/FORMAT.md").rdbuf();
  const std::string text = page.str(), fence = "```\n";
  const std::size_t begin = text.find(fence, text.find("**Finite errors.**")) + fence.size();
  const Verification v = verify_text(text.substr(begin, text.find(fence, begin) - begin));
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.links, 1U);
}

TEST(AFiniteError, IsVerifiedIfItIsKept) {
  expect(Outcome::kVerified, {"601/10000"});
  expect(Outcome::kVerified, {"1/10"});
  expect(Outcome::kRejected, {"5979/100000"});
  expect(Outcome::kRejected, {"58/1000"});
}

TEST(AFiniteError, IsVerifiedWhereItIsAttained) {
  const std::string largest = "-0x1p-2 0.9";
  expect(Outcome::kVerified, {"597/10000", largest});
  expect(Outcome::kUnfinished, {"598/10000", largest});
  expect(Outcome::kUnfinished, {"597/10000", "0x1p-2 0.9"});
  expect(Outcome::kVerified, {"558/10000", "-0x1p-2 1.0999999"});
  // Without an error nothing moves.
  expect(Outcome::kUnfinished, {"1/1000000", "-0x1p-2 1"});
  expect(Outcome::kRejected, {"597/10000", "-0x1p-2 0.8"});
}

/// The copies have the branch of the start, too, and g = 1.
TEST(AFiniteError, IsFromTheConfigurationWithoutErrors) {
  for (const std::string place : {"", "-0x1p-2 0.9"}) {
    const std::string bound = place.empty() ? "1/10" : "597/10000";
    expect(Outcome::kVerified, {bound, place});
    expect(Outcome::kRejected, {bound, place, {.nominal_sign = -1}});
    expect(Outcome::kRejected, {bound, place, {.sign = -1, .nominal_sign = -1}});
    expect(Outcome::kRejected, {bound, place, {.of_nominal = 1.1}});
    expect(Outcome::kRejected, {bound, place, {.of_nominal = 0.9}});
  }
}

/// A tree about a smaller set of errors, or a proof of smaller errors, is none about these.
TEST(AFiniteError, IsAboutAllErrors) {
  expect(Outcome::kRejected, {"1/10", "", {}, "uncertain g = 1 +- 2/10\n"});
  expect(Outcome::kRejected, {"1/10", "", {}, "uncertain g = 1 +- 3/10\n"});
  // The other way round it is one.
  expect(Outcome::kVerified, {"601/10000", "", {}, "uncertain g = 1 +- 9/100\n"});
}

TEST(AFiniteError, HasErrorsOfThePose) {
  const Tree tree{.g = {-0.1, 0.1}, .is_error = true};
  const std::string pose = "pose x = x +- 1/10\n", equation = "p^2 - x - 1";
  expect(Outcome::kVerified, {"601/10000", "", tree, "", pose, equation});
  expect(Outcome::kRejected, {"58/1000", "", tree, "", pose, equation});
  expect(Outcome::kVerified, {"597/10000", "-0x1p-2 -0.0999999999", tree, "", pose, equation});
}

TEST(AFiniteError, IsOfEquationsThatAreDefined) {
  const auto with = [](const std::string& defined) {
    return Asked{
        "1/10",        "",           {},         "uncertain g = 1 +- 1/10\n", "pose x = x\n",
        "p^2 - x - g", "column 1\n", "absolute", "defined " + defined + "\n"};
  };
  expect(Outcome::kVerified, with("1/(x + g)"));
  EXPECT_NE(answer(with("1/x")).outcome, Outcome::kVerified);
  EXPECT_NE(answer(with("1/(g - 1.05)")).outcome, Outcome::kVerified);
}

TEST(AFiniteError, HasOneSideAndAnUnknownOfTheFile) {
  Asked asked{"1/10"};
  asked.side = "largest";
  expect(Outcome::kRejected, asked);
  asked = {"1/10"};
  asked.lines = "column 2\n";
  expect(Outcome::kRejected, asked);
  asked.lines = "column 1\nmotor-error 1\n";
  expect(Outcome::kRejected, asked);
}

}  // namespace
}  // namespace regulus::detail::test::finite_error_test
