// SPDX-License-Identifier: GPL-3.0-or-later
// The determinants of a witness, as reports print them.
#pragma once

#include "codegen/question/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

/// Encloses them by more digits than doubles have, of the matrix as the model writes it. So they
/// depend on the points alone: kernels of two instruction sets give two enclosures.
///
/// Ensures   an enclosure is replaced by one that is true, too, and has no other sign.
void enclose_determinants(PreparedSearch& preparation, Result& result);

}  // namespace regulus::detail
