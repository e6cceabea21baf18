// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/singular_bases.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace regulus::verifier {
namespace {

using Doubles = std::vector<double>;

constexpr int kMostSweeps = 30;
/// The span of fewer than m ≤ 64 vectors is at least so far from one of the m unit vectors.
constexpr double kLeastPart = 0.1;

bool are_finite(const Doubles& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

/// One-sided Jacobi: rotates the columns of A until they are orthogonal, and those of V with them.
class ColumnRotations {
 public:
  ColumnRotations(Doubles A, std::size_t rows, std::size_t columns)
      : m_(rows), n_(columns), A_(std::move(A)), V_(columns * columns) {
    for (std::size_t j = 0; j < n_; ++j) V_[j * n_ + j] = 1.0;
  }

  SingularBases run() {
    bool has_rotated = true;
    for (int sweep = 0; has_rotated && sweep < kMostSweeps; ++sweep) {
      has_rotated = false;
      for (std::size_t p = 0; p + 1 < n_; ++p)
        for (std::size_t q = p + 1; q < n_; ++q) has_rotated = orthogonalise(p, q) || has_rotated;
    }
    Doubles length;
    for (std::size_t j = 0; j < n_; ++j) length.push_back(product(j, j));
    if (!are_finite(length) || !are_finite(V_)) return {};
    order(length);
    return {left(), V_};
  }

 private:
  [[nodiscard]] double product(std::size_t p, std::size_t q) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < m_; ++i) sum += A_[i * n_ + p] * A_[i * n_ + q];
    return sum;
  }

  bool orthogonalise(std::size_t p, std::size_t q) {
    const double a = product(p, p), b = product(q, q), c = product(p, q);
    if (!(std::fabs(c) > 0x1p-52 * std::sqrt(a) * std::sqrt(b))) return false;
    const double z = (b - a) / (2.0 * c);
    const double tangent = (z >= 0.0 ? 1.0 : -1.0) / (std::fabs(z) + std::sqrt(1.0 + z * z));
    const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent), sine = cosine * tangent;
    rotate(A_, m_, p, q, cosine, sine);
    rotate(V_, n_, p, q, cosine, sine);
    return true;
  }

  void rotate(Doubles& X, std::size_t rows, std::size_t p, std::size_t q, double cosine,
              double sine) const {
    for (std::size_t i = 0; i < rows; ++i) {
      const double x = X[i * n_ + p], y = X[i * n_ + q];
      X[i * n_ + p] = cosine * x - sine * y;
      X[i * n_ + q] = sine * x + cosine * y;
    }
  }

  /// The longest column first.
  void order(const Doubles& length) {
    std::vector<std::size_t> numbers(n_);
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    std::stable_sort(numbers.begin(), numbers.end(),
                     [&](std::size_t p, std::size_t q) { return length[p] > length[q]; });
    permute(A_, m_, numbers);
    permute(V_, n_, numbers);
  }

  void permute(Doubles& X, std::size_t rows, const std::vector<std::size_t>& numbers) const {
    const Doubles old = X;
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < n_; ++j) X[i * n_ + j] = old[i * n_ + numbers[j]];
  }

  /// The columns of A in length 1, and then unit vectors, made orthogonal to those before them.
  [[nodiscard]] Doubles left() const {
    std::vector<Doubles> columns;
    for (std::size_t j = 0; j < n_; ++j) {
      Doubles u(m_);
      for (std::size_t i = 0; i < m_; ++i) u[i] = A_[i * n_ + j];
      if (!add_to(columns, std::move(u), 0.0)) return {};
    }
    for (std::size_t k = 0; k < m_ && columns.size() < m_; ++k) {
      Doubles u(m_);
      u[k] = 1.0;
      static_cast<void>(add_to(columns, std::move(u), kLeastPart));
    }
    if (columns.size() < m_) return {};
    Doubles U(m_ * m_);
    for (std::size_t i = 0; i < m_; ++i)
      for (std::size_t j = 0; j < m_; ++j) U[i * m_ + j] = columns[j][i];
    return are_finite(U) ? U : Doubles{};
  }

  /// Returns false if the part of u that is orthogonal to the columns is not longer than `least`.
  static bool add_to(std::vector<Doubles>& columns, Doubles u, double least) {
    for (int twice = 0; twice < 2; ++twice)
      for (const Doubles& column : columns) {
        const double part = std::inner_product(u.begin(), u.end(), column.begin(), 0.0);
        for (std::size_t i = 0; i < u.size(); ++i) u[i] -= part * column[i];
      }
    const double length = std::sqrt(std::inner_product(u.begin(), u.end(), u.begin(), 0.0));
    if (!(length > least)) return false;
    for (double& x : u) x /= length;
    columns.push_back(std::move(u));
    return true;
  }

  const std::size_t m_, n_;
  Doubles A_, V_;
};

}  // namespace

SingularBases approx_singular_bases(Doubles A, std::size_t rows, std::size_t columns) {
  if (!are_finite(A)) return {};
  return ColumnRotations(std::move(A), rows, columns).run();
}

}  // namespace regulus::verifier
