// SPDX-License-Identifier: GPL-3.0-or-later
// Tests regulus-mpi as its users meet it: real processes, and the bytes of one thread.
#include <chrono>

#include "tests/mpi/ranks.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Ranks : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const {
    return (directory_.path() / name).string();
  }
  const TemporaryDirectory directory_;
};
using NightlyRanks = Ranks;

TEST_F(Ranks, GiveTheCertificateOfOneThread) {
  const CommandResult one =
      run_command(one_thread(joined(long_check(), {"--certificate", file("one")})));
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  const std::string expected = file_contents(file("one"));
  for (const int count : numbers_of_ranks({1, 2, 4, 16})) {
    const CommandResult many =
        run_command(ranks(count, joined(long_check(), {"--certificate", file("many")})));
    EXPECT_EQ(many.exit_code, 0) << many.errors;
    EXPECT_EQ(many.output, one.output);
    EXPECT_TRUE(file_contents(file("many")) == expected) << count << " ranks";
  }
}

TEST_F(Ranks, WithSeveralThreadsGiveThePavingOfOneThread) {
  const Words locate = {"locate", model("planar_3rpr"), "crossing", "--resolution", "1/100"};
  const CommandResult one = run_command(one_thread(joined(locate, {"--output", file("one")})));
  ASSERT_EQ(one.exit_code, 1) << one.errors;
  const CommandResult many =
      run_command(ranks(3, joined(locate, {"--output", file("many"), "--threads", "2"})));
  EXPECT_EQ(many.exit_code, 1) << many.errors;
  const auto boxes_of = [](const std::string& text) {
    return text.substr(0, text.rfind("{\"summary\""));
  };
  const std::string expected = boxes_of(file_contents(file("one")));
  EXPECT_GT(expected.size(), 1'000'000U);
  EXPECT_TRUE(boxes_of(file_contents(file("many"))) == expected);
}

