// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/read_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// A file is read in parts of these sizes: most are small, and memory that is not used costs time, too.
constexpr std::uint64_t kLeastPart = 1 << 14, kMostPart = 1 << 20;

class Opened {
 public:
  /// O_NONBLOCK: a pipe without a writer opens at once, and has no bytes.
  explicit Opened(const std::string& path)
      : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (descriptor_ < 0 && errno != ENOENT) fail(std::strerror(errno));
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  ~Opened() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  [[nodiscard]] bool exists() const noexcept { return descriptor_ >= 0; }
  [[noreturn]] void fail(const std::string& why) const {
    throw FileError(path_ + " cannot be read: " + why);
  }

  /// Returns the size of a file on a disk, 0 for a stream.
  std::uint64_t require(Readable kind) const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) fail(std::strerror(errno));
    if (S_ISDIR(status.st_mode)) fail("it is a directory");
    if (S_ISREG(status.st_mode)) return static_cast<std::uint64_t>(status.st_size);
    if (kind == Readable::kFile) fail("it is not a regular file");
    // Wait for the bytes that a writer has not sent yet.
    if (::fcntl(descriptor_, F_SETFL, 0) != 0) fail(std::strerror(errno));
    return 0;
  }

  /// Returns the first `most` bytes, or all if there are fewer.
  [[nodiscard]] std::string start(std::uint64_t most) const {
    std::string bytes;
    while (bytes.size() < most) {
      const std::size_t had = bytes.size();
      const std::uint64_t part = std::clamp<std::uint64_t>(had, kLeastPart, kMostPart);
      bytes.resize(had + std::min(part, most - had));
      const ssize_t count = ::read(descriptor_, bytes.data() + had, bytes.size() - had);
      const int error = errno;
      bytes.resize(had + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
      if (count == 0) break;
      if (count < 0 && error != EINTR) fail(std::strerror(error));
    }
    return bytes;
  }

 private:
  const std::string& path_;
  int descriptor_;
};

}  // namespace

std::optional<std::string> read_file_if_any(const std::string& path, std::uint64_t most,
                                            Readable kind) {
  const Opened file(path);
  if (!file.exists()) return std::nullopt;
  std::string bytes;
  const bool fits = file.require(kind) <= most;
  if (fits) bytes = file.start(most + 1);
  if (!fits || bytes.size() > most)
    file.fail("it has more than " + std::to_string(most) + " bytes");
  return bytes;
}

std::string read_file(const std::string& path, std::uint64_t most, Readable kind) {
  std::optional<std::string> bytes = read_file_if_any(path, most, kind);
  if (!bytes) throw FileError(path + " cannot be read: there is no such file");
  return std::move(*bytes);
}

std::string read_start(const std::string& path, std::uint64_t most, Readable kind) {
  const Opened file(path);
  if (!file.exists()) file.fail("there is no such file");
  static_cast<void>(file.require(kind));
  return file.start(most);
}

}  // namespace regulus::detail
