// SPDX-License-Identifier: Apache-2.0
// The value of a quantity over a tube of a closure. PROOF.md, "Bounds over a branch", derives it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/verifier/branch_singular_values.hpp"
#include "runtime/verifier/branch_test.hpp"
#include "runtime/verifier/domination.hpp"

namespace regulus::verifier {

/// Returns true for the quantities that have the derivatives of the branch by the motors.
[[nodiscard]] bool has_branch_rates(const std::string& kind);

/// Returns true for a claim about finite errors.
[[nodiscard]] bool is_finite_error(const Question& question);

/// Returns true for a bound over a branch that is attained: its proof is a line `value` and trees.
[[nodiscard]] bool is_attained_bound(const Question& question);

/// Reads from the line `quantity KIND` up to the line after `bound`, and forms the derivatives of the
/// equations by the pose parameters. Throws Rejection.
///
/// Requires  question.closure; the lines of the model and the motion have been read.
void read_branch_quantity_lines(Lines& lines, Question& question);

/// True if a closure has a threshold: FORMAT.md, "Closures". It is a bound of the determinant.
[[nodiscard]] bool has_threshold_of_branch(const Question& question);

/// Makes the threshold of a closure that bound. Throws Unfinished if it may be negative.
///
/// Requires  has_threshold_of_branch(question); the lines of the model and the motion have been read.
void take_threshold_of_branch(Question& question);

/// The claim that |det| is at most the threshold is shown by a singular configuration, where it is 0, if the
/// proof has no line `value`. Leaves the claim SINGULARITY of that configuration.
void show_threshold_by_fold(Question& question);

/// Reads the line `value` after `proof`, the place of an attained bound. Throws Rejection, or Unfinished
/// if the place is not certainly in the set.
void read_value_line(Lines& lines, Question& question, const Variety& variety);

/// The same from the words after `value`, which may be those of a piece.
void read_place_of_value(std::span<const std::string_view> words, Question& question,
                         const Variety& variety);

class BranchQuantity {
 public:
  /// Requires  question.closure, question.quantity; of a finite error, after add_nominal_copy().
  /// Throws    Unfinished.
  explicit BranchQuantity(Question& question);

  /// Ensures   true only if the bound holds at all configurations of the set over which the test was
  ///           last true, for all loads and errors.
  [[nodiscard]] bool keeps_bound(BranchTest& test);
  /// After it was false: roughly what each variable adds to what is not known; empty: see the test.
  [[nodiscard]] std::vector<double> impact() const {
    return singular_values_ ? singular_values_->impact() : std::vector<double>{};
  }
  /// Ensures   true only if at each of these configurations some load and errors attain the bound.
  [[nodiscard]] bool attains_bound(const BranchTest& test);

 private:
  struct Ball {
    Interval radius;
    std::vector<std::size_t> members;
  };

  /// along·w is within middle ± spread for the wrenches w of the load, and these are attained.
  struct Work {
    Interval middle, spread;
  };

  [[nodiscard]] Interval largest(const BranchTest& test);
  [[nodiscard]] std::vector<Interval> rates(const BranchTest& test, const Domination& domination);
  [[nodiscard]] std::vector<Work> forces(const BranchTest& test);
  [[nodiscard]] Work work(const std::vector<Interval>& along) const;
  [[nodiscard]] std::optional<Domination> dominate(const BranchTest& test);
  [[nodiscard]] std::vector<Interval> derivatives(const BranchTest& test,
                                                  const Domination& domination,
                                                  const std::vector<Interval>& B,
                                                  std::size_t columns) const;
  [[nodiscard]] Interval determinant(const BranchTest& test, const Domination& domination) const;
  [[nodiscard]] Interval condition(const BranchTest& test, const Domination& domination) const;
  [[nodiscard]] Interval of_load(const std::vector<Interval>& along) const;
  [[nodiscard]] std::vector<Interval> compliance(const std::vector<Interval>& J) const;

  const QuantityLines& quantity_;
  const std::size_t n_, motors_;
  Evaluation by_motor_;
  Interval bound_;  ///< of a quantity without limits
  std::vector<Interval> of_motors_, factors_, middle_, spread_, least_, largest_;
  std::vector<Ball> balls_;
  std::optional<BranchSingularValues> singular_values_;
  Matrix P_;  ///< |KΦ_p − I| ≤ P, column by column
};

}  // namespace regulus::verifier
