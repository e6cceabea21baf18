// SPDX-License-Identifier: GPL-3.0-or-later
// Stretches of a way on which a load is held: compared with statics by virtual work in closed
// form, with the same motion over ranges, and with the same way in other pieces.
#include <gtest/gtest.h>

#include <cmath>

#include "codegen/question/closure/branch_load.hpp"
#include "codegen/question/closure/closure_way_paving.hpp"
#include "tests/property/closure/checked_ways.hpp"
#include "tests/property/closure/loaded_linkages.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

constexpr double kFineness = 0x1p-8;

struct Part {
  double from, to;  ///< of the crank's angle, in the direction of the way
  ForceClaim claim;
};

struct PavedWay {
  std::vector<Part> parts;
  FeasibilityVerdict verdict = FeasibilityVerdict::kPossibleProblem;
  std::string reason;
  std::optional<double> shortage;  ///< the angle

  [[nodiscard]] double length(ForceClaim claim) const {
    double sum = 0;
    for (const Part& part : parts) sum += part.claim == claim ? std::fabs(part.to - part.from) : 0;
    return sum;
  }
  [[nodiscard]] double length() const {
    double sum = 0;
    for (const Part& part : parts) sum += std::fabs(part.to - part.from);
    return sum;
  }
};

PavedWay paved(const std::string& model, const std::vector<double>& places,
               double resolution = kFineness) {
  const WayFile file(table_of(places));
  ModelOptions options;
  options.motion = "m";
  options.waypoints = file.path();
  PreparedBranchLoad prepared =
      prepare_branch_load(read_request(model, options), 0, "", usual_options(), {});
  PavedWay way;
  const BranchLoadResult result = pave_branch_load(
      prepared, resolution, {},
      [&](std::size_t piece, std::span<const Interval> box, ForceClaim claim) {
        const double begin = places.at(piece), step = places.at(piece + 1) - begin;
        way.parts.push_back({begin + step * box[0].lo, begin + step * box[0].hi, claim});
      },
      nullptr);
  way.verdict = result.verdict;
  way.reason = result.reason;
  if (result.shortage) {
    const std::size_t k = result.shortage->piece;
    way.shortage = places[k] + mid(result.shortage->place[0]) * (places[k + 1] - places[k]);
  }
  return way;
}

/// Returns the parts over the range of the model.
std::vector<Part> paved_range(const std::string& model) {
  ModelOptions options;
  options.motion = "m";
  PreparedBranchLoad prepared =
      prepare_branch_load(read_request(model, options), 0, "", usual_options(), {});
  std::vector<Part> parts;
  static_cast<void>(pave_branch_load(
      prepared, kFineness, {},
      [&](std::size_t, std::span<const Interval> box, ForceClaim claim) {
        parts.push_back({box[0].lo, box[0].hi, claim});
      },
      nullptr));
  return parts;
}

/// Limits that the motor keeps in a part of the motion alone.
struct Limits {
  double least, largest;
};
Limits within(const LoadCase& c) {
  double least = INFINITY, low = INFINITY, high = -INFINITY;
  for (int i = 0; i <= 1000; ++i) {
    const auto [lo, hi] = c.torque(c.from + (c.to - c.from) * i / 1000);
    least = std::fmin(least, lo), low = std::fmin(low, hi), high = std::fmax(high, hi);
  }
  return {least - 1, (low + high) / 2};
}

/// A way that stays in the range, and turns there.
std::vector<double> way_in(const LoadCase& c) {
  const double width = c.to - c.from;
  return {c.start, c.to - 0.02 * width, c.from + 0.01 * width, c.start + 0.1 * width};
}

