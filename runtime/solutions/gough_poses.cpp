// SPDX-License-Identifier: Apache-2.0
#include "runtime/solutions/gough_poses.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>

#include "runtime/solutions/dietmaier.hpp"
#include "runtime/solutions/dual_quaternion.hpp"
#include "runtime/solutions/paired_legs.hpp"
#include "runtime/solutions/root_list.hpp"

namespace regulus::detail {

namespace {

constexpr std::size_t kUnknowns = 8;
constexpr std::array<std::size_t, 1> kGroups{kUnknowns};

/// A leg: w = y + x₀(b − a) + x × (a + b) − x·(b − a).
template <class Number>
struct Leg {
  std::array<Number, 3> difference;  ///< b − a
  std::array<Number, 3> sum;         ///< a + b
  Number square;                     ///< ρ²
};

template <class Number>
Leg<Number> leg_of(const std::array<Number, 3>& a, const std::array<Number, 3>& b, Number square) {
  Leg<Number> leg{{}, {}, square};
  for (std::size_t i = 0; i < 3; ++i) leg.difference[i] = b[i] - a[i], leg.sum[i] = a[i] + b[i];
  return leg;
}

/// u × v, where u is from component `from` on.
template <class Number>
std::array<Number, 3> cross(const Quaternion<Number>& u, const std::array<Number, 3>& v) {
  return {u[2] * v[2] - u[3] * v[1], u[3] * v[0] - u[1] * v[2], u[1] * v[1] - u[2] * v[0]};
}

/// xb − ax, which is linear in the leg, too.
template <class Number>
Quaternion<Number> offset_of(const Leg<Number>& leg, const Quaternion<Number>& x) {
  const auto& d = leg.difference;
  const auto turned = cross(x, leg.sum);
  return {Number{} - (x[1] * d[0] + x[2] * d[1] + x[3] * d[2]), x[0] * d[0] + turned[0],
          x[0] * d[1] + turned[1], x[0] * d[2] + turned[2]};
}

template <class Number>
struct Place {
  Quaternion<Number> x, y;
  Number xx;  ///< x·x

  explicit Place(std::span<const Number> z)
      : x{z[0], z[1], z[2], z[3]}, y{z[4], z[5], z[6], z[7]}, xx(dot(x, x)) {}
};

template <class Number>
Quaternion<Number> w_of(const Leg<Number>& leg, const Place<Number>& at) {
  Quaternion<Number> w = offset_of(leg, at.x);
  for (std::size_t i = 0; i < 4; ++i) w[i] += at.y[i];
  return w;
}

/// w·w − ρ² x·x and its derivatives by x and y.
template <class Number>
Number evaluate(const Leg<Number>& leg, const Place<Number>& at, const Quaternion<Number>& w,
                std::span<Number> derivatives) {
  const auto& d = leg.difference;
  const auto turned = cross(w, leg.sum);
  const Number two(2.0);
  derivatives[0] = two * (w[1] * d[0] + w[2] * d[1] + w[3] * d[2] - leg.square * at.x[0]);
  for (std::size_t i = 0; i < 3; ++i)
    derivatives[1 + i] = Number{} - two * (d[i] * w[0] + turned[i] + leg.square * at.x[1 + i]);
  for (std::size_t i = 0; i < 4; ++i) derivatives[4 + i] = two * w[i];
  return dot(w, w) - leg.square * at.xx;
}

/// The equation x·y = 0.
template <class Number>
Number evaluate_study(const Place<Number>& at, std::span<Number> derivatives) {
  std::ranges::copy(at.y, derivatives.begin());
  std::ranges::copy(at.x, derivatives.begin() + 4);
  return dot(at.x, at.y);
}

/// The equations of six legs and of the quadric, and the plane patch·(x, y) = 1.
class PoseSystem final : public PolynomialSystem {
 public:
  PoseSystem(const std::array<Leg<Interval>, 6>& legs, const std::array<double, 8>& patch)
      : patch_(patch) {
    std::ranges::transform(legs, legs_.begin(), [](const Leg<Interval>& leg) {
      Leg<Rectangle> result{{}, {}, leg.square};
      std::ranges::copy(leg.difference, result.difference.begin());
      std::ranges::copy(leg.sum, result.sum.begin());
      return result;
    });
  }

  [[nodiscard]] std::size_t size() const noexcept override { return kUnknowns; }

  void enclose(std::span<const Rectangle> z, std::span<Rectangle> values,
               std::span<Rectangle> derivatives) const override {
    const Place<Rectangle> at(z);
    const auto row = [&](std::size_t i) { return derivatives.subspan(i * kUnknowns, kUnknowns); };
    for (std::size_t i = 0; i < legs_.size(); ++i)
      values[i] = evaluate<Rectangle>(legs_[i], at, w_of(legs_[i], at), row(i));
    values[6] = evaluate_study<Rectangle>(at, row(6));
    values[7] = Rectangle(-1.0);
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      row(7)[i] = Rectangle(patch_[i]);
      values[7] += z[i] * Rectangle(patch_[i]);
    }
  }

