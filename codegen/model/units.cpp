// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/units.hpp"

#include <array>

#include "codegen/model/degrees.hpp"

namespace regulus {
namespace {

enum class Kind { kLength, kAngle };

struct Unit {
  std::string_view name;
  Kind kind;
  long numerator, denominator;  ///< of the unit in metres; unused for angles
};

constexpr std::array<Unit, 10> kUnits = {{{"m", Kind::kLength, 1, 1},
                                          {"dm", Kind::kLength, 1, 10},
                                          {"cm", Kind::kLength, 1, 100},
                                          {"mm", Kind::kLength, 1, 1000},
                                          {"um", Kind::kLength, 1, 1'000'000},
                                          {"µm", Kind::kLength, 1, 1'000'000},
                                          {"in", Kind::kLength, 254, 10'000},
                                          {"rad", Kind::kAngle, 1, 1},
                                          {"deg", Kind::kAngle, 1, 1},
                                          {"°", Kind::kAngle, 1, 1}}};

const Unit* find(std::string_view name) {
  for (const Unit& unit : kUnits)
    if (unit.name == name) return &unit;
  return nullptr;
}

GiNaC::ex size_of(const Unit& unit) {
  if (unit.kind == Kind::kAngle) return is_in_degrees(unit.name) ? one_degree() : GiNaC::ex(1);
  return GiNaC::numeric(unit.numerator, unit.denominator);
}

}  // namespace

std::optional<GiNaC::ex> unit_factor(std::string_view from, std::string_view to) {
  if (from == to) return GiNaC::ex(1);
  const Unit *a = find(from), *b = find(to);
  if (a == nullptr || b == nullptr || a->kind != b->kind) return std::nullopt;
  return size_of(*a) / size_of(*b);
}

}  // namespace regulus
