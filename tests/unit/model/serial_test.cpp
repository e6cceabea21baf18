// SPDX-License-Identifier: GPL-3.0-or-later
// [serial]: the Jacobian against differences of an independent forward kinematics.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <string>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/mechanism/joint_polynomial.hpp"
#include "codegen/model/mechanism/singular_factors.hpp"
#include "tests/support/serial/model_twists.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::serial {
namespace {

constexpr double kPi = std::numbers::pi;

Model parsed(const std::string& serial, const std::string& motions) {
  return parse_model("regulus = 1\nname = \"arm\"\n[serial]\n" + serial + motions, "arm.toml");
}

Model parsed(const std::string& serial, int joints) {
  std::string motion = "\n[motion.zero]\n";
  for (int j = 1; j <= joints; ++j) motion += "q" + std::to_string(j) + " = 0\n";
  return parsed(serial, motion);
}

std::vector<double> random_pose(std::mt19937& random, std::size_t joints) {
  std::uniform_real_distribution<double> between(-kPi, kPi);
  std::vector<double> q(joints);
  for (double& x : q) x = between(random);
  return q;
}

void expect_twists(const Model& model, const std::vector<ChainJoint>& chain, int poses = 100) {
  std::mt19937 random(7);
  for (int pose = 0; pose < poses; ++pose) {
    const auto q = random_pose(random, model.pose.size());
    expect_same_arm(model_twists(model, q), difference_twists(chain, q));
  }
}

/// A row of Denavit and Hartenberg.
struct DhRow {
  double a, alpha, d, theta;  // alpha in quarter turns
};
constexpr DhRow kArm[] = {{0, 1, 0.09, 0},    {-0.4, 0, 0, 0.3}, {-0.35, 0, 0.02, 0},
                          {0.01, 1, 0.11, 0}, {0, -1, 0.1, 0},   {0, 0, 0.08, 0}};

std::string row_text(const DhRow& row, int number) {
  return "  { name = \"q" + std::to_string(number) + "\", a = " + std::to_string(row.a) +
         ", alpha = \"" + std::to_string(int(row.alpha)) + "*pi/2\", d = " + std::to_string(row.d) +
         ", theta = " + std::to_string(row.theta) + " },\n";
}

std::string dh_text(const std::string& convention) {
  std::string text = "convention = \"" + convention + "\"\njoints = [\n";
  int number = 0;
  for (const DhRow& row : kArm) text += row_text(row, ++number);
  return text + "]\n";
}

Frame across(const DhRow& row) {
  return Frame{.p = {row.a, 0, 0}} * Frame{.R = turn_about({1, 0, 0}, row.alpha * kPi / 2)};
}
Frame along(const DhRow& row) {
  return Frame{.R = turn_about({0, 0, 1}, row.theta)} * Frame{.p = {0, 0, row.d}};
}

TEST(Serial, HasTheTwistsOfStandardDhRows) {
  std::vector<ChainJoint> chain;
  for (const DhRow& row : kArm) {
    chain.push_back({along(row)});
    chain.push_back({.origin = across(row), .moves = false});
  }
  expect_twists(parsed(dh_text("standard-dh"), 6), chain);
}

TEST(Serial, HasTheTwistsOfModifiedDhRows) {
  std::vector<ChainJoint> chain;
  for (const DhRow& row : kArm) chain.push_back({across(row) * along(row)});
  expect_twists(parsed(dh_text("modified-dh"), 6), chain);
}

/// Random chains: origins by rpy, some of them multiples of pi/12, axes of any direction and length.
class RandomArm {
 public:
  explicit RandomArm(unsigned seed, int joints) : random_(seed) {
    for (int j = 1; j <= joints; ++j) add_joint("q" + std::to_string(j));
    text_ = "unit = \"m\"\njoints = [\n" + text_ + "]\n";
  }

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::vector<ChainJoint>& chain() const { return chain_; }

