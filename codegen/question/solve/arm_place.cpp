// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <tuple>
#include <utility>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/place.hpp"
#include "codegen/question/solve/arm_direction.hpp"
#include "codegen/question/solve/arm_tubes.hpp"
#include "codegen/question/solve/coupled_axes.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/varying_place.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

/// The four joints of OppositeAxes among six, and the other two.
constexpr std::array<std::size_t, 4> kSearched = {0, 1, 3, 4};
constexpr std::array<std::size_t, 2> kFollowing = {2, 5};
constexpr std::size_t kMostChoices = 3;

/// Returns the joints of the option, and those to which a motion by the tool gives a value.
std::vector<std::string> held_joints(const Model& model, const Motion& motion,
                                     std::vector<std::string> names) {
  for (std::size_t i = 0; i < model.pose.size() && !motion.tool.empty(); ++i) {
    const std::string& name = model.pose[i].name;
    const bool is_named = std::ranges::find(names, name) != names.end();
    if (is_named && !keeps_value(model, motion, i))
      throw UsageError(fmt::format(
          "{} is held, and has no value; give it beside the place of the tool, at {}=VALUE",
          in_quotes(name), name));
    if (!is_named && keeps_value(model, motion, i)) names.push_back(name);
  }
  return names;
}

/// Makes a joint a part of the link behind it.
void fix(ArmAtPlace& arm, std::size_t joint, const ArmValue& value) {
  const ArmJoint& fixed = arm.chain[joint];
  const LinkFrame moved = fixed.moved(value.value), link = compose(fixed.origin, moved);
  const FrameRates rates =
      rates_of_product(fixed.origin, fixed.rates, moved, fixed.rates_of_moved(value));
  if (joint + 1 < arm.chain.size()) {
    ArmJoint& next = arm.chain[joint + 1];
    next.rates = rates_of_product(link, rates, next.origin, next.rates);
    next.origin = compose(link, next.origin);
  } else {
    arm.target_rates = rates_of_product(arm.target, arm.target_rates, inverse(link),
                                        rates_of_inverse(link, rates));
    arm.target = compose(arm.target, inverse(link));
  }
  arm.chain.erase(arm.chain.begin() + std::ptrdiff_t(joint));
}

/// Joints that follow others by the multiplier 0 do not move.
void fix_unmoved(ArmAtPlace& arm) {
  for (std::size_t i = arm.chain.size(); i-- > 0;)
    if (arm.chain[i].factor == Interval(0.0)) fix(arm, i, {0.0});
}

/// Makes joints that an unknown moves parts of the links behind them.
void hold(ArmAtPlace& arm, const Model& model, const std::string& name,
          const std::vector<ArmValue>& values) {
  const auto at = std::ranges::find(
      arm.unknowns, name, [&model](const ArmUnknown& u) { return model.pose[u.pose].name; });
  if (at == arm.unknowns.end())
    throw UsageError("no joint " + in_quotes(name) + " is free to be held");
  const auto k = std::size_t(at - arm.unknowns.begin());
  for (std::size_t i = arm.chain.size(); i-- > 0;) {
    const ArmJoint& joint = arm.chain[i];
    if (joint.unknown == k) fix(arm, i, joint.factor * values[at->pose]);
  }
  for (ArmJoint& joint : arm.chain)
    if (joint.unknown > k) --joint.unknown;
  arm.unknowns.erase(at);
}

/// Finds whether the arm is one of four unknowns, and whether it is turned away from the place.
void take_direction(ArmAtPlace& arm, const Request& request) {
  const auto direction = direction_of(request.model, arm.geometry);
  if (!direction) return;
  arm.direction.emplace();
  for (std::size_t i = 0; i < 3; ++i)
    (*arm.direction)[i] = enclose_constant(direction->of_base[i], "a direction of the arm");
  if (request.motion.tool.empty()) return;
  const IsTurnedTo turned =
      is_turned_to(*direction, request.model, arm.geometry, tool_within_errors(request.motion));
  arm.is_turned_away = turned == IsTurnedTo::kNo;
  if (turned == IsTurnedTo::kUnknown)
    throw UsageError(
        "the arm turns about one direction alone, and it is not shown that this place has an "
        "orientation of it, within its errors; give the place by values of the joints");
}

void require_joints(const ArmAtPlace& arm, const Request& request) {
  const std::size_t free = arm.unknowns.size(), fixed = arm.direction ? kFourJoints : kJoints;
  if (free == fixed) return;
  throw UsageError(fmt::format(
      "{} joints are free to move, and {}; {}", free,
      arm.direction ? "as the arm turns about one direction alone, a place fixes four"
                    : "a frame fixes six",
      free < fixed
          ? (arm.direction ? "postures are found of such arms with four"
                           : "postures are found of arms with six, of arms with five, whose "
                             "tool may turn about its z axis, and of arms with four that turn "
                             "about one direction alone")
      : !request.motion.tool.empty()
          ? "give values that some keep, such as at " + request.model.pose.back().name + "=VALUE"
          : "name some that keep their values by hold"));
}

