// SPDX-License-Identifier: GPL-3.0-or-later
// Arms, of special geometry too, with planted postures. Newton's method looks for more, from many places.
#include <functional>

#include "tests/attack/families/families.hpp"
#include "tests/attack/families/found_places.hpp"
#include "tests/attack/oracle/newton.hpp"

namespace regulus::detail::attack {
namespace {

struct DhJoint {
  Rational a, d;
  std::string alpha;
  double angle = 0;
  double sizes[2] = {0, 0};  ///< a and d
};

using Arm = std::array<DhJoint, 6>;

Arm arm_geometry(Builder& b) {
  const bool is_special = b.coin();
  Arm arm;
  for (DhJoint& joint : arm) {
    joint.a = is_special && b.coin() ? Rational(0) : Rational(b.random.between(1, 16), 16);
    joint.d = is_special && b.coin() ? Rational(0) : Rational(b.random.between(-16, 16), 16);
    if (is_special && b.random.below(4) != 0) {
      const std::size_t quarter = b.random.below(4);
      joint.alpha = std::array{"0", "pi/2", "-pi/2", "pi/2"}[quarter];
      joint.angle = std::array{0.0, 0.5, -0.5, 0.5}[quarter] * std::numbers::pi;
    } else if (b.random.one_in(4)) {  // a multiple of 18 degrees, whose sine may be a root
      const long tenths = b.random.between(-9, 9);
      joint.alpha = std::to_string(tenths) + "/10*pi";
      joint.angle = double(tenths) / 10 * std::numbers::pi;
    } else {
      const Rational alpha(b.random.between(-24, 24), 16);
      joint.alpha = alpha.fraction();
      joint.angle = number_of(alpha);
    }
  }
  if (b.random.one_in(3)) {  // a wrist whose axes meet
    arm[3].a = arm[4].a = arm[4].d = Rational(0);
    arm[3].alpha = "-pi/2", arm[3].angle = -std::numbers::pi / 2;
    arm[4].alpha = "pi/2", arm[4].angle = std::numbers::pi / 2;
  }
  for (DhJoint& joint : arm) {
    joint.sizes[0] = number_of(joint.a);
    joint.sizes[1] = number_of(joint.d);
  }
  return arm;
}

bool has_wrist(const Arm& arm) {
  return arm[3].a.is_zero() && arm[4].a.is_zero() && arm[4].d.is_zero() &&
         arm[3].alpha == "-pi/2" && arm[4].alpha == "pi/2";
}

/// The place and the axes of the end: twelve numbers.
Numbers end_of(const Arm& arm, const Numbers& q) {
  double T[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  for (std::size_t k = 0; k < 6; ++k) {
    const double c = std::cos(q[k]), s = std::sin(q[k]), ca = std::cos(arm[k].angle),
                 sa = std::sin(arm[k].angle), a = arm[k].sizes[0], d = arm[k].sizes[1];
    const double L[3][4] = {
        {c, -s * ca, s * sa, a * c}, {s, c * ca, -c * sa, a * s}, {0, sa, ca, d}};
    double R[3][4];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        R[i][j] = j == 3 ? T[i][3] : 0;
        for (std::size_t m = 0; m < 3; ++m) R[i][j] += T[i][m] * L[m][j];
      }
    std::copy(&R[0][0], &R[0][0] + 12, &T[0][0]);
  }
  return Numbers(&T[0][0], &T[0][0] + 12);
}

std::string joint_name(std::size_t joint) { return "q" + std::to_string(joint + 1); }

/// An arm whose lengths differ by up to 10^-digits.
Arm near_arm(Builder& b, Arm arm, long digits) {
  const Rational step = Rational::ten_to(-digits) * Rational(1, 8);
  for (DhJoint& joint : arm) {
    joint.sizes[0] = number_of(joint.a + Rational(b.random.between(-8, 8)) * step);
    joint.sizes[1] = number_of(joint.d + Rational(b.random.between(-8, 8)) * step);
  }
  return arm;
}

struct PlaceErrors {
  std::string text;      ///< the line of the motion; empty: there are none
  Numbers joints_there;  ///< values within them
};

/// Errors of some joints, which vary the place.
PlaceErrors place_errors(Builder& b, const Numbers& planted) {
  PlaceErrors errors{"", planted};
  if (!b.random.one_in(4)) return errors;
  for (std::size_t k = 0; k < 6; ++k) {
    if (b.coin()) continue;
    const Rational error = Rational::ten_to(-b.random.between(5, 10));
    errors.joints_there[k] += number_of(error * Rational(b.random.between(-8, 8)) * Rational(1, 8));
    errors.text += (errors.text.empty() ? "error = { " : ", ") + joint_name(k) + " = " +
                   quoted(error.fraction());
  }
  if (!errors.text.empty()) errors.text += " }\n";
  return errors;
}

void look_for_postures(Builder& b, const Arm& arm, const Numbers& wanted, SolveTruth& truth) {
  constexpr int kStarts = 60;
  std::vector<std::string> angles;
  for (std::size_t k = 0; k < 6; ++k) angles.push_back(joint_name(k));
  const Residual residual = [&](const Numbers& q) {
    Numbers r = end_of(arm, q);
    std::ranges::transform(r, wanted, r.begin(), std::minus());
    return r;
  };
  for (int i = 0; i < kStarts; ++i) {
    Numbers start(6);
    for (double& x : start) x = uniform(b, -std::numbers::pi, std::numbers::pi);
    const auto root = newton_root(residual, start);
    std::map<std::string, double> one;
    for (std::size_t k = 0; root && k < 6; ++k) one[joint_name(k)] = (*root)[k];
    if (root && !is_among(truth.near, one, angles)) truth.near.push_back(std::move(one));
  }
}

}  // namespace

Attack solved_arm(std::uint64_t seed) {
  Builder b("solve_arm", seed);
  const Arm arm = arm_geometry(b);
  SolveTruth truth;
  std::string joints, motion;
  Numbers planted;
  const bool is_stretched = has_wrist(arm) && b.random.one_in(6);
  Solution known;
  for (std::size_t k = 0; k < 6; ++k) {
    const Rational q =
        is_stretched && k == 4 ? Rational(0) : Rational(b.random.between(-48, 48), 16);
    planted.push_back(number_of(q));
    known[joint_name(k)] = q;
    truth.periods[joint_name(k)] = "2*pi";
    joints += "  { name = " + quoted(joint_name(k)) + ", a = " + quoted(arm[k].a.fraction()) +
              ", alpha = " + quoted(arm[k].alpha) + ", d = " + quoted(arm[k].d.fraction()) +
              " },\n";
    motion += joint_name(k) + " = " + quoted(q.fraction()) + "\n";
  }
  truth.known.push_back(std::move(known));
  truth.is_degenerate = is_stretched;  // the first and the last joint of the wrist turn alike
  // The postures of another arm within the tolerance, and at another place within the errors, lie in the tubes of the list,
  // too, and are as many.
  const bool varies = b.random.one_in(3);
  const long digits = b.random.between(2, 7);
  const PlaceErrors errors = place_errors(b, planted);
  look_for_postures(b, varies ? near_arm(b, arm, digits) : arm, end_of(arm, errors.joints_there),
                    truth);
  b.attack.model.instead =
      "regulus = 1\nname = \"arm\"\n\n[serial]\nconvention = \"standard-dh\"\n" +
      (varies ? "length_tolerance = 1e-" + std::to_string(digits) + "\n" : "") + "joints = [\n" +
      joints + "]\n\n[motion.m]\n" + motion + errors.text;
  b.attack.solve = std::move(truth);
  state_mechanism(b, "a posture is planted, and Newton's method finds others");
  return b.finish();
}

}  // namespace regulus::detail::attack
