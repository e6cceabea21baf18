// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/rotated_terms.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/verifier/derivative.hpp"
#include "runtime/verifier/rounding.hpp"

namespace regulus::verifier {
namespace {

using Intervals = std::vector<Interval>;

constexpr std::size_t kMostExpandedVariables = 12;
constexpr std::size_t kMostDerivatives = 1 << 15;

std::vector<std::size_t> variables_of(const Question& q) {
  const Dependence dependence(q.graph, q.variables.size());
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < q.variables.size(); ++k)
    if (std::any_of(q.matrix.begin(), q.matrix.end(),
                    [&](NodeId entry) { return dependence.on(entry, k); }))
      result.push_back(k);
  return result;
}

/// A value as a double and a bound of what is beside it, roundings of its products included.
struct Spread {
  explicit Spread(Interval value)
      : middle(mid(value)), radius(radius_ru(value, middle) + kRounding * std::fabs(middle)) {}
  double middle, radius;
};

}  // namespace

void add_rotated(Intervals& sum, Interval x, const SingularBases& bases, std::size_t i,
                 std::size_t j, std::size_t rows, std::size_t columns) {
  if (is_zero(x)) return;
  for (std::size_t b = 0; b < columns; ++b) {
    const Interval right = bases.V[j * columns + b] * x;
    for (std::size_t a = 0; a < rows; ++a) {
      Interval& entry = sum[a * columns + b];
      entry = entry + bases.U[i * rows + a] * right;
    }
  }
}

RotatedMatrix rotate(const MatrixSlopes& slopes, const SingularBases& bases, std::size_t rows,
                     std::size_t columns) {
  RotatedMatrix result;
  const std::size_t size = rows * columns;
  result.center.resize(size);
  result.rest.assign(size, 0.0);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      add_rotated(result.center, slopes.entry(i, j), bases, i, j, rows, columns);
  for (std::size_t s = 0; s < slopes.of().size(); ++s) {
    Intervals& slope = result.slopes.emplace_back(size);
    const auto& entries = slopes.of()[s].entries;
    for (std::size_t e = 0; e < entries.size(); ++e)
      add_rotated(slope, slopes.slope(s, e), bases, entries[e].row, entries[e].column, rows,
                  columns);
    result.variable.push_back(slopes.of()[s].variable);
    result.radius.push_back(slopes.radius(s));
    double width = 0.0;
    for (const Interval x : slope) width = std::max(width, x.hi / 2 - x.lo / 2);
    result.share.push_back(width * slopes.radius(s));
  }
  return result;
}

RotatedTerms::RotatedTerms(Question& question)
    : q_(question), m_(question.rows), n_(question.columns), variables_(variables_of(question)) {
  if (variables_.size() <= kMostExpandedVariables) differentiate(question);
}

void RotatedTerms::differentiate(Question& question) {
  std::vector<Differentiator> by;
  for (const std::size_t p : variables_) by.emplace_back(question.graph, p);
  std::vector<NodeId> middle, over;
  const auto derivatives_of = [&](NodeId node) {
    Derivatives d{node, {}, {}};
    for (std::size_t p = 0; p < variables_.size(); ++p) {
      d.first.push_back(by[p].of(node));
      for (std::size_t q = 0; q <= p; ++q)
        d.second.push_back(d.first[p] == kNoNode ? kNoNode : by[q].of(d.first[p]));
    }
    middle.push_back(d.itself);
    middle.insert(middle.end(), d.first.begin(), d.first.end());
    over.insert(over.end(), d.second.begin(), d.second.end());
    return d;
  };
  const QuantityLines& quantity = *q_.quantity;
  for (Term& term : expand(question.graph, quantity.unscaled, variables_, q_.variables.size())) {
    for (const Coefficient& c : term.coefficients) middle.push_back(c.node);
    terms_.push_back({std::move(term.coefficients), derivatives_of(term.monomial)});
    const std::size_t pairs = terms_.back().monomial.second.size();
    if (terms_.size() > kMostTerms || terms_.size() * pairs > kMostDerivatives) return;
  }
  for (const NodeId s : quantity.row_scales) {
    scales_.push_back(derivatives_of(s));
    over.push_back(s);
    over.insert(over.end(), scales_.back().first.begin(), scales_.back().first.end());
  }
  at_middle_.emplace(q_, middle);
  over_box_.emplace(q_, over);
  first_.resize(variables_.size());
}

std::optional<RotatedMatrix> RotatedTerms::rotate(const Box& box, const Middle& middle,
                                                  const SingularBases& bases) {
  RotatedMatrix result;
  for (const std::size_t p : variables_) result.radius.push_back(middle.radius[p]);
  const bool is_known = at_middle_ && at_middle_->run(middle.point) && over_box_->run(box) &&
                        is_moderate(result.radius) && rotate_coefficients(bases) &&
                        find_rows(result.radius);
  if (!is_known) return std::nullopt;
  result.variable = variables_;
  Intervals rows(m_ * n_);
  for (std::size_t e = 0; e < rows.size(); ++e)
    rows[e] = scale(*at_middle_, e / n_) * middle_.at(e);
  result.center = combine(bases, rows);
  for (std::size_t p = 0; p < variables_.size(); ++p) {
    for (std::size_t e = 0; e < rows.size(); ++e)
      rows[e] = scale(*at_middle_, e / n_, &Derivatives::first, p) * middle_.at(e) +
                scale(*at_middle_, e / n_) * first_[p].at(e);
    result.slopes.push_back(combine(bases, rows));
  }
  add_pairs(bases, result);
  return result;
}

