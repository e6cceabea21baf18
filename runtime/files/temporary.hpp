// SPDX-License-Identifier: Apache-2.0
// The names of temporary files and folders, and the end of those that a killed process left.
#pragma once

#include <fcntl.h>
#include <sys/types.h>

#include <string>

namespace regulus::detail {

/// A file of an earlier run is renamed to NAME.old.
inline constexpr const char* kEarlierEnding = ".old";

/// A new file or folder NAME.XXXXXXXX.regulus, with eight hexadecimal digits that no other has. As
/// long as the descriptor is open, its maker holds its lock (flock), which the kernel releases when
/// the process ends in any way.
struct Temporary {
  std::string name;
  int descriptor = -1;  ///< the owner of this object closes it
};

/// Makes a file. `folder`: `name` is relative to it.
///
/// Throws    std::system_error.
[[nodiscard]] Temporary make_temporary_file(const std::string& name, mode_t mode = 0666,
                                            int folder = AT_FDCWD);

/// Makes a folder. Throws std::system_error.
[[nodiscard]] Temporary make_temporary_folder(const std::string& name, mode_t mode = 0777);

/// Removes the files and folders that killed processes of this user left for `name`. Those that a
/// process still uses stay.
void sweep_temporaries(const std::string& name) noexcept;

/// The same, for all names in a folder; only files.
void sweep_temporary_files(int folder) noexcept;

/// A temporary folder; the destructor removes it with its content, unless it was put in place.
class TemporaryFolder {
 public:
  /// First removes what killed processes left for this name. Throws std::system_error.
  explicit TemporaryFolder(const std::string& name, mode_t mode = 0777);
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  [[nodiscard]] const std::string& path() const noexcept { return folder_.name; }
  /// Waits for the disk and renames the folder. Throws std::system_error.
  void put_in_place_durably(const std::string& name);

 private:
  Temporary folder_;
  bool in_place_ = false;
};

/// Waits until the names in the folder of a file are on the disk.
void sync_folder_of(const std::string& name, int folder = AT_FDCWD) noexcept;

}  // namespace regulus::detail
