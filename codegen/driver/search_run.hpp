// SPDX-License-Identifier: GPL-3.0-or-later
// Running a search from a command: with more digits at hand, a display of its progress, and an exit
// code for its verdict.
#pragma once

#include "regulus/codegen/driver/exit_code.hpp"
#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/search/observer.hpp"

namespace regulus::codegen {

/// Searches all of the preparation's variety; time and bits are noted in the preparation.
[[nodiscard]] Result run_search(Preparation& preparation, const SearchOptions& search,
                                const OutputOptions& output, Settings settings,
                                Observer* observer = nullptr);

[[nodiscard]] ExitCode exit_code_of(Verdict verdict);

}  // namespace regulus::codegen
