// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <csignal>
#include <thread>

namespace regulus::inline command {

/// Turns SIGINT, SIGTERM and SIGHUP into a flag that the search reads, while it lives; not SIGHUP
/// where it is ignored, as nohup has it.
///
/// The signals are blocked and taken by a thread of our own, so nothing runs in a signal handler
/// and no global is needed. Construct it before any other thread starts: threads inherit the mask.
/// A second one ends the process at once, but for SIGHUP: a terminal that closes may send several,
/// and what the first asked for, a checkpoint say, is still to be done. So does the first, after
/// three seconds, where no search has begun by then and nobody else handles the signal, as the
/// shell does: what comes before a search has nothing to report, and may take long.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// From now on a signal is a search's to take.
  void begin_search() noexcept { searching_ = true; }

  /// Asks for an end from within, as a signal does from outside.
  void request() noexcept { requested_ = true; }
  [[nodiscard]] const std::atomic<bool>& requested() const noexcept { return requested_; }

 private:
  void wait_for_signals();
  [[nodiscard]] bool search_begins() const;

  sigset_t watched_{};

  std::atomic<bool> requested_{false};
  std::atomic<bool> searching_{false};
  std::atomic<bool> ending_{false};
  sigset_t previous_{};
  std::thread watcher_;
};

}  // namespace regulus::inline command
