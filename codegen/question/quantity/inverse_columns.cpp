// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/inverse_columns.hpp"

#include <cmath>

#include "codegen/question/quantity/sample_point.hpp"
#include "codegen/support/decomposition.hpp"

namespace regulus::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int kPlaces = 8;

/// C need only be near an inverse: fewer digits make shorter expressions, and a term below the last
/// of them is left out.
constexpr int kBits = 10;

/// Below it, the columns of A depend on each other so nearly that C would make nothing better.
constexpr double kLeastRatio = 1e-9;

/// Returns A with its uncertain quantities at their nominal values; empty if it has no value.
MatrixXd nominal_values(const GiNaC::matrix& A, const Request& request, GiNaC::exmap point) try {
  for (const GeometryParameter& g : request.model.geometry) point[g.symbol] = g.value.evalf();
  PointValues at(point);
  MatrixXd values = values_of(A, at);
  return values.allFinite() ? values : MatrixXd();
} catch (const std::exception&) {
  return {};  // GiNaC throws at a pole
}

/// Returns a number of kBits bits near x, exactly.
GiNaC::ex short_number(double x) {
  int exponent = 0;
  const long digits = std::lround(std::ldexp(std::frexp(x, &exponent), kBits));
  return GiNaC::numeric(digits) * GiNaC::pow(GiNaC::numeric(2), exponent - kBits);
}

/// Returns [A⁺ᵀ N], with the columns of N orthogonal to those of A, and its short numbers.
std::optional<GiNaC::matrix> columns_at(const MatrixXd& A) {
  // Columns may have different units: a length and an angle.
  const Eigen::VectorXd scale = A.colwise().norm();
  if (!(scale.minCoeff() > 0)) return std::nullopt;
  const MatrixXd balanced = A * scale.cwiseInverse().asDiagonal();
  const SingularValueDecomposition svd = decompose(balanced);
  const Eigen::VectorXd& sigma = svd.sigma;
  if (!(sigma(sigma.size() - 1) > kLeastRatio * sigma(0))) return std::nullopt;
  const Index m = A.rows(), n = A.cols();
  MatrixXd C = svd.u;
  C.leftCols(n) *= sigma.cwiseInverse().asDiagonal() * svd.v.transpose();
  GiNaC::matrix columns(static_cast<unsigned>(m), static_cast<unsigned>(m));
  for (Index k = 0; k < m; ++k) {
    const double least = std::ldexp(C.col(k).cwiseAbs().maxCoeff(), -kBits);
    const double unit = k < n ? 1 / scale(k) : 1;
    for (Index i = 0; i < m; ++i)
      if (std::abs(C(i, k)) > least)
        columns(static_cast<unsigned>(i), static_cast<unsigned>(k)) = short_number(C(i, k) * unit);
  }
  if (columns.determinant().is_zero()) return std::nullopt;
  return columns;
}

}  // namespace

std::optional<GiNaC::matrix> inverse_columns(const Request& request, const GiNaC::matrix& A) {
  SamplePoints points(request);
  for (int place = 0; place < kPlaces; ++place) {
    const MatrixXd values =
        nominal_values(A, request, place == 0 ? points.middle() : points.next());
    if (values.size() == 0) continue;
    if (auto columns = columns_at(values)) return columns;
  }
  return std::nullopt;
}

}  // namespace regulus::detail
