// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a branch that constraints exclude.
#pragma once

#include <vector>

#include "codegen/question/closure/branch_search.hpp"

namespace regulus::detail {

/// Takes the tubes of excluded leaves from them, if the other tubes are neighbours of each other
/// without them: a proof says less of such a leaf. Otherwise they join the parts of the branch, and stay.
///
/// Requires  the tubes are those of one branch.
void drop_excluded_tubes(BranchTree& tree, const std::vector<Interval>& root);

}  // namespace regulus::detail
