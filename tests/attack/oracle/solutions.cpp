// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/oracle/solutions.hpp"

#include <cmath>

#include "tests/attack/oracle/evaluate.hpp"

namespace regulus::detail::attack {
namespace {

using Listed = std::map<std::string, std::pair<double, double>>;

constexpr double kNear = 1e-6;

bool is_quaternion(const std::string& name) { return name.size() == 2 && name[0] == 'q'; }

/// False only if the value is certainly outside.
bool may_be_within(const Value& value, const std::pair<double, double>& ends) {
  return (value - Value(Rational::of(ends.first))).sign() != -1 &&
         (value - Value(Rational::of(ends.second))).sign() != 1;
}

bool may_be_within(const Value& value, const std::pair<double, double>& ends,
                   const std::string& period) {
  if (period.empty()) return may_be_within(value, ends);
  const Value turn = evaluate(period, {});
  for (long turns = -4; turns <= 4; ++turns)
    if (may_be_within(value + Value(Rational(turns)) * turn, ends)) return true;
  return false;
}

std::string period_of(const SolveTruth& truth, const std::string& name) {
  const auto found = truth.periods.find(name);
  return found == truth.periods.end() ? "" : found->second;
}

bool may_be(const SolveTruth& truth, const Solution& known, const Listed& listed, long sign) {
  for (const auto& [name, ends] : listed) {
    const auto value = known.find(name);
    if (value == known.end()) return false;
    const bool turns = truth.has_opposites && is_quaternion(name);
    if (!may_be_within(turns ? Value(Rational(sign)) * value->second : value->second, ends,
                       period_of(truth, name)))
      return false;
  }
  return true;
}

bool may_be(const SolveTruth& truth, const Solution& known, const Listed& listed) {
  return may_be(truth, known, listed, 1) ||
         (truth.has_opposites && may_be(truth, known, listed, -1));
}

bool is_near(const SolveTruth& truth, const std::map<std::string, double>& near,
             const Listed& listed, double sign) {
  for (const auto& [name, ends] : listed) {
    const auto value = near.find(name);
    if (value == near.end()) return false;
    double gap = (truth.has_opposites && is_quaternion(name) ? sign : 1) * value->second -
                 (ends.first / 2 + ends.second / 2);
    const std::string period = period_of(truth, name);
    if (!period.empty())
      gap = std::remainder(gap, arf_get_d(arb_midref(evaluate(period, {}).ball()), ARF_RND_NEAR));
    const double slack = kNear * (1 + std::fabs(value->second)) + (ends.second - ends.first);
    if (!(std::fabs(gap) <= slack)) return false;
  }
  return true;
}

std::string at(const Solution& solution) {
  std::string text;
  for (const auto& [name, value] : solution)
    text += (text.empty() ? "" : ", ") + name + " = " + value.describe();
  return text;
}

std::optional<std::string> refute_each(const SolveTruth& truth, const ListedSolutions& listed) {
  std::vector<int> times(truth.known.size(), 0);
  const bool has_all = truth.count == truth.known.size();
  for (std::size_t i = 0; i < listed.solutions.size(); ++i) {
    int enclosed = 0;
    for (const auto& [name, ends] : listed.solutions[i])
      if (!(ends.first <= ends.second)) return "an enclosure of " + name + " is empty";
    for (std::size_t k = 0; k < truth.known.size(); ++k)
      if (may_be(truth, truth.known[k], listed.solutions[i])) ++enclosed, ++times[k];
    if (enclosed > 1) return "one enclosure has several solutions";
    if (has_all && enclosed == 0)
      return "number " + std::to_string(i + 1) + " of the list is no solution";
  }
  for (std::size_t k = 0; k < times.size(); ++k)
    if (times[k] > 1) return "the list has one solution twice: " + at(truth.known[k]);
  return std::nullopt;
}

}  // namespace

std::optional<std::string> refute_list(const SolveTruth& truth, const ListedSolutions& listed) {
  if (auto why = refute_each(truth, listed)) return why;
  if (truth.count && listed.solutions.size() > *truth.count)
    return "there are only " + std::to_string(*truth.count) + " solutions";
  if (listed.verdict == "incomplete") return std::nullopt;
  if (truth.is_degenerate) return "a solution is multiple or not isolated";
  if (truth.count && listed.solutions.size() != *truth.count)
    return "there are " + std::to_string(*truth.count) + " solutions";
  for (const Solution& known : truth.known) {
    bool is_listed = false;
    for (const Listed& one : listed.solutions) is_listed = is_listed || may_be(truth, known, one);
    if (!is_listed) return "the list lacks " + at(known);
  }
  for (const auto& near : truth.near) {
    bool is_listed = false;
    for (const Listed& one : listed.solutions)
      is_listed = is_listed || is_near(truth, near, one, 1) || is_near(truth, near, one, -1);
    if (is_listed) continue;
    std::string place;
    for (const auto& [name, value] : near) place += " " + name + " = " + std::to_string(value);
    return "the list lacks what Newton's method found near" + place;
  }
  return std::nullopt;
}

std::optional<std::string> refute_solutions(const SolveTruth& truth) {
  if (truth.count && truth.known.size() > *truth.count) return "more solutions than the count";
  for (const Solution& known : truth.known)
    for (const std::string& equation : truth.equations)
      if (!evaluate(equation, known).is_zero_to(Rational(1))) return "not 0: " + equation;
  return std::nullopt;
}

}  // namespace regulus::detail::attack
