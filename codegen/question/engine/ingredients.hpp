// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the method that `--without` switches off: each name, its meaning, and its switch.
#pragma once

#include <string>
#include <vector>

#include "codegen/kernel/formulation/formulation.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

[[nodiscard]] std::vector<std::string> ingredient_names();

/// Returns the text of --help: every name and its meaning.
[[nodiscard]] std::string describe_ingredient();

/// Switches off the named ingredients in the search and in the symbolic stage. A search never
/// depends on the latter: a kernel may have more functions than the search uses, or fewer.
void leave_out(const std::vector<std::string>& names, Settings& settings);
void leave_out(const std::vector<std::string>& names, FormulationOptions& functions);

}  // namespace regulus::detail
