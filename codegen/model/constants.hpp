// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of constants, from a file or a command line.
#pragma once

#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/model/model.hpp"

namespace regulus::detail {

/// Returns the range lo ≤ hi; the order is proved. Throws InputError for a reversed range, and for
/// a range whose ends certified evaluation cannot put in order (sqrt(2)*sqrt(3) to sqrt(6)).
[[nodiscard]] Range checked_range(const ParsedExpression& lo, const ParsedExpression& hi,
                                  const Place& place);

/// Returns a tolerance, an error or a threshold; throws InputError unless it is proved to be ≥ 0.
[[nodiscard]] GiNaC::ex checked_nonnegative(const ParsedExpression& value, const Place& place);

/// Reads "LO:HI", or "V" for a range of one value. Conditions of the constants are added to
/// `must_be_defined`.
[[nodiscard]] Range parse_range(std::string_view text, const Place& place,
                                std::vector<GiNaC::ex>& must_be_defined,
                                NumberUnit unit = NumberUnit::kPlain);

void append(std::vector<GiNaC::ex>& all, const std::vector<GiNaC::ex>& more);

/// Returns the expressions without repetitions, in the order of first occurrence.
[[nodiscard]] std::vector<GiNaC::ex> distinct(const std::vector<GiNaC::ex>& all);

}  // namespace regulus::detail
