// SPDX-License-Identifier: GPL-3.0-or-later
// A valid model file that uses every feature of the format; tests change one place of it.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace regulus::detail::test {

/// Line 1 has the format version; tests count lines from there.
inline const std::string kExample = R"toml(regulus = 1
name = "example"
source = "made up"

[pose]
x = "cm"
y = "cm"
phi = "rad"

[geometry]
a2 = 10
h = { value = "1/3", tolerance = 0.01 }
r = { value = 4, tolerance = 0.05, group = "platform" }
p1 = { value = [3, 7, 0], radius = 0.05, group = "base" }
p2 = { value = [0.1, "1/7"], tolerance = "1/100", group = "base" }

[let]
rho_1 = "sqrt((x - h*c)^2 + y^2 + 1)"
c = "cos(phi)"
rho_2 = "sqrt((x - a2)^2 + y^2)"
half = 0.5

[matrix]
rows = [
  ["x - h*c", "y", 1],
  ["x - a2", "y", "c"],
  ["p1_1*x", "y - r", "half*p2_2"],
  [1, 2.5, "p1_2 + p1_3 + p2_1"],
]
row_scale = ["1/rho_1", "1/rho_2", 2, "1/3"]

[motion.small]
x = [-1, 1]
y = [4, 5]
phi = ["-10*deg", "10*deg"]
constraints = ["x^2 + y^2 - 25", "rho_2 - 20"]
alpha = 0

[motion.circle]
parameters = { T = [0, 1] }
x = "cos(2*pi*T)"
y = "5 + sin(2*pi*T)"
phi = 0
error = { x = 0.01, phi = "0.1*deg" }
)toml";

inline const std::string kExampleGough = R"toml(regulus = 1
name = "six legs"

[gough]
orientation = "euler-zxz"
unit = "cm"
base = [[-9, 9, 0], [9, 9, 0], [12, -3, 0], [3, -13, 0], [-3, -13, 0], [-12, -3, 0]]
platform = [[-3, 7, 0], [3, 7, 0], [7, -1, 0], [4, -6, 0], [-4, -6, 0], [-7, -1, 0]]
base_tolerance = 0.05
tolerance_shape = "box"

[motion.small]
x = [-5, 5]
y = [-5, 5]
z = [45, 50]
psi = 0
theta = ["-5*deg", "5*deg"]
phi = 0
)toml";

/// Returns the text after replacing the only occurrence of `from`.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "not in the example: " << from;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << "ambiguous in the example: " << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace regulus::detail::test
