// SPDX-License-Identifier: GPL-3.0-or-later
// The same machine in radians and in degrees has the same bounds: in every string 10*deg, 10deg and 10° are
// ten degrees, of a motor of a closure in degrees, too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/bounded_model.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test::motors_in_degrees {
namespace {

using testing::HasSubstr;

const double kDegree = std::acos(-1.0) / 180;

/// s = sin(th), whose rate is cos(th).
std::string sine(const std::string& unit, const std::string& actuators) {
  return R"toml(regulus = 1
name = "u"
[pose]
th = ")toml" +
         unit + R"toml("
[closure]
unknowns = { s = "m" }
equations = ["s - sin(th)"]
start = { th = 0, s = 0 }
[actuators]
)toml" + actuators +
         "\n[motion.m]\nth = [0, " + (unit == "rad" ? "\"10*deg\"" : "10") + "]\n";
}

class MotorsInDegrees : public BoundedModel {};

TEST_F(MotorsInDegrees, HaveTheSameErrorsAndSpeeds) {
  for (const std::string unit : {"rad", "deg"})
    for (const std::string number : {"0.1*deg", "0.1deg", "0.1°"})
      for (const std::string quantity : {"error", "speed"}) {
        write(sine(unit, quantity + " = \"" + number + "\""));
        const std::string certificate = path("proof");
        const auto found = components({quantity, "--gap", "1e-3", "--certificate", certificate});
        expect_bracket(found.at("s"), 0.1 * kDegree);  // at th = 0 the rate is 1
        EXPECT_EQ(verify(certificate + ".s.safe").output, "VERIFIED\n")
            << unit << ' ' << number << ' ' << verify(certificate + ".s.safe").errors;
      }
  write(sine("deg", "error = 0.1"));
  expect_bracket(components({"error"}).at("s"), 0.1 * kDegree);
}

TEST_F(MotorsInDegrees, AreNotVerifiedWithAnotherNumber) {
  write(sine("deg", "error = \"0.1*deg\""));
  const std::string certificate = path("proof"), safe = certificate + ".s.safe";
  EXPECT_EQ(bound({"error", "--certificate", certificate}).exit_code, 0);
  std::string text = file_contents(safe);
  const std::string stated = "motor-error 1/10\n";
  ASSERT_NE(text.find(stated), std::string::npos) << text;
  text.replace(text.find(stated), stated.size(), "motor-error 1/1800*pi\n");
  std::ofstream(safe) << text;
  EXPECT_NE(verify(safe).output, "VERIFIED\n");
}

TEST_F(MotorsInDegrees, TakeNoNumberOfRadians) {
  write(sine("deg", "error = \"pi/1800\""));
  EXPECT_EQ(bound({"error"}).exit_code, 65);
}

TEST_F(MotorsInDegrees, TakeNoOtherUnit) {
  write(sine("deg", "unit = \"rad\"\nerror = 0.001"));
  EXPECT_EQ(bound({"error"}).exit_code, 65);
  EXPECT_THAT(bound({"error"}).errors, HasSubstr("has the unit 'deg' of its pose parameter"));
}

/// s = th: the error of an unknown in degrees is that of the motor.
TEST_F(MotorsInDegrees, HaveLimitsInTheirUnit) {
  for (const std::string unit : {"rad", "deg"}) {
    const std::string text = R"toml(regulus = 1
name = "follower"
[pose]
th = ")toml" + unit + R"toml("
[closure]
unknowns = { s = ")toml" + unit +
                             R"toml(" }
equations = ["sin(s - 2*th)"]
start = { th = 0, s = 0 }
[actuators]
error = "0.1deg"
[motion.m]
th = [0, "10deg"]
)toml";
    write(text);
    EXPECT_EQ(bound({"error", "--limit", "0.21deg", "--quiet"}).output, "WITHIN\n") << unit;
    EXPECT_EQ(bound({"error", "--limit", "0.19*deg", "--quiet"}).output, "EXCEEDED (s)\n") << unit;
  }
}

/// The motors of legs turn by radians, whatever the unit of the pose is.
TEST_F(MotorsInDegrees, OfLegsAreInRadians) {
  const auto text = [](const std::string& angle_unit, const std::string& actuators) {
    return R"toml(regulus = 1
name = "cranks"
[legs]
unit = "mm"
angle_unit = ")toml" +
           angle_unit + R"toml("
leg = [
  { type = "RRR", base = [0, 0], platform = [-30, -20], crank = 120, rod = 150, mode = "+" },
  { type = "RRR", base = [300, 0], platform = [30, -20], crank = 120, rod = 150, mode = "-" },
  { type = "RRR", base = [150, 300], platform = [0, 40], crank = 120, rod = 150, mode = "+" },
]
[actuators]
)toml" + actuators +
           "\n[load.push]\nforce = [1, 2]\n[motion.m]\nx = 150\ny = 120\nphi = \"2deg\"\n";
  };
  std::vector<json> found;
  for (const char* angle_unit : {"rad", "deg"})
    for (const char* actuators :
         {"error = \"0.1deg\"", "unit = \"rad\"\nerror = \"0.1*deg\"", "error = \"pi/1800\""}) {
      write(text(angle_unit, actuators));
      found.push_back(components({"error"}).at("v_x"));
      EXPECT_EQ(found.back()["attained"], found.front()["attained"]) << angle_unit << actuators;
    }
  EXPECT_EQ(components({"force"}).at("leg 1")["unit"], "N mm");
  for (const char* unit : {"deg", "°", "degrees", "mm"}) {
    write(text("deg", "unit = \"" + std::string(unit) + "\"\nerror = 0.1"));
    EXPECT_EQ(bound({"error"}).exit_code, 65) << unit;
  }
}

}  // namespace
}  // namespace regulus::detail::test::motors_in_degrees
