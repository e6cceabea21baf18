// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/bases.hpp"

#include "tests/attack/forge/mechanism_bases.hpp"
#include "tests/attack/forge/mechanism_texts.hpp"

namespace regulus::detail::attack {
namespace {

/// Constraints, errors, a ball, a box, scales, roots, denominators and names in one small model.
constexpr const char* kEverything = R"toml(regulus = 1
name = "everything"

[pose]
x = "m"
y = "m"

[geometry]
a = { value = [3, "1/7"], radius = 0.01, group = "anchor" }
b = { value = 2, tolerance = 0.02, group = "anchor" }
k = 5

[let]
d = "sqrt((x + a_1)^2 + (y + a_2)^2)"
e = "x/(y + k) + d"

[matrix]
rows = [["x + b + 4", "y/(x + 3)"], ["e*y/100", "log(y + k) + d"]]
row_scale = ["1/d", "1/(b + x^2)"]
[motion.m]
x = [-1, 1]
y = ["-1/2", 0.5]
constraints = ["x^2 + y^2 - 1", "x*y - 0.4"]
alpha = 0.001
error = { x = 0.01 }

[motion.plain]
x = [-1, 1]
y = ["-1/2", 0.5]
constraints = ["x^2 + y^2 - 1"]
error = { y = 0.01 }

[motion.path]
parameters = { T = [0, 1], s = [0, 0.1] }
x = "cos(2*pi*T)"
y = "sin(2*pi*T)/2 + s"

[motion.way]
waypoints = "way.csv"
)toml";

/// A removable singularity, and a singular pose that a constraint would leave out.
constexpr const char* kRemovable = R"toml(regulus = 1
name = "removable"

[pose]
x = "m"

[geometry]
c = 1

[matrix]
rows = [["x/(x + c + 1)*(x + 2)", "x - 1/4"], ["x + 3", "2"]]

[motion.m]
x = [-1, 1]
)toml";

/// Forces, errors, speeds of a cart on three cables.
constexpr const char* kCart = R"toml(regulus = 1
name = "cart"
characteristic_length = 2

[pose]
x = "m"
y = "m"

[matrix]
rows = [["x", "y"], ["x - 4", "y"], ["x - 2", "y - 3"]]
row_scale = ["1/sqrt(x^2 + y^2)", "1/sqrt((x - 4)^2 + y^2)", "1/sqrt((x - 2)^2 + (y - 3)^2)"]
twist = ["v_x", "v_y"]

[load.pull]
force = { value = [0, -2], radius = 1 }

[load.gust]
force = [[-1, 1], [-3, -2]]

[load.storm]
force = { value = [40, -2], radius = 1 }

[actuators]
force = [1, 30]
error = 0.01
stiffness = 100

[motion.work]
x = [1.5, 2.5]
y = [0.8, 1.2]
)toml";

/// Bounds of every quantity.
constexpr const char* kPair = R"toml(regulus = 1
name = "pair"
characteristic_length = 2

[pose]
x = "m"
phi = "rad"

[matrix]
rows = [["x + 3", "cos(phi)"], ["sin(phi)", "x + 5"]]
row_scale = ["1/sqrt((x + 3)^2 + 1)", "1/(x + 5)"]
twist = ["v_x", "w_z"]

[load.gust]
force = [[-1, 1]]
moment = { value = [0], radius = 1 }
[twist.turn]
velocity = [[-1, 1]]
rotation = [[-0.5, 0.5]]

[actuators]
force = [-10, 30]
error = 0.01
stiffness = 100

[motion.work]
x = [-1, 1]
phi = [-0.1, 0.1]
)toml";

/// Two angles that jump on the motion, at one ordinate and at another.
constexpr const char* kSides = R"toml(regulus = 1
name = "sides"
[pose]
x = "m"
y = "m"
[geometry]
h = 0.125
u = { value = 2, tolerance = 0.01, group = "u" }
[let]
a = "atan2(y - h, x)"
[matrix]
rows = [["a + u*x", "atan2(y + x/4, x - 1)"], ["y", "1/(3 + x)"]]
[motion.across]
x = [-2, -1.5]
y = [0.05, 0.6]
constraints = ["y - x - 4"]
)toml";

