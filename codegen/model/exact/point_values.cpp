// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/point_values.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace regulus::detail {

using GiNaC::ex;

namespace {

using OfOne = std::pair<std::string_view, double (*)(double)>;

constexpr std::array<OfOne, 9> kOfDoubles = {{{"sin", std::sin},
                                              {"cos", std::cos},
                                              {"tan", std::tan},
                                              {"asin", std::asin},
                                              {"acos", std::acos},
                                              {"atan", std::atan},
                                              {"exp", std::exp},
                                              {"log", std::log},
                                              {"abs", std::fabs}}};

double number(const ex& e) {
  const bool is_real = GiNaC::is_a<GiNaC::numeric>(e) && GiNaC::ex_to<GiNaC::numeric>(e).is_real();
  return is_real ? GiNaC::ex_to<GiNaC::numeric>(e).to_double() : std::nan("");
}

}  // namespace

double approx_number(const ex& constant) { return number(constant.evalf()); }

PointValues::PointValues(const GiNaC::exmap& numbers) {
  for (const auto& [symbol, value] : numbers) values_.emplace(symbol, approx_number(value));
}

double PointValues::of(const ex& expression) {
  const auto known = values_.find(expression);
  if (known != values_.end()) return known->second;
  const double value = form(expression);
  values_.emplace(expression, value);
  return value;
}

double PointValues::form(const ex& e) {
  if (GiNaC::is_a<GiNaC::numeric>(e)) return number(e);
  if (GiNaC::is_a<GiNaC::constant>(e)) return approx_number(e);
  if (GiNaC::is_a<GiNaC::power>(e)) return std::pow(of(e.op(0)), of(e.op(1)));
  if (GiNaC::is_a<GiNaC::function>(e)) return call(GiNaC::ex_to<GiNaC::function>(e));
  const bool is_sum = GiNaC::is_a<GiNaC::add>(e);
  if (!is_sum && !GiNaC::is_a<GiNaC::mul>(e)) return std::nan("");
  double value = is_sum ? 0 : 1;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    const double operand = of(e.op(i));
    value = is_sum ? value + operand : value * operand;
  }
  return value;
}

double PointValues::call(const GiNaC::function& f) {
  const std::string name = f.get_name();
  if (name == "atan2") return std::atan2(of(f.op(0)), of(f.op(1)));
  for (const auto& [known, function] : kOfDoubles)
    if (name == known) return function(of(f.op(0)));
  return std::nan("");
}

}  // namespace regulus::detail
