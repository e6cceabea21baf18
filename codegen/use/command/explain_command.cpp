// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "codegen/answer/report/report_text.hpp"
#include "codegen/kernel/formulation/explain.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/question/analysis/box_evaluation.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/support/exit_code.hpp"
#include "codegen/use/command/commands.hpp"

namespace regulus::detail {
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
  SearchOptions search;
  search.method = command.method;
  options.kernel = functions_needed(command.method, settings_from(search), command.symbolic_budget);
  options.formulation.columns = options.kernel->columns;
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

/// Six digits, rounded outward: the decimal encloses the bounds that it stands for.
std::string outward_text(const Interval& x) {
  const auto end = [](double value, double direction) {
    double shown = value;
    for (int i = 0; i < 4; ++i) {
      const double decimal = std::stod(fmt::format("{:.5e}", shown));
      if (direction < 0 ? decimal <= value : decimal >= value)
        return fmt::format("{:.6g}", decimal);
      shown += direction * std::max(std::fabs(value) * 1e-5, 1e-300);
    }
    return fmt::format("{:.17g}", value);
  };
  return fmt::format("[{}, {}]", end(x.lo, -1), end(x.hi, 1));
}

std::string matrix_text(const char* title, const std::vector<Interval>& entries,
                        std::size_t columns) {
  std::string text = fmt::format("{}\n", title);
  for (std::size_t e = 0; e < entries.size(); ++e)
    text += fmt::format("{}{:<28}{}", e % columns == 0 ? "  " : "", outward_text(entries[e]),
                        e % columns == columns - 1 ? "\n" : "");
  return text + '\n';
}

std::string box_text(const BoxEvaluation& b) {
  std::string text = "The box of the motion\n";
  for (const auto& [variable, range] : b.box)
    text += fmt::format("  {} in {}\n", variable, outward_text(range));
  text += '\n';
  if (b.matrix.empty())
    return text + "M is not defined all over the box, as far as intervals show\n";
  text += matrix_text("M(B), the matrix with natural entries", b.matrix, b.columns);
  if (b.K.empty()) return text + "M has no inverse at the middle of the box\n";
  text += matrix_text("K·M(B), multiplied numerically: K is the inverse of M at the middle",
                      b.numeric, b.columns);
  text += matrix_text("K·M(B), multiplied symbolically", b.product, b.columns);
  if (b.bounds.empty()) return text;
  text += "The determinant of M over the box\n";
  text += fmt::format("  {:<12}{:<13}{:<13}{:<30}{}\n", "method", "entries", "expanded by",
                      "bounds", "regular by Rohn's test");
  for (const BoxEvaluation::Bound& d : b.bounds)
    text += fmt::format("  {:<12}{:<13}{:<13}{:<30}{}\n", d.method, d.entries, d.determinant,
                        outward_text(d.value),
                        !d.rohn   ? "-"
                        : *d.rohn ? "yes"
                                  : "not shown");
  return text;
}

nlohmann::ordered_json json_of(const Interval& x) { return {x.lo, x.hi}; }

nlohmann::ordered_json json_of(const std::vector<Interval>& entries) {
  if (entries.empty()) return nullptr;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Interval& x : entries) list.push_back(json_of(x));
  return list;
}

nlohmann::ordered_json json_box(const BoxEvaluation& b) {
  nlohmann::ordered_json box = nlohmann::ordered_json::object();
  for (const auto& [variable, range] : b.box) box[variable] = json_of(range);
  nlohmann::ordered_json bounds = nlohmann::ordered_json::array();
  for (const BoxEvaluation::Bound& d : b.bounds) {
    nlohmann::ordered_json rohn = nullptr;
    if (d.rohn) rohn = *d.rohn;
    bounds.push_back({{"method", d.method},
                      {"entries", d.entries},
                      {"determinant", d.determinant},
                      {"bounds", json_of(d.value)},
                      {"rohn", rohn}});
  }
  nlohmann::ordered_json K = nullptr;
  if (!b.K.empty()) K = b.K;
  return {{"box", box},
          {"rows", b.rows},
          {"columns", b.columns},
          {"matrix", json_of(b.matrix)},
          {"K", K},
          {"product", json_of(b.product)},
          {"numeric_product", json_of(b.numeric)},
          {"determinants", bounds}};
}

}  // namespace

int run_explain(const ExplainCommand& command, const std::string& typed) {
  const bool kernel = command.stage == "text", box = command.stage == "box";
  std::optional<BoxEvaluation> evaluation;
  if (box) evaluation = evaluate_box(read_request(command.model));
  const Explanation explained = kernel ? Explanation{kernel_text(command, typed), {}}
                                : box  ? Explanation{box_text(*evaluation), {}}
                                       : forms(command);
  if (command.output.json) {
    nlohmann::ordered_json report{{"model", command.model.path},
                                  {"motion", command.model.motion},
                                  {"stage", command.stage},
                                  {"text", explained.text}};
    if (box) report["evaluation"] = json_box(*evaluation);
    if (!kernel && !box) report["scaling"] = json_scaling(explained.scaling);
    std::cout << report_text(report, command.output.json_indent) << '\n';
  } else {
    std::cout << explained.text;
  }
  std::cout.flush();
  return 0;
}

}  // namespace regulus::detail
