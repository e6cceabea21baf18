// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/condition_test.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/verifier/extreme_discs.hpp"
#include "runtime/verifier/ratio.hpp"
#include "runtime/verifier/rounding.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfBound = 128;
constexpr long kBitsOfContradiction = 128;

/// Bounds ‖XᵀX − I‖ of a square matrix, row by row.
double defect(const std::vector<double>& X, std::size_t order) {
  double most = 0.0;
  for (std::size_t j = 0; j < order; ++j) {
    double sum = 0.0;
    for (std::size_t l = 0; l < order; ++l) {
      Interval entry = point(j == l ? -1.0 : 0.0);
      for (std::size_t i = 0; i < order; ++i)
        entry = entry + X[i * order + j] * point(X[i * order + l]);
      sum = up(sum + mag(entry));
    }
    most = std::max(most, sum);
  }
  return most;
}

}  // namespace

ConditionTest::ConditionTest(Question& question, const Variety& variety)
    : q_(question),
      variety_(variety),
      m_(question.rows),
      n_(question.columns),
      slopes_(question),
      terms_(question),
      outside_(question, variety),
      defined_(question, join({&question.matrix, &question.defined, &question.motion_defined})),
      at_middle_(question, question.matrix) {
  const auto bound = evaluate(q_.graph, {q_.quantity->bound}, {}, kBitsOfBound);
  if (!bound) throw Unfinished("the bound has no certain value");
  bound_ = (*bound)[0].enclosure();
}

BoxAnswer ConditionTest::decide(const Box& box) {
  impact_.assign(box.size(), 0.0);
  place_middle(variety_, box, middle_);
  if (outside_.covers(box)) return BoxAnswer::kOutside;
  if (!defined_.run(box)) return BoxAnswer::kOpen;
  const bool has_middle = at_middle_.run(middle_.point);
  std::vector<double> A;
  for (const NodeId entry : q_.matrix)
    A.push_back(mid(has_middle ? at_middle_.value(entry) : defined_.value(entry)));
  const SingularBases bases = approx_singular_bases(std::move(A), m_, n_);
  if (bases.U.empty()) return BoxAnswer::kOpen;
  const std::optional<RotatedMatrix> B = rotated(box, bases);
  return B && is_below(*B, ratio_of_rotated(bases)) ? BoxAnswer::kProved : BoxAnswer::kOpen;
}

std::optional<RotatedMatrix> ConditionTest::rotated(const Box& box, const SingularBases& bases) {
  if (auto B = terms_.rotate(box, middle_, bases)) return B;
  if (!slopes_.run(box, middle_)) return std::nullopt;
  return rotate(slopes_, bases, m_, n_);
}

bool ConditionTest::is_below(const RotatedMatrix& B, double ratio) {
  const bool is_finite =
      is_moderate(B.rest) && is_moderate(B.center) &&
      std::all_of(B.slopes.begin(), B.slopes.end(), [](const auto& s) { return is_moderate(s); });
  if (!is_finite || !(ratio > 0.0)) return false;
  ExtremeDiscs discs(B, m_, n_, ratio);
  if (discs.are_apart()) return true;
  const std::vector<double> parts = discs.parts();
  for (std::size_t k = 0; k < parts.size(); ++k) impact_[B.variable[k]] = parts[k];
  return false;
}

/// κ(A) ≤ κ(B)·√((1 + ε)(1 + ε')/((1 − ε)(1 − ε'))). Returns the bound that κ(B) must keep, rounded
/// downward; 0 if there is none.
double ConditionTest::ratio_of_rotated(const SingularBases& bases) const {
  const double left = defect(bases.U, m_), right = defect(bases.V, n_);
  if (!(left < 0.5) || !(right < 0.5) || !(bound_.lo > 0.0)) return 0.0;
  const Interval one = point(1.0);
  const Interval square =
      (one - point(left)) * (one - point(right)) / ((one + point(left)) * (one + point(right)));
  return (point(bound_.lo) * sqrt(square)).lo;
}

bool ConditionTest::exceeds_at(const Box& point) const {
  std::vector<Ball> x;
  for (const Interval coordinate : point) x.emplace_back(coordinate, kBitsOfContradiction);
  const auto A = evaluate(q_.graph, q_.matrix, x, kBitsOfContradiction);
  return A && has_ratio(q_, *A, kBitsOfContradiction);
}

}  // namespace regulus::verifier
