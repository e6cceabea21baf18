// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/error/model/refusal.hpp"

namespace regulus {
namespace {

using test::expect_refused;
using test::expect_refused_gough;
using test::kExampleGough;

TEST(GoughRefusal, TogetherWithMatrix) {
  expect_refused(kExampleGough + "[matrix]\nrows = [[1]]\n", 19, "[matrix] cannot be used together",
                 "remove one of them");
}

TEST(GoughRefusal, TogetherWithPose) {
  expect_refused(kExampleGough + "[pose]\nx = \"cm\"\n", 19, "[pose] cannot be used together",
                 "remove one of them");
}

TEST(GoughRefusal, UnknownOrientation) {
  expect_refused_gough("\"euler-zxz\"", "\"euler-zyz\"", 5, "the string 'euler-zyz'",
                       "\"euler-zxz\", \"roll-pitch-yaw\" or \"quaternion\"");
}

TEST(GoughRefusal, OrientationOfAnotherType) {
  expect_refused_gough("\"euler-zxz\"", "1", 5, "the integer 1 for gough.orientation",
                       "\"euler-zxz\"");
}

TEST(GoughRefusal, MissingOrientation) {
  expect_refused_gough("orientation = \"euler-zxz\"\n", "", 4, "no 'orientation' in gough",
                       "'gough.orientation'");
}

TEST(GoughRefusal, UnknownToleranceShape) {
  expect_refused_gough("\"box\"", "\"sphere\"", 10, "the string 'sphere'", "\"box\" or \"ball\"");
}

TEST(GoughRefusal, UnknownKey) {
  expect_refused_gough("base_tolerance", "base_tolerence", 9, "unknown key 'gough.base_tolerence'",
                       "'base_tolerance'");
}

TEST(GoughRefusal, MissingBase) {
  expect_refused("regulus = 1\nname = \"a\"\n\n[gough]\norientation = \"quaternion\"\n", 4,
                 "no 'base' in gough", "'gough.base'");
}

TEST(GoughRefusal, FivePoints) {
  expect_refused_gough("[-9, 9, 0], ", "", 7, "5 points in gough.base",
                       "6 points of 3 coordinates");
}

TEST(GoughRefusal, PointOfTwoCoordinates) {
  expect_refused_gough("[-7, -1, 0]", "[-7, -1]", 8, "2 numbers in gough.platform[6]", "3 numbers");
}

TEST(GoughRefusal, CoordinateThatUsesAName) {
  expect_refused_gough("[-7, -1, 0]", "[-7, -1, \"x\"]", 8,
                       "gough.platform[6][3] depends on the pose", "[geometry]");
  expect_refused_gough("[-7, -1, 0]", "[-7, -1, \"L\"]", 8, "undeclared name 'L'", "declared");
}

TEST(GoughRefusal, ATolerancesThatAnAnchorCannotHave) {
  expect_refused_gough("[-7, -1, 0]", "{ value = [-7, -1, 0], tolerance = 1, radius = 1 }", 8,
                       "both a tolerance and a radius", "one of them");
  expect_refused_gough("[-7, -1, 0]", "{ value = [-7, -1, 0], radius = -1 }", 8,
                       "the negative number", "a number ≥ 0");
  expect_refused_gough("[-7, -1, 0]", "{ radius = 1 }", 8, "no 'value'", "gough.platform[6].value");
  expect_refused_gough("[-7, -1, 0]", "{ value = [-7, -1, 0], group = \"a\" }", 8, "unknown key",
                       "value");
  std::string all = kExampleGough;
  for (std::size_t at = all.find("base = [") + 8, last = all.find('\n', at); at < last;) {
    const std::size_t begin = all.find('[', at), end = all.find(']', begin) + 1;
    if (begin > last) break;
    const std::string own = "{ value = " + all.substr(begin, end - begin) + ", tolerance = 0 }";
    all.replace(begin, end - begin, own);
    at = begin + own.size();
    last = all.find('\n', at);
  }
  expect_refused(all, 9, "gough.base_tolerance applies to nothing", "remove it");
}

TEST(GoughRefusal, NegativeTolerance) {
  expect_refused_gough("base_tolerance = 0.05", "base_tolerance = -0.05", 9,
                       "the negative number -0.050000 in gough.base_tolerance", "a number ≥ 0");
}

TEST(GoughRefusal, MotionInTheWrongAngles) {
  expect_refused_gough("psi = 0", "yaw = 0", 16, "unknown key 'motion.small.yaw'", "phi");
}

}  // namespace
}  // namespace regulus
