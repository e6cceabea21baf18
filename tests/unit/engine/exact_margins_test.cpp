// SPDX-License-Identifier: GPL-3.0-or-later
// Tests margins and singularities that bounds of the entries cannot show: other forms of the
// determinant, constraints that share its terms, and ends of ranges that are not doubles show them.
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/question/engine/algebra_oracle.hpp"
#include "codegen/question/engine/closed_form_bounds.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::exact_margins {
namespace {

/// Makes the matrix [[1, y], [x, x·y + e]], whose determinant is e.
std::string around(const std::string& e, const std::string& ranges, const std::string& rest = "") {
  return "regulus = 1\nname = \"two\"\nsource = \"a test\"\n[pose]\nx = \"1\"\ny = \"1\"\n" + rest +
         "[matrix]\nrows = [[\"1\", \"y\"], [\"x\", \"x*y + " + e + "\"]]\n[motion.box]\n" + ranges;
}

SearchOptions short_search() {
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  search.max_boxes = 20000;
  return search;
}

PreparedSearch prepared(const std::string& text) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() / "model.toml";
  std::ofstream(path) << text;
  ModelOptions model;
  model.path = path;
  return prepare(model, short_search());
}

Result checked(const std::string& text) {
  const SearchOptions search = short_search();
  PreparedSearch preparation = prepared(text);
  return run_search(preparation, search, settings_from(search));
}

const char* const kPositive = "x = [0.1, 0.8]\ny = [0.1, 0.5]\n";

TEST(AMargin, IsSeenThroughASquareAndAnIdentity) {
  for (const char* zero : {"(x - y - 0.2)^2", "sqrt(x)*sqrt(y) - sqrt(x*y)",
                           "log(x*y) - log(x) - log(y)", "tan(x)*cos(x) - sin(x)"}) {
    const std::string e = zero;
    EXPECT_EQ(checked(around("(" + e + " + 1e-14)", kPositive)).verdict, Verdict::kNoSingularity)
        << e;
    EXPECT_NE(checked(around("(" + e + ")", kPositive)).verdict, Verdict::kNoSingularity) << e;
  }
}

TEST(ARelation, IsNotUsedWhereItsPartsHaveNoValue) {
  const char* const negative = "x = [-0.8, -0.1]\ny = [-0.5, -0.1]\n";
  EXPECT_EQ(checked(around("sqrt(x*y)", negative)).verdict, Verdict::kNoSingularity);
  EXPECT_NE(checked(around("(sqrt(x*y) + 0*sqrt(x))", negative)).verdict, Verdict::kNoSingularity);
}

TEST(AJumpBetweenSigns, IsClosedInOn) {
  const Result result =
      checked(around("(x - 0.3123)^3/abs(x - 0.3123)^3", "x = [0.1, 0.8]\ny = 0.3\n"));
  EXPECT_EQ(result.verdict, Verdict::kPossibleProblem);
  EXPECT_FALSE(result.stopped_by);
}

std::string beside_a_hole(const std::string& e) {
  return around(e, "x = [-1, 1]\ny = [-1, 1]\nconstraints = [\"1/4 - x^2 - y^2\"]\n");
}

TEST(AConstraint, GivesAMarginWhereItHasTermsOfTheDeterminant) {
  EXPECT_EQ(checked(beside_a_hole("(x^2 + y^2 - 1/4 + 1e-14)")).verdict, Verdict::kNoSingularity);
  EXPECT_EQ(checked(beside_a_hole("(1/4 - x^2 - y^2 - 1e-14)")).verdict, Verdict::kNoSingularity);
}

TEST(AConstraint, GivesNoMarginOnItsOtherSide) {
  EXPECT_NE(checked(beside_a_hole("(x^2 + y^2 - 1/4)")).verdict, Verdict::kNoSingularity);
  EXPECT_NE(checked(beside_a_hole("(x^2 + y^2 - 1/4 - 1e-14)")).verdict, Verdict::kNoSingularity);
  EXPECT_NE(checked(beside_a_hole("(1/4 - x^2 - y^2 + 1e-14)")).verdict, Verdict::kNoSingularity);
}

