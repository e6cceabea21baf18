// SPDX-License-Identifier: GPL-3.0-or-later
// What is told of the lost twists and the dependent rows.
#pragma once

#include <optional>

#include "codegen/answer/facts.hpp"
#include "codegen/question/analysis/lost_twist.hpp"

namespace regulus::detail {

/// Tells `nullity`, `singular_values`, `twist` and `rows`. For programs the last two are null if
/// nothing is lost, and all of them if J⁻¹ has no value.
void tell_degeneracy(const SearchSubject& preparation, const std::optional<Degeneracy>& degeneracy,
                     Facts& facts);

}  // namespace regulus::detail
