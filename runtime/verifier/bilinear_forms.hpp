// SPDX-License-Identifier: Apache-2.0
// Vectors and numbers that are bilinear in 1, cos, sin of one angle and 1, cos, sin of another, with
// expressions of a graph as coefficients.
#pragma once

#include "runtime/verifier/rigid_motion.hpp"

namespace regulus::verifier {

class BilinearForms {
 protected:
  explicit BilinearForms(Graph& graph) : a_(graph), zero_(a_.zero()) {}

  template <class T>
  using Bilinear = std::array<std::array<T, 3>, 3>;
  using Form = Bilinear<VectorNodes>;
  using Number = Bilinear<NodeId>;
  enum class Angle { kFirst, kSecond };

  Form constant(const VectorNodes& v) {
    Form result;
    for (auto& row : result) row.fill(zero_);
    result[0][0] = v;
    return result;
  }
  template <class Map>
  static auto mapped(const Form& form, const Map& map) {
    Bilinear<decltype(map(form[0][0]))> result;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) result[i][j] = map(form[i][j]);
    return result;
  }
  Form times(const MatrixNodes& R, const Form& form) {
    return mapped(form, [&](const VectorNodes& v) { return a_.product(R, v); });
  }
  Form cross(const VectorNodes& u, const Form& form) {
    return mapped(form, [&](const VectorNodes& v) { return a_.cross(u, v); });
  }
  Number dot(const VectorNodes& u, const Form& form) {
    return mapped(form, [&](const VectorNodes& v) { return a_.dot(u, v); });
  }
  Form plus(Form form, const VectorNodes& v) {
    form[0][0] = a_.sum(form[0][0], v);
    return form;
  }
  Form minus(Form form, const VectorNodes& v) {
    form[0][0] = a_.difference(form[0][0], v);
    return form;
  }
  Form sum(const Form& x, const Form& y) {
    Form result;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) result[i][j] = a_.sum(x[i][j], y[i][j]);
    return result;
  }
  Form difference(const Form& x, const Form& y) {
    Form result;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) result[i][j] = a_.difference(x[i][j], y[i][j]);
    return result;
  }
  /// Adds a multiple of another one.
  Number plus(Number x, const Number& y, long factor = 1) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        x[i][j] = a_.sum(x[i][j], a_.product(a_.number(factor), y[i][j]));
    return x;
  }
  Number number(NodeId constant) {
    Number result;
    for (auto& row : result) row.fill(a_.number(0));
    result[0][0] = constant;
    return result;
  }

  /// Turns a form that does not have the angle by it about a unit vector u, or back if `sign` is −1:
  /// v becomes u(u·v) + (v − u(u·v))·cos ± (u × v)·sin.
  Form turned(const Form& form, Angle angle, const VectorNodes& u, long sign) {
    Form result = constant(zero_);
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_first = angle == Angle::kFirst;
      const VectorNodes& v = is_first ? form[0][i] : form[i][0];
      const VectorNodes along = a_.scaled(a_.dot(u, v), u);
      const std::array<VectorNodes, 3> parts = {along, a_.difference(v, along),
                                                a_.scaled(a_.number(sign), a_.cross(u, v))};
      for (std::size_t part = 0; part < 3; ++part)
        (is_first ? result[part][i] : result[i][part]) = parts[part];
    }
    return result;
  }

  GraphAlgebra a_;
  const VectorNodes zero_;
};

}  // namespace regulus::verifier
