// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "codegen/model/drawing.hpp"
#include "codegen/model/mechanism/legs.hpp"

namespace regulus::detail {

/// Returns base, platform and legs. `value` reads a formula in the names of the model.
[[nodiscard]] Drawing legs_drawing(const std::vector<LegPoints>& legs,
                                   const std::function<GiNaC::ex(const Formula&)>& value);

}  // namespace regulus::detail
