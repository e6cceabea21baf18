// SPDX-License-Identifier: GPL-3.0-or-later
// A time limit and an interrupt work in every stage before the compiler and leave no trace.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/report.hpp"
#include "codegen/question/analysis/least_singular.hpp"
#include "codegen/question/engine/choices.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "runtime/search/solver.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::forming_stop {
namespace {

using testing::HasSubstr;

constexpr const char* kModel = R"(regulus = 1
name = "r"
source = "a test"
[pose]
x = "1"
y = "1"
[matrix]
rows = [["x", "y"], ["-y", "x"]]
[motion.box]
x = [0.3, 1.1]
y = [0.2, 1.3]
)";

class FormingStop : public testing::Test {
 protected:
  FormingStop() {
    options_.path = directory_.path() / "model.toml";
    std::ofstream(options_.path) << kModel;
    search_.engine = Engine::kInterpreted;
    search_.use_cache = false;
  }

  Result searched(const FormingWatch& watch, const std::atomic<bool>* interrupt = nullptr) {
    preparation_ = prepare(options_, search_, watch);
    Settings settings = settings_from(search_);
    settings.interrupt = interrupt;
    settings.time_limit = seconds_left(preparation_, settings.time_limit);
    return run_search(preparation_, search_, settings);
  }

  const test::TemporaryDirectory directory_;
  ModelOptions options_;
  SearchOptions search_;
  PreparedSearch preparation_;
};

TEST_F(FormingStop, AtTheTimeLimitProvesNothing) {
  for (const char* method : {"auto", "reg", "kj", "jk+rohn", "closed-form"}) {
    search_.method = choice_of<Method>("--method", method);
    search_.time_limit = 1e-9;
    const Result result = searched({});
    EXPECT_TRUE(preparation_.stopped) << method;
    EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
    EXPECT_EQ(result.reason, Reason::kTimeBudget) << method;
    EXPECT_STREQ(name(result.method), method);
    EXPECT_EQ(result.statistics.boxes, 0U);
    EXPECT_THAT(text_report(preparation_, search_, result),
                HasSubstr("the time limit was reached before the search"));
    EXPECT_TRUE(json_report(preparation_, search_, result)["forms"].is_null());
  }
}

TEST_F(FormingStop, ByAnInterruptProvesNothing) {
  const std::atomic<bool> interrupted = true;
  FormingWatch watch;
  watch.interrupt = &interrupted;
  const Result result = searched(watch, &interrupted);
  ASSERT_TRUE(preparation_.stopped);
  EXPECT_TRUE(preparation_.stopped->interrupted);
  EXPECT_EQ(result.reason, Reason::kInterrupted);
}

TEST_F(FormingStop, HappensInEachStage) {
  using enum WorkStage;
  for (const Engine engine : {Engine::kInterpreted, Engine::kJit})
    for (const WorkStage stage : {kSubstitution, kForming, kLowering, kSelection}) {
      search_.engine = engine;
      std::atomic<bool> interrupted = false;
      FormingWatch watch;
      watch.progress = [&](WorkStage at, std::uint64_t, std::uint64_t) {
        if (at != stage) return;
        interrupted = true;
        throw FormingStopped{true};
      };
      const Result result = searched(watch, &interrupted);
      EXPECT_TRUE(interrupted) << static_cast<int>(stage);
      ASSERT_TRUE(preparation_.stopped) << static_cast<int>(stage);
      EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
      EXPECT_EQ(result.reason, Reason::kInterrupted);
      EXPECT_EQ(result.statistics.boxes, 0U);
      EXPECT_FALSE(nearest_singular(preparation_, result));
      EXPECT_THAT(text_report(preparation_, search_, result),
                  HasSubstr("forms      none: interrupted before the search"));
    }
}

/// The cache is looked at between the reading of the model and the other stages.
TEST_F(FormingStop, ProvesNothingWithAnEmptyCache) {
  setenv("XDG_CACHE_HOME", (directory_.path() / "cache").c_str(), 1);
  search_.engine = Engine::kAuto;
  search_.use_cache = true;
  search_.time_limit = 1e-9;
  const Result result = searched({});
  unsetenv("XDG_CACHE_HOME");
  ASSERT_TRUE(preparation_.stopped);
  EXPECT_EQ(result.reason, Reason::kTimeBudget);
  EXPECT_GE(preparation_.seconds.symbolic, 0);
}

/// A search with the remaining kernel could prove nothing, even if one began.
TEST_F(FormingStop, LeavesAKernelThatIsUndefinedEverywhere) {
  search_.time_limit = 1e-9;
  static_cast<void>(searched({}));
  ASSERT_TRUE(preparation_.stopped);
  Settings settings;
  settings.max_boxes = 100;
  const Result result = solve(preparation_.problem(), settings);
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_GT(result.statistics.boxes, 0U);
}

TEST_F(FormingStop, DoesNotHappenOtherwise) {
  search_.time_limit = 1000;
  const Result result = searched({});
  EXPECT_FALSE(preparation_.stopped);
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity);
  EXPECT_EQ(json_report(preparation_, search_, result)["forms"], "full");
}

}  // namespace
}  // namespace regulus::detail::forming_stop
