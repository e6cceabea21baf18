// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "codegen/kernel/cpp/emitted_kernel.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/kernel/program/module.hpp"

namespace regulus::detail {

/// Returns the description of a kernel as JSON for other programs: the model, the shapes of its
/// functions and their cost. `selected` is in the order of module.functions.
[[nodiscard]] std::string write_manifest(const Module& module, const EmitOptions& options,
                                         const EmittedKernel& kernel,
                                         const std::vector<SelectedFunction>& selected);

}  // namespace regulus::detail
