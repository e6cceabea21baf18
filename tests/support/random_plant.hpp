// SPDX-License-Identifier: GPL-3.0-or-later
// Random models of robots that are singular at a known pose for known values of their uncertain
// quantities: planar platforms on three legs, and matrices of polynomials and sines.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

/// A square matrix of doubles.
using Entries = std::vector<std::vector<double>>;

/// Returns the determinant, to nearest.
inline double determinant_of(Entries M) {
  double result = 1;
  for (std::size_t k = 0; k < M.size(); ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < M.size(); ++i)
      if (std::fabs(M[i][k]) > std::fabs(M[pivot][k])) pivot = i;
    if (M[pivot][k] == 0) return 0;
    if (pivot != k) std::swap(M[pivot], M[k]), result = -result;
    result *= M[k][k];
    for (std::size_t i = k + 1; i < M.size(); ++i)
      for (std::size_t j = M.size(); j-- > k;) M[i][j] -= M[i][k] / M[k][k] * M[k][j];
  }
  return result;
}

/// The known place: that part of the way from the middle of each range to one of its ends.
struct PlantedPlace {
  double part;
  bool ball;
  double alpha = 0;  ///< if it is not 0: |det| there is `part` of α, and need not be 0
};

/// Shares its motions: "pose", "box" around that pose, and "path" through it.
class RandomPlant {
 public:
  virtual ~RandomPlant() = default;

  /// Returns the text of a model; empty if these numbers do not suit.
  [[nodiscard]] virtual std::string model() const = 0;

 protected:
  RandomPlant(RandomSource& random, std::vector<std::string> names, std::vector<double> pose,
              std::vector<double> halves, PlantedPlace place)
      : place_(place), names_(std::move(names)), pose_(std::move(pose)) {
    for (std::size_t k = 0; k < pose_.size(); ++k) {
      const double away = (random.one_in(2) ? -1 : 1) * place_.part * halves[k];
      ranges_.push_back({pose_[k] - away - halves[k], pose_[k] - away + halves[k]});
      slopes_.push_back(random.between(-halves[k], halves[k]));
    }
    crossing_ = random.between(0.1, 0.9);
  }

  /// `determinant`: at the known place.
  [[nodiscard]] std::string motions(double determinant) const {
    const std::string alpha =
        place_.alpha == 0 ? ""
                          : fmt::format("alpha = {:.17g}\n", std::fabs(determinant) / place_.part);
    std::string pose = "[motion.pose]\n", box = "[motion.box]\n",
                path = "[motion.path]\nparameters = { s = [0, 1] }\n";
    for (std::size_t k = 0; k < names_.size(); ++k) {
      pose += fmt::format("{} = {:.17g}\n", names_[k], pose_[k]);
      box +=
          fmt::format("{} = [{:.17g}, {:.17g}]\n", names_[k], ranges_[k].first, ranges_[k].second);
      path += fmt::format("{} = \"({:.17g}) + ({:.17g})*(s - ({:.17g}))\"\n", names_[k], pose_[k],
                          slopes_[k], crossing_);
    }
    return fmt::format("{1}{0}{2}{0}{3}{0}", alpha, pose, box, path);
  }

  const PlantedPlace place_;
  const std::vector<std::string> names_;
  const std::vector<double> pose_;

 private:
  std::vector<std::pair<double, double>> ranges_;
  std::vector<double> slopes_;
  double crossing_;
};

/// Three legs from points A_i, in balls or boxes, to the corners of a platform; the matrix has the
/// rows (d, Rb × d), d = X + Rb − A.
class RandomPlanarPlatform final : public RandomPlant {
 public:
  RandomPlanarPlatform(RandomSource& random, PlantedPlace place)
      : RandomPlant(random, {"x", "y", "phi"},
                    {random.between(-2, 2), random.between(-2, 2), random.between(-0.5, 0.5)},
                    {0.3, 0.3, 0.05}, place),
        tolerance_(std::exp(random.between(-5, -1.5))) {
    for (int i = 0; i < 3; ++i) {
      const double angle = 2.1 * i + random.between(-0.3, 0.3);
      base_[i] = {10 * std::cos(angle), 10 * std::sin(angle)};
      platform_[i] = {4 * std::cos(angle + 0.4), 4 * std::sin(angle + 0.4)};
    }
    plant();
  }

  [[nodiscard]] std::string model() const override {
    if (!(std::hypot(base_[2][0], base_[2][1]) < 40)) return {};
    std::string
        text =
            "regulus = 1\nname = \"planar\"\n[pose]\nx = \"cm\"\ny = \"cm\"\nphi = \"rad\"\n"
            "[geometry]\n",
        rows;
    for (int i = 0; i < 3; ++i) {
      text +=
          fmt::format("a{} = {{ value = [{:.17g}, {:.17g}], {} = {:.17g}, group = \"base\" }}\n", i,
                      base_[i][0], base_[i][1], place_.ball ? "radius" : "tolerance", tolerance_);
      rows += fmt::format("{}[\"dx{}\", \"dy{}\", \"rx{}*dy{} - ry{}*dx{}\"]", i == 0 ? "" : ", ",
                          i, i, i, i, i, i);
    }
    text += "[let]\n";
    for (int i = 0; i < 3; ++i)
      text += fmt::format(
          "rx{0} = \"({1:.17g})*cos(phi) - ({2:.17g})*sin(phi)\"\n"
          "ry{0} = \"({1:.17g})*sin(phi) + ({2:.17g})*cos(phi)\"\n"
          "dx{0} = \"x + rx{0} - a{0}_1\"\ndy{0} = \"y + ry{0} - a{0}_2\"\n",
          i, platform_[i][0], platform_[i][1]);
    const double determinant =
        place_.alpha == 0 ? 0 : determinant_at({base_[0], base_[1], base_[2]});
    return fmt::format("{}[matrix]\nrows = [{}]\n{}", text, rows, motions(determinant));
  }

