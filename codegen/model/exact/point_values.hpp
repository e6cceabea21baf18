// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions at one point, to nearest: for planning and for reports, never for a proof.
#pragma once

#include <ginac/ginac.h>

#include <unordered_map>

namespace regulus::detail {

/// Values of many expressions at one point. A part that they share is evaluated once.
class PointValues {
 public:
  /// `numbers`: of symbols.
  explicit PointValues(const GiNaC::exmap& numbers);

  /// Returns NaN where the value is no real number or a symbol has none, and what `double` gives at a pole.
  [[nodiscard]] double of(const GiNaC::ex& expression);

 private:
  struct Hash {
    std::size_t operator()(const GiNaC::ex& e) const { return e.gethash(); }
  };
  struct Equal {
    bool operator()(const GiNaC::ex& a, const GiNaC::ex& b) const { return a.is_equal(b); }
  };

  [[nodiscard]] double form(const GiNaC::ex& e);
  [[nodiscard]] double call(const GiNaC::function& f);

  std::unordered_map<GiNaC::ex, double, Hash, Equal> values_;
};

/// Returns the number of an expression without symbols; NaN as above.
[[nodiscard]] double approx_number(const GiNaC::ex& constant);

}  // namespace regulus::detail
