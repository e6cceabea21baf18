// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/error_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "codegen/answer/report/report_text.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

const char* word_of_exit(ExitCode code) {
  switch (code) {
    case kUsageError:
      return "usage";
    case kBadInput:
      return "input";
    case kFileError:
      return "file";
    case kInternalFault:
    case kNoSingularity:
    case kSingularity:
    case kPossibleProblem:
      break;
  }
  return "internal";
}

}  // namespace

ErrorFormat error_format(int argc, const char* const* argv) {
  const bool is_json = std::any_of(
      argv, argv + argc, [](const char* word) { return std::string_view(word) == "--json"; });
  return is_json ? ErrorFormat::kJson : ErrorFormat::kText;
}

std::string json_error(const std::exception& error, ExitCode code) {
  nlohmann::ordered_json object = {
      {"kind", word_of_exit(code)}, {"message", error.what()}, {"exit", static_cast<int>(code)}};
  if (const auto* input = dynamic_cast<const InputError*>(&error)) {
    object["file"] = input->file();
    object["line"] = input->line();
    object["problem"] = input->found();
    object["remedy"] = input->expected();
    object["symbol"] = input->symbol();
  }
  const nlohmann::ordered_json report = {{"error", object}};
  return report_text(report);
}

}  // namespace regulus::detail
