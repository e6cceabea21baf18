// SPDX-License-Identifier: GPL-3.0-or-later
// Calls from Python to the algebra thread.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>

#include "codegen/use/python/algebra_thread.hpp"

namespace regulus::detail {

/// How long Ctrl-C waits at most until Python sees it. Only the main thread handles signals.
inline constexpr std::chrono::milliseconds kLookForSignals{50};
inline constexpr std::chrono::hours kNoLook{1};

/// Waits for a task, for some time, without Python's lock. A thread that is still waiting for the
/// lock when Python ends is unwound from there, so no destructor may take the lock.
inline bool wait_unlocked(AlgebraThread& thread, const AlgebraTask& task,
                          std::chrono::milliseconds most) {
  PyThreadState* const state = PyEval_SaveThread();
  const bool done = thread.wait(task, most);
  PyEval_RestoreThread(state);
  return done;
}

inline bool is_main_thread() {
  const auto threading = pybind11::module_::import("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

/// Waits for a task. If a signal handler of Python throws, such as that of Ctrl-C, the task is
/// interrupted, and its end is waited for.
///
/// Returns   the exception of the handler, if there was one.
inline std::optional<pybind11::error_already_set> wait_for(AlgebraThread& thread,
                                                           AlgebraTask& task) {
  std::optional<pybind11::error_already_set> thrown;
  const std::chrono::milliseconds most = is_main_thread() ? kLookForSignals : kNoLook;
  while (!wait_unlocked(thread, task, most)) {
    if (PyErr_CheckSignals() == 0) continue;
    thrown.emplace();
    if (thread.interrupt(task)) break;
  }
  return thrown;
}

/// Runs `work` in the algebra thread, which must not touch Python's objects, and returns its result.
///
/// Throws    what `work` threw; the exception of a signal handler, whose attribute `partial` is then
///           the result of the interrupted work, or None if it had not begun.
template <class Work>
auto run_there(Work work) {
  using Returned = std::invoke_result_t<Work, const std::atomic<bool>&>;
  AlgebraThread& thread = AlgebraThread::of_this_process();
  const auto result = std::make_shared<std::optional<Returned>>();
  const auto task =
      thread.add([result, work = std::move(work)](const std::atomic<bool>& interrupt) {
        result->emplace(work(interrupt));
      });
  if (auto thrown = wait_for(thread, *task)) {
    thrown->value().attr("partial") =
        *result ? pybind11::cast(std::move(**result)) : pybind11::none();
    throw *thrown;
  }
  task->rethrow();
  return std::move(**result);
}

}  // namespace regulus::detail
