// SPDX-License-Identifier: Apache-2.0
// Error: a bound of a minor of order k is a sum of products, each of an entry's bound and a minor's
// bound, of which min and max choose one. These change by no more than what they choose among, so
// by induction the computed bound differs from that of exact interval arithmetic by less than
// ((1+u)^t − 1)·perm|A|, t = k(k+1)/2 roundings on the longest way (one product and k − 1 additions
// a level) and u = 2^-52 (any rounding mode), apart from underflows: at most n·2^n·4 products lose
// at most 2^-1074 each, which is multiplied on by entries of the remaining rows; with M the largest
// magnitude, at least 1, that is below n·2^n·4·2^-1074·n!·M^n ≤ 2^-1040·M^n for n ≤ 8. An overflow
// makes the permanent infinite or NaN, whose factor exceeds (1+u)^t at each level: no bound then.
#include "runtime/regularity/minors.hpp"

#include <algorithm>
#include <array>

#include "runtime/interval/interval.hpp"
#include "runtime/regularity/backend.hpp"
#include "runtime/regularity/minors_error.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kMaxEntries = kMaxEightMinors * kMaxEightMinors;

struct alignas(64) Workspace {
  double matrix[2 * kMaxEntries * kLanes];
  double magnitude[kMaxEntries * kLanes];
  double bounds[2 * kLanes];
  LaneNumbers permanent;
};

using Order = std::array<unsigned char, kMaxEightMinors>;

/// Orders rows, or columns, from the widest to the narrowest. A choice, not a bound.
Order by_width(ConstIntervalMatrix matrix, std::size_t lane, bool rows) noexcept {
  const std::size_t n = matrix.rows();
  double width[kMaxEightMinors] = {};
  for (std::size_t e = 0; e < n * n; ++e)
    width[rows ? e / n : e % n] += matrix.upper(e, lane) - matrix.lower(e, lane);
  Order order;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t at = k;
    for (; at > 0 && width[order[at - 1]] < width[k]; --at) order[at] = order[at - 1];
    order[at] = static_cast<unsigned char>(k);
  }
  return order;
}

bool is_odd(const Order& order, std::size_t n) noexcept {
  bool odd = false;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k) odd ^= order[i] > order[k];
  return odd;
}

/// Copies a lane with its rows in the order of their widths, or with its columns as rows.
bool arrange(ConstIntervalMatrix matrix, std::size_t lane, bool rows, Workspace& work) noexcept {
  const std::size_t n = matrix.rows();
  const Order order = by_width(matrix, lane, rows);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t e = rows ? order[i] * n + j : j * n + order[i];
      work.matrix[lower_at(i * n + j, lane)] = matrix.lower(e, lane);
      work.matrix[upper_at(i * n + j, lane)] = matrix.upper(e, lane);
    }
  return is_odd(order, n);
}

void expand(ConstIntervalMatrix matrix, bool rows, const LaneNumbers& error, Workspace& work,
            LaneIntervals& determinants) noexcept {
  const std::size_t n = matrix.rows();
  bool odd[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) odd[lane] = arrange(matrix, lane, rows, work);
  regularity_backend().expand(ConstIntervalMatrix(work.matrix, n, n),
                              IntervalVector(work.bounds, 1));
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (!(error[lane] < kInfinity)) continue;
    const Interval value(sub_rd(work.bounds[lane], error[lane]),
                         add_ru(work.bounds[kLanes + lane], error[lane]));
    // Both enclose all determinants, so their intersection is not empty.
    determinants[lane] =
        intersect(determinants[lane], odd[lane] ? -value : value).value_or(kEntire);
  }
}

LaneNumbers errors_ru(ConstIntervalMatrix matrix, Workspace& work) noexcept {
  const std::size_t n = matrix.rows();
  for (std::size_t e = 0; e < n * n; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      work.magnitude[point_at(e, lane)] =
          magnitude_of(matrix.lower(e, lane), matrix.upper(e, lane));
  const ConstPointMatrix magnitude(work.magnitude, n, n);
  regularity_backend().permanent(magnitude, raise_factor(n), work.permanent);
  LaneNumbers error;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    error[lane] = minors_error_ru(magnitude, lane, work.permanent[lane], n * (n + 1) / 2);
  return error;
}

}  // namespace

LaneIntervals enclose_determinants(ConstIntervalMatrix matrix) noexcept {
  LaneIntervals determinants;
  for (Interval& value : determinants.of) value = kEntire;
  if (matrix.rows() <= kMaxEightMinors) {
    Workspace work;
    const LaneNumbers error = errors_ru(matrix, work);
    expand(matrix, true, error, work, determinants);
    expand(matrix, false, error, work, determinants);
  }
  return determinants;
}

}  // namespace regulus::detail
