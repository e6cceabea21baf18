// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/locate.hpp"

#include "codegen/answer/ask.hpp"
#include "codegen/use/api/algebra_lock.hpp"
#include "codegen/use/api/answer_fields.hpp"

namespace regulus {

using namespace detail;

Paving locate(const Question& question, const LocateOptions& options,
              const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  Services services = services_of(options.certificate, options.shard_size, interrupt);
  services.on_box = options.on_box;
  const auto answer =
      ask(AskPaving{question.options(), options.search, options.resolution}, services);
  Paving found;
  found.verdict = answer->result.verdict;
  found.free = answer->free;
  found.singular = answer->singular;
  found.undecided = answer->undecided;
  found.outside = answer->outside;
  found.unreachable = answer->unreachable;
  found.workspace = answer->workspace;
  for (const StretchOfWay& s : answer->stretches)
    found.stretches.push_back({s.claim, s.first_segment, s.last_segment, s.begin, s.end, s.line});
  found.variables = answer->variables;
  found.result = answer->result;
  set_reports(*answer, "", found);
  set_proof(answer->proof, found);
  return found;
}

}  // namespace regulus
