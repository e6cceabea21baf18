// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/model/request.hpp"

namespace regulus::detail {

/// Applies the ranges, the tolerances and the threshold of the options to a model and its motion.
/// Throws UsageError.
void apply_changes(Request& request, const ModelOptions& options);

/// Refuses a motion that leaves the limits of the joints, or adds a note if the options allow it.
/// Throws InputError.
void stay_within_limits(Request& request, const ModelOptions& options);

}  // namespace regulus::detail
