// SPDX-License-Identifier: GPL-3.0-or-later
// One page of several questions about a motion.
#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/answer/ask.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/page_of_answers.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/use/command/commands.hpp"
#include "codegen/use/command/interrupt.hpp"
#include "codegen/use/command/run_question.hpp"
#include "codegen/use/command/shared_options.hpp"
#include "codegen/use/command/terminal.hpp"

namespace regulus::detail {
namespace {

/// Each bracket has a time limit of its own, as `bound` and `margin` have.
SearchOptions search_of_bracket(const ReportCommand& command) {
  SearchOptions search = command.search;
  if (!search.time_limit) search.time_limit = kMarginSeconds;
  return search;
}

/// Returns what a page has beside the check.
std::vector<Asked> more_of(const ReportCommand& command) {
  std::vector<Asked> more;
  if (command.paves)
    more.emplace_back(AskPaving{command.model, command.search, command.resolution});
  for (const std::string& quantity : command.bounds)
    more.emplace_back(AskBound{command.model,
                               search_of_bracket(command),
                               {.quantity = quantity, .load = command.load, .twist = command.twist},
                               "",
                               command.gap});
  for (const std::string& margin : command.margins) {
    AskMargin asked{command.model, search_of_bracket(command), {}, {}, "", command.gap};
    asked.model.tolerances.push_back(margin);
    more.emplace_back(std::move(asked));
  }
  return more;
}

Services services_of(const ReportCommand& command, InterruptGuard& interrupt) {
  Services services;
  services.dashes = "--";
  services.shows_progress = !command.output.quiet;
  services.interrupt = &interrupt.requested();
  services.on_search = [&interrupt] { interrupt.begin_search(); };
  return services;
}

}  // namespace

int run_report(const ReportCommand& command, const std::string& typed) {
  static_cast<void>(read_gap(command.gap));
  set_outputs_aside(command.model, command.search, {}, {{"--output", command.page, true}});
  PageOfAnswers page(PageTemplate::installed(), command.model, typed);
  InterruptGuard interrupt;
  const Services services = services_of(command, interrupt);
  const auto check = ask_for_page(AskCheck{command.model, command.search}, services, page);
  if (!command.output.quiet) print_report(check->text());
  for (const Asked& asked : more_of(command))
    static_cast<void>(ask_for_page(asked, services, page));
  const bool is_written = check->write_beside([&] {
    const std::size_t size = page.write(command.page);
    if (!command.output.quiet)
      print_report(fmt::format("page       {}, {:.0f} kB\n", command.page, double(size) / 1000));
  });
  if (command.output.json) {
    nlohmann::ordered_json report = check->json();
    if (is_written) report["page"] = command.page;
    std::cout << report_text(report, command.output.json_indent) << '\n';
  } else {
    std::cout << check->headline() << '\n';
  }
  std::cout.flush();
  print_lost(*check);
  return end_answer(*check, command.output, interrupt.requested());
}

}  // namespace regulus::detail
