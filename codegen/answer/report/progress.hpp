// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "codegen/answer/report/output_options.hpp"
#include "codegen/support/work_meter.hpp"
#include "runtime/cluster/workers.hpp"

namespace regulus::detail {

/// The progress of a search.
struct SearchProgress {
  std::uint64_t boxes = 0;
  std::uint64_t waiting = 0;
  double decided = 0;     ///< part of the volume, 0 … 1; for display only
  double seconds = 0;     ///< since the search began
  double time_limit = 0;  ///< of the search, in seconds; infinite: none
  std::string workers{};  ///< of a cluster; empty: threads
};

/// Returns a line of at most `columns` bytes: a bar of the share decided if there is room for it,
/// the share, boxes, boxes in a second, the time, and the time that is left of a limit.
[[nodiscard]] std::string describe_progress(const SearchProgress& progress, std::size_t columns);

/// Shows the progress of a search on a terminal, on one line, rewritten a few times a second,
/// erased at the end. Construct it only if the stream is a terminal.
class ProgressDisplay : public Observer {
 public:
  explicit ProgressDisplay(std::FILE* terminal) : terminal_(terminal) {}

  void on_start(const Problem&, const Settings&) noexcept override;
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;
  void on_progress(const Statistics& statistics, std::uint64_t frontier) noexcept override;
  void on_finish(const Result& result) noexcept override;

 private:
  using Clock = std::chrono::steady_clock;

  std::FILE* terminal_;
  const cluster::Workers* workers_ = nullptr;  ///< of the search; null: threads
  double time_limit_ = 0;                      ///< of the search, in seconds
  Clock::time_point start_{};
  Clock::time_point last_{};
  double decided_ = 0;  ///< part of the root's volume, 0 … 1; for display only
  bool shown_ = false;
};

/// A ProgressDisplay if standard error is a terminal and the output is not quiet; otherwise
/// nothing.
class SearchDisplay {
 public:
  explicit SearchDisplay(const OutputOptions& output);
  /// Returns nullptr if nothing is shown.
  [[nodiscard]] Observer* observer() noexcept { return display_ ? &*display_ : nullptr; }

 private:
  std::optional<ProgressDisplay> display_;
};

/// Shows the progress of a stage before the search on a terminal.
class FormingDisplay {
 public:
  explicit FormingDisplay(std::FILE* terminal) : terminal_(terminal) {}
  ~FormingDisplay();
  FormingDisplay(const FormingDisplay&) = delete;
  FormingDisplay& operator=(const FormingDisplay&) = delete;

  void show(WorkStage stage, std::uint64_t work, std::uint64_t most);

 private:
  using Clock = std::chrono::steady_clock;

  std::FILE* terminal_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
  bool shown_ = false;
};

/// Returns a watch for interrupts, which also shows progress if standard error is a terminal and
/// the output is not quiet.
[[nodiscard]] FormingWatch forming_watch(const OutputOptions& output,
                                         const std::atomic<bool>* interrupt);

}  // namespace regulus::detail
