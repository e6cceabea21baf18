// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/constant_rank.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "codegen/model/exact_algebra.hpp"

namespace regulus::inline model {
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

/// Subtracts without dividing: row · pivot − base · entry.
void eliminate(Coefficients& row, const EchelonRow& base) {
  if (row.size() < base.row.size()) row.resize(base.row.size(), 0);
  const ex entry = row[base.pivot], pivot = base.row[base.pivot];
  if (entry.is_zero()) return;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const ex subtracted = i < base.row.size() ? base.row[i] * entry : ex(0);
    row[i] = reduced(row[i] * pivot - subtracted);
  }
}

enum class Dependence { kDependent, kIndependent, kUnknown };

Dependence find_pivot(const Coefficients& row, std::size_t& pivot) {
  bool zero = true;
  for (pivot = 0; pivot < row.size(); ++pivot) {
    if (is_certainly_nonzero(row[pivot])) return Dependence::kIndependent;
    zero = zero && row[pivot].is_zero();
  }
  return zero ? Dependence::kDependent : Dependence::kUnknown;
}

}  // namespace

std::vector<std::size_t> independent_rows(const std::vector<std::vector<JointPolynomial>>& rows) {
  Monomials monomials;
  std::vector<EchelonRow> echelon;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Coefficients row;
    for (std::size_t j = 0; j < rows[i].size(); ++j) add_terms(row, j, rows[i][j], monomials);
    for (ex& entry : row) entry = reduced(entry);
    for (const EchelonRow& base : echelon) eliminate(row, base);
    std::size_t pivot = 0;
    const Dependence found = find_pivot(row, pivot);
    if (found == Dependence::kUnknown) {
      std::vector<std::size_t> all(rows.size());
      std::iota(all.begin(), all.end(), std::size_t{0});
      return all;
    }
    if (found == Dependence::kDependent) continue;
    echelon.push_back({std::move(row), pivot});
    chosen.push_back(i);
  }
  return chosen;
}

}  // namespace regulus::model
