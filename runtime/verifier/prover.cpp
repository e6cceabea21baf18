// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/prover.hpp"

#include "runtime/verifier/bordered_matrix.hpp"
#include "runtime/verifier/branch_prover.hpp"
#include "runtime/verifier/condition_prover.hpp"
#include "runtime/verifier/leaf.hpp"
#include "runtime/verifier/load_prover.hpp"

namespace regulus::verifier {

std::unique_ptr<Prover> make_prover(Question& question, const Variety& variety,
                                    const Options& options, WorkClock& clock) {
  if (question.load) return std::make_unique<LoadProver>(question, variety, options, clock);
  if (question.closure) return std::make_unique<BranchProver>(question, variety, options, clock);
  if (question.quantity && is_about_ratio(*question.quantity))
    return std::make_unique<ConditionProver>(question, variety, options, clock);
  return std::make_unique<LeafProver>(question, variety, options, clock);
}

}  // namespace regulus::verifier
