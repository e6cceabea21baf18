// SPDX-License-Identifier: Apache-2.0
// A claim as a theorem for Coq, over the library of runtime/formal.
#pragma once

#include <istream>
#include <string>

#include "runtime/formal/coq_geometry.hpp"

namespace regulus::verifier {

enum class CoqStatement {
  kClaim,  ///< the claim of the certificate
  kForce,  ///< the bound of a force, from the proof that `regulus bound` writes of it
};

/// Returns the text of a Coq file: the question of a certificate, expression by expression as it is
/// written there, and the theorem that the claim is true. Coq searches the proof anew, so nothing
/// after the line `proof` of a claim NO SINGULARITY is read. Throws Rejection if the file is not a
/// certificate; Unfinished if the library has no theorem for such a claim: SINGULARITY of a robot
/// that is always singular, or at a point without a double; or if the certificate is not that of a force.
[[nodiscard]] std::string coq_proof(std::istream& certificate,
                                    CoqStatement statement = CoqStatement::kClaim);

/// The sentences that may follow, about the robot of a model file (coq_geometry.hpp).
struct CoqRobot {
  std::string text;
  std::string reason;  ///< if there are none
};

/// The same; `robot` gets what may follow.
[[nodiscard]] std::string coq_proof(std::istream& certificate, CoqStatement statement,
                                    const CoqModel& model, CoqRobot& robot);

}  // namespace regulus::verifier
