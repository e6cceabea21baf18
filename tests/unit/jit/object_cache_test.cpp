// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/cache/object_cache.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "runtime/files/temporary.hpp"
#include "tests/support/cache_entries.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

const std::string kKey(64, 'a');
const std::string kOtherKey(64, 'b');

class ObjectCacheTest : public testing::Test {
 protected:
  test::TemporaryDirectory directory_;
  std::filesystem::path path_ = directory_.path() / "new" / "cache";

  [[nodiscard]] std::filesystem::path entry(const std::string& key) const {
    return path_ / (key + ".object");
  }
  [[nodiscard]] std::size_t entries() const { return test::cache_entries(path_).size(); }
};

TEST_F(ObjectCacheTest, GivesBackWhatWasWritten) {
  const ObjectCache cache(path_);
  EXPECT_EQ(cache.refusal(), "");
  EXPECT_FALSE(cache.read(kKey).object);
  const std::string object("bytes\0and more", 14);
  EXPECT_EQ(cache.write(kKey, object), "");
  EXPECT_EQ(cache.read(kKey).object, object);
  EXPECT_FALSE(cache.read(kOtherKey).object);
  EXPECT_EQ(ObjectCache(path_).read(kKey).object, object);
}

TEST_F(ObjectCacheTest, ReplacesAnEntry) {
  const ObjectCache cache(path_);
  EXPECT_EQ(cache.write(kKey, "first"), "");
  EXPECT_EQ(cache.write(kKey, "second"), "");
  EXPECT_EQ(cache.read(kKey).object, "second");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(ObjectCacheTest, CreatesPrivateDirectoriesAndFiles) {
  const ObjectCache cache(path_);
  EXPECT_EQ(cache.write(kKey, "object"), "");
  struct stat status {};
  ASSERT_EQ(::stat(path_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0700u);
  ASSERT_EQ(::stat(entry(kKey).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0600u);
}

TEST_F(ObjectCacheTest, EvictsWhatWasUsedLeastRecently) {
  const std::string object(1000, 'x');
  const ObjectCache cache(path_, 3 * 1300);
  const std::vector<std::string> keys{std::string(64, '0'), std::string(64, '1'),
                                      std::string(64, '2')};
  for (std::size_t i = 0; i < keys.size(); ++i) {
    EXPECT_EQ(cache.write(keys[i], object), "");
    const timespec old[2] = {{1000 + static_cast<std::time_t>(i), 0},
                             {1000 + static_cast<std::time_t>(i), 0}};
    ASSERT_EQ(::utimensat(AT_FDCWD, entry(keys[i]).c_str(), old, 0), 0);
  }
  EXPECT_TRUE(cache.read(keys[0]).object);  // now the most recently used
  EXPECT_EQ(cache.write(kKey, object), "");
  EXPECT_TRUE(cache.read(keys[0]).object);
  EXPECT_FALSE(cache.read(keys[1]).object);
  EXPECT_TRUE(cache.read(keys[2]).object);
  EXPECT_TRUE(cache.read(kKey).object);
}

std::string key_of(int i) { return std::string(60, '0') + std::to_string(1000 + i); }

TEST_F(ObjectCacheTest, StaysWithinItsLimitAlthoughItSeldomLooksAtAllEntries) {
  const ObjectCache cache(path_, 200'000);
  const std::string object(1000, 'x');
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(cache.write(key_of(i), object), "");
    std::uintmax_t bytes = 0;
    if (i % 50 == 49)
      for (const auto& file : test::cache_entries(path_)) bytes += std::filesystem::file_size(file);
    ASSERT_LE(bytes, 200'000U);
  }
  EXPECT_GE(entries(), 200'000U * 7 / 8 / 1200);
}

TEST_F(ObjectCacheTest, LooksAtAllEntriesOnlyAfterMuchWasWritten) {
  const ObjectCache cache(path_);
  EXPECT_EQ(cache.write(kKey, "object"), "");
  const auto abandoned = path_ / "1.object.00000001.regulus";
  std::ofstream(abandoned) << "x";
  EXPECT_EQ(cache.write(kOtherKey, "object"), "");
  EXPECT_TRUE(std::filesystem::exists(abandoned));
}

TEST_F(ObjectCacheTest, RemovesWhatInterruptedWritersLeft) {
  const ObjectCache cache(path_);
  const auto abandoned = path_ / "1.object.00000001.regulus";
  std::ofstream(abandoned) << "x";
  const Temporary in_use = make_temporary_file(path_ / "2.object");
  EXPECT_EQ(cache.write(kKey, "object"), "");
  EXPECT_FALSE(std::filesystem::exists(abandoned));
  EXPECT_TRUE(std::filesystem::exists(in_use.name));
  ::close(in_use.descriptor);
}

/// Each value repeats one character, so that a mixture of two writers is visible.
bool writes_and_reads_whole_entries(const std::filesystem::path& path, int process) {
  const ObjectCache cache(path);
  for (int round = 0; round < 100; ++round) {
    const std::string key(64, static_cast<char>('0' + round % 3));
    const std::string object(5000 + static_cast<std::size_t>(round) * 13,
                             static_cast<char>('A' + process));
    if (!cache.write(key, object).empty()) return false;
    const auto entry = cache.read(key);
    if (!entry.object || entry.object->empty()) return false;
    if (std::ranges::count(*entry.object, entry.object->front()) !=
        static_cast<std::ptrdiff_t>(entry.object->size()))
      return false;
  }
  return true;
}

TEST_F(ObjectCacheTest, ServesProcessesThatWriteTheSameEntriesAtOnce) {
  std::vector<pid_t> children;
  for (int process = 0; process < 4; ++process) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) ::_exit(writes_and_reads_whole_entries(path_, process) ? 0 : 1);
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  EXPECT_EQ(entries(), 3U);
}

/// Sets an environment variable for one test.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    value ? ::setenv(name, value, 1) : ::unsetenv(name);
  }
  ~Variable() { old_ ? ::setenv(name_, old_->c_str(), 1) : ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(DefaultCacheDirectory, FollowsTheXdgSpecification) {
  const Variable home("HOME", "/home/somebody");
  {
    const Variable cache("XDG_CACHE_HOME", "/var/mine");
    EXPECT_EQ(default_cache_directory(), "/var/mine/regulus");
  }
  for (const char* not_absolute : {static_cast<const char*>(nullptr), "", "relative/path"}) {
    const Variable cache("XDG_CACHE_HOME", not_absolute);
    EXPECT_EQ(default_cache_directory(), "/home/somebody/.cache/regulus");
  }
}

TEST(DefaultCacheDirectory, IsEmptyWithoutAHome) {
  const Variable home("HOME", nullptr);
  const Variable cache("XDG_CACHE_HOME", nullptr);
  EXPECT_EQ(default_cache_directory(), "");
}

}  // namespace
}  // namespace regulus::detail
