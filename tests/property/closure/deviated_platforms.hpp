// SPDX-License-Identifier: GPL-3.0-or-later
// Platforms on legs of wrong lengths, whose poses Newton's method finds in long doubles.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace regulus::detail::test {

using Real = long double;

/// Newton's method for f(p) = 0 from p = 0, with differences for the derivatives.
template <std::size_t n, class Function>
std::array<Real, n> root_near_zero(const Function& f) {
  std::array<Real, n> p{};
  for (int step = 0; step < 12; ++step) {
    std::array<std::array<Real, n + 1>, n> A{};
    const std::array<Real, n> value = f(p);
    for (std::size_t k = 0; k < n; ++k) {
      std::array<Real, n> moved = p;
      constexpr Real h = 1e-7L;
      moved[k] += h;
      const std::array<Real, n> there = f(moved);
      for (std::size_t i = 0; i < n; ++i) A[i][k] = (there[i] - value[i]) / h;
    }
    for (std::size_t i = 0; i < n; ++i) A[i][n] = value[i];
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t best = k;
      for (std::size_t i = k; i < n; ++i)
        if (std::fabs(A[i][k]) > std::fabs(A[best][k])) best = i;
      std::swap(A[k], A[best]);
      for (std::size_t i = 0; i < n; ++i) {
        if (i == k) continue;
        const Real factor = A[i][k] / A[k][k];
        for (std::size_t j = k; j <= n; ++j) A[i][j] -= factor * A[k][j];
      }
    }
    for (std::size_t k = 0; k < n; ++k) p[k] -= A[k][n] / A[k][k];
  }
  return p;
}

/// A platform on six legs with errors of them, and of its anchors at the base.
struct Hexapod {
  static constexpr Real kBase[6][3] = {{-9, 9, 0},  {9, 9, 0},    {12, -3, 0},
                                       {3, -13, 0}, {-3, -13, 0}, {-12, -3, 0}},
                        kPlatform[6][3] = {{-3, 7, 0}, {3, 7, 0},   {7, -1, 0},
                                           {4, -6, 0}, {-4, -6, 0}, {-7, -1, 0}};
  static constexpr double kLegs = 0.001, kAnchors = 0.001;  ///< the largest errors

  std::array<Real, 6> pose{0, 1, 47, 0, 0, 0};  ///< x, y, z and Euler's angles ψ, θ, φ
  std::array<Real, 6> legs{};                   ///< errors
  std::array<std::array<Real, 3>, 6> base{};    ///< the same

  /// How far the platform is off its commanded pose: e, and roll, pitch, yaw.
  [[nodiscard]] std::array<Real, 6> deviation() const {
    return root_near_zero<6>([this](const std::array<Real, 6>& p) { return residuals(p); });
  }

  /// Puts errors at corners, and changes one after another as long as the deviation grows.
  [[nodiscard]] Real largest_at_corners(std::size_t freedom, std::mt19937& random) {
    std::vector<Real*> signs;
    for (Real& leg : legs) leg = random() % 2 == 0 ? kLegs : -kLegs, signs.push_back(&leg);
    for (auto& anchor : base)
      for (Real& x : anchor) x = random() % 2 == 0 ? kAnchors : -kAnchors, signs.push_back(&x);
    Real value = std::fabs(deviation()[freedom]);
    for (Real* sign : signs) {
      *sign = -*sign;
      const Real other = std::fabs(deviation()[freedom]);
      other > value ? static_cast<void>(value = other) : static_cast<void>(*sign = -*sign);
    }
    return value;
  }

  /// The model, with `anchors` as the tolerance of the base. `motion`: its lines.
  static std::string text(const std::string& motion, double anchors = kAnchors) {
    std::string base, platform;
    for (int k = 0; k < 6; ++k) {
      base += fmt::format("[{}, {}, 0], ", double(kBase[k][0]), double(kBase[k][1]));
      platform += fmt::format("[{}, {}, 0], ", double(kPlatform[k][0]), double(kPlatform[k][1]));
    }
    return fmt::format(
        "regulus = 1\nname = \"hexapod\"\n[gough]\norientation = \"euler-zxz\"\nunit = \"cm\"\n"
        "base = [{}]\nplatform = [{}]\nbase_tolerance = {}\n[actuators]\nerror = {}\n"
        "[motion.m]\n{}",
        base, platform, anchors, kLegs, motion);
  }

 private:
  using Vector = std::array<Real, 3>;
  using Matrix = std::array<Vector, 3>;

