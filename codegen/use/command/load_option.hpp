// SPDX-License-Identifier: GPL-3.0-or-later
// The option --load of `regulus check` and `regulus locate`.
#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace regulus::detail {

/// Adds --load, and refuses the options that have no meaning together with it, with the reason. Call
/// it after those options are added.
void add_load_option(CLI::App& app, std::optional<std::string>& load);

}  // namespace regulus::detail
