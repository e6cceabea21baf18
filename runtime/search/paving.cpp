// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/paving.hpp"

#include <algorithm>

namespace regulus {
namespace {

/// A range between neighbouring doubles is a single value: it is never split.
bool is_single_value(Interval x) noexcept { return !bisect(x).has_value(); }

/// The boxes overlap only in their faces, so their true volumes add up to at most the total. Sums
/// of rounded bounds may exceed it.
Interval at_most_one(Interval x) noexcept {
  return intersect(x, Interval(0.0, 1.0)).value_or(Interval(0.0, 1.0));
}

}  // namespace

Claim claim_of(Rule rule) noexcept {
  switch (rule) {
    case Rule::kOutside:
      return Claim::kOutside;
    case Rule::kWitness:
      return Claim::kSingular;
    case Rule::kBlocked:
    case Rule::kFilter:  // a filter is not checked, so it gives no claim
      return Claim::kUndecided;
    case Rule::kHMatrix:
    case Rule::kMeanValue:
    case Rule::kSecondOrder:
    case Rule::kOrthants:
    case Rule::kDeterminant:
    case Rule::kElimination:
    case Rule::kRohn:
    case Rule::kClosedForm:
    case Rule::kMultiprecision:
      return Claim::kFree;
  }
  return Claim::kUndecided;
}

const char* name(Claim claim) noexcept {
  switch (claim) {
    case Claim::kFree:
      return "free";
    case Claim::kSingular:
      return "singular";
    case Claim::kUndecided:
      return "undecided";
    case Claim::kOutside:
      return "outside";
    case Claim::kUnreachable:
      return "unreachable";
  }
  return "";
}

LeafClaims::LeafClaims(const Problem& problem, std::size_t reach)
    : problem_(problem),
      reach_(reach),
      box_(problem.outer),
      lanes_(problem_),
      outputs_(2 * kLanes * std::max(problem.kernel->constraints, 1U)) {}

Claim LeafClaims::of(std::span<const Interval> box, Rule rule) noexcept {
  if (rule != Rule::kOutside || reach_ == 0) return claim_of(rule);
  lanes_.clear();
  std::copy(box.begin(), box.end(), box_.begin());
  lanes_.load(0, box_);
  lanes_.seal(1);
  const LaneMask defined =
      lanes_.call(problem_.kernel->constraint, lanes_.boxes(), nullptr, outputs_.get());
  for (std::size_t h = 0; has_lane(defined, 0) && h < reach_; ++h)
    if (outputs_[lower_at(h, 0)] > 0.0) return Claim::kUnreachable;
  return Claim::kOutside;
}

Volumes::Volumes(const Problem& problem, std::size_t reach)
    : problem_(problem), claims_(problem, reach) {
  for (std::size_t k = 0; k < problem.kernel->motion_variables; ++k)
    if (!is_single_value(problem.outer[k])) axes_.push_back(k);
  total_ = volume(problem.outer);
}

Interval Volumes::volume(std::span<const Interval> box) const noexcept {
  Interval product(1.0);
  for (const std::size_t k : axes_) {
    const auto& inner = problem_.inner[k];
    const std::optional<Interval> within = inner ? intersect(*inner, box[k]) : std::nullopt;
    const double least = within ? sub_rd(within->hi, within->lo) : 0.0;
    product = product * Interval(least, width_ru(box[k]));
  }
  return product;
}

void Volumes::add(Claim claim, std::span<const Interval> box) noexcept {
  Share& share = shares_[static_cast<std::size_t>(claim)];
  if (claim == Claim::kUnreachable && share.boxes == 0)
    unreachable_box_.assign(box.begin(), box.end());
  ++share.boxes;
  share.volume += volume(box);
}

void Volumes::on_open(const OpenBox& box) noexcept {
  add(Claim::kUndecided, box.box);
  ++unfinished_.boxes;
  unfinished_.volume += volume(box.box);
}

Interval Volumes::fraction(const Share& share) const noexcept {
  if (share.boxes == 0) return Interval(0.0);
  return at_most_one(share.volume / total_);
}

}  // namespace regulus
