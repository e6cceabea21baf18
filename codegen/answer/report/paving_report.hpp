// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of a paving, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/answer/report/paving_options.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// Returns the first JSON line: the question, and the claim of each kind of box.
[[nodiscard]] nlohmann::ordered_json json_paving_header(const SearchSubject& preparation,
                                                        const PavingOptions& options);

/// Tells the question, and number, volume and fraction of each kind of box; if the paving is not complete,
/// the reason. `asked`: of a closure, whose kernel has another request.
void tell_paving(const PreparedSearch& preparation, const Request& asked,
                 const SearchOptions& search, const PavingOptions& options, const Volumes& volumes,
                 const Result& result, Facts& facts);

/// Returns "83.1 %", for example, from certified bounds; "100 %" and "0 %" only for all and
/// nothing.
[[nodiscard]] std::string percentage(const Volumes& volumes, const Share& share);

}  // namespace regulus::detail
