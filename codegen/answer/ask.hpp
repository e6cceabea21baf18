// SPDX-License-Identifier: GPL-3.0-or-later
// The one way to an answer, for the command, the shell, C++, Python, the page and the ranks of a
// cluster. It alone knows which motions follow way-points.
#pragma once

#include <memory>

#include "codegen/answer/asked.hpp"
#include "codegen/answer/kinds.hpp"
#include "codegen/answer/services.hpp"

namespace regulus::detail {

/// Answers a question. Files of earlier runs that the services would write are first renamed to
/// FILE.old; those that are written are complete when it returns.
///
/// Threads   The answer holds objects of GiNaC, which belong to the calling thread.
/// Throws    InputError for the model, UsageError for the motion, the options and services that the
///           question does not have (refusals.hpp), FileError, CompileError and InternalError.
[[nodiscard]] std::unique_ptr<Answer> ask(const Asked& asked, const Services& services);

/// The same, and writes the page of the answer if Services::page names a file.
[[nodiscard]] std::unique_ptr<Answer> ask_and_show(const Asked& asked, const Services& services);

[[nodiscard]] std::unique_ptr<CheckAnswer> ask(const AskCheck& asked, const Services& services);
[[nodiscard]] std::unique_ptr<PavingAnswer> ask(const AskPaving& asked, const Services& services);
[[nodiscard]] std::unique_ptr<MarginAnswer> ask(const AskMargin& asked, const Services& services);
[[nodiscard]] std::unique_ptr<BoundAnswer> ask(const AskBound& asked, const Services& services);
[[nodiscard]] std::unique_ptr<LoadAnswer> ask(const AskLoad& asked, const Services& services);
[[nodiscard]] std::unique_ptr<LoadPavingAnswer> ask(const AskLoadPaving& asked,
                                                    const Services& services);
[[nodiscard]] std::unique_ptr<DatasheetAnswer> ask(const AskDatasheet& asked,
                                                   const Services& services);
/// Returns true if the question is about many places, each for itself. Throws InputError for the model.
[[nodiscard]] bool is_about_places(const AskSolve& asked);
/// Returns null, and writes no file, for a process that is not the first of Services::places.
[[nodiscard]] std::unique_ptr<SolveAnswer> ask(const AskSolve& asked, const Services& services);

}  // namespace regulus::detail
