// SPDX-License-Identifier: GPL-3.0-or-later
// Singular values of robots with more cables than freedoms, against a decomposition of matrices of the
// test's own at random poses.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <fstream>
#include <random>

#include "codegen/model/file/model_file.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/verifier/verify.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test::cables {
namespace {

constexpr int kSamples = 400;
using Pose = std::array<double, 3>;

/// Cables from a hall to a box that does not turn, whose anchors are random.
class Cables {
 public:
  Cables(int count, unsigned seed) : random_(seed) {
    for (int i = 0; i < count; ++i) {
      const double side = i % 2 == 0 ? 1 : -1, other = i % 4 < 2 ? 1 : -1;
      base_.push_back({rounded(5 * side + between(-1, 1)), rounded(4 * other + between(-1, 1)),
                       rounded(i % 3 == 0 ? 0.5 : 8)});
      platform_.push_back(
          {rounded(between(-1, 1)), rounded(between(-1, 1)), rounded(between(-1, 1))});
    }
  }

  [[nodiscard]] std::string text(double half) const {
    std::string legs;
    const auto point = [](const Pose& p) { return fmt::format("[{}, {}, {}]", p[0], p[1], p[2]); };
    for (std::size_t i = 0; i < base_.size(); ++i)
      legs += fmt::format("  {{ type = \"UPS\", base = {}, platform = {} }},\n", point(base_[i]),
                          point(platform_[i]));
    const auto range = [half](double middle) {
      return half == 0 ? fmt::format("{}", middle)
                       : fmt::format("[{}, {}]", middle - half, middle + half);
    };
    return fmt::format(
        "regulus = 1\nname = \"cables\"\ncharacteristic_length = 2\n[legs]\nunit = \"m\"\n"
        "orientation = \"fixed\"\nleg = [\n{}]\n[motion.m]\nx = {}\ny = {}\nz = {}\n",
        legs, range(0.5), range(0.25), range(4));
  }

  /// The least and the largest singular value, where an angle of 1 rad counts as 2 m.
  [[nodiscard]] std::array<double, 2> values_at(const Pose& pose) const {
    Eigen::MatrixXd J(base_.size(), 6);
    for (std::size_t i = 0; i < base_.size(); ++i) {
      const Eigen::Vector3d b(platform_[i].data());
      const Eigen::Vector3d way =
          Eigen::Vector3d(pose.data()) + b - Eigen::Vector3d(base_[i].data());
      const Eigen::Vector3d u = way.normalized();
      J.row(Eigen::Index(i)) << u.transpose(), b.cross(u).transpose() / 2;
    }
    const Eigen::VectorXd s = J.jacobiSvd().singularValues();
    return {s(5), s(0)};
  }

  [[nodiscard]] std::array<double, 2> extreme_values(double half) {
    std::array<double, 2> result{HUGE_VAL, 0};
    for (int k = 0; k < kSamples; ++k) {
      Pose pose{0.5, 0.25, 4};
      for (double& x : pose) x += between(-half, half);
      const auto [least, largest] = values_at(pose);
      result = {std::min(result[0], least), std::max(result[1], largest)};
    }
    return result;
  }

 private:
  double between(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random_);
  }
  static double rounded(double x) { return std::round(1000 * x) / 1000; }

  std::mt19937 random_;
  std::vector<Pose> base_, platform_;
};

Bound bound_of(const std::string& text, const char* quantity, const std::string& proofs = "") {
  ModelOptions of_motion;
  of_motion.motion = "m";
  const Request request = read_request(text, of_motion);
  BoundSettings settings;
  settings.gap = 0.02;
  settings.search.threads = 1;
  settings.output.quiet = true;
  settings.certificate = proofs;
  return bound_quantity(request, quantity_of(request.model, {.quantity = quantity}), settings,
                        [](const ComponentBound&) {});
}

void expect_bracket(const Bound& bound, double seen, bool is_least) {
  ASSERT_TRUE(bound.is_closed()) << bound.components[0].reason;
  const double proved = bound.components[0].proved->approx,
               attained = bound.components[0].attained->approx;
  const double room = 1e-9 * seen;
  EXPECT_TRUE(is_least ? seen >= proved - room : seen <= proved + room) << seen << ' ' << proved;
  EXPECT_TRUE(is_least ? attained >= proved : attained <= proved);
  // Samples come near to the end that is attained.
  EXPECT_NEAR(seen, attained, 0.06 * seen);
}

void expect_singular_values(int cables, double half) {
  Cables robot(cables, 1);
  const auto [least, largest] = robot.extreme_values(half);
  const std::string text = robot.text(half);
  SCOPED_TRACE(text);
  expect_bracket(bound_of(text, "sigma-min"), least, true);
  expect_bracket(bound_of(text, "sigma-max"), largest, false);
}

TEST(SingularValuesOfCables, AreThoseOfADecomposition) {
  for (const double half : {0.0, 0.02}) expect_singular_values(7, half);
}

TEST(SingularValuesOfCables, OfTheLargestMatrixAreThoseOfADecomposition) {
  expect_singular_values(10, 0.02);
}

TEST(SingularValuesOfCables, HaveProofs) {
  const std::string text = Cables(8, 3).text(0.02);
  const TemporaryDirectory folder;
  const Bound bound = bound_of(text, "sigma-min", folder.path() / "proof");
  for (const EndProof* proof :
       {&bound.components[0].proofs.safe(), &bound.components[0].proofs.singular()}) {
    std::ifstream file(proof->file);
    verifier::Options options;
    options.model_text = text;
    options.model_name = "model.toml";
    EXPECT_EQ(verifier::verify(file, options).outcome, verifier::Outcome::kVerified) << proof->file;
  }
}

TEST(SingularValuesOfCables, AreRefusedOfTooManyAtOnce) {
  try {
    static_cast<void>(bound_of(Cables(11, 1).text(0.02), "sigma-max"));
    FAIL();
  } catch (const UsageError& why) {
    EXPECT_THAT(why.what(), testing::HasSubstr("the 11×6 matrix has 17 rows and columns together"));
  }
}

}  // namespace
}  // namespace regulus::detail::test::cables
