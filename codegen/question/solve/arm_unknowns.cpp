// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_unknowns.hpp"

#include <cstdlib>
#include <numeric>
#include <optional>

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// Denominators and multiples beyond this are taken as no simple numbers: there would be as many postures.
constexpr long kMostTurns = 16;

bool turns(const SerialJoint& joint) { return joint.kind == JointKind::kRevolute; }

/// Returns the joints that move with this one, which follows none.
std::vector<const SerialJoint*> followers_of(const Serial& arm, std::size_t leader) {
  std::vector<const SerialJoint*> followers;
  for (const SerialJoint& joint : arm.joints)
    if (joint.follows && joint.follows->leader == leader && !joint.follows->multiplier.is_zero())
      followers.push_back(&joint);
  return followers;
}

/// Returns the number n if the rational number is n or a part n of a whole; nullopt: it is not simple.
std::optional<long> simple(const GiNaC::numeric& number) {
  if (!number.is_integer() || abs(number) > GiNaC::numeric(kMostTurns)) return std::nullopt;
  return number.to_long();
}

/// Returns after how many turns of the leader all that it moves is as before; nullopt: that is not known.
std::optional<long> turns_of_period(const Serial& arm, std::size_t leader) {
  if (!turns(arm.joints[leader])) return std::nullopt;
  const auto followers = followers_of(arm, leader);
  long all = 1;
  for (const SerialJoint* follower : followers) {
    const ex& multiplier = follower->follows->multiplier;
    if (!turns(*follower) || !GiNaC::is_a<GiNaC::numeric>(multiplier)) return std::nullopt;
    const auto& number = GiNaC::ex_to<GiNaC::numeric>(multiplier);
    const auto part = number.is_rational() ? simple(number.denom()) : std::nullopt;
    if (!part || std::lcm(all, *part) > kMostTurns) return std::nullopt;
    all = std::lcm(all, *part);
  }
  for (const SerialJoint* follower : followers)
    if (!simple(GiNaC::ex_to<GiNaC::numeric>(follower->follows->multiplier * all)))
      return std::nullopt;
  return all;
}

}  // namespace

std::vector<ArmUnknown> unknowns_of(const Serial& arm) {
  std::vector<ArmUnknown> unknowns;
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    if (arm.joints[j].follows) continue;
    const auto period = turns_of_period(arm, j);
    unknowns.push_back({unknowns.size(), turns(arm.joints[j]), double(period.value_or(1)),
                        period.has_value(), followers_of(arm, j).empty()});
  }
  return unknowns;
}

std::vector<JointRule> joint_rules(const Serial& arm) {
  const std::vector<ArmUnknown> unknowns = unknowns_of(arm);
  std::vector<std::size_t> number(arm.joints.size());
  std::size_t next = 0;
  for (std::size_t j = 0; j < number.size(); ++j)
    if (!arm.joints[j].follows) number[j] = next++;
  std::vector<JointRule> rules;
  for (std::size_t j = 0; j < number.size(); ++j) {
    const auto& follows = arm.joints[j].follows;
    const std::size_t unknown = number[follows ? follows->leader : j];
    const ex scale = long(unknowns[unknown].scale);
    rules.push_back(follows ? JointRule{unknown, follows->multiplier * scale, follows->offset}
                            : JointRule{unknown, scale, 0});
  }
  return rules;
}

}  // namespace regulus::detail
