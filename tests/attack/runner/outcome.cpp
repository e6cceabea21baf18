// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/runner/outcome.hpp"

namespace regulus::detail::attack {
namespace {

constexpr int kNoSingularity = 0, kSingularity = 1, kPossibleProblem = 2;
constexpr int kUsage = 64, kBadModel = 65;

bool is_refusal(int exit_code) { return exit_code == kUsage || exit_code == kBadModel; }

/// Returns the true verdict; −1 if neither may be claimed.
int true_verdict(Truth truth) {
  switch (truth) {
    case Truth::kRegular:
      return kNoSingularity;
    case Truth::kSingular:
    case Truth::kUndefinedOrSingular:
      return kSingularity;
    default:
      return -1;
  }
}

/// About all solutions.
Judgement judge_list(const Attack& attack, const Outcome& outcome) {
  if (!outcome.false_list.empty()) return Judgement::kContradiction;
  if (outcome.exit_code == kPossibleProblem)
    return attack.decidable ? Judgement::kMissed : Judgement::kOpen;
  const bool has_none = outcome.exit_code == kSingularity;
  const bool is_true = has_none ? attack.solve->known.empty() : attack.truth == Truth::kRegular;
  return is_true ? Judgement::kTrue : Judgement::kContradiction;
}

}  // namespace

Judgement judge(const Attack& attack, const Outcome& outcome) {
  if (outcome.ending == Ending::kSlow && outcome.stage == Stage::kCheck) return Judgement::kSlow;
  if (outcome.ending == Ending::kCrashed && outcome.stage == Stage::kCheck)
    return Judgement::kCrash;
  const int code = outcome.exit_code;
  if (attack.truth == Truth::kRefused) {
    if (is_refusal(code)) return Judgement::kTrue;
    return code <= kPossibleProblem ? Judgement::kContradiction : Judgement::kCrash;
  }
  if (is_refusal(code)) return attack.may_be_refused ? Judgement::kOpen : Judgement::kCrash;
  if (attack.solve && code >= kNoSingularity && code <= kPossibleProblem)
    return judge_list(attack, outcome);
  if (code == kPossibleProblem) return attack.decidable ? Judgement::kMissed : Judgement::kOpen;
  if (code != kNoSingularity && code != kSingularity) return Judgement::kCrash;
  // A claim about no pose is true, but it must not look like a claim about some pose.
  if (attack.truth == Truth::kEmpty && code == kNoSingularity && outcome.may_be_vacuous)
    return attack.decidable ? Judgement::kMissed : Judgement::kOpen;
  return code == true_verdict(attack.truth) ? Judgement::kTrue : Judgement::kContradiction;
}

bool proof_failed(const Outcome& outcome) {
  return outcome.proof == Proof::kRejected || outcome.proof == Proof::kBroken;
}

const char* name(Judgement judgement) {
  switch (judgement) {
    case Judgement::kTrue:
      return "true";
    case Judgement::kOpen:
      return "open";
    case Judgement::kMissed:
      return "missed";
    case Judgement::kContradiction:
      return "CONTRADICTION";
    case Judgement::kCrash:
      return "CRASH";
    case Judgement::kSlow:
      return "SLOW";
  }
  return "";
}

const char* name(Proof proof) {
  switch (proof) {
    case Proof::kNone:
      return "none";
    case Proof::kVerified:
      return "VERIFIED";
    case Proof::kUnfinished:
      return "UNFINISHED";
    case Proof::kRejected:
      return "REJECTED";
    case Proof::kBroken:
      return "BROKEN";
  }
  return "";
}

std::string verdict_text(int exit_code) {
  switch (exit_code) {
    case kNoSingularity:
      return "NO SINGULARITY";
    case kSingularity:
      return "SINGULARITY";
    case kPossibleProblem:
      return "POSSIBLE PROBLEM";
    default:
      return "exit " + std::to_string(exit_code);
  }
}

}  // namespace regulus::detail::attack
