// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/property/closure/checked_closures.hpp"
#include "tests/property/closure/four_bars.hpp"

namespace regulus::detail {
namespace {

using test::FourBar;
using test::random_four_bar;

using Checked = test::CheckedClosure;

SearchOptions options_with(unsigned threads) {
  SearchOptions search = test::usual_options();
  search.threads = threads;
  return search;
}

Checked check(const std::string& text, const SearchOptions& search = test::usual_options()) {
  return test::check_closure_text(text, search);
}

/// Every tube over a place holds the linkage's own configuration, and not the mirrored one.
void expect_configurations(const FourBar& linkage, const Checked& checked, std::mt19937& random) {
  for (const BranchLeaf& leaf : checked.found.searched.branch.tree.leaves()) {
    if (!leaf.tube) continue;
    const Interval& range = leaf.at.box[0];
    std::uniform_real_distribution<double> places(range.lo, range.hi);
    for (int i = 0; i < 5; ++i) {
      std::vector<Interval> place{Interval(places(random))};
      for (std::size_t k = 1; k < checked.prepared.shape.variables; ++k)
        place.emplace_back(mid(leaf.at.box[k]));
      const std::vector<Interval> unknowns = enclose(*leaf.tube, place);
      const FourBar::Angles angles = linkage.at(mid(place[0]));
      for (const auto& [value, interval] :
           {std::pair(angles.phi, unknowns[0]), std::pair(angles.psi, unknowns[1])}) {
        const double turns = std::round((mid(interval) - value) / (2 * std::numbers::pi));
        const double moved = value + turns * 2 * std::numbers::pi;
        EXPECT_GE(moved, interval.lo - 1e-9);
        EXPECT_LE(moved, interval.hi + 1e-9);
      }
    }
  }
}

TEST(FourBar, TurnsBetweenItsToggles) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  const double toggle = std::acos((0.04 + 0.2025 - std::pow(0.35355 + 0.25, 2)) / (2 * 0.2 * 0.45));
  const Checked inside = check(linkage.text(1, -toggle + 1e-3, toggle - 1e-3));
  EXPECT_EQ(inside.verdict(), Verdict::kNoSingularity);
  const Checked beyond = check(linkage.text(1, -2.4, 2.4));
  ASSERT_EQ(beyond.verdict(), Verdict::kSingularity);
  const Fold& fold = beyond.found.folds.front();
  EXPECT_NEAR(std::fabs(mid(fold.place[0])), toggle, 1e-10);
  EXPECT_LT(width_ru(fold.place[0]), 1e-10);
  // Coupler and rocker are in line there.
  const double angle = mid(fold.unknowns[1]) - mid(fold.unknowns[0]);
  EXPECT_NEAR(std::sin(angle), 0, 1e-9);
}

/// Singular if and only if the range reaches a toggle.
TEST(FourBar, HasTheVerdictOfItsClosedForm) {
  std::mt19937 random(1);
  int singular = 0, regular = 0;
  for (int count = 0; count < 60;) {
    const FourBar linkage = random_four_bar(random);
    std::uniform_real_distribution<double> angle(-3, 3);
    const double start = angle(random);
    if (!linkage.is_between_toggles(start, 0.05)) continue;
    std::uniform_real_distribution<double> reach(0.1, 2.5);
    const double from = start - reach(random), to = start + reach(random);
    // Ranges that end next to a toggle are left out.
    bool is_regular = true, is_near = false;
    for (int i = 0; i <= 2000; ++i) {
      const double theta = from + (to - from) * i / 2000;
      is_regular = is_regular && linkage.is_between_toggles(theta);
      is_near =
          is_near || (linkage.is_between_toggles(theta) != linkage.is_between_toggles(theta, 0.01));
    }
    if (is_regular && is_near) continue;
    ++count;
    const Checked checked = check(linkage.text(start, from, to));
    EXPECT_EQ(checked.verdict(), is_regular ? Verdict::kNoSingularity : Verdict::kSingularity)
        << linkage.text(start, from, to);
    ++(is_regular ? regular : singular);
    if (is_regular) expect_configurations(linkage, checked, random);
    if (!checked.found.folds.empty()) {
      const double s = linkage.diagonal(mid(checked.found.folds[0].place[0]));
      EXPECT_NEAR(std::fmin(std::fabs(s - std::fabs(linkage.b - linkage.c)),
                            std::fabs(s - linkage.b - linkage.c)),
                  0, 1e-8);
    }
  }
  EXPECT_GE(singular, 15);
  EXPECT_GE(regular, 15);
}

TEST(FourBar, KeepsItsBranchForAllLengthsWithinTolerances) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  std::mt19937 random(2);
  const Checked checked = check(linkage.text(1, -1.5, 2, 0.002));
  ASSERT_EQ(checked.verdict(), Verdict::kNoSingularity);
  for (int i = 0; i < 200; ++i) {
    std::uniform_real_distribution<double> error(-0.002, 0.002), places(-1.5, 2);
    FourBar other = linkage;
    const double da = error(random), db = error(random), theta = places(random);
    other.a += da, other.b += db;
    const BranchTree& tree = checked.found.searched.branch.tree;
    const Interval at(theta);
    const std::size_t leaf = tree.leaves_at({&at, 1}).front();
    const std::vector<Interval> place{theta, other.a, other.b};
    const std::vector<Interval> unknowns = enclose(*tree.leaves()[leaf].tube, place);
    EXPECT_NEAR(other.at(theta).phi, mid(unknowns[0]), rad_ru(unknowns[0]) + 1e-9);
    EXPECT_NEAR(other.at(theta).psi, mid(unknowns[1]), rad_ru(unknowns[1]) + 1e-9);
  }
}

