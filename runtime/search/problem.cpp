// SPDX-License-Identifier: Apache-2.0
#include "regulus/search/problem.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "regulus/kernel/call.hpp"
#include "regulus/regularity/lanes.hpp"
#include "regulus/regularity/rohn.hpp"

namespace regulus {
namespace {

constexpr std::array<std::pair<Method, const char*>, 10> kMethodNames{{
    {Method::kAuto, "auto"},
    {Method::kReg, "reg"},
    {Method::kRegRohn, "reg+rohn"},
    {Method::kKj, "kj"},
    {Method::kKjRohn, "kj+rohn"},
    {Method::kJk, "jk"},
    {Method::kJkRohn, "jk+rohn"},
    {Method::kKjNumeric, "kj-numeric"},
    {Method::kJkNumeric, "jk-numeric"},
    {Method::kClosedForm, "closed-form"},
}};

std::optional<std::string> fault_of_range(const Problem& problem, std::size_t k) {
  const Interval& outer = problem.outer[k];
  const std::string variable = "variable " + std::to_string(k);
  if (!(mag(outer) <= kMaxBoxMagnitude)) return variable + " ranges beyond 2^64";
  const auto& inner = problem.inner[k];
  if (inner && !certain_subset(*inner, outer))
    return variable + " has an inner range outside its outer range";
  return std::nullopt;
}

std::optional<std::string> fault_of_kernel(const regulus_kernel& kernel) {
  try {
    static_cast<void>(Kernel(kernel));
  } catch (const std::exception& error) {
    return error.what();
  }
  if (kernel.columns > kMaxColumns || kernel.rows > kMaxRows)
    return "the matrix is larger than " + std::to_string(kMaxRows) + "×" +
           std::to_string(kMaxColumns);
  if (kernel.constraints > 0 && kernel.constraint == nullptr)
    return "the kernel has constraints but no function for them";
  return std::nullopt;
}

std::optional<std::string> fault_of_method(const regulus_kernel& kernel, Method method) {
  if (method == Method::kClosedForm && kernel.determinant == nullptr)
    return "method closed-form needs a kernel with the determinant in closed form";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_fault(const Problem& problem, const Settings& settings) {
  if (problem.kernel == nullptr) return "there is no kernel";
  const regulus_kernel& kernel = *problem.kernel;
  if (auto fault = fault_of_kernel(kernel)) return fault;
  if (problem.outer.size() != kernel.variables || problem.inner.size() != kernel.variables)
    return "the kernel has " + std::to_string(kernel.variables) + " variables, the problem " +
           std::to_string(problem.outer.size());
  for (std::size_t k = 0; k < problem.outer.size(); ++k)
    if (auto fault = fault_of_range(problem, k)) return fault;
  if (!(problem.alpha.lo >= 0.0 && problem.alpha.hi < kInfinity))
    return "the threshold is not a finite number ≥ 0";
  if (settings.batch < 1 || settings.batch > kLanes) return "the batch is not of 1 to 8 boxes";
  if (!(settings.min_relative_width >= 0.0)) return "the minimum width is negative";
  for (const regulus_filter_interface* filter : settings.filters)
    if (auto fault = find_fault(*filter)) return fault;
  if (kernel.rows == kernel.columns) return fault_of_method(kernel, settings.method);
  if (problem.alpha.hi > 0.0) return "a threshold needs a square matrix";
  if (settings.method != Method::kAuto)
    return "method " + std::string(name(settings.method)) + " needs a square matrix";
  return std::nullopt;
}

ProductForm form_of(Method method) noexcept {
  using Side = ProductForm::Side;
  switch (method) {
    case Method::kAuto:
    case Method::kKj:
    case Method::kKjRohn:
      return {Side::kLeft, false};
    case Method::kJk:
    case Method::kJkRohn:
      return {Side::kRight, false};
    case Method::kKjNumeric:
      return {Side::kLeft, true};
    case Method::kJkNumeric:
      return {Side::kRight, true};
    case Method::kReg:
    case Method::kRegRohn:
    case Method::kClosedForm:
      break;
  }
  return {Side::kNone, false};
}

Entries fitting_entries(Method method, Uncertainty uncertainty) noexcept {
  if (method == Method::kAuto || method == Method::kClosedForm) return Entries::kNatural;
  const bool left = form_of(method).side == ProductForm::Side::kLeft;
  return left || uncertainty == Uncertainty::kVariables ? Entries::kDerivatives : Entries::kNatural;
}

const char* name(Method method) noexcept {
  for (const auto& [value, text] : kMethodNames)
    if (value == method) return text;
  return "unknown";
}

std::optional<Method> parse_method(std::string_view text) noexcept {
  for (const auto& [value, known] : kMethodNames)
    if (text == known) return value;
  return std::nullopt;
}

}  // namespace regulus
