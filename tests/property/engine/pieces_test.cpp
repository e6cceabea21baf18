// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of a trajectory with uncertain geometry and control errors. A check begins with tests for
// easy boxes, which a search does not use; both must come to the same verdict.
#include <gtest/gtest.h>

#include <cmath>

#include "codegen/question/engine/pipeline.hpp"
#include "runtime/embedded/checker.hpp"
#include "runtime/evaluation/batch.hpp"
#include "runtime/problem/row_structure.hpp"
#include "runtime/regularity/h_matrix.hpp"
#include "runtime/search/solver.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail {
namespace {

constexpr unsigned kMostBoxes = 1000;

PreparedSearch trajectory_of(const char* motion, const char* tolerance) {
  ModelOptions model;
  model.path = REGULUS_SOURCE_DIR "/models/robot_1.toml";
  model.motion = motion;
  model.tolerances = {std::string("base,platform=") + tolerance};
  SearchOptions options;
  options.engine = Engine::kInterpreted;
  return prepare(model, options);
}

/// Returns a piece of 1, 1/8, 1/64 … of the trajectory.
Interval some_piece(test::RandomSource& random, Interval whole) {
  const double width = std::ldexp(whole.hi - whole.lo, -3 * static_cast<int>(random.below(5)));
  const double part = static_cast<double>(random.below(1 << 20)) / (1 << 20);
  const double lo = whole.lo + part * (whole.hi - whole.lo - width);
  return {lo, lo + width};
}

TEST(Pieces, HaveTheVerdictsOfSearches) {
  test::RandomSource random(71);
  int regular = 0, singular = 0;
  for (const char* tolerance : {"0.05", "0.2", "0.4", "1"}) {
    const PreparedSearch prepared = trajectory_of("T2_errors", tolerance);
    Checker checker(prepared.kernel->functions(), prepared.variety.outer, kMostBoxes);
    for (int i = 0; i < 25; ++i) {
      const Interval piece = some_piece(random, prepared.variety.outer.front());
      Problem problem = prepared.problem();
      problem.outer.front() = piece;
      problem.inner.front() = piece;
      Settings settings;
      settings.max_boxes = kMostBoxes;
      const Verdict expected = solve(problem, settings).verdict;
      const Verdict verdict = checker.check({&piece, 1}).verdict;
      EXPECT_EQ(verdict, expected) << tolerance << ' ' << piece.lo << ' ' << piece.hi;
      regular += verdict == Verdict::kNoSingularity;
      singular += verdict == Verdict::kSingularity;
    }
  }
  EXPECT_GT(regular, 25);
  EXPECT_GT(singular, 10);
}

/// A kernel that counts calls for second derivatives of K·A.
struct CountedExpansion {
  static inline regulus_function counted = nullptr;
  static inline int calls = 0;

  explicit CountedExpansion(const regulus_kernel& of) : kernel(of), expansion(*of.expansion) {
    counted = expansion.second.function;
    calls = 0;
    expansion.second.function = [](const double* boxes, const double* K, double* out,
                                   const void* context) {
      ++calls;
      return counted(boxes, K, out, context);
    };
    kernel.expansion = &expansion;
  }

  regulus_kernel kernel;
  regulus_expansion expansion;
};

TEST(Pieces, SmallOnesNeedNoSecondDerivatives) {
  const PreparedSearch prepared = trajectory_of("T2_errors", "0.05");
  const CountedExpansion counting(prepared.kernel->functions());
  Checker checker(counting.kernel, prepared.variety.outer, kMostBoxes);
  CountedExpansion::calls = 0;
  for (int i = 0; i < 100; ++i) {
    const Interval piece(0.01 * i, i == 99 ? 1.0 : 0.01 * (i + 1));
    const Check check = checker.check({&piece, 1});
    EXPECT_EQ(check.verdict, Verdict::kNoSingularity);
    EXPECT_EQ(check.boxes, kLanes);
  }
  EXPECT_EQ(CountedExpansion::calls, 0);
  EXPECT_EQ(checker.check({&prepared.variety.outer.front(), 1}).boxes, kLanes);
  EXPECT_EQ(CountedExpansion::calls, 1);
}

/// Control errors are tiny, so K need not move with them.
TEST(Pieces, AreBoundedWellAlongTheMotion) {
  const PreparedSearch prepared = trajectory_of("T2_errors", "0.05");
  const Problem problem = prepared.problem();
  const Settings settings;
  const RowStructure structure = find_row_structure(problem, settings);
  Batch batch(problem, settings, structure, true);
  batch.clear();
  std::vector<Interval> box = problem.outer;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    box.front() = {0.125 * double(lane), 0.125 * double(lane + 1)};
    batch.load(lane, box);
  }
  batch.seal(kLanes);
  const std::size_t n = batch.order();
  std::vector<double> right(n * kLanes), left(n * kLanes);
  const auto radii = [&](ConstPointMatrix T) {
    return approx_perron(
        T, {.right = PointVector(right.data(), n), .left = PointVector(left.data(), n)});
  };
  const LaneNumbers all = radii(batch.second_order_bounds()), motion = radii(batch.motion_bounds());
  for (std::size_t lane = 0; lane < kLanes; ++lane) EXPECT_LT(motion[lane], 1.05 * all[lane]);
  EXPECT_EQ(certain_h_matrix(batch.motion_bounds(), batch.candidate_vector(n)), kAllLanes);
}

}  // namespace
}  // namespace regulus::detail
