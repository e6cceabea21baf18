// SPDX-License-Identifier: Apache-2.0
// Proves leaves of the claim that the condition number in the 2-norm is below a number.
#pragma once

#include "runtime/verifier/condition_test.hpp"
#include "runtime/verifier/splitting_prover.hpp"

namespace regulus::verifier {

class ConditionProver final : public SplittingProver {
 public:
  ConditionProver(Question& question, const Variety& variety, const Options& options,
                  WorkClock& clock)
      : SplittingProver(question, variety, options, clock), test_(question, variety) {}

 private:
  [[nodiscard]] BoxAnswer decide(const Box& box, LeafClaim /*claim*/) override {
    return test_.decide(box);
  }
  [[nodiscard]] std::optional<std::size_t> variable_to_split(const Box& box) const override {
    return test_.variable_to_split(box);
  }
  [[nodiscard]] std::string contradiction(const Box& point, LeafClaim /*claim*/) override {
    return test_.exceeds_at(point) ? "the condition number is not below the bound" : "";
  }

  ConditionTest test_;
};

}  // namespace regulus::verifier
