// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method in doubles, for roots of as many equations as unknowns, or more.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace regulus::detail::attack {

using Numbers = std::vector<double>;
using Residual = std::function<Numbers(const Numbers&)>;

/// Returns a regular root that the method of Levenberg and Marquardt reaches from there; nullopt: it
/// reaches none, or the derivatives may lose rank there.
[[nodiscard]] std::optional<Numbers> newton_root(const Residual& residual, Numbers start);

}  // namespace regulus::detail::attack
