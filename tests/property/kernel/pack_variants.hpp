// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/isa.hpp"
#include "tests/property/kernel/pack_operations.hpp"

namespace regulus::detail::test {

/// The packs as one compiler compiled them.
struct Variant {
  std::string_view name;  ///< "g++ -O2 avx512"
  Isa isa;
  bool primary;  ///< made by the compiler of this build, at -O2
  EvaluatePack evaluate;
};

/// Returns those that this processor can run.
[[nodiscard]] std::vector<Variant> variants();

/// The self-test for AVX2, compiled with optimisation and without the project's rounding flags.
struct Unflagged {
  std::string_view compiler;
  regulus_function self_test;
};
[[nodiscard]] std::span<const Unflagged> unflagged_self_tests();

}  // namespace regulus::detail::test
