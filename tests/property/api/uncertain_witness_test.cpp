// SPDX-License-Identifier: GPL-3.0-or-later
// Singularities that need certain values of the uncertain quantities, all of which are found; and
// quantities at which derivatives are not defined, which are no reason to give up.
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/use/api/regulus.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

Verdict verdict_of(const std::string& body) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "model.toml";
  std::ofstream(path) << "regulus = 1\nname = \"planted\"\n[pose]\nx = \"1\"\n" << body;
  SearchOptions options;
  options.engine = Engine::kInterpreted;
  return check(Question::of_file(path), options).verdict;
}

/// No single quantity makes the determinant smaller: two of them must move together.
TEST(UncertainWitness, IsFoundWhereTwoQuantitiesMoveTogether) {
  const auto saddle = [](const char* tolerance) {
    return verdict_of(std::string("[geometry]\nu = { value = 0, tolerance = ") + tolerance +
                      " }\nv = { value = 0, tolerance = " + tolerance +
                      " }\n[matrix]\nrows = [[\"1 + x^2\", \"u\"], [\"v\", \"1\"]]\n"
                      "[motion.m]\nx = [-1, 1]\n");
  };
  EXPECT_EQ(saddle("1.1"), Verdict::kSingularity);
  EXPECT_EQ(saddle("1.01"), Verdict::kSingularity);
  EXPECT_EQ(saddle("0.9"), Verdict::kNoSingularity);
}

/// The cube in the ball ends at 1/√3 of the radius.
TEST(UncertainWitness, IsFoundAtTheSurfaceOfABall) {
  const auto on_axis = [](const char* distance) {
    return verdict_of(std::string("[geometry]\np = { value = [0, 0, 0], radius = 1 }\n"
                                  "[matrix]\nrows = [[\"") +
                      distance + " + x + p_1 + (p_2^2 + p_3^2)/100\"]]\n[motion.m]\nx = [0, 1]\n");
  };
  EXPECT_EQ(on_axis("0.6"), Verdict::kSingularity);
  EXPECT_EQ(on_axis("0.99"), Verdict::kSingularity);
  EXPECT_EQ(on_axis("0.999999"), Verdict::kSingularity);
  EXPECT_NE(on_axis("1.000001"), Verdict::kSingularity);
}

/// The derivatives of |u − c| are not defined at u = c, and grow without limit where enclosures come
/// near it. Plain entries or their determinant are enough.
TEST(UncertainModulus, IsBoundedWhereItsDerivativesAreNot) {
  for (const char* center : {"3/10", "29/100", "199/1000", "x/10 + 3/10"})
    for (const char* above : {"2", "1/1000"}) {
      const std::string entry = std::string("\"abs(u - (") + center + ")) + " + above + "\"";
      EXPECT_EQ(verdict_of("[geometry]\nu = { value = 0.3, tolerance = 0.1 }\n"
                           "[matrix]\nrows = [[" +
                           entry +
                           ", \"x/10000\"], [\"x\", \"1 + x^2/4\"]]\n"
                           "[motion.m]\nx = [-1, 1]\n"),
                Verdict::kNoSingularity)
          << entry;
    }
}

/// The first column is 0 at u = 3/10.
TEST(UncertainModulus, IsNeverCertifiedWhereItVanishes) {
  EXPECT_NE(verdict_of("[geometry]\nu = { value = 0.3, tolerance = 0.1 }\n[matrix]\n"
                       "rows = [[\"abs(u - 3/10)\", \"x\"], [\"0\", \"1\"]]\n"
                       "[motion.m]\nx = [-1, 1]\n"),
            Verdict::kNoSingularity);
}

/// 1/20 up to u = 7/20, the kink, and then falling to −1/20: derivatives at the nominal value show no
/// change.
TEST(UncertainModulus, IsFollowedBeyondItsKink) {
  EXPECT_EQ(verdict_of("[geometry]\nu = { value = 0.3, tolerance = 0.1 }\n[matrix]\n"
                       "rows = [[\"1/20 - abs(u - 7/20) - (u - 7/20)\", \"0\"], [\"x\", \"1\"]]\n"
                       "[motion.m]\nx = [-1, 1]\n"),
            Verdict::kSingularity);
}

}  // namespace
}  // namespace regulus::detail::test
