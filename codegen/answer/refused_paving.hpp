// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/answer/services.hpp"
#include "codegen/model/model_options.hpp"
#include "codegen/question/engine/options.hpp"

namespace regulus::detail {

/// Call it before an earlier file is touched. Reads the model only if pictures are wanted.
///
/// Throws    UsageError for a resolution, or pictures, that no paving of the motion has; the errors of
///           read_request().
void refuse_paving(const std::string& resolution, const ModelOptions& model,
                   const SearchOptions& search, const Services& services);

}  // namespace regulus::detail