Interval RotatedTerms::RoundEntries::at(std::size_t e) const {
  return {down(middle[e] - radius[e]), up(middle[e] + radius[e])};
}

bool RotatedTerms::rotate_coefficients(const SingularBases& bases) {
  for (ConstantTerm& t : terms_) {
    t.rotated.assign(m_ * n_, 0.0);
    t.unsure.assign(m_ * n_, 0.0);
    for (const Coefficient& c : t.coefficients) {
      const Interval value = at_middle_->value(c.node);
      if (mag(value) > kLargest) return false;
      const Spread x(value);
      const std::size_t row = c.entry / n_ * n_;
      for (std::size_t b = 0; b < n_; ++b) {
        const double right = bases.V[c.entry % n_ * n_ + b];
        t.rotated[row + b] += right * x.middle;
        t.unsure[row + b] += std::fabs(right) * x.radius;
      }
    }
  }
  return true;
}

/// Encloses Σ_μ C_μV·node(μ).
template <class NodeOf>
bool RotatedTerms::total(const Evaluation& values, const NodeOf& node, RoundEntries& sum) const {
  sum.middle.assign(m_ * n_, 0.0);
  sum.radius.assign(m_ * n_, 0.0);
  for (const ConstantTerm& t : terms_) {
    const Interval value = values.value(node(t.monomial));
    if (is_zero(value)) continue;
    if (mag(value) > kLargest) return false;
    const Spread x(value);
    const double size = std::fabs(x.middle) + x.radius;
    for (std::size_t e = 0; e < m_ * n_; ++e) {
      sum.middle[e] += t.rotated[e] * x.middle;
      sum.radius[e] += std::fabs(t.rotated[e]) * x.radius + t.unsure[e] * size;
    }
  }
  for (double& radius : sum.radius) radius = inflate(radius);
  return true;
}

/// ∂²_pqa over the box gives ∂_pa over the box, and this gives a, by the mean value theorem.
bool RotatedTerms::find_rows(const std::vector<double>& radius) {
  const std::size_t count = variables_.size();
  if (!total(
          *at_middle_, [](const Derivatives& d) { return d.itself; }, middle_))
    return false;
  second_.assign(count * (count + 1) / 2, Intervals(m_ * n_));
  slope_.assign(count, Intervals(m_ * n_));
  for (std::size_t p = 0; p < count; ++p) {
    if (!total(
            *at_middle_, [p](const Derivatives& d) { return d.first[p]; }, first_[p]))
      return false;
    for (std::size_t e = 0; e < m_ * n_; ++e) slope_[p][e] = first_[p].at(e);
  }
  RoundEntries sum;
  for (std::size_t p = 0, pair = 0; p < count; ++p)
    for (std::size_t q = 0; q <= p; ++q, ++pair) {
      if (!total(
              *over_box_, [pair](const Derivatives& d) { return d.second[pair]; }, sum))
        return false;
      for (std::size_t e = 0; e < m_ * n_; ++e) {
        const Interval x = second_[pair][e] = sum.at(e);
        slope_[p][e] = slope_[p][e] + x * Interval{-radius[q], radius[q]};
        if (p != q) slope_[q][e] = slope_[q][e] + x * Interval{-radius[p], radius[p]};
      }
    }
  over_.resize(m_ * n_);
  for (std::size_t e = 0; e < m_ * n_; ++e) {
    over_[e] = middle_.at(e);
    for (std::size_t p = 0; p < count; ++p)
      over_[e] = over_[e] + slope_[p][e] * Interval{-radius[p], radius[p]};
  }
  return true;
}

/// Returns Uᵀ·rows.
Intervals RotatedTerms::combine(const SingularBases& bases, const Intervals& rows) const {
  Intervals result(m_ * n_);
  for (std::size_t i = 0; i < m_; ++i)
    for (std::size_t a = 0; a < m_; ++a)
      for (std::size_t b = 0; b < n_; ++b)
        result[a * n_ + b] = result[a * n_ + b] + bases.U[i * m_ + a] * rows[i * n_ + b];
  return result;
}

/// Bounds Σ_p<q r_pr_q|∂²_pqB| + ½Σ_p r_p²|∂²_ppB| over the box, where
/// ∂²_pq(sa) = s_pq·a + s_p·a_q + s_q·a_p + s·a_pq.
void RotatedTerms::add_pairs(const SingularBases& bases, RotatedMatrix& result) const {
  result.rest.assign(m_ * n_, 0.0);
  result.share.assign(variables_.size(), 0.0);
  Intervals rows(m_ * n_);
  for (std::size_t p = 0, pair = 0; p < variables_.size(); ++p)
    for (std::size_t q = 0; q <= p; ++q, ++pair) {
      const double weight = up(up(result.radius[p] * result.radius[q]) * (p == q ? 0.5 : 1.0));
      for (std::size_t e = 0; e < rows.size(); ++e) {
        const std::size_t i = e / n_;
        rows[e] = scale(*over_box_, i) * second_[pair][e] +
                  scale(*over_box_, i, &Derivatives::second, pair) * over_[e] +
                  scale(*over_box_, i, &Derivatives::first, p) * slope_[q][e] +
                  scale(*over_box_, i, &Derivatives::first, q) * slope_[p][e];
      }
      double largest = 0.0;
      const Intervals pair_of_B = combine(bases, rows);
      for (std::size_t e = 0; e < rows.size(); ++e) {
        const double part = up(mag(pair_of_B[e]) * weight);
        result.rest[e] = up(result.rest[e] + part);
        largest = std::max(largest, part);
      }
      result.share[p] += largest, result.share[q] += largest;
    }
}

}  // namespace regulus::verifier
