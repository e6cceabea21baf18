// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/overrides.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/model/file/model_file.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/example_model.hpp"

namespace regulus::detail::overrides {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::Pi;
using testing::HasSubstr;

void expect_equal(const ex& a, const ex& b) { EXPECT_TRUE(a.is_equal(b)) << a << " is not " << b; }

Model example() { return parse_model(test::kExample, "example"); }
Model gough() { return parse_model(test::kExampleGough, "gough"); }

template <typename Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(FindMotion, ByName) { EXPECT_EQ(find_motion(example(), "circle").name, "circle"); }

TEST(FindMotion, TheOnlyOneNeedsNoName) { EXPECT_EQ(find_motion(gough()).name, "small"); }

TEST(FindMotion, ListsTheNamesWhenOneIsNeeded) {
  const Model model = example();
  EXPECT_EQ(refusal([&] { (void)find_motion(model); }),
            "no motion is given; this model has: small, circle");
}

TEST(FindMotion, SuggestsTheNearest) {
  const Model model = example();
  EXPECT_EQ(refusal([&] { (void)find_motion(model, "smal"); }),
            "no motion 'smal'; did you mean 'small'?");
}

TEST(SetRange, TakesExpressions) {
  const Model model = example();
  Motion motion = model.motions[0];
  set_range(model, motion, "phi", "-5*deg:pi/36");
  expect_equal(motion.parameters[2].range.lo, -Pi / 36);
  expect_equal(motion.parameters[2].range.hi, Pi / 36);
}

TEST(SetRange, TakesOneValue) {
  const Model model = example();
  Motion motion = model.motions[0];
  set_range(model, motion, "x", "0.1");
  expect_equal(motion.parameters[0].range.lo, numeric(1, 10));
  expect_equal(motion.parameters[0].range.hi, numeric(1, 10));
}

TEST(SetRange, FreesAConstantPoseParameter) {
  const Model model = gough();
  Motion motion = model.motions[0];
  set_range(model, motion, "psi", "-1:2");
  expect_equal(motion.pose[3], model.pose[3].symbol);
  ASSERT_EQ(motion.parameters.size(), 5U);
  EXPECT_EQ(motion.parameters[4].name, "psi");
  EXPECT_EQ(motion.parameters[4].unit, "rad");
  expect_equal(motion.parameters[4].range.hi, 2);
}

TEST(SetRange, LeavesAPoseThatMovesAlone) {
  const Model model = example();
  Motion motion = model.motions[1];
  EXPECT_EQ(refusal([&] { set_range(model, motion, "x", "0:1"); }),
            "this motion has no range or constant 'x'; it has: T, phi");
}

TEST(SetRange, RefusesAReversedRange) {
  const Model model = example();
  Motion motion = model.motions[0];
  EXPECT_THAT(refusal([&] { set_range(model, motion, "x", "2:1"); }), HasSubstr("is empty"));
  expect_equal(motion.parameters[0].range.lo, -1);
}

TEST(SetRange, RefusesWhatIsNotARange) {
  const Model model = example();
  Motion motion = model.motions[0];
  for (const char* text : {"", ":", "1:", ":1", "1:2:3", "a:b", "nan:1", "0:1/0", "0;1"})
    EXPECT_THAT(refusal([&] { set_range(model, motion, "x", text); }), testing::Ne("accepted"))
        << text;
}

TEST(SetAlpha, TakesAnExpressionAndRefusesANegativeOne) {
  const Model model = example();
  Motion motion = model.motions[0];
  set_alpha(motion, "1/3");
  expect_equal(motion.alpha, numeric(1, 3));
  EXPECT_THAT(refusal([&] { set_alpha(motion, "-1"); }), HasSubstr("negative number"));
  expect_equal(motion.alpha, numeric(1, 3));
}

TEST(SetTolerance, OfOneGroup) {
  Model model = gough();
  set_tolerance(model, "platform", "0.1");
  expect_equal(model.geometry[0].tolerance, numeric(1, 20));
  expect_equal(model.geometry[35].tolerance, numeric(1, 10));
}

TEST(SetTolerance, OfAListOfGroups) {
  Model model = gough();
  set_tolerance(model, "base,platform", "1/7");
  for (const GeometryParameter& g : model.geometry) expect_equal(g.tolerance, numeric(1, 7));
}

TEST(SetTolerance, SetsTheRadiusOfBalls) {
  Model model = example();
  set_tolerance(model, "base", "0.2");
  expect_equal(model.balls[0].radius, numeric(1, 5));
  expect_equal(model.geometry[3].tolerance, numeric(1, 5));  // p1, in the ball
  expect_equal(model.geometry[6].tolerance, numeric(1, 5));  // p2, in a box
  expect_equal(model.geometry[2].tolerance, numeric(1, 20));
}

TEST(SetTolerance, RefusesAnUnknownGroupAndListsTheKnown) {
  Model model = example();
  EXPECT_EQ(refusal([&] { set_tolerance(model, "platform,legs", "0.1"); }),
            "no group 'legs'; this model has: platform, base");
  expect_equal(model.geometry[2].tolerance, numeric(1, 20));
}

TEST(SetTolerance, RefusesANegativeOne) {
  Model model = gough();
  EXPECT_THAT(refusal([&] { set_tolerance(model, "base", "-0.1"); }), HasSubstr("negative number"));
}

}  // namespace
}  // namespace regulus::detail::overrides
