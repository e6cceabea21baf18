// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/branch_test.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/verifier/derivative.hpp"
#include "runtime/verifier/outside.hpp"
#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/slopes.hpp"

namespace regulus::verifier {
namespace {

constexpr int kMostSteps = 30;
constexpr double kSmallStep = 0x1p-36;    ///< of Newton's method, in parts of the scale
constexpr double kSmallRadius = 0x1p-20;  ///< of a small box, in parts of the scale

std::vector<Interval> points_of(const std::vector<double>& numbers) {
  std::vector<Interval> result;
  for (const double x : numbers) result.push_back(point(x));
  return result;
}

Box joined(const Box& places, const std::vector<Interval>& unknowns) {
  Box box = places;
  box.insert(box.end(), unknowns.begin(), unknowns.end());
  return box;
}

std::vector<Interval> about(const std::vector<double>& middle, const std::vector<double>& radius) {
  std::vector<Interval> box;
  for (std::size_t i = 0; i < middle.size(); ++i)
    box.push_back(point(middle[i]) + Interval{-radius[i], radius[i]});
  return box;
}

}  // namespace

BranchTest::BranchTest(Question& q, bool moves)
    : q_(q),
      moves_(moves),
      m_(q.variables.size()),
      n_(q.closure->equations.size()),
      all_(m_ + n_),
      first_(n_ * all_, kNoNode) {
  const std::vector<NodeId>& equations = q.closure->equations;
  std::vector<Differentiator> by;
  for (std::size_t k = 0; k < all_; ++k) by.emplace_back(q.graph, k);
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t k = moves ? 0 : m_; k < all_; ++k)
      first_[j * all_ + k] = by[k].of(equations[j]);
  const std::vector<NodeId> kinks = kinks_of(q.graph, first_);
  try {
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t k = 0; k < all_; ++k)
        for (std::size_t l = k; l < all_; ++l) {
          const NodeId first = first_[j * all_ + k];
          second_.push_back(first == kNoNode ? kNoNode : by[l].of(first));
        }
    rates_.emplace(q, second_);
  } catch (const Unfinished&) {
    second_.clear();  // too many operations; the test of first order needs none of them
  }
  equations_.emplace(q, equations);
  derivatives_.emplace(q, first_);
  over_.emplace(q, join({&equations, &first_, &kinks, &q.defined}));
  near_start_.emplace(q, join({&equations, &first_, &kinks}));
  for (std::size_t j = 0; j < n_ && !moves; ++j)
    for (std::size_t k = 0; k < m_; ++k) by_variable_.push_back(by[k].of(equations[j]));
  if (!by_variable_.empty()) rates_at_center_.emplace(q, by_variable_);
}

bool BranchTest::take(Evaluation& evaluation, const std::vector<NodeId>& nodes, const Box& box,
                      Values& values) {
  values.clear();
  if (!is_moderate(box) || !evaluation.run(box)) return false;
  for (const NodeId node : nodes) values.push_back(evaluation.value(node));
  return is_moderate(values);
}

/// Encloses the equations and their derivatives over a small box.
bool BranchTest::take_center(const Box& point) {
  return take(*derivatives_, first_, point, center_) &&
         take(*equations_, q_.closure->equations, point, at_center_);
}

/// Takes K ≈ Φ_p⁻¹ at the middle of a small box (any other K would be as sound), and bounds KΦ and
/// the derivatives over it.
bool BranchTest::bound_center(const Box& point) {
  if (!take_center(point)) return false;
  std::vector<double> A;
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t l = 0; l < n_; ++l) A.push_back(mid(center_[j * all_ + m_ + l]));
  if (!approx_left_inverse(A, n_, n_, K_) || !is_moderate(K_)) return false;
  value_.clear();
  for (std::size_t i = 0; i < n_; ++i) value_.push_back(times_inverse(i, at_center_, 1, 0));
  if (rates_at_center_) narrow_values(point);
  return true;
}

/// KΦ(x, c) is in KΦ(x̄, c) + KΦ_x(X, c)(x − x̄), where what equations have in common cancels.
void BranchTest::narrow_values(const Box& point) {
  Box middle = point;
  for (std::size_t k = 0; k < m_; ++k) middle[k] = verifier::point(mid(point[k]));
  Values rates, values;
  if (!take(*rates_at_center_, by_variable_, point, rates) ||
      !take(*equations_, q_.closure->equations, middle, values))
    return;
  for (std::size_t i = 0; i < n_; ++i) {
    Interval sum = times_inverse(i, values, 1, 0);
    for (std::size_t k = 0; k < m_; ++k)
      sum = sum + times_inverse(i, rates, m_, k) * (point[k] - middle[k]);
    if (is_bounded(sum))
      value_[i] = {std::max(value_[i].lo, sum.lo), std::min(value_[i].hi, sum.hi)};
  }
}

