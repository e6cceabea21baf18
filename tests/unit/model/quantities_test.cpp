// SPDX-License-Identifier: GPL-3.0-or-later
// A declared tolerance applies to a value however it is written: as a number, a name, an expression.
#include "codegen/model/file/quantities.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/file/model_file.hpp"
#include "tests/support/example_model.hpp"

namespace regulus::detail::quantities {
namespace {

using test::changed;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kHead = "regulus = 1\nname = \"m\"\n";

Model parsed(const std::string& text) { return parse_model(kHead + text, "m.toml"); }

/// A number for each name, the same in every model.
GiNaC::numeric some_value(const std::string& name) {
  long sum = 0;
  for (const char c : name) sum = (31 * sum + c) % 997;
  return {sum + 500, 700};
}

/// The question that a model asks: its uncertain quantities, and the matrix, its scales and its
/// conditions at some values of all that is not an exact constant of [geometry].
std::vector<std::string> question(const Model& model) {
  std::vector<std::string> lines;
  GiNaC::exmap values;
  for (const PoseParameter& p : model.pose) values[p.symbol] = some_value(p.name);
  for (const GeometryParameter& g : model.geometry) {
    const bool is_exact = g.group.empty() && g.tolerance.is_zero();
    values[g.symbol] = is_exact ? g.value : GiNaC::ex(some_value(g.name));
    if (!is_exact)
      lines.push_back(g.name + " = " + formula_text(g.value) + " +- " + formula_text(g.tolerance) +
                      " of " + g.group + " in " + std::to_string(g.ball));
  }
  const auto add = [&](const GiNaC::ex& e) {
    std::ostringstream text;
    text.precision(8);
    const GiNaC::ex value = e.subs(values).evalf();
    ASSERT_TRUE(GiNaC::is_a<GiNaC::numeric>(value)) << e;
    const auto& number = GiNaC::ex_to<GiNaC::numeric>(value);
    text << number.real().to_double() << " + " << number.imag().to_double() << "i";
    lines.push_back(text.str());
  };
  for (unsigned i = 0; i < model.matrix.rows(); ++i)
    for (unsigned j = 0; j < model.matrix.cols(); ++j) add(model.matrix(i, j));
  for (const auto& scale : model.row_scale) add(scale);
  for (const auto& condition : model.must_be_defined) add(condition);
  for (const ToleranceBall& ball : model.balls)
    lines.push_back("ball of " + std::to_string(ball.members.size()));
  return lines;
}

/// A number, a name of [geometry] for it, a name of [let], and two expressions that equal it.
void expect_same_question(const std::string& model, const std::string& number) {
  const std::string names = "[geometry]\nL = " + number + "\n[let]\nM = \"L\"\n";
  const Model written = parsed(changed(model, "NUMBER", number));
  ASSERT_FALSE(written.geometry.empty()) << model;
  for (const char* other : {"\"L\"", "\"M\"", "\"2*L - M\"", "\"-L*cos(180deg)\""})
    EXPECT_EQ(question(parsed(names + changed(model, "NUMBER", other))), question(written))
        << other << " in\n"
        << model;
}

const std::string kPlanar =
    "[legs]\nbase_tolerance = 0.1\nplatform_tolerance = 0.2\ncrank_tolerance = 0.3\n"
    "rod_tolerance = 0.4\naxis_tolerance = 0.5\n"
    "[[legs.leg]]\ntype = \"RRR\"\nbase = [0, 5]\nplatform = [1, 0]\ncrank = 7\nrod = 8\n"
    "mode = \"+\"\n"
    "[[legs.leg]]\ntype = \"RPR\"\nbase = [9, 0]\nplatform = [1, 1]\n"
    "[[legs.leg]]\ntype = \"PRR\"\nbase = [0, 9]\nplatform = [0, 1]\naxis = [1, 2]\nrod = 6\n"
    "mode = \"-\"\n"
    "[motion.zero]\nx = 0\ny = 0\nphi = 0\n";

TEST(DeclaredTolerances, OfLegsApplyToNamesAndExpressions) {
  for (const auto& [from, to, number] :
       {std::array<std::string, 3>{"base = [0, 5]", "base = [0, NUMBER]", "5"},
        {"platform = [1, 0]", "platform = [NUMBER, 0]", "1"},
        {"crank = 7", "crank = NUMBER", "7"},
        {"rod = 8", "rod = NUMBER", "8"},
        {"axis = [1, 2]", "axis = [1, NUMBER]", "2"}}) {
    expect_same_question(changed(kPlanar, from, to), number);
    const std::string balls = changed(kPlanar, "[legs]\n", "[legs]\ntolerance_shape = \"ball\"\n");
    expect_same_question(changed(balls, from, to), number);
  }
}

TEST(DeclaredTolerances, OfSixLegsApplyToNamesAndExpressions) {
  const std::string anchors =
      "[[4, 0, 0], [2, 0, 5], [3, 0, 1], [4, 1, 0], [5, 0, 2], [6, 0, 3]]\n";
  const std::string robot =
      "[gough]\norientation = \"euler-zxz\"\nbase_tolerance = 0.1\nbase = " + anchors +
      "platform = " + changed(anchors, "[2, 0, 5]", "[2, 0, 4]") +
      "[motion.zero]\nx = 0\ny = 0\nz = 9\npsi = 0\ntheta = 0\nphi = 0\n";
  for (const auto& written :
       {robot, changed(robot, "[2, 0, 5]", "{ value = [2, 0, 5], radius = 0.3 }"),
        changed(robot, "[gough]\n", "[gough]\ntolerance_shape = \"ball\"\n"),
        changed(robot, "base_tolerance = 0.1\n", "")})
    expect_same_question(changed(written, "[2, 0, 5]", "[2, 0, NUMBER]"), "5");
}

TEST(DeclaredTolerances, OfOneLegAreItsOwn) {
  const std::string own =
      changed(changed(kPlanar, "base = [9, 0]", "base = { value = [9, 0], radius = 2 }"), "rod = 6",
              "rod = { value = 6, tolerance = 3 }");
  const Model model = parsed(own);
  for (const GeometryParameter& g : model.geometry) {
    if (g.name == "a2_x" || g.name == "a2_y") {
      EXPECT_TRUE(g.tolerance.is_equal(2));
      EXPECT_EQ(g.ball, 0);
    } else if (g.name == "rod_3") {
      EXPECT_TRUE(g.tolerance.is_equal(3));
    } else if (g.group == "rods" || g.group == "base") {
      EXPECT_TRUE(
          g.tolerance.is_equal(g.group == "rods" ? GiNaC::numeric(2, 5) : GiNaC::numeric(1, 10)))
          << g.name;
      EXPECT_EQ(g.ball, -1);
    }
  }
  expect_same_question(changed(own, "value = 6", "value = NUMBER"), "6");
  expect_same_question(changed(own, "value = [9, 0]", "value = [NUMBER, 0]"), "9");
}

TEST(DeclaredTolerances, OfNoValueStillMakeTheirGroups) {
  std::string exact = kPlanar;
  for (const char* line :
       {"base_tolerance = 0.1\n", "platform_tolerance = 0.2\n", "crank_tolerance = 0.3\n",
        "rod_tolerance = 0.4\n", "axis_tolerance = 0.5\n"})
    exact = changed(exact, line, "");
  expect_same_question(changed(exact, "crank = 7", "crank = NUMBER"), "7");
  expect_same_question(changed(exact, "axis = [1, 2]", "axis = [1, NUMBER]"), "2");
}

const std::string kArm =
    "[serial]\nlength_tolerance = 0.1\nangle_tolerance = \"1deg\"\nconvention = \"standard-dh\"\n"
    "joints = [{ name = \"q1\", a = 1, alpha = 0.5 }, { name = \"q2\", a = 2, d = 3, theta = 0 }]\n"
    "[motion.zero]\nq1 = 0\nq2 = 0\n";
const std::string kArmByOrigins =
    "[serial]\nlength_tolerance = 0.1\nangle_tolerance = \"1deg\"\n"
    "joints = [{ name = \"q1\" }, { name = \"q2\", xyz = [1, 2, 0], rpy = [0.25, 0, 0.5] }]\n"
    "[motion.zero]\nq1 = 0\nq2 = 0\n";

TEST(DeclaredTolerances, OfArmsApplyToNamesAndExpressions) {
  expect_same_question(changed(kArm, "alpha = 0.5", "alpha = NUMBER"), "0.5");
  expect_same_question(changed(kArm, "a = 2", "a = NUMBER"), "2");
  expect_same_question(changed(kArm, "d = 3", "d = NUMBER"), "3");
  expect_same_question(changed(kArm, "theta = 0", "theta = NUMBER"), "0");
  expect_same_question(changed(kArmByOrigins, "[1, 2, 0]", "[1, NUMBER, 0]"), "2");
  expect_same_question(changed(kArmByOrigins, "[0.25,", "[NUMBER,"), "0.25");
  const std::string degrees = changed(kArm, "[serial]\n", "[serial]\nangle_unit = \"deg\"\n");
  expect_same_question(changed(degrees, "alpha = 0.5", "alpha = NUMBER"), "0.5");
}

TEST(DeclaredTolerances, OfSharedNamesVaryIndependently) {
  const Model model =
      parsed("[geometry]\nL = 7\n" +
             changed(changed(kPlanar, "crank = 7", "crank = \"L\""), "rod = 8", "rod = \"L\""));
  std::map<std::string, int> counts;
  for (const GeometryParameter& g : model.geometry)
    if (!g.tolerance.is_zero()) ++counts[g.group];
  EXPECT_EQ(counts, (std::map<std::string, int>{
                        {"axes", 2}, {"base", 6}, {"cranks", 1}, {"platform", 6}, {"rods", 2}}));
}

TEST(DeclaredTolerances, AddToThoseOfTheConstants) {
  const Model model =
      parsed("[geometry]\nL = { value = 7, tolerance = 0.01, group = \"own\" }\n" +
             changed(changed(kPlanar, "crank = 7", "crank = \"L\""), "rod = 8", "rod = \"L + 1\""));
  std::vector<std::string> names;
  for (const GeometryParameter& g : model.geometry)
    if (g.group == "own" || g.group == "cranks" || g.group == "rods")
      names.push_back(g.name + " " + formula_text(g.value) + " +- " + formula_text(g.tolerance));
  EXPECT_THAT(names, ElementsAre("L 7 +- 1/100", "crank_1_error 0 +- 3/10", "rod_1_error 0 +- 2/5",
                                 "rod_3 6 +- 2/5"));
  for (const char* name : {"L", "crank_1_error", "rod_1_error"}) {
    bool occurs = false;
    for (const GeometryParameter& g : model.geometry)
      for (unsigned j = 0; j < 3; ++j)
        occurs = occurs || (g.name == name && model.matrix(0, j).has(g.symbol));
    EXPECT_TRUE(occurs) << name;
  }
}

TEST(DeclaredTolerances, OfAnArmAddToThoseOfTheConstants) {
  const Model model = parsed("[geometry]\nL = { value = 2, tolerance = 0.01 }\n" +
                             changed(kArm, "a = 2", "a = \"L\""));
  std::vector<std::string> names;
  for (const GeometryParameter& g : model.geometry) names.push_back(g.name);
  EXPECT_THAT(names, ElementsAre("L", "a_1", "alpha_1", "a_2_error", "d_2", "theta_2"));
}

TEST(LegsOfAQuaternion, HaveCranksAndRails) {
  for (const char* leg : {"type = \"RUS\"\ncrank = 2\n", "type = \"PUS\"\n"}) {
    std::string text = "[legs]\norientation = \"quaternion\"\nrod = 5\nmode = \"+\"\n";
    for (int i = 0; i < 6; ++i)
      text += std::string("[[legs.leg]]\n") + leg + "base = [" + std::to_string(i) +
              ", 1, 0]\nplatform = [0, " + std::to_string(i) + ", 1]\naxis = [1, " +
              std::to_string(i) + ", 2]\n";
    text += "[motion.zero]\nx = 0\ny = 0\nz = 4\nq0 = 1\nq1 = 0\nq2 = 0\nq3 = 0\n";
    EXPECT_EQ(parsed(text).matrix.rows(), 6U) << leg;
  }
}

TEST(ArmsInDegrees, HaveTheMatrixOfRadians) {
  const std::string radians =
      "[serial]\nconvention = \"standard-dh\"\njoints = [{ name = \"q1\", alpha = \"90deg\", range "
      "= [\"-90deg\", \"90deg\"] }, { name = \"q2\", a = 1, theta = \"30deg\", range = [0, "
      "\"45deg\"] }, { mimic = \"q2\", multiplier = -1, offset = \"10deg\", a = 1 }, { name = "
      "\"slide\", type = \"prismatic\", range = [0, 1] }]\n";
  std::string degrees = changed(radians, "[serial]", "[serial]\nangle_unit = \"deg\"");
  for (std::size_t at = 0; (at = degrees.find("deg\"", at)) != std::string::npos;)
    if (degrees[at - 1] != '"') {
      const std::size_t begin = degrees.rfind('"', at - 1);
      degrees.erase(at, 4).erase(begin, 1);
    } else {
      ++at;
    }
  const Model in_radians = parsed(radians), in_degrees = parsed(degrees);
  EXPECT_THAT(in_degrees.warnings, IsEmpty());
  EXPECT_EQ(in_degrees.pose.at(0).unit, "deg");
  EXPECT_EQ(in_degrees.pose.at(2).unit, "1");
  EXPECT_TRUE(in_degrees.limits.at(1).hi.is_equal(45));
  GiNaC::exmap same;
  for (std::size_t j = 0; j < 3; ++j) {
    const PoseParameter& p = in_degrees.pose[j];
    same[p.symbol] = p.unit == "deg" ? in_radians.pose[j].symbol / one_degree()
                                     : GiNaC::ex(in_radians.pose[j].symbol);
  }
  ASSERT_EQ(in_degrees.matrix.rows(), in_radians.matrix.rows());
  for (unsigned i = 0; i < in_radians.matrix.rows(); ++i)
    for (unsigned j = 0; j < in_radians.matrix.cols(); ++j)
      EXPECT_TRUE(
          (in_degrees.matrix(i, j).subs(same) - in_radians.matrix(i, j)).expand().is_zero());
}

TEST(ArmsInRadians, GetAWarningWithTheLineOfAnAngleBeyondATurn) {
  const Model model = parsed(
      "[serial]\nconvention = \"standard-dh\"\njoints = [\n{ name = \"q1\", a = 1, alpha = 90, "
      "range = [0, 1] },\n{ name = \"q2\", a = 1, range = [-90, 90] }]\n");
  EXPECT_THAT(
      model.warnings,
      ElementsAre("m.toml:6: serial.joints[1].alpha is 90 rad, more than a turn; if degrees "
                  "are meant, write \"90deg\"",
                  testing::StartsWith("m.toml:7: serial.joints[2].range is 90 rad")));
}

}  // namespace
}  // namespace regulus::detail::quantities