 private:
  std::array<Leg<Rectangle>, 6> legs_;
  std::array<double, 8> patch_;
};

/// A platform all of whose poses are known.
struct KnownPlatform {
  std::array<std::array<double, 3>, 6> base, platform;
  std::array<double, 6> length;
  std::span<const std::array<double, 7>> poses;
};

constexpr KnownPlatform kGeneral{dietmaier::kBase, dietmaier::kPlatform, dietmaier::kLength,
                                 dietmaier::kPoses};
constexpr KnownPlatform kPaired{paired_legs::kBase, paired_legs::kPlatform, paired_legs::kLength,
                                paired_legs::kPoses};

/// Legs that go from those of a known platform to the given ones.
class PoseHomotopy final : public Homotopy {
 public:
  PoseHomotopy(const KnownPlatform& known, const std::array<Leg<Interval>, 6>& legs) {
    for (std::size_t i = 0; i < 6; ++i) {
      const auto point = [](const std::array<double, 3>& p) {
        return std::array<Complex, 3>{{{p[0], 0}, {p[1], 0}, {p[2], 0}}};
      };
      start_[i] = leg_of(point(known.base[i]), point(known.platform[i]),
                         Complex(known.length[i] * known.length[i]));
      const auto change = [](Interval end, Complex start) { return Complex(mid(end)) - start; };
      for (std::size_t k = 0; k < 3; ++k) {
        change_[i].difference[k] = change(legs[i].difference[k], start_[i].difference[k]);
        change_[i].sum[k] = change(legs[i].sum[k], start_[i].sum[k]);
      }
      change_[i].square = change(legs[i].square, start_[i].square);
    }
  }

  [[nodiscard]] std::size_t unknowns() const noexcept override { return kUnknowns; }
  [[nodiscard]] std::span<const std::size_t> groups() const noexcept override { return kGroups; }

  void evaluate(std::span<const Complex> z, Complex s, std::span<Complex> values,
                std::span<Complex> derivatives, std::span<Complex> rates) const override {
    const Place<Complex> at(z);
    const auto row = [&](std::size_t i) { return derivatives.subspan(i * kUnknowns, kUnknowns); };
    for (std::size_t i = 0; i < 6; ++i) {
      const Leg<Complex> leg = leg_at(i, s);
      const Quaternion<Complex> w = w_of(leg, at);
      values[i] = detail::evaluate<Complex>(leg, at, w, row(i));
      rates[i] = Complex(2) * dot(w, offset_of(change_[i], at.x)) - change_[i].square * at.xx;
    }
    values[6] = evaluate_study<Complex>(at, row(6));
    rates[6] = {};
  }

 private:
  [[nodiscard]] Leg<Complex> leg_at(std::size_t i, Complex s) const {
    Leg<Complex> leg = start_[i];
    for (std::size_t k = 0; k < 3; ++k) {
      leg.difference[k] += s * change_[i].difference[k];
      leg.sum[k] += s * change_[i].sum[k];
    }
    leg.square += s * change_[i].square;
    return leg;
  }

