// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/opposite_axes.hpp"

#include <utility>

#include "codegen/question/solve/approx_vectors.hpp"
#include "runtime/interval/elementary.hpp"

namespace regulus::detail {
namespace {

using detail::cross;  // those below would hide them
using detail::dot;
using detail::times;

template <class T>
VectorOf<T> constant(const Vector3& v) {
  return {T(v[0]), T(v[1]), T(v[2])};
}
template <class T>
VectorOf<T> negative(const VectorOf<T>& v) {
  return constant<T>({0, 0, 0}) - v;
}

/// A vector of bilinear forms.
template <class T>
struct FormOf {
  std::array<std::array<VectorOf<T>, 3>, 3> k{};

  FormOf() = default;
  explicit FormOf(const VectorOf<T>& constant) { k[0][0] = constant; }

  template <class Map>
  [[nodiscard]] FormOf mapped(const Map& map) const {
    FormOf result;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) result.k[i][j] = map(k[i][j]);
    return result;
  }

  friend FormOf operator+(const FormOf& a, const FormOf& b) {
    FormOf result;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) result.k[i][j] = a.k[i][j] + b.k[i][j];
    return result;
  }
};

template <class T>
FormOf<T> times(const MatrixOf<T>& R, const FormOf<T>& form) {
  return form.mapped([&R](const VectorOf<T>& v) { return times(R, v); });
}
template <class T>
FormOf<T> cross(const VectorOf<T>& u, const FormOf<T>& form) {
  return form.mapped([&u](const VectorOf<T>& v) { return cross(u, v); });
}
template <class T>
FormOf<T> negative(const FormOf<T>& form) {
  return form.mapped([](const VectorOf<T>& v) { return negative(v); });
}

template <class T>
BilinearOf<T> dot(const VectorOf<T>& u, const FormOf<T>& form) {
  BilinearOf<T> result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = dot(u, form.k[i][j]);
  return result;
}

template <class T>
BilinearOf<T> sum(const BilinearOf<T>& a, const BilinearOf<T>& b, double factor = 1) {
  BilinearOf<T> result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = a[i][j] + T(factor) * b[i][j];
  return result;
}

template <class T>
BilinearOf<T> number(const T& value) {
  BilinearOf<T> result{};
  result[0][0] = value;
  return result;
}

enum class Angle { kFirst, kSecond };

/// Rotates a form that does not have the angle by it about an axis, `sign` 1, or back, −1.
template <class T>
FormOf<T> rotated(const FormOf<T>& form, Angle angle, const VectorOf<T>& axis, double sign) {
  FormOf<T> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = [&](FormOf<T>& f, std::size_t part) -> VectorOf<T>& {
      return angle == Angle::kFirst ? f.k[part][i] : f.k[i][part];
    };
    const VectorOf<T>& v = angle == Angle::kFirst ? form.k[0][i] : form.k[i][0];
    const VectorOf<T> along = dot(axis, v) * axis;
    at(result, 0) = along;
    at(result, 1) = v - along;
    at(result, 2) = T(sign) * cross(axis, v);
  }
  return result;
}

/// A point and a direction, seen from a frame.
template <class T>
struct LineOf {
  FormOf<T> point, direction;
};

template <class T>
using SidesOf = std::array<std::array<BilinearOf<T>, 2>, OppositeEquations::kAll>;

/// Returns both sides of the equations of lines of which a slide along k carries one to the other. `before`
/// is seen from a frame in which the slide's has the rotation R.
template <class T>
SidesOf<T> slide_along(const Vector3& axis, const MatrixOf<T>& R, const LineOf<T>& before,
                       const LineOf<T>& behind) {
  const VectorOf<T> k = constant<T>(axis), e = constant<T>(cross(axis, farthest_unit(axis))),
                    f = cross(k, e);
  const auto both = [&](const VectorOf<T>& u, FormOf<T> LineOf<T>::*of) {
    return std::array<BilinearOf<T>, 2>{dot(times(R, u), before.*of), dot(u, behind.*of)};
  };
  return {both(e, &LineOf<T>::point), both(f, &LineOf<T>::point), both(e, &LineOf<T>::direction),
          both(f, &LineOf<T>::direction), both(k, &LineOf<T>::direction)};
}

template <class T>
struct FrameOf {
  MatrixOf<T> R;
  VectorOf<T> d;
};

