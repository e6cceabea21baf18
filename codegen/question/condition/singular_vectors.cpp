// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/singular_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace regulus::detail {
namespace {

constexpr int kMostSweeps = 30;
constexpr double kOrthogonal = 1e-15;

using Vector = std::vector<double>;

/// The columns of A·V and of V, each as one vector.
class Rotations {
 public:
  Rotations(std::span<const double> A, std::size_t rows, std::size_t columns)
      : image_(columns, std::vector<double>(rows)), basis_(columns, std::vector<double>(columns)) {
    for (std::size_t j = 0; j < columns; ++j) {
      for (std::size_t i = 0; i < rows; ++i) image_[j][i] = A[i * columns + j];
      basis_[j][j] = 1;
    }
  }

  void run() {
    bool rotates = true;
    for (int sweep = 0; rotates && sweep < kMostSweeps; ++sweep) {
      rotates = false;
      for (std::size_t p = 0; p < image_.size(); ++p)
        for (std::size_t q = p + 1; q < image_.size(); ++q) rotates |= make_orthogonal(p, q);
    }
  }

  [[nodiscard]] std::optional<SingularVectors> result() const {
    const std::size_t n = image_.size();
    std::vector<double> lengths(n);
    for (std::size_t j = 0; j < n; ++j) lengths[j] = std::sqrt(dot(image_[j], image_[j]));
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      return lengths[a] > lengths[b] || (std::isnan(lengths[b]) && !std::isnan(lengths[a]));
    });
    SingularVectors found{Vector(n), {}, Vector(n * n)};
    for (std::size_t j = 0; j < n; ++j) {
      found.values[j] = lengths[order[j]];
      for (std::size_t i = 0; i < n; ++i) found.right[i * n + j] = basis_[order[j]][i];
    }
    std::vector<Vector> images;
    for (const std::size_t j : order) images.push_back(image_[j]);
    found.left = orthogonal_basis(std::move(images));
    const auto is_finite = [](double x) { return std::isfinite(x); };
    for (const Vector* part : {&found.values, &found.left, &found.right})
      if (!std::ranges::all_of(*part, is_finite)) return std::nullopt;
    return found;
  }

 private:
  /// Returns an orthogonal matrix whose first columns are parallel to the vectors, as far as these
  /// are orthogonal. Twice is enough (Kahan and Parlett).
  static Vector orthogonal_basis(std::vector<Vector> vectors) {
    const std::size_t rows = vectors.front().size();
    std::vector<Vector> basis;
    for (Vector& v : vectors) basis.push_back(unit_beside(basis, std::move(v)));
    while (basis.size() < rows) basis.push_back(unit_beside(basis, Vector(rows, 0.0)));
    Vector matrix(rows * rows);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < rows; ++j) matrix[i * rows + j] = basis[j][i];
    return matrix;
  }

  /// Returns the part of v that is orthogonal to the basis, with length 1; if hardly anything is
  /// left, that of a unit vector.
  static Vector unit_beside(const std::vector<Vector>& basis, Vector v) {
    if (normalise_beside(basis, v)) return v;
    Vector best;
    double most = -1;
    for (std::size_t i = 0; i < v.size(); ++i) {
      Vector unit(v.size(), 0.0);
      unit[i] = 1;
      double left = 1;
      for (const Vector& b : basis) left -= b[i] * b[i];
      if (left > most) most = left, best = unit;
    }
    normalise_beside(basis, best);
    return best;
  }

  static bool normalise_beside(const std::vector<Vector>& basis, Vector& v) {
    const double before = std::sqrt(dot(v, v));
    for (int pass = 0; pass < 2; ++pass)
      for (const Vector& b : basis) {
        const double along = dot(b, v);
        for (std::size_t i = 0; i < v.size(); ++i) v[i] -= along * b[i];
      }
    const double length = std::sqrt(dot(v, v));
    if (!(length > 1e-14 * before)) return false;
    for (double& x : v) x /= length;
    return true;
  }

  static double dot(const Vector& a, const Vector& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }

  /// Returns false if the two columns were orthogonal already.
  bool make_orthogonal(std::size_t p, std::size_t q) {
    const double a = dot(image_[p], image_[p]), b = dot(image_[q], image_[q]);
    const double c = dot(image_[p], image_[q]);
    if (!(std::fabs(c) > kOrthogonal * std::sqrt(a) * std::sqrt(b))) return false;
    const double zeta = (b - a) / (2 * c);
    const double t = std::copysign(1 / (std::fabs(zeta) + std::hypot(1, zeta)), zeta);
    const double cosine = 1 / std::hypot(1, t), sine = cosine * t;
    rotate(image_[p], image_[q], cosine, sine);
    rotate(basis_[p], basis_[q], cosine, sine);
    return true;
  }

  static void rotate(Vector& x, Vector& y, double cosine, double sine) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double before = x[i];
      x[i] = cosine * before - sine * y[i];
      y[i] = sine * before + cosine * y[i];
    }
  }

  std::vector<Vector> image_, basis_;
};

}  // namespace

std::optional<SingularVectors> approx_singular_vectors(std::span<const double> A, std::size_t rows,
                                                       std::size_t columns) {
  Rotations rotations(A, rows, columns);
  rotations.run();
  return rotations.result();
}

}  // namespace regulus::detail
