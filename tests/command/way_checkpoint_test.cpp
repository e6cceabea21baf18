// SPDX-License-Identifier: GPL-3.0-or-later
// --checkpoint of searches whose boxes are judged again: along way-points, and of pavings. They are
// stopped, killed, damaged and forged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "tests/support/command.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/files.hpp"
#include "tests/support/interrupted_runs.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::way_checkpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// det = y − x² − gx. Both ways follow the parabola; boxes around parts of them contain it, so
/// that segments are searched alone.
constexpr const char* kParabola = R"toml(regulus = 1
name = "parabola"
[pose]
x = "m"
y = "m"
[geometry]
g = { value = 0, tolerance = 0.00001, group = "base" }
[matrix]
twist = ["v_x", "v_y"]
rows = [["1", "x"], ["x + g", "y"]]
[load.push]
force = [[-0.1, 0.1], [-0.1, 0.1]]
[actuators]
force = [-1000000, 1000000]
[motion.beside]
waypoints = "beside.csv"
interpolation = "cubic"
error = { x = 0.00001, y = 0.00002 }
[motion.across]
waypoints = "across.csv"
interpolation = "cubic"
error = { x = 0.00001, y = 0.00002 }
[motion.area]
x = [-1, 2]
y = [-1, 2]
constraints = ["x^2 + y^2 - 4"]
[motion.free]
x = [-1, 1]
y = [2, 5]
[motion.line]
x = [-1, 1]
y = "1/3"
)toml";

/// A linkage whose uncertain bars are long enough to divide the ways. "reaches" has a toggle.
constexpr const char* kLinkage = R"toml(regulus = 1
name = "linkage"
[pose]
theta = "rad"
[geometry]
crank = { value = "0.2", tolerance = "0.004", group = "base" }
rod = { value = "0.35355", tolerance = "0.004", group = "base" }
[closure]
unknowns = { phi = "rad", psi = "rad" }
equations = [
  "crank*cos(theta) + rod*cos(phi) - 0.45 - 0.25*cos(psi)",
  "crank*sin(theta) + rod*sin(phi) - 0.25*sin(psi)",
]
start = { theta = 0, phi = 0.7854, psi = 1.5708 }
[actuators]
force = [-5, 5]
[load.push]
wrench = [[-1, 3], 2]
[motion.turns]
waypoints = "turns.csv"
error = { theta = 0.02 }
[motion.reaches]
waypoints = "reaches.csv"
error = { theta = 0.02 }
)toml";

struct Asked {
  const char* name;
  std::vector<std::string> words;  ///< command, motion, options
  const char* model = "parabola.toml";
};

void PrintTo(const Asked& asked, std::ostream* out) { *out << asked.name; }

