// SPDX-License-Identifier: GPL-3.0-or-later
// Legs with a hinge: the rows of motor and constraint against the screws of each joint.
#include "tests/models/posed_leg.hpp"

namespace regulus::detail::test {
namespace {

/// A leg RPS or PRS: its hinge along `g`, the rail and the rod in the plane across it.
Posed hinged_leg(Poses& random, const std::string& type) {
  const Vector<double> A = random_vector(random, 1), b = random_vector(random, 1);
  const Frame frame = random_frame(random);
  const double first = random.between(1, 2), rod = random.between(1, 2);
  const double bend = random.between(-2, 2), roll = random.between(-1, 1),
               pitch = random.between(-1, 1), yaw = random.between(-1, 1);
  const Vector<double> along = std::cos(bend) * frame.n + std::sin(bend) * frame.f;
  const Vector<double> C = A + first * frame.f;
  const Vector<double> B = type == "RPS" ? C : C + rod * along;
  const Vector<double> X = B - turned(2, yaw, turned(1, pitch, turned(0, roll, b)));
  Posed posed;
  posed.pose = {{"x", X[0]},    {"y", X[1]},      {"z", X[2]},
                {"roll", roll}, {"pitch", pitch}, {"yaw", yaw}};
  for (const Vector<double>& axis : {kX, kY, kZ}) posed.passive.push_back(turn(axis, B, X));
  posed.passive.push_back(turn(frame.g, type == "RPS" ? A : C, X));
  posed.joints = {slide(frame.f)};
  posed.values = {first};
  posed.leg = "type = \"" + type + "\"\nbase = " + list(A, 3) + "\nplatform = " + list(b, 3) +
              "\nhinge = " + list(0.7 * frame.g, 3) + '\n';
  if (type == "RPS") return posed;
  posed.leg += "axis = " + list(1.5 * frame.f, 3) + '\n' + key("rod", rod);
  posed.leg += dot(B - A, frame.f) < first ? "mode = \"+\"\n" : "mode = \"-\"\n";
  return posed;
}

TEST(Legs, WithAHingeHaveRowsOfMotorAndConstraint) {
  Poses random;
  for (const char* type : {"RPS", "PRS"})
    for (int trial = 0; trial < 40; ++trial) {
      const Posed posed = hinged_leg(random, type);
      // Random directions are across each other but for rounding, as uncertain ones are.
      const Model model =
          parsed(posed, "orientation = \"roll-pitch-yaw\"\naxis_tolerance = 0.001\n",
                 other_legs("type = \"UPS\"\n"));
      ASSERT_EQ(model.matrix.rows(), 7U);
      expect_rate(row_of(model, 0, posed.pose), posed, 1, false);
      // No joint of the leg moves against the force of the hinge.
      expect_rate(row_of(model, 6, posed.pose), posed, 0, false);
      EXPECT_GT(std::fabs(row_of(model, 6, posed.pose)[0]), 0);
    }
}

/// The rail need not be across the hinge if the file says that directions are uncertain: the force
/// that the leg holds against its motor, too, is in the plane of hinge and rod.
TEST(Legs, WithAHingeAlongTheRailHoldWhatTheMotorDoesNotMove) {
  Poses random;
  Posed posed = hinged_leg(random, "PRS");
  const Model model = parsed(posed, "orientation = \"roll-pitch-yaw\"\naxis_tolerance = 0.001\n",
                             other_legs("type = \"UPS\"\n"));
  Point point = posed.pose;
  for (const GeometryParameter& g : model.geometry) point[g.name] = evaluate(g.value, point);
  for (const char* axis : {"x", "y", "z"}) point[std::string("h1_") + axis] += 0.2;
  double power = 0, size = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const double force = evaluate(model.matrix(6, i), point);
    power += force * point[std::string("n1_") + "xyz"[i]];
    size += std::fabs(force);
  }
  EXPECT_GT(size, 1e-3);
  EXPECT_NEAR(power, 0, 1e-12);
}

}  // namespace
}  // namespace regulus::detail::test
