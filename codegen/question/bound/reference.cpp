// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "codegen/model/exact/decimal.hpp"
#include "codegen/question/bound/bracket_question.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"
#include "runtime/search/bracket.hpp"

namespace regulus::detail {
namespace {

constexpr double kBeyond = 1.01;  ///< an end of the bracket that is certainly singular
constexpr double kPartOfLeast = 0.5;

/// To three digits: the last ones of a sample are not the same with every C library.
double rounded(double x) { return std::stod(fmt::format("{:.2e}", x)); }

}  // namespace

GiNaC::ex Reference::value() const { return shortest_decimal(approx); }

Reference choose_reference(const Component& component, const std::vector<double>& values,
                           double least) {
  Reference result;
  if (values.empty()) return result;
  const bool direct = traits_of(component.kind).is_always_least;
  double extreme = direct ? std::ranges::min(values) : std::ranges::max(values);
  if (!component.is_absolute && extreme <= 0) {
    result.approx = extreme == 0 ? -1 : rounded(2 * extreme);
    extreme = extreme == 0 ? 1 : -extreme;
  }
  if (component.is_absolute && !direct) extreme = std::max(extreme, kPartOfLeast * least);
  if (extreme > 0) result.sampled = direct ? extreme : 1 / extreme;
  return result;
}

MarginQuestion question_beyond(const Bordered& bordered, const std::optional<double>& sampled) {
  std::optional<MarginValue> high;
  if (sampled) high = decimal_value(short_decimal_above(kBeyond * *sampled));
  return question_of(bordered, decimal_value(0), std::move(high));
}

GiNaC::ex bound_at(const Bordered& bordered, const Component& component, const MarginValue& value) {
  return bordered.is_reciprocal ? component.sign * (bordered.reference + 1 / value.exact)
                                : value.exact;
}

bool is_zero_where_defined(const Bordered& bordered, const Component& component) {
  const Model& model = bordered.request.model;
  const Motion& motion = bordered.request.motion;
  return component.kind == QuantityKind::kSpeed && motion.constraints.empty() &&
         motion.reach.empty() && model.matrix.rows() == 1 &&
         GiNaC::is_a<GiNaC::numeric>(model.matrix(0, 0));
}

void set_zero(ComponentBound& bound) {
  bound.proved = bound.attained = end_at(0);
  bound.place.emplace().pose = "every pose";
  bound.is_closed = true;
}

std::optional<double> relative_gap(const ComponentBound* attained, const ComponentBound* proved) {
  if (!attained || !proved || !attained->attained || !proved->proved) return std::nullopt;
  const double a = attained->attained->approx, p = proved->proved->approx;
  return std::abs(a - p) / std::max({std::abs(a), std::abs(p), 1e-300});
}

}  // namespace regulus::detail
