// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace regulus::detail::test {

/// A rotation with scales of its rows: κ₂ = 5 at every pose, which takes many boxes.
inline constexpr const char* kTurn = R"toml(regulus = 1
name = "turn"
[pose]
x = "1"
y = "1"
z = "1"
[matrix]
rows = [["cos(x)*cos(y)", "cos(x)*sin(y)*sin(z) - sin(x)*cos(z)", "cos(x)*sin(y)*cos(z) + sin(x)*sin(z)"],
        ["2*sin(x)*cos(y)", "2*sin(x)*sin(y)*sin(z) + 2*cos(x)*cos(z)", "2*sin(x)*sin(y)*cos(z) - 2*cos(x)*sin(z)"],
        ["-5*sin(y)", "5*cos(y)*sin(z)", "5*cos(y)*cos(z)"]]
[motion.m]
x = [0, 1]
y = [0, 1]
z = [0, 1]
constraints = ["x + y - 3/2"]
)toml";

}  // namespace regulus::detail::test
