// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/slopes.hpp"

#include <algorithm>

#include "runtime/verifier/derivative.hpp"
#include "runtime/verifier/rounding.hpp"

namespace regulus::verifier {
MatrixSlopes::MatrixSlopes(Question& question)
    : q_(question),
      defined_(question, join({&question.matrix, &question.defined, &question.motion_defined})) {
  std::vector<NodeId> roots;
  for (std::size_t k = 0; k < question.variables.size(); ++k) {
    Differentiator by(question.graph, k);
    SlopesOf slopes{k, {}};
    for (std::size_t e = 0; e < question.matrix.size(); ++e)
      if (const NodeId node = by.of(question.matrix[e]); node != kNoNode) {
        slopes.entries.push_back({e / question.columns, e % question.columns, node});
        roots.push_back(node);
      }
    if (!slopes.entries.empty()) slopes_.push_back(std::move(slopes));
  }
  at_middle_.emplace(q_, q_.matrix);
  over_box_.emplace(q_, roots);
}

bool MatrixSlopes::run(const Box& box, const Middle& middle) {
  if (!defined_.run(box)) return false;
  has_slopes_ = over_box_->run(box) && at_middle_->run(middle.point);
  A_.clear(), dA_.clear(), radius_.clear();
  for (const NodeId entry : q_.matrix)
    A_.push_back(has_slopes_ ? at_middle_->value(entry) : defined_.value(entry));
  for (const SlopesOf& slopes : of()) {
    dA_.emplace_back();
    for (const Slope& slope : slopes.entries) dA_.back().push_back(over_box_->value(slope.node));
    radius_.push_back(middle.radius[slopes.variable]);
    if (!is_moderate(dA_.back())) return false;
  }
  return is_moderate(A_) && is_moderate(radius_);
}

bool is_moderate(const std::vector<Interval>& values) {
  return std::all_of(values.begin(), values.end(), [](Interval x) { return mag(x) <= kLargest; });
}

}  // namespace regulus::verifier
