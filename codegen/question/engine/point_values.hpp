// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/kernel/program/program.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Returns approximate outputs of a program without points, at the middles of `variables`. It uses
/// enough bits that rounding errors do not hide the values; nullopt if one is undefined or too
/// large.
[[nodiscard]] std::optional<std::vector<double>> approx_values(const Program& program,
                                                               std::span<const Interval> variables);

}  // namespace regulus::detail
