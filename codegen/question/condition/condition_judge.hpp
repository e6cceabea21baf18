// SPDX-License-Identifier: GPL-3.0-or-later
// Decides boxes for the search of a condition number.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "codegen/question/condition/box_judge.hpp"
#include "codegen/question/condition/shared_boxes.hpp"

namespace regulus {

/// Decides boxes in several threads, and many boxes at once by workers, too.
class BoxJudges {
 public:
  using Box = BoxJudge::Box;

  /// `threads`: at least 1. `most`: the number of boxes that are usually decided at once.
  BoxJudges(const ConditionQuestion& question, unsigned threads, std::size_t most,
            const BoxSharing& sharing = {});

  /// The findings depend on the arguments alone. `attained`: as for BoxJudge.
  ///
  /// Ensures   false if memory ran out; some findings then know nothing about their boxes.
  /// Throws    the exceptions of the workers.
  [[nodiscard]] bool judge(std::span<const Box> boxes, std::span<BoxFinding> findings,
                           double attained);

 private:
  [[nodiscard]] bool judge_here(std::span<const Box> boxes, std::span<BoxFinding> findings,
                                double attained);

  std::vector<std::unique_ptr<BoxJudge>> judges_;
  SharedBoxes shared_;
};

}  // namespace regulus