class KeptSearchTest : public testing::TestWithParam<Asked> {
 protected:
  KeptSearchTest() {
    std::ofstream(path("parabola.toml")) << kParabola;
    write_way("beside.csv", 0.002, 0);
    write_way("across.csv", 0.01, 0.3);
    std::ofstream(path("linkage.toml")) << kLinkage;
    std::string weak = kLinkage;  // in parts of the ways alone
    weak.replace(weak.find("-5, 5"), 5, "-2, 2");
    std::ofstream(path("weak.toml")) << weak;
    std::ofstream(path("turns.csv")) << "theta\n0\n1.5\n-2\n2\n0.3\n-2.1\n2.1\n0\n";
    std::ofstream(path("reaches.csv")) << "theta\n0\n1.5\n-2\n2\n-2\n1.9\n-2.5\n0\n";
  }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }

  void write_way(const std::string& name, double above, double bump) const {
    std::ofstream way(path(name));
    way.precision(17);
    way << "t [s],x [m],y [m]\n";
    for (int k = 0; k <= 6; ++k) {
      const double x = k / 3.0;
      way << k << ',' << x << ',' << x * x + above + (k == 3 ? bump : 0) << '\n';
    }
  }

  /// Returns the words of a run that writes `name`.json, .lines and .proof.
  [[nodiscard]] std::vector<std::string> words(const Asked& asked, const std::string& name,
                                               const std::vector<std::string>& more) const {
    std::vector<std::string> all{kCommand, asked.words[0], path(asked.model)};
    all.insert(all.end(), asked.words.begin() + 1, asked.words.end());
    all.insert(all.end(), {"--json", "--engine", "interpreted"});
    all.insert(all.end(), {"--certificate", path(name + ".proof")});
    if (is_paving(asked)) all.insert(all.end(), {"--output", path(name + ".lines")});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static bool is_paving(const Asked& asked) { return asked.words[0] == "locate"; }

  /// Returns what may not depend on interruptions: the report without times, the boxes, the proof.
  [[nodiscard]] std::string answer_of(const CommandResult& run, const std::string& name) const {
    json report = json::parse(run.output);
    for (const char* key : {"seconds", "proof", "certificate", "threads", "options"})
      report.erase(key);
    std::string lines = file_contents(path(name + ".lines"));
    if (!lines.empty()) lines.resize(lines.rfind('\n', lines.size() - 2));
    report.erase("certificate_obstacle");
    return report.dump(1) + lines + file_contents(path(name + ".proof"));
  }
  [[nodiscard]] CommandResult ask(const Asked& asked, const std::string& name,
                                  const std::vector<std::string>& more) const {
    return run_command(words(asked, name, more));
  }
  /// Stops a search after each of these numbers of boxes. The file stays if one is less than all.
  void stop_after(const Asked& asked, const std::vector<std::uint64_t>& boxes) const {
    for (const std::uint64_t most : boxes) {
      const CommandResult run = ask(
          asked, "stopped", {"--max-boxes", std::to_string(most), "--checkpoint", path("saved")});
      ASSERT_LE(run.exit_code, 2) << run.errors;
    }
  }
  [[nodiscard]] bool is_saved() const { return std::filesystem::exists(path("saved")); }

  TemporaryDirectory folder_;
};

TEST_P(KeptSearchTest, IsTheSameAfterInterruptions) {
  const CommandResult whole = ask(GetParam(), "whole", {"--threads", "1"});
  ASSERT_LE(whole.exit_code, 2) << whole.errors;
  const std::uint64_t boxes = json::parse(whole.output).at("boxes");
  ASSERT_GT(boxes, 100U);
  for (const std::vector<std::uint64_t>& stops : std::vector<std::vector<std::uint64_t>>{
           {1}, {7, 64, boxes / 3}, {boxes / 2, 2 * boxes / 3, boxes - 1}}) {
    stop_after(GetParam(), stops);
    const CommandResult continued =
        ask(GetParam(), "continued", {"--threads", "2", "--checkpoint", path("saved")});
    EXPECT_EQ(answer_of(continued, "continued"), answer_of(whole, "whole"));
    EXPECT_EQ(is_saved(), false) << "there is nothing to continue";
  }
}

/// A kill may come before the search begins, while it is saved, or between.
TEST_P(KeptSearchTest, SurvivesKills) {
  const CommandResult whole = ask(GetParam(), "whole", {"--threads", "1"});
  std::mt19937 random(1);
  for (int kill = 0; kill < 3; ++kill) {
    RunningCommand running(
        words(GetParam(), "many",
              {"--threads", "1", "--checkpoint", path("saved"), "--checkpoint-every", "0"}));
    for (int i = 0; !is_saved() && i < 5000; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 40));
    ::kill(running.pid(), SIGKILL);
    static_cast<void>(running.wait());
  }
  const CommandResult last = ask(GetParam(), "many", {"--checkpoint", path("saved")});
  EXPECT_EQ(answer_of(last, "many"), answer_of(whole, "whole"));
}

/// An interrupt and the time end a search between two rounds.
TEST_P(KeptSearchTest, IsTheSameAfterSignalsAndTimes) {
  const CommandResult whole = ask(GetParam(), "whole", {"--threads", "1"});
  for (int stop = 0; stop < 3; ++stop) {
    RunningCommand running(
        words(GetParam(), "many", {"--threads", "1", "--checkpoint", path("saved")}));
    for (int i = 0; !is_saved() && i < 5000; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(3 * stop));
    ::kill(running.pid(), SIGINT);
    EXPECT_LE(running.wait().exit_code, 2);
    static_cast<void>(
        ask(GetParam(), "many", {"--time-limit", "0.01", "--checkpoint", path("saved")}));
  }
  const CommandResult last = ask(GetParam(), "many", {"--checkpoint", path("saved")});
  EXPECT_EQ(answer_of(last, "many"), answer_of(whole, "whole"));
}

