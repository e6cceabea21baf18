// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/load.hpp"

#include "codegen/answer/ask.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/use/api/algebra_lock.hpp"
#include "codegen/use/api/answer_fields.hpp"

namespace regulus {

using namespace detail;

namespace {

LoadFinding finding_of(const LoadAnswer& answer, double seconds) {
  LoadFinding finding;
  finding.verdict = answer.verdict;
  finding.claim = answer.claim;
  finding.reason = answer.reason;
  finding.variables = answer.variables;
  finding.boxes = answer.boxes;
  set_reports(answer, "", finding);
  set_proof(answer.proof, finding);
  finding.seconds = seconds;
  return finding;
}

}  // namespace

LoadFinding check_load(const Question& question, const std::string& load,
                       const SearchOptions& options, const std::atomic<bool>* interrupt,
                       const std::string& certificate, std::uint64_t shard_size) {
  const AlgebraLock lock;
  Stopwatch watch;
  const auto answer = ask(AskLoad{question.options(), options, load},
                          services_of(certificate, shard_size, interrupt));
  return finding_of(*answer, watch.lap());
}

LoadPaving locate_load(const Question& question, const LocateLoadOptions& options,
                       const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  Stopwatch watch;
  Services services = services_of(options.certificate, options.shard_size, interrupt);
  services.on_force_box = options.on_box;
  const auto answer =
      ask(AskLoadPaving{question.options(), options.search, options.load, options.resolution},
          services);
  LoadPaving paving{finding_of(*answer, watch.lap()), answer->feasible, answer->infeasible,
                    answer->undecided, answer->outside};
  for (const StretchOfLoad& s : answer->stretches)
    paving.stretches.push_back({s.claim, s.first_segment, s.last_segment, s.begin, s.end, s.line});
  return paving;
}

}  // namespace regulus
