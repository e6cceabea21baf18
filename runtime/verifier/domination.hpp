// SPDX-License-Identifier: Apache-2.0
// Matrices I + E with |E| ≤ T, where Tv < v for some v > 0: all of them are regular.
#pragma once

#include <vector>

#include "runtime/verifier/ball.hpp"
#include "runtime/verifier/linear_algebra.hpp"

namespace regulus::verifier {

class Domination {
 public:
  explicit Domination(std::size_t order) : n_(order), v_(order, 1.0), Tv_(order) {}

  /// Searches for v; T ≥ 0 must stay unchanged. Returns true if it was found; `holds` is then true.
  [[nodiscard]] bool find(const Matrix& T);
  [[nodiscard]] bool holds() const noexcept;

  /// Returns roughly the Perron vector of T, if find has failed.
  [[nodiscard]] const std::vector<double>& v() const noexcept { return v_; }

  /// Computes x ≥ (I − T)⁻¹c for a column c ≥ 0, if Tv < v.
  void bound_solution(const double* c, double* x) const;
  /// Encloses det(I − T), if Tv < v. |det(I + E)| is at least that.
  [[nodiscard]] Interval determinant() const;

 private:
  void multiply();

  const std::size_t n_;
  const Matrix* T_ = nullptr;
  std::vector<double> v_, Tv_;
};

}  // namespace regulus::verifier
