// SPDX-License-Identifier: GPL-3.0-or-later
// With any number of threads, a search tells its observer the same, to the last bit.
#include <gtest/gtest.h>

#include <atomic>
#include <cfenv>

#include "runtime/problem/observers.hpp"
#include "tests/support/function_kernel.hpp"
#include "tests/support/gough_kernel.hpp"
#include "tests/support/search_events.hpp"

namespace regulus::detail {
namespace {

using test::FunctionKernel;
using test::problem_over;
using test::Values;

/// Records the data of proofs and the progress of a search, too.
class EventLog : public test::SearchEvents {
 public:
  explicit EventLog(const Problem& problem) : kernel_(*problem.kernel) {}

  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override {
    for (unsigned p = 0; p < kernel_.rows * kernel_.columns; ++p)
      put(proof.preconditioner[p * REGULUS_LANES]);
    for (std::size_t i = 0; i < proof.order; ++i) put(proof.vector[i * REGULUS_LANES]);
    SearchEvents::on_leaf(box, rule, proof);
  }
  void on_progress(const Statistics& statistics, std::uint64_t frontier) noexcept override {
    text += std::to_string(statistics.boxes) + " boxes, " + std::to_string(frontier) + " open\n";
  }

 private:
  const regulus_kernel& kernel_;
};

struct Logged {
  Result result;
  std::string events;
};

Logged search_by(unsigned threads, const Problem& problem, Settings settings) {
  settings.threads = threads;
  EventLog log(problem);
  Logged logged;
  logged.result = solve(problem, settings, &log);
  logged.events = std::move(log.text);
  return logged;
}

/// `least`: a number of boxes that is enough for rounds of many batches.
void expect_the_same(const Problem& problem, const Settings& settings, std::uint64_t least,
                     Verdict verdict) {
  const Logged one = search_by(1, problem, settings);
  EXPECT_EQ(one.result.verdict, verdict) << describe(one.result.reason);
  EXPECT_GE(one.result.statistics.boxes, least);
  for (const unsigned threads : {2U, 3U, 8U})
    EXPECT_TRUE(search_by(threads, problem, settings).events == one.events) << threads;
}

/// Makes A = [[x, y], [−y, x]] − r·[[1, 0], [0, 1]]: singular only at x = r and y = 0.
FunctionKernel point_of_singularity(double r) {
  return {2, 2, 2, [r](const Values& x) {
            return Values{x[0] - Interval(r), x[1], -x[1], x[0] - Interval(r)};
          }};
}

/// Makes det A = x² + y² − 1.
TEST(Threads, LeaveAProofOfManyBoxesAsItIs) {
  const FunctionKernel kernel = point_of_singularity(1.0);
  expect_the_same(problem_over(kernel, {{0x1p-30, 0.999999}, {-1, 1}}), {}, 100,
                  Verdict::kNoSingularity);
  const test::GoughKernel gough(test::kRobot2);
  const test::Angle angle = test::plus_minus_degrees(38);
  Problem problem;
  problem.kernel = gough.get();
  problem.outer = {{-200, 200}, {-200, 200}, {2800, 3200}, angle.outer, angle.outer, angle.outer};
  problem.inner = {Interval{-200, 200}, Interval{-200, 200}, Interval{2800, 3200},
                   angle.inner,         angle.inner,         angle.inner};
  Settings settings;
  settings.max_boxes = 2000;
  const Logged one = search_by(1, problem, settings);
  EXPECT_TRUE(search_by(4, problem, settings).events == one.events);
}

TEST(Threads, LeaveAWitnessAsItIs) {
  const FunctionKernel kernel = test::singular_circle();
  Settings settings;
  settings.ingredients.descents = settings.ingredients.corners = false;
  expect_the_same(problem_over(kernel, {{0.125, 0.70710678}, {0, 0.70710679}}), settings, 100,
                  Verdict::kSingularity);
}

TEST(Threads, LeaveWhatBlocksAsItIs) {
  const FunctionKernel kernel = point_of_singularity(0.3);
  expect_the_same(problem_over(kernel, {{-1, 1}, {-1, 1}}), {}, 200, Verdict::kPossibleProblem);
}

TEST(Threads, LeaveAPavingAsItIs) {
  const FunctionKernel kernel = test::singular_circle();
  Settings settings;
  settings.exhaustive = settings.enclose_determinants = true;
  settings.min_relative_width = 0x1p-6;
  expect_the_same(problem_over(kernel, {{-2, 2}, {-2, 2}}), settings, 500, Verdict::kSingularity);
}

TEST(Threads, LeaveASearchWithinConstraintsAsItIs) {
  FunctionKernel kernel = test::singular_circle();
  kernel.with_constraints(1, [](const Values& x) { return Values{sqr(x[0]) + sqr(x[1]) - 0.9}; });
  expect_the_same(problem_over(kernel, {{-2, 2}, {-2, 2}}), {}, 200, Verdict::kNoSingularity);
}

TEST(Threads, AreStoppedByABudget) {
  const FunctionKernel kernel = point_of_singularity(0.3);
  Settings settings;
  settings.max_boxes = 317;
  expect_the_same(problem_over(kernel, {{-1, 1}, {-1, 1}}), settings, 250,
                  Verdict::kPossibleProblem);
}

/// Interrupts the search after so many evaluations: in the middle of a batch and of a round.
class Interrupted : public test::FixtureKernel {
 public:
  explicit Interrupted(std::uint64_t after) : FixtureKernel(2, 2, 2, 2), left_(after) {}
  Values matrix(const Values& x) const override {
    if (left_.fetch_sub(1) == 1) interrupt.store(true);
    // The matrix is singular at one point; boxes near it become narrow.
    return {x[0] - Interval(0.3), x[1], -x[1], x[0] - Interval(0.3)};
  }
  mutable std::atomic<bool> interrupt{false};

