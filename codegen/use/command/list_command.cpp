// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/model_report.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/model/file/installed_models.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/use/command/commands.hpp"
#include "codegen/use/command/terminal.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

int list_installed(const ListCommand& command) {
  Json all = Json::array();
  std::string text;
  for (const InstalledModel& installed : installed_models()) {
    const Model model = load_model(installed.path);
    all.push_back({{"name", installed.name},
                   {"title", model.name},
                   {"file", installed.path.string()},
                   {"motions", model.motions.size()}});
    text += command.quiet ? installed.name + '\n'
                          : fmt::format("{:<20} {}, {} motion{}\n", installed.name, model.name,
                                        model.motions.size(), model.motions.size() == 1 ? "" : "s");
  }
  const std::string folder = model_folder().string();
  if (command.json)
    std::cout << report_text({{"folder", folder}, {"models", all}}) << '\n';
  else
    std::cout << (text.empty() ? "no models in " + folder + '\n' : text);
  return 0;
}

std::string names_of_motions(const Model& model) {
  std::string names;
  for (const Motion& motion : model.motions) names += motion.name + '\n';
  return names;
}

}  // namespace

int run_list(const ListCommand& command) {
  if (command.path.empty()) return list_installed(command);
  const Model model = load_model(command.path);
  std::cout << (command.json    ? report_text(json_model(model)) + '\n'
                : command.quiet ? names_of_motions(model)
                                : for_file(STDOUT_FILENO, format_model(model)));
  return 0;
}

}  // namespace regulus::detail
