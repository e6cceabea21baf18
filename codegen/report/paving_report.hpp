// SPDX-License-Identifier: GPL-3.0-or-later
// What a paving found, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/report/paving_options.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::inline report {

/// The first JSON line: what was asked, and what each kind of box claims.
[[nodiscard]] nlohmann::ordered_json json_paving_header(const PreparedSearch& preparation,
                                                        const PavingOptions& options);

/// Number, volume and fraction of each kind of box; what was not finished, and why.
[[nodiscard]] nlohmann::ordered_json json_paving_summary(const PreparedSearch& preparation,
                                                         const SearchOptions& search,
                                                         const PavingOptions& options,
                                                         const Volumes& volumes,
                                                         const Result& result);

[[nodiscard]] std::string paving_report(const PreparedSearch& preparation,
                                        const SearchOptions& search, const PavingOptions& options,
                                        const Volumes& volumes, const Result& result);

/// "83.1 %", from certified bounds; "100 %" and "0 %" only for all and nothing.
[[nodiscard]] std::string percentage(const Volumes& volumes, const Share& share);

}  // namespace regulus::inline report
