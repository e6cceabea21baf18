// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/bound/bound_question.hpp"
#include "codegen/bound/bound_report.hpp"
#include "codegen/bound/bound_run.hpp"
#include "codegen/bound/condition_run.hpp"
#include "codegen/command/answer.hpp"
#include "codegen/command/command_files.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/command/interrupt.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/exit_code.hpp"

namespace regulus::inline command {
namespace {

int exit_code_of(const Bound& bound, const BoundSettings& settings) {
  if (settings.limit) {
    switch (bound.verdict()) {
      case LimitVerdict::kWithin:
        return kNoSingularity;
      case LimitVerdict::kExceeded:
        return kSingularity;
      case LimitVerdict::kUndecided:
        return kPossibleProblem;
    }
  }
  if (std::ranges::any_of(bound.components, &ComponentBound::is_unbounded)) return kSingularity;
  return bound.is_closed() ? kNoSingularity : kPossibleProblem;
}

}  // namespace

int run_bound(const BoundCommand& given) {
  const BoundCommand command = with_quantity(given);
  BoundQuestion question = read_bound_question(command.model, command.quantity, command.limit);
  const Request& request = question.request;
  Quantity& quantity = question.quantity;
  BoundSettings settings;
  settings.gap = read_gap(command.gap);
  settings.limit = question.limit;
  settings.search = command.search;
  settings.output = command.output;
  settings.certificate = command.certificate;
  if (settings.limit && !command.checkpoint.empty() && quantity.kind != QuantityKind::kCondition2)
    throw UsageError("--checkpoint: with --limit there is one search and no bracket to continue");
  refuse_unsupported(request, quantity);
  std::vector<OutputFile> outputs = certificate_files(quantity, command.certificate);
  outputs.push_back(checkpoint_file(command.checkpoint));
  set_earlier_outputs_aside(input_files(command.model, command.search), outputs);
  InterruptGuard interrupt;
  settings.interrupt = &interrupt.requested();
  interrupt.begin_search();
  HeldFiles held;
  settings.held = &held;
  std::optional<BoundCheckpoint> checkpoint;
  if (!command.checkpoint.empty()) {
    checkpoint.emplace(command.checkpoint,
                       checkpointed_question(request, quantity, command.search));
    settings.checkpoint = &*checkpoint;
  }

  const bool quiet = command.output.quiet;
  if (!quiet)
    std::cerr << fmt::format("model      {}\nmotion     {}\nbound      {}\n", request.model.name,
                             request.motion.name, quantity.name);
  const Bound bound =
      bound_quantity(request, std::move(quantity), settings, [&](const ComponentBound& component) {
        if (!quiet) std::cerr << format_component(component, settings.limit.has_value());
      });
  held.put_in_place();
  if (!quiet) print_report(bound_report(request, bound, settings));
  if (checkpoint) print_report(checkpoint->line());
  if (command.output.json)
    std::cout << report_text(json_bound(request, bound, settings), command.output.json_indent)
              << '\n';
  else
    print_answer(describe_bound(bound, settings), exit_code_of(bound, settings));
  std::cout.flush();
  return exit_code_of(bound, settings);
}

}  // namespace regulus::command
