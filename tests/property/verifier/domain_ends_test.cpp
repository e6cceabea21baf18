// SPDX-License-Identifier: GPL-3.0-or-later
// Tests operations at the very end of their domain. The end of a range is a rational number that is
// not a double: the operation is defined there, or 1e-30 beyond.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

/// A range of x, and an expression u of x with values in [0, 1] that is 0 at one end only.
struct End {
  std::string range, u;
};

std::string replaced(std::string text, char letter, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(letter, at)) != std::string::npos; at += by.size())
    text.replace(at, 1, by);
  return text;
}

class RandomEnds {
 public:
  explicit RandomEnds(std::uint64_t seed) : random_(seed) {}

  int pick(int lo, int hi) { return std::uniform_int_distribution(lo, hi)(random_); }

  End end() {
    // The range of x is p/q to p/q + w, or p/q − w to p/q, with w = 1/m or 0; u = m·|x − p/q|.
    const int q = std::array{3, 7, 10, 11, 13, 49}[std::size_t(pick(0, 5))];
    const int p = pick(-60, 60), m = pick(1, 9), w = pick(0, 3) == 0 ? 0 : 1;
    const std::string end = fraction(p, q);
    if (pick(0, 1) == 0) return {end + " : " + fraction(p * m + q * w, q * m), difference(p, q, m)};
    return {fraction(p * m - q * w, q * m) + " : " + end,
            replaced("((-1)*U)", 'U', difference(p, q, m))};
  }

 private:
  static std::string fraction(int p, int q) {
    std::string text = std::to_string(p);
    text += '/';
    return text += std::to_string(q);
  }

  /// Returns m·(x − p/q) in one of a few spellings.
  std::string difference(int p, int q, int m) {
    const char* const spelling =
        std::array{"(M*x - M*(P/Q))", "(M*(x - (P/Q)))", "((Q*x - (P))*M/Q)",
                   "((x + x - 2*(P/Q))*M/2)"}[std::size_t(pick(0, 3))];
    std::string text = replaced(spelling, 'M', std::to_string(m));
    text = replaced(text, 'P', std::to_string(p));
    return replaced(text, 'Q', std::to_string(q));
  }

  std::mt19937_64 random_;
};

// The expressions of U, for U in [0, 1].
const std::vector<const char*> kDefined = {
    "1 + sqrt(U)",           "1 + sqrt(U)^5",           "1 + sqrt(abs(U))",
    "1 + sqrt(U^3 + 1e-40)", "1 + sqrt(U/(1 + U))",     "90 + log(U + 1e-30)",
    "1 + 1/(U + 1e-30)",     "4 + atan2(U, U + 1e-30)", "4 + atan2(U + 1e-30, -U)",
    "3 + asin(1 - U)",       "3 + asin(U - 1)",         "1 + acos(1 - U^2)",
    "1 + sqrt(1 - cos(U))",
};

const std::vector<const char*> kUndefined = {
    "1 + sqrt(U - 1e-30)",
    "1 + 0*sqrt(U - 1e-30)",
    "90 + 0*log(U)",
    "1 + 1/U",
    "1 + 1/(U)^2",
    "4 + atan2(U, -U)",
    "3 + asin(1 + 1e-30 - U)",
    "3 + acos(U - 1 - 1e-30)",
    "1 + sqrt(cos(U) - 1 - 1e-30)",
    "1 + 1/(2 + 0*log(U))",
};

TEST(AnOperationAtTheEndOfItsDomain, IsVerified) {
  RandomEnds random(20261122);
  for (int trial = 0; trial < 400; ++trial) {
    const End end = random.end();
    const std::string entry = replaced(kDefined[std::size_t(trial) % kDefined.size()], 'U', end.u);
    const auto v = verify_text(scalar_question(entry, end.range) + kOneLeaf);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << entry << " over " << end.range << ": " << v.reason;
  }
}

TEST(AnOperationBeyondTheEndOfItsDomain, IsNotVerified) {
  RandomEnds random(20261123);
  for (int trial = 0; trial < 400; ++trial) {
    const End end = random.end();
    const std::string entry =
        replaced(kUndefined[std::size_t(trial) % kUndefined.size()], 'U', end.u);
    EXPECT_NE(verify_text(scalar_question(entry, end.range) + kOneLeaf).outcome, Outcome::kVerified)
        << entry << " over " << end.range;
    const std::string beside = scalar_question("1", end.range) + "defined " + entry + "\n";
    EXPECT_NE(verify_text(beside + kOneLeaf).outcome, Outcome::kVerified) << entry;
  }
}

/// The least value of u + margin is 0, but no double is that close.
TEST(ATouchedZero, IsNotVerified) {
  RandomEnds random(20261124);
  for (int trial = 0; trial < 100; ++trial) {
    const End end = random.end();
    for (const std::string& entry :
         {end.u, replaced("sqrt(U)", 'U', end.u), replaced("asin(U)", 'U', end.u)})
      EXPECT_NE(verify_text(scalar_question(entry, end.range) + kOneLeaf).outcome,
                Outcome::kVerified)
          << entry << " over " << end.range;
  }
}

}  // namespace
}  // namespace regulus::detail::test
