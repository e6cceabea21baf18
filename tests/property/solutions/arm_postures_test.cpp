// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/solutions/arm_postures.hpp"

#include <gtest/gtest.h>

#include "runtime/existence/branch_tube.hpp"
#include "runtime/solutions/manocha_canny.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {
namespace {

template <class Number>
using Vector = std::array<Number, 3>;
template <class Number>
using Rotation = std::array<Number, 9>;

template <class Number>
Vector<Number> times(const Rotation<Number>& R, const Vector<Number>& v) {
  Vector<Number> result{};
  for (std::size_t k = 0; k < 9; ++k) result[k / 3] += R[k] * v[k % 3];
  return result;
}

template <class Number>
Rotation<Number> times(const Rotation<Number>& A, const Rotation<Number>& B) {
  Rotation<Number> result{};
  for (std::size_t k = 0; k < 27; ++k)
    result[k / 9 * 3 + k % 3] += A[k / 3] * B[k / 3 % 3 * 3 + k % 3];
  return result;
}

/// Rodrigues' formula.
template <class Number>
Rotation<Number> turn_about(const Vector<Number>& a, Number angle) {
  using std::cos, std::sin;
  const Number c = cos(angle), s = sin(angle), one(1.0);
  Rotation<Number> R;
  for (std::size_t k = 0; k < 9; ++k)
    R[k] = (one - c) * a[k / 3] * a[k % 3] + (k % 4 == 0 ? c : Number(0.0));
  R[1] -= s * a[2], R[2] += s * a[1], R[3] += s * a[2];
  R[5] -= s * a[0], R[6] -= s * a[1], R[7] += s * a[0];
  return R;
}

template <class Number>
struct Joint {
  Rotation<Number> rotation;
  Vector<Number> position, axis;
};

/// Six joints that turn, by rotation matrices, which the counting of postures does not use.
template <class Number>
struct Chain {
  std::array<Joint<Number>, 6> joints;

  struct End {
    Rotation<Number> rotation;
    Vector<Number> position;
    std::array<Vector<Number>, 6> axes, origins;
  };

