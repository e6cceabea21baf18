// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus-mpi solve`: the places of a table, with the bytes of one process.
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <thread>

#include "tests/mpi/ranks.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test {
namespace {

class SolvingRanks : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const {
    return (directory_.path() / name).string();
  }
  const TemporaryDirectory directory_;
};

/// Each rank has some of the places; the last one has fewer, and 8 ranks have some without any.
TEST_F(SolvingRanks, SolveThePlacesOfATableAsOneThreadDoes) {
  std::ofstream(file("lengths.csv")) << "t [s], rho_1, rho_2, rho_3\n0, 14.98, 15.38, 12\n"
                                        "1, 14.9, 15.4, 12.1\n2, 100, 1, 1\n3, 14.8, 15.5, 12.2\n"
                                        "4, 14.7, 15.3, 12.1\n";
  const auto solve = [this](const std::string& name) {
    return Words{"solve",         model("rpr_6"), "--waypoints", file("lengths.csv"),
                 "--certificate", file(name),     "--output",    file(name + ".jsonl")};
  };
  const CommandResult one = run_command(one_thread(solve("one")));
  ASSERT_EQ(one.output, "NONE at 1, COMPLETE at 4 of 5 places: 24 poses\n") << one.errors;
  const auto lines_of = [](const std::string& text) {
    static const std::regex kTime("\"search\": ?[-+.0-9e]+|\"seconds\": ?[-+.0-9e]+");
    return std::regex_replace(text, kTime, "");
  };
  for (const int count : numbers_of_ranks({1, 2, 3, 8})) {
    const CommandResult many = run_command(ranks(count, solve("many")));
    EXPECT_EQ(many.exit_code, 1) << many.errors;
    EXPECT_EQ(many.output, one.output);
    EXPECT_TRUE(file_contents(file("many")) == file_contents(file("one"))) << count << " ranks";
    EXPECT_EQ(lines_of(file_contents(file("many.jsonl"))),
              lines_of(file_contents(file("one.jsonl"))));
  }
}

/// A shard ends with the place that makes it longer than its size.
TEST_F(SolvingRanks, CutAndVerifyThePlacesOfATable) {
  std::ofstream table(file("lengths.csv"));
  table << "rho_1, rho_2, rho_3\n";
  for (int k = 0; k < 20; ++k) table << "14.98, 15." << 30 + k << ", 12\n";
  table.close();
  const auto solve = [this](const std::string& name) {
    return Words{"solve",         model("rpr_6"), "--waypoints",  file("lengths.csv"),
                 "--certificate", file(name),     "--shard-size", "4kiB"};
  };
  ASSERT_EQ(run_command(one_thread(solve("one"))).exit_code, 0);
  ASSERT_EQ(run_command(ranks(2, solve("many"))).exit_code, 0);
  EXPECT_EQ(file_contents(file("many")), file_contents(file("one")));
  const Words about = {"verify",       file("one"),   "--model",
                       model("rpr_6"), "--waypoints", file("lengths.csv")};
  const CommandResult alone = run_command(joined({REGULUS_BINARY_DIR "/bin/regulus"}, about));
  EXPECT_EQ(alone.output, "VERIFIED\n") << alone.errors;
  EXPECT_THAT(alone.errors, testing::ContainsRegex("places     20, .*\nshards     [3-9]"));
  for (const int count : {2, 12}) {
    const CommandResult many = run_command(ranks(count, about));
    EXPECT_EQ(many.output, alone.output) << many.errors;
    EXPECT_THAT(many.errors, testing::HasSubstr(alone.errors));
  }
  std::filesystem::remove(file("one.shards/2"));
  const CommandResult lacking = run_command(ranks(2, about));
  EXPECT_EQ(lacking.output, "REJECTED\n");
  EXPECT_THAT(lacking.errors, testing::HasSubstr("shard 2: it is missing"));
}

TEST_F(SolvingRanks, SolveOnePlaceOnce) {
  const Words solve = {"solve", model("rpr_6"), "--certificate", file("proof")};
  const CommandResult many = run_command(ranks(3, solve));
  EXPECT_EQ(many.exit_code, 0) << many.errors;
  EXPECT_EQ(many.output, "COMPLETE: 6 poses\n");
  const std::string proof = file_contents(file("proof"));
  EXPECT_EQ(run_command(one_thread(solve)).exit_code, 0);
  EXPECT_TRUE(file_contents(file("proof")) == proof);
}

/// The search has more than 16 384 boxes.
TEST_F(SolvingRanks, ShareTheBoxesOfOnePlace) {
  const Words solve = {"solve",        model("rpr_6"), "--tolerance", "base=0.3", "--json",
                       "--time-limit", "600",          "--max-boxes", "20000"};
  const auto found = [](const CommandResult& run) {
    nlohmann::json report = nlohmann::json::parse(run.output);
    for (const char* key : {"seconds", "options", "threads"}) report.erase(key);
    return report;
  };
  const nlohmann::json one = found(run_command(one_thread(solve)));
  EXPECT_GT(one.at("boxes"), 16384);
  for (const int count : numbers_of_ranks({1, 2, 3, 8}))
    EXPECT_EQ(found(run_command(ranks(count, solve))), one) << count << " ranks";
}

/// Each rank has the places that it solves in a file of its own. So many take longer than mpiexec needs to
/// end the job.
TEST_F(SolvingRanks, GoOnWithTheirPlaces) {
  std::ofstream table(file("lengths.csv"));
  table << "rho_1, rho_2, rho_3\n";
  for (int k = 0; k < 150; ++k) table << "14.98, 15." << 30 + k % 10 << ", 12\n";
  table.close();
  const Words solve = {"solve",         model("rpr_6"), "--waypoints", file("lengths.csv"),
                       "--certificate", file("proof")};
  const CommandResult whole = run_command(one_thread(solve));
  const std::string proof = file_contents(file("proof"));
  const Words kept = joined(solve, {"--checkpoint", file("saved"), "--checkpoint-every", "0"});
  RunningCommand run(ranks(3, kept));
  for (int i = 0; i < 20000 && !is_search_saved(file("saved.2")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(run.pid(), SIGTERM);
  static_cast<void>(run.wait());
  EXPECT_TRUE(is_search_saved(file("saved.2")));
  const CommandResult many = run_command(ranks(2, kept));
  EXPECT_EQ(many.output, whole.output) << many.errors;
  EXPECT_TRUE(file_contents(file("proof")) == proof);
  EXPECT_FALSE(std::filesystem::exists(file("saved")) || std::filesystem::exists(file("saved.1")));
}

TEST_F(SolvingRanks, TellAMistakeOfATableOnce) {
  std::ofstream(file("lengths.csv")) << "rho_1, rho_2, rho_3\n14.98, 15.38, -12\n";
  const CommandResult many =
      run_command(ranks(3, {"solve", model("rpr_6"), "--waypoints", file("lengths.csv")}));
  EXPECT_EQ(many.exit_code, 65);
  EXPECT_EQ(many.errors.find("negative"), many.errors.rfind("negative")) << many.errors;
}

}  // namespace
}  // namespace regulus::detail::test
