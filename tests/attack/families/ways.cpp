// SPDX-License-Identifier: GPL-3.0-or-later
// Way-points in the plane, and a determinant that vanishes beside one of them, or between two.
#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

/// The function a·x + c·y.
struct Slope {
  Rational a, c;
  [[nodiscard]] Rational at(const std::vector<Rational>& p) const { return a * p[0] + c * p[1]; }
  [[nodiscard]] std::string minus(Builder& b, const Rational& level) const {
    return b.text(a) + "*x + " + b.text(c) + "*y - " + b.text(level);
  }
};

/// Way-points with different values of the function one after the other.
std::vector<std::vector<Rational>> different_points(Builder& b, const Slope& slope) {
  std::vector<std::vector<Rational>> points;
  for (long count = b.random.between(2, 6); count > 0;) {
    const std::vector<Rational> next{Rational(b.random.between(-400, 400), 64),
                                     Rational(b.random.between(-4000, 4000), 1000)};
    if (!points.empty() &&
        (slope.at(next) - slope.at(points.back())).magnitude() < Rational(1, 1000))
      continue;
    points.push_back(next);
    --count;
  }
  return points;
}

std::size_t index_of_least(const std::vector<std::vector<Rational>>& points, const Slope& slope) {
  std::size_t least = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (slope.at(points[i]) < slope.at(points[least])) least = i;
  return least;
}

/// The pose goes from one point to another while s goes from 0 to 1.
void pose_between(Builder& b, const std::vector<Rational>& from, const std::vector<Rational>& to) {
  b.attack.axes.push_back({"s", 0, 1});
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string name = i == 0 ? "x" : "y";
    b.attack.model.pose.push_back(
        {name, "", b.text(from[i]) + " + " + b.text(to[i] - from[i]) + "*s"});
    b.mention(name);
  }
}

}  // namespace

Attack way(std::uint64_t seed) {
  Builder b("way", seed);
  const Slope slope{b.number(), b.number()};
  const auto points = different_points(b, slope);
  const std::size_t least = index_of_least(points, slope);
  const std::size_t beside = least + 1 < points.size() ? least + 1 : least - 1;
  pose_between(b, points[least], points[beside]);
  b.follow(points);
  const Rational low = slope.at(points[least]), rise = slope.at(points[beside]) - low;
  if (b.random.one_in(3)) {  // a square that is touched in the middle of a segment
    const Rational s(b.random.between(1, 7), 8), m = b.coin() ? Rational(0) : b.margin(60);
    b.hide("(" + slope.minus(b, low + s * rise) + ")^2 + " + b.text(m));
    b.decide(m, {{"s", b.text(s)}});
    b.attack.argument = "a square that is 0 on one segment, plus a margin or not";
    return b.finish();
  }
  Rational error(0);
  if (b.coin()) {
    error = Rational(b.random.between(1, 9), 1000);
    b.error("x", error);
  }
  const Rational excess = b.excess(60), reached = low - slope.a.magnitude() * error;
  b.hide(slope.minus(b, reached - excess));
  Planted at{{"s", b.text(excess.sign() < 0 ? -excess / rise : Rational(0))}};
  if (!error.is_zero()) at["x_error"] = b.text(slope.a.sign() > 0 ? -error : error);
  b.decide(excess, at);
  b.attack.argument = "linear, least at one way-point";
  return b.finish();
}

}  // namespace regulus::detail::attack
