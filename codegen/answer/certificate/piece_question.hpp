// SPDX-License-Identifier: GPL-3.0-or-later
// The questions of certificates about motions along a trajectory.
#pragma once

#include <set>
#include <string>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/model/request.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "runtime/proof/writer.hpp"

namespace regulus::detail {

/// Returns the question about one piece alone: its first parameter s ranges over [0, 1], and the
/// parameters of the motion follow. The start of a closure is where the piece begins.
[[nodiscard]] Request piece_request(const Request& request, std::size_t piece);

/// A number that each piece of a trajectory has.
struct PieceConstant {
  PoseParameter quantity;         ///< as a constant of the common question
  std::vector<GiNaC::ex> values;  ///< by piece
};

/// The question about all pieces: piece_request() with constants in the place of its numbers.
struct PiecesRequest {
  Request request;
  std::vector<PieceConstant> constants;
};
[[nodiscard]] PiecesRequest pieces_request(const Request& request);

/// Returns the question whether a matrix is regular.
[[nodiscard]] CertifiedAbout is_regular();

/// Returns the question about all pieces (FORMAT.md, `piecewise`).
[[nodiscard]] CertifiedQuestion trajectory_question(const Request& request,
                                                    const std::set<std::string>& uncertain,
                                                    const CertifiedAbout& about = is_regular());

}  // namespace regulus::detail
