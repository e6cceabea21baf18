// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/run_question.hpp"

#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/answer/ask.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/terminal_width.hpp"
#include "codegen/use/command/interrupt.hpp"
#include "codegen/use/command/terminal.hpp"

namespace regulus::detail {
namespace {

/// What every command wants.
Services services_of(const OutputOptions& output) {
  Services services;
  services.dashes = "--";
  services.shows_progress = !output.quiet;
  services.page = output.page;
  if (!output.quiet) services.on_line = [](const std::string& line) { print_report(line); };
  return services;
}

/// Of those with proofs.
template <class Command>
Services services_of(const Command& command) {
  Services services = services_of(command.output);
  services.certificate = command.certificate;
  services.shard_size = command.shard_size;
  return services;
}

/// Sends the JSON lines to standard output.
void print_lines(CommandQuestion& question) {
  if (question.output.json)
    throw UsageError("--json and --output - both write to standard output; use one of them");
  question.prints_lines = true;
  question.services.lines = {"", &std::cout, "standard output"};
}

void print(const Answer& answer, const CommandQuestion& question) {
  const OutputOptions& output = question.output;
  Facts facts(!output.json ? Readers::kPeople : output.quiet ? Readers::kPrograms : Readers::kBoth);
  if (output.json || !output.quiet) answer.tell(facts);
  if (!output.quiet) print_report(facts.text() + answer.about_files());
  print_report(answer.warning());
  if (output.json)
    std::cout << report_text(facts.report(), output.json_indent) << '\n';
  else if (std::holds_alternative<AskDatasheet>(question.asked))
    std::cout << answer.headline();
  else if (!question.prints_lines)
    print_answer(answer.headline(), exit_code_of(answer.word()));
  else if (!output.quiet)
    std::cerr << answer.headline() << '\n';
  std::cout.flush();
  // Without a report nothing else says so.
  if (const std::string why = answer.missing_proof(); output.quiet && !output.json && !why.empty())
    std::cerr << "regulus: no certificate was written: " << why << '\n';
  print_lost(answer);
}

}  // namespace

CommandQuestion question_of(const CheckCommand& command) {
  CommandQuestion question{AskCheck{command.model, command.search}, command.output};
  if (command.load) question.asked = AskLoad{command.model, command.search, *command.load};
  question.services = services_of(command);
  question.services.checkpoint = command.checkpoint;
  return question;
}

CommandQuestion question_of(const LocateCommand& command) {
  CommandQuestion question{AskPaving{command.model, command.search, command.resolution},
                           command.output};
  if (command.load)
    question.asked =
        AskLoadPaving{command.model, command.search, *command.load, command.resolution};
  Services& services = question.services = services_of(command);
  services.pictures = command.pictures;
  services.checkpoint = command.checkpoint;
  if (!command.output.quiet && ::isatty(STDERR_FILENO) != 0)
    services.pictures.map_columns = columns_of_terminal(STDERR_FILENO);
  services.lines.file = command.lines;
  if (command.lines == "-") print_lines(question);
  return question;
}

CommandQuestion question_of(const MarginCommand& command) {
  CommandQuestion question{AskMargin{command.model, command.search, command.size, command.quantity,
                                     command.limit, command.gap},
                           command.output, services_of(command)};
  question.services.checkpoint.path = command.checkpoint;
  return question;
}

CommandQuestion question_of(const BoundCommand& given) {
  const BoundCommand command = with_quantity(given);
  CommandQuestion question{
      AskBound{command.model, command.search, command.quantity, command.limit, command.gap},
      command.output, services_of(command)};
  question.services.checkpoint.path = command.checkpoint;
  return question;
}

CommandQuestion question_of(const DatasheetCommand& command) {
  CommandQuestion question{
      AskDatasheet{command.model, command.search, command.gap, command.markdown}, command.output,
      services_of(command)};
  question.services.checkpoint.path = command.checkpoint;
  return question;
}

CommandQuestion question_of(const SolveCommand& command) {
  CommandQuestion question{AskSolve{command.model, command.search, command.held, command.table},
                           command.output, services_of(command.output)};
  question.services.certificate = command.certificate;
  question.services.shard_size = command.shard_size;
  question.services.checkpoint = command.checkpoint;
  question.services.lines.file = command.lines;
  if (command.lines == "-") print_lines(question);
  return question;
}

int run_question(CommandQuestion question, const std::string& typed) {
  InterruptGuard interrupt;
  question.services.interrupt = &interrupt.requested();
  question.services.typed = typed;
  question.services.on_search = [&interrupt] { interrupt.begin_search(); };
  const std::unique_ptr<Answer> answer = ask_and_show(question.asked, question.services);
  print(*answer, question);
  return end_answer(*answer, question.output, interrupt.requested());
}

void print_lost(const Answer& answer) {
  for (const std::string& why : answer.lost) std::cerr << "regulus: " << why << '\n';
}

int end_answer(Answer& answer, const OutputOptions& output, const std::atomic<bool>& interrupted) {
  const int code = answer.lost.empty() ? int{exit_code_of(answer.word())} : int{kFileError};
  if (!std::cout) return code;
  const Answer::Rest rest = answer.wait_for_rest(interrupted);
  if (rest.is_at_work) {
    std::fflush(nullptr);
    ::_exit(code);
  }
  if (!output.quiet) std::cerr << rest.note;
  return code;
}

}  // namespace regulus::detail
