// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/singular_claims.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/singular_bases.hpp"
#include "runtime/verifier/slopes.hpp"

namespace regulus::verifier {
namespace {

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

/// Encloses |Av|² and |v|² of a column v of V.
struct Image {
  Image(const std::vector<Ball>& A, const std::vector<double>& V, std::size_t columns,
        std::size_t column, long bits) {
    for (std::size_t first = 0; first < A.size(); first += columns) {
      Ball sum;
      for (std::size_t j = 0; j < columns; ++j)
        arb_addmul(sum.get(), A[first + j].get(), Ball(point(V[j * columns + column]), bits).get(),
                   bits);
      arb_addmul(image.get(), sum.get(), sum.get(), bits);
    }
    for (std::size_t j = 0; j < columns; ++j) {
      const Ball part(point(V[j * columns + column]), bits);
      arb_addmul(length.get(), part.get(), part.get(), bits);
    }
  }

  Ball image, length;
};

/// Multiplies x by N².
void times_square(Ball& x, const Ball& N, long bits) {
  arb_mul(x.get(), x.get(), N.get(), bits);
  arb_mul(x.get(), x.get(), N.get(), bits);
}

}  // namespace

double bound_of_rotated(SingularClaim claim, const SingularBases& bases, std::size_t rows,
                        std::size_t columns, Interval N) {
  const double left = defect(bases.U, rows), right = defect(bases.V, columns);
  if (!(left < 0.5) || !(right < 0.5) || !(N.lo > 0.0) || !is_bounded(N)) return 0.0;
  const Interval one = point(1.0);
  const Interval below = (one - point(left)) * (one - point(right)),
                 above = (one + point(left)) * (one + point(right));
  if (claim == SingularClaim::kRatioBelow) return (point(N.lo) * sqrt(below / above)).lo;
  return claim == SingularClaim::kLargestBelow ? (point(N.lo) * sqrt(below)).lo
                                               : (point(N.hi) * sqrt(above)).hi;
}

bool keeps_singular_claim(SingularClaim claim, const RotatedMatrix& B, const SingularBases& bases,
                          std::size_t rows, std::size_t columns, Interval N,
                          std::vector<double>& parts) {
  parts.clear();
  const bool is_finite =
      is_moderate(B.rest) && is_moderate(B.center) &&
      std::all_of(B.slopes.begin(), B.slopes.end(), [](const auto& s) { return is_moderate(s); });
  const double bound = bound_of_rotated(claim, bases, rows, columns, N);
  if (!is_finite || !(bound > 0.0) || !(bound < kInfinity)) return false;
  ExtremeDiscs discs(B, rows, columns, claim, bound);
  if (discs.keep_claim()) return true;
  parts = discs.parts();
  return false;
}

bool breaks_singular_claim(SingularClaim claim, const std::vector<Ball>& A, std::size_t rows,
                           std::size_t columns, const Ball& N, long bits) {
  std::vector<double> middle;
  for (const Ball& entry : A) middle.push_back(mid(entry.enclosure()));
  const std::vector<double> V = approx_singular_bases(std::move(middle), rows, columns).V;
  if (V.empty() || arb_is_positive(N.get()) == 0) return false;
  Image high(A, V, columns, 0, bits), low(A, V, columns, columns - 1, bits);
  if (claim == SingularClaim::kLargestBelow) {  // |Au|² ≥ N²|u|²
    times_square(high.length, N, bits);
    return arb_is_positive(high.length.get()) != 0 &&
           arb_ge(high.image.get(), high.length.get()) != 0;
  }
  if (claim == SingularClaim::kLeastAbove) {  // |Av|² ≤ N²|v|²
    times_square(low.length, N, bits);
    return arb_is_positive(low.length.get()) != 0 && arb_le(low.image.get(), low.length.get()) != 0;
  }
  // Each matrix but 0 has a ratio of at least 1, also where all vectors have the same.
  if (arb_le(N.get(), Ball(point(1.0), bits).get()) != 0)
    return arb_is_positive(high.image.get()) != 0;
  // |Au|²|v|² ≥ N²|Av|²|u|²
  arb_mul(high.image.get(), high.image.get(), low.length.get(), bits);
  arb_mul(low.image.get(), low.image.get(), high.length.get(), bits);
  times_square(low.image, N, bits);
  return arb_is_positive(low.length.get()) != 0 && arb_ge(high.image.get(), low.image.get()) != 0;
}

bool has_ratio(const Question& q, const std::vector<Ball>& A, long bits) {
  const auto bound = evaluate(q.graph, {q.quantity->bound}, {}, bits);
  return bound &&
         breaks_singular_claim(SingularClaim::kRatioBelow, A, q.rows, q.columns, (*bound)[0], bits);
}

}  // namespace regulus::verifier
