// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/switching_kernel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <span>
#include <utility>

#include "regulus/kernel/rounding_scope.hpp"

namespace regulus::codegen {
namespace {

constexpr std::size_t kFunctions = 15;
using FunctionList = std::array<regulus_function, kFunctions>;

/// Where a kernel keeps its functions, those of its expansion in `x`.
std::array<regulus_function*, kFunctions> places(regulus_kernel& k, regulus_expansion& x) {
  return {&k.matrix,
          &k.matrix_derivatives,
          &k.left_product,
          &k.left_derivatives,
          &k.right_product,
          &k.row_scale,
          &k.constraint,
          &k.pose,
          &k.determinant,
          &k.determinant_derivatives,
          &x.product,
          &x.first.function,
          &x.second.function,
          &x.row_first.function,
          &x.row_second.function};
}

FunctionList functions_of(const regulus_kernel& kernel) {
  regulus_kernel k = kernel;
  regulus_expansion x = kernel.expansion ? *kernel.expansion : regulus_expansion{};
  FunctionList list{};
  std::ranges::transform(places(k, x), list.begin(), [](regulus_function* f) { return *f; });
  return list;
}

/// What a call needs to know of a kernel.
struct Target {
  FunctionList functions{};
  const void* context = nullptr;
  unsigned rounding = REGULUS_ROUND_NEAREST;
};

Target target_of(const regulus_kernel& kernel) {
  return {functions_of(kernel), kernel.context, kernel.rounding};
}

bool equal(const regulus_derivatives& a, const regulus_derivatives& b) noexcept {
  const auto same = [](const regulus_derivative& p, const regulus_derivative& q) {
    return p.row == q.row && p.column == q.column && p.first == q.first && p.second == q.second;
  };
  return std::equal(a.list, a.list + a.count, b.list, b.list + b.count, same);
}

/// Both null, or equal for `count` numbers.
template <class Number>
bool equal(const Number* a, const Number* b, std::size_t count) noexcept {
  if (a == nullptr || b == nullptr) return a == b;
  return std::equal(a, a + count, b);
}

bool equal(const regulus_expansion* a, const regulus_expansion* b, std::size_t variables) noexcept {
  if (a == nullptr || b == nullptr) return a == b;
  return equal(a->row_of_variable, b->row_of_variable, variables) &&
         equal(a->ball_of_variable, b->ball_of_variable, variables) &&
         equal(a->nominal, b->nominal, 2 * variables) && equal(a->first, b->first) &&
         equal(a->second, b->second) && equal(a->row_first, b->row_first) &&
         equal(a->row_second, b->row_second);
}

bool interchangeable(const regulus_kernel& a, const regulus_kernel& b) noexcept {
  const auto present = [](regulus_function f, regulus_function g) { return !f == !g; };
  const FunctionList of_a = functions_of(a), of_b = functions_of(b);
  return a.abi == b.abi && a.variables == b.variables && a.motion_variables == b.motion_variables &&
         a.rows == b.rows && a.columns == b.columns && a.constraints == b.constraints &&
         a.pose_parameters == b.pose_parameters &&
         std::equal(of_a.begin(), of_a.end(), of_b.begin(), present) &&
         equal(a.expansion, b.expansion, a.variables);
}

using Current = std::atomic<const Target*>;

/// The function of place `index`, whose context is what to call at present.
template <std::size_t index>
unsigned call_current(const double* boxes, const double* points, double* out,
                      const void* context) noexcept {
  const Target& target = *static_cast<const Current*>(context)->load(std::memory_order_acquire);
  const RoundingScope scope(target.rounding);
  return target.functions[index](boxes, points, out, target.context);
}

template <std::size_t... index>
constexpr FunctionList make_callers(std::index_sequence<index...>) {
  return {&call_current<index>...};
}

constexpr FunctionList kCallers = make_callers(std::make_index_sequence<kFunctions>());

}  // namespace

struct SwitchingKernel::State {
  Target first, next;
  Current current = &first;
  regulus_expansion expansion{};
  regulus_kernel kernel{};
};

SwitchingKernel::SwitchingKernel(const regulus_kernel& first) : state_(std::make_unique<State>()) {
  state_->first = target_of(first);
  regulus_kernel& kernel = state_->kernel = first;
  if (first.expansion) {
    state_->expansion = *first.expansion;
    kernel.expansion = &state_->expansion;
  }
  const auto at = places(kernel, state_->expansion);
  for (std::size_t i = 0; i < kFunctions; ++i)
    if (*at[i] != nullptr) *at[i] = kCallers[i];
  kernel.rounding = REGULUS_ROUND_NEAREST;
  kernel.context = &state_->current;
}

SwitchingKernel::~SwitchingKernel() = default;

const regulus_kernel& SwitchingKernel::functions() const noexcept { return state_->kernel; }

bool SwitchingKernel::switch_to(const regulus_kernel& next) noexcept {
  regulus_kernel first = state_->kernel;
  if (!interchangeable(first, next)) return false;
  state_->next = target_of(next);
  state_->current.store(&state_->next, std::memory_order_release);
  return true;
}

}  // namespace regulus::codegen
