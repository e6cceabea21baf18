// SPDX-License-Identifier: Apache-2.0
// A system whose complex solutions are counted, with what a theorem says of their number.
#pragma once

#include <memory>

#include "runtime/verifier/complex_root.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

class CountedSystem : public ComplexSystem {
 public:
  /// The number such that no system of this family has more simple solutions, and one that has as many
  /// has no others, neither complex nor real.
  [[nodiscard]] virtual std::size_t most() const = 0;
  /// Returns one system of the family, if its numbers have ranges; nullptr: they have single values.
  [[nodiscard]] virtual const ComplexSystem* one() const = 0;
  /// How many complex numbers a line `root` has.
  [[nodiscard]] virtual std::size_t numbers() const = 0;
  /// Returns where the root is, roughly. `z`: the numbers of the line, n×1.
  [[nodiscard]] virtual ComplexMatrix place_of(const ComplexMatrix& z) const = 0;
  /// Returns a usual size of each unknown about a place.
  [[nodiscard]] virtual std::vector<double> scale_at(const ComplexMatrix& place) const = 0;
  /// Throws Rejection for a root of the equations that is no solution; Unfinished if it may be none.
  virtual void require_solution(const ComplexRoot& root) const = 0;
  /// Tells whether a real root is within the values of a line `solution`.
  [[nodiscard]] virtual Certainty is_within(const ComplexRoot& root,
                                            const SolutionLine& line) const = 0;
  /// Throws Rejection if no solution is within the line.
  virtual void require_possible(const SolutionLine& line) const = 0;
};

/// Returns the equations of the poses of a platform on six legs, for `question.solutions`, enclosed for all
/// values of the variables in `places`. Throws Unfinished for a number without a certain value. The
/// question must outlive it.
[[nodiscard]] std::unique_ptr<CountedSystem> platform_system(Question& question, const Box& places);

}  // namespace regulus::verifier
