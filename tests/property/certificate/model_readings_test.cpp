// SPDX-License-Identifier: GPL-3.0-or-later
// The verifier reads [serial] by itself. A question that the front end writes of
// random robots is that of their file; it is that of no file with another number, or another matrix.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <sstream>

#include "tests/property/certificate/compared_question.hpp"

namespace regulus::detail::test::readings {
namespace {

using verifier::Outcome;

class Dice {
 public:
  explicit Dice(unsigned seed) : generator_(seed) {}
  bool once_in(unsigned n) { return generator_() % n == 0; }
  std::string one_of(const std::vector<std::string>& words) {
    return words[generator_() % words.size()];
  }

 private:
  std::mt19937 generator_;
};

std::string random_joint(Dice& dice, bool has_origins, std::vector<std::string>& names) {
  std::string joint;
  if (!names.empty() && dice.once_in(4)) {
    joint = fmt::format("mimic = \"{}\", multiplier = {}", dice.one_of(names),
                        dice.one_of({"1", "-1", "0", "\"1/2\"", "2"}));
    if (dice.once_in(2)) joint += ", offset = " + dice.one_of({"\"30*deg\"", "\"-pi/2\""});
  } else {
    names.push_back(fmt::format("q{}", names.size() + 1));
    joint = "name = \"" + names.back() + '"';
  }
  if (dice.once_in(6)) joint += ", type = \"prismatic\"";
  const auto length = [&] { return dice.one_of({"0", "0", "0.3", "-0.2", "0.41"}); };
  const auto angle = [&] { return dice.one_of({"0", "\"90*deg\"", "\"-pi/2\"", "\"pi\""}); };
  if (!has_origins)
    return joint + fmt::format(", a = {}, d = {}, alpha = {}", length(), length(), angle());
  joint += fmt::format(", xyz = [{}, {}, {}]", length(), length(), length());
  if (dice.once_in(2)) joint += fmt::format(", rpy = [{}, {}, 0]", angle(), angle());
  if (dice.once_in(2)) joint += ", axis = " + dice.one_of({"[0, 1, 0]", "[0, 3, 4]", "[-1, 0, 0]"});
  return joint;
}

std::string random_arm(Dice& dice) {
  const std::string convention = dice.one_of({"origins", "standard-dh", "modified-dh"});
  std::string text = "regulus = 1\nname = \"arm\"\n[serial]\nconvention = \"" + convention + "\"\n";
  if (dice.once_in(4)) text += "length_tolerance = 0.001\n";
  std::vector<std::string> names;
  const int joints = std::stoi(dice.one_of({"2", "3", "4", "5", "6", "6", "7"}));
  text += "joints = [\n";
  for (int i = 0; i < joints; ++i)
    text += "  { " + random_joint(dice, convention == "origins", names) + " },\n";
  text += "]\n[motion.w]\n";
  for (const std::string& name : names) text += name + " = [0.25, 0.5]\n";
  return text;
}

TEST(AQuestionAboutARandomArm, IsThatOfItsFile) {
  Dice dice(1);
  int unfinished = 0;
  for (int k = 0; k < 60; ++k) {
    const std::string text = random_arm(dice);
    std::string why;
    const Outcome outcome = compared(head_of(text), text, why);
    EXPECT_NE(outcome, Outcome::kRejected) << text << why;
    unfinished += outcome == Outcome::kUnfinished;
  }
  EXPECT_LE(unfinished, 3);
}

/// The comparison leaves nothing behind that the proof would take for a variable.
TEST(AnArmAtOnePose, IsVerifiedWithItsModelFile) {
  const std::string text = R"toml(regulus = 1
name = "arm"
[serial]
convention = "standard-dh"
joints = [ { name = "q1", a = 0.5, alpha = 0.3 }, { mimic = "q1", d = 0.41 }, { name = "q2" } ]
[motion.w]
q1 = -0.52
q2 = 0.3
)toml";
  verifier::Options options;
  options.model_name = "test.toml";
  options.model_text = text;
  std::istringstream certificate(head_of(text) + "l 0 h-matrix\nend 1\n");
  const verifier::Verification v = verifier::verify(certificate, options);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << v.reason;
}

constexpr const char* kPuma = R"toml(regulus = 1
name = "arm"
[serial]
convention = "modified-dh"
joints = [
  { name = "q1" },
  { name = "q2", alpha = "-90*deg" },
  { name = "q3", a = 0.43, d = 0.15 },
  { name = "q4", a = 0.02, alpha = "90*deg", d = 0.43 },
  { name = "q5", alpha = "-90*deg" },
  { name = "q6", alpha = "90*deg" },
]
[motion.w]
q1 = 0
q2 = [-0.5, 0]
q3 = [0.4, 1]
q4 = [0, 1]
q5 = [0.5, 1]
q6 = 0
)toml";

constexpr const char *kBend = "\"q5\", alpha = \"-90*deg\"",
                     *kOtherBend = "\"q5\", alpha = \"-89*deg\"";

