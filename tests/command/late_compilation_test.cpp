// SPDX-License-Identifier: GPL-3.0-or-later
// `--engine auto`: a search that switches from the interpreter to the compiled kernel gives the
// same answer, and the report does not depend on the moment of the switch.
#include "codegen/question/engine/late_compilation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "codegen/answer/certificate/certificate_file.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "runtime/problem/observers.hpp"
#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using testing::Not;

struct LongQuestion {
  std::string model, motion;
  std::vector<std::string> tolerances;
  Method method = Method::kAuto;
};

const LongQuestion kFree{kModels + "robot_1.toml", "table6_15_15", {"base,platform=0.1"}};
const LongQuestion kSingular{kModels + "robot_1.toml", "wide_40", {}};
const LongQuestion kPlanarFree{kModels + "planar_3rpr.toml", "regular", {}};

SearchOptions options(Engine engine, unsigned threads = 1, std::uint64_t boxes = 64) {
  SearchOptions search;
  search.engine = engine;
  search.threads = threads;
  search.boxes_before_compiling = boxes;
  return search;
}

PreparedSearch prepared(const LongQuestion& question, const SearchOptions& search) {
  ModelOptions model;
  model.path = question.model;
  model.motion = question.motion;
  model.tolerances = question.tolerances;
  return prepare(model, search);
}

/// Blocks a search until the compiler that it has started has finished.
class WaitsForCompiler : public Observer {
 public:
  explicit WaitsForCompiler(LateCompilation* late) : late_(late) {}
  void on_progress(const Statistics&, std::uint64_t) noexcept override {
    const std::atomic<bool> never = false;
    if (late_ == nullptr) return;
    EXPECT_TRUE(late_->wait(never));
  }

 private:
  LateCompilation* late_;
};

/// The results of a run.
struct Outcome {
  Result result;
  std::string report, certificate;
  nlohmann::json json;
};

/// `waits`: the compiled kernel takes over in the round after the request for it.
Outcome run(const LongQuestion& question, const SearchOptions& search, bool waits = false) {
  const TemporaryDirectory directory;
  const std::string file = directory.path() / "certificate";
  PreparedSearch preparation = prepared(question, search);
  Outcome outcome;
  {
    CertificateFile certificate(file, preparation);
    WaitsForCompiler waiting(waits ? preparation.late.get() : nullptr);
    Observers observers({certificate.observer(), &waiting});
    outcome.result = run_search(preparation, search, settings_from(search), &observers);
    certificate.finish(outcome.result);
  }
  outcome.report = timeless(text_report(preparation, search, outcome.result, std::nullopt));
  outcome.json =
      timeless(nlohmann::json(json_report(preparation, search, outcome.result, std::nullopt)));
  outcome.certificate = file_contents(file);
  return outcome;
}

/// Compares everything except how the functions ran.
void expect_same_finding(const Outcome& found, const Outcome& expected) {
  EXPECT_EQ(found.certificate, expected.certificate);
  EXPECT_FALSE(found.certificate.empty());
  nlohmann::json a = found.json, b = expected.json;
  for (nlohmann::json* report : {&a, &b})
    for (const char* key : {"engine", "engine_boxes", "threads", "options"}) report->erase(key);
  EXPECT_EQ(a, b);
}

TEST(LateCompilation, GoesOverInTheMiddleOfASearchThatFindsTheSame) {
  for (const LongQuestion& question : {kFree, kSingular}) {
    const CachedCommand cache;
    const Outcome interpreted = run(question, options(Engine::kInterpreted));
    const Outcome compiled = run(question, options(Engine::kJit));
    expect_same_finding(compiled, interpreted);
    for (const unsigned threads : {1U, 2U, 8U}) {
      SearchOptions search = options(Engine::kAuto, threads, 1);
      search.use_cache = false;
      expect_same_finding(run(question, search, true), interpreted);
    }
  }
}

TEST(LateCompilation, TakesOverWhileBoxesAreLeft) {
  const CachedCommand cache;
  const SearchOptions search = options(Engine::kAuto, 2);
  PreparedSearch p = prepared(kFree, search);
  ASSERT_TRUE(p.late);
  EXPECT_EQ(p.late->kernel().load(), nullptr);
  WaitsForCompiler waiting(p.late.get());
  const Result result = run_search(p, search, settings_from(search), &waiting);
  EXPECT_GT(result.statistics.boxes, 2 * search.boxes_before_compiling);
  EXPECT_FALSE(p.late->is_compiling());
  EXPECT_EQ(p.late->failure(), "");
  ASSERT_NE(p.late->kernel().load(), nullptr);
  EXPECT_NE(p.late->kernel().load()->matrix, p.kernel->functions().matrix);
  EXPECT_STREQ(p.late->kernel().load()->identity, p.kernel->functions().identity);
}

TEST(LateCompilation, ReportsTheSameWheneverTheCompilerIsDone) {
  std::vector<Outcome> outcomes;
  for (const bool waits : {false, true, true}) {
    const CachedCommand cache;
    outcomes.push_back(run(kFree, options(Engine::kAuto), waits));
  }
  EXPECT_THAT(outcomes[0].report, HasSubstr("interpreted, and compiled meanwhile from 64 boxes"));
  EXPECT_EQ(outcomes[0].json["engine_boxes"]["interpreted"], 64);
  for (const Outcome& outcome : outcomes) {
    EXPECT_EQ(outcome.report, outcomes[0].report);
    EXPECT_EQ(outcome.json, outcomes[0].json);
    EXPECT_EQ(outcome.certificate, outcomes[0].certificate);
  }
}

