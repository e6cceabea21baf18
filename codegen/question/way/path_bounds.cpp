// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_bounds.hpp"

#include <algorithm>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/kernel/program/rational_bounds.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

bool is_rational(const ex& e) { return e.info(GiNaC::info_flags::rational); }

Interval enclose_rational(const ex& e) {
  return enclose(cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(e).to_cl_N()));
}

/// Numbers of degrees and radians are rational multiples of π and of 1/π, which are fast.
Interval enclose_coefficient(const ex& e) {
  if (is_rational(e)) return enclose_rational(e);
  if (const ex part = e / GiNaC::Pi; is_rational(part)) return enclose_rational(part) * kPi;
  if (const ex part = e * GiNaC::Pi; is_rational(part)) return enclose_rational(part) / kPi;
  return enclose_constant(e, "a coefficient of the trajectory");
}

bool differs(const PieceOfPose& a, const PieceOfPose& b) {
  return !a.power[0].is_equal(b.power[0]);
}

bool moves(const PieceOfPose& p) {
  for (std::size_t i = 1; i < kPieceCoefficients; ++i)
    if (!coefficient(p, i).is_zero()) return true;
  return false;
}

}  // namespace

CoordinateBounds::CoordinateBounds(const PieceOfPose& piece)
    : is_linear_(piece.power[2].is_zero() && piece.power[3].is_zero()),
      has_arc_(!piece.cosine.is_zero() || !piece.sine.is_zero()) {
  for (std::size_t i = 0; i < power_.size(); ++i) power_[i] = enclose_coefficient(piece.power[i]);
  if (!has_arc_) return;
  cosine_ = enclose_coefficient(piece.cosine);
  sine_ = enclose_coefficient(piece.sine);
  turn_ = enclose_coefficient(piece.turn);
}

/// A linear function has its extrema at the ends. A cubic lies in the hull of its Bernstein
/// coefficients over [begin, end], which follow from Taylor's at `begin`.
Interval CoordinateBounds::polynomial(Interval begin, Interval end) const noexcept {
  const auto& [a, b, c, d] = power_;
  if (is_linear_) return hull(a + b * begin, a + b * end);
  const Interval h = end - begin;
  const Interval q0 = a + begin * (b + begin * (c + begin * d));
  const Interval q1 = h * (b + begin * (Interval(2) * c + Interval(3) * begin * d));
  const Interval q2 = sqr(h) * (c + Interval(3) * begin * d);
  const Interval q3 = h * sqr(h) * d;
  const Interval b1 = q0 + q1 / Interval(3);
  const Interval b2 = q0 + (Interval(2) * q1 + q2) / Interval(3);
  return hull(hull(q0, b1), hull(b2, q0 + q1 + q2 + q3));
}

/// The natural bounds and the mean-value bounds each enclose the arc.
Interval CoordinateBounds::arc(Interval s) const noexcept {
  const auto at = [this](Interval angle) {
    const SinCos v = sincos(angle);
    return cosine_ * v.cos + sine_ * v.sin;
  };
  const Interval middle(mid(s));
  const SinCos v = sincos(turn_ * s);
  const Interval slope = turn_ * (sine_ * v.cos - cosine_ * v.sin);
  const Interval natural = cosine_ * v.cos + sine_ * v.sin;
  const Interval mean_value = at(turn_ * middle) + slope * (s - middle);
  // Both contain the arc, so that they meet.
  return intersect(natural, mean_value).value_or(natural);
}

Interval CoordinateBounds::over(double begin, double end) const noexcept {
  const Interval straight = polynomial(Interval(begin), Interval(end));
  return has_arc_ ? straight + arc(Interval(begin, end)) : straight;
}

PathBounds::PathBounds(const Trajectory& trajectory, const std::vector<ex>& errors)
    : pieces_(trajectory.pieces.size()) {
  find_moving(trajectory, errors);
  coordinates_.reserve(pieces_ * moving_.size());
  for (const TrajectoryPiece& piece : trajectory.pieces)
    for (const std::size_t i : moving_) coordinates_.emplace_back(piece.pose[i]);
  bound_groups();
}

void PathBounds::find_moving(const Trajectory& trajectory, const std::vector<ex>& errors) {
  const std::vector<PieceOfPose>& first = trajectory.pieces.front().pose;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool has_error = !errors.empty() && !errors[i].is_zero();
    const bool is_moving =
        std::ranges::any_of(trajectory.pieces, [&](const TrajectoryPiece& piece) {
          return moves(piece.pose[i]) || differs(piece.pose[i], first[i]);
        });
    if (!is_moving && !has_error) continue;
    moving_.push_back(i);
    const Interval error =
        has_error ? enclose_constant(errors[i], "a control error") : Interval(0.0);
    errors_.emplace_back(-error.hi, error.hi);
    certain_errors_.push_back(std::max(error.lo, 0.0));
  }
}

void PathBounds::bound_groups() {
  const std::size_t m = moving_.size();
  auto& pieces = groups_.emplace_back();
  for (const CoordinateBounds& coordinate : coordinates_) pieces.push_back(coordinate.over(0, 1));
  while (groups_.back().size() > m) {
    const std::vector<Interval> below = groups_.back();
    auto& level = groups_.emplace_back();
    for (std::size_t at = 0; at < below.size(); at += 2 * m)
      for (std::size_t k = 0; k < m; ++k)
        level.push_back(at + m + k < below.size() ? hull(below[at + k], below[at + m + k])
                                                  : below[at + k]);
  }
}

Interval PathBounds::over_pieces(std::size_t first, std::size_t count,
                                 std::size_t m) const noexcept {
  std::size_t level = 0;
  while ((std::size_t{1} << level) < count) ++level;
  return groups_[level][(first >> level) * moving_.size() + m];
}

}  // namespace regulus::detail
