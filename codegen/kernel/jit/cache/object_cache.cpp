// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/cache/object_cache.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <memory>
#include <set>
#include <span>
#include <system_error>
#include <vector>

#include "codegen/kernel/jit/cache/cache_entry.hpp"
#include "runtime/files/atomic_file.hpp"
#include "runtime/files/temporary.hpp"

namespace regulus::detail {
namespace {

constexpr std::string_view kEntrySuffix = ".object";
constexpr off_t kMaximumEntrySize = off_t{1} << 28;

/// To look at all entries takes long if they are many, so it is done only after this part of the
/// limit has been written. The rest of the limit stays free for what is written until then.
constexpr std::uint64_t kSweepsPerLimit = 16;
/// The file that grows by one byte for each this part of the limit that is written.
constexpr std::uint64_t kMarksPerSweep = 2048;
constexpr const char* kMarksName = "written-since-sweep";

std::string entry_name(std::string_view key) { return std::string(key).append(kEntrySuffix); }

/// Returns the reason not to trust the open file; empty if it is trusted.
std::string reason_to_distrust(const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return "is not a regular file";
  if (status.st_uid != ::geteuid()) return "belongs to another user";
  if (status.st_mode & (S_IWGRP | S_IWOTH)) return "is writable by other users";
  if (status.st_size > kMaximumEntrySize) return "is too large";
  return {};
}

/// Returns the bytes of the file, or fewer if it shrinks meanwhile.
std::string read_all(int descriptor, std::size_t size) {
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::read(descriptor, bytes.data() + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

struct DirectoryFile {
  std::string name;
  std::uint64_t size;
  std::time_t used;
};

std::vector<DirectoryFile> list_entries(int directory) {
  std::vector<DirectoryFile> files;
  FileDescriptor copy(::openat(directory, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  DIR* opened = copy ? ::fdopendir(copy.get()) : nullptr;
  if (!opened) return files;
  copy.release();
  const std::unique_ptr<DIR, int (*)(DIR*)> stream(opened, ::closedir);
  while (const dirent* item = ::readdir(stream.get())) {
    struct stat status {};
    if (!std::string_view(item->d_name).ends_with(kEntrySuffix)) continue;
    if (::fstatat(directory, item->d_name, &status, AT_SYMLINK_NOFOLLOW) == 0 &&
        S_ISREG(status.st_mode))
      files.push_back({item->d_name, static_cast<std::uint64_t>(status.st_size), status.st_mtime});
  }
  return files;
}

/// Adds the bytes of new entries to those written since the last sweep. Returns true if a sweep is
/// due, and then counts from zero again. Processes may append at the same time.
bool is_sweep_due(int directory, std::uint64_t bytes, std::uint64_t limit) {
  const int flags = O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  const FileDescriptor marks(::openat(directory, kMarksName, flags, 0600));
  struct stat status {};
  if (!marks || ::fstat(marks.get(), &status) != 0 || !S_ISREG(status.st_mode)) return true;
  const std::uint64_t count =
      bytes * kSweepsPerLimit * kMarksPerSweep / std::max<std::uint64_t>(limit, 1) + 1;
  const std::string more(std::min(count, kMarksPerSweep), '.');
  const bool is_new = status.st_size == 0;
  if (!is_new && static_cast<std::uint64_t>(status.st_size) + more.size() < kMarksPerSweep)
    return ::write(marks.get(), more.data(), more.size()) != static_cast<ssize_t>(more.size());
  const bool begins_again = ::ftruncate(marks.get(), 1) == 0;
  static_cast<void>(begins_again);  // if not, the next write sweeps, too
  return true;
}

void evict_down_to(int directory, std::uint64_t limit, const std::set<std::string>& kept) {
  auto files = list_entries(directory);
  std::uint64_t total = 0;
  for (const DirectoryFile& file : files) total += file.size;
  if (total <= limit) return;
  std::ranges::sort(files, {}, &DirectoryFile::used);
  for (const DirectoryFile& file : files) {
    if (total <= limit) return;
    if (kept.contains(file.name)) continue;
    if (::unlinkat(directory, file.name.c_str(), 0) == 0) total -= file.size;
  }
}

}  // namespace

ObjectCache::ObjectCache(const std::filesystem::path& directory, std::uint64_t limit)
    : directory_(open_cache_directory(directory)), limit_(limit) {}

ObjectCache::Entry ObjectCache::read(std::string_view key) const {
  if (!directory_.descriptor) return {};
  const std::string name = entry_name(key);
  // O_NONBLOCK: if the entry is a pipe, opening it must not wait for a writer.
  const FileDescriptor file(::openat(directory_.descriptor.get(), name.c_str(),
                                     O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file && errno == ENOENT) return {};
  if (!file) return {{}, "cache entry cannot be opened: " + std::string(std::strerror(errno))};
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) return {{}, "cache entry cannot be examined"};
  if (const auto reason = reason_to_distrust(status); !reason.empty())
    return {{}, "cache entry " + reason};
  auto object =
      open_cache_entry(key, read_all(file.get(), static_cast<std::size_t>(status.st_size)));
  if (!object) return {{}, "cache entry is damaged"};
  ::futimens(file.get(), nullptr);  // the time of the last use decides the eviction
  return {std::move(object), {}};
}

std::string ObjectCache::write(std::string_view key, std::string_view object) const {
  return write({{key, object}});
}

std::string ObjectCache::write(const std::vector<NamedObject>& objects) const {
  if (!directory_.descriptor) return refusal();
  std::set<std::string> written;
  std::uint64_t bytes = 0;
  std::string reason;
  for (const NamedObject& object : objects) {
    reason = write_entry(object);
    if (!reason.empty()) break;  // the next one would probably fail, too
    written.insert(entry_name(object.key));
    bytes += sizeof(CacheEntryHeader) + object.object.size();
  }
  const int directory = directory_.descriptor.get();
  if (written.empty() || !is_sweep_due(directory, bytes, limit_)) return reason;
  sweep_temporary_files(directory);
  evict_down_to(directory, limit_ - limit_ / kSweepsPerLimit, written);
  return reason;
}

/// Does not wait for the disk: after a crash, a half-written entry is found as damaged.
std::string ObjectCache::write_entry(const NamedObject& named) const {
  const auto [key, object] = named;
  const int directory = directory_.descriptor.get();
  const CacheEntryHeader header = make_cache_entry_header(key, object);
  if (sizeof header + object.size() > limit_) return "the object is larger than the whole cache";
  try {
    AtomicFile file(entry_name(key), 0600, directory);
    file.write({reinterpret_cast<const char*>(&header), sizeof header});
    file.write(object);
    file.put_in_place();
  } catch (const std::system_error& error) {
    return "cache entry cannot " + std::string(error.what());
  }
  return {};
}

}  // namespace regulus::detail
