// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/branch_singular_values.hpp"

#include <algorithm>
#include <utility>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/slopes.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfSingularValues = 128;

SingularClaim claim_of(const std::string& kind) {
  return kind == format::kCondition2 ? SingularClaim::kRatioBelow
         : kind == format::kSigmaMax ? SingularClaim::kLargestBelow
                                     : SingularClaim::kLeastAbove;
}

/// Encloses a constant, which must be positive.
Ball positive_constant(const Graph& graph, NodeId node) {
  const auto value = evaluate(graph, {node}, {}, kBitsOfSingularValues);
  if (!value || !is_bounded((*value)[0].enclosure()) || arb_is_positive((*value)[0].get()) == 0)
    throw Unfinished("a number of the quantity is not certainly positive");
  return (*value)[0];
}

/// Takes an n×n matrix, entry by entry.
template <class Entry>
std::vector<Interval> matrix_of(std::size_t n, const Entry& entry) {
  std::vector<Interval> X;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t l = 0; l < n; ++l) X.push_back(entry(j, l));
  return X;
}

}  // namespace

bool is_singular_value(const std::string& kind) {
  return kind == format::kCondition2 || kind == format::kSigmaMax || kind == format::kSigmaMin;
}

BranchSingularValues::BranchSingularValues(const Question& q)
    : m_(q.variables.size()),
      n_(q.closure->equations.size()),
      claim_(claim_of(q.quantity->kind)),
      bound_(positive_constant(q.graph, q.quantity->bound)) {
  for (const NodeId factor : q.quantity->factors)
    factors_.push_back(positive_constant(q.graph, factor).enclosure());
}

/// Without derivatives of X, its enclosure over the tube is all that is known.
bool BranchSingularValues::keeps_bound(BranchTest& test) {
  impact_.clear();
  const bool has_rates = test.take_rates();
  const Intervals X = matrix_of(n_, [&](std::size_t j, std::size_t l) {
    return (has_rates ? test.center_derivative(j, l) : test.derivative(j, l)) * factors_[l];
  });
  const SingularBases bases = bases_of(X);
  if (bases.U.empty()) return false;
  RotatedMatrix B;
  if (has_rates) B = rotate(test, bases);
  B.center = rotated(X, bases);
  B.rest.assign(n_ * n_, 0.0);
  std::vector<double> parts;
  if (keeps_singular_claim(claim_, B, bases, n_, n_, bound_.enclosure(), parts)) return true;
  // The tube is the same set in parts of the box.
  if (parts.size() < m_) return false;
  parts.resize(m_);
  if (is_moderate(parts)) impact_ = std::move(parts);
  return false;
}

SingularBases BranchSingularValues::bases_of(const Intervals& X) const {
  if (!is_moderate(X)) return {};
  std::vector<double> middle;
  for (const Interval x : X) middle.push_back(mid(x));
  return approx_singular_bases(std::move(middle), n_, n_);
}

BranchSingularValues::Intervals BranchSingularValues::rotated(const Intervals& X,
                                                              const SingularBases& bases) const {
  Intervals result(n_ * n_);
  for (std::size_t e = 0; e < X.size(); ++e)
    add_rotated(result, X[e], bases, e / n_, e % n_, n_, n_);
  return result;
}

/// The slopes by the places and by the distances from the middle of the tube.
RotatedMatrix BranchSingularValues::rotate(const BranchTest& test,
                                           const SingularBases& bases) const {
  RotatedMatrix B;
  for (std::size_t k = 0; k < m_ + n_; ++k) {
    B.slopes.push_back(rotated(
        matrix_of(n_,
                  [&](std::size_t j, std::size_t l) { return test.rate(j, l, k) * factors_[l]; }),
        bases));
    B.variable.push_back(k);
    B.radius.push_back(test.reach(k));
    double width = 0.0;
    for (const Interval x : B.slopes.back()) width = std::max(width, x.hi / 2 - x.lo / 2);
    B.share.push_back(width * B.radius.back());
  }
  return B;
}

bool BranchSingularValues::attains_bound(const BranchTest& test) const {
  std::vector<Ball> X;
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t l = 0; l < n_; ++l) {
      const Interval x = test.derivative(j, l) * factors_[l];
      if (!is_bounded(x)) return false;
      X.emplace_back(x, kBitsOfSingularValues);
    }
  return breaks_singular_claim(claim_, X, n_, n_, bound_, kBitsOfSingularValues);
}

}  // namespace regulus::verifier
