// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/rational_in.hpp"

#include <utility>

namespace regulus::verifier {

std::optional<Rational> rational_in(const Ball& ball) {
  constexpr long kBits = 512;
  constexpr int kMostTerms = 60;
  Ball rest = ball;
  Rational before(0), value(1), denominator_before(1), denominator(0);
  for (int term = 0; term < kMostTerms; ++term) {
    if (arb_is_finite(rest.get()) == 0 || arf_cmpabs_2exp_si(arb_midref(rest.get()), kBits) > 0)
      return std::nullopt;
    fmpz_t nearest;
    fmpz_init(nearest);
    arf_get_fmpz(nearest, arb_midref(rest.get()), ARF_RND_NEAR);
    Rational a;
    fmpz_set(fmpq_numref(a.get()), nearest);
    fmpz_clear(nearest);
    before = std::exchange(value, a * value + before);
    denominator_before = std::exchange(denominator, a * denominator + denominator_before);
    const Rational found = value / denominator;
    if (arb_contains_fmpq(ball.get(), found.get()) != 0) return found;
    arb_sub_fmpz(rest.get(), rest.get(), fmpq_numref(a.get()), kBits);
    arb_inv(rest.get(), rest.get(), kBits);
  }
  return std::nullopt;
}

}  // namespace regulus::verifier
