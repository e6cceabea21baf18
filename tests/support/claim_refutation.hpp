// SPDX-License-Identifier: GPL-3.0-or-later
// Looks for a proof that the claim NO SINGULARITY of a certificate is false, by sampling in Arb.
#pragma once

#include <sstream>
#include <string>

#include "runtime/verifier/leaf.hpp"
#include "runtime/verifier/proof.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

/// Evaluates corners, the middle and random points of the variety. It looks for determinants of
/// different signs (in a variety without constraints, which is convex), for one of at most alpha,
/// and for undefined points. It skips matrices that are not square.
class ClaimRefutation {
 public:
  ClaimRefutation(const std::string& certificate, RandomSource& random) : random_(random) {
    std::istringstream stream(certificate);
    verifier::Lines lines(stream);
    verifier::read_question(lines, question_);
    variety_ = verifier::enclose_variety(question_);
    for (int sample = 0; sample < kSamples && found_.empty(); ++sample) look(sample);
  }

  /// Returns a reason; empty if none was found.
  [[nodiscard]] const std::string& found() const { return found_; }

 private:
  static constexpr int kSamples = 300;
  static constexpr long kBits = 256;

  void look(int sample) {
    if (question_.rows != question_.columns) return;
    const verifier::Box point = pick(sample);
    if (!verifier::certain_inside(question_, variety_, point)) return;
    const auto values = verifier::values_over(question_, point, kBits);
    if (!values) {
      if (question_.constraints.empty()) found_ = "not defined at a point";
      return;
    }
    for (const verifier::Ball& h : values->constraints)
      if (arb_is_nonpositive(h.get()) == 0) return;
    const verifier::Interval det = values->determinant.enclosure();
    if (verifier::mag(det) <= variety_.alpha.lo) found_ = "a determinant of at most alpha";
    const int sign = det.lo > 0 ? 1 : det.hi < 0 ? -1 : 0;
    if (question_.constraints.empty() && sign * sign_ < 0) found_ = "opposite signs";
    if (sign != 0) sign_ = sign;
  }

  verifier::Box pick(int sample) {
    verifier::Box point = variety_.outer;
    for (std::size_t k = 0; k < point.size(); ++k) {
      if (!variety_.inner[k]) continue;
      const verifier::Interval inner = *variety_.inner[k];
      const double part = sample == 0         ? 0.5
                          : random_.one_in(2) ? double(random_.below(2))
                                              : random_.unit();
      point[k] =
          verifier::point(std::clamp(inner.lo + part * (inner.hi - inner.lo), inner.lo, inner.hi));
    }
    return point;
  }

  RandomSource& random_;
  verifier::Question question_;
  verifier::Variety variety_;
  std::string found_;
  int sign_ = 0;
};

}  // namespace regulus::detail::test
