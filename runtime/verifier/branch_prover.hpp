// SPDX-License-Identifier: Apache-2.0
// Proves leaves of a claim about a closure: each by the tube that it states.
#pragma once

#include "runtime/verifier/branch_quantity.hpp"
#include "runtime/verifier/splitting_prover.hpp"

namespace regulus::verifier {

class BranchProver final : public SplittingProver {
 public:
  BranchProver(Question& question, const Variety& variety, const Options& options, WorkClock& clock)
      : SplittingProver(question, variety, options, clock),
        variety_(variety),
        test_(question),
        outside_(question, variety),
        motion_(question, question.motion_defined),
        all_keep_(question.has_threshold ? "|det| exceeds alpha"
                                         : "all forces are within their limits") {
    if (question.quantity && !question.singular) quantity_.emplace(question);
  }

  void prove(const Leaf& leaf) override {
    tube_ = &leaf.tube;
    shown_.clear();
    SplittingProver::prove(leaf);
  }

 private:
  /// After the test was true.
  [[nodiscard]] bool holds(LeafClaim claim);
  /// After the tube was shown over a larger part: the same solutions are in a narrower one over a part.
  [[nodiscard]] bool has_narrower_tube(const Box& box);
  /// After the test was true, if no point of the box is in the set.
  [[nodiscard]] bool needs_no_bound(const Box& box, LeafClaim claim);
  [[nodiscard]] BoxAnswer decide(const Box& box, LeafClaim claim) override;
  [[nodiscard]] std::optional<std::size_t> variable_to_split(const Box& box) const override;
  /// The tube, or a box about the solution that is in it, shows it.
  [[nodiscard]] std::string contradiction(const Box& point, LeafClaim claim) override;
  /// After the test was true.
  [[nodiscard]] std::string contradiction_in_test(LeafClaim claim);

  const Variety& variety_;
  BranchTest test_;
  Outside outside_;
  Evaluation motion_;
  const char* const all_keep_;              ///< what contradicts a leaf `infeasible`
  std::optional<BranchQuantity> quantity_;  ///< that keeps its bound, or attains it all over
  const TubeNumbers* tube_ = nullptr;       ///< of the leaf
  TubeNumbers narrower_;                    ///< within it, over a part of the leaf
  Box shown_;                               ///< the tube has one solution all over this part
  std::vector<double> impact_;              ///< for the last box
  bool is_hopeless_ = false;                ///< the tube does not hold even at its middle
};

}  // namespace regulus::verifier
