// SPDX-License-Identifier: GPL-3.0-or-later
// Calls from Python to the algebra thread.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>

#include "codegen/python/algebra_thread.hpp"

namespace regulus::inline python {

/// How long Ctrl-C waits at most until Python sees it.
inline constexpr std::chrono::milliseconds kLookForSignals{50};

/// Waits for a task without Python's lock. If a signal handler of Python throws, such as that of
/// Ctrl-C, the task is interrupted, and its end is waited for.
///
/// Returns   the exception of the handler, if there was one.
inline std::optional<pybind11::error_already_set> wait_for(AlgebraThread& thread,
                                                           AlgebraTask& task) {
  std::optional<pybind11::error_already_set> thrown;
  while (true) {
    {
      const pybind11::gil_scoped_release unlocked;
      if (thread.wait(task, kLookForSignals)) return thrown;
    }
    if (PyErr_CheckSignals() == 0) continue;
    thrown.emplace();
    if (thread.interrupt(task)) return thrown;
  }
}

/// Runs `work` in the algebra thread, which must not touch Python's objects, and returns its result.
///
/// Throws    what `work` threw; the exception of a signal handler, whose attribute `partial` is then
///           the result of the interrupted work, or None if it had not begun.
template <class Work>
auto run_there(Work work) {
  using Result = std::invoke_result_t<Work, const std::atomic<bool>&>;
  AlgebraThread& thread = AlgebraThread::of_this_process();
  const auto result = std::make_shared<std::optional<Result>>();
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

}  // namespace regulus::python
