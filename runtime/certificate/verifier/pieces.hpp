// SPDX-License-Identifier: Apache-2.0
// Certificates about a trajectory of several pieces: one question, whose pieces give some constants
// their values, and a tree for each piece.
#pragma once

#include "runtime/certificate/verifier/verify.hpp"

namespace regulus::verifier {

/// Reads on from the line `piecewise`, up to the end of the file, and proves the claim for each
/// piece. `lines` has kept the lines before. Returns if the claim is proved; throws Rejection,
/// Unfinished or OtherModel.
void check_pieces(Lines& lines, const Options& options, Verification& result);

}  // namespace regulus::verifier
