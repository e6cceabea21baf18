// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/files/atomic_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "runtime/files/atomic_stream.hpp"
#include "runtime/files/temporary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

namespace fs = std::filesystem;
using test::file_contents;

class AtomicFiles : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const char* name) const { return folder_.path() / name; }
  [[nodiscard]] auto files() const {
    return std::distance(fs::directory_iterator(folder_.path()), {});
  }

  test::TemporaryDirectory folder_;
};

TEST_F(AtomicFiles, AppearUnderTheirNameWhenComplete) {
  std::ofstream(path("x")) << "old";
  AtomicFile file(path("x"));
  file.write("ne");
  file.write("w");
  EXPECT_EQ(file_contents(path("x")), "old");
  file.put_in_place();
  EXPECT_EQ(file_contents(path("x")), "new");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFiles, LeaveNothingIfTheyAreNotPutInPlace) {
  std::ofstream(path("x")) << "old";
  { AtomicFile(path("x")).write("half"); }
  EXPECT_EQ(file_contents(path("x")), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFiles, AreRemovedOnceAfterAMove) {
  AtomicFile file(path("x"));
  AtomicFile moved = std::move(file);
  moved.write("new");
  moved.put_in_place();
  EXPECT_EQ(file_contents(path("x")), "new");
}

TEST_F(AtomicFiles, HaveTheModeThatIsAskedForAndNamesInTheFolder) {
  const int folder = ::open(folder_.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  AtomicFile file("x", 0600, folder);
  file.put_in_place_durably();
  ::close(folder);
  EXPECT_EQ(fs::status(path("x")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFiles, SayWhichStepFailed) {
  EXPECT_THAT([&] { AtomicFile(path("none/x")); },
              testing::ThrowsMessage<std::system_error>(
                  testing::StartsWith("be created: No such file or directory")));
  fs::create_directory(path("folder"));
  EXPECT_THAT(
      [&] { AtomicFile(path("folder")); },
      testing::ThrowsMessage<std::system_error>(testing::StartsWith("be created: Is a directory")));
  AtomicFile file(path("x"));
  fs::create_directory(path("x"));
  EXPECT_THAT([&] { file.put_in_place(); }, testing::ThrowsMessage<std::system_error>(
                                                testing::StartsWith("be put in its place")));
}

TEST_F(AtomicFiles, ReplaceTheTargetOfALinkWithItsPermissions) {
  std::ofstream(path("x")) << "old";
  fs::permissions(path("x"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("x", path("link"));
  AtomicFile file(path("link"));
  file.write("new");
  file.put_in_place();
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(file_contents(path("x")), "new");
  EXPECT_EQ(fs::status(path("x")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFiles, LeaveAnotherNameOfTheEarlierFileAsItIs) {
  std::ofstream(path("x")) << "old";
  fs::create_hard_link(path("x"), path("other"));
  AtomicFile file(path("x"));
  file.write("new");
  file.put_in_place();
  EXPECT_EQ(file_contents(path("other")), "old");
}

/// A device must not be replaced by a file, whoever runs this.
TEST_F(AtomicFiles, WriteToDevicesAndPipesInPlace) {
  for (const char* stream : {"/dev/zero", "/dev/stdout", "/dev/fd/1"}) {
    EXPECT_TRUE(is_stream(stream)) << stream;
    AtomicFile file(stream);
    file.put_in_place_durably();
  }
  EXPECT_TRUE(fs::is_character_file("/dev/zero"));
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  const int reader = ::open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  AtomicFile file(path("pipe"));
  file.write("bytes");
  file.put_in_place();
  char bytes[8] = {};
  EXPECT_EQ(::read(reader, bytes, sizeof bytes), 5);
  ::close(reader);
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
  EXPECT_FALSE(is_stream(path("x")));
}

TEST_F(AtomicFiles, SayThatTheDiskIsFull) {
  AtomicFile file("/dev/full");
  EXPECT_THAT([&] { file.write("x"); }, testing::ThrowsMessage<std::system_error>(
                                            testing::HasSubstr("No space left on device")));
}

class Temporaries : public AtomicFiles {};

TEST_F(Temporaries, OfKilledProcessesAreSwept) {
  std::ofstream(path("x.0123abcd.regulus")) << "a long text of a process that was killed";
  fs::create_directories(path("x.89abcdef.regulus") + "/inner");
  AtomicFile file(path("x"));
  EXPECT_EQ(files(), 1);
  file.put_in_place_durably();
  EXPECT_EQ(files(), 1);
}

TEST_F(Temporaries, StayWhileTheirProcessRunsAndIfTheyAreOfAnotherFile) {
  const AtomicFile first(path("x"));
  for (const char* name : {"y.0123abcd.regulus", "x.0123abcd", "x.0123abc.regulus", "x.old",
                           "x.0123abcX.regulus", ".0123abcd.regulus"})
    std::ofstream(path(name)) << "not ours";
  const AtomicFile second(path("x"));
  sweep_temporaries(path("x"));
  EXPECT_EQ(files(), 8);
}

TEST_F(Temporaries, AreSweptWithoutTheTargetsOfLinks) {
  fs::create_directory(path("mine"));
  std::ofstream(path("mine/file")) << "mine";
  fs::create_symlink("mine", path("x.0123abcd.regulus"));
  sweep_temporaries(path("x"));
  EXPECT_TRUE(fs::exists(path("mine/file")));
}

TEST_F(Temporaries, ThatAreFoldersGoWithTheirContent) {
  {
    const TemporaryFolder folder(path("x"));
    std::ofstream(folder.path() + "/file") << "text";
    EXPECT_EQ(files(), 1);
  }
  EXPECT_EQ(files(), 0);
  {
    TemporaryFolder folder(path("x"));
    std::ofstream(folder.path() + "/file") << "text";
    folder.put_in_place_durably(path("x"));
  }
  EXPECT_EQ(file_contents(path("x/file")), "text");
}

class AtomicStreams : public AtomicFiles {};

TEST_F(AtomicStreams, AppearWhenTheyAreComplete) {
  AtomicStream stream(path("x"));
  for (int i = 0; i < 100000; ++i) stream << i << '\n';
  EXPECT_FALSE(fs::exists(path("x")));
  stream.put_in_place();
  EXPECT_EQ(fs::file_size(path("x")), 588890U);
}

TEST_F(AtomicStreams, SayWhyTheyCouldNotBeWritten) {
  AtomicStream stream("/dev/full");
  stream << "x";
  EXPECT_THAT([&] { stream.put_in_place(); },
              testing::ThrowsMessage<std::system_error>(
                  testing::StartsWith("be written: No space left on device")));
  EXPECT_FALSE(stream);
}

}  // namespace
}  // namespace regulus::detail
