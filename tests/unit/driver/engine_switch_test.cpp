// SPDX-License-Identifier: GPL-3.0-or-later
// The interpreter until the compiler is done: what is called when, and that a search which goes
// over from one to the other says what it would have said.
#include "regulus/codegen/driver/engine_switch.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>

#include <chrono>
#include <functional>
#include <thread>

#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/codegen/driver/settings.hpp"
#include "regulus/interval/floating_point_scope.hpp"
#include "regulus/search/observers.hpp"
#include "regulus/search/solver.hpp"
#include "support/cached_command.hpp"

namespace regulus::codegen {
namespace {

using test::CachedCommand;

constexpr unsigned kRoundingBits = 0x6000;
constexpr unsigned kUpward = 0x4000;

/// What the last call was of, and how it was made.
struct Seen {
  int function = -1;
  const void* context = nullptr;
  unsigned rounding = 0;
};
Seen& seen() {
  static Seen s;
  return s;
}

template <int number>
unsigned note(const double*, const double*, double*, const void* context) {
  seen() = {number, context, read_mxcsr() & kRoundingBits};
  return 0;
}

/// A kernel whose functions say which they are: `base` and up.
template <int base>
struct NotedKernel {
  explicit NotedKernel(unsigned rounding) {
    expansion.row_of_variable = rows;
    expansion.nominal = nominal;
    expansion.product = note<base + 10>;
    expansion.first = {note<base + 11>, derivatives, 2};
    expansion.second = {note<base + 12>, derivatives, 2};
    expansion.row_first = {note<base + 13>, derivatives, 1};
    expansion.row_second = {note<base + 14>, derivatives, 1};
    kernel.abi = REGULUS_KERNEL_ABI;
    kernel.rounding = rounding;
    kernel.variables = 2;
    kernel.motion_variables = 1;
    kernel.rows = kernel.columns = 2;
    kernel.matrix = note<base>;
    kernel.matrix_derivatives = note<base + 1>;
    kernel.left_product = note<base + 2>;
    kernel.left_derivatives = note<base + 3>;
    kernel.right_product = note<base + 4>;
    kernel.row_scale = note<base + 5>;
    kernel.constraint = note<base + 6>;
    kernel.pose = note<base + 7>;
    kernel.determinant = note<base + 8>;
    kernel.determinant_derivatives = note<base + 9>;
    kernel.expansion = &expansion;
    kernel.context = this;
  }
  int rows[2] = {-1, 0};
  double nominal[4] = {0, 0, 1, 1};
  regulus_derivative derivatives[2] = {{0, 0, 0, REGULUS_FIRST_ORDER}, {0, 1, 1, 1}};
  regulus_expansion expansion{};
  regulus_kernel kernel{};
};

/// The functions in the order of their numbers.
std::vector<regulus_function> functions_in_order(const regulus_kernel& k) {
  const regulus_expansion& x = *k.expansion;
  return {k.matrix,
          k.matrix_derivatives,
          k.left_product,
          k.left_derivatives,
          k.right_product,
          k.row_scale,
          k.constraint,
          k.pose,
          k.determinant,
          k.determinant_derivatives,
          x.product,
          x.first.function,
          x.second.function,
          x.row_first.function,
          x.row_second.function};
}

void expect_calls_go_to(const regulus_kernel& through, const regulus_kernel& target, int base,
                        unsigned rounding) {
  int number = base;
  for (const regulus_function function : functions_in_order(through)) {
    function(nullptr, nullptr, nullptr, through.context);
    EXPECT_EQ(seen().function, number++);
    EXPECT_EQ(seen().context, target.context);
    EXPECT_EQ(seen().rounding, rounding);
    EXPECT_EQ(read_mxcsr() & kRoundingBits, 0U) << "the caller's rounding is put back";
  }
}

TEST(SwitchingKernel, CallsOneKernelAndThenTheOtherWithTheRoundingThatEachNeeds) {
  const NotedKernel<100> first(REGULUS_ROUND_NEAREST);
  const NotedKernel<200> next(REGULUS_ROUND_UPWARD);
  SwitchingKernel kernel(first.kernel);
  EXPECT_EQ(kernel.functions().rounding, unsigned{REGULUS_ROUND_NEAREST});
  expect_calls_go_to(kernel.functions(), first.kernel, 100, 0);
  ASSERT_TRUE(kernel.switch_to(next.kernel));
  expect_calls_go_to(kernel.functions(), next.kernel, 200, kUpward);
}

TEST(SwitchingKernel, HasNoFunctionThatTheFirstKernelHasNot) {
  NotedKernel<100> first(REGULUS_ROUND_NEAREST);
  first.kernel.right_product = nullptr;
  first.expansion.second.function = nullptr;
  const SwitchingKernel kernel(first.kernel);
  EXPECT_EQ(kernel.functions().right_product, nullptr);
  EXPECT_EQ(kernel.functions().expansion->second.function, nullptr);
  EXPECT_NE(kernel.functions().matrix, nullptr);
}

TEST(SwitchingKernel, StaysWithTheFirstKernelWhenTheOtherIsOfAnotherShape) {
  using Kernel = NotedKernel<200>;
  const std::function<void(Kernel&)> changes[] = {
      [](Kernel& k) { ++k.kernel.abi; },
      [](Kernel& k) { ++k.kernel.variables; },
      [](Kernel& k) { ++k.kernel.motion_variables; },
      [](Kernel& k) { ++k.kernel.rows; },
      [](Kernel& k) { --k.kernel.columns; },
      [](Kernel& k) { ++k.kernel.constraints; },
      [](Kernel& k) { ++k.kernel.pose_parameters; },
      [](Kernel& k) { k.kernel.left_derivatives = nullptr; },
      [](Kernel& k) { k.kernel.expansion = nullptr; },
      [](Kernel& k) { k.expansion.row_second.function = nullptr; },
      [](Kernel& k) { k.rows[1] = 1; },
      [](Kernel& k) { k.nominal[3] = 2; },
      [](Kernel& k) { k.expansion.nominal = nullptr; },
      [](Kernel& k) { k.expansion.ball_of_variable = k.rows; },
      [](Kernel& k) { k.expansion.first.count = 1; },
      [](Kernel& k) { k.derivatives[0].column = 1; },
      [](Kernel& k) { k.derivatives[1].second = 0; },
  };
  const NotedKernel<100> first(REGULUS_ROUND_NEAREST);
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    Kernel next(REGULUS_ROUND_UPWARD);
    changes[i](next);
    SwitchingKernel kernel(first.kernel);
    EXPECT_FALSE(kernel.switch_to(next.kernel)) << "change " << i;
    expect_calls_go_to(kernel.functions(), first.kernel, 100, 0);
  }
}

const std::string kPlanar = REGULUS_SOURCE_DIR "/models/planar_3rpr.toml";

Preparation prepared(const std::string& motion) {
  SearchOptions search;
  search.engine = Engine::kAuto;
  ModelOptions model;
  model.path = kPlanar;
  model.motion = motion;
  return prepare(model, search);
}

/// Lets the switch look until it has gone over.
bool wait_for(EngineSwitch& engine) {
  for (int i = 0; i < 6000 && !engine.switched() && engine.failure().empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    engine.on_progress({}, 0);
  }
  return engine.switched();
}

/// Waits for the compiler after some batches, so that a search certainly goes over in the middle.
class WaitsAfterBatches : public Observer {
 public:
  WaitsAfterBatches(EngineSwitch& engine, int batches) : engine_(engine), left_(batches) {}
  void on_progress(const Statistics&, std::uint64_t) noexcept override {
    if (left_-- == 0) {
      EXPECT_TRUE(wait_for(engine_));
    }
  }

