// SPDX-License-Identifier: GPL-3.0-or-later
// Platforms, of special geometry too, with planted poses. A resultant counts those
// of planar platforms; of others Newton's method looks for more, from many places.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/attack/families/families.hpp"
#include "tests/attack/families/found_places.hpp"
#include "tests/attack/oracle/newton.hpp"
#include "tests/attack/oracle/planar_count.hpp"

namespace regulus::detail::attack {
namespace {

// Planar platforms.

PlanarPlatform planar_geometry(Builder& b) {
  PlanarPlatform robot;
  for (auto* points : {&robot.base, &robot.platform})
    for (auto& point : *points) point = {eighths(b), eighths(b)};
  switch (b.random.below(6)) {
    case 0:  // legs that meet at the platform
      robot.platform[2] = robot.platform[1];
      break;
    case 1:  // on lines
      for (std::size_t i = 0; i < 3; ++i) robot.base[i][1] = robot.platform[i][1] = Rational(0);
      break;
    case 2:  // similar triangles
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 2; ++k) robot.platform[i][k] = robot.base[i][k] / Rational(3);
      break;
    case 3:  // mirrored triangles
      for (std::size_t i = 0; i < 3; ++i) robot.platform[i] = {-robot.base[i][0], robot.base[i][1]};
      break;
    default:
      break;
  }
  return robot;
}

// Platforms in space.

struct SixLegs {
  std::array<std::array<Rational, 3>, 6> base, platform;
  double anchors[2][6][3] = {};  ///< of the base and the platform
  bool is_planar = false;        ///< both lie in a plane z = 0
  bool is_architecturally_singular = false;
};

SixLegs leg_geometry(Builder& b) {
  SixLegs legs;
  for (auto* points : {&legs.base, &legs.platform})
    for (auto& point : *points) point = {eighths(b), eighths(b), eighths(b)};
  const std::size_t kind = b.random.below(8);
  if (kind >= 2 && kind <= 5) {
    legs.is_planar = true;
    for (auto* points : {&legs.base, &legs.platform})
      for (auto& point : *points) point[2] = Rational(0);
  }
  if (kind == 3)  // similar hexagons on circles
    for (std::size_t i = 0; i < 6; ++i) {
      const Rational t(b.random.between(-20, 20), 7), one(1), norm = one + t * t;
      legs.base[i] = {Rational(4) * (one - t * t) / norm, Rational(8) * t / norm, Rational(0)};
      for (std::size_t k = 0; k < 2; ++k) legs.platform[i][k] = legs.base[i][k] / Rational(2);
    }
  legs.is_architecturally_singular = kind == 3;
  if (kind == 4 || kind == 6)  // legs that meet in pairs
    for (std::size_t i = 0; i < 6; i += 2) {
      legs.base[(i + 1) % 6] = legs.base[i];
      legs.platform[(i + 2) % 6] = legs.platform[i + 1];
    }
  if (kind == 5)  // mirror symmetric
    for (std::size_t i = 0; i < 3; ++i)
      for (auto* points : {&legs.base, &legs.platform}) {
        (*points)[5 - i] = (*points)[i];
        (*points)[5 - i][0] = -(*points)[i][0];
      }
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      legs.anchors[0][i][k] = number_of(legs.base[i][k]);
      legs.anchors[1][i][k] = number_of(legs.platform[i][k]);
    }
  return legs;
}