/// Where the robot reaches is a constraint that only a paving without a proof has.
TEST_F(Ranks, PaveWhatTheRobotReachesAsOneThreadDoes) {
  const Words locate = {"locate",  model("delta"),  "far",         "--resolution", "1/800",
                        "--range", "y=-1300:-1000", "--max-boxes", "18000",        "--output"};
  const auto boxes_of = [this](const std::string& name) {
    const std::string text = file_contents(file(name));
    return text.substr(0, text.rfind("{\"summary\""));
  };
  static_cast<void>(run_command(one_thread(joined(locate, {file("one")}))));
  EXPECT_GT(boxes_of("one").size(), 500'000U);
  static_cast<void>(run_command(ranks(2, joined(locate, {file("many")}))));
  EXPECT_TRUE(boxes_of("many") == boxes_of("one"));
}

TEST_F(Ranks, OnFourHostsGiveTheCertificateOfOneThread) {
  const Words job = {REGULUS_SOURCE_DIR "/tests/mpi/four_hosts.sh", MPIEXEC,
                     REGULUS_BINARY_DIR "/bin/regulus-mpi"};
  const CommandResult many =
      run_command(joined(job, joined(long_check(), {"--certificate", file("many")})));
  constexpr int kImpossible = 77;
  if (many.exit_code == kImpossible) GTEST_SKIP() << many.errors;
  EXPECT_EQ(many.exit_code, 0) << many.errors;
  ASSERT_EQ(run_command(one_thread(joined(long_check(), {"--certificate", file("one")}))).exit_code,
            0);
  EXPECT_TRUE(file_contents(file("many")) == file_contents(file("one")));
}

TEST_F(Ranks, CutAProofAsOneThreadDoes) {
  const Words cut = joined(long_check(), {"--shard-size", "256kB", "--certificate"});
  ASSERT_EQ(run_command(one_thread(joined(cut, {file("one")}))).exit_code, 0);
  ASSERT_EQ(run_command(ranks(3, joined(cut, {file("many")}))).exit_code, 0);
  EXPECT_TRUE(file_contents(file("many")) == file_contents(file("one")));
  std::size_t shards = 0;
  for (const auto& shard : std::filesystem::directory_iterator(file("one.shards"))) {
    const std::string name = shard.path().filename().string();
    EXPECT_TRUE(file_contents(file("many.shards/" + name)) == file_contents(shard.path())) << name;
    ++shards;
  }
  EXPECT_GT(shards, 5U);
}

TEST_F(NightlyRanks, VerifyTheShardsOfAnIndex) {
  const Words cut = {"check",         model("robot_1"), "table4_5",     "--method", "jk",
                     "--certificate", file("proof"),    "--shard-size", "256kB"};
  ASSERT_EQ(run_command(ranks(2, cut)).exit_code, 0);
  const CommandResult one =
      run_command({REGULUS_BINARY_DIR "/bin/regulus", "verify", file("proof"), "--threads", "2"});
  EXPECT_EQ(one.output, "VERIFIED\n") << one.errors;
  for (const int count : numbers_of_ranks({1, 3, 12})) {
    const CommandResult many = run_command(ranks(count, {"verify", file("proof")}));
    EXPECT_EQ(many.output, one.output) << many.errors;
    EXPECT_THAT(many.errors, HasSubstr(one.errors));
  }
  std::filesystem::remove(file("proof.shards/3"));
  const CommandResult lacking = run_command(ranks(2, {"verify", file("proof")}));
  EXPECT_EQ(lacking.output, "REJECTED\n");
  EXPECT_THAT(lacking.errors, HasSubstr("shard 3: it is missing"));
  EXPECT_EQ(lacking.exit_code, 1);
}

TEST_F(NightlyRanks, VerifyTheShardsOfAPavingOfALoad) {
  const Words pave = {"locate",  model("cable_8"), "hall",        "--load",       "weight",
                      "--range", "z=4:7.5",        "--output",    file("boxes"),  "--resolution",
                      "1/32",    "--certificate",  file("proof"), "--shard-size", "16kiB"};
  ASSERT_EQ(run_command(one_thread(pave)).exit_code, 1);
  const CommandResult one =
      run_command({REGULUS_BINARY_DIR "/bin/regulus", "verify", file("proof")});
  EXPECT_EQ(one.output, "VERIFIED\n") << one.errors;
  EXPECT_THAT(one.errors, HasSubstr("undecided\n"));
  const CommandResult many = run_command(ranks(3, {"verify", file("proof")}));
  EXPECT_EQ(many.output, one.output);
  EXPECT_THAT(many.errors, HasSubstr(one.errors));
}

TEST_F(Ranks, VerifyAProofInOneFileByTheFirst) {
  ASSERT_EQ(run_command(
                one_thread({"check", model("robot_1"), "wide_15", "--certificate", file("proof")}))
                .exit_code,
            0);
  const CommandResult result = run_command(ranks(3, {"verify", file("proof")}));
  EXPECT_EQ(result.output, "VERIFIED\n") << result.errors;
  EXPECT_EQ(run_command(ranks(3, {"verify", file("none")})).exit_code, 74);
}

TEST(ManualPage, NamesTheCommandsThatRunOnRanks) {
  const std::string page = file_contents(REGULUS_BINARY_DIR "/codegen/use/mpi/regulus-mpi.1");
  for (const char* words : {"check", "locate", "margin", "bound", "datasheet", "solve", "verify",
                            "\\-\\-filter", "EXIT STATUS"})
    EXPECT_THAT(page, HasSubstr(words));
}

TEST(Help, ListsTheCommandsThatRunOnRanksAlone) {
  const std::string help = run_command(ranks(1, {"--help"})).output;
  EXPECT_THAT(help, HasSubstr("mpirun -n 8 regulus-mpi check robot_1 wide_15"));
  for (const char* command : {"check", "locate", "margin", "bound", "datasheet", "solve", "verify"})
    EXPECT_THAT(help, HasSubstr("\n  " + std::string(command) + ' '));
  for (const char* command : {"report", "explain", "generate", "import", "list", "shell"})
    EXPECT_THAT(help, testing::Not(HasSubstr("\n  " + std::string(command) + ' ')));
}

TEST_F(Ranks, BracketAsOneThreadDoes) {
  const CommandResult many =
      run_command(ranks(2, {"margin", model("robot_1"), "wide_15", "--tolerance",
                            "base,platform=0:0.05", "--gap", "0.5"}));
  EXPECT_EQ(many.exit_code, 0) << many.errors;
  EXPECT_THAT(many.output, HasSubstr("0.05"));
}

/// Each leg has searches of its own, and those that end the brackets are long enough for all ranks.
TEST_F(Ranks, BoundAQuantityAsOneThreadDoes) {
  const Words bound = long_bound();
  const CommandResult one = run_command(one_thread(joined(bound, {"--certificate", file("one")})));
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  for (const int count : numbers_of_ranks({2, 4})) {
    const CommandResult many =
        run_command(ranks(count, joined(bound, {"--certificate", file("many"), "--threads", "2"})));
    EXPECT_EQ(many.exit_code, 0) << many.errors;
    EXPECT_EQ(many.output, one.output);
    for (const char* end : {".safe", ".singular"})
      EXPECT_TRUE(file_contents(file("many") + end) == file_contents(file("one") + end)) << end;
  }
}

/// Returns the files that a search of a condition number with this name leaves.
std::string files_of_condition(const std::string& name) {
  std::string all;
  for (const char* end : {".safe", ".singular", ".checkpoint"}) all += file_contents(name + end);
  return all;
}

Words saved_as(const std::string& name) {
  return {"--certificate", name, "--checkpoint", name + ".checkpoint"};
}

TEST_F(NightlyRanks, BoundAConditionNumberAsOneThreadDoes) {
  const Words bound = long_condition(file("turn.toml"), "6e-3");
  const CommandResult one = run_command(one_thread(joined(bound, saved_as(file("one")))));
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  const std::string expected = files_of_condition(file("one"));
  EXPECT_GT(expected.size(), 1'000'000U);
  for (const int count : numbers_of_ranks({1, 2, 4})) {
    const std::string name = file(std::to_string(count));
    const CommandResult many =
        run_command(ranks(count, joined(bound, joined(saved_as(name), {"--threads", "2"}))));
    EXPECT_EQ(many.exit_code, 0) << many.errors;
    EXPECT_EQ(many.output, one.output);
    EXPECT_TRUE(files_of_condition(name) == expected) << count << " ranks";
  }
}

TEST_F(NightlyRanks, ContinueASearchOfAConditionNumber) {
  const Words bound = long_condition(file("turn.toml"), "6e-3");
  const CommandResult one = run_command(one_thread(joined(bound, saved_as(file("one")))));
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  const Words many = joined(bound, saved_as(file("many")));
  EXPECT_EQ(run_command(ranks(2, joined(many, {"--max-boxes", "25000"}))).exit_code, 2);
  const CommandResult last = run_command(ranks(3, many));
  EXPECT_EQ(last.output, one.output) << last.errors;
  EXPECT_TRUE(files_of_condition(file("many")) == files_of_condition(file("one")));
}

/// The bounds of singular values, which it asks for, are searches of rank 0 alone.
TEST_F(Ranks, FindASingularPoseWhenTheyBoundAConditionNumber) {
  const Words bound = {"bound", model("planar_3rpr"), "crossing", "condition", "--norm", "2"};
  const CommandResult one = run_command(one_thread(bound));
  const CommandResult many = run_command(ranks(2, bound));
  EXPECT_EQ(many.output, one.output) << many.errors;
  EXPECT_EQ(many.exit_code, one.exit_code);
}

/// Shared after 16 384 boxes, in rounds of 256.
TEST_F(NightlyRanks, PaveForALoadAsOneThreadDoes) {
  const Words locate = {"locate",       model("delta"), "far",         "--load", "payload",
                        "--resolution", "1/64",         "--max-boxes", "20000"};
  const auto files = [this](const std::string& name) {
    return Words{"--output", file(name + ".lines"), "--certificate", file(name + ".proof")};
  };
  const CommandResult one = run_command(one_thread(joined(locate, files("one"))));
  ASSERT_EQ(one.exit_code, 1) << one.errors;
  const auto boxes_of = [this](const std::string& name) {
    const std::string text = file_contents(file(name + ".lines"));
    return text.substr(0, text.rfind('\n', text.size() - 2)) + file_contents(file(name + ".proof"));
  };
  const std::string expected = boxes_of("one");
  EXPECT_GT(expected.size(), 1'000'000U);
  for (const int count : numbers_of_ranks({1, 3})) {
    const CommandResult many =
        run_command(ranks(count, joined(joined(locate, files("many")), {"--threads", "2"})));
    EXPECT_EQ(many.exit_code, 1) << many.errors;
    EXPECT_TRUE(boxes_of("many") == expected) << count << " ranks";
  }
}

TEST_F(Ranks, CheckALoadAsOneThreadDoes) {
  const Words check = {"check", model("delta"), "work", "--load", "payload", "--certificate"};
  ASSERT_EQ(run_command(one_thread(joined(check, {file("one")}))).exit_code, 0);
  const CommandResult many = run_command(ranks(2, joined(check, {file("many")})));
  EXPECT_EQ(many.output, "FEASIBLE\n") << many.errors;
  EXPECT_TRUE(file_contents(file("many")) == file_contents(file("one")));
}

TEST_F(Ranks, FindTheLargestSizeWithinALimitAsOneThreadDoes) {
  const Words margin = {"margin",     model("orthoglide"), "factors_2", "--grow", "edge=0.5:0.7",
                        "--quantity", "sigma-max",         "--limit",   "2",      "--gap",
                        "1e-4",       "--time-limit",      "600"};
  const CommandResult one = run_command(one_thread(margin));
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  EXPECT_EQ(run_command(ranks(2, margin)).output, one.output);
}

TEST_F(Ranks, ReportAMistakeOnce) {
  const CommandResult result = run_command(ranks(3, {"check", file("none.toml")}));
  const std::string words = "cannot read";
  EXPECT_THAT(result.errors, HasSubstr(words));
  EXPECT_EQ(result.errors.find(words), result.errors.rfind(words)) << result.errors;
  EXPECT_EQ(result.exit_code, 74);
}

TEST_F(Ranks, NameTheCommandsThatTheyRun) {
  const CommandResult result = run_command(ranks(2, {"explain", model("robot_1")}));
  EXPECT_THAT(result.errors, HasSubstr("check, locate, margin, bound, datasheet, solve and verify "
                                       "run on several ranks"));
  EXPECT_EQ(result.exit_code, 64);
}

TEST_F(Ranks, EndWhenAWordIsWrong) {
  for (const Words& wrong : {Words{"--without", "nothing"}, Words{"--tolerance", "nobody=1"}}) {
    const CommandResult result =
        run_command(ranks(3, joined({"check", model("robot_1"), "wide_15"}, wrong)));
    EXPECT_EQ(result.exit_code, 64) << result.errors;
  }
}

TEST_F(Ranks, RefuseAFilter) {
  const CommandResult result =
      run_command(ranks(2, {"check", model("robot_1"), "wide_15", "--filter", "any.so"}));
  EXPECT_THAT(result.errors, HasSubstr("--filter: a filter runs in one process only"));
  EXPECT_EQ(result.exit_code, 64);
}

/// Along way-points all ranks search the boxes of all pieces, and those of pieces that need more.
class RanksOnAWay : public Ranks {
 protected:
  RanksOnAWay() { write_ring(directory_.path()); }

  /// Returns the answer, and the bytes of the proofs.
  [[nodiscard]] std::string answer(const Words& launched, const Words& question) const {
    for (const char* end : {"", ".safe", ".singular"}) std::filesystem::remove(file("proof") + end);
    const CommandResult result =
        run_command(joined(launched, joined(question, {"--certificate", file("proof")})));
    std::string text = result.output + std::to_string(result.exit_code) + '\n';
    for (const char* end : {"", ".safe", ".singular"}) text += file_contents(file("proof") + end);
    EXPECT_GT(text.size(), 100U) << result.errors;
    EXPECT_THAT(result.errors, Not(HasSubstr("does not answer")));
    return text;
  }

  void expect_same(const Words& question, const std::vector<int>& counts) const {
    const Words by_one_thread = joined(question, {"--threads", "1"});
    const std::string one = answer({REGULUS_BINARY_DIR "/bin/regulus"}, by_one_thread);
    for (const int count : counts)
      EXPECT_TRUE(answer(ranks(count, {}), by_one_thread) == one) << count << " ranks";
  }
};

TEST_F(RanksOnAWay, ProveAsOneThreadDoes) {
  expect_same({"check", file("ring.toml"), "way"}, numbers_of_ranks({1, 2, 4}));
}

TEST_F(RanksOnAWay, FindTheSingularPieceAsOneThreadDoes) {
  expect_same({"check", file("ring.toml"), "dip"}, numbers_of_ranks({1, 2, 4}));
}

TEST_F(RanksOnAWay, CheckALoadAsOneThreadDoes) {
  expect_same({"check", file("ring.toml"), "way", "--load", "push"}, {3});
}

TEST_F(RanksOnAWay, CompareWithALimitAsOneThreadDoes) {
  expect_same({"bound", file("ring.toml"), "way", "sigma-min", "--limit", "0.0002"}, {2});
}

/// Each rank reads the file of way-points by itself.
TEST_F(RanksOnAWay, NameOneThatReadsOtherWayPoints) {
  std::filesystem::create_directory(file("other"));
  std::ofstream(file("other/way.csv")) << "x,y\n1.1,0\n1.2,0\n";
  // Two programs with a colon between them crash mpiexec of Open MPI 5.0.7.
  const std::string start = "[ \"$OMPI_COMM_WORLD_RANK\" = 0 ] || cd other; exec " +
                            std::string(REGULUS_BINARY_DIR "/bin/regulus-mpi") +
                            " check ring.toml way";
  const CommandResult result =
      run_command({MPIEXEC, "--oversubscribe", "--allow-run-as-root", "-n", "2", "-wdir",
                   directory_.path().string(), "/bin/sh", "-c", start});
  EXPECT_EQ(result.exit_code, 70) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("rank 1 on "));
  EXPECT_THAT(result.errors, HasSubstr("way.csv: the first rank has read other way-points"));
}

