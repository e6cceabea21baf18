// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/loop_gap.hpp"

#include <cmath>

namespace regulus::detail {
namespace {

using GiNaC::ex;

template <class T>
using Vector = std::array<T, 3>;

/// The exact numbers of steps and joints, or their doubles.
struct Exact {
  static const ex& R(const LoopStep& step, unsigned i, unsigned j) { return step.frame.R(i, j); }
  static const ex& p(const LoopStep& step, std::size_t i) { return step.frame.p[i]; }
  static const ex& axis(const LoopJoint& joint, std::size_t i) { return joint.axis[i]; }
  static ex value(const LoopJoint& joint, const std::vector<ex>& variables) {
    return joint.multiplier * variables[joint.variable] + joint.offset;
  }
  static ex cosine(const ex& x) { return cos(x); }
  static ex sine(const ex& x) { return sin(x); }
};

struct Rounded {
  static double R(const LoopStep& step, unsigned i, unsigned j) { return step.approx[i * 3 + j]; }
  static double p(const LoopStep& step, std::size_t i) { return step.approx[9 + i]; }
  static double axis(const LoopJoint& joint, std::size_t i) { return joint.approx_axis[i]; }
  static double value(const LoopJoint& joint, const std::vector<double>& variables) {
    return joint.value(variables);
  }
  static double cosine(double x) { return std::cos(x); }
  static double sine(double x) { return std::sin(x); }
};

template <class T>
struct NumbersOf {
  using Type = Exact;
};
template <>
struct NumbersOf<double> {
  using Type = Rounded;
};

template <class T>
class GapMeter {
 public:
  using Numbers = typename NumbersOf<T>::Type;

  GapMeter(const std::vector<LoopJoint>& joints, const std::vector<T>& variables)
      : joints_(joints), variables_(variables) {}

  std::vector<T> gap(const CutLoop& loop) const {
    if (loop.kind == CutLoop::Kind::kRod) {
      const auto [one, other] = squared_lengths(loop);
      return {one - other};
    }
    std::vector<T> gap;
    const auto add = [&gap](const Vector<T>& v) { gap.insert(gap.end(), v.begin(), v.end()); };
    add(difference(loop.arc, {}, true));
    if (loop.kind == CutLoop::Kind::kHinge) {
      const LoopJoint& hinge = joints_[loop.hinge];
      add(difference(loop.arc,
                     {Numbers::axis(hinge, 0), Numbers::axis(hinge, 1), Numbers::axis(hinge, 2)},
                     false));
    }
    if (loop.kind == CutLoop::Kind::kWeld)
      for (const Vector<T>& e : {Vector<T>{1, 0, 0}, Vector<T>{0, 1, 0}, Vector<T>{0, 0, 1}})
        add(difference(loop.arc, e, false));
    return gap;
  }

  /// Between the balls of a rod, one way and the other.
  std::pair<T, T> squared_lengths(const CutLoop& loop) const {
    return {squared(difference(loop.arc, {}, true)), squared(difference(loop.other, {}, true))};
  }

 private:
  static T squared(const Vector<T>& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

  /// Returns the difference of a point, or of a direction, between the ends of both ways.
  Vector<T> difference(const LoopArc& arc, const Vector<T>& at, bool is_point) const {
    const Vector<T> left = seen(arc.left, at, is_point), right = seen(arc.right, at, is_point);
    return {right[0] - left[0], right[1] - left[1], right[2] - left[2]};
  }

  Vector<T> seen(const std::vector<LoopStep>& steps, Vector<T> v, bool is_point) const {
    for (auto step = steps.rbegin(); step != steps.rend(); ++step)
      v = step->kind == LoopStep::Kind::kFixed ? placed(*step, v, is_point)
                                               : moved(*step, v, is_point);
    return v;
  }

  static Vector<T> placed(const LoopStep& step, const Vector<T>& v, bool is_point) {
    Vector<T> result;
    for (unsigned i = 0; i < 3; ++i) {
      result[i] = Numbers::R(step, i, 0) * v[0] + Numbers::R(step, i, 1) * v[1] +
                  Numbers::R(step, i, 2) * v[2];
      if (is_point) result[i] += Numbers::p(step, i);
    }
    return result;
  }

  Vector<T> moved(const LoopStep& step, const Vector<T>& v, bool is_point) const {
    const LoopJoint& joint = joints_[step.joint];
    const T value = Numbers::value(joint, variables_);
    const T sign = step.reversed ? -1 : 1;
    const Vector<T> a = {Numbers::axis(joint, 0), Numbers::axis(joint, 1), Numbers::axis(joint, 2)};
    if (joint.slides) {
      if (!is_point) return v;
      return {v[0] + sign * value * a[0], v[1] + sign * value * a[1], v[2] + sign * value * a[2]};
    }
    return turned(v, a, Numbers::cosine(value), sign * Numbers::sine(value));
  }

  /// v about the unit vector a (Rodrigues).
  static Vector<T> turned(const Vector<T>& v, const Vector<T>& a, const T& c, const T& s) {
    const Vector<T> side = {a[1] * v[2] - a[2] * v[1], a[2] * v[0] - a[0] * v[2],
                            a[0] * v[1] - a[1] * v[0]};
    const T along = a[0] * v[0] + a[1] * v[1] + a[2] * v[2];
    Vector<T> result;
    for (std::size_t i = 0; i < 3; ++i)
      result[i] = along * a[i] + c * (v[i] - along * a[i]) + s * side[i];
    return result;
  }

  const std::vector<LoopJoint>& joints_;
  const std::vector<T>& variables_;
};

}  // namespace

template <class T>
std::vector<T> gap_of(const CutLoop& loop, const std::vector<LoopJoint>& joints,
                      const std::vector<T>& variables) {
  return GapMeter<T>(joints, variables).gap(loop);
}

double opening_of(const CutLoop& loop, const std::vector<LoopJoint>& joints,
                  const std::vector<double>& variables) {
  const GapMeter<double> meter(joints, variables);
  if (loop.kind == CutLoop::Kind::kRod) {
    const auto [one, other] = meter.squared_lengths(loop);
    return std::fabs(std::sqrt(one) - std::sqrt(other));
  }
  double largest = 0;
  for (const double part : meter.gap(loop)) largest = std::fmax(largest, std::fabs(part));
  return largest;
}

template std::vector<double> gap_of(const CutLoop&, const std::vector<LoopJoint>&,
                                    const std::vector<double>&);
template std::vector<ex> gap_of(const CutLoop&, const std::vector<LoopJoint>&,
                                const std::vector<ex>&);

}  // namespace regulus::detail
