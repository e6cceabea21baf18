// SPDX-License-Identifier: Apache-2.0
#include "runtime/existence/narrowing.hpp"

#include <optional>

namespace regulus::detail {
namespace {

/// Returns the hull of the t in `within` with a·t = s for some a ∈ A, s ∈ S; nullopt: there are none.
std::optional<Interval> quotients(Interval S, Interval A, Interval within) noexcept {
  if (!contains_zero(A)) return intersect(S / A, within);
  if (contains_zero(S)) return within;
  if (certain_negative(S)) S = -S, A = -A;
  // s > 0: with a > 0 is t ≥ s/a, with a < 0 is t ≤ s/a.
  std::optional<Interval> above, below;
  if (A.hi > 0) above = intersect({(Interval(S.lo) / Interval(A.hi)).lo, kInfinity}, within);
  if (A.lo < 0) below = intersect({-kInfinity, (Interval(S.lo) / Interval(A.lo)).hi}, within);
  return above && below ? hull(*above, *below) : above ? above : below;
}

}  // namespace

bool narrow_by_rows(std::span<const Interval> A, std::span<const Interval> b,
                    std::span<const double> c, std::span<Interval> x) noexcept {
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < b.size(); ++i)
    for (std::size_t j = 0; j < n; ++j) {
      Interval rest = b[i];
      for (std::size_t k = 0; k < n; ++k)
        if (k != j) rest += A[i * n + k] * (x[k] - Interval(c[k]));
      const auto step = quotients(-rest, A[i * n + j], x[j] - Interval(c[j]));
      const auto left = step ? intersect(x[j], *step + Interval(c[j])) : std::optional<Interval>();
      if (!left) return false;
      x[j] = *left;
    }
  return true;
}

}  // namespace regulus::detail
