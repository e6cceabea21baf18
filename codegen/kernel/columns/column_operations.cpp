// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/columns/column_operations.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace regulus::detail {
namespace {

std::size_t terms_in(const PolynomialMatrix& A, int column) {
  std::size_t count = 0;
  for (int i = 0; i < A.rows(); ++i) count += A.at(i, column).terms().size();
  return count;
}

std::size_t terms_in(const PolynomialMatrix& A) {
  std::size_t count = 0;
  for (const Polynomial& entry : A.entries) count += entry.terms().size();
  return count;
}

/// The factor of a column before it is added to another.
struct Multiplier {
  AtomProduct atoms;
  cln::cl_RA factor;
};

struct MultiplierOrder {
  bool operator()(const Multiplier& a, const Multiplier& b) const {
    if (a.atoms != b.atoms) return a.atoms < b.atoms;
    return a.factor < b.factor;
  }
};

/// Examines pairs of columns; pairs that have not changed are not examined again.
class ShorteningSearch {
 public:
  ShorteningSearch(PolynomialMatrix A, const std::function<bool(Atom)>& may_multiply,
                   std::uint64_t most_pairs)
      : A_(std::move(A)),
        may_multiply_(may_multiply),
        pairs_left_(most_pairs),
        best_(static_cast<std::size_t>(A_.columns * A_.columns)) {}

  ShorteningOperations run() {
    ShorteningOperations result;
    result.terms_before = terms_in(A_);
    for (int t = 0; t < A_.columns; ++t) look_at_pairs_with(t);
    while (const std::optional<Found> next = best()) {
      if (exhausted_) break;
      apply(next->operation, A_);
      result.operations.push_back(next->operation);
      look_at_pairs_with(next->operation.target);
    }
    result.terms_after = terms_in(A_);
    result.complete = !exhausted_;
    return result;
  }

 private:
  struct Found {
    ColumnOperation operation;
    std::size_t saved = 0;  // terms
  };

  std::optional<Found>& best_of(int target, int source) {
    return best_[static_cast<std::size_t>(target * A_.columns + source)];
  }

  std::optional<Found> best() const {
    std::optional<Found> most;
    for (const std::optional<Found>& found : best_)
      if (found && (!most || found->saved > most->saved)) most = found;
    return most;
  }

  void look_at_pairs_with(int column) {
    for (int other = 0; other < A_.columns; ++other) {
      if (other == column) continue;
      best_of(column, other) = look_at(column, other);
      best_of(other, column) = look_at(other, column);
    }
  }

  std::optional<Found> look_at(int target, int source) {
    std::map<Multiplier, std::size_t, MultiplierOrder> cancelled;
    for (int i = 0; i < A_.rows(); ++i)
      if (!count_cancelled(A_.at(i, target), A_.at(i, source), cancelled)) return std::nullopt;
    const auto most =
        std::max_element(cancelled.begin(), cancelled.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == cancelled.end()) return std::nullopt;
    const ColumnOperation operation{target, source, most->first.factor, most->first.atoms};
    PolynomialMatrix changed = A_;
    apply(operation, changed);
    const std::size_t before = terms_in(A_, target), after = terms_in(changed, target);
    if (after >= before) return std::nullopt;
    return Found{operation, before - after};
  }

  /// Counts, for each multiplier of q's terms, the terms of p that it cancels.
  bool count_cancelled(const Polynomial& p, const Polynomial& q,
                       std::map<Multiplier, std::size_t, MultiplierOrder>& cancelled) {
    const std::uint64_t pairs = p.terms().size() * q.terms().size();
    exhausted_ = exhausted_ || pairs > pairs_left_;
    if (exhausted_) return false;
    pairs_left_ -= pairs;
    AtomProduct quotient;
    for (const PolynomialTerm& term : p.terms())
      for (const PolynomialTerm& by : q.terms()) {
        if (term.monomial.variables.size() <= by.monomial.variables.size()) continue;
        if (term.monomial.coefficients != by.monomial.coefficients) continue;
        if (!divide(term.monomial.variables, by.monomial.variables, quotient)) continue;
        if (!std::all_of(quotient.begin(), quotient.end(), may_multiply_)) continue;
        ++cancelled[{quotient, -term.factor / by.factor}];
      }
    return true;
  }

  PolynomialMatrix A_;
  const std::function<bool(Atom)>& may_multiply_;
  std::uint64_t pairs_left_;
  bool exhausted_ = false;
  std::vector<std::optional<Found>> best_;  // by target and source
};

}  // namespace

void apply(const ColumnOperation& operation, PolynomialMatrix& A) {
  const Polynomial multiplier(
      std::vector<PolynomialTerm>{{Monomial{operation.multiplier, {}}, operation.factor}});
  for (int i = 0; i < A.rows(); ++i)
    A.at(i, operation.target) = A.at(i, operation.target) + multiplier * A.at(i, operation.source);
}

ShorteningOperations find_shortening_operations(PolynomialMatrix A,
                                                const std::function<bool(Atom)>& may_multiply,
                                                std::uint64_t most_pairs) {
  return ShorteningSearch(std::move(A), may_multiply, most_pairs).run();
}

std::vector<ColumnOperation> scaled(std::vector<ColumnOperation> operations,
                                    const cln::cl_RA& part) {
  for (ColumnOperation& operation : operations) operation.factor = part * operation.factor;
  return operations;
}

}  // namespace regulus::detail
