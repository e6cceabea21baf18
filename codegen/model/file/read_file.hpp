// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a file that a user names, up to a limit of bytes. It never waits for a pipe that has no
// writer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace regulus::detail {

/// kFile: a file on a disk. kStream: also a pipe or a device, such as /dev/stdin.
enum class Readable { kFile, kStream };

/// Returns the bytes of a file; nullopt if there is no file of that name.
///
/// Ensures   at most `most` + 1 bytes are held at any time.
/// Throws    FileError: "`path` cannot be read: it is a directory", "it has more than N bytes", …
[[nodiscard]] std::optional<std::string> read_file_if_any(const std::string& path,
                                                          std::uint64_t most, Readable kind);

/// The same, but a file that does not exist is an error.
[[nodiscard]] std::string read_file(const std::string& path, std::uint64_t most, Readable kind);

/// Returns its first `most` bytes, or all if there are fewer. Throws FileError.
[[nodiscard]] std::string read_start(const std::string& path, std::uint64_t most, Readable kind);

}  // namespace regulus::detail