 private:
  int integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random_); }

  std::string angle(double& value) {
    const int k = integer(-12, 12);
    if (integer(0, 9) == 0) {
      value = k / 10.0;
      return std::to_string(k) + "e-1";
    }
    value = k * kPi / 12;
    return "\"" + std::to_string(k) + "*pi/12\"";
  }

  Frame frame(std::string& text) {
    Frame result;
    Vec rpy{};
    text += "xyz = [";
    for (double& x : result.p) {
      const int tenths = integer(-5, 5);
      x = tenths / 10.0;
      text += std::to_string(tenths) + "e-1, ";
    }
    text += "], rpy = [";
    for (double& x : rpy) text += (integer(0, 1) == 0 ? angle(x) : (x = 0, "0")) + ", ";
    text += "]";
    result.R = of_rpy(rpy);
    return result;
  }

  void add_joint(const std::string& name) {
    if (integer(0, 3) == 0) {
      text_ += "  { type = \"fixed\", ";
      chain_.push_back({.origin = frame(text_), .moves = false});
      text_ += " },\n";
    }
    const bool slides = integer(0, 3) == 0;
    text_ += "  { name = \"" + name + "\", " + (slides ? "type = \"prismatic\", " : "");
    ChainJoint joint{.origin = frame(text_), .axis = {}, .slides = slides};
    do
      for (double& x : joint.axis) x = integer(0, 2) == 0 ? integer(-2, 2) : 0;
    while (inner(joint.axis, joint.axis) == 0);
    text_ += ", axis = [";
    for (const double x : joint.axis) text_ += std::to_string(int(x)) + ", ";
    text_ += "] },\n";
    chain_.push_back(joint);
  }

  std::mt19937 random_;
  std::string text_;
  std::vector<ChainJoint> chain_;
};

TEST(Serial, HasTheTwistsOfRandomChains) {
  int compared = 0;
  for (unsigned seed = 1; seed <= unsigned(trials(12, 25)); ++seed) {
    const int joints = 2 + static_cast<int>(seed % 6);
    const RandomArm arm(seed, joints);
    const Model model = parsed(arm.text(), joints);
    // Rows that depend on others without being zero leave no invariants to compare.
    if (kept_rows(model).size() < 6) continue;
    ++compared;
    expect_twists(model, arm.chain(), 10);
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed << '\n' << arm.text();
  }
  EXPECT_GE(compared, trials(5, 12));
}

bool has(const GiNaC::matrix& matrix, const GiNaC::ex& part) {
  for (unsigned i = 0; i < matrix.rows(); ++i)
    for (unsigned j = 0; j < matrix.cols(); ++j)
      if (matrix(i, j).has(part)) return true;
  return false;
}

TEST(Serial, AddsTheAnglesOfParallelAxes) {
  for (const int direction : {1, -1}) {
    const Model model = parsed(
        "joints = [{ name = \"q1\" }, { name = \"q2\", axis = [0, 1, 0], xyz = [1, 0, 0] }, { "
        "name = \"q3\", axis = [0, " +
            std::to_string(direction) +
            ", 0], xyz = [1, 0, 0] }, { name = \"q4\", axis = [1, 0, 0], xyz = [1, 0, 0] }, { name "
            "= \"q5\", axis = [0, 1, 0] }, { name = \"q6\", axis = [1, 0, 0] }]\n",
        6);
    const GiNaC::ex q2 = model.pose[1].symbol, q3 = model.pose[2].symbol;
    EXPECT_TRUE(has(model.matrix, GiNaC::cos(q2 + direction * q3)));
    EXPECT_FALSE(has(model.matrix, GiNaC::cos(q2) * GiNaC::cos(q3)));
  }
}

TEST(Serial, KeepsThreeRowsOfAPlanarArm) {
  const Model model = parsed(
      "joints = [{ name = \"q1\", axis = [0, 1, 0] }, { name = \"q2\", axis = [0, 1, 0], xyz = [0, "
      "0, 1] }, { name = \"q3\", axis = [0, -1, 0], xyz = [0, 0, 1] }]\n",
      3);
  EXPECT_EQ(kept_rows(model), (std::vector<std::size_t>{0, 2, 4}));
  EXPECT_EQ(model.matrix_kind, MatrixKind::kForward);
  EXPECT_THAT(model.matrix_notes[1], testing::HasSubstr("planar"));
}

