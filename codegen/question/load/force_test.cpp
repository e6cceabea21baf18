// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/force_test.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/question/load/along_direction.hpp"
#include "codegen/question/load/greatest_slack.hpp"

namespace regulus::detail {
namespace {

using Doubles = std::vector<double>;
using Intervals = std::vector<Interval>;

/// A bound that no slack reaches: the largest slack is about 1.
constexpr double kFarBound = 1e6;

Interval symmetric(double radius) { return {-radius, radius}; }

/// Decides one box.
class BoxDecision {
 public:
  BoxDecision(const ForceProblem& problem, const BoxMatrix& box)
      : problem_(problem), box_(box), m_(problem.rows), n_(problem.columns) {}

  ForceDecision run() {
    for (std::size_t i = 0; i < m_; ++i)
      weight_.push_back(
          problem_.is_free[i] ? 1.0 : problem_.certain[i].hi / 2 - problem_.certain[i].lo / 2);
    weigh_free_rows();
    decision_.impact.assign(box_.radius.size(), 0);
    if (!precondition()) return decision_;
    bound_error();
    bool all_held = true, all_held_at_center = true;
    for (std::size_t corner = 0; corner < problem_.corners.size(); ++corner) {
      const Attempt attempt = try_corner(corner);
      if (decision_.shortage) return decision_;
      all_held = all_held && attempt.held;
      all_held_at_center = all_held_at_center && attempt.held_at_center;
    }
    if (all_held) decision_.kind = ForceDecision::Kind::kHeld;
    decision_.fails_at_center = !all_held_at_center;
    return decision_;
  }

 private:
  struct Attempt {
    bool held = false, held_at_center = false;
  };

  [[nodiscard]] const Interval& A(std::size_t i, std::size_t j) const {
    return box_.center[i * n_ + j];
  }
  [[nodiscard]] const Interval& slope(std::size_t k, std::size_t i, std::size_t j) const {
    return box_.slopes[(k * m_ + i) * n_ + j];
  }
  [[nodiscard]] double K(std::size_t j, std::size_t i) const { return inverse_[j * m_ + i]; }
  [[nodiscard]] std::size_t parameters() const { return box_.radius.size(); }

  [[nodiscard]] double middle(std::size_t i) const {
    return problem_.is_free[i] ? 0.0 : mid(problem_.certain[i]);
  }

  [[nodiscard]] double length_of_row(std::size_t i) const {
    double length = 0;
    for (std::size_t j = 0; j < n_; ++j) length = std::hypot(length, weight_[i] * mid(A(i, j)));
    return length;
  }

  /// Free rows are long, so that a change of the load costs their forces nothing.
  void weigh_free_rows() {
    constexpr double kMuchLonger = 1e3;
    double longest = 0;
    for (std::size_t i = 0; i < m_; ++i)
      if (!problem_.is_free[i]) longest = std::fmax(longest, length_of_row(i));
    for (std::size_t i = 0; i < m_; ++i)
      if (const double own = length_of_row(i); problem_.is_free[i] && own > 0 && longest > 0)
        weight_[i] = kMuchLonger * longest / own;
  }

  /// Finds K and the null space for A with rows in units of the ranges of the forces.
  [[nodiscard]] bool precondition() {
    Doubles scaled(m_ * n_);
    for (std::size_t i = 0; i < m_; ++i)
      for (std::size_t j = 0; j < n_; ++j) {
        scaled[i * n_ + j] = weight_[i] * mid(A(i, j));
        if (!is_bounded(A(i, j))) return false;
      }
    auto found = approx_left_inverse(scaled, m_, n_);
    if (!found) return false;
    scaled_inverse_ = found->inverse;
    null_space_ = std::move(found->null_space);
    inverse_ = std::move(found->inverse);
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t i = 0; i < m_; ++i) inverse_[j * m_ + i] *= weight_[i];
    return std::ranges::all_of(inverse_, [](double x) { return std::isfinite(x); });
  }

  /// Computes P, and the part of it that is there at c.
  void bound_error() {
    error_.assign(n_ * n_, 0);
    error_at_center_ = error_;
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t l = 0; l < n_; ++l) {
        Interval sum(j == l ? -1.0 : 0.0);
        for (std::size_t i = 0; i < m_; ++i) sum += Interval(K(j, i)) * A(i, l);
        error_at_center_[j * n_ + l] = error_[j * n_ + l] = mag(sum);
        for (std::size_t k = 0; k < parameters(); ++k) add_error(k, j, l);
      }
  }

  void add_error(std::size_t k, std::size_t j, std::size_t l) {
    Interval sum(0.0);
    for (std::size_t i = 0; i < m_; ++i) sum += Interval(K(j, i)) * slope(k, i, l);
    const double part = mul_ru(mag(sum), box_.radius[k]);
    error_[j * n_ + l] = add_ru(error_[j * n_ + l], part);
    if (j == l) decision_.impact[k] = std::fmax(decision_.impact[k], part);
  }