/// Row i of K times a column.
Interval BranchTest::times_inverse(std::size_t i, const Values& columns, std::size_t count,
                                   std::size_t at) const {
  Interval sum;
  for (std::size_t j = 0; j < n_; ++j) sum = sum + K_[j * n_ + i] * columns[j * count + at];
  return sum;
}

/// |K·M − (0, I)|, entry i, k.
double BranchTest::left_side(std::size_t i, const Values& M, std::size_t k) const {
  const Interval entry = times_inverse(i, M, all_, k);
  return mag(k == m_ + i ? entry - point(1.0) : entry);
}

std::vector<Interval> BranchTest::middle_of(const TubeNumbers& tube, const Box& box) const {
  std::vector<Interval> result;
  for (std::size_t i = 0; i < n_; ++i) {
    Interval sum = point(tube[m_ + i]);
    for (std::size_t k = 0; k < m_; ++k) sum = sum + slope(tube, i, k) * (box[k] - point(tube[k]));
    result.push_back(sum);
  }
  return result;
}

/// The derivatives by variables become those along the tube: Φ_x + Φ_p S.
BranchTest::Values BranchTest::along(const TubeNumbers& tube, Values derivatives) const {
  for (std::size_t row = 0; row < derivatives.size(); row += all_)
    for (std::size_t k = 0; k < m_; ++k)
      for (std::size_t l = 0; l < n_; ++l)
        derivatives[row + k] = derivatives[row + k] + slope(tube, l, k) * derivatives[row + m_ + l];
  return derivatives;
}

/// Bounds how much each entry of K times along(derivatives) changes from the centre to any point of
/// the tube. Both derivatives are along the tube.
std::vector<double> BranchTest::changes(const TubeNumbers& tube,
                                        const std::vector<double>& reach) const {
  std::vector<Values> rates(all_, Values(n_ * all_));  // by the first direction
  std::size_t next = 0;
  for (std::size_t j = 0; j < n_; ++j) {
    Values square(all_ * all_), turned(all_ * all_);
    for (std::size_t k = 0; k < all_; ++k)
      for (std::size_t l = k; l < all_; ++l)
        square[k * all_ + l] = square[l * all_ + k] = second_values_[next++];
    square = along(tube, std::move(square));
    for (std::size_t k = 0; k < all_; ++k)
      for (std::size_t l = 0; l < all_; ++l) turned[l * all_ + k] = square[k * all_ + l];
    turned = along(tube, std::move(turned));
    for (std::size_t k = 0; k < all_; ++k)
      for (std::size_t l = 0; l < all_; ++l) rates[k][j * all_ + l] = turned[k * all_ + l];
  }
  std::vector<double> result(n_ * all_);
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t k = 0; k < all_; ++k) {
      Interval sum;
      for (std::size_t l = 0; l < all_; ++l)
        sum = sum + point(mag(times_inverse(i, rates[l], all_, k))) * point(reach[l]);
      result[i * all_ + k] = sum.hi;
    }
  return result;
}

/// Compares the left side of the test with r, and |E|r with r.
bool BranchTest::is_in(const TubeNumbers& tube, const std::vector<double>& reach,
                       bool is_second_order) {
  const Values over = along(tube, first_values_), center = along(tube, center_);
  std::vector<double> change;
  if (is_second_order) change = changes(tube, reach);
  impact_.assign(m_, 0.0);
  bool is_proved = true;
  for (std::size_t i = 0; i < n_; ++i) {
    Interval sum = point(mag(value_[i])), contraction;
    for (std::size_t k = 0; k < all_; ++k) {
      double all = left_side(i, over, k), mean = all;
      if (is_second_order) {
        const Interval at_center = point(left_side(i, center, k));
        mean = std::min(mean, (at_center + 0.5 * point(change[i * all_ + k])).hi);
        all = std::min(all, (at_center + point(change[i * all_ + k])).hi);
      }
      const Interval part = point(mean) * point(reach[k]);
      sum = sum + part;
      if (k >= m_) contraction = contraction + point(all) * point(reach[k]);
      if (k < m_) impact_[k] = std::max(impact_[k], part.hi / reach[m_ + i]);
    }
    is_proved = is_proved && sum.hi < reach[m_ + i] && contraction.hi < reach[m_ + i];
  }
  return is_proved;
}

