// SPDX-License-Identifier: GPL-3.0-or-later
// Disks that are full, files that vanish, folders where nothing can be made, two runs on one file:
// each is said, with exit code 74, and what was there before stays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <csignal>
#include <thread>

#include "support/cached_command.hpp"

namespace regulus::test {
namespace {

using testing::HasSubstr;

const std::string kCommand = REGULUS_BINARY_DIR "/bin/regulus";
const std::string kRobot1 = REGULUS_SOURCE_DIR "/models/robot_1.toml";
const std::string kPlanar = REGULUS_SOURCE_DIR "/models/planar_3rpr.toml";

class FileTrouble : public testing::Test {
 protected:
  [[nodiscard]] static CommandResult regulus(std::vector<std::string> words) {
    words.insert(words.begin(), kCommand);
    return run_command(words);
  }
  /// No file may grow beyond so many blocks of 512 bytes: what a full disk does, for every user.
  [[nodiscard]] static CommandResult with_small_files(int blocks, std::vector<std::string> words) {
    words.insert(words.begin(),
                 {"/bin/sh", "-c", "ulimit -f " + std::to_string(blocks) + "; exec \"$0\" \"$@\"",
                  kCommand});
    return run_command(words);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return directory_.path() / name; }
  [[nodiscard]] bool exists(const std::string& name) const {
    return std::filesystem::exists(file(name));
  }
  /// A search of some thousand boxes.
  [[nodiscard]] std::vector<std::string> long_check(std::vector<std::string> more) const {
    more.insert(more.begin(), {"check", kRobot1, "table6_15_15", "--tolerance",
                               "base,platform=0.12", "--checkpoint", file("checkpoint")});
    return more;
  }
  static void expect_trouble(const CommandResult& result, const std::string& what) {
    EXPECT_EQ(result.exit_code, 74) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr(what));
    EXPECT_THAT(result.errors, testing::Not(HasSubstr("internal error")));
  }

  const TemporaryDirectory directory_;
};

constexpr const char* kNowhere = "/proc/self/nothing/can/be/made/here";

TEST_F(FileTrouble, AFolderInWhichNothingCanBeMadeIsSaid) {
  const std::vector<std::string> check = {"check", kPlanar, "regular"},
                                 locate = {"locate", kPlanar, "regular", "--quiet"};
  const auto with = [](std::vector<std::string> words, const std::string& option,
                       const std::string& path) {
    words.insert(words.end(), {option, path});
    return regulus(words);
  };
  expect_trouble(with(check, "--certificate", kNowhere), "the certificate");
  expect_trouble(with(check, "--checkpoint", kNowhere), "the checkpoint");
  expect_trouble(with(locate, "--certificate", kNowhere), "the certificate");
  expect_trouble(with(locate, "--output", kNowhere), "cannot write");
  expect_trouble(with(locate, "--picture", std::string(kNowhere) + ".svg"), "cannot write");
}

TEST_F(FileTrouble, ACertificateThatDoesNotFitLeavesTheOneThatWasThere) {
  write_file(file("certificate"), "the one before");
  const std::vector<std::string> words = {"check", kPlanar, "regular", "--certificate",
                                          file("certificate")};
  const CommandResult full = with_small_files(1, words);
  expect_trouble(full, "cannot be written: File too large");
  EXPECT_EQ(full.output, "");
  EXPECT_EQ(file_contents(file("certificate")), "the one before");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_.path()), {}), 1);
}

TEST_F(FileTrouble, MarginCertificatesThatDoNotFitAreSaid) {
  expect_trouble(with_small_files(1, {"margin", kPlanar, "regular", "--tolerance", "base=0:0.1",
                                      "--certificate", file("ends")}),
                 "cannot be written: File too large");
  EXPECT_TRUE(std::filesystem::is_empty(directory_.path()));
}

TEST_F(FileTrouble, LinesAndPicturesThatDoNotFitAreSaid) {
  const std::vector<std::string> locate = {"locate", kPlanar, "crossing", "--quiet"};
  auto lines = locate;
  lines.insert(lines.end(), {"--output", "/dev/full"});
  expect_trouble(regulus(lines), "cannot write /dev/full");
  std::filesystem::create_symlink("/dev/full", file("picture.svg"));
  auto picture = locate;
  picture.insert(picture.end(), {"--output", file("lines"), "--picture", file("picture.svg")});
  expect_trouble(regulus(picture), "picture.svg: No space left on device");
}

