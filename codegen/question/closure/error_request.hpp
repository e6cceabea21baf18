// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/model/request.hpp"

namespace regulus {

/// A motion of a closure with an own parameter for each error, which are 0 at the start. The
/// parameters of the motion come first, then control errors, then errors of the geometry.
struct ErrorRequest {
  Request request;
  std::size_t parameters = 0;  ///< of the motion
};

/// Throws    UsageError if nothing has an error, or if points lie in balls.
[[nodiscard]] ErrorRequest with_errors_as_parameters(const Request& given);

}  // namespace regulus
