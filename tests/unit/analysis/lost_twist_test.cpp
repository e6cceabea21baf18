// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the motion that is lost at a singular pose, for robots where geometry gives it.
#include "codegen/question/analysis/lost_twist.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/report.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

using nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;

/// A planar platform on three legs, like models/planar_3rpr.toml with simpler numbers; B1 does not
/// move.
constexpr const char* kPlanar = R"toml(regulus = 1
name = "three legs"
[pose]
x = "m"
y = "m"
phi = "rad"
[geometry]
h = { value = 1, tolerance = 0, group = "h" }
[let]
c = "cos(phi)"
s = "sin(phi)"
[matrix]
rows = [["x - 1", "y - 2", "0"], ["x + c - 3", "y + s", "c*y - s*(x - 3)"], ["x + c/2 - s*h", "y + s/2 + c*h - 4", "0.5*(c*(y - 4) - s*x) - h*(s*(y - 4) + c*x)"]]
row_scale = ["1/sqrt((x - 1)^2 + (y - 2)^2)", "1/sqrt((x + c - 3)^2 + (y + s)^2)", "1/sqrt((x + c/2 - s*h)^2 + (y + s/2 + c*h - 4)^2)"]
[motion.turn]
x = 2
y = 1
phi = [-3, 3]
)toml";

/// det = (x − a)·(x − a)²: two rows vanish together at x = a.
constexpr const char* kTwoAtOnce = R"toml(regulus = 1
name = "two at once"
[pose]
x = "m"
y = "m"
[geometry]
a = { value = "1/3", tolerance = 0.1, group = "a" }
[matrix]
rows = [["x - a", "0", "0"], ["0", "(x - a)^2", "0"], ["0", "y", "1"]]
[motion.box]
x = [0, 1]
y = [1, 2]
[motion.pose]
x = 0.375
y = 1
)toml";

struct Checked {
  PreparedSearch preparation;
  Result result;
  ordered_json witness;
  std::string text;
};

Checked checked_file(const std::string& path, const std::string& motion,
                     const std::vector<std::string>& options = {}) {
  ModelOptions model;
  model.path = path;
  model.motion = motion;
  model.tolerances = options;
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  Checked checked{prepare(model, search), {}, {}, {}};
  checked.result = run_search(checked.preparation, search, settings_from(search));
  checked.witness = json_report(checked.preparation, search, checked.result)["witness"];
  checked.text = text_report(checked.preparation, search, checked.result);
  return checked;
}

Checked checked_text(const std::string& text, const std::string& motion,
                     const std::vector<std::string>& options = {}) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() / "model.toml";
  std::ofstream(path) << text;
  return checked_file(path, motion, options);
}

std::string model(const std::string& name) {
  return REGULUS_SOURCE_DIR "/models/" + name + ".toml";
}

double norm(std::span<const double> v) {
  double squares = 0;
  for (const double x : v) squares += x * x;
  return std::sqrt(squares);
}

/// Checks the residuals of the reported vectors in J⁻¹ at the point, relative to |J⁻¹|·|v|.
void expect_null_vectors(const Checked& checked) {
  ASSERT_TRUE(checked.result.witness && checked.result.witness->near);
  const auto J =
      InverseJacobian(checked.preparation).approx_at(checked.result.witness->near->variables);
  ASSERT_TRUE(J);
  const std::size_t n = std::size_t(checked.preparation.labels.columns);
  for (const std::vector<double> v : checked.witness["twist"]["vectors"]) {
    std::vector<double> image(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) image[i] += (*J)[i * n + j] * v[j];
    EXPECT_LE(norm(image), 1e-10 * norm(*J) * norm(v));
  }
  for (const std::vector<double> w : checked.witness["rows"]["vectors"]) {
    std::vector<double> image(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) image[j] += w[i] * (*J)[i * n + j];
    EXPECT_LE(norm(image), 1e-10 * norm(*J) * norm(w));
  }
}

double middle(const ordered_json& interval) {
  return (interval[0].get<double>() + interval[1].get<double>()) / 2;
}

/// Returns the point where the lines through the legs 1 and 2 of kPlanar meet, for an angle.
std::pair<double, double> meeting_point(double phi) {
  const double x = 2, y = 1;  // B1; A1 = (1, 2), A2 = (3, 0)
  const double u1 = x - 1, v1 = y - 2;
  const double u2 = x + std::cos(phi) - 3, v2 = y + std::sin(phi);
  const double t = (u2 * (0 - 2) - v2 * (3 - 1)) / (u2 * v1 - v2 * u1);
  return {1 + t * u1, 2 + t * v1};
}

TEST(LostTwist, OfConcurrentLegsIsTheRotationAboutTheirCommonPoint) {
  const Checked checked = checked_text(kPlanar, "turn");
  ASSERT_EQ(checked.result.verdict, Verdict::kSingularity) << checked.text;
  expect_null_vectors(checked);
  EXPECT_EQ(checked.witness["nullity"], 1);
  const std::vector<double> v = checked.witness["twist"]["vectors"][0];
  const auto [x, y] = meeting_point(middle(checked.witness["near"]["pose"]["phi"]));
  // The velocity of B1 = (2, 1) if the platform turns about (x, y) at rate v[2].
  ASSERT_NE(v[2], 0);
  EXPECT_NEAR(v[0] / v[2], -(1 - y), 1e-9);
  EXPECT_NEAR(v[1] / v[2], 2 - x, 1e-9);
}