TEST(Serial, FindsAPlanarArmInAnyDirection) {
  const Model model = parsed(
      "joints = [{ name = \"q1\", axis = [1, 1, 1], rpy = [0, \"pi/12\", \"pi/4\"] }, { name = "
      "\"q2\", "
      "axis = [1, 1, 1], xyz = [1, -1, 0] }, { name = \"q3\", axis = [-2, -2, -2], xyz = [1, 0, 2] "
      "}, { name = \"q4\", axis = [1, 1, 1], xyz = [0.3, 0, 0] }]\n",
      4);
  EXPECT_EQ(kept_rows(model).size(), 3U);
  EXPECT_EQ(model.matrix.rows(), 4U);
  EXPECT_EQ(model.matrix.cols(), 3U);
  EXPECT_EQ(model.matrix_kind, MatrixKind::kForwardTransposed);
}

TEST(Serial, KeepsThreeRowsOfASphericalArm) {
  const Model model = parsed(
      "joints = [{ name = \"q1\", xyz = [1, 2, 3] }, { name = \"q2\", axis = [1, 0, 0] }, { name = "
      "\"q3\", axis = [1, 2, 0] }]\n",
      3);
  EXPECT_EQ(kept_rows(model), (std::vector<std::size_t>{3, 4, 5}));
}

TEST(Serial, LeavesOutTheFirstAndTheLastJoint) {
  const RandomArm arm(3, 6);
  const Model model = parsed(arm.text(), 6);
  for (unsigned i = 0; i < model.matrix.rows(); ++i)
    for (unsigned j = 0; j < model.matrix.cols(); ++j) {
      EXPECT_FALSE(model.matrix(i, j).has(model.pose.front().symbol));
      EXPECT_FALSE(model.matrix(i, j).has(model.pose.back().symbol));
    }
  EXPECT_THAT(model.matrix_notes.back(),
              testing::AllOf(testing::HasSubstr("rank does not depend"), testing::HasSubstr("q1"),
                             testing::HasSubstr("q6")));
}

TEST(Serial, HasExactZerosAndOnesForAxesAlongCoordinates) {
  const Model model = parsed(dh_text("standard-dh"), 6);
  unsigned numbers = 0;
  for (unsigned i = 0; i < 6; ++i)
    for (unsigned j = 0; j < 6; ++j)
      numbers += model.matrix(i, j).is_zero() || model.matrix(i, j).is_equal(1) ||
                 model.matrix(i, j).is_equal(-1);
  EXPECT_GE(numbers, 12U);
}

TEST(Serial, MakesUncertainQuantitiesOfTolerances) {
  const Model model = parsed(
      "length_tolerance = 0.001\nangle_tolerance = \"0.1*deg\"\nconvention = "
      "\"standard-dh\"\njoints = "
      "[{ name = \"q1\", a = 1, alpha = 0 }, { name = \"q2\", a = 1, d = 0 }]\n",
      2);
  std::vector<std::string> names, groups;
  for (const GeometryParameter& g : model.geometry) {
    names.push_back(g.name);
    groups.push_back(g.group);
  }
  EXPECT_THAT(names, testing::ElementsAre("a_1", "alpha_1", "a_2", "d_2"));
  EXPECT_THAT(groups, testing::ElementsAre("lengths", "angles", "lengths", "lengths"));
  EXPECT_GT(kept_rows(model).size(), 3U) << "the axes need not be parallel";
}

