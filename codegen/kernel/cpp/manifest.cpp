// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/manifest.hpp"

#include <nlohmann/json.hpp>

#include "runtime/kernel/abi.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

Json describe(const Function& function, const SelectedFunction& selected) {
  return {{"name", function.name},
          {"title", function.title},
          {"rows", function.rows},
          {"columns", function.columns},
          {"outputs", function.program.outputs.size()},
          {"points", function.program.points.size()},
          {"operations", selected.plan.operations},
          {"parts", selected.code.part_ends.size()}};
}

}  // namespace

std::string write_manifest(const Module& module, const EmitOptions& options,
                           const EmittedKernel& kernel,
                           const std::vector<SelectedFunction>& selected) {
  Json functions = Json::array();
  for (std::size_t i = 0; i < selected.size(); ++i)
    functions.push_back(describe(module.functions[i], selected[i]));
  const Json manifest = {{"kernel_abi", static_cast<int>(REGULUS_KERNEL_ABI)},
                         {"symbol", kernel.symbol},
                         {"identity", kernel.identity},
                         {"command", options.command},
                         {"source", options.source},
                         {"model", module.model},
                         {"motion", module.motion},
                         {"variables", module.variables},
                         {"motion_variables", module.motion_variables},
                         {"rows", module.rows},
                         {"columns", module.columns},
                         {"constraints", module.constraints},
                         {"pose_parameters", module.pose_parameters},
                         {"functions", functions}};
  constexpr int kIndent = 2;
  // Names need not be UTF-8, but a manifest must be.
  return manifest.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace regulus::detail
