// SPDX-License-Identifier: GPL-3.0-or-later
// The result of the symbolic stage for a problem. The cache keeps it beside the pack program and
// the parts of its kernel, so a later run of the same program on the same question starts with the
// search.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/kernel/jit/jit.hpp"
#include "codegen/kernel/program/ball_program.hpp"
#include "codegen/question/engine/options.hpp"
#include "codegen/question/engine/report_labels.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus {

struct WarmStart {
  ReportLabels labels;
  Variety variety;
  std::optional<BallProgram> matrix;  ///< of a square one
  std::string program_key;            ///< of the kernel's pack program in the cache
  std::string identity;               ///< of that program
};

/// Returns the name of a warm start in the cache.
///
/// Shape     64 hexadecimal digits.
/// Requires  `program` and `compiler` change whenever either may give another result for a
///           question.
/// Ensures   two questions that differ in a byte of the model file, in the motion or any change to
///           it, in a function that is formed or a way of forming it, in the instruction set, the
///           program or the compiler have different keys, up to collisions of SHA-256. No key of an
///           object is equal to one of them.
[[nodiscard]] std::string warm_start_key(std::string_view model_text, const ModelOptions& model,
                                         const FormulationOptions& functions, Isa isa,
                                         std::string_view program, std::string_view compiler);

/// Writes bounds as hexadecimal numbers, so they are read back exactly.
[[nodiscard]] std::string to_text(const WarmStart& problem);
/// Returns nullopt unless to_text wrote the text.
[[nodiscard]] std::optional<WarmStart> read_warm_start(std::string_view text);

/// True if a program has the problem's sizes and is the source of its kernel.
[[nodiscard]] bool fits(const WarmStart& problem, const machine::PackKernel& program) noexcept;

}  // namespace regulus
