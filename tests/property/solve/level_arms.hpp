// SPDX-License-Identifier: GPL-3.0-or-later
// Random arms with four joints that turn about one direction alone.
#pragma once

#include "tests/property/solve/coupled_arms.hpp"

namespace regulus::detail::test::coupled_arms {

/// Two parallelograms keep the tool level.
inline Arm palletizer(RandomSource& random) {
  const auto length = [&] { return random.between(0.1, 0.9); };
  return {{.xyz = {0, 0, length()}},
          {.xyz = {length(), random.between(-0.2, 0.2), 0}, .axis = {0, 1, 0}},
          {.xyz = {0, 0, length()}, .axis = {0, 1, 0}, .leader = 1, .multiplier = -1},
          {.xyz = {0, random.between(-0.2, 0.2), 0}, .axis = {0, 1, 0}},
          {.xyz = {length(), 0, 0}, .axis = {0, 1, 0}, .leader = 2, .multiplier = -1},
          {.xyz = {length() / 2, 0, -length()}, .axis = {0, 0, -1}},
          {.xyz = {0.1, 0.1, 0}, .axis = {0, 0, 1}, .leader = 3, .multiplier = 0}};
}

/// Three joints turn and one slides, in any order.
inline Arm scara(RandomSource& random) {
  Arm arm(4);
  for (Joint& joint : arm) {
    joint.xyz = random_vector(random);
    joint.axis = {0, 0, random.one_in(2) ? 1.0 : -1.0};
  }
  Joint& slide = arm[random.below(4)];
  slide.slides = true;
  if (random.one_in(2)) slide.axis = {0, 3, 4};
  return arm;
}

}  // namespace regulus::detail::test::coupled_arms
