// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/closed_form_bounds.hpp"

#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "codegen/kernel/program/enclose.hpp"
#include "codegen/kernel/program/interval_arithmetic.hpp"
#include "codegen/kernel/symbolic/determinant.hpp"
#include "codegen/kernel/symbolic/kept_powers.hpp"
#include "codegen/kernel/symbolic/rewrite.hpp"

namespace regulus::detail {
namespace {

/// Larger determinants have too many terms to be narrower than what they are made of.
constexpr int kMostRows = 4;
constexpr std::uint64_t kMostTerms = 4000;
/// An entry of more terms is an indeterminate.
constexpr std::size_t kMostTermsOfAnEntry = 64;

/// Powers of sums that are kept in one piece.
constexpr std::size_t kMostPowers = 32;
/// Constraints that the determinant is reduced by.
constexpr std::size_t kMostConstraints = 8;

std::vector<std::string> names_of(const std::vector<Variable>& variables) {
  std::vector<std::string> names;
  for (const Variable& v : variables) names.push_back(v.name);
  return names;
}

Expressions scaled_entries(const Formulation& f) {
  Expressions entries;
  for (int i = 0; i < f.rows; ++i)
    for (int j = 0; j < f.columns; ++j)
      entries.push_back(
          f.scaling.apply(f.natural_matrix[static_cast<std::size_t>(i * f.columns + j)], i, j));
  return entries;
}

Polynomial determinant_of(const Expressions& entries, int n, Rewriter& rewriter) {
  std::vector<Polynomial> expanded;
  for (const Expression& e : entries) expanded.push_back(rewriter.expand(e));
  DeterminantBudget budget(kMostTerms);
  return determinant(expanded, n, rewriter.atoms(), budget);
}

RewriteOptions rewriting() {
  RewriteOptions options;
  options.most_terms = kMostTermsOfAnEntry;
  return options;
}

/// Not defined where `also` is not.
Program program_of(const Formulation& f, const Expression& determinant, const Expressions& also) {
  Formulation closed;
  closed.variables = f.variables;
  closed.rows = f.rows;
  closed.columns = f.columns;
  closed.must_be_defined = f.must_be_defined;
  closed.must_be_defined.insert(closed.must_be_defined.end(), also.begin(), also.end());
  closed.determinant = {determinant};
  return lower(closed).find("determinant")->program;
}

/// Throws ClosedFormError.
Program expanded_program(const Formulation& f) {
  Rewriter rewriter(names_of(f.variables), {}, rewriting());
  const Polynomial p = determinant_of(scaled_entries(f), f.columns, rewriter);
  return program_of(f, rewriter.nested_form(p).expression, {});
}

/// Throws ClosedFormError.
Program program_with_powers(const Formulation& f) {
  KeptPowers powers(kMostPowers);
  Expressions entries;
  for (const Expression& e : scaled_entries(f)) entries.push_back(powers.hide(e));
  std::vector<std::string> names = powers.names();
  const std::vector<std::string> variables = names_of(f.variables);
  names.insert(names.end(), variables.begin(), variables.end());
  Rewriter rewriter(names, {}, rewriting());
  const Polynomial p =
      powers.without_inverses(determinant_of(entries, f.columns, rewriter), rewriter.atoms());
  const Expression form = powers.reveal(rewriter.nested_form(p).expression);
  return program_of(f, form, powers.must_be_defined());
}

/// g = det + λh for a constraint h ≤ 0: det = g − λh ≥ g where it holds, if λ > 0.
struct Reduction {
  Polynomial polynomial;
  bool from_below = false;  ///< λ > 0; else det ≤ g
};

const PolynomialTerm* find_term(const Polynomial& p, const Monomial& monomial) {
  for (const PolynomialTerm& term : p.terms())
    if (term.monomial == monomial) return &term;
  return nullptr;
}

/// λ is what leaves the fewest terms; nullopt if none leaves fewer than there are.
std::optional<Reduction> reduce(const Polynomial& p, const Polynomial& constraint) {
  std::optional<Reduction> best;
  std::size_t fewest = p.terms().size();
  for (const PolynomialTerm& term : constraint.terms()) {
    const PolynomialTerm* const like = find_term(p, term.monomial);
    if (like == nullptr || term.monomial.variables.empty()) continue;
    const cln::cl_RA factor = -like->factor / term.factor;
    Polynomial left = p + constraint * factor;
    if (left.terms().size() >= fewest) continue;
    fewest = left.terms().size();
    best = Reduction{std::move(left), plusp(factor)};
  }
  return best;
}

/// Throws ClosedFormError.
std::vector<ClosedFormBounds::Form> reduced_forms(const Formulation& f) {
  std::vector<ClosedFormBounds::Form> forms;
  if (f.constraints.empty()) return forms;
  Rewriter rewriter(names_of(f.variables), {}, rewriting());
  const Polynomial p = determinant_of(scaled_entries(f), f.columns, rewriter);
  for (const Expression& constraint : f.constraints) {
    if (forms.size() == kMostConstraints) break;
    const std::optional<Reduction> found = reduce(p, rewriter.expand(constraint));
    if (!found) continue;
    forms.emplace_back(program_of(f, rewriter.nested_form(found->polynomial).expression,
                                  f.motion_must_be_defined));
    (found->from_below ? forms.back().bounds_above : forms.back().bounds_below) = false;
  }
  return forms;
}

}  // namespace

ClosedFormBounds::Form::Form(Program made) : program(std::move(made)) {
  known = enclose_constant_nodes(program);
  program.constants.clear();
}

// Without it the search goes on as it did. Not all that is thrown is a std::exception: OverBudget
// and FormingStopped are none.
void ClosedFormBounds::make() noexcept try {
  if (!forms_.empty()) return;
  const Formulation& f = stages_.natural_formulation();
  if (f.rows != f.columns || f.rows > kMostRows) return;
  for (const auto form : {expanded_program, program_with_powers}) try {
      forms_.emplace_back(form(f));
    } catch (const ClosedFormError&) {
    }
  for (Form& form : reduced_forms(f)) forms_.push_back(std::move(form));
} catch (...) {
}

std::optional<Interval> ClosedFormBounds::enclose(std::span<const Interval> box) const noexcept
    try {
  std::optional<Interval> result;
  for (const Form& form : forms_) {
    const std::optional<Interval> one = enclose(form, box);
    if (one) result = result ? intersect(*result, *one) : one;
  }
  return result;
} catch (const std::exception&) {
  return std::nullopt;
}

std::optional<Interval> ClosedFormBounds::enclose(const Form& form, std::span<const Interval> box) {
  IntervalArithmetic arithmetic;
  std::vector<Interval> values(form.program.nodes.size());
  run<IntervalArithmetic, Interval>(form.program, form.known, box, {}, values, arithmetic);
  const Interval result = values[form.program.outputs.front()];
  if (arithmetic.undefined() || !is_bounded(result)) return std::nullopt;
  return Interval(form.bounds_below ? result.lo : -kInfinity,
                  form.bounds_above ? result.hi : kInfinity);
}

}  // namespace regulus::detail
