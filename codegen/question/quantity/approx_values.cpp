// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/approx_values.hpp"

#include <cmath>

#include "codegen/question/quantity/sample_point.hpp"
#include "codegen/support/decomposition.hpp"

namespace regulus::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
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
    exmap point = in_the_middle ? points_.middle() : points_.next();
    points_.add_uncertain(point, in_the_middle);
    PointValues at(point);
    for (const ex& constraint : bordered_.request.motion.constraints)
      if (!(at.of(constraint) <= 0)) return std::nan("");
    if (bordered_.parameter.empty()) return determinant(at);
    if (bordered_.scaled) return determinant_of_scaled(at);
    return bordered_.rows_of_inverse == 0 ? by_determinants(point) : by_norm(point);
  } catch (const std::exception&) {
    return std::nan("");  // GiNaC throws at a pole
  }

  [[nodiscard]] double determinant(PointValues& at) const {
    const Model& model = bordered_.request.model;
    double value = detail::determinant(values_of(model.matrix, at));
    for (const ex& scale : model.row_scale) value *= at.of(scale);
    return std::abs(value);
  }

  [[nodiscard]] MatrixXd matrix_at(exmap point, double r) const {
    for (const MotionParameter& p : bordered_.request.motion.parameters)
      if (p.name == bordered_.parameter) point[p.symbol] = r;
    PointValues at(point);
    return values_of(bordered_.plain, at);
  }

  /// det B is affine in r, so (det B(0) − det B(1))/det B(0) = q − y.
  [[nodiscard]] double by_determinants(const exmap& point) const {
    const double value =
        1 - detail::determinant(matrix_at(point, 1)) / detail::determinant(matrix_at(point, 0));
    return bordered_.is_absolute ? std::abs(value) : value;
  }

  [[nodiscard]] double determinant_of_scaled(PointValues& at) const {
    const double value = detail::determinant(values_of(*bordered_.scaled, at));
    return bordered_.is_absolute ? std::abs(value) : value - approx_number(bordered_.reference);
  }

  [[nodiscard]] double by_norm(const exmap& point) const {
    const MatrixXd B = matrix_at(point, 1);
    const Index rows = bordered_.rows_of_inverse, columns = B.cols() - rows;
    const MatrixXd A =
        B.topLeftCorner(rows, rows).diagonal().cwiseSqrt().cwiseInverse().asDiagonal() *
        B.block(0, rows, rows, columns);
    if (!by_decomposition_) return std::sqrt(A.squaredNorm() / double(columns));
    const Eigen::VectorXd sigma = singular_values(A);
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

}  // namespace regulus::detail