TEST(LateCompilation, DoesNotBeginForAShortSearch) {
  const CachedCommand cache;
  const Outcome outcome = run(kPlanarFree, options(Engine::kAuto, 1, kBoxesBeforeCompiling));
  EXPECT_THAT(outcome.report, HasSubstr("interpreted (the search ended before 50 000 boxes)"));
  EXPECT_EQ(outcome.json["engine_boxes"]["interpreted"], outcome.json["boxes"]);
  EXPECT_EQ(outcome.json["engine_boxes"]["compiled"], 0);
  EXPECT_EQ(cache.problems().size(), 1U);
  EXPECT_TRUE(cache.objects().empty()) << "nothing was compiled";
}

TEST(LateCompilation, LeavesTheKernelToTheNextRun) {
  const CachedCommand cache;
  const Outcome first = run(kFree, options(Engine::kAuto));
  const Outcome second = run(kFree, options(Engine::kAuto));
  EXPECT_THAT(second.report, HasSubstr("compiled for"));
  EXPECT_EQ(second.json["engine_boxes"]["compiled"], second.json["boxes"]);
  expect_same_finding(second, first);
}

TEST(LateCompilation, StartsFromTheCacheWithoutAnObject) {
  const CachedCommand cache;
  const Outcome first = run(kFree, options(Engine::kAuto));
  for (const auto& file : cache.objects()) std::filesystem::remove(file);
  const PreparedSearch p = prepared(kFree, options(Engine::kAuto));
  ASSERT_TRUE(p.late);
  EXPECT_EQ(p.seconds_spent().program, 0) << "its forms are in the cache";
  const Outcome second = run(kFree, options(Engine::kAuto));
  EXPECT_EQ(second.report, first.report);
  EXPECT_EQ(second.certificate, first.certificate);
  EXPECT_FALSE(cache.objects().empty()) << "a long search compiles it anew";
}

/// Runs a compilation that fails.
struct Failing {
  explicit Failing(SharedProgram program) : late(std::move(program), 64, uncached()) {}
  static CompileOptions uncached() {
    CompileOptions options;
    options.use_cache = false;
    return options;
  }
  void reach(std::uint64_t boxes) {
    Statistics statistics;
    statistics.boxes = boxes;
    late.on_progress(statistics, 1);
  }
  LateCompilation late;
};

TEST(LateCompilation, ThatFailsLeavesTheInterpreter) {
  const std::atomic<bool> never = false;
  Failing broken(std::make_shared<const machine::PackKernel>());
  broken.reach(63);
  EXPECT_FALSE(broken.late.is_compiling());
  broken.reach(64);
  EXPECT_TRUE(broken.late.wait(never));
  EXPECT_NE(broken.late.failure(), "");
  EXPECT_EQ(broken.late.kernel().load(), nullptr);
  broken.reach(1000);
  EXPECT_FALSE(broken.late.is_compiling()) << "it is asked once";
}

TEST(LateCompilation, IsNotWaitedForOnceThatIsGivenUp) {
  const CachedCommand cache;
  PreparedSearch p = prepared(kFree, options(Engine::kAuto));
  ASSERT_TRUE(p.late);
  const std::atomic<bool> given_up = true;
  Statistics statistics;
  statistics.boxes = 64;
  p.late->on_progress(statistics, 1);
  EXPECT_EQ(p.late->wait(given_up), !p.late->is_compiling());
}

TEST(EngineAuto, CompilesBeforeTheSearchWhereTheProcessIsKept) {
  const CachedCommand cache;
  const PreparedSearch p = prepared(kPlanarFree, options(Engine::kAuto, 1, 0));
  EXPECT_FALSE(p.late);
  EXPECT_EQ(p.cache, "miss");
  EXPECT_FALSE(cache.objects().empty());
}

/// A search of more than 50 000 boxes in a second.
const std::vector<std::string> kLong = {"check", kModels + "hexapod_6rus.toml",
                                        "work",  "--method",
                                        "reg",   "--max-boxes",
                                        "60000", "--engine",
                                        "auto"};

TEST(TheCommand, LeavesTheKernelInTheCacheAfterALongSearch) {
  const CachedCommand cache;
  const CommandResult first = cache.run(kLong);
  EXPECT_THAT(first.errors, HasSubstr("compiled meanwhile from 50 000 boxes on"));
  EXPECT_FALSE(cache.objects().empty());
  const CommandResult second = cache.run(kLong);
  EXPECT_THAT(second.errors, HasSubstr("cache hit"));
  EXPECT_EQ(second.output, first.output);
  EXPECT_EQ(second.exit_code, first.exit_code);
}

TEST(TheCommand, EndsWithItsReportWhereNothingIsKept) {
  const CachedCommand cache;
  std::vector<std::string> words = kLong;
  words.emplace_back("--no-cache");
  const CommandResult result = cache.run(words);
  EXPECT_THAT(result.errors, HasSubstr("compiled meanwhile from 50 000 boxes on"));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(cache.objects().empty());
}

}  // namespace
}  // namespace regulus::detail::test