/// The left and right sides of the equations of OppositeEquations. `frames`: of the joints, and the target.
template <class T>
SidesOf<T> sides_of(const ArmChain& chain, const std::array<FrameOf<T>, kJoints + 1>& frames) {
  using Form = FormOf<T>;
  using Vector = VectorOf<T>;
  const auto frame = [&](std::size_t joint) -> const FrameOf<T>& { return frames[joint - 1]; };
  const auto axis = [&](std::size_t joint) { return constant<T>(chain[joint - 1].axis); };
  SidesOf<T> sides;
  const auto left = [&](std::size_t e) -> BilinearOf<T>& { return sides[e][0]; };
  const auto right = [&](std::size_t e) -> BilinearOf<T>& { return sides[e][1]; };

  // The line in the frame of joint 1, then seen through joints 1 and 2.
  const MatrixOf<T> back = transposed(frame(1).R);
  const FrameOf<T>& target = frames[kJoints];
  const Vector g = times(back, target.d - frame(1).d);
  const Vector h = times(back, times(target.R, axis(6)));
  const Vector &d2 = frame(2).d, &d3 = frame(3).d;
  const MatrixOf<T> back2 = transposed(frame(2).R);
  const Form G = rotated(Form(g), Angle::kFirst, axis(1), -1);
  const Form H = rotated(Form(h), Angle::kFirst, axis(1), -1);
  const Form N = rotated(Form(cross(g, h)), Angle::kFirst, axis(1), -1) + negative(cross(d2, H));
  const Form Q = rotated(times(back2, G + Form(negative(d2))), Angle::kSecond, axis(2), -1);
  const Form M = rotated(times(back2, H), Angle::kSecond, axis(2), -1);
  const Form N2 = rotated(times(back2, N), Angle::kSecond, axis(2), -1);
  const Vector k3 = times(frame(3).R, axis(3));
  left(0) = dot(k3, Q + Form(negative(d3)));
  left(1) = dot(k3, M);
  left(2) = sum(sum(number(dot(g, g) + dot(d2, d2) + dot(d3, d3)), dot(d2, G), -2), dot(d3, Q), -2);
  left(3) = sum(sum(number(dot(g, h)), dot(d2, H), -1), dot(d3, M), -1);
  left(4) = dot(k3, N2 + negative(cross(d3, M)));

  // The same through joints 4 and 5.
  const Vector &d4 = frame(4).d, &d5 = frame(5).d, &d6 = frame(6).d, k = axis(3);
  const Vector a6 = times(frame(6).R, axis(6));
  const Form D = times(frame(5).R, rotated(Form(d6), Angle::kSecond, axis(5), 1));
  const Form u = times(frame(5).R, rotated(Form(a6), Angle::kSecond, axis(5), 1));
  const Form m = times(frame(5).R, rotated(Form(cross(d6, a6)), Angle::kSecond, axis(5), 1));
  const auto through4 = [&](const Form& form) {
    return times(frame(4).R, rotated(form, Angle::kFirst, axis(4), 1));
  };
  const Form W = through4(Form(d5) + D), U = through4(u), C = through4(cross(d5, u) + m);
  right(0) = dot(k, Form(d4) + W);
  right(1) = dot(k, U);
  right(2) =
      sum(sum(number(dot(d4, d4) + dot(d5, d5) + dot(d6, d6)), dot(d5, D), 2), dot(d4, W), 2);
  right(3) = sum(sum(number(dot(d6, a6)), dot(d4, U)), dot(d5, u));
  right(4) = dot(k, cross(d4, U) + C);
  if (chain[2].turns) return sides;
  return slide_along<T>(chain[2].axis, frame(3).R, {Q + Form(negative(d3)), M}, {Form(d4) + W, U});
}

template <class T, class Part>
OppositeEquations::Equations equations_of(const SidesOf<T>& sides, const Part& part) {
  OppositeEquations::Equations equations;
  for (std::size_t e = 0; e < sides.size(); ++e)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        equations[e].left[i][j] = part(sides[e][0][i][j]);
        equations[e].right[i][j] = part(sides[e][1][i][j]);
      }
  return equations;
}

OppositeEquations::Equations equations_of(const ArmLoop& arm) {
  std::array<FrameOf<Interval>, kJoints + 1> frames;
  for (std::size_t k = 0; k <= kJoints; ++k) {
    const LinkFrame& frame = k < kJoints ? arm.chain[k].origin : arm.target;
    frames[k] = {frame.R, frame.d};
  }
  return equations_of<Interval>(sides_of(arm.chain, frames), [](const Interval& x) { return x; });
}