  [[nodiscard]] End at(const std::array<Number, 6>& angles) const {
    const Number zero(0.0), one(1.0);
    End end{{one, zero, zero, zero, one, zero, zero, zero, one}, {}, {}, {}};
    for (std::size_t i = 0; i < 6; ++i) {
      const auto shift = times(end.rotation, joints[i].position);
      for (std::size_t k = 0; k < 3; ++k) end.position[k] += shift[k];
      end.rotation = times(end.rotation, joints[i].rotation);
      end.axes[i] = times(end.rotation, joints[i].axis);
      end.origins[i] = end.position;
      end.rotation = times(end.rotation, turn_about(joints[i].axis, angles[i]));
    }
    return end;
  }
};

using Angles = std::array<double, 6>;

Chain<double> random_chain(RandomSource& random) {
  Chain<double> chain;
  const auto direction = [&] {
    Vector<double> v{};
    double square = 0;
    for (double& x : v) x = random.between(-1, 1), square += x * x;
    for (double& x : v) x /= std::sqrt(square);
    return v;
  };
  for (Joint<double>& joint : chain.joints) {
    joint.rotation = turn_about(direction(), random.between(-3, 3));
    for (double& x : joint.position) x = random.between(-1, 1);
    joint.axis = direction();
  }
  return chain;
}

Angles random_angles(RandomSource& random) {
  Angles angles{};
  for (double& angle : angles) angle = random.between(-3.1, 3.1);
  return angles;
}

template <class Number>
ArmToEnd arm_of(const Chain<double>& chain, const typename Chain<Number>::End& end) {
  ArmToEnd arm;
  for (std::size_t i = 0; i < 6; ++i) {
    std::ranges::copy(chain.joints[i].rotation, arm.joints[i].origin.rotation.begin());
    std::ranges::copy(chain.joints[i].position, arm.joints[i].origin.position.begin());
    std::ranges::copy(chain.joints[i].axis, arm.joints[i].axis.begin());
  }
  std::ranges::copy(end.rotation, arm.end.rotation.begin());
  std::ranges::copy(end.position, arm.end.position.begin());
  return arm;
}

bool has_posture(const std::vector<PostureAngles>& postures, const Angles& angles,
                 double tolerance) {
  return std::ranges::any_of(postures, [&](const PostureAngles& known) {
    for (std::size_t i = 0; i < 6; ++i)
      if (std::abs(std::remainder(mid(known[i]) - angles[i], 2 * kPi.lo)) > tolerance) return false;
    return true;
  });
}

/// Six of the twelve differences between two frames; the others follow but for half turns.
Angles difference(const Chain<double>::End& is, const Chain<double>::End& to) {
  Rotation<double> back;
  for (std::size_t k = 0; k < 9; ++k) back[k] = to.rotation[k % 3 * 3 + k / 3];
  const Rotation<double> E = times(is.rotation, back);
  return {is.position[0] - to.position[0],
          is.position[1] - to.position[1],
          is.position[2] - to.position[2],
          (E[7] - E[5]) / 2,
          (E[2] - E[6]) / 2,
          (E[3] - E[1]) / 2};
}

/// The forward Jacobian at the end's position, row-major.
std::vector<double> jacobian(const Chain<double>::End& end) {
  std::vector<double> J(36);
  for (std::size_t i = 0; i < 6; ++i) {
    const Vector<double>& a = end.axes[i];
    Vector<double> r{};
    for (std::size_t k = 0; k < 3; ++k) r[k] = end.position[k] - end.origins[i][k];
    for (std::size_t k = 0; k < 3; ++k) {
      J[k * 6 + i] = a[(k + 1) % 3] * r[(k + 2) % 3] - a[(k + 2) % 3] * r[(k + 1) % 3];
      J[(k + 3) * 6 + i] = a[k];
    }
  }
  return J;
}

std::optional<Angles> newton(const Chain<double>& chain, const Chain<double>::End& to,
                             Angles angles) {
  for (int step = 0; step < 60; ++step) {
    const auto end = chain.at(angles);
    const Angles error = difference(end, to);
    if (std::ranges::all_of(error, [](double e) { return std::abs(e) < 1e-13; })) {
      double trace = 0;
      for (std::size_t k = 0; k < 9; ++k) trace += end.rotation[k] * to.rotation[k];
      return trace > 2.9 ? std::optional(angles) : std::nullopt;
    }
    const auto inverse = approx_inverse_of(jacobian(end), 6);
    if (!inverse) return std::nullopt;
    Angles by{};
    double largest = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t k = 0; k < 6; ++k) by[i] -= (*inverse)[i * 6 + k] * error[k];
      largest = std::max(largest, std::abs(by[i]));
    }
    for (std::size_t i = 0; i < 6; ++i) angles[i] += by[i] * std::min(1.0, 0.5 / largest);
  }
  return std::nullopt;
}

/// Each posture encloses one that leads to the end, as far as rotation matrices can tell.
void expect_end(const Chain<double>& chain, const Chain<double>::End& end,
                const std::vector<PostureAngles>& postures) {
  Chain<Interval> enclosed;
  for (std::size_t i = 0; i < 6; ++i) {
    std::ranges::copy(chain.joints[i].rotation, enclosed.joints[i].rotation.begin());
    std::ranges::copy(chain.joints[i].position, enclosed.joints[i].position.begin());
    std::ranges::copy(chain.joints[i].axis, enclosed.joints[i].axis.begin());
  }
  for (const PostureAngles& posture : postures) {
    const auto at = enclosed.at(posture);
    for (std::size_t k = 0; k < 9; ++k)
      EXPECT_FALSE(certain_disjoint(at.rotation[k], end.rotation[k] + Interval(-1e-12, 1e-12)));
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_FALSE(certain_disjoint(at.position[k], end.position[k] + Interval(-1e-12, 1e-12)));
      EXPECT_LT(width_ru(at.position[k]), 1e-3);
    }
  }
}

TEST(TheArmOfManochaAndCanny, HasSixteen) {
  using namespace manocha_canny;
  Chain<double> chain;
  Chain<double>::End end{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {}, {}, {}};
  for (std::size_t i = 0; i < 6; ++i) {
    const double c = std::cos(kTwist[i]), s = std::sin(kTwist[i]);
    const Rotation<double> rotation{1, 0, 0, 0, c, -s, 0, s, c};
    const Vector<double> position{kShift[i], -s * kOffset[i], c * kOffset[i]};
    chain.joints[(i + 1) % 6] = {rotation, position, {0, 0, 1}};
  }
  // The last link is before the first joint; the loop closes at the last joint.
  const ArmPostures found = find_arm_postures(arm_of<double>(chain, end));
  EXPECT_TRUE(found.is_complete());
  ASSERT_EQ(found.postures.size(), 16U);
  expect_end(chain, end, found.postures);
  for (const Angles& known : kPostures) EXPECT_TRUE(has_posture(found.postures, known, 1e-9));
}

