// SPDX-License-Identifier: Apache-2.0
#include "runtime/solutions/arm_postures.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/solutions/manocha_canny.hpp"
#include "runtime/solutions/path_tracker.hpp"
#include "runtime/solutions/root_list.hpp"

namespace regulus::detail {

namespace {

constexpr std::size_t kJoints = 6, kUnknowns = 12;
/// (u, v) of each joint
constexpr std::array<std::size_t, kJoints> kGroups{2, 2, 2, 2, 2, 2};
/// The plane patch·(u, v) = 1 of each joint, which has nothing to do with any robot.
constexpr std::array<double, kUnknowns> kPatch{0.617, 0.749, -0.533, 0.871, 0.411, 0.683,
                                               0.829, 0.367, -0.291, 0.773, 0.719, -0.457};

template <class Number>
using Links = std::array<DualQuaternion<Number>, kJoints>;

template <class Number>
std::array<Number, 6> closure_of(const DualQuaternion<Number>& loop) {
  return {loop.x[1], loop.x[2], loop.x[3], loop.y[1], loop.y[2], loop.y[3]};
}

template <class Number>
DualQuaternion<Number> unit() {
  return {{Number(1.0), Number(0.0), Number(0.0), Number(0.0)}, {}};
}

/// The product of a loop and of its parts.
template <class Number>
class Loop {
 public:
  Loop(const Links<Number>& links, std::span<const Number> z) : links_(links) {
    DualQuaternion<Number> after = unit<Number>();
    for (std::size_t i = kJoints; i-- > 0;) {
      after_[i] = after;
      rest_[i] = links[i] * after;
      after = turned(z[2 * i], z[2 * i + 1], rest_[i]);
    }
    whole_ = after;
    DualQuaternion<Number> before = unit<Number>();
    for (std::size_t i = 0; i < kJoints; ++i) {
      before_[i] = before;
      turn_[i] = before * turned(z[2 * i], z[2 * i + 1], unit<Number>());
      before = turn_[i] * links[i];
    }
  }

  void evaluate(std::span<Number> values, std::span<Number> derivatives) const {
    const auto closure = closure_of(whole_);
    std::ranges::copy(closure, values.begin());
    std::ranges::fill(derivatives.first(6 * kUnknowns), Number(0.0));
    for (std::size_t i = 0; i < kJoints; ++i) {
      const auto by_u = closure_of(before_[i] * turned(Number(1.0), Number(0.0), rest_[i]));
      const auto by_v = closure_of(before_[i] * rest_[i]);
      for (std::size_t row = 0; row < 6; ++row) {
        derivatives[row * kUnknowns + 2 * i] = by_u[row];
        derivatives[row * kUnknowns + 2 * i + 1] = by_v[row];
      }
    }
  }

  /// The derivative of the product where links change at these rates.
  [[nodiscard]] std::array<Number, 6> rates(const Links<Number>& changes) const {
    DualQuaternion<Number> sum;
    for (std::size_t i = 0; i < kJoints; ++i) sum = sum + turn_[i] * changes[i] * after_[i];
    return closure_of(sum);
  }

 private:
  const Links<Number>& links_;
  /// What comes before joint i; that and its turn; the links after it; its link and those.
  Links<Number> before_, turn_, after_, rest_;
  DualQuaternion<Number> whole_;
};

class PostureSystem final : public PolynomialSystem {
 public:
  explicit PostureSystem(const Links<Interval>& links) {
    for (std::size_t i = 0; i < kJoints; ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        links_[i].x[k] = Rectangle(links[i].x[k]);
        links_[i].y[k] = Rectangle(links[i].y[k]);
      }
  }

  [[nodiscard]] std::size_t size() const noexcept override { return kUnknowns; }

