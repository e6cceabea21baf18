// SPDX-License-Identifier: Apache-2.0
// Calls a user's regularity test.
#pragma once

#include <optional>
#include <string>

#include "runtime/problem/filter.h"

namespace regulus {

/// Returns the fault of an interface, in words; nullopt if it can be called.
[[nodiscard]] std::optional<std::string> find_fault(const regulus_filter_interface& filter);

/// Returns the lanes that a filter certifies.
///
/// Ensures   a subset of boxes.lanes; none if the filter throws or changes the rounding.
///           The caller's floating-point environment is kept.
[[nodiscard]] unsigned call_filter(const regulus_filter_interface& filter,
                                   const regulus_filter_boxes& boxes) noexcept;

}  // namespace regulus