Interval BranchTest::difference(std::size_t i, std::size_t j) const {
  if (tube_ == nullptr) return whole_[m_ + i] - whole_[m_ + j];
  const double rest = (point(radius_of(*tube_)[i]) + point(radius_of(*tube_)[j])).hi;
  Interval sum = middle_[i] - middle_[j] + Interval{-rest, rest};
  for (std::size_t k = 0; k < m_; ++k)
    sum = sum + (point(slope(*tube_, i, k)) - point(slope(*tube_, j, k))) * step_[k];
  return sum;
}

bool BranchTest::has_one_solution(const Box& box, const TubeNumbers& tube) {
  impact_.clear();
  tube_ = &tube;
  has_rates_ = false;
  if (!moves_) return false;
  const std::span<const double> radius = radius_of(tube);
  const bool is_tube = std::ranges::all_of(radius, [](double r) { return r > 0.0; });
  if (!is_tube || !is_moderate(tube) || !is_moderate(box)) return false;
  // The same tube with the middle of the box in the place of x₀.
  Box middle;
  step_.clear();
  std::vector<double> reach;
  for (const Interval x : box) {
    middle.push_back(point(mid(x)));
    step_.push_back(x - middle.back());
    reach.push_back(mag(step_.back()));
  }
  reach.insert(reach.end(), radius.begin(), radius.end());
  middle_ = middle_of(tube, middle);
  std::vector<Interval> unknowns;
  for (std::size_t i = 0; i < n_; ++i) {
    Interval p = middle_[i] + Interval{-radius[i], radius[i]};
    for (std::size_t k = 0; k < m_; ++k) p = p + slope(tube, i, k) * step_[k];
    unknowns.push_back(p);
  }
  whole_ = joined(box, unknowns);
  if (!bound_center(joined(middle, middle_)) || !take(*over_, first_, whole_, first_values_))
    return false;
  if (is_in(tube, reach, false)) return true;
  return take_rates() && is_in(tube, reach, true);
}

bool BranchTest::take_rates() {
  has_rates_ = has_rates_ || (rates_ && take(*rates_, second_, whole_, second_values_));
  return has_rates_;
}

Interval BranchTest::rate(std::size_t equation, std::size_t unknown, std::size_t k) const {
  Interval sum = second_at(equation, k, m_ + unknown);
  for (std::size_t i = 0; i < n_ && k < m_; ++i)
    sum = sum + slope(*tube_, i, k) * second_at(equation, m_ + i, m_ + unknown);
  return sum;
}

bool BranchTest::has_no_solution(const Box& place, const TubeNumbers& tube) {
  if (!is_moderate(tube)) return false;
  const std::span<const double> radius = radius_of(tube);
  const std::vector<Interval> center = middle_of(tube, place);
  std::vector<Interval> unknowns;
  for (std::size_t i = 0; i < n_; ++i)
    unknowns.push_back(center[i] + Interval{-radius[i], radius[i]});
  if (!bound_center(joined(place, center)) ||
      !take(*over_, first_, joined(place, unknowns), first_values_))
    return false;
  // KΦ(x, c + ρ) is in KΦ(x, c) + KΦ_p ρ: is it different from 0 in some component?
  for (std::size_t i = 0; i < n_; ++i) {
    Interval most;
    for (std::size_t l = 0; l < n_; ++l)
      most = most + point(mag(times_inverse(i, first_values_, all_, m_ + l))) * point(radius[l]);
    if (mig(value_[i]) > most.hi) return true;
  }
  return false;
}

/// Φ(x, c) + M(p − c) = 0 with M = mean_derivatives(), as it is and times K.
bool BranchTest::narrow_to_solutions(const Box& places, Box& unknowns) {
  shares_.clear();
  std::vector<double> center;
  for (const Interval x : unknowns) center.push_back(mid(x));
  const Box middle = joined(places, points_of(center)), all = joined(places, unknowns);
  if (!take_center(middle) || !take(*over_, first_, all, first_values_)) return true;
  if (!rates_ || !take(*rates_, second_, all, second_values_)) second_values_.clear();
  std::vector<Interval> step;
  for (std::size_t k = 0; k < n_; ++k) step.push_back(unknowns[k] - point(center[k]));
  const Values M = mean_derivatives(step);
  shares_.assign(n_, 0.0);
  for (std::size_t i = 0; i < n_; ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < n_; ++k) sum += mag(M[i * n_ + k]) * mag(step[k]);
    for (std::size_t k = 0; k < n_ && sum > 0.0; ++k)
      shares_[k] += mag(M[i * n_ + k]) * mag(step[k]) / sum;
  }
  if (!narrow_by_rows(at_center_, M, center, unknowns)) return false;
  if (!bound_center(middle)) return true;
  Values product;
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t l = 0; l < n_; ++l) product.push_back(times_inverse(i, M, n_, l));
  return narrow_by_rows(value_, product, center, unknowns);
}

