// SPDX-License-Identifier: GPL-3.0-or-later
// Ranges of polynomials over eight boxes in plain doubles, to compare forms of a matrix before one
// of them is chosen. These ranges are not bounds, and no verdict depends on them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/interval_arithmetic.hpp"
#include "codegen/kernel/symbolic/polynomial.hpp"
#include "runtime/interval/interval.hpp"
#include "runtime/regularity/lanes.hpp"

namespace regulus::detail {

/// One value for each of eight boxes.
using LaneValues = std::array<double, kLanes>;

/// The ends are NaN in the lanes of boxes over which something is not defined.
struct ApproxRange {
  LaneValues lo{}, hi{};
};

/// Ranges by the number of the atom.
using ApproxRanges = std::vector<ApproxRange>;
using ApproxValues = std::vector<std::optional<double>>;

/// The variable atoms of a table as functions of the variables.
class AtomRanges {
 public:
  /// Uses the atoms that `atoms` has at this time.
  AtomRanges(const AtomTable& atoms, const std::vector<std::string>& variables);

  /// Shape  boxes[variable][lane].
  [[nodiscard]] ApproxRanges over(const std::vector<std::vector<Interval>>& boxes);

 private:
  std::size_t atoms_;
  IntervalArithmetic arithmetic_;
  std::vector<Program> programs_;  // one for each atom, so that each is undefined separately
  std::vector<KnownValues<Interval>> known_;
  std::vector<Interval> values_;
};

/// Returns the values of π, √3, … among the coefficient atoms; the first `points`, K's entries,
/// have none.
[[nodiscard]] ApproxValues approx_coefficient_values(const AtomTable& atoms, std::size_t points);

/// A polynomial in nested form, linear in the entries of one row of K or free of them.
class NestedRange {
 public:
  /// `fixed` has values for variable atoms, `coefficients` for coefficient atoms. A coefficient
  /// atom without a value is the entry of K's row with its number.
  NestedRange(const Polynomial& p, const AtomTable& atoms, const ApproxValues& fixed,
              const ApproxValues& coefficients);

  /// `row_of_K` may be null if the polynomial is free of K.
  [[nodiscard]] ApproxRange over(const ApproxRanges& atoms, const LaneValues* row_of_K) const;

 private:
  static constexpr std::size_t kNoPoint = static_cast<std::size_t>(-1);
  struct Constant {
    std::size_t point;  // or kNoPoint
    double factor;
  };
  struct Term {
    AtomProduct atoms;
    std::vector<Constant> coefficient;
  };
  using Terms = std::vector<Term>;
  /// Σ of `terms` or, if `inner` is set, atom^exponent·inner + rest.
  struct Form {
    Terms terms;
    Atom atom = 0;
    int exponent = 0;
    std::size_t inner = 0, rest = 0;  // indices of forms; 0 is none
  };

  static Terms terms_of(const Polynomial& p, const ApproxValues& fixed,
                        const ApproxValues& coefficients);
  std::size_t add_form(Terms terms, const AtomTable& atoms);
  [[nodiscard]] ApproxRange over(std::size_t form, const ApproxRanges& atoms,
                                 const LaneValues* row_of_K) const;

  std::vector<Form> forms_;
};

}  // namespace regulus::detail
