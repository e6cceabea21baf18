// SPDX-License-Identifier: GPL-3.0-or-later
// A search for roots that is stopped after any round and continued, and what false trees can do.
#include "codegen/question/solve/retraced_roots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <sstream>

#include "codegen/question/solve/root_search.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

/// x² + y² = 5, x·y = p. Of p = 2 the solutions are ±(1, 2) and ±(2, 1), of p = 3 there is none. It is
/// written so that bounds are wide. Counts the boxes that have a width.
class CircleAndHyperbola final : public RootSystem {
 public:
  CircleAndHyperbola(double product, std::atomic<std::uint64_t>& boxes)
      : product_(product), count_(boxes) {}

  void evaluate(std::span<const Box> boxes, bool) override {
    boxes_.assign(boxes.begin(), boxes.end());
    for (const Box& box : boxes_) count_ += box[0].lo < box[0].hi ? 1 : 0;
  }
  [[nodiscard]] std::optional<Values> at(std::size_t lane) const override {
    const Interval one(1.0), two(2.0), x = boxes_[lane][0], y = boxes_[lane][1];
    Values values;
    values.value = {sqr(x) * (one + y) - sqr(x) * y + sqr(y) - Interval(5.0), x * y - product_};
    values.by_unknown = {two * x * (one + y) - two * x * y, two * y + sqr(x) - sqr(x), y, x};
    return values;
  }

 private:
  const Interval product_;
  std::atomic<std::uint64_t>& count_;
  std::vector<Box> boxes_;
};

class RetracedSearch : public testing::Test {
 protected:
  RetracedSearch() { problem_.outer = {Interval(-40.0, 41.0), Interval(-39.0, 43.0)}; }

  RootList search(const RootSettings& settings) {
    const RootQuestion question{problem_, {0, 0, 2, 0}, [this] {
                                  return std::make_unique<CircleAndHyperbola>(product_, boxes_);
                                }};
    return search_roots(question, {Interval(0.0), Interval(0.0)}, settings, nullptr);
  }
  /// Returns the tree of a search that ends after so many boxes.
  SavedTree stopped_after(std::uint64_t boxes) {
    RootSettings settings;
    SavedTree tree;
    settings.max_boxes = boxes;
    settings.save = [&tree](const SavedTree& saved) { tree = saved; };
    static_cast<void>(search(settings));
    return tree;
  }
  RootList continued(const SavedTree& tree) {
    RootSettings settings;
    settings.from = &tree;
    return search(settings);
  }

  static std::vector<std::string> words(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
  }
  static std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += word + ' ';
    return text;
  }
  /// Each of the four solutions is in one of the enclosures, whatever was false.
  static void expect_truth(const RootList& list, const std::string& what) {
    if (!list.is_complete) return;
    EXPECT_EQ(list.roots.size(), 4U) << what;
    for (const auto& [x, y] : {std::pair{1.0, 2.0}, {2.0, 1.0}, {-1.0, -2.0}, {-2.0, -1.0}})
      EXPECT_EQ(std::ranges::count_if(list.roots,
                                      [x = x, y = y](const Root& root) {
                                        return contains(root.values[0], x) &&
                                               contains(root.values[1], y);
                                      }),
                1)
          << what;
  }
  void expect_truth_of(const SavedTree& tree, const std::string& what) {
    try {
      expect_truth(continued(tree), what);
    } catch (const SavedTreeError&) {  // it is refused
    }
  }

  const FloatingPointScope nearest_{FloatingPointRounding::kNearest};
  Problem problem_;
  double product_ = 2;
  std::atomic<std::uint64_t> boxes_ = 0;
};

void expect_same(const RootList& found, const RootList& expected) {
  EXPECT_EQ(found.boxes, expected.boxes);
  EXPECT_EQ(found.is_complete, expected.is_complete);
  EXPECT_EQ(found.open, expected.open);
  ASSERT_EQ(found.roots.size(), expected.roots.size());
  for (std::size_t i = 0; i < found.roots.size(); ++i) {
    EXPECT_EQ(found.roots[i].values, expected.roots[i].values);
    EXPECT_EQ(found.roots[i].center, expected.roots[i].center);
    EXPECT_EQ(found.roots[i].radius, expected.roots[i].radius);
  }
}

TEST_F(RetracedSearch, ContinuesFromAnyRound) {
  const RootList whole = search({});
  ASSERT_TRUE(whole.is_complete);
  expect_truth(whole, "without a stop");
  for (std::uint64_t boxes = 1; boxes < whole.boxes; ++boxes)
    expect_same(continued(stopped_after(boxes)), whole);
  expect_same(continued(stopped_after(whole.boxes)), whole);
}

/// Where no box is above a solution.
TEST_F(RetracedSearch, JudgesFewerBoxesThanTheSearch) {
  product_ = 3;
  const std::uint64_t boxes = search({}).boxes;
  const SavedTree tree = stopped_after(boxes + 1);
  EXPECT_TRUE(tree.open.empty());
  boxes_ = 0;
  static_cast<void>(search({}));
  const std::uint64_t of_search = boxes_.exchange(0);
  const RootList list = continued(tree);
  EXPECT_TRUE(list.is_complete && list.roots.empty());
  EXPECT_LT(boxes_, of_search * 3 / 4);
}

TEST_F(RetracedSearch, EndsEarlyWithoutAClaim) {
  const SavedTree tree = stopped_after(20);
  const std::atomic<bool> interrupt = true;
  RootSettings settings;
  settings.from = &tree;
  settings.interrupt = &interrupt;
  settings.save = [](const SavedTree&) { ADD_FAILURE() << "the file must stay as it is"; };
  const RootList list = search(settings);
  EXPECT_FALSE(list.is_complete);
  EXPECT_EQ(list.stopped_by, Reason::kInterrupted);
}

TEST_F(RetracedSearch, OfAFalseTreeProvesNothing) {
  const std::uint64_t boxes = search({}).boxes;
  for (std::uint64_t stop = 1; stop < boxes; stop += 3) {
    const SavedTree genuine = stopped_after(stop);
    SavedTree empty = genuine;  // all that is open claims to be empty
    for (const std::string& word : words(genuine.open)) empty.steps += word + ' ';
    empty.open.clear();
    expect_truth_of(empty, "empty after " + std::to_string(stop));
    for (SavedTree tree : {genuine, empty}) {
      std::vector<std::string> steps = words(tree.steps);
      for (std::string& word : steps)
        if (word.find('=') != std::string::npos) word = word.substr(0, word.find('=')) + '-';
      tree.steps = joined(steps);
      expect_truth_of(tree, "nothing is found after " + std::to_string(stop));
    }
  }
}

/// Cuts in other places still tile the ranges, or are refused.
TEST_F(RetracedSearch, WithOtherCutsProvesNothing) {
  const SavedTree genuine = stopped_after(search({}).boxes + 1);
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    SavedTree tree = genuine;
    std::vector<std::string> steps = words(tree.steps);
    for (std::string& word : steps) {
      if (word.find('=') != std::string::npos && random() % 2 == 0)
        word = word.substr(0, word.find('=')) + '-';
      const std::size_t cut = word.find('@');
      if (cut == std::string::npos || random() % 4 != 0) continue;
      std::ostringstream at;
      at << std::hexfloat << std::uniform_real_distribution<double>(-40, 40)(random);
      word = word.substr(0, cut + 1) + at.str();
    }
    tree.steps = joined(steps);
    expect_truth_of(tree, "cuts of trial " + std::to_string(trial));
  }
}

}  // namespace
}  // namespace regulus::detail
