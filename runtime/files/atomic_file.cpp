// SPDX-License-Identifier: Apache-2.0
#include "runtime/files/atomic_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

namespace regulus {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

AtomicFile::AtomicFile(std::string name, std::string temporary, mode_t mode, int folder)
    : name_(std::move(name)), temporary_(std::move(temporary)), folder_(folder) {
  const int flags = O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC;
  descriptor_ = ::openat(folder_, temporary_.c_str(), flags, mode);
  if (descriptor_ < 0) fail("be created");
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : name_(std::move(other.name_)),
      temporary_(std::move(other.temporary_)),
      folder_(other.folder_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      in_place_(other.in_place_) {}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (!in_place_) ::unlinkat(folder_, temporary_.c_str(), 0);
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail("be written");
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void AtomicFile::put_in_place() {
  if (::renameat(folder_, temporary_.c_str(), folder_, name_.c_str()) != 0)
    fail("be put in its place");
  in_place_ = true;
}

/// The folder is synchronised too: otherwise the renaming could be lost with the power.
void AtomicFile::put_in_place_durably() {
  if (::fsync(descriptor_) != 0) fail("be written");
  put_in_place();
  const std::string parent = name_.substr(0, name_.find_last_of('/') + 1);
  const int directory =
      ::openat(folder_, parent.empty() ? "." : parent.c_str(), O_RDONLY | O_CLOEXEC);
  if (directory < 0) return;
  ::fsync(directory);
  ::close(directory);
}

}  // namespace regulus
