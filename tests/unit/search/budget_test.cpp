// SPDX-License-Identifier: GPL-3.0-or-later
// Tests budgets, events, faults, and the floating-point environment.
#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <array>
#include <atomic>
#include <map>
#include <thread>

#include "tests/support/function_kernel.hpp"

namespace regulus::detail {
namespace {

using test::FunctionKernel;
using test::problem_over;
using test::Values;

/// Is regular everywhere, but intervals need some hundred boxes to show it.
class Laborious : public FunctionKernel {
 public:
  Laborious()
      : FunctionKernel(2, 1, 1, [](const Values& x) {
          return Values{x[0] * x[0] - x[0] * x[0] + x[1] * x[0] - x[0] * x[1] + 0.125};
        }) {}
};
const std::vector<Interval> kUnitSquare{{0, 1}, {0, 1}};

TEST(Budget, TheLaboriousMatrixIsRegular) {
  const Laborious kernel;
  const Result result = solve(problem_over(kernel, kUnitSquare), {});
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity);
  EXPECT_GT(result.statistics.boxes, 100U);
}

/// The search stops before a round that would exceed the limit. A round has at most an eighth of
/// the boxes before it, plus eight.
TEST(Budget, StopsAtTheNumberOfBoxes) {
  const Laborious kernel;
  for (const std::uint64_t limit : {0U, 1U, 5U, 20U, 100U}) {
    Settings settings;
    settings.max_boxes = limit;
    const Result result = solve(problem_over(kernel, kUnitSquare), settings);
    EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
    EXPECT_EQ(result.reason, Reason::kBoxBudget);
    EXPECT_LE(result.statistics.boxes, limit);
    EXPECT_GE(result.statistics.boxes + limit / 8 + 8, limit);
    EXPECT_EQ(result.blocking_box.size(), 2U);
  }
}

TEST(Budget, IsMetToTheBoxInTheOrderOfThePaper) {
  const Laborious kernel;
  for (const std::uint64_t limit : {0U, 1U, 5U, 20U, 101U}) {
    Settings settings;
    settings.batch = 1;
    settings.max_boxes = limit;
    EXPECT_EQ(solve(problem_over(kernel, kUnitSquare), settings).statistics.boxes, limit);
  }
}

/// The matrix is regular everywhere, but only 2^48 boxes, as small as 2^-24 each way, show it.
TEST(Budget, StopsWhereTheSearchMakesNoHeadway) {
  const FunctionKernel kernel(2, 1, 1, [](const Values& x) {
    const double spread = (x[0].hi - x[0].lo + x[1].hi - x[1].lo) * 0x1p23;
    return Values{Interval(1 - spread, 1 + spread)};
  });
  const Result result = solve(problem_over(kernel, kUnitSquare), {});
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(result.reason, Reason::kStalled);
  EXPECT_LE(result.statistics.boxes, 1'200'000U);
}

TEST(Budget, StopsAtTheTimeLimit) {
  const Laborious kernel;
  Settings settings;
  settings.time_limit = 0;
  const Result result = solve(problem_over(kernel, kUnitSquare), settings);
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(result.reason, Reason::kTimeBudget);
}

TEST(Budget, StopsWhenInterrupted) {
  const Laborious kernel;
  const std::atomic<bool> interrupt{true};
  Settings settings;
  settings.interrupt = &interrupt;
  const Result result = solve(problem_over(kernel, kUnitSquare), settings);
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(result.reason, Reason::kInterrupted);
}

/// Returns a state that has only the number of the next box.
SearchState from_box(BoxId next_id) {
  SearchState state;
  state.next_id = next_id;
  return state;
}

/// Follows the events of a search and checks that they describe a tree of halves.
class Recorder : public Observer {
 public:
  void on_start(const Problem& problem, const Settings&) noexcept override {
    open[0] = problem.outer;
  }
  void on_split(const OpenBox& box, const Split& split) noexcept override {
    ASSERT_TRUE(open.count(box.id));
    std::vector<Interval> lower = open[box.id], upper = lower;
    EXPECT_TRUE(std::equal(lower.begin(), lower.end(), box.box.begin()));
    lower[split.variable].hi = split.at;
    upper[split.variable].lo = split.at;
    open.erase(box.id);
    EXPECT_TRUE(open.emplace(split.lower, lower).second);
    EXPECT_TRUE(open.emplace(split.lower + 1, upper).second);
    next_id = split.lower + 2;
  }
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override {
    ASSERT_TRUE(open.count(box.id));
    EXPECT_TRUE(std::equal(box.box.begin(), box.box.end(), open[box.id].begin()));
    if (rule == Rule::kHMatrix) {
      ASSERT_NE(proof.vector, nullptr);
      EXPECT_GT(proof.vector[0], 0.0);
      EXPECT_NE(proof.preconditioner[0], 0.0);
    }
    open.erase(box.id);
    ++leaves;
  }
  void on_progress(const Statistics& statistics, std::uint64_t frontier) noexcept override {
    boxes = statistics.boxes;
    EXPECT_EQ(frontier, open.size());
  }
  void on_finish(const Result& result) noexcept override { finished = result.verdict; }

