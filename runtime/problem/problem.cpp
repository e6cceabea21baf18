// SPDX-License-Identifier: Apache-2.0
#include "runtime/problem/problem.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "runtime/kernel/call.hpp"
#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/rohn.hpp"

namespace regulus {

using namespace detail;

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
  if (!(outer.lo <= outer.hi)) return variable + " has no range: its bounds are not in order";
  if (!(mag(outer) <= kMaxBoxMagnitude)) return variable + " ranges beyond 2^64";
  const auto& inner = problem.inner[k];
  if (inner && !certain_subset(*inner, outer))
    return variable + " has an inner range outside its outer range";
  return std::nullopt;
}

std::optional<std::string> fault_of_kernel(const regulus_kernel& kernel) {
  try {
    static_cast<void>(CheckedKernel(kernel));
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

bool places_fit(const regulus_kernel& kernel, const regulus_derivatives& derivatives, unsigned rows,
                bool second_order) {
  for (unsigned i = 0; i < derivatives.count; ++i) {
    const regulus_derivative& d = derivatives.list[i];
    if (d.row >= rows || d.column >= kernel.columns || d.first >= kernel.variables) return false;
    if (second_order && (d.second < d.first || d.second >= kernel.variables)) return false;
  }
  return derivatives.count == 0 || derivatives.function != nullptr;
}

/// Derivatives of A by quantities that touch one row are in that row.
bool rows_fit(const regulus_expansion& x, const regulus_derivatives& derivatives,
              bool second_order) {
  for (unsigned i = 0; i < derivatives.count; ++i) {
    const regulus_derivative& d = derivatives.list[i];
    const int row = static_cast<int>(d.row);
    const int of_first = x.row_of_variable[d.first];
    const int of_second = second_order ? x.row_of_variable[d.second] : -1;
    if (of_first < 0 && of_second < 0) return false;
    if ((of_first >= 0 && of_first != row) || (of_second >= 0 && of_second != row)) return false;
  }
  return true;
}

std::optional<std::string> fault_of_expansion(const Problem& problem) {
  const regulus_kernel& kernel = *problem.kernel;
  if (kernel.expansion == nullptr) return std::nullopt;
  const regulus_expansion& x = *kernel.expansion;
  if (x.product == nullptr || x.row_of_variable == nullptr)
    return "the kernel's expansion has no product or no rows of its variables";
  for (unsigned k = 0; k < kernel.variables; ++k) {
    if (x.row_of_variable[k] >= static_cast<int>(kernel.rows))
      return "the kernel's expansion gives a variable a row that does not exist";
    // Taylor's theorem needs the path from the nominal value to stay in the box.
    if (x.nominal == nullptr || x.row_of_variable[k] < 0) continue;
    if (!certain_subset({x.nominal[2 * k], x.nominal[2 * k + 1]}, problem.outer[k]))
      return "variable " + std::to_string(k) + " has a nominal value outside its range";
  }
  if (!places_fit(kernel, x.first, kernel.columns, false) ||
      !places_fit(kernel, x.second, kernel.columns, true) ||
      !places_fit(kernel, x.row_first, kernel.rows, false) ||
      !places_fit(kernel, x.row_second, kernel.rows, true) || !rows_fit(x, x.row_first, false) ||
      !rows_fit(x, x.row_second, true))
    return "the kernel's expansion lists a derivative of no entry, or of another row";
  return std::nullopt;
}

std::optional<std::string> fault_of_method(const regulus_kernel& kernel, Method method) {
  if (method == Method::kClosedForm && kernel.determinant == nullptr)
    return "method closed-form needs a kernel with the determinant in closed form";
  return std::nullopt;
}

}  // namespace

bool same_but_for_run(const Settings& a, const Settings& b) {
  Settings other = b;
  other.max_boxes = a.max_boxes;
  other.time_limit = a.time_limit;
  other.interrupt = a.interrupt;
  other.boxes_after_problem = a.boxes_after_problem;
  other.boxes_before_units = a.boxes_before_units;
  other.boxes_of_unit = a.boxes_of_unit;
  other.workers = a.workers;
  other.oracle = a.oracle;
  other.closed_form = a.closed_form;
  other.algebra = a.algebra;
  return a == other;
}

std::optional<std::string> find_fault(const Problem& problem, const Settings& settings) {
  if (problem.kernel == nullptr) return "there is no kernel";
  const regulus_kernel& kernel = *problem.kernel;
  if (auto fault = fault_of_kernel(kernel)) return fault;
  if (problem.outer.size() != kernel.variables || problem.inner.size() != kernel.variables)
    return "the kernel has " + std::to_string(kernel.variables) + " variables, the problem " +
           std::to_string(problem.outer.size());
  if (!problem.idle.empty() && problem.idle.size() != kernel.variables)
    return "the list of idle variables is too short";
  for (std::size_t k = 0; k < problem.outer.size(); ++k)
    if (auto fault = fault_of_range(problem, k)) return fault;
  if (auto fault = fault_of_expansion(problem)) return fault;
  if (!(problem.alpha.lo >= 0.0 && problem.alpha.hi < kInfinity))
    return "the threshold is not a finite number ≥ 0";
  if (settings.batch < 1 || settings.batch > kLanes) return "the batch is not of 1 to 8 boxes";
  if (settings.boxes_of_unit < 1) return "the units of the search have no boxes";
  if (settings.threads < 1 || settings.threads > kMaxThreads)
    return "the number of threads is not from 1 to " + std::to_string(kMaxThreads);
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
