// SPDX-License-Identifier: GPL-3.0-or-later
// Postures of an arm whose place has errors. The oracle is Newton's method in doubles, at places within them.
#include <algorithm>
#include <cmath>

#include "codegen/support/errors.hpp"
#include "tests/property/solve/puma_rows.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::coupled_arms {
namespace {

using Six = std::array<double, 6>;

constexpr Six kTool = {0.4, 0.1, 0.5, 0.3, 0.2, 1};
constexpr std::array<const char*, 6> kNames = {"x", "y", "z", "roll", "pitch", "yaw"};
const Numbers kJoints = {0.3, 0.4, -0.7, 0.3, 0.9, -1.4};

Frame frame_of(const Six& tool) {
  return Frame{.p = {tool[0], tool[1], tool[2]}} * Frame{.R = turn_about({0, 0, 1}, tool[5])} *
         Frame{.R = turn_about({0, 1, 0}, tool[4])} * Frame{.R = turn_about({1, 0, 0}, tool[3])};
}

std::string errors_text(const std::vector<std::pair<std::string, double>>& errors) {
  std::string text;
  for (const auto& [name, error] : errors)
    text += fmt::format("{}{} = {:.17g}", text.empty() ? "" : ", ", name, error);
  return text.empty() ? "" : "error = { " + text + " }\n";
}

std::string motion_by_tool(const Six& tool, const Six& errors) {
  std::vector<std::pair<std::string, double>> named;
  for (std::size_t i = 0; i < 6; ++i)
    if (errors[i] != 0) named.emplace_back(kNames[i], errors[i]);
  return fmt::format("tool = [{:.17g}]\n{}", fmt::join(tool, ", "), errors_text(named));
}

std::string motion_by_joints(const Numbers& q, const Numbers& errors) {
  std::string text;
  std::vector<std::pair<std::string, double>> named;
  for (std::size_t i = 0; i < 6; ++i) {
    text += fmt::format("q{} = {:.17g}\n", i + 1, q[i]);
    if (errors[i] != 0) named.emplace_back(fmt::format("q{}", i + 1), errors[i]);
  }
  return text + errors_text(named);
}

/// The postures of the nominal arm, followed to another place and other rows.
std::vector<Numbers> followed_to(const Frame& end, const Rows& rows, const Solutions& points) {
  std::vector<Numbers> postures;
  for (const CertainSolution& point : points.found)
    postures.push_back(newton(RowsGap{rows, end}, middle_of(point.values)));
  return postures;
}

void expect_in_tubes(const Solutions& tubes, const std::vector<Numbers>& postures) {
  for (const Numbers& posture : postures) {
    ASSERT_FALSE(posture.empty());
    EXPECT_EQ(tubes_with(tubes, posture), 1);
  }
}

Six place_within(const Six& errors, RandomSource& random) {
  Six tool = kTool;
  for (std::size_t i = 0; i < 6; ++i) tool[i] += deviation(random, errors[i]);
  return tool;
}

TEST(PosturesOfAToolWithErrors, AreInTheirTubes) {
  RandomSource random(81);
  const Solutions points = solved(text_of(kPuma, {}, "", motion_by_tool(kTool, {})));
  ASSERT_TRUE(is_complete(points));
  ASSERT_EQ(points.found.size(), 8U);
  for (const Six& errors :
       {Six{1e-3, 1e-3, 1e-3}, Six{0, 0, 0, 1e-3, 1e-3, 1e-3}, Six{1e-3, 0, 2e-3, 0, 2e-3, 0},
        Six{1e-2, 1e-2, 1e-2, 1e-2, 1e-2, 1e-2}}) {
    const Solutions tubes = solved(text_of(kPuma, {}, "", motion_by_tool(kTool, errors)));
    ASSERT_TRUE(is_complete(tubes)) << tubes.obstacle;
    EXPECT_FALSE(tubes.is_nominal);
    ASSERT_EQ(tubes.found.size(), 8U);
    for (int other = 0; other < trials(40, 400); ++other)
      expect_in_tubes(tubes, followed_to(frame_of(place_within(errors, random)), kPuma, points));
  }
}

TEST(PosturesOfJointsWithErrors, AreInTheirTubes) {
  RandomSource random(82);
  const Solutions points = solved(text_of(kPuma, kJoints, ""));
  ASSERT_EQ(points.found.size(), 8U);
  for (const Numbers& errors : {Numbers{1e-3, 0, 0, 0, 0, 0}, Numbers{0, 1e-3, 0, 0, 2e-3, 0},
                                Numbers{1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3}}) {
    const Solutions tubes = solved(text_of(kPuma, {}, "", motion_by_joints(kJoints, errors)));
    ASSERT_TRUE(is_complete(tubes)) << tubes.obstacle;
    ASSERT_EQ(tubes.found.size(), 8U);
    for (int other = 0; other < trials(40, 400); ++other) {
      Numbers q = kJoints;
      for (std::size_t i = 0; i < 6; ++i) q[i] += deviation(random, errors[i]);
      EXPECT_EQ(tubes_with(tubes, q), 1);
      expect_in_tubes(tubes, followed_to(end_of(kPuma, q), kPuma, points));
    }
  }
}

/// Errors count beside the tolerances of the arm, of which none is dropped.
TEST(PosturesOfAnArmWithTolerancesAndErrors, AreInTheirTubes) {
  RandomSource random(83);
  const char* const kTolerances = "length_tolerance = 5e-4\nangle_tolerance = 1e-4\n";
  const Six errors = {1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3};
  const Solutions points = solved(text_of(kPuma, {}, "", motion_by_tool(kTool, {}))),
                  tubes = solved(text_of(kPuma, {}, kTolerances, motion_by_tool(kTool, errors)));
  ASSERT_TRUE(is_complete(tubes)) << tubes.obstacle;
  ASSERT_EQ(tubes.found.size(), 8U);
  for (int other = 0; other < trials(60, 600); ++other) {
    Rows rows = kPuma;
    for (auto& row : rows) {
      row[0] += deviation(random, 5e-4);
      row[1] += deviation(random, 1e-4);
      row[2] += deviation(random, 5e-4);
    }
    expect_in_tubes(tubes, followed_to(frame_of(place_within(errors, random)), rows, points));
  }
}

/// At the border of its reach a place with an error has now more postures and now none.
TEST(PosturesAtTheBorderOfReach, AreNotAlwaysAsMany) {
  const Six inside = {0.86, 0, 0, 0, 1.5, 0};
  const Solutions sharp = solved(text_of(kPuma, {}, "", motion_by_tool(inside, {}))),
                  wide = solved(text_of(kPuma, {}, "", motion_by_tool(inside, {0.05})));
  ASSERT_TRUE(is_complete(sharp)) << sharp.obstacle;
  ASSERT_FALSE(sharp.found.empty());
  EXPECT_FALSE(is_complete(wide));
  EXPECT_TRUE(wide.changes) << wide.obstacle;
  EXPECT_NE(wide.obstacle.find(" with x_error = "), std::string::npos) << wide.obstacle;
}

struct Forgery {
  const char *from, *to;
};

/// The certificate is about the errors of the file, and of no other file.
void expect_only_with(const std::string& model, const std::vector<Forgery>& forgeries) {
  const Certified made = certified(model);
  ASSERT_TRUE(is_complete(made.solutions)) << made.solutions.obstacle;
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v) << made.status.obstacle();
  const std::string plain = without_sum(made.text);
  ASSERT_EQ(outcome(plain, model), Outcome::kVerified);
  for (const auto& [from, to] : forgeries) {
    std::string changed = model;
    ASSERT_NE(changed.find(from), std::string::npos) << from;
    changed.replace(changed.find(from), std::string(from).size(), to);
    EXPECT_NE(outcome(plain, changed), Outcome::kVerified) << from << " is " << to;
  }
  // The errors are needed where they stand.
  for (const char* key : {"uncertain", "tool", "joint-value"})
    for (Lines lines = lines_of(plain); std::string & line : lines) {
      if (!line.starts_with(std::string(key) + ' ')) continue;
      const std::size_t at = line.find("_error");
      if (at == std::string::npos) continue;
      Lines other = lines_of(plain);
      std::string& forged = other[std::size_t(&line - lines.data())];
      const std::size_t number = key[0] == 'u' ? line.rfind(' ') + 1 : line.rfind(' ', at) + 1;
      forged.insert(number, key[0] == 'u' ? "1/2*" : "2*");
      EXPECT_NE(outcome(joined(other), model), Outcome::kVerified) << forged;
    }
}

