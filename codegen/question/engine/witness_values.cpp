// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/witness_values.hpp"

#include <optional>

#include "codegen/question/engine/arb_oracle.hpp"

namespace regulus::detail {
namespace {

constexpr long kMostPrecision = 4096;

/// Returns the entries of the matrix, or of J⁻¹, which has its rows times their scales.
std::vector<Expression> entries_of(const Formulation& formulation, bool is_scaled) {
  std::vector<Expression> entries = formulation.natural_matrix;
  const auto& scales = formulation.natural_row_scale;
  for (std::size_t e = 0; is_scaled && !scales.empty() && e < entries.size(); ++e)
    entries[e] = scales[e / std::size_t(formulation.columns)] * entries[e];
  return entries;
}

void enclose(ArbOracle& oracle, WitnessPoint& point) {
  const Interval before = point.determinant;
  if (before.lo == 0 && before.hi == 0) return;  // found by exact algebra
  const std::optional<Interval> value = oracle.enclose(point.variables);
  const auto is_of_sign = [](Interval x) { return x.lo > 0 || x.hi < 0; };
  // At an end that is no double the sign is that of the exact number.
  if (value && (is_of_sign(*value) || !is_of_sign(before))) point.determinant = *value;
}

}  // namespace

void enclose_determinants(PreparedSearch& preparation, Result& result) {
  const bool is_small = result.reason == Reason::kSmallDeterminant;
  if (!result.witness || (!is_small && result.reason != Reason::kOppositeSigns)) return;
  if (preparation.stopped || preparation.labels.rows != preparation.labels.columns) return;
  const bool is_scaled = is_small && preparation.variety.alpha.hi > 0;
  const Formulation& formulation = preparation.stages->natural_formulation();
  ArbOracle oracle(lower_outputs(formulation, entries_of(formulation, is_scaled)),
                   preparation.labels.rows, kMostPrecision);
  for (WitnessPoint& point : result.witness->points) enclose(oracle, point);
  if (result.witness->near) enclose(oracle, *result.witness->near);
}

}  // namespace regulus::detail
