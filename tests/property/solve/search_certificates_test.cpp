// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of lists of configurations: genuine ones are verified and compared with their files,
// forged ones are not.
#include <cmath>
#include <numbers>

#include "tests/property/solve/certified_lists.hpp"

namespace regulus::test {
namespace {

/// A forged list of configurations, with the claim that belongs to it.
std::string forged_list(Lines lines, const std::string& verdict) {
  lines[first(lines, "verdict")] = "verdict " + verdict;
  lines[first(lines, "claim")] =
      "claim " + format::describe_solutions_claim({verdict, format::kOfUnknowns, "configuration",
                                                   "configurations", count_of(lines, "solution"),
                                                   count_of(lines, "uncertain")});
  return joined(lines);
}

void expect_forgeries_fail(const std::string& certificate) {
  const Lines genuine = lines_of(certificate);
  const auto at = std::ptrdiff_t(first(genuine, "solution"));
  Lines fewer = genuine, more = genuine, none = genuine, moved = genuine;
  fewer.erase(fewer.begin() + at);
  more.insert(more.begin() + at, genuine[std::size_t(at)]);
  std::erase_if(none, [](const std::string& line) { return line.starts_with("solution "); });
  std::string& equation = moved[first(moved, "equation")];
  equation += " + 1";
  EXPECT_EQ(outcome(forged_list(genuine, "COMPLETE")), Outcome::kVerified);
  EXPECT_EQ(outcome(forged_list(genuine, "INCOMPLETE")), Outcome::kVerified);
  if (count_of(fewer, "solution") > 0) {
    EXPECT_EQ(outcome(forged_list(fewer, "COMPLETE")), Outcome::kRejected);
    EXPECT_EQ(outcome(forged_list(fewer, "INCOMPLETE")), Outcome::kVerified);
  }
  EXPECT_EQ(outcome(forged_list(more, "COMPLETE")), Outcome::kRejected);
  EXPECT_EQ(outcome(forged_list(more, "INCOMPLETE")), Outcome::kRejected);
  EXPECT_EQ(outcome(forged_list(none, "NONE")), Outcome::kRejected);
  EXPECT_NE(outcome(forged_list(moved, "COMPLETE")), Outcome::kVerified);
}

/// Half a turn is all of a range that is longer only if a whole turn changes no equation.
TEST(ARangeOfAnAngle, IsShortenedToATurnOnlyIfTheEquationsRepeat) {
  for (const auto& [equation, repeats] :
       std::vector<std::pair<std::string, bool>>{{"sin(q/2) - x", false},
                                                 {"q - 2*x", false},
                                                 {"sin(q) + q/100 - x", false},
                                                 {"sin(q)/2 + cos(2*q + x) - x - 3", true},
                                                 {"exp(cos(3*q)) - 2*x + abs(sin(q))", true}}) {
    const std::string model =
        "regulus = 1\nname = \"turn\"\n[pose]\nx = \"m\"\n[closure]\n"
        "unknowns = { q = \"rad\" }\nequations = [\"" +
        equation +
        "\"]\nstart = { x = 0.4, q = 0.8 }\nrange = { q = [-7, 7] }\n"
        "[motion.here]\nx = 0.4\n";
    Lines lines = lines_of(certified(model).text);
    ASSERT_FALSE(lines.empty()) << equation;
    lines[first(lines, "unknown")] = "unknown q = 0 +- pi";
    std::erase_if(lines, [](const std::string& line) {
      return line.starts_with("solution ") &&
             std::fabs(std::stod(line.substr(9))) > std::numbers::pi;
    });
    const std::size_t count = count_of(lines, "solution");
    const std::string text = forged_list(lines, count == 0 ? "NONE" : "COMPLETE");
    const verifier::Verification v = verified(text, model);
    EXPECT_EQ(v.outcome, repeats ? Outcome::kVerified : Outcome::kRejected) << equation << '\n'
                                                                            << describe(v);
  }
}

TEST(ConfigurationsOfAFourBar, AreVerifiedWithTheirFile) {
  const std::string model = library_model("four_bar");
  const Certified none = certified(model, {"theta=135*deg"});
  EXPECT_TRUE(none.solutions.found.empty());
  EXPECT_EQ(outcome(none.text), Outcome::kVerified) << none.status.obstacle();
  const verifier::Verification v = verified(none.text, model, true);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  const Certified two = certified(model, {"theta=1"});
  ASSERT_EQ(two.solutions.found.size(), 2U);
  EXPECT_EQ(verified(two.text, model, true).outcome, Outcome::kVerified);
  expect_forgeries_fail(two.text);
}

TEST(ConfigurationsOfADoubleButterfly, AreVerifiedWithTheirFile) {
  const std::string model = library_model("double_butterfly");
  const Certified six = certified(model, {"theta=67.38"});
  ASSERT_EQ(six.solutions.found.size(), 6U);
  const verifier::Verification v = verified(six.text, model, true);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.roots, 6U);
  expect_forgeries_fail(six.text);
}

/// y² = x + a for a within its tolerance, x at a place of the file.
TEST(SolutionsWithATolerance, AreVerifiedForAllItsValues) {
  const std::string model = R"toml(regulus = 1
name = "root"
[pose]
x = "m"
[geometry]
a = { value = 1, tolerance = 0.125 }
[closure]
unknowns = { y = "m" }
equations = ["y^2 - x - a"]
start = { x = 0, y = 1 }
range = { y = [-3, 2.5] }
[motion.here]
x = 0.25
)toml";
  const Certified made = certified(model);
  ASSERT_TRUE(made.status.is_written()) << made.status.obstacle();
  ASSERT_EQ(made.solutions.found.size(), 2U);
  const verifier::Verification v = verified(made.text, model);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_TRUE(v.claim.starts_with("at every value of the 1 uncertain quantities, a mechanism"));
  expect_forgeries_fail(made.text);
  const std::string plain = without_sum(made.text);
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"0.125", "0.25"},
                                                        {"x = 0.25", "x = 0.26"},
                                                        {"[-3, 2.5]", "[-3, 2]"},
                                                        {"- a", "- 2*a"},
                                                        {"value = 1", "value = 1.5"}}) {
    std::string changed = model;
    changed.replace(changed.find(from), from.size(), to);
    EXPECT_EQ(outcome(plain, changed), Outcome::kRejected) << from;
  }
}

}  // namespace
}  // namespace regulus::test
