// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>

namespace regulus::detail::bench {

inline double seconds_on(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Returns the processor time of this thread. Other work on the machine does not count, except by
/// its effect on caches and clock rate.
inline double thread_seconds() { return seconds_on(CLOCK_THREAD_CPUTIME_ID); }

/// Returns the processor time of all threads together.
inline double process_seconds() { return seconds_on(CLOCK_PROCESS_CPUTIME_ID); }

/// Returns the time on the wall: for several threads, and for processes.
inline double wall_seconds() { return seconds_on(CLOCK_MONOTONIC); }

}  // namespace regulus::detail::bench