  std::map<BoxId, std::vector<Interval>> open;
  BoxId next_id = 1;
  std::uint64_t leaves = 0, boxes = 0;
  std::optional<Verdict> finished;
};

TEST(Observer, SeesATreeWhoseLeavesCoverTheVariety) {
  const Laborious kernel;
  Recorder recorder;
  const Result result = solve(problem_over(kernel, kUnitSquare), {}, &recorder);
  EXPECT_TRUE(recorder.open.empty());
  EXPECT_EQ(recorder.leaves, result.statistics.leaves[static_cast<std::size_t>(Rule::kHMatrix)]);
  EXPECT_EQ(2 * recorder.leaves - 1, result.statistics.boxes);
  EXPECT_EQ(recorder.boxes, result.statistics.boxes);
  EXPECT_EQ(recorder.finished, Verdict::kNoSingularity);
}

TEST(Observer, AnInterruptedSearchCanBeResumedFromItsOpenBoxes) {
  const Laborious kernel;
  const Problem problem = problem_over(kernel, kUnitSquare);
  const std::uint64_t whole = solve(problem, {}).statistics.boxes;
  Recorder recorder;
  Settings settings;
  settings.max_boxes = 40;
  const Result stopped = solve(problem, settings, &recorder);
  ASSERT_EQ(stopped.verdict, Verdict::kPossibleProblem);
  ASSERT_FALSE(recorder.open.empty());
  const auto kept = recorder.open;
  std::vector<OpenBox> open;
  for (const auto& [id, box] : kept) open.push_back({id, 1, box});
  const Result rest = resume(problem, {}, open, from_box(recorder.next_id));
  EXPECT_EQ(rest.verdict, Verdict::kNoSingularity);
  EXPECT_EQ(rest.statistics.boxes + stopped.statistics.boxes, whole);
}

TEST(Observer, BoxesOfAnotherUncertaintyAreRefused) {
  FunctionKernel kernel(2, 1, 1, [](const Values& x) { return Values{x[0] + x[1] + 3.0}; });
  kernel.with_uncertain(1);
  const Problem problem = problem_over(kernel, {Interval(-1, 1), Interval(-1, 1)});
  const std::vector<Interval> whole{Interval(0, 1), Interval(-1, 1)};
  const std::vector<Interval> part{Interval(0, 1), Interval(0, 1)};
  const OpenBox of_it{1, 1, whole}, of_another{1, 1, part};
  EXPECT_EQ(resume(problem, {}, {&of_it, 1}, from_box(2)).verdict, Verdict::kNoSingularity);
  EXPECT_EQ(resume(problem, {}, {&of_another, 1}, from_box(2)).reason, Reason::kBadProblem);
  Settings settings;
  settings.uncertainty = Uncertainty::kVariables;
  EXPECT_EQ(resume(problem, settings, {&of_another, 1}, from_box(2)).verdict,
            Verdict::kNoSingularity);
}

TEST(Observer, AnExhaustiveSearchVisitsEverything) {
  const FunctionKernel kernel(1, 1, 1, [](const Values& x) { return Values{x[0] - 0.3}; });
  Settings settings;
  settings.exhaustive = true;
  settings.min_relative_width = 0x1p-6;
  Recorder recorder;
  const Result result = solve(problem_over(kernel, {{-1, 1}}), settings, &recorder);
  EXPECT_TRUE(recorder.open.empty());
  EXPECT_EQ(result.verdict, Verdict::kSingularity);
  EXPECT_EQ(result.statistics.leaves[static_cast<std::size_t>(Rule::kWitness)], 1U);
  EXPECT_GE(result.statistics.leaves[static_cast<std::size_t>(Rule::kHMatrix)], 4U);
}

TEST(Environment, IsKeptAndDoesNotMatter) {
  const Laborious kernel;
  const Problem problem = problem_over(kernel, kUnitSquare);
  const Result reference = solve(problem, {});
  const unsigned saved = _mm_getcsr();
  for (const unsigned mode : {0x3F80U, 0x5F80U, 0x7F80U, 0x9FC0U}) {
    _mm_setcsr(mode);
    const Result result = solve(problem, {});
    const unsigned after = _mm_getcsr();
    _mm_setcsr(saved);
    EXPECT_EQ(after & ~0x3FU, mode);
    EXPECT_EQ(result.verdict, reference.verdict);
    EXPECT_EQ(result.statistics.boxes, reference.statistics.boxes);
  }
}

TEST(Environment, IsToNearestInsideTheSearch) {
  class Watch : public Observer {
   public:
    void on_progress(const Statistics&, std::uint64_t) noexcept override {
      seen = _mm_getcsr() & ~0x3FU;
    }
    unsigned seen = 0;
  };
  const Laborious kernel;
  Watch watch;
  const unsigned saved = _mm_getcsr();
  _mm_setcsr(0xDFC0U);  // upward, flush to zero, denormals are zero
  static_cast<void>(solve(problem_over(kernel, kUnitSquare), {}, &watch));
  _mm_setcsr(saved);
  EXPECT_EQ(watch.seen, 0x1F80U);
}

TEST(Environment, SearchesRunSideBySide) {
  const Laborious kernel;
  const Problem problem = problem_over(kernel, kUnitSquare);
  const std::uint64_t boxes = solve(problem, {}).statistics.boxes;
  std::array<std::uint64_t, 4> found{};
  std::vector<std::thread> threads;
  for (std::uint64_t& count : found)
    threads.emplace_back([&] { count = solve(problem, {}).statistics.boxes; });
  for (std::thread& thread : threads) thread.join();
  for (const std::uint64_t count : found) EXPECT_EQ(count, boxes);
}

void expect_fault(const Problem& problem, const Settings& settings, const std::string& words) {
  const std::optional<std::string> fault = find_fault(problem, settings);
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->find(words), std::string::npos) << *fault;
  const Result result = solve(problem, settings);
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_EQ(result.reason, Reason::kBadProblem);
}

