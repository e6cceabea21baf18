// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "codegen/support/file_descriptor.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus {

/// SHA-256 of a file that grows. Each byte is read once.
class FileDigest {
 public:
  /// Opens the file now: a later file of the same name is another file.
  explicit FileDigest(const std::string& path);

  /// Returns the digest of its first `length` bytes; nullopt if it cannot be read or has fewer.
  ///
  /// Requires  a length that is not less than in the call before.
  [[nodiscard]] std::optional<std::string> of_first(std::uint64_t length);

 private:
  FileDescriptor file_;
  Sha256 digest_;
  std::uint64_t done_ = 0;
};

}  // namespace regulus
