// SPDX-License-Identifier: Apache-2.0
#include "regulus/machine/machine_kernel.hpp"

#include <stdexcept>
#include <utility>

#include "regulus/machine/machine_function.hpp"

namespace regulus::machine {

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

using Functions = std::array<MachineFunction, kKernelFunctions.size()>;

/// The function of row `index`, as the ABI calls it: its context is the array of all of them.
template <std::size_t index>
unsigned call(const double* boxes, const double* points, double* out,
              const void* context) noexcept {
  return (*static_cast<const Functions*>(context))[index].run(boxes, points, out);
}

template <std::size_t... index>
constexpr std::array<regulus_function, sizeof...(index)> make_callers(
    std::index_sequence<index...>) {
  return {&call<index>...};
}

constexpr auto kCallers = make_callers(std::make_index_sequence<kKernelFunctions.size()>());

MachineFunction prepare(const PackKernel& program, std::size_t row, const StepTable& table) {
  const PackFunction& function = program.functions[row];
  const auto refuse = [row](const std::string& why) -> std::invalid_argument {
    return std::invalid_argument("the function " + std::string(kKernelFunctions[row].name) +
                                 " of a pack program: " + why);
  };
  const std::string fault = find_fault(function, program.variables, program.rows * program.columns);
  if (!fault.empty()) throw refuse(fault);
  MachineFunction prepared(function, table);
  if (prepared.slots() > kMaxFrameSlots)
    throw refuse("its values need " + std::to_string(prepared.slots()) + " slots, more than " +
                 std::to_string(kMaxFrameSlots));
  return prepared;
}

}  // namespace

struct MachineKernel::State {
  State(const PackKernel& program, Isa isa)
      : identity(program.identity), expansion(program.expansion) {
    for (std::size_t row = 0; row < functions.size(); ++row)
      if (program.functions[row].outputs > 0)
        functions[row] = prepare(program, row, step_table(isa));
    kernel.abi = REGULUS_KERNEL_ABI;
    kernel.rounding = required_rounding(isa);
    kernel.variables = program.variables;
    kernel.motion_variables = program.motion_variables;
    kernel.rows = program.rows;
    kernel.columns = program.columns;
    kernel.constraints = program.constraints;
    kernel.pose_parameters = program.pose_parameters;
    kernel.context = &functions;
    kernel.identity = identity.c_str();
    for (std::size_t row = 0; row < functions.size(); ++row)
      if (kKernelFunctions[row].field != nullptr && program.functions[row].outputs > 0)
        kernel.*kKernelFunctions[row].field = kCallers[row];
    if (program.has_expansion) fill_expansion();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void fill_expansion() {
    for (const Interval& x : expansion.nominal) nominal.insert(nominal.end(), {x.lo, x.hi});
    const auto& balls = expansion.ball_of_variable;
    table = {expansion.row_of_variable.data(),
             balls.empty() ? nullptr : balls.data(),
             nominal.empty() ? nullptr : nominal.data(),
             kCallers[static_cast<std::size_t>(expansion.product)],
             derivatives(0),
             derivatives(1),
             derivatives(2),
             derivatives(3)};
    kernel.expansion = &table;
  }

  [[nodiscard]] regulus_derivatives derivatives(std::size_t number) const {
    const PackDerivatives& d = expansion.derivatives[number];
    if (d.list.empty()) return {nullptr, nullptr, 0};
    return {kCallers[static_cast<std::size_t>(d.function)], d.list.data(),
            static_cast<unsigned>(d.list.size())};
  }

  std::string identity;
  PackExpansion expansion;
  Functions functions;
  std::vector<double> nominal;
  regulus_expansion table{};
  regulus_kernel kernel{};
};

MachineKernel::MachineKernel(const PackKernel& program, Isa isa)
    : state_(std::make_unique<State>(program, isa)) {}
MachineKernel::MachineKernel(MachineKernel&&) noexcept = default;
MachineKernel& MachineKernel::operator=(MachineKernel&&) noexcept = default;
MachineKernel::~MachineKernel() = default;

const regulus_kernel* MachineKernel::get() const noexcept { return &state_->kernel; }

}  // namespace regulus::machine
