// SPDX-License-Identifier: Apache-2.0
#include "runtime/files/temporary.hpp"

#include <dirent.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <random>
#include <string_view>
#include <system_error>

namespace regulus::detail {
namespace {

constexpr std::string_view kEnding = ".regulus";
constexpr std::size_t kDigits = 8;

std::string temporary_name(const std::string& name) {
  std::random_device random;
  char digits[16];
  std::snprintf(digits, sizeof digits, ".%08x", static_cast<unsigned>(random()));
  return name + digits + std::string(kEnding);
}

/// Returns what stands before the digits; empty for a name of another form.
std::string_view base_of(std::string_view name) {
  constexpr std::size_t kAdded = 1 + kDigits + kEnding.size();
  if (name.size() <= kAdded || !name.ends_with(kEnding)) return {};
  const std::string_view base = name.substr(0, name.size() - kAdded);
  const std::string_view digits = name.substr(base.size() + 1, kDigits);
  const bool is_ours = name[base.size()] == '.' &&
                       digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
  return is_ours ? base : std::string_view();
}

/// A sweep takes a new file between its making and its locking for an abandoned one. It holds the
/// lock, or the name is gone: then another file must be made.
bool is_kept(int descriptor) noexcept {
  struct stat status {};
  const bool is_swept = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  return !is_swept && ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

/// `make` returns a descriptor of the new file, or -1 and errno; EEXIST: with another name.
template <class Make>
Temporary make_new(const std::string& name, const Make& make) {
  constexpr int kTries = 100;
  for (int tries = 0; tries < kTries; ++tries) {
    Temporary made{temporary_name(name), -1};
    made.descriptor = make(made.name.c_str());
    if (made.descriptor < 0 && errno != EEXIST) break;
    if (made.descriptor >= 0 && is_kept(made.descriptor)) return made;
    if (made.descriptor >= 0) ::close(made.descriptor);
  }
  throw std::system_error(errno, std::generic_category(), "be created");
}

/// Removes it if no process holds its lock. Where nothing can be locked, all stay.
void remove_if_abandoned(int folder, const std::string& path, const char* name) {
  constexpr int kReading = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  struct stat status {};
  const int descriptor = ::openat(folder, name, kReading);
  const bool is_ours = descriptor >= 0 && ::fstat(descriptor, &status) == 0 &&
                       status.st_uid == ::geteuid() && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  std::error_code ignored;
  if (is_ours && S_ISREG(status.st_mode)) ::unlinkat(folder, name, 0);
  if (is_ours && S_ISDIR(status.st_mode) && !path.empty())
    std::filesystem::remove_all(std::filesystem::path(path) / name, ignored);
  if (descriptor >= 0) ::close(descriptor);
}

/// `base` empty: of all names. `path` of the folder; empty: only files. Takes the descriptor.
void sweep(int folder, const std::string& path, std::string_view base) {
  DIR* const opened = ::fdopendir(folder);
  if (opened == nullptr) {
    ::close(folder);
    return;
  }
  const std::unique_ptr<DIR, int (*)(DIR*)> stream(opened, ::closedir);
  while (const dirent* item = ::readdir(stream.get())) {
    const std::string_view found = base_of(item->d_name);
    if (!found.empty() && (base.empty() || found == base))
      remove_if_abandoned(::dirfd(stream.get()), path, item->d_name);
  }
}

int open_folder(int folder, const char* path) noexcept {
  return ::openat(folder, path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

}  // namespace

Temporary make_temporary_file(const std::string& name, mode_t mode, int folder) {
  return make_new(name, [&](const char* made) {
    return ::openat(folder, made, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
  });
}

Temporary make_temporary_folder(const std::string& name, mode_t mode) {
  return make_new(name, [&](const char* made) {
    if (::mkdir(made, mode) != 0) return -1;
    const int descriptor = open_folder(AT_FDCWD, made);
    if (descriptor < 0 && errno == ENOENT) errno = EEXIST;  // a sweep was faster
    return descriptor;
  });
}

void sweep_temporaries(const std::string& name) noexcept try {
  const std::size_t start = name.find_last_of('/') + 1;
  const std::string path = start == 0 ? "." : name.substr(0, start);
  const std::string_view base = std::string_view(name).substr(start);
  const int folder = base.empty() ? -1 : open_folder(AT_FDCWD, path.c_str());
  if (folder >= 0) sweep(folder, path, base);
} catch (const std::exception&) {
  // What stays is swept by a later run.
}

void sweep_temporary_files(int folder) noexcept try {
  const int copy = open_folder(folder, ".");
  if (copy >= 0) sweep(copy, "", "");
} catch (const std::exception&) {
  // The same.
}

void sync_folder_of(const std::string& name, int folder) noexcept {
  const std::size_t length = name.find_last_of('/') + 1;
  const std::string parent = length == 0 ? "." : name.substr(0, length);
  const int directory = ::openat(folder, parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return;
  ::fsync(directory);
  ::close(directory);
}

TemporaryFolder::TemporaryFolder(const std::string& name, mode_t mode) {
  sweep_temporaries(name);
  folder_ = make_temporary_folder(name, mode);
}

/// Removed before its lock is released, as a file is.
TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!in_place_) std::filesystem::remove_all(folder_.name, ignored);
  ::close(folder_.descriptor);
}

void TemporaryFolder::put_in_place_durably(const std::string& name) {
  if (::fsync(folder_.descriptor) != 0)
    throw std::system_error(errno, std::generic_category(), "be written");
  if (std::rename(folder_.name.c_str(), name.c_str()) != 0)
    throw std::system_error(errno, std::generic_category(), "be put in its place");
  in_place_ = true;
  sync_folder_of(name);
}

}  // namespace regulus::detail