/// Returns the loop that the system of this number of four joints is about.
VaryingLoop loop_from(const ArmAtPlace& arm, std::size_t number) {
  const auto rotated = [number](const ArmAtPlace& at) {
    return rotated_loop({at.chain, at.target, at.target_rates}, number);
  };
  VaryingLoop loop{rotated(arm), {}, arm.deviations};
  if (arm.nominal) loop.nominal = rotated(*arm.nominal);
  move_origins(loop.within, arm.nominal ? &loop.nominal : nullptr);
  return loop;
}

std::vector<std::size_t> opposite_systems(const ArmChain& chain) {
  const auto sliding = std::ranges::count(chain, false, &ArmJoint::turns);
  if (sliding > 1) return {};
  if (sliding == 0) return {0, 1, 2};
  const auto slide = std::ranges::find(chain, false, &ArmJoint::turns) - chain.begin();
  return {(std::size_t(slide) + kJoints - 2) % kJoints};  // it is the third joint of the loop
}

// Arms with joints that follow others, and those that turn about one direction.

std::size_t number_of(std::size_t a, std::size_t b) { return kWholeArm + 1 + kJoints * a + b; }

std::array<std::size_t, 2> pair_of(std::size_t number) {
  return {(number - kWholeArm - 1) / kJoints, (number - kWholeArm - 1) % kJoints};
}

CoupledChoice choice_of(const ArmAtPlace& arm, std::size_t number) {
  const auto joint_of = [&](std::size_t unknown) {
    return std::size_t(std::ranges::find(arm.chain, unknown, &ArmJoint::unknown) -
                       arm.chain.begin());
  };
  const auto pair = pair_of(number);
  return {joint_of(pair[0]), joint_of(pair[1]), divided_unknowns(arm, number).searched};
}

/// Both move one joint. If one slides, it is the first of the pair.
bool may_be_left_out(const ArmAtPlace& arm, std::size_t a, std::size_t b) {
  const auto &first = arm.unknowns[a], &second = arm.unknowns[b];
  return a != b && first.is_alone && second.is_alone && second.turns && (!first.turns || a < b);
}

std::vector<std::size_t> coupled_systems(const ArmAtPlace& arm) {
  std::vector<std::pair<std::size_t, std::size_t>> found;  // terms and number
  for (std::size_t a = 0; a < arm.unknowns.size(); ++a)
    for (std::size_t b = 0; b < arm.unknowns.size(); ++b) {
      if (!may_be_left_out(arm, a, b)) continue;
      const std::size_t number = number_of(a, b);
      found.emplace_back(terms_of(arm.chain, arm.target, choice_of(arm, number)), number);
    }
  std::ranges::sort(found);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < std::min(found.size(), kMostChoices); ++i)
    numbers.push_back(found[i].second);
  return numbers;
}

/// Says what of the geometry varies. Axes are constants of the file.
struct VaryingGeometry {
  VaryingGeometry(const Model& model, const Motion& motion) {
    for (const GeometryParameter& g : model.geometry) {
      if (g.tolerance.is_zero()) continue;
      symbols.push_back(g.symbol);
      const double most = enclose_constant(g.tolerance, "a tolerance").hi;
      deviations.emplace_back(-most, most);
    }
    const std::vector<GiNaC::ex> tool = tool_within_errors(motion);
    const bool place_is_linear = tool.empty()
                                     ? motion.added_to_place.empty()
                                     : std::none_of(tool.begin() + 3, tool.end(), has_symbols);
    is_linear = place_is_linear && moves_linearly(model.arm->tool) &&
                std::ranges::all_of(model.arm->joints, [this](const SerialJoint& joint) {
                  return moves_linearly(joint.origin);
                });
  }

  std::vector<GiNaC::realsymbol>
      symbols;  ///< as symbols of the base class they would be none of the model's
  std::vector<Interval> deviations;
  bool is_linear = false;

 private:
  [[nodiscard]] bool varies(const GiNaC::ex& number) const {
    return std::ranges::any_of(symbols, [&](const GiNaC::realsymbol& s) { return number.has(s); });
  }
  [[nodiscard]] bool moves_linearly(const Placement& placement) const {
    return !varies(placement.R) && std::ranges::all_of(placement.p, [this](const GiNaC::ex& x) {
      return std::ranges::none_of(symbols,
                                  [&](const GiNaC::realsymbol& s) { return varies(x.diff(s)); });
    });
  }
};

/// For a geometry of the model, with derivatives. The place is that of the request.
ArmAtPlace arm_at_place(const Request& request, const std::vector<std::string>& held,
                        const Model& model, ArmGeometry geometry,
                        const std::vector<GiNaC::realsymbol>& varying) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  ArmAtPlace arm;
  arm.geometry = geometry;
  arm.chain = enclose_chain(model, geometry, varying);
  const std::vector<std::string> names = held_joints(model, request.motion, held);
  const std::vector<ArmValue> values = enclose_values(request, model, geometry, varying);
  arm.unknowns = unknowns_of(*model.arm);
  std::tie(arm.target, arm.target_rates) =
      request.motion.tool.empty()
          ? end_of(enclose_chain(request.model, ArmGeometry::kNominal), values)
          : enclose_target(model, tool_within_errors(request.motion), geometry, varying);
  fix_unmoved(arm);
  for (const std::string& name : names) hold(arm, model, name, values);
  if (arm.unknowns.size() < kJoints) take_direction(arm, request);
  require_joints(arm, request);
  return arm;
}

