// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/algebra_oracle.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codegen/kernel/program/rational_bounds.hpp"
#include "codegen/kernel/symbolic/determinant.hpp"
#include "codegen/kernel/symbolic/evaluate.hpp"
#include "codegen/kernel/symbolic/from_ginac.hpp"
#include "codegen/kernel/symbolic/rewrite.hpp"
#include "codegen/question/engine/arb_oracle.hpp"
#include "codegen/question/engine/enclosed_place.hpp"
#include "codegen/question/engine/exact_place.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

/// Bits at the samples: first before the determinant is multiplied out, then for the result that it
/// seems to vanish although the expansion did not show it.
constexpr long kFewBits = 212;
constexpr long kManyBits = 2048;
/// Terms of the determinant, before like ones are combined.
constexpr std::uint64_t kBudget = 50000;
/// A larger matrix is not multiplied out, because its certificate could not be checked.
constexpr int kLargestOrder = 8;

/// Coordinates of points that fill the variety evenly enough, the middle first.
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

/// True if the determinant cannot be distinguished from 0 at the point, and at each sample where it
/// is defined.
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
  if (p.labels.rows > kLargestOrder) return false;
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

using Values = std::map<std::string, Expression>;

/// nullopt for the end of an axis of a ball, which need not be in the ball.
std::optional<Values> values_at(std::span<const Variable> variables,
                                std::span<const Interval> point,
                                std::span<const PlaceInRange> places) {
  const SymbolMeaning no_symbols;
  Values values;
  for (std::size_t k = 0; k < variables.size(); ++k) {
    const Variable& v = variables[k];
    const bool at_end = places[k] != PlaceInRange::kInside;
    if (at_end ? v.ball >= 0 : point[k].lo != point[k].hi) return std::nullopt;
    const GiNaC::ex& end = places[k] == PlaceInRange::kUpperEnd ? v.range.hi : v.range.lo;
    values.emplace(v.name, at_end ? GinacReader(no_symbols).read(end)
                                  : Expression(exact_rational(point[k].lo)));
  }
  return values;
}

/// A polynomial in indeterminates is known to be 0 only if it has no terms.
bool is_at_most(const Polynomial& p, const Expression& alpha) {
  if (p.is_zero()) return true;
  const PolynomialTerm& first = p.terms().front();
  const bool is_number = p.terms().size() == 1 && first.monomial == Monomial{};
  return is_number && alpha.kind() == ExpressionKind::kConstant &&
         cln::abs(first.factor) <= alpha.value();
}

bool is_at_most_alpha(const Formulation& f, const Values& values, const GiNaC::ex& alpha) {
  const SymbolMeaning no_symbols;
  const Expression threshold = GinacReader(no_symbols).read(alpha);
  const ReplacementOf value_of = [&](const Expression& e) -> std::optional<Expression> {
    if (e.kind() != ExpressionKind::kVariable) return std::nullopt;
    return values.at(e.name());
  };
  Rewriter rewriter({}, {});
  const auto expanded = [&](const Expression& e) {
    return rewriter.expand(substitute(e, value_of));
  };
  std::vector<Polynomial> entries;
  for (const Expression& e : f.natural_matrix) entries.push_back(expanded(e));
  DeterminantBudget budget(kBudget);
  Polynomial p = determinant(entries, f.columns, rewriter.atoms(), budget);
  if (p.is_zero() || threshold.is_constant(0)) return p.is_zero();
  for (const Expression& scale : f.natural_row_scale) p = p * expanded(scale);
  return is_at_most(p, threshold);
}

}  // namespace

bool ExactAlgebra::is_singular_at(std::span<const Interval> point,
                                  std::span<const PlaceInRange> places) noexcept try {
  if (preparation_.is_replanned) return false;
  const Formulation& f = preparation_.stages->natural_formulation();
  if (f.rows != f.columns || f.rows > kLargestOrder) return false;
  const std::optional<Values> values = values_at(f.variables, point, places);
  return values && is_at_most_alpha(f, *values, preparation_.stages->request().motion.alpha);
} catch (...) {
  return false;  // one more way of not knowing
}

std::optional<ExactPlace> ExactAlgebra::find_singular(std::span<const Interval> box) noexcept try {
  return find_exact_place(preparation_, box);
} catch (...) {
  return std::nullopt;  // one more way of not knowing
}

std::optional<EnclosedPlace> ExactAlgebra::enclose_singular(std::span<const Interval> box) noexcept
    try {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  return find_enclosed_place(preparation_, box);
} catch (...) {
  return std::nullopt;  // one more way of not knowing
}

AlgebraOracle::Determinant ExactAlgebra::determinant(std::span<const Interval> point) noexcept try {
  if (!vanishes_at_samples(preparation_, point, kFewBits)) return Determinant::kUnknown;
  if (vanishes_identically(preparation_)) return Determinant::kVanishes;
  return vanishes_at_samples(preparation_, point, kManyBits) ? Determinant::kSeemsToVanish
                                                             : Determinant::kUnknown;
} catch (...) {
  return Determinant::kUnknown;  // the result is not known
}

}  // namespace regulus::detail
