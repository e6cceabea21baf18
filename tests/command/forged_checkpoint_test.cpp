// SPDX-License-Identifier: GPL-3.0-or-later
// Files of --checkpoint that claim what is false, for each kind of question that has one. Whatever a
// file says, no answer is better than the truth, which is known in closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>

#include "tests/command/forged_checkpoints.hpp"
#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/interrupted_runs.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::forged_checkpoint {
namespace {

/// det = (x² − 2)² + 2(y² − 3)², which is 0 at (√2, √3) alone, and has no other sign nearby. There
/// no force holds a load. With g it is 0 up to x = 1.4 if |g| ≥ 0.04, and σ_min ≤ |0.04 − |g||.
constexpr const char* kTouch = R"toml(regulus = 1
name = "touch"
[pose]
x = "m"
y = "m"
[geometry]
g = { value = 0, tolerance = 0, group = "base" }
[matrix]
twist = ["v_x", "v_y"]
rows = [["x^2 - 2 - g", "2*y^2 - 6"], ["3 - y^2", "x^2 - 2 - g"]]
[load.push]
force = [[-1, 1], [-1, 1]]
[actuators]
force = [-10, 10]
[motion.all]
x = [0, 2]
y = [0, 2]
)toml";

/// A report, and the lines of --output without the last.
struct Told {
  json report;
  std::vector<json> boxes;
};

using IsTrue = std::function<bool(const Told&)>;

bool is_not(const Told& told, const char* verdict) { return told.report.at("verdict") != verdict; }

/// True if no box with this place claims one of these.
bool claims_none(const Told& told, const std::vector<std::pair<std::string, double>>& place,
                 const std::vector<std::string>& kinds) {
  return std::ranges::none_of(told.boxes, [&](const json& line) {
    const bool is_there = std::ranges::all_of(place, [&](const auto& at) {
      const json& range = line.at("box").at(at.first);
      return range.at(0) <= at.second && at.second <= range.at(1);
    });
    return is_there && std::ranges::find(kinds, line.at("kind").get<std::string>()) != kinds.end();
  });
}

bool is_at_most(const Told& told, const char* key, double most) {
  return told.report.at(key).is_null() || told.report.at(key) <= most;
}

struct Kind {
  const char* name;
  std::vector<std::string> words;  ///< command, model, options
  Words easy;                      ///< a motion along which a better answer is true
  IsTrue is_true;                  ///< of an answer over the whole range
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

/// A linkage whose load is beyond a limit in a part of its motion.
constexpr const char* kBars = R"toml(regulus = 1
name = "bars"
[pose]
theta = "rad"
[closure]
unknowns = { phi = "rad", psi = "rad" }
equations = [
  "0.2*cos(theta) + 0.35355*cos(phi) - 0.45 - 0.25*cos(psi)",
  "0.2*sin(theta) + 0.35355*sin(phi) - 0.25*sin(psi)",
]
start = { theta = 0, phi = 0.7854, psi = 1.5708 }
[actuators]
force = [-4.1, 2.5]
[load.push]
wrench = [[-1, 3], 2]
[motion.all]
theta = [-1, 1.5]
)toml";

const std::vector<std::pair<std::string, double>> kZero = {{"x", std::sqrt(2.0)},
                                                           {"y", std::sqrt(3.0)}};
const std::string kFourBar = model_path("four_bar");
constexpr double kToggle = 2.3138160;  // rad: 132.5719°

bool is_not_regular(const Told& told) { return is_not(told, "no-singularity"); }
bool is_not_feasible(const Told& told) { return is_not(told, "feasible"); }
bool is_open_at_zero(const Told& told) {
  return claims_none(told, kZero, {"free", "feasible", "outside"});
}
bool is_open_at_toggles(const Told& told) {
  return claims_none(told, {{"theta", kToggle}}, {"free", "outside"}) &&
         claims_none(told, {{"theta", -kToggle}}, {"free", "outside"});
}
/// It is 4.39706 at ±2 rad.
bool is_condition_of_bars(const Told& told) {
  return told.report.at("proved").is_null() || told.report.at("proved") >= 4.397;
}
/// The load needs −4.1659 at −0.2 rad, and at least −4.1 from −0.01 rad on.
bool is_open_beyond_the_limit(const Told& told) {
  return claims_none(told, {{"theta", -0.2}}, {"feasible", "outside"});
}
IsTrue is_proved_up_to(const char* key, double most) {
  return [=](const Told& told) { return is_at_most(told, key, most); };
}
/// κ + 1/κ = ‖A‖²/|det A| = 45.1922/18.0961 at (1.3, 0).
bool is_condition(const Told& told) {
  return told.report.at("proved").is_null() || told.report.at("proved") >= 1.9964;
}
bool is_datasheet(const Told& told) {
  return std::ranges::all_of(told.report.at("bounds"), [](const json& bound) {
    if (bound.at("proved").is_null() || bound.at("attained").is_null()) return true;
    const double proved = bound.at("proved"), attained = bound.at("attained");
    const bool is_least = bound.at("least");
    const bool is_sigma = bound.at("quantity").at("kind") == "sigma-min";
    return (is_least ? proved <= attained : proved >= attained) && (!is_sigma || proved <= 0.31);
  });
}

