// SPDX-License-Identifier: GPL-3.0-or-later
// Platforms on six legs in files with loops.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "codegen/model/import/exact_pose.hpp"

namespace regulus::detail {

/// A leg: points that are fixed to the base and to the platform, and a joint that slides along the
/// line between them.
struct HexapodLeg {
  Point base;          ///< A, in the frame of the world, at zero
  Point platform;      ///< B, likewise
  std::string slider;  ///< the joint that is driven
};

struct Hexapod {
  std::string base, platform;  ///< links
  std::array<HexapodLeg, 6> legs;
  Placement home;  ///< of the platform's frame in the world, every joint at zero
};

/// Returns the platform if the mechanism is one: two bodies, and between them six chains that each
/// have a joint that slides, turn about a point of the base before it and about a point of the
/// platform behind it, and leave the platform all six freedoms.
///
/// `base`: a link of the fixed body; empty: the world or the root.
/// Throws    InputError for six chains that do not have these joints.
[[nodiscard]] std::optional<Hexapod> find_hexapod(const Mechanism& mechanism,
                                                  const std::string& file, const std::string& base);

/// Returns the tables [gough], [motion.home] and [motion.around_home] of a model file.
[[nodiscard]] std::string hexapod_text(const Hexapod& hexapod, std::vector<std::string>& notes);

}  // namespace regulus::detail
