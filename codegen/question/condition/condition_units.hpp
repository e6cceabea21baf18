// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes of the search of a condition number as units for other threads and processes.
#pragma once

#include <span>
#include <string_view>

#include "codegen/question/condition/box_judge.hpp"
#include "runtime/cluster/workers.hpp"

namespace regulus {

/// Each box of the unit has one more range, from 0 to `attained`: so its outcome depends on the unit
/// alone.
///
/// Requires  1 to kLanes boxes; attained ≥ 0.
[[nodiscard]] cluster::Unit unit_of(std::span<const BoxJudge::Box> boxes, double attained);

/// Makes deciders of such units. The parts of the question must outlive them.
[[nodiscard]] cluster::MakeDecider condition_deciders(const ConditionQuestion& question);

/// Reads the outcome of a unit with as many boxes as `findings`. ConditionBound::growth is not a part
/// of it: only the decider needs it.
///
/// Throws    MalformedMessage; std::bad_alloc if the decider had not enough memory.
void read_findings(std::string_view outcome, const ConditionQuestion& question,
                   std::span<BoxFinding> findings);

}  // namespace regulus
