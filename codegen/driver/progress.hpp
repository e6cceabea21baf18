// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>

#include "regulus/codegen/driver/options.hpp"
#include "regulus/codegen/program/work_meter.hpp"
#include "regulus/search/observer.hpp"

namespace regulus::codegen {

/// Shows on a terminal how far a search is: boxes, volume decided, rate, time. One line, rewritten
/// a few times a second, erased at the end. Construct it only when the stream is a terminal.
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
  Clock::time_point start_{};
  Clock::time_point last_{};
  double decided_ = 0;  ///< part of the root's volume, 0 … 1; for display only
  bool shown_ = false;
};

/// Shows on a terminal how far a stage before the search is.
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

/// Watches for an interrupt, and shows the progress of what it watches if standard error is a
/// terminal and nobody asked for quiet.
[[nodiscard]] FormingWatch forming_watch(const OutputOptions& output,
                                         const std::atomic<bool>* interrupt);

}  // namespace regulus::codegen
