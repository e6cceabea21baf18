// SPDX-License-Identifier: GPL-3.0-or-later
// Random robots in the plane with loops, as MJCF closes them: the matrix against differences of the
// driven joints, which are solved from the points of the file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/import/import.hpp"
#include "tests/support/evaluate.hpp"
#include "tests/support/legs/inverse_kinematics.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {
namespace {

std::string words(const Vec& v) {
  char text[80];
  std::snprintf(text, sizeof text, "%.2f %.2f 0", v[0], v[1]);
  return text;
}

/// A stage on three legs. Its origin is the end of the last leg, and all coordinates are hundredths.
class RandomStage {
 public:
  explicit RandomStage(std::uint64_t seed) : random_(seed) {
    for (int leg = 0; leg < 3; ++leg) draw_leg();
    home_ = {.p = ends_.back()};
    for (std::size_t leg = 0; leg < 3; ++leg) legs_[leg].platform = ends_[leg] + -1.0 * home_.p;
    text_ = "<mujoco model=\"stage\"><worldbody>\n";
    std::string loops;
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const std::string n = std::to_string(leg + 1);
      text_ += bodies_[leg];
      if (leg == 2)
        text_ += "<body name=\"stage\" pos=\"" + words(ends_[2] + -1.0 * elbows_[2]) +
                 "\"><joint name=\"wrist\" axis=\"0 0 1\"/></body>";
      else
        loops += "<connect body1=\"stage\" body2=\"link_" + n + "\" anchor=\"" +
                 words(legs_[leg].platform) + "\"/>\n";
      text_ += "</body></body>\n";
    }
    text_ += "</worldbody><equality>\n" + loops + "</equality></mujoco>\n";
  }

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::vector<PlainLeg>& legs() const { return legs_; }
  [[nodiscard]] const Frame& home() const { return home_; }

 private:
  Vec point(double size) {
    const auto hundredths = [&] { return std::round(100 * random_.between(-size, size)) / 100; };
    return {hundredths(), hundredths(), 0};
  }

  static double length(const Vec& v) { return std::sqrt(inner(v, v)); }

  void draw_leg() {
    const std::string n = std::to_string(legs_.size() + 1);
    Vec A{}, C{}, B{};
    do {
      A = point(2), C = A + point(1), B = C + point(1);
    } while (std::fabs(outer(C + -1.0 * A, B + -1.0 * C)[2]) < 0.05);
    PlainLeg leg{.driven = DrivenBy(random_.below(3)), .base = A};
    const Vec first = C + -1.0 * A, rod = B + -1.0 * C;
    leg.crank = length(first);
    leg.rod = length(rod);
    std::string body = "<body name=\"crank_" + n + "\" pos=\"";
    if (leg.driven == DrivenBy::kCarriage) {
      leg.base = C;
      leg.axis = (1 / length(first)) * first;
      leg.plus = inner(rod, leg.axis) < 0;
      body += words(C) + "\"><joint name=\"motor_" + n + "\" type=\"slide\" axis=\"" +
              words(first) + "\"/><body name=\"link_" + n + "\"><joint name=\"elbow_" + n +
              "\" axis=\"0 0 1\"/>";
    } else if (leg.driven == DrivenBy::kCrank) {
      leg.plus = outer(B + -1.0 * A, first)[2] > 0;
      body += words(A) + "\"><joint name=\"motor_" + n + "\" axis=\"0 0 1\"/><body name=\"link_" +
              n + "\" pos=\"" + words(first) + "\"><joint name=\"elbow_" + n +
              "\" axis=\"0 0 -1\"/>";
    } else {
      B = C + 2.0 * first;
      body += words(A) + "\"><joint name=\"base_" + n + "\" axis=\"0 0 1\"/><body name=\"link_" +
              n + "\" pos=\"" + words(first) + "\"><joint name=\"motor_" + n +
              "\" type=\"slide\" axis=\"" + words(first) + "\"/>";
    }
    legs_.push_back(leg);
    bodies_.push_back(body);
    elbows_.push_back(C);
    ends_.push_back(B);
  }

  RandomSource random_;
  std::vector<PlainLeg> legs_;
  std::vector<std::string> bodies_;
  std::vector<Vec> elbows_, ends_;
  Frame home_;
  std::string text_;
};

double value_of(const Motion& motion, const Model& model, const std::string& name) {
  for (std::size_t j = 0; j < model.pose.size(); ++j)
    if (model.pose[j].name == name) return evaluate(motion.pose[j], {});
  return kUndefined;
}

std::vector<Vec> rows_at(const Model& model, Point point) {
  for (const GeometryParameter& g : model.geometry) point[g.name] = evaluate(g.value, point);
  std::vector<Vec> rows;
  for (unsigned i = 0; i < model.matrix.rows(); ++i) {
    Vec row{};
    for (unsigned j = 0; j < 3; ++j)
      row.at(j) = evaluate(model.row_scale[i], point) * evaluate(model.matrix(i, j), point);
    rows.push_back(row);
  }
  return rows;
}

/// One of the rows has these rates, up to their sign: legs need not have the order of the file.
bool has_row(const std::vector<Vec>& rows, const Vec& rates) {
  const double size = std::sqrt(inner(rates, rates));
  return std::ranges::any_of(rows, [&](const Vec& row) {
    const Vec difference = (inner(row, rates) < 0 ? -1.0 : 1.0) * row + -1.0 * rates;
    return std::sqrt(inner(difference, difference)) < 1e-5 * (1 + size);
  });
}

TEST(RandomLoops, HaveTheRatesOfTheirMotors) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const RandomStage stage(seed);
    const Imported imported = import_robot(stage.text(), "stage.xml", {});
    const Model model = parse_model(imported.model, "stage.toml");
    ASSERT_EQ(model.matrix.rows(), 3U) << stage.text();
    const auto home = std::ranges::find(model.motions, "home", &Motion::name);
    ASSERT_NE(home, model.motions.end()) << imported.model;
    RandomSource random(seed);
    for (int pose = 0; pose < 5; ++pose) {
      const Vec d = {random.between(-0.05, 0.05), random.between(-0.05, 0.05), 0};
      const double turn = random.between(-0.1, 0.1);
      const Point point = {{"x", value_of(*home, model, "x") + d[0]},
                           {"y", value_of(*home, model, "y") + d[1]},
                           {"phi", turn}};
      const Frame frame = {turn_about({0, 0, 1}, turn), stage.home().p + d};
      const std::vector<Vec> rows = rows_at(model, point);
      for (const PlainLeg& leg : stage.legs()) {
        const auto rates = rates_of(leg, frame);
        const Vec planar = {rates[0], rates[1], rates[5]};
        if (!(inner(planar, planar) < 2500)) continue;  // out of reach, or near it
        ++compared;
        EXPECT_TRUE(has_row(rows, planar))
            << planar[0] << ' ' << planar[1] << ' ' << planar[2] << " seed " << seed << '\n'
            << stage.text() << imported.model;
      }
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(compared, 700);
}

}  // namespace
}  // namespace regulus::detail::test
