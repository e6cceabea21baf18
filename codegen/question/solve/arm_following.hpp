// SPDX-License-Identifier: GPL-3.0-or-later
// Postures are followed while the geometry of an arm is anywhere within its tolerances.
//
// The equations F of a system without two unknowns are the same for both sides of the loop, so a movement of the whole
// arm that the loop allows moves its unknowns by a null vector of F's derivatives, or does not move them. Then the two
// joints that are left out move against each other: their axes are one line, of which the direction L is ±k and the
// place P is along k. There the row of k·L has no derivatives, as both lengths are constant; of an arm with two
// unknowns those of k·P and |P|² are multiples of each other. So where F's derivatives are regular at a posture, the
// Jacobian is, too.
//
// A search finds boxes all over which they are, and which hold all postures at all geometries. These are a closed and
// bounded set, as joints that turn come back and slides do not leave their ranges, and the geometries are connected.
// So each posture goes on without a jump from one geometry to all others, and none comes or goes.
#pragma once

#include <map>

#include "codegen/question/solve/arm_slides.hpp"
#include "codegen/question/solve/followed_tubes.hpp"

namespace regulus::detail {

/// Returns where unknowns of an arm are searched, and their periods. A little more than a turn is searched.
[[nodiscard]] FollowedRanges ranges_of_arm(const ArmAtPlace& arm,
                                           const std::map<std::size_t, SlideRange>& slides,
                                           std::span<const std::size_t> unknowns);

/// A box of the searched unknowns of a system as one of all; those that are not searched have a whole turn.
[[nodiscard]] std::vector<Interval> box_of_all(const ArmAtPlace& arm, std::size_t number,
                                               const std::map<std::size_t, SlideRange>& slides,
                                               const std::vector<Interval>& searched);

/// Follows all postures of the nominal arm.
///
/// `number`: of the system whose unknowns are searched; kWholeArm: all.
/// Requires  arm within its tolerances; postures: as follow_in_ranges() does, of all unknowns.
/// Ensures   as follow_in_ranges(), but that `parts` are of the searched unknowns.
/// Rounding  outward; MXCSR at nearest.
[[nodiscard]] SolutionTubes follow_postures(const ArmAtPlace& arm, std::size_t number,
                                            const std::map<std::size_t, SlideRange>& slides,
                                            const std::vector<std::vector<Interval>>& postures,
                                            RootSettings settings, Observer* progress);

}  // namespace regulus::detail
