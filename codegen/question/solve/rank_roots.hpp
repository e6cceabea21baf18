// SPDX-License-Identifier: GPL-3.0-or-later
// The systems of the searches for solutions at a place, for a process that judges boxes of another one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/model/request.hpp"
#include "codegen/question/solve/root_judge.hpp"

namespace regulus::detail {

/// Returns the request whose equations have a kernel; nullopt: the systems have none.
///
/// Requires  a request of read_solve_request().
[[nodiscard]] std::optional<Request> kernel_request(const Request& request);

/// Returns the systems of this number; those without unknowns if the question has none. They have no
/// kernel.
///
/// Requires  !kernel_request(request).
/// Throws    as solve().
[[nodiscard]] RootSystems systems_of(const Request& request, const std::vector<std::string>& held,
                                     std::size_t number);

}  // namespace regulus::detail
