// SPDX-License-Identifier: Apache-2.0
#include "runtime/machine/machine_kernel.hpp"

#include <stdexcept>
#include <string>

#include "runtime/machine/kernel_table.hpp"
#include "runtime/machine/machine_function.hpp"

namespace regulus::detail::machine {

const StepTable& step_table_portable() noexcept;
#if defined(__x86_64__)
const StepTable& step_table_avx2() noexcept;
const StepTable& step_table_avx512() noexcept;
#endif

const StepTable& step_table(Isa isa) noexcept {
#if defined(__x86_64__)
  if (isa == Isa::kAvx512) return step_table_avx512();
  if (isa == Isa::kAvx2) return step_table_avx2();
#endif
  static_cast<void>(isa);
  return step_table_portable();
}

namespace {

using Kernel = KernelOf<MachineFunction>;

Kernel::Functions prepare(const PackKernel& program, const StepTable& table) {
  require_no_fault(program);
  Kernel::Functions functions;
  for (std::size_t row = 0; row < functions.size(); ++row)
    if (program.functions[row].outputs > 0)
      functions[row] = MachineFunction(program.functions[row], table);
  return functions;
}

}  // namespace

struct MachineKernel::State {
  Kernel kernel;
};

MachineKernel::MachineKernel(const PackKernel& program, Isa isa)
    : state_(new State{{program, isa, prepare(program, step_table(isa))}}) {}
MachineKernel::MachineKernel(MachineKernel&&) noexcept = default;
MachineKernel& MachineKernel::operator=(MachineKernel&&) noexcept = default;
MachineKernel::~MachineKernel() = default;

const regulus_kernel* MachineKernel::get() const noexcept { return state_->kernel.get(); }

}  // namespace regulus::detail::machine
