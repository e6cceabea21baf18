// SPDX-License-Identifier: GPL-3.0-or-later
// Mechanisms whose singular values are known by configurations in closed form or by Newton's method, and
// questions about them.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <vector>

#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/closure/branch_bound.hpp"
#include "codegen/support/decomposition.hpp"
#include "tests/property/closure/checked_closures.hpp"

namespace regulus::detail::test::singular_values_over_a_branch {

using Matrix = Eigen::MatrixXd;

inline const QuantityOptions kCondition{.quantity = "condition", .norm = "2"},
    kLeast{.quantity = "sigma-min"}, kLargest{.quantity = "sigma-max"};

struct Asked {
  double gap = 0.02;
  std::string limit{}, certificate{};
  unsigned threads = 1;
  std::vector<std::string> tubes{};
};

inline ComponentBound bound(const std::string& text, const QuantityOptions& words,
                            const Asked& asked = {}) {
  ModelOptions options;
  options.motion = "m";
  options.tubes = asked.tubes;
  const Request request = read_request(text, options);
  BoundSettings settings;
  settings.gap = asked.gap;
  settings.search = usual_options();
  settings.search.threads = asked.threads;
  settings.over_branch = bounds_over_branch();
  settings.certificate = asked.certificate;
  Quantity quantity = quantity_of(request.model, words);
  if (!asked.limit.empty()) settings.limit = read_limit(asked.limit, quantity);
  return bound_quantity(request, std::move(quantity), settings, [](const ComponentBound&) {})
      .components.front();
}

/// The values of the three quantities.
struct Values {
  explicit Values(const Matrix& A) {
    const Eigen::VectorXd values = singular_values(A);
    largest = values(0), least = values(values.size() - 1), condition = largest / least;
  }
  double largest, least, condition;
};

/// Two cranks, whose ends two links at phi and psi join to a point (x, y).
class FiveBar {
 public:
  static std::string text(const std::string& tolerance) {
    return R"(regulus = 1
name = "five-bar"
characteristic_length = 0.5
[pose]
s = "rad"
t = "rad"
[geometry]
crank = { value = "0.4", tolerance = ")" +
           tolerance + R"(" }
[closure]
unknowns = { phi = "rad", psi = "rad", x = "m", y = "m" }
equations = [
  "crank*cos(s) + 0.7*cos(phi) - x",
  "crank*sin(s) + 0.7*sin(phi) - y",
  "0.6 + crank*cos(t) + 0.7*cos(psi) - x",
  "crank*sin(t) + 0.7*sin(psi) - y",
]
start = { s = 2, t = 1, phi = 0.765, psi = 2.322, x = 0.3386, y = 0.8484 }
[motion.m]
s = [1.7, 2.3]
t = [0.8, 1.3]
)";
  }

  /// Follows the configuration by Newton's method from the start.
  FiveBar(double s, double t, double crank) {
    constexpr int kSteps = 10;
    for (int step = 0; step <= kSteps; ++step) {
      const double part = double(step) / kSteps;
      s_ = 2 + (s - 2) * part, t_ = 1 + (t - 1) * part, crank_ = 0.4 + (crank - 0.4) * part;
      for (int i = 0; i < 6; ++i) u_ -= solve_least_squares(derivatives(), equations());
    }
  }
  /// An angle of 1 counts as 0.5.
  [[nodiscard]] Matrix matrix() const {
    return derivatives() * Eigen::Vector4d(2, 2, 1, 1).asDiagonal();
  }
  [[nodiscard]] Eigen::Vector4d equations() const {
    return {crank_ * std::cos(s_) + 0.7 * std::cos(u_[0]) - u_[2],
            crank_ * std::sin(s_) + 0.7 * std::sin(u_[0]) - u_[3],
            0.6 + crank_ * std::cos(t_) + 0.7 * std::cos(u_[1]) - u_[2],
            crank_ * std::sin(t_) + 0.7 * std::sin(u_[1]) - u_[3]};
  }

 private:
  [[nodiscard]] Eigen::Matrix4d derivatives() const {
    Eigen::Matrix4d A;
    A << -0.7 * std::sin(u_[0]), 0, -1, 0, 0.7 * std::cos(u_[0]), 0, 0, -1, 0,
        -0.7 * std::sin(u_[1]), -1, 0, 0, 0.7 * std::cos(u_[1]), 0, -1;
    return A;
  }
  double s_ = 2, t_ = 1, crank_ = 0.4;
  Eigen::Vector4d u_{0.7649, 2.3219, 0.33858878, 0.84841166};
};

/// A crank of 1 and a rod of 2 push a slider: A = ((2cos φ, 0), (2sin φ, 1)), sin φ = −sin θ/2, with an
/// angle that counts as `length`.
inline std::string slider(const std::string& theta, const std::string& length) {
  return "regulus = 1\nname = \"slider\"\ncharacteristic_length = " + length +
         "\n[pose]\ntheta = \"rad\"\n[closure]\nunknowns = { phi = \"rad\", s = \"m\" }\nequations "
         "= [\n"
         "  \"sin(theta) + 2*sin(phi)\",\n  \"s - cos(theta) - 2*cos(phi)\",\n]\n"
         "start = { theta = 0, phi = 0, s = 3 }\n[motion.m]\ntheta = " +
         theta + "\n";
}

inline Values of_slider(double theta, double length) {
  const double sine = -std::sin(theta) / 2;
  Matrix A(2, 2);
  A << 2 * std::sqrt(1 - sine * sine) / length, 0, 2 * sine / length, 1;
  return Values(A);
}

}  // namespace regulus::detail::test::singular_values_over_a_branch
