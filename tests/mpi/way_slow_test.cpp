// SPDX-License-Identifier: GPL-3.0-or-later
// Ranks share the searches over a branch along way-points.
#include "tests/mpi/ranks.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test {
namespace {

/// A search of values is shared after 16 384 boxes, which both segments have. Where the second one
/// begins, other ranks know from its topic alone.
TEST(RanksOnAWayOfABranch, BoundAsOneThreadDoes) {
  const TemporaryDirectory directory;
  const auto file = [&](const std::string& name) { return (directory.path() / name).string(); };
  std::ofstream(file("bars.toml")) << bars("0.001", "[-40, 40]");
  std::ofstream(file("way.csv")) << "theta\n0\n1\n-0.5\n";
  for (const Words& quantity :
       {Words{"error", "--freedom", "phi"}, Words{"error", "--finite", "--freedom", "phi"}}) {
    Words bound = {
        "bound",        file("bars.toml"), "m",           "--waypoints", file("way.csv"), "--gap",
        "1e-9",         "--quiet",         "--max-boxes", "36000",       "--time-limit",  "1000",
        "--certificate"};
    bound.insert(bound.begin() + 3, quantity.begin(), quantity.end());
    const CommandResult one = run_command(one_thread(joined(bound, {file("one")})));
    EXPECT_GT(file_contents(file("one.phi.safe")).size(), 2'000'000U);
    for (const unsigned count : {2U, 3U}) {
      const CommandResult many = run_command(ranks(count, joined(bound, {file("many")})));
      EXPECT_EQ(many.output, one.output) << many.errors;
      for (const char* end : {".phi.safe", ".phi.singular"})
        EXPECT_TRUE(file_contents(file(std::string("many") + end)) ==
                    file_contents(file(std::string("one") + end)))
            << count << end;
    }
  }
}

/// Forces near their limits are searched in small boxes, on both segments.
TEST(RanksOnAWayOfABranch, PaveALoadAsOneThreadDoes) {
  const TemporaryDirectory directory;
  const auto file = [&](const std::string& name) { return (directory.path() / name).string(); };
  std::ofstream(file("bars.toml")) << bars("0.01", "[-4, 4]");
  std::ofstream(file("way.csv")) << "theta\n0\n1\n-1.4\n";
  const Words locate = {"locate",        file("bars.toml"), "m",     "--waypoints",
                        file("way.csv"), "--load",          "L",     "--resolution",
                        "1/10000000",    "--max-boxes",     "40000", "--output"};
  // The last line is the summary, with its times.
  const auto stretches_of = [&](const std::string& name) {
    const std::string lines = file_contents(file(name));
    return lines.substr(0, lines.rfind('\n', lines.size() - 2));
  };
  const CommandResult one = run_command(one_thread(joined(locate, {file("one")})));
  EXPECT_EQ(one.exit_code, 1) << one.errors;
  for (const unsigned count : {2U, 3U}) {
    const CommandResult many = run_command(ranks(count, joined(locate, {file("many")})));
    EXPECT_EQ(many.output, one.output) << many.errors;
    EXPECT_EQ(stretches_of("many"), stretches_of("one")) << count;
  }
}

}  // namespace
}  // namespace regulus::detail::test
