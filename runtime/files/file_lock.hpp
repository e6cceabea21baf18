// SPDX-License-Identifier: Apache-2.0
// One run at a time: whoever writes a file over and over holds the lock beside it.
#pragma once

#include <string>

namespace regulus {

/// Holds `path`.lock. The kernel gives it back when the process ends, however it does: what a
/// process that was killed leaves behind locks nobody out.
class FileLock {
 public:
  /// Throws std::runtime_error when another process holds it, and when no lock can be had there.
  explicit FileLock(const std::string& path);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace regulus
