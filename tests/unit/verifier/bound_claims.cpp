// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/verifier/bound_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/proof/format.hpp"

namespace regulus::detail::test {
namespace {

using Matrix2 = std::array<Vector2, 2>;

Matrix2 inverse(const Matrix2& A) {
  const double det = A[0][0] * A[1][1] - A[0][1] * A[1][0];
  return {{{A[1][1] / det, -A[0][1] / det}, {-A[1][0] / det, A[0][0] / det}}};
}

/// Returns J⁻¹.
Matrix2 matrix_at(const BoundClaim& c, double x) {
  return {
      {{c.scale[0] * (c.a + c.b * x), c.scale[0] * c.c * x}, {c.scale[1] * c.d, c.scale[1] * c.e}}};
}

Matrix2 with_factors(const BoundClaim& c, Matrix2 A) {
  for (Vector2& row : A)
    for (std::size_t j = 0; j < 2; ++j) row[j] *= c.factor[j];
  return A;
}

double product(const Vector2& u, const Vector2& v) { return u[0] * v[0] + u[1] * v[1]; }

/// Returns the largest or the least singular value.
double singular_value(const Matrix2& A, bool is_largest) {
  const double sum = product(A[0], A[0]) + product(A[1], A[1]);
  const double det = A[0][0] * A[1][1] - A[0][1] * A[1][0];
  const double largest = std::sqrt((sum + std::sqrt(std::max(0.0, sum * sum - 4 * det * det))) / 2);
  return is_largest ? largest : std::abs(det) / largest;
}

bool has_set(const BoundClaim& c) {
  return c.kind == "force" || c.kind == "speed" || c.kind == "deflection";
}

/// Returns some values of the variables that the quantity adds, near the edge of their set.
std::vector<std::vector<double>> candidates(const BoundClaim& c) {
  constexpr int kDirections = 48;
  constexpr double kWithin = 0.999, kPi = 3.14159265358979;
  std::vector<std::vector<double>> found;
  const auto corners = [&](const Vector2& middle, const Vector2& spread) {
    for (const double i : {-1.0, 1.0})
      for (const double j : {-1.0, 1.0})
        found.push_back({middle[0] + kWithin * i * spread[0], middle[1] + kWithin * j * spread[1]});
  };
  const auto circle = [&](const Vector2& middle, double radius) {
    for (int k = 0; k < kDirections; ++k)
      found.push_back({middle[0] + kWithin * radius * std::cos(2 * kPi * k / kDirections),
                       middle[1] + kWithin * radius * std::sin(2 * kPi * k / kDirections)});
  };
  if (has_set(c) && c.has_norms) return {{}};
  if (has_set(c) && c.radius > 0) circle(c.middle, c.radius);
  if (has_set(c) && c.radius == 0) corners(c.middle, c.spread);
  if (c.kind == "error") corners({0, 0}, c.errors);
  if (c.kind == "condition") corners({0, 0}, {1, 1});
  if (c.kind == "error" && c.is_norm) {
    const std::vector<std::vector<double>> errors = std::move(found);
    found.clear();
    circle({0, 0}, 1);
    std::vector<std::vector<double>> both;
    for (const auto& delta : errors)
      for (const auto& n : found) both.push_back({delta[0], delta[1], n[0], n[1]});
    return both;
  }
  if (found.empty()) found.emplace_back();
  return found;
}

double number(std::mt19937& random, double lo, double hi) {
  return std::round(64 * std::uniform_real_distribution<double>(lo, hi)(random)) / 64;
}

format::ClaimedBound words_of(const BoundClaim& c) {
  format::ClaimedBound words;
  words.quantity = c.kind;
  words.side = c.side;
  if (c.kind == "force" || c.kind == "speed" || c.kind == "condition")
    words.row = std::to_string(c.row + 1);
  if (c.kind == "error" || c.kind == "deflection" || c.kind == "condition")
    words.columns = c.is_norm ? "1 2" : std::to_string(c.column + 1);
  if (has_set(c)) words.set = "any";
  if (c.kind == "expression") words.expression = "x^2 - x";
  words.bound = fmt::format("{:.12f}", c.bound);
  return words;
}

std::string set_lines(const BoundClaim& c) {
  std::string text = fmt::format("{} any\n", c.kind == "speed" ? "twist" : "load");
  for (std::size_t j = 0; j < 2; ++j)
    text += fmt::format("wrench {} +- {}\n", c.middle[j], c.radius > 0 ? 0 : c.spread[j]);
  if (c.radius > 0) text += fmt::format("wrench-ball {} in 1 2\n", c.radius);
  return text + (c.has_norms ? "norms\n" : "");
}

}  // namespace

double value_at(const BoundClaim& c, const Place& place) {
  const Matrix2 J = matrix_at(c, place.x), I = inverse(J);
  const std::vector<double>& u = place.values;
  const Vector2 w = u.size() < 2 ? c.middle : Vector2{u[0], u[1]};
  const auto transposed = [](const Matrix2& A, std::size_t k) { return Vector2{A[0][k], A[1][k]}; };
  double q = 0;
  if (c.kind == "force") q = product(transposed(I, c.row), w);
  if (c.kind == "speed") q = product(J[c.row], w);
  if (c.kind == "error" && !c.is_norm) q = product(I[c.column], w);
  if (c.kind == "error" && c.is_norm) q = -(product(I[0], w) * u[2] + product(I[1], w) * u[3]);
  if (c.kind == "deflection") {
    const Vector2 f{product(transposed(I, 0), w) / c.stiffness[0],
                    product(transposed(I, 1), w) / c.stiffness[1]};
    q = product(I[c.column], f);
  }
  if (c.kind == "expression") q = place.x * place.x - place.x;
  if (c.kind == "condition") {
    const Matrix2 A = with_factors(c, J);
    q = (std::abs(A[c.row][0]) + std::abs(A[c.row][1])) * product(inverse(A)[c.column], w);
  }
  if (c.kind.starts_with("sigma")) q = singular_value(with_factors(c, J), c.kind == "sigma-max");
  if (c.kind == "determinant-max") q = J[0][0] * J[1][1] - J[0][1] * J[1][0];
  if (c.kind == "condition-2")
    q = singular_value(with_factors(c, J), true) / singular_value(with_factors(c, J), false);
  if (c.has_norms) q += c.sign() * c.radius * std::hypot(J[c.row][0], J[c.row][1]);
  return c.side == "absolute" ? std::abs(q) : q;
}

Place extreme_place(const BoundClaim& c) {
  constexpr int kPoses = 40;
  Place best{c.lo, {}};
  double most = -INFINITY;
  for (const auto& values : candidates(c))
    for (int k = 0; k <= kPoses; ++k) {
      const Place place{c.lo + (c.hi - c.lo) * k / kPoses, values};
      const double q = c.sign() * value_at(c, place);
      if (q > most) most = q, best = place;
    }
  return best;
}

BoundClaim random_claim(std::mt19937& random) {
  const auto pick = [&](auto list) {
    return std::string(
        list[std::uniform_int_distribution<std::size_t>(0, list.size() - 1)(random)]);
  };
  using Words = std::vector<const char*>;
  BoundClaim c;
  c.kind = pick(Words{"force", "force", "speed", "error", "deflection", "condition", "sigma-min",
                      "sigma-max", "condition-2", "determinant-max", "expression"});
  c.is_norm = c.kind == "error" && random() % 2 == 0;
  const bool is_signed = has_set(c) || c.kind == "determinant-max";
  c.side = is_signed                         ? pick(Words{"absolute", "largest", "least"})
           : c.kind == "expression"          ? pick(Words{"largest", "least"})
           : c.kind == "sigma-min"           ? "least"
           : c.kind == "error" && !c.is_norm ? "absolute"
                                             : "largest";
  c.a = number(random, 2, 4), c.b = number(random, 0, 1), c.c = number(random, -1, 1);
  c.d = number(random, -0.5, 0.5), c.e = number(random, 1, 3);
  c.lo = number(random, 0, 0.5), c.hi = number(random, 1, 1.5);
  for (std::size_t k = 0; k < 2; ++k) {
    c.scale[k] = number(random, 0.25, 2), c.spread[k] = number(random, 0.25, 2);
    c.middle[k] = random() % 2 == 0 ? 0 : number(random, -2, 2);
    c.errors[k] = number(random, 0.25, 1), c.stiffness[k] = number(random, 0.5, 3);
    c.factor[k] = number(random, 0.25, 2);
  }
  if (has_set(c) && random() % 2 == 0) c.radius = number(random, 0.5, 2);
  const bool is_two_sided = c.side == "absolute" && (c.middle[0] != 0 || c.middle[1] != 0);
  c.has_norms = c.kind == "speed" && c.radius > 0 && !is_two_sided && random() % 2 == 0;
  c.row = random() % 2, c.column = random() % 2;
  return c;
}

std::string head_of(const BoundClaim& c, bool is_attained) {
  const format::ClaimedBound words = words_of(c);
  std::string text = fmt::format(
      "regulus-certificate 1\nverdict {}\nclaim {}\nmodel shear\nsha256 -\nmotion m\nalpha 0\n"
      "parameter x in {} : {}\npose x = x\nmatrix 2 2\nentry {} + x*({})\nentry x*({})\nentry {}\n"
      "entry {}\nscale 1/({})\nscale {}\nquantity {}\nside {}\n",
      is_attained ? "SINGULARITY" : "NO SINGULARITY",
      format::describe_bound_claim({2, 2, 0, false, false}, words, is_attained), c.lo, c.hi, c.a,
      c.b, c.c, c.d, c.e, 1 / c.scale[0], c.scale[1], c.kind, c.side);
  if (!words.row.empty()) text += "row " + words.row + '\n';
  if (!words.columns.empty()) text += "column " + words.columns + '\n';
  if (has_set(c)) text += set_lines(c);
  for (std::size_t k = 0; k < 2 && c.kind == "error"; ++k)
    text += fmt::format("motor-error {}\n", c.errors[k]);
  for (std::size_t k = 0; k < 2 && c.kind == "deflection"; ++k)
    text += fmt::format("stiffness {}\n", c.stiffness[k]);
  for (std::size_t k = 0; k < 2 && (c.kind.starts_with("condition") || c.kind.starts_with("sigma"));
       ++k)
    text += fmt::format("factor {}\n", c.factor[k]);
  if (c.kind == "expression") text += "expression x^2 - x\n";
  return text + fmt::format("reference {}\nbound {}\nproof\n", c.reference, words.bound);
}

std::string proof_of(const BoundClaim&) { return "l 0 h-matrix\nend 1\n"; }

/// Which of two points has the positive determinant is not known here.
std::string witness_of(const BoundClaim& c, const Place& place) {
  constexpr double kBeside = 1e-6;
  if (c.kind == "condition-2") return fmt::format("reason ratio\npoint 0 {:a}\nend\n", place.x);
  const double q = c.sign() * value_at(c, place);
  const double r = c.is_direct() ? std::abs(q) : 1 / (q - c.reference);
  const double end = c.is_direct() ? c.bound : 1 / (c.sign() * c.bound - c.reference);
  BoundClaim plain = c;
  plain.side = "largest";
  // r is negative only for a set that is not its own mirror image.
  const bool is_below = c.side == "absolute" && value_at(plain, place) < 0;
  const bool has_mirror = c.kind == "error" || (c.middle[0] == 0 && c.middle[1] == 0);
  std::string text = "reason opposite-signs\n";
  for (const double side : {1 - kBeside, 1 + kBeside}) {
    const double at = std::min(r * side, end * (1 - 1e-9)) * (is_below && !has_mirror ? -1 : 1);
    text += fmt::format("point {} {:a} {:a}", side < 1 ? '+' : '-', place.x, at);
    for (const double value : place.values)
      text += fmt::format(" {:a}", is_below && has_mirror ? -value : value);
    text += '\n';
  }
  return text + "path segment\nend\n";
}

}  // namespace regulus::detail::test
