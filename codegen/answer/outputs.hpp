// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a question, and what every answer does with its services.
#pragma once

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/report/output_options.hpp"
#include "codegen/answer/services.hpp"
#include "codegen/model/model_options.hpp"
#include "codegen/question/engine/options.hpp"
#include "codegen/support/work_meter.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::detail {

/// Renames the files of earlier runs: the certificate, the checkpoint, the lines and the pictures of
/// `services`. Throws as set_earlier_outputs_aside.
void set_outputs_aside(const ModelOptions& model, const SearchOptions& search,
                       const Services& services);
/// The same with other files for the certificate, such as those of both ends of a bracket.
void set_outputs_aside(const ModelOptions& model, const SearchOptions& search,
                       const Services& services, std::vector<OutputFile> certificates);

/// Returns the watch of the stages before a search.
[[nodiscard]] FormingWatch watch_of(const Services& services);
/// Returns the watch of the reading of a model, which ends at the time limit, too.
[[nodiscard]] FormingWatch watch_of(const Services& services, const SearchOptions& search);
/// Returns what says whether a terminal shows the progress.
[[nodiscard]] OutputOptions display_of(const Services& services);

/// Returns what `read` returns; nothing if it throws. A question is refused before the files of an
/// earlier run are set aside. What is wrong with the model is said afterwards, when it is read again:
/// no file of another model may stay under its name.
template <class Read>
[[nodiscard]] auto if_readable(const Read& read) -> decltype(read()) try {
  return read();
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace regulus::detail
