// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "codegen/command/commands.hpp"
#include "codegen/command/page_run.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/page/page_template.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/atomic_file.hpp"

namespace regulus::inline command {
namespace {

void write_page(const std::string& path, const std::string& text) try {
  AtomicFile file(path);
  file.write(text);
  file.put_in_place();
} catch (const std::system_error& error) {
  throw FileError(path + " cannot " + error.what());
}

}  // namespace

int run_report(const ReportCommand& command, const std::string& typed) {
  const PageTemplate page = PageTemplate::installed();
  static_cast<void>(read_gap(command.gap));
  for (const std::string& file : command.from)
    if (std::error_code ec; std::filesystem::equivalent(file, command.page, ec))
      throw UsageError("--output: " + command.page + " is read by --from; give another file");
  set_earlier_outputs_aside(command.model.path, {{"--output", command.page, true}});
  PageRun run(command, typed);
  run.run();
  const PageTexts texts = run.texts();
  const std::string text = page.fill(texts);
  write_page(command.page, text);
  if (!command.output.quiet)
    std::cerr << fmt::format("page       {}, {:.0f} kB\n", command.page,
                             double(text.size()) / 1000);
  if (command.output.json)
    std::cout << run.json_report(command.page).dump(command.output.json_indent) << '\n';
  else
    std::cout << texts.verdict << '\n';
  return run.end();
}

}  // namespace regulus::command
