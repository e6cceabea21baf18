// SPDX-License-Identifier: GPL-3.0-or-later
// The verifier reads [legs] and [gough] by itself. A question about a robot on legs is that of its file;
// it is that of no file with another number.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "tests/property/certificate/compared_question.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::readings {
namespace {

using verifier::Outcome;

std::string leg(const std::string& type, double angle, bool is_planar, bool has_platform) {
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
}

/// Legs of all types, with and without tolerances.
std::vector<std::string> robots_on_legs() {
  std::vector<std::string> result;
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
    const auto step = std::size_t(trials(20, 6));
    for (std::size_t i = next++ % step; i < others.size(); i += step)
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

/// Anchors by names, uncertain ones too, and with tolerances of their own.
TEST(AQuestionAboutASixLeggedPlatform, IsThatOfItsFileIfAnchorsHaveNamesAndTolerances) {
  const std::string text =
      "regulus = 1\nname = \"h\"\n[geometry]\nL = 9\nR = { value = 7, tolerance = 0.02 }\n"
      "[let]\nM = \"L/3\"\n[gough]\norientation = \"euler-zxz\"\nbase_tolerance = 0.01\n"
      "base = [[\"-L\", 9, 0], { value = [\"L\", 9, 0], tolerance = 0.03 }, "
      "{ value = [12, \"-M\", 0], radius = 0.05 }, [3, -13, 0], [-3, -13, 0], [-12, -3, 0]]\n"
      "platform = [[-3, \"R\", 0], [3, \"R\", 0], [7, -1, 0], { value = [4, -6, 0], radius = 0 }, "
      "[-4, -6, 0], [-7, -1, 0]]\n"
      "[motion.w]\nx = 0\ny = [0, 1]\nz = [45, 46]\npsi = 0\ntheta = [0, 0.1]\nphi = 0.1\n";
  const std::string head = head_of(text);
  std::string why;
  EXPECT_EQ(compared(head, text, why), Outcome::kVerified) << text << why;
  for (const std::string& other : with_another_number(text, "[gough]", "[motion.w]"))
    EXPECT_EQ(compared(head, other), Outcome::kRejected) << other;
  for (const auto& [from, to] :
       {std::pair("L = 9", "L = 8"), std::pair("value = 7", "value = 8"), std::pair("0.02", "0.03"),
        std::pair("radius = 0.05", "tolerance = 0.05"),
        std::pair("tolerance = 0.03", "radius = 0.03"), std::pair("L/3", "L/2")})
    EXPECT_EQ(compared(head, replaced(text, from, to)), Outcome::kRejected) << from;
}

/// The same of a robot on legs.
TEST(AQuestionAboutARobotOnLegs, IsThatOfItsFileIfALegHasItsOwnTolerances) {
  const std::string text = replaced(
      replaced(replaced(robots_on_legs().front(), "[legs]\n", "[legs]\nbase_tolerance = 0.01\n"),
               "rod = 150", "rod = { value = 150, tolerance = 0.2 }"),
      "base = [", "base = { radius = 0.05, value = [");
  const std::size_t end = text.find(']', text.find("value = [")) + 1;
  const std::string whole = text.substr(0, end) + " }" + text.substr(end);
  const std::string head = head_of(whole);
  std::string why;
  EXPECT_EQ(compared(head, whole, why), Outcome::kVerified) << whole << why;
  for (const std::string& other : with_another_number(whole, "[[legs.leg]]", "[motion.w]"))
    EXPECT_EQ(compared(head, other), Outcome::kRejected) << other;
  EXPECT_EQ(compared(head, replaced(whole, "radius", "tolerance")), Outcome::kRejected);
}

}  // namespace
}  // namespace regulus::detail::test::readings