TEST(Serial, UsesTheNamesOfTheGeometry) {
  const Model model = parse_model(
      "regulus = 1\nname = \"arm\"\n[geometry]\nl = { value = 0.5, tolerance = 0.01, group = "
      "\"links\" "
      "}\n[let]\nhalf = \"l/2\"\n[serial]\nconvention = \"standard-dh\"\njoints = [{ name = "
      "\"q1\", a "
      "= \"l\" }, { name = \"q2\", a = \"half\" }]\n[motion.zero]\nq1 = 0\nq2 = 0\n",
      "arm.toml");
  ASSERT_EQ(model.geometry.size(), 1U);
  bool occurs = false;
  for (unsigned i = 0; i < model.matrix.rows(); ++i)
    for (unsigned j = 0; j < model.matrix.cols(); ++j)
      occurs = occurs || model.matrix(i, j).has(model.geometry[0].symbol);
  EXPECT_TRUE(occurs);
}

/// Joint 3 turns by −2·q1 + 0.4: at every pose its column adds to that of q1.
TEST(Serial, AddsTheColumnsOfJointsThatFollow) {
  const Model model = parsed(
      "joints = [{ name = \"q1\" }, { name = \"q2\", xyz = [0.3, 0.1, 0], axis = [0, 1, 0] },\n"
      "{ mimic = \"q1\", multiplier = -2, offset = 0.4, xyz = [0, 0.2, 0.1], axis = [1, 0, 0] },\n"
      "{ name = \"q3\", xyz = [0.2, 0, 0.3], axis = [0, 1, 1] }]\n",
      3);
  const std::vector<ChainJoint> chain = {{.axis = {0, 0, 1}},
                                         {.origin = {.p = {0.3, 0.1, 0}}, .axis = {0, 1, 0}},
                                         {.origin = {.p = {0, 0.2, 0.1}}, .axis = {1, 0, 0}},
                                         {.origin = {.p = {0.2, 0, 0.3}}, .axis = {0, 1, 1}}};
  ASSERT_EQ(model.pose.size(), 3U);
  EXPECT_THAT(model.matrix_notes.at(1), testing::HasSubstr("1 more joint follows these"));
  std::mt19937 random(13);
  for (int pose = 0; pose < 20; ++pose) {
    const auto q = random_pose(random, 3);
    const auto all = difference_twists(chain, {q[0], q[1], -2 * q[0] + 0.4, q[2]});
    std::vector<Twist> twists = {all[0], all[1], all[3]};
    for (std::size_t i = 0; i < 3; ++i) {
      twists[0].velocity[i] -= 2 * all[2].velocity[i];
      twists[0].spin[i] -= 2 * all[2].spin[i];
    }
    expect_same_arm(model_twists(model, q), twists);
  }
}

/// sin(q2)·cos(q3), which is (sin(q2 + q3) + sin(q2 - q3))/2, with values whose sum or difference is 0.
TEST(JointPolynomials, HaveNoSineOfAnglesThatAddToZero) {
  const JointGroups parallel{{0, 0}, 1, std::make_shared<TermBudget>()};
  const JointPolynomial product = JointPolynomial(parallel, 1).times_sine(0).times_cosine(1);
  const GiNaC::realsymbol q("q");
  for (const int multiplier : {-1, 0, 1}) {
    const GiNaC::ex got = product.expression({q, multiplier * q});
    EXPECT_NEAR(evaluate(got, {{"q", 0.3}}), std::sin(0.3) * std::cos(multiplier * 0.3), 1e-15)
        << multiplier;
  }
}

TEST(Serial, HasASlidingJointThatStandsStill) {
  const Model model = parsed(
      "joints = [{ name = \"q1\" }, { mimic = \"q1\", multiplier = 0, type = \"prismatic\", axis = "
      "[1, 0, 0] }, { name = \"q2\", xyz = [0.3, 0, 0], axis = [0, 1, 0] }]\n",
      2);
  const std::vector<ChainJoint> chain = {{.axis = {0, 0, 1}},
                                         {.origin = {.p = {0.3, 0, 0}}, .axis = {0, 1, 0}}};
  expect_same_arm(model_twists(model, {0.3, 0.4}), difference_twists(chain, {0.3, 0.4}));
}

