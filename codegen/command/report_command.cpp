// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "codegen/answer/outputs.hpp"
#include "codegen/command/answer.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/command/page_run.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/page/page_template.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/write_file.hpp"

namespace regulus::inline command {

int run_report(const ReportCommand& command, const std::string& typed) {
  const PageTemplate page = PageTemplate::installed();
  static_cast<void>(read_gap(command.gap));
  for (const std::string& file : command.from)
    if (std::error_code ec; std::filesystem::equivalent(file, command.page, ec))
      throw UsageError("--output: " + command.page + " is read by --from; give another file");
  set_outputs_aside(command.model, command.search, {}, {{"--output", command.page, true}});
  PageRun run(command, typed);
  run.run();
  const PageTexts texts = run.texts();
  const std::string text = page.fill(texts);
  write_file(command.page, text);
  if (!command.output.quiet)
    print_report(
        fmt::format("page       {}, {:.0f} kB\n", command.page, double(text.size()) / 1000));
  if (command.output.json)
    std::cout << report_text(run.json_report(command.page), command.output.json_indent) << '\n';
  else
    std::cout << texts.verdict << '\n';
  return run.end();
}

}  // namespace regulus::command
