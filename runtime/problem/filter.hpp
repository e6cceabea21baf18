// SPDX-License-Identifier: Apache-2.0
// Calling a regularity test that is not ours.
#pragma once

#include <optional>
#include <string>

#include "runtime/problem/filter.h"

namespace regulus {

/// What is wrong with an interface, in words; nullopt when it can be called.
[[nodiscard]] std::optional<std::string> find_fault(const regulus_filter_interface& filter);

/// The lanes that a filter vouches for.
///
/// Ensures   a subset of boxes.lanes; none if the filter throws or leaves another rounding behind.
///           The caller's floating-point environment is kept.
[[nodiscard]] unsigned call_filter(const regulus_filter_interface& filter,
                                   const regulus_filter_boxes& boxes) noexcept;

}  // namespace regulus
