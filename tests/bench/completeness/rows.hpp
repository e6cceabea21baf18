// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::detail::bench {

/// Counts random models that are decided, with and without a singularity that is known to be there.
[[nodiscard]] Section completeness_rows();

/// Compares both ends of margins.
[[nodiscard]] Section margin_rows();

}  // namespace regulus::detail::bench
