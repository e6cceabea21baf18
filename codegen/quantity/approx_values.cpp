// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/quantity/approx_values.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace regulus::inline quantity {
namespace {

using GiNaC::ex;
using GiNaC::exmap;

/// Returns a real number, NaN for anything else.
double number_of(const ex& e) {
  const ex value = e.evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_real())
    return std::nan("");
  return GiNaC::ex_to<GiNaC::numeric>(value).to_double();
}

class Sampler {
 public:
  explicit Sampler(const Bordered& bordered) : bordered_(bordered) {}

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
    exmap parameters;
    for (const MotionParameter& p : motion.parameters) {
      const ex t = in_the_middle ? ex(0.5) : ex(uniform_(random_));
      parameters[p.symbol] = (p.range.lo + t * (p.range.hi - p.range.lo)).evalf();
    }
    exmap point = with_pose(parameters);
    add_uncertain(point, in_the_middle);
    for (const ex& constraint : motion.constraints)
      if (!(number_of(constraint.subs(point)) <= 0)) return std::nan("");
    return bordered_.rows_of_inverse == 0 ? by_determinants(point) : by_norm(point);
  } catch (const std::exception&) {
    return std::nan("");  // GiNaC throws at a pole
  }

  exmap with_pose(const exmap& parameters) const {
    exmap point = parameters;
    const Request& request = bordered_.request;
    for (std::size_t i = 0; i < request.model.pose.size(); ++i)
      point[request.model.pose[i].symbol] = request.motion.pose[i].subs(parameters).evalf();
    return point;
  }

  void add_uncertain(exmap& point, bool in_the_middle) {
    const Model& model = bordered_.request.model;
    for (const GeometryParameter& g : model.geometry) {
      const double side = uniform_(random_) < 0.5 ? -1 : 1;
      const double part =
          g.ball < 0
              ? side
              : side /
                    std::sqrt(double(model.balls[static_cast<std::size_t>(g.ball)].members.size()));
      // A load about 0 has no force in its middle.
      const bool is_nominal = in_the_middle && !g.value.is_zero();
      point[g.symbol] = (g.value + (is_nominal ? ex(0) : ex(part)) * g.tolerance).evalf();
    }
  }

  GiNaC::matrix matrix_at(exmap point, double r) const {
    for (const MotionParameter& p : bordered_.request.motion.parameters)
      if (p.name == bordered_.parameter) point[p.symbol] = r;
    const GiNaC::matrix& B = bordered_.request.model.matrix;
    GiNaC::matrix values(B.rows(), B.cols());
    for (unsigned i = 0; i < B.rows(); ++i)
      for (unsigned j = 0; j < B.cols(); ++j) values(i, j) = number_of(B(i, j).subs(point));
    return values;
  }

  /// det B is affine in r, so (det B(0) − det B(1))/det B(0) = q − y.
  [[nodiscard]] double by_determinants(const exmap& point) const {
    const double at_0 = number_of(matrix_at(point, 0).determinant());
    const double at_1 = number_of(matrix_at(point, 1).determinant());
    const double value = 1 - at_1 / at_0;
    return bordered_.is_absolute ? std::abs(value) : value;
  }

  [[nodiscard]] double by_norm(const exmap& point) const {
    const GiNaC::matrix B = matrix_at(point, 1);
    const unsigned rows = bordered_.rows_of_inverse, columns = B.cols() - rows;
    double sum = 0;
    for (unsigned i = 0; i < rows; ++i)
      for (unsigned j = 0; j < columns; ++j)
        sum += std::pow(number_of(B(i, rows + j)), 2) / number_of(B(i, i));
    return std::sqrt(sum / columns);
  }

  const Bordered& bordered_;
  std::minstd_rand random_{1};
  std::uniform_real_distribution<double> uniform_{0, 1};
};

}  // namespace

std::vector<double> approx_values(const Bordered& bordered, int places) {
  return Sampler(bordered).values(places);
}

}  // namespace regulus::quantity
