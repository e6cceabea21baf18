// SPDX-License-Identifier: GPL-3.0-or-later
// The domains of partial operations, recorded as expressions that are defined exactly there.
//
// An expression recorded for an operation is that operation on the operand as GiNaC has simplified
// it. The conditions for the operand itself were recorded when the operand was built, so a
// simplification across the two (1/(1/x) into x) loses nothing: x ≠ 0 is already there.
#pragma once

#include "codegen/model/exact/parsed_expression.hpp"

namespace regulus::detail {

// Each function records in `result` the condition on the operand, unless the form of the operand
// shows it, and throws ParseRefusal if the operand is a constant that does not satisfy it.

void require_nonzero(ParsedExpression& result, const GiNaC::ex& operand, bool constant);
void require_nonnegative(ParsedExpression& result, const GiNaC::ex& operand, bool constant);
void require_positive(ParsedExpression& result, const GiNaC::ex& operand, bool constant);
void require_unit_range(ParsedExpression& result, const GiNaC::ex& operand,
                        bool constant);  ///< |x| ≤ 1
void require_no_pole_of_tan(ParsedExpression& result, const GiNaC::ex& operand);
void require_off_branch_cut(ParsedExpression& result, const GiNaC::ex& ordinate,
                            const GiNaC::ex& abscissa);

}  // namespace regulus::detail
