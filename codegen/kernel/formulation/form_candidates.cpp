// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/form_candidates.hpp"

#include <algorithm>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/interval_arithmetic.hpp"
#include "codegen/kernel/symbolic/lowering.hpp"
#include "codegen/kernel/symbolic/passes.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/regularity/aligned_buffer.hpp"
#include "runtime/regularity/midpoint_inverse.hpp"

namespace regulus::detail {
namespace {

/// Empty where one of the values is not defined.
std::vector<Interval> values_of(const Program& program, const std::vector<Interval>& box,
                                const std::vector<Interval>& K) {
  IntervalArithmetic arithmetic;
  std::vector<Interval> result =
      evaluate(program, std::span<const Interval>(box), std::span<const Interval>(K), arithmetic);
  return arithmetic.undefined() ? std::vector<Interval>() : result;
}

}  // namespace

FormCandidates::FormCandidates(const Formulation& formulation, const RewriteOptions& rewriting)
    : formulation_(formulation) {
  for (const Variable& v : formulation.variables) names_.push_back(v.name);
  for (int i = 1; i <= formulation.columns; ++i)
    for (int j = 1; j <= formulation.rows; ++j) points_.push_back(point_name(i, j));
  rewriter_ = std::make_unique<Rewriter>(names_, points_, rewriting);
  try {
    for (const Variable& v : formulation.variables)
      box_.push_back(
          hull(enclose_constant(v.range.lo, v.name), enclose_constant(v.range.hi, v.name)));
    find_preconditioner();
  } catch (const InputError&) {
    // A range without a value is reported by those who search it.
  }
}

FormCandidates::~FormCandidates() = default;

void FormCandidates::find_preconditioner() {
  std::vector<Interval> middle;
  for (const Interval& range : box_) middle.emplace_back(mid(range));
  const std::vector<Interval> A =
      values_of(lower_outputs(formulation_, formulation_.matrix), middle, {});
  if (A.empty()) return;
  const auto m = static_cast<std::size_t>(formulation_.rows);
  const auto n = static_cast<std::size_t>(formulation_.columns);
  AlignedBuffer from(m * n * kLanes), to(m * n * kLanes);
  for (std::size_t e = 0; e < m * n; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane) from[point_at(e, lane)] = mid(A[e]);
  LaneNumbers determinant{};
  const LaneMask singular =
      approx_inverse(ConstPointMatrix(from.get(), m, n), PointMatrix(to.get(), n, m), determinant);
  if (singular != 0) return;
  for (std::size_t e = 0; e < m * n; ++e) K_.emplace_back(to[point_at(e, 0)]);
}

std::optional<double> FormCandidates::width(const Expression& form) const {
  if (K_.empty()) return std::nullopt;
  Lowering lowering(names_, points_);
  lowering.output(form);
  const std::vector<Interval> value = values_of(std::move(lowering).finish(), box_, K_);
  if (value.empty()) return std::nullopt;
  return value[0].hi - value[0].lo;
}

void FormCandidates::add(std::vector<FormCandidate>& to, const Polynomial& p,
                         const std::string& prefix) {
  const auto offer = [&](const std::string& passes, const Expression& form) {
    to.push_back({prefix + passes, count_occurrences(form), width(form)});
  };
  offer("collect", collect(p, rewriter_->atoms()));
  if (!can_nest(p)) return;
  HornerOptions options;
  offer("horner", horner(p, rewriter_->atoms(), options));
  options.order = HornerOrder::kVariablesFirst;
  offer("horner, variables first", horner(p, rewriter_->atoms(), options));
}

std::vector<FormCandidate> FormCandidates::of(const Expression& natural) {
  std::vector<FormCandidate> result{{"natural", count_occurrences(natural), width(natural)}};
  if (!natural.is_total()) return result;
  const Polynomial p = rewriter_->expand(natural);
  add(result, p, "");
  const auto merge = [this](const Polynomial& q, bool double_angles) {
    const auto simplify = [this](const Expression& e) {
      const std::optional<Polynomial> of_argument = rewriter_->expander().expand(e);
      return of_argument ? horner(*of_argument, rewriter_->atoms()) : e;
    };
    return merge_angles(q, rewriter_->atoms(), rewriter_->expander(), simplify,
                        {true, double_angles});
  };
  const Polynomial merged = merge(p, false);
  if (!(merged == p)) add(result, merged, "angles + ");
  const Polynomial doubled = merge(p, true);
  if (!(doubled == merged)) add(result, doubled, "double angles + ");
  return result;
}

}  // namespace regulus::detail