void expect_claims_of_closed_form(const std::vector<Part>& parts, const Torque& torque,
                                  const Limits& limits) {
  constexpr int kSamples = 8;
  for (const Part& part : parts)
    for (int i = 0; i <= kSamples; ++i) {
      const double theta = part.from + (part.to - part.from) * i / kSamples;
      const auto [lo, hi] = torque(theta);
      const double beyond = std::fmax(limits.least - lo, hi - limits.largest);
      EXPECT_TRUE(part.claim != ForceClaim::kFeasible || beyond <= 1e-6) << theta;
      EXPECT_TRUE(part.claim != ForceClaim::kInfeasible || beyond >= -1e-6) << theta;
      EXPECT_NE(part.claim, ForceClaim::kOutside);
    }
}

/// No angle may be held along one motion and not along another.
void expect_no_contradiction(const std::vector<Part>& a, const std::vector<Part>& b) {
  const auto are_apart = [](const Part& x, const Part& y) {
    return std::fmax(std::fmin(x.from, x.to), std::fmin(y.from, y.to)) >=
           std::fmin(std::fmax(x.from, x.to), std::fmax(y.from, y.to));
  };
  for (const Part& x : a)
    for (const Part& y : b)
      EXPECT_TRUE(x.claim == y.claim || x.claim == ForceClaim::kUndecided ||
                  y.claim == ForceClaim::kUndecided || are_apart(x, y))
          << x.from << ' ' << x.to << ' ' << y.from << ' ' << y.to;
}

TEST(ALoadOnAWay, IsHeldWhereVirtualWorkSaysSo) {
  for (const LoadCase& c : load_cases(31, std::size_t(trials(6, 30)))) {
    const Limits limits = within(c);
    const std::string model = with_limits(c, limits.least, limits.largest);
    const std::vector<double> places = way_in(c);
    SCOPED_TRACE(model + table_of(places));
    const PavedWay way = paved(model, places);
    double length = 0;
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
      length += std::fabs(places[k + 1] - places[k]);
    EXPECT_NEAR(way.length(), length, 1e-9);
    EXPECT_GT(way.length(ForceClaim::kFeasible) + way.length(ForceClaim::kInfeasible),
              0.8 * length);
    EXPECT_GT(way.length(ForceClaim::kFeasible), 0);
    EXPECT_GT(way.length(ForceClaim::kInfeasible), 0);
    expect_claims_of_closed_form(way.parts, c.torque, limits);
    EXPECT_EQ(way.verdict, FeasibilityVerdict::kInfeasible) << way.reason;
    ASSERT_TRUE(way.shortage);
    const auto [lo, hi] = c.torque(*way.shortage);
    EXPECT_TRUE(lo < limits.least || hi > limits.largest);
  }
}

TEST(ALoadOnAWay, IsHeldAsOverTheRange) {
  for (const LoadCase& c : load_cases(32, std::size_t(trials(4, 20)))) {
    const Limits limits = within(c);
    const std::string model = with_limits(c, limits.least, limits.largest);
    SCOPED_TRACE(model);
    expect_no_contradiction(paved(model, way_in(c)).parts, paved_range(model));
  }
}

TEST(ALoadOnAWay, DoesNotDependOnThePiecesOrTheDirection) {
  for (const LoadCase& c : load_cases(33, std::size_t(trials(4, 20)))) {
    const Limits limits = within(c);
    const std::string model = with_limits(c, limits.least, limits.largest);
    SCOPED_TRACE(model);
    const double width = c.to - c.from, high = c.to - 0.02 * width, low = c.from + 0.03 * width;
    const PavedWay way = paved(model, {c.start, high, low, c.start});
    const PavedWay reversed = paved(model, {c.start, low, high, c.start});
    const PavedWay divided =
        paved(model, {c.start, (2 * c.start + high) / 3, high, (high + low) / 2, low, c.start});
    for (const PavedWay* other : {&reversed, &divided}) {
      expect_no_contradiction(way.parts, other->parts);
      EXPECT_EQ(other->verdict, way.verdict);
      for (const ForceClaim claim : {ForceClaim::kFeasible, ForceClaim::kInfeasible})
        EXPECT_NEAR(other->length(claim), way.length(claim), 0.1 * way.length());
    }
  }
}