  /// Returns y > 0 with Pᵀ(|r| + y) < y; empty if none was found.
  [[nodiscard]] Doubles bound_correction(const Doubles& P, const Intervals& r) const {
    Doubles y(n_, 0.0);
    const auto image = [&](std::size_t j) {
      double sum = 0;
      for (std::size_t l = 0; l < n_; ++l)
        sum = add_ru(sum, mul_ru(P[l * n_ + j], add_ru(mag(r[l]), y[l])));
      return sum;
    };
    Doubles next(n_);
    for (int step = 0; step < 30; ++step) {
      for (std::size_t j = 0; j < n_; ++j) next[j] = 1.02 * image(j) + 1e-18 * mag(r[j]) + 1e-290;
      y = next;
      bool proves = true;
      for (std::size_t j = 0; j < n_ && proves; ++j) proves = image(j) < y[j];
      if (proves) return y;
    }
    return {};
  }

  /// Returns the forces at c in the middle of the limits, of which `reserve` is taken away, and
  /// notes the linear program's answer.
  [[nodiscard]] std::optional<Doubles> middle_forces(const Intervals& w, const Doubles& reserve) {
    const std::size_t k = m_ - n_;
    const Doubles start = least_forces(w);
    Doubles normals, bounds;
    for (std::size_t i = 0; i < m_; ++i)
      for (const int side : {-1, 1}) {
        // Otherwise the force is given, or has no limit.
        const bool is_bound = weight_[i] > 0 && !problem_.is_free[i];
        for (std::size_t d = 0; d < k; ++d)
          normals.push_back(is_bound ? side * null_space_[i * k + d] : 0);
        bounds.push_back(is_bound ? 1 - reserve[i] / weight_[i] - side * start[i] : kFarBound);
      }
    slack_ = approx_greatest_slack(normals, k, bounds);
    if (!slack_) return std::nullopt;
    Doubles forces(m_);
    for (std::size_t i = 0; i < m_; ++i) {
      double offset = start[i];
      for (std::size_t d = 0; d < k; ++d) offset += null_space_[i * k + d] * slack_->z[d];
      forces[i] = std::clamp(middle(i) + weight_[i] * offset, -1e300, 1e300);
    }
    return forces;
  }

  /// Returns the shortest vector of forces that hold w at c, as offsets from the middles of the
  /// limits in units of half of their ranges.
  [[nodiscard]] Doubles least_forces(const Intervals& w) const {
    Doubles offsets(m_, 0.0);
    for (std::size_t j = 0; j < n_; ++j) {
      double missing = mid(w[j]);
      for (std::size_t i = 0; i < m_; ++i) missing -= mid(A(i, j)) * middle(i);
      for (std::size_t i = 0; i < m_; ++i) offsets[i] += scaled_inverse_[j * m_ + i] * missing;
    }
    return offsets;
  }

  [[nodiscard]] Attempt try_corner(std::size_t corner) {
    const Intervals& w = problem_.corners[corner];
    Doubles reserve(m_, 0.0);
    Attempt attempt;
    for (int round = 0; round < 3 && !attempt.held; ++round) {
      const std::optional<Doubles> forces = middle_forces(w, reserve);
      if (!forces) break;
      if (round == 0 && slack_->s < 0) {
        refute(corner);
        return attempt;
      }
      const Doubles needed = compare(w, *forces, attempt);
      if (needed.empty()) break;
      reserve = needed;
    }
    if (!attempt.held_at_center && !problem_.balls.empty()) refute_in_balls(corner);
    return attempt;
  }

  /// A load of a ball may not be held although that in its centre is. Tries those that change some
  /// force most.
  void refute_in_balls(std::size_t corner) {
    for (std::size_t i = 0; i < m_; ++i)
      for (const double side : {-1.0, 1.0}) {
        Intervals w = problem_.corners[corner];
        for (const LoadBall& ball : problem_.balls) {
          double length = 0;
          for (const std::size_t j : ball.members) length = std::hypot(length, K(j, i));
          for (const std::size_t j : ball.members)
            if (length > 0) w[j] += Interval(side * ball.radius.hi * K(j, i) / length);
        }
        if (middle_forces(w, Doubles(m_, 0.0)) && slack_->s < 0) refute(corner);
        if (decision_.shortage) return;
      }
  }

  /// Compares the forces around `f0` with the limits. Returns how far each may move; empty if
  /// nothing bounds them.
  Doubles compare(const Intervals& w, const Doubles& f0, Attempt& attempt) {
    Intervals r = residual(w, f0);
    const Intervals slopes = slopes_of_residual(f0);
    Intervals at_center = r;
    add_balls(at_center);
    const Doubles center_correction = bound_correction(error_at_center_, at_center);
    for (std::size_t k = 0; k < parameters(); ++k)
      for (std::size_t j = 0; j < n_; ++j)
        r[j] += symmetric(mul_ru(mag(slopes[k * n_ + j]), box_.radius[k]));
    const Intervals start = residual(w, f0);
    add_balls(r);
    const Doubles correction = bound_correction(error_, r);
    bool held = !correction.empty(), held_at_center = !center_correction.empty();
    Doubles moves(m_, 0.0);
    for (std::size_t i = 0; i < m_; ++i) {
      const Interval fixed = force_at_center(i, start) + symmetric(ball_force(i));
      const Interval moving = symmetric(moving_force(i, slopes));
      held_at_center = held_at_center && is_within(i, f0[i], fixed, center_correction);
      held = held && is_within(i, f0[i], fixed + moving, correction);
      moves[i] = mag(fixed + moving + symmetric(correction_force(i, correction)));
    }
    attempt.held = held;
    attempt.held_at_center = attempt.held_at_center || held_at_center;
    return correction.empty() ? Doubles{} : moves;
  }

