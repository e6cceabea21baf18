// SPDX-License-Identifier: GPL-3.0-or-later
// Six-legged platforms whose singular poses are known.
#include <array>

#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

using Vector = std::array<Rational, 3>;
using Frame = std::array<Vector, 3>;  ///< a rotation, by rows

Vector operator+(const Vector& u, const Vector& v) {
  return {u[0] + v[0], u[1] + v[1], u[2] + v[2]};
}
Vector operator-(const Vector& u, const Vector& v) {
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
Rational dot(const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }
Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
Vector transposed_times(const Frame& r, const Vector& v) {
  Vector result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = r[0][i] * v[0] + r[1][i] * v[1] + r[2][i] * v[2];
  return result;
}

Rational small(Random& random, long most, unsigned long denominator = 4) {
  return Rational(random.between(-most, most), denominator);
}

/// An orientation with a rational rotation, and its values as a motion states them.
struct Orientation {
  std::string name;
  std::vector<std::pair<std::string, Rational>> parameters;
  Frame rotation;
};

Orientation rational_orientation(Random& random) {
  Orientation o;
  const auto angles = [&o](const char* name, std::array<const char*, 3> names) {
    o.name = name;
    for (const char* angle : names) o.parameters.push_back({angle, Rational(0)});
    o.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  };
  switch (random.below(3)) {
    case 0:
      angles("euler-zxz", {"psi", "theta", "phi"});
      return o;
    case 1:
      angles("roll-pitch-yaw", {"roll", "pitch", "yaw"});
      return o;
    default:
      break;
  }
  o.name = "quaternion";
  std::array<Rational, 4> q{Rational(1), small(random, 2, 3), small(random, 2, 3),
                            small(random, 2, 3)};
  const auto& [a, b, c, d] = q;
  const Rational n = a * a + b * b + c * c + d * d, two(2);
  o.rotation = {{{a * a + b * b - c * c - d * d, two * (b * c - a * d), two * (b * d + a * c)},
                 {two * (b * c + a * d), a * a - b * b + c * c - d * d, two * (c * d - a * b)},
                 {two * (b * d - a * c), two * (c * d + a * b), a * a - b * b - c * c + d * d}}};
  for (Vector& row : o.rotation)
    for (Rational& x : row) x = x / n;
  // A quaternion of any other norm is a rotation, too.
  const Rational length = random.one_in(3) ? Rational(random.between(1, 40), 4) : Rational(1);
  for (std::size_t i = 0; i < 4; ++i)
    o.parameters.push_back({"q" + std::to_string(i), length * q[i]});
  return o;
}

struct Legs {
  std::array<Vector, 6> base, platform;  ///< both in the reference frame, at the pose
};

/// Returns a vector that is orthogonal to five rows of six.
std::optional<std::array<Rational, 6>> null_vector(std::vector<std::array<Rational, 6>> rows) {
  std::vector<std::size_t> pivots;
  std::size_t free_column = 6;
  for (std::size_t column = 0, r = 0; column < 6; ++column) {
    std::size_t at = r;
    while (at < rows.size() && rows[at][column].is_zero()) ++at;
    if (at == rows.size()) {
      if (free_column != 6) return std::nullopt;
      free_column = column;
      continue;
    }
    std::swap(rows[r], rows[at]);
    const Rational pivot = rows[r][column];
    for (Rational& x : rows[r]) x = x / pivot;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Rational factor = rows[i][column];
      if (i == r || factor.is_zero()) continue;
      for (std::size_t j = 0; j < 6; ++j) rows[i][j] -= factor * rows[r][j];
    }
    pivots.push_back(column);
    ++r;
  }
  if (free_column == 6) return std::nullopt;
  std::array<Rational, 6> k;
  k[free_column] = Rational(1);
  for (std::size_t r = 0; r < pivots.size(); ++r) k[pivots[r]] = -rows[r][free_column];
  return k;
}

/// Moves the sixth leg into the linear complex of the other five: B·(v + w × A) = A·v.
bool make_dependent(Legs& legs, Random& random) {
  std::vector<std::array<Rational, 6>> rows;
  for (std::size_t i = 0; i < 5; ++i) {
    const Vector n = legs.platform[i] - legs.base[i], m = cross(legs.base[i], legs.platform[i]);
    rows.push_back({n[0], n[1], n[2], m[0], m[1], m[2]});
  }
  const auto k = null_vector(rows);
  if (!k) return false;
  const Vector v{(*k)[0], (*k)[1], (*k)[2]}, w{(*k)[3], (*k)[4], (*k)[5]};
  const Vector g = v + cross(w, legs.base[5]);
  const std::size_t solved = random.below(3);
  if (g[solved].is_zero()) return false;
  Vector& b = legs.platform[5];
  b[solved] = Rational(0);
  b[solved] = (dot(legs.base[5], v) - dot(b, g)) / g[solved];
  return b[solved].magnitude() < Rational(40) && dot(b - legs.base[5], b - legs.base[5]).sign() > 0;
}

