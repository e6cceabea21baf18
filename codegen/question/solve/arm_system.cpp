// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_system.hpp"

#include <cmath>
#include <utility>

#include "codegen/question/solve/approx_vectors.hpp"
#include "runtime/interval/elementary.hpp"

namespace regulus::detail {
namespace {

using detail::cross;  // those below would hide them
using detail::dot;
using detail::times;

constexpr std::size_t kFourJoints = 4;

/// A vector of bilinear forms.
struct Form {
  std::array<std::array<Vector3, 3>, 3> k{};

  Form() = default;
  explicit Form(const Vector3& constant) { k[0][0] = constant; }

  template <class Map>
  [[nodiscard]] Form mapped(const Map& map) const {
    Form result;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) result.k[i][j] = map(k[i][j]);
    return result;
  }

  friend Form operator+(const Form& a, const Form& b) {
    Form result;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) result.k[i][j] = a.k[i][j] + b.k[i][j];
    return result;
  }
};

Form times(const Matrix3& R, const Form& form) {
  return form.mapped([&R](const Vector3& v) { return times(R, v); });
}
Form cross(const Vector3& u, const Form& form) {
  return form.mapped([&u](const Vector3& v) { return cross(u, v); });
}
Form negative(const Form& form) {
  return form.mapped([](const Vector3& v) { return Vector3{-v[0], -v[1], -v[2]}; });
}

Bilinear dot(const Vector3& u, const Form& form) {
  Bilinear result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = dot(u, form.k[i][j]);
  return result;
}

Bilinear sum(const Bilinear& a, const Bilinear& b, double factor = 1) {
  Bilinear result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = a[i][j] + Interval(factor) * b[i][j];
  return result;
}

Bilinear constant(const Interval& value) {
  Bilinear result{};
  result[0][0] = value;
  return result;
}

enum class Angle { kFirst, kSecond };

/// Rotates a form that does not have the angle by it about an axis, `sign` 1, or back, −1.
Form rotated(const Form& form, Angle angle, const Vector3& axis, double sign) {
  Form result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = [&](Form& f, std::size_t part) -> Vector3& {
      return angle == Angle::kFirst ? f.k[part][i] : f.k[i][part];
    };
    const Vector3& v = angle == Angle::kFirst ? form.k[0][i] : form.k[i][0];
    const Vector3 along = dot(axis, v) * axis;
    at(result, 0) = along;
    at(result, 1) = v - along;
    at(result, 2) = Interval(sign) * cross(axis, v);
  }
  return result;
}

/// A point and a direction, seen from a frame.
struct Line {
  Form point, direction;
};

