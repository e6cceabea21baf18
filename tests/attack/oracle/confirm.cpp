// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/oracle/confirm.hpp"

#include <sstream>

#include "tests/attack/oracle/evaluate.hpp"
#include "tests/attack/oracle/random.hpp"

namespace regulus::detail::attack {
namespace {

using Doubt = std::optional<std::string>;

const Axis* find_axis(const Attack& attack, const std::string& name) {
  for (const Axis& axis : attack.axes)
    if (axis.name == name) return &axis;
  return nullptr;
}

/// Returns the planted values; the other axes have their lower ends.
Point point_of(const Attack& attack, const Planted& at) {
  Point point = planted(at);
  for (const Axis& axis : attack.axes) point.try_emplace(axis.name, Value(axis.lo));
  return point;
}

Point clamped(const Attack& attack, Point point) {
  for (const Axis& axis : attack.axes) {
    Value& value = point.at(axis.name);
    if (!value.certain_at_least(axis.lo)) value = axis.lo;
    if (!value.certain_at_most(axis.hi)) value = axis.hi;
  }
  return point;
}

/// Returns true if the point is certainly in each ball.
bool is_in_balls(const Attack& attack, const Point& point) {
  for (const BallOfAxes& ball : attack.balls) {
    Value sum = Rational(0);
    for (std::size_t i = 0; i < ball.axes.size(); ++i) {
      const Value d = point.at(ball.axes[i]) - Value(ball.centre[i]);
      sum = sum + d * d;
    }
    if (!sum.certain_at_most(ball.radius * ball.radius)) return false;
  }
  return true;
}

/// Checks that a rational point is in the variety; pi/2, say, is the end of its range.
Doubt refute_place(const Attack& attack, const Point& point, const Sample& at) {
  for (const Axis& axis : attack.axes) {
    const Value& value = point.at(axis.name);
    const bool inside = value.certain_at_least(axis.lo) && value.certain_at_most(axis.hi);
    if (value.exact() && !inside) return axis.name + " is outside its range";
  }
  if (!is_in_balls(attack, point)) return "the point is outside a ball";
  if (!at.certain_inside()) return "a constraint does not hold at the point";
  return std::nullopt;
}

/// Returns the scale for zero tests: a bound of the largest entry's magnitude.
Rational scale_of(const Sample& at) {
  Rational scale(1);
  for (const auto& row : at.matrix)
    for (const Value& entry : row)
      while (!magnitude(entry).certain_at_most(scale) && entry.defined())
        scale *= Rational::two_to(16);
  return scale;
}

Doubt refute_singular(const Attack& attack) {
  const Point point = point_of(attack, attack.planted);
  const Sample here = sample(attack, point);
  if (const Doubt doubt = refute_place(attack, point, here)) return doubt;
  if (!here.defined) return "undefined at the point";
  const Value det = here.determinant();
  if (!attack.other_sign.empty()) {
    const Point other = point_of(attack, attack.other_sign);
    const Sample there = sample(attack, other);
    if (const Doubt doubt = refute_place(attack, other, there)) return doubt;
    if (det.sign().value_or(0) * there.determinant().sign().value_or(0) == -1) return std::nullopt;
  }
  const Rational unit = scale_of(here).to_the(static_cast<long>(here.matrix.size()));
  if (det.is_zero_to(unit)) return std::nullopt;
  if (attack.alpha.sign() > 0 && (magnitude(det) - Value(attack.alpha)).is_zero_to(unit))
    return std::nullopt;
  if (attack.alpha.sign() > 0 && magnitude(det).certain_at_most(attack.alpha)) return std::nullopt;
  return "the determinant at the point is " + det.describe();
}

Doubt refute_undefined(const Attack& attack) {
  const Point point = point_of(attack, attack.planted);
  const Sample here = sample(attack, point);
  if (const Doubt doubt = refute_place(attack, point, here)) return doubt;
  if (!here.defined) return std::nullopt;
  if (attack.truth == Truth::kUndefinedOrSingular && here.determinant().is_zero_to(Rational(1)))
    return std::nullopt;
  return "everything is defined at the point";
}

Doubt refute_regular_at(const Attack& attack, const Point& point) {
  const Sample here = sample(attack, point);
  if (!is_in_balls(attack, point) || !here.certain_inside()) return std::nullopt;
  if (!here.defined) return "undefined at a point";
  const Value det = here.determinant();
  if (det.sign().value_or(0) == 0) return "the determinant at a point is " + det.describe();
  // Balls are not exact: they need slack where the point meets the margin exactly.
  const Rational least = attack.alpha + attack.margin * Rational(999, 1000);
  if (magnitude(det).certain_at_least(least)) return std::nullopt;
  return "the determinant at a point is too small: " + det.describe();
}

Doubt refute_empty_at(const Attack& attack, const Point& point) {
  if (sample(attack, point).certain_outside()) return std::nullopt;
  return "a point satisfies every constraint";
}

/// Returns a corner, a point near an end, or any point.
Point random_point(const Attack& attack, Random& random) {
  Point point;
  const bool corner = random.one_in(4);
  for (const Axis& axis : attack.axes) {
    const Rational width = axis.hi - axis.lo;
    Rational part(static_cast<long>(random.below(1 << 20)), 1 << 20);
    if (corner || random.one_in(4)) part = Rational(static_cast<long>(random.below(2)));
    if (random.one_in(8)) part *= Rational::ten_to(-random.between(3, 30));
    point.emplace(axis.name, Value(axis.lo + width * part));
  }
  return point;
}

/// Evaluates a TOML value: a number, or an expression in quotation marks.
Value toml_value(const std::string& text) {
  if (text.starts_with('"')) return evaluate(text.substr(1, text.size() - 2), {});
  return toml_number(text);
}

bool equals(const Value& value, const Rational& exact) {
  return value.exact() && *value.exact() == exact;
}

/// Checks lo and hi of "[lo, hi]" or of an option "lo:hi".
Doubt refute_ends(const Axis& axis, const Value& lo, const Value& hi) {
  const bool exact = lo.exact() && hi.exact();
  if (exact && equals(lo, axis.lo) && equals(hi, axis.hi)) return std::nullopt;
  const bool within = !exact && (Value(axis.lo) - lo).certain_at_least(Rational(0)) &&
                      (hi - Value(axis.hi)).certain_at_least(Rational(0));
  if (within) return std::nullopt;
  return "the range of " + axis.name + " is spelled wrong: " + lo.describe() + " to " +
         hi.describe();
}

Doubt refute_range(const Attack& attack, const Axis& axis, const std::string& toml) {
  for (std::size_t i = 0; i + 1 < attack.options.size(); ++i) {
    const std::string& text = attack.options[i + 1];
    if (attack.options[i] != "--range" || !text.starts_with(axis.name + "=")) continue;
    const std::size_t begin = axis.name.size() + 1, colon = text.find(':');
    return refute_ends(axis, evaluate(text.substr(begin, colon - begin), {}),
                       evaluate(text.substr(colon + 1), {}));
  }
  const std::size_t comma = toml.find(", ");
  return refute_ends(axis, toml_value(toml.substr(1, comma - 1)),
                     toml_value(toml.substr(comma + 2, toml.size() - comma - 3)));
}

/// Returns the text after "key = ", up to the comma or the bracket.
std::string field(const std::string& table, const std::string& key) {
  const std::size_t begin = table.find(key + " = ");
  if (begin == std::string::npos) return "";
  std::size_t end = begin + key.size() + 3;
  const std::size_t first = end;
  while (end < table.size() && table[end] != ',' && table[end] != '}') ++end;
  std::string text = table.substr(first, end - first);
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

Doubt refute_uncertain(const Attack& attack, const Axis& axis, const std::string& toml) {
  const bool is_table = toml.starts_with('{');
  const Value centre = toml_value(is_table ? field(toml, "value") : toml);
  Value width = Rational(0);
  if (const std::string given = field(toml, "tolerance"); !given.empty()) width = toml_value(given);
  if (const std::string group = field(toml, "group"); !group.empty())
    for (std::size_t i = 0; i + 1 < attack.options.size(); ++i)
      if (attack.options[i] == "--tolerance")
        if (const std::string& text = attack.options[i + 1];
            '"' + text.substr(0, text.find('=')) + '"' == group)
          width = evaluate(text.substr(text.find('=') + 1), {});
  return refute_ends(axis, centre - width, centre + width);
}

/// Returns the values of the pose parameters in the last columns of each line of the file.
std::vector<std::vector<Value>> way_points(const ModelSource& model) {
  std::vector<std::vector<Value>> points;
  std::istringstream lines(model.way);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::vector<Value> values;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(toml_number(cell));
    points.emplace_back(values.end() - static_cast<std::ptrdiff_t>(model.pose.size()),
                        values.end());
  }
  return points;
}

bool are_equal(const std::vector<Value>& a, const std::vector<Value>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!a[i].exact() || !b[i].exact() || *a[i].exact() != *b[i].exact()) return false;
  return true;
}

/// Checks that two way-points follow each other where the axis `s` has its ends.
Doubt refute_segment(const Attack& attack) {
  std::vector<Value> from, to;
  for (const PoseEntry& entry : attack.model.pose) {
    from.push_back(evaluate(entry.expression, {{"s", Value(Rational(0))}}));
    to.push_back(evaluate(entry.expression, {{"s", Value(Rational(1))}}));
  }
  const auto points = way_points(attack.model);
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    if ((are_equal(points[i], from) && are_equal(points[i + 1], to)) ||
        (are_equal(points[i], to) && are_equal(points[i + 1], from)))
      return std::nullopt;
  return "no segment of the file is that of the axis s";
}

}  // namespace

