// SPDX-License-Identifier: GPL-3.0-or-later
// Loads within limits over a branch, against statics by virtual work in closed form.
#include "codegen/question/closure/branch_load.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "codegen/question/closure/value_certificate.hpp"
#include "tests/property/closure/checked_closures.hpp"
#include "tests/property/closure/loaded_linkages.hpp"

namespace regulus::detail {
namespace {

using test::FourBar;
using test::load_cases;
using test::LoadCase;
using test::SliderCrank;
using test::with_limits;

/// The least and the largest torque of samples.
struct Extremes {
  double least = INFINITY, largest = -INFINITY;
};
Extremes extremes_of(const LoadCase& c) {
  Extremes seen;
  for (int i = 0; i <= 2000; ++i) {
    const auto [lo, hi] = c.torque(c.from + (c.to - c.from) * i / 2000);
    seen = {std::fmin(seen.least, lo), std::fmax(seen.largest, hi)};
  }
  return seen;
}

struct CheckedLoad {
  PreparedBranchLoad prepared;
  BranchLoadResult result;
  std::string proof;
};

PreparedBranchLoad prepared_of(const std::string& text) {
  ModelOptions options;
  options.motion = "m";
  return prepare_branch_load(read_request(text, options), 0, "", test::usual_options(), {});
}

CheckedLoad checked_load(const std::string& text) {
  CheckedLoad c{prepared_of(text), {}, {}};
  c.result = check_branch_load(c.prepared, {});
  if (!c.result.reason.empty()) return c;
  const test::TemporaryDirectory directory;
  const std::string path = (directory.path() / "certificate").string();
  const ProofStatus status = certify_load(path, c.prepared, c.result, {});
  EXPECT_TRUE(status.is_written()) << status.obstacle();
  std::ostringstream read;
  read << std::ifstream(path).rdbuf();
  c.proof = read.str();
  return c;
}

verifier::Outcome outcome_of(const std::string& proof, const std::string& model = "") {
  return test::verified(proof, model).outcome;
}

std::string with_other(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// Its proof is not one for other limits and another load, in the file or in the proof.
void expect_bound_to_its_data(const CheckedLoad& c, const std::string& text, bool is_feasible) {
  EXPECT_EQ(outcome_of(c.proof, text), verifier::Outcome::kVerified)
      << describe(test::verified(c.proof, text)) << c.proof.substr(0, 2000);
  const std::string force = text.substr(text.find("force = "), 12);
  for (const std::string& other :
       {with_other(text, "[-1, 3]", "[-1, 4]"), with_other(text, "3], 2]", "3], 1]"),
        with_other(text, force, "force = [\"1e3*" + force.substr(10))})
    EXPECT_EQ(outcome_of(c.proof, other), verifier::Outcome::kRejected) << other;
  if (!is_feasible) return;
  // The same tree does not show forces within less.
  const std::size_t at = c.proof.find("\nlimits ") + 8;
  const std::string limits = c.proof.substr(at, c.proof.find('\n', at) - at);
  EXPECT_NE(outcome_of(with_other(c.proof, limits, "0 : 1/1000")), verifier::Outcome::kVerified);
  EXPECT_NE(outcome_of(with_other(c.proof, "\nlimits " + limits, "")),
            verifier::Outcome::kVerified);
}

TEST(LoadsOverABranch, AreHeldWithinWhatVirtualWorkNeeds) {
  for (const LoadCase& c : load_cases(3, 4)) {
    SCOPED_TRACE(c.text);
    const Extremes seen = extremes_of(c);
    const double room = 0.05 * (seen.largest - seen.least) + 0.01;
    const std::string text = with_limits(c, seen.least - room, seen.largest + room);
    const CheckedLoad held = checked_load(text);
    EXPECT_EQ(held.result.verdict, FeasibilityVerdict::kFeasible) << held.result.reason;
    expect_bound_to_its_data(held, text, true);
  }
}

TEST(LoadsOverABranch, AreNotHeldBeyondALimit) {
  for (const LoadCase& c : load_cases(4, 4))
    for (const bool is_above : {true, false}) {
      SCOPED_TRACE(c.text);
      const Extremes seen = extremes_of(c);
      const double room = 0.05 * (seen.largest - seen.least) + 0.01;
      const double least = is_above ? seen.least - room : seen.least + room,
                   largest = is_above ? seen.largest - room : seen.largest + room;
      const std::string text = with_limits(c, least, largest);
      const CheckedLoad beyond = checked_load(text);
      ASSERT_EQ(beyond.result.verdict, FeasibilityVerdict::kInfeasible) << beyond.result.reason;
      const BranchShortage& shortage = *beyond.result.shortage;
      const double theta = mid(shortage.place[0]);
      EXPECT_GE(theta, c.from);
      EXPECT_LE(theta, c.to);
      const auto [lo, hi] = c.torque(theta);
      EXPECT_EQ(shortage.beyond.is_above, is_above);
      EXPECT_NEAR(mid(shortage.beyond.force), is_above ? hi : lo, 1e-6 * (1 + std::fabs(hi - lo)));
      EXPECT_TRUE(is_above ? hi > largest : lo < least);
      expect_bound_to_its_data(beyond, text, false);
    }
}

/// The torque over a ball of wrenches is that at its middle, and on both sides the radius times the length of (dx/dθ,
/// dφ/dθ). The report names the wrench of the ball that needs it.
TEST(LoadsOverABranch, TakeBallsToTheirFarthestWrench) {
  const SliderCrank slider{0.4, 1.5, 0.1};
  constexpr double kRadius = 0.7, kTo = 0.8;
  const auto [x, phi] = slider.speeds(kTo);
  const double needed = x + 2 * phi - kRadius * std::hypot(x, phi);  // the least, at the end
  const auto text = [&](double least) {
    return slider.text(0.5, 0.3, kTo) +
           fmt::format(
               "[actuators]\nforce = [\"{:.17g}\", 9]\nforce_unit = \"N m\"\n[load.L]\nwrench = {{ "
               "value = [1, 2], radius = 0.7 }}\n",
               least);
  };
  const CheckedLoad held = checked_load(text(needed - 0.01));
  EXPECT_EQ(held.result.verdict, FeasibilityVerdict::kFeasible) << held.result.reason;
  EXPECT_EQ(outcome_of(held.proof, text(needed - 0.01)), verifier::Outcome::kVerified);
  const CheckedLoad beyond = checked_load(text(needed + 0.01));
  ASSERT_EQ(beyond.result.verdict, FeasibilityVerdict::kInfeasible) << beyond.result.reason;
  EXPECT_EQ(outcome_of(beyond.proof, text(needed + 0.01)), verifier::Outcome::kVerified);

  Facts facts(Readers::kPrograms);
  tell_branch_load(beyond.prepared, beyond.result, nullptr, facts);
  const auto witness = facts.object().at("witness");
  EXPECT_EQ(witness.at("wrench_units"), (std::vector<std::string>{"N", "N m"}));
  double work = 0, squares = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const double w = witness.at("wrench")[i][0], direction = witness.at("direction")[i];
    work += w * direction;
    squares += (w - (i + 1.0)) * (w - (i + 1.0));
  }
  EXPECT_NEAR(std::sqrt(squares), kRadius, 1e-6);
  EXPECT_NEAR(work, witness.at("needed")[0], 1e-6);
  EXPECT_GT(work, double(witness.at("possible")[0]) + 1e-6);
}

/// Forces that are at a limit all the way are within it.
TEST(LoadsOverABranch, MayBeAtTheLimit) {
  const FourBar bar{0.2, 0.35355, 0.25, 0.45};
  const std::string text =
      bar.text(0, -1, 1) + "[actuators]\nforce = [0, 0]\n[load.L]\nwrench = [0, 0]\n";
  const CheckedLoad held = checked_load(text);
  EXPECT_EQ(held.result.verdict, FeasibilityVerdict::kFeasible) << held.result.reason;
  EXPECT_EQ(outcome_of(held.proof, text), verifier::Outcome::kVerified);
}

TEST(LoadsOverABranch, ArePossibleWhereTheBranchEnds) {
  const FourBar bar{0.2, 0.35355, 0.25, 0.45};
  const CheckedLoad open = checked_load(
      bar.text(0, -2.4, 2.4) + "[actuators]\nforce = [-1e9, 1e9]\n[load.L]\nwrench = [1, 1]\n");
  EXPECT_EQ(open.result.verdict, FeasibilityVerdict::kPossibleProblem);
  EXPECT_NE(open.result.reason.find("the branch ends"), std::string::npos);
}

/// Every box keeps what it says at its ends and in its middle.
TEST(LoadsOverABranch, PaveTheirMotion) {
  for (const LoadCase& c : load_cases(5, 4)) {
    SCOPED_TRACE(c.text);
    const Extremes seen = extremes_of(c);
    const double half = (seen.largest + seen.least) / 2;
    const double least = seen.least - 1, largest = half + 0.2 * (seen.largest - half);
    PreparedBranchLoad prepared = prepared_of(with_limits(c, least, largest));
    double feasible = 0, infeasible = 0, all = 0;
    const auto listener = [&](std::size_t, std::span<const Interval> box, ForceClaim claim) {
      const double width = box[0].hi - box[0].lo;
      all += width;
      for (const double theta : {box[0].lo, mid(box[0]), box[0].hi}) {
        const auto [lo, hi] = c.torque(theta);
        if (claim == ForceClaim::kFeasible) {
          EXPECT_LE(hi, largest + 1e-6);
          EXPECT_GE(lo, least - 1e-6);
        } else if (claim == ForceClaim::kInfeasible) {
          EXPECT_GE(hi, largest - 1e-6);
        }
      }
      feasible += claim == ForceClaim::kFeasible ? width : 0;
      infeasible += claim == ForceClaim::kInfeasible ? width : 0;
    };
    const BranchLoadResult paved = pave_branch_load(prepared, 0x1p-10, {}, listener, nullptr);
    EXPECT_EQ(paved.verdict, FeasibilityVerdict::kInfeasible) << paved.reason;
    EXPECT_NEAR(all, c.to - c.from, 1e-9);
    EXPECT_GT(feasible + infeasible, 0.97 * all);
    EXPECT_GT(infeasible, 0);
  }
}

/// A box that is one place is as narrow as a tube there.
TEST(LoadsOverABranch, PaveOnePlace) {
  const FourBar bar{0.2, 0.35355, 0.25, 0.45};
  constexpr double kPlace = 0.3;
  const LoadCase c{bar.text(kPlace, kPlace, kPlace), kPlace, kPlace, kPlace, test::torque_of(bar)};
  const auto torque = c.torque(kPlace);
  const double least = torque.first, largest = torque.second;
  const auto paved = [&](double limit, ForceClaim expected) {
    PreparedBranchLoad prepared = prepared_of(with_limits(c, least - 1, limit));
    const auto listener = [&](std::size_t, std::span<const Interval>, ForceClaim claim) {
      EXPECT_EQ(claim, expected);
    };
    return pave_branch_load(prepared, 0x1p-10, {}, listener, nullptr).verdict;
  };
  EXPECT_EQ(paved(largest + 1e-3, ForceClaim::kFeasible), FeasibilityVerdict::kFeasible);
  EXPECT_EQ(paved(largest - 1e-3, ForceClaim::kInfeasible), FeasibilityVerdict::kInfeasible);
}

}  // namespace
}  // namespace regulus::detail
