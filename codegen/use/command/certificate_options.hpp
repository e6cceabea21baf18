// SPDX-License-Identifier: GPL-3.0-or-later
// The options that write and check certificates.
#pragma once

#include <cstdint>
#include <string>

#include "codegen/use/command/command_line.hpp"

namespace CLI {
class App;
}

namespace regulus::detail {

/// `what` names the subject of the proof.
void add_certificate_option(CLI::App& app, std::string& path, const std::string& what);
void add_shard_option(CLI::App& app, std::uint64_t& size);
void add_verify_options(CLI::App& app, VerifyCommand& command);

}  // namespace regulus::detail
