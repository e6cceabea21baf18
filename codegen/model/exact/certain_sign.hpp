// SPDX-License-Identifier: GPL-3.0-or-later
// The sign of a constant, proved.
#pragma once

#include <ginac/ginac.h>

namespace regulus::detail {

enum class CertainSign { kNegative, kZero, kPositive, kUnknown };

/// Returns the sign of an exact constant: by rational arithmetic if it is rational, else by Arb's
/// balls with up to 4096 bits.
///
/// Requires  the constant has no symbols.
/// Ensures   a result other than kUnknown is proved. Only rational arithmetic proves zero, so a
///           constant such as sqrt(2)*sqrt(3) - sqrt(6), or one that is not defined, is kUnknown.
[[nodiscard]] CertainSign certain_sign(const GiNaC::ex& constant);

}  // namespace regulus::detail
