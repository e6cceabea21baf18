// SPDX-License-Identifier: GPL-3.0-or-later
// The legs of some robots have passive constraints beside their motors: a Delta's parallelograms, the
// hinges of a 3-RPS. Errors, stiffness and limits of [actuators] are those of motors. The oracle has the
// rates of the joints by differences, and solves the few equations in doubles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/bounded_model.hpp"
#include "tests/support/files.hpp"
#include "tests/support/legs/inverse_kinematics.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

/// In metres; the platform does not turn.
std::array<PlainLeg, 3> delta_legs() {
  std::array<PlainLeg, 3> legs;
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::cos(kThird * double(i)), s = std::sin(kThird * double(i));
    legs.at(i) = {DrivenBy::kCrank,
                  {0.1 * c, 0.1 * s, 0},
                  {0.04 * c, 0.04 * s, 0},
                  {s, -c, 0},
                  0.1,
                  0.24,
                  true};
  }
  return legs;
}

/// The rates of the three cranks for the three velocities.
std::vector<Row> rates_of_delta(const Vec& position) {
  std::vector<Row> rows;
  for (const PlainLeg& leg : delta_legs()) {
    Frame platform;
    platform.p = position;
    const auto rates = rates_of(leg, platform);
    rows.emplace_back(rates.begin(), rates.begin() + 3);
  }
  return rows;
}

std::string delta_model(const std::string& actuators) {
  return R"toml(regulus = 1
name = "delta in metres"
[legs]
unit = "m"
orientation = "fixed"
crank = 0.1
rod = 0.24
mode = "+"
leg = [
  { type = "delta", base = [0.1, 0, 0], platform = [0.04, 0, 0], axis = [0, -1, 0] },
  { type = "delta", base = ["0.1*cos(120*deg)", "0.1*sin(120*deg)", 0], platform = ["0.04*cos(120*deg)", "0.04*sin(120*deg)", 0], axis = ["sin(120*deg)", "-cos(120*deg)", 0] },
  { type = "delta", base = ["0.1*cos(240*deg)", "0.1*sin(240*deg)", 0], platform = ["0.04*cos(240*deg)", "0.04*sin(240*deg)", 0], axis = ["sin(240*deg)", "-cos(240*deg)", 0] },
]
[load.tip]
force = [[-2, 2], [-2, 2], [-10, 0]]
moment = [0.5, 0, 0]
[twist.fast]
velocity = [1, 0, 0]
[actuators]
)toml" + actuators +
         R"toml(
[motion.work]
x = [-0.02, 0.02]
y = [-0.02, 0.02]
z = [-0.24, -0.22]
)toml";
}

/// The largest torque at the corners of the motion and of the load, and between them.
double largest_torque() {
  double largest = 0;
  for (const double x : {-0.02, 0.0, 0.02})
    for (const double y : {-0.02, 0.0, 0.02})
      for (const double z : {-0.24, -0.23, -0.22}) {
        const auto M = transposed(rates_of_delta({x, y, z}));
        for (const double fx : {-2.0, 2.0})
          for (const double fy : {-2.0, 2.0})
            for (const double fz : {-10.0, 0.0})
              for (const double torque : solved(M, {fx, fy, fz}))
                largest = std::fmax(largest, std::fabs(torque));
      }
  return largest;
}

class ConstraintRows : public BoundedModel {};

TEST_F(ConstraintRows, OfADeltaTakeNoLimits) {
  const double torque = largest_torque();
  EXPECT_NEAR(torque, 0.811, 0.001);
  for (const bool is_held : {true, false}) {
    const std::string limit = number(torque * (is_held ? 1.02 : 0.98)),
                      certificate = path(is_held ? "held" : "not_held");
    write(delta_model("force = [-" + limit + ", " + limit + "]"));
    const CommandResult result = run_command({kCommand, "check", model_, "--load", "tip",
                                              "--threads", "1", "--certificate", certificate});
    EXPECT_EQ(result.output, is_held ? "FEASIBLE\n" : "INFEASIBLE\n") << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("N m"));
    EXPECT_THAT(file_contents(certificate), HasSubstr("limits free\nlimits free\nlimits free\n"));
    EXPECT_EQ(verify(certificate).output, "VERIFIED\n") << verify(certificate).errors;
    EXPECT_EQ(run_command({kVerify, certificate}).output, "VERIFIED\n");
  }
}

/// Somewhere in the motion the load is not held over whole boxes, and elsewhere it is.
TEST_F(ConstraintRows, OfADeltaTakeNoLimitsInAPaving) {
  write(delta_model("force = [-0.7, 0.7]"));
  const std::string certificate = path("paving");
  const CommandResult result =
      run_command({kCommand, "locate", model_, "--load", "tip", "--threads", "1", "--resolution",
                   "1/16", "--range", "z=-0.24:-0.16", "--certificate", certificate});
  EXPECT_EQ(result.output, "INFEASIBLE\n") << result.errors;
  const std::string text = file_contents(certificate);
  EXPECT_THAT(text, HasSubstr(" infeasible\n"));
  EXPECT_THAT(text, HasSubstr(" feasible\n"));
  const CommandResult verified =
      run_command({kVerify, certificate, "--model", model_, "--allow-options"});
  EXPECT_EQ(verified.output, "VERIFIED\n") << verified.errors;
}

