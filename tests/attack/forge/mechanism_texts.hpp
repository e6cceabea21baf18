// SPDX-License-Identifier: GPL-3.0-or-later
// Model files of robots by legs, joints and equations, for genuine certificates.
#pragma once

namespace regulus::detail::attack {

/// Legs PRS and RPS whose directions are uncertain.
inline constexpr const char* kRails = R"toml(regulus = 1
name = "rails"
[legs]
orientation = "euler-zxz"
axis_tolerance = 0.0001
hinge = [0, 1, 0]
[[legs.leg]]
type = "PRS"
base = [20, 0, 0]
platform = [10, 0, 0]
axis = [1, 0, 0]
rod = 40
mode = "+"
[[legs.leg]]
type = "RPS"
base = [-10, 17, 0]
platform = [-5, 9, 0]
hinge = [-0.86, -0.5, 0]
[[legs.leg]]
type = "RPS"
base = [-10, -17, 0]
platform = [-5, -9, 0]
hinge = [0.86, -0.5, 0]
[motion.work]
x = 0
y = 0
z = [30, 31]
psi = 0
theta = 0
phi = 0
)toml";

/// A crank and a slider with data of the motor.
inline constexpr const char* kDriven = R"toml(regulus = 1
name = "driven"
characteristic_length = 0.2
[pose]
theta = "rad"
[geometry]
r = { value = 0.1, tolerance = 0.0001, group = "links" }
l = 0.3
[closure]
unknowns = { s = "m", phi = "rad" }
equations = ["r*cos(theta) + l*cos(phi) - s", "r*sin(theta) + l*sin(phi)"]
start = { theta = 0.5, s = 0.383917, phi = -0.160497 }
range = { s = [0.1, 0.5], phi = ["-pi/3", 0.1] }
[actuators]
error = 0.001
speed = 10
stiffness = 2000
force = [-90, 90]
[load.pull]
wrench = [[-500, 400], [-3, 5]]
[load.ball]
wrench = { value = [100, 1], radius = 5 }
[load.hard]
wrench = [5000, 0]
[load.middle]
wrench = [1200, 0]
[motion.work]
theta = [0.4, 1.2]
)toml";

/// A platform in the plane on legs with errors.
inline constexpr const char* kTripod = R"toml(regulus = 1
name = "tripod"
[legs]
unit = "cm"
base_tolerance = 0.005
[[legs.leg]]
type = "RPR"
base = [0, 0]
platform = [0, 0]
[[legs.leg]]
type = "RPR"
base = [10, 0]
platform = [4, 0]
[[legs.leg]]
type = "RPR"
base = [3, 10]
platform = [2, 2]
[actuators]
error = [0.01, 0.02, 0.01]
[motion.work]
x = [4.9, 5.1]
y = 5
phi = "1/10"
)toml";

/// A branch of an equation, from a start that lies within the motion.
inline constexpr const char* kSlider = R"toml(regulus = 1
name = "slider"

[pose]
x = "m"
y = "m"

[geometry]
a = { value = 1, tolerance = 0.001, group = "a" }
k = 2

[let]
d = "p + k"

[closure]
unknowns = { p = "m", q = "rad" }
equations = ["d^2 - x - 8*a - 1/(x + 10)", "sin(q) - y*p/4 - 0.1"]
start = { x = 0, y = 0, p = 1, q = 0.1 }
radius = { p = 0.5, q = 0.1 }
range = { p = [0, 3] }

[motion.work]
x = [-0.5, 6]
y = [-0.4, 0.4]
constraints = ["y - x/4 - 0.3"]
error = { y = 0.001 }
)toml";

/// A branch along way-points: a tolerance, an error, a constraint.
inline constexpr const char* kSliderOnItsWay = R"toml(regulus = 1
name = "slider on its way"

[pose]
x = "m"
y = "m"

[geometry]
a = { value = 1, tolerance = 0.001, group = "a" }
k = 2

[let]
d = "p + k"

[closure]
unknowns = { p = "m", q = "rad" }
equations = ["d^2 - x - 8*a - 1/(x + 10)", "sin(q) - y*p/4 - 0.1"]
start = { x = 0, y = 0, p = 1, q = 0.1 }
radius = { p = 0.5, q = 0.1 }
range = { p = [0.5, 2.5], q = [-1, "6/5"] }

[motion.way]
waypoints = "way.csv"
constraints = ["y - x/4 - 0.9"]
error = { y = 0.001 }
)toml";
inline constexpr const char* kWayOfSlider = "x,y\n0,0\n1,0.4\n-0.5,-0.3\n6,0.2\n";

/// One that ends on its second segment.
inline constexpr const char* kRockerOnItsWay = R"toml(regulus = 1
name = "rocker on its way"

[pose]
x = "m"
y = "m"

[geometry]
a = { value = 1, tolerance = 0.001, group = "a" }

[closure]
unknowns = { p = "m", q = "rad" }
equations = ["p^2 - x - a", "sin(q) - y*p/4 - 0.1"]
start = { x = 0, y = 0, p = 1, q = 0.1 }
radius = { p = 0.5, q = 0.1 }

[motion.way]
waypoints = "way.csv"
error = { y = 0.001 }
)toml";
inline constexpr const char* kWayOfRocker = "x,y\n0,0\n0.5,0.3\n-2,0.1\n1,0\n";

