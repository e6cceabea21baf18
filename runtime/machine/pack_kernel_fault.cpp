// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "runtime/machine/pack_program.hpp"

namespace regulus::detail::machine {
namespace {

/// More than any robot has. Products of three such numbers fit in 64 bits.
constexpr std::uint32_t kMaxCount = 1U << 12;

bool has_possible_sizes(const PackKernel& k) {
  const std::uint32_t counts[] = {k.variables, k.rows, k.constraints, k.pose_parameters};
  return k.columns > 0 && k.rows >= k.columns && k.motion_variables <= k.variables &&
         std::ranges::all_of(counts, [](std::uint32_t count) { return count <= kMaxCount; });
}

/// Returns how many outputs a function of the kernel must have. Functions that only the expansion
/// names have one output for each element of their list.
std::uint64_t outputs_stated(const PackKernel& k, KernelFunction function) {
  const std::uint64_t m = k.rows, n = k.columns, v = k.variables;
  switch (function) {
    case KernelFunction::kMatrix:
      return m * n;
    case KernelFunction::kMatrixDerivatives:
      return v * m * n;
    case KernelFunction::kLeftProduct:
    case KernelFunction::kNominalProduct:
      return n * n;
    case KernelFunction::kLeftDerivatives:
      return v * n * n;
    case KernelFunction::kRightProduct:
      return m * m;
    case KernelFunction::kConstraint:
      return k.constraints;
    case KernelFunction::kPose:
      return k.pose_parameters;
    case KernelFunction::kDeterminantDerivatives:
      return v;
    case KernelFunction::kRowScale:
    case KernelFunction::kDeterminant:
      return 1;
    case KernelFunction::kNominalFirst:
    case KernelFunction::kExpansionSecond:
    case KernelFunction::kRowFirst:
    case KernelFunction::kRowSecond:
      break;
  }
  return k.functions[static_cast<std::size_t>(function)].outputs;
}

bool needs_square_matrix(KernelFunction function) {
  return function == KernelFunction::kRightProduct || function == KernelFunction::kDeterminant ||
         function == KernelFunction::kDeterminantDerivatives;
}

std::string fault_of_function(const PackKernel& kernel, std::size_t row) {
  const PackFunction& function = kernel.functions[row];
  if (function.outputs == 0)
    return function.code.empty() && function.slots == 0 ? "" : "has instructions but no outputs";
  if (function.outputs != outputs_stated(kernel, static_cast<KernelFunction>(row)))
    return "has another number of outputs";
  if (needs_square_matrix(static_cast<KernelFunction>(row)) && kernel.rows != kernel.columns)
    return "needs a square matrix";
  // This check comes before find_fault allocates memory for them.
  if (function.slots > function.code.size() || function.outputs > kMaxCount * function.code.size())
    return "has more slots or outputs than instructions could write";
  return find_fault(function, kernel.variables, kernel.rows * kernel.columns);
}

/// Checks list `number` of the expansion: the first two are of K·A, the others of A; the odd ones
/// are of second order.
bool fits(const PackKernel& k, std::size_t number) {
  const PackDerivatives& derivatives = k.expansion.derivatives[number];
  const PackFunction& function = k.functions[static_cast<std::size_t>(derivatives.function)];
  const std::uint32_t rows = number < 2 ? k.columns : k.rows;
  const auto is_derivative = [&](const regulus_derivative& d) {
    const bool of_that_order = number % 2 == 0 ? d.second == REGULUS_FIRST_ORDER
                                               : d.first <= d.second && d.second < k.variables;
    return d.row < rows && d.column < k.columns && d.first < k.variables && of_that_order;
  };
  return derivatives.list.empty() || (function.outputs == derivatives.list.size() &&
                                      std::ranges::all_of(derivatives.list, is_derivative));
}

/// Checks that there is one number for each variable, from −1 up to below `end`.
bool numbers_variables(const PackKernel& k, const std::vector<int>& list, std::int64_t end) {
  return list.size() == k.variables &&
         std::ranges::all_of(list, [&](int number) { return -1 <= number && number < end; });
}

std::string fault_of_expansion(const PackKernel& k) {
  const PackExpansion& x = k.expansion;
  const std::uint64_t entries = std::uint64_t{k.columns} * k.columns;
  if (k.functions[static_cast<std::size_t>(x.product)].outputs != entries)
    return "the expansion has no product";
  for (std::size_t i = 0; i < x.derivatives.size(); ++i)
    if (!fits(k, i)) return "a list of derivatives does not fit its function";
  if (!numbers_variables(k, x.row_of_variable, k.rows)) return "variables have no row";
  if (!x.ball_of_variable.empty() && !numbers_variables(k, x.ball_of_variable, k.variables))
    return "variables are in no ball";
  const auto in_order = [](const Interval& bounds) { return bounds.lo <= bounds.hi; };
  if (!x.nominal.empty() &&
      (x.nominal.size() != k.variables || !std::ranges::all_of(x.nominal, in_order)))
    return "variables have no nominal value";
  return {};
}

}  // namespace

std::string find_fault(const PackKernel& kernel) {
  if (!has_possible_sizes(kernel)) return "the sizes are those of no kernel";
  if (kernel.functions[static_cast<std::size_t>(KernelFunction::kMatrix)].outputs == 0)
    return "there is no function for the matrix";
  for (std::size_t row = 0; row < kernel.functions.size(); ++row)
    if (std::string fault = fault_of_function(kernel, row); !fault.empty())
      return std::string(kKernelFunctions[row].name) + ": " + fault;
  return kernel.has_expansion ? fault_of_expansion(kernel) : std::string();
}

}  // namespace regulus::detail::machine
