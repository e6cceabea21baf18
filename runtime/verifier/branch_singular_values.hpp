// SPDX-License-Identifier: Apache-2.0
// The singular values of X = Φ_p·diag(factors) over a tube of a closure. PROOF.md, "Bounds over a branch",
// derives the enclosure.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/branch_test.hpp"
#include "runtime/verifier/singular_claims.hpp"

namespace regulus::verifier {

/// Returns true for the condition number in the 2-norm, and the extreme singular values.
[[nodiscard]] bool is_singular_value(const std::string& kind);

class BranchSingularValues {
 public:
  /// Requires  question.closure, is_singular_value(question.quantity->kind).
  /// Throws    Unfinished.
  explicit BranchSingularValues(const Question& question);

  /// Ensures   true only if the claim about X holds at all configurations of the set over which the
  ///           test was last true.
  [[nodiscard]] bool keeps_bound(BranchTest& test);
  /// After it was false: roughly what each variable adds to the bound; empty if nothing is known.
  [[nodiscard]] const std::vector<double>& impact() const noexcept { return impact_; }
  /// Ensures   true only if at each of these configurations X attains the bound.
  [[nodiscard]] bool attains_bound(const BranchTest& test) const;

 private:
  using Intervals = std::vector<Interval>;

  [[nodiscard]] SingularBases bases_of(const Intervals& X) const;
  [[nodiscard]] Intervals rotated(const Intervals& X, const SingularBases& bases) const;
  [[nodiscard]] RotatedMatrix rotate(const BranchTest& test, const SingularBases& bases) const;

  const std::size_t m_, n_;
  const SingularClaim claim_;
  Ball bound_;
  std::vector<Interval> factors_;
  std::vector<double> impact_;
};

}  // namespace regulus::verifier
