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

// Functions of the expansion have no field of their own in regulus_kernel.
constexpr std::array<Field, 15> kFields = {
    {{"matrix", &regulus_kernel::matrix},
     {"matrix_derivatives", &regulus_kernel::matrix_derivatives},
     {"left_product", &regulus_kernel::left_product},
     {"left_derivatives", &regulus_kernel::left_derivatives},
     {"right_product", &regulus_kernel::right_product},
     {"row_scale", &regulus_kernel::row_scale},
     {"constraint", &regulus_kernel::constraint},
     {"pose", &regulus_kernel::pose},
     {"determinant", &regulus_kernel::determinant},
     {"determinant_derivatives", &regulus_kernel::determinant_derivatives},
     {"nominal_product", nullptr},
     {"nominal_first", nullptr},
     {"expansion_second", nullptr},
     {"row_first", nullptr},
     {"row_second", nullptr}}};

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

/// A function's list of derivatives, as the ABI wants it.
std::vector<regulus_derivative> derivative_list(const Function& function) {
  std::vector<regulus_derivative> list;
  for (const DerivativeIndex& d : function.derivatives)
    list.push_back({static_cast<unsigned>(d.row), static_cast<unsigned>(d.column),
                    static_cast<unsigned>(d.first),
                    d.second == DerivativeIndex::kNone ? unsigned{REGULUS_FIRST_ORDER}
                                                       : static_cast<unsigned>(d.second)});
  return list;
}

/// regulus_expansion and the arrays it points to.
class InterpretedExpansion {
 public:
  void fill(const Module& module) {
    const Expansion& expansion = *module.expansion;
    rows_ = expansion.row_of_variable;
    balls_ = expansion.ball_of_variable;
    table_.ball_of_variable = balls_.empty() ? nullptr : balls_.data();
    for (const Interval& x : expansion.nominal) nominal_.insert(nominal_.end(), {x.lo, x.hi});
    table_.row_of_variable = rows_.data();
    table_.nominal = nominal_.empty() ? nullptr : nominal_.data();
    table_.product = kCallers[index_of(expansion.product)];
    table_.first = derivatives(module, expansion.first, 0);
    table_.second = derivatives(module, "expansion_second", 1);
    table_.row_first = derivatives(module, "row_first", 2);
    table_.row_second = derivatives(module, "row_second", 3);
  }
  [[nodiscard]] const regulus_expansion* table() const noexcept { return &table_; }

 private:
  static std::size_t index_of(const std::string& name) {
    std::size_t i = 0;
    while (name != kFields[i].name) ++i;
    return i;
  }
  regulus_derivatives derivatives(const Module& module, const std::string& name, std::size_t list) {
    const Function* function = module.find(name);
    if (function == nullptr || function->program.outputs.empty()) return {nullptr, nullptr, 0};
    lists_[list] = derivative_list(*function);
    return {kCallers[index_of(name)], lists_[list].data(),
            static_cast<unsigned>(lists_[list].size())};
  }

  std::vector<int> rows_, balls_;
  std::vector<double> nominal_;
  std::array<std::vector<regulus_derivative>, 4> lists_;
  regulus_expansion table_{};
};

}  // namespace

struct InterpretedKernel::State {
  PreparedFunctions functions;
  InterpretedExpansion expansion;
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
    if (kFields[i].member != nullptr) kernel.*kFields[i].member = kCallers[i];
  }
  if (module.expansion) {
    state_->expansion.fill(module);
    kernel.expansion = state_->expansion.table();
  }
}

InterpretedKernel::InterpretedKernel(InterpretedKernel&&) noexcept = default;
InterpretedKernel& InterpretedKernel::operator=(InterpretedKernel&&) noexcept = default;
InterpretedKernel::~InterpretedKernel() = default;

const regulus_kernel* InterpretedKernel::get() const noexcept { return &state_->kernel; }

}  // namespace regulus::codegen
