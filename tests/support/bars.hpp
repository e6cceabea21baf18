// SPDX-License-Identifier: GPL-3.0-or-later
// A linkage of three bars with uncertain lengths, loads and motors, for commands.
#pragma once

#include <fmt/format.h>

#include <string>

namespace regulus::detail::test {

/// The motion is "m", the load "L"; `tolerance` is that of two bars, `force` the limits of the motor.
inline std::string bars(const std::string& tolerance, const std::string& force) {
  return fmt::format(R"toml(regulus = 1
name = "bars"
[pose]
theta = "rad"
[geometry]
crank = {{ value = "0.2", tolerance = "{0}", group = "links" }}
rod = {{ value = "0.35355", tolerance = "{0}", group = "links" }}
[closure]
unknowns = {{ phi = "rad", psi = "rad" }}
equations = [
  "crank*cos(theta) + rod*cos(phi) - 0.45 - 0.25*cos(psi)",
  "crank*sin(theta) + rod*sin(phi) - 0.25*sin(psi)",
]
start = {{ theta = 0, phi = 0.7854, psi = 1.5708 }}
[actuators]
error = 0.01
speed = 2
force = {1}
force_unit = "N m"
[load.L]
wrench = [[-1, 3], 2]
[motion.m]
theta = [-1, 1.5]
)toml",
                     tolerance, force);
}

}  // namespace regulus::detail::test
