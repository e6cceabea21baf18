// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <sys/types.h>

#include <string>
#include <string_view>

namespace regulus {

/// Writes a file that appears under its name only when it is complete. Until then it has a
/// temporary name in the same folder; a file that is not put in place is removed.
///
/// Errors    std::system_error, whose text completes the sentence "the file cannot ...".
class AtomicFile {
 public:
  /// Replaces a file that has the temporary name. Names are relative to the folder.
  AtomicFile(std::string name, std::string temporary, mode_t mode = 0666, int folder = AT_FDCWD);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  void write(std::string_view bytes);
  void put_in_place();
  /// Also waits for the disk, so that a power failure leaves either the old file or the new one.
  void put_in_place_durably();

 private:
  std::string name_;
  std::string temporary_;
  int folder_;
  int descriptor_ = -1;
  bool in_place_ = false;
};

}  // namespace regulus
