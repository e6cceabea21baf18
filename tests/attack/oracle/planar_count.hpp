// SPDX-License-Identifier: GPL-3.0-or-later
// Counts the poses of a planar platform on three legs by its resultant, in exact arithmetic.
#pragma once

#include <array>
#include <optional>

#include "tests/attack/oracle/rational.hpp"

namespace regulus::detail::attack {

struct PlanarPlatform {
  std::array<std::array<Rational, 2>, 3> base, platform;
  std::array<Rational, 3> squares;  ///< of the lengths
};

struct PlanarCount {
  std::optional<std::size_t> poses;  ///< nullopt: the resultant does not tell
  bool is_multiple = false;          ///< some pose is multiple
};

/// The differences of the equations are linear in x and y; what is left is a polynomial in t = tan(φ/2),
/// whose real roots are counted by Sturm's theorem.
[[nodiscard]] PlanarCount count_planar_poses(const PlanarPlatform& robot);

}  // namespace regulus::detail::attack