/// A parallelogram keeps the direction of the wrist: its joint turns back what q2 and q3 turn.
TEST(Serial, HasTheTwistsOfAParallelogram) {
  const std::string elbow = ", xyz = [0, 0, 0.9], axis = [0, 1, 0] },\n";
  const std::string wrist = "xyz = [1.1, 0, 0], axis = [0, 1, 0] },\n";
  const Model model = parsed(
      "joints = [{ name = \"q1\" }, { name = \"q2\", xyz = [0.3, 0, 0.7], axis = [0, 1, 0] },\n"
      "{ name = \"q3\"" +
          elbow + "{ mimic = \"q2\", multiplier = -1, " + wrist +
          "{ mimic = \"q3\", multiplier = -1, axis = [0, 1, 0] }, { name = \"q4\", xyz = [0.2, 0, "
          "0] }]\n",
      4);
  const std::vector<ChainJoint> chain = {{.axis = {0, 0, 1}},
                                         {.origin = {.p = {0.3, 0, 0.7}}, .axis = {0, 1, 0}},
                                         {.origin = {.p = {0, 0, 0.9}}, .axis = {0, 1, 0}},
                                         {.origin = {.p = {1.1, 0, 0}}, .axis = {0, 1, 0}},
                                         {.axis = {0, 1, 0}},
                                         {.origin = {.p = {0.2, 0, 0}}, .axis = {0, 0, 1}}};
  const auto frame = [&chain](const std::vector<double>& q) {
    return tool_frame(chain, {q[0], q[1], q[2], -q[1], -q[2], q[3]});
  };
  std::mt19937 random(17);
  for (int pose = 0; pose < 20; ++pose) {
    const auto q = random_pose(random, 4);
    expect_same_arm(model_twists(model, q), difference_twists(frame, q));
  }
}

TEST(Serial, MakesAMotionOfTheRanges) {
  const Model model = parsed(
      "joints = [{ name = \"q1\", range = [-1, 1] }, { name = \"q2\", type = \"prismatic\", range "
      "= [0, "
      "\"1/3\"] }]\n",
      "");
  ASSERT_EQ(model.motions.size(), 1U);
  EXPECT_EQ(model.motions[0].name, "limits");
  EXPECT_TRUE(model.motions[0].parameters[1].range.hi.is_equal(GiNaC::numeric(1, 3)));
}

std::vector<std::string> factor_texts(const Model& model) {
  std::vector<std::string> texts;
  for (const SingularFactor& factor : singular_factors(model))
    texts.push_back(factor.name + ": " + factor.text);
  return texts;
}

TEST(SingularFactors, NameWristElbowAndShoulder) {
  const Model puma = parsed(
      "convention = \"modified-dh\"\njoints = [{ name = \"q1\" }, { name = \"q2\", alpha = "
      "\"-pi/2\", d "
      "= 0.2435 }, { name = \"q3\", a = 0.4318, d = -0.0934 }, { name = \"q4\", a = -0.0203, alpha "
      "= "
      "\"pi/2\", d = 0.4331 }, { name = \"q5\", alpha = \"-pi/2\" }, { name = \"q6\", alpha = "
      "\"pi/2\" }]\n",
      6);
  EXPECT_THAT(factor_texts(puma),
              testing::UnorderedElementsAre(
                  "wrist: sin(q5)", "elbow: 203*sin(q3) + 4331*cos(q3)",
                  "shoulder: -203*cos(q2 + q3) + 4318*cos(q2) + 4331*sin(q2 + q3)"));
}

TEST(SingularFactors, NameTheElbowOfAScara) {
  const std::string joints =
      "joints = [{ name = \"q1\", a = 0.3 }, { name = \"q2\", a = 0.2, alpha = \"180*deg\" }, "
      "{ name = \"q3\", type = \"prismatic\" }, { name = \"q4\" }]\n";
  for (const char* unit : {"rad", "deg"}) {
    const std::string angles = std::string("angle_unit = \"") + unit + "\"\n";
    const Model scara = parsed("convention = \"standard-dh\"\n" + angles + joints, 4);
    EXPECT_THAT(factor_texts(scara), testing::ElementsAre("elbow: sin(q2)")) << unit;
  }
}

}  // namespace
}  // namespace regulus::detail::test::serial
