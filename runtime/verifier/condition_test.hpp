// SPDX-License-Identifier: Apache-2.0
// The test that the condition number in the 2-norm is below the bound all over a box. PROOF.md,
// "The condition number in the 2-norm", derives it.
#pragma once

#include "runtime/verifier/rotated_terms.hpp"

namespace regulus::verifier {

class ConditionTest {
 public:
  /// Adds derivatives to the question's graph. Throws Unfinished if the bound has no value.
  ///
  /// Requires  the matrix of the question has at least as many rows as columns.
  ConditionTest(Question& question, const Variety& variety);

  [[nodiscard]] BoxAnswer decide(const Box& box);

  /// After BoxAnswer::kOpen: returns the variable that is best to split; nullopt if none can be
  /// split.
  [[nodiscard]] std::optional<std::size_t> variable_to_split(const Box& box) const {
    return variable_of_impact(variety_, box, impact_);
  }

  /// Returns true only if the matrix is singular at the point, or the condition number is at least
  /// the bound. A coordinate may be an interval around the one value of its range.
  [[nodiscard]] bool exceeds_at(const Box& point) const;

 private:
  [[nodiscard]] std::optional<RotatedMatrix> rotated(const Box& box, const SingularBases& bases);

  const Question& q_;
  const Variety& variety_;
  const std::size_t m_, n_;
  Interval bound_;
  MatrixSlopes slopes_;
  RotatedTerms terms_;
  Outside outside_;
  Evaluation defined_, at_middle_;

  // For one box.
  Middle middle_;
  std::vector<double> impact_;
};

}  // namespace regulus::verifier