Vector random_point(Random& random, long z) {
  return {small(random, 40), small(random, 40), Rational(z) + small(random, 6)};
}

Legs dependent_legs(Random& random) {
  Legs legs;
  do {
    for (std::size_t i = 0; i < 6; ++i) {
      legs.base[i] = random_point(random, 0);
      legs.platform[i] = random_point(random, 12);
    }
  } while (!make_dependent(legs, random));
  return legs;
}

/// Adds a pose parameter with this value, or with a range around it.
void pose_of(Builder& b, const std::string& name, const Rational& at, const Rational& width) {
  if (b.random.one_in(3)) {
    b.value(name, at);
    return;
  }
  b.range(name, at - width * Rational(b.random.between(1, 4), 3),
          at + width * Rational(b.random.between(1, 5), 4));
  b.attack.planted[name] = b.text(at);
}

/// Sets the motion around a pose, and the anchors in the frame of the platform.
void place(Builder& b, Hexapod& hexapod, const Orientation& o, const Legs& legs) {
  const Vector X{small(b.random, 8), small(b.random, 8), Rational(10) + small(b.random, 8)};
  hexapod.orientation = o.name;
  hexapod.base = legs.base;
  for (std::size_t i = 0; i < 6; ++i)
    hexapod.platform[i] = transposed_times(o.rotation, legs.platform[i] - X);
  const Rational width = b.random.one_in(3) ? Rational(1, 1000) : Rational(1, 10);
  for (std::size_t i = 0; i < 3; ++i) pose_of(b, std::string(1, "xyz"[i]), X[i], width);
  for (const auto& [name, value] : o.parameters) pose_of(b, name, value, width);
  b.attack.may_be_refused = o.name == "quaternion";  // a reader may refuse its norm
}

/// Puts base anchors on a circle, with a similar platform. Each row is linear in the six monomials
/// of degree at most 2 of an anchor's coordinates; six points of a conic make these dependent.
void similar_hexagons(Builder& b) {
  Hexapod hexapod;
  const Orientation o = rational_orientation(b.random);
  const Rational ratio(b.random.between(1, 5), 3), radius(b.random.between(4, 20)), one(1);
  for (std::size_t i = 0; i < 6; ++i) {
    const Rational t = Rational(static_cast<long>(i) * 2 - 5, 3) + small(b.random, 2, 9);
    const Rational n = one + t * t;
    hexapod.base[i] = {radius * (one - t * t) / n, radius * Rational(2) * t / n, Rational(0)};
    hexapod.platform[i] = hexapod.base[i];
    for (Rational& x : hexapod.platform[i]) x *= ratio;
  }
  hexapod.orientation = o.name;
  pose_of(b, "x", small(b.random, 8), Rational(1, 3));
  pose_of(b, "y", small(b.random, 8), Rational(1, 3));
  pose_of(b, "z", Rational(10), Rational(1, 3));
  for (const auto& [name, value] : o.parameters) pose_of(b, name, value, Rational(1, 20));
  b.attack.model.hexapod = hexapod;
  b.attack.truth = Truth::kSingular;
  b.attack.argument = "base and platform are similar hexagons in circles";
}

/// Three legs end in one point, two in another, one in a third. At a constant orientation the
/// determinant is the product of three functions that are affine in the position.
struct ThreeTwoOne {
  Legs legs;  ///< platform: relative to the position
  [[nodiscard]] std::array<Rational, 3> factors(const Vector& X) const {
    std::array<Vector, 6> n;
    for (std::size_t i = 0; i < 6; ++i) n[i] = X + legs.platform[i] - legs.base[i];
    const Vector r = legs.platform[3] - legs.platform[0], s = legs.platform[5] - legs.platform[0];
    return {dot(n[0], cross(n[1], n[2])), dot(r, cross(n[3], n[4])), dot(r, cross(s, n[5]))};
  }
};

ThreeTwoOne three_two_one(Random& random) {
  ThreeTwoOne robot;
  for (std::size_t i = 0; i < 6; ++i) robot.legs.base[i] = random_point(random, 0);
  const Vector p[3] = {random_point(random, 0), random_point(random, 0), random_point(random, 0)};
  constexpr std::size_t kPointOfLeg[] = {0, 0, 0, 1, 1, 2};
  for (std::size_t i = 0; i < 6; ++i) robot.legs.platform[i] = p[kPointOfLeg[i]];
  return robot;
}

/// Returns the slope of a factor: its largest change per unit of each coordinate.
Rational slope(const ThreeTwoOne& robot, std::size_t factor, const Vector& X, Vector& signs) {
  Rational sum;
  for (std::size_t i = 0; i < 3; ++i) {
    Vector moved = X;
    moved[i] += Rational(1);
    const Rational change = robot.factors(moved)[factor] - robot.factors(X)[factor];
    signs[i] = Rational(change.sign());
    sum += change.magnitude();
  }
  return sum;
}

}  // namespace

