// SPDX-License-Identifier: Apache-2.0
// Proves leaves of claims about forces that hold a load.
#pragma once

#include "runtime/verifier/load_test.hpp"
#include "runtime/verifier/splitting_prover.hpp"

namespace regulus::verifier {

class LoadProver final : public SplittingProver {
 public:
  LoadProver(Question& question, const Variety& variety, const Options& options, WorkClock& clock)
      : SplittingProver(question, variety, options, clock), test_(question, variety) {}

 private:
  [[nodiscard]] BoxAnswer decide(const Box& box, LeafClaim claim) override;
  [[nodiscard]] std::optional<std::size_t> variable_to_split(const Box& box) const override {
    return test_.variable_to_split(box);
  }
  [[nodiscard]] std::string contradiction(const Box& point, LeafClaim claim) override;

  LoadTest test_;
};

}  // namespace regulus::verifier
