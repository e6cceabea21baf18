// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/file_digest.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace regulus {
namespace {

constexpr std::uint64_t kPart = std::uint64_t{1} << 16;

}  // namespace

FileDigest::FileDigest(const std::string& path)
    : file_(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)) {}

std::optional<std::string> FileDigest::of_first(std::uint64_t length) {
  if (!file_ || length < done_) return std::nullopt;
  std::string part(kPart, '\0');
  while (done_ < length) {
    const ssize_t count = ::pread(file_.get(), part.data(), std::min(kPart, length - done_),
                                  static_cast<off_t>(done_));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    digest_.add(std::string_view(part).substr(0, static_cast<std::size_t>(count)));
    done_ += static_cast<std::uint64_t>(count);
  }
  return digest_.text();
}

}  // namespace regulus