 private:
  EngineSwitch& engine_;
  int left_;
};

Result paved(const Preparation& p, Observer& observer) {
  Settings settings = settings_from({});
  settings.exhaustive = true;
  settings.min_relative_width = 1.0 / 32;
  return solve(p.problem(), settings, &observer);
}

TEST(EngineSwitch, GoesOverInTheMiddleOfASearchThatFindsTheSame) {
  const CachedCommand cache;
  const Preparation p = prepared("crossing");
  ASSERT_NE(p.engine_switch, nullptr);
  WaitsAfterBatches waiting(*p.engine_switch, 5);
  Observers observers({p.engine_switch, &waiting});
  const Result mixed = paved(p, observers);
  EXPECT_TRUE(p.engine_switch->switched());

  SearchOptions search;
  search.engine = Engine::kInterpreted;
  ModelOptions model;
  model.path = kPlanar;
  model.motion = "crossing";
  const Preparation interpreted = prepare(model, search);
  Observer nobody;
  const Result plain = paved(interpreted, nobody);
  EXPECT_EQ(mixed.verdict, plain.verdict);
  EXPECT_EQ(mixed.reason, plain.reason);
  EXPECT_GT(mixed.statistics.boxes, 40U);
  EXPECT_NEAR(double(mixed.statistics.boxes), double(plain.statistics.boxes),
              0.05 * double(plain.statistics.boxes));
}

TEST(EngineSwitch, IsTheInterpreterWhenTheCompilerIsEnded) {
  const CachedCommand cache;
  const Preparation p = prepared("regular");
  ASSERT_NE(p.engine_switch, nullptr);
  p.engine_switch->abandon();
  const Result result = solve(p.problem(), settings_from({}), p.engine_switch);
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity);
  EXPECT_FALSE(p.engine_switch->switched());
  EXPECT_THAT(p.engine_switch->failure(), testing::HasSubstr("without an answer"));
}