Words words_in(const char* text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

std::vector<Kind> kinds_of_linkages() {
  const auto bar = [](const char* name, const char* command, const char* more, IsTrue is_true) {
    Words words{command, kFourBar, "turn"};
    for (const std::string& word : words_in(more)) words.push_back(word);
    return Kind{name, std::move(words), {"--range", "theta=-2:2"}, std::move(is_true)};
  };
  return {
      bar("check_closure", "check", "", is_not_regular),
      bar("locate_closure", "locate", "--resolution 1/256", is_open_at_toggles),
      bar("margin_closure", "margin", "--scale 0.5:1 --gap 0.05",
          is_proved_up_to("certified", kToggle / (140 * std::numbers::pi / 180))),
      {"bound_closure",
       {"bound", kFourBar, "turn", "condition", "--gap", "0.01", "--range", "theta=-2:2"},
       {"--range", "theta=-1:1"},
       is_condition_of_bars},
      {"bound_closure_way",
       {"bound", kFourBar, "turn", "condition", "--gap", "0.01", "--waypoints", "way"},
       {"--waypoints", "near"},
       is_condition_of_bars},
      {"check_load_closure",
       {"check", "bars", "all", "--load", "push"},
       {"--range", "theta=-0.01:1.5"},
       is_not_feasible},
      {"check_load_closure_way",
       {"check", "bars", "all", "--load", "push", "--waypoints", "back"},
       {"--waypoints", "ahead"},
       is_not_feasible},
      {"locate_load_closure",
       {"locate", "bars", "all", "--load", "push", "--resolution", "1/256"},
       {"--range", "theta=-0.01:1.5"},
       is_open_beyond_the_limit},
  };
}

std::vector<Kind> kinds() {
  const auto touch = [](const char* name, const char* words, IsTrue is_true) {
    return Kind{name, words_in(words), {"--range", "x=0:1"}, std::move(is_true)};
  };
  std::vector<Kind> all{
      touch("check", "check touch all", is_not_regular),
      touch("check_variables", "check touch all --tolerance base=0.001 --uncertainty variables",
            is_not_regular),
      touch("locate", "locate touch all --resolution 1/64", is_open_at_zero),
      touch("check_load", "check touch all --load push", is_not_feasible),
      touch("locate_load", "locate touch all --load push --resolution 1/64", is_open_at_zero),
      touch("margin", "margin touch all --range x=0:1.4 --tolerance base=0:1 --gap 0.3",
            is_proved_up_to("certified", 0.04)),
      touch("margin_quantity",
            "margin touch all --range x=0:1.4 --tolerance base=0:1 --gap 0.3 --quantity sigma-min "
            "--limit 0.01",
            is_proved_up_to("certified", 0.03)),
      touch("bound", "bound touch all sigma-min --gap 0.2 --range x=0:1.3",
            is_proved_up_to("proved", 0.31)),
      touch("condition", "bound touch all condition --norm 2 --gap 0.05 --range x=0:1.3",
            is_condition),
      touch("datasheet", "datasheet touch all --gap 0.3 --range x=0:1.3", is_datasheet),
  };
  std::ranges::move(kinds_of_linkages(), std::back_inserter(all));
  return all;
}

class ForgedCheckpoint : public testing::TestWithParam<Kind> {
 protected:
  ForgedCheckpoint() {
    std::ofstream(path("touch")) << kTouch;
    std::ofstream(path("bars")) << kBars;
    std::ofstream(path("way")) << "theta\n0\n2\n-2\n";
    std::ofstream(path("near")) << "theta\n0\n1\n-1\n";
    std::ofstream(path("back")) << "theta\n0\n1.5\n-1\n";
    std::ofstream(path("ahead")) << "theta\n0\n1.5\n1\n";
  }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }

  [[nodiscard]] CommandResult run(const std::vector<std::string>& more) const {
    std::vector<std::string> words{kCommand};
    for (const std::string& word : GetParam().words)
      words.push_back(std::filesystem::exists(path(word)) ? path(word) : word);
    for (const char* motion : {"--range", "--waypoints"})
      if (std::ranges::find(more, motion) != more.end())
        if (const auto given = std::ranges::find(words, motion); given != words.end())
          words.erase(given, given + 2);
    words.insert(words.end(), {"--threads", "1", "--engine", "interpreted", "--json"});
    if (is_paving()) words.insert(words.end(), {"--output", path("lines")});
    for (const std::string& word : more)
      words.push_back(word == "near" || word == "ahead" ? path(word) : word);
    return run_command(words);
  }
  [[nodiscard]] static bool is_paving() { return GetParam().words[0] == "locate"; }

  [[nodiscard]] Told told(const CommandResult& run) const {
    Told told{json::parse(run.output), {}};
    std::ifstream lines(path("lines"));
    for (std::string line; std::getline(lines, line);) {
      json read = json::parse(line);
      if (read.contains("kind") && read.contains("box")) told.boxes.push_back(std::move(read));
    }
    return told;
  }

  /// Returns the file of a run that is stopped after so many boxes; null if it leaves none.
  [[nodiscard]] json saved_after(std::uint64_t boxes, std::vector<std::string> more) const {
    std::filesystem::remove(path("saved"));
    more.insert(more.end(), {"--max-boxes", std::to_string(boxes), "--checkpoint", path("saved")});
    const CommandResult stopped = run(more);
    EXPECT_LE(stopped.exit_code, 2) << stopped.errors;
    const std::string text = file_contents(path("saved"));
    return text.empty() ? json() : json::parse(text);
  }
  /// Returns the file of a run that is stopped as late as can be.
  [[nodiscard]] json saved_late(const std::vector<std::string>& more) const {
    const std::uint64_t boxes = json::parse(run(more).output).at("boxes");
    for (std::uint64_t part = 15; part > 0; --part)
      if (json saved = saved_after(boxes * part / 16, more); saved.is_object()) return saved;
    return {};
  }

  /// Goes on from a file. Its answer is true, or the file is refused.
  void expect_true_answer(const json& saved, const std::string& what) const {
    std::ofstream(path("saved")) << saved.dump();
    const CommandResult continued = run({"--checkpoint", path("saved")});
    if (continued.exit_code == 65) {
      EXPECT_THAT(continued.errors, testing::HasSubstr("cannot continue from this file")) << what;
      return;
    }
    ASSERT_LE(continued.exit_code, 2) << what << continued.errors;
    EXPECT_TRUE(GetParam().is_true(told(continued))) << what << continued.output.substr(0, 3000);
  }

  TemporaryDirectory folder_;
};

