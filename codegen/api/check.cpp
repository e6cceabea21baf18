// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/api/check.hpp"

#include "codegen/answer/ask.hpp"
#include "codegen/api/algebra_lock.hpp"
#include "codegen/api/answer_fields.hpp"
#include "codegen/support/stopwatch.hpp"

namespace regulus::inline api {

Finding check(const Question& question, const SearchOptions& options,
              const std::atomic<bool>* interrupt, const std::string& certificate) {
  const AlgebraLock lock;
  Stopwatch watch;
  const auto answer =
      ask(AskCheck{question.options(), options}, services_of(certificate, interrupt));
  Finding finding;
  finding.verdict = answer->result.verdict;
  finding.claim = answer->claim();
  finding.variables = answer->variables;
  finding.result = answer->result;
  set_reports(*answer, "", finding);
  set_proof(answer->proof, finding);
  finding.seconds = watch.lap();
  return finding;
}

}  // namespace regulus::api
