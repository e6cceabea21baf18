// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <nlohmann/json.hpp>

#include "regulus/codegen/driver/commands.hpp"
#include "regulus/codegen/driver/exit_code.hpp"
#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/codegen/model/model_file.hpp"
#include "regulus/codegen/symbolic/explain.hpp"

namespace regulus::codegen {
namespace {

/// Without a motion the forms are shown over the pose parameters themselves.
std::string forms(const ExplainCommand& command) {
  ExplainOptions options;
  options.all_entries = command.all_entries;
  options.part = command.stage == "matrix"        ? ExplainPart::kMatrix
                 : command.stage == "occurrences" ? ExplainPart::kOccurrences
                                                  : ExplainPart::kAll;
  options.formulation.determinant = command.method == name(Method::kClosedForm);
  options.formulation.determinant_budget = command.symbolic_budget;
  if (command.model.motion.empty())
    return explain(parse_model(model_text(command.model), command.model.path), options);
  options.formulation.columns = functions_needed(parse_method(command.method).value()).columns;
  const Request request = read_request(command.model);
  return explain(request.model, request.motion, options);
}

std::string kernel_text(const ExplainCommand& command, const std::string& typed) {
  return emit_kernel(read_request(command.model), parse_method(command.method).value(), typed,
                     command.symbolic_budget)
      .source;
}

}  // namespace

int run_explain(const ExplainCommand& command, const std::string& typed) {
  const std::string text = command.stage == "text" ? kernel_text(command, typed) : forms(command);
  if (command.output.json)
    std::cout << nlohmann::ordered_json{{"model", command.model.path},
                                        {"motion", command.model.motion},
                                        {"stage", command.stage},
                                        {"text", text}}
                     .dump(command.output.json_indent)
              << '\n';
  else
    std::cout << text;
  std::cout.flush();
  return 0;
}

}  // namespace regulus::codegen
