// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of lists of configurations: genuine ones are verified and compared with their files,
// forged ones are not.
#include <cmath>
#include <numbers>

#include "tests/property/solve/certified_lists.hpp"

namespace regulus::detail::test {
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
  for (std::size_t k = 0; k < count_of(genuine, "solution"); ++k) {
    Lines without = genuine;
    without.erase(without.begin() + at + std::ptrdiff_t(k));
    const char* verdict = count_of(without, "solution") == 0 ? "NONE" : "COMPLETE";
    EXPECT_EQ(outcome(forged_list(without, verdict)), Outcome::kRejected) << k;
  }
  if (count_of(fewer, "solution") > 0) {
    EXPECT_EQ(outcome(forged_list(fewer, "COMPLETE")), Outcome::kRejected);
    EXPECT_EQ(outcome(forged_list(fewer, "INCOMPLETE")), Outcome::kVerified);
  }
  EXPECT_EQ(outcome(forged_list(more, "COMPLETE")), Outcome::kRejected);
  EXPECT_EQ(outcome(forged_list(more, "INCOMPLETE")), Outcome::kRejected);
  EXPECT_EQ(outcome(forged_list(none, "NONE")), Outcome::kRejected);
  EXPECT_NE(outcome(forged_list(moved, "COMPLETE")), Outcome::kVerified);
}

struct Turns {
  const char* equation;
  int count;  ///< the certificate has half of so many turns in the place of the range
  Outcome outcome;
};

const std::vector<Turns> kTurns = {{"sin(q/2) - x", 1, Outcome::kRejected},
                                   {"sin(q/2) - x", 2, Outcome::kVerified},
                                   {"cos(q/2) + sin(2*q)/3 - x", 2, Outcome::kVerified},
                                   {"sin(q/3) - x/9", 2, Outcome::kRejected},
                                   {"q - 2*x", 1, Outcome::kRejected},
                                   {"sin(q) + q/100 - x", 1, Outcome::kRejected},
                                   {"sin(q) - x", 2, Outcome::kRejected},
                                   {"sin(q)/2 + cos(2*q + x) - x - 3", 1, Outcome::kVerified},
                                   {"exp(cos(3*q)) - 2*x + abs(sin(q))", 1, Outcome::kVerified},
                                   // Each repeats after a turn, and the verifier does not see it.
                                   {"sin(q/2)^2 - x", 1, Outcome::kUnfinished},
                                   {"sin(q*(1 + a) - q*a) - x", 1, Outcome::kUnfinished}};

std::string model_of(const std::string& equation, bool is_in_degrees) {
  return "regulus = 1\nname = \"turn\"\n[pose]\nx = \"m\"\n[geometry]\n"
         "a = { value = 1, tolerance = 0.001 }\n[closure]\n"
         "unknowns = { q = \"" +
         std::string(is_in_degrees ? "deg" : "rad") + "\" }\nequations = [\"" + equation +
         "\"]\nstart = { x = 0.4, q = " + (is_in_degrees ? "45" : "0.8") +
         " }\nrange = { q = " + (is_in_degrees ? "[-401, 401]" : "[-7, 7]") +
         " }\n[motion.here]\nx = 0.4\n";
}

/// Half of some turns is all of a range that is longer only if these, and not fewer, change no equation.
void expect_turns(const Turns& turns, bool is_in_degrees) {
  const double radian = is_in_degrees ? 180 / std::numbers::pi : 1;
  const std::string equation = turns.equation, what = equation + ", " + std::to_string(turns.count);
  const bool is_unseen = equation.find("q*a") != std::string::npos;
  const std::string model = model_of(equation, is_in_degrees);
  Lines lines = lines_of(certified(model).text);
  ASSERT_FALSE(lines.empty()) << what;
  EXPECT_EQ(outcome(joined(lines), model), is_unseen ? Outcome::kUnfinished : Outcome::kVerified)
      << what;
  lines[first(lines, "unknown")] =
      "unknown q = 0 +- " + std::to_string(turns.count) + (is_in_degrees ? "*180" : "*pi");
  std::erase_if(lines, [&](const std::string& line) {
    return line.starts_with("solution ") &&
           std::fabs(std::stod(line.substr(9))) > turns.count * std::numbers::pi * radian;
  });
  if (equation == "sin(q) - x")
    for (const double more : {-5.871669, -3.553109}) {
      std::ostringstream line;
      line << "solution " << (more - 1e-4) * radian << ':' << (more + 1e-4) * radian;
      lines.insert(std::ranges::find(lines, "proof"), line.str());
    }
  const char* verdict = count_of(lines, "solution") == 0 ? "NONE" : "COMPLETE";
  const verifier::Verification v = verified(forged_list(lines, verdict), model);
  EXPECT_EQ(v.outcome, turns.outcome) << what << '\n' << describe(v);
  EXPECT_EQ(turns.outcome == Outcome::kUnfinished,
            v.reason.find("it is not certain whether the equations repeat") != std::string::npos)
      << what << '\n'
      << describe(v);
}

