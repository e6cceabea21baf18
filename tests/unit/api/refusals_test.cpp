// SPDX-License-Identifier: GPL-3.0-or-later
// What a question does not take is refused in C++ with the reason that the command gives.
#include "codegen/answer/refusals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include "codegen/use/api/regulus.hpp"

namespace refusals_test {
namespace {

using regulus::Question;
using regulus::SearchOptions;
using testing::HasSubstr;

Question bead() {
  return Question::of_text(R"toml(regulus = 1
name = "bead"
[pose]
x = "m"
[matrix]
twist = ["v_x"]
rows = [["x + 1"], ["x - 1"]]
[load.push]
force = [[-2, 2]]
[actuators]
force = [1, 9]
[motion.m]
x = [-0.5, 0.5]
)toml",
                           "bead");
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const regulus::UsageError& error) {
    return error.what();
  } catch (const regulus::InputError& error) {
    return error.what();
  }
  return "no error";
}

struct Change {
  const char* option;
  void (*make)(SearchOptions&);
};

class OptionOfALoad : public testing::TestWithParam<Change> {};

TEST_P(OptionOfALoad, IsRefusedInTheWordsOfTheTable) {
  SearchOptions search;
  GetParam().make(search);
  std::string expected;
  for (const regulus::detail::OptionRefusal& row : regulus::detail::option_refusals_of_loads())
    if (row.option == std::string_view(GetParam().option))
      expected = GetParam().option + std::string(": ") + std::string(row.why);
  EXPECT_EQ(message_of([&] { static_cast<void>(regulus::check_load(bead(), "push", search)); }),
            expected);
  const regulus::LocateLoadOptions paving{.search = search};
  EXPECT_EQ(message_of([&] { static_cast<void>(regulus::locate_load(bead(), paving)); }), expected);
}

INSTANTIATE_TEST_SUITE_P(
    EachOption, OptionOfALoad,
    testing::Values(
        Change{"method", [](SearchOptions& o) { o.method = regulus::Method::kReg; }},
        Change{"determinant",
               [](SearchOptions& o) { o.determinant = regulus::Determinant::kExpansion; }},
        Change{"entries", [](SearchOptions& o) { o.entries = regulus::Entries::kNatural; }},
        Change{"bisect", [](SearchOptions& o) { o.bisection = regulus::Bisection::kWidest; }},
        Change{"weight", [](SearchOptions& o) { o.weights = {"x=2"}; }},
        Change{"uncertainty",
               [](SearchOptions& o) { o.uncertainty = regulus::Uncertainty::kVariables; }},
        Change{"precision", [](SearchOptions& o) { o.precision = 64; }},
        Change{"symbolic-budget", [](SearchOptions& o) { o.symbolic_budget = 5; }},
        Change{"without", [](SearchOptions& o) { o.without = {"derivatives"}; }},
        Change{"filter", [](SearchOptions& o) { o.filters = {"filter.so"}; }}),
    [](const auto& of) {
      std::string name = of.param.option;
      std::erase(name, '-');
      return name;
    });

TEST(Refusals, OfALoadNameTheThreshold) {
  const auto threshold = [] {
    static_cast<void>(regulus::check_load(bead().alpha("0.1"), "push"));
  };
  EXPECT_EQ(message_of(threshold),
            "alpha: forces have no threshold; change the limits in [actuators]");
}

std::string crank_text() {
  return R"toml(regulus = 1
name = "crank"
[pose]
x = "m"
[closure]
unknowns = { phi = "rad" }
equations = ["x - 2*sin(phi)"]
start = { x = 0, phi = 0 }
[motion.m]
x = [-1, 1]
)toml";
}
Question crank() { return Question::of_text(crank_text(), "crank"); }

TEST(Refusals, OfAClosureAlongWayPointsSayWhatIsAsked) {
  const std::string file = testing::TempDir() + "crank_on_its_way.csv";
  std::ofstream(file) << "x\n0\n1\n";
  const Question along = crank().waypoints(file);
  EXPECT_EQ(regulus::check(along).verdict, regulus::Verdict::kNoSingularity);
  regulus::BoundOptions options;
  options.quantity.quantity = "determinant";
  EXPECT_TRUE(regulus::bound(along, options).closed);
  EXPECT_EQ(regulus::locate(along).verdict, regulus::Verdict::kNoSingularity);
}

TEST(Refusals, OfQuantitiesOfAClosureSayWhy) {
  const auto why = [](const char* quantity) {
    return message_of([quantity] {
      regulus::BoundOptions options;
      options.quantity.quantity = quantity;
      static_cast<void>(regulus::bound(crank(), options));
    });
  };
  EXPECT_THAT(why("x"), HasSubstr("the branch changes nothing"));
  EXPECT_THAT(why("x + phi"), HasSubstr("depends on the unknowns of [closure]"));
  EXPECT_THAT(why("error"), HasSubstr("the error of each motor"));
  EXPECT_THAT(why("speed"), HasSubstr("the largest speed of each motor"));
  EXPECT_THAT(why("force"), HasSubstr("the model has no [load.NAME]"));
  EXPECT_EQ(why("determinant"), "no error");
}

