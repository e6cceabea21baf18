// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <nlohmann/json.hpp>

#include "regulus/codegen/driver/commands.hpp"
#include "regulus/codegen/driver/interrupt.hpp"
#include "regulus/codegen/driver/margin_report.hpp"
#include "regulus/codegen/driver/margin_run.hpp"
#include "regulus/codegen/driver/progress.hpp"
#include "regulus/codegen/driver/search_run.hpp"
#include "regulus/codegen/driver/settings.hpp"
#include "regulus/codegen/model/expression_parser.hpp"
#include "regulus/codegen/model/sign.hpp"

namespace regulus::codegen {
namespace {

double read_gap(const std::string& text) {
  double gap = 0;
  from_option("--gap", [&] {
    gap = approx_value(parse_constant(text, {.file = "", .key = "--gap"}).value).value_or(0);
  });
  if (!(gap > 0 && gap < 1))
    throw UsageError("--gap: found " + text + ", expected a number between 0 and 1");
  return gap;
}

/// The value at which the kernel is formed, which is the same at all: one that is not 0, where
/// quantities would not be uncertain at all.
MarginValue forming_value(const MarginQuestion& question) {
  return question.high ? *question.high : decimal_value(1);
}

int exit_code_of(const MarginQuestion& question, const Margin& margin) {
  if (margin.refuted && margin.refuted->value.approx <= question.low.approx) return kSingularity;
  return margin.closed && margin.certified ? kNoSingularity : kPossibleProblem;
}

void require_searchable(const Preparation& preparation, const Settings& settings) {
  if (const auto fault = find_fault(preparation.problem(), settings))
    throw UsageError("margin: " + *fault);
}

}  // namespace

int run_margin(const MarginCommand& given) {
  MarginCommand command = given;
  const double gap = read_gap(command.gap);
  const MarginQuestion question = take_question(command);
  set_earlier_outputs_aside(command.model.path, MarginCertificates::files(command.certificate));
  InterruptGuard interrupt;
  Stopwatch watch;
  const MarginRequest request(read_request(command.model), question);
  command.search.threshold = true;
  Preparation preparation =
      prepare(request.at(forming_value(question)), watch.lap(), command.search,
              forming_watch(command.output, &interrupt.requested()));
  Settings settings = settings_from(command.search);
  settings.interrupt = &interrupt.requested();
  settings.time_limit = seconds_left(preparation, settings.time_limit);
  interrupt.begin_search();
  for (const FilterFile& filter : preparation.filters)
    settings.filters.push_back(&filter.interface());
  if (preparation.stopped) settings.method = Method::kAuto;  // as run_search has it
  require_searchable(preparation, settings);

  const bool quiet = command.output.quiet;
  MarginCertificates certificates(command.certificate, request, preparation.subject);
  MarginRun run(preparation, question, request, command, settings, gap, certificates,
                [quiet](const MarginStep& step) {
                  if (!quiet) std::cerr << step_line(step);
                });
  const Margin margin = run.run();
  preparation.seconds.search = margin.seconds;
  if (!quiet)
    std::cerr << margin_report(preparation, command.search, question, margin)
              << certificates.lines();
  if (command.output.json) {
    nlohmann::ordered_json report = json_margin(preparation, command.search, question, margin, gap);
    certificates.add_to(report);
    std::cout << report.dump(command.output.json_indent) << '\n';
  } else {
    std::cout << bracket_words(question, margin) << '\n';
  }
  std::cout.flush();
  return exit_code_of(question, margin);
}

}  // namespace regulus::codegen
