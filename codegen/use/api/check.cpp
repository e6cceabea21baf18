// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/check.hpp"

#include "codegen/answer/ask.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/use/api/algebra_lock.hpp"
#include "codegen/use/api/answer_fields.hpp"

namespace regulus {

using namespace detail;

Finding check(const Question& question, const SearchOptions& options,
              const std::atomic<bool>* interrupt, const std::string& certificate,
              std::uint64_t shard_size) {
  const AlgebraLock lock;
  Stopwatch watch;
  const auto answer =
      ask(AskCheck{question.options(), options}, services_of(certificate, shard_size, interrupt));
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

}  // namespace regulus
