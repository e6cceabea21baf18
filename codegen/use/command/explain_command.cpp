// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/report_text.hpp"
#include "codegen/kernel/formulation/explain.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/support/exit_code.hpp"
#include "codegen/use/command/commands.hpp"

namespace regulus {
namespace {

/// Shows the forms; without a motion, over the pose parameters themselves.
Explanation forms(const ExplainCommand& command) {
  ExplainOptions options;
  options.all_entries = command.all_entries;
  constexpr std::size_t kWhole = std::size_t{1} << 28;  // what a terminal or a file can still hold
  if (command.all_entries) options.longest = kWhole;
  options.part = command.stage == "matrix"        ? ExplainPart::kMatrix
                 : command.stage == "occurrences" ? ExplainPart::kOccurrences
                                                  : ExplainPart::kAll;
  options.formulation.determinant = command.method == Method::kClosedForm;
  options.formulation.determinant_budget = command.symbolic_budget;
  if (command.model.motion.empty())
    return explain(parse_model(model_text(command.model), command.model.path), options);
  options.formulation.columns = functions_needed(command.method).columns;
  const Request request = read_request(command.model);
  return explain(request.model, request.motion, options);
}

std::string kernel_text(const ExplainCommand& command, const std::string& typed) {
  return emit_kernel(read_request(command.model), command.method, typed, command.symbolic_budget)
      .source;
}

/// Returns exponents of two; null if the matrix is not scaled.
nlohmann::ordered_json json_scaling(const MatrixScaling& scaling) {
  if (scaling.empty()) return nullptr;
  return {{"rows", scaling.rows}, {"columns", scaling.columns}};
}

}  // namespace

int run_explain(const ExplainCommand& command, const std::string& typed) {
  const bool kernel = command.stage == "text";
  const Explanation explained =
      kernel ? Explanation{kernel_text(command, typed), {}} : forms(command);
  if (command.output.json) {
    nlohmann::ordered_json report{{"model", command.model.path},
                                  {"motion", command.model.motion},
                                  {"stage", command.stage},
                                  {"text", explained.text}};
    if (!kernel) report["scaling"] = json_scaling(explained.scaling);
    std::cout << report_text(report, command.output.json_indent) << '\n';
  } else {
    std::cout << explained.text;
  }
  std::cout.flush();
  return 0;
}

}  // namespace regulus
