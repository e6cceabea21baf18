// SPDX-License-Identifier: GPL-3.0-or-later
// A six-legged platform in C++, written as in the paper: rows (AB, CB × AB), ZXZ angles.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "codegen/model/model.hpp"

namespace regulus::detail::test {

using Anchors = std::array<std::array<int, 3>, 6>;

/// Robot 1 of Table III.
inline constexpr Anchors kRobot1Base = {
    {{-9, 9, 0}, {9, 9, 0}, {12, -3, 0}, {3, -13, 0}, {-3, -13, 0}, {-12, -3, 0}}};
inline constexpr Anchors kRobot1Platform = {
    {{-3, 7, 0}, {3, 7, 0}, {7, -1, 0}, {4, -6, 0}, {-4, -6, 0}, {-7, -1, 0}}};

inline constexpr Anchors kRobot2Base = {{{-2539, 1778, 0},
                                         {2539, 1778, 500},
                                         {2809, 1310, 0},
                                         {270, -3088, 500},
                                         {-270, -3088, 0},
                                         {-2809, 1310, 500}}};
inline constexpr Anchors kRobot2Platform = {{{-657, -239, -100},
                                             {657, -239, 100},
                                             {121, 689, -100},
                                             {-536, -449, 100},
                                             {536, -449, -100},
                                             {-121, 689, 100}}};

struct GoughOptions {
  GiNaC::ex tolerance = 0;  ///< of every anchor coordinate
  bool with_row_scale = false;
  bool shuffled_symbols = false;  ///< creates the symbols in another order
};

inline GiNaC::ex add_coordinate(Model& model, const std::string& name, int value,
                                const GiNaC::ex& tolerance) {
  GeometryParameter g;
  g.symbol = GiNaC::realsymbol(name);
  g.name = name;
  g.value = value;
  g.tolerance = tolerance;
  model.geometry.push_back(g);
  return g.symbol;
}

inline Model gough_model(const Anchors& base, const Anchors& platform,
                         const GoughOptions& options = {}) {
  using GiNaC::cos, GiNaC::ex, GiNaC::sin;
  const std::vector<std::string> names = {"x", "y", "z", "psi", "theta", "phi"};
  std::vector<GiNaC::realsymbol> q(6);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t at = options.shuffled_symbols ? 5 - i : i;
    q[at] = GiNaC::realsymbol(names[at]);
  }
  Model model;
  model.name = "gough";
  for (std::size_t i = 0; i < 6; ++i) model.pose.push_back({q[i], names[i], i < 3 ? "cm" : "rad"});
  const ex cpsi = cos(q[3]), spsi = sin(q[3]), ctheta = cos(q[4]), stheta = sin(q[4]),
           cphi = cos(q[5]), sphi = sin(q[5]);
  const ex R[3][3] = {
      {cpsi * cphi - spsi * ctheta * sphi, -cpsi * sphi - spsi * ctheta * cphi, spsi * stheta},
      {spsi * cphi + cpsi * ctheta * sphi, -spsi * sphi + cpsi * ctheta * cphi, -cpsi * stheta},
      {stheta * sphi, stheta * cphi, ctheta}};
  model.matrix = GiNaC::matrix(6, 6);
  for (unsigned leg = 0; leg < 6; ++leg) {
    ex d[3], arm[3], a[3], b[3];
    for (unsigned c = 0; c < 3; ++c) {
      const std::string tail = std::to_string(leg + 1) + "_" + std::to_string(c + 1);
      a[c] = add_coordinate(model, "A" + tail, base[leg][c], options.tolerance);
      b[c] = add_coordinate(model, "B" + tail, platform[leg][c], options.tolerance);
    }
    for (unsigned c = 0; c < 3; ++c) {
      arm[c] = R[c][0] * b[0] + R[c][1] * b[1] + R[c][2] * b[2];
      d[c] = q[c] + arm[c] - a[c];
    }
    for (unsigned c = 0; c < 3; ++c) {
      const unsigned u = (c + 1) % 3, v = (c + 2) % 3;
      model.matrix(leg, c) = d[c];
      model.matrix(leg, c + 3) = arm[u] * d[v] - arm[v] * d[u];
    }
    if (options.with_row_scale) {
      const ex square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      model.row_scale.push_back(GiNaC::pow(square, GiNaC::numeric(-1, 2)));
    }
  }
  return model;
}

/// Returns the box variety: every pose parameter is a motion parameter.
inline Motion box_motion(const Model& model) {
  Motion motion;
  motion.name = "box";
  for (const PoseParameter& p : model.pose) {
    motion.parameters.push_back({p.symbol, p.name, p.unit, {-1, 1}});
    motion.pose.push_back(p.symbol);
    motion.error.push_back(0);
  }
  return motion;
}

inline Model robot_1(const GoughOptions& options = {}) {
  return gough_model(kRobot1Base, kRobot1Platform, options);
}

inline Model robot_2(const GoughOptions& options = {}) {
  return gough_model(kRobot2Base, kRobot2Platform, options);
}

}  // namespace regulus::detail::test
