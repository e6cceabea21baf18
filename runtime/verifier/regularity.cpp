// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/regularity.hpp"

#include <algorithm>

#include "runtime/verifier/derivative.hpp"
#include "runtime/verifier/elementary.hpp"
#include "runtime/verifier/rounding.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfMatrix = 64;

/// If their part is below this, the ranges of moving variables do not keep the box open.
constexpr double kNoImpact = 0.02;

/// Returns the motion parameters, even if they touch only one row, because they are split; and all
/// other variables that touch several rows.
std::vector<std::size_t> moving_variables(Question& q) {
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < q.variables.size(); ++k) {
    Differentiator by(q.graph, k);
    std::size_t touched = 0;
    for (std::size_t row = 0; row < q.rows; ++row) {
      const auto first = q.matrix.begin() + std::ptrdiff_t(row * q.columns);
      touched += std::any_of(first, first + std::ptrdiff_t(q.columns),
                             [&](NodeId entry) { return by.of(entry) != kNoNode; });
    }
    if (touched > 1 || (touched == 1 && q.variables[k].kind == VariableKind::kParameter))
      result.push_back(k);
  }
  return result;
}

/// Returns S that makes the entries of S⁻¹XS similar: √(right/left Perron vector of X), roughly.
std::vector<double> balance(const Matrix& X, std::size_t n) {
  std::vector<double> right(n, 1.0), left(n, 1.0), result;
  for (int step = 0; step < 10; ++step) {
    std::vector<double> to_right(n, 1e-300), to_left(n, 1e-300);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        to_right[i] += X[j * n + i] * right[j];
        to_left[j] += X[j * n + i] * left[i];
      }
    right = to_right;
    left = to_left;
  }
  for (std::size_t i = 0; i < n; ++i)
    result.push_back(std::clamp(std::sqrt(right[i] / left[i]), 1e-100, 1e100));
  return result;
}

}  // namespace

RegularityTest::RegularityTest(Question& q, const Variety& variety)
    : q_(q),
      variety_(variety),
      inverse_(q, moving_variables(q)),
      rows_(q, variety, inverse_.moving()),
      over_box_(q, join({&q.matrix, &q.defined, &q.motion_defined, &q.scale})),
      outside_(q, variety),
      of_motion_(q.columns),
      of_rows_(rows_.order()) {}

RegularityTest::Answer RegularityTest::decide(const Box& box) {
  stage_ = Stage::kNothing;
  is_defined_ = false;
  place_middle(box);
  if (outside_.covers(box)) return Answer::kOutside;
  is_defined_ = over_box_.run(box);
  if (!is_defined_ || !is_moderate(middle_.radius)) return Answer::kOpen;
  if (!inverse_.run(thin_, middle_.point, middle_.radius))
    return is_regular_without_derivatives() ? Answer::kRegular : Answer::kOpen;
  stage_ = Stage::kMotion;
  if (!of_motion_.find(inverse_.P()) ||
      !rows_.run(box, middle_.point, middle_.radius, inverse_, of_motion_))
    return Answer::kOpen;
  stage_ = Stage::kRows;
  return is_regular() ? Answer::kRegular : Answer::kOpen;
}

bool RegularityTest::is_regular() {
  if (of_rows_.find(rows_.T())) return !q_.has_threshold || exceeds_threshold();
  return !q_.has_threshold && rows_.has_no_null_vector(of_rows_.v());
}

/// PROOF.md, "The test", 7: at a kink or at the end of a domain there may be no derivatives.
bool RegularityTest::is_regular_without_derivatives() {
  const std::size_t n = q_.columns;
  std::vector<double> A;
  for (const NodeId entry : q_.matrix) A.push_back(mid(over_box_.value(entry)));
  if (!is_moderate(A) || !approx_left_inverse(A, q_.rows, n, K_) || !is_moderate(K_)) return false;
  P_.assign(n * n, 0.0);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      double sum = i == j ? -1.0 : 0.0, unsure = i == j ? kRounding : 0.0;
      for (std::size_t row = 0; row < q_.rows; ++row) {
        const std::size_t e = row * n + j;
        const double spread = radius_ru(over_box_.value(q_.matrix[e]), A[e]);
        sum += K_[row * n + i] * A[e];
        unsure += std::fabs(K_[row * n + i]) * (spread + kRounding * std::fabs(A[e]));
      }
      P_[j * n + i] = inflate(std::fabs(sum) + unsure);
    }
  if (!is_moderate(P_) || !of_motion_.find(P_)) return false;
  return !q_.has_threshold ||
         exceeds_threshold(of_motion_.determinant(), determinant(K_, n, kBitsOfMatrix).enclosure());
}

