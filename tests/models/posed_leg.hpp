// SPDX-License-Identifier: GPL-3.0-or-later
// A leg of [legs] in some pose, and the screws of its joints there.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "tests/models/jacobian.hpp"

namespace regulus::detail::test {

/// The twist of the platform that one unit of a joint's speed gives, at the platform's origin X.
inline Row turn(const Vector<double>& axis, const Vector<double>& through,
                const Vector<double>& X) {
  const Vector<double> v = cross(axis, X - through);
  return {v[0], v[1], v[2], axis[0], axis[1], axis[2]};
}
inline Row slide(const Vector<double>& along) { return {along[0], along[1], along[2], 0, 0, 0}; }

inline const Vector<double> kX = {1, 0, 0}, kY = {0, 1, 0}, kZ = {0, 0, 1};

/// A leg in some pose, by its own joints: the platform's pose and the joints' screws.
struct Posed {
  std::string leg;  ///< as in a model file
  Point pose;
  std::vector<Row> joints;       ///< those of the leg's name, in order
  std::vector<Row> passive;      ///< further passive freedoms
  std::vector<double> values{};  ///< of the joints, as `range` counts them
};

inline std::string list(const Vector<double>& v, std::size_t size) {
  std::ostringstream text;
  text.precision(17);
  text << '[';
  for (std::size_t i = 0; i < size; ++i) text << (i > 0 ? ", " : "") << v[i];
  return text.str() + ']';
}

inline std::string key(const std::string& name, double value) {
  std::ostringstream text;
  text.precision(17);
  text << name << " = " << value << '\n';
  return text.str();
}

inline Vector<double> random_vector(Poses& random, double size) {
  return {random.between(-size, size), random.between(-size, size), random.between(-size, size)};
}

inline double product(const Row& row, const Row& twist) {
  double sum = 0;
  for (std::size_t j = 0; j < row.size(); ++j) sum += row[j] * twist[j];
  return sum;
}

inline Row column_subset(const Row& twist, bool planar) {
  return planar ? Row{twist[0], twist[1], twist[5]} : twist;
}

inline Model parsed(const Posed& posed, const std::string& head, const std::string& others,
                    const std::string& more = {}) {
  std::string text = "regulus = 1\nname = \"leg\"\n[legs]\n" + head + "[[legs.leg]]\n" + posed.leg +
                     others + "[motion.here]\n";
  for (const auto& [name, value] : posed.pose) text += key(name, value);
  return parse_model(text + more, "leg.toml");
}

inline Row row_of(const Model& model, unsigned i, Point point) {
  for (const GeometryParameter& g : model.geometry) point[g.name] = evaluate(g.value, point);
  Row row;
  for (unsigned j = 0; j < model.matrix.cols(); ++j)
    row.push_back(evaluate(model.row_scale[i], point) * evaluate(model.matrix(i, j), point));
  return row;
}

/// The row of the motor has the product ±1 with the twist of its joint and 0 with all others.
inline void expect_rate(const Row& row, const Posed& posed, std::size_t actuated, bool planar) {
  for (std::size_t j = 0; j < posed.joints.size(); ++j) {
    const double rate = product(row, column_subset(posed.joints[j], planar));
    if (j + 1 == actuated)
      EXPECT_NEAR(std::fabs(rate), 1, 1e-8) << posed.leg;
    else
      EXPECT_NEAR(rate, 0, 1e-8) << posed.leg << " joint " << j + 1;
  }
  for (const Row& twist : posed.passive)
    EXPECT_NEAR(product(row, column_subset(twist, planar)), 0, 1e-8) << posed.leg;
}

inline std::string other_legs(const std::string& key_of_type) {
  std::string text;
  for (int leg = 2; leg <= 6; ++leg)
    text += "[[legs.leg]]\n" + key_of_type + "base = [" + std::to_string(leg) +
            ", 1, 0]\nplatform = [1, " + std::to_string(leg) + ", 0]\n";
  return text;
}

struct Frame {
  Vector<double> f, g, n;
};

inline Frame random_frame(Poses& random) {
  const double a = random.between(-3, 3), b = random.between(-3, 3), c = random.between(-3, 3);
  const auto turn_all = [&](const Vector<double>& v) {
    return turned(2, a, turned(1, b, turned(0, c, v)));
  };
  return {turn_all(kX), turn_all(kY), turn_all(kZ)};
}

}  // namespace regulus::detail::test
