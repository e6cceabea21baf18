// SPDX-License-Identifier: GPL-3.0-or-later
// Systems Φ(x, p) = 0 whose roots are all known, and random tubes near them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/existence/branch_tube.hpp"
#include "tests/support/exact.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

/// Φ = A·f, where f_j is zero at the roots of p_j alone: known functions of x.
class PlantedSystem {
 public:
  enum class Kind {
    kSingle,  ///< p − g
    kTwo,     ///< (p − g)(p − h)
    kDouble,  ///< (p − g)²
    kNone,    ///< (p − g)² + 1/256
    kSine,    ///< sin(p − g)
  };

  PlantedSystem(RandomSource& random, std::size_t n, std::size_t m) : n_(n), m_(m) {
    for (std::size_t e = 0; e < n * n; ++e) A_.push_back(eighths(random));
    // Some systems are singular everywhere.
    if (n > 1 && random.one_in(16))
      for (std::size_t j = 0; j < n; ++j) A_[(n - 1) * n + j] = A_[j];
    for (std::size_t j = 0; j < n; ++j) {
      kinds_.push_back(random.one_in(2) ? Kind(random.below(5)) : Kind(4 * random.below(2)));
      g_.push_back(curve(random));
      h_.push_back(curve(random));
      // The second root is often close to the first.
      if (random.one_in(2)) {
        h_[j] = g_[j];
        h_[j][0] += std::ldexp(eighths(random), -static_cast<int>(random.below(12)));
      }
    }
  }

  [[nodiscard]] std::size_t unknowns() const { return n_; }
  [[nodiscard]] std::size_t variables() const { return m_; }
  [[nodiscard]] bool is_regular() const {
    return determinant(std::vector<Exact>(A_.begin(), A_.end()), n_).sign() != 0;
  }

  struct Values {
    std::vector<Interval> value, by_unknown, by_variable;
  };
  /// Encloses Φ and its derivatives over a box.
  [[nodiscard]] Values over(const std::vector<Interval>& x, const std::vector<Interval>& p) const {
    Values v{std::vector<Interval>(n_), std::vector<Interval>(n_ * n_),
             std::vector<Interval>(n_ * m_)};
    for (std::size_t j = 0; j < n_; ++j) {
      const Interval from_g = p[j] - at(g_[j], x), from_h = p[j] - at(h_[j], x);
      Interval f = from_g, by_g = 1.0, by_h = 0.0;
      if (kinds_[j] == Kind::kTwo) f = from_g * from_h, by_g = from_h, by_h = from_g;
      if (kinds_[j] == Kind::kDouble || kinds_[j] == Kind::kNone)
        f = sqr(from_g) + Interval(kinds_[j] == Kind::kNone ? 0x1p-8 : 0), by_g = 2.0 * from_g;
      if (kinds_[j] == Kind::kSine) f = sin(from_g), by_g = cos(from_g);
      for (std::size_t i = 0; i < n_; ++i) {
        const Interval a(A_[i * n_ + j]);
        v.value[i] += a * f;
        v.by_unknown[i * n_ + j] = a * (by_g + by_h);
        for (std::size_t k = 0; k < m_; ++k)
          v.by_variable[i * m_ + k] -= a * (by_g * slope(g_[j], x, k) + by_h * slope(h_[j], x, k));
      }
    }
    return v;
  }

