// SPDX-License-Identifier: Apache-2.0
// Allows one run at a time: a run that rewrites a file holds the lock beside it.
#pragma once

#include <string>

namespace regulus::detail {

/// Holds `path`.lock. The kernel releases the lock when the process ends in any way. So the file
/// that a killed process leaves behind locks nothing.
///
/// A file of this name is used, and removed at the end, only if it is empty or a lock wrote it, and
/// has no other name. Any other file stays as it is.
class FileLock {
 public:
  /// Throws std::runtime_error if another process holds it, or if no lock can be made there.
  ///
  /// Ensures   nothing is made or changed if it throws.
  explicit FileLock(const std::string& path);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  /// Locks the open file.
  void take(const std::string& path) const;

  std::string path_;
  int descriptor_ = -1;
};

}  // namespace regulus::detail
