// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of pavings of branches: what they claim is compared with closed forms, and none that was
// forged is verified.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/question/closure/paving_certificate.hpp"
#include "tests/property/closure/checked_ways.hpp"
#include "tests/property/closure/four_bars.hpp"
#include "tests/property/closure/paved_certificates.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;

constexpr double kFinestPart = 0x1p-7;  ///< of a range, or of a segment

struct PavedBranch {
  PreparedClosure prepared;
  ClosureFinding found;

  explicit PavedBranch(const std::string& model)
      : prepared(prepare_closure(request_of(model), 0, usual_options(), {})),
        found(pave_closure(prepared, usual_options(), kFinestPart, {})) {}
  static Request request_of(const std::string& model) {
    ModelOptions options;
    options.motion = "m";
    return read_request(model, options);
  }
  [[nodiscard]] std::string certificate() const {
    return written(
        [this](const std::string& path) { return certify_paving(path, prepared, found, {}); });
  }
};

/// Returns the nearest angle in a direction at which coupler and rocker are in line.
double toggle_from(const FourBar& bar, double start, double step) {
  double at = start;
  while (bar.is_between_toggles(at + step)) at += step;
  for (int k = 0; k < 60; ++k) step /= 2, at += bar.is_between_toggles(at + step) ? step : 0;
  return at;
}

/// True if each leaf with a tube is between the toggles next to the start, and holds the configuration there.
bool is_true(const PavedTreeText& tree, const FourBar& bar, double low, double high) {
  for (const PavedLeaf& leaf : tree.leaves()) {
    if (leaf.tube.empty()) continue;
    if (leaf.lo < low || leaf.hi > high) return false;
    for (const double theta : {leaf.lo, (leaf.lo + leaf.hi) / 2, leaf.hi}) {
      const double inside = std::clamp(theta, low + 1e-12, high - 1e-12);
      const FourBar::Angles angles = bar.at(inside);
      const double exact[] = {angles.phi, angles.psi};
      for (std::size_t i = 0; i < 2; ++i) {
        const double middle = leaf.tube[1 + i] + leaf.tube[3 + i] * (inside - leaf.tube[0]);
        if (std::fabs(std::remainder(exact[i] - middle, 2 * std::numbers::pi)) >
            leaf.tube[5 + i] + 1e-6)
          return false;
      }
    }
  }
  return true;
}

/// A linkage, a start, and the toggles next to it.
struct ToggledBar {
  FourBar bar;
  double start, low, high;
  [[nodiscard]] std::string model() const { return bar.text(start, low - 0.2, high + 0.3); }
};

std::vector<ToggledBar> toggled_bars(unsigned seed, std::size_t wanted) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(-3, 3);
  std::vector<ToggledBar> found;
  while (found.size() < wanted) {
    const FourBar bar = random_four_bar(random);
    const double start = angle(random);
    if (!bar.is_between_toggles(start, 0.05)) continue;
    if (bar.is_between_toggles(start + 3) && bar.is_between_toggles(start - 3)) continue;
    bool is_open = true;
    for (int i = 0; i < 700; ++i)
      is_open = is_open && bar.is_between_toggles(start - 3.5 + i / 100.0);
    if (is_open) continue;
    const ToggledBar c{bar, start, toggle_from(bar, start, -0.01), toggle_from(bar, start, 0.01)};
    if (c.high - c.start > 3 || c.start - c.low > 3 || c.high - c.low < 0.5) continue;
    found.push_back(c);
  }
  return found;
}