  /// Returns the equations in the names p0, p1, … and x0, x1, …; all numbers are multiples of 2⁻¹⁴.
  [[nodiscard]] std::vector<std::string> equations() const {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < n_; ++i) {
      std::string sum = "0";
      for (std::size_t j = 0; j < n_; ++j) {
        const std::string from_g = "(" + name('p', j) + " - (" + text(g_[j]) + "))";
        const std::string from_h = "(" + name('p', j) + " - (" + text(h_[j]) + "))";
        std::string f = from_g;
        if (kinds_[j] == Kind::kTwo) f = from_g + "*" + from_h;
        if (kinds_[j] == Kind::kDouble) f = from_g + "^2";
        if (kinds_[j] == Kind::kNone) f = "(" + from_g + "^2 + 1/256)";
        if (kinds_[j] == Kind::kSine) f = "sin" + from_g;
        sum += " + " + number(A_[i * n_ + j]) + "*" + f;
      }
      result.push_back(sum);
    }
    return result;
  }

  /// Returns the number of roots in the tube over x; nullopt if π is not known well enough.
  [[nodiscard]] std::optional<std::size_t> count_roots(const BranchTube& tube,
                                                       const std::vector<double>& x) const {
    std::size_t product = 1;
    const std::vector<Exact> exact(x.begin(), x.end());
    for (std::size_t j = 0; j < n_; ++j) {
      const double turns = std::round(
          (tube.center[j] - mid(at(g_[j], std::vector<Interval>(x.begin(), x.end())))) / kPi.lo);
      const auto count = count_of(j, tube, exact, turns);
      if (!count) return std::nullopt;
      product *= *count;
    }
    return product;
  }

  /// Returns a tube that is mostly about a root, and a box of x, which need not contain x₀.
  [[nodiscard]] BranchTube random_tube(RandomSource& random, std::vector<Interval>& box) const {
    BranchTube tube;
    box.clear();
    const double width = std::ldexp(1.0, -static_cast<int>(random.below(12)));
    std::vector<Interval> at_middle;
    for (std::size_t k = 0; k < m_; ++k) {
      const double middle = random.between(-1, 1), half = random.one_in(6) ? 0 : width;
      box.emplace_back(middle - half, middle + half * random.unit());
      tube.at.push_back(random.one_in(4) ? middle + width * random.between(-2, 2) : middle);
      at_middle.emplace_back(tube.at[k]);
    }
    const double radius = std::ldexp(1.0 + random.unit(), 1 - static_cast<int>(random.below(14)));
    for (std::size_t j = 0; j < n_; ++j) {
      const auto& root = random.one_in(3) ? h_[j] : g_[j];
      const double off = random.one_in(2) ? 0 : radius * random.between(-1.2, 1.2);
      tube.center.push_back(mid(at(root, at_middle)) + off);
      for (std::size_t k = 0; k < m_; ++k)
        tube.slopes.push_back(mid(slope(root, at_middle, k)) +
                              (random.one_in(2) ? 0 : random.between(-0.1, 0.1)));
      tube.radius.push_back(radius * random.between(0.5, 2));
    }
    return tube;
  }

 private:
  /// Coefficients of 1, x₀², x₀, x₁, …
  using Curve = std::vector<double>;

  static double eighths(RandomSource& random) {
    return (static_cast<double>(random.below(33)) - 16) / 8;
  }
  [[nodiscard]] Curve curve(RandomSource& random) const {
    Curve c;
    for (std::size_t k = 0; k < 2 + m_; ++k) c.push_back(eighths(random) / (k == 0 ? 1 : 4));
    return c;
  }
  template <class Number>
  [[nodiscard]] Number at(const Curve& c, const std::vector<Number>& x) const {
    Number sum(c[0]);
    if (m_ > 0) sum = sum + Number(c[1]) * x[0] * x[0];
    for (std::size_t k = 0; k < m_; ++k) sum = sum + Number(c[2 + k]) * x[k];
    return sum;
  }
  static std::string name(char letter, std::size_t k) { return letter + std::to_string(k); }
  static std::string number(double x) {
    return "(" + std::to_string(std::lround(x * 0x1p14)) + "/16384)";
  }
  [[nodiscard]] std::string text(const Curve& c) const {
    std::string sum = number(c[0]);
    if (m_ > 0) sum += " + " + number(c[1]) + "*x0^2";
    for (std::size_t k = 0; k < m_; ++k) sum += " + " + number(c[2 + k]) + "*" + name('x', k);
    return sum;
  }
  [[nodiscard]] static Interval slope(const Curve& c, const std::vector<Interval>& x,
                                      std::size_t k) {
    const Interval linear(c[2 + k]);
    return k == 0 ? linear + Interval(2 * c[1]) * x[0] : linear;
  }

  [[nodiscard]] std::optional<std::size_t> count_of(std::size_t j, const BranchTube& tube,
                                                    const std::vector<Exact>& x,
                                                    double turns) const {
    Exact middle(tube.center[j]);
    for (std::size_t k = 0; k < m_; ++k)
      middle = middle + Exact(tube.slopes[j * m_ + k]) * (x[k] - Exact(tube.at[k]));
    const Exact radius(tube.radius[j]), g = at(g_[j], x), h = at(h_[j], x);
    const auto is_in = [&](const Exact& root) { return (root - middle).abs() <= radius; };
    if (kinds_[j] == Kind::kNone) return 0;
    if (kinds_[j] == Kind::kTwo && (g - h).sign() != 0)
      return static_cast<std::size_t>(is_in(g)) + static_cast<std::size_t>(is_in(h));
    if (kinds_[j] != Kind::kSine) return static_cast<std::size_t>(is_in(g));
    std::size_t count = 0;
    for (int turn = -9; turn <= 9; ++turn) {
      const Exact times(turns + turn);
      const bool is_in_with_less = is_in(g + times * Exact(kPi.lo));
      if (is_in_with_less != is_in(g + times * Exact(kPi.hi))) return std::nullopt;
      count += is_in_with_less;
    }
    return count;
  }

  std::size_t n_, m_;
  std::vector<double> A_;
  std::vector<Kind> kinds_;
  std::vector<Curve> g_, h_;
};

}  // namespace regulus::detail::test
