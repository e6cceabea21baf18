// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities of a hexapod that have J⁻¹ and its transpose in one matrix, against values at random
// poses and at corners.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "codegen/model/file/model_file.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "codegen/support/decomposition.hpp"

namespace regulus::detail::test::hexapod {
namespace {

constexpr int kSamples = 300;

Bound bound_of(const QuantityOptions& options) {
  ModelOptions model;
  model.path = REGULUS_SOURCE_DIR "/models/robot_1.toml";
  model.motion = "table4_5";
  const Request request = read_request(model);
  BoundSettings settings;
  settings.gap = 0.05;
  settings.search.engine = Engine::kAuto;
  settings.search.threads = 1;
  settings.search.time_limit = 300;
  settings.output.quiet = true;
  return bound_quantity(request, quantity_of(request.model, options), settings,
                        [](const ComponentBound&) {});
}

Eigen::Matrix3d rotation(double psi, double theta, double phi) {
  return (Eigen::AngleAxisd(psi, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(theta, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(phi, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

/// J⁻¹ of robot 1, with unit directions of the legs.
Eigen::Matrix<double, 6, 6> inverse_jacobian(const std::array<double, 6>& pose) {
  constexpr double base[6][2] = {{-9, 9}, {9, 9}, {12, -3}, {3, -13}, {-3, -13}, {-12, -3}};
  constexpr double platform[6][2] = {{-3, 7}, {3, 7}, {7, -1}, {4, -6}, {-4, -6}, {-7, -1}};
  const Eigen::Matrix3d R = rotation(pose[3], pose[4], pose[5]);
  Eigen::Matrix<double, 6, 6> J;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d b = R * Eigen::Vector3d(platform[i][0], platform[i][1], 0);
    const Eigen::Vector3d leg =
        Eigen::Vector3d(pose[0], pose[1], pose[2]) + b - Eigen::Vector3d(base[i][0], base[i][1], 0);
    const Eigen::Vector3d direction = leg.normalized();
    J.row(i) << direction.transpose(), b.cross(direction).transpose();
  }
  return J;
}

/// Poses of the motion; half of them at its corners.
std::vector<std::array<double, 6>> poses() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double angle = 5 * 3.14159265358979 / 180;
  std::vector<std::array<double, 6>> result;
  for (int s = 0; s < kSamples; ++s) {
    std::array<double, 6> p{};
    for (double& x : p) {
      x = uniform(random);
      if (s % 2 == 0) x = x < 0 ? -1 : 1;
    }
    result.push_back(
        {5 * p[0], 5 * p[1], 47.5 + 2.5 * p[2], angle * p[3], angle * p[4], angle * p[5]});
  }
  return result;
}

TEST(ABoundOfAHexapod, OfItsLeastSingularValueTakesFewBoxes) {
  const Bound bound = bound_of({.quantity = "sigma-min"});
  ASSERT_TRUE(bound.is_closed());
  EXPECT_LE(bound.components[0].boxes, 20u);
  const double proved = bound.decisive_proved()->proved->approx;
  double least = 1e9;
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Identity();
  for (int k = 3; k < 6; ++k) C(k, k) = 0.1;  // characteristic_length = 10
  for (const auto& pose : poses()) {
    const double value = singular_values(inverse_jacobian(pose) * C)(5);
    least = std::min(least, value);
    ASSERT_GT(value, proved);
  }
  EXPECT_LT(least, 1.1 * proved);
}

TEST(ABoundOfAHexapod, OfADeflectionTakesFewBoxes) {
  const Bound bound = bound_of({.quantity = "deflection", .load = "payload", .freedom = "v_y"});
  ASSERT_TRUE(bound.is_closed());
  EXPECT_LE(bound.components[0].boxes, 200u);
  const double proved = bound.decisive_proved()->proved->approx;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double largest = 0;
  for (const auto& pose : poses()) {
    Eigen::Matrix<double, 6, 1> load;
    load << 10 * uniform(random), 10 * uniform(random), -75 + 25 * uniform(random), 0, 0, 0;
    Eigen::Vector3d moment(uniform(random), uniform(random), uniform(random));
    load.tail<3>() = 100 * moment.normalized();
    const auto J = inverse_jacobian(pose);
    const Eigen::Matrix<double, 6, 1> force = solve_least_squares(J.transpose(), load);
    const Eigen::Matrix<double, 6, 1> twist = solve_least_squares(J, force / 10000);
    largest = std::max(largest, std::abs(twist(1)));
    ASSERT_LT(std::abs(twist(1)), proved);
  }
  EXPECT_GT(largest, proved / 2);
}

}  // namespace
}  // namespace regulus::detail::test::hexapod
