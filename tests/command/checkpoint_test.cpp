// SPDX-License-Identifier: GPL-3.0-or-later
// Tests --checkpoint as its users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/interrupted_runs.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

class CheckpointOption : public testing::Test {
 protected:
  CommandResult check(std::vector<std::string> more) const {
    std::vector<std::string> words = {kCommand,       "check",           kRobot1,
                                      "table6_15_15", "--tolerance",     "base,platform=0.1",
                                      "--checkpoint", file("checkpoint")};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }
  /// A search of so many boxes that a signal finds it at work, on a busy machine, too.
  [[nodiscard]] std::vector<std::string> long_check() const {
    return {kCommand,
            "check",
            kRobot1,
            "table6_15_15",
            "--tolerance",
            "base,platform=0.13",
            "--uncertainty",
            "variables",
            "--checkpoint",
            file("checkpoint"),
            "--checkpoint-every",
            "0"};
  }
  [[nodiscard]] std::string file(const std::string& name) const {
    return (directory_.path() / name).string();
  }
  [[nodiscard]] bool exists(const std::string& name) const {
    return std::filesystem::exists(file(name));
  }
  const TemporaryDirectory directory_;
};

TEST_F(CheckpointOption, ASearchOutOfBoxesGoesOnLater) {
  const CommandResult first = check({"--max-boxes", "200"});
  EXPECT_EQ(first.exit_code, 2);
  EXPECT_THAT(first.errors, HasSubstr("repeat the command to continue from here"));
  ASSERT_TRUE(exists("checkpoint"));
  // The checkpoint is not tied to the machine code, the number of threads or the instruction set.
  const CommandResult second = check({"--threads", "2", "--isa", "portable"});
  EXPECT_EQ(second.exit_code, 0) << second.errors;
  EXPECT_THAT(second.errors, HasSubstr("continued from " + file("checkpoint")));
  EXPECT_FALSE(exists("checkpoint"));
}

TEST_F(CheckpointOption, ACertificateGoesOnWithIt) {
  ASSERT_EQ(check({"--max-boxes", "300", "--certificate", file("pieces")}).exit_code, 2);
  EXPECT_FALSE(exists("pieces"));
  ASSERT_EQ(check({"--max-boxes", "600", "--certificate", file("pieces")}).exit_code, 2);
  ASSERT_EQ(check({"--certificate", file("pieces")}).exit_code, 0);
  const CommandResult verified = regulus({"verify", file("pieces")});
  EXPECT_EQ(verified.exit_code, 0) << verified.errors;
}

/// The earlier run wrote no proof. The one that continues judges its boxes again and writes all.
TEST_F(CheckpointOption, ACertificateMayComeLater) {
  ASSERT_EQ(check({"--max-boxes", "300"}).exit_code, 2);
  ASSERT_EQ(check({"--certificate", file("late")}).exit_code, 0);
  const std::string late = file_contents(file("late"));
  ASSERT_EQ(check({"--certificate", file("late")}).exit_code, 0);
  EXPECT_TRUE(late == file_contents(file("late")));
}

/// With one engine, a certificate written in pieces is the same as one written without a stop.
TEST_F(CheckpointOption, ABudgetLeavesTheCertificateAsItIs) {
  const auto certified = [this](std::vector<std::string> more) {
    more.insert(more.end(), {"--engine", "jit", "--threads", "2", "--certificate", file("proof")});
    return check(more);
  };
  ASSERT_EQ(certified({}).exit_code, 0);
  std::ifstream whole_file(file("proof"), std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(whole_file), {}};
  for (const char* budget : {"7", "100", "301"}) {
    ASSERT_EQ(certified({"--max-boxes", budget}).exit_code, 2);
    EXPECT_FALSE(exists("proof")) << "the proof of an earlier run";
    ASSERT_EQ(certified({}).exit_code, 0);
    std::ifstream file_of_pieces(file("proof"), std::ios::binary);
    const std::string pieces{std::istreambuf_iterator<char>(file_of_pieces), {}};
    EXPECT_TRUE(pieces == whole) << budget;
  }
}

TEST_F(CheckpointOption, AnotherSearchOrAnotherFileIsRefused) {
  ASSERT_EQ(check({"--max-boxes", "100"}).exit_code, 2);
  for (const char* change : {"x=-14:15", "psi=0"}) {
    const CommandResult other = check({"--range", change});
    EXPECT_EQ(other.exit_code, 65) << other.errors;
    EXPECT_THAT(other.errors, HasSubstr("about another question"));
  }
  EXPECT_EQ(check({"--alpha", "0.001"}).exit_code, 65);
  EXPECT_EQ(check({"--uncertainty", "variables"}).exit_code, 65);
  std::ofstream(file("checkpoint")) << "[pose]\n";
  const CommandResult strange = check({});
  EXPECT_EQ(strange.exit_code, 65);
  EXPECT_THAT(strange.errors, HasSubstr("it is not a checkpoint"));
}

/// Boxes that rest on a filter are not proved: the final report must name the filter.
TEST_F(CheckpointOption, BoxesThatAFilterVouchedForAreNotTakenOverWithoutIt) {
  const std::string filter = REGULUS_BINARY_DIR "/filters/gershgorin.so";
  ASSERT_EQ(check({"--method", "reg", "--filter", filter, "--max-boxes", "100"}).exit_code, 2);
  const CommandResult without = check({"--method", "reg"});
  EXPECT_EQ(without.exit_code, 65) << without.errors;
  EXPECT_THAT(without.errors, HasSubstr("about another question"));
}

TEST_F(CheckpointOption, AFolderThatIsNotThereIsSaidBeforeTheSearch) {
  const CommandResult result =
      regulus({"check", kRobot1, "wide_15", "--checkpoint", file("no/such/folder")});
  EXPECT_EQ(result.exit_code, 74);
  EXPECT_THAT(result.errors, HasSubstr("cannot be created: there is no folder"));
}

/// A closing terminal sends SIGHUP, perhaps twice; nohup asks programs to ignore it.
TEST_F(CheckpointOption, SighupSavesWhatIsDone) {
  RunningCommand run(long_check());
  for (int i = 0; i < 10000 && !exists("checkpoint"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(run.pid(), SIGHUP);
  ::kill(run.pid(), SIGHUP);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 2) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("repeat the command to continue from here"));
  EXPECT_TRUE(exists("checkpoint"));
}

TEST_F(CheckpointOption, SighupThatIsIgnoredStaysSo) {
  RunningCommand run({"/bin/sh", "-c", "trap '' HUP; exec \"$0\" \"$@\"", kCommand, "check",
                      kRobot1, "table6_15_15", "--tolerance", "base,platform=0.1", "--checkpoint",
                      file("checkpoint"), "--checkpoint-every", "0"});
  for (int i = 0; i < 10000 && !exists("checkpoint"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(run.pid(), SIGHUP);
  EXPECT_EQ(run.wait().exit_code, 0);
}

TEST_F(CheckpointOption, SigtermSavesWhatIsDone) {
  RunningCommand run(long_check());
  for (int i = 0; i < 10000 && !exists("checkpoint"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(run.pid(), SIGTERM);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 2) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("repeat the command to continue from here"));
  EXPECT_TRUE(exists("checkpoint"));
  EXPECT_FALSE(exists("checkpoint.new"));
}

TEST_F(CheckpointOption, KillsChangeNothing) { expect_kills_change_nothing(1, 5); }

}  // namespace
}  // namespace regulus::detail::test
