// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/leg_geometry.hpp"

#include "codegen/model/constants.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/exact/exact_algebra.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

FormulaPoint formulas(const Point& v) { return {unplaced(v[0]), unplaced(v[1]), unplaced(v[2])}; }

std::string numbers(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " number" : " numbers");
}

}  // namespace

std::vector<std::string> LegGeometry::keys() {
  return {"base_tolerance", "platform_tolerance", "crank_tolerance",
          "rod_tolerance",  "axis_tolerance",     "tolerance_shape"};
}

void LegGeometry::read_tolerances() {
  const TomlReader& toml = reading_.toml;
  for (Group& group : groups_) {
    const TomlEntry given = toml.optional(legs_, group.key);
    if (!given.node) continue;
    group.tolerance = checked_nonnegative(constant(given), toml.place(given));
    group.given = given;
  }
  if (const TomlEntry shape = toml.optional(legs_, "tolerance_shape"); shape.node)
    balls_ = choice(
        toml, shape,
        std::array{std::pair{std::string("box"), false}, std::pair{std::string("ball"), true}});
}

void LegGeometry::require_uses() const {
  for (const Group& group : groups_)
    require_use(reading_.toml, group.given, group.tolerance, group.is_used,
                std::string(group.quantities) +
                    (group.has_others ? " without a tolerance of its own" : ""));
}

LegGeometry::Given LegGeometry::given(const TomlEntry& entry, Group& of, bool is_point) {
  static const std::array<std::string, 3> kKeys = {"value", "tolerance", "radius"};
  const TomlReader& toml = reading_.toml;
  const bool is_table = entry.node->is_table();
  if (is_table) (void)toml.entries(entry, kKeys);
  const TomlEntry tolerance = is_table ? toml.optional(entry, "tolerance") : TomlEntry{};
  const TomlEntry radius = is_table ? toml.optional(entry, "radius") : TomlEntry{};
  if (tolerance.node && radius.node)
    toml.refuse(entry, "both a tolerance and a radius in " + entry.path, "one of them");
  if (radius.node && !is_point)
    toml.refuse(entry, "a radius for the length " + entry.path, "a tolerance");
  const TomlEntry& own = radius.node ? radius : tolerance;
  (own.node ? of.has_others : of.is_used) = true;
  return {is_table ? toml.required(entry, "value") : entry,
          own.node ? checked_nonnegative(constant(own), toml.place(own)) : of.tolerance,
          is_point && (own.node ? radius.node != nullptr : balls_)};
}

FormulaPoint LegGeometry::point(const TomlEntry& list, LegGroup kind, const std::string& number) {
  return point(list, group(kind), group(kind).letter, number);
}

FormulaPoint LegGeometry::point(const TomlEntry& list, Group& of, const char* letter,
                                const std::string& number) {
  const Given written = given(list, of, true);
  const auto values = elements(written.value, coordinates_);
  FormulaPoint result;
  ToleranceBall ball{.members = {}, .radius = written.tolerance, .group = of.name};
  const int index = written.is_ball ? static_cast<int>(reading_.model.balls.size()) : -1;
  for (std::size_t i = 0; i < coordinates_; ++i) {
    ball.members.push_back(reading_.model.geometry.size());
    result[i] =
        quantity(values[i], read_quantity(reading_, values[i]),
                 letter + number + "_" + kCoordinates[i], {written.tolerance, of.name, index});
  }
  if (written.is_ball) reading_.model.balls.push_back(std::move(ball));
  return result;
}

Formula LegGeometry::length(const TomlEntry& entry, LegGroup kind, const std::string& number) {
  Group& of = group(kind);
  const Given written = given(entry, of, false);
  const ParsedExpression term = read_quantity(reading_, written.value);
  if (certain_sign(nominal_value(reading_.model, term.value)) != CertainSign::kPositive)
    reading_.toml.reject(entry, "a length that is not positive", "a rod has a positive length");
  return quantity(written.value, term, of.letter + number, {written.tolerance, of.name, -1});
}

Formula LegGeometry::quantity(const TomlEntry& entry, const ParsedExpression& value,
                              const std::string& name, const DeclaredTolerance& tolerance) {
  declare_quantity(reading_, entry, name, value, tolerance);
  if (tolerance.group != group(LegGroup::kAxis).name)
    lengths_.push_back(reading_.model.geometry.back().name);
  return unplaced(name);
}

LegAxis LegGeometry::axis(const TomlEntry& list, const std::string& number) {
  return axis(list, group(LegGroup::kAxis).letter, number);
}

LegAxis LegGeometry::hinge(const TomlEntry& list, const std::string& number) {
  return axis(list, "h", number);
}

LegAxis LegGeometry::axis(const TomlEntry& list, const char* letter, const std::string& number) {
  Point v = {0, 0, 0};
  bool exact = group(LegGroup::kAxis).given.node == nullptr;
  const auto values = elements(list, coordinates_);
  for (std::size_t i = 0; i < coordinates_; ++i) {
    const ParsedExpression term = read_quantity(reading_, values[i]);
    exact = exact && term.constant;
    v[i] = term.value;
  }
  if (!exact) return {.direction = point(list, group(LegGroup::kAxis), letter, number)};
  const Point n = unit(list, v);
  // A coordinate axis across the direction, if there is one, gives the shortest expressions.
  Point g = {-n[1], n[0], 0};
  if (n[2].is_zero())
    g = {0, 0, 1};
  else if (n[1].is_zero())
    g = {0, 1, 0};
  else if (n[0].is_zero())
    g = {1, 0, 0};
  else
    g = unit(list, g);
  return {formulas(n), std::pair(formulas(reduced(cross(g, n))), formulas(g))};
}

FormulaPoint LegGeometry::direction(const TomlEntry& list) {
  const auto values = elements(list, coordinates_);
  Point v = {0, 0, 0};
  for (std::size_t i = 0; i < coordinates_; ++i) v[i] = constant(values[i]).value;
  return formulas(unit(list, v));
}

Point LegGeometry::unit(const TomlEntry& list, const Point& v) const {
  const ex square = reduced(dot(v, v));
  if (!is_certainly_nonzero(square))
    reading_.toml.reject(list, list.path + " is zero, or cannot be told from zero",
                         "it must have a direction");
  return reduced(scaled(1 / GiNaC::sqrt(square), v));
}

ParsedExpression LegGeometry::constant(const TomlEntry& entry, NumberUnit unit) {
  ParsedExpression term = reading_.toml.constant(entry, unit);
  append(reading_.model.must_be_defined, term.must_be_defined);
  return term;
}

std::vector<TomlEntry> LegGeometry::elements(const TomlEntry& list, std::size_t count) const {
  auto found = reading_.toml.elements(list, numbers(count));
  if (found.size() != count)
    reading_.toml.refuse(list, numbers(found.size()) + " in " + list.path, numbers(count));
  return found;
}

}  // namespace regulus::detail