/// Returns both sides of the equations of lines of which a slide along k carries one to the other. `before`
/// is seen from a frame in which the slide's has the rotation R.
std::array<std::array<Bilinear, 2>, 5> slide_along(const Vector3& k, const Matrix3& R,
                                                   const Line& before, const Line& behind) {
  const Vector3 e = cross(k, farthest_unit(k)), f = cross(k, e);
  const auto both = [&](const Vector3& u, Form Line::*of) {
    return std::array<Bilinear, 2>{dot(times(R, u), before.*of), dot(u, behind.*of)};
  };
  return {both(e, &Line::point), both(f, &Line::point), both(e, &Line::direction),
          both(f, &Line::direction), both(k, &Line::direction)};
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

std::optional<RootSystem::Values> WholeArm::at(std::size_t lane) const {
  const ArmPosture posture = posture_at(chain_, boxes_[lane]);
  const Matrix3 E = times(posture.end.R, transposed(target_.R));
  const Vector3 gap = posture.end.d - target_.d, turn = axial(E);
  Values values;
  for (const Vector3* part : {&gap, &turn})
    values.value.insert(values.value.end(), part->begin(), part->end());
  const std::size_t n = boxes_[lane].size();
  values.by_unknown.assign(kJoints * n, Interval(0.0));
  for (std::size_t k = 0; k < chain_.size(); ++k) {
    const Vector3 v = velocity_by(chain_, posture, k);
    const Vector3 rate =
        chain_[k].turns ? axial(across(posture.axes[k], E)) : Vector3{0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 3; ++i) {
      values.by_unknown[i * n + chain_[k].unknown] += chain_[k].factor * v[i];
      values.by_unknown[(3 + i) * n + chain_[k].unknown] += chain_[k].factor * rate[i];
    }
  }
  values.also = {Interval(3.0) - (E[0] + E[4] + E[8])};
  if (has_rates_ && are_rates_needed_) add_rates(values, n, posture, E);
  return values;
}

void WholeArm::add_rates(Values& values, std::size_t n, const ArmPosture& posture,
                         const Matrix3& E) const {
  values.rates_by_unknown.assign(n * kJoints * n, Interval(0.0));
  for (std::size_t k = 0; k < chain_.size(); ++k) {
    const Vector3 v = velocity_by(chain_, posture, k);
    for (std::size_t j = 0; j <= k; ++j) {
      if (!chain_[j].turns) continue;
      const Interval factor = chain_[j].factor * chain_[k].factor;
      const Vector3 of_place = factor * cross(posture.axes[j], v);
      const Vector3 of_turn =
          chain_[k].turns ? factor * axial(across(posture.axes[j], across(posture.axes[k], E)))
                          : Vector3{0.0, 0.0, 0.0};
      const auto add = [&](std::size_t by, std::size_t column) {
        for (std::size_t i = 0; i < 3; ++i) {
          values.rates_by_unknown[(by * kJoints + i) * n + column] += of_place[i];
          values.rates_by_unknown[(by * kJoints + 3 + i) * n + column] += of_turn[i];
        }
      };
      add(chain_[j].unknown, chain_[k].unknown);
      if (j < k) add(chain_[k].unknown, chain_[j].unknown);
    }
  }
}

std::vector<Interval> along(const Vector3& n, const std::vector<Interval>& rows) {
  const std::size_t m = rows.size() / 6;
  std::vector<Interval> result(rows.begin(), rows.begin() + std::ptrdiff_t(3 * m));
  for (std::size_t k = 0; k < m; ++k)
    result.push_back(dot(n, {rows[3 * m + k], rows[4 * m + k], rows[5 * m + k]}));
  return result;
}

std::optional<RootSystem::Values> ArmAboutDirection::at(std::size_t lane) const {
  auto values = whole_.at(lane);
  if (!values) return std::nullopt;
  values->value = along(direction_, values->value);
  values->by_unknown = along(direction_, values->by_unknown);
  std::vector<Interval> rates;
  const std::size_t size = 6 * kFourJoints;
  for (std::size_t k = 0; k * size < values->rates_by_unknown.size(); ++k) {
    const auto first = values->rates_by_unknown.begin() + std::ptrdiff_t(k * size);
    const auto of_unknown =
        along(direction_, std::vector<Interval>(first, first + std::ptrdiff_t(size)));
    rates.insert(rates.end(), of_unknown.begin(), of_unknown.end());
  }
  values->rates_by_unknown = std::move(rates);
  return values;
}

OppositeAxes::OppositeAxes(const ArmChain& chain, const LinkFrame& target) {
  const auto frame = [&](std::size_t joint) -> const LinkFrame& { return chain[joint - 1].origin; };
  const auto axis = [&](std::size_t joint) -> const Vector3& { return chain[joint - 1].axis; };

  // The line in the frame of joint 1, then seen through joints 1 and 2.
  const LinkFrame back = inverse(frame(1));
  const Vector3 g = times(back.R, target.d) + back.d;
  const Vector3 h = times(back.R, times(target.R, axis(6)));
  const Vector3 &d2 = frame(2).d, &d3 = frame(3).d;
  const Matrix3 back2 = transposed(frame(2).R);
  const Form G = rotated(Form(g), Angle::kFirst, axis(1), -1);
  const Form H = rotated(Form(h), Angle::kFirst, axis(1), -1);
  const Form N = rotated(Form(cross(g, h)), Angle::kFirst, axis(1), -1) + negative(cross(d2, H));
  const Form Q =
      rotated(times(back2, G + Form(Vector3{0, 0, 0} - d2)), Angle::kSecond, axis(2), -1);
  const Form M = rotated(times(back2, H), Angle::kSecond, axis(2), -1);
  const Form N2 = rotated(times(back2, N), Angle::kSecond, axis(2), -1);
  const Vector3 k3 = times(frame(3).R, axis(3));
  equations_[0].left = dot(k3, Q + Form(Vector3{0, 0, 0} - d3));
  equations_[1].left = dot(k3, M);
  equations_[2].left =
      sum(sum(constant(dot(g, g) + dot(d2, d2) + dot(d3, d3)), dot(d2, G), -2), dot(d3, Q), -2);
  equations_[3].left = sum(sum(constant(dot(g, h)), dot(d2, H), -1), dot(d3, M), -1);
  equations_[4].left = dot(k3, N2 + negative(cross(d3, M)));

  // The same through joints 4 and 5.
  const Vector3 &d4 = frame(4).d, &d5 = frame(5).d, &d6 = frame(6).d, &k = axis(3);
  const Vector3 a6 = times(frame(6).R, axis(6));
  const Form D = times(frame(5).R, rotated(Form(d6), Angle::kSecond, axis(5), 1));
  const Form u = times(frame(5).R, rotated(Form(a6), Angle::kSecond, axis(5), 1));
  const Form m = times(frame(5).R, rotated(Form(cross(d6, a6)), Angle::kSecond, axis(5), 1));
  const auto through4 = [&](const Form& form) {
    return times(frame(4).R, rotated(form, Angle::kFirst, axis(4), 1));
  };
  const Form W = through4(Form(d5) + D), U = through4(u), C = through4(cross(d5, u) + m);
  equations_[0].right = dot(k, Form(d4) + W);
  equations_[1].right = dot(k, U);
  equations_[2].right =
      sum(sum(constant(dot(d4, d4) + dot(d5, d5) + dot(d6, d6)), dot(d5, D), 2), dot(d4, W), 2);
  equations_[3].right = sum(sum(constant(dot(d6, a6)), dot(d4, U)), dot(d5, u));
  equations_[4].right = dot(k, cross(d4, U) + C);
  if (chain[2].turns) return;
  const auto slide =
      slide_along(k, frame(3).R, {Q + Form(Vector3{0, 0, 0} - d3), M}, {Form(d4) + W, U});
  for (std::size_t e = 0; e < kEquations; ++e) equations_[e] = {slide[e][0], slide[e][1]};
}

std::optional<RootSystem::Values> OppositeAxes::at(std::size_t lane) const {
  std::array<std::array<Vector3, 3>, kFourJoints> t;
  for (std::size_t i = 0; i < kFourJoints; ++i) t[i] = powers(boxes_[lane][i]);
  const auto derivative = [&](const Equation& e, std::array<std::size_t, kFourJoints> order) {
    const bool has_left = order[2] + order[3] == 0, has_right = order[0] + order[1] == 0;
    Interval value(0.0);
    if (has_left) value += value_of(e.left, t[0][order[0]], t[1][order[1]]);
    if (has_right) value -= value_of(e.right, t[2][order[2]], t[3][order[3]]);
    return value;
  };
  Values values;
  for (std::size_t e = 0; e < kFourJoints; ++e) {
    values.value.push_back(derivative(equations_[e], {}));
    for (std::size_t j = 0; j < kFourJoints; ++j) {
      std::array<std::size_t, kFourJoints> order{};
      ++order[j];
      values.by_unknown.push_back(derivative(equations_[e], order));
    }
  }
  values.also = {derivative(equations_[kFourJoints], {})};
  for (std::size_t k = 0; has_rates_ && k < kFourJoints; ++k)
    for (std::size_t e = 0; e < kFourJoints; ++e)
      for (std::size_t j = 0; j < kFourJoints; ++j) {
        std::array<std::size_t, kFourJoints> order{};
        ++order[j], ++order[k];
        values.rates_by_unknown.push_back(derivative(equations_[e], order));
      }
  return values;
}

std::array<double, 2> OppositeAxes::approx_others(const ArmChain& chain, const LinkFrame& target,
                                                  std::span<const double> four) {
  const auto moved = [&](std::size_t joint, double value) {
    return compose(chain[joint].origin, chain[joint].moved(Interval(value)));
  };
  const LinkFrame before = compose(compose(moved(0, four[0]), moved(1, four[1])), chain[2].origin);
  const LinkFrame after = compose(compose(moved(3, four[2]), moved(4, four[3])), chain[5].origin);
  const LinkFrame seen = compose(inverse(before), target);
  const Point3 k = middle(chain[2].axis);
  const auto by_place = approx_angle(k, middle(after.d), middle(seen.d));
  const auto by_direction =
      approx_angle(k, middle(times(after.R, chain[5].axis)), middle(times(seen.R, chain[5].axis)));
  const double third = !chain[2].turns ? approx_dot(k, middle(seen.d - after.d))
                       : by_place.second > by_direction.second ? by_place.first
                                                               : by_direction.first;
  const LinkFrame last =
      compose(inverse(compose(compose(before, chain[2].moved(Interval(third))), after)), target);
  const Point3 a = middle(chain[5].axis);
  const Vector3 across = farthest_unit(chain[5].axis);
  return {third, approx_angle(a, middle(across), middle(times(last.R, across))).first};
}

std::pair<ArmChain, LinkFrame> rotated_loop(const ArmChain& chain, const LinkFrame& target,
                                            std::size_t first) {
  if (first == 0) return {chain, target};
  // O₁J₁…O₆J₆ = T is J₁O₂J₂…J₆(T⁻¹O₁) = I.
  ArmChain loop;
  for (std::size_t i = 0; i < kJoints; ++i) {
    ArmJoint joint = chain[(i + first) % kJoints];
    if ((i + first) % kJoints == 0) joint.origin = compose(inverse(target), chain[0].origin);
    loop.push_back(joint);
  }
  const LinkFrame end = inverse(loop[0].origin);
  loop[0].origin = LinkFrame();
  return {loop, end};
}

void move_origins(ArmChain& chain, LinkFrame& target) {
  for (std::size_t i = 1; i < chain.size(); ++i) {
    // Along the axis, seen from the joint before: d + t·a is to be nearest to the line of b.
    const Point3 b = middle(chain[i - 1].axis), d = middle(chain[i].origin.d);
    const Point3 a = middle(times(chain[i].origin.R, chain[i].axis));
    const double ab = approx_dot(a, b), across = 1 - ab * ab;
    if (!chain[i].turns) continue;
    const double t =
        across < 1e-12 ? -approx_dot(d, a) : (ab * approx_dot(d, b) - approx_dot(d, a)) / across;
    if (!std::isfinite(t)) continue;
    LinkFrame shift;
    shift.d = Interval(t) * chain[i].axis;
    LinkFrame& next = i + 1 < chain.size() ? chain[i + 1].origin : target;
    chain[i].origin = compose(chain[i].origin, shift);
    if (i + 1 < chain.size()) {
      LinkFrame back;
      back.d = Interval(-t) * chain[i].axis;
      next = compose(back, next);
    } else {
      next = compose(next, shift);
    }
  }
}

}  // namespace regulus::detail
