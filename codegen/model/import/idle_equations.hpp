// SPDX-License-Identifier: GPL-3.0-or-later
// Equations of closed loops that are always true: those of a planar loop that is written in space.
#pragma once

#include <string>
#include <vector>

#include "codegen/model/import/loop_closing.hpp"

namespace regulus::detail {

inline constexpr double kClosedGap = 1e-9;  ///< a larger gap is open

struct IdleEquations {
  std::vector<GiNaC::ex> exact;    ///< the gap, loop after loop
  std::vector<char> idle;          ///< parts of it that are always 0, or follow from others
  std::vector<std::size_t> most;   ///< by loop: equations that are left
  std::vector<std::string> notes;  ///< for the report
};

/// `symbols`: one for each variable of the graph.
///
/// Requires  the loops are closed at the pose.
/// Ensures   exact algebra shows of each idle part that it is 0 wherever the joints are, or follows.
/// Throws    InputError for an equation that is nearly always true.
[[nodiscard]] IdleEquations find_idle_equations(const LoopGraph& graph,
                                                const std::vector<CutLoop>& loops,
                                                const LoopPose& pose,
                                                const std::vector<GiNaC::ex>& symbols,
                                                const std::string& file);

/// True if exact algebra shows that the gap does not depend on a joint, or on its sum or difference
/// with another one of `others` alone.
[[nodiscard]] bool is_idle_joint(std::size_t variable, const std::vector<std::size_t>& others,
                                 const LoopPose& pose, const std::vector<GiNaC::ex>& exact,
                                 const std::vector<GiNaC::ex>& symbols);

/// Returns a hundredth of the length of a loop that the joint is in.
[[nodiscard]] double reach_of(const LoopGraph& graph, std::size_t variable);

}  // namespace regulus::detail
