// SPDX-License-Identifier: GPL-3.0-or-later
// Decides boxes for the search of a condition number.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "codegen/bound/condition_test.hpp"

namespace regulus::inline bounding {

/// The question for a kernel of the matrix with derivatives of its entries.
struct ConditionQuestion {
  const Problem& problem;
  const MatrixScaling& scaling;  ///< of the kernel's matrix
};

/// A pose of the variety and values of the uncertain quantities, with vectors that show κ there.
struct ConditionWitness {
  std::vector<Interval> variables;  ///< thin, or enclosing the only value
  StretchedVectors shown;
};

/// The result for one box. It depends on the box alone, but for `attained`.
struct BoxFinding {
  bool is_outside = false, is_undefined = false;
  ConditionBound bound{};
  std::optional<ConditionWitness> attained{};
};

/// Decides boxes in several threads.
class BoxJudges {
 public:
  using Box = BoxMatrices::Box;

  /// `threads`: at least 1. `most`: the number of boxes that are usually decided at once.
  BoxJudges(const ConditionQuestion& question, unsigned threads, std::size_t most);
  ~BoxJudges();
  BoxJudges(const BoxJudges&) = delete;
  BoxJudges& operator=(const BoxJudges&) = delete;

  /// `attained`: a smaller κ is of no use; infinite: no κ is.
  ///
  /// Ensures   false if memory ran out; some findings then know nothing about their boxes.
  [[nodiscard]] bool judge(std::span<const Box> boxes, std::span<BoxFinding> findings,
                           double attained);

 private:
  class Judge;
  std::vector<std::unique_ptr<Judge>> judges_;
};

}  // namespace regulus::bounding