/// How long each row is searched depends on the time.
TEST_F(Ranks, MakeADatasheet) {
  const CommandResult sheet =
      run_command(ranks(2, {"datasheet", model("planar_3rpr"), "regular", "--time-limit", "600"}));
  EXPECT_EQ(sheet.exit_code, 0) << sheet.errors;
  EXPECT_THAT(sheet.output, HasSubstr("least |det J⁻¹|"));
}

/// Rank 0 refuses some words only when the others have begun. That it dismisses them may arrive while
/// they wait for the agreement of all; a rank that misses it keeps the job for a minute.
TEST_F(Ranks, EndAtOnceWhenTheQuestionIsRefused) {
  for (int run = 0; run < 3; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    const CommandResult result =
        run_command(ranks(2, {"margin", model("robot_1"), "table4_1", "--scale", "2:1"}));
    EXPECT_EQ(result.exit_code, 64) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("expected LO below HI"));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  }
}

TEST_F(Ranks, RefuseACheckpointThatAnotherJobUses) {
  RunningCommand first(
      ranks(2, {"check", model("robot_1"), "table4_5", "--method", "reg", "--checkpoint",
                file("saved"), "--checkpoint-every", "0.1", "--time-limit", "60"}));
  while (!std::filesystem::exists(file("saved"))) ::usleep(10000);
  const CommandResult second =
      run_command(ranks(2, {"check", model("robot_1"), "table4_5", "--method", "reg",
                            "--checkpoint", file("saved")}));
  EXPECT_EQ(second.exit_code, 74) << second.errors;
  EXPECT_THAT(second.errors, HasSubstr("another"));
  ::kill(first.pid(), SIGTERM);
  static_cast<void>(first.wait());
}

}  // namespace
}  // namespace regulus::detail::test
