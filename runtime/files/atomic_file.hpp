// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <sys/types.h>

#include <string>
#include <string_view>

namespace regulus::detail {

/// True for a name that is written to and not replaced: of a device, a pipe, a socket, or of an open
/// file of this process, such as /dev/stdout.
[[nodiscard]] bool is_stream(const std::string& name);

/// Writes a file that appears under its name only when it is complete. Until then it has a
/// temporary name in the same folder (temporary.hpp); a file that is not put in place is removed.
///
/// A link stays, and its target is replaced. A file that was there passes on its permissions. Bytes
/// for a stream go there at once.
///
/// Errors    std::system_error, whose text completes the sentence "the file cannot ...".
class AtomicFile {
 public:
  /// First removes what killed processes left for this name.
  explicit AtomicFile(const std::string& name);
  /// For a file in a folder that is open, where it replaces a link, too. The caller sweeps.
  AtomicFile(std::string name, mode_t mode, int folder);
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
  void make_temporary(mode_t mode);
  void keep_permissions();

  std::string name_;
  std::string temporary_;  ///< empty: a stream
  int folder_ = AT_FDCWD;
  int descriptor_ = -1;
  bool in_place_ = false;
};

}  // namespace regulus::detail
