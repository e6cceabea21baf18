// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "runtime/cluster/workers.hpp"

namespace regulus::detail::cluster {

/// Everything on which the outcomes of units depend, besides the kernel, for a process of the same
/// build that has the same kernel.
struct SearchDescription {
  /// Without the kernels.
  Problem problem;
  /// Without what belongs to one process: threads, budgets, interrupts, oracles, filters.
  Settings settings;
  Learned learned;
};

[[nodiscard]] std::string write_search(const Problem& problem, const Settings& settings,
                                       const Learned& learned);
/// Accepts any bytes. Throws MalformedMessage.
[[nodiscard]] SearchDescription read_search(std::string_view bytes);

}  // namespace regulus::detail::cluster