TEST(Faults, AreNamedAndNeverSearched) {
  const Laborious kernel;
  const Problem good = problem_over(kernel, kUnitSquare);
  EXPECT_EQ(find_fault(good, {}), std::nullopt);
  Problem bad = good;
  bad.kernel = nullptr;
  expect_fault(bad, {}, "no kernel");
  bad = good;
  bad.outer.pop_back();
  expect_fault(bad, {}, "2 variables");
  bad = good;
  bad.outer[1] = {0, 0x1p65};
  expect_fault(bad, {}, "2^64");
  bad = good;
  bad.inner[0] = Interval(-1, 1);
  expect_fault(bad, {}, "inner range");
  bad = good;
  bad.alpha = Interval(-1, 1);
  expect_fault(bad, {}, "threshold");
  Settings settings;
  settings.batch = 9;
  expect_fault(good, settings, "batch");
  settings = {};
  settings.min_relative_width = -1;
  expect_fault(good, settings, "width");
}

TEST(Faults, TallMatricesHaveNoDeterminant) {
  const FunctionKernel kernel(1, 2, 1, [](const Values& x) { return Values{x[0], 1.0}; });
  Problem problem = problem_over(kernel, {{-1, 1}});
  Settings settings;
  settings.method = Method::kReg;
  expect_fault(problem, settings, "square");
  problem.alpha = Interval(1.0);
  expect_fault(problem, {}, "square");
}

TEST(Faults, AKernelOfAnotherAbiIsRefused) {
  Laborious kernel;
  kernel.functions().abi = REGULUS_KERNEL_ABI + 1;
  expect_fault(problem_over(kernel, kUnitSquare), {}, "ABI");
}

TEST(Faults, OfTheExpansionAreNamed) {
  Laborious kernel;
  const auto product = [](const double*, const double*, double*, const void*) { return 0U; };
  const int rows[] = {-1, 0};
  const double nominal[] = {0, 0, 0.5, 0.5};
  const regulus_derivative place{0, 0, 1, REGULUS_FIRST_ORDER};
  regulus_expansion expansion{rows, nullptr, nominal, product, {}, {}, {product, &place, 1}, {}};
  kernel.functions().expansion = &expansion;
  const Problem problem = problem_over(kernel, kUnitSquare);
  EXPECT_EQ(find_fault(problem, {}), std::nullopt);

  const double outside[] = {0, 0, 1.5, 1.5};
  expansion.nominal = outside;
  expect_fault(problem, {}, "nominal value");
  expansion.nominal = nominal;
  const int wide[] = {-1, -1};
  expansion.row_of_variable = wide;
  expect_fault(problem, {}, "another row");
  const int too_far[] = {-1, 7};
  expansion.row_of_variable = too_far;
  expect_fault(problem, {}, "does not exist");
  expansion.row_of_variable = rows;
  expansion.product = nullptr;
  expect_fault(problem, {}, "no product");
}

TEST(Methods, HaveNamesThatReadBack) {
  for (const char* text :
       {"auto", "reg", "reg+rohn", "kj", "kj+rohn", "jk", "jk+rohn", "kj-numeric", "jk-numeric"}) {
    const std::optional<Method> method = parse_method(text);
    ASSERT_TRUE(method) << text;
    EXPECT_STREQ(name(*method), text);
  }
  EXPECT_EQ(parse_method("rohn"), std::nullopt);
}

}  // namespace
}  // namespace regulus::detail
