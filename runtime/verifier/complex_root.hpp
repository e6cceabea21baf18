// SPDX-License-Identifier: Apache-2.0
// Exactly one root of an analytic system near a place of ℂⁿ. PROOF.md, "All solutions", derives it.
#pragma once

#include <acb_mat.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace regulus::verifier {

/// An owned acb_mat_t.
class ComplexMatrix {
 public:
  ComplexMatrix(std::size_t rows, std::size_t columns) noexcept {
    acb_mat_init(value_, slong(rows), slong(columns));
  }
  ComplexMatrix(const ComplexMatrix& other) noexcept
      : ComplexMatrix(other.rows(), other.columns()) {
    acb_mat_set(value_, other.value_);
  }
  ComplexMatrix& operator=(const ComplexMatrix& other) noexcept {
    ComplexMatrix copy(other);
    acb_mat_swap(value_, copy.value_);
    return *this;
  }
  ~ComplexMatrix() { acb_mat_clear(value_); }

  [[nodiscard]] std::size_t rows() const noexcept { return std::size_t(acb_mat_nrows(value_)); }
  [[nodiscard]] std::size_t columns() const noexcept { return std::size_t(acb_mat_ncols(value_)); }
  [[nodiscard]] acb_mat_struct* get() noexcept { return value_; }
  [[nodiscard]] const acb_mat_struct* get() const noexcept { return value_; }
  [[nodiscard]] acb_ptr at(std::size_t row, std::size_t column = 0) noexcept {
    return acb_mat_entry(value_, row, column);
  }
  [[nodiscard]] acb_srcptr at(std::size_t row, std::size_t column = 0) const noexcept {
    return acb_mat_entry(value_, row, column);
  }

 private:
  acb_mat_t value_;
};

/// n analytic equations in n unknowns, all of whose coefficients are real.
class ComplexSystem {
 public:
  ComplexSystem() = default;
  ComplexSystem(const ComplexSystem&) = delete;
  ComplexSystem& operator=(const ComplexSystem&) = delete;
  virtual ~ComplexSystem() = default;

  [[nodiscard]] virtual std::size_t unknowns() const = 0;
  /// Encloses the values (n×1) and the derivatives (n×n, a row for each equation) all over z (n×1).
  virtual void evaluate(const ComplexMatrix& z, ComplexMatrix& values, ComplexMatrix& derivatives,
                        long bits) const = 0;
};

/// A root of a system: there is exactly one z with |z_i − center_i| ≤ reach_i for each i, it is simple,
/// and |z_i − center_i| ≤ radius_i.
struct ComplexRoot {
  ComplexMatrix center;  ///< exact numbers
  std::vector<double> reach, radius;

  /// Encloses the root.
  [[nodiscard]] ComplexMatrix enclosure() const;
};

/// Looks for a root near `start`, with at most so many bits. `scale`: a usual size of each unknown,
/// above 0. Returns nullopt if none was proved.
[[nodiscard]] std::optional<ComplexRoot> prove_root(const ComplexSystem& system,
                                                    const ComplexMatrix& start,
                                                    std::span<const double> scale, long most_bits);

/// Looks for a root of each system of a family near a root of one of them.
///
/// Requires  `family` encloses the values and derivatives of all its systems, `one` those of one of them.
/// Ensures   the root is one of each system of the family, as above: they differ, the bounds are the same.
[[nodiscard]] std::optional<ComplexRoot> prove_tube(const ComplexSystem& one,
                                                    const ComplexSystem& family,
                                                    const ComplexMatrix& start,
                                                    std::span<const double> scale);

enum class Certainty { kYes, kNo, kUnknown };

/// Tells whether two roots of a system are the same.
[[nodiscard]] Certainty is_same(const ComplexRoot& a, const ComplexRoot& b);
/// Tells whether all unknowns of a root are real.
[[nodiscard]] Certainty is_real(const ComplexRoot& root);

}  // namespace regulus::verifier
