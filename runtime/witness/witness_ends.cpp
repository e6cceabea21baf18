// SPDX-License-Identifier: Apache-2.0
// Points at the ends of ranges themselves. If an end is not a double, it lies between two doubles.
// At both the determinant may have one sign, and be 0 at the end. Bounds in doubles show if that is
// possible; exact algebra shows if it is so.
#include <algorithm>
#include <utility>

#include "runtime/witness/witness_search.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kMaxCornerVariables = 6;

}  // namespace

/// Sets a coordinate of box_. If a range has no double, uses its lower end.
///
/// Ensures   box_[variable] encloses the end: it lies between the outer and the inner one.
void WitnessSearch::place_at(std::size_t variable, PlaceInRange place) noexcept {
  const Interval& outer = problem_.outer[variable];
  const std::optional<Interval>& inner = inner_[variable];
  places_[variable] = inner ? place : PlaceInRange::kLowerEnd;
  box_[variable] = !inner                             ? outer
                   : place == PlaceInRange::kUpperEnd ? Interval(inner->hi, outer.hi)
                                                      : Interval(outer.lo, inner->lo);
}

/// Returns true if the model is defined and the constraints hold all over box_, which is loaded.
bool WitnessSearch::holds_box() noexcept {
  points_.clear();
  points_.load(0, box_);
  evaluate_points(1);
  LaneMask defined = points_.certain_inside() & points_.certain_posed() & 1U;
  static_cast<void>(points_.product({}, defined));
  return defined != 0;
}

/// Tests the point in box_ exactly, if the model is defined and the constraints hold there.
void WitnessSearch::try_exactly() noexcept {
  if (!holds_box()) return;
  const Interval determinant = enclose_at(0, scaled_, Effort::kAll);
  const Interval small(-problem_.alpha.hi, problem_.alpha.hi);
  const std::optional<Interval> left = intersect(determinant, small);
  if (!left || !algebra_->is_singular_at(box_, places_)) return;
  std::copy(box_.begin(), box_.end(), at_ends_.begin());
  numbers_.clear();
  determinant_at_ends_ = *left;
  reason_ = Reason::kSmallDeterminant;
  found_ = found_at_ends_ = true;
}

void WitnessSearch::look_at_exact_corners() noexcept {
  if (found_ || !square_ || algebra_ == nullptr || !uses_corners_) return;
  const std::size_t corners = std::size_t{1} << std::min(variables_, kMaxCornerVariables);
  for (std::size_t corner = 0; corner < corners && !found_; ++corner) {
    for (std::size_t k = 0; k < variables_; ++k)
      place_at(k, (corner >> (k % kMaxCornerVariables) & 1U) != 0 ? PlaceInRange::kUpperEnd
                                                                  : PlaceInRange::kLowerEnd);
    try_exactly();
  }
}

void WitnessSearch::look_at_ends(std::span<const Interval> box) noexcept {
  if (found_ || !square_ || algebra_ == nullptr) return;
  bool at_end = false;
  for (std::size_t k = 0; k < variables_; ++k) {
    const bool lower = box[k].lo == problem_.outer[k].lo, upper = box[k].hi == problem_.outer[k].hi;
    at_end = at_end || lower != upper;
    if (lower != upper || !inner_[k]) {
      place_at(k, upper && !lower ? PlaceInRange::kUpperEnd : PlaceInRange::kLowerEnd);
    } else {
      places_[k] = PlaceInRange::kInside;
      box_[k] = within_inner(k, mid(box[k]));
    }
  }
  if (at_end) try_exactly();
}

void WitnessSearch::look_for_exact_place(std::span<const Interval> box) noexcept {
  if (found_ || algebra_ == nullptr || !uses_descents_ || scaled_) return;
  std::optional<ExactPlace> place = algebra_->find_singular(box);
  if (!place) return;
  std::copy(place->variables.begin(), place->variables.end(), box_.begin());
  if (!holds_box()) return;
  at_ends_ = std::move(place->variables);
  places_ = std::move(place->places);
  numbers_ = std::move(place->numbers);
  determinant_at_ends_ = Interval(0.0);
  reason_ = square_ ? Reason::kSmallDeterminant : Reason::kLostRank;
  found_ = found_at_ends_ = true;
}

/// The inner range of a ball's coordinate is a side of a cube in the ball.
bool WitnessSearch::is_in_ranges(std::span<const Interval> box) const noexcept {
  for (std::size_t k = 0; k < variables_; ++k) {
    const std::optional<Interval>& inner = problem_.inner[k];
    if (!(inner ? certain_subset(box[k], *inner) : box[k] == problem_.outer[k])) return false;
  }
  return true;
}

void WitnessSearch::look_for_null_vector(std::span<const Interval> box) noexcept {
  if (found_ || algebra_ == nullptr || !uses_descents_ || scaled_) return;
  std::optional<EnclosedPlace> place = algebra_->enclose_singular(box);
  if (!place || !is_in_ranges(place->variables)) return;
  for (const std::uint32_t k : place->chosen)
    if (!problem_.inner[k]) return;  // its one value is no unknown
  std::copy(place->variables.begin(), place->variables.end(), box_.begin());
  if (!holds_box()) return;
  determinant_at_ends_ = square_ ? enclose_at(0, false, Effort::kElimination) : Interval(0.0);
  enclosed_ = std::move(*place);
  reason_ = Reason::kNullVector;
  found_ = found_at_ends_ = true;
}

void WitnessSearch::report_ends(WitnessPoint& into) {
  const bool is_enclosed = reason_ == Reason::kNullVector;
  into.variables = is_enclosed ? enclosed_.variables : at_ends_;
  into.places = is_enclosed ? std::vector<PlaceInRange>() : places_;
  into.numbers = is_enclosed ? std::vector<ExactNumber>() : numbers_;
  into.null_vector = is_enclosed ? enclosed_.null_vector : std::vector<Interval>();
  into.chosen = is_enclosed ? enclosed_.chosen : std::vector<std::uint32_t>();
  into.determinant = determinant_at_ends_;
  copy_pose(into.variables, into.pose);
}

}  // namespace regulus::detail