/// det at (0.6, 0), a point beside the hole, lies within the bounds of a box that contains it.
TEST(AConstraint, LeavesTheDeterminantWithinItsBounds) {
  for (const double sign : {1.0, -1.0}) {
    const PreparedSearch search = prepared(
        beside_a_hole(sign > 0 ? "(x^2 + y^2 - 1/4 - 1e-14)" : "(1/4 - x^2 - y^2 + 1e-14)"));
    ClosedFormBounds bounds(*search.stages);
    bounds.make();
    const std::vector<Interval> box = {{0.5, 0.6}, {0.0, 0.1}};
    const std::optional<Interval> determinant = bounds.enclose(box);
    ASSERT_TRUE(determinant);
    EXPECT_LE(determinant->lo, sign * 0.109);
    EXPECT_GE(determinant->hi, sign * 0.109);
  }
}

TEST(AnEndThatIsNoDouble, IsAWitness) {
  const Result rational = checked(around("(3*x - 1)^3", "x = [\"1/3\", 1]\ny = [0, 1]\n"));
  ASSERT_EQ(rational.verdict, Verdict::kSingularity);
  EXPECT_EQ(rational.reason, Reason::kSmallDeterminant);
  ASSERT_EQ(rational.witness->points.front().places.size(), 2U);
  EXPECT_EQ(rational.witness->points.front().places.front(), PlaceInRange::kLowerEnd);
  const Interval end = rational.witness->points.front().variables.front();
  EXPECT_LT(end.lo, end.hi);
  EXPECT_EQ(checked(around("(sqrt(5) - y)", "x = [0, 1]\ny = [1, \"sqrt(5)\"]\n")).verdict,
            Verdict::kSingularity);
}

TEST(AnEndThatIsNoDouble, IsNoWitnessWithAMargin) {
  EXPECT_NE(checked(around("(3*x - 1 + 1e-300)", "x = [\"1/3\", 1]\ny = [0, 1]\n")).verdict,
            Verdict::kSingularity);
  EXPECT_NE(checked(around("(3*x - 1)",
                           "x = [\"1/3\", 1]\ny = [0, 1]\n"
                           "constraints = [\"0.34 - x\"]\n"))
                .verdict,
            Verdict::kSingularity);
}

TEST(AnEndThatMarginHasMoved, IsNotTakenForTheOneThatIsWritten) {
  PreparedSearch p = prepared(around("(3*x - 1)", "x = [\"1/3\", 1]\ny = [0, 1]\n"));
  ExactAlgebra algebra(p);
  const std::vector<Interval> point = {{p.variety.outer[0].lo, p.variety.inner[0]->lo}, {0.5, 0.5}};
  const std::vector<PlaceInRange> places = {PlaceInRange::kLowerEnd, PlaceInRange::kInside};
  EXPECT_TRUE(algebra.is_singular_at(point, places));
  p.is_replanned = true;
  EXPECT_FALSE(algebra.is_singular_at(point, places));
}

/// The corner of the box around a ball is not in the ball.
TEST(AnEndOfAnAxisOfABall, IsNoWitness) {
  const std::string geometry = "[geometry]\nc = { value = [1, 2], radius = \"1/3\" }\n";
  const std::string ranges = "x = [0, 1]\ny = [0, 1]\n";
  EXPECT_NE(checked(around("(c_1 + c_2 - 7/3)", ranges, geometry)).verdict, Verdict::kSingularity);
  EXPECT_NE(checked(around("(c_1 + c_2 - 11/3)", ranges, geometry)).verdict, Verdict::kSingularity);
}

}  // namespace
}  // namespace regulus::detail::exact_margins
