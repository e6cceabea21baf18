// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "codegen/bound/bound_report.hpp"
#include "codegen/bound/datasheet.hpp"
#include "codegen/command/command_files.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/command/interrupt.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/exit_code.hpp"

namespace regulus::inline command {
namespace {

int exit_code_of(const Model& model, const Datasheet& sheet) {
  // A sheet without a row answers nothing.
  bool is_closed = !sheet.is_interrupted && !sheet.bounds.empty();
  for (const Bound& bound : sheet.bounds) {
    is_closed = is_closed && bound.is_closed();
    for (const ComponentBound& c : bound.components)
      if (c.is_unbounded || limit_state(model, c) == LimitState::kExceeded) return kSingularity;
  }
  return is_closed ? kNoSingularity : kPossibleProblem;
}

std::string proof_lines(const Datasheet& sheet) {
  std::string lines;
  for (const Bound& bound : sheet.bounds)
    for (const ComponentBound& c : bound.components) lines += c.proofs.lines();
  return lines;
}

void print(const DatasheetCommand& command, const Request& request, const Datasheet& sheet,
           const BoundSettings& settings) {
  if (command.output.json)
    std::cout << report_text(json_datasheet(request, sheet, settings), command.output.json_indent)
              << '\n';
  else if (command.markdown)
    std::cout << markdown_datasheet(request, sheet);
  else
    std::cout << text_datasheet(request, sheet);
  std::cout.flush();
}

}  // namespace

int run_datasheet(const DatasheetCommand& command) {
  refuse_threshold(command.model);
  BoundSettings settings;
  settings.gap = read_gap(command.gap);
  settings.search = command.search;
  settings.output = command.output;
  settings.certificate = command.certificate;
  const Request request = read_request(command.model);
  std::vector<OutputFile> outputs = datasheet_files(request, command.certificate);
  outputs.push_back(checkpoint_file(command.checkpoint));
  set_earlier_outputs_aside(input_files(command.model, command.search), outputs);
  InterruptGuard interrupt;
  settings.interrupt = &interrupt.requested();
  interrupt.begin_search();
  HeldFiles held;
  settings.held = &held;
  std::optional<BoundCheckpoint> checkpoint;
  if (!command.checkpoint.empty()) {
    checkpoint.emplace(command.checkpoint, checkpointed_datasheet(request, command.search));
    settings.checkpoint = &*checkpoint;
  }
  if (!command.output.quiet)
    std::cerr << fmt::format("model      {}\nmotion     {}\n", request.model.name,
                             request.motion.name);
  const Datasheet sheet = make_datasheet(request, settings, [](const ComponentBound&) {});
  held.put_in_place();
  if (!command.output.quiet) std::cerr << proof_lines(sheet);
  if (checkpoint) std::cerr << checkpoint->line();
  print(command, request, sheet, settings);
  return exit_code_of(request.model, sheet);
}

}  // namespace regulus::command