/// It is regular on either side of its cut.
constexpr const char* kSafeSides = R"toml(regulus = 1
name = "safe sides"
[pose]
x = "m"
y = "m"
[geometry]
h = 0.125
[matrix]
rows = [["atan2(y - h, x) + 20*x", "x/7"], ["y", "1/(3 + x)"]]
[motion.across]
x = [-2, -1.5]
y = [0.05, 0.6]
)toml";

/// A motion along a curve that has a pole, and a twist in a ball.
constexpr const char* kCurve = R"toml(regulus = 1
name = "curve"
[pose]
x = "m"
y = "m"
phi = "rad"
[matrix]
twist = ["v_x", "v_y", "w_z"]
rows = [["x + 4", "y", "1"], ["y/3", "x + 6", "phi"], ["0", "phi", "3"]]
[twist.drift]
velocity = { value = [0.1, 0.2], radius = 1 }
rotation = [[-0.5, 0.5]]
[motion.pole]
parameters = { T = [0, 1] }
x = "1/(T + 2)"
y = "sqrt(T + 1)"
phi = "T - 1/2"
[motion.work]
x = [-1, 1]
y = [-1, 1]
phi = [-0.1, 0.1]
)toml";

/// A force that grows without end near a singular pose.
constexpr const char* kUnbounded = R"toml(regulus = 1
name = "unbounded"
[pose]
x = "m"
[matrix]
rows = [["x - 1/3"]]
[load.pull]
wrench = [1]
[motion.across]
x = [-1, 1]
)toml";

/// A redundant robot that loses rank at one pose, with tolerances, a constraint and an error.
constexpr const char* kLost = R"toml(regulus = 1
name = "lost"
[pose]
x = "m"
y = "m"
[geometry]
a = { value = 2, tolerance = 0.01 }
[matrix]
rows = [["exp(x)", "2"], ["a", "2"], ["y*exp(x)", "1.7*a - 1.7"]]
[motion.m]
x = [-1, 1.5]
y = [0.3, 1.1]
constraints = ["x*y - 1"]
error = { y = 0.01 }
)toml";

constexpr const char* kWay = "x,y\n0.1,0.2\n0.3,0.1\n0.2,-0.1\n";
constexpr const char* kTimes =
    "t [s],x [mm],y [mm]\n0,500,1000\n0.1,450,1500\n0.25,250,500\n0.3,350,1000\n";
constexpr const char* kMoves =
    "G21 G90 G17\nG0 X100 Y0 Z1\nG1 X200 Y100 F100\nG2 X300 Y0 I0 J-100\n";

constexpr const char* kTable = R"toml(regulus = 1
name = "table"

[pose]
x = "mm"
y = "mm"
z = "mm"

[matrix]
rows = [["x + 900", "y + z"], ["y/7", "x + y + 1200"]]

[motion.way]
waypoints = "way.ngc"
)toml";

