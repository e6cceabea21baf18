// SPDX-License-Identifier: GPL-3.0-or-later
// The ranges of the joints of an arm that follow none.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/model/import/chain.hpp"

namespace regulus::detail {

struct RangeOfJoint {
  JointLimits range;
  std::string remark;  ///< a comment, or empty
};

/// Returns the values that the limits of a joint, and of those that follow it, leave to it; nullopt if
/// none of them has limits.
///
/// Requires  each of `followers` follows the joint by a rule.
/// Throws    InputError if no value is within the limits.
[[nodiscard]] std::optional<RangeOfJoint> limits_of(
    const ImportedJoint& joint, const std::vector<const ImportedJoint*>& followers,
    const std::string& file);

/// Returns the values that a joint may have: within its own limits, and so that those which follow it
/// are within theirs. Without limits, all poses of a joint that turns without end, counted in the
/// turns after which the joints that follow it are where they were; else an assumption, which becomes
/// a note.
///
/// Throws    InputError if no value is within the limits.
[[nodiscard]] RangeOfJoint range_of(const ImportedJoint& joint, const Chain& chain,
                                    const std::string& file, std::vector<std::string>& notes);

}  // namespace regulus::detail