TEST(PosturesOfAToolWithErrors, AreVerifiedWithTheirFile) {
  const Six errors = {1e-3, 0, 0, 0, 0, 1e-3};
  expect_only_with(text_of(kPuma, {}, "", motion_by_tool(kTool, errors)),
                   {{"x = 0.001", "x = 0.0011"},
                    {"yaw = 0.001", "yaw = 0.0011"},
                    {"x = 0.001", "y = 0.001"},
                    {"yaw = 0.001", "pitch = 0.001"},
                    {"x = 0.001", "x = 0.001, z = 1e-9"},
                    {"error = {", "error = { y = 1e-9,"}});
}

TEST(PosturesOfJointsWithErrors, AreVerifiedWithTheirFile) {
  expect_only_with(
      text_of(kPuma, {}, "", motion_by_joints(kJoints, {0x1p-20, 0, 0, 0, 0x1p-20, 0})),
      {{"q1 = 9.5367431640625e-07", "q1 = 9.6e-07"},
       {"q1 = 9.5367431640625e-07", "q2 = 9.5367431640625e-07"},
       {"error = {", "error = { q6 = 1e-9,"}});
}

/// A certificate without errors is about no file with some.
TEST(PosturesOfAToolWithoutErrors, AreNotThoseOfAFileWithErrors) {
  const std::string plain =
      without_sum(certified(text_of(kPuma, {}, "", motion_by_tool(kTool, {}))).text);
  for (const char* error : {"x", "roll"}) {
    const std::string model = text_of(kPuma, {}, "", motion_by_tool(kTool, {})) +
                              fmt::format("error = {{ {} = 1e-9 }}\n", error);
    EXPECT_NE(outcome(plain, model), Outcome::kVerified);
  }
}

