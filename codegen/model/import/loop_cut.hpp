// SPDX-License-Identifier: GPL-3.0-or-later
// A loop is cut at one place, and its equations say what must meet there.
//
// A loop is cut at the joint that leaves the fewest equations: at a ball, whose angles are then no
// unknowns; at a joint that turns, at best one without limits, which need a value; else anywhere. Between two balls is a rod, which may spin: only
// the distance of their centres counts.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "codegen/model/import/loop_graph.hpp"

namespace regulus::detail {

/// Two ways from one frame, whose ends must meet.
struct LoopArc {
  std::vector<LoopStep> left, right;
};

struct CutLoop {
  enum class Kind { kBall, kHinge, kWeld, kRod };
  Kind kind = Kind::kWeld;
  std::string name;
  int line = 0;
  LoopArc arc;                               ///< of a rod: what is between its balls
  LoopArc other;                             ///< of a rod: the other way between them
  std::size_t hinge{};                       ///< the joint that was cut
  std::string at;                            ///< where it was cut
  std::vector<std::string> made_balls{};     ///< of three joints: their names
  std::vector<std::size_t> without_value{};  ///< variables of joints that are cut

  /// Returns the number of equations without what is always true.
  [[nodiscard]] std::size_t equations() const;
};

/// `driven`: variables that motors give. Joints of two loops are not cut, nor are those that others
/// follow.
/// Throws    InputError for a ball that two loops share, and for a loop of more than two balls.
[[nodiscard]] std::vector<CutLoop> cut_loops(const LoopGraph& graph,
                                             const std::set<std::size_t>& driven,
                                             const std::string& file);

}  // namespace regulus::detail
