// SPDX-License-Identifier: GPL-3.0-or-later
// Reading a file that a user names: no more of it than can be meant, and never waiting for one that
// nobody writes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace regulus::inline model {

/// kFile: one on a disk. kStream: also what comes from a pipe or a device, such as /dev/stdin.
enum class Readable { kFile, kStream };

/// The bytes of a file; nullopt if there is none of that name.
///
/// Ensures   at most `most` + 1 bytes are held at any time.
/// Throws    FileError: "`path` cannot be read: it is a directory", "it has more than N bytes", …
[[nodiscard]] std::optional<std::string> read_file_if_any(const std::string& path,
                                                          std::uint64_t most, Readable kind);

/// The same; a file that does not exist is an error, too.
[[nodiscard]] std::string read_file(const std::string& path, std::uint64_t most, Readable kind);

/// Its first bytes, all if there are no more than that. Throws FileError.
[[nodiscard]] std::string read_start(const std::string& path, std::uint64_t most, Readable kind);

}  // namespace regulus::inline model
