// SPDX-License-Identifier: GPL-3.0-or-later
// The hinges of a 3-RPS robot are passive constraints: motors alone have errors, stiffness and limits. The
// oracle has the rates of lengths, and of the joints' distances from the planes of their legs, by
// differences.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/bounded_model.hpp"
#include "tests/support/files.hpp"
#include "tests/support/legs/inverse_kinematics.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

class HingeRows : public BoundedModel {
 protected:
  /// What is 0 has no lower end, and a proof that it is almost 0.
  static void expect_bracket_or_nothing(const json& one, double value) {
    if (value > 1e-6) return expect_bracket(one, value);
    EXPECT_TRUE(one["closed"].get<bool>()) << one;
    EXPECT_LT(one["proved"].get<double>(), 1e-9) << one;
  }
};

constexpr const char* kHinges = R"toml(regulus = 1
name = "3-RPS"
[legs]
unit = "mm"
orientation = "fixed"
leg = [
  { type = "RPS", base = [100, 0, 0], platform = [60, 0, 0], hinge = [0, 1, 0] },
  { type = "RPS", base = [-50, "50*sqrt(3)", 0], platform = [-30, "30*sqrt(3)", 0], hinge = ["-sqrt(3)/2", "-1/2", 0] },
  { type = "RPS", base = [-50, "-50*sqrt(3)", 0], platform = [-30, "-30*sqrt(3)", 0], hinge = ["sqrt(3)/2", "-1/2", 0] },
]
[load.side]
force = [50, 0, -30]
moment = [0, 0, 0]
[actuators]
error = 0.01
stiffness = 100
)toml";

/// The rates of the three lengths, and of the distances of the joints from the planes of their legs.
std::vector<Row> rates_of_hinges(double height) {
  std::vector<Row> lengths, distances;
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::cos(kThird * double(i)), s = std::sin(kThird * double(i));
    const PlainLeg leg{DrivenBy::kLength, {100 * c, 100 * s, 0}, {60 * c, 60 * s, 0}};
    Frame platform;
    platform.p = {0, 0, height};
    const auto rates = rates_of(leg, platform);
    lengths.emplace_back(rates.begin(), rates.end());
    const Vec h{-s, c, 0};
    Row distance;
    for (std::size_t k = 0; k < 6; ++k) {
      constexpr double kStep = 1e-5;
      const auto at = [&](double step) {
        Frame moved = platform;
        Vec axis{};
        axis.at(k % 3) = 1;
        if (k < 3)
          moved.p = moved.p + step * axis;
        else
          moved.R = turn_about(axis, step) * moved.R;
        return inner(h, moved.R * leg.platform + moved.p);
      };
      distance.push_back((at(kStep) - at(-kStep)) / (2 * kStep));
    }
    distances.push_back(distance);
  }
  lengths.insert(lengths.end(), distances.begin(), distances.end());
  return lengths;
}

std::string hinges_model(double height, const std::string& more) {
  return kHinges + more + "\n[motion.up]\nx = 0\ny = 0\nz = " + number(height) + "\n";
}

TEST_F(HingeRows, TakeNothingOfTheMotors) {
  const double height = 155;
  const auto M = rates_of_hinges(height);
  const Row forces = solved(transposed(M), {50, 0, -30, 0, 0, 0});
  Row errors(6, 0.0), deflections(6, 0.0);
  double largest = 0;
  for (std::size_t motor = 0; motor < 3; ++motor) {
    const Row column = column_of_inverse(M, motor);
    largest = std::fmax(largest, std::fabs(forces[motor]));
    for (std::size_t k = 0; k < 6; ++k) {
      errors[k] += 0.01 * std::fabs(column[k]);
      deflections[k] += column[k] * forces[motor] / 100;
    }
  }
  write(hinges_model(height, ""));
  const auto found = components({"error", "--gap", "1e-3"});
  const auto moved = components({"deflection", "--gap", "1e-3"});
  const std::array<const char*, 6> names{"v_x", "v_y", "v_z", "w_x", "w_y", "w_z"};
  for (std::size_t k = 0; k < 6; ++k) {
    expect_bracket_or_nothing(found.at(names.at(k)), errors[k]);
    expect_bracket_or_nothing(moved.at(names.at(k)), std::fabs(deflections[k]));
  }
  for (const bool is_held : {true, false}) {
    const std::string limit = number(largest * (is_held ? 1.001 : 0.999)),
                      certificate = path(is_held ? "held" : "not_held");
    write(hinges_model(height, "force = [-" + limit + ", " + limit + "]"));
    const CommandResult result =
        run_command({kCommand, "check", model_, "--load", "side", "--certificate", certificate});
    EXPECT_EQ(result.output, is_held ? "FEASIBLE\n" : "INFEASIBLE\n") << result.errors;
    EXPECT_EQ(verify(certificate).output, "VERIFIED\n") << verify(certificate).errors;
  }
}

TEST_F(HingeRows, GiveWayToNoForce) {
  write(hinges_model(155, ""));
  const std::string certificate = path("deflection");
  EXPECT_EQ(bound({"deflection", "--freedom", "v_z", "--certificate", certificate}).exit_code, 0);
  const std::string safe = certificate + ".v_z.safe", text = file_contents(safe);
  EXPECT_THAT(text, HasSubstr("stiffness rigid\nstiffness rigid\nstiffness rigid\n"));
  EXPECT_EQ(verify(safe).output, "VERIFIED\n") << verify(safe).errors;
  EXPECT_EQ(verify(certificate + ".v_z.singular").output, "VERIFIED\n");
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"stiffness rigid\n", "stiffness 100\n"},
        {"stiffness 100\n", "stiffness rigid\n"}}) {
    std::string forged = text;
    forged.replace(forged.find(from), from.size(), to);
    std::ofstream(safe) << forged;
    EXPECT_EQ(verify(safe).output, "REJECTED\n");
  }
}

}  // namespace
}  // namespace regulus::detail::test