  std::array<Leg<Complex>, 6> start_, change_;
};

std::array<Leg<Interval>, 6> scaled(const GoughLegs& legs, int exponent) {
  const auto scale = [&](Interval x) { return times_power_of_two(x, -exponent); };
  std::array<Leg<Interval>, 6> result;
  for (std::size_t i = 0; i < 6; ++i) {
    std::array<Interval, 3> a, b;
    std::ranges::transform(legs.base[i], a.begin(), scale);
    std::ranges::transform(legs.platform[i], b.begin(), scale);
    result[i] = leg_of(a, b, sqr(scale(legs.length[i])));
  }
  return result;
}

std::vector<Complex> start_of(const std::array<double, 7>& pose) {
  const Quaternion<double> t{0, pose[0], pose[1], pose[2]}, x{pose[3], pose[4], pose[5], pose[6]};
  std::vector<Complex> start;
  for (const auto& part : {x, t * x})
    for (const double number : part) start.emplace_back(number);
  return start;
}

/// No pose of a robot is in the plane at infinity of a patch that has nothing to do with it.
constexpr std::array<double, kUnknowns> kPatch{0.871, -0.533, 0.617, 0.749,
                                               0.291, -0.411, 0.367, 0.229};

/// x·x is not 0 in the box.
bool certain_pose(const RootBox& root) {
  const Rectangle square =
      dot<Rectangle>({root[0], root[1], root[2], root[3]}, {root[0], root[1], root[2], root[3]});
  return !contains_zero(square.re) || !contains_zero(square.im);
}

/// `is_back`: the root is the motion of the base as the platform sees it.
GoughPose pose_of(const RootBox& root, int exponent, bool is_back) {
  Quaternion<Interval> x, y;
  for (std::size_t i = 0; i < 4; ++i) x[i] = root[i].re, y[i] = root[4 + i].re;
  if (is_back) x = conj(x), y = conj(y);
  const Interval square = sqr(x[0]) + sqr(x[1]) + sqr(x[2]) + sqr(x[3]);
  const auto moved = [&](std::size_t i, std::size_t j, std::size_t k) {
    const Interval t = x[0] * y[i] - y[0] * x[i] + (x[j] * y[k] - x[k] * y[j]);
    return times_power_of_two(t / square, exponent);
  };
  const auto leading = std::ranges::find_if_not(x, contains_zero);
  const bool is_negative = leading != x.end() && certain_negative(*leading);
  const Interval norm = is_negative ? -sqrt(square) : sqrt(square);
  GoughPose pose{{}, {moved(1, 2, 3), moved(2, 3, 1), moved(3, 1, 2)}};
  std::ranges::transform(x, pose.rotation.begin(), [&](Interval part) { return part / norm; });
  return pose;
}

ApproxPose approx_pose_of(const RootBox& root, int exponent, bool is_back) {
  Quaternion<Complex> x, y;
  for (std::size_t i = 0; i < 4; ++i) x[i] = root.center[i], y[i] = root.center[4 + i];
  if (is_back) x = conj(x), y = conj(y);
  const Complex factor = Complex(std::ldexp(1.0, exponent)) * inverse(dot(x, x));
  const Quaternion<Complex> t = y * conj(x);
  return {factor * t[1], factor * t[2], factor * t[3], x[0], x[1], x[2], x[3]};
}

/// Legs in an order in which 0 and 1 have a point in common, 2 and 3, 4 and 5; nullopt: there is none.
std::optional<std::array<std::size_t, 6>> pairs_of(const std::array<std::size_t, 6>& points) {
  std::array<std::size_t, 6> order{0, 1, 2, 3, 4, 5};
  std::ranges::stable_sort(order, std::less<>(), [&](std::size_t leg) { return points[leg]; });
  const auto same = [&](std::size_t i) { return points[order[i]] == points[order[i + 1]]; };
  const bool is_paired = same(0) && !same(1) && same(2) && !same(3) && same(4);
  return is_paired ? std::optional(order) : std::nullopt;
}

/// A platform in the terms of a known one of its family.
struct Question {
  const KnownPlatform& known;
  GoughLegs legs;
  bool is_back = false;  ///< base and platform have changed places
};

Question question_of(const GoughLegs& legs) {
  const auto at_platform = pairs_of(legs.platform_point), at_base = pairs_of(legs.base_point);
  if (!at_platform && !at_base) return {kGeneral, legs};
  Question question{kPaired, {}, !at_platform};
  const auto& order = at_platform ? *at_platform : *at_base;
  for (std::size_t i = 0; i < 6; ++i) {
    question.legs.base[i] = at_platform ? legs.base[order[i]] : legs.platform[order[i]];
    question.legs.platform[i] = at_platform ? legs.platform[order[i]] : legs.base[order[i]];
    question.legs.length[i] = legs.length[order[i]];
  }
  return question;
}

}  // namespace

int exponent_of_size(const GoughLegs& legs) {
  double size = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    size = std::max(size, mag(legs.length[i]));
    for (std::size_t k = 0; k < 3; ++k)
      size = std::max({size, mag(legs.base[i][k]), mag(legs.platform[i][k])});
  }
  return std::isfinite(size) && size > 0 ? std::ilogb(size) : 0;
}

std::array<Interval, 9> rotation_matrix(const std::array<Interval, 4>& q) {
  const Interval two(2.0), one(1.0);
  return {one - two * (sqr(q[2]) + sqr(q[3])), two * (q[1] * q[2] - q[0] * q[3]),
          two * (q[1] * q[3] + q[0] * q[2]),   two * (q[1] * q[2] + q[0] * q[3]),
          one - two * (sqr(q[1]) + sqr(q[3])), two * (q[2] * q[3] - q[0] * q[1]),
          two * (q[1] * q[3] - q[0] * q[2]),   two * (q[2] * q[3] + q[0] * q[1]),
          one - two * (sqr(q[1]) + sqr(q[2]))};
}

GoughPoses find_gough_poses(const GoughLegs& given) {
  const Question question = question_of(given);
  const int exponent = exponent_of_size(question.legs);
  const std::array<Leg<Interval>, 6> legs = scaled(question.legs, exponent);
  const PoseSystem system(legs, kPatch);
  const PoseHomotopy homotopy(question.known, legs);
  std::vector<std::vector<Complex>> starts;
  for (const auto& pose : question.known.poses) starts.push_back(start_of(pose));
  const std::vector<RootBox> roots = follow_roots(homotopy, starts, {system, kPatch, certain_pose});
  GoughPoses found{{}, {}, roots.size(), starts.size()};
  for (const RootBox& root : roots) {
    found.approx.push_back(approx_pose_of(root, exponent, question.is_back));
    if (root.is_real) found.poses.push_back(pose_of(root, exponent, question.is_back));
  }
  return found;
}

}  // namespace regulus::detail
