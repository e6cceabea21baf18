// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/kernel/program/program.hpp"

namespace regulus::detail {

/// Returns the same program without the nodes that no output uses, in an order that depends on the
/// outputs alone: depth first from each output in turn, the operand that needs more registers first
/// (Sethi and Ullman, JACM 1970). So values are used soon after they are computed. Constants are
/// numbered by first use.
///
/// Requires  operands come before their use; no two nodes are equal.
[[nodiscard]] Program canonical(Program program);

}  // namespace regulus::detail
