// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "tests/bench/report/row.hpp"

namespace regulus::detail::bench {

/// Times whole searches, on every instruction set and one box at a time.
[[nodiscard]] Section search_rows();

/// Times the same for one problem that is not from the paper.
struct SearchCase;
[[nodiscard]] Section rows_of(const SearchCase& which);

/// Runs nothing but one search, on the best instruction set, by one solver or by a new one each time;
/// returns the least time of a run.
[[nodiscard]] double least_microseconds(const SearchCase& which, std::size_t runs, bool anew);

/// Compares the product K·J⁻¹ formed symbolically with the product formed from numbers.
[[nodiscard]] Section product_rows();

/// Compares compiled code with the vector machine.
[[nodiscard]] Section engine_rows();

/// Compares one thread with two.
[[nodiscard]] Section thread_rows();

}  // namespace regulus::detail::bench
