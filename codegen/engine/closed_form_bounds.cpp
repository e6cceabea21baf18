// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/engine/closed_form_bounds.hpp"

#include <exception>
#include <string>
#include <vector>

#include "codegen/program/enclose.hpp"
#include "codegen/program/interval_arithmetic.hpp"
#include "codegen/symbolic/determinant.hpp"
#include "codegen/symbolic/rewrite.hpp"

namespace regulus::inline engine {
namespace {

/// Larger determinants have too many terms to be narrower than what they are made of.
constexpr int kMostRows = 4;
constexpr std::uint64_t kMostTerms = 4000;
/// An entry of more terms is an indeterminate.
constexpr std::size_t kMostTermsOfAnEntry = 64;

/// Throws ClosedFormError.
Program determinant_program(const Formulation& f) {
  std::vector<std::string> names;
  for (const Variable& v : f.variables) names.push_back(v.name);
  RewriteOptions options;
  options.most_terms = kMostTermsOfAnEntry;
  Rewriter rewriter(names, {}, options);
  std::vector<Polynomial> entries;
  for (int i = 0; i < f.rows; ++i)
    for (int j = 0; j < f.columns; ++j)
      entries.push_back(rewriter.expand(
          f.scaling.apply(f.natural_matrix[static_cast<std::size_t>(i * f.columns + j)], i, j)));
  TermBudget budget(kMostTerms);
  Formulation closed;
  closed.variables = f.variables;
  closed.rows = f.rows;
  closed.columns = f.columns;
  closed.must_be_defined = f.must_be_defined;
  const Polynomial p = determinant(entries, f.columns, rewriter.atoms(), budget);
  closed.determinant = {rewriter.nested_form(p).expression};
  return lower(closed).find("determinant")->program;
}

}  // namespace

// Without it the search goes on as it did. Not all that is thrown is a std::exception: OverBudget
// and FormingStopped are none.
void ClosedFormBounds::make() noexcept try {
  const Formulation& f = stages_.natural_formulation();
  if (f.rows != f.columns || f.rows > kMostRows) return;
  Program program = determinant_program(f);
  known_ = enclose_constant_nodes(program);
  program.constants.clear();
  program_ = std::move(program);
} catch (...) {
}

std::optional<Interval> ClosedFormBounds::enclose(std::span<const Interval> box) const noexcept
    try {
  if (!program_) return std::nullopt;
  IntervalArithmetic arithmetic;
  std::vector<Interval> values(program_->nodes.size());
  run<IntervalArithmetic, Interval>(*program_, known_, box, {}, values, arithmetic);
  const Interval result = values[program_->outputs.front()];
  if (arithmetic.undefined() || !is_bounded(result)) return std::nullopt;
  return result;
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace regulus::inline engine
