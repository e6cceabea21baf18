// SPDX-License-Identifier: GPL-3.0-or-later
// A moment does its work on an angle in radians: with coordinates in degrees there is no force, no
// deflection and no condition number, from the command and for the verifier.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test::loads_in_degrees {
namespace {

using testing::HasSubstr;

constexpr const char* kModel = R"toml(regulus = 1
name = "slider"
[pose]
theta = "deg"
[geometry]
r = 0.1
l = 0.3
[closure]
unknowns = { x = "m", phi = "deg" }
equations = ["r*cos(theta) + l*cos(phi) - x", "r*sin(theta) + l*sin(phi)"]
start = { theta = 30, x = 0.38240653, phi = -9.59406823 }
[actuators]
error = 0.5
speed = 10
stiffness = 50
[load.push]
wrench = [100, 0]
[motion.turn]
theta = [20, 60]
)toml";

/// 0.177 N m for each degree: as a number it is attained, and it is no force.
constexpr const char* kForceByDegrees = R"(regulus-certificate 1
verdict SINGULARITY
claim on the branch through the start, |force of motor 1 under the load push| >= 17728431/100000000 at some pose of the variety and some vector of it
model slider
sha256 e234247f99578356efd266ba5be69e0a4b1f4bf2f45f82cb2abf87d5a66a35e6
motion turn
alpha 0
parameter theta in 20 : 60
constant r = 1/10
constant l = 3/10
pose theta = theta
unknown x = 38240653/100000000 +- 1/100
unknown phi = -959406823/100000000 +- 9/5/pi
start 30
let e1 = phi*pi
let e2 = pi*theta
equation l*cos(1/180*e1) + r*cos(1/180*e2) - x
equation l*sin(1/180*e1) + r*sin(1/180*e2)
quantity force
side absolute
row 1
load push
wrench 100 +- 0
wrench 0 +- 0
bound 17728431/100000000
proof
value 0x1.ep+5
l 0 tube 0x1.4p+5 0x1.7a8231bc249cap-2 -0x1.8be99972c043ap+3 -0x1.72f9846d8c416p-10 -0x1.0bb181b61c8f8p-2 0x1.43ea3a25f829cp-7 0x1.807b242cc3f4ap+0
end 1
)";

class LoadsInDegrees : public testing::Test {
 protected:
  LoadsInDegrees() {
    std::ofstream(model_) << kModel;
    std::ofstream(certificate_) << kForceByDegrees;
  }
  TemporaryDirectory folder_;
  const std::string model_ = folder_.path() / "slider.toml",
                    certificate_ = folder_.path() / "certificate";
};

TEST_F(LoadsInDegrees, AreRefused) {
  for (const char* quantity : {"force", "deflection", "condition", "determinant"}) {
    const CommandResult result = run_command({kCommand, "bound", model_, "turn", quantity});
    EXPECT_EQ(result.exit_code, 64);
    EXPECT_THAT(result.errors, HasSubstr("is in degrees"));
  }
  EXPECT_THAT(run_command({kCommand, "check", model_, "turn", "--alpha", "0.001"}).errors,
              HasSubstr("alpha: 'phi' is in degrees"));
  for (const char* quantity : {"error", "speed"})
    EXPECT_EQ(run_command({kCommand, "bound", model_, "turn", quantity}).exit_code, 0) << quantity;
}

TEST_F(LoadsInDegrees, AreNotVerifiedWithTheirFile) {
  EXPECT_EQ(run_command({kVerify, certificate_}).output, "VERIFIED\n");
  const CommandResult compared = run_command({kVerify, certificate_, "--model", model_});
  EXPECT_EQ(compared.output, "UNFINISHED\n");
  EXPECT_THAT(compared.errors, HasSubstr("is in degrees"));
}

}  // namespace
}  // namespace regulus::detail::test::loads_in_degrees
