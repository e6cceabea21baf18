// SPDX-License-Identifier: GPL-3.0-or-later
// Searches a matrix with atan2 on both sides of its cut (cut_sides.hpp).
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/certificate/cut_sides.hpp"
#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "runtime/proof/tree_kept.hpp"

namespace regulus::detail {

/// What is known of a matrix once all sides are searched.
struct SidesDecision {
  Result result;
  std::vector<TreeKept> trees;  ///< of NO SINGULARITY, by side
};

/// Searches the sides one after another, in the time that is left. NO SINGULARITY: on every side.
/// SINGULARITY: on a side, off its cut, so that the witness is one of the question itself. Returns
/// nullopt if this decides nothing.
///
/// `whole`: of the question itself, which the cut left undecided. Its time becomes longer.
[[nodiscard]] std::optional<SidesDecision> search_sides(const CutSides& sides,
                                                        PreparedSearch& whole, const Result& open,
                                                        const SearchOptions& search,
                                                        const std::atomic<bool>* interrupt,
                                                        Observer* display);

/// Writes the proof of a decision. An empty `path` means none.
[[nodiscard]] ProofStatus certify_sides(const std::string& path, const CutSides& sides,
                                        const PreparedSearch& whole, const SidesDecision& decision,
                                        const ProofPlacing& placing);

}  // namespace regulus::detail
