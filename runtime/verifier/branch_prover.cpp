// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/branch_prover.hpp"

#include <algorithm>
#include <utility>

namespace regulus::verifier {
namespace {

/// The slopes of a part are others than those of the tube's middle line.
constexpr double kPartOfRadius = 4.0;

/// `whole`: of as many coordinates; empty: nothing is in it.
bool are_in(const Box& part, const Box& whole) {
  return !whole.empty() && std::ranges::equal(part, whole, [](Interval x, Interval y) {
    return y.lo <= x.lo && x.hi <= y.hi;
  });
}

}  // namespace

bool BranchProver::holds(LeafClaim claim) {
  if (!quantity_ || claim == LeafClaim::kBranch) return true;
  return claim == LeafClaim::kInfeasible ? quantity_->attains_bound(test_)
                                         : quantity_->keeps_bound(test_);
}

/// A bound is claimed at the points of the set. The tube itself is shown all over the leaf.
bool BranchProver::needs_no_bound(const Box& box, LeafClaim claim) {
  return quantity_ && claim != LeafClaim::kInfeasible && outside_.covers(box);
}

/// Its middle line is parallel, through the solution in the middle of the box. Its radius becomes less as the
/// box does.
bool BranchProver::has_narrower_tube(const Box& box) {
  Box middle;
  for (const Interval x : box) middle.push_back(point(mid(x)));
  const std::vector<Interval> line = test_.middle_of(*tube_, middle);
  const std::span<const double> radius = test_.radius_of(*tube_);
  std::vector<double> near;
  for (const Interval p : line) near.push_back(mid(p));
  const auto solution = test_.solution_near(middle, std::move(near), radius);
  if (!solution) return false;
  double part = 0.0;
  for (std::size_t k = 0; k < box.size(); ++k)
    if (shown_[k].lo < shown_[k].hi)
      part = std::max(part, (box[k].hi - box[k].lo) / (shown_[k].hi - shown_[k].lo));
  narrower_ = *tube_;
  const std::size_t m = box.size(), n = line.size();
  for (std::size_t k = 0; k < m; ++k) narrower_[k] = middle[k].lo;
  for (std::size_t i = 0; i < n; ++i) {
    const double p = solution->middle[i], off = mag(point(p) - line[i]);
    const double room = (point(radius[i]) - point(off)).lo;
    if (!(room > 0.0 && part > 0.0)) return false;
    narrower_[m + i] = p;
    narrower_[narrower_.size() - n + i] = std::min(room, kPartOfRadius * part * radius[i]);
  }
  return test_.has_one_solution(box, narrower_);
}

/// In the halves of a leaf its tube is the same set, so the solutions in them agree at the cut.
BoxAnswer BranchProver::decide(const Box& box, LeafClaim claim) {
  is_hopeless_ = false;
  impact_.assign(box.size(), 0.0);
  if (claim == LeafClaim::kOutside)
    return outside_.covers(box) ? BoxAnswer::kOutside : BoxAnswer::kOpen;
  if (!motion_.run(box)) return BoxAnswer::kOpen;
  const bool has_whole = test_.has_one_solution(box, *tube_);
  if (!test_.impact().empty()) impact_ = test_.impact();
  const bool is_known = are_in(box, shown_);
  if (has_whole && !is_known) shown_ = box;
  if (has_whole && holds(claim)) return BoxAnswer::kProved;
  const bool has_narrower = is_known && has_narrower_tube(box),
             has_tube = has_whole || has_narrower;
  if (has_narrower && holds(claim)) return BoxAnswer::kProved;
  if ((has_tube || is_known) && needs_no_bound(box, claim)) return BoxAnswer::kOutside;
  if (quantity_ && !quantity_->impact().empty() && has_tube) impact_ = quantity_->impact();
  if (has_tube || is_known) return BoxAnswer::kOpen;
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
  if (std::string why = contradiction_in_test(claim); !why.empty()) return why;
  std::vector<double> near;
  for (const Interval p : test_.middle_of(*tube_, point)) near.push_back(mid(p));
  const auto solution = test_.solution_near(point, std::move(near), test_.radius_of(*tube_));
  if (!solution || test_.place_of(*solution, *tube_, point) != Place::kInside) return "";
  return contradiction_in_test(claim);
}

std::string BranchProver::contradiction_in_test(LeafClaim claim) {
  if (claim == LeafClaim::kInfeasible) return quantity_->keeps_bound(test_) ? all_keep_ : "";
  return quantity_->attains_bound(test_) ? "the quantity is beyond the bound" : "";
}

}  // namespace regulus::verifier
