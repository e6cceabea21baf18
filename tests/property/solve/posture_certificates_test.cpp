// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of lists of postures: genuine ones are verified and compared with their files, forged ones
// are not.
#include <fmt/format.h>

#include "tests/property/solve/certified_lists.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

/// Writes the claim that belongs to the lines.
std::string with_claim_of_postures(const Lines& lines, const std::string& verdict) {
  return joined(claiming(lines, verdict, format::describe_arm(6, false, false, false), "posture",
                         "postures"));
}

/// Moves one angle of a line by so much.
std::string moved(const std::string& line, std::size_t value, double step) {
  Lines words;
  std::istringstream stream(line);
  for (std::string word; stream >> word;) words.push_back(word);
  std::string& word = words[1 + value];
  const std::size_t colon = word.find(':');
  word = fmt::format("{:a}:{:a}", std::stod(word.substr(0, colon)) + step,
                     std::stod(word.substr(colon + 1)) + step);
  std::string text;
  for (const std::string& each : words) text += (text.empty() ? "" : " ") + each;
  return text;
}

/// Each line left out, and repeated as it is and a turn on; a changed arm and a changed place.
void expect_forgeries_of_postures_fail(const std::string& certificate) {
  constexpr double kTurn = 2 * 3.14159265358979312;
  const Lines genuine = lines_of(certificate);
  EXPECT_EQ(outcome(with_claim_of_postures(genuine, "INCOMPLETE")), Outcome::kVerified);
  const auto at = std::ptrdiff_t(first(genuine, "solution"));
  expect_each_line_is_needed(genuine, with_claim_of_postures);
  for (std::size_t value = 0; value < 6; ++value)
    for (const double step : {0.0, kTurn, 0.5 * kTurn, 1e-3}) {
      Lines more = genuine;
      more.insert(more.begin() + at, moved(genuine[std::size_t(at)], value, step));
      EXPECT_NE(outcome(with_claim_of_postures(more, "COMPLETE")), Outcome::kVerified);
      EXPECT_NE(outcome(with_claim_of_postures(more, "INCOMPLETE")), Outcome::kVerified);
    }
  for (const char* key : {"joint", "joint-value", "tool"}) {
    if (count_of(genuine, key) == 0) continue;
    Lines other = genuine;
    std::string& line = other[first(other, key)];
    line.insert(line.rfind(' ') + 1, "1/4 + ");
    EXPECT_NE(outcome(with_claim_of_postures(other, "COMPLETE")), Outcome::kVerified) << line;
  }
}

TEST(PosturesOfAnArmInTheLibrary, AreVerifiedWithTheirFile) {
  const std::string model = library_model("puma_560_serial") +
                            "[motion.at]\nq1 = 0.3\nq2 = 0.4\nq3 = -0.7\nq4 = 0.3\nq5 = 0.9\n"
                            "q6 = -1.4\n[motion.tool]\ntool = [0.4, 0.1, 0.5, 0, 0.2, 1]\n";
  for (const char* motion : {"at", "tool"}) {
    const Certified made = certified(model, {}, motion);
    ASSERT_EQ(made.solutions.found.size(), 8U);
    const verifier::Verification v = verified(made.text, model);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v) << made.status.obstacle();
    EXPECT_EQ(v.claim,
              "an arm of these six joints whose end is at this place has exactly 8 postures, one "
              "within each line 'solution'");
    expect_forgeries_of_postures_fail(made.text);
    const std::string plain = without_sum(made.text);
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"0.4318", "0.4319"},
             {"-0.0203", "0.0203"},
             {"\"-90*deg\", d = \"d2\"", "\"90*deg\", d = \"d2\""},
             {"modified-dh", "standard-dh"},
             {"q5 = 0.9\n", "q5 = 0.90001\n"},
             {"0.5, 0, 0.2, 1]", "0.5, 0, 0.2, 1.001]"},
             {"0.5, 0, 0.2, 1]", "0.5, 0, 0.2, 1, 0]"},
             {"{ name = \"q1\" }", "{ name = \"q1\", d = 0.1 }"},
             {"alpha = \"90*deg\" },\n]", "alpha = \"90*deg\" },\n{ type = \"fixed\", d = 0.1 }]"},
             {"a2 = { value = 0.4318, tolerance = 0", "a2 = { value = 0.4318, tolerance = 0.1"}}) {
      std::string changed = model;
      ASSERT_NE(changed.find(from), std::string::npos) << from;
      changed.replace(changed.find(from), from.size(), to);
      const bool is_other_motion =
          (std::string(motion) == "tool") != (from.find("0.5, 0, 0.2") == 0) &&
          (from.starts_with("q5") || from.starts_with("0.5"));
      // What is behind the last joint does not move it.
      const bool is_behind = std::string(motion) == "at" && from.starts_with("alpha");
      if (is_other_motion || is_behind) continue;
      EXPECT_NE(outcome(plain, changed), Outcome::kVerified) << motion << ": " << from;
    }
  }
}

