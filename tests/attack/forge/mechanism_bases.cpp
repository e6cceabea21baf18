// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/mechanism_bases.hpp"

#include "tests/attack/forge/mechanism_texts.hpp"

namespace regulus::detail::attack {
namespace {

constexpr const char* kDegrees = R"toml(regulus = 1
name = "crank in degrees"

[pose]
theta = "deg"

[closure]
unknowns = { phi = "deg", psi = "deg" }
equations = [
  "2*cos(theta) + 5*cos(phi) - 4*cos(psi) - 6",
  "2*sin(theta) + 5*sin(phi) - 4*sin(psi)",
]
start = { theta = 50, phi = 29.3662967687, psi = 95.1192054312 }
range = { phi = [-200, 200], psi = [0, 180] }

[motion.here]
theta = 50

[motion.work]
theta = [49, 51]
)toml";

constexpr const char* kWrist = R"(regulus = 1
name = "arm with a wrist"

[geometry]
upper = 0.45

[serial]
unit = "m"
angle_unit = "deg"
tool = { xyz = [0.01, 0, 0.08], rpy = [0, 30, 0] }
joints = [
  { name = "q1", xyz = [0, 0, 0.4] },
  { name = "q2", xyz = [0.1, 0, 0], axis = [0, 1, 0] },
  { name = "q3", xyz = ["upper", 0, 0], axis = [0, 1, 0] },
  { name = "q4", xyz = [0.03, 0, 0], axis = [1, 0, 0] },
  { name = "q5", xyz = [0.42, 0, 0], axis = [0, 1, 0] },
  { name = "q6", rpy = [0, 0, 15], axis = [3, 0, 4] },
]

[motion.here]
q1 = 20
q2 = -35
q3 = 70
q4 = 50
q5 = -40
q6 = 10

[motion.tool]
tool = [0.5, 0.1, 0.3, 0.2, 0.4, "60*deg"]
)";

constexpr const char* kSlide = R"(regulus = 1
name = "arm with a slide, on a rail"

[serial]
unit = "m"
joints = [
  { name = "rail", type = "prismatic", axis = [1, 0, 0] },
  { name = "q1", xyz = [0, 0, 0.4] },
  { name = "q2", xyz = [0, 0.15, 0], axis = [0, 1, 0] },
  { name = "q3", type = "prismatic", axis = [0, 3, 4] },
  { name = "q4", xyz = [0, 0, 0.1] },
  { name = "q5", axis = [0, 1, 0] },
  { name = "q6", xyz = [0, 0, 0.2] },
]

[motion.here]
rail = 0.2
q1 = 0.3
q2 = 0.7
q3 = 0.5
q4 = 0.4
q5 = 0.8
q6 = -0.2
)";

constexpr const char* kElbow = R"(regulus = 1
name = "arm with an elbow"

[serial]
unit = "m"
convention = "modified-dh"
joints = [
  { name = "q1", d = 0.3 },
  { name = "q2", alpha = "-pi/2" },
  { name = "q3", alpha = "pi/2", d = 0.4 },
  { name = "q4", alpha = "pi/2", a = 0.05 },
  { name = "q5", alpha = "-pi/2", d = 0.4, a = -0.05 },
  { name = "q6", alpha = "pi/2" },
  { name = "q7", alpha = "-pi/2", d = 0.1 },
]

[motion.here]
q1 = 0.4
q2 = 0.6
q3 = -0.3
q4 = -1.1
q5 = 0.2
q6 = 0.9
q7 = 0.1
)";

constexpr const char* kParallelogram = R"(regulus = 1
name = "arm with a parallelogram"

[serial]
unit = "m"
angle_unit = "deg"
tool = { xyz = [0.01, 0, 0.08], rpy = [0, 30, 0] }
joints = [
  { name = "q1", xyz = [0, 0, 0.4] },
  { name = "q2", xyz = [0.1, 0, 0], axis = [0, 1, 0] },
  { mimic = "q2", multiplier = -1, offset = 10, xyz = [0.45, 0, 0], axis = [0, 1, 0] },
  { name = "q3", axis = [0, 1, 0] },
  { name = "q4", xyz = [0.03, 0, 0], axis = [1, 0, 0] },
  { name = "q5", xyz = [0.42, 0, 0], axis = [0, 1, 0] },
  { name = "q6", rpy = [0, 0, 15], axis = [3, 0, 4] },
]

