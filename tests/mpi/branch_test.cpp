// SPDX-License-Identifier: GPL-3.0-or-later
// Ranks share the search over a branch of a closure.
#include "tests/mpi/ranks.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test {
namespace {

class RanksOnABranch : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const {
    return (directory_.path() / name).string();
  }
  const TemporaryDirectory directory_;
};
using NightlyRanksOnABranch = RanksOnABranch;

/// Shared after 16 384 boxes.
TEST_F(NightlyRanksOnABranch, PaveAsOneThreadDoes) {
  const Words locate = {
      "locate",  model("five_bar_closure"), "wide", "--resolution", "1/400", "--max-boxes", "18000",
      "--output"};
  const auto boxes_of = [this](const std::string& name) {
    const std::string lines = file_contents(file(name));
    return lines.substr(0, lines.rfind("{\"summary\""));
  };
  static_cast<void>(run_command(one_thread(joined(locate, {file("one")}))));
  EXPECT_GT(boxes_of("one").size(), 500'000U);
  const CommandResult many = run_command(ranks(2, joined(locate, {file("many")})));
  EXPECT_TRUE(boxes_of("many") == boxes_of("one")) << many.errors;
}

TEST_F(RanksOnABranch, ProveAsOneThreadDoes) {
  const Words check = {"check", model("four_bar"), "inside", "--certificate"};
  ASSERT_EQ(run_command(one_thread(joined(check, {file("one")}))).exit_code, 0);
  const CommandResult many = run_command(ranks(2, joined(check, {file("many")})));
  EXPECT_EQ(many.output, "NO SINGULARITY\n") << many.errors;
  EXPECT_TRUE(file_contents(file("many")) == file_contents(file("one")));
}

TEST_F(RanksOnABranch, BracketAsOneThreadDoes) {
  const Words margin = {"margin", model("four_bar"), "swing", "--scale", "1:4", "--gap", "0.1"};
  const CommandResult one = run_command(one_thread(margin));
  EXPECT_EQ(run_command(ranks(2, margin)).output, one.output) << one.errors;
}

/// From the second segment on each begins with a configuration that the ranks are told. The last one
/// has a toggle; the paving beyond it is shared.
TEST_F(NightlyRanksOnABranch, PaveAWayAsOneThreadDoes) {
  std::ofstream(file("way.csv")) << "theta\n0\n1.5\n-2\n2.4\n";
  const Words locate = {"locate",        model("four_bar"), "turn",      "--waypoints",
                        file("way.csv"), "--resolution",    "1/1000000", "--max-boxes",
                        "18000",         "--output"};
  const auto stretches_of = [this](const std::string& name) {
    const std::string lines = file_contents(file(name));
    return lines.substr(0, lines.rfind("{\"summary\""));
  };
  const CommandResult one = run_command(one_thread(joined(locate, {file("one")})));
  EXPECT_NE(stretches_of("one"), "");
  const CommandResult many = run_command(ranks(2, joined(locate, {file("many")})));
  EXPECT_EQ(stretches_of("many"), stretches_of("one")) << many.errors;
  EXPECT_EQ(many.output, one.output);
}

TEST_F(RanksOnABranch, FollowAWayAsOneThreadDoes) {
  std::ofstream(file("way.csv")) << "theta\n0\n1.5\n-2\n2\n";
  const Words asked = {model("four_bar"), "swing", "--waypoints", file("way.csv"), "--certificate"};
  const Words check = joined({"check"}, asked);
  ASSERT_EQ(run_command(one_thread(joined(check, {file("one")}))).exit_code, 0);
  const CommandResult many = run_command(ranks(2, joined(check, {file("many")})));
  EXPECT_EQ(many.output, "NO SINGULARITY\n") << many.errors;
  EXPECT_TRUE(file_contents(file("many")) == file_contents(file("one")));
  const Words margin = joined({"margin"}, asked), grown = {"--tube", "theta=0:1"};
  const CommandResult bracket = run_command(one_thread(joined(joined(margin, {file("a")}), grown)));
  EXPECT_EQ(bracket.exit_code, 0) << bracket.errors;
  const CommandResult shared = run_command(ranks(2, joined(joined(margin, {file("b")}), grown)));
  EXPECT_EQ(shared.output, bracket.output) << shared.errors;
  for (const char* end : {".safe", ".singular"})
    EXPECT_TRUE(file_contents(file(std::string("b") + end)) ==
                file_contents(file(std::string("a") + end)))
        << end;
}

TEST_F(RanksOnABranch, CompareAThresholdAsOneThreadDoes) {
  std::ofstream(file("way.csv")) << "theta\n0\n1\n-1\n";
  for (const Words& along : {Words{}, Words{"--waypoints", file("way.csv")}}) {
    const Words asked = joined({model("four_bar"), "swing", "--quiet"}, along);
    for (const char* alpha : {"0.06", "0.07"}) {
      const Words check = joined(joined({"check"}, asked), {"--alpha", alpha, "--certificate"});
      const CommandResult one = run_command(one_thread(joined(check, {file("one")})));
      const CommandResult many = run_command(ranks(2, joined(check, {file("many")})));
      EXPECT_EQ(many.output, one.output) << many.errors;
      EXPECT_NE(file_contents(file("one")), "");
      EXPECT_TRUE(file_contents(file("many")) == file_contents(file("one"))) << alpha;
    }
    for (const Words& more : {Words{"margin", "--alpha", "0.05:0.07", "--gap", "0.1"},
                              Words{"locate", "--alpha", "0.07"}}) {
      const Words words = joined(joined({more[0]}, asked), Words(more.begin() + 1, more.end()));
      EXPECT_EQ(run_command(ranks(2, words)).output, run_command(one_thread(words)).output);
    }
  }
}

/// Its search of values is shared after 16 384 boxes.
TEST_F(RanksOnABranch, ShareTheSearchOfAThreshold) {
  std::ofstream(file("bars.toml")) << bars("0.01", "[-1, 1]");
  const Words check = {"check",       file("bars.toml"), "m",       "--alpha",      "0.0586",
                       "--max-boxes", "40000",           "--quiet", "--certificate"};
  const CommandResult one = run_command(one_thread(joined(check, {file("one")})));
  EXPECT_EQ(one.output, "NO SINGULARITY\n") << one.errors;
  const CommandResult many = run_command(ranks(2, joined(check, {file("many")})));
  EXPECT_EQ(many.output, one.output) << many.errors;
  EXPECT_GT(file_contents(file("one")).size(), 1'000'000U);
  EXPECT_TRUE(file_contents(file("many")) == file_contents(file("one")));
}

/// Its uncertain links leave many boxes undecided.
const std::string kBars = bars("0.01", "[-1, 1]");

/// Its search of values is shared after 16 384 boxes; the branch has few.
TEST_F(RanksOnABranch, BoundAsOneThreadDoes) {
  std::ofstream(file("bars.toml")) << kBars;
  const Words bound = {"bound",   file("bars.toml"), "m",    "error",       "--freedom",
                       "phi",     "--gap",           "1e-9", "--max-boxes", "18000",
                       "--quiet", "--certificate"};
  const CommandResult one = run_command(one_thread(joined(bound, {file("one")})));
  const CommandResult many = run_command(ranks(2, joined(bound, {file("many")})));
  EXPECT_EQ(many.output, one.output) << many.errors;
  EXPECT_GT(file_contents(file("one.phi.safe")).size(), 1'000'000U);
  for (const char* end : {".phi.safe", ".phi.singular"})
    EXPECT_TRUE(file_contents(file(std::string("many") + end)) ==
                file_contents(file(std::string("one") + end)))
        << end;
}

/// Each rank proves the leaves of some shards; the first one links those of all.
TEST_F(RanksOnABranch, VerifyTheShardsOfAProof) {
  std::ofstream(file("bars.toml")) << kBars;
  const Words bound = {"bound",   file("bars.toml"), "m",     "error",        "--freedom",
                       "phi",     "--gap",           "0.01",  "--shard-size", "16kiB",
                       "--quiet", "--max-boxes",     "18000", "--certificate"};
  const CommandResult one = run_command(one_thread(joined(bound, {file("one")})));
  const CommandResult shared = run_command(ranks(2, joined(bound, {file("many")})));
  EXPECT_EQ(shared.output, one.output) << shared.errors;
  const std::string index = file("one.phi.safe");
  EXPECT_EQ(file_contents(file("many.phi.safe")), file_contents(index));
  const CommandResult alone =
      run_command({REGULUS_BINARY_DIR "/bin/regulus", "verify", index, "--threads", "2"});
  EXPECT_EQ(alone.output, "VERIFIED\n") << alone.errors;
  EXPECT_THAT(alone.errors, testing::ContainsRegex("shards +[0-9]+\nleaves .*\nlinks "));
  for (const int count : {1, 3}) {
    const CommandResult many = run_command(ranks(count, {"verify", index}));
    EXPECT_EQ(many.output, alone.output) << many.errors;
    EXPECT_THAT(many.errors, testing::HasSubstr(alone.errors));
  }
  std::filesystem::remove(index + ".shards/2");
  const CommandResult lacking = run_command(ranks(2, {"verify", index}));
  EXPECT_EQ(lacking.output, "REJECTED\n");
  EXPECT_THAT(lacking.errors, testing::HasSubstr("shard 2: it is missing"));
}

TEST_F(NightlyRanksOnABranch, BoundSingularValuesAsOneThreadDoes) {
  std::ofstream(file("bars.toml")) << kBars;
  for (const Words& quantity : {Words{"condition", "--norm", "2"}, Words{"sigma-min"}}) {
    Words bound = {"bound",       file("bars.toml"), "m",       "--gap",        "1e-12",
                   "--max-boxes", "18000",           "--quiet", "--certificate"};
    bound.insert(bound.begin() + 3, quantity.begin(), quantity.end());
    const CommandResult one = run_command(one_thread(joined(bound, {file("one")})));
    const CommandResult many = run_command(ranks(2, joined(bound, {file("many")})));
    EXPECT_EQ(many.output, one.output) << many.errors;
    EXPECT_GT(file_contents(file("one.safe")).size(), 1'000'000U);
    for (const char* end : {".safe", ".singular"})
      EXPECT_TRUE(file_contents(file(std::string("many") + end)) ==
                  file_contents(file(std::string("one") + end)))
          << end;
  }
}

TEST_F(RanksOnABranch, BoundFiniteErrorsAsOneThreadDoes) {
  std::ofstream(file("bars.toml")) << kBars;
  const Words bound = {
      "bound", file("bars.toml"), "m",     "error",   "--finite",     "--freedom", "phi", "--gap",
      "1e-9",  "--max-boxes",     "18000", "--quiet", "--certificate"};
  const CommandResult one = run_command(one_thread(joined(bound, {file("one")})));
  const CommandResult many = run_command(ranks(2, joined(bound, {file("many")})));
  EXPECT_EQ(many.output, one.output) << many.errors;
  for (const char* end : {".phi.safe", ".phi.singular"})
    EXPECT_TRUE(file_contents(file(std::string("many") + end)) ==
                file_contents(file(std::string("one") + end)))
        << end;
}

TEST_F(NightlyRanksOnABranch, CompareAndSumUpAsOneThreadDoes) {
  std::ofstream(file("bars.toml")) << kBars;
  for (const Words& asked :
       {Words{"margin", file("bars.toml"), "m", "--scale", "0.5:1.2", "--quantity", "error",
              "--limit", "0.02", "--gap", "0.1", "--quiet"},
        Words{"bound", file("bars.toml"), "m", "force", "--limit", "9", "--quiet"},
        Words{"bound", file("bars.toml"), "m", "condition", "--norm", "2", "--limit", "9",
              "--quiet"},
        Words{"check", file("bars.toml"), "m", "--load", "L", "--quiet"}}) {
    const CommandResult one = run_command(one_thread(asked));
    EXPECT_LE(one.exit_code, 2) << one.errors;
    const CommandResult many = run_command(ranks(2, asked));
    EXPECT_EQ(many.output, one.output) << many.errors;
    EXPECT_EQ(many.exit_code, one.exit_code) << many.errors;
  }
  const Words sheet = {"datasheet", file("bars.toml"), "m", "--gap", "0.05", "--markdown"};
  EXPECT_EQ(run_command(ranks(2, sheet)).exit_code, run_command(one_thread(sheet)).exit_code);
}

TEST_F(RanksOnABranch, PaveALoadAsOneThreadDoes) {
  std::ofstream(file("bars.toml")) << kBars;
  const Words locate = {"locate",       file("bars.toml"), "m",           "--load", "L",
                        "--resolution", "1/100000",        "--max-boxes", "18000",  "--output"};
  // The last line is the summary, with its times.
  const auto boxes_of = [this](const std::string& name) {
    const std::string lines = file_contents(file(name));
    return lines.substr(0, lines.rfind('\n', lines.size() - 2));
  };
  static_cast<void>(run_command(one_thread(joined(locate, {file("one")}))));
  EXPECT_GT(boxes_of("one").size(), 500'000U);
  const CommandResult many = run_command(ranks(2, joined(locate, {file("many")})));
  EXPECT_TRUE(boxes_of("many") == boxes_of("one")) << many.errors;
}

}  // namespace
}  // namespace regulus::detail::test