TEST(ThePavingOfABranch, IsProvedBetweenItsToggles) {
  for (const ToggledBar& c : toggled_bars(41, std::size_t(trials(6, 40)))) {
    SCOPED_TRACE(c.model());
    const std::string certificate = PavedBranch(c.model()).certificate();
    ASSERT_THAT(certificate, HasSubstr("\nverdict PAVING\n"));
    const verifier::Verification v = verified(certificate, c.model());
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
    EXPECT_THAT(describe(v), HasSubstr(" tube"));
    const PavedTreeText tree(certificate, c.low - 0.2, c.high + 0.3);
    EXPECT_TRUE(is_true(tree, c.bar, c.low, c.high));
    EXPECT_GT(tree.length("tube"), 0.8 * (c.high - c.low));
    // It is not about another assembly, nor about other ranges.
    ToggledBar other = c;
    other.bar.is_open = !c.bar.is_open;
    EXPECT_EQ(verified(certificate, other.model()).outcome, Outcome::kRejected);
    other = c, other.high += 1e-3;
    EXPECT_EQ(verified(certificate, other.model()).outcome, Outcome::kRejected);
  }
}

/// A linkage without a toggle in its motion has the certificate of check.
TEST(ThePavingOfABranch, IsACheckIfItIsWhole) {
  const FourBar bar{0.2, 0.35355, 0.25, 0.45};
  const std::string model = bar.text(0, -1, 1);
  const std::string certificate = PavedBranch(model).certificate();
  EXPECT_EQ(certificate, certified_closure(check_closure_text(model, usual_options())));
  EXPECT_EQ(verified(certificate, model).outcome, Outcome::kVerified);
}

/// Some leaf with another claim, another tube or another box.
TEST(ThePavingOfABranch, IsNotVerifiedIfItClaimsMore) {
  int forged = 0;
  for (const ToggledBar& c : toggled_bars(42, 3)) {
    SCOPED_TRACE(c.model());
    const std::string certificate = PavedBranch(c.model()).certificate();
    const PavedTreeText tree(certificate, c.low - 0.2, c.high + 0.3);
    const std::vector<PavedLeaf> leaves = tree.leaves();
    for (const PavedLeaf& leaf : leaves) {
      if (leaf.word != "undecided") continue;
      for (const PavedLeaf& near : leaves) {
        if (near.tube.empty() || (near.hi != leaf.lo && near.lo != leaf.hi)) continue;
        const std::string more = tree.with(leaf, "tube", near.tube);
        EXPECT_NE(verified(more).outcome, Outcome::kVerified) << leaf.lo << ' ' << leaf.hi;
        ++forged;
      }
      EXPECT_NE(verified(tree.with(leaf, "outside", {})).outcome, Outcome::kVerified);
    }
    // A cut that is moved is one of true claims, or is not verified.
    for (std::size_t split = 0; split < tree.splits(); ++split)
      for (const double part : {-0.4, 0.4}) {
        const std::string moved = tree.with_cut_moved(split, part);
        if (verified(moved).outcome != Outcome::kVerified) continue;
        const PavedTreeText of_moved(moved, c.low - 0.2, c.high + 0.3);
        EXPECT_TRUE(is_true(of_moved, c.bar, c.low, c.high)) << moved;
      }
  }
  EXPECT_GT(forged, 5);
}

TEST(ThePavingOfABranch, IsNotVerifiedIfItIsNotOneBranch) {
  for (const ToggledBar& c : toggled_bars(43, 3)) {
    SCOPED_TRACE(c.model());
    const std::string certificate = PavedBranch(c.model()).certificate();
    const PavedTreeText tree(certificate, c.low - 0.2, c.high + 0.3);
    std::vector<PavedLeaf> tubes;
    for (const PavedLeaf& leaf : tree.leaves())
      if (!leaf.tube.empty()) tubes.push_back(leaf);
    std::ranges::sort(tubes, {}, &PavedLeaf::lo);
    ASSERT_GT(tubes.size(), 4U);
    for (std::size_t i = 0; i < tubes.size(); ++i) {
      // Without it there are two parts; one at an end is left out with truth.
      const verifier::Verification v = verified(tree.with(tubes[i], "undecided", {}));
      const bool has_start = tubes[i].lo <= c.start && c.start <= tubes[i].hi;
      const bool is_end = i == 0 || i + 1 == tubes.size();
      EXPECT_EQ(v.outcome == Outcome::kVerified, is_end && !has_start) << describe(v);
      // The other assembly has a tube over this box, too.
      FourBar mirror = c.bar;
      mirror.is_open = !mirror.is_open;
      const FourBar::Angles angles = mirror.at((tubes[i].lo + tubes[i].hi) / 2);
      std::vector<double> other = tubes[i].tube;
      other[0] = (tubes[i].lo + tubes[i].hi) / 2;
      other[1] = angles.phi, other[2] = angles.psi;
      EXPECT_NE(verified(tree.with(tubes[i], "tube", other)).outcome, Outcome::kVerified);
    }
  }
}

