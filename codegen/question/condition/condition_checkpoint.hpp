// SPDX-License-Identifier: GPL-3.0-or-later
// A search of a condition number in the file of --checkpoint.
#pragma once

#include <string>

#include "codegen/question/bound/bound_checkpoint.hpp"
#include "codegen/question/condition/condition_search.hpp"

namespace regulus {

/// Searches, continues from the state in the file if there is one, and saves states there.
/// `checkpoint` may be null.
///
/// Throws    InputError if the file has no such state, but something in its place; FileError if it
///           cannot be written.
[[nodiscard]] ConditionResult search_with_checkpoint(const ConditionQuestion& question,
                                                     ConditionSettings settings, Observer* progress,
                                                     BoundCheckpoint* checkpoint);

/// Says why a search is not closed.
[[nodiscard]] std::string describe_end(const ConditionResult& result);

}  // namespace regulus