 private:
  mutable std::atomic<std::uint64_t> left_;
};

/// Sums the area of leaves and open boxes.
class Cover : public Observer {
 public:
  void on_leaf(const OpenBox& box, Rule, const Proof&) noexcept override { add(box); }
  void on_open(const OpenBox& box) noexcept override { add(box); }
  double area = 0;

 private:
  void add(const OpenBox& box) noexcept {
    area += (box.box[0].hi - box.box[0].lo) * (box.box[1].hi - box.box[1].lo);
  }
};

TEST(Threads, AnInterruptLosesNoBox) {
  for (const unsigned threads : {1U, 2U, 4U}) {
    std::uint64_t interrupted = 0;
    for (std::uint64_t after = 1; after < 5000; after += 97) {
      const Interrupted kernel(after);
      Settings settings;
      settings.interrupt = &kernel.interrupt;
      settings.threads = threads;
      settings.ingredients.descents = settings.ingredients.corners = false;
      Cover cover;
      const Result result = solve(problem_over(kernel, {{-1, 1}, {-1, 1}}), settings, &cover);
      if (result.stopped_by != Reason::kInterrupted) continue;
      ++interrupted;
      EXPECT_NEAR(cover.area, 4.0, 1e-12) << threads << " threads, after " << after;
    }
    EXPECT_GT(interrupted, 40U);
  }
}

/// Offers another kernel to a search after so many boxes.
class OffersKernel : public Observer {
 public:
  OffersKernel(const regulus_kernel* kernel, std::uint64_t after)
      : kernel_(kernel), after_(after) {}
  void on_progress(const Statistics& statistics, std::uint64_t) noexcept override {
    if (statistics.boxes >= after_) offered.store(kernel_, std::memory_order_release);
  }
  std::atomic<const regulus_kernel*> offered = nullptr;

 private:
  const regulus_kernel* kernel_;
  const std::uint64_t after_;
};

/// Counts its evaluations.
class Counted : public test::FixtureKernel {
 public:
  Counted() : FixtureKernel(2, 2, 2, 2) {}
  Values matrix(const Values& x) const override {
    calls.fetch_add(1, std::memory_order_relaxed);
    return {x[0] - Interval(1.0), x[1], -x[1], x[0] - Interval(1.0)};
  }
  mutable std::atomic<std::uint64_t> calls = 0;
};

TEST(Threads, GoOverToAFasterKernelInTheMiddleOfASearch) {
  for (const unsigned threads : {1U, 2U, 8U}) {
    const Counted first, second;
    Problem problem = problem_over(first, {{0x1p-30, 0.999999}, {-1, 1}});
    Settings settings;
    const Logged plain = search_by(1, problem, settings);
    const std::uint64_t all = first.calls.exchange(0);
    OffersKernel offering(second.get(), plain.result.statistics.boxes / 2);
    problem.faster_kernel = &offering.offered;
    settings.threads = threads;
    EventLog log(problem);
    Observers observers({&offering, &log});
    const Result result = solve(problem, settings, &observers);
    EXPECT_TRUE(log.text == plain.events) << threads;
    EXPECT_EQ(result.statistics.boxes, plain.result.statistics.boxes);
    EXPECT_GT(first.calls, 0U);
    EXPECT_GT(second.calls, 0U);
    EXPECT_EQ(first.calls + second.calls, all);
  }
}

TEST(Threads, KeepTheCallersRoundingMode) {
  const FunctionKernel kernel = point_of_singularity(1.0);
  const Problem problem = problem_over(kernel, {{0x1p-30, 0.999999}, {-1, 1}});
  const std::string expected = search_by(1, problem, {}).events;
  std::fesetround(FE_DOWNWARD);
  const std::string events = search_by(4, problem, {}).events;
  EXPECT_EQ(std::fegetround(), FE_DOWNWARD);
  std::fesetround(FE_TONEAREST);
  EXPECT_TRUE(events == expected);
}

TEST(Threads, NoneOrTooManyAreAFault) {
  const FunctionKernel kernel = test::singular_circle();
  const Problem problem = problem_over(kernel, {{2, 3}, {2, 3}});
  Settings settings;
  for (const unsigned threads : {0U, kMaxThreads + 1}) {
    settings.threads = threads;
    EXPECT_EQ(solve(problem, settings).reason, Reason::kBadProblem);
  }
}

}  // namespace
}  // namespace regulus::detail
