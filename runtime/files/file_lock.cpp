// SPDX-License-Identifier: Apache-2.0
#include "runtime/files/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace regulus::detail {
namespace {

/// Before the number of the process.
constexpr std::string_view kMark = "regulus lock ";
constexpr std::size_t kMostBytes = 40;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw std::runtime_error(path + " cannot be locked: " + why);
}

/// Returns the number of the process that wrote the file, which may be empty; nullopt if it is
/// another program's.
std::optional<std::string> owner_in(int descriptor) {
  struct stat status {};
  char bytes[kMostBytes + 1];
  const ssize_t size = ::pread(descriptor, bytes, sizeof bytes, 0);
  if (size < 0 || ::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode) ||
      status.st_nlink > 1)
    return std::nullopt;
  if (size == 0) return "";
  std::string_view text(bytes, static_cast<std::size_t>(size));
  if (!text.starts_with(kMark) || !text.ends_with('\n') || text.size() > kMostBytes)
    return std::nullopt;
  text = text.substr(kMark.size(), text.size() - kMark.size() - 1);
  if (text.empty() || text.find_first_not_of("0123456789") != std::string_view::npos)
    return std::nullopt;
  return std::string(text);
}

/// Returns true if a descriptor and a path are still the same file.
bool is_file_at(int descriptor, const std::string& path) noexcept {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

void write_owner(int descriptor) noexcept {
  char text[kMostBytes + 1];
  const int size =
      std::snprintf(text, sizeof text, "%s%ld\n", kMark.data(), static_cast<long>(::getpid()));
  // For people, and for the next run: a process that cannot write it still holds the lock.
  if (::ftruncate(descriptor, 0) != 0 || ::pwrite(descriptor, text, std::size_t(size), 0) < 0)
    errno = 0;
}

/// Opens a file that may be another program's, so nothing is changed. O_NONBLOCK: a pipe opens at
/// once.
int open_lock(const std::string& path) noexcept {
  constexpr int kOpening = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  for (;;) {
    const int made = ::open(path.c_str(), kOpening | O_CREAT | O_EXCL, 0666);
    if (made >= 0 || errno != EEXIST) return made;
    const int found = ::open(path.c_str(), kOpening);
    if (found >= 0 || errno != ENOENT) return found;
  }
}

}  // namespace

FileLock::FileLock(const std::string& path) : path_(path + ".lock") {
  do {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = open_lock(path_);
    if (descriptor_ < 0) fail(path, path_ + ": " + std::strerror(errno));
    try {
      take(path);
    } catch (...) {
      ::close(descriptor_);
      throw;
    }
    // The previous holder may remove the file between our opening it and our locking it. Then our
    // lock protects nothing, and we must make another file.
  } while (!is_file_at(descriptor_, path_));
  write_owner(descriptor_);
}

void FileLock::take(const std::string& path) const {
  const bool is_taken = ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0;
  const int error = is_taken ? errno : 0;
  const std::optional<std::string> owner = owner_in(descriptor_);
  if (!owner)
    fail(path, path_ + " is a file of another program; choose another name, or move that file");
  if (error == EWOULDBLOCK)
    throw std::runtime_error(path + " is in use by another run" +
                             (owner->empty() ? "" : " (process " + *owner + ")"));
  if (is_taken) fail(path, path_ + ": " + std::strerror(error));
}

/// Removes it first: no other process can hold the lock of this file until it is closed.
FileLock::~FileLock() {
  if (is_file_at(descriptor_, path_)) ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace regulus::detail
