// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/units.hpp"

#include <array>

#include "codegen/model/degrees.hpp"

namespace regulus::detail {
namespace {

enum class UnitKind { kLength, kAngle };

struct Unit {
  std::string_view name;
  UnitKind kind;
  long numerator, denominator;  ///< of the unit in metres; unused for angles
};

constexpr std::array<Unit, 10> kUnits = {{{"m", UnitKind::kLength, 1, 1},
                                          {"dm", UnitKind::kLength, 1, 10},
                                          {"cm", UnitKind::kLength, 1, 100},
                                          {"mm", UnitKind::kLength, 1, 1000},
                                          {"um", UnitKind::kLength, 1, 1'000'000},
                                          {"µm", UnitKind::kLength, 1, 1'000'000},
                                          {"in", UnitKind::kLength, 254, 10'000},
                                          {"rad", UnitKind::kAngle, 1, 1},
                                          {"deg", UnitKind::kAngle, 1, 1},
                                          {"°", UnitKind::kAngle, 1, 1}}};

const Unit* find(std::string_view name) noexcept {
  for (const Unit& unit : kUnits)
    if (unit.name == name) return &unit;
  return nullptr;
}

GiNaC::ex size_of(const Unit& unit) {
  if (unit.kind == UnitKind::kAngle) return is_in_degrees(unit.name) ? one_degree() : GiNaC::ex(1);
  return GiNaC::numeric(unit.numerator, unit.denominator);
}

}  // namespace

bool is_unit(std::string_view name) noexcept { return find(name) != nullptr; }

std::optional<GiNaC::ex> unit_factor(std::string_view from, std::string_view to) {
  if (from == to) return GiNaC::ex(1);
  const Unit *a = find(from), *b = find(to);
  if (a == nullptr || b == nullptr || a->kind != b->kind) return std::nullopt;
  return size_of(*a) / size_of(*b);
}

}  // namespace regulus::detail
