// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/kernel/cpp/output_label.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/kernel/program/module.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

/// Returns the C++ text of one function of the kernel: its parts, and the function of the ABI that
/// calls them in turn. `meter` counts the operations that are written.
[[nodiscard]] std::string write_function(const Module& module, const Function& function,
                                         const SelectedFunction& selected, WorkMeter& meter);

}  // namespace regulus::detail
