// SPDX-License-Identifier: GPL-3.0-or-later
#include <random>

#include "tests/mpi/ranks.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test {
namespace {

/// Returns the processes that a process started.
std::vector<pid_t> children_of(pid_t parent) {
  const std::string id = std::to_string(parent);
  std::ifstream list("/proc/" + id + "/task/" + id + "/children");
  std::vector<pid_t> children;
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

/// Kills one of the ranks, or all of them with mpirun, at a random moment of the search.
void kill_some(const RunningCommand& job, std::mt19937& random) {
  std::vector<pid_t> targets = children_of(job.pid());
  if (targets.empty() || random() % 2 == 0)
    targets.push_back(job.pid());
  else
    targets = {targets[random() % targets.size()]};
  for (const pid_t target : targets) ::kill(target, SIGKILL);
}

TEST(SixtyFourRanks, GiveTheCertificateOfOneThread) {
  const TemporaryDirectory directory;
  const auto file = [&](const char* name) { return (directory.path() / name).string(); };
  ASSERT_EQ(run_command(one_thread(joined(long_check(), {"--certificate", file("one")}))).exit_code,
            0);
  const CommandResult many =
      run_command(ranks(64, joined(long_check(), {"--certificate", file("many")})));
  EXPECT_EQ(many.exit_code, 0) << many.errors;
  EXPECT_TRUE(file_contents(file("many")) == file_contents(file("one")));
}

/// Returns the process that mpirun started as this rank; 0: there is none yet.
pid_t process_of(int rank, const RunningCommand& job) {
  const std::string wanted = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
  for (const pid_t child : children_of(job.pid())) {
    std::ifstream file("/proc/" + std::to_string(child) + "/environ");
    for (std::string variable; std::getline(file, variable, '\0');)
      if (variable == wanted) return child;
  }
  return 0;
}

/// The others do its work, and the job ends with the verdict.
TEST(StoppedRanks, AreNamedAndDoNotKeepTheJob) {
  const TemporaryDirectory directory;
  const Words check = {
      "check", model("robot_2"), "table5_30",     "--method",
      "reg",   "--quiet",        "--certificate", (directory.path() / "proof").string()};
  RunningCommand job(ranks(3, check));
  // Rank 0 writes when all ranks have agreed.
  for (int i = 0; i < 60'000 && std::filesystem::is_empty(directory.path()); ++i) ::usleep(1000);
  const pid_t stopped = process_of(2, job);
  if (stopped == 0) GTEST_SKIP() << "the launcher does not name its ranks";
  ASSERT_EQ(::kill(stopped, SIGSTOP), 0);
  const CommandResult result = job.wait();
  EXPECT_EQ(result.output, "NO SINGULARITY\n");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.errors, testing::ContainsRegex("rank 2 on .* does not answer; the job ends"));
}

TEST(KilledJobs, GoOnToTheSameCertificate) {
  const TemporaryDirectory directory;
  const auto file = [&](const char* name) { return (directory.path() / name).string(); };
  const Words check = {"check", model("robot_2"), "table5_30", "--method", "reg"};
  ASSERT_EQ(run_command(one_thread(joined(check, {"--certificate", file("one")}))).exit_code, 0);
  const Words many = joined(check, {"--certificate", file("many"), "--checkpoint", file("saved"),
                                    "--checkpoint-every", "0.05"});
  std::mt19937 random(1);
  int continued = 0;
  for (int kill = 0; kill < 100; ++kill) {
    RunningCommand job(ranks(2 + static_cast<int>(random() % 3), many));
    for (int i = 0; i < 4000 && !is_search_saved(file("saved")); ++i) ::usleep(1000);
    ::usleep(static_cast<useconds_t>(random() % 1'500'000));
    kill_some(job, random);
    static_cast<void>(job.wait());
    // A rank that lost mpirun ends soon after; until then it holds the lock of the checkpoint.
    ::usleep(300'000);
    continued += is_search_saved(file("saved")) ? 1 : 0;
  }
  EXPECT_GT(continued, 50);
  CommandResult last;
  for (int tries = 0; tries < 10 && last.exit_code != 0; ++tries)
    last = run_command(ranks(4, many));
  EXPECT_EQ(last.exit_code, 0) << last.errors;
  EXPECT_TRUE(file_contents(file("many")) == file_contents(file("one")));
}

TEST(KilledJobs, GoOnToTheSameBracket) {
  const TemporaryDirectory directory;
  const auto file = [&](const char* name) { return (directory.path() / name).string(); };
  const CommandResult one =
      run_command(one_thread(joined(long_bound(), {"--certificate", file("one")})));
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  const Words many =
      joined(long_bound(), {"--certificate", file("many"), "--checkpoint", file("saved")});
  std::mt19937 random(2);
  for (int kill = 0; kill < 20; ++kill) {
    RunningCommand job(ranks(2 + static_cast<int>(random() % 3), many));
    ::usleep(static_cast<useconds_t>(500'000 + random() % 4'000'000));
    kill_some(job, random);
    static_cast<void>(job.wait());
    ::usleep(300'000);
  }
  CommandResult last;
  for (int tries = 0; tries < 10 && last.exit_code != 0; ++tries)
    last = run_command(ranks(4, many));
  EXPECT_EQ(last.output, one.output) << last.errors;
  for (const char* end : {".safe", ".singular"})
    EXPECT_TRUE(file_contents(file("many") + end) == file_contents(file("one") + end)) << end;
}

TEST(KilledJobs, GoOnToTheSameConditionNumber) {
  const TemporaryDirectory directory;
  const auto file = [&](const char* name) { return (directory.path() / name).string(); };
  const Words bound = long_condition(file("turn.toml"), "1e-3");
  const CommandResult one = run_command(one_thread(joined(bound, {"--certificate", file("one")})));
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  const Words many = joined(bound, {"--certificate", file("many"), "--checkpoint", file("saved")});
  std::mt19937 random(3);
  for (int kill = 0; kill < 20; ++kill) {
    RunningCommand job(ranks(2 + static_cast<int>(random() % 3), many));
    ::usleep(static_cast<useconds_t>(500'000 + random() % 4'000'000));
    kill_some(job, random);
    static_cast<void>(job.wait());
    ::usleep(300'000);
  }
  CommandResult last;
  for (int tries = 0; tries < 10 && last.exit_code != 0; ++tries)
    last = run_command(ranks(4, many));
  EXPECT_EQ(last.output, one.output) << last.errors;
  for (const char* end : {".safe", ".singular"})
    EXPECT_TRUE(file_contents(file("many") + end) == file_contents(file("one") + end)) << end;
}

}  // namespace
}  // namespace regulus::detail::test
