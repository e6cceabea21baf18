// SPDX-License-Identifier: GPL-3.0-or-later
// What `--without` leaves out, by name: each name, what it means, and which switch it is.
#pragma once

#include <string>
#include <vector>

#include "codegen/formulation/formulation.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::inline engine {

[[nodiscard]] std::vector<std::string> ingredient_names();

/// Of --help: every name and what it means.
[[nodiscard]] std::string describe_ingredient();

/// What the named ingredients are to the search and to the symbolic stage. A search never depends
/// on the latter having been told: a kernel may have more than it uses, or less.
void leave_out(const std::vector<std::string>& names, Settings& settings);
void leave_out(const std::vector<std::string>& names, FormulationOptions& functions);

}  // namespace regulus::inline engine
