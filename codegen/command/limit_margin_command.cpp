// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus margin --quantity Q --limit L`.
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/bound/bound_question.hpp"
#include "codegen/bound/bound_run.hpp"
#include "codegen/bound/limit_margin.hpp"
#include "codegen/command/answer.hpp"
#include "codegen/command/command_files.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/command/interrupt.hpp"
#include "codegen/margin/margin_report.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/exit_code.hpp"

namespace regulus::inline command {
namespace {

int exit_code_of_bracket(const MarginQuestion& question, const Margin& margin) {
  if (margin.refuted && margin.refuted->value.approx <= question.low.approx) return kSingularity;
  return margin.closed ? kNoSingularity : kPossibleProblem;
}

LimitMarginSettings settings_of(const MarginCommand& command) {
  LimitMarginSettings settings;
  settings.gap = read_gap(command.gap);
  settings.search = command.search;
  settings.output = command.output;
  settings.certificate = command.certificate;
  return settings;
}

/// Returns everything that the bracket depends on.
nlohmann::ordered_json question_of(const Request& request, const MarginQuestion& question,
                                   const Quantity& quantity, const MarginCommand& command) {
  auto text = checkpointed_question(request, quantity, command.search);
  text["margin"] = describe_quantity(question);
  text["limit"] = command.limit;
  return text;
}

}  // namespace

std::optional<int> run_limit_margin(const MarginCommand& given) {
  if (given.limit.empty() && given.quantity.quantity.empty()) return std::nullopt;
  if (given.limit.empty() || given.quantity.quantity.empty())
    throw UsageError("margin: --quantity and --limit need each other");
  MarginCommand command = given;
  LimitMarginSettings settings = settings_of(command);
  const MarginQuestion question = take_question(command.model, command.size);
  const Request request = read_asked(command.model, command.quantity);
  Quantity quantity = quantity_of(request.model, command.quantity);
  settings.limit = read_limit(command.limit, quantity);
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
    checkpoint.emplace(command.checkpoint, question_of(request, question, quantity, command));
    settings.checkpoint = &*checkpoint;
  }

  const bool quiet = command.output.quiet;
  const LimitMargin margin = limit_margin(request, question, std::move(quantity), settings,
                                          [quiet](const MarginStep& step) {
                                            if (!quiet) std::cerr << format_step(step);
                                          });
  held.put_in_place();
  if (!quiet) print_report(limit_margin_report(request, question, margin, settings));
  if (checkpoint) print_report(checkpoint->line());
  if (command.output.json)
    std::cout << report_text(json_limit_margin(request, question, margin, settings),
                             command.output.json_indent)
              << '\n';
  else
    print_answer(describe_limit_bracket(question, margin),
                 exit_code_of_bracket(question, margin.whole));
  std::cout.flush();
  return exit_code_of_bracket(question, margin.whole);
}

}  // namespace regulus::command
