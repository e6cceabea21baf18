// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates expressions at many points, in doubles. For tests only.
#pragma once

#include <ginac/ginac.h>

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace regulus::detail::test {

/// Sums, products, powers, sines and cosines in an order in which each has its operands before it.
class FormulaTape {
 public:
  /// `names`: of the symbols, in the order of the values.
  FormulaTape(const std::vector<GiNaC::ex>& formulas, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i) inputs_[names[i]] = i;
    for (const GiNaC::ex& formula : formulas) results_.push_back(add(formula));
  }

  [[nodiscard]] std::vector<double> at(const std::vector<double>& values) const {
    std::vector<double> v(steps_.size());
    for (std::size_t i = 0; i < steps_.size(); ++i) v[i] = value(steps_[i], v, values);
    std::vector<double> result;
    for (const std::size_t i : results_) result.push_back(v[i]);
    return result;
  }

 private:
  enum class Kind { kNumber, kInput, kSum, kProduct, kPower, kSine, kCosine };
  struct Step {
    Kind kind = Kind::kNumber;
    double number = 0;
    std::vector<std::size_t> of{};
  };

  static double value(const Step& s, const std::vector<double>& v, const std::vector<double>& in) {
    double result = s.kind == Kind::kProduct ? 1 : 0;
    switch (s.kind) {
      case Kind::kNumber:
        return s.number;
      case Kind::kInput:
        return in[s.of[0]];
      case Kind::kSum:
        for (const std::size_t i : s.of) result += v[i];
        return result;
      case Kind::kProduct:
        for (const std::size_t i : s.of) result *= v[i];
        return result;
      case Kind::kPower:
        return s.number == 2 ? v[s.of[0]] * v[s.of[0]] : std::pow(v[s.of[0]], s.number);
      case Kind::kSine:
        return std::sin(v[s.of[0]]);
      case Kind::kCosine:
        return std::cos(v[s.of[0]]);
    }
    return result;
  }

  static double number_of(const GiNaC::ex& e) {
    return GiNaC::ex_to<GiNaC::numeric>(e.evalf()).to_double();
  }

  std::size_t add(const GiNaC::ex& e) {
    if (const auto known = known_.find(e); known != known_.end()) return known->second;
    Step step;
    if (GiNaC::is_a<GiNaC::numeric>(e) || e.is_equal(GiNaC::Pi)) {
      step.number = number_of(e);
    } else if (GiNaC::is_a<GiNaC::symbol>(e)) {
      step = {Kind::kInput, 0, {inputs_.at(GiNaC::ex_to<GiNaC::symbol>(e).get_name())}};
    } else if (GiNaC::is_a<GiNaC::power>(e)) {
      step = {Kind::kPower, number_of(e.op(1)), {add(e.op(0))}};
    } else if (GiNaC::is_a<GiNaC::function>(e)) {
      const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
      if (name != "sin" && name != "cos") throw std::invalid_argument("the function " + name);
      step = {name == "sin" ? Kind::kSine : Kind::kCosine, 0, {add(e.op(0))}};
    } else {
      step.kind = GiNaC::is_a<GiNaC::add>(e) ? Kind::kSum : Kind::kProduct;
      for (const GiNaC::ex& operand : e) step.of.push_back(add(operand));
    }
    steps_.push_back(std::move(step));
    return known_[e] = steps_.size() - 1;
  }

  std::map<std::string, std::size_t> inputs_;
  std::map<GiNaC::ex, std::size_t, GiNaC::ex_is_less> known_;
  std::vector<Step> steps_;
  std::vector<std::size_t> results_;
};

}  // namespace regulus::detail::test
