// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/question/engine/search_subject.hpp"
#include "runtime/problem/result.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// Withdraws a claim of a paving about all poses if some of them are out of reach. Unless the motion
/// says where = "reachable", these are part of the question, and the matrix is undefined there.
void keep_poses_out_of_reach(const SearchSubject& preparation, const Volumes& volumes,
                             Result& result);

}  // namespace regulus::detail
