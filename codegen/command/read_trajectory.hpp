// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "codegen/model/request.hpp"

namespace regulus::inline command {

/// Returns the request of a motion along way-points; nullopt for another motion.
[[nodiscard]] std::optional<Request> read_trajectory(const ModelOptions& options);

}  // namespace regulus::command
