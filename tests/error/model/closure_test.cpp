// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/error/model/refusal.hpp"

namespace regulus::detail {
namespace {

using test::changed;
using test::expect_refused;

const std::string kClosure =
    "regulus = 1\n"
    "name = \"four-bar\"\n"
    "[pose]\n"
    "theta = \"rad\"\n"
    "[geometry]\n"
    "crank = { value = 0.2, tolerance = 0, group = \"links\" }\n"
    "[let]\n"
    "u = \"cos(phi)\"\n"
    "[closure]\n"
    "unknowns = { phi = \"rad\", psi = \"rad\" }\n"
    "equations = [\n"
    "  \"crank*cos(theta) + 0.35355*u - 0.45 - 0.25*cos(psi)\",\n"
    "  \"crank*sin(theta) + 0.35355*sin(phi) - 0.25*sin(psi)\",\n"
    "]\n"
    "start = { theta = 1, phi = 0.22, psi = 1.67 }\n"
    "[closure.radius]\n"
    "phi = 0.1\n"
    "[closure.range]\n"
    "phi = [-1, 1]\n"
    "[motion.turn]\n"
    "theta = [0, 1]\n";

void expect_refused_closure(const std::string& from, const std::string& to, int line,
                            const std::string& found, const std::string& expected) {
  expect_refused(changed(kClosure, from, to), line, found, expected);
}

TEST(ClosureRefusal, BesideAnotherRobotOrWhatNeedsOne) {
  EXPECT_NO_THROW((void)parse_model(kClosure, "m.toml"));
  for (const char* other : {"matrix", "drawing", "twist"})
    expect_refused(kClosure + "[" + other + "]\n", 22,
                   "[" + std::string(other) + "] cannot be used together with [closure]",
                   "remove one of them");
  for (const char* other : {"gough", "legs", "serial"})
    expect_refused(kClosure + "[" + other + "]\n", 9,
                   "[closure] cannot be used together with [" + std::string(other) + "]",
                   "remove one of them");
  EXPECT_NO_THROW(
      (void)parse_model(changed(kClosure, "[pose]", "characteristic_length = 1\n[pose]") +
                            "[actuators]\nerror = [1]\n[load.one]\nwrench = [1, 2]\n",
                        "m.toml"));
  expect_refused(kClosure + "[matrix]\nrow_scale = [1, 1]\n", 22, "[matrix]", "remove");
}

/// The motors are the pose parameters, and a load is on the unknowns.
TEST(ClosureRefusal, DataOfOtherSizes) {
  expect_refused(kClosure + "[actuators]\nerror = [1, 2]\n", 23, "2 values in actuators.error",
                 "one value, or 1, one for each pose parameter");
  expect_refused(kClosure + "[load.one]\nwrench = [1]\n", 23, "1 values in load.one.wrench",
                 "2, as many as the matrix has such columns");
}

TEST(ClosureRefusal, NoUnknowns) {
  expect_refused_closure("unknowns = { phi = \"rad\", psi = \"rad\" }\n", "", 9,
                         "there is no 'unknowns' in closure", "add 'closure.unknowns'");
  expect_refused_closure("{ phi = \"rad\", psi = \"rad\" }", "{}", 10,
                         "0 unknowns in closure.unknowns", "1 to 64");
  expect_refused_closure("{ phi = \"rad\", psi = \"rad\" }", "[\"phi\", \"psi\"]", 10,
                         "an array of 2 for closure.unknowns", "a table");
  expect_refused_closure("phi = \"rad\", psi", "phi = 1, psi", 10, "closure.unknowns.phi",
                         "string");
  expect_refused_closure("phi = \"rad\", psi", "phi = \"degrees\", psi", 10, "'degrees'",
                         "write \"deg\"");
}

TEST(ClosureRefusal, NamesThatAreTaken) {
  expect_refused_closure("{ phi = ", "{ theta = ", 10, "'theta' is declared twice, as pose.theta",
                         "choose another name");
  expect_refused_closure("{ phi = ", "{ crank = \"rad\", phi = ", 6, "'crank' is declared twice",
                         "choose another name");
  expect_refused_closure("{ phi = ", "{ error = \"rad\", phi = ", 10,
                         "an unknown cannot be named 'error'", "choose another name");
  expect_refused_closure("{ phi = ", "{ sin = \"rad\", phi = ", 10, "'sin' is reserved",
                         "choose another name");
  expect_refused_closure("theta = [0, 1]", "parameters = { phi = [0, 1] }\ntheta = \"phi\"", 21,
                         "'phi' is declared twice", "choose another name");
}

TEST(ClosureRefusal, EquationsThatAreNotAsManyAsUnknowns) {
  expect_refused_closure("  \"crank*sin(theta) + 0.35355*sin(phi) - 0.25*sin(psi)\",\n", "", 11,
                         "1 equation for 2 unknowns", "add what else holds the unknowns");
  expect_refused_closure("\",\n]", "\", \"phi\",\n]", 11, "3 equations for 2 unknowns",
                         "leave out those that follow from others");
  expect_refused_closure("equations = [", "equation = [", 11, "unknown key 'closure.equation'",
                         "did you mean 'equations'?");
}

TEST(ClosureRefusal, EquationsThatSayNothingOfAnUnknown) {
  expect_refused_closure("crank*sin(theta) + 0.35355*sin(phi) - 0.25*sin(psi)", "theta - phi + phi",
                         13, "closure.equations[2] depends on no unknown",
                         "an equation of unknowns");
  expect_refused_closure("{ phi = ", "{ psi_2 = \"rad\", phi = ", 11, "2 equations for 3 unknowns",
                         "");
  expect_refused(changed(changed(kClosure, " - 0.25*cos(psi)", ""), " - 0.25*sin(psi)", ""), 11,
                 "no equation depends on the unknown 'psi'", "remove the unknown");
  expect_refused_closure("- 0.25*sin(psi)", "= 0.25*sin(psi)", 13, "'='", "");
  expect_refused_closure("- 0.25*sin(psi)", "- 0.25*sin(chi)", 13, "undeclared name 'chi'", "phi");
}

TEST(ClosureRefusal, StartsThatAreNotOne) {
  expect_refused_closure("start = { theta = 1, phi = 0.22, psi = 1.67 }\n", "", 9,
                         "there is no 'start' in closure", "add 'closure.start'");
  expect_refused_closure("{ theta = 1, phi", "{ phi", 15, "there is no 'theta' in closure.start",
                         "add 'closure.start.theta'");
  expect_refused_closure(", psi = 1.67", "", 15, "there is no 'psi' in closure.start", "add");
  expect_refused_closure("psi = 1.67", "psi = 1.67, chi = 1", 15, "unknown key 'closure.start.chi'",
                         "did you mean 'phi'?");
  expect_refused_closure("psi = 1.67", "psi = \"crank\"", 15, "undeclared name 'crank'",
                         "constant");
  expect_refused_closure("psi = 1.67", "psi = [1, 2]", 15, "an array of 2", "a finite number");
}

TEST(ClosureRefusal, RangesAndRadii) {
  expect_refused_closure("phi = [-1, 1]", "phi = [0.3, 1]", 19, "the start of 'phi' is not within",
                         "widen the range");
  expect_refused_closure("phi = [-1, 1]", "phi = [1, -1]", 19, "is empty", "lower end");
  expect_refused_closure("phi = [-1, 1]", "phi = [0.2, \"1/5\"]", 19, "is one number", "widen");
  expect_refused_closure("phi = [-1, 1]", "phi = 1", 19, "closure.range.phi", "a range");
  expect_refused_closure("phi = [-1, 1]", "theta = [-1, 1]", 19,
                         "unknown key 'closure.range.theta'", "phi");
  expect_refused_closure("phi = 0.1", "phi = 0", 17, "not above 0", "above 0");
  expect_refused_closure("phi = 0.1", "phi = \"-1deg\"", 17, "not above 0", "above 0");
  expect_refused_closure("phi = 0.1\n", "", 16, "an empty table closure.radius", "an entry");
}

TEST(ClosureRefusal, UnknownsInMotions) {
  expect_refused_closure("theta = [0, 1]", "theta = [0, 1]\nphi = 1", 22,
                         "'phi' is an unknown of [closure]", "here theta");
  expect_refused_closure("theta = [0, 1]", "theta = \"phi\"", 21, "motion.turn.theta uses 'phi'",
                         "pose parameters and constants");
  expect_refused_closure("theta = [0, 1]", "theta = [0, \"phi\"]", 21, "undeclared name 'phi'",
                         "constant");
  expect_refused_closure("theta = [0, 1]", "theta = [0, 1]\nconstraints = [\"phi - 1\"]", 22,
                         "uses 'phi', which depends on the unknowns", "pose parameters");
  expect_refused_closure("theta = [0, 1]", "theta = [0, 1]\nconstraints = [\"u\"]", 22, "uses 'u'",
                         "pose parameters");
  expect_refused_closure("theta = [0, 1]", "theta = [0, 1]\nerror = { phi = 1 }", 22,
                         "'phi' is an unknown of [closure]", "remove it");
  expect_refused_closure("theta = [0, 1]", "theta = [0, 1]\nwhere = \"reachable\"", 22,
                         "has no where", "remove it");
}

TEST(ClosureRefusal, UnknownsInConstants) {
  expect_refused_closure("tolerance = 0", "tolerance = \"phi\"", 6, "undeclared name 'phi'",
                         "constant");
  expect_refused_closure("value = 0.2", "value = \"psi\"", 6, "undeclared name 'psi'", "constant");
}

/// A product of sums, as long as an expression may be.
TEST(ClosureRefusal, DerivativesThatAreTooLarge) {
  std::string product = "(phi + 1)";
  for (int i = 2; product.size() < 60000; ++i) product += "*(phi + " + std::to_string(i) + ")";
  expect_refused_closure("crank*sin(theta)", product, 13,
                         "a model too large at closure.equations[2]", "5 million");
}

}  // namespace
}  // namespace regulus::detail
