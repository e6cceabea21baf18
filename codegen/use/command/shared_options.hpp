// SPDX-License-Identifier: GPL-3.0-or-later
// The options that several commands have.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "codegen/use/command/command_line.hpp"

namespace regulus::detail {

/// The time limit of commands that search at many values.
constexpr double kMarginSeconds = 60;

void add_model_arguments(CLI::App& app, ModelOptions& options);
/// The arguments MODEL and MOTION, and the options that change them.
void add_model_options(CLI::App& app, ModelOptions& options);
void add_waypoint_options(CLI::App& app, ModelOptions& options);
void add_method_options(CLI::App& app, Method& method, std::uint64_t& budget);
void add_filter_option(CLI::App& app, SearchOptions& options);
void add_kernel_option(CLI::App& app, SearchOptions& options);
void add_search_options(CLI::App& app, SearchOptions& options);
void add_output_options(CLI::App& app, OutputOptions& options);
void add_page_option(CLI::App& app, OutputOptions& options);
void add_checkpoint_options(CLI::App& app, CheckpointOptions& options);
/// Adds the checkpoint of brackets.
void add_bracket_checkpoint(CLI::App& app, std::string& path);

}  // namespace regulus::detail
