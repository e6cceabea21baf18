// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/files/atomic_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "tests/support/temporary_directory.hpp"

namespace regulus {
namespace {

namespace fs = std::filesystem;

class AtomicFiles : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const char* name) const { return folder_.path() / name; }
  [[nodiscard]] static std::string text(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  test::TemporaryDirectory folder_;
};

TEST_F(AtomicFiles, AppearUnderTheirNameWhenComplete) {
  std::ofstream(path("x")) << "old";
  AtomicFile file(path("x"), path("x.new"));
  file.write("ne");
  file.write("w");
  EXPECT_EQ(text(path("x")), "old");
  file.put_in_place();
  EXPECT_EQ(text(path("x")), "new");
  EXPECT_FALSE(fs::exists(path("x.new")));
}

TEST_F(AtomicFiles, LeaveNothingIfTheyAreNotPutInPlace) {
  std::ofstream(path("x")) << "old";
  { AtomicFile(path("x"), path("x.new")).write("half"); }
  EXPECT_EQ(text(path("x")), "old");
  EXPECT_FALSE(fs::exists(path("x.new")));
}

TEST_F(AtomicFiles, ReplaceWhatAKilledProcessLeft) {
  std::ofstream(path("x.new")) << "a long text of a process that was killed";
  AtomicFile file(path("x"), path("x.new"));
  file.write("new");
  file.put_in_place_durably();
  EXPECT_EQ(text(path("x")), "new");
}

TEST_F(AtomicFiles, AreRemovedOnceAfterAMove) {
  AtomicFile file(path("x"), path("x.new"));
  AtomicFile moved = std::move(file);
  moved.write("new");
  moved.put_in_place();
  EXPECT_EQ(text(path("x")), "new");
}

TEST_F(AtomicFiles, DoNotFollowALinkThatHasTheTemporaryName) {
  std::ofstream(path("secret")) << "secret";
  fs::create_symlink(path("secret"), path("x.new"));
  EXPECT_THROW(AtomicFile(path("x"), path("x.new")), std::system_error);
  EXPECT_EQ(text(path("secret")), "secret");
}

TEST_F(AtomicFiles, HaveTheModeThatIsAskedForAndNamesInTheFolder) {
  const int folder = ::open(folder_.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  AtomicFile file("x", "x.new", 0600, folder);
  file.put_in_place_durably();
  ::close(folder);
  EXPECT_EQ(fs::status(path("x")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFiles, SayWhichStepFailed) {
  EXPECT_THAT([&] { AtomicFile(path("none/x"), path("none/x.new")); },
              testing::ThrowsMessage<std::system_error>(
                  testing::StartsWith("be created: No such file or directory")));
  fs::create_directory(path("folder"));
  AtomicFile file(path("folder"), path("folder.new"));
  EXPECT_THAT([&] { file.put_in_place(); }, testing::ThrowsMessage<std::system_error>(
                                                testing::StartsWith("be put in its place")));
}

}  // namespace
}  // namespace regulus
