// SPDX-License-Identifier: GPL-3.0-or-later
// The certificate of a branch.
#pragma once

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/closure/closure_run.hpp"

namespace regulus {

/// Writes the proof of a branch, if it is proved. An empty `path` means no certificate.
[[nodiscard]] ProofStatus certify_branch(const std::string& path, const PreparedClosure& prepared,
                                         const ClosureResult& result, const ProofPlacing& placing);

}  // namespace regulus
