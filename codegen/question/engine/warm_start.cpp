// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/warm_start.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>

namespace regulus::detail {
namespace {

using Json = nlohmann::json;

/// Increase it if the meaning of the text of a warm start changes.
constexpr int kWarmFormat = 9;

bool is_key(std::string_view text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Throws    std::invalid_argument unless the value is a small number.
int count_of(const Json& json) {
  constexpr Json::number_unsigned_t kMost = 1 << 20;
  const auto* number = json.get_ptr<const Json::number_unsigned_t*>();
  if (number == nullptr || *number > kMost) throw std::invalid_argument("no count");
  return static_cast<int>(*number);
}

/// Writes four numbers for each node, all in one list.
Json json_of(const BallProgram& program) {
  Json nodes = Json::array(), constants = Json::array();
  for (const Node& node : program.nodes)
    for (const std::uint32_t number :
         {static_cast<std::uint32_t>(node.op), node.a, node.b, node.index})
      nodes.push_back(number);
  for (const FlintRational& constant : program.constants) constants.push_back(constant.text());
  return {{"inputs", program.inputs},
          {"nodes", nodes},
          {"constants", constants},
          {"outputs", program.outputs}};
}

BallProgram program_of(const Json& json) {
  BallProgram program;
  program.inputs = std::size_t(count_of(json.at("inputs")));
  const Json& nodes = json.at("nodes");
  const auto number = [&nodes](std::size_t i) { return std::uint32_t(count_of(nodes.at(i))); };
  for (std::size_t i = 0; i < nodes.size(); i += 4) {
    if (number(i) > std::uint32_t(Op::kAbs)) throw std::invalid_argument("no operation");
    program.nodes.push_back({Op(number(i)), number(i + 1), number(i + 2), number(i + 3)});
  }
  for (const Json& constant : json.at("constants"))
    program.constants.push_back(FlintRational::read(constant).value());
  for (const Json& output : json.at("outputs")) program.outputs.push_back(NodeId(count_of(output)));
  return program;
}

}  // namespace

std::string to_text(const WarmStart& forms) {
  const Json json = {{"format", kWarmFormat},
                     {"program", forms.program_key},
                     {"identity", forms.identity},
                     {"detail", static_cast<int>(forms.detail)},
                     {"matrix", forms.matrix ? json_of(*forms.matrix) : Json(nullptr)}};
  return json.dump();
}

std::optional<WarmStart> read_warm_start(std::string_view text) try {
  const Json json = Json::parse(text);
  WarmStart forms;
  forms.program_key = json.at("program");
  forms.identity = json.at("identity");
  const int detail = count_of(json.at("detail"));
  if (json.at("format") != kWarmFormat || !is_key(forms.program_key) ||
      detail > static_cast<int>(FormDetail::kAsWritten))
    return std::nullopt;
  forms.detail = FormDetail(detail);
  if (!json.at("matrix").is_null()) forms.matrix = program_of(json.at("matrix"));
  if (forms.matrix && !is_consistent(*forms.matrix)) return std::nullopt;
  if (to_text(forms) != text) return std::nullopt;
  return forms;
} catch (const std::exception&) {
  return std::nullopt;
}

bool fits(const WarmStart& forms, const machine::PackKernel& program,
          const ReportLabels& question) noexcept {
  const auto& [rows, columns, variables] =
      std::tie(question.rows, question.columns, question.variables);
  const auto motion = std::ranges::count(variables, VariableKind::kMotion, &VariableLabel::kind);
  const bool matrix_fits =
      forms.matrix ? rows == columns && forms.matrix->inputs == variables.size() &&
                         forms.matrix->outputs.size() == std::size_t(rows) * std::size_t(columns)
                   : rows != columns;
  return matrix_fits && program.identity == forms.identity &&
         program.variables == variables.size() && program.motion_variables == unsigned(motion) &&
         program.rows == unsigned(rows) && program.columns == unsigned(columns) &&
         program.constraints == question.constraints &&
         program.pose_parameters == question.pose.size();
}

}  // namespace regulus::detail