/// With other lengths within the tolerance, the motion reaches a toggle: that of the least diagonal.
TEST(FourBar, ReachesAToggleForSomeLengthsWithinTolerances) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  const Checked checked = check(linkage.text(1, -2, 2.3, 0.05));
  ASSERT_EQ(checked.verdict(), Verdict::kSingularity);
  const Fold& fold = checked.found.folds.front();
  const double theta = mid(fold.place[0]);
  EXPECT_TRUE(linkage.is_between_toggles(theta));  // of the middles
  // Some lengths within the tolerance have a toggle there.
  const auto room = [&](double da, double db) {
    FourBar other = linkage;
    other.a += da, other.b += db;
    return other.b + other.c - other.diagonal(theta);
  };
  EXPECT_LT(room(0.05, -0.05), 1e-9);
  EXPECT_GT(room(-0.05, 0.05), 0);
}

/// The branch starts at the middles of the uncertain quantities, which are no doubles.
TEST(FourBar, StartsAtTheExactMiddlesOfItsTolerances) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  std::string text = linkage.text(1, -1.5, 2, 0.001);
  for (const char* number : {"0.20000000000000001", "0.35354999999999998"}) {
    const std::size_t at = text.find(number);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string(number).size(), number[2] == '2' ? "0.2" : "0.35355");
  }
  const Checked checked = check(text);
  ASSERT_EQ(checked.verdict(), Verdict::kNoSingularity);
  const std::vector<Interval>& place = checked.prepared.start.place;
  ASSERT_EQ(place.size(), 3U);
  for (const std::size_t k : {1U, 2U}) EXPECT_LT(place[k].lo, place[k].hi);
}

TEST(FourBar, HasTheSameTubesForAnyNumberOfThreads) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  const std::string text = linkage.text(1, -2.31, 2.31);
  const Checked one = check(text), two = check(text, options_with(2));
  const auto &a = one.found.searched.branch.tree.leaves(),
             &b = two.found.searched.branch.tree.leaves();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].tube, b[i].tube);
  EXPECT_EQ(one.found.searched.links.links, two.found.searched.links.links);
}