  static Vector sum(const Vector& u, const Vector& v, Real sign = 1) {
    return {u[0] + sign * v[0], u[1] + sign * v[1], u[2] + sign * v[2]};
  }
  static Vector product(const Matrix& A, const Vector& v) {
    Vector result{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) result[i] += A[i][j] * v[j];
    return result;
  }
  static Matrix product(const Matrix& A, const Matrix& B) {
    Matrix result{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) result[i][j] += A[i][k] * B[k][j];
    return result;
  }
  /// The rotation about axis 0, 1 or 2.
  static Matrix turn(int axis, Real angle) {
    const Real c = std::cos(angle), s = std::sin(angle);
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    Matrix R{};
    R[axis][axis] = 1, R[i][i] = R[j][j] = c, R[i][j] = -s, R[j][i] = s;
    return R;
  }
  static Real length(const Vector& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

  [[nodiscard]] std::array<Real, 6> residuals(const std::array<Real, 6>& p) const {
    const Matrix R = product(turn(2, pose[3]), product(turn(0, pose[4]), turn(2, pose[5]))),
                 E = product(turn(2, p[5]), product(turn(1, p[4]), turn(0, p[3])));
    const Vector X{pose[0], pose[1], pose[2]};
    std::array<Real, 6> result{};
    for (int k = 0; k < 6; ++k) {
      const Vector b = product(R, Vector{kPlatform[k][0], kPlatform[k][1], kPlatform[k][2]});
      const Vector nominal{kBase[k][0], kBase[k][1], kBase[k][2]};
      const Vector a = sum(nominal, base[k]);
      const Real commanded = length(sum(sum(X, b), nominal, -1)) + legs[k];
      const Vector moved = sum(X, Vector{p[0], p[1], p[2]});
      result[k] = length(sum(sum(moved, product(E, b)), a, -1)) - commanded;
    }
    return result;
  }
};

/// A platform in the plane on three legs, the same.
struct Tripod {
  static constexpr Real kBase[3][2] = {{0, 0}, {10, 0}, {3, 10}},
                        kPlatform[3][2] = {{0, 0}, {4, 0}, {2, 2}};

  std::array<Real, 3> pose{};                 ///< x, y, φ
  std::array<Real, 3> legs{};                 ///< errors
  std::array<std::array<Real, 2>, 3> base{};  ///< the same

  [[nodiscard]] std::array<Real, 3> deviation() const {
    return root_near_zero<3>([this](const std::array<Real, 3>& p) {
      std::array<Real, 3> result{};
      for (int k = 0; k < 3; ++k) result[k] = length(k, p, base[k]) - length(k, {}, {}) - legs[k];
      return result;
    });
  }

  /// The largest of the corners of all errors.
  [[nodiscard]] std::array<Real, 3> largest_at_corners(Real of_legs, Real of_anchors) const {
    std::array<Real, 3> most{};
    const int count = of_anchors > 0 ? 512 : 8;
    for (int corner = 0; corner < count; ++corner) {
      Tripod other = *this;
      const auto error = [corner](int bit, Real size) {
        return (corner >> bit & 1) != 0 ? size : -size;
      };
      for (int k = 0; k < 3; ++k) {
        other.legs[k] = error(k, of_legs);
        for (int i = 0; i < 2; ++i) other.base[k][i] = error(3 + 2 * k + i, of_anchors);
      }
      const std::array<Real, 3> p = other.deviation();
      for (int i = 0; i < 3; ++i) most[i] = std::fmax(most[i], std::fabs(p[i]));
    }
    return most;
  }

  /// The model. `lines`: of [legs]; `motion`: of the motion m.
  static std::string text(const std::string& error, const std::string& motion,
                          const std::string& lines = "") {
    return "regulus = 1\nname = \"3-RPR\"\n[legs]\nunit = \"cm\"\n" + lines +
           "[[legs.leg]]\ntype = \"RPR\"\nbase = [0, 0]\nplatform = [0, 0]\n"
           "[[legs.leg]]\ntype = \"RPR\"\nbase = [10, 0]\nplatform = [4, 0]\n"
           "[[legs.leg]]\ntype = \"RPR\"\nbase = [3, 10]\nplatform = [2, 2]\n"
           "[actuators]\nerror = " +
           error + "\n[motion.m]\n" + motion;
  }

 private:
  [[nodiscard]] Real length(int k, const std::array<Real, 3>& p,
                            const std::array<Real, 2>& off) const {
    const Real c = std::cos(pose[2] + p[2]), s = std::sin(pose[2] + p[2]);
    const Real *b = kPlatform[k], *a = kBase[k];
    return std::hypot(pose[0] + p[0] + c * b[0] - s * b[1] - a[0] - off[0],
                      pose[1] + p[1] + s * b[0] + c * b[1] - a[1] - off[1]);
  }
};

}  // namespace regulus::detail::test
