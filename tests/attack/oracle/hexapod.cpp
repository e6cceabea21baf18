// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/oracle/hexapod.hpp"

namespace regulus::detail::attack {
namespace {

using Vector = std::vector<Value>;

Value zero() { return Rational(0); }
Value one() { return Rational(1); }

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c(3, Vector(3, zero()));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] = c[i][j] + a[i][k] * b[k][j];
  return c;
}

/// Returns the rotation about axis 0, 1 or 2.
Matrix rotation_about(std::size_t axis, const Value& angle) {
  const Value c = call("cos", angle, {}), s = call("sin", angle, {});
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  Matrix r(3, Vector(3, zero()));
  r[axis][axis] = one();
  r[u][u] = r[v][v] = c;
  r[u][v] = zero() - s;
  r[v][u] = s;
  return r;
}

Matrix of_quaternion(const Value& a, const Value& b, const Value& c, const Value& d) {
  const Value two = Rational(2);
  const Value aa = a * a, bb = b * b, cc = c * c, dd = d * d;
  return {{aa + bb - cc - dd, two * (b * c - a * d), two * (b * d + a * c)},
          {two * (b * c + a * d), aa - bb + cc - dd, two * (c * d - a * b)},
          {two * (b * d - a * c), two * (c * d + a * b), aa - bb - cc + dd}};
}

Value squared_norm(const Point& p) {
  Value sum = zero();
  for (const char* q : {"q0", "q1", "q2", "q3"}) sum = sum + p.at(q) * p.at(q);
  return sum;
}

Vector anchor(char side, std::size_t leg, const std::array<Rational, 3>& nominal,
              const Point& point) {
  Vector result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name = std::string(1, side) + std::to_string(leg + 1) + "_" + "xyz"[axis];
    const auto found = point.find(name);
    result.push_back(found != point.end() ? found->second : Value(nominal[axis]));
  }
  return result;
}

Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

}  // namespace

Matrix scaled_rotation(const std::string& orientation, const Point& p) {
  if (orientation == "quaternion")
    return of_quaternion(p.at("q0"), p.at("q1"), p.at("q2"), p.at("q3"));
  if (orientation == "euler-zxz")
    return product(product(rotation_about(2, p.at("psi")), rotation_about(0, p.at("theta"))),
                   rotation_about(2, p.at("phi")));
  return product(product(rotation_about(2, p.at("yaw")), rotation_about(1, p.at("pitch"))),
                 rotation_about(0, p.at("roll")));
}

Sample sample_of(const Hexapod& hexapod, const Point& point) {
  const Matrix S = scaled_rotation(hexapod.orientation, point);
  const Value N = hexapod.orientation == "quaternion" ? squared_norm(point) : one();
  Sample result;
  for (std::size_t leg = 0; leg < 6; ++leg) {
    const Vector a = anchor('a', leg, hexapod.base[leg], point);
    const Vector b = anchor('b', leg, hexapod.platform[leg], point);
    Vector on_platform, direction;  // N·(B − C) and N·(B − A)
    Value squared_length = zero();
    const Value centre[] = {point.at("x"), point.at("y"), point.at("z")};
    for (std::size_t i = 0; i < 3; ++i) {
      on_platform.push_back(S[i][0] * b[0] + S[i][1] * b[1] + S[i][2] * b[2]);
      direction.push_back(N * (centre[i] - a[i]) + on_platform[i]);
      squared_length = squared_length + direction[i] * direction[i];
    }
    result.defined = result.defined && squared_length.sign() == 1 && N.sign() == 1;
    Vector row = direction;
    for (const Value& moment : cross(on_platform, direction)) row.push_back(moment);
    result.matrix.push_back(row);
  }
  return result;
}

}  // namespace regulus::detail::attack
