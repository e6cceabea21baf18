// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "regulus/codegen/driver/options.hpp"
#include "regulus/search/problem.hpp"

namespace regulus::codegen {

/// The search's settings as the command line spells them. Throws UsageError for an unknown word.
[[nodiscard]] Settings settings_from(const SearchOptions& options);

}  // namespace regulus::codegen
