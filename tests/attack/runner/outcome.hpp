// SPDX-License-Identifier: GPL-3.0-or-later
// The outcome of one model, and whether it contradicts the truth.
#pragma once

#include <string>

#include "tests/attack/oracle/attack.hpp"

namespace regulus::detail::attack {

enum class Stage { kCheck, kVerify };

enum class Ending {
  kReturned,  ///< it returned an exit code
  kCrashed,   ///< a signal or an exit ended the whole process
  kSlow,      ///< stopped at the time limit
};

enum class Proof { kNone, kVerified, kUnfinished, kRejected, kBroken };

struct Outcome {
  Ending ending = Ending::kReturned;
  Stage stage = Stage::kCheck;  ///< the stage in which it ended
  int exit_code = -1;           ///< of the check
  Proof proof = Proof::kNone;
  std::string reason;      ///< from the report, or what went wrong
  std::string false_list;  ///< why the list of solutions is false; empty: it is not shown to be
  std::string proof_reason;
  double check_seconds = 0, verify_seconds = 0;  ///< in processor time
  bool may_be_vacuous = false;  ///< the report warns that the claim may be about no pose
  bool is_announced = false;    ///< the report warns that the verifier may not finish the proof
};

enum class Judgement {
  kTrue,           ///< the true verdict, or a refusal that the truth demands
  kOpen,           ///< POSSIBLE PROBLEM, or a refusal that is allowed
  kMissed,         ///< the same, but a verdict was expected
  kContradiction,  ///< a false verdict, or a verdict about a text that is not a model
  kCrash,          ///< a crash, or an exit code that no model should give
  kSlow,
};

[[nodiscard]] Judgement judge(const Attack& attack, const Outcome& outcome);

/// Returns true if the verifier rejected the proof or crashed.
[[nodiscard]] bool proof_failed(const Outcome& outcome);

[[nodiscard]] const char* name(Judgement judgement);
[[nodiscard]] const char* name(Proof proof);
/// Returns, for example, "NO SINGULARITY" or "exit 70".
[[nodiscard]] std::string verdict_text(int exit_code);

}  // namespace regulus::detail::attack
