// SPDX-License-Identifier: GPL-3.0-or-later
// A search about a load that is stopped and continued, from true trees and from others, and shared.
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "codegen/question/load/feasibility_run.hpp"
#include "runtime/search/thread_workers.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/search_events.hpp"
#include "tests/support/simulated_workers.hpp"

namespace regulus::detail::test {
namespace {

/// Four cables hold a plate in the plane; an anchor is uncertain. Poses near the middle hold the load.
constexpr const char* kPlate = R"toml(regulus = 1
name = "plate"
[pose]
x = "m"
y = "m"
[geometry]
a = { value = 3, tolerance = 0.01, group = "a" }
[matrix]
twist = ["v_x", "v_y"]
rows = [["x - a", "y - 3"], ["x + 3", "y - 3"], ["x + 3", "y + 3"], ["x - 3", "y + 3"]]
row_scale = ["1/sqrt((x - a)^2 + (y - 3)^2)", "1/sqrt((x + 3)^2 + (y - 3)^2)",
             "1/sqrt((x + 3)^2 + (y + 3)^2)", "1/sqrt((x - 3)^2 + (y + 3)^2)"]
[load.pull]
wrench = { value = [0, -2], radius = 1 }
[actuators]
force = [1, 10]
[motion.m]
x = ["-29/10", "29/10"]
y = ["-29/10", "29/10"]
constraints = ["x^2 + y^2 - 8"]
[motion.held]
x = [-2, 2]
y = [-2, "13/10"]
constraints = ["x^2 + y^2 - 3"]
)toml";

struct Ended {
  FeasibilityResult result;
  std::string events, claims;
  SavedTree saved;
  int saves = 0;
};

class Plate {
 public:
  explicit Plate(const char* motion) : prepared_(prepared(motion)) {}

  [[nodiscard]] FeasibilitySettings paving(double resolution) const {
    FeasibilitySettings settings;
    settings.paves = true;
    settings.min_relative_width = resolution;
    return settings;
  }

  Ended run(FeasibilitySettings settings, const SavedTree* from = nullptr) {
    Ended ended;
    SearchEvents events;
    settings.from = from;
    settings.save = [&](const SavedTree& tree) { ended.saved = tree, ++ended.saves; };
    settings.save_every = 0;
    const auto listener = [&](std::span<const Interval> box, ForceClaim claim) {
      ended.claims += name(claim);
      for (const Interval& x : box) ended.claims += ' ' + std::to_string(x.lo);
      ended.claims += '\n';
    };
    ended.result = search_forces(prepared_.question(), settings, listener, &events);
    ended.events = events.text;
    return ended;
  }

  /// Stops at each number of boxes and continues.
  Ended run_with_stops(const FeasibilitySettings& settings,
                       std::initializer_list<std::uint64_t> stops) {
    std::optional<SavedTree> tree;
    for (const std::uint64_t stop : stops) {
      FeasibilitySettings until = settings;
      until.max_boxes = stop;
      Ended ended = run(until, tree ? &*tree : nullptr);
      EXPECT_EQ(ended.result.stopped_by, Reason::kBoxBudget) << stop;
      EXPECT_EQ(ended.result.boxes, stop);
      tree = std::move(ended.saved);
    }
    return run(settings, tree ? &*tree : nullptr);
  }

  [[nodiscard]] ForceQuestion question() const { return prepared_.question(); }

 private:
  static PreparedForces prepared(const char* motion) {
    ModelOptions model;
    model.path = "test.toml";
    model.text = kPlate;
    model.motion = motion;
    SearchOptions search;
    search.engine = Engine::kInterpreted;
    return prepare_forces(model, "pull", search, {});
  }

