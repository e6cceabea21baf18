// SPDX-License-Identifier: GPL-3.0-or-later
// What came of one model, and whether it contradicts the truth.
#pragma once

#include <string>

#include "tests/attack/oracle/attack.hpp"

namespace regulus::attack {

enum class Stage { kCheck, kVerify };

enum class Ending {
  kReturned,  ///< with an exit code
  kCrashed,   ///< by a signal or an exit of the whole process
  kSlow,      ///< stopped at the limit of time
};

enum class Proof { kNone, kVerified, kUnfinished, kRejected, kBroken };

struct Outcome {
  Ending ending = Ending::kReturned;
  Stage stage = Stage::kCheck;  ///< in which it ended
  int exit_code = -1;           ///< of the check
  Proof proof = Proof::kNone;
  std::string reason;  ///< of the report, or of what went wrong
  std::string proof_reason;
  double check_seconds = 0, verify_seconds = 0;  ///< of processor time
  bool may_be_vacuous = false;  ///< the report warns that the claim may be about no pose
  bool is_announced = false;    ///< the report warns that the verifier may not finish the proof
};

enum class Judgement {
  kTrue,           ///< the verdict that is true, or a model refused that had to be
  kOpen,           ///< POSSIBLE PROBLEM, or a refusal that is allowed
  kMissed,         ///< the same where a verdict was expected
  kContradiction,  ///< a verdict that is false; a text accepted that is not a model
  kCrash,          ///< or an exit code that no model should give
  kSlow,
};

[[nodiscard]] Judgement judge(const Attack& attack, const Outcome& outcome);

/// A rejected proof, or a verifier that crashed.
[[nodiscard]] bool proof_failed(const Outcome& outcome);

[[nodiscard]] const char* name(Judgement judgement);
[[nodiscard]] const char* name(Proof proof);
/// "NO SINGULARITY", "exit 70".
[[nodiscard]] std::string verdict_text(int exit_code);

}  // namespace regulus::attack