/// `loop`: of the system, if it is one of four joints of a plain arm.
PairInLoop pair_of_values(const ArmAtPlace& arm, std::size_t number, const ArmLoop& loop,
                          std::span<const Interval> searched) {
  return number < kWholeArm ? opposite_pair(loop, searched)
                            : pair_in_loop(arm.chain, arm.target, choice_of(arm, number), searched);
}

}  // namespace

ArmAtPlace arm_at_place(const Request& request, const std::vector<std::string>& held) {
  if (!has_tolerances(request)) return nominal_arm_at_place(request, held);
  const VaryingGeometry varying(request.model, request.motion);
  const auto varying_arm = [&](ArmGeometry geometry) {
    ArmAtPlace arm = arm_at_place(request, held, request.model, geometry, varying.symbols);
    arm.is_linear = varying.is_linear;
    return arm;
  };
  ArmAtPlace arm = varying_arm(ArmGeometry::kWithinTolerances);
  arm.deviations = varying.deviations;
  arm.nominal = std::make_shared<const ArmAtPlace>(varying_arm(ArmGeometry::kNominal));
  return arm;
}

ArmAtPlace nominal_arm_at_place(const Request& request, const std::vector<std::string>& held) {
  return nominal_arm_at_place(request, held, request.model);
}

ArmAtPlace nominal_arm_at_place(const Request& request, const std::vector<std::string>& held,
                                const Model& model) {
  return arm_at_place(request, held, model, ArmGeometry::kNominal, {});
}

bool ArmAtPlace::is_plain() const { return std::ranges::all_of(unknowns, &ArmUnknown::is_alone); }

std::unique_ptr<RootSystem> ArmAtPlace::equations(bool has_rates) const {
  if (direction) return std::make_unique<ArmAboutDirection>(chain, target, *direction);
  if (nominal) return std::make_unique<VaryingArm>(*this, has_rates);
  return std::make_unique<WholeArm>(chain, target, has_rates);
}

std::vector<std::size_t> systems_without_two(const ArmAtPlace& arm) {
  return arm.is_plain() && !arm.direction ? opposite_systems(arm.chain) : coupled_systems(arm);
}

DividedUnknowns divided_unknowns(const ArmAtPlace& arm, std::size_t number) {
  DividedUnknowns divided;
  if (number < kWholeArm) {
    for (const std::size_t i : kSearched) divided.searched.push_back((i + number) % kJoints);
    std::ranges::transform(kFollowing, divided.following.begin(),
                           [&](std::size_t i) { return (i + number) % kJoints; });
    return divided;
  }
  divided.following = pair_of(number);
  for (std::size_t k = 0; k < arm.unknowns.size(); ++k)
    if (std::ranges::find(divided.following, k) == divided.following.end())
      divided.searched.push_back(k);
  return divided;
}

std::array<double, 2> approx_following(const ArmAtPlace& arm, std::size_t number,
                                       std::span<const double> searched) {
  const std::vector<Interval> at(searched.begin(), searched.end());
  const VaryingLoop loop = number < kWholeArm ? loop_from(arm, number) : VaryingLoop();
  return approx_values(pair_of_values(arm, number, loop.within, at));
}

std::optional<std::array<Interval, 2>> enclose_following(const ArmAtPlace& arm, std::size_t number,
                                                         std::span<const Interval> searched) {
  const VaryingLoop loop = number < kWholeArm ? loop_from(arm, number) : VaryingLoop();
  return enclose_values(pair_of_values(arm, number, loop.within, searched));
}

RootSystems systems_of_arm(const ArmAtPlace& arm, std::size_t number) {
  if (number == kWholeArm) {
    const auto whole = std::make_shared<const ArmAtPlace>(arm);
    return {number, arm.unknowns.size(), [whole] { return whole->equations(false); }};
  }
  if (number > kWholeArm) {
    const CoupledChoice choice = choice_of(arm, number);
    const auto forms =
        std::make_shared<const TrigForms>(coupled_equations(arm.chain, arm.target, choice));
    const auto rows = CoupledAxes::rows_of(choice.searched.size(), arm.chain[choice.a].turns);
    return {number, choice.searched.size(),
            [forms, rows] { return std::make_unique<CoupledAxes>(forms, rows); }};
  }
  const auto equations = std::make_shared<const OppositeEquations>(loop_from(arm, number));
  return {number, kSearched.size(),
          [equations] { return std::make_unique<OppositeAxes>(equations); }};
}

RootSystems followed_systems_of_arm(const ArmAtPlace& arm, std::size_t number) {
  RootSystems systems = systems_of_arm(arm, number);
  systems.regular = systems.system;
  systems.number += kFollowedArm;
  return systems;
}

}  // namespace regulus::detail
