// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace regulus::detail {

/// File descriptors for a process's standard streams; -1: the stream of this process.
struct StandardStreams {
  int input = -1, output = -1, errors = -1;
};

/// A program that runs as a child process, started without a shell. The destructor waits for it.
class Subprocess {
 public:
  /// `words`: the program, which is searched for in PATH, and its arguments. The child inherits the
  /// environment and the mask of signals. Throws std::system_error if it cannot be started.
  explicit Subprocess(const std::vector<std::string>& words, const StandardStreams& streams = {});
  Subprocess(const Subprocess&) = delete;
  Subprocess& operator=(const Subprocess&) = delete;
  ~Subprocess();

  /// Waits for the end. Returns the exit code; -1 if a signal ended the process.
  int wait() noexcept;

 private:
  pid_t process_ = -1;
  int exit_code_ = -1;
};

}  // namespace regulus::detail
