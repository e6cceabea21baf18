// SPDX-License-Identifier: GPL-3.0-or-later
// Selects all functions of a kernel and the tables beside them.
#include "codegen/kernel/pack/select.hpp"
#include "codegen/kernel/program/module_check.hpp"
#include "codegen/kernel/program/print.hpp"

namespace regulus::detail {
namespace {

machine::PackDerivatives derivatives_of(const Module& module, const std::string& name) {
  const Function* function = module.find(name);
  if (function == nullptr || function->program.outputs.empty())
    return {KernelFunction::kNominalFirst, {}};
  machine::PackDerivatives result{parse_kernel_function(name).value(), {}};
  for (const DerivativeIndex& d : function->derivatives)
    result.list.push_back({static_cast<unsigned>(d.row), static_cast<unsigned>(d.column),
                           static_cast<unsigned>(d.first),
                           d.second == DerivativeIndex::kNone ? unsigned{REGULUS_FIRST_ORDER}
                                                              : static_cast<unsigned>(d.second)});
  return result;
}

machine::PackExpansion expansion_of(const Module& module) {
  const Expansion& x = *module.expansion;
  return {parse_kernel_function(x.product).value(),
          {derivatives_of(module, x.first), derivatives_of(module, "expansion_second"),
           derivatives_of(module, "row_first"), derivatives_of(module, "row_second")},
          x.row_of_variable,
          x.ball_of_variable,
          x.nominal};
}

}  // namespace

machine::PackKernel select(const Module& module, std::size_t operations_per_part,
                           const FormingWatch* watch) {
  check_module(module);
  WorkMeter meter(WorkMeter::kNoLimit, watch, WorkStage::kSelection);
  machine::PackKernel kernel;
  kernel.variables = static_cast<std::uint32_t>(module.variables.size());
  kernel.motion_variables = static_cast<std::uint32_t>(module.motion_variables);
  kernel.rows = static_cast<std::uint32_t>(module.rows);
  kernel.columns = static_cast<std::uint32_t>(module.columns);
  kernel.constraints = static_cast<std::uint32_t>(module.constraints);
  kernel.pose_parameters = static_cast<std::uint32_t>(module.pose_parameters);
  for (const Function& function : module.functions)
    if (!function.program.outputs.empty())
      kernel.functions[static_cast<std::size_t>(parse_kernel_function(function.name).value())] =
          select(function.program, operations_per_part, kernel.rows, &meter).code;
  kernel.has_expansion = module.expansion.has_value();
  if (module.expansion) kernel.expansion = expansion_of(module);
  kernel.identity = identity(module);
  return kernel;
}

}  // namespace regulus::detail
