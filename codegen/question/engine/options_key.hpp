// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/jit/cache/key_parts.hpp"

namespace regulus::detail {

/// Adds every option of the symbolic stage to a key of the cache.
void add(KeyParts& parts, const FormulationOptions& options);

}  // namespace regulus::detail
