// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets the condition number in the 2-norm, which is no question of regularity.
#pragma once

#include "codegen/question/bound/bound_run.hpp"

namespace regulus::detail {

/// Brackets another quantity of the same question, in so many seconds.
using OtherBound =
    std::function<ComponentBound(const Component&, const BoundSettings&, double seconds)>;

/// Brackets κ, or compares it with the limit of `settings`. `seconds`: for the search; `left`: to form
/// the matrix; `other`: for singular values.
///
/// Requires  component.kind is kCondition2.
/// Throws    UsageError for options that a motion along way-points does not have; the exceptions of
///           prepare().
[[nodiscard]] ComponentBound bound_condition_number(const Request& request,
                                                    const Component& component,
                                                    const BoundSettings& settings, double seconds,
                                                    double left, const OtherBound& other);

}  // namespace regulus::detail
