// SPDX-License-Identifier: GPL-3.0-or-later
// What the cache keeps of the symbolic stage for the questions with the same forms (forms_key.hpp),
// beside the pack program and the parts of its kernel. A later run of the same program on one of them
// starts with the search.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "codegen/kernel/program/ball_program.hpp"
#include "codegen/question/engine/report_labels.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::detail {

struct WarmStart {
  FormDetail detail = FormDetail::kFull;
  std::optional<BallProgram> matrix;  ///< of a square one
  std::string program_key;            ///< of the kernel's pack program in the cache
  std::string identity;               ///< of that program
};

[[nodiscard]] std::string to_text(const WarmStart& forms);
/// Returns nullopt unless to_text wrote the text.
[[nodiscard]] std::optional<WarmStart> read_warm_start(std::string_view text);

/// True if matrix and program have the sizes of the question, and the program is the one that was
/// kept.
[[nodiscard]] bool fits(const WarmStart& forms, const machine::PackKernel& program,
                        const ReportLabels& question) noexcept;

}  // namespace regulus::detail
