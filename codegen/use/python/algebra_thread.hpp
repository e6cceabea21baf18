// SPDX-License-Identifier: GPL-3.0-or-later
// The one thread of a Python process that works with GiNaC and CLN: their objects belong to the
// thread that made them, and threads of Python come and go.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace regulus::detail {

/// Work that should end soon after `interrupt` becomes true.
using AlgebraWork = std::function<void(const std::atomic<bool>& interrupt)>;

class AlgebraTask {
 public:
  /// Requires  the task is done.
  /// Throws    what the work threw.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  friend class AlgebraThread;
  enum class State { kWaiting, kRunning, kDone };

  AlgebraWork work_;
  std::atomic<bool> interrupt_{false};
  State state_ = State::kWaiting;
  bool is_late_ = false;  ///< added after stop()
  std::exception_ptr failure_;
};

class AlgebraThread {
 public:
  /// Returns the thread of this process, which the first call starts. A process that was forked gets
  /// one of its own.
  ///
  /// Throws    std::runtime_error if the process was forked while the thread was at work: its
  ///           objects are then in no defined state.
  static AlgebraThread& of_this_process();
  /// Stops the thread of this process, if it has one.
  static void stop_in_this_process();

  AlgebraThread();
  AlgebraThread(const AlgebraThread&) = delete;
  AlgebraThread& operator=(const AlgebraThread&) = delete;

  /// Adds work, which begins after all earlier work has ended. After stop() the task is done, and
  /// has failed.
  [[nodiscard]] std::shared_ptr<AlgebraTask> add(AlgebraWork work);
  /// Waits for the end of a task, but not longer than `most`. Returns true if it is done. If stop()
  /// is called meanwhile, it never returns: the thread that waits must not go back to Python, which
  /// is ending.
  [[nodiscard]] bool wait(const AlgebraTask& task, std::chrono::milliseconds most);
  /// Asks a task to end soon. Returns true if it was withdrawn before it began: it is done then.
  bool interrupt(AlgebraTask& task);

 private:
  /// Interrupts the task at work, drops the others, and waits for the thread.
  void stop();
  void run();

  std::mutex mutex_;
  std::condition_variable added_, done_;
  std::deque<std::shared_ptr<AlgebraTask>> waiting_;
  std::shared_ptr<AlgebraTask> running_;
  std::atomic<bool> is_busy_{false};
  bool stopped_ = false;
  std::thread thread_;
};

}  // namespace regulus::detail