TEST(ARandomArm, HasAllItsPosturesInTheList) {
  RandomSource random(1);
  int complete = 0;
  for (int round = 0; round < 20; ++round) {
    const Chain<double> chain = random_chain(random);
    const Angles planted = random_angles(random);
    const auto end = chain.at(planted);
    const ArmPostures found = find_arm_postures(arm_of<double>(chain, end));
    EXPECT_LE(found.complex, 16U);
    expect_end(chain, end, found.postures);
    if (!found.is_complete()) continue;
    ++complete;
    EXPECT_TRUE(has_posture(found.postures, planted, 1e-6));
    for (int start = 0; start < 100; ++start) {
      const auto other = newton(chain, end, random_angles(random));
      EXPECT_TRUE(!other || has_posture(found.postures, *other, 1e-5));
    }
  }
  EXPECT_GE(complete, 18);
}

/// An end that is uncertain, so that the arm can be singular there: two postures are one.
TEST(AnEndThatEnclosesADoublePosture, IsNeverComplete) {
  RandomSource random(2);
  int singular = 0;
  for (int round = 0; round < 10; ++round) {
    const Chain<double> chain = random_chain(random);
    Angles at = random_angles(random);
    const auto is_regular_sign = [&](double angle) {
      at[2] = angle;
      const auto inverse = approx_inverse_of(jacobian(chain.at(at)), 6);
      return inverse ? std::copysign(1.0, (*inverse)[0]) : 0.0;
    };
    // Where det changes its sign through 0, so does every entry of the inverse, through infinity.
    for (double left = -3; left < 3; left += 0.1) {
      double lo = left, hi = left + 0.1;
      const double before = is_regular_sign(lo);
      if (before == is_regular_sign(hi)) continue;
      while (hi - lo > 1e-9) {
        const double middle = (lo + hi) / 2;
        (is_regular_sign(middle) == before ? lo : hi) = middle;
      }
      is_regular_sign(lo);
      const auto inverse = approx_inverse_of(jacobian(chain.at(at)), 6);
      if (!inverse || std::abs((*inverse)[0]) < 1e4) continue;  // a zero of the entry
      ++singular;
      auto end = arm_of<double>(chain, chain.at(at));
      for (Interval& x : end.end.rotation) x += Interval(-1e-7, 1e-7);
      for (Interval& x : end.end.position) x += Interval(-1e-7, 1e-7);
      EXPECT_FALSE(find_arm_postures(end).is_complete());
      break;
    }
  }
  EXPECT_GE(singular, 4);
}

TEST(SpecialArms, AreNeverComplete) {
  RandomSource random(3);
  for (int round = 0; round < 4; ++round) {
    Chain<double> chain = random_chain(random);
    if (round % 2 == 0) {  // a spherical wrist
      chain.joints[4].position = chain.joints[5].position = {0, 0, 0};
    } else {  // three parallel axes
      for (std::size_t i : {2U, 3U}) {
        chain.joints[i].rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        chain.joints[i].axis = chain.joints[1].axis;
      }
    }
    const Angles planted = random_angles(random);
    const ArmPostures found = find_arm_postures(arm_of<double>(chain, chain.at(planted)));
    EXPECT_FALSE(found.is_complete());
    EXPECT_TRUE(has_posture(found.postures, planted, 1e-6));
  }
}

TEST(AnArmWithoutNumbers, IsNotComplete) {
  ArmToEnd arm;
  EXPECT_FALSE(find_arm_postures(arm).is_complete());
  for (TurningJoint& joint : arm.joints) {
    joint.origin.rotation.fill(kEntire);
    joint.axis.fill(kEntire);
  }
  EXPECT_FALSE(find_arm_postures(arm).is_complete());
}

}  // namespace
}  // namespace regulus::detail::test
