// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/paving.hpp"

#include <algorithm>

#include "runtime/search/leaf_claims.hpp"

namespace regulus {

using namespace detail;

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

Volumes::Volumes(const Problem& problem, std::size_t reach)
    : problem_(problem), claims_(std::make_unique<LeafClaims>(problem, reach)) {
  for (std::size_t k = 0; k < problem.kernel->motion_variables; ++k)
    if (!is_single_value(problem.outer[k])) axes_.push_back(k);
  total_ = volume(problem.outer);
}

Volumes::~Volumes() = default;

void Volumes::on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept {
  add(claims_->of(box.box, rule), box.box);
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

Interval Volumes::workspace_fraction() const noexcept {
  const Interval inside = fraction(workspace_->inside), outside = fraction(workspace_->outside);
  const double most = sub_ru(1.0, outside.lo);
  return {std::min(inside.lo, most), most};
}

Interval Volumes::fraction(const Share& share) const noexcept {
  if (share.boxes == 0) return Interval(0.0);
  return at_most_one(share.volume / total_);
}

}  // namespace regulus
