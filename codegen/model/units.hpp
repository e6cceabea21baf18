// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string_view>

namespace regulus::detail {

/// Returns the exact factor that turns a number in `from` into one in `to`: units of length, of an
/// angle, or one label twice. nullopt if the units are of different kinds, or not known.
[[nodiscard]] std::optional<GiNaC::ex> unit_factor(std::string_view from, std::string_view to);

/// True for the name of a unit that is known.
[[nodiscard]] bool is_unit(std::string_view name) noexcept;

}  // namespace regulus::detail