/// The tool of an arm in degrees is in degrees, as its joints are.
TEST(TheToolOfAnArmInDegrees, IsThatOfTheArmInRadians) {
  const std::string whole = library_model("puma_560_serial"), head = "[serial]\n",
                    arm = whole.substr(0, whole.find("[motion."));
  std::string in_degrees = arm;
  in_degrees.insert(in_degrees.find(head) + head.size(), "angle_unit = \"deg\"\n");
  const std::string numbers = "[motion.tool]\ntool = [0.4, 0.1, 0.5, 0, 20, 60]\n";
  const Certified degrees = certified(in_degrees + numbers, {}, "tool"),
                  radians = certified(
                      arm + "[motion.tool]\ntool = [0.4, 0.1, 0.5, 0, \"20*deg\", \"pi/3\"]\n", {},
                      "tool");
  ASSERT_GT(degrees.solutions.found.size(), 0U);
  const Lines one = lines_of(degrees.text), other = lines_of(radians.text);
  EXPECT_EQ(one[first(one, "tool")], other[first(other, "tool")]);
  EXPECT_EQ(count_of(one, "solution"), count_of(other, "solution"));
  EXPECT_EQ(outcome(without_sum(degrees.text), in_degrees + numbers), Outcome::kVerified);
  EXPECT_EQ(outcome(without_sum(degrees.text), arm + numbers), Outcome::kRejected);
  const std::string with_deg = "[motion.tool]\ntool = [0.4, 0.1, 0.5, 0, \"20*deg\", \"60 deg\"]\n";
  EXPECT_EQ(outcome(without_sum(degrees.text), in_degrees + with_deg), Outcome::kVerified);
}

/// A frame, in doubles.
struct DhFrame {
  std::array<double, 9> R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 3> p = {};
  void move(const std::array<double, 3>& d) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) p[i] += R[3 * i + j] * d[j];
  }
  /// About the x axis (0) or the z axis (2).
  void turn(std::size_t axis, double angle) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const double a = R[3 * i + u], b = R[3 * i + v];
      R[3 * i + u] = a * std::cos(angle) + b * std::sin(angle);
      R[3 * i + v] = b * std::cos(angle) - a * std::sin(angle);
    }
  }
};

/// Returns x, y, z, roll, pitch, yaw of the tool of models/seven_joints.toml.
std::array<double, 6> tool_of_seven_joints(const std::array<double, 7>& q) {
  constexpr double kQuarter = 1.57079632679489662;
  constexpr std::array<std::array<double, 3>, 8> kOffset = {{{0, 0, 0.16},
                                                             {0, 0, 0.2},
                                                             {0, -0.2, 0},
                                                             {0, 0, 0.22},
                                                             {0, 0.18, 0},
                                                             {0, 0, 0.22},
                                                             {0, -0.08, 0},
                                                             {0, 0, 0.1}}};
  constexpr std::array<double, 7> kTurned = {0,         -kQuarter, kQuarter, kQuarter,
                                             -kQuarter, -kQuarter, kQuarter};
  DhFrame frame;
  for (std::size_t i = 0; i < 7; ++i) {
    frame.move(kOffset[i]);
    frame.turn(0, kTurned[i]);
    frame.turn(2, q[i]);
  }
  frame.move(kOffset[7]);
  const auto& R = frame.R;
  return {frame.p[0],       frame.p[1],
          frame.p[2],       std::atan2(R[7], R[8]),
          std::asin(-R[6]), std::atan2(R[3], R[0])};
}