/// A branch that ends within the motion: a tolerance, an error, two ranges.
inline constexpr const char* kRocker = R"toml(regulus = 1
name = "rocker"

[pose]
x = "m"
y = "m"

[geometry]
a = { value = 1, tolerance = 0.001, group = "a" }

[closure]
unknowns = { p = "m", q = "rad" }
equations = ["p^2 - x - a", "sin(q) - y*p/4 - 0.1"]
start = { x = 0, y = 0, p = 1, q = 0.1 }
radius = { p = 0.5, q = 0.1 }

[motion.work]
x = [-2, 0.5]
y = [-0.4, 0.4]
error = { y = 0.001 }
)toml";

/// The configurations at a place: a ball, a tolerance, an error, a logarithm, two ranges.
inline constexpr const char* kLoop = R"toml(regulus = 1
name = "loop"

[pose]
x = "m"
y = "m"

[geometry]
a = { value = [1, 2], radius = 0.001, group = "a" }
b = { value = 3, tolerance = 0.001, group = "b" }
k = 2

[let]
d = "p + k"

[closure]
unknowns = { p = "m", q = "rad" }
equations = ["d^2 - x - 8*a_1 - b/(x + 10)", "sin(q) - y*log(p + 9)/4 - a_2/20"]
start = { x = 0.5, y = 0.25, p = 1, q = 0.1 }
range = { p = [-7, 7], q = [-1, 1.5] }

[motion.here]
x = 0.5
y = 0.25
error = { y = 0.001 }

[motion.path]
parameters = { T = ["1/2", "1/2"] }
x = "1/(T + 2)"
y = "T/4"

[motion.nowhere]
x = -10.5
y = 0
)toml";

/// Two angles with ranges that are longer than a turn: one repeats.
inline constexpr const char* kTurn = R"toml(regulus = 1
name = "turn"
[pose]
x = "m"
[geometry]
a = { value = "1/3", tolerance = 0.001, group = "a" }
[closure]
unknowns = { q = "rad", r = "rad" }
equations = ["sin(q) + x*cos(2*q)/9 - a", "r - x/(2 + sin(q))"]
start = { x = 0.5, q = 0.1, r = 0.2 }
range = { q = [-7, 6], r = [-1, 9] }
[motion.here]
x = 0.5
)toml";

/// A double root beside a simple one: a list that is not all.
inline constexpr const char* kDouble = R"toml(regulus = 1
name = "double"
[pose]
x = "m"
[closure]
unknowns = { p = "m" }
equations = ["(p - 1)^2*(p + x)"]
start = { x = 2, p = -2 }
range = { p = [-5, 5] }
[motion.here]
x = 2
)toml";

/// Legs in degrees, with balls and the ranges of joints.
inline constexpr const char* kStage = R"toml(regulus = 1
name = "stage"

[geometry]
L = 120

[legs]
unit = "mm"
angle_unit = "deg"
rod_tolerance = 0.1
base_tolerance = 0.01
tolerance_shape = "ball"

[[legs.leg]]
type = "RRR"
base = [0, 0]
platform = [-30, -20]
crank = "L"
rod = 150
mode = "+"
range = ["-90deg", "200deg"]

[[legs.leg]]
type = "RPR"
base = { value = [300, 0], radius = 0.02 }
platform = [30, -20]
range = [80, 220]

[[legs.leg]]
type = "PRR"
base = [0, 300]
platform = [0, 40]
axis = [1, 0]
rod = 160
mode = "-"
range = [0, 150]

[motion.within]
x = [120, 171]
y = [155, 186]
phi = [-5, 5]
where = "within-ranges"
error = { phi = 0.01 }

[motion.reached]
x = [140, 175]
y = [155, 190]
phi = 2
where = "reachable"
)toml";

/// An arm by Denavit and Hartenberg, in degrees, with a joint that follows another.
inline constexpr const char* kBent = R"toml(regulus = 1
name = "bent"

[geometry]
L = { value = 0.4, tolerance = 0.0001, group = "own" }

[serial]
unit = "m"
convention = "modified-dh"
angle_unit = "deg"
length_tolerance = 0.001
angle_tolerance = 0.01
joints = [
  { name = "q1", d = 0.3, range = [-170, 170] },
  { name = "q2", a = 0.1, alpha = -90, theta = 10, range = [-80, 60] },
  { mimic = "q2", multiplier = "-1/2", a = "L" },
  { name = "q3", type = "prismatic", alpha = 90, d = 0.2, range = [0.1, 0.5] },
]
tool = { xyz = [0, 0, 0.1] }

[motion.work]
q1 = [-20, 20]
q2 = [10, 20]
q3 = [0.2, 0.3]
error = { q2 = 0.1, q3 = 0.001 }
)toml";

/// A pose in three units, along a spline.
inline constexpr const char* kSpline = R"toml(regulus = 1
name = "spline"

[pose]
x = "mm"
y = "m"
phi = "deg"

[matrix]
rows = [["x + 900 + y", "sin(phi)"], ["phi/deg/7 + y", "x + 1200"]]

[motion.way]
waypoints = "way.csv"
interpolation = "cubic"
phi = 3
error = { x = 0.5, phi = 0.1 }
constraints = ["x - 480"]
)toml";

}  // namespace regulus::detail::attack
