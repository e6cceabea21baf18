// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/approx_values.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "codegen/question/quantity/sample_point.hpp"

namespace regulus {
namespace {

using GiNaC::ex;
using GiNaC::exmap;

class Sampler {
 public:
  Sampler(const Bordered& bordered, bool by_decomposition)
      : bordered_(bordered), by_decomposition_(by_decomposition), points_(bordered.request) {}

  std::vector<double> values(int places) {
    std::vector<double> found;
    for (int place = 0; place < places; ++place) {
      const double value = value_at(place == 0);
      if (std::isfinite(value)) found.push_back(value);
    }
    return found;
  }

 private:
  double value_at(bool in_the_middle) try {
    const Motion& motion = bordered_.request.motion;
    exmap point = in_the_middle ? points_.middle() : points_.next();
    points_.add_uncertain(point, in_the_middle);
    for (const ex& constraint : motion.constraints)
      if (!(approx_number(constraint.subs(point)) <= 0)) return std::nan("");
    if (bordered_.parameter.empty()) return determinant(point);
    if (bordered_.scaled) return determinant_of_scaled(point);
    return bordered_.rows_of_inverse == 0 ? by_determinants(point) : by_norm(point);
  } catch (const std::exception&) {
    return std::nan("");  // GiNaC throws at a pole
  }

  static GiNaC::matrix values_at(const GiNaC::matrix& A, const exmap& point) {
    GiNaC::matrix values(A.rows(), A.cols());
    for (unsigned i = 0; i < A.rows(); ++i)
      for (unsigned j = 0; j < A.cols(); ++j) values(i, j) = approx_number(A(i, j).subs(point));
    return values;
  }

  [[nodiscard]] double determinant(const exmap& point) const {
    const Model& model = bordered_.request.model;
    double value = approx_number(values_at(model.matrix, point).determinant());
    for (const ex& scale : model.row_scale) value *= approx_number(scale.subs(point));
    return std::abs(value);
  }

  GiNaC::matrix matrix_at(exmap point, double r) const {
    for (const MotionParameter& p : bordered_.request.motion.parameters)
      if (p.name == bordered_.parameter) point[p.symbol] = r;
    return values_at(bordered_.plain, point);
  }

  /// det B is affine in r, so (det B(0) − det B(1))/det B(0) = q − y.
  [[nodiscard]] double by_determinants(const exmap& point) const {
    const double at_0 = approx_number(matrix_at(point, 0).determinant());
    const double at_1 = approx_number(matrix_at(point, 1).determinant());
    const double value = 1 - at_1 / at_0;
    return bordered_.is_absolute ? std::abs(value) : value;
  }

  [[nodiscard]] double determinant_of_scaled(const exmap& point) const {
    const double value = approx_number(values_at(*bordered_.scaled, point).determinant());
    return bordered_.is_absolute ? std::abs(value) : value - approx_number(bordered_.reference);
  }

  [[nodiscard]] double by_norm(const exmap& point) const {
    const GiNaC::matrix B = matrix_at(point, 1);
    const unsigned rows = bordered_.rows_of_inverse, columns = B.cols() - rows;
    if (by_decomposition_) return by_decomposition(B, rows, columns);
    double sum = 0;
    for (unsigned i = 0; i < rows; ++i)
      for (unsigned j = 0; j < columns; ++j)
        sum += std::pow(approx_number(B(i, rows + j)), 2) / approx_number(B(i, i));
    return std::sqrt(sum / columns);
  }

  [[nodiscard]] double by_decomposition(const GiNaC::matrix& B, unsigned rows,
                                        unsigned columns) const {
    Eigen::MatrixXd A(rows, columns);
    for (unsigned i = 0; i < rows; ++i)
      for (unsigned j = 0; j < columns; ++j)
        A(i, j) = approx_number(B(i, rows + j)) / std::sqrt(approx_number(B(i, i)));
    const Eigen::VectorXd sigma = Eigen::JacobiSVD<Eigen::MatrixXd>(A).singularValues();
    return bordered_.is_reciprocal ? sigma(0) : sigma(sigma.size() - 1);
  }

  const Bordered& bordered_;
  const bool by_decomposition_;
  SamplePoints points_;
};

}  // namespace

std::vector<double> approx_values(const Bordered& bordered, int places) {
  return Sampler(bordered, false).values(places);
}

std::vector<double> better_values(const Bordered& bordered, int places) {
  return Sampler(bordered, true).values(places);
}

}  // namespace regulus
