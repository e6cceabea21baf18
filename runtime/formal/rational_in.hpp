// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "runtime/verifier/ball.hpp"
#include "runtime/verifier/rational.hpp"

namespace regulus::verifier {

/// Returns the rational number of smallest height in a narrow ball, by its continued fraction; nullopt
/// if it is not found.
[[nodiscard]] std::optional<Rational> rational_in(const Ball& ball);

}  // namespace regulus::verifier