/// The square of each length at a place and a unit quaternion; the last number is |q|².
Numbers squares_at(const SixLegs& legs, const Numbers& at) {
  const double w = at[3], x = at[4], y = at[5], z = at[6];
  const double R[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                          {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                          {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  Numbers squares;
  for (std::size_t leg = 0; leg < 6; ++leg) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      double part = at[i] - legs.anchors[0][leg][i];
      for (std::size_t j = 0; j < 3; ++j) part += R[i][j] * legs.anchors[1][leg][j];
      sum += part * part;
    }
    squares.push_back(sum);
  }
  squares.push_back(w * w + x * x + y * y + z * z);
  return squares;
}

const std::vector<std::string> kPose = {"x", "y", "z", "qw", "qx", "qy", "qz"};

std::string anchors_text(const std::array<std::array<Rational, 3>, 6>& points) {
  std::string text;
  for (const auto& p : points)
    text += (text.empty() ? "" : ", ") + numbers_text({p[0], p[1], p[2]});
  return "[" + text + "]";
}

void look_for_poses(Builder& b, const SixLegs& legs, const Numbers& planted, SolveTruth& truth) {
  constexpr int kStarts = 40;
  const Numbers wanted = squares_at(legs, planted);
  const Residual residual = [&](const Numbers& at) {
    Numbers r = squares_at(legs, at);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= wanted[i];
    return r;
  };
  double reach = 1;
  for (const double square : wanted) reach = std::fmax(reach, std::sqrt(square));
  for (int i = 0; i < kStarts; ++i) {
    Numbers start;
    for (int k = 0; k < 3; ++k) start.push_back(uniform(b, -reach, reach));
    double norm = 0;
    for (int k = 0; k < 4; ++k)
      start.push_back(uniform(b, -1, 1)), norm += start.back() * start.back();
    for (std::size_t k = 3; k < 7; ++k) start[k] /= std::sqrt(norm);
    const auto root = newton_root(residual, start);
    if (!root) continue;
    std::map<std::string, double> one, opposite;
    for (std::size_t k = 0; k < 7; ++k) {
      one[kPose[k]] = (*root)[k];
      opposite[kPose[k]] = (k < 3 ? 1 : -1) * (*root)[k];
    }
    if (!is_among(truth.near, one, {}) && !is_among(truth.near, opposite, {}))
      truth.near.push_back(std::move(one));
  }
}

/// From one that is as good as none to one within which poses meet.
std::string tolerance_text(Builder& b) { return "1e-" + std::to_string(b.random.between(2, 9)); }

}  // namespace

Attack solved_planar_platform(std::uint64_t seed) {
  Builder b("solve_planar", seed);
  PlanarPlatform robot = planar_geometry(b);
  const Rational one(1), two(2), x = eighths(b), y = eighths(b);
  Rational t(b.random.between(-12, 12), static_cast<unsigned long>(b.random.between(1, 8)));
  const bool is_carried = b.random.one_in(10);  // parallel legs of one length carry it on a circle
  if (is_carried) robot.platform = robot.base, t = Rational(0);
  const Rational norm = one + t * t, c = (one - t * t) / norm, s = two * t / norm;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [bx, by] = robot.platform[i];
    const Rational dx = x + c * bx - s * by - robot.base[i][0];
    const Rational dy = y + s * bx + c * by - robot.base[i][1];
    robot.squares[i] = dx * dx + dy * dy;
  }
  SolveTruth truth;
  truth.known.push_back({{"x", x}, {"y", y}, {"phi", Value(two) * call("atan", t, Value())}});
  truth.periods["phi"] = "2*pi";
  const PlanarCount count = count_planar_poses(robot);
  truth.count = count.poses;
  truth.is_degenerate = count.is_multiple || (is_carried && !robot.squares[0].is_zero());
  // The planted poses lie in the tubes of the list, too, and are as many.
  const bool varies = b.random.one_in(3);
  std::string text = "regulus = 1\nname = \"planar\"\n\n[legs]\n", lengths;
  if (varies) text += "platform_tolerance = " + tolerance_text(b) + "\n";
  for (std::size_t i = 0; i < 3; ++i) {
    text += "\n[[legs.leg]]\ntype = \"RPR\"\nbase = " +
            numbers_text({robot.base[i][0], robot.base[i][1]}) +
            "\nplatform = " + numbers_text({robot.platform[i][0], robot.platform[i][1]}) + "\n";
    lengths += (i == 0 ? "" : ", ") + quoted("sqrt(" + robot.squares[i].fraction() + ")");
    const std::string index = std::to_string(i);
    truth.equations.push_back(
        "(x + (" + robot.platform[i][0].fraction() + ")*cos(phi) - (" +
        robot.platform[i][1].fraction() + ")*sin(phi) - (" + robot.base[i][0].fraction() +
        "))^2 + (y + (" + robot.platform[i][0].fraction() + ")*sin(phi) + (" +
        robot.platform[i][1].fraction() + ")*cos(phi) - (" + robot.base[i][1].fraction() +
        "))^2 - (" + robot.squares[i].fraction() + ")");
  }
  text += "\n[motion.m]\n";
  text += b.coin() ? "legs = [" + lengths + "]\n"
                   : "x = " + quoted(x.fraction()) + "\ny = " + quoted(y.fraction()) +
                         "\nphi = " + quoted("2*atan(" + t.fraction() + ")") + "\n";
  b.attack.model.instead = text;
  b.attack.decidable = count.poses.has_value() && !count.is_multiple && !varies;
  b.attack.solve = std::move(truth);
  state_mechanism(b, "a pose is planted, and a resultant counts them");
  return b.finish();
}

