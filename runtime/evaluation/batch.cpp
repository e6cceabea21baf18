// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/batch.hpp"

#include "runtime/regularity/determinant.hpp"

namespace regulus::detail {
namespace {

/// Returns the common part of two enclosures of the same numbers.
Interval both(Interval x, Interval y) noexcept { return intersect(x, y).value_or(x); }

/// Expansion takes far more work, and adds little if elimination finds its pivots.
Interval enclose_both_ways(const LaneMatrix& M) noexcept {
  const Interval eliminated = enclose_determinant_by_elimination(M);
  const bool expand = M.n <= kMaxExpansion && certain_sign(eliminated) == 0;
  return expand ? both(eliminated, enclose_determinant(M)) : eliminated;
}

}  // namespace

Batch::Batch(const Problem& problem, const Settings& settings, const RowStructure& structure,
             bool for_easy_boxes)
    : alpha_(problem.alpha),
      plan_(make_plan(problem, settings)),
      order_(problem.kernel->columns + structure.rows.size()),
      lanes_(problem),
      pose_(lanes_),
      midpoint_(lanes_),
      matrix_(lanes_, plan_.form),
      derivatives_(lanes_, midpoint_, plan_),
      product_(lanes_, midpoint_, derivatives_, matrix_, plan_),
      first_order_(lanes_, midpoint_, product_, derivatives_, plan_),
      closed_form_(lanes_, plan_),
      impact_({lanes_, midpoint_, matrix_, product_, derivatives_, first_order_, expansion_,
               closed_form_},
              plan_, order_),
      vector_(order_ * kLanes),
      candidate_vector_(order_ * kLanes) {
  if (structure.is_known())
    expansion_.emplace(lanes_, midpoint_, product_, structure, plan_, for_easy_boxes);
}

void Batch::clear() noexcept {
  lanes_.clear();
  pose_.forget();
  midpoint_.forget();
  derivatives_.forget();
  product_.forget();
  first_order_.forget();
  if (expansion_) expansion_->forget();
  closed_form_.forget();
  impact_.forget();
}

LaneMask Batch::certain_by_orthants(LaneMask lanes, unsigned halvings) noexcept {
  if (lanes == 0) return 0;
  return expansion_->certain_by_orthants(impact_.approx_right_vector(), lanes, halvings);
}

/// Bounds det A directly, and as det(K·A)/det K: near I, entries depend less on each other.
std::optional<Interval> Batch::determinant(std::size_t lane, bool scaled) noexcept {
  LaneMask defined = certain_posed() & 1U << lane;
  const ConstIntervalMatrix A = product({}, defined);
  if (defined == 0) return std::nullopt;
  Interval result = enclose_both_ways(matrix_of_lane(A, lane));
  LaneMask left = defined;
  const ConstIntervalMatrix KA = product({ProductForm::Side::kLeft, false}, left);
  const Interval K = left != 0 ? preconditioner_determinant(lane) : Interval(0.0);
  if (left != 0 && !contains_zero(K))
    result = both(result, enclose_both_ways(matrix_of_lane(KA, lane)) / K);
  return scaled ? result * row_scale(lane) : result;
}

bool Batch::certain_above_threshold(std::size_t lane, double lower) noexcept {
  if (!(lower > 0.0) || !has_lane(certain_posed(), lane)) return false;
  return alpha_.hi == 0.0 || mul_rd(lower, row_scale(lane).lo) > alpha_.hi;
}

void Batch::keep_vector(LaneMask lanes, std::size_t entries) noexcept {
  for_each_lane(lanes, [this, entries](std::size_t lane) {
    for (std::size_t i = 0; i < entries; ++i)
      vector_[point_at(i, lane)] = candidate_vector_[point_at(i, lane)];
  });
}

void Batch::learn_from_root() noexcept {
  pose_.learn_from_root();
  lanes_.fix_from(plan_.splittable);
}

void Batch::forget_root() noexcept {
  clear();
  pose_.forget_root();
  if (expansion_) expansion_->forget_root();
  lanes_.fix_none();
}

}  // namespace regulus::detail
