// SPDX-License-Identifier: GPL-3.0-or-later
// The C++ text of a kernel that a person has edited.
#pragma once

#include <optional>
#include <string>

#include "codegen/kernel/jit/jit.hpp"
#include "codegen/kernel/program/module.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

/// The file of a text, by which reports name it.
struct EditedText {
  std::string path;
  std::string sha256;
};

struct EditedKernel {
  EditedText text;
  CompiledKernel code;
};

/// Compiles the text of a file by Clang. The text is what emit_kernel wrote for `module`, with other
/// forms of the same functions.
///
/// Ensures   the kernel has the sizes, the functions and the lists of derivatives of the module's
///           own. Whether its functions enclose those of the model is not proved.
/// Throws    FileError; InputError for a text that does not compile, that was written for another
///           question, or that lacks a function; NoCompiler.
[[nodiscard]] EditedKernel compile_edited(const std::string& path, const Module& module,
                                          const CompileOptions& options);

/// Compares a kernel with the module's own, at eight points of the ranges.
///
/// Returns   the output of a function whose two enclosures have no number in common, in words: then
///           the kernel computes another function. nullopt: no difference is seen, which is no proof.
[[nodiscard]] std::optional<std::string> find_difference(const regulus_kernel& edited,
                                                         const Module& module,
                                                         const std::vector<Interval>& ranges,
                                                         Isa isa);

}  // namespace regulus::detail
