// SPDX-License-Identifier: Apache-2.0
#include "runtime/files/atomic_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <utility>

#include "runtime/files/temporary.hpp"

namespace regulus::detail {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* what, int error = errno) {
  throw std::system_error(error, std::generic_category(), what);
}

/// Returns N for /dev/fd/N and /proc/self/fd/N; otherwise -1.
int descriptor_in(std::string_view name) {
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!name.starts_with(folder)) continue;
    const std::string_view digits = name.substr(folder.size());
    int descriptor = -1;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), descriptor);
    if (error == std::errc{} && end == digits.data() + digits.size()) return descriptor;
  }
  return -1;
}

/// Follows links to the file that they name, which need not exist; a link to an open file of this
/// process is not followed.
std::string target_of(std::string name) {
  constexpr int kMostLinks = 40;
  std::error_code none;
  for (int links = 0; descriptor_in(name) < 0 && fs::is_symlink(name, none); ++links) {
    const fs::path target = fs::read_symlink(name, none);
    if (none || links == kMostLinks) fail("be created", ELOOP);
    name = (fs::path(name).parent_path() / target).string();
  }
  return name;
}

bool is_device_or_pipe(const std::string& name) {
  struct stat status {};
  return ::stat(name.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

/// A copy of an open descriptor has its place in the file: nothing overwrites what comes next.
int open_stream(const std::string& name) {
  const int open = descriptor_in(name);
  return open >= 0 ? ::fcntl(open, F_DUPFD_CLOEXEC, 0) : ::open(name.c_str(), O_WRONLY | O_CLOEXEC);
}

}  // namespace

bool is_stream(const std::string& name) try {
  const std::string target = target_of(name);
  return descriptor_in(target) >= 0 || is_device_or_pipe(target);
} catch (const std::system_error&) {
  return false;
}

AtomicFile::AtomicFile(const std::string& name) : name_(target_of(name)) {
  if (descriptor_in(name_) >= 0 || is_device_or_pipe(name_)) {
    descriptor_ = open_stream(name_);
    if (descriptor_ < 0) fail("be opened");
    return;
  }
  if (std::error_code none; fs::is_directory(name_, none)) fail("be created", EISDIR);
  sweep_temporaries(name_);
  make_temporary(0666);
  keep_permissions();
}

AtomicFile::AtomicFile(std::string name, mode_t mode, int folder)
    : name_(std::move(name)), folder_(folder) {
  make_temporary(mode);
}

void AtomicFile::make_temporary(mode_t mode) {
  Temporary made = make_temporary_file(name_, mode, folder_);
  temporary_ = std::move(made.name);
  descriptor_ = made.descriptor;
}

/// A file that its owner protects from writing is not replaced, although the folder would allow it.
void AtomicFile::keep_permissions() {
  struct stat status {};
  if (::stat(name_.c_str(), &status) != 0) return;
  const bool is_kept =
      ::access(name_.c_str(), W_OK) == 0 && ::fchmod(descriptor_, status.st_mode & 0777U) == 0;
  const int error = errno;
  if (is_kept) return;
  ::close(descriptor_);
  ::unlink(temporary_.c_str());
  fail("be written", error);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : name_(std::move(other.name_)),
      temporary_(std::move(other.temporary_)),
      folder_(other.folder_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      in_place_(other.in_place_) {}

/// Removed before its lock is released: a sweep never sees it.
AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  if (!in_place_ && !temporary_.empty()) ::unlinkat(folder_, temporary_.c_str(), 0);
  ::close(descriptor_);
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
  if (!temporary_.empty() && ::renameat(folder_, temporary_.c_str(), folder_, name_.c_str()) != 0)
    fail("be put in its place");
  in_place_ = true;
}

/// The folder is synchronised too: otherwise the renaming could be lost with the power.
void AtomicFile::put_in_place_durably() {
  if (!temporary_.empty() && ::fsync(descriptor_) != 0) fail("be written");
  put_in_place();
  if (!temporary_.empty()) sync_folder_of(name_, folder_);
}

}  // namespace regulus::detail
