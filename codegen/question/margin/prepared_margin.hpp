// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/margin/margin_question.hpp"

namespace regulus::detail {

/// Throws UsageError unless the text is a number between 0 and 1.
[[nodiscard]] double read_gap(const std::string& text);

/// Returns the options of a search that is worth a compiler before it begins.
[[nodiscard]] SearchOptions compiled_first(SearchOptions options);

/// All data of a bracket: one kernel is used for every value.
struct PreparedMargin {
  /// `nominal`: a request that has been read in `model_seconds`.
  /// Throws    the exceptions of prepare(), and UsageError for a search that is not possible.
  PreparedMargin(const MarginQuestion& question, Request nominal, double model_seconds,
                 const SearchOptions& options, FormingWatch watch);

  MarginRequest request;
  SearchOptions search;
  PreparedSearch prepared;
  Settings settings;
};

}  // namespace regulus::detail
