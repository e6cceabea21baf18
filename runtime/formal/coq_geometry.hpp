// SPDX-License-Identifier: Apache-2.0
// The theorem about the robot of a model file, in the words of Geometry.v, Arms.v, Legs.v or
// Matrices.v. All that it shows is read from the file; its proof compares that with the question of the
// certificate.
#pragma once

#include <string>
#include <vector>

#include "runtime/formal/coq_robot.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the sentences that follow the theorem the_claim about this question, which has these lines. Throws Unfinished, with
/// the reason, if there is no theorem about such a model or such a claim.
[[nodiscard]] std::string coq_geometry(const Question& question,
                                       const std::vector<std::string>& lines,
                                       const CoqModel& model);

}  // namespace regulus::verifier
