// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a prepared search, with more digits and exact algebra if needed.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <vector>

#include "codegen/question/engine/pipeline.hpp"
#include "runtime/checkpoint/checkpoint.hpp"
#include "runtime/cluster/search_description.hpp"
#include "runtime/problem/observer.hpp"

namespace regulus::detail {
struct BoxSearchSettings;

/// Returns the seconds of a time limit that remain after the stages before the search.
[[nodiscard]] double seconds_left(const PreparedSearch& preparation, double time_limit);

/// Sets the threads, the workers and the limits of a search of boxes after these stages.
void set_limits(BoxSearchSettings& settings, const PreparedSearch& preparation,
                const SearchOptions& search, const std::atomic<bool>* interrupt);

/// Searches the whole variety of the preparation; records time and bits in the preparation. If
/// forming was stopped, the search ends for the same reason before its first box.
[[nodiscard]] Result run_search(PreparedSearch& preparation, const SearchOptions& search,
                                Settings settings, Observer* observer = nullptr,
                                const Checkpoint* from = nullptr);

/// Returns the state from which a search continues. It may judge boxes with the settings, which have
/// the oracles of the search, and take the time for that from their limit.
using Restore = std::function<Checkpoint(const Problem&, Settings&, Observer&)>;

/// The same, from a state that is made when all is ready to judge boxes.
[[nodiscard]] Result continue_search(PreparedSearch& preparation, const SearchOptions& search,
                                     Settings settings, Observer* observer, const Restore& restore);

/// Returns the problem of a search that another process runs, with the kernel of the own one. Throws
/// InternalError if it has other variables.
[[nodiscard]] Problem problem_of_another(const Problem& own,
                                         const cluster::SearchDescription& description);

/// Calls `decide` with the problem and the settings of a search that another process runs: with the
/// kernel, the digits and the closed form of this one. Throws InternalError if the other process
/// has another kernel.
void decide_for_another(PreparedSearch& preparation, const SearchOptions& search,
                        const cluster::SearchDescription& description,
                        const std::function<void(const Problem&, const Settings&)>& decide);

/// Proves a singularity at the first of these points of the variety, or between it and one of the
/// others, and refines the witness (see prove_singularity).
[[nodiscard]] Result prove_between(PreparedSearch& preparation, const SearchOptions& search,
                                   Settings settings, std::span<const std::vector<double>> points);

/// Refines the witness of the first singularity of a paving, whose points are as far apart as its
/// box is wide. If this fails, the result is unchanged.
void close_in_on_witness(PreparedSearch& preparation, const SearchOptions& search,
                         Settings settings, Result& result);

}  // namespace regulus::detail