TEST(Refusals, OfALoadOnAClosureSayWhatTheModelLacks) {
  EXPECT_THAT(message_of([] { static_cast<void>(regulus::check_load(crank(), "")); }),
              HasSubstr("the model has no [load.NAME]"));
  const Question loaded = Question::of_text(crank_text() + "[load.L]\nwrench = [1]\n", "crank");
  EXPECT_THAT(message_of([&] { static_cast<void>(regulus::check_load(loaded, "")); }),
              HasSubstr("add [actuators] force = [LEAST, LARGEST]"));
  EXPECT_THAT(message_of([&] { static_cast<void>(regulus::locate_load(loaded)); }),
              HasSubstr("add [actuators] force = [LEAST, LARGEST]"));
}

/// The torque is f·dφ/dx = f/(2·cos φ) with sin φ = x/2, which passes 0.52 N for f = 1 at x = 0.549.
TEST(Refusals, OfALoadOnAClosureDoNotKeepItFromWayPoints) {
  const std::string file = testing::TempDir() + "loaded_crank.csv";
  std::ofstream(file) << "x\n0\n0.4\n1\n";
  const Question along =
      Question::of_text(crank_text() + "[actuators]\nforce = [-1, 0.52]\n[load.L]\nwrench = [1]\n",
                        "crank")
          .waypoints(file);
  regulus::LocateLoadOptions options;
  const regulus::LoadPaving paving = regulus::locate_load(along, options);
  EXPECT_EQ(paving.finding.verdict, regulus::FeasibilityVerdict::kInfeasible);
  ASSERT_EQ(paving.stretches.size(), 3U);
  const double at = (std::sqrt(4 - 1 / (0.52 * 0.52)) - 0.4) / 0.6;
  EXPECT_EQ(paving.stretches[0].claim, regulus::ForceClaim::kFeasible);
  EXPECT_EQ(paving.stretches[0].last_segment, 2U);
  EXPECT_EQ(paving.stretches[2].claim, regulus::ForceClaim::kInfeasible);
  EXPECT_LE(paving.stretches[0].end, at);
  EXPECT_GE(paving.stretches[2].begin, at);
  EXPECT_LE(paving.stretches[2].begin - paving.stretches[0].end, 1.0 / 32);
  EXPECT_THAT(paving.stretches[2].json, HasSubstr("\"kind\":\"infeasible\""));
  options.certificate = testing::TempDir() + "loaded_crank";
  const regulus::LoadPaving proved = regulus::locate_load(along, options);
  EXPECT_EQ(proved.finding.certificate, options.certificate);
  EXPECT_EQ(regulus::verify(options.certificate).outcome, regulus::ProofOutcome::kVerified);
}

TEST(Refusals, OfAClosureNameTheOption) {
  SearchOptions search;
  search.method = regulus::Method::kReg;
  EXPECT_THAT(message_of([&] { static_cast<void>(regulus::check(crank(), search)); }),
              testing::StartsWith("method: for a [closure]"));
}

TEST(Refusals, OfFiniteErrorsAreOfOtherModels) {
  regulus::BoundOptions options;
  options.quantity.quantity = "error";
  options.quantity.is_finite = true;
  EXPECT_THAT(message_of([&] { static_cast<void>(regulus::bound(bead(), options)); }),
              testing::StartsWith("finite errors are those of a [closure], or of a platform"));
}

TEST(Refusals, OfAClosureReachKernelsAndPreparedQuestions) {
  EXPECT_THAT(message_of([] { regulus::Kernel kernel(crank()); }), HasSubstr("[closure]"));
  EXPECT_THAT(message_of([] { regulus::PreparedQuestion prepared(crank()); }),
              HasSubstr("[closure]"));
}

TEST(Refusals, SpeakNoWordOfTheCommandLine) {
  for (const regulus::detail::Refusal& row : regulus::detail::refusals())
    EXPECT_THAT(std::string(row.why), testing::Not(HasSubstr("--"))) << name(row.service);
}

TEST(WhatWorks, IsThePageOfTheManual) {
  std::ostringstream page;
  page << std::ifstream(REGULUS_SOURCE_DIR "/codegen/answer/WHAT_WORKS.md").rdbuf();
  EXPECT_EQ(page.str(), regulus::detail::what_works())
      << "renew it: build/bin/regulus_write_manual --what-works >codegen/answer/WHAT_WORKS.md";
}

TEST(WhatWorks, GivesEachReasonOnceAndNoneTwiceForOneCell) {
  for (const regulus::detail::Refusal& row : regulus::detail::refusals())
    EXPECT_EQ(std::ranges::count_if(regulus::detail::refusals(),
                                    [&row](const regulus::detail::Refusal& other) {
                                      return other.kind == row.kind && other.service == row.service;
                                    }),
              1)
        << name(row.kind) << ", " << name(row.service);
}

}  // namespace
}  // namespace refusals_test
