// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/model_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "codegen/model/overrides.hpp"
#include "runtime/files/sha256.hpp"
#include "tests/support/evaluate.hpp"
#include "tests/support/example_model.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::Pi;
using test::changed;
using test::kExample;
using test::kExampleGough;

Model example() { return parse_model(kExample, "example"); }

void expect_equal(const ex& a, const ex& b) { EXPECT_TRUE(a.is_equal(b)) << a << " is not " << b; }

TEST(ModelFile, KeepsThePoseInTheOrderOfTheFile) {
  const Model model = parse_model(
      "regulus = 1\nname = \"a\"\n[pose]\nz = \"cm\"\nb = \"1\"\na = \"rad\"\n[matrix]\nrows = "
      "[[1]]\n"
      "[motion.m]\na = 0\nb = 0\nz = 0\n",
      "order");
  ASSERT_EQ(model.pose.size(), 3U);
  EXPECT_EQ(model.pose[0].name + model.pose[0].unit, "zcm");
  EXPECT_EQ(model.pose[1].name + model.pose[1].unit, "b1");
  EXPECT_EQ(model.pose[2].name + model.pose[2].unit, "arad");
}

TEST(ModelFile, ReadsTheHeader) {
  const Model model = example();
  EXPECT_EQ(model.name, "example");
  EXPECT_EQ(model.source, "made up");
  EXPECT_EQ(model.path, "");
  EXPECT_EQ(model.sha256, sha256(kExample));
}

TEST(ModelFile, ReadsEveryFormOfGeometry) {
  const Model model = example();
  std::vector<std::string> names;
  for (const GeometryParameter& g : model.geometry) names.push_back(g.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"a2", "h", "r", "p1_1", "p1_2", "p1_3", "p2_1", "p2_2"}));
  const auto g = [&model](std::size_t i) { return model.geometry[i]; };
  expect_equal(g(0).value, 10);
  expect_equal(g(0).tolerance, 0);
  expect_equal(g(1).value, numeric(1, 3));
  expect_equal(g(1).tolerance, numeric(1, 100));
  EXPECT_EQ(g(1).group, "");
  EXPECT_EQ(g(2).group, "platform");
  expect_equal(g(2).tolerance, numeric(1, 20));
  expect_equal(g(4).value, 7);
  expect_equal(g(6).value, numeric(1, 10));
  expect_equal(g(7).value, numeric(1, 7));
  expect_equal(g(7).tolerance, numeric(1, 100));
  EXPECT_EQ(g(7).ball, -1);
}

TEST(ModelFile, ReadsAPointInABall) {
  const Model model = example();
  ASSERT_EQ(model.balls.size(), 1U);
  EXPECT_EQ(model.balls[0].members, (std::vector<std::size_t>{3, 4, 5}));
  EXPECT_EQ(model.balls[0].group, "base");
  expect_equal(model.balls[0].radius, numeric(1, 20));
  EXPECT_EQ(model.geometry[3].ball, 0);
  expect_equal(model.geometry[3].tolerance, numeric(1, 20));
}

TEST(ModelFile, ExpandsSubExpressionsInAnyOrder) {
  const Model model = example();
  ASSERT_EQ(model.matrix.rows(), 4U);
  ASSERT_EQ(model.matrix.cols(), 3U);
  const ex x = model.pose[0].symbol, y = model.pose[1].symbol, phi = model.pose[2].symbol;
  const ex h = model.geometry[1].symbol, r = model.geometry[2].symbol;
  expect_equal(model.matrix(0, 0), x - h * cos(phi));
  expect_equal(model.matrix(2, 1), y - r);
  expect_equal(model.matrix(2, 2), model.geometry[7].symbol / 2);
  expect_equal(model.matrix(3, 1), numeric(5, 2));
  expect_equal(model.row_scale[0], pow(pow(x - h * cos(phi), 2) + y * y + 1, numeric(-1, 2)));
  expect_equal(model.row_scale[3], numeric(1, 3));
}

TEST(ModelFile, RecordsWhatTheRowScalesNeed) {
  const Model model = example();
  const ex x = model.pose[0].symbol, y = model.pose[1].symbol, a2 = model.geometry[0].symbol;
  ASSERT_EQ(model.must_be_defined.size(), 1U);  // rho_1 ≥ 1 by its form
  expect_equal(model.must_be_defined[0], pow(pow(x - a2, 2) + y * y, numeric(-1, 2)));
}

TEST(ModelFile, RequiresRowScalesToBePositive) {
  const Model model = parse_model(changed(kExample, "2, \"1/3\"]", "\"x - 3\", \"1/3\"]"), "m");
  const ex x = model.pose[0].symbol;
  const ex positive = GiNaC::log(x - 3);
  EXPECT_TRUE(std::ranges::any_of(model.must_be_defined,
                                  [&](const ex& e) { return e.is_equal(positive); }));
}

TEST(ModelFile, NeverLosesAZeroDivisorOfTheMatrix) {
  const Model model = parse_model(
      changed(kExample, "\"x - a2\", \"y\", \"c\"", "\"x - a2\", \"y*x/x\", \"c\""), "m");
  const ex x = model.pose[0].symbol;
  expect_equal(model.matrix(1, 1), model.pose[1].symbol);
  EXPECT_TRUE(
      std::ranges::any_of(model.must_be_defined, [&](const ex& e) { return e.is_equal(1 / x); }));
}