/// Returns a tube of the mirrored assembly over a box.
BranchTube mirrored_tube(const FourBar& linkage, const PreparedClosure& prepared,
                         const std::vector<Interval>& box) {
  FourBar mirror = linkage;
  mirror.is_open = !linkage.is_open;
  const FourBar::Angles angles = mirror.at(mid(box[0]));
  SystemBoxes system(prepared.problem, prepared.scaling, prepared.shape);
  TubeFinder finder(system, prepared.shape, prepared.ranges);
  const BranchPoint near{{mid(box[0])}, {angles.phi, angles.psi}};
  const auto settled = settle(system, prepared.shape, {&near, 1});
  const TubeTrial trial{{box[0]},
                        {settled[0]->at.variables, settled[0]->at.unknowns, settled[0]->slopes, {}},
                        settled[0]->inverse};
  TubeFinding found;
  finder.find({&trial, 1}, {&found, 1});
  return found.tube.value();
}

/// A tube of the mirrored assembly is as good by itself. Links notice it, and put the right one in its
/// place; at the start nothing can be put right.
TEST(FourBar, IsNotJoinedWithItsMirroredAssembly) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  ModelOptions options;
  options.motion = "m";
  const PreparedClosure prepared = prepare_closure(
      read_request(linkage.text(1, -2.2, 2.2), options), 0, test::usual_options(), {});
  const auto never = [] { return std::optional<Reason>(); };
  const BranchTree tree = search_branch(prepared.question(), {}, nullptr).tree;
  ASSERT_GT(tree.leaves().size(), 3U);
  const std::vector<std::size_t> starts = tree.leaves_at(prepared.start.place);
  for (std::size_t leaf = 0; leaf < tree.leaves().size(); ++leaf) {
    BranchTree other = tree;
    const BranchTube mirror = mirrored_tube(linkage, prepared, tree.leaves()[leaf].at.box);
    other.replace(leaf, mirror);
    const BranchLinks links = link_branch(prepared.question(), other, prepared.start, never);
    const bool is_start = std::ranges::find(starts, leaf) != starts.end();
    EXPECT_EQ(links.is_one_branch, !is_start) << leaf;
    if (is_start) continue;
    EXPECT_NE(other.leaves()[leaf].tube, mirror) << leaf;
  }
}

/// Wherever it stops, the tubes and the number of boxes are those of a search without a stop.
TEST(FourBar, ContinuesASearchThatHasStopped) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  ModelOptions options;
  options.motion = "m";
  const PreparedClosure prepared = prepare_closure(
      read_request(linkage.text(1, -2.31, 2.31, 1e-4), options), 0, test::usual_options(), {});
  const BranchResult whole = search_branch(prepared.question(), {}, nullptr);
  ASSERT_TRUE(whole.is_complete);
  for (std::uint64_t stop = 1; stop < whole.boxes; stop += 7) {
    SavedTree saved;
    BranchSettings first;
    first.max_boxes = stop;
    first.save = [&](const SavedTree& tree) { saved = tree; };
    EXPECT_EQ(search_branch(prepared.question(), first, nullptr).stopped_by, Reason::kBoxBudget);
    BranchSettings second;
    second.from = &saved;
    const BranchResult rest = search_branch(prepared.question(), second, nullptr);
    EXPECT_TRUE(rest.is_complete);
    EXPECT_EQ(rest.boxes, whole.boxes) << stop;
    ASSERT_EQ(rest.tree.leaves().size(), whole.tree.leaves().size());
    for (const BranchLeaf& leaf : whole.tree.leaves()) {
      const std::vector<Interval> middle{Interval(mid(leaf.at.box[0]))};
      EXPECT_EQ(rest.tree.leaves()[rest.tree.leaves_at(middle).front()].tube, leaf.tube);
    }
  }
}

TEST(FourBar, SaysWhyNothingIsClaimed) {
  FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  // The values of the start are those of the other assembly, at another place.
  std::string text = linkage.text(1, -1, 1.5);
  const std::size_t at = text.find("start = ");
  text.replace(at, text.find('\n', at) - at, "start = { theta = 1, phi = 3, psi = 1 }");
  EXPECT_EQ(check(text).verdict(), Verdict::kPossibleProblem);
}

}  // namespace
}  // namespace regulus::detail