Attack hexapod_singular(std::uint64_t seed) {
  Builder b("hexapod", seed);
  if (b.random.one_in(5)) {
    similar_hexagons(b);
    return b.finish();
  }
  Hexapod hexapod;
  const Orientation o = rational_orientation(b.random);
  const Legs legs = dependent_legs(b.random);
  place(b, hexapod, o, legs);
  if (b.random.one_in(4)) {
    // Tolerances only add singular poses.
    const Rational t = Rational(1, 1000);
    hexapod.toml.push_back({"platform_tolerance", spell_toml(t, b.random)});
    hexapod.toml.push_back({"tolerance_shape", b.coin() ? "\"box\"" : "\"ball\""});
  }
  b.attack.model.hexapod = hexapod;
  b.attack.truth = Truth::kSingular;
  b.attack.argument = "the sixth leg is in the linear complex of the others at the pose";
  return b.finish();
}

Attack hexapod_regular(std::uint64_t seed) {
  Builder b("hexapod_regular", seed);
  const Orientation o = rational_orientation(b.random);
  ThreeTwoOne robot;
  Vector X, signs;
  Rational reach(0);  // how far the position moves until a factor vanishes
  Vector corner;
  do {
    robot = three_two_one(b.random);
    X = {small(b.random, 8), small(b.random, 8), Rational(10) + small(b.random, 8)};
    reach = Rational(1000);
    for (std::size_t f = 0; f < 3; ++f) {
      const Rational value = robot.factors(X)[f], sum = slope(robot, f, X, signs);
      if (value.is_zero() || sum.is_zero()) reach = Rational(0);
      if (reach.is_zero() || reach <= value.magnitude() / sum) continue;
      reach = value.magnitude() / sum;
      for (std::size_t i = 0; i < 3; ++i) corner[i] = -signs[i] * Rational(value.sign());
    }
  } while (reach < Rational(1, 100) || reach == Rational(1000));
  const bool singular = b.random.one_in(3);
  const Rational half =
      singular ? reach : reach * (Rational(1) - Rational::ten_to(-b.random.between(1, 9)));

  Hexapod hexapod;
  hexapod.orientation = o.name;
  hexapod.base = robot.legs.base;
  for (std::size_t i = 0; i < 6; ++i)
    hexapod.platform[i] = transposed_times(o.rotation, robot.legs.platform[i]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name(1, "xyz"[i]);
    b.range(name, X[i] - half, X[i] + half);
    if (singular) b.attack.planted[name] = b.text(X[i] + corner[i] * half);
  }
  for (const auto& [name, value] : o.parameters) b.value(name, value);
  b.attack.model.hexapod = hexapod;
  b.attack.truth = singular ? Truth::kSingular : Truth::kRegular;
  b.attack.argument = "the determinant is a product of three affine functions of the position";
  return b.finish();
}

Attack hexapod_tolerance(std::uint64_t seed) {
  Builder b("hexapod_tolerance", seed);
  Hexapod hexapod;
  const Orientation o = rational_orientation(b.random);
  const Legs legs = dependent_legs(b.random);
  const bool ball = b.coin();
  place(b, hexapod, o, legs);
  // The declared anchors differ from dependent ones by the tolerance, or by a little less.
  const Rational t(b.random.between(1, 50), 1000), beyond = b.coin() ? Rational(0) : b.margin(30);
  const std::array<long, 3> unit = {2, 3, 6};
  const bool on_platform = b.coin();
  auto& anchors = on_platform ? hexapod.platform : hexapod.base;
  for (std::size_t leg = 0; leg < 6; ++leg) {
    const std::string prefix = (on_platform ? "b" : "a") + std::to_string(leg + 1) + "_";
    BallOfAxes of_leg{{}, {}, t};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string axis = prefix + "xyz"[i];
      const Rational right = anchors[leg][i], sign(b.coin() ? 1 : -1);
      anchors[leg][i] += sign * (ball ? (t - beyond) * Rational(unit[i], 7) : t - beyond);
      b.attack.planted[axis] = b.text(right);
      b.attack.axes.push_back({axis, anchors[leg][i] - t, anchors[leg][i] + t});
      of_leg.axes.push_back(axis);
      of_leg.centre.push_back(anchors[leg][i]);
    }
    if (ball) b.attack.balls.push_back(std::move(of_leg));
  }
  hexapod.toml = {{on_platform ? "platform_tolerance" : "base_tolerance", spell_toml(t, b.random)},
                  {"tolerance_shape", ball ? "\"ball\"" : "\"box\""}};
  b.attack.model.hexapod = hexapod;
  b.attack.truth = Truth::kSingular;
  b.attack.argument = "anchors within the tolerance make the legs dependent at the pose";
  return b.finish();
}

}  // namespace regulus::detail::attack
