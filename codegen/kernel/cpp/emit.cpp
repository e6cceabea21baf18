// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/emit.hpp"

#include <algorithm>
#include <stdexcept>

#include "codegen/kernel/cpp/comment.hpp"
#include "codegen/kernel/cpp/function_writer.hpp"
#include "codegen/kernel/cpp/literal.hpp"
#include "codegen/kernel/cpp/manifest.hpp"
#include "codegen/kernel/cpp/names.hpp"
#include "codegen/kernel/program/module_check.hpp"
#include "codegen/kernel/program/print.hpp"
#include "runtime/kernel/kernel_functions.hpp"

namespace regulus::detail {
namespace {

std::string header(const Module& module, const EmitOptions& options, const std::string& identity) {
  const auto optional_line = [](const char* label, const std::string& text) {
    return text.empty() ? std::string() : labelled_comment(label, text);
  };
  std::string variables;
  for (const std::string& name : module.variables)
    variables += (variables.empty() ? "" : " ") + name;
  return "// SPDX-License-Identifier: Apache-2.0\n"
         "// Generated: edit the model, not this file.\n" +
         optional_line("Command", options.command) + optional_line("Model", module.model) +
         optional_line("Motion", module.motion) + optional_line("Source", options.source) +
         optional_line("Variables", variables) + labelled_comment("Identity", identity) +
         "//\n"
         "// v_…: a variable. k_…: an entry of K. c_…: depends on K and constants alone, a P where "
         "that is\n"
         "// exact (runtime/kernel/abi.hpp). t_…: on the variables, too. Hexadecimal constants are "
         "bounds on\n"
         "// both sides, or exact in P(…).\n"
         "#include \"runtime/kernel/abi.hpp\"\n"
         "#include \"runtime/kernel/pack.hpp\"\n\n"
         "namespace {\n\n"
         "using namespace regulus::pack;\n\n";
}

std::string field(const std::string& value, const std::string& name) {
  return "    " + value + ",  // " + name + "\n";
}

bool is_present(const Module& module, const std::string& name) {
  const Function* function = module.find(name);
  return function != nullptr && !function->program.outputs.empty();
}

std::string list_of(const Function& function) {
  std::string text = "const regulus_derivative " + function.name + "_list[] = {\n";
  for (const DerivativeIndex& d : function.derivatives)
    text +=
        "    {" + std::to_string(d.row) + ", " + std::to_string(d.column) + ", " +
        std::to_string(d.first) + ", " +
        (d.second == DerivativeIndex::kNone ? "REGULUS_FIRST_ORDER" : std::to_string(d.second)) +
        "},\n";
  return text + "};\n";
}

std::string derivatives_field(const Module& module, const std::string& function, const char* name) {
  if (!is_present(module, function)) return field("{nullptr, nullptr, 0}", name);
  const std::size_t count = module.find(function)->derivatives.size();
  return field("{" + function + ", " + function + "_list, " + std::to_string(count) + "}", name);
}

std::string integers(const std::string& name, const std::vector<int>& values) {
  if (values.empty()) return "";
  std::string text = "const int " + name + "[] = {";
  for (const int value : values) text += std::to_string(value) + ", ";
  return text + "};\n";
}

/// The lists of the expansion's functions, then the table itself.
std::string expansion_table(const Module& module) {
  if (!module.expansion) return "";
  const Expansion& expansion = *module.expansion;
  std::string text;
  const std::string listed[] = {expansion.first, "expansion_second", "row_first", "row_second"};
  for (const std::string& name : listed)
    if (is_present(module, name)) text += list_of(*module.find(name));
  text += integers("row_of_variable", expansion.row_of_variable);
  text += integers("ball_of_variable", expansion.ball_of_variable);
  if (!expansion.nominal.empty()) {
    text += "const double nominal[] = {\n";
    for (const Interval& x : expansion.nominal)
      text += "    " + literal(x.lo) + ", " + literal(x.hi) + ",\n";
    text += "};\n";
  }
  text += "const regulus_expansion expansion = {\n";
  text += field("row_of_variable", "row_of_variable");
  text += field(expansion.ball_of_variable.empty() ? "nullptr" : "ball_of_variable",
                "ball_of_variable");
  text += field(expansion.nominal.empty() ? "nullptr" : "nominal", "nominal");
  text += field(expansion.product, "product");
  text += derivatives_field(module, expansion.first, "first");
  text += derivatives_field(module, "expansion_second", "second");
  text += derivatives_field(module, "row_first", "row_first");
  text += derivatives_field(module, "row_second", "row_second");
  return text + "};\n\n";
}

std::string kernel_table(const Module& module, const std::string& symbol,
                         const std::string& identity) {
  std::string text = "extern \"C\" {\nextern const regulus_kernel " + symbol +
                     ";\nconst regulus_kernel " + symbol + " = {\n";
  text += field("REGULUS_KERNEL_ABI", "abi") + field("kRounding", "rounding");
  text += field(std::to_string(module.variables.size()), "variables");
  text += field(std::to_string(module.motion_variables), "motion_variables");
  text += field(std::to_string(module.rows), "rows");
  text += field(std::to_string(module.columns), "columns");
  text += field(std::to_string(module.constraints), "constraints");
  text += field(std::to_string(module.pose_parameters), "pose_parameters");
  for (const KernelFunctionRow& row : kKernelFunctions) {
    if (row.field == nullptr) continue;
    const std::string name(row.name);
    text += field(is_present(module, name) ? name : "nullptr", name);
  }
  text += field(module.expansion ? "&expansion" : "nullptr", "expansion");
  text += field("nullptr", "context") + field("\"" + identity + "\"", "identity");
  return text + "};\n}\n";
}

}  // namespace

EmittedKernel emit(const Module& module, const EmitOptions& options, const FormingWatch* watch) {
  check_module(module);
  if (!is_identifier(options.prefix) || options.prefix == "regulus")
    throw std::invalid_argument("the prefix must be a C identifier other than regulus");
  if (options.operations_per_part == 0) throw std::invalid_argument("a part holds no operations");
  EmittedKernel kernel;
  kernel.symbol = options.prefix + "_kernel";
  kernel.identity = identity(module);
  kernel.source = header(module, options, kernel.identity);
  WorkMeter meter(WorkMeter::kNoLimit, watch, WorkStage::kSelection);
  std::vector<SelectedFunction> selected;
  for (const Function& function : module.functions) {
    selected.push_back(select(function.program, options.operations_per_part,
                              static_cast<std::size_t>(module.rows), &meter));
    if (!function.program.outputs.empty())
      kernel.source += write_function(module, function, selected.back(), meter) + "\n";
  }
  kernel.source += expansion_table(module);
  kernel.source += "}  // namespace\n\n" + kernel_table(module, kernel.symbol, kernel.identity);
  if (options.manifest) kernel.manifest = write_manifest(module, options, kernel, selected);
  return kernel;
}

}  // namespace regulus::detail
