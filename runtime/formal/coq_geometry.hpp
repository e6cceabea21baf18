// SPDX-License-Identifier: Apache-2.0
// The theorem about the robot of a model file, in the words of Geometry.v. All that it shows is read
// from the file; its proof compares that with the question of the certificate.
#pragma once

#include <string>

#include "runtime/formal/coq_robot.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the sentences that follow the theorem the_claim about this question. Throws Unfinished, with
/// the reason, if there is no theorem about such a model or such a claim.
[[nodiscard]] std::string coq_geometry(const Question& question, const CoqModel& model);

}  // namespace regulus::verifier
