// SPDX-License-Identifier: GPL-3.0-or-later
// Forms the kernel with which condition numbers are bounded.
#pragma once

#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/search_topic.hpp"

namespace regulus::detail {

struct ConditionKernel {
  PreparedSearch prepared;
  /// It has Taylor's expansion of the matrix, and otherwise slopes of the entries.
  bool is_expanded = false;
};

/// Forms the expansion, unless it is too costly.
///
/// Throws    the exceptions of prepare().
[[nodiscard]] ConditionKernel form_condition_kernel(const Request& request,
                                                    const SearchOptions& search,
                                                    const FormingWatch& watch);

/// Names the kernel for other processes.
[[nodiscard]] SearchTopic topic_of(const ConditionKernel& kernel);
[[nodiscard]] bool is_about_condition(const SearchTopic& topic);

/// Forms the same kernel as the process that named it, in any time.
///
/// Requires  is_about_condition(topic).
/// Throws    InternalError if it has another form here; the exceptions of prepare().
[[nodiscard]] PreparedSearch prepare_condition(const SearchTopic& topic, const Request& request,
                                               const SearchOptions& search);

}  // namespace regulus::detail
