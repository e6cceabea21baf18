// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

namespace regulus::detail {

/// Returns the number itself, as a fraction.
///
/// Requires  x is finite.
[[nodiscard]] GiNaC::ex exact_number(double x);

}  // namespace regulus::detail