TEST_P(KeptSearchTest, OfAnotherQuestionIsRefused) {
  stop_after(GetParam(), {20});
  ASSERT_TRUE(is_saved());
  const std::string saved = file_contents(path("saved"));
  const CommandResult other =
      ask(GetParam(), "other", {"--tolerance", "base=0.00002", "--checkpoint", path("saved")});
  EXPECT_EQ(other.exit_code, 65);
  EXPECT_THAT(other.errors, HasSubstr("it is about another question"));
  EXPECT_EQ(file_contents(path("saved")), saved);
}

/// What a damaged file says is refused, or judged again.
TEST_P(KeptSearchTest, IfDamagedIsRefusedOrRight) {
  const CommandResult whole = ask(GetParam(), "whole", {"--threads", "1"});
  const std::uint64_t boxes = json::parse(whole.output).at("boxes");
  stop_after(GetParam(), {boxes / 2});
  const std::string saved = file_contents(path("saved"));
  const std::size_t known = saved.find("\"known\"");
  ASSERT_NE(known, std::string::npos);
  const std::vector<std::string> splices{" ",  "-",  "=",    "7",  "0:1 ", "-2 ",
                                         "x ", "0 ", "null", "{}", "\"",   "1e9"};
  int refused = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::ofstream(path("saved")) << saved.substr(0, known)
                                 << Damage(seed, splices).done_to(saved.substr(known));
    const CommandResult run = ask(GetParam(), "damaged", {"--checkpoint", path("saved")});
    if (run.exit_code != 65) {
      EXPECT_EQ(run.exit_code, whole.exit_code) << seed << run.errors;
      continue;
    }
    EXPECT_THAT(run.errors, HasSubstr("the search cannot continue from this file")) << seed;
    ++refused;
  }
  EXPECT_GT(refused, 0);
}

const std::vector<Asked> kKept = {
    {"check_beside", {"check", "beside"}},
    {"check_across", {"check", "across"}},
    {"locate_beside", {"locate", "beside"}},
    {"locate_across", {"locate", "across"}},
    {"branch", {"check", "turns"}, "linkage.toml"},
    {"branch_to_a_toggle", {"check", "reaches"}, "linkage.toml"},
    {"locate_branch", {"locate", "turns"}, "linkage.toml"},
    {"locate_toggle", {"locate", "reaches"}, "linkage.toml"},
    {"load_of_branch", {"check", "turns", "--load", "push"}, "linkage.toml"},
    {"locate_load_of_branch", {"locate", "turns", "--load", "push"}, "weak.toml"},
    {"locate_load_to_a_toggle", {"locate", "reaches", "--load", "push"}, "weak.toml"},
    {"load_beside", {"check", "beside", "--load", "push"}},
    {"load_across", {"check", "across", "--load", "push"}},
    {"load_stretches", {"locate", "across", "--load", "push"}},
    {"area", {"locate", "area", "--resolution", "1/128"}},
    {"line", {"locate", "line", "--resolution", "1/512"}}};

std::string name_of(const testing::TestParamInfo<Asked>& asked) { return asked.param.name; }

INSTANTIATE_TEST_SUITE_P(Of, KeptSearchTest, testing::ValuesIn(every_second(kKept, 0)), name_of);
INSTANTIATE_TEST_SUITE_P(NightlyOf, KeptSearchTest, testing::ValuesIn(every_second(kKept, 1)),
                         name_of);

class KeptPaving : public KeptSearchTest {};