bool BranchTest::has_one_solution(const Box& place, const std::vector<double>& middle,
                                  const std::vector<double>& outer,
                                  const std::vector<double>& inner) {
  return has_one_in_box(*over_, place, middle, outer, inner);
}

bool BranchTest::has_one_start(const Box& place, const std::vector<double>& middle,
                               const std::vector<double>& outer, const std::vector<double>& inner) {
  return has_one_in_box(*near_start_, place, middle, outer, inner);
}

bool BranchTest::has_one_in_box(Evaluation& over, const Box& place,
                                const std::vector<double>& middle, const std::vector<double>& outer,
                                const std::vector<double>& inner) {
  whole_ = joined(place, about(middle, outer));
  tube_ = nullptr;
  has_rates_ = false;
  if (!is_moderate(outer) || !bound_center(joined(place, points_of(middle))) ||
      !take(over, first_, whole_, first_values_))
    return false;
  if (is_in_box(outer, inner, false)) return true;
  return rates_ && take(*rates_, second_, whole_, second_values_) && is_in_box(outer, inner, true);
}

/// The same for a tube that does not move.
bool BranchTest::is_in_box(const std::vector<double>& outer, const std::vector<double>& inner,
                           bool is_second_order) const {
  for (std::size_t i = 0; i < n_; ++i) {
    Interval sum = point(mag(value_[i])), contraction;
    for (std::size_t l = 0; l < n_; ++l) {
      double all = left_side(i, first_values_, m_ + l), mean = all;
      if (is_second_order) {
        Interval change;
        for (std::size_t k = 0; k < n_; ++k) {
          Interval rate;
          for (std::size_t j = 0; j < n_; ++j) rate = rate + inverse(i, j) * second(j, k, l);
          change = change + point(mag(rate)) * point(outer[k]);
        }
        const Interval at_center = point(left_side(i, center_, m_ + l));
        mean = std::min(mean, (at_center + 0.5 * change).hi);
        all = std::min(all, (at_center + change).hi);
      }
      sum = sum + point(mean) * point(outer[l]);
      contraction = contraction + point(all) * point(outer[l]);
    }
    if (!(sum.hi < inner[i] && inner[i] <= outer[i] && contraction.hi < outer[i])) return false;
  }
  return true;
}

std::optional<SolutionBox> BranchTest::solution_near(const Box& place, std::vector<double> start,
                                                     std::span<const double> scale) {
  SolutionBox solution{std::move(start), std::vector<double>(n_)};
  std::vector<double>& p = solution.middle;
  bool is_small = false;
  for (int step = 0; step < kMostSteps && !is_small; ++step) {
    if (!bound_center(joined(place, points_of(p)))) return std::nullopt;
    is_small = true;
    for (std::size_t i = 0; i < n_; ++i) {
      const double correction = mid(value_[i]);
      is_small = is_small && std::fabs(correction) <= kSmallStep * scale[i];
      p[i] -= correction;
    }
  }
  if (!bound_center(joined(place, points_of(p)))) return std::nullopt;
  for (std::size_t i = 0; i < n_; ++i)
    solution.radius[i] = 2.0 * mag(value_[i]) + kSmallRadius * scale[i];
  if (!has_one_solution(place, p, solution.radius, solution.radius)) return std::nullopt;
  return solution;
}

Place BranchTest::place_of(const SolutionBox& solution, const TubeNumbers& tube,
                           const Box& place) const {
  const std::vector<Interval> middle = middle_of(tube, place);
  const std::span<const double> radius = radius_of(tube);
  const std::vector<Interval> box = about(solution.middle, solution.radius);
  bool is_inside = true;
  for (std::size_t i = 0; i < n_; ++i) {
    const Interval distance = box[i] - middle[i];
    if (is_bounded(distance) && mig(distance) > radius[i]) return Place::kOutside;
    is_inside = is_inside && mag(distance) <= radius[i];
  }
  return is_inside ? Place::kInside : Place::kUnknown;
}

}  // namespace regulus::verifier
