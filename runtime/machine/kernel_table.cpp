// SPDX-License-Identifier: Apache-2.0
#include "runtime/machine/kernel_table.hpp"

#include <stdexcept>

namespace regulus::detail::machine {

void require_no_fault(const PackKernel& program) {
  for (std::size_t row = 0; row < program.functions.size(); ++row) {
    const PackFunction& function = program.functions[row];
    if (function.outputs == 0) continue;
    const std::string fault =
        find_fault(function, program.variables, program.rows * program.columns);
    if (!fault.empty())
      throw std::invalid_argument("the function " + std::string(kKernelFunctions[row].name) +
                                  " of a pack program: " + fault);
  }
}

KernelTable::KernelTable(const PackKernel& program, Isa isa, const Callers& callers,
                         const void* context)
    : identity_(program.identity), expansion_(program.expansion) {
  kernel_.abi = REGULUS_KERNEL_ABI;
  kernel_.rounding = required_rounding(isa);
  kernel_.variables = program.variables;
  kernel_.motion_variables = program.motion_variables;
  kernel_.rows = program.rows;
  kernel_.columns = program.columns;
  kernel_.constraints = program.constraints;
  kernel_.pose_parameters = program.pose_parameters;
  kernel_.context = context;
  kernel_.identity = identity_.c_str();
  for (std::size_t row = 0; row < callers.size(); ++row)
    if (kKernelFunctions[row].field != nullptr && program.functions[row].outputs > 0)
      kernel_.*kKernelFunctions[row].field = callers[row];
  if (program.has_expansion) fill_expansion(callers);
}

void KernelTable::fill_expansion(const Callers& callers) {
  for (const Interval& x : expansion_.nominal) nominal_.insert(nominal_.end(), {x.lo, x.hi});
  const auto& balls = expansion_.ball_of_variable;
  table_ = {expansion_.row_of_variable.data(),
            balls.empty() ? nullptr : balls.data(),
            nominal_.empty() ? nullptr : nominal_.data(),
            callers[static_cast<std::size_t>(expansion_.product)],
            derivatives(0, callers),
            derivatives(1, callers),
            derivatives(2, callers),
            derivatives(3, callers)};
  kernel_.expansion = &table_;
}

regulus_derivatives KernelTable::derivatives(std::size_t number, const Callers& callers) const {
  const PackDerivatives& d = expansion_.derivatives[number];
  if (d.list.empty()) return {nullptr, nullptr, 0};
  return {callers[static_cast<std::size_t>(d.function)], d.list.data(),
          static_cast<unsigned>(d.list.size())};
}

}  // namespace regulus::detail::machine
