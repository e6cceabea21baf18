// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/search/retold_tree.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <map>

#include "runtime/search/solver.hpp"
#include "tests/support/function_kernel.hpp"

namespace regulus::detail {
namespace {

using test::FunctionKernel;
using test::problem_over;
using test::Values;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Keeps the tree of a search, and what it was told.
class Listener : public Observer {
 public:
  void on_split(const OpenBox& box, const Split& split) noexcept override {
    tree.add_split(box.id, split.variable);
    events += std::to_string(box.id) + ':' + std::to_string(split.at) + ' ';
  }
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override {
    tree.add_leaf(box.id, bound_of_leaf(rule, proof.reason));
    rules[box.id] = rule;
    boxes[box.id] = {box.box.begin(), box.box.end()};
    has_witness = has_witness || proof.witness != nullptr;
    events += std::to_string(box.id) + '=' + name(rule) + ' ' + describe(proof.reason) +
              (proof.witness != nullptr ? "!" : "") + ' ';
  }
  void on_open(const OpenBox& box) noexcept override { tree.add_open(box.id, kInfinite); }

  SavedTree tree;
  std::string events;
  std::map<BoxId, Rule> rules;
  std::map<BoxId, std::vector<Interval>> boxes;
  bool has_witness = false;
};

class RetoldTreeTest : public testing::Test {
 protected:
  RetoldTreeTest() {
    settings_.exhaustive = true;
    settings_.min_relative_width = 0x1p-5;
  }
  [[nodiscard]] RetoldTree tell(const SavedTree& saved, Listener& to) const {
    const RestoredTree tree(saved, problem_.outer, 2);
    return tell_again(tree, problem_, settings_, to);
  }
  [[nodiscard]] static bool meets_circle(const std::vector<Interval>& box) {
    return contains(sqr(box[0]) + sqr(box[1]), 1.0);
  }

  /// det = x² + y² − 1.
  const FunctionKernel kernel_{2, 2, 2, [](const Values& x) {
                                 return Values{x[0], x[1] + 1.0, 1.0 - x[1], x[0]};
                               }};
  const Problem problem_ = problem_over(kernel_, {{-2, 2}, {-2, 2}});
  Settings settings_;
};

TEST_F(RetoldTreeTest, IsToldAsTheSearchToldIt) {
  Listener once, again;
  const Result result = solve(problem_, settings_, &once);
  const RetoldTree told = tell(once.tree, again);
  EXPECT_EQ(again.events, once.events);
  EXPECT_TRUE(told.is_complete);
  EXPECT_TRUE(told.reopened.empty());
  EXPECT_EQ(told.leaves, result.statistics.leaves);
  ASSERT_TRUE(told.witness && result.witness);
  EXPECT_EQ(told.witness->points.front().variables, result.witness->points.front().variables);
}

/// Each leaf claims that it is free, in a way that a search would save.
TEST_F(RetoldTreeTest, DoesNotClaimWhatIsFalse) {
  Listener once;
  static_cast<void>(solve(problem_, settings_, &once));
  for (const Rule rule : {Rule::kHMatrix, Rule::kOutside, Rule::kWitness, Rule::kFilter}) {
    SavedTree forged;
    std::size_t at = 0;
    const RestoredTree tree(once.tree, problem_.outer, 2);
    for (const RestoredTree::Step& step : tree.steps())
      if (step.variable)
        forged.add_split(step.box, *step.variable);
      else
        forged.add_leaf(tree.leaves()[at++].box, bound_of_leaf(rule, Reason::kAllBoxesCertified));
    Listener to;
    const RetoldTree told = tell(forged, to);
    EXPECT_TRUE(told.is_complete);
    EXPECT_EQ(told.reopened.size() + to.rules.size(), at);
    EXPECT_FALSE(told.reopened.empty());
    for (const auto& [id, told_rule] : to.rules) {
      EXPECT_EQ(told_rule, rule);
      EXPECT_EQ(meets_circle(to.boxes[id]), rule == Rule::kWitness);
      EXPECT_NE(rule, Rule::kOutside);
      EXPECT_NE(rule, Rule::kFilter);
    }
  }
}

/// The root, as one leaf: the whole is not free.
TEST_F(RetoldTreeTest, OpensAWholeThatIsNotCertified) {
  SavedTree forged;
  forged.add_leaf(0, bound_of_leaf(Rule::kMeanValue, Reason::kAllBoxesCertified));
  Listener to;
  const RetoldTree told = tell(forged, to);
  EXPECT_EQ(told.reopened, std::vector<BoxId>{0});
  EXPECT_EQ(to.events, "");
}

/// What is blocked claims nothing, but excludes that all is certified.
TEST_F(RetoldTreeTest, RemembersWhatIsBlocked) {
  SavedTree saved;
  saved.add_leaf(0, bound_of_leaf(Rule::kBlocked, Reason::kUncertainty));
  Listener to;
  const RetoldTree told = tell(saved, to);
  EXPECT_EQ(told.blocked, BoxId{0});
  EXPECT_EQ(told.blocked_reason, Reason::kUncertainty);
}

TEST_F(RetoldTreeTest, OpensTheRestIfItMustStop) {
  Listener once, again;
  static_cast<void>(solve(problem_, settings_, &once));
  const std::atomic<bool> stop = true;
  settings_.interrupt = &stop;
  const RetoldTree told = tell(once.tree, again);
  EXPECT_FALSE(told.is_complete);
  for (std::size_t rule = 0; rule < static_cast<std::size_t>(Rule::kBlocked); ++rule)
    EXPECT_EQ(told.leaves[rule], 0U);
  EXPECT_GT(told.reopened.size(), 100U);
}

TEST_F(RetoldTreeTest, RefusesALeafWithoutARule) {
  for (const double bound : {0.5, double(kRules), 64.0 * 63, kInfinite}) {
    SavedTree saved;
    saved.add_leaf(0, bound);
    Listener to;
    EXPECT_THROW(static_cast<void>(tell(saved, to)), SavedTreeError) << bound;
  }
}

}  // namespace
}  // namespace regulus::detail
