// SPDX-License-Identifier: GPL-3.0-or-later
// [legs] of every kind that has a motor: the matrix of random robots against differences of the
// legs' joints.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "codegen/model/file/model_file.hpp"
#include "tests/support/evaluate.hpp"
#include "tests/support/legs/inverse_kinematics.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

class RandomLegs {
 public:
  RandomLegs(std::uint64_t seed, std::string orientation)
      : random_(seed), orientation_(std::move(orientation)) {
    const std::size_t count = is_planar() ? 3 : is_point() ? 3 : 6 + random_.below(2);
    for (std::size_t i = 0; i < count; ++i) legs_.push_back(leg());
  }

  [[nodiscard]] bool is_planar() const { return orientation_ == "planar"; }
  [[nodiscard]] bool is_point() const { return orientation_ == "point"; }
  [[nodiscard]] const std::vector<PlainLeg>& legs() const { return legs_; }

  [[nodiscard]] std::string text() const {
    std::string text = "regulus = 1\nname = \"legs\"\n[legs]\n";
    if (!is_planar()) text += "orientation = \"" + orientation_ + "\"\n";
    for (const PlainLeg& leg : legs_) {
      static const std::map<DrivenBy, const char*> kPlane = {
          {DrivenBy::kLength, "RPR"}, {DrivenBy::kCrank, "RRR"}, {DrivenBy::kCarriage, "PRR"}};
      static const std::map<DrivenBy, const char*> kSpace = {
          {DrivenBy::kLength, "UPS"}, {DrivenBy::kCrank, "RUS"}, {DrivenBy::kCarriage, "PUS"}};
      text += "[[legs.leg]]\ntype = \"" +
              std::string((is_planar() ? kPlane : kSpace).at(leg.driven)) +
              "\"\nbase = " + list(leg.base) + "\n";
      if (!is_point()) text += "platform = " + list(leg.platform) + "\n";
      if (leg.driven == DrivenBy::kLength) continue;
      text += "rod = " + number(leg.rod) + "\nmode = \"" + (leg.plus ? "+" : "-") + "\"\n";
      if (leg.driven == DrivenBy::kCrank) text += "crank = " + number(leg.crank) + "\n";
      if (!is_planar() || leg.driven == DrivenBy::kCarriage)
        text += "axis = " + list(3.0 * leg.axis) + "\n";
    }
    text += "[motion.here]\nx = 0\ny = 0\n";
    if (!is_planar()) text += "z = 0\n";
    for (const char* name : names()) text += std::string(name) + " = 0.5\n";
    return text;
  }

  /// A pose, and the frame of the platform there.
  Frame draw_pose(Point& pose) {
    Frame frame;
    for (double& x : frame.p) x = random_.between(-0.3, 0.3);
    if (is_planar()) frame.p[2] = 0;
    pose = {{"x", frame.p[0]}, {"y", frame.p[1]}, {"z", frame.p[2]}};
    std::array<double, 4> q{};
    for (double& angle : q) angle = random_.between(-1, 1);
    std::size_t next = 0;
    for (const char* name : names()) pose[name] = q.at(next++);
    frame.R = rotation(q);
    return frame;
  }

 private:
  [[nodiscard]] std::vector<const char*> names() const {
    if (is_planar()) return {"phi"};
    if (is_point()) return {};
    if (orientation_ == "euler-zxz") return {"psi", "theta", "phi"};
    if (orientation_ == "quaternion") return {"q0", "q1", "q2", "q3"};
    return {"roll", "pitch", "yaw"};
  }

  [[nodiscard]] Mat rotation(const std::array<double, 4>& q) const {
    if (is_planar()) return turn_about({0, 0, 1}, q[0]);
    if (is_point()) return Frame{}.R;
    if (orientation_ == "roll-pitch-yaw") return of_rpy({q[0], q[1], q[2]});
    if (orientation_ == "euler-zxz")
      return turn_about({0, 0, 1}, q[0]) *
             (turn_about({1, 0, 0}, q[1]) * turn_about({0, 0, 1}, q[2]));
    const Vec v = {q[1], q[2], q[3]};
    return turn_about(v, 2 * std::atan2(std::sqrt(inner(v, v)), q[0]));
  }