/// After 16 384 boxes a search is cut into units.
TEST_F(KeptPaving, OfManyBoxesIsTheSame) {
  const auto run = [this](const std::string& name, std::vector<std::string> more) {
    more.insert(more.begin(), {kCommand, "locate", kPlanar, "crossing", "--resolution", "1/128",
                               "--engine", "interpreted", "--json", "--output",
                               path(name + ".lines"), "--certificate", path(name + ".proof")});
    return run_command(more);
  };
  const CommandResult whole = run("whole", {});
  ASSERT_EQ(whole.exit_code, 1) << whole.errors;
  ASSERT_GT(json::parse(whole.output).at("boxes"), 25'000U);
  for (const char* most : {"15000", "20000"})
    ASSERT_EQ(run("stopped", {"--max-boxes", most, "--checkpoint", path("saved")}).exit_code, 1);
  ASSERT_TRUE(is_saved());
  const CommandResult continued = run("continued", {"--checkpoint", path("saved")});
  EXPECT_EQ(answer_of(continued, "continued"), answer_of(whole, "whole"));
}

/// Gives the search of one question the question of another. What it claims is false there.
class ForgedSearch : public KeptSearchTest {
 protected:
  /// Returns the answer that follows from the search of `easy`, which was stopped near its end, and
  /// from the question of `hard`.
  [[nodiscard]] CommandResult forged(const Asked& easy, const Asked& hard) const {
    const CommandResult whole = ask(easy, "easy", {});
    const std::uint64_t boxes = json::parse(whole.output).at("boxes");
    for (std::uint64_t n = 63; n > 0 && !is_saved(); --n) stop_after(easy, {boxes * n / 64});
    json saved = json::parse(file_contents(path("saved")));
    EXPECT_FALSE(saved.at("known").empty());
    std::filesystem::remove(path("saved"));
    stop_after(hard, {1});
    saved["question"] = json::parse(file_contents(path("saved"))).at("question");
    std::ofstream(path("saved")) << saved.dump();
    return ask(hard, "forged", {"--checkpoint", path("saved")});
  }
};

TEST_F(ForgedSearch, ProvesNothingAlongWayPoints) {
  for (const char* command : {"check", "locate"}) {
    const Asked hard{"", {command, "across"}};
    const CommandResult run = forged({"", {command, "beside"}}, hard);
    EXPECT_EQ(run.exit_code, 1) << run.errors;
    EXPECT_EQ(json::parse(run.output).at("verdict"), "singularity");
    if (is_paving(hard)) {
      const json share = json::parse(run.output).at("share");
      EXPECT_GT(share.at("singular"), 0);
      EXPECT_EQ(share, json::parse(ask(hard, "hard", {}).output).at("share"));
    }
  }
}

TEST_F(ForgedSearch, ProvesNothingOfALoad) {
  for (const char* command : {"check", "locate"}) {
    const CommandResult run = forged({"", {command, "beside", "--load", "push"}},
                                     {"", {command, "across", "--load", "push"}});
    EXPECT_EQ(run.exit_code, 2) << run.errors;
    EXPECT_EQ(json::parse(run.output).at("verdict"), "possible-problem");
  }
}

TEST_F(ForgedSearch, ProvesNothingOfABranch) {
  for (const char* command : {"check", "locate"}) {
    const CommandResult run = forged({"", {command, "turns"}, "linkage.toml"},
                                     {"", {command, "reaches"}, "linkage.toml"});
    EXPECT_EQ(run.exit_code, 1) << run.errors;
    const json report = json::parse(run.output);
    EXPECT_EQ(report.at("verdict"), "singularity");
    EXPECT_EQ(report.at("segment").at("segment"), 6);
    EXPECT_TRUE(!report.contains("share") || double(report.at("share").at("free")) < 1);
  }
}

/// Limits that a motor keeps all the way are not those that it keeps in parts of it.
TEST_F(ForgedSearch, ProvesNothingOfALoadOnABranch) {
  const std::vector<std::string> words{"locate", "turns", "--load", "push"};
  const Asked hard{"", words, "weak.toml"};
  const CommandResult run = forged({"", words, "linkage.toml"}, hard);
  EXPECT_EQ(run.exit_code, 1) << run.errors;
  const json report = json::parse(run.output);
  EXPECT_EQ(report.at("verdict"), "infeasible");
  EXPECT_GT(report.at("share").at("infeasible"), 0);
  EXPECT_EQ(report.at("share"), json::parse(ask(hard, "hard", {}).output).at("share"));
}

/// The boxes that are left are those of the other range.
TEST_F(ForgedSearch, OfAnotherRangeIsRefused) {
  const CommandResult run = forged({"", {"locate", "line", "--resolution", "1/512"}},
                                   {"", {"locate", "line", "--range", "x=-2:2"}});
  EXPECT_EQ(run.exit_code, 65) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("the search cannot continue from this file"));
}

}  // namespace
}  // namespace regulus::detail::test::way_checkpoint