TEST_F(ConstraintRows, OfADeltaAreNoLegs) {
  write(delta_model("force = [-1, 1]"));
  const auto forces = components({"force", "--range", "x=0.01:0.01", "--range", "y=0:0", "--range",
                                  "z=-0.23:-0.23", "--gap", "1e-3"});
  ASSERT_EQ(forces.size(), 3);
  const auto M = transposed(rates_of_delta({0.01, 0, -0.23}));
  for (std::size_t i = 0; i < 3; ++i) {
    double most = 0;
    for (const double fx : {-2.0, 2.0})
      for (const double fy : {-2.0, 2.0})
        for (const double fz : {-10.0, 0.0})
          most = std::fmax(most, std::fabs(solved(M, {fx, fy, fz})[i]));
    const json& leg = forces.at("leg " + std::to_string(i + 1));
    expect_bracket(leg, most);
    EXPECT_EQ(leg["unit"], "N m");
  }
  EXPECT_THAT(bound({"force", "--leg", "4"}).errors, HasSubstr("expected a number from 1 to 3"));
  const auto speeds = components({"speed"});
  EXPECT_EQ(speeds.size(), 3);
  EXPECT_EQ(speeds.at("leg 1")["unit"], "rad/s");
}

TEST_F(ConstraintRows, OfADeltaHaveNoErrors) {
  for (const char* actuators : {"error = 0.001", "error = [0.001, 0.001, 0.001]",
                                "error = [0.001, 0.001, 0.001, 0, 0, 0]"}) {
    write(delta_model(actuators));
    const auto errors = components({"error", "--range", "x=0.01:0.01", "--range", "y=0:0",
                                    "--range", "z=-0.23:-0.23", "--gap", "1e-3"});
    const auto M = rates_of_delta({0.01, 0, -0.23});
    Row sums(3, 0.0);
    for (std::size_t motor = 0; motor < 3; ++motor) {
      const Row column = column_of_inverse(M, motor);
      for (std::size_t k = 0; k < 3; ++k) sums[k] += 0.001 * std::fabs(column[k]);
    }
    expect_bracket(errors.at("v_x"), sums[0]);
    expect_bracket(errors.at("v_y"), sums[1]);
    expect_bracket(errors.at("v_z"), sums[2]);
    EXPECT_LT(errors.at("w_x")["proved"].get<double>(), 1e-6);  // it cannot turn
  }
  write(delta_model("error = [0.001, 0.001, 0.001, 0.001]"));
  EXPECT_THAT(bound({"error"}).errors,
              HasSubstr("one value, or 3, one for each motor, or 6, one for each row"));
}

TEST_F(ConstraintRows, WithErrorsOfMotorsAreNotVerified) {
  write(delta_model("error = 0.001"));
  const std::string certificate = path("error");
  EXPECT_EQ(bound({"error", "--freedom", "v_x", "--gap", "0.05", "--certificate", certificate,
                   "--threads", "1"})
                .exit_code,
            0);
  const std::string safe = certificate + ".v_x.safe";
  EXPECT_EQ(verify(safe).output, "VERIFIED\n") << verify(safe).errors;
  std::string text = file_contents(safe);
  const std::string none = "motor-error 0\n";
  ASSERT_NE(text.find(none), std::string::npos);
  text.replace(text.find(none), none.size(), "motor-error 1/1000\n");
  std::ofstream(safe) << text;
  EXPECT_EQ(verify(safe).output, "REJECTED\n");
  EXPECT_THAT(verify(safe).errors, HasSubstr("motor-error"));
}

TEST_F(ConstraintRows, WithLimitsOfMotorsAreNotVerified) {
  write(delta_model("force = [-1.2, 1.2]"));
  const std::string certificate = path("held");
  EXPECT_EQ(run_command({kCommand, "check", model_, "--load", "tip", "--range", "x=0:0", "--range",
                         "y=0:0", "--certificate", certificate})
                .exit_code,
            0);
  const std::string text = file_contents(certificate);
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"limits free\n", "limits -100 : 100\n"},
        {"limits -6/5 : 6/5\n", "limits free\n"}}) {
    std::string forged = text;
    ASSERT_NE(forged.find(from), std::string::npos);
    forged.replace(forged.find(from), from.size(), to);
    std::ofstream(certificate) << forged;
    EXPECT_EQ(run_command({kVerify, certificate, "--model", model_, "--allow-options"}).output,
              "REJECTED\n");
  }
}

/// A matrix of one's own says how many of its rows motors drive.
TEST_F(ConstraintRows, OfAMatrixAreNamedByItsMotors) {
  const auto text = [](const std::string& motors) {
    return R"toml(regulus = 1
name = "slide"
[pose]
x = "mm"
phi = "rad"
[matrix]
twist = ["v_x", "w"]
rows = [["1", "10"], ["0", "1"]]
)toml" + motors +
           R"toml([load.push]
force = [3]
moment = [50]
[actuators]
error = 0.1
force = [-4, 4]
[motion.m]
x = [0, 1]
phi = 0
)toml";
  };
  write(text("motors = 1\n"));
  EXPECT_EQ(components({"force"}).size(), 1);
  EXPECT_LT(components({"error"}).at("w")["proved"].get<double>(), 1e-6);
  expect_bracket(components({"error"}).at("v_x"), 0.1);
  EXPECT_EQ(run_command({kCommand, "check", model_, "--load", "push"}).output, "FEASIBLE\n");
  const std::string certificate = path("slide");
  static_cast<void>(
      run_command({kCommand, "check", model_, "--load", "push", "--certificate", certificate}));
  EXPECT_EQ(verify(certificate).output, "VERIFIED\n") << verify(certificate).errors;
  write(text(""));  // the force of the second row is 50 − 10·3
  EXPECT_EQ(components({"force"}).size(), 2);
  EXPECT_EQ(run_command({kCommand, "check", model_, "--load", "push"}).output, "INFEASIBLE\n");
  write(text("motors = 3\n"));
  EXPECT_THAT(bound({"force"}).errors, HasSubstr("the number of rows that motors drive, 1 to 2"));
}

}  // namespace
}  // namespace regulus::detail::test
