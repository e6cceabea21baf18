// SPDX-License-Identifier: GPL-3.0-or-later
// Proves anew what a saved search of a condition number says about its boxes.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "codegen/question/condition/condition_judge.hpp"
#include "codegen/question/condition/condition_state.hpp"

namespace regulus {

/// The facts about the leaf of a tree, proved by this process.
struct ProvedLeaf {
  bool is_outside = false, is_undefined = false;
  double upper = kInfinity;
  std::vector<double> impact{};  ///< of ConditionBound
};

struct ProvedTree {
  std::vector<ProvedLeaf> leaves;              ///< in the order of ConditionTree::leaves()
  std::optional<ConditionWitness> attained{};  ///< in the box of ConditionState::attained
};

/// Decides every leaf again. A box above it may have a smaller bound, which holds for the leaf, too:
/// while the bound of the text is smaller than what is proved, the next box above is decided as
/// well. So each bound is that of the text if the text is true, and is proved in any case.
///
/// Ensures   nullopt if must_stop() returned true, or if memory ran out.
/// Throws    ConditionStateError as ConditionTree::box() does.
[[nodiscard]] std::optional<ProvedTree> prove_again(const ConditionTree& tree,
                                                    std::optional<BoxId> attained,
                                                    BoxJudges& judges,
                                                    const std::function<bool()>& must_stop);

}  // namespace regulus
