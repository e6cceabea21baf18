// SPDX-License-Identifier: GPL-3.0-or-later
// The determinant of a matrix of polynomials, multiplied out within a budget.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "codegen/kernel/symbolic/polynomial.hpp"

namespace regulus::detail {

/// The determinant has no closed form: it needs more terms than allowed, or the matrix is not
/// square.
class ClosedFormError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Counts the terms of the expansion before like terms are combined: a measure of time and memory
/// that is the same on every machine.
class DeterminantBudget {
 public:
  explicit DeterminantBudget(std::uint64_t most) : most_(most) {}

  /// Call it before the work is done. Throws ClosedFormError if the work would exceed the budget.
  void spend(std::uint64_t terms);

  [[nodiscard]] std::uint64_t spent() const noexcept { return spent_; }

 private:
  std::uint64_t most_;
  std::uint64_t spent_ = 0;
};

/// Returns p with sin²u written as 1 − cos²u, so that terms equal by sin² + cos² = 1 cancel.
[[nodiscard]] Polynomial without_squared_sines(const Polynomial& p, AtomTable& atoms);

/// Returns det A, with sin²u written as 1 − cos²u. Columns are added one by one to the minors of
/// all sets of rows: n·2^(n−1) products of an entry and a minor.
///
/// Shape     entries row-major, n×n, n ≤ 12.
/// Ensures   exact wherever the entries are defined. Throws ClosedFormError.
[[nodiscard]] Polynomial determinant(const std::vector<Polynomial>& entries, int n,
                                     AtomTable& atoms, DeterminantBudget& budget);

}  // namespace regulus::detail
