// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/files/file_lock.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

namespace fs = std::filesystem;
using test::file_contents;

class FileLocks : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const char* name) const { return folder_.path() / name; }
  void expect_refused(const char* why) const {
    EXPECT_THAT([&] { FileLock lock(path("x")); },
                testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr(why)));
  }

  test::TemporaryDirectory folder_;
};

TEST_F(FileLocks, AreHeldByOne) {
  std::optional<FileLock> first(path("x"));
  expect_refused("in use by another run (process ");
  first.reset();
  EXPECT_FALSE(fs::exists(path("x.lock")));
  const FileLock next(path("x"));
}

TEST_F(FileLocks, TakeTheFileThatAKilledProcessLeft) {
  for (const char* left : {"", "regulus lock 1234\n"}) {
    std::ofstream(path("x.lock")) << left;
    { const FileLock lock(path("x")); }
    EXPECT_FALSE(fs::exists(path("x.lock")));
  }
}

TEST_F(FileLocks, LeaveAFileOfAnotherProgramAsItIs) {
  for (const std::string other :
       {"[[package]]\nname = \"numpy\"\n", "1234", "regulus lock \n", "regulus lock 12 \n",
        "regulus lock 1234", "regulus lock 1234\nand more than that is written here\n"}) {
    std::ofstream(path("x.lock")) << other;
    expect_refused("x.lock is a file of another program");
    EXPECT_EQ(file_contents(path("x.lock")), other);
  }
}

TEST_F(FileLocks, DoNotWriteThroughLinks) {
  std::ofstream(path("target")) << "";
  fs::create_hard_link(path("target"), path("x.lock"));
  expect_refused("x.lock is a file of another program");
  fs::remove(path("x.lock"));
  fs::create_symlink(path("target"), path("x.lock"));
  expect_refused("x.lock");
  fs::remove(path("x.lock"));
  ASSERT_EQ(::mkfifo(path("x.lock").c_str(), 0600), 0);
  expect_refused("x.lock is a file of another program");
  EXPECT_EQ(fs::file_size(path("target")), 0U);
  EXPECT_TRUE(fs::is_fifo(path("x.lock")));
}

}  // namespace
}  // namespace regulus::detail