/// At the place of the tool for random values of the joints, with the value of one joint, the planted
/// posture is in the list.
TEST(AJointBesideTheTool, KeepsItsValue) {
  const std::string model = library_model("seven_joints");
  RandomSource random(7);
  for (int count = 0; count < 8; ++count) {
    std::array<double, 7> q{};
    for (double& angle : q) angle = random.between(-1.5, 1.5);
    const std::array<double, 6> tool = tool_of_seven_joints(q);
    // Beside a given elbow, q4, the upper arm can still turn about the line from shoulder to wrist.
    constexpr std::array<std::size_t, 6> kHeld = {0, 1, 2, 4, 5, 6};
    const std::size_t held = kHeld[std::size_t(count) % kHeld.size()];
    std::vector<std::string> at = {fmt::format("q{}={:.17f}", held + 1, q[held])};
    constexpr std::array<const char*, 6> kNames = {"x", "y", "z", "roll", "pitch", "yaw"};
    for (std::size_t i = 0; i < 6; ++i) at.push_back(fmt::format("{}={:.17f}", kNames[i], tool[i]));
    const Certified made = certified(model, at);
    ASSERT_EQ(made.solutions.unknowns.size(), 6U);
    const bool has_planted = std::ranges::any_of(made.solutions.found, [&](const auto& solution) {
      for (std::size_t i = 0, k = 0; i < 7; ++i) {
        if (i == held) continue;
        const double away = mid(solution.values[k++]) - q[i];
        if (std::fabs(std::remainder(away, 6.28318530717958648)) > 1e-6) return false;
      }
      return true;
    });
    EXPECT_TRUE(has_planted) << fmt::format("{}", fmt::join(at, " "));
    if (made.text.empty()) continue;
    EXPECT_EQ(outcome(made.text), Outcome::kVerified);
    EXPECT_EQ(verified(made.text, model, true).outcome, Outcome::kVerified);
    EXPECT_EQ(verified(made.text, model).outcome, Outcome::kRejected);
  }
}

Outcome outcome_of_pair(Lines lines, int pair) {
  lines[first(lines, "opposite")] = fmt::format("opposite {}", pair);
  verifier::Options options;
  options.max_boxes = 20'000;
  std::istringstream stream(joined(lines));
  return verifier::verify(stream, options).outcome;
}

TEST(PosturesOfAnArm, AreThoseOfAnyPairOfOppositeJoints) {
  const Certified made = certified(library_model("manocha_canny"));
  const Lines genuine = lines_of(made.text);
  ASSERT_EQ(count_of(genuine, "solution"), 16U);
  for (int pair = 1; pair <= 3; ++pair) {
    EXPECT_EQ(outcome_of_pair(genuine, pair), Outcome::kVerified) << pair;
    for (std::size_t k = 0; k < 16; k += 5) {
      Lines fewer = genuine;
      fewer.erase(fewer.begin() + std::ptrdiff_t(first(genuine, "solution") + k));
      EXPECT_EQ(outcome_of_pair(lines_of(with_claim_of_postures(fewer, "COMPLETE")), pair),
                Outcome::kRejected)
          << pair << ' ' << k;
    }
  }
  EXPECT_EQ(outcome_of_pair(genuine, 0), Outcome::kRejected);
  EXPECT_EQ(outcome_of_pair(genuine, 4), Outcome::kRejected);
}

