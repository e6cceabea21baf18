// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "runtime/files/temporary.hpp"

namespace regulus::detail {

/// A folder of this object alone in the folder for temporary files; it is removed at the end. Those
/// of processes that were killed are removed by the next one.
class ScratchFolder {
 public:
  /// Throws    FileError.
  ScratchFolder();

  [[nodiscard]] std::filesystem::path path() const { return folder_->path(); }

 private:
  std::optional<TemporaryFolder> folder_;
};

}  // namespace regulus::detail
