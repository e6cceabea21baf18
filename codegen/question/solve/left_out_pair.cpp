// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/left_out_pair.hpp"

#include "codegen/question/solve/approx_vectors.hpp"
#include "runtime/interval/elementary.hpp"

namespace regulus::detail {
namespace {

/// The movement about or along `axis` carries a point and a direction of the other axis from one side of the loop to
/// the other.
struct CarriedLine {
  const Vector3& axis;
  Vector3 point_from, point_to, direction_from, direction_to;
};

CarriedLine line_of_b(const PairInLoop& loop) {
  return {loop.a.axis, loop.M.d, loop.N.d, times(loop.M.R, loop.b.axis),
          times(loop.N.R, loop.b.axis)};
}

/// The same loop is J_b·N⁻¹·J_a = M⁻¹.
CarriedLine line_of_a(const PairInLoop& loop) {
  const LinkFrame from = inverse(loop.N), to = inverse(loop.M);
  return {loop.b.axis, from.d, to.d, times(from.R, loop.a.axis), times(to.R, loop.a.axis)};
}

/// Encloses the angle about the axis from one vector to another; nullopt: one may be along the axis.
std::optional<Interval> angle_between(const Vector3& axis, const Vector3& from, const Vector3& to) {
  const double near = approx_angle(middle(axis), middle(from), middle(to)).first;
  const Interval along = dot(axis, from) * dot(axis, to);
  const Interval c = dot(from, to) - along, s = dot(axis, cross(from, to));
  const SinCos turn = sincos(Interval(near));
  const Interval c_near = c * turn.cos + s * turn.sin, s_near = s * turn.cos - c * turn.sin;
  if (!(c_near.lo > 0)) return std::nullopt;
  return Interval(near) + atan(s_near / c_near);
}

std::optional<Interval> angle_of(const CarriedLine& line, bool has_point) {
  const auto by_direction = angle_between(line.axis, line.direction_from, line.direction_to);
  const auto by_point =
      has_point ? angle_between(line.axis, line.point_from, line.point_to) : std::nullopt;
  if (!by_point || !by_direction) return by_point ? by_point : by_direction;
  const bool is_finer = width_ru(*by_point) < width_ru(*by_direction);
  return is_finer ? by_point : by_direction;
}

}  // namespace

std::array<double, 2> approx_values(const PairInLoop& loop) {
  const CarriedLine line = line_of_b(loop);
  const Point3 k = middle(line.axis);
  const auto by_place = approx_angle(k, middle(line.point_from), middle(line.point_to));
  const auto by_direction = approx_angle(k, middle(line.direction_from), middle(line.direction_to));
  const double value = !loop.a.turns ? approx_dot(k, middle(line.point_to - line.point_from))
                       : by_place.second > by_direction.second ? by_place.first
                                                               : by_direction.first;
  const LinkFrame last = compose(inverse(compose(loop.a.moved(Interval(value)), loop.M)), loop.N);
  const Vector3 across = farthest_unit(loop.b.axis);
  return {value,
          approx_angle(middle(loop.b.axis), middle(across), middle(times(last.R, across))).first};
}

std::optional<std::array<Interval, 2>> enclose_values(const PairInLoop& loop) {
  const CarriedLine of_b = line_of_b(loop);
  // A point of an axis that slides is nowhere certain.
  const auto a = loop.a.turns ? angle_of(of_b, true)
                              : std::optional(dot(of_b.axis, of_b.point_to - of_b.point_from));
  const auto b = angle_of(line_of_a(loop), loop.a.turns);
  if (!a || !b) return std::nullopt;
  return std::array<Interval, 2>{*a, *b};
}

}  // namespace regulus::detail
