// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/paving_verdict.hpp"

namespace regulus::detail {

void keep_poses_out_of_reach(const SearchSubject& p, const Volumes& volumes, Result& result) {
  const bool claims_all =
      result.verdict == Verdict::kNoSingularity || result.reason == Reason::kEmptyVariety;
  if (!p.labels.where.empty() || !claims_all || volumes.unreachable_box().empty()) return;
  result.verdict = Verdict::kPossibleProblem;
  result.reason = Reason::kUndefined;
  result.blocking_box = volumes.unreachable_box();
}

}  // namespace regulus::detail
