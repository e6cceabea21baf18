// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/bordered.hpp"

#include <algorithm>
#include <memory>

#include "codegen/model/constants.hpp"
#include "codegen/model/drawing.hpp"
#include "codegen/model/mechanism/motor_rows.hpp"
#include "codegen/model/mechanism/twist.hpp"
#include "codegen/question/quantity/determinant_of_inverse.hpp"
#include "codegen/question/quantity/inverse_columns.hpp"
#include "codegen/question/quantity/inverse_in_one_unit.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::matrix;

ex scale_of(const Model& model, unsigned row) {
  return model.row_scale.empty() ? ex(1) : model.row_scale[row];
}

/// True if the set is its own mirror image about 0.
bool is_symmetric(const VectorSet& set) {
  return std::ranges::all_of(set.entries, [](const auto& e) { return e.value.is_zero(); });
}

/// False if −q is a value wherever q is one.
bool has_both_signs(const Component& c) {
  return c.kind == QuantityKind::kDeterminantMax || (c.set != nullptr && !is_symmetric(*c.set));
}

/// Builds B(r) and the request around it.
class Border {
 public:
  Border(const Request& request, const Component& component, const ex& reference)
      : component_(component),
        twist_(twist_of(request.model)),
        scales_(column_scales(request.model)),
        y_(reference),
        bordered_{request, {}, {}, reference} {}

  Bordered build() {
    const Component& c = component_;
    Model& model = bordered_.request.model;
    bordered_.is_absolute = c.is_absolute;
    if (c.kind == QuantityKind::kDeterminant) return determinant();
    bordered_.is_two_sided = c.is_absolute && has_both_signs(c);
    add_parameter();
    bordered_.plain = matrix_of(c.kind);
    model.matrix = with_combined_columns(c.kind);
    model.jacobian.reset();
    // B has 1/s, which may be defined where s is not.
    append(model.must_be_defined, model.row_scale);
    model.row_scale.clear();
    model.twist.clear();
    model.matrix_notes.clear();
    append(model.must_be_defined, c.must_be_defined);
    bordered_.request.motion.alpha = 0;
    return std::move(bordered_);
  }

 private:
  /// Returns a name that no pose parameter, constant or motion parameter has.
  [[nodiscard]] static std::string free_name(const Request& request, std::string name) {
    const auto is_taken = [&] {
      const auto has = [&](const auto& list) {
        return std::ranges::any_of(list, [&](const auto& p) { return p.name == name; });
      };
      return has(request.model.pose) || has(request.model.geometry) ||
             has(request.motion.parameters);
    };
    while (is_taken()) name += "_";
    return name;
  }

  /// The threshold of a search is the bound.
  Bordered determinant() {
    bordered_.is_reciprocal = false;
    bordered_.request.motion.alpha = 0;
    return std::move(bordered_);
  }

  /// Appends r to the pose and to the motion.
  void add_parameter() {
    bordered_.parameter = free_name(bordered_.request, "r");
    const GiNaC::realsymbol r(bordered_.parameter);
    r_ = r;
    Model& model = bordered_.request.model;
    Motion& motion = bordered_.request.motion;
    model.pose.push_back({r, bordered_.parameter, "1"});
    motion.parameters.push_back({r, bordered_.parameter, "1", {0, 1}});
    motion.pose.emplace_back(r);
    motion.error.resize(model.pose.size(), 0);
  }

  matrix matrix_of(QuantityKind kind) {
    switch (kind) {
      case QuantityKind::kForce:
        return force();
      case QuantityKind::kError:
        return component_.part == PosePart::kColumn ? error() : error_of_part();
      case QuantityKind::kSpeed:
        return speed();
      case QuantityKind::kSigmaMin:
      case QuantityKind::kSigmaMax:
        return singular_values(kind == QuantityKind::kSigmaMax);
      case QuantityKind::kCondition:
        return condition();
      case QuantityKind::kDeflection:
        return deflection();
      case QuantityKind::kCondition2:
      case QuantityKind::kFiniteError:
        throw InternalError("the quantity has no matrix B(r)");
      case QuantityKind::kDeterminantMax:
        return determinant_with_sign();
      case QuantityKind::kDeterminant:
      case QuantityKind::kExpression:
        break;
    }
    return value(component_.sign * *component_.expression);
  }