  PreparedForces prepared_;
};

void expect_same(const Ended& one, const Ended& other) {
  EXPECT_EQ(one.result.verdict, other.result.verdict);
  EXPECT_EQ(one.result.reason, other.result.reason);
  EXPECT_EQ(one.result.boxes, other.result.boxes);
  EXPECT_EQ(one.result.is_inhabited, other.result.is_inhabited);
  EXPECT_EQ(one.result.is_empty, other.result.is_empty);
  EXPECT_EQ(one.result.blocking_box, other.result.blocking_box);
  ASSERT_EQ(one.result.witness.has_value(), other.result.witness.has_value());
  if (one.result.witness) {
    EXPECT_EQ(one.result.witness->variables, other.result.witness->variables);
    EXPECT_EQ(one.result.witness->shortage.direction, other.result.witness->shortage.direction);
    EXPECT_EQ(one.result.witness->shortage.needed, other.result.witness->shortage.needed);
  }
  EXPECT_TRUE(one.events == other.events);
  EXPECT_TRUE(one.claims == other.claims);
  EXPECT_TRUE(one.saved == other.saved);
}

TEST(ContinuedForceSearch, PavesLikeOneWithoutAStop) {
  Plate plate("m");
  const FeasibilitySettings settings = plate.paving(1.0 / 128);
  const Ended whole = plate.run(settings);
  ASSERT_EQ(whole.result.verdict, FeasibilityVerdict::kInfeasible);
  ASSERT_GT(whole.result.boxes, 1500U);
  expect_same(plate.run_with_stops(settings, {1}), whole);
  expect_same(plate.run_with_stops(settings, {2, 3, 100, 101, 800, 1499}), whole);
  FeasibilitySettings two = settings;
  two.threads = 2;
  expect_same(plate.run_with_stops(two, {700}), whole);
}

TEST(ContinuedForceSearch, ProvesLikeOneWithoutAStop) {
  Plate plate("held");
  const Ended whole = plate.run({});
  ASSERT_EQ(whole.result.verdict, FeasibilityVerdict::kFeasible);
  EXPECT_TRUE(whole.result.is_inhabited);
  ASSERT_GT(whole.result.boxes, 20U);
  expect_same(plate.run_with_stops({}, {1, 5, 9, 17}), whole);
}

TEST(ContinuedForceSearch, FindsTheSameWitness) {
  Plate plate("m");
  const Ended whole = plate.run({});
  ASSERT_EQ(whole.result.verdict, FeasibilityVerdict::kInfeasible);
  ASSERT_GT(whole.result.boxes, 2U);
  expect_same(plate.run_with_stops({}, {1, 2}), whole);
}

/// A blocked search looks for a witness in so many more boxes; a later run knows since when.
TEST(ContinuedForceSearch, LooksForAWitnessAsLongAsOneWithoutAStop) {
  Plate plate("m");
  FeasibilitySettings settings;
  settings.min_relative_width = 1.0 / 8;
  const Ended whole = plate.run(settings);
  expect_same(plate.run_with_stops(settings, {1, 2}), whole);
}

TEST(ContinuedForceSearch, ClaimsNothingIfItStopsTooEarly) {
  Plate plate("held");
  const Ended whole = plate.run({});
  std::atomic<bool> interrupt = true;
  FeasibilitySettings settings;
  settings.interrupt = &interrupt;
  const Ended stopped = plate.run(settings, &whole.saved);
  EXPECT_FALSE(stopped.result.is_continued);
  EXPECT_EQ(stopped.result.verdict, FeasibilityVerdict::kPossibleProblem);
  EXPECT_EQ(stopped.result.reason, Reason::kInterrupted);
  EXPECT_EQ(stopped.saves, 0);  // the file keeps what it has
}

/// Each claim about a box, by its text.
std::map<std::string, int> claims_of(const Ended& ended) {
  std::map<std::string, int> claims;
  std::istringstream lines(ended.claims);
  for (std::string line; std::getline(lines, line);) ++claims[line];
  return claims;
}

TEST(ContinuedForceSearch, DoesNotBelieveLeaves) {
  Plate plate("m");
  const Ended whole = plate.run(plate.paving(1.0 / 32));
  FeasibilitySettings early = plate.paving(1.0 / 32);
  early.max_boxes = 600;
  SavedTree lie = plate.run(early).saved;
  ASSERT_GT(lie.open.size(), 20U);
  lie.steps += lie.open;  // open boxes, said to be decided
  lie.open.clear();
  lie.shown = {0, 1};
  const Ended ended = plate.run(plate.paving(1.0 / 32), &lie);
  EXPECT_EQ(ended.result.verdict, whole.result.verdict);
  EXPECT_EQ(claims_of(ended), claims_of(whole));  // perhaps in another order
}

TEST(ContinuedForceSearch, OfADamagedTreeIsRefusedOrRight) {
  Plate plate("held");
  FeasibilitySettings settings;
  settings.max_boxes = 20;
  const SavedTree saved = plate.run(settings).saved;
  settings.max_boxes = 4000;
  const std::vector<std::string> splices{
      " ", "-", ":", "0:1 ", ":2", "7", "9- ", "=0x1p+0", "99999999999999999999"};
  int refused = 0, right = 0;
  for (unsigned seed = 0; seed < 800; ++seed) {
    SavedTree tree = saved;
    std::string& text = seed % 3 == 0 ? tree.open : tree.steps;
    text = Damage(seed, splices).done_to(text);
    try {
      EXPECT_NE(plate.run(settings, &tree).result.verdict, FeasibilityVerdict::kInfeasible) << text;
      ++right;
    } catch (const SavedTreeError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 300);
  EXPECT_GT(right, 2);
  SavedTree uncertain = saved;  // a search does not split an uncertain quantity
  uncertain.steps = "0:2 ", uncertain.open = "1- 2- ";
  EXPECT_THROW(plate.run(settings, &uncertain), SavedTreeError);
}

TEST(SharedForceSearch, EndsLikeOneOfOneThread) {
  Plate plate("m");
  const FeasibilitySettings settings = plate.paving(1.0 / 256);
  const Ended alone = plate.run(settings);
  const auto shared_by = [&](cluster::Workers& workers) {
    FeasibilitySettings shared = settings;
    shared.workers = &workers;
    shared.boxes_before_workers = 0;
    return shared;
  };
  ThreadWorkers threads(3);
  expect_same(plate.run(shared_by(threads)), alone);
  KnownOutcomes known;
  for (unsigned seed = 0; seed < 2; ++seed) {
    Troubles troubles;
    if (seed % 2 == 1) troubles = {0.02, 0.05, 0.01, 40};
    SimulatedWorkers workers(2 + seed, troubles, seed, known);
    expect_same(plate.run(shared_by(workers)), alone);
  }
  EXPECT_GT(known.size(), 30U) << "workers judged too few units";
  FeasibilitySettings until = shared_by(threads);
  until.max_boxes = alone.result.boxes / 2;
  const Ended stopped = plate.run(until);
  expect_same(plate.run(settings, &stopped.saved), alone);
}

TEST(SharedForceSearch, RefusesDamagedFindings) {
  Plate plate("m");
  const ForceQuestion question = plate.question();
  std::vector<BoxOutcome> own(1), brought(1);
  std::vector<std::vector<Interval>> boxes{question.problem.outer};
  boxes[0][0] = {2.5, 2.6}, boxes[0][1] = {-0.1, 0.1};
  BoxForces(question).judge(boxes, own, 0);
  ASSERT_TRUE(own[0].witness);
  cluster::ByteWriter bytes;
  BoxForces::put(bytes, own[0]);
  read_findings<BoxForces>(bytes.bytes(), question, brought);
  EXPECT_EQ(brought[0].kind, own[0].kind);
  EXPECT_EQ(brought[0].impact, own[0].impact);
  ASSERT_TRUE(brought[0].witness);
  EXPECT_EQ(brought[0].witness->variables, own[0].witness->variables);
  EXPECT_EQ(brought[0].witness->shortage.direction, own[0].witness->shortage.direction);
  for (std::size_t size = 0; size < bytes.bytes().size(); ++size)
    EXPECT_THROW(read_findings<BoxForces>(bytes.bytes().substr(0, size), question, brought),
                 cluster::MalformedMessage)
        << size;
  for (const std::size_t at : {0U, 1U, 2U, 3U, 4U}) {
    std::string damaged = bytes.bytes();
    damaged[at] = 9;
    EXPECT_THROW(read_findings<BoxForces>(damaged, question, brought), cluster::MalformedMessage)
        << at;
  }
}

}  // namespace
}  // namespace regulus::detail::test
