// SPDX-License-Identifier: GPL-3.0-or-later
// An arm whose end is where the joints or the tool of a motion put it, and the systems that are searched
// for its postures.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codegen/model/request.hpp"
#include "codegen/question/solve/arm_chain.hpp"
#include "codegen/question/solve/arm_unknowns.hpp"
#include "codegen/question/solve/opposite_axes.hpp"
#include "codegen/question/solve/root_judge.hpp"

namespace regulus::detail {

struct ArmAtPlace {
  ArmGeometry geometry;
  ArmChain chain;  ///< of the joints that are free; those that are held are parts of its links
  LinkFrame target;
  FrameRates target_rates = {};
  std::vector<ArmUnknown> unknowns;  ///< those of the chain
  /// An arm of four unknowns that turns about one direction alone has this one (arm_direction.hpp).
  std::optional<Vector3> direction{};
  bool is_turned_away = false;  ///< it has none of the orientation that is asked for
  // Within tolerances: the nominal arm, and how far each uncertain quantity may be from its value there. Both have rates
  // by these.
  std::shared_ptr<const ArmAtPlace> nominal{};
  std::vector<Interval> deviations{};
  /// The derivatives of place and lengths by what varies are constant, and rotations do not vary.
  bool is_linear = false;

  /// True if each joint is an unknown.
  [[nodiscard]] bool is_plain() const;
  /// Returns the equations of all unknowns. They live no longer than this.
  [[nodiscard]] std::unique_ptr<RootSystem> equations(bool has_rates) const;
};

/// `held`: joints that keep their values, beside those to which a motion by the tool gives one. Joints that
/// follow them keep theirs, too.
///
/// Requires  request.model.arm; the motion has values.
/// Throws    UsageError for an arm that has not six joints that are free to move and follow none, or four if
///           it turns about one direction.
[[nodiscard]] ArmAtPlace arm_at_place(const Request& request, const std::vector<std::string>& held);
/// The nominal arm; the other one has the geometry of `model`, but the same place.
[[nodiscard]] ArmAtPlace nominal_arm_at_place(const Request& request,
                                              const std::vector<std::string>& held);
[[nodiscard]] ArmAtPlace nominal_arm_at_place(const Request& request,
                                              const std::vector<std::string>& held,
                                              const Model& model);

/// The number of the system of all unknowns. Those before it are of four joints of a plain arm, and the other two
/// are opposite: N + 2 and N + 5 modulo 6 in the system of number N. Those behind it are of an arm
/// with joints that follow others, or that turns about one direction, and number the pair that is left out.
inline constexpr std::size_t kWholeArm = 6;
/// If all joints turn, each pair of opposite ones has one number, below this.
inline constexpr std::size_t kOppositePairs = 3;

/// Added to a number: the system of the nominal arm of a question with tolerances, and the one that is asked for where
/// the derivatives are regular within these.
inline constexpr std::size_t kNominalArm = 64, kFollowedArm = 128;

/// Returns the numbers of the systems without two unknowns, the best one first: none if several joints of a plain
/// arm slide, or if fewer than two of another arm have no followers.
[[nodiscard]] std::vector<std::size_t> systems_without_two(const ArmAtPlace& arm);

/// The unknowns of such a system, in their order, and the other two.
struct DividedUnknowns {
  std::vector<std::size_t> searched;
  std::array<std::size_t, 2> following{};
};

/// Requires  of these three: number is one of systems_without_two(), for the last one also kWholeArm.
[[nodiscard]] DividedUnknowns divided_unknowns(const ArmAtPlace& arm, std::size_t number);
/// Returns the two that follow from values of the others, approximately.
[[nodiscard]] std::array<double, 2> approx_following(const ArmAtPlace& arm, std::size_t number,
                                                     std::span<const double> searched);
/// Encloses them; nullopt: they may not follow from all of these.
[[nodiscard]] std::optional<std::array<Interval, 2>> enclose_following(
    const ArmAtPlace& arm, std::size_t number, std::span<const Interval> searched);
[[nodiscard]] RootSystems systems_of_arm(const ArmAtPlace& arm, std::size_t number);
/// The same, where its derivatives are asked to be regular. Its number is that with kFollowedArm.
[[nodiscard]] RootSystems followed_systems_of_arm(const ArmAtPlace& arm, std::size_t number);

}  // namespace regulus::detail