TEST_F(FileTrouble, AVerdictThatNobodyCanReadIsNone) {
  for (const char* words :
       {"check " REGULUS_SOURCE_DIR "/models/planar_3rpr.toml regular",
        "margin " REGULUS_SOURCE_DIR "/models/planar_3rpr.toml regular --tolerance base=0:0.1"})
    expect_trouble(run_command({"/bin/sh", "-c", kCommand + ' ' + words + " >/dev/full"}),
                   "cannot write standard output");
}

TEST_F(FileTrouble, AnOutputThatIsRemovedMeanwhileIsSaid) {
  for (const std::string option : {"--output", "--picture"}) {
    const std::string path = file("paving.svg");
    RunningCommand run({kCommand, "locate", kRobot1, "wide_40", "--quiet", "--max-boxes", "1500",
                        "--engine", "interpreted", option, path});
    for (int i = 0; i < 10000 && !std::filesystem::exists(path); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::filesystem::remove(path);
    expect_trouble(run.wait(), path + " was removed");
  }
}

TEST_F(FileTrouble, ACheckpointThatDoesNotFitLeavesTheOneThatWasThere) {
  ASSERT_EQ(regulus(long_check({"--max-boxes", "200"})).exit_code, 2);
  const std::string before = file_contents(file("checkpoint"));
  expect_trouble(with_small_files(1, long_check({"--max-boxes", "400"})),
                 "the checkpoint " + file("checkpoint") + " cannot be written: File too large");
  EXPECT_EQ(file_contents(file("checkpoint")), before);
  EXPECT_FALSE(exists("checkpoint.new"));
  EXPECT_FALSE(exists("checkpoint.lock"));
}

/// The certificate runs out of room first; when there is room again, nothing of it is missing.
TEST_F(FileTrouble, ASearchWhoseCertificateDoesNotFitGoesOnWhenThereIsRoom) {
  const auto certified = [this](std::vector<std::string> more) {
    more.insert(more.end(), {"--certificate", file("certificate")});
    return long_check(more);
  };
  ASSERT_EQ(regulus(certified({"--max-boxes", "100"})).exit_code, 2);
  const std::string before = file_contents(file("checkpoint"));
  const auto kilobytes = std::filesystem::file_size(file("certificate.partial")) / 512 + 1;
  expect_trouble(with_small_files(int(kilobytes), certified({"--max-boxes", "3000"})),
                 "the certificate cannot be written");
  EXPECT_EQ(file_contents(file("checkpoint")), before);
  EXPECT_EQ(regulus(certified({})).exit_code, 0);
  const CommandResult verified = regulus({"verify", file("certificate"), "--model", kRobot1});
  EXPECT_EQ(verified.output, "VERIFIED\n") << verified.errors;
}

TEST_F(FileTrouble, TwoRunsOnOneCheckpointAreKeptApart) {
  RunningCommand first([&] {
    auto words = long_check({"--checkpoint-every", "0", "--tolerance", "base,platform=0.13"});
    words.insert(words.begin(), kCommand);
    return words;
  }());
  for (int i = 0; i < 10000 && !exists("checkpoint"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  expect_trouble(regulus(long_check({})),
                 "is in use by another run (process " + std::to_string(first.pid()) + ")");
  ::kill(first.pid(), SIGKILL);
  static_cast<void>(first.wait());
  ASSERT_TRUE(exists("checkpoint.lock"));
  const CommandResult next =
      regulus(long_check({"--tolerance", "base,platform=0.13", "--max-boxes", "1"}));
  EXPECT_EQ(next.exit_code, 2) << next.errors;
  EXPECT_THAT(next.errors, HasSubstr("continued from"));
  EXPECT_FALSE(exists("checkpoint.lock"));
}

TEST_F(FileTrouble, TwoCheckpointsOfOneCertificateAreKeptApart) {
  const std::string held = file("certificate.lock");
  const int lock = ::open(held.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  expect_trouble(regulus(long_check({"--certificate", file("certificate")})),
                 file("certificate") + " is in use by another run");
  ::close(lock);
}

TEST_F(FileTrouble, OnlyCheckCanBeContinuedAndTheOthersSaySo) {
  const CommandResult locate = regulus({"locate", kPlanar, "regular", "--checkpoint", file("c")});
  EXPECT_EQ(locate.exit_code, 64);
  EXPECT_THAT(locate.errors, HasSubstr("only `regulus check` can be continued"));
  const CommandResult margin =
      regulus({"margin", kPlanar, "regular", "--tolerance", "base=0:1", "--checkpoint-every", "1"});
  EXPECT_EQ(margin.exit_code, 64);
  EXPECT_THAT(margin.errors, HasSubstr("can be narrowed from its two ends"));
}

}  // namespace
}  // namespace regulus::test