[motion.here]
q1 = 20
q2 = -35
q3 = 70
q4 = 50
q5 = -40
q6 = 10

[motion.tool]
tool = [0.5, 0.1, 0.3, 0.2, 0.4, "60*deg"]
)";

constexpr const char* kScrew = R"(regulus = 1
name = "arm on a screw"

[serial]
unit = "m"
joints = [
  { name = "q1", xyz = [0, 0, 0.4], range = [-1.5, 1.5] },
  { mimic = "q1", type = "prismatic", multiplier = 0.1, offset = 0.2, xyz = [0.45, 0, 0] },
  { name = "q2", xyz = [0.1, 0, 0], axis = [0, 1, 0], range = [-4, 4] },
  { name = "q3", xyz = [0.2, 0.1, 0.05], axis = [0, 1, 0], range = [-4, 4] },
  { name = "q4", xyz = [0.03, 0, 0], axis = [1, 0, 0], range = [-4, 4] },
  { name = "q5", xyz = [0.42, 0, 0], axis = [0, 1, 0], range = [-4, 4] },
  { name = "q6", rpy = [0, 0, 0.15], axis = [3, 0, 4], range = [-4, 4] },
]

[motion.here]
q1 = 0.2
q2 = 0.35
q3 = 0.7
q4 = 0.5
q5 = -1.4
q6 = 0.1
)";

constexpr const char* kPalletizer = R"(regulus = 1
name = "palletizer"

[geometry]
upper = { value = 1.15, tolerance = 0.000001 }

[serial]
unit = "m"
joints = [
  { name = "q1", xyz = [0, 0, 0.8] },
  { name = "q2", xyz = [0.35, 0, 0], axis = [0, 1, 0] },
  { mimic = "q2", multiplier = -1, xyz = [0, 0, "upper"], axis = [0, 1, 0] },
  { name = "q3", axis = [0, 1, 0] },
  { mimic = "q3", multiplier = -1, xyz = [1.2, 0, 0], axis = [0, 1, 0] },
  { name = "q4", xyz = [0.25, 0, -0.2], axis = [0, 0, -1] },
]

[motion.here]
q1 = 0.3
q2 = 0.2
q3 = 0.4
q4 = 1

[motion.away]
tool = [1.4, 0.5, 1.2, 0.1, 0, 1]
)";

constexpr const char* kFive = R"(regulus = 1
name = "arm of five joints"

[serial]
unit = "m"
angle_unit = "deg"
tool = { xyz = [0.05, 0, 0.12], rpy = [0, 70, 0] }
joints = [
  { name = "q1", xyz = [0, 0, 0.4] },
  { name = "q2", xyz = [0.1, 0, 0], axis = [0, 1, 0] },
  { name = "q3", xyz = [0.45, 0, 0], axis = [0, 1, 0] },
  { name = "q4", xyz = [0.1, 0, 0.03], axis = [1, 0, 0] },
  { name = "q5", xyz = [0.42, 0, 0], axis = [0, 1, 0] },
]

[motion.here]
q1 = 20
q2 = -35
q3 = 70
q4 = 50
q5 = -40
)";

}  // namespace

