// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "codegen/answer/kinds.hpp"

namespace regulus {

/// Returns the proofs of a component's ends; none if none were wanted.
[[nodiscard]] std::vector<ProofOfEnd> proofs_of_ends(const EndProofs& ends,
                                                     const std::string& component);

/// Puts the files of a run in their places. What is missing is noted in `ends` and in the answer.
void settle_files(HeldFiles& held, const std::vector<EndProofs*>& ends, Answer& answer);

}  // namespace regulus