TEST(AnArmWhoseDeterminantFactors, HasNoOtherLengthsAndAngles) {
  const std::string head = head_of(kPuma);
  ASSERT_NE(head.find("entry sin(q5)"), std::string::npos);
  EXPECT_EQ(compared(head, kPuma), Outcome::kVerified);
  // An offset along parallel axes does not occur in the determinant; an angle of the wrist is a factor.
  EXPECT_EQ(compared(head, replaced(kPuma, "0.15", "0.2")), Outcome::kVerified);
  EXPECT_EQ(compared(head, replaced(kPuma, kBend, kOtherBend)), Outcome::kVerified);
  for (const auto& [from, to] :
       {std::pair("a = 0.43", "a = 0.44"), std::pair("0.02", "-0.02"),
        std::pair("d = 0.43 }", "d = 0.44 }"), std::pair("\"q6\",", "\"q6\", a = 0.01,")})
    EXPECT_EQ(compared(head, replaced(kPuma, from, to)), Outcome::kRejected) << from;
  EXPECT_NE(compared(head, replaced(kPuma, "modified", "standard")), Outcome::kVerified);
  EXPECT_EQ(compared(replaced(head, "entry sin(q5)", "entry 2*sin(q5)"), kPuma),
            Outcome::kVerified);
  EXPECT_EQ(compared(replaced(head, "entry sin(q5)", "entry cos(q5)"), kPuma), Outcome::kRejected);
}

TEST(ADeterminantWithAThreshold, HasNoOtherFactor) {
  const std::string text = std::string(kPuma) + "alpha = 0.001\n";
  const std::string head = head_of(text);
  EXPECT_EQ(compared(head, text), Outcome::kVerified);
  EXPECT_EQ(compared(replaced(head, "entry sin(q5)", "entry -sin(q5)"), text), Outcome::kVerified);
  EXPECT_EQ(compared(head, replaced(text, kBend, kOtherBend)), Outcome::kRejected);
  EXPECT_EQ(compared(replaced(head, "entry sin(q5)", "entry 2*sin(q5)"), text), Outcome::kRejected);
}

/// A parallelogram keeps the third link's direction.
constexpr const char* kPalletizer = R"toml(regulus = 1
name = "palletizer"
[serial]
joints = [
  { name = "q1" },
  { name = "q2", axis = [0, 1, 0], xyz = [0.2, 0, 0.5] },
  { mimic = "q2", multiplier = -1, axis = [0, 1, 0], xyz = [0, 0, 0.7] },
  { name = "q3", axis = [0, 1, 0] },
  { mimic = "q3", multiplier = -1, axis = [0, 1, 0], xyz = [0.8, 0, 0] },
  { name = "q4", xyz = [0.1, 0, 0], rpy = ["180*deg", 0, 0] },
]
[motion.w]
q1 = 0
q2 = [0.1, 0.3]
q3 = [0.1, 0.3]
q4 = 0
)toml";

TEST(AnArmWithAParallelogram, HasNoOtherFollowersAndNoMatrixOfASineThatIsNotZero) {
  const std::string head = head_of(kPalletizer);
  std::string why;
  EXPECT_EQ(compared(head, kPalletizer, why), Outcome::kVerified) << why << head;
  for (const char* multiplier : {"1", "0", "\"1/2\"", "2", "-2"})
    EXPECT_NE(compared(head, replaced(kPalletizer, "= -1", std::string("= ") + multiplier)),
              Outcome::kVerified)
        << multiplier;
  for (const char* length : {"0.7", "0.8"})
    EXPECT_NE(compared(head, replaced(kPalletizer, length, "0.9")), Outcome::kVerified) << length;
}

constexpr const char* kSevenJoints = R"toml(regulus = 1
name = "arm"
[serial]
joints = [
  { name = "q1", xyz = [0, 0, 0.16] },
  { name = "q2", rpy = ["-pi/2", 0, 0] },
  { name = "q3", xyz = [0, -0.2, 0], rpy = ["pi/2", 0, 0] },
  { name = "q4", xyz = [0, 0, 0.22], rpy = ["pi/2", 0, 0] },
  { name = "q5", xyz = [0, 0.18, 0], rpy = ["-pi/2", 0, 0] },
  { name = "q6", xyz = [0, 0, 0.22], rpy = ["-pi/2", 0, 0] },
  { name = "q7", rpy = ["pi/2", 0, 0] },
]
[motion.w]
q1 = 0
q2 = [0.4, 0.5]
q3 = [0.4, 0.5]
q4 = [0.4, 0.5]
q5 = [0.4, 0.5]
q6 = [0.4, 0.5]
q7 = 0
)toml";

TEST(AnArmWithMoreJointsThanRows, HasNoOtherLengthsAndRows) {
  const std::string head = head_of(kSevenJoints);
  std::string why;
  EXPECT_EQ(compared(head, kSevenJoints, why), Outcome::kVerified) << why;
  for (const char* length : {"-0.2", "0.22", "0.18"})
    EXPECT_NE(compared(head, replaced(kSevenJoints, length, "0.4")), Outcome::kVerified) << length;
  EXPECT_NE(compared(replaced(head, "entry 0\n", "entry 1\n"), kSevenJoints), Outcome::kVerified);
}

}  // namespace
}  // namespace regulus::detail::test::readings
