// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_direction.hpp"

#include <algorithm>
#include <initializer_list>
#include <memory>

#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/exact/parsed_expression.hpp"
#include "codegen/model/mechanism/joint_screws.hpp"
#include "codegen/model/mechanism/rotation.hpp"
#include "codegen/question/solve/arm_unknowns.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using Direction = std::array<ex, 3>;

bool has_any_symbol(const ex& x) {
  return GiNaC::is_a<GiNaC::symbol>(x) || std::any_of(x.begin(), x.end(), has_any_symbol);
}

bool is_certainly(const ex& constant, std::initializer_list<CertainSign> signs) {
  return std::ranges::find(signs, certain_sign(constant)) != signs.end();
}

bool are_along(const Direction& u, const Direction& v) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (!is_certainly((u[i] * v[j] - u[j] * v[i]).expand(), {CertainSign::kZero})) return false;
  }
  return true;
}

/// The numbers of the geometry that are the same for all of its values.
GiNaC::exmap certain_numbers(const Model& model, ArmGeometry geometry) {
  GiNaC::exmap values;
  for (const GeometryParameter& g : model.geometry)
    if (geometry == ArmGeometry::kNominal || (g.tolerance.is_zero() && g.ball < 0))
      values[g.symbol] = g.value;
  return values;
}

/// The angular velocities by the unknowns, seen from a link; nullopt: one is not the same at all postures.
std::optional<std::vector<Direction>> spins_seen_from(const Model& model, std::size_t link,
                                                      const GiNaC::exmap& certain) {
  const Serial& arm = *model.arm;
  const JointGroups groups = parallel_groups(arm, std::make_shared<TermBudget>());
  const std::vector<JointScrew> screws = joint_screws(arm, groups, link);
  const std::vector<ex> values = joint_values(model, arm);
  const std::vector<JointRule> rules = joint_rules(arm);
  std::vector<Direction> spins(model.pose.size());
  for (std::size_t j = 0; j < screws.size(); ++j)
    for (std::size_t i = 0; i < 3; ++i)
      spins[rules[j].unknown][i] += rules[j].factor * screws[j].spin[i].expression(values);
  for (Direction& spin : spins)
    for (ex& part : spin) {
      part = part.subs(certain).expand();
      if (has_any_symbol(part)) return std::nullopt;
    }
  return spins;
}

/// True if no rotation of a link has a tolerance.
bool keep_links_their_turns(const Model& model, const GiNaC::exmap& certain) {
  const auto varies = [&certain](const ex& x) { return has_any_symbol(x.subs(certain)); };
  return std::ranges::none_of(model.arm->joints, [&](const SerialJoint& joint) {
    return varies(joint.origin.R) || std::ranges::any_of(joint.axis, varies);
  });
}

/// The one that is not 0, if all are along it.
std::optional<std::size_t> common_direction(const std::vector<Direction>& spins) {
  const auto is_not_zero = [](const Direction& spin) {
    return std::ranges::any_of(spin, [](const ex& part) {
      return is_certainly(part, {CertainSign::kNegative, CertainSign::kPositive});
    });
  };
  const auto first = std::ranges::find_if(spins, is_not_zero);
  if (first == spins.end()) return std::nullopt;
  for (const Direction& spin : spins)
    if (!are_along(*first, spin)) return std::nullopt;
  return std::size_t(first - spins.begin());
}

}  // namespace

std::optional<ArmDirection> direction_of(const Model& model, ArmGeometry geometry) try {
  const GiNaC::exmap certain = certain_numbers(model, geometry);
  if (!keep_links_their_turns(model, certain)) return std::nullopt;
  const auto of_base = spins_seen_from(model, 0, certain);
  const auto number = of_base ? common_direction(*of_base) : std::nullopt;
  if (!number) return std::nullopt;
  const auto of_end = spins_seen_from(model, model.arm->joints.size(), certain);
  if (!of_end) return std::nullopt;
  return ArmDirection{(*of_base)[*number], (*of_end)[*number]};
} catch (const ParseRefusal&) {  // too many terms
  return std::nullopt;
}

IsTurnedTo is_turned_to(const ArmDirection& direction, const Model& model, ArmGeometry geometry,
                        const std::vector<ex>& tool) {
  const GiNaC::exmap certain = certain_numbers(model, geometry);
  const ex tip = ex(model.arm->tool.R).subs(certain);
  if (has_any_symbol(tip)) return IsTurnedTo::kUnknown;
  const GiNaC::matrix R = rotation_roll_pitch_yaw(tool[3], tool[4], tool[5])
                              .mul(GiNaC::ex_to<GiNaC::matrix>(tip).transpose());
  IsTurnedTo result = IsTurnedTo::kYes;
  for (unsigned i = 0; i < 3; ++i) {
    ex gap = -direction.of_base[i];
    for (unsigned j = 0; j < 3; ++j) gap += R(i, j) * direction.of_end[j];
    gap = gap.subs(certain).expand();
    const CertainSign sign = has_any_symbol(gap) ? CertainSign::kUnknown : certain_sign(gap);
    if (sign == CertainSign::kUnknown) result = IsTurnedTo::kUnknown;
    if (sign == CertainSign::kNegative || sign == CertainSign::kPositive) return IsTurnedTo::kNo;
  }
  return result;
}

}  // namespace regulus::detail
