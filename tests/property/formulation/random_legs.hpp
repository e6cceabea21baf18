// SPDX-License-Identifier: GPL-3.0-or-later
// Robots on legs with random anchors, axes, lengths and working modes, which reach a small motion.
#pragma once

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "codegen/model/file/model_file.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {

struct Vector {
  double x, y, z;
};

inline double norm(const Vector& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// Two digits, as people write dimensions.
inline double digits(double x) { return std::round(100 * x) / 100; }

/// A leg whose rod reaches the platform at home: crank and rod, or rail and rod.
inline std::string random_leg(const std::string& type, const Vector& home, RandomSource& random) {
  static const Vector axes[] = {{1, 0, 0},      {0, -1, 0}, {0, 0, 1},  {3, 4, 0},
                                {0, 0.6, -0.8}, {1, 1, 0},  {-2, 1, 2}, {0.96, -0.28, 0}};
  const bool planar = type == "RRR";
  const auto point = [&](double size) {
    return Vector{digits(random.between(-size, size)), digits(random.between(-size, size)),
                  planar ? 0 : digits(random.between(-size / 8, size / 8))};
  };
  const Vector A = point(90), B = point(60), v = point(50);
  const Vector n = planar ? Vector{0, 0, 1} : axes[random.below(std::size(axes))];
  Vector u{n.y * v.z - n.z * v.y, n.z * v.x - n.x * v.z, n.x * v.y - n.y * v.x};
  if (type == "PUS") u = n;
  const double length = digits(random.between(25, 45)), scale = length / norm(u);
  const double rod =
      digits(norm({home.x + B.x - A.x - scale * u.x, home.y + B.y - A.y - scale * u.y,
                   home.z + B.z - A.z - scale * u.z}));
  std::ostringstream text;
  const auto write = [&](const char* key, const Vector& p) {
    text << key << " = [" << p.x << ", " << p.y;
    if (!planar) text << ", " << p.z;
    text << "]\n";
  };
  text << "[[legs.leg]]\ntype = \"" << type << "\"\n";
  write("base", A);
  write("platform", B);
  if (!planar) write("axis", n);
  if (type != "PUS") text << "crank = " << length << '\n';
  text << "rod = " << rod << "\nmode = \"" << (random.one_in(2) ? '+' : '-') << "\"\n";
  return text.str();
}

inline Model random_robot(const std::string& type, RandomSource& random) {
  const bool planar = type == "RRR";
  const Vector home{digits(random.between(-30, 30)), digits(random.between(-30, 30)),
                    planar ? 0 : digits(random.between(60, 140) * (random.one_in(3) ? -1 : 1))};
  std::ostringstream text;
  text << "regulus = 1\nname = \"random\"\n[legs]\nunit = \"mm\"\n";
  if (!planar) text << "orientation = \"roll-pitch-yaw\"\n";
  for (int i = 0; i < (planar ? 3 : 6); ++i) text << random_leg(type, home, random);
  const auto range = [&](const char* name, double middle, double half) {
    text << name << " = [" << middle - half << ", " << middle + half << "]\n";
  };
  text << "[motion.work]\n";
  range("x", home.x, 3);
  range("y", home.y, 3);
  if (planar) {
    range("phi", 0, 0.05);
  } else {
    range("z", home.z, 3);
    for (const char* angle : {"roll", "pitch", "yaw"}) range(angle, 0, 0.05);
  }
  const TemporaryDirectory directory;
  const std::string path = directory.path() / "model.toml";
  std::ofstream(path) << text.str();
  return load_model(path);
}

}  // namespace regulus::detail::test