  /// Combines the columns of B that have a transposed matrix.
  [[nodiscard]] matrix with_combined_columns(QuantityKind kind) {
    const matrix& B = bordered_.plain;
    const bool of_deflection = kind == QuantityKind::kDeflection;
    if (!of_deflection && kind != QuantityKind::kSigmaMin) return B;
    const auto& C = bordered_.combination =
        inverse_columns(bordered_.request, of_deflection ? M() : in_one_unit());
    if (!C) return B;
    matrix result = B;
    const unsigned m = C->rows(), first = of_deflection ? B.cols() - m : 0;
    for (unsigned i = 0; i < B.rows(); ++i)
      for (unsigned k = 0; k < m; ++k) {
        ex sum = 0;
        for (unsigned j = 0; j < m; ++j) sum += B(i, first + j) * (*C)(j, k);
        result(i, first + k) = sum;
      }
    return result;
  }

  [[nodiscard]] const Model& model() const { return bordered_.request.model; }
  [[nodiscard]] const matrix& M() const { return bordered_.request.model.matrix; }
  [[nodiscard]] ex nominal(const ex& entry) const { return (1 + r_ * y_) * entry; }

  matrix force() {
    const std::vector<ex> w = symbols_of(*component_.set);
    matrix B = M();
    const auto i = static_cast<unsigned>(component_.row);
    for (unsigned k = 0; k < B.cols(); ++k)
      B(i, k) = nominal(B(i, k)) - r_ * component_.sign * w[k] / scale_of(model(), i);
    return B;
  }

  matrix error() {
    const std::vector<ex> delta = errors();
    matrix B = M();
    const auto k = static_cast<unsigned>(component_.column);
    for (unsigned i = 0; i < B.rows(); ++i)
      B(i, k) = nominal(B(i, k)) - r_ * delta[i] / scale_of(model(), i);
    return B;
  }

  matrix error_of_part() {
    const std::vector<ex> delta = errors();
    const unsigned n = M().cols();
    matrix B = enlarged(M(), n + 1, n + 1);
    const std::vector<ex> direction = direction_of_part();
    for (unsigned i = 0; i < n; ++i) {
      B(i, n) = -r_ * delta[i] / scale_of(model(), i);
      B(n, i) = direction[i];
    }
    B(n, n) = 1;
    return B;
  }

  matrix speed() {
    const auto i = static_cast<unsigned>(component_.row);
    VectorSet set = *component_.set;
    const ex spread = take_balls(set, i);
    const std::vector<ex> v = symbols_of(set);
    ex along = 0;
    for (unsigned k = 0; k < M().cols(); ++k) along += M()(i, k) * v[k];
    return single(nominal(1 / scale_of(model(), i)) - r_ * (component_.sign * along + spread));
  }

  /// Replaces the balls of a set by their centres; returns the largest m_i·d of the points d of balls
  /// about 0. Does nothing if r has both signs, or if a norm would be an absolute value, whose
  /// derivative jumps.
  [[nodiscard]] ex take_balls(VectorSet& set, unsigned i) {
    const auto is_smooth = [&](const ToleranceBall& ball) {
      return std::ranges::count_if(ball.members, [&](std::size_t k) {
               return !M()(i, static_cast<unsigned>(k)).is_zero();
             }) > 1;
    };
    if (bordered_.is_two_sided || !std::ranges::all_of(set.balls, is_smooth)) return 0;
    ex spread = 0;
    bordered_.has_norms = !set.balls.empty();
    for (const ToleranceBall& ball : set.balls) {
      spread += ball.radius * norm_of(i, ball.members);
      for (const std::size_t k : ball.members) {
        set.entries[k].tolerance = 0;
        set.entries[k].ball = -1;
      }
    }
    set.balls.clear();
    return spread;
  }

