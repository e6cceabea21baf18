// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "codegen/model/request.hpp"

namespace regulus::detail {

/// Returns the request of a motion along way-points; nullopt for another motion, whose model need
/// not have been read. Throws as read_request().
[[nodiscard]] std::optional<Request> read_trajectory(const ModelOptions& options,
                                                     const FormingWatch& watch = {});

}  // namespace regulus::detail
