// SPDX-License-Identifier: GPL-3.0-or-later
// Tests proofs in shards as the command writes and reads them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "runtime/proof/format.hpp"
#include "tests/support/certificates.hpp"
#include "tests/support/command.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class InShards : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const {
    return (directory_.path() / name).string();
  }
  [[nodiscard]] CommandResult check(const std::vector<std::string>& options) const {
    std::vector<std::string> words = {
        kCommand, "check", kRobot1, "wide_15", "--tolerance", "base,platform=0.09", "--quiet"};
    words.insert(words.end(), options.begin(), options.end());
    return run_command(words);
  }
  [[nodiscard]] CommandResult check_into(const std::string& name, const std::string& size) const {
    return check({"--certificate", file(name), "--shard-size", size});
  }
  [[nodiscard]] static CommandResult verify(const std::string& path,
                                            const std::vector<std::string>& options = {},
                                            const char* program = "regulus-verify") {
    std::vector<std::string> words = {REGULUS_BINARY_DIR + std::string("/bin/") + program};
    if (std::string(program) == "regulus") words.emplace_back("verify");
    words.push_back(path);
    words.insert(words.end(), options.begin(), options.end());
    return run_command(words);
  }
  [[nodiscard]] std::size_t shards_of(const std::string& name) const {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(file(name) + format::kShardsEnding))
      count += entry.is_regular_file();
    return count;
  }

  const TemporaryDirectory directory_;
};

/// Without the counts of boxes that wait, which differ from those of one file.
std::string without(const std::string& text, const std::string& pattern) {
  return std::regex_replace(text, std::regex(pattern), "");
}

TEST_F(InShards, AProofIsVerifiedByAnyNumberOfThreads) {
  ASSERT_EQ(check_into("proof", "4kiB").exit_code, 0);
  EXPECT_GT(shards_of("proof"), 3U);
  const CommandResult one = verify(file("proof"));
  EXPECT_EQ(one.output, "VERIFIED\n") << one.errors;
  for (const char* threads : {"2", "5"}) {
    const CommandResult many = verify(file("proof"), {"--threads", threads});
    EXPECT_EQ(many.output, one.output);
    EXPECT_EQ(many.errors, one.errors);
  }
  const CommandResult own =
      verify(file("proof"), {"--model", kRobot1, "--allow-options"}, "regulus");
  EXPECT_EQ(own.output, "VERIFIED\n") << own.errors;
  EXPECT_THAT(own.errors, HasSubstr("question   that of"));
}

TEST_F(InShards, AProofHasTheLeavesOfTheOneFile) {
  ASSERT_EQ(check_into("proof", "4kiB").exit_code, 0);
  ASSERT_EQ(check({"--certificate", file("one")}).exit_code, 0);
  const std::string in_shards = verify(file("proof")).errors, whole = verify(file("one")).errors;
  EXPECT_EQ(without(in_shards, "shards .*\n|, in .*"), without(whole, ", in .*"));
  EXPECT_EQ(verify(file("one"), {"--threads", "3"}).errors, whole);
}

TEST_F(InShards, SmallProofsStayInOneFile) {
  ASSERT_EQ(check_into("proof", "1MB").exit_code, 0);
  ASSERT_EQ(check({"--certificate", file("one")}).exit_code, 0);
  EXPECT_FALSE(fs::exists(file("proof.shards")));
  EXPECT_EQ(file_contents(file("proof")), file_contents(file("one")));
}

TEST_F(InShards, AnEarlierProofGoesAsideWithItsShards) {
  ASSERT_EQ(check_into("proof", "4kiB").exit_code, 0);
  const std::size_t shards = shards_of("proof");
  ASSERT_EQ(check_into("proof", "8kiB").exit_code, 0);
  EXPECT_LT(shards_of("proof"), shards);
  EXPECT_EQ(shards_of("proof.old"), shards);
  for (const char* name : {"proof", "proof.old"})
    EXPECT_EQ(verify(file(name)).output, "VERIFIED\n") << name;
  // A proof in one file has no shards, and neither has its predecessor those of another proof.
  ASSERT_EQ(check({"--certificate", file("proof")}).exit_code, 0);
  EXPECT_FALSE(fs::exists(file("proof.shards")));
  ASSERT_EQ(check({"--certificate", file("proof")}).exit_code, 0);
  EXPECT_FALSE(fs::exists(file("proof.old.shards")));
}

TEST_F(InShards, NothingOfARunThatWasKilledRemains) {
  for (const char* folder : {"proof.shards", "proof.shards.0123abcd.regulus"}) {
    fs::create_directory(file(folder));
    std::ofstream(file(folder) + "/1") << "stale";
  }
  ASSERT_EQ(check_into("proof", "4kiB").exit_code, 0);
  EXPECT_FALSE(fs::exists(file("proof.shards.0123abcd.regulus")));
  EXPECT_FALSE(fs::exists(file("proof.old.shards")));
  EXPECT_EQ(verify(file("proof")).output, "VERIFIED\n");
}

TEST_F(InShards, FilesOfTheUserAreNotRemoved) {
  fs::create_directory(file("proof.shards"));
  std::ofstream(file("proof.shards/notes.txt")) << "mine";
  const CommandResult result = check_into("proof", "4kiB");
  EXPECT_EQ(result.exit_code, 74);
  EXPECT_THAT(result.errors, HasSubstr("has the file notes.txt"));
  EXPECT_EQ(file_contents(file("proof.shards/notes.txt")), "mine");
}

TEST_F(InShards, APageDoesNotContainThem) {
  const CommandResult result =
      check({"--certificate", file("proof"), "--shard-size", "4kiB", "--page", file("page.html")});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const std::string page = file_contents(file("page.html"));
  EXPECT_THAT(page, HasSubstr("its proof is in several files"));
  EXPECT_THAT(page, Not(HasSubstr(format::kIndexMagic)));
}

TEST_F(InShards, ABoundHasThemForEachEnd) {
  const CommandResult result =
      run_command({kCommand, "bound", kRobot1, "table6_15_15", "force", "--load", "payload",
                   "--leg", "3", "--certificate", file("ends"), "--shard-size", "8kB", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_GT(shards_of("ends.leg_3.safe"), 1U);
  for (const char* name : {"ends.leg_3.safe", "ends.leg_3.singular"})
    EXPECT_EQ(verify(file(name)).output, "VERIFIED\n") << name;
}

TEST_F(InShards, SizesAreRefusedThatMakeNoSense) {
  for (const char* size : {"0", "100", "5TB", "-1", "many"})
    EXPECT_EQ(check_into("proof", size).exit_code, 64) << size;
  EXPECT_EQ(check({"--shard-size", "1MB"}).exit_code, 64);
}

TEST_F(InShards, TooManyBoxesAreTheSameForAnyNumberOfThreads) {
  ASSERT_EQ(check_into("proof", "4kiB").exit_code, 0);
  const CommandResult one = verify(file("proof"), {"--max-boxes", "100"});
  EXPECT_EQ(one.output, "UNFINISHED\n");
  const CommandResult many = verify(file("proof"), {"--max-boxes", "100", "--threads", "3"});
  EXPECT_EQ(many.errors, one.errors);
}

}  // namespace
}  // namespace regulus::detail::test
