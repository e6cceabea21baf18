// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/branch_prover.hpp"

namespace regulus::verifier {

bool BranchProver::holds(LeafClaim claim) {
  if (!quantity_ || claim == LeafClaim::kBranch) return true;
  return claim == LeafClaim::kInfeasible ? quantity_->attains_bound(test_)
                                         : quantity_->keeps_bound(test_);
}

/// In the halves of a leaf its tube is the same set, so the solutions in them agree at the cut.
BoxAnswer BranchProver::decide(const Box& box, LeafClaim claim) {
  is_hopeless_ = false;
  impact_.assign(box.size(), 0.0);
  if (claim == LeafClaim::kOutside)
    return outside_.covers(box) ? BoxAnswer::kOutside : BoxAnswer::kOpen;
  if (!motion_.run(box)) return BoxAnswer::kOpen;
  const bool has_tube = test_.has_one_solution(box, *tube_);
  if (has_tube && holds(claim)) return BoxAnswer::kProved;
  if (!test_.impact().empty()) impact_ = test_.impact();
  if (quantity_ && !quantity_->impact().empty() && has_tube) impact_ = quantity_->impact();
  if (has_tube) return BoxAnswer::kOpen;
  Box middle;
  for (const Interval x : box) middle.push_back(point(mid(x)));
  is_hopeless_ = !test_.has_one_solution(middle, *tube_);
  return BoxAnswer::kOpen;
}

std::optional<std::size_t> BranchProver::variable_to_split(const Box& box) const {
  if (is_hopeless_) return std::nullopt;
  return variable_of_impact(variety_, box, impact_);
}

std::string BranchProver::contradiction(const Box& point, LeafClaim claim) {
  if (claim == LeafClaim::kOutside) return "there is a pose of the variety";
  if (test_.has_no_solution(point, *tube_)) return "the tube has no configuration";
  if (!quantity_ || claim == LeafClaim::kBranch) return "";
  if (!test_.has_one_solution(point, *tube_)) return "";
  if (claim == LeafClaim::kInfeasible) return quantity_->keeps_bound(test_) ? all_keep_ : "";
  return quantity_->attains_bound(test_) ? "the quantity is beyond the bound" : "";
}

}  // namespace regulus::verifier
