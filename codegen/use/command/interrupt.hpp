// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <csignal>
#include <thread>

namespace regulus::detail {

/// During its lifetime, turns SIGINT, SIGTERM and SIGHUP into a flag that the search reads; not
/// SIGHUP if it is ignored, as after nohup.
///
/// The signals are blocked, and a separate thread receives them, so nothing runs in a signal
/// handler and no global is needed. Construct it before any other thread starts, because threads
/// inherit the mask. A second signal ends the process at once, except SIGHUP: a closing terminal
/// may send several, and the work after the first, such as a checkpoint, must still be done. A
/// first signal ends the process after three seconds if no search has begun by then and no other
/// code handles the signal, as the shell does: the stages before a search have nothing to report,
/// and may take long.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// From now on the search handles signals.
  void begin_search() noexcept { searching_ = true; }

  /// Requests an end from inside the program, as a signal does from outside.
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

}  // namespace regulus::detail