  void enclose(std::span<const Rectangle> z, std::span<Rectangle> values,
               std::span<Rectangle> derivatives) const override {
    Loop<Rectangle>(links_, z).evaluate(values, derivatives);
    const auto planes = derivatives.subspan(6 * kUnknowns);
    std::ranges::fill(planes, Rectangle());
    for (std::size_t i = 0; i < kJoints; ++i) {
      values[6 + i] = Rectangle(-1.0);
      for (std::size_t k = 2 * i; k < 2 * i + 2; ++k) {
        planes[i * kUnknowns + k] = Rectangle(kPatch[k]);
        values[6 + i] += z[k] * Rectangle(kPatch[k]);
      }
    }
  }

 private:
  Links<Rectangle> links_;
};

/// Links that go from those of Manocha and Canny to the given ones: x and t of each along a line.
class PostureHomotopy final : public Homotopy {
 public:
  explicit PostureHomotopy(const Links<Interval>& links) {
    for (std::size_t i = 0; i < kJoints; ++i) {
      using namespace manocha_canny;
      const double half = kTwist[i] / 2;
      turn_[i] = {Complex(std::cos(half)), Complex(std::sin(half)), Complex(), Complex()};
      shift_[i] = {Complex(), Complex(kShift[i]), Complex(-std::sin(kTwist[i]) * kOffset[i]),
                   Complex(std::cos(kTwist[i]) * kOffset[i])};
      Quaternion<Complex> x, y;
      for (std::size_t k = 0; k < 4; ++k)
        x[k] = Complex(mid(links[i].x[k])), y[k] = Complex(mid(links[i].y[k]));
      const double square = dot(x, x).re;
      const Quaternion<Complex> t = y * conj(x);
      const double size = std::copysign(std::sqrt(square), dot(x, turn_[i]).re);
      for (std::size_t k = 0; k < 4; ++k) {
        turn_change_[i][k] = x[k] * Complex(1 / size) - turn_[i][k];
        shift_change_[i][k] = t[k] * Complex(1 / square) - shift_[i][k];
      }
    }
  }

  [[nodiscard]] std::size_t unknowns() const noexcept override { return kUnknowns; }
  [[nodiscard]] std::span<const std::size_t> groups() const noexcept override { return kGroups; }

  void evaluate(std::span<const Complex> z, Complex s, std::span<Complex> values,
                std::span<Complex> derivatives, std::span<Complex> rates) const override {
    Links<Complex> links, changes;
    for (std::size_t i = 0; i < kJoints; ++i) {
      const Quaternion<Complex> x = at(turn_[i], turn_change_[i], s);
      const Quaternion<Complex> t = at(shift_[i], shift_change_[i], s);
      links[i] = {x, t * x};
      changes[i] = {turn_change_[i], shift_change_[i] * x + t * turn_change_[i]};
    }
    const Loop<Complex> loop(links, z);
    loop.evaluate(values, derivatives);
    std::ranges::copy(loop.rates(changes), rates.begin());
  }

 private:
  static Quaternion<Complex> at(const Quaternion<Complex>& start, const Quaternion<Complex>& change,
                                Complex s) {
    Quaternion<Complex> result = start;
    for (std::size_t k = 0; k < 4; ++k) result[k] += s * change[k];
    return result;
  }