  /// Returns w − A(c)ᵀf₀.
  [[nodiscard]] Intervals residual(const Intervals& w, const Doubles& f0) const {
    Intervals r = w;
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t i = 0; i < m_; ++i) r[j] -= A(i, j) * Interval(f0[i]);
    return r;
  }

  /// Returns (∂_kA)ᵀf₀, k by k.
  [[nodiscard]] Intervals slopes_of_residual(const Doubles& f0) const {
    Intervals slopes(parameters() * n_, Interval(0.0));
    for (std::size_t k = 0; k < parameters(); ++k)
      for (std::size_t i = 0; i < m_; ++i)
        for (std::size_t j = 0; j < n_; ++j) slopes[k * n_ + j] += slope(k, i, j) * Interval(f0[i]);
    return slopes;
  }

  void add_balls(Intervals& r) const {
    for (const LoadBall& ball : problem_.balls)
      for (const std::size_t j : ball.members) r[j] += symmetric(ball.radius.hi);
  }

  [[nodiscard]] Interval force_at_center(std::size_t i, const Intervals& r) const {
    Interval sum(0.0);
    for (std::size_t j = 0; j < n_; ++j) sum += Interval(K(j, i)) * r[j];
    return sum;
  }

  [[nodiscard]] double ball_force(std::size_t i) const {
    Interval sum(0.0);
    for (const LoadBall& ball : problem_.balls) {
      Interval squares(0.0);
      for (const std::size_t j : ball.members) squares += sqr(Interval(K(j, i)));
      sum += ball.radius * sqrt(squares);
    }
    return mag(sum);
  }

  [[nodiscard]] double moving_force(std::size_t i, const Intervals& slopes) {
    double sum = 0;
    for (std::size_t k = 0; k < parameters(); ++k) {
      Interval along(0.0);
      for (std::size_t j = 0; j < n_; ++j) along += Interval(K(j, i)) * slopes[k * n_ + j];
      const double part = mul_ru(mag(along), box_.radius[k]);
      if (weight_[i] > 0 && !problem_.is_free[i])
        decision_.impact[k] = std::fmax(decision_.impact[k], part / weight_[i]);
      sum = add_ru(sum, part);
    }
    return sum;
  }

  [[nodiscard]] double correction_force(std::size_t i, const Doubles& y) const {
    double sum = 0;
    for (std::size_t j = 0; j < y.size(); ++j) sum = add_ru(sum, mul_ru(std::fabs(K(j, i)), y[j]));
    return sum;
  }

  [[nodiscard]] bool is_within(std::size_t i, double f0, const Interval& change,
                               const Doubles& correction) const {
    if (correction.empty()) return false;
    if (problem_.is_free[i]) return true;
    const Interval force = Interval(f0) + change + symmetric(correction_force(i, correction));
    return certain_subset(force, problem_.certain[i]);
  }

  /// Tries the direction of the linear program's multipliers.
  void refute(std::size_t corner) {
    Doubles y(n_, 0.0);
    for (std::size_t i = 0; i < m_; ++i) {
      const double a = (slack_->multipliers[2 * i] - slack_->multipliers[2 * i + 1]);
      for (std::size_t j = 0; j < n_; ++j) y[j] -= scaled_inverse_[j * m_ + i] * a;
    }
    if (!std::ranges::all_of(y, [](double x) { return std::isfinite(x); })) return;
    const AlongDirection at_center(problem_, box_, weight_, scaled_inverse_, y, false);
    if (!at_center.is_found()) return;
    const Interval needed = at_center.needed(corner), possible = at_center.possible();
    if (!certain_less(possible, needed)) return;
    decision_.shortage = Shortage{corner, y, needed, possible};
    const AlongDirection over_box(problem_, box_, weight_, scaled_inverse_, y, true);
    if (over_box.is_found() && certain_less(over_box.possible(), over_box.needed(corner)))
      decision_.kind = ForceDecision::Kind::kNotHeld;
  }

  const ForceProblem& problem_;
  const BoxMatrix& box_;
  const std::size_t m_, n_;
  Doubles
      weight_;  ///< half of each range of forces, 0: the force is given; of a free one, a large number
  Doubles scaled_inverse_, null_space_;
  Doubles inverse_;                  ///< K
  Doubles error_, error_at_center_;  ///< P
  std::optional<GreatestSlack> slack_;
  ForceDecision decision_;
};

}  // namespace

ForceDecision ForceTest::decide(const BoxMatrix& box) const {
  return BoxDecision(problem_, box).run();
}

}  // namespace regulus::detail
