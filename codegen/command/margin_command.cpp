// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/command/answer.hpp"
#include "codegen/command/command_files.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/command/interrupt.hpp"
#include "codegen/margin/margin_report.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/margin/variety_attempts.hpp"
#include "codegen/report/progress.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/exit_code.hpp"
#include "codegen/trajectory/margin_checkpoint.hpp"

namespace regulus::inline command {
int exit_code_of_margin(const MarginQuestion& question, const Margin& margin) {
  if (margin.refuted && margin.refuted->value.approx <= question.low.approx) return kSingularity;
  return margin.closed && margin.certified ? kNoSingularity : kPossibleProblem;
}

int run_margin(const MarginCommand& given) {
  if (const std::optional<int> code = run_limit_margin(given)) return *code;
  MarginCommand command = given;
  const double gap = read_gap(command.gap);
  const MarginQuestion question = take_question(command.model, command.size);
  std::vector<OutputFile> outputs = EndProofs::files(command.certificate);
  outputs.push_back(checkpoint_file(command.checkpoint));
  set_earlier_outputs_aside(input_files(command.model, command.search), outputs);
  Request request = read_request(command.model);
  if (request.motion.trajectory)
    return run_trajectory_margin(command, question, std::move(request));
  MarginCheckpoint checkpoint(command.checkpoint, request, question, command.search);
  InterruptGuard interrupt;
  PreparedMargin margin(question, std::move(request), 0, compiled_first(command.search),
                        forming_watch(command.output, &interrupt.requested()));
  margin.settings.interrupt = &interrupt.requested();
  interrupt.begin_search();

  const bool quiet = command.output.quiet;
  HeldFiles held;
  VarietyAttempts attempts(margin, question, command.output,
                           margin_proofs(command.certificate, &held));
  const Margin found = close_bracket(attempts, question,
                                     {limits_of(margin.settings, gap), &interrupt.requested(),
                                      [quiet](const MarginStep& step) {
                                        if (!quiet) std::cerr << format_step(step);
                                      },
                                      checkpoint.searches()});
  held.put_in_place();
  margin.prepared.seconds.search = found.seconds;
  if (!quiet)
    print_report(margin_report(margin.prepared, margin.search, question, found) +
                 attempts.proofs().lines() + checkpoint.line());
  if (command.output.json) {
    nlohmann::ordered_json report =
        json_margin(margin.prepared, margin.search, margin.request.nominal(), question, found, gap);
    attempts.proofs().add_to(report);
    std::cout << report_text(report, command.output.json_indent) << '\n';
  } else {
    print_answer(describe_bracket(question, found), exit_code_of_margin(question, found));
  }
  std::cout.flush();
  return exit_code_of_margin(question, found);
}

}  // namespace regulus::command