TEST_P(ForgedCheckpoint, ProvesNothing) {
  const json late = saved_late({});
  ASSERT_TRUE(late.is_object()) << "the search is too short";
  const std::uint64_t boxes = json::parse(run({}).output).at("boxes");
  for (const json& saved : {saved_after(std::max<std::uint64_t>(boxes / 3, 4), {}), late}) {
    if (!saved.is_object()) continue;
    expect_true_answer(saved, "as it is");
    if (!has_tree(saved)) break;
    if (saved != late && trials(0, 1) == 0) continue;
    for (const std::string& claim : kClaims) {
      expect_true_answer(with_leaves_for_open(saved, claim), "open boxes claim " + claim);
      expect_true_answer(with_claims(saved, claim), "leaves claim " + claim);
    }
    expect_true_answer(without_open(saved), "an open box is missing");
    expect_true_answer(without_leaf(saved), "a leaf is missing");
    expect_true_answer(with_smaller_boxes(saved), "boxes are smaller");
  }
  for (const json& saved : {with_proved_values(late), with_failures(late, Reason::kWidth),
                            with_failures(late, Reason::kEmptyVariety)})
    expect_true_answer(saved, "searches of the bracket end otherwise");
}

/// A report counts the boxes that there are.
TEST_P(ForgedCheckpoint, DoesNotCountMoreBoxes) {
  const json late = saved_late({});
  ASSERT_TRUE(late.is_object()) << "the search is too short";
  std::ofstream(path("saved")) << with_more_boxes(late).dump();
  const CommandResult continued = run({"--checkpoint", path("saved")});
  if (continued.exit_code == 65) {
    EXPECT_THAT(continued.errors, testing::HasSubstr("another number of boxes than it has"));
    return;
  }
  const json report = json::parse(continued.output), genuine = json::parse(run({}).output);
  EXPECT_EQ(report.at("boxes"), genuine.at("boxes"));
}

/// The search of one question with the question of another, for which its claims are false.
TEST_P(ForgedCheckpoint, OfAnotherRangeProvesNothing) {
  json easy = saved_late(GetParam().easy);
  const json hard = saved_after(4, {});
  ASSERT_TRUE(easy.is_object() && hard.is_object()) << "the search is too short";
  expect_true_answer(easy, "the question of the file is another");
  easy["question"] = hard.at("question");
  expect_true_answer(easy, "the question of the file is forged");
  if (!has_tree(easy)) return;
  for (const std::string& claim : kClaims)
    expect_true_answer(with_leaves_for_open(easy, claim), "and open boxes claim " + claim);
}

std::string name_of(const testing::TestParamInfo<Kind>& kind) { return kind.param.name; }

INSTANTIATE_TEST_SUITE_P(Of, ForgedCheckpoint, testing::ValuesIn(every_second(kinds(), 0)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(NightlyOf, ForgedCheckpoint, testing::ValuesIn(every_second(kinds(), 1)),
                         name_of);

}  // namespace
}  // namespace regulus::detail::test::forged_checkpoint
