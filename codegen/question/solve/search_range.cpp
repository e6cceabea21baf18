// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/search_range.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/certain_sign.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// Beyond the circle, so that no solution is on the border of the search; part of a turn.
constexpr double kOverlap = 0x1p-10;
/// The same for a range.
constexpr double kOverlapOfRange = 0x1p-20;

ex turn_of(const std::string& unit) { return is_in_degrees(unit) ? ex(360) : 2 * GiNaC::Pi; }

/// True if the symbol is only in arguments of sines and cosines, to which the period adds whole turns.
bool is_periodic(const ex& expression, const GiNaC::realsymbol& symbol, const ex& period) {
  if (!expression.has(symbol)) return true;
  if (GiNaC::is_a<GiNaC::symbol>(expression)) return false;
  if (GiNaC::is_a<GiNaC::function>(expression)) {
    const std::string name = GiNaC::ex_to<GiNaC::function>(expression).get_name();
    if (name == "sin" || name == "cos") {
      const ex turns = (expression.op(0).expand().diff(symbol) * period / (2 * GiNaC::Pi)).normal();
      if (GiNaC::is_a<GiNaC::numeric>(turns) && GiNaC::ex_to<GiNaC::numeric>(turns).is_integer())
        return true;
    }
  }
  return expression.nops() > 0 &&
         std::all_of(expression.begin(), expression.end(),
                     [&](const ex& part) { return is_periodic(part, symbol, period); });
}

}  // namespace

ex period_of(const Closure& closure, std::size_t unknown) {
  const PoseParameter& p = closure.unknowns[unknown];
  const ex turn = turn_of(p.unit);
  const bool is_one = (p.unit == "rad" || is_in_degrees(p.unit)) &&
                      std::ranges::all_of(closure.equations, [&](const ex& equation) {
                        return is_periodic(equation, p.symbol, turn);
                      });
  return is_one ? turn : ex(0);
}

SearchRange search_range(const Closure& closure, std::size_t unknown, const Interval& range) {
  const ex period = period_of(closure, unknown);
  const double slack = kOverlapOfRange * width_ru(range);
  SearchRange result{range + Interval(-slack, slack), range};
  if (period.is_zero()) return result;
  const Interval turn = enclose_constant(period, "period");
  if (width_ru(range) < mig(turn)) return result;
  const double half = mid(turn) * (0.5 + kOverlap);
  return {Interval(mid(range)) + Interval(-half, half), kEntire, turn};
}

void turn_back(std::vector<Interval>& values, const std::vector<SearchRange>& ranges) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (ranges[i].period == Interval(0.0)) continue;
    const double turns = std::round(mid(values[i]) / mid(ranges[i].period));
    if (turns != 0) values[i] -= Interval(turns) * ranges[i].period;
  }
}

std::optional<WithinLimits> place_in(const std::vector<Interval>& values,
                                     const std::vector<SearchRange>& ranges) {
  WithinLimits place = WithinLimits::kNoLimits;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (certain_disjoint(values[i], ranges[i].range)) return std::nullopt;
    if (!certain_subset(values[i], ranges[i].range)) place = WithinLimits::kUnknown;
  }
  return place;
}

}  // namespace regulus::detail