/// Whether this process has started another that has not been waited for.
bool has_child() { return waitpid(-1, nullptr, WNOHANG) != -1; }

TEST(BackgroundCompilation, OutlivesItsSearchUnlessAnotherDoes) {
  const CachedCommand cache;
  (void)prepared("regular").engine_switch;
  EXPECT_TRUE(has_child());
  while (has_child()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(cache.problems().size(), 1U);

  const FileDescriptor another(open(default_cache_directory().c_str(), O_RDONLY | O_DIRECTORY));
  ASSERT_EQ(flock(another.get(), LOCK_EX | LOCK_NB), 0);
  (void)prepared("circle").engine_switch;
  EXPECT_FALSE(has_child());
  EXPECT_EQ(cache.problems().size(), 1U);
}

class AutoCommand : public testing::Test {
 protected:
  nlohmann::json report(const std::string& motion, const std::string& more = "") {
    std::vector<std::string> words = {"check", kPlanar, motion, "--engine", "auto"};
    if (!more.empty()) words.push_back(more);
    return command_.report(words);
  }
  CachedCommand command_;
};

TEST_F(AutoCommand, LeavesTheKernelToTheNextRun) {
  const nlohmann::json first = report("regular");
  EXPECT_EQ(first["engine"], "auto");
  EXPECT_EQ(first["cache"], "miss");
  for (int i = 0; i < 6000 && command_.problems().empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const nlohmann::json second = report("regular");
  EXPECT_EQ(second["cache"], "hit");
  EXPECT_EQ(second["engine_boxes"]["interpreted"], 0);
  EXPECT_EQ(second["engine_boxes"]["compiled"], second["boxes"]);
  EXPECT_EQ(first["verdict"], second["verdict"]);
  EXPECT_EQ(first["claim"], second["claim"]);
}

TEST_F(AutoCommand, WaitsForTheCompilerWhereThereIsNoCache) {
  const nlohmann::json only = report("regular", "--no-cache");
  EXPECT_EQ(only["cache"], "off");
  EXPECT_EQ(only["engine_boxes"]["compiled"], only["boxes"]);
  EXPECT_TRUE(command_.problems().empty());
}

TEST_F(AutoCommand, SaysHowManyBoxesEachEngineEvaluated) {
  const nlohmann::json one = report("crossing");
  EXPECT_EQ(
      one["engine_boxes"]["interpreted"].get<int>() + one["engine_boxes"]["compiled"].get<int>(),
      one["boxes"]);
  EXPECT_EQ(one["verdict"], "singularity");
}

}  // namespace
}  // namespace regulus::codegen
