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
///
/// `model`: may be null. With it, the theorem about the robot of the model file follows
/// (coq_geometry.hpp). If there is none, `why` gets the reason.
[[nodiscard]] std::string coq_proof(std::istream& certificate,
                                    CoqStatement statement = CoqStatement::kClaim,
                                    const CoqModel* model = nullptr, std::string* why = nullptr);

}  // namespace regulus::verifier