std::vector<Base> written_here() {
  return {
      {"everything", kEverything, {"check", "m"}},
      {"errors", kEverything, {"check", "plain"}},
      {"path", kEverything, {"check", "path"}},
      {"lost", kLost, {"check", "m"}},
      {"way", kEverything, {"check", "way"}, kWay, "way.csv"},
      {"moves", kTable, {"check", "way"}, kMoves, "way.ngc"},
      {"spline", kSpline, {"check", "way"}, kTimes, "way.csv"},
      {"within ranges", kStage, {"check", "within"}},
      {"reachable", kStage, {"check", "reached"}},
      {"bent arm", kBent, {"check", "work"}},
      {"removable", kRemovable, {"check", "m"}},
      {"sides", kSides, {"check", "across"}},
      {"curve", kCurve, {"check", "pole"}},
      {"ball",
       kCurve,
       {"bound", "work", "speed", "--twist", "drift", "--leg", "1", "--signed", "--limit", "19"}},
      {"unbounded", kUnbounded, {"bound", "across", "force", "--load", "pull", "--limit", "5"}},
      {"feasible", kCart, {"check", "work", "--load", "pull"}},
      {"infeasible", kCart, {"check", "work", "--load", "storm"}},
      {"paving", kCart, {"locate", "work", "--load", "gust"}},
      {"force", kPair, {"bound", "work", "force", "--load", "gust", "--leg", "1", "--limit", "50"}},
      {"speed", kPair, {"bound", "work", "speed", "--twist", "turn", "--leg", "1", "--limit", "9"}},
      {"error", kPair, {"bound", "work", "error", "--freedom", "v_x", "--limit", "5"}},
      {"sigma-min", kPair, {"bound", "work", "sigma-min", "--limit", "0.001"}},
      {"sigma-max", kPair, {"bound", "work", "sigma-max", "--limit", "50"}},
      {"condition", kPair, {"bound", "work", "condition", "--limit", "500"}},
      {"condition-2", kPair, {"bound", "work", "condition", "--norm", "2", "--limit", "500"}},
      {"deflection",
       kPair,
       {"bound", "work", "deflection", "--load", "gust", "--freedom", "w_z", "--limit", "8"}},
      {"determinant", kPair, {"bound", "work", "determinant", "--limit", "0.001"}},
      {"determinant-max", kPair, {"bound", "work", "determinant-max", "--limit", "100"}},
      {"expression", kPair, {"bound", "work", "x*phi + phi^2/(x + 2)", "--limit", "5"}},
      {"met", kPair, {"bound", "work", "force", "--load", "gust", "--leg", "1", "--limit", "0.1"}},
      {"shards", "robot_1", {"check", "wide_15"}, "", "", 400},
      {"shards of pieces", kEverything, {"check", "way"}, kWay, "way.csv", 60},
      {"shards of sides", kSafeSides, {"check", "across"}, "", "", 20},
      {"shards of a paving", kCart, {"locate", "work", "--load", "gust"}, "", "", 1000},
  };
}

std::vector<Base> of_the_library() {
  return {
      {"gough", "robot_1", {"check", "table4_5", "--tolerance", "base,platform=0.01"}},
      {"threshold", "robot_1", {"check", "table4_5", "--alpha", "1"}},
      {"witness", "robot_1", {"check", "wide_40"}},
      {"trajectory", "robot_1", {"check", "T1_errors"}},
      {"octahedral", "octahedral", {"check", "work"}},
      {"planar", "planar_3rpr", {"check", "regular", "--tolerance", "base=0.01"}},
      {"planar legs", "planar_3rrr", {"check", "regular"}},
      {"legs", "delta", {"check", "work"}},
      {"cranks", "hexapod_6rus", {"check", "work"}},
      {"hinges", "hunt_3rps", {"check", "work"}},
      {"rails", kRails, {"check", "work"}},
      {"arm", "puma_560_serial", {"check", "dexterous"}},
      {"parallel axes", "three_parallel_axes", {"check", "table"}},
      {"scara", "scara", {"check", "right_handed"}},
      {"redundant arm", "seven_joints", {"check", "table"}},
      {"cables", "cable_8", {"check", "work"}},
      {"poses", "dietmaier", {"solve", "legs"}},
      {"poses in the plane", "rpr_6", {"solve", "legs"}},
      {"poses that are followed", "rpr_6", {"solve", "legs", "--tolerance", "base=0.1"}},
  };
}

}  // namespace

const std::vector<Base>& bases() {
  static const std::vector<Base> kBases = [] {
    std::vector<Base> all = written_here();
    for (auto* more :
         {of_mechanisms, of_paved_branches, of_branches_in_shards, of_solutions, of_the_library})
      for (Base& base : more()) all.push_back(std::move(base));
    return all;
  }();
  return kBases;
}

}  // namespace regulus::detail::attack
