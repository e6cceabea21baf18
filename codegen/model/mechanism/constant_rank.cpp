// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/constant_rank.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "codegen/model/exact/exact_algebra.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// The coefficients of one row, one for each monomial in joints and geometry of each column.
using Coefficients = std::vector<ex>;

/// Numbers the monomials.
class Monomials {
 public:
  std::size_t index(std::size_t column, const JointPolynomial::Key& key, const ex& geometry) {
    const auto [first, last] = known_.equal_range({column, key});
    for (auto at = first; at != last; ++at)
      if (at->second.first.is_equal(geometry)) return at->second.second;
    known_.emplace(std::pair(column, key), std::pair(geometry, known_.size()));
    return known_.size() - 1;
  }

 private:
  std::multimap<std::pair<std::size_t, JointPolynomial::Key>, std::pair<ex, std::size_t>> known_;
};

/// Splits a product into its number and the rest.
std::pair<ex, ex> split_product(const ex& term) {
  if (!has_symbols(term)) return {term, 1};
  if (!GiNaC::is_a<GiNaC::mul>(term)) return {1, term};
  ex number = 1, rest = 1;
  for (std::size_t i = 0; i < term.nops(); ++i)
    (has_symbols(term.op(i)) ? rest : number) *= term.op(i);
  return {number, rest};
}

void add_at(Coefficients& row, std::size_t index, const ex& value) {
  if (row.size() <= index) row.resize(index + 1, 0);
  row[index] += value;
}

void add_terms(Coefficients& row, std::size_t column, const JointPolynomial& entry,
               Monomials& monomials) {
  for (const auto& [key, coefficient] : entry.terms()) {
    const ex sum = reduced(coefficient);
    const bool several = GiNaC::is_a<GiNaC::add>(sum);
    for (std::size_t i = 0; i < (several ? sum.nops() : 1); ++i) {
      const auto [number, rest] = split_product(several ? sum.op(i) : sum);
      add_at(row, monomials.index(column, key, rest), number);
    }
  }
}

/// A row of an echelon form: its entry at `pivot` is proved to differ from zero.
struct EchelonRow {
  Coefficients row;
  std::size_t pivot;
};

std::size_t count_summands(const ex& e) { return GiNaC::is_a<GiNaC::add>(e) ? e.nops() : 1; }

/// Limits the work of an elimination: products of sums of roots, sines and cosines grow fast.
class Elimination {
 public:
  explicit Elimination(WorkMeter* meter) : meter_(meter) {}

  /// Subtracts without dividing: row · pivot − base · entry. Throws OverBudget.
  void eliminate(Coefficients& row, const EchelonRow& base) {
    if (row.size() < base.row.size()) row.resize(base.row.size(), 0);
    const ex entry = row[base.pivot], pivot = base.row[base.pivot];
    if (entry.is_zero()) return;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const ex subtracted = i < base.row.size() ? base.row[i] : ex(0);
      count(count_summands(row[i]) * count_summands(pivot) +
            count_summands(subtracted) * count_summands(entry));
      row[i] = reduced(row[i] * pivot - subtracted * entry);
    }
  }

 private:
  void count(std::size_t products) {
    constexpr std::size_t kSteps = 100;  // as for the terms of a TermBudget
    budget_.spend(products);
    spend(meter_, kSteps * products);
  }

  static constexpr std::uint64_t kMostProducts = 50'000;  // about a second
  WorkMeter* meter_;
  WorkMeter budget_{kMostProducts};
};

enum class Dependence { kDependent, kIndependent, kUnknown };

Dependence find_pivot(const Coefficients& row, std::size_t& pivot) {
  bool zero = true;
  for (pivot = 0; pivot < row.size(); ++pivot) {
    if (is_certainly_nonzero(row[pivot])) return Dependence::kIndependent;
    zero = zero && row[pivot].is_zero();
  }
  return zero ? Dependence::kDependent : Dependence::kUnknown;
}

std::vector<Coefficients> coefficients_of(const std::vector<std::vector<JointPolynomial>>& rows) {
  Monomials monomials;
  std::vector<Coefficients> all(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < rows[i].size(); ++j) add_terms(all[i], j, rows[i][j], monomials);
    for (ex& entry : all[i]) entry = reduced(entry);
  }
  return all;
}

std::vector<double> approx(const Coefficients& row) {
  std::vector<double> values;
  for (const ex& entry : row) {
    const ex value = entry.evalf();
    const bool known = GiNaC::is_a<GiNaC::numeric>(value);
    values.push_back(known ? GiNaC::ex_to<GiNaC::numeric>(value).to_double() : 0);
  }
  return values;
}

/// The rank in doubles. Rows that look independent are all kept, which is right in any case; a proof
/// is tried for others alone.
std::size_t approx_rank(const std::vector<Coefficients>& rows) {
  constexpr double kSmall = 1e-9;  // beside a row of length 1
  std::vector<std::vector<double>> basis;
  const auto product = [](const std::vector<double>& u, const std::vector<double>& v) {
    const std::size_t n = std::min(u.size(), v.size());
    return std::inner_product(u.begin(), u.begin() + std::ptrdiff_t(n), v.begin(), 0.0);
  };
  for (const Coefficients& coefficients : rows) {
    std::vector<double> row = approx(coefficients);
    const double length = std::sqrt(product(row, row));
    for (const auto& other : basis) {
      const double along = product(row, other);
      row.resize(std::max(row.size(), other.size()), 0);
      for (std::size_t k = 0; k < other.size(); ++k) row[k] -= along * other[k];
    }
    const double rest = std::sqrt(product(row, row));
    if (!(rest > kSmall * length)) continue;
    for (double& x : row) x /= rest;
    basis.push_back(std::move(row));
  }
  return basis.size();
}

std::vector<std::size_t> all_rows(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

std::vector<std::size_t> independent_rows(const std::vector<std::vector<JointPolynomial>>& rows,
                                          WorkMeter* meter) try {
  const std::vector<Coefficients> all = coefficients_of(rows);
  if (approx_rank(all) == rows.size()) return all_rows(rows.size());
  Elimination elimination(meter);
  std::vector<EchelonRow> echelon;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Coefficients row = all[i];
    for (const EchelonRow& base : echelon) elimination.eliminate(row, base);
    std::size_t pivot = 0;
    const Dependence found = find_pivot(row, pivot);
    if (found == Dependence::kUnknown) return all_rows(rows.size());
    if (found == Dependence::kDependent) continue;
    echelon.push_back({std::move(row), pivot});
    chosen.push_back(i);
  }
  return chosen;
} catch (const OverBudget&) {
  return all_rows(rows.size());
}

}  // namespace regulus::detail
