// SPDX-License-Identifier: Apache-2.0
// Files that a user names. Reading does not wait for a pipe that nobody writes.
#pragma once

#include <streambuf>
#include <string>
#include <vector>

namespace regulus::verifier {

/// A stream buffer over the bytes of a file, of a pipe that has a writer or has been written, or of
/// a device such as /dev/stdin. A failure to read sets the bad state of the stream.
class InputFile final : public std::streambuf {
 public:
  /// Throws std::runtime_error for a file that cannot be opened, a directory, and a pipe that
  /// nobody writes.
  explicit InputFile(const std::string& path);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile() override;

 private:
  [[noreturn]] void fail(const std::string& why);
  int_type underflow() override;

  const std::string path_;
  int descriptor_;
  std::vector<char> buffer_;
};

/// Returns the whole file. Throws std::runtime_error, also if it is longer than `most` bytes.
[[nodiscard]] std::string read_text(const std::string& path, std::size_t most);

}  // namespace regulus::verifier
