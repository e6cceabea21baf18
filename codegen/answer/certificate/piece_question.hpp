// SPDX-License-Identifier: GPL-3.0-or-later
// The questions of certificates about motions along a trajectory.
#pragma once

#include <set>
#include <string>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/model/request.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "runtime/proof/writer.hpp"

namespace regulus {

/// Returns the question about one piece alone: its first parameter s ranges over [0, 1], and the
/// parameters of the motion follow.
[[nodiscard]] Request piece_request(const Request& request, std::size_t piece);

/// Returns the question whether a matrix is regular.
[[nodiscard]] CertifiedAbout is_regular();

/// Returns the question about all pieces (FORMAT.md, `piecewise`).
[[nodiscard]] CertifiedQuestion trajectory_question(const Request& request,
                                                    const std::set<std::string>& uncertain,
                                                    const CertifiedAbout& about = is_regular());

}  // namespace regulus
