// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/bench/report/row.hpp"

namespace regulus::bench {

/// Whole searches, on every instruction set and one box at a time.
[[nodiscard]] Section search_rows();

/// The same of one problem that is not the paper's.
struct SearchCase;
[[nodiscard]] Section rows_of(const SearchCase& which);

/// The product K·J⁻¹ formed symbolically, and from numbers.
[[nodiscard]] Section product_rows();

/// Compiled code and the vector machine.
[[nodiscard]] Section engine_rows();

/// One thread and two.
[[nodiscard]] Section thread_rows();

}  // namespace regulus::bench
