// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/cpp/emitted_kernel.hpp"
#include "codegen/program/module.hpp"
#include "codegen/program/work_meter.hpp"

namespace regulus::inline cpp {

/// The C++ text of a module's kernel: one text for ahead-of-time compilation and for the compiler
/// in process. It needs runtime/kernel/abi.hpp and runtime/kernel/pack.hpp, and one of the macros
/// REGULUS_ISA_…; it defines `<prefix>_kernel`.
///
/// Requires  a module that check_module accepts; a prefix that is a C identifier and not "regulus",
///           since regulus_kernel is the type. std::invalid_argument otherwise.
/// Ensures   equal modules and options give equal bytes. Nothing that comes from a model file
///           (names, titles, comments) gets outside a comment or a string literal, except as an
///           identifier of letters, digits and underscores that starts with a prefix of ours.
///           Throws FormingStopped when `watch` says so.
[[nodiscard]] EmittedKernel emit(const Module& module, const EmitOptions& options = {},
                                 const FormingWatch* watch = nullptr);

}  // namespace regulus::inline cpp
