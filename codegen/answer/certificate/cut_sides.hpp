// SPDX-License-Identifier: GPL-3.0-or-later
// A matrix with atan2 on a set that meets its cut, by the sides of the cut.
//
// atan2(Y, X) jumps where Y = 0 and X < 0, and is undefined there. Where s·Y ≥ 0, for s = 1 or −1,
//
//   atan2(Y, X) = s·(π/2 + atan2(−X, s·Y))
//
// off the cut, and the right-hand side is smooth but at the origin: on the cut it is the limit s·π.
// So the set is the union of the sets of 2ⁿ questions, one for each choice of the signs of n
// ordinates, whose matrices have no jump. If all of these are regular, so is the matrix at every pose
// off the cuts, and with either limit on them.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "codegen/answer/certificate/certificate_question.hpp"

namespace regulus::detail {

class CutSides {
 public:
  static constexpr std::size_t kMostSigns = 4;

  /// Finds the ordinates Y of the matrix and its scales whose sign is that of a commanded pose:
  /// without errors, tolerances and other atan2. The others keep their cuts.
  explicit CutSides(const Request& request);

  /// True if there is nothing to choose, or there are too many choices.
  [[nodiscard]] bool is_empty() const noexcept {
    return signs_.empty() || signs_.size() > kMostSigns;
  }
  [[nodiscard]] std::size_t count() const noexcept { return std::size_t{1} << signs_.size(); }
  /// Returns the question on some sides, with the constraints −s·Y ≤ 0.
  [[nodiscard]] Request on_sides(std::size_t number) const;
  /// Returns the question about all sides: a piece for each (FORMAT.md, `piecewise`).
  [[nodiscard]] CertifiedQuestion on_all_sides(const std::set<std::string>& uncertain) const;
  /// Returns the sentence for reports.
  [[nodiscard]] std::string note() const;

 private:
  struct Sign {
    GiNaC::ex ordinate;
    GiNaC::realsymbol symbol;
  };
  [[nodiscard]] static int sign(std::size_t number, std::size_t i) noexcept {
    return (number >> i & 1) == 0 ? 1 : -1;
  }
  /// Returns the matrix with these signs, without the constraints.
  [[nodiscard]] Request with_signs(const std::vector<GiNaC::ex>& signs) const;

  const Request& request_;
  std::vector<Sign> signs_;
};

}  // namespace regulus::detail
