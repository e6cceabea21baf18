// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/leaf_claims.hpp"

#include <algorithm>

namespace regulus::detail {

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

}  // namespace regulus::detail
