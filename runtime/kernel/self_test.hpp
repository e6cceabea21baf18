// SPDX-License-Identifier: Apache-2.0
// Tests whether compiled code rounds its bounds outward, by running it.
//
// A compiler may merge the two roundings of 1/3, fold 0.1·3 to nearest, or negate a product after
// rounding it. A library may make the processor flush subnormals to zero. Then enclosures miss the
// true value, and look like any others. The test detects each of these before a verdict depends on
// it.
#pragma once

#include <optional>
#include <string>

#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/isa.hpp"

namespace regulus {

/// The text of a program that defines `kSelfTestSymbol`, a regulus_function. It needs the headers
/// of runtime/kernel/kernel_headers.hpp and the compile flags of the tested instruction set.
extern const char* const kSelfTestSource;
inline constexpr const char* kSelfTestSymbol = "regulus_self_test";

/// Runs a compiled kSelfTestSource and compares every lane with the known results.
///
/// Requires  `function` was compiled for `isa`, and supported(isa). It is called with `context`.
/// Ensures   nullopt if every true result is enclosed, by bounds within a few doubles of it;
///           otherwise a text with the computed and the true result.
/// Rounding  as `function` needs; the caller's environment is restored.
[[nodiscard]] std::optional<std::string> check_self_test(regulus_function function, Isa isa,
                                                         const void* context = nullptr);

/// Does the same for the packs that were compiled ahead of time into this library.
[[nodiscard]] std::optional<std::string> self_test(Isa isa);

/// Checks the outputs of the self-test, for a caller who chooses the rounding mode.
///
/// Ensures   nullopt or a failure, as check_self_test. The floating-point environment of the caller
///           is used as it is.
[[nodiscard]] std::optional<std::string> check_self_test_as_is(regulus_function function,
                                                               const void* context = nullptr);

}  // namespace regulus
