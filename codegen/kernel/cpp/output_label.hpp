// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "codegen/kernel/program/module.hpp"

namespace regulus::detail {

/// Returns the label of output number `output` for readers: "(K·A)[0][2]", "∂(K·A)[1][1]/∂x". Not
/// sanitised: variables keep their own names.
[[nodiscard]] std::string output_label(const Module& module, const Function& function,
                                       std::size_t output);

}  // namespace regulus::detail
