// SPDX-License-Identifier: GPL-3.0-or-later
// What a question does not take is refused in C++ with the reason that the command gives.
#include "codegen/answer/refusals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>

#include "codegen/use/api/regulus.hpp"

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
  for (const regulus::OptionRefusal& row : regulus::option_refusals_of_loads())
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

TEST(Refusals, SpeakNoWordOfTheCommandLine) {
  for (const regulus::Refusal& row : regulus::refusals())
    EXPECT_THAT(std::string(row.why), testing::Not(HasSubstr("--"))) << name(row.service);
}

TEST(WhatWorks, IsThePageOfTheManual) {
  std::ostringstream page;
  page << std::ifstream(REGULUS_SOURCE_DIR "/codegen/answer/WHAT_WORKS.md").rdbuf();
  EXPECT_EQ(page.str(), regulus::what_works())
      << "renew it: build/bin/regulus_write_manual --what-works >codegen/answer/WHAT_WORKS.md";
}

TEST(WhatWorks, GivesEachReasonOnceAndNoneTwiceForOneCell) {
  for (const regulus::Refusal& row : regulus::refusals())
    EXPECT_EQ(std::ranges::count_if(regulus::refusals(),
                                    [&row](const regulus::Refusal& other) {
                                      return other.kind == row.kind && other.service == row.service;
                                    }),
              1)
        << name(row.kind) << ", " << name(row.service);
}

}  // namespace
