// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/kernel/cpp/emitted_kernel.hpp"
#include "codegen/kernel/program/module.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

/// Returns the C++ text of a module's kernel, the same for ahead-of-time compilation and for the
/// compiler in process. It needs runtime/kernel/abi.hpp and runtime/kernel/pack.hpp, and one of the
/// macros REGULUS_ISA_…; it defines `<prefix>_kernel`.
///
/// Requires  a module that check_module accepts; a prefix that is a C identifier and not "regulus",
///           since regulus_kernel is the type. std::invalid_argument otherwise.
/// Ensures   equal modules and options give equal bytes. Text from a model file (names, titles,
///           comments) appears only in comments and string literals, or as an identifier of
///           letters, digits and underscores that starts with our prefix. Throws FormingStopped if
///           `watch` stops it.
[[nodiscard]] EmittedKernel emit(const Module& module, const EmitOptions& options = {},
                                 const FormingWatch* watch = nullptr);

}  // namespace regulus::detail
