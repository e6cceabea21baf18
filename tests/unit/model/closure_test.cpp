// SPDX-License-Identifier: GPL-3.0-or-later
// [closure]: unknowns, equations, the start of a branch, and the matrix that they make.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "codegen/model/closure_start.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/mechanism/closure_matrix.hpp"
#include "codegen/model/overrides.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/example_model.hpp"

namespace regulus::detail {
namespace {

using test::changed;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kFourBar =
    "regulus = 1\n"
    "name = \"four-bar\"\n"
    "[pose]\n"
    "theta = \"rad\"\n"
    "[geometry]\n"
    "crank = { value = 0.2, tolerance = 0, group = \"links\" }\n"
    "coupler = 0.35355\n"
    "[let]\n"
    "across = \"coupler*sin(phi)\"\n"
    "[closure]\n"
    "unknowns = { psi = \"rad\", phi = \"rad\" }\n"
    "equations = [\n"
    "  \"crank*cos(theta) + coupler*cos(phi) - 0.45 - 0.25*cos(psi)\",\n"
    "  \"crank*sin(theta) + across - 0.25*sin(psi)\",\n"
    "]\n"
    "start = { theta = \"60*deg\", phi = 0.25, psi = 1.9 }\n"
    "[motion.turn]\n"
    "theta = [\"-100*deg\", \"100*deg\"]\n";

Model parsed(const std::string& text) { return parse_model(text, "m.toml"); }

std::vector<std::string> texts(const std::vector<GiNaC::ex>& expressions) {
  std::vector<std::string> result;
  for (const GiNaC::ex& e : expressions) result.push_back(formula_text(e));
  return result;
}

/// The question that a model asks, in the texts of exact expressions.
std::vector<std::string> question(const Model& model) {
  const Closure& closure = model.closure.value();
  std::vector<std::string> lines;
  const auto add = [&lines](const std::vector<GiNaC::ex>& expressions) {
    for (const std::string& text : texts(expressions)) lines.push_back(text);
  };
  for (const PoseParameter& u : closure.unknowns) lines.push_back(u.name + " " + u.unit);
  for (const Range& range : closure.ranges) add({range.lo, range.hi});
  for (const auto* list : {&closure.equations, &closure.start_pose, &closure.start,
                           &closure.start_radius, &model.must_be_defined})
    add(*list);
  for (unsigned i = 0; i < model.matrix.rows(); ++i)
    for (unsigned j = 0; j < model.matrix.cols(); ++j) add({model.matrix(i, j)});
  return lines;
}

TEST(Closure, HasUnknownsInTheirOrderThatAreNotOfThePose) {
  const Model model = parsed(kFourBar);
  ASSERT_EQ(model.closure->unknowns.size(), 2);
  EXPECT_EQ(model.closure->unknowns[0].name, "psi");
  EXPECT_EQ(model.closure->unknowns[1].name, "phi");
  ASSERT_EQ(model.pose.size(), 1);
  EXPECT_EQ(model.pose[0].name, "theta");
  EXPECT_EQ(model.motions[0].parameters.size(), 1);
}

TEST(Closure, HasTheMatrixOfDerivativesByItsUnknowns) {
  const Model model = parsed(kFourBar);
  ASSERT_EQ(model.matrix.rows(), 2);
  ASSERT_EQ(model.matrix.cols(), 2);
  EXPECT_EQ(formula_text(model.matrix(0, 0)), "(1/4)*sin(psi)");
  EXPECT_EQ(formula_text(model.matrix(0, 1)), "-coupler*sin(phi)");
  EXPECT_EQ(formula_text(model.matrix(1, 0)), "-(1/4)*cos(psi)");
  EXPECT_EQ(formula_text(model.matrix(1, 1)), "cos(phi)*coupler");
}

TEST(Closure, HasDefaultsThatAreExact) {
  const Closure closure = parsed(kFourBar).closure.value();
  EXPECT_THAT(texts(closure.start_pose), ElementsAre("(1/3)*pi"));
  EXPECT_THAT(texts(closure.start), ElementsAre("19/10", "1/4"));
  EXPECT_THAT(texts(closure.start_radius), ElementsAre("1/100", "1/100"));
  EXPECT_THAT(texts({closure.ranges[0].lo, closure.ranges[0].hi}),
              ElementsAre("19/10 - 2*pi", "19/10 + 2*pi"));
}

TEST(Closure, HasDefaultsOfLengthsBySize) {
  const std::string by_length = changed(kFourBar, "psi = \"rad\"", "psi = \"mm\"");
  const Closure closure = parsed(by_length).closure.value();
  EXPECT_THAT(texts(closure.start_radius), ElementsAre("19/1000", "1/100"));
  EXPECT_THAT(texts({closure.ranges[0].lo, closure.ranges[0].hi}),
              ElementsAre("-18981/10", "19019/10"));
  const Closure small = parsed(changed(by_length, "psi = 1.9", "psi = -0.5")).closure.value();
  EXPECT_THAT(texts({small.start_radius[0], small.ranges[0].lo, small.ranges[0].hi}),
              ElementsAre("1/100", "-2001/2", "1999/2"));
}

TEST(Closure, TakesRangesAndRadiiOfSomeUnknowns) {
  const Closure closure =
      parsed(changed(kFourBar, "[motion.turn]",
                     "[closure.radius]\nphi = \"1deg\"\n[closure.range]\npsi = [0, \"pi\"]\n"
                     "[motion.turn]"))
          .closure.value();
  EXPECT_THAT(texts(closure.start_radius), ElementsAre("1/100", "(1/180)*pi"));
  EXPECT_THAT(texts({closure.ranges[0].lo, closure.ranges[0].hi}), ElementsAre("0", "pi"));
  EXPECT_THAT(texts({closure.ranges[1].lo, closure.ranges[1].hi}),
              ElementsAre("1/4 - 2*pi", "1/4 + 2*pi"));
}

TEST(Closure, InDegreesHasStartRadiusAndRangeInDegrees) {
  std::string text = changed(kFourBar, "psi = \"rad\"", "psi = \"deg\"");
  const Model model = parsed(changed(text, "psi = 1.9", "psi = 108"));
  EXPECT_EQ(formula_text(model.closure->start[0]), "108");
  EXPECT_TRUE((model.closure->start_radius[0] * GiNaC::Pi / 180 - GiNaC::numeric(1, 100))
                  .expand()
                  .is_zero());
  EXPECT_THAT(texts({model.closure->ranges[0].lo, model.closure->ranges[0].hi}),
              ElementsAre("-252", "468"));
  EXPECT_EQ(formula_text(model.matrix(0, 0)), "(1/720)*pi*sin((1/180)*pi*psi)");
}

/// A number, a name of [let] for it, and expressions that equal it.
TEST(Closure, AsksTheSameOfANumberAndOfWhatEqualsIt) {
  const std::vector<std::string> asked = question(parsed(kFourBar));
  const std::string named = changed(kFourBar, "[let]\n", "[let]\nrocker = 0.25\n");
  for (const char* other : {"rocker", "(1/4)", "0.250", "25e-2", "(2*rocker - 0.25)"}) {
    std::string text = changed(named, "0.25*cos(psi)", std::string(other) + "*cos(psi)");
    text = changed(text, "0.25*sin(psi)", std::string(other) + "*sin(psi)");
    EXPECT_EQ(question(parsed(text)), asked) << other;
  }
  EXPECT_EQ(question(parsed(changed(kFourBar, "across - ", "coupler*sin(phi) - "))), asked);
  for (const char* other : {"\"pi/3\"", "\"60deg\"", "\"pi/6 + 30*deg\""})
    EXPECT_EQ(question(parsed(changed(kFourBar, "\"60*deg\"", other))), asked) << other;
  for (const char* other : {"\"1/4\"", "0.250", "\"2^-2\"", "\"sqrt(1/16)\"", "25e-2"})
    EXPECT_EQ(question(parsed(changed(kFourBar, "phi = 0.25", "phi = " + std::string(other)))),
              asked)
        << other;
  EXPECT_EQ(question(parsed(changed(kFourBar, "[motion.turn]",
                                    "[closure.radius]\nphi = 0.01\npsi = \"1/100\"\n"
                                    "[closure.range]\nphi = [\"0.25 - 360deg\", \"1/4 + 2*pi\"]\n"
                                    "[motion.turn]"))),
            asked);
}

TEST(Closure, KeepsTheConditionsOfItsEquations) {
  const Model model = parsed(changed(kFourBar, "- 0.25*sin(psi)", "- sqrt(psi)*sqrt(psi)"));
  EXPECT_THAT(texts(model.must_be_defined), testing::Contains("sqrt(psi)"));
  EXPECT_EQ(formula_text(model.matrix(1, 0)), "-1");
}

TEST(Closure, HasNoDerivativeOfAnAbsoluteValueAtZero) {
  const Model model = parsed(changed(kFourBar, "- 0.25*sin(psi)", "- abs(exp(psi) - 1)"));
  const GiNaC::ex entry = model.matrix(1, 0);
  EXPECT_THAT(formula_text(entry), testing::Not(HasSubstr("abs")));
  const GiNaC::ex& psi = model.closure->unknowns[0].symbol;
  EXPECT_NEAR(GiNaC::ex_to<GiNaC::numeric>(entry.subs(psi == -1).evalf()).to_double(), std::exp(-1),
              1e-12);
  EXPECT_THROW((void)entry.subs(psi == 0), GiNaC::pole_error);
}

TEST(Closure, BoundsTheSizeOfDerivatives) {
  const GiNaC::realsymbol x("x"), y("y");
  const std::vector<GiNaC::ex> expressions = {
      x * y, GiNaC::sin(x * y) * GiNaC::exp(x), GiNaC::pow(x + y, GiNaC::numeric(1, 2)),
      (x + 1) * (x + 2) * (x + y) * GiNaC::cos(x), GiNaC::atan2(x * x, y + x)};
  const auto nodes = [](const auto& self, const GiNaC::ex& e) -> double {
    double count = 1;
    for (std::size_t i = 0; i < e.nops(); ++i) count += self(self, e.op(i));
    return count;
  };
  for (const GiNaC::ex& e : expressions)
    EXPECT_LE(nodes(nodes, e.diff(x)), 4 * derivative_size(e, x)) << e;
  EXPECT_EQ(derivative_size(GiNaC::sin(y), x), 0);
}

TEST(Closure, TakesChangesOfTheCommandLine) {
  Model model = parsed(kFourBar);
  set_tolerance(model, "links", "0.001");
  EXPECT_EQ(formula_text(model.geometry[0].tolerance), "1/1000");
  Motion motion = model.motions[0];
  set_range(model, motion, "theta", "0:1");
  EXPECT_EQ(formula_text(motion.parameters[0].range.hi), "1");
  EXPECT_THROW(set_range(model, motion, "phi", "0:1"), InputError);
  EXPECT_THROW(set_tube(model, motion, "phi=0.1"), InputError);
  EXPECT_THROW((void)parse_model(kFourBar, "m.toml", "cos(phi)"), UsageError);
  EXPECT_NO_THROW((void)parse_model(kFourBar, "m.toml", "crank*cos(theta)"));
}

std::string refusal_of_start(const Model& model, const Motion& motion) try {
  (void)start_of(model, motion);
  return "";
} catch (const InputError& error) {
  return error.what();
}

TEST(ClosureStart, IsAPlaceOfTheMotion) {
  const Model model = parsed(kFourBar);
  Motion motion = model.motions[0];
  EXPECT_THAT(texts(start_of(model, motion)), ElementsAre("(1/3)*pi"));
  for (const char* range : {"60deg:1.5", "0:60deg", "pi/3:pi/3"}) {
    set_range(model, motion, "theta", range);
    EXPECT_EQ(refusal_of_start(model, motion), "") << range;
  }
  for (const char* range : {"0:1", "1.1:2"}) {
    set_range(model, motion, "theta", range);
    EXPECT_THAT(refusal_of_start(model, motion),
                testing::AllOf(HasSubstr("the motion 'turn' does not contain the start of "
                                         "[closure], where theta is (1/3)*pi rad"),
                               HasSubstr("widen the range of theta")));
  }
}

TEST(ClosureStart, IsRefusedForMotionsThatDoNotTellIt) {
  const auto refusal = [](const std::string& lines) {
    const Model model = parsed(changed(kFourBar, "theta = [\"-100*deg\", \"100*deg\"]\n", lines));
    return refusal_of_start(model, model.motions[0]);
  };
  EXPECT_EQ(refusal("theta = \"pi/3\"\n"), "");
  EXPECT_EQ(refusal("parameters = { T = [1, 2] }\ntheta = \"T\"\n"), "");
  EXPECT_THAT(refusal("theta = 1\n"),
              HasSubstr("theta is 1 rad there, and (1/3)*pi rad at the start"));
  // A motion by formulas begins at the start.
  EXPECT_EQ(refusal("parameters = { T = [0, 2] }\ntheta = \"2*T + pi/3\"\n"), "");
  EXPECT_EQ(refusal("parameters = { T = [\"pi/6\", 2] }\ntheta = \"2*T\"\n"), "");
  EXPECT_THAT(refusal("parameters = { T = [0, \"pi/6\"] }\ntheta = \"2*T\"\n"),
              HasSubstr("theta is 0 rad there, and (1/3)*pi rad at the start"));
  const std::string excluded =
      "parameters = { T = [0, 2], R = [0, 1] }\ntheta = \"T\"\nconstraints = [\"T - R\"]\n";
  EXPECT_EQ(refusal(excluded), "");
  const Model at_start =
      parsed(changed(kFourBar, "theta = [\"-100*deg\", \"100*deg\"]\n", excluded));
  EXPECT_THROW((void)start_within_constraints(at_start, at_start.motions[0]), InputError);
  EXPECT_THAT(refusal("waypoints = \"w.csv\"\n"), HasSubstr("follows way-points"));
}

/// Two pose parameters that follow one parameter of the motion start together.
TEST(ClosureStart, IsTheSameForAllThatFollowAParameter) {
  const std::string two =
      changed(changed(kFourBar, "theta = \"rad\"\n", "theta = \"rad\"\nx = \"1\"\n"),
              "theta = [\"-100*deg\", \"100*deg\"]\n",
              "parameters = { T = [0, 2] }\ntheta = \"T\"\nx = \"T\"\n");
  const Model same = parsed(changed(two, "start = { ", "start = { x = \"pi/3\", "));
  EXPECT_EQ(refusal_of_start(same, same.motions[0]), "");
  const Model other = parsed(changed(two, "start = { ", "start = { x = 1, "));
  EXPECT_THAT(refusal_of_start(other, other.motions[0]), HasSubstr("does not contain the start"));
}

}  // namespace
}  // namespace regulus::detail