std::vector<Base> of_mechanisms() {
  return {
      {"branch", kSlider, {"check", "work"}},
      {"five-bar", "five_bar_closure", {"check", "work"}},
      {"toggle", kRocker, {"check", "work"}},
      {"branch along way-points", kSliderOnItsWay, {"check", "way"}, kWayOfSlider, "way.csv"},
      {"toggle along way-points", kRockerOnItsWay, {"check", "way"}, kWayOfRocker, "way.csv"},
      {"force over a branch",
       kDriven,
       {"bound", "work", "force", "--load", "pull", "--leg", "1", "--limit", "90"}},
      {"force of a ball over a branch",
       kDriven,
       {"bound", "work", "force", "--load", "ball", "--leg", "1", "--signed", "--limit", "60"}},
      {"load within limits over a branch", kDriven, {"check", "work", "--load", "pull"}},
      {"load beyond limits over a branch", kDriven, {"check", "work", "--load", "hard"}},
      {"error over a branch",
       kDriven,
       {"bound", "work", "error", "--freedom", "phi", "--limit", "0.01"}},
      {"speed over a branch",
       kDriven,
       {"bound", "work", "speed", "--freedom", "s", "--limit", "9"}},
      {"deflection over a branch",
       kDriven,
       {"bound", "work", "deflection", "--load", "pull", "--freedom", "s", "--limit", "0.5"}},
      {"condition over a branch", kDriven, {"bound", "work", "condition", "--limit", "90"}},
      {"condition-2 over a branch",
       kDriven,
       {"bound", "work", "condition", "--norm", "2", "--limit", "9"}},
      {"least singular value over a branch",
       kDriven,
       {"bound", "work", "sigma-min", "--limit", "0.8"}},
      {"largest singular value that is met over a branch",
       kDriven,
       {"bound", "work", "sigma-max", "--limit", "1.2"}},
      {"determinant over a branch", kDriven, {"bound", "work", "determinant", "--limit", "0.1"}},
      {"finite error over a branch",
       kSlider,
       {"bound", "work", "error", "--finite", "--freedom", "p", "--limit", "0.002"}},
      {"finite error that is met over a branch",
       kDriven,
       {"bound", "work", "error", "--finite", "--freedom", "phi", "--limit", "0.0002"}},
      {"finite error of a platform",
       kTripod,
       {"bound", "work", "error", "--finite", "--freedom", "x_deviation", "--limit", "0.2"}},
      {"speed that is met over a branch",
       kDriven,
       {"bound", "work", "speed", "--freedom", "s", "--limit", "0.5"}},
  };
}

std::vector<Base> of_paved_branches() {
  return {
      {"paving of a load on a branch",
       kDriven,
       {"locate", "work", "--load", "middle", "--resolution", "1/16"}},
      {"paving of a branch", kRocker, {"locate", "work", "--resolution", "1/8"}},
      {"paving of a branch along way-points",
       kRockerOnItsWay,
       {"locate", "way", "--resolution", "1/16"},
       kWayOfRocker,
       "way.csv"},
  };
}

std::vector<Base> of_branches_in_shards() {
  return {
      {"shards of a branch", kSlider, {"check", "work"}, "", "", 200},
      {"shards of a branch along way-points",
       kSliderOnItsWay,
       {"check", "way"},
       kWayOfSlider,
       "way.csv",
       200},
      {"shards of a paving of a branch",
       kRocker,
       {"locate", "work", "--resolution", "1/8"},
       "",
       "",
       300},
      {"shards of a bound that is met on a way",
       kSliderOnItsWay,
       {"bound", "way", "error", "--finite", "--freedom", "p", "--limit", "0.00001"},
       kWayOfSlider,
       "way.csv",
       200},
  };
}

std::vector<Base> of_solutions() {
  return {
      {"list", kLoop, {"solve", "here"}},
      {"list on a curve", kLoop, {"solve", "path"}},
      {"list around a turn", kTurn, {"solve", "here"}},
      {"no configuration", kLoop, {"solve", "nowhere"}},
      {"part of a list", kDouble, {"solve", "here"}},
      {"list in degrees", kDegrees, {"solve", "here"}},
      {"branch in degrees", kDegrees, {"check", "work"}},
      {"postures", kWrist, {"solve", "here"}},
      {"postures by the tool", kWrist, {"solve", "tool"}},
      {"postures beside a held joint", kElbow, {"solve", "here", "--hold", "q3"}},
      {"postures with a slide", kSlide, {"solve", "here", "--hold", "rail"}},
      {"postures with a parallelogram", kParallelogram, {"solve", "here"}},
      {"postures by the tool with a parallelogram", kParallelogram, {"solve", "tool"}},
      {"postures of five joints", kFive, {"solve", "here"}},
      {"postures on a screw", kScrew, {"solve", "here"}},
      {"postures of a palletizer", kPalletizer, {"solve", "here"}},
      {"a place that a palletizer is turned away from", kPalletizer, {"solve", "away"}},
  };
}

}  // namespace regulus::detail::attack
