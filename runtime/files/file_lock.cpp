// SPDX-License-Identifier: Apache-2.0
#include "runtime/files/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace regulus {
namespace {

[[noreturn]] void fail(const std::string& path) {
  throw std::runtime_error(path + " cannot be locked: " + std::strerror(errno));
}

/// Returns the process that wrote its number there; empty if it cannot be read.
std::string owner_in(int descriptor) {
  char text[24] = {};
  const ssize_t size = ::pread(descriptor, text, sizeof text - 1, 0);
  return size > 0 ? " (process " + std::string(text, static_cast<std::size_t>(size)) + ")" : "";
}

/// Returns true if a descriptor and a path are still the same file.
bool is_file_at(int descriptor, const std::string& path) noexcept {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

void write_owner(int descriptor) noexcept {
  char text[24];
  const int size = std::snprintf(text, sizeof text, "%ld", static_cast<long>(::getpid()));
  // For people only: a process that cannot write it still holds the lock.
  if (::ftruncate(descriptor, 0) != 0 || ::pwrite(descriptor, text, std::size_t(size), 0) < 0)
    errno = 0;
}

}  // namespace

/// The previous holder may remove the file between our opening it and our locking it. Then our lock
/// protects nothing, and we must make another file.
FileLock::FileLock(const std::string& path) : path_(path + ".lock") {
  for (;;) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(path);
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const int error = errno;
      const std::string owner = owner_in(descriptor_);
      ::close(descriptor_);
      errno = error;
      if (error != EWOULDBLOCK) fail(path);
      throw std::runtime_error(path + " is in use by another run" + owner);
    }
    if (is_file_at(descriptor_, path_)) break;
    ::close(descriptor_);
  }
  write_owner(descriptor_);
}

/// Removes it first: no other process can hold the lock of this file until it is closed.
FileLock::~FileLock() {
  ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace regulus