  /// Returns the Euclidean norm of some entries of a row.
  [[nodiscard]] ex norm_of(unsigned i, const std::vector<std::size_t>& columns) const {
    ex sum = 0;
    for (const std::size_t k : columns) sum += pow(M()(i, static_cast<unsigned>(k)), 2);
    return sqrt(sum);
  }

  matrix deflection() {
    const std::vector<ex> w = symbols_of(*component_.set);
    const unsigned n = M().cols();
    matrix B(2 * n, 2 * n);
    for (unsigned i = 0; i < n; ++i)
      for (unsigned j = 0; j < n; ++j) {
        B(i, j) = M()(j, i);
        B(n + i, n + j) = M()(i, j);
      }
    const std::vector<ex>& stiffness = model().actuators.stiffness;
    for (unsigned i = 0; i < n; ++i)  // after the list: gives way to no force
      B(n + i, i) = i < stiffness.size() ? -pow(scale_of(model(), i), -2) / stiffness[i] : ex(0);
    const unsigned k = n + static_cast<unsigned>(component_.column);
    for (unsigned i = 0; i < n; ++i) {
      B(n + i, k) = nominal(B(n + i, k));
      B(i, k) = -r_ * component_.sign * w[i];
    }
    return B.transpose();  // the load touches one row then
  }

  matrix singular_values(bool largest) {
    bordered_.is_reciprocal = largest;
    const matrix A = in_one_unit();
    const unsigned m = A.rows(), n = A.cols();
    bordered_.rows_of_inverse = m;
    const ex factor = largest ? r_ : ex(1), corner = largest ? ex(1) : pow(r_, 2);
    matrix B(m + n, m + n);
    for (unsigned i = 0; i < m; ++i) {
      B(i, i) = pow(scale_of(model(), i), -2);
      for (unsigned j = 0; j < n; ++j) B(i, m + j) = B(m + j, i) = factor * A(i, j);
    }
    for (unsigned j = 0; j < n; ++j) B(m + j, m + j) = corner;
    return B;
  }

  matrix condition() {
    matrix B = in_one_unit();
    const auto i = static_cast<unsigned>(component_.row);
    const auto k = static_cast<unsigned>(component_.column);
    ex norm = 0;
    for (unsigned j = 0; j < B.cols(); ++j) norm += abs(B(i, j));
    norm *= scale_of(model(), i);
    for (unsigned l = 0; l < B.rows(); ++l) {
      const ex y = add_uncertain("y_" + std::to_string(l + 1), 0, 1, -1);
      B(l, k) -= r_ * norm * y / scale_of(model(), l);
    }
    return B;
  }

  /// Returns M·C.
  matrix in_one_unit() const {
    matrix A = M();
    for (unsigned i = 0; i < A.rows(); ++i)
      for (unsigned j = 0; j < A.cols(); ++j) A(i, j) *= scales_[j];
    return A;
  }

  matrix determinant_with_sign() {
    matrix& scaled = bordered_.scaled.emplace(M());
    for (unsigned i = 0; i < scaled.rows(); ++i)
      for (unsigned j = 0; j < scaled.cols(); ++j)
        scaled(i, j) *= (i == 0 ? component_.sign : 1) * scale_of(model(), i);
    return value(component_.sign * determinant_of_inverse(model()));
  }

  [[nodiscard]] matrix value(const ex& f) const { return single(nominal(1) - r_ * f); }
  static matrix single(const ex& entry) { return {1, 1, GiNaC::lst{entry}}; }

  static matrix enlarged(const matrix& M, unsigned rows, unsigned columns) {
    matrix B(rows, columns);
    for (unsigned i = 0; i < M.rows(); ++i)
      for (unsigned j = 0; j < M.cols(); ++j) B(i, j) = M(i, j);
    return B;
  }

  /// Adds an uncertain quantity under a free name, and returns its symbol.
  ex add_uncertain(const std::string& wanted, const ex& value, const ex& tolerance, int ball,
                   const std::string& unit = "1") {
    const std::string name = free_name(bordered_.request, wanted);
    if (unit != "1") name_unit(name, unit);
    const GiNaC::realsymbol symbol(name);
    bordered_.request.model.geometry.push_back({symbol, name, value, tolerance, "", ball});
    return symbol;
  }