/// Their derivatives by a deviation.
OppositeEquations::Equations rates_of(const ArmLoop& arm, std::size_t deviation) {
  std::array<FrameOf<Rated>, kJoints + 1> frames;
  for (std::size_t k = 0; k <= kJoints; ++k) {
    const LinkFrame& frame = k < kJoints ? arm.chain[k].origin : arm.target;
    const FrameRates& all = k < kJoints ? arm.chain[k].rates : arm.target_rates;
    const LinkFrame rate = all.empty() ? LinkFrame{Matrix3{}, Vector3{}} : all[deviation];
    for (std::size_t i = 0; i < 9; ++i) frames[k].R[i] = {frame.R[i], rate.R[i]};
    for (std::size_t i = 0; i < 3; ++i) frames[k].d[i] = {frame.d[i], rate.d[i]};
  }
  return equations_of<Rated>(sides_of(arm.chain, frames), [](const Rated& x) { return x.rate; });
}

/// (1, cos, sin) and its derivatives.
std::array<Vector3, 3> powers(const Interval& angle) {
  const SinCos t = sincos(angle);
  return {{{1.0, t.cos, t.sin}, {0.0, -t.sin, t.cos}, {0.0, -t.cos, -t.sin}}};
}

Interval value_of(const Bilinear& form, const Vector3& u, const Vector3& v) {
  Interval result(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    if (u[i] == Interval(0.0)) continue;
    Interval row(0.0);
    for (std::size_t j = 0; j < 3; ++j)
      if (v[j] != Interval(0.0)) row += form[i][j] * v[j];
    result += u[i] * row;
  }
  return result;
}

}  // namespace

OppositeEquations::OppositeEquations(const VaryingLoop& arm)
    : within(equations_of(arm.within)), nominal{}, deviations(arm.deviations) {
  if (deviations.empty()) return;
  nominal = equations_of(arm.nominal);
  for (std::size_t k = 0; k < deviations.size(); ++k) rates.push_back(rates_of(arm.within, k));
}

std::optional<RootSystem::Values> OppositeAxes::at(std::size_t lane) const {
  using Order = std::array<std::size_t, kFourJoints>;
  std::array<std::array<Vector3, 3>, kFourJoints> t;
  for (std::size_t i = 0; i < kFourJoints; ++i) t[i] = powers(boxes_[lane][i]);
  const auto derivative = [&](const OppositeEquations::Equation& e, const Order& order) {
    const bool has_left = order[2] + order[3] == 0, has_right = order[0] + order[1] == 0;
    Interval value(0.0);
    if (has_left) value += value_of(e.left, t[0][order[0]], t[1][order[1]]);
    if (has_right) value -= value_of(e.right, t[2][order[2]], t[3][order[3]]);
    return value;
  };
  const OppositeEquations& all = *equations_;
  Values values;
  for (std::size_t e = 0; e < kFourJoints; ++e) {
    values.value.push_back(derivative(all.within[e], {}));
    for (std::size_t j = 0; j < kFourJoints; ++j) {
      Order order{};
      ++order[j];
      values.by_unknown.push_back(derivative(all.within[e], order));
    }
  }
  values.also = {derivative(all.within[kFourJoints], {})};
  for (std::size_t k = 0; has_rates_ && k < kFourJoints; ++k)
    for (std::size_t e = 0; e < kFourJoints; ++e)
      for (std::size_t j = 0; j < kFourJoints; ++j) {
        Order order{};
        ++order[j], ++order[k];
        values.rates_by_unknown.push_back(derivative(all.within[e], order));
      }
  if (all.deviations.empty() || !is_point(boxes_[lane])) return values;
  values.data = all.deviations;
  for (std::size_t e = 0; e < kFourJoints; ++e) {
    values.core.push_back(derivative(all.nominal[e], {}));
    for (const OppositeEquations::Equations& rate : all.rates)
      values.by_datum.push_back(derivative(rate[e], {}));
  }
  return values;
}

PairInLoop opposite_pair(const ArmLoop& arm, std::span<const Interval> four) {
  const ArmChain& chain = arm.chain;
  const auto moved = [&](std::size_t joint, const Interval& value) {
    return compose(chain[joint].origin, chain[joint].moved(value));
  };
  const LinkFrame before = compose(compose(moved(0, four[0]), moved(1, four[1])), chain[2].origin);
  const LinkFrame after = compose(compose(moved(3, four[2]), moved(4, four[3])), chain[5].origin);
  return {chain[2], chain[5], after, compose(inverse(before), arm.target)};
}

}  // namespace regulus::detail
