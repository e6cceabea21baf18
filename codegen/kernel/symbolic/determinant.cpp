// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/determinant.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace regulus::detail {
namespace {

using Terms = std::vector<PolynomialTerm>;

/// Finds, once for each sine, the cosine of the same angle.
class Pythagoras {
 public:
  explicit Pythagoras(AtomTable& atoms) : atoms_(atoms) {}

  /// Appends a sum without squared sines that equals the term.
  void append(PolynomialTerm term, Terms& to) {
    if (replace_square(term, term.monomial.variables, variable_partners_, to)) return;
    if (replace_square(term, term.monomial.coefficients, coefficient_partners_, to)) return;
    to.push_back(std::move(term));
  }

 private:
  using Partners = std::vector<std::optional<std::optional<Atom>>>;  // by atom: asked, a sine

  bool replace_square(PolynomialTerm& term, AtomProduct& product, Partners& partners, Terms& to) {
    for (std::size_t i = 0; i + 1 < product.size(); ++i) {
      if (product[i] != product[i + 1]) continue;
      const std::optional<Atom> cosine = partner(product[i], partners);
      if (!cosine) continue;
      product.erase(i, 2);
      PolynomialTerm subtracted = term;
      AtomProduct& changed = &product == &term.monomial.variables
                                 ? subtracted.monomial.variables
                                 : subtracted.monomial.coefficients;
      changed = multiply(changed, AtomProduct(2, *cosine));
      subtracted.factor = -subtracted.factor;
      append(std::move(term), to);
      append(std::move(subtracted), to);
      return true;
    }
    return false;
  }

  std::optional<Atom> partner(Atom a, Partners& partners) {
    if (partners.size() <= a) partners.resize(std::size_t{a} + 1);
    if (!partners[a]) partners[a] = find_cosine(a, &partners == &variable_partners_);
    return *partners[a];
  }

  std::optional<Atom> find_cosine(Atom a, bool has_variables) {
    const Expression e =
        has_variables ? atoms_.variable_expression(a) : atoms_.coefficient_expression(a);
    if (e.kind() != ExpressionKind::kCall || e.function() != Call::kSin) return std::nullopt;
    const Expression cosine = call(Call::kCos, e.operands());
    return has_variables ? atoms_.variable_atom(cosine) : atoms_.coefficient_atom(cosine);
  }

  AtomTable& atoms_;
  Partners variable_partners_, coefficient_partners_;
};

/// Columns with few terms first: their minors take part in most products.
std::vector<int> order_of_columns(const std::vector<Polynomial>& entries, int n) {
  std::vector<std::size_t> terms(static_cast<std::size_t>(n));
  for (std::size_t e = 0; e < entries.size(); ++e)
    terms[e % terms.size()] += entries[e].terms().size();
  std::vector<int> order(terms.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return terms[static_cast<std::size_t>(a)] < terms[static_cast<std::size_t>(b)];
  });
  return order;
}

bool is_odd(const std::vector<int>& permutation) {
  bool odd = false;
  for (std::size_t i = 0; i < permutation.size(); ++i)
    for (std::size_t j = i + 1; j < permutation.size(); ++j)
      if (permutation[i] > permutation[j]) odd = !odd;
  return odd;
}

class Minors {
 public:
  Minors(const std::vector<Polynomial>& entries, int n, AtomTable& atoms, DeterminantBudget& budget)
      : entries_(entries),
        n_(static_cast<std::size_t>(n)),
        pythagoras_(atoms),
        atoms_(atoms),
        budget_(budget),
        columns_(order_of_columns(entries, n)),
        minors_(std::size_t{1} << n_) {}

  Polynomial run() {
    minors_[0] = Polynomial(cln::cl_RA(1));
    // A set comes after its subsets.
    for (std::size_t rows = 1; rows < minors_.size(); ++rows) minors_[rows] = minor(rows);
    return is_odd(columns_) ? minors_.back() * cln::cl_RA(-1) : minors_.back();
  }

 private:
  /// The minor of these rows and as many of the first columns, expanded along the last column.
  Polynomial minor(std::size_t rows) {
    const auto size = static_cast<std::size_t>(std::popcount(rows));
    const auto column = static_cast<std::size_t>(columns_[size - 1]);
    Terms terms;
    bool negative = size % 2 == 0;
    for (std::size_t row = 0; row < n_; ++row) {
      const std::size_t bit = std::size_t{1} << row;
      if ((rows & bit) == 0) continue;
      append_product(entries_[row * n_ + column], minors_[rows & ~bit], negative, terms);
      negative = !negative;
    }
    return Polynomial(std::move(terms));
  }

  void append_product(const Polynomial& a, const Polynomial& b, bool negative, Terms& to) {
    budget_.spend(std::uint64_t{a.terms().size()} * b.terms().size());
    atoms_.spend(std::uint64_t{a.terms().size()} * b.terms().size());
    for (const PolynomialTerm& s : a.terms())
      for (const PolynomialTerm& t : b.terms()) {
        const cln::cl_RA factor = s.factor * t.factor;
        pythagoras_.append({Monomial{multiply(s.monomial.variables, t.monomial.variables),
                                     multiply(s.monomial.coefficients, t.monomial.coefficients)},
                            negative ? -factor : factor},
                           to);
      }
  }

  const std::vector<Polynomial>& entries_;
  std::size_t n_;
  Pythagoras pythagoras_;
  const AtomTable& atoms_;
  DeterminantBudget& budget_;
  std::vector<int> columns_;
  std::vector<Polynomial> minors_;  // by the set of rows, as bits
};

std::string over_budget(std::uint64_t reached, std::uint64_t most) {
  return "the determinant takes at least " + std::to_string(reached) + " terms, the budget is " +
         std::to_string(most) + ": choose another method or a larger --symbolic-budget";
}

}  // namespace

void DeterminantBudget::spend(std::uint64_t terms) {
  if (terms > most_ - spent_) throw ClosedFormError(over_budget(spent_ + terms, most_));
  spent_ += terms;
}

Polynomial without_squared_sines(const Polynomial& p, AtomTable& atoms) {
  Pythagoras pythagoras(atoms);
  Terms terms;
  for (const PolynomialTerm& term : p.terms()) pythagoras.append(term, terms);
  return Polynomial(std::move(terms));
}

Polynomial determinant(const std::vector<Polynomial>& entries, int n, AtomTable& atoms,
                       DeterminantBudget& budget) {
  return Minors(entries, n, atoms, budget).run();
}

}  // namespace regulus::detail
