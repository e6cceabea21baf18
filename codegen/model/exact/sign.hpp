// SPDX-License-Identifier: GPL-3.0-or-later
// Signs and domains that can be read off an expression's form.
#pragma once

#include <ginac/ginac.h>

#include <optional>

namespace regulus::detail {

/// True if the form of e shows that e ≥ 0 at every real point where e is defined: squares, roots,
/// sums and products of such. False says nothing.
[[nodiscard]] bool certain_nonnegative(const GiNaC::ex& e);

/// True if the form of e shows that e > 0 at every real point where e is defined. False says
/// nothing.
[[nodiscard]] bool certain_positive(const GiNaC::ex& e);

/// True if the form of e shows that e is defined at every real point. False says nothing.
[[nodiscard]] bool certain_defined(const GiNaC::ex& e);

/// Returns a constant's approximate value, without a bound, to refuse input early and for messages;
/// nullopt if it, or a part of it, is not a real number in the range of doubles. (evalf() is not
/// used: beyond its exponent range it gives exp(exp(exp(9))) = 1.)
[[nodiscard]] std::optional<double> approx_value(const GiNaC::ex& constant);

}  // namespace regulus::detail