TEST(LostTwist, OfAPlatformHasAngularVelocityOne) {
  const Checked checked = checked_file(model("robot_1"), "wide_40");
  ASSERT_EQ(checked.result.verdict, Verdict::kSingularity);
  expect_null_vectors(checked);
  const std::vector<double> v = checked.witness["twist"]["vectors"][0];
  EXPECT_NEAR(norm(std::span(v).subspan(3)), 1, 1e-12);
  EXPECT_EQ(checked.witness["twist"]["columns"][2]["name"], "v_z");
  EXPECT_EQ(checked.witness["twist"]["columns"][2]["unit"], "cm");
  EXPECT_EQ(checked.witness["twist"]["columns"][5]["unit"], "rad");
  EXPECT_THAT(checked.text, HasSubstr("twist      lost, approximately: velocity ("));
}

/// The report encloses det at the point where it nearly vanishes; it changes sign near there.
TEST(LostTwist, IsReportedWhereTheDeterminantIsNearlyZero) {
  const Checked checked = checked_file(model("robot_1"), "wide_40");
  const Interval at_near = checked.result.witness->near->determinant;
  for (const WitnessPoint& point : checked.result.witness->points)
    EXPECT_LE(mag(at_near), mag(point.determinant));
  EXPECT_LE(mag(at_near), 1e-3);  // cm⁹; wide_15 has 10⁵ and more
  const ordered_json near = checked.witness["near"];
  for (const auto& [name, range] : checked.witness["vanishes_within"]["parameters"].items()) {
    EXPECT_LE(range[0], near["parameters"][name][0]);
    EXPECT_GE(range[1], near["parameters"][name][1]);
    EXPECT_LE(range[1].get<double>() - range[0].get<double>(), 1e-12) << name;
  }
}

TEST(LostTwist, OfNullityTwoIsASpace) {
  const Checked checked = checked_text(kTwoAtOnce, "box", {"a=0"});
  ASSERT_EQ(checked.result.verdict, Verdict::kSingularity);
  EXPECT_EQ(checked.witness["nullity"], 2);
  expect_null_vectors(checked);
  ASSERT_EQ(checked.witness["twist"]["vectors"].size(), 2U);
  ASSERT_EQ(checked.witness["rows"]["vectors"].size(), 2U);
  EXPECT_THAT(checked.text, HasSubstr("a space of dimension 2, spanned by ("));
}

TEST(DependentRows, AreThoseThatTakePart) {
  const Checked checked = checked_text(kTwoAtOnce, "box", {"a=0"});
  EXPECT_THAT(checked.witness["rows"]["taking_part"], ElementsAre(1, 2));
  const Checked all = checked_file(model("robot_1"), "wide_40");
  EXPECT_EQ(all.witness["rows"]["taking_part"].size(), 6U);
  double largest = 0;
  for (const double weight : all.witness["rows"]["vectors"][0])
    largest = std::max(largest, std::fabs(weight));
  EXPECT_EQ(largest, 1);
}

TEST(Witness, BetweenUncertainValuesNamesAConcreteGeometry) {
  const Checked checked = checked_text(kTwoAtOnce, "pose");
  ASSERT_EQ(checked.result.verdict, Verdict::kSingularity);
  EXPECT_TRUE(checked.witness["near"]["parameters"].empty());
  EXPECT_NEAR(middle(checked.witness["near"]["uncertain"]["a"]), 0.375, 1e-15);
  const ordered_json& a = checked.witness["vanishes_within"]["uncertain"]["a"];
  EXPECT_LE(a[0], 0.375);
  EXPECT_GE(a[1], 0.375);
  EXPECT_LE(a[1].get<double>() - a[0].get<double>(), 1e-15);
  EXPECT_THAT(checked.text, HasSubstr("           with a = 0.375\n"));
}

TEST(Witness, OfASmallDeterminantLosesNothing) {
  const Checked checked = checked_text(
      std::string(kTwoAtOnce) + "[motion.far]\nx = [2, 3]\ny = 1\nalpha = 1000\n", "far");
  ASSERT_EQ(checked.result.reason, Reason::kSmallDeterminant);
  EXPECT_EQ(checked.witness["points"].size(), 1U);
  EXPECT_EQ(checked.witness["nullity"], 0);
  EXPECT_TRUE(checked.witness["twist"].is_null());
  EXPECT_TRUE(checked.witness["rows"].is_null());
  EXPECT_FALSE(checked.witness.contains("vanishes_within"));
  EXPECT_THAT(checked.text, HasSubstr("twist      no twist is lost there"));
}

}  // namespace
}  // namespace regulus::detail
