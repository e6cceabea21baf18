// SPDX-License-Identifier: GPL-3.0-or-later
// The question of a certificate about the bound of a quantity: that of the model, and the lines of
// FORMAT.md, "Bounds of quantities". The verifier builds the matrix of question/quantity/bordered.hpp itself.
#pragma once

#include <set>
#include <string>

#include "codegen/question/quantity/bordered.hpp"
#include "runtime/proof/writer.hpp"

namespace regulus::detail {

/// `request`: of the model, before border(). `bordered`: of it; `end`: the end R of the range of r,
/// or the threshold of a determinant. `uncertain`: as for certified_question; other names are ignored.
///
/// Throws    as certified_question.
[[nodiscard]] CertifiedQuestion certified_bound(const Request& request, const Component& component,
                                                const Bordered& bordered, const GiNaC::ex& end,
                                                const std::set<std::string>& uncertain);

}  // namespace regulus::detail