TEST(ARangeOfAnAngle, IsShortenedToTurnsOnlyIfTheEquationsRepeat) {
  for (const Turns& turns : kTurns) {
    expect_turns(turns, false);
    // An angle in degrees is no number.
    const std::string equation = turns.equation;
    if (!equation.starts_with("q") && equation.find("+ q/") == std::string::npos)
      expect_turns(turns, true);
  }
}

/// Lengths have no turns, whatever the equations are.
TEST(ARangeOfAnAngle, IsNotThatOfALength) {
  const auto model = [](const std::string& unit) {
    return "regulus = 1\nname = \"turn\"\n[pose]\nx = \"m\"\n[closure]\nunknowns = { q = \"" +
           unit +
           "\" }\nequations = [\"sin(q) - x\"]\nstart = { x = 0.4, q = 0.8 }\n"
           "range = { q = [-7, 6] }\n[motion.here]\nx = 0.4\n";
  };
  const std::string text = without_sum(certified(model("rad")).text);
  EXPECT_EQ(outcome(text, model("rad")), Outcome::kVerified);
  EXPECT_EQ(outcome(text, model("m")), Outcome::kRejected);
  EXPECT_EQ(outcome(text, model("deg")), Outcome::kRejected);
  const std::string degrees = without_sum(certified(model("deg")).text);
  EXPECT_EQ(outcome(degrees, model("deg")), Outcome::kVerified);
  EXPECT_NE(outcome(degrees, model("rad")), Outcome::kVerified);
}

std::string model_at(const std::string& motion, const std::string& geometry = "a = 1") {
  return "regulus = 1\nname = \"place\"\n[pose]\nx = \"m\"\n[geometry]\n" + geometry +
         "\n[closure]\nunknowns = { p = \"m\" }\nequations = [\"p^2 - x - 1\"]\n"
         "start = { x = 0.5, p = 1 }\nrange = { p = [-7, 7] }\n[motion.here]\n" +
         motion + '\n';
}

TEST(ThePlaceOfAList, IsThatOfTheFileUnlessAnOptionHasChosenIt) {
  const std::string model = model_at("x = [0, 1]");
  const std::string text = certified(model, {"x=0.5"}, "here").text;
  const verifier::Verification v = verified(text, model);
  EXPECT_EQ(v.outcome, Outcome::kRejected) << describe(v);
  EXPECT_NE(v.reason.find("motion.here.x[0] is '0', but the certificate has '1/2'"),
            std::string::npos)
      << v.reason;
  const verifier::Verification excused = verified(text, model, true);
  EXPECT_EQ(excused.outcome, Outcome::kVerified) << describe(excused);
  EXPECT_EQ(excused.differences.size(), 2U);
}

TEST(ThePlaceOfAList, IsOnACurveWithTheParameterAsAConstant) {
  const auto model = [](const std::string& range) {
    return model_at("parameters = { T = " + range + " }\nx = \"1/(T + 2)\"");
  };
  const std::string point = model("[\"1/2\", \"1/2\"]"),
                    genuine = without_sum(certified(point).text);
  EXPECT_EQ(outcome(genuine, point), Outcome::kVerified) << genuine;
  EXPECT_EQ(outcome(genuine, model("[0, \"1/2\"]")), Outcome::kRejected);
  EXPECT_EQ(verified(genuine, model("[0, 1]"), true).outcome, Outcome::kVerified);
  Lines other = lines_of(genuine), without = other;
  other[first(other, "constant T")] = "constant T = 1/2 + 1e-30";
  EXPECT_EQ(outcome(joined(other), point), Outcome::kRejected);
  without.erase(without.begin() + std::ptrdiff_t(first(without, "constant T")));
  without[first(without, "pose")] = "pose x = 2/5";
  std::erase_if(without, [](const std::string& l) { return l.starts_with("motion-defined"); });
  EXPECT_EQ(outcome(joined(without)), Outcome::kVerified);
  EXPECT_EQ(outcome(joined(without), point), Outcome::kUnfinished);
}

TEST(APointInABallOfNoRadius, IsAConstantOfAList) {
  const std::string model = model_at("x = 0.5", "a = { value = [1, 2], radius = 0 }");
  const Certified list = certified(model);
  EXPECT_EQ(list.solutions.found.size(), 2U);
  EXPECT_EQ(outcome(list.text, model), Outcome::kVerified) << list.text;
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
TEST(AnUnknownThatIsZero, HasALineThatIsWideEnough) {
  const std::string model = library_model("five_bar_closure");
  for (const std::vector<std::string>& at :
       {std::vector<std::string>{"theta1=120*deg", "theta2=60*deg"},
        std::vector<std::string>{"theta1=135*deg", "theta2=45*deg"}}) {
    const Certified made = certified(model, at);
    EXPECT_EQ(made.solutions.found.size(), 2U);
    const verifier::Verification v = verified(made.text, model, true);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v) << made.text;
  }
}

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
}  // namespace regulus::detail::test
