// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/real_functions.hpp"

#include <algorithm>
#include <array>

#include "codegen/model/exact/combine_limits.hpp"
#include "codegen/model/exact/domain.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// Records the domain in the first argument and returns the value.
using Apply = ex (*)(ParsedExpression& result, const std::vector<ParsedExpression>& arguments);

ex apply_sqrt(ParsedExpression& result, const std::vector<ParsedExpression>& x) {
  require_nonnegative(result, x[0].value, x[0].constant);
  // GiNaC::sqrt on a number would give a float.
  return GiNaC::pow(x[0].value, GiNaC::numeric(1, 2));
}

ex apply_sin(ParsedExpression&, const std::vector<ParsedExpression>& x) {
  return GiNaC::sin(x[0].value);
}
ex apply_cos(ParsedExpression&, const std::vector<ParsedExpression>& x) {
  return GiNaC::cos(x[0].value);
}

ex apply_tan(ParsedExpression& result, const std::vector<ParsedExpression>& x) {
  require_no_pole_of_tan(result, x[0].value);
  return GiNaC::tan(x[0].value);
}

ex apply_asin(ParsedExpression& result, const std::vector<ParsedExpression>& x) {
  require_unit_range(result, x[0].value, x[0].constant);
  return GiNaC::asin(x[0].value);
}

ex apply_acos(ParsedExpression& result, const std::vector<ParsedExpression>& x) {
  require_unit_range(result, x[0].value, x[0].constant);
  return GiNaC::acos(x[0].value);
}

ex apply_atan(ParsedExpression&, const std::vector<ParsedExpression>& x) {
  return GiNaC::atan(x[0].value);
}

ex apply_atan2(ParsedExpression& result, const std::vector<ParsedExpression>& x) {
  require_off_branch_cut(result, x[0].value, x[1].value);
  return GiNaC::atan2(x[0].value, x[1].value);
}

ex apply_exp(ParsedExpression&, const std::vector<ParsedExpression>& x) {
  return GiNaC::exp(x[0].value);
}

ex apply_log(ParsedExpression& result, const std::vector<ParsedExpression>& x) {
  require_positive(result, x[0].value, x[0].constant);
  return GiNaC::log(x[0].value);
}

/// For an operand that GiNaC does not know to be real, such as log(x), GiNaC turns abs(u)^2 into
/// u·conjugate(u), also in derivatives.
ex apply_abs(ParsedExpression&, const std::vector<ParsedExpression>& x) {
  const ex& u = x[0].value;
  if (u.info(GiNaC::info_flags::real)) return GiNaC::abs(u);
  return GiNaC::pow(GiNaC::pow(u, 2), GiNaC::numeric(1, 2));
}

constexpr std::size_t kNumberOfFunctions = 11;
constexpr std::array<Apply, kNumberOfFunctions> kApply = {
    apply_sqrt, apply_sin,   apply_cos, apply_tan, apply_asin, apply_acos,
    apply_atan, apply_atan2, apply_exp, apply_log, apply_abs};

std::size_t index_of(std::string_view name) {
  const auto names = function_names();
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

}  // namespace

std::span<const std::string> function_names() {
  static const std::array<std::string, kNumberOfFunctions> kNames = {
      "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "abs"};
  return kNames;
}

bool is_function(std::string_view name) { return index_of(name) < kNumberOfFunctions; }

ParsedExpression call(std::string_view name, std::vector<ParsedExpression> arguments) {
  const std::size_t wanted = name == "atan2" ? 2 : 1;
  if (arguments.size() != wanted)
    throw ParseRefusal{
        std::string(name) + " with " + std::to_string(arguments.size()) + " arguments",
        wanted == 1 ? "one argument" : "two arguments, atan2(y, x)"};
  ParsedExpression result = combine_limits(arguments);
  result.value = kApply[index_of(name)](result, arguments);
  return result;
}

}  // namespace regulus::detail
