// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "codegen/model/mechanism/legs.hpp"
#include "codegen/model/model.hpp"

namespace regulus::detail {

/// Returns the legs of a platform if the motors set the lengths of all, and nothing else keeps it:
/// three in the plane, six in space; else none. `value` reads a formula in the names of the model.
[[nodiscard]] std::vector<ExtensibleLeg> extensible_legs(
    const Legs& robot, const std::function<GiNaC::ex(const Formula&)>& value);

}  // namespace regulus::detail
