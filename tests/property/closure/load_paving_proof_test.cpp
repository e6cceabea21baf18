// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of pavings of loads on branches: compared with statics by virtual work in closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/question/closure/branch_load.hpp"
#include "tests/property/closure/checked_ways.hpp"
#include "tests/property/closure/loaded_linkages.hpp"
#include "tests/property/closure/paved_certificates.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;

/// `file`: of way-points; empty: over ranges.
std::string certified_load_paving(const std::string& model, const std::string& file = "") {
  ModelOptions options;
  options.motion = "m";
  options.waypoints = file;
  PreparedBranchLoad prepared =
      prepare_branch_load(read_request(model, options), 0, "", usual_options(), {});
  const auto listener = [](std::size_t, std::span<const Interval>, ForceClaim) {};
  const BranchLoadResult result = pave_branch_load(prepared, 0x1p-6, {}, listener, nullptr);
  return written(
      [&](const std::string& path) { return certify_load_paving(path, prepared, result, {}); });
}

/// The motor keeps the limits in a part of the motion alone.
struct LimitedCase {
  LoadCase load;
  double least = INFINITY, largest = 0;
  std::string model;

  explicit LimitedCase(const LoadCase& c) : load(c) {
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i <= 1000; ++i) {
      const auto [lo, hi] = c.torque(c.from + (c.to - c.from) * i / 1000);
      least = std::fmin(least, lo - 1), low = std::fmin(low, hi), high = std::fmax(high, hi);
    }
    largest = (low + high) / 2;
    model = with_limits(c, least, largest);
  }
  /// True if what each leaf claims is true, of a motion from one angle to another.
  [[nodiscard]] bool is_true(const PavedTreeText& tree, double from, double to) const {
    for (const PavedLeaf& leaf : tree.leaves())
      for (const double part : {leaf.lo, (leaf.lo + leaf.hi) / 2, leaf.hi}) {
        const double theta = from + part * (to - from);
        const auto [lo, hi] = load.torque(theta);
        const double beyond = std::fmax(least - lo, hi - largest);
        if (leaf.word == "feasible" && beyond > 1e-6) return false;
        if (leaf.word == "infeasible" && beyond < -1e-6) return false;
      }
    return true;
  }
};

TEST(ThePavingOfALoadOnABranch, IsProvedAsVirtualWorkSays) {
  for (const LoadCase& load : load_cases(51, std::size_t(trials(6, 30)))) {
    const LimitedCase c(load);
    SCOPED_TRACE(c.model);
    const std::string certificate = certified_load_paving(c.model);
    ASSERT_THAT(certificate, HasSubstr("\nverdict PAVING\n"));
    const verifier::Verification v = verified(certificate, c.model);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
    const PavedTreeText tree(certificate, load.from, load.to);
    EXPECT_TRUE(c.is_true(tree, 0, 1));
    EXPECT_GT(tree.length("feasible"), 0);
    EXPECT_GT(tree.length("infeasible"), 0);
    EXPECT_GT(tree.length("feasible") + tree.length("infeasible"), 0.5 * (load.to - load.from));
    // It is about these limits and this load.
    EXPECT_EQ(verified(certificate, replaced(c.model, "[-1, 3]", "[-1, 4]")).outcome,
              Outcome::kRejected);
    EXPECT_EQ(verified(certificate, with_limits(load, c.least - 1, c.largest)).outcome,
              Outcome::kRejected);
  }
}

TEST(ThePavingOfALoadOnABranch, IsNotVerifiedIfItClaimsMore) {
  int refused = 0;
  for (const LoadCase& load : load_cases(52, 2)) {
    const LimitedCase c(load);
    SCOPED_TRACE(c.model);
    const std::string certificate = certified_load_paving(c.model);
    const PavedTreeText tree(certificate, load.from, load.to);
    for (const PavedLeaf& leaf : tree.leaves()) {
      if (leaf.tube.empty()) continue;
      for (const char* word : {"feasible", "infeasible", "tube"}) {
        if (leaf.word == word) continue;
        const std::string text = tree.with(leaf, word, leaf.tube);
        const bool is_verified = verified(text).outcome == Outcome::kVerified;
        EXPECT_TRUE(!is_verified || c.is_true(PavedTreeText(text, load.from, load.to), 0, 1))
            << text;
        // Nothing about forces is a smaller claim.
        EXPECT_TRUE(is_verified || word != std::string("tube")) << leaf.lo;
        refused += is_verified ? 0 : 1;
      }
    }
    // Limits that no motor keeps, and other words.
    const std::size_t at = certificate.find("\nlimits ") + 8;
    const std::string limits = certificate.substr(at, certificate.find('\n', at) - at);
    EXPECT_EQ(verified(replaced(certificate, limits, "0 : 1/1000")).outcome, Outcome::kRejected);
    EXPECT_EQ(
        verified(replaced(certificate, "quantity force-limits", "quantity determinant")).outcome,
        Outcome::kRejected);
    EXPECT_EQ(verified(replaced(certificate, "verdict PAVING", "verdict NO SINGULARITY")).outcome,
              Outcome::kRejected);
  }
  EXPECT_GT(refused, 8);
}

TEST(ThePavingOfALoadOnABranch, IsProvedAlongAWay) {
  for (const LoadCase& load : load_cases(53, 2)) {
    const LimitedCase c(load);
    const double width = load.to - load.from;
    const std::vector<double> places{load.start, load.to - 0.02 * width, load.from + 0.02 * width};
    const WayFile file(table_of(places));
    SCOPED_TRACE(c.model + table_of(places));
    const std::string certificate = certified_load_paving(c.model, file.path());
    ASSERT_THAT(certificate, HasSubstr("\nverdict PAVING\n"));
    const verifier::Verification v = verified_way(certificate, c.model, file.path());
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
    double held = 0, not_held = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const PavedTreeText tree(certificate, 0, 1, k);
      EXPECT_TRUE(c.is_true(tree, places[k], places[k + 1])) << k;
      held += tree.length("feasible"), not_held += tree.length("infeasible");
    }
    EXPECT_GT(held, 0);
    EXPECT_GT(not_held, 0);
    const WayFile other(table_of({places[0], places[1], places[2] + 1e-3}));
    EXPECT_EQ(verified_way(certificate, c.model, other.path()).outcome, Outcome::kRejected);
  }
}

}  // namespace
}  // namespace regulus::detail::test