TEST(ModelFile, ReadsABoxOfPoses) {
  const Model model = example();
  ASSERT_EQ(model.motions.size(), 2U);
  const Motion& motion = model.motions[0];
  EXPECT_EQ(motion.name, "small");
  ASSERT_EQ(motion.parameters.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_equal(motion.parameters[i].symbol, model.pose[i].symbol);
    expect_equal(motion.pose[i], model.pose[i].symbol);
    EXPECT_EQ(motion.parameters[i].unit, model.pose[i].unit);
    expect_equal(motion.error[i], 0);
  }
  expect_equal(motion.parameters[2].range.lo, -Pi / 18);
  expect_equal(motion.parameters[2].range.hi, Pi / 18);
  expect_equal(motion.alpha, 0);
}

TEST(ModelFile, ReadsConstraintsOnPoseAndSubExpressions) {
  const Model model = example();
  const Motion& motion = model.motions[0];
  const ex x = model.pose[0].symbol, y = model.pose[1].symbol, a2 = model.geometry[0].symbol;
  ASSERT_EQ(motion.constraints.size(), 2U);
  expect_equal(motion.constraints[0], x * x + y * y - 25);
  expect_equal(motion.constraints[1], pow(pow(x - a2, 2) + y * y, numeric(1, 2)) - 20);
}

TEST(ModelFile, ReadsATrajectoryWithErrors) {
  const Model model = example();
  const Motion& motion = model.motions[1];
  ASSERT_EQ(motion.parameters.size(), 1U);
  const ex T = motion.parameters[0].symbol;
  EXPECT_EQ(motion.parameters[0].name, "T");
  expect_equal(motion.parameters[0].range.hi, 1);
  expect_equal(motion.pose[0], cos(2 * Pi * T));
  expect_equal(motion.pose[1], 5 + sin(2 * Pi * T));
  expect_equal(motion.pose[2], 0);
  expect_equal(motion.error[0], numeric(1, 100));
  expect_equal(motion.error[1], 0);
  expect_equal(motion.error[2], Pi / 1800);
}

TEST(ModelFile, MixesParametersAndRanges) {
  const Model model = parse_model(changed(changed(kExample, "phi = 0\n", "phi = [0, \"pi/2\"]\n"),
                                          "\"cos(2*pi*T)\"", "\"cos(2*pi*T)*cos(phi)\""),
                                  "m");
  const Motion& motion = model.motions[1];
  ASSERT_EQ(motion.parameters.size(), 2U);
  EXPECT_EQ(motion.parameters[1].name, "phi");
  expect_equal(motion.pose[0],
               cos(2 * Pi * motion.parameters[0].symbol) * cos(model.pose[2].symbol));
}

TEST(ModelFile, RecordsWhatTheMotionNeeds) {
  const Model model = parse_model(changed(kExample, "\"5 + sin(2*pi*T)\"", "\"5 + 0/T\""), "m");
  const Motion& motion = model.motions[1];
  expect_equal(motion.pose[1], 5);
  ASSERT_EQ(motion.must_be_defined.size(), 1U);
  expect_equal(motion.must_be_defined[0], 1 / motion.parameters[0].symbol);
}

TEST(ModelFile, TakesAFixedPose) {
  const Model model = parse_model(kExampleGough, "m");
  const Motion& motion = model.motions[0];
  ASSERT_EQ(motion.parameters.size(), 4U);
  expect_equal(motion.pose[3], 0);
  expect_equal(motion.pose[4], model.pose[4].symbol);
}

TEST(ModelFile, TakesWordsOfCppAsNames) {
  const Model model = parse_model(
      "regulus = 1\nname = \"a\"\n[pose]\nint = \"1\"\n[geometry]\ndouble = 2\n[let]\n"
      "class = \"int + double\"\n[matrix]\nrows = [[\"2*class\"]]\n[motion.for]\nint = [0, 1]\n",
      "m");
  EXPECT_EQ(model.pose[0].name, "int");
  expect_equal(model.matrix(0, 0), 2 * (model.pose[0].symbol + model.geometry[0].symbol));
  EXPECT_EQ(model.motions[0].name, "for");
}

TEST(ModelFile, ReadsAGoughPlatform) {
  const Model model = parse_model(kExampleGough, "m");
  EXPECT_EQ(model.name, "six legs");
  ASSERT_EQ(model.geometry.size(), 36U);
  expect_equal(model.geometry[0].value, -9);
  expect_equal(model.geometry[0].tolerance, numeric(1, 20));
  expect_equal(model.geometry[35].tolerance, 0);
  EXPECT_TRUE(model.motions[0].constraints.empty());
}

TEST(ModelFile, PutsNoConstraintOfItsOwnOnAQuaternion) {
  std::string text = changed(kExampleGough, "euler-zxz", "quaternion");
  text = changed(text, "psi = 0\ntheta = [\"-5*deg\", \"5*deg\"]\nphi = 0\n",
                 "q0 = [0.9, 1]\nq1 = [-0.1, 0.1]\nq2 = 0\nq3 = 0\nconstraints = [\"x - 1\"]\n");
  const Model model = parse_model(text, "m");
  ASSERT_EQ(model.motions[0].constraints.size(), 1U);
  expect_equal(model.motions[0].constraints[0], model.pose[0].symbol - 1);
  EXPECT_EQ(model.must_be_defined.size(), 1U);
}

TEST(ModelFile, HashesTheBytesOfTheFile) {
  const auto path = std::filesystem::path(testing::TempDir()) / "regulus_model_file_test.toml";
  std::ofstream(path, std::ios::binary) << kExample;
  const Model model = load_model(path);
  EXPECT_EQ(model.path, path.string());
  EXPECT_EQ(model.sha256, sha256(kExample));
  std::filesystem::remove(path);
}

TEST(ModelFile, TakesWindowsLineEndings) {
  std::string text;
  for (const char c : kExample) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(parse_model(text, "m").motions.size(), 2U);
}

}  // namespace
}  // namespace regulus::detail
