// SPDX-License-Identifier: GPL-3.0-or-later
// Models that are singular at every pose ("architecturally"): no search can show that.
#pragma once

#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/search/result.hpp"

namespace regulus::codegen {

/// Turns a result into SINGULARITY, kAlwaysSingular, when det A vanishes identically over the
/// motion and the uncertain quantities, by multiplying it out exactly within a small budget; that
/// is tried only where the search found no certain box and determinants at sample points hold 0 to
/// many bits. Otherwise the result is left as it is, as it is when no point of the variety is
/// certainly inside the constraints and defined.
void recognise_always_singular(const Preparation& preparation, Result& result);

}  // namespace regulus::codegen
