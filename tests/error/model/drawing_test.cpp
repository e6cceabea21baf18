// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/error/model/refusal.hpp"

namespace regulus::detail {
namespace {

using test::changed;
using test::expect_refused;

const std::string kDrawn =
    "regulus = 1\n"
    "name = \"drawn\"\n"
    "[pose]\n"
    "x = \"1\"\n"
    "[matrix]\n"
    "rows = [[\"x\"]]\n"
    "[drawing]\n"
    "points = { A = [0, 0], B = [\"x\", 1] }\n"
    "legs = [[\"A\", \"B\"]]\n"
    "[motion.far]\n"
    "x = [1, 2]\n";

void expect_refused_drawing(const std::string& from, const std::string& to, int line,
                            const std::string& found, const std::string& expected) {
  expect_refused(changed(kDrawn, from, to), line, found, expected);
}

TEST(DrawingRefusal, PointsOfOneCoordinateOrOfUnknownNames) {
  EXPECT_NO_THROW((void)parse_model(kDrawn, "m.toml"));
  expect_refused_drawing("A = [0, 0]", "A = [0]", 8, "1 coordinates", "2 or 3");
  expect_refused_drawing("\"x\", 1]", "\"z\", 1]", 8, "undeclared name 'z'", "");
}

TEST(DrawingRefusal, PartsOfPointsThatAreNotDeclared) {
  expect_refused_drawing("[[\"A\", \"B\"]]", "[[\"A\", \"C\"]]", 9, "there is no point 'C'",
                         "points");
  expect_refused_drawing("[[\"A\", \"B\"]]", "[[\"A\"]]", 9, "1 points", "at least 2");
}

TEST(DrawingRefusal, NoPartsAndUnknownKeys) {
  expect_refused_drawing("legs = [[\"A\", \"B\"]]\n", "", 7, "no parts", "legs");
  expect_refused_drawing("legs =", "rods =", 9, "rods", "legs");
}

TEST(DrawingRefusal, BesideARobotThatIsDrawnByItself) {
  expect_refused(test::kExampleGough + "[drawing]\npoints = { A = [0, 0] }\nbase = [\"A\"]\n",
                 static_cast<int>(std::ranges::count(test::kExampleGough, '\n')) + 1, "[drawing]",
                 "remove one of them");
}

}  // namespace
}  // namespace regulus::detail
