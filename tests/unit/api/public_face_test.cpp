// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the interface for C++ programs, using its single header only.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "codegen/use/api/regulus.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/unit/api/circle.hpp"

namespace {

using regulus::Claim;
using regulus::Interval;
using regulus::Question;
using regulus::Verdict;
using regulus::detail::test::circle;
using regulus::detail::test::interpreted;
using testing::HasSubstr;
using testing::Not;

TEST(PublicFace, AnswersForAFileAsForTheRobotThatItDescribes) {
  const Question file = Question::of_file(REGULUS_SOURCE_DIR "/models/planar_3rpr.toml", "regular");
  EXPECT_EQ(regulus::check(file, interpreted()).verdict, Verdict::kNoSingularity);
  EXPECT_THROW(static_cast<void>(regulus::check(Question::of_file("/no/such/file"))),
               regulus::FileError);
}

TEST(PublicFace, CopiesOfAQuestionAreChangedApart) {
  const Question asked(circle(), "outside");
  Question changed = asked;
  changed.tolerance("platform", "2");
  EXPECT_EQ(regulus::check(asked, interpreted()).verdict, Verdict::kNoSingularity);
  EXPECT_EQ(regulus::check(changed, interpreted()).verdict, Verdict::kSingularity);
}

/// What the file says beside the place is neither lost nor taken for zero.
TEST(PublicFace, SolutionsLeaveNoToleranceOut) {
  const regulus::SolveOptions at{
      .search = {}, .at = {"x=0", "y=0", "z=47", "psi=0.1", "theta=0.05", "phi=0.02"}, .hold = {}};
  Question robot = Question::of_file(REGULUS_SOURCE_DIR "/models/robot_1.toml");
  Question arm = Question::of_file(REGULUS_SOURCE_DIR "/models/puma_560_serial.toml");
  const regulus::SolveOptions joints{
      .search = {},
      .at = {"q1=0.3", "q2=0.4", "q3=-0.7", "q4=0.3", "q5=0.9", "q6=-1.4"},
      .hold = {}};
  const char* const kLeftOut = "with every tolerance and control error at 0, ";
  EXPECT_THAT(regulus::solve(robot, at).report, Not(HasSubstr(kLeftOut)));
  EXPECT_THAT(regulus::solve(robot.tolerance("base", "1e-7"), at).report, Not(HasSubstr(kLeftOut)));
  EXPECT_THAT(regulus::solve(arm.tolerance("links", "1e-6"), joints).report,
              Not(HasSubstr(kLeftOut)));
  Question swept = Question::of_file(REGULUS_SOURCE_DIR "/models/puma_560_serial.toml", "sweep");
  const std::string errors =
      regulus::solve(swept, {.search = {}, .at = {"T=0.25"}, .hold = {}}).report;
  EXPECT_THAT(errors, Not(HasSubstr(kLeftOut)));
  EXPECT_THAT(errors, HasSubstr("q5_error in ["));
}

TEST(PublicFace, SolutionsOfAMotionWithConstraintsAreRefused) {
  const auto circle_with = [](const std::string& line) {
    return Question::of_text(
        "regulus = 1\nname = \"circle\"\n[pose]\nx = \"m\"\n[closure]\nunknowns = { y = \"m\" }\n"
        "equations = [\"x^2 + y^2 - 25\"]\nstart = { x = 3, y = 4 }\nrange = { y = [-9, 9] }\n"
        "[motion.point]\nx = 3\n" +
            line,
        "circle.toml", "point");
  };
  EXPECT_EQ(regulus::solve(circle_with("")).solutions.found.size(), 2U);
  EXPECT_THROW(static_cast<void>(regulus::solve(circle_with("constraints = [\"x - 4\"]\n"))),
               regulus::UsageError);
}

TEST(PublicFace, BoundsAQuantity) {
  regulus::BoundOptions options;
  options.search.engine = regulus::Engine::kInterpreted;
  options.quantity.quantity = "x + y";
  const regulus::BoundFinding finding = regulus::bound(Question(circle(), "outside"), options);
  ASSERT_TRUE(finding.attained && finding.proved) << finding.report;
  EXPECT_LE(*finding.attained, 6);
  EXPECT_GE(*finding.proved, 6);
  options.limit = "7";
  EXPECT_EQ(regulus::bound(Question(circle(), "outside"), options).verdict,
            regulus::BoundVerdict::kWithin);
}

TEST(PublicFace, WritesACertificateThatItVerifies) {
  const regulus::detail::test::TemporaryDirectory folder;
  const std::string path = folder.path() / "proof.txt";
  const regulus::Finding finding =
      regulus::check(Question(circle(), "outside"), interpreted(), nullptr, path);
  EXPECT_EQ(finding.certificate, path);
  EXPECT_EQ(regulus::verify(path).outcome, regulus::ProofOutcome::kVerified);
}

/// The straight line between the way-points crosses the circle; its ends do not.
TEST(PublicFace, ChecksEverySegmentBetweenWayPoints) {
  const regulus::detail::test::TemporaryDirectory folder;
  const std::string way = folder.path() / "way.csv";
  std::ofstream(way) << "x,y\n2,2\n-2,-2\n";
  const Question along = Question(circle(), "outside").waypoints(way);
  const regulus::Finding finding = regulus::check(along, interpreted());
  EXPECT_EQ(finding.verdict, Verdict::kSingularity) << finding.report;
  EXPECT_THROW(static_cast<void>(regulus::PreparedQuestion(along, interpreted())),
               regulus::UsageError);
}

TEST(PublicFace, AnInterruptThatCameBeforeLeavesNoVerdict) {
  const std::atomic<bool> interrupt{true};
  const regulus::Finding finding =
      regulus::check(Question(circle(), "outside"), interpreted(), &interrupt);
  EXPECT_EQ(finding.verdict, Verdict::kPossibleProblem);
}

TEST(PublicFace, LocateHandsOnEveryBoxOfThePaving) {
  double area[regulus::kClaims] = {};
  regulus::LocateOptions options{.search = interpreted(), .resolution = "1/64"};
  options.on_box = [&area](Claim claim, std::span<const Interval> box) {
    area[static_cast<std::size_t>(claim)] += (box[0].hi - box[0].lo) * (box[1].hi - box[1].lo);
  };
  const regulus::Paving paving = regulus::locate(Question(circle(), "across"), options);
  EXPECT_EQ(paving.verdict, Verdict::kSingularity);
  EXPECT_EQ(paving.variables, (std::vector<std::string>{"x", "y"}));
  const auto part = [&area](Claim claim) { return area[static_cast<std::size_t>(claim)] / 36; };
  EXPECT_NEAR(part(Claim::kFree) + part(Claim::kSingular) + part(Claim::kUndecided), 1, 1e-12);
  EXPECT_TRUE(paving.free.lo <= part(Claim::kFree) + 1e-12 &&
              part(Claim::kFree) <= paving.free.hi + 1e-12);
  EXPECT_GT(paving.free.lo, 0.8);
  EXPECT_GT(paving.singular.lo, 0.0);
}

TEST(PublicFace, WhatABoxCallbackThrowsEndsThePaving) {
  int calls = 0;
  regulus::LocateOptions options{.search = interpreted(), .resolution = "1/64"};
  options.on_box = [&calls](Claim, std::span<const Interval>) {
    ++calls;
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(static_cast<void>(regulus::locate(Question(circle(), "across"), options)),
               std::runtime_error);
  EXPECT_EQ(calls, 1);
}

/// The circle of radius h meets [2, 3]² from h = √8 on.
TEST(PublicFace, MarginBracketsTheToleranceThatIsSafe) {
  regulus::MarginOptions options;
  options.search.engine = regulus::Engine::kInterpreted;
  options.tolerance = "platform=0:4";
  const regulus::MarginFinding finding = regulus::margin(Question(circle(), "outside"), options);
  ASSERT_TRUE(finding.safe && finding.singular) << finding.report;
  EXPECT_TRUE(finding.closed);
  const double critical = std::sqrt(8.0) - 1;
  EXPECT_LE(std::stod(*finding.safe), critical);
  EXPECT_GE(std::stod(*finding.singular), critical);
  EXPECT_LE(std::stod(*finding.singular) - std::stod(*finding.safe), 0.02 * critical);
  EXPECT_THAT(finding.bracket, testing::StartsWith("SAFE UP TO "));
  EXPECT_THROW(static_cast<void>(regulus::margin(Question(circle(), "outside"), {})),
               regulus::UsageError);
}

/// |det| = x² + y² − 1 is above 4 where x and y are above √2.5.
TEST(PublicFace, MarginBracketsTheSizeWithinALimit) {
  regulus::MarginOptions options;
  options.search.engine = regulus::Engine::kInterpreted;
  options.scale = "0:4";
  options.quantity.quantity = "determinant";
  EXPECT_THROW(static_cast<void>(regulus::margin(Question(circle(), "outside"), options)),
               regulus::UsageError);
  options.limit = "4";
  const regulus::MarginFinding finding = regulus::margin(Question(circle(), "outside"), options);
  ASSERT_TRUE(finding.safe && finding.exceeded && !finding.singular) << finding.report;
  const double critical = 5 - 2 * std::sqrt(2.5);
  EXPECT_LE(std::stod(*finding.safe), critical);
  EXPECT_GE(std::stod(*finding.exceeded), critical);
  EXPECT_TRUE(finding.closed);
  EXPECT_THAT(finding.bracket, testing::StartsWith("WITHIN UP TO "));
}

TEST(PublicFace, AKernelDecidesPiecesOfTheMotion) {
  regulus::KernelOptions options;
  options.engine = regulus::Engine::kInterpreted;
  regulus::Kernel made(Question(circle(), "across").tolerance("platform", "1/4"), options);
  const regulus::Kernel kernel = std::move(made);
  EXPECT_EQ(kernel.variables(), (std::vector<std::string>{"x", "y", "h"}));
  EXPECT_EQ(kernel.motion_parameters(), 2U);
  EXPECT_EQ(kernel.ranges()[2].lo, 0.75);
  EXPECT_EQ(kernel.ranges()[2].hi, 1.25);
  regulus::Checker checker = kernel.checker(1024);
  const auto verdict = [&checker](Interval x, Interval y) {
    return checker.check(std::vector<Interval>{x, y}).verdict;
  };
  EXPECT_EQ(verdict({1.5, 2.0}, {0.0, 1.0}), Verdict::kNoSingularity);
  EXPECT_EQ(verdict({0.0, 2.0}, {0.0, 1.0}), Verdict::kSingularity);
  EXPECT_EQ(verdict({2.0, 4.0}, {0.0, 1.0}), Verdict::kPossibleProblem) << "outside of the motion";
}

/// The checks use the threshold of the question: |det| > 2 where x² + y² > 3.
TEST(PublicFace, AKernelHasTheThresholdOfTheQuestion) {
  regulus::KernelOptions options;
  options.engine = regulus::Engine::kInterpreted;
  const regulus::Kernel kernel(Question(circle(), "across").alpha("2"), options);
  regulus::Checker checker = kernel.checker(1024);
  EXPECT_EQ(checker.check(std::vector<Interval>{{1.8, 2.0}, {0.0, 1.0}}).verdict,
            Verdict::kNoSingularity);
  EXPECT_EQ(checker.check(std::vector<Interval>{{1.5, 1.6}, {0.0, 0.1}}).verdict,
            Verdict::kSingularity);
}

/// `regulus check` finds this singularity after one box, at corners of the variety.
TEST(PublicFace, ACheckerLooksForASingularityAtCornersOfThePiece) {
  const regulus::Kernel kernel(
      Question::of_file(REGULUS_SOURCE_DIR "/models/robot_2.toml", "table5_40"),
      {.engine = regulus::Engine::kInterpreted});
  regulus::Checker checker = kernel.checker(1000);
  std::vector<Interval> piece(kernel.ranges().begin(),
                              kernel.ranges().begin() + std::ptrdiff_t(kernel.motion_parameters()));
  const regulus::Check whole = checker.check(piece);
  EXPECT_EQ(whole.verdict, Verdict::kSingularity);
  EXPECT_LE(whole.boxes, 16U);
  // Another piece: the witness lies in it, and not in the one before.
  piece[0] = Interval(regulus::mid(piece[0]), piece[0].hi);
  const regulus::Check half = checker.check(piece);
  ASSERT_EQ(half.verdict, Verdict::kSingularity);
  const std::size_t variables = kernel.ranges().size();
  for (std::size_t p = 0; p < half.places.size() / variables; ++p)
    for (std::size_t k = 0; k < piece.size(); ++k)
      EXPECT_TRUE(regulus::certain_subset(half.places[p * variables + k], piece[k]));
}

/// A bead on a rail between two pulleys is held where |x| ≤ 0.6.
Question bead() {
  return Question::of_text(R"toml(regulus = 1
name = "bead"
[pose]
x = "m"
[matrix]
twist = ["v_x"]
rows = [["x + 1"], ["x - 1"]]
[load.push]
force = [[-2, 2]]
[actuators]
force = [1, 9]
[motion.m]
x = [-0.5, 0.5]
)toml",
                           "bead");
}

TEST(PublicFace, ProvesThatForcesHoldALoad) {
  const regulus::detail::test::TemporaryDirectory folder;
  const std::string proof = folder.path() / "proof";
  const regulus::LoadFinding found =
      regulus::check_load(bead(), "push", interpreted(), nullptr, proof);
  EXPECT_EQ(found.verdict, regulus::FeasibilityVerdict::kFeasible) << found.report;
  EXPECT_EQ(found.variables, std::vector<std::string>{"x"});
  EXPECT_EQ(found.certificate, proof);
  EXPECT_EQ(regulus::verify(proof).outcome, regulus::ProofOutcome::kVerified);
  const regulus::LoadFinding other =
      regulus::check_load(bead().range("x", "-0.7", "0.7"), "", interpreted());
  EXPECT_EQ(other.verdict, regulus::FeasibilityVerdict::kInfeasible) << other.report;
  EXPECT_THAT(other.json, HasSubstr("\"witness\""));
}

/// At x the forces give at most 10x + 8 and at least 10x − 8, and the load is within ±2.
TEST(PublicFace, BoundsAndHoldsALoadAlongWayPoints) {
  const regulus::detail::test::TemporaryDirectory folder;
  const std::string way = folder.path() / "way.csv", proof = folder.path() / "proof";
  std::ofstream(way) << "t,x\n0,-0.5\n1,0.25\n2,0.5\n";
  const regulus::LoadFinding held =
      regulus::check_load(bead().waypoints(way), "push", interpreted(), nullptr, proof);
  EXPECT_EQ(held.verdict, regulus::FeasibilityVerdict::kFeasible) << held.report;
  EXPECT_EQ(regulus::verify(proof).outcome, regulus::ProofOutcome::kVerified);
  regulus::BoundOptions options;
  options.quantity.quantity = "x";
  options.search = interpreted();
  options.search.time_limit = 60;
  const regulus::BoundFinding most = regulus::bound(bead().waypoints(way), options);
  ASSERT_TRUE(most.proved) << most.report;
  EXPECT_GE(*most.proved, 0.5);
  EXPECT_LE(*most.proved, 0.51);
  std::ofstream(way) << "t,x\n0,-0.5\n1,0.25\n2,0.75\n";
  const regulus::LoadFinding lost = regulus::check_load(bead().waypoints(way), "", interpreted());
  EXPECT_EQ(lost.verdict, regulus::FeasibilityVerdict::kInfeasible) << lost.report;
  EXPECT_THAT(lost.report, HasSubstr("segment 2, t = "));
}

TEST(PublicFace, PavesAMotionUnderALoad) {
  double held = 0;
  regulus::LocateLoadOptions options{.search = interpreted(), .resolution = "1/256"};
  options.on_box = [&](regulus::ForceClaim claim, std::span<const Interval> box) {
    if (claim == regulus::ForceClaim::kFeasible) held += box[0].hi - box[0].lo;
  };
  const regulus::LoadPaving paving = regulus::locate_load(bead().range("x", "-1", "1"), options);
  EXPECT_LE(held, 1.2);
  EXPECT_GE(held, 1.15);
  EXPECT_LE(paving.feasible.lo, 0.6);
  EXPECT_NEAR(paving.feasible.lo, held / 2, 1e-9);
  options.on_box = [](regulus::ForceClaim, std::span<const Interval>) {
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(static_cast<void>(regulus::locate_load(bead(), options)), std::runtime_error);
}

}  // namespace