TEST(ThePavingOfABranch, IsNotVerifiedWithAnotherVerdict) {
  const ToggledBar c = toggled_bars(44, 1).front();
  const std::string certificate = PavedBranch(c.model()).certificate();
  for (const char* verdict : {"NO SINGULARITY", "FEASIBLE", "COMPLETE"})
    EXPECT_EQ(verified(replaced(certificate, "verdict PAVING", std::string("verdict ") + verdict))
                  .outcome,
              Outcome::kRejected)
        << verdict;
  // The claim of a whole branch.
  const std::string whole =
      replaced(replaced(certificate, "verdict PAVING", "verdict NO SINGULARITY"),
               " in a leaf with a tube\n", "\n");
  const verifier::Verification v = verified(whole);
  EXPECT_EQ(v.outcome, Outcome::kRejected);
  EXPECT_THAT(v.reason, HasSubstr("there is no rule 'undecided'"));
  EXPECT_EQ(verified(replaced(certificate, " in a leaf with a tube\n", "\n")).outcome,
            Outcome::kRejected);
}

/// The square root of x + iy: whoever goes round 0 comes to the other branch.
std::string root_model(const std::string& ranges) {
  return "regulus = 1\nname = \"root\"\n[pose]\nx = \"m\"\ny = \"m\"\n[closure]\n"
         "unknowns = { p = \"m\", q = \"m\" }\nequations = [\"p^2 - q^2 - x\", \"2*p*q - y\"]\n"
         "start = { x = 1, y = 0, p = 1, q = 0 }\n[motion.m]\n" +
         ranges;
}

TEST(ThePavingOfABranch, IsCutWhereItWouldHaveTwoValues) {
  const std::string model = root_model("x = [-1, 1.5]\ny = [-1, 1]\n");
  PavedBranch paved(model);
  const std::string certificate = paved.certificate();
  const verifier::Verification v = verified(certificate, model);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  // Leaves with a tube are left out, because all of them together are not one branch.
  const BranchTree& tree = paved.found.searched.branch.tree;
  PavedTree all = PavedTree::of(paved.found.searched);
  std::size_t left_out = 0;
  for (std::size_t leaf = 0; leaf < all.words.size(); ++leaf)
    if (tree.leaves()[leaf].tube && all.words[leaf] != std::string(format::kTubeLeaf))
      all.words[leaf] = format::kTubeLeaf, ++left_out;
  EXPECT_GT(left_out, 0U);
  const std::string text = written([&](const std::string& path) {
    return certify_paved(path, paved.prepared.request, paved.prepared.preparation.labels, {all},
                         is_regular(), {});
  });
  EXPECT_NE(verified(text).outcome, Outcome::kVerified);
}

/// Constraints leave out what is near 0, and one side.
TEST(ThePavingOfABranch, MayHaveBoxesOutside) {
  const std::string model = root_model(
      "x = [-1, 1.5]\ny = [-1, 1]\nconstraints = [\"-x - 1/2\", \"1/16 - x^2 - y^2\"]\n");
  const std::string certificate = PavedBranch(model).certificate();
  EXPECT_THAT(certificate, HasSubstr(" outside\n"));
  EXPECT_EQ(verified(certificate, model).outcome, Outcome::kVerified)
      << describe(verified(certificate, model));
}

