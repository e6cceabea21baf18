// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/margin.hpp"

#include "codegen/answer/ask.hpp"
#include "codegen/use/api/algebra_lock.hpp"
#include "codegen/use/api/answer_fields.hpp"

namespace regulus {

using namespace detail;

MarginFinding margin(const Question& question, const MarginOptions& options,
                     const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  AskMargin asked{question.options(), options.search, {options.scale, options.parameter},
                  options.quantity,   options.limit,  options.gap};
  if (!options.tolerance.empty()) asked.model.tolerances.push_back(options.tolerance);
  if (!options.tube.empty()) asked.model.tubes.push_back(options.tube);
  if (!options.alpha.empty()) asked.model.alpha = options.alpha;
  const auto answer = ask(asked, services_of(options.certificate, options.shard_size, interrupt));
  MarginFinding finding;
  finding.safe = answer->safe;
  (answer->is_of_limit ? finding.exceeded : finding.singular) = answer->refuted;
  finding.closed = answer->closed;
  finding.bracket = answer->headline();
  set_reports(*answer, "", finding);
  set_ends(answer->proofs, finding);
  return finding;
}

}  // namespace regulus