TEST(ErrorsOfATool, AreInTheUnitOfTheArm) {
  const std::string radians = text_of(kPuma, {}, "", motion_by_tool({0.4, 0.1, 0.5}, {})) +
                              "error = { yaw = \"0.1*deg\", x = 0.001 }\n";
  std::string degrees = radians;
  const auto change = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(degrees.find(from), std::string::npos);
    degrees.replace(degrees.find(from), from.size(), to);
  };
  for (const auto& row : kPuma) {
    const std::string alpha = fmt::format("alpha = {:.17g}", row[1]);
    change(alpha, fmt::format("alpha = {}", std::round(row[1] / kQuarter) * 90));
  }
  change("[serial]\n", "[serial]\nangle_unit = \"deg\"\n");
  change("\"0.1*deg\"", "0.1");
  const Certified one = certified(radians), other = certified(degrees);
  const Lines lines = lines_of(one.text), others = lines_of(other.text);
  ASSERT_GT(count_of(lines, "uncertain"), 1U);
  EXPECT_EQ(lines[first(lines, "tool")], others[first(others, "tool")]);
  EXPECT_EQ(outcome(without_sum(other.text), degrees), Outcome::kVerified);
}

/// SCARA robots keep their tools upright.
TEST(ErrorsOfALevelArm, MayNotTiltItsTool) {
  const std::string arm = library_model("scara"), head = arm.substr(0, arm.find("[motion."));
  const std::string at = "[motion.at]\nq1 = 0.3\nq2 = 0.5\nd3 = 0.1\nq4 = 0.7\n";
  const std::string varying = head + at + "error = { q1 = 0.001, d3 = 0.001 }\n";
  const Certified made = certified(varying, {}, "at");
  ASSERT_TRUE(is_complete(made.solutions)) << made.solutions.obstacle;
  EXPECT_EQ(made.solutions.found.size(), 2U);
  EXPECT_EQ(outcome(without_sum(made.text), varying), Outcome::kVerified);
  const std::string tool = head + "[motion.at]\ntool = [0.5, 0.2, 0.1, \"pi\", 0, 0.3]\n";
  const Certified upright = certified(tool + "error = { x = 1e-3, yaw = 1e-3 }\n", {}, "at");
  ASSERT_TRUE(is_complete(upright.solutions)) << upright.solutions.obstacle;
  EXPECT_FALSE(upright.solutions.is_nominal);
  EXPECT_THROW(static_cast<void>(certified(tool + "error = { roll = 1e-3 }\n", {}, "at")),
               UsageError);
}

TEST(NamesOfErrors, AreNoOtherNamesOfTheModel) {
  const std::string model = text_of(kPuma, {}, "", motion_by_tool(kTool, {1e-3})) +
                            "[geometry]\nx_error = { value = 1, tolerance = 0.1 }\n";
  EXPECT_THROW(static_cast<void>(solved(model)), UsageError);
}

}  // namespace
}  // namespace regulus::detail::test::coupled_arms
