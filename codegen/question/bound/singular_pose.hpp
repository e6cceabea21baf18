// SPDX-License-Identifier: GPL-3.0-or-later
// A pose where the matrix of the model is singular, looked for as `check` does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "codegen/question/bound/bound_run.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

struct SingularPose {
  AttainedPlace place;
  Result result;
  std::set<std::string> uncertain;  ///< as in a certificate
  std::size_t piece = 0;            ///< of a motion along way-points
};

/// Returns nullopt if none was found in `seconds`. Adds the boxes of the search to `boxes`.
///
/// Throws    the exceptions of prepare().
[[nodiscard]] std::optional<SingularPose> find_singular_pose(const Request& request,
                                                             const BoundSettings& settings,
                                                             double seconds, std::uint64_t& boxes);

}  // namespace regulus::detail
