// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/write_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "codegen/support/errors.hpp"
#include "codegen/support/write_file.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

namespace fs = std::filesystem;
using test::file_contents;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::size_t entries(const fs::path& folder) {
  return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(WriteFiles, MakesTheFolderAndReplacesWhatIsThere) {
  const test::TemporaryDirectory temporary;
  const fs::path folder = temporary.path() / "a/b";
  write_files(folder, {{"x", "old"}, {"y", "1"}});
  write_files(folder, {{"x", "new"}, {"y", "2"}});
  EXPECT_EQ(file_contents(folder / "x") + file_contents(folder / "y"), "new2");
  EXPECT_EQ(entries(folder), 2U);
}

TEST(WriteFiles, TouchesNothingWhereOneCannotBeWritten) {
  const test::TemporaryDirectory temporary;
  write_files(temporary.path(), {{"x", "old"}});
  fs::create_directory(temporary.path() / "y");
  EXPECT_THAT(
      [&] {
        write_files(temporary.path(), {{"x", "new"}, {"y", "new"}});
      },
      ThrowsMessage<FileError>(HasSubstr("y cannot be written: there is a folder")));
  EXPECT_EQ(file_contents(temporary.path() / "x"), "old");
  EXPECT_EQ(entries(temporary.path()), 2U);
}

TEST(WriteFiles, SaysWhyAFolderCannotBe) {
  const test::TemporaryDirectory temporary;
  write_file(temporary.path() / "file", "");
  EXPECT_THAT(
      [&] {
        write_files(temporary.path() / "file/folder", {{"x", ""}});
      },
      ThrowsMessage<FileError>(HasSubstr("folder cannot be written: Not a directory")));
}

/// A limit on the size of files stands for a full disk.
TEST(WriteFiles, SaysWhenTheDiskIsFull) {
  const test::TemporaryDirectory temporary;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{100, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THAT([&] { write_file(temporary.path() / "x", std::string(1000, 'x')); },
              ThrowsMessage<FileError>(HasSubstr("x cannot be written: File too large")));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(entries(temporary.path()), 0U);
}

TEST(DependencyText, NamesNoPathWithALineBreak) {
  EXPECT_THAT(
      [] {
        static_cast<void>(dependency_text("out", {{"a.h", ""}}, "m\n.toml"));
      },
      ThrowsMessage<FileError>(HasSubstr("rename m\\x0a.toml")));
}

TEST(DependencyText, EscapesWhatMakeWouldRead) {
  EXPECT_EQ(dependency_text("my out", {{"a.h", ""}, {"a.cpp", ""}}, "m$1 #2.toml"),
            "my\\ out/a.h my\\ out/a.cpp: m$$1\\ \\#2.toml\n");
}

}  // namespace
}  // namespace regulus::detail