Doubt refute_truth(const Attack& attack, int samples) {
  if (attack.solve) return refute_solutions(*attack.solve);
  switch (attack.truth) {
    case Truth::kRefused:
      return std::nullopt;
    case Truth::kSingular:
      return refute_singular(attack);
    case Truth::kUndefined:
    case Truth::kUndefinedOrSingular:
      return refute_undefined(attack);
    default:
      break;
  }
  const bool empty = attack.truth == Truth::kEmpty;
  if (!attack.planted.empty())
    if (const Doubt doubt =
            refute_regular_at(attack, clamped(attack, point_of(attack, attack.planted))))
      return doubt;
  Random random("samples" + attack.family, attack.seed);
  for (int i = 0; i < samples; ++i) {
    const Point point = random_point(attack, random);
    if (const Doubt doubt =
            empty ? refute_empty_at(attack, point) : refute_regular_at(attack, point))
      return doubt;
  }
  return std::nullopt;
}

Doubt refute_axes(const Attack& attack) {
  if (!attack.model.way.empty() && find_axis(attack, "s"))
    if (const Doubt doubt = refute_segment(attack)) return doubt;
  for (const PoseEntry& entry : attack.model.pose)
    if (const Axis* axis = find_axis(attack, entry.name); axis && entry.expression.empty())
      if (const Doubt doubt = refute_range(attack, *axis, entry.toml)) return doubt;
  for (const NamedText& constant : attack.model.geometry)
    if (const Axis* axis = find_axis(attack, constant.name))
      if (const Doubt doubt = refute_uncertain(attack, *axis, constant.text)) return doubt;
  for (const NamedText& error : attack.model.error)
    if (const Axis* axis = find_axis(attack, error.name + "_error"))
      if (!equals(toml_value(error.text), axis->hi)) return "the error of " + error.name;
  if (!attack.model.alpha.empty() && !equals(toml_value(attack.model.alpha), attack.alpha))
    return "alpha is spelled wrong";
  return std::nullopt;
}

}  // namespace regulus::detail::attack
