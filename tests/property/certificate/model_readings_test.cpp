// SPDX-License-Identifier: GPL-3.0-or-later
// The verifier reads [serial], [legs] and [gough] by itself. A question that the front end writes of
// random robots is that of their file; it is that of no file with another number, or another matrix.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <sstream>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/model/request.hpp"
#include "runtime/verifier/model/model_comparison.hpp"

namespace regulus::test::readings {
namespace {

using verifier::Outcome;

std::string head_of(const std::string& text) {
  ModelOptions options;
  options.path = "test.toml";
  options.text = text;
  const Request request = read_request(options);
  const CertifiedQuestion question = certified_question(request, uncertain_names(request));
  return std::string(format::kMagic) + "\nverdict NO SINGULARITY\nclaim " +
         question.no_singularity + '\n' + question.text + "proof\n";
}

/// The outcome for the question alone: no proof follows.
Outcome compared(const std::string& head, const std::string& text, std::string& why) {
  std::istringstream stream(head);
  verifier::Lines lines(stream);
  verifier::Question question;
  verifier::read_question(lines, question);
  question.graph.end_of_file();
  verifier::Options options;
  options.model_name = "test.toml";
  options.model_text = text;
  verifier::Verification result;
  why.clear();
  try {
    compare_with_model(question, verifier::read_model_values(text), options, result);
  } catch (const verifier::OtherModel& other) {
    why = other.what();
    return Outcome::kRejected;
  } catch (const verifier::Unfinished& unfinished) {
    why = unfinished.what();
    return Outcome::kUnfinished;
  }
  return Outcome::kVerified;
}

Outcome compared(const std::string& head, const std::string& text) {
  std::string why;
  return compared(head, text, why);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// Returns the text with each number between `begin` and `end` changed, one at a time.
std::vector<std::string> with_another_number(const std::string& text, const std::string& begin,
                                             const std::string& end) {
  std::vector<std::string> result;
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  const std::size_t stop = text.find(end);
  for (std::size_t at = text.find(begin); at < stop; ++at) {
    const char before = text[at - 1];
    if (!std::isdigit(static_cast<unsigned char>(text[at])) || is_word(before) || before == '.')
      continue;
    std::size_t last = at;
    while (std::isdigit(static_cast<unsigned char>(text[last])) || text[last] == '.') ++last;
    if (text.compare(last, 1, "]") == 0 && before == '[') continue;
    result.push_back(std::string(text).insert(last, text.find('.', at) < last ? "7" : ".7"));
    at = last;
  }
  return result;
}

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

/// Legs of all types, with and without tolerances.
std::vector<std::string> robots_on_legs() {
  std::vector<std::string> result;
  const auto leg = [](const std::string& type, double angle, bool is_planar, bool has_platform) {
    std::string text = fmt::format("[[legs.leg]]\ntype = \"{}\"\n", type);
    const std::string third = is_planar ? "" : ", 3";
    text += fmt::format("base = [{:.1f}, {:.1f}{}]\n", 200 * std::cos(angle), 200 * std::sin(angle),
                        third);
    if (has_platform)
      text += fmt::format("platform = [{:.1f}, {:.1f}{}]\n", 60 * std::cos(angle + 0.2),
                          60 * std::sin(angle + 0.2), third);
    if (type == "RRR") text += "crank = 120\nrod = 150\nmode = \"+\"\n";
    if (type == "PRR") text += "axis = [3, 4]\nrod = 260\nmode = \"-\"\n";
    if (type == "RUS" || type == "RSS" || type == "delta")
      text += "axis = [1, 2, 2]\ncrank = 120\nrod = 310\nmode = \"+\"\n";
    if (type == "PUS" || type == "PSS" || type == "linear-delta")
      text += "axis = [0, 3, 4]\nrod = 380\nmode = \"-\"\n";
    if (type == "linear-delta") text += "bar = [2, 1, 0]\n";
    if (type == "UPU") text += "axis = [1, 2, 2]\n";
    if (type == "RPS" || type == "PRS")
      text += fmt::format("hinge = [{0:.1f}, {1:.1f}, 0]\n", -std::sin(angle), std::cos(angle));
    // Across the hinge, which is in the plane of the base.
    if (type == "PRS") text += "axis = [0, 0, 2]\nrod = 310\nmode = \"-\"\n";
    return text;
  };
  const auto robot = [&](const std::string& keys, const std::vector<std::string>& types,
                         const std::string& motion) {
    std::string text = "regulus = 1\nname = \"r\"\n[legs]\n" + keys;
    const bool is_planar = types.front() == "RRR" || types.front() == "PRR";
    for (std::size_t i = 0; i < types.size(); ++i)
      text += leg(types[i], 0.4 + double(i) * 6.2832 / double(types.size()), is_planar,
                  keys.find("\"point\"") == std::string::npos);
    result.push_back(text + "[motion.w]\nx = [-1, 1]\ny = [2, 3]\n" + motion);
  };
  for (const std::string tolerances :
       {"", "rod_tolerance = 0.1\nbase_tolerance = 0.05\ntolerance_shape = \"ball\"\n",
        "axis_tolerance = 0.001\n"}) {
    robot(tolerances, {"RRR", "RPR", "PRR"}, "phi = [0.1, 0.12]\n");
    robot(tolerances + "orientation = \"fixed\"\n", {"delta", "UPU", "linear-delta"},
          "z = [300, 302]\n");
    robot(tolerances + "orientation = \"point\"\n", {"RUS", "PSS", "SPS"}, "z = [300, 302]\n");
  }
  robot("orientation = \"roll-pitch-yaw\"\n", {"RUS", "PUS", "UPS", "RSS", "PSS", "SPS"},
        "z = [300, 302]\nroll = 0.05\npitch = [0, 0.01]\nyaw = 0.1\n");
  for (const std::string tolerances : {"", "axis_tolerance = 0.001\nbase_tolerance = 0.01\n"})
    robot(tolerances + "orientation = \"euler-zxz\"\n", {"RPS", "PRS", "RPS", "PRS"},
          "z = [300, 302]\npsi = 0.05\ntheta = [0, 0.01]\nphi = -0.05\n");
  // At these angles the square of a length is a sum of squares, for certain not 0.
  robot("orientation = \"euler-zxz\"\n", {"RPS", "UPS", "UPS", "RPS", "UPS"},
        "z = [300, 302]\npsi = 0\ntheta = 0\nphi = 0\n");
  for (const char* joint : {"1", "2", "3"})
    robot(fmt::format("actuated = {}\naxis_tolerance = 0.001\n", joint), {"PRR", "RPR", "RRR"},
          "phi = [0.1, 0.12]\n");
  return result;
}

TEST(AQuestionAboutARobotOnLegs, IsThatOfItsFileAndOfNoFileWithAnotherNumber) {
  std::size_t next = 0;
  for (const std::string& text : robots_on_legs()) {
    const std::string head = head_of(text);
    std::string why;
    EXPECT_EQ(compared(head, text, why), Outcome::kVerified) << text << why;
    const auto others = with_another_number(text, "[[legs.leg]]", "[motion.w]");
    for (std::size_t i = next++ % 3; i < others.size(); i += 3)
      EXPECT_NE(compared(head, others[i]), Outcome::kVerified) << others[i];
    const std::string from = "mode = \"+\"", to = "mode = \"-\"";
    // The line through the ends of a leg does not depend on the mode.
    const bool has_mode = text.find("actuated = 2") == std::string::npos;
    if (!has_mode || text.find(from) == std::string::npos) continue;
    EXPECT_EQ(compared(head, replaced(text, from, to)), Outcome::kRejected) << text;
  }
}

/// A name for a number, of [geometry] or of [let], is the number: an axis counts by its direction.
TEST(AQuestionAboutARobotOnLegs, IsThatOfItsFileIfAxesAreWrittenByNames) {
  const std::string names =
      "[geometry]\nL = 2\nP = [2, 7]\nT = { value = 2, tolerance = 0 }\n[let]\nM = \"L/2\"\n";
  std::size_t next = 0;
  for (const std::string& text : robots_on_legs())
    for (const char* key : {"axis = [0, 3, ", "axis = [1, 2, ", "axis = [0, 0, ", "hinge = ["}) {
      if (text.find(key) == std::string::npos) continue;
      const char* const name = std::array{"L", "P_1", "T", "2*M"}.at(next++ % 4);
      std::string other = text;
      const std::size_t at = other.find(key) + std::string_view(key).size();
      const std::size_t end = other.find_first_of(",]", at);
      other.replace(at, end - at, fmt::format("\"{}*{}/2\"", other.substr(at, end - at), name));
      other = replaced(other, "[legs]\n", names + "[legs]\n");
      std::string why;
      EXPECT_EQ(compared(head_of(other), other, why), Outcome::kVerified) << other << why;
    }
}

TEST(AQuestionAboutASixLeggedPlatform, IsThatOfItsFileAndOfNoFileWithAnotherNumber) {
  const std::array<std::pair<const char*, const char*>, 3> orientations = {
      {{"euler-zxz", "psi = 0\ntheta = [0, 0.1]\nphi = 0\n"},
       {"roll-pitch-yaw", "roll = 0\npitch = [0, 0.1]\nyaw = 0.1\n"},
       {"quaternion", "q0 = 1\nq1 = [0, 0.1]\nq2 = 0.1\nq3 = 0\n"}}};
  for (const auto& [orientation, angles] : orientations) {
    const std::string text =
        fmt::format("regulus = 1\nname = \"h\"\n[gough]\norientation = \"{}\"\n", orientation) +
        "base = [[-9, 9, 0], [9, 9, 0], [12, -3, 0], [3, -13, 0], [-3, -13, 0], [-12, -3, 0]]\n"
        "platform = [[-3, 7, 0], [3, 7, 0], [7, -1, 0], [4, -6, 0], [-4, -6, 0], [-7, -1, 0]]\n"
        "base_tolerance = 0.01\ntolerance_shape = \"ball\"\n[motion.w]\nx = 0\ny = [0, 1]\n"
        "z = [45, 46]\n" +
        angles;
    const std::string head = head_of(text);
    std::string why;
    EXPECT_EQ(compared(head, text, why), Outcome::kVerified) << text << why;
    for (const std::string& other : with_another_number(text, "base =", "[motion.w]"))
      EXPECT_EQ(compared(head, other), Outcome::kRejected) << other;
    for (const auto& [other, ignored] : orientations) {
      if (std::string(other) == orientation) continue;
      EXPECT_NE(compared(head, replaced(text, orientation, other)), Outcome::kVerified) << other;
    }
  }
}

}  // namespace
}  // namespace regulus::test::readings
