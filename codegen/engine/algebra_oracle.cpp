// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/engine/algebra_oracle.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "codegen/engine/arb_oracle.hpp"
#include "codegen/symbolic/determinant.hpp"

namespace regulus::inline engine {
namespace {

/// Bits at the samples: before the determinant is multiplied out, and to say that it seems to
/// vanish although that did not show it.
constexpr long kFewBits = 212;
constexpr long kManyBits = 2048;
/// Terms of the determinant, before like ones are combined.
constexpr std::uint64_t kBudget = 50000;
/// A larger matrix is not multiplied out: no certificate of it could be checked.
constexpr int kMaxOrder = 8;

/// Points that fill the variety evenly enough, the middle first.
constexpr double kParts[] = {0.5, 0.381966, 0.763932, 0.145898};
constexpr std::size_t kPoints = std::size(kParts);

std::vector<Interval> sample(const Variety& variety, std::size_t number) {
  std::vector<Interval> point;
  for (std::size_t k = 0; k < variety.outer.size(); ++k) {
    const std::optional<Interval>& inner = variety.inner[k];
    if (!inner) {
      point.push_back(variety.outer[k]);
      continue;
    }
    const double part = kParts[(number * (k + 1)) % kPoints];
    const double x = inner->lo + part * (inner->hi - inner->lo);
    point.emplace_back(std::clamp(x, inner->lo, inner->hi));
  }
  return point;
}

bool may_be_zero(const std::optional<Interval>& determinant) {
  return determinant && determinant->lo <= 0 && determinant->hi >= 0;
}

/// The determinant is too small to be told from 0 at the point, and at each sample where it is
/// defined.
bool vanishes_at_samples(const PreparedSearch& p, std::span<const Interval> point, long bits) {
  ArbOracle oracle(p.stages->matrix(), p.labels.rows, bits);
  if (!may_be_zero(oracle.enclose(point))) return false;
  for (std::size_t number = 0; number < kPoints; ++number) {
    const auto determinant = oracle.enclose(sample(p.variety, number));
    if (determinant && !may_be_zero(determinant)) return false;
  }
  return true;
}

bool vanishes_identically(const PreparedSearch& p) {
  if (p.labels.rows > kMaxOrder) return false;
  FormulationOptions options;
  options.left_product = options.derivatives = options.right_product = false;
  options.determinant = true;
  options.determinant_budget = kBudget;
  try {
    const Request& request = p.stages->request();
    const Formulation f = formulate(request.model, request.motion, options);
    return f.determinant.size() == 1 && f.determinant.front().is_constant(0);
  } catch (const ClosedFormError&) {
    return false;
  }
}

}  // namespace

AlgebraOracle::Determinant ExactAlgebra::determinant(std::span<const Interval> point) noexcept try {
  if (!vanishes_at_samples(preparation_, point, kFewBits)) return Determinant::kUnknown;
  if (vanishes_identically(preparation_)) return Determinant::kVanishes;
  return vanishes_at_samples(preparation_, point, kManyBits) ? Determinant::kSeemsToVanish
                                                             : Determinant::kUnknown;
} catch (...) {
  return Determinant::kUnknown;  // one more way of not knowing
}

}  // namespace regulus::inline engine