void RegularityTest::place_middle(const Box& box) {
  verifier::place_middle(variety_, box, middle_);
  thin_ = middle_.point;
  for (const std::size_t p : inverse_.moving()) thin_[p] = box[p];
}

/// Shows that |det J⁻¹| ≥ det(I − P)·det(I − T)·∏|scale|/|det K(t)| > α.
bool RegularityTest::exceeds_threshold() const {
  Interval bound = of_motion_.determinant();
  if (rows_.order() > 0) bound = bound * of_rows_.determinant();
  return bound.lo > 0.0 && exceeds_threshold(bound, determinant_of_K());
}

/// `bound`: a bound of |det KA|.
bool RegularityTest::exceeds_threshold(Interval bound, Interval determinant_of_K) const {
  if (!(bound.lo > 0.0)) return false;
  for (const NodeId scale : q_.scale) bound = bound * point(mig(over_box_.value(scale)));
  bound = bound / point(mag(determinant_of_K));
  return is_bounded(bound) && bound.lo > variety_.alpha.hi;
}

/// Uses |det K(t)| ≤ |det K|·exp(Σ r_p|tr D_p| + f²/(2 − 2f)), if the Frobenius norm f of S⁻¹XS is
/// less than 1, for any positive diagonal S.
Interval RegularityTest::determinant_of_K() const {
  const std::size_t n = q_.columns;
  const std::vector<double> S = balance(inverse_.X(), n);
  Interval norm, exponent;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      norm = norm + square(point(inverse_.X()[j * n + i]) * point(S[j]) / point(S[i]));
  const double f = sqrt(norm).hi;
  if (!(f < 1.0)) return everything();
  for (std::size_t p = 0; p < inverse_.moving().size(); ++p) {
    Interval trace;
    for (std::size_t i = 0; i < n; ++i) trace = trace + point(inverse_.D(p)[i * n + i]);
    exponent = exponent + point(middle_.radius[inverse_.moving()[p]]) * point(mag(trace));
  }
  exponent = exponent + square(point(f)) / (2.0 * (point(1.0) - point(f)));
  return determinant(inverse_.K(), n, kBitsOfMatrix).enclosure() * apply(Op::kExp, exponent);
}

/// Returns, roughly, how much each variable keeps P, or T, from being dominated. If only the
/// threshold is not reached, the influence on the determinant counts.
std::vector<double> RegularityTest::impacts() const {
  std::vector<double> impact(q_.variables.size(), 0.0);
  if (stage_ == Stage::kNothing) return impact;
  const std::size_t n = q_.columns;
  const bool is_regular = stage_ == Stage::kRows && of_rows_.holds();
  const std::vector<double>& v = of_motion_.v();
  for (std::size_t p = 0; p < inverse_.moving().size(); ++p)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t e = j * n + i, k = inverse_.moving()[p];
        impact[k] +=
            (is_regular ? middle_.radius[k] * std::fabs(inverse_.D(p)[e]) : inverse_.share(p)[e]) *
            v[j] / v[i];
      }
  if (stage_ == Stage::kRows) rows_.add_impacts(of_rows_.v(), impact);
  double of_moving = 0.0;
  for (const std::size_t k : inverse_.moving()) of_moving += impact[k];
  if (is_regular || of_moving < kNoImpact) return impact;
  std::vector<double> moving_only(impact.size(), 0.0);
  for (const std::size_t k : inverse_.moving()) moving_only[k] = impact[k];
  return moving_only;
}

std::optional<std::size_t> RegularityTest::variable_to_split(const Box& box) const {
  return variable_of_impact(variety_, box, impacts());
}

int RegularityTest::sign_at_middle() const {
  if (stage_ == Stage::kNothing || q_.rows != q_.columns) return 0;
  // If |K·A − I| < 1 in the column-sum norm, regular matrices join K·A to I: det K·A > 0.
  const std::size_t n = q_.columns;
  for (std::size_t j = 0; j < n; ++j) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum = up(sum + inverse_.e()[j * n + i]);
    if (!(sum < 1.0)) return 0;
  }
  const Ball det = determinant(inverse_.K(), n, 128);
  return arb_is_positive(det.get()) ? 1 : arb_is_negative(det.get()) ? -1 : 0;
}

}  // namespace regulus::verifier
