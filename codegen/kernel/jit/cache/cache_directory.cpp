// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/cache/cache_directory.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace regulus::detail {
namespace {

std::filesystem::path absolute_path_in(const char* variable) {
  const char* value = std::getenv(variable);
  std::filesystem::path path = value ? value : "";
  return path.is_absolute() ? path : std::filesystem::path();
}

/// Parents get the mode of the XDG specification, too.
bool create(const std::filesystem::path& directory) {
  if (::mkdir(directory.c_str(), 0700) == 0 || errno == EEXIST) return true;
  if (errno != ENOENT || !directory.has_parent_path() || directory.parent_path() == directory)
    return false;
  return create(directory.parent_path()) &&
         (::mkdir(directory.c_str(), 0700) == 0 || errno == EEXIST);
}

std::string reason_to_refuse(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return "cannot be examined";
  if (status.st_uid != ::geteuid()) return "belongs to another user";
  if (status.st_mode & (S_IWGRP | S_IWOTH)) return "is writable by other users";
  return {};
}

}  // namespace

std::filesystem::path default_cache_directory() {
  if (auto cache = absolute_path_in("XDG_CACHE_HOME"); !cache.empty()) return cache / "regulus";
  if (auto home = absolute_path_in("HOME"); !home.empty()) return home / ".cache" / "regulus";
  return {};
}

CacheDirectory open_cache_directory(const std::filesystem::path& directory) {
  if (directory.empty()) return {{}, "neither XDG_CACHE_HOME nor HOME is an absolute path"};
  const std::string name = "cache directory " + directory.string() + " ";
  if (!create(directory)) return {{}, name + "cannot be created: " + std::strerror(errno)};
  FileDescriptor descriptor(
      ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (!descriptor) {
    std::error_code ignored;
    const bool link = errno == ELOOP || std::filesystem::is_symlink(directory, ignored);
    return {{}, name + (link ? "is a symbolic link" : "cannot be opened")};
  }
  if (auto reason = reason_to_refuse(descriptor.get()); !reason.empty()) return {{}, name + reason};
  return {std::move(descriptor), {}};
}

}  // namespace regulus::detail