 private:
  using Point = std::array<double, 2>;

  [[nodiscard]] double determinant_at(const std::array<Point, 3>& base) const {
    Entries M;
    for (int i = 0; i < 3; ++i) {
      const double c = std::cos(pose_[2]), s = std::sin(pose_[2]);
      const Point r{c * platform_[i][0] - s * platform_[i][1],
                    s * platform_[i][0] + c * platform_[i][1]};
      const Point d{pose_[0] + r[0] - base[i][0], pose_[1] + r[1] - base[i][1]};
      M.push_back({d[0], d[1], r[0] * d[1] - r[1] * d[0]});
    }
    return determinant_of(M);
  }

  /// The determinant is linear in an anchor: moves the last one to a zero, then all of them away
  /// from it along the gradient.
  void plant() {
    if (place_.alpha != 0) return;
    std::array<Point, 3> zero = base_;
    const double before = determinant_at(zero);
    zero[2][1] += 1;
    zero[2][1] -= 1 + before / (determinant_at(zero) - before);
    base_ = zero;
    for (int i = 0; i < 3; ++i) {
      Point gradient;
      for (int j = 0; j < 2; ++j) {
        std::array<Point, 3> moved = zero;
        moved[i][j] += 1;
        gradient[j] = determinant_at(moved);
      }
      const double length = place_.part * tolerance_, norm = std::hypot(gradient[0], gradient[1]);
      for (int j = 0; j < 2; ++j)
        base_[i][j] += length * (place_.ball ? gradient[j] / norm : gradient[j] < 0 ? -1.0 : 1.0);
    }
  }

  const double tolerance_;
  std::array<Point, 3> base_, platform_;
};

/// A matrix of order two to four. Each entry has a constant, the pose parameters p, one uncertain
/// quantity u, and p²·u or sin p.
class RandomMatrixModel final : public RandomPlant {
 public:
  RandomMatrixModel(RandomSource& random, PlantedPlace place)
      : RandomPlant(random, {"p", "q"}, {random.between(-1, 1), random.between(-1, 1)}, {0.1, 0.1},
                    place),
        order_(2 + random.below(3)),
        tolerance_(std::exp(random.between(-4, -1))) {
    for (std::size_t e = 0; e < order_ * order_; ++e) {
      Entry entry;
      for (double* x : {&entry.one, &entry.p, &entry.q, &entry.u, &entry.last})
        *x = random.between(-1, 1);
      entry.uncertain = random.below(kUncertain);
      entry.is_sine = random.one_in(2);
      entries_.push_back(entry);
    }
    // A witness lies in the box inside a ball whose coordinates touch several rows.
    const double half = tolerance_ * (place.ball ? 1 / std::sqrt(double{kUncertain}) : 1.0);
    for (double& u : values_) u = place.part * half * (random.one_in(2) ? -1 : 1);
    plant();
  }

  [[nodiscard]] std::string model() const override {
    if (!(std::fabs(entries_.back().one) < 20)) return {};
    std::string text = fmt::format(
        "regulus = 1\nname = \"matrix\"\n[pose]\np = \"1\"\nq = \"1\"\n[geometry]\n"
        "u = {{ value = [0, 0, 0], {} = {:.17g}, group = \"all\" }}\n[matrix]\nrows = [",
        place_.ball ? "radius" : "tolerance", tolerance_);
    for (std::size_t i = 0; i < order_; ++i) {
      text += i == 0 ? "[" : ", [";
      for (std::size_t j = 0; j < order_; ++j)
        text += fmt::format("{}\"{}\"", j == 0 ? "" : ", ", format(entries_[i * order_ + j]));
      text += "]";
    }
    return fmt::format("{}]\n{}", text, motions(determinant()));
  }

 private:
  static constexpr std::size_t kUncertain = 3;
  struct Entry {
    double one, p, q, u, last;
    std::size_t uncertain;
    bool is_sine;
  };

  static std::string format(const Entry& e) {
    return fmt::format("({:.17g}) + ({:.17g})*p + ({:.17g})*q + ({:.17g})*u_{} + ({:.17g})*{}",
                       e.one, e.p, e.q, e.u, e.uncertain + 1, e.last,
                       e.is_sine ? "sin(q)" : fmt::format("p^2*u_{}", e.uncertain + 1));
  }

  [[nodiscard]] double value(const Entry& e) const {
    const double p = pose_[0], q = pose_[1], u = values_[e.uncertain];
    return e.one + e.p * p + e.q * q + e.u * u + e.last * (e.is_sine ? std::sin(q) : p * p * u);
  }

  [[nodiscard]] double determinant() const {
    Entries M(order_);
    for (std::size_t e = 0; e < entries_.size(); ++e) M[e / order_].push_back(value(entries_[e]));
    return determinant_of(M);
  }

  /// The determinant is linear in the last entry.
  void plant() {
    if (place_.alpha != 0) return;
    const double before = determinant();
    entries_.back().one += 1;
    entries_.back().one -= 1 + before / (determinant() - before);
  }

  const std::size_t order_;
  const double tolerance_;
  std::vector<Entry> entries_;
  double values_[kUncertain];
};

}  // namespace regulus::detail::test