Attack solved_hexapod(std::uint64_t seed) {
  Builder b("solve_hexapod", seed);
  const SixLegs legs = leg_geometry(b);
  SolveTruth truth;
  truth.has_opposites = true;
  truth.is_degenerate = legs.is_architecturally_singular;
  Solution known;
  Numbers planted;
  std::string motion;
  std::vector<Rational> place = {eighths(b), eighths(b), Rational(b.random.between(8, 64), 8)};
  for (std::size_t k = 0; k < 3; ++k) {
    known[kPose[k]] = place[k];
    planted.push_back(number_of(place[k]));
    motion += kPose[k] + " = " + quoted(place[k].fraction()) + "\n";
  }
  // Rz(ψ)·Rx(θ)·Rz(φ).
  std::vector<Rational> angles;
  for (const char* angle : {"psi", "theta", "phi"}) {
    angles.emplace_back(b.random.between(-24, 24), 16);
    motion += std::string(angle) + " = " + quoted(angles.back().fraction()) + "\n";
  }
  const Value half = Rational(1, 2), sum = Value(angles[0] + angles[2]) * half,
              gap = Value(angles[0] - angles[2]) * half, tilt = Value(angles[1]) * half;
  const auto cosine = [](const Value& x) { return call("cos", x, Value()); };
  const auto sine = [](const Value& x) { return call("sin", x, Value()); };
  known["qw"] = cosine(tilt) * cosine(sum);
  known["qx"] = sine(tilt) * cosine(gap);
  known["qy"] = sine(tilt) * sine(gap);
  known["qz"] = cosine(tilt) * sine(sum);
  for (std::size_t k = 3; k < 7; ++k)
    planted.push_back(arf_get_d(arb_midref(known[kPose[k]].ball()), ARF_RND_NEAR));
  truth.known.push_back(known);
  if (legs.is_planar) {  // mirrored in the plane of the base
    const Value minus = Rational(-1);
    for (const char* name : {"z", "qx", "qy"}) known[name] = minus * known[name];
    truth.known.push_back(known);
  }
  if (!legs.is_architecturally_singular) look_for_poses(b, legs, planted, truth);
  // The planted poses lie in the tubes of the list, too.
  const bool varies = b.random.one_in(3);
  const std::string tolerance = varies ? tolerance_text(b) : "";
  b.attack.model.instead =
      "regulus = 1\nname = \"legs\"\n\n[gough]\norientation = \"euler-zxz\"\nbase = " +
      anchors_text(legs.base) + "\nplatform = " + anchors_text(legs.platform) + "\n" +
      (varies ? "base_tolerance = " + tolerance + "\n" : "") + "\n[motion.m]\n" + motion +
      (varies ? "error = { z = " + tolerance + ", theta = " + tolerance + " }\n" : "");
  b.attack.solve = std::move(truth);
  state_mechanism(b, "a pose is planted, and Newton's method finds others");
  return b.finish();
}

}  // namespace regulus::detail::attack
