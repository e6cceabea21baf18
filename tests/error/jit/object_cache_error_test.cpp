// SPDX-License-Identifier: GPL-3.0-or-later
// A cache that is not sound counts as no cache, and the reason is given.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "codegen/kernel/jit/cache/object_cache.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

using testing::HasSubstr;

const std::string kKey(64, 'a');

class ObjectCacheErrorTest : public testing::Test {
 protected:
  test::TemporaryDirectory directory_;
  std::filesystem::path path_ = directory_.path() / "cache";
  std::filesystem::path entry_ = path_ / (kKey + ".object");

  void expect_refusal(const char* reason) const {
    const ObjectCache cache(path_);
    EXPECT_THAT(cache.refusal(), HasSubstr(reason));
    EXPECT_FALSE(cache.read(kKey).object);
    EXPECT_NE(cache.write(kKey, "object"), "");
    EXPECT_FALSE(std::filesystem::exists(entry_));
  }

  /// Expects that a bad entry is not used, and that the next write replaces it.
  void expect_distrust(const char* reason) const {
    const ObjectCache cache(path_);
    const auto found = cache.read(kKey);
    EXPECT_FALSE(found.object);
    EXPECT_THAT(found.note, HasSubstr(reason));
    EXPECT_EQ(cache.write(kKey, "object"), "");
    EXPECT_EQ(cache.read(kKey).object, "object");
  }

  void write_sound_entry() const { ASSERT_EQ(ObjectCache(path_).write(kKey, "object"), ""); }

  [[nodiscard]] std::string read_entry() const {
    std::ifstream file(entry_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void overwrite_entry(const std::string& bytes) const {
    std::ofstream(entry_, std::ios::binary | std::ios::trunc) << bytes;
  }
};

TEST_F(ObjectCacheErrorTest, RefusesADirectoryThatIsASymbolicLink) {
  std::filesystem::create_directory(directory_.path() / "elsewhere");
  std::filesystem::create_directory_symlink(directory_.path() / "elsewhere", path_);
  expect_refusal("is a symbolic link");
}

TEST_F(ObjectCacheErrorTest, RefusesADirectoryThatOthersMayWriteTo) {
  for (const mode_t mode : {0770, 0707}) {
    std::filesystem::remove_all(path_);
    ASSERT_EQ(::mkdir(path_.c_str(), 0700), 0);
    ASSERT_EQ(::chmod(path_.c_str(), mode), 0);
    expect_refusal("is writable by other users");
  }
}

TEST_F(ObjectCacheErrorTest, RefusesADirectoryOfAnotherUser) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a directory away";
  ASSERT_EQ(::mkdir(path_.c_str(), 0700), 0);
  ASSERT_EQ(::chown(path_.c_str(), 12345, 12345), 0);
  expect_refusal("belongs to another user");
}

TEST_F(ObjectCacheErrorTest, RefusesAFileInThePlaceOfTheDirectory) {
  std::ofstream(path_) << "a file";
  const ObjectCache cache(path_);
  EXPECT_THAT(cache.refusal(), HasSubstr("cannot be opened"));
}

TEST_F(ObjectCacheErrorTest, RefusesADirectoryThatCannotBeMade) {
  const ObjectCache cache("/proc/regulus/cache");
  EXPECT_THAT(cache.refusal(), HasSubstr("cannot be created"));
  EXPECT_THAT(ObjectCache("").refusal(), HasSubstr("XDG_CACHE_HOME"));
}

TEST_F(ObjectCacheErrorTest, IgnoresATruncatedEntry) {
  for (const std::size_t kept : {0u, 1u, 100u, 160u}) {
    write_sound_entry();
    overwrite_entry(read_entry().substr(0, kept));
    expect_distrust("is damaged");
  }
}

TEST_F(ObjectCacheErrorTest, IgnoresAnAlteredEntry) {
  for (const std::size_t place : {0u, 20u, 90u, 100u, 165u}) {
    write_sound_entry();
    std::string bytes = read_entry();
    bytes[place] = static_cast<char>(bytes[place] ^ 1);
    overwrite_entry(bytes);
    expect_distrust("is damaged");
  }
}

TEST_F(ObjectCacheErrorTest, IgnoresBytesAfterTheEnd) {
  write_sound_entry();
  overwrite_entry(read_entry() + "x");
  expect_distrust("is damaged");
}

TEST_F(ObjectCacheErrorTest, IgnoresTheEntryOfAnotherKey) {
  const ObjectCache cache(path_);
  const std::string other(64, 'b');
  ASSERT_EQ(cache.write(other, "object"), "");
  std::filesystem::rename(path_ / (other + ".object"), entry_);
  expect_distrust("is damaged");
}

TEST_F(ObjectCacheErrorTest, IgnoresAnEntryThatIsASymbolicLink) {
  write_sound_entry();
  std::filesystem::rename(entry_, path_ / "elsewhere");
  std::filesystem::create_symlink(path_ / "elsewhere", entry_);
  expect_distrust("cannot be opened");
}

TEST_F(ObjectCacheErrorTest, IgnoresAnEntryThatIsAPipe) {
  std::filesystem::create_directory(path_);
  ASSERT_EQ(::chmod(path_.c_str(), 0700), 0);
  ASSERT_EQ(::mkfifo(entry_.c_str(), 0600), 0);
  expect_distrust("is not a regular file");
}

TEST_F(ObjectCacheErrorTest, IgnoresAnEntryThatOthersMayWriteTo) {
  write_sound_entry();
  ASSERT_EQ(::chmod(entry_.c_str(), 0620), 0);
  expect_distrust("is writable by other users");
}

TEST_F(ObjectCacheErrorTest, IgnoresAnEntryOfAnotherUser) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a file away";
  write_sound_entry();
  ASSERT_EQ(::chown(entry_.c_str(), 12345, 12345), 0);
  expect_distrust("belongs to another user");
}

TEST_F(ObjectCacheErrorTest, SaysWhenADirectoryIsInThePlaceOfAnEntry) {
  std::filesystem::create_directories(entry_ / "inside");
  ASSERT_EQ(::chmod(path_.c_str(), 0700), 0);
  const ObjectCache cache(path_);
  EXPECT_THAT(cache.read(kKey).note, HasSubstr("is not a regular file"));
  EXPECT_THAT(cache.write(kKey, "object"), HasSubstr("cannot be put in its place"));
}

TEST_F(ObjectCacheErrorTest, SaysWhenAnObjectIsLargerThanTheCache) {
  const ObjectCache cache(path_, 1000);
  EXPECT_THAT(cache.write(kKey, std::string(1000, 'x')), HasSubstr("larger than the whole cache"));
  EXPECT_FALSE(cache.read(kKey).object);
}

}  // namespace
}  // namespace regulus::detail
