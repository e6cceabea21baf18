// SPDX-License-Identifier: GPL-3.0-or-later
// The certificate of a list of all solutions: runtime/proof/FORMAT.md, "All solutions".
#pragma once

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/solve/solutions.hpp"

namespace regulus {

/// Writes the proof of what is known of the solutions, if there is one.
///
/// Requires  solutions are those of the request.
[[nodiscard]] ProofStatus certify_solutions(const std::string& path, const Request& request,
                                            const Solutions& solutions,
                                            const ProofPlacing& placing);

}  // namespace regulus
