// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/subprocess.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <system_error>

namespace regulus::detail {
namespace {

TEST(Subprocess, ReturnsTheExitCode) {
  EXPECT_EQ(Subprocess({"sh", "-c", "exit 3"}).wait(), 3);
  EXPECT_EQ(Subprocess({"true"}).wait(), 0);
}

TEST(Subprocess, ReturnsTheExitCodeAgainWhenAskedAgain) {
  Subprocess process({"sh", "-c", "exit 3"});
  process.wait();
  EXPECT_EQ(process.wait(), 3);
}

TEST(Subprocess, TellsASignalFromAnExitCode) {
  EXPECT_EQ(Subprocess({"sh", "-c", "kill -TERM $$"}).wait(), -1);
}

TEST(Subprocess, PassesArgumentsWithoutAShell) {
  EXPECT_EQ(Subprocess({"test", "a b; exit 1", "=", "a b; exit 1"}).wait(), 0);
}

TEST(Subprocess, RedirectsTheStandardStreams) {
  const int file = ::memfd_create("output", MFD_CLOEXEC);
  ASSERT_GE(file, 0);
  EXPECT_EQ(Subprocess({"sh", "-c", "echo out; echo errors >&2"}, {-1, file, file}).wait(), 0);
  std::array<char, 32> text{};
  ::pread(file, text.data(), text.size() - 1, 0);
  ::close(file);
  EXPECT_STREQ(text.data(), "out\nerrors\n");
}

TEST(Subprocess, RefusesAProgramThatDoesNotExist) {
  try {
    const Subprocess process({"no-such-program-anywhere"});
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
  }
}

}  // namespace
}  // namespace regulus::detail