  /// Reports show it beside the value.
  void name_unit(const std::string& name, const std::string& unit) {
    std::shared_ptr<const Drawing>& drawing = bordered_.request.model.drawing;
    Drawing named = drawing ? *drawing : Drawing();
    named.units[name] = unit;
    drawing = std::make_shared<const Drawing>(std::move(named));
  }

  /// Returns the values of a set by column: numbers where they are exact, otherwise new symbols.
  std::vector<ex> symbols_of(const VectorSet& set) {
    Model& model = bordered_.request.model;
    const int first_ball = static_cast<int>(model.balls.size());
    for (const ToleranceBall& ball : set.balls)
      model.balls.push_back({.members = {}, .radius = ball.radius, .group = ""});
    const std::vector<std::string> units = component_.kind == QuantityKind::kSpeed
                                               ? units_of_rates(twist_)
                                               : units_of_wrench(model, twist_);
    std::vector<ex> values;
    for (std::size_t k = 0; k < set.entries.size(); ++k) {
      const GeometryParameter& entry = set.entries[k];
      if (entry.tolerance.is_zero() && entry.ball < 0) {
        values.push_back(entry.value);
        continue;
      }
      const int ball = entry.ball < 0 ? -1 : first_ball + entry.ball;
      if (ball >= 0)
        model.balls[static_cast<std::size_t>(ball)].members.push_back(model.geometry.size());
      values.push_back(add_uncertain(entry.name, entry.value, entry.tolerance, ball,
                                     k < units.size() ? units[k] : "1"));
    }
    return values;
  }

  std::vector<ex> errors() {
    std::vector<ex> delta;
    const Actuators& motors = model().actuators;
    for (std::size_t i = 0; i < motors.error.size(); ++i) {
      const std::string unit = i < motor_count(model()) ? unit_of_coordinate(model(), i) : "1",
                        name = "error_" + std::to_string(i + 1);
      const ex error = motors.error[i];
      delta.push_back(error.is_zero() ? ex(0) : add_uncertain(name, 0, error, -1, unit));
    }
    delta.resize(M().rows(), 0);  // constraints have none
    return delta;
  }

  /// Returns n: 0 in the other columns.
  std::vector<ex> direction_of_part() {
    Model& model = bordered_.request.model;
    const auto kind = component_.part == PosePart::kLinear ? TwistComponent::Kind::kLinear
                                                           : TwistComponent::Kind::kAngular;
    ToleranceBall ball{.members = {}, .radius = 1, .group = ""};
    std::vector<ex> direction(model.matrix.cols(), 0);
    for (std::size_t j = 0; j < twist_.size(); ++j) {
      if (twist_[j].kind != kind) continue;
      ball.members.push_back(model.geometry.size());
      direction[j] =
          add_uncertain("n_" + std::to_string(j + 1), 0, 1, static_cast<int>(model.balls.size()));
    }
    model.balls.push_back(std::move(ball));
    return direction;
  }

  const Component& component_;
  std::vector<TwistComponent> twist_;  ///< before r is a pose parameter
  std::vector<ex> scales_;             ///< C
  ex y_;
  Bordered bordered_;
  ex r_;
};

}  // namespace

Bordered border(const Request& request, const Component& component, const ex& reference) {
  return Border(request, component, reference).build();
}

Bordered border_at_limit(const Request& request, const Component& component, const ex& limit) {
  const ex bound = component.sign * limit;
  const bool is_direct = traits_of(component.kind).is_always_least;
  ex reference = 0;  // below the limit
  if (!is_direct && !component.is_absolute)
    reference = bound - (bound.is_zero() ? ex(1) : GiNaC::abs(bound));
  Bordered bordered = border(request, component, reference);
  Motion& motion = bordered.request.motion;
  if (bordered.parameter.empty()) {
    motion.alpha = bound;
    return bordered;
  }
  const ex end = bordered.is_reciprocal ? 1 / (bound - reference) : bound;
  motion.parameters.back().range = {bordered.is_two_sided ? ex(-end) : ex(0), end};
  return bordered;
}

}  // namespace regulus::detail