  std::array<Quaternion<Complex>, kJoints> turn_, turn_change_, shift_, shift_change_;
};

/// Encloses x, up to a factor, of a rotation: the column of xxᵀ with the largest diagonal entry.
Quaternion<Interval> quaternion_of(const std::array<Interval, 9>& R) {
  const Interval one(1.0);
  const std::array<Quaternion<Interval>, 4> columns{
      {{one + R[0] + R[4] + R[8], R[7] - R[5], R[2] - R[6], R[3] - R[1]},
       {R[7] - R[5], one + R[0] - R[4] - R[8], R[1] + R[3], R[2] + R[6]},
       {R[2] - R[6], R[1] + R[3], one - R[0] + R[4] - R[8], R[5] + R[7]},
       {R[3] - R[1], R[2] + R[6], R[5] + R[7], one - R[0] - R[4] + R[8]}}};
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (mid(columns[i][i]) > mid(columns[best][best])) best = i;
  return columns[best];
}

DualQuaternion<Interval> dual_of(const RigidMotion& motion, int exponent) {
  const Quaternion<Interval> x = quaternion_of(motion.rotation);
  Quaternion<Interval> t{Interval(0.0)};
  for (std::size_t k = 0; k < 3; ++k) t[1 + k] = times_power_of_two(motion.position[k], -exponent);
  return {x, t * x};
}

/// A rotation that turns z to an axis, up to a factor: to a by 1 + a·z and z × a; or x after −a.
Quaternion<Interval> turn_to(const std::array<Interval, 3>& a) {
  const Interval one(1.0), zero(0.0);
  if (mid(a[2]) > -0.5) return {one + a[2], -a[1], a[0], zero};
  const Quaternion<Interval> opposite{one - a[2], a[1], -a[0], zero};
  return opposite * Quaternion<Interval>{zero, one, zero, zero};
}

int exponent_of_size(const ArmToEnd& arm) {
  double size = 0;
  const auto add = [&](const RigidMotion& motion) {
    for (const Interval x : motion.position) size = std::max(size, mag(x));
  };
  for (const TurningJoint& joint : arm.joints) add(joint.origin);
  add(arm.end);
  return std::isfinite(size) && size > 0 ? std::ilogb(size) : 0;
}

/// The links between joints that turn about z.
Links<Interval> links_of(const ArmToEnd& arm) {
  const int exponent = exponent_of_size(arm);
  std::array<DualQuaternion<Interval>, kJoints> turns, origins;
  for (std::size_t i = 0; i < kJoints; ++i) {
    turns[i].x = turn_to(arm.joints[i].axis);
    origins[i] = dual_of(arm.joints[i].origin, exponent);
  }
  Links<Interval> links;
  for (std::size_t i = 0; i < kJoints; ++i) {
    const std::size_t next = (i + 1) % kJoints;
    DualQuaternion<Interval> link = origins[next] * turns[next];
    if (next == 0) link = conj(dual_of(arm.end, exponent)) * link;
    links[i] = conj(turns[i]) * link;
  }
  return links;
}

std::vector<Complex> start_of(const std::array<double, kJoints>& angles) {
  std::vector<Complex> start;
  for (const double angle : angles) {
    start.emplace_back(std::sin(angle / 2));
    start.emplace_back(std::cos(angle / 2));
  }
  return start;
}

/// u² + v² is not 0 for any joint.
bool certain_posture(const RootBox& root) {
  for (std::size_t i = 0; i < kUnknowns; i += 2) {
    const Rectangle square = root[i] * root[i] + root[i + 1] * root[i + 1];
    if (contains_zero(square.re) && contains_zero(square.im)) return false;
  }
  return true;
}

/// 2·arctan(u/v)
Interval angle_of(Interval u, Interval v) {
  const Interval two(2.0);
  if (std::abs(mid(v)) >= std::abs(mid(u))) return two * atan(u / v);
  const Interval rest = two * atan(v / u);
  return (mid(v) / mid(u) >= 0 ? kPi : -kPi) - rest;
}

PostureAngles posture_of(const RootBox& root) {
  PostureAngles angles;
  for (std::size_t i = 0; i < kJoints; ++i)
    angles[i] = angle_of(root[2 * i].re, root[2 * i + 1].re);
  return angles;
}

}  // namespace

ArmPostures find_arm_postures(const ArmToEnd& arm) {
  const Links<Interval> links = links_of(arm);
  const PostureSystem system(links);
  const PostureHomotopy homotopy(links);
  std::vector<std::vector<Complex>> starts;
  for (const auto& angles : manocha_canny::kPostures) starts.push_back(start_of(angles));
  const std::vector<RootBox> roots =
      follow_roots(homotopy, starts, {system, kPatch, certain_posture});
  ArmPostures found{{}, roots.size()};
  for (const RootBox& root : roots)
    if (root.is_real) found.postures.push_back(posture_of(root));
  return found;
}

}  // namespace regulus::detail
