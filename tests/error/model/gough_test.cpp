// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/error/model/refusal.hpp"

namespace regulus::detail {
namespace {

using test::expect_refused;
using test::expect_refused_gough;
using test::kExampleGough;

const test::RefusedChange kRefusedGoughs[] = {
    {"TogetherWithMatrix", "", kExampleGough + "[matrix]\nrows = [[1]]\n", 19,
     "[matrix] cannot be used together", "remove one of them"},
    {"TogetherWithPose", "", kExampleGough + "[pose]\nx = \"cm\"\n", 19,
     "[pose] cannot be used together", "remove one of them"},
    {"UnknownOrientation", "\"euler-zxz\"", "\"euler-zyz\"", 5, "the string 'euler-zyz'",
     "\"euler-zxz\", \"roll-pitch-yaw\" or \"quaternion\""},
    {"OrientationOfAnotherType", "\"euler-zxz\"", "1", 5, "the integer 1 for gough.orientation",
     "\"euler-zxz\""},
    {"MissingOrientation", "orientation = \"euler-zxz\"\n", "", 4, "no 'orientation' in gough",
     "'gough.orientation'"},
    {"UnknownToleranceShape", "\"box\"", "\"sphere\"", 10, "the string 'sphere'",
     "\"box\" or \"ball\""},
    {"UnknownKey", "base_tolerance", "base_tolerence", 9, "unknown key 'gough.base_tolerence'",
     "'base_tolerance'"},
    {"MissingBase", "", "regulus = 1\nname = \"a\"\n\n[gough]\norientation = \"quaternion\"\n", 4,
     "no 'base' in gough", "'gough.base'"},
    {"FivePoints", "[-9, 9, 0], ", "", 7, "5 points in gough.base", "6 points of 3 coordinates"},
    {"PointOfTwoCoordinates", "[-7, -1, 0]", "[-7, -1]", 8, "2 numbers in gough.platform[6]",
     "3 numbers"},
    {"NegativeTolerance", "base_tolerance = 0.05", "base_tolerance = -0.05", 9,
     "the negative number -0.05 in gough.base_tolerance", "a number ≥ 0"},
    {"MotionInTheWrongAngles", "psi = 0", "yaw = 0", 16, "unknown key 'motion.small.yaw'", "phi"},
};

class RefusedGough : public testing::TestWithParam<test::RefusedChange> {};
TEST_P(RefusedGough, IsToldWithItsLine) { expect_refused(GetParam(), kExampleGough); }
INSTANTIATE_TEST_SUITE_P(Each, RefusedGough, testing::ValuesIn(kRefusedGoughs),
                         test::name_of_change);

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

}  // namespace
}  // namespace regulus::detail