TEST(PosturesOfAnArm, MayBeAtARangeFromANumberToTheSame) {
  const auto model = [](const std::string& q1) {
    return library_model("puma_560_serial") + "[motion.at]\nq1 = " + q1 +
           "\nq2 = 0.4\nq3 = -0.7\nq4 = 0.3\nq5 = 0.9\nq6 = -1.4\n";
  };
  const std::string text = without_sum(certified(model("[0.3, \"3/10\"]"), {}, "at").text);
  EXPECT_EQ(outcome(text, model("[0.3, \"3/10\"]")), Outcome::kVerified);
  EXPECT_EQ(outcome(text, model("0.3")), Outcome::kVerified);
  EXPECT_EQ(outcome(text, model("[0.3, 0.4]")), Outcome::kRejected);
  EXPECT_EQ(outcome(text, model("[0.4, 0.4]")), Outcome::kRejected);
}

struct DhArm {
  std::array<std::array<double, 3>, 6> joints{};  ///< a, alpha, d
  std::string tail{};                             ///< of the section

  [[nodiscard]] std::string text(const std::string& unit, const std::string& motion) const {
    std::string rows;
    for (std::size_t i = 0; i < 6; ++i)
      rows += fmt::format("{{ name = \"q{}\", a = {}, alpha = {}, d = {} }},\n", i + 1,
                          joints[i][0], joints[i][1], joints[i][2]);
    return fmt::format(
        "regulus = 1\nname = \"arm\"\n[serial]\nangle_unit = \"{}\"\nconvention = "
        "\"standard-dh\"\n{}joints = [\n{}]\n[motion.m]\n{}",
        unit, tail, rows, motion);
  }
};

std::string some_values(RandomSource& random, double most) {
  std::string motion;
  for (int i = 1; i <= 6; ++i)
    motion += fmt::format("q{} = {:.4f}\n", i, random.between(-most, most));
  return motion;
}

/// Arms with a spherical wrist, parallel axes, or a wrist whose axes do not meet.
DhArm usual_arm(RandomSource& random, int kind, double right) {
  const auto length = [&] { return std::round(random.between(5, 100)) / 100; };
  DhArm arm{{{{length(), -right, length()},
              {length(), 0, 0},
              {length(), right, 0},
              {0, -right, length()},
              {0, right, 0},
              {0, 0, length()}}}};
  if (kind == 1) arm.joints[2] = {length(), 0, 0}, arm.joints[3] = {0, right, length()};
  if (kind == 1) arm.joints[4] = {0, -right, length()};
  if (kind == 2) arm.joints[4][0] = length() / 4;
  return arm;
}

TEST(PosturesOfUsualArms, AreVerifiedWithTheirFiles) {
  RandomSource random(3);
  int with_proof = 0;
  for (int round = 0; round < trials(6, 18); ++round) {
    const bool is_degrees = round % 2 == 1, has_tool = round % 3 == 0;
    DhArm arm = usual_arm(random, round % 3, is_degrees ? 90 : 1.5707963267948966);
    if (has_tool) arm.tail = "tool = { xyz = [0.1, 0, 0.2], rpy = [0.1, 0.2, 0.3] }\n";
    const std::string motion =
        has_tool && round % 2 == 0
            ? fmt::format("tool = [{:.3f}, {:.3f}, {:.3f}, {:.3f}, {:.3f}, {:.3f}]\n",
                          random.between(-1, 1), random.between(-1, 1), random.between(-1, 1),
                          random.between(-3, 3), random.between(-1, 1), random.between(-3, 3))
            : some_values(random, is_degrees ? 175 : 3.1);
    const std::string model = arm.text(is_degrees ? "deg" : "rad", motion);
    const Certified made = certified(model);
    if (made.solutions.opposite == 0 || !is_complete(made.solutions)) continue;
    ASSERT_TRUE(made.status.is_written()) << made.status.obstacle() << model;
    const verifier::Verification v = verified(made.text, model);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v) << model << made.text;
    ++with_proof;
    if (round % 6 == 5 && !made.solutions.found.empty())
      expect_forgeries_of_postures_fail(made.text);
  }
  EXPECT_GE(with_proof, trials(5, 15));
}

}  // namespace
}  // namespace regulus::detail::test
