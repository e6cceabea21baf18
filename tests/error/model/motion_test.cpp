// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/error/model/refusal.hpp"

namespace regulus::detail {
namespace {

const test::RefusedChange kRefusedMotions[] = {
    {"EmptyMotion", "[motion.circle]", "[motion.none]\n[motion.circle]", 39,
     "no 'x' in motion.none", "'motion.none.x'"},
    {"MissingPoseParameter", "y = [4, 5]\n", "", 32, "no 'y' in motion.small", "'motion.small.y'"},
    {"UnknownPoseParameter", "y = [4, 5]", "y = [4, 5]\nphy = 0", 35,
     "unknown key 'motion.small.phy'", "'phi'"},
    {"MotionThatIsNotATable", "[motion.small]", "[motion]\nother = 3\n[motion.small]", 33,
     "the integer 3 for motion.other", "a table"},
    {"MotionWhoseNameIsNotAName", "[motion.small]", "[motion.\"a b\"]", 32, "key 'a b' in motion",
     "a letter, then"},
    {"ReversedRange", "y = [4, 5]", "y = [5, 4]", 34, "the range 5 to 4 in motion.small.y is empty",
     "lower end must not be above"},
    {"ReversedRangeByLessThanDoublesCanTell", "y = [4, 5]", "y = [\"1 + 1e-40\", 1]", 34,
     "is empty", "lower end must not be above"},
    {"ReversedIrrationalRange", "phi = [\"-10*deg\", \"10*deg\"]",
     "phi = [\"10*deg\", \"-10*deg\"]", 35, "is empty", "lower end must not be above"},
    {"RangeWithNaN", "y = [4, 5]", "y = [nan, 5]", 34, "nan for motion.small.y[1]",
     "a finite number"},
    {"RangeToInfinity", "y = [4, 5]", "y = [4, inf]", 34,
     "an infinite number for motion.small.y[2]", "a finite number"},
    {"RangeThatOverflows", "y = [4, 5]", "y = [4, \"exp(exp(exp(9)))\"]", 34, "exp(exp(exp(9)))",
     "a finite real number"},
    {"PoseThatOverflows", "phi = 0", "phi = \"exp(exp(9))\"", 43, "the string 'exp(exp(9))'",
     "a finite number"},
    {"RangeOfThreeNumbers", "y = [4, 5]", "y = [4, 5, 6]", 34, "3 numbers in motion.small.y",
     "a range [lower, upper]"},
    {"RangeThatUsesAName", "y = [4, 5]", "y = [4, \"a2\"]", 34, "undeclared name 'a2'",
     "a constant"},
    {"PoseThatUsesItself", "phi = 0", "phi = \"2*phi\"", 43, "undeclared name 'phi'",
     "the declared names are: T"},
    {"PoseThatUsesAnUndeclaredParameter", "x = \"cos(2*pi*T)\"", "x = \"cos(2*pi*S)\"", 41,
     "undeclared name 'S'", "the declared names are: T"},
    {"ParameterThatShadowsADeclaredName", "{ T = [0, 1] }", "{ h = [0, 1] }", 40,
     "'h' is declared twice, here as motion.circle.parameters.h", "choose another name"},
    {"ParameterThatIsReserved", "{ T = [0, 1] }", "{ deg = [0, 1] }", 40,
     "the name 'deg' is reserved", "another name"},
    {"MoreParametersThanPoseParameters", "{ T = [0, 1] }",
     "{ T = [0, 1], A = [0, 1], B = [0, 1], C = [0, 1] }", 39, "4 parameters in motion.circle",
     "at most as many as pose parameters, 3"},
    {"NoParameters", "{ T = [0, 1] }", "{}", 40, "no parameter in motion.circle.parameters",
     "at least one"},
    {"ParameterThatIsNotARange", "{ T = [0, 1] }", "{ T = 1 }", 40,
     "the integer 1 for motion.circle.parameters.T", "a range"},
    {"NegativeAlpha", "alpha = 0", "alpha = -1", 37, "the negative number", "a number ≥ 0"},
    {"AlphaNaN", "alpha = 0", "alpha = nan", 37, "nan for motion.small.alpha", "a finite number"},
    {"NegativeError", "error = { x = 0.01", "error = { x = -0.01", 44, "the negative number",
     "a number ≥ 0"},
    {"ErrorOfAnUnknownPoseParameter", "error = { x = 0.01", "error = { T = 0.01", 44,
     "unknown key 'motion.circle.error.T'", "x, y, phi"},
    {"ConstraintsThatAreNotAList", "constraints = [\"x^2 + y^2 - 25\", \"rho_2 - 20\"]",
     "constraints = \"x\"", 36, "the string 'x' for motion.small.constraints",
     "a list of expressions"},
    {"ConstraintOnAnUndeclaredName", "\"rho_2 - 20\"", "\"rho_4 - 20\"", 36,
     "undeclared name 'rho_4'", "did you mean 'rho_"},
};

class RefusedMotion : public testing::TestWithParam<test::RefusedChange> {};
TEST_P(RefusedMotion, IsToldWithItsLine) { expect_refused(GetParam(), test::kExample); }
INSTANTIATE_TEST_SUITE_P(Each, RefusedMotion, testing::ValuesIn(kRefusedMotions),
                         test::name_of_change);

}  // namespace
}  // namespace regulus::detail