/// A way that turns, and ends beyond a toggle on its third segment.
class ThePavingOfAWay : public testing::Test {
 protected:
  [[nodiscard]] std::string certificate_of(const std::string& file) const {
    ModelOptions options;
    options.motion = "m";
    options.waypoints = file;
    PreparedWay prepared = prepare_way(read_request(model_, options), 0, usual_options(), {});
    const WayFinding found = pave_way(prepared, usual_options(), kFinestPart, {});
    return written(
        [&](const std::string& path) { return certify_paving(path, prepared, found, {}); });
  }
  [[nodiscard]] verifier::Verification verify(const std::string& certificate) const {
    return verified_way(certificate, model_, file_.path());
  }
  void expect_not_verified(const std::string& certificate) const {
    EXPECT_NE(verified(certificate).outcome, Outcome::kVerified);
    EXPECT_NE(verify(certificate).outcome, Outcome::kVerified);
  }
  /// The tree of a segment, by the angle of the crank.
  [[nodiscard]] PavedTreeText tree(std::size_t k) const { return {certificate_, 0, 1, k}; }

  const ToggledBar toggled_ = toggled_bars(45, 1).front();
  const std::vector<double> places_{toggled_.start,     toggled_.high - 0.1,
                                    toggled_.low + 0.1, toggled_.high + 0.2,
                                    toggled_.start,     toggled_.start + 0.01};
  const std::string model_ = toggled_.model();
  const WayFile file_{table_of(places_)};
  const std::string certificate_ = certificate_of(file_.path());
};

TEST_F(ThePavingOfAWay, IsProvedUpToItsToggle) {
  ASSERT_THAT(certificate_, HasSubstr("\nverdict PAVING\n"));
  const verifier::Verification v = verify(certificate_);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(verified(certificate_).outcome, Outcome::kVerified);
  EXPECT_EQ(tree(0).length("tube"), 1);
  EXPECT_EQ(tree(1).length("tube"), 1);
  const double toggle = (toggled_.high - places_[2]) / (places_[3] - places_[2]);
  for (const PavedLeaf& leaf : tree(2).leaves())
    EXPECT_TRUE(leaf.tube.empty() || leaf.hi <= toggle) << leaf.hi;
  EXPECT_GT(tree(2).length("tube"), toggle - 0.2);
  for (const std::size_t k : {3U, 4U}) EXPECT_EQ(tree(k).length("undecided"), 1);
}

TEST_F(ThePavingOfAWay, IsOfThisWayAlone) {
  std::vector<double> other = places_;
  other[1] -= 1e-3;
  const WayFile file(table_of(other));
  EXPECT_EQ(verified_way(certificate_, model_, file.path()).outcome, Outcome::kRejected);
  other = places_;
  other.pop_back();
  file.write(table_of(other));
  EXPECT_EQ(verified_way(certificate_, model_, file.path()).outcome, Outcome::kRejected);
  ToggledBar mirror = toggled_;
  mirror.bar.is_open = !mirror.bar.is_open;
  EXPECT_EQ(verified_way(certificate_, mirror.model(), file_.path()).outcome, Outcome::kRejected);
}

TEST_F(ThePavingOfAWay, IsNotVerifiedIfItClaimsMore) {
  for (const std::size_t k : {3U, 4U})
    for (const std::size_t from : {0U, 1U, 2U})
      expect_not_verified(tree(k).with_tree_of(tree(from)));
  const std::vector<PavedLeaf> leaves = tree(2).leaves();
  int forged = 0;
  for (const PavedLeaf& leaf : leaves)
    for (const PavedLeaf& near : leaves)
      if (leaf.tube.empty() && !near.tube.empty() && near.hi == leaf.lo)
        expect_not_verified(tree(2).with(leaf, "tube", near.tube)), ++forged;
  EXPECT_GT(forged, 0);
}

TEST_F(ThePavingOfAWay, IsNotVerifiedIfItsWayIsTorn) {
  // A segment without a tube between two that have some.
  expect_not_verified(tree(1).with_tree_of(tree(3)));
  expect_not_verified(tree(0).with_tree_of(tree(3)));
  for (const std::size_t k : {0U, 1U})
    for (const PavedLeaf& leaf : tree(k).leaves())
      expect_not_verified(tree(k).with(leaf, "undecided", {}));
}

}  // namespace
}  // namespace regulus::detail::test