  [[nodiscard]] std::string list(const Vec& v) const {
    return "[" + number(v[0]) + ", " + number(v[1]) + (is_planar() ? "" : ", " + number(v[2])) +
           "]";
  }

  Vec vector(double size) {
    Vec v{};
    for (double& x : v) x = random_.one_in(5) ? 0 : random_.between(-size, size);
    if (is_planar()) v[2] = 0;
    return v;
  }

  PlainLeg leg() {
    PlainLeg leg{.driven = DrivenBy(random_.below(3)), .base = vector(2)};
    if (!is_point()) leg.platform = vector(1);
    leg.crank = random_.between(1, 2);
    leg.rod = random_.between(1, 3);
    leg.plus = random_.one_in(2);
    if (is_planar() && leg.driven == DrivenBy::kCrank) return leg;
    Vec axis = vector(1);
    if (inner(axis, axis) < 0.01) axis = {1, 0, 0};
    leg.axis = (1 / std::sqrt(inner(axis, axis))) * axis;
    return leg;
  }

  RandomSource random_;
  std::string orientation_;
  std::vector<PlainLeg> legs_;
};

/// The rates of motors, by rows, are those of the joints up to their signs. Returns how many rows were
/// compared: of the legs that reach the pose.
int compare(const Model& model, const RandomLegs& robot, Point point, const Frame& frame) {
  const std::vector<std::size_t> columns = robot.is_planar() ? std::vector<std::size_t>{0, 1, 5}
                                           : robot.is_point()
                                               ? std::vector<std::size_t>{0, 1, 2}
                                               : std::vector<std::size_t>{0, 1, 2, 3, 4, 5};
  for (const GeometryParameter& g : model.geometry) point[g.name] = evaluate(g.value, point);
  int compared = 0;
  for (unsigned i = 0; i < robot.legs().size(); ++i) {
    const auto expected = rates_of(robot.legs()[i], frame);
    double most = 0, product = 0;
    for (const double rate : expected) most += std::fabs(rate);
    if (std::isnan(joint_of(robot.legs()[i], frame))) {
      EXPECT_TRUE(std::isnan(evaluate(model.row_scale[i], point))) << "leg " << i + 1;
      continue;
    }
    if (!(most < 50)) continue;  // near the end of its reach
    ++compared;
    std::vector<double> got;
    for (unsigned j = 0; j < columns.size(); ++j) {
      got.push_back(evaluate(model.row_scale[i], point) * evaluate(model.matrix(i, j), point));
      product += got.back() * expected.at(columns[j]);
    }
    for (unsigned j = 0; j < columns.size(); ++j)
      EXPECT_NEAR(product < 0 ? -got[j] : got[j], expected.at(columns[j]), 1e-5 * (1 + most))
          << "leg " << i + 1 << " column " << j + 1;
  }
  return compared;
}

void expect_rates(const std::string& orientation, std::uint64_t first, int robots) {
  int compared = 0;
  for (std::uint64_t seed = first; seed < first + std::uint64_t(robots); ++seed) {
    RandomLegs robot(seed, orientation);
    const Model model = parse_model(robot.text(), "legs.toml");
    for (int k = 0; k < 5; ++k) {
      Point pose;
      const Frame frame = robot.draw_pose(pose);
      compared += compare(model, robot, pose, frame);
    }
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed << '\n' << robot.text();
  }
  EXPECT_GT(compared, 3 * robots);
}

TEST(RandomLegs, HaveTheRatesOfTheirJointsWithEulerAngles) { expect_rates("euler-zxz", 1, 15); }

TEST(RandomLegs, HaveTheRatesOfTheirJointsWithRollPitchYaw) {
  expect_rates("roll-pitch-yaw", 1001, 15);
}

TEST(RandomLegs, HaveTheRatesOfTheirJointsWhereTheyEndInAPoint) {
  expect_rates("point", 2001, 100);
}

TEST(RandomLegs, HaveTheRatesOfTheirJointsInThePlane) { expect_rates("planar", 3001, 100); }

}  // namespace
}  // namespace regulus::detail::test
