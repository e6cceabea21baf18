// SPDX-License-Identifier: GPL-3.0-or-later
// The twist of a set for which a motor turns fastest.
#pragma once

#include "codegen/model/request.hpp"
#include "codegen/question/bound/attained_place.hpp"
#include "codegen/question/quantity/quantity.hpp"

namespace regulus::detail {

/// Appends the twist of component.set that the speed at `place` belongs to, approximately.
///
/// Requires  the component is a speed of request.model.
void add_fastest_twist(AttainedPlace& place, const Request& request, const Component& component);

}  // namespace regulus::detail