TEST(ALoadOnAWay, IsFeasibleWithinWideLimits) {
  const LoadCase c = load_cases(34, 1).front();
  const PavedWay way = paved(with_limits(c, -1e6, 1e6), way_in(c));
  EXPECT_EQ(way.verdict, FeasibilityVerdict::kFeasible) << way.reason;
  EXPECT_EQ(way.length(ForceClaim::kFeasible), way.length());
}

/// Beyond its first toggle nothing is known, on later segments, too.
TEST(ALoadOnAWay, IsUndecidedWhereTheBranchHasEnded) {
  const FourBar bar{0.2, 0.35355, 0.25, 0.45};
  const double toggle =
      std::acos((bar.a * bar.a + bar.d * bar.d - std::pow(bar.b + bar.c, 2)) / (2 * bar.a * bar.d));
  const std::string model =
      bar.text(0, -1, 1) + "[actuators]\nforce = [-1e9, 1e9]\n[load.L]\nwrench = [1, 1]\n";
  const std::vector<double> places{0, 1, -2, toggle + 0.3, 0, 1};
  const PavedWay way = paved(model, places);
  EXPECT_EQ(way.verdict, FeasibilityVerdict::kPossibleProblem);
  EXPECT_NE(way.reason.find("the branch ends"), std::string::npos) << way.reason;
  double feasible = 0;
  for (const Part& part : way.parts) {
    EXPECT_TRUE(std::fmax(part.from, part.to) <= toggle || part.claim == ForceClaim::kUndecided)
        << part.from;
    if (part.claim == ForceClaim::kFeasible) feasible += std::fabs(part.to - part.from);
  }
  EXPECT_GT(feasible, 1 + 3 + 2 + 0.95 * toggle);
  EXPECT_LE(feasible, 1 + 3 + 2 + toggle);
}

/// A decision about bars with tolerances holds for the longest and the shortest of them.
TEST(ALoadOnAWay, IsHeldForAllLengths) {
  constexpr double kTolerance = 2e-3;
  const FourBar bar{0.2, 0.35355, 0.25, 0.45};
  const std::string model = bar.text(0, -1, 1, kTolerance) +
                            "[actuators]\nforce = [-2, 2]\n[load.L]\nwrench = [[-1, 3], 2]\n";
  const PavedWay way = paved(model, {0, 1.2, -1.5});
  EXPECT_GT(way.length(ForceClaim::kFeasible), 0.5);
  EXPECT_GT(way.length(ForceClaim::kInfeasible), 0.5);
  for (const double a : {-kTolerance, 0.0, kTolerance})
    for (const double b : {-kTolerance, 0.0, kTolerance})
      expect_claims_of_closed_form(way.parts, torque_of({bar.a + a, bar.b + b, bar.c, bar.d}),
                                   {-2, 2});
}

/// Control errors move the crank away from the way.
TEST(ALoadOnAWay, IsHeldForAllErrors) {
  constexpr double kError = 0.05;
  const FourBar bar{0.2, 0.35355, 0.25, 0.45};
  const std::string model = bar.text(0, -1, 1) +
                            "error = { theta = 0.05 }\n[actuators]\nforce = [-2, 2]\n[load.L]\n" +
                            "wrench = [[-1, 3], 2]\n";
  const PavedWay way = paved(model, {0, 1.2, -1.5});
  EXPECT_GT(way.length(ForceClaim::kFeasible), 0.3);
  EXPECT_GT(way.length(ForceClaim::kInfeasible), 0.3);
  for (const double error : {-kError, 0.0, kError})
    expect_claims_of_closed_form(
        way.parts, [error, torque = torque_of(bar)](double theta) { return torque(theta + error); },
        {-2, 2});
}

}  // namespace
}  // namespace regulus::detail::test
