// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/program/interpreted_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "regulus/codegen/program/enclose.hpp"
#include "regulus/codegen/program/interpreter.hpp"
#include "regulus/codegen/program/interval_arithmetic.hpp"
#include "regulus/codegen/program/module_check.hpp"
#include "regulus/codegen/program/print.hpp"

namespace regulus::codegen {
namespace {

constexpr std::size_t kLanes = REGULUS_LANES;
constexpr unsigned kAllLanes = (1U << kLanes) - 1;
constexpr double kLargestGuarded = 0x1p128;

struct PreparedFunction {
  Program program;
  KnownValues<Interval> known;
};

/// What one call needs besides its arguments.
struct Workspace {
  explicit Workspace(const Program& program)
      : inputs(program.inputs.size()),
        points(program.points.size()),
        values(program.nodes.size()) {}

  std::vector<Interval> inputs;
  std::vector<Interval> points;
  std::vector<Interval> values;
};

void load_lane(Workspace& work, const double* boxes, const double* points, std::size_t lane) {
  for (std::size_t v = 0; v < work.inputs.size(); ++v)
    work.inputs[v] = Interval{boxes[2 * v * kLanes + lane], boxes[(2 * v + 1) * kLanes + lane]};
  for (std::size_t p = 0; p < work.points.size(); ++p)
    work.points[p] = Interval{points[p * kLanes + lane]};
}

/// Returns whether the lane is defined.
bool run_lane(const PreparedFunction& function, Workspace& work, double* out, std::size_t lane) {
  IntervalArithmetic arithmetic(kLargestGuarded);
  run<IntervalArithmetic, Interval>(function.program, function.known, work.inputs, work.points,
                                    work.values, arithmetic);
  bool bounded = true;
  for (std::size_t e = 0; e < function.program.outputs.size(); ++e) {
    const Interval& value = work.values[function.program.outputs[e]];
    bounded = bounded && is_bounded(value);
    out[2 * e * kLanes + lane] = value.lo;
    out[(2 * e + 1) * kLanes + lane] = value.hi;
  }
  return bounded && !arithmetic.undefined();
}

unsigned run_lanes(const PreparedFunction& function, const double* boxes, const double* points,
                   double* out) {
  Workspace work(function.program);
  unsigned undefined = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    load_lane(work, boxes, points, lane);
    if (!run_lane(function, work, out, lane)) undefined |= 1U << lane;
  }
  return undefined;
}

struct Field {
  const char* name;
  regulus_function regulus_kernel::*member;
};

constexpr std::array<Field, 10> kFields = {
    {{"matrix", &regulus_kernel::matrix},
     {"matrix_derivatives", &regulus_kernel::matrix_derivatives},
     {"left_product", &regulus_kernel::left_product},
     {"left_derivatives", &regulus_kernel::left_derivatives},
     {"right_product", &regulus_kernel::right_product},
     {"row_scale", &regulus_kernel::row_scale},
     {"constraint", &regulus_kernel::constraint},
     {"pose", &regulus_kernel::pose},
     {"determinant", &regulus_kernel::determinant},
     {"determinant_derivatives", &regulus_kernel::determinant_derivatives}}};

using PreparedFunctions = std::array<PreparedFunction, kFields.size()>;

/// The function of field `index`, as the ABI calls it: its context is the array of all of them.
template <std::size_t index>
unsigned call_field(const double* boxes, const double* points, double* out,
                    const void* context) noexcept {
  try {
    return run_lanes((*static_cast<const PreparedFunctions*>(context))[index], boxes, points, out);
  } catch (...) {
    return kAllLanes;
  }
}

template <std::size_t... index>
constexpr std::array<regulus_function, kFields.size()> make_callers(std::index_sequence<index...>) {
  return {&call_field<index>...};
}

constexpr auto kCallers = make_callers(std::make_index_sequence<kFields.size()>());

}  // namespace

struct InterpretedKernel::State {
  PreparedFunctions functions;
  std::string identity;
  regulus_kernel kernel{};
};

InterpretedKernel::InterpretedKernel(const Module& module) : state_(std::make_unique<State>()) {
  check_module(module);
  state_->identity = codegen::identity(module);
  regulus_kernel& kernel = state_->kernel;
  kernel.abi = REGULUS_KERNEL_ABI;
  kernel.rounding = REGULUS_ROUND_NEAREST;
  kernel.variables = static_cast<unsigned>(module.variables.size());
  kernel.motion_variables = static_cast<unsigned>(module.motion_variables);
  kernel.rows = static_cast<unsigned>(module.rows);
  kernel.columns = static_cast<unsigned>(module.columns);
  kernel.constraints = static_cast<unsigned>(module.constraints);
  kernel.pose_parameters = static_cast<unsigned>(module.pose_parameters);
  kernel.context = &state_->functions;
  kernel.identity = state_->identity.c_str();
  for (std::size_t i = 0; i < kFields.size(); ++i) {
    const Function* function = module.find(kFields[i].name);
    if (function == nullptr || function->program.outputs.empty()) continue;
    state_->functions[i] = {function->program, enclose_constant_nodes(function->program)};
    kernel.*kFields[i].member = kCallers[i];
  }
}

InterpretedKernel::InterpretedKernel(InterpretedKernel&&) noexcept = default;
InterpretedKernel& InterpretedKernel::operator=(InterpretedKernel&&) noexcept = default;
InterpretedKernel::~InterpretedKernel() = default;

const regulus_kernel* InterpretedKernel::get() const noexcept { return &state_->kernel; }

}  // namespace regulus::codegen
