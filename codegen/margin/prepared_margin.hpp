// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "codegen/margin/margin_certificates.hpp"
#include "codegen/margin/margin_question.hpp"
#include "codegen/margin/margin_run.hpp"

namespace regulus::inline bracketing {

/// Throws UsageError unless the text is a number between 0 and 1.
[[nodiscard]] double read_gap(const std::string& text);

/// Everything a bracket needs: one kernel serves at every value.
struct PreparedMargin {
  /// Throws what prepare() throws, and UsageError for a search that cannot be made.
  PreparedMargin(const MarginQuestion& question, const ModelOptions& model,
                 const SearchOptions& options, FormingWatch watch);

  MarginRequest request;
  SearchOptions search;
  PreparedSearch prepared;
  Settings settings;
};

}  // namespace regulus::inline bracketing
