// SPDX-License-Identifier: GPL-3.0-or-later
// Signs and domains that can be read off an expression's form.
#pragma once

#include <ginac/ginac.h>

#include <optional>

namespace regulus::inline model {

/// Whether e ≥ 0 at every real point where e is defined, by its form alone: squares, roots, sums
/// and products of such. false says nothing.
[[nodiscard]] bool certain_nonnegative(const GiNaC::ex& e);

/// Whether e > 0 at every real point where e is defined, by its form alone. false says nothing.
[[nodiscard]] bool certain_positive(const GiNaC::ex& e);

/// Whether e is defined at every real point, by its form alone. false says nothing.
[[nodiscard]] bool certain_defined(const GiNaC::ex& e);

/// A constant's approximate value, for refusing input early and for messages: no bound is claimed.
/// nullopt when it, or a part of it, is not a real number in the range of doubles. (Not by evalf():
/// beyond its exponent range it gives exp(exp(exp(9))) = 1.)
[[nodiscard]] std::optional<double> approx_value(const GiNaC::ex& constant);

}  // namespace regulus::inline model
