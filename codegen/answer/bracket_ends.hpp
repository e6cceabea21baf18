// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "codegen/answer/kinds.hpp"

namespace regulus {

/// Returns the proofs of a component's ends; none if none were wanted.
[[nodiscard]] std::vector<ProofOfEnd> proofs_of_ends(const EndProofs& ends,
                                                     const std::string& component);

}  // namespace regulus
