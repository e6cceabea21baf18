// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/bound.hpp"

#include "codegen/answer/ask.hpp"
#include "codegen/use/api/algebra_lock.hpp"
#include "codegen/use/api/answer_fields.hpp"

namespace regulus {

using namespace detail;

namespace {

BoundVerdict verdict_of(BoundAnswer::Verdict verdict) {
  switch (verdict) {
    case BoundAnswer::Verdict::kBracket:
      return BoundVerdict::kBracket;
    case BoundAnswer::Verdict::kWithin:
      return BoundVerdict::kWithin;
    case BoundAnswer::Verdict::kExceeded:
      return BoundVerdict::kExceeded;
    case BoundAnswer::Verdict::kUndecided:
      break;
  }
  return BoundVerdict::kUndecided;
}

}  // namespace

BoundFinding bound(const Question& question, const BoundOptions& options,
                   const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  std::string told;
  Services services = services_of(options.certificate, options.shard_size, interrupt);
  services.on_line = [&told](const std::string& line) { told += line; };
  const auto answer = ask(
      AskBound{question.options(), options.search, options.quantity, options.limit, options.gap},
      services);
  BoundFinding finding;
  finding.verdict = verdict_of(answer->verdict);
  finding.attained = answer->attained;
  finding.proved = answer->proved;
  finding.closed = options.limit.empty() && answer->closed;
  finding.unit = answer->unit;
  finding.result = answer->headline();
  set_reports(*answer, told, finding);
  set_ends(answer->proofs, finding);
  return finding;
}

}  // namespace regulus
