// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/mechanism_bases.hpp"

#include "tests/attack/forge/mechanism_texts.hpp"

namespace regulus::attack {

std::vector<Base> of_mechanisms() {
  return {
      {"branch", kSlider, {"check", "work"}},
      {"five-bar", "five_bar_closure", {"check", "work"}},
      {"toggle", kRocker, {"check", "work"}},
      {"force over a branch",
       kDriven,
       {"bound", "work", "force", "--load", "pull", "--leg", "1", "--limit", "90"}},
      {"force of a ball over a branch",
       kDriven,
       {"bound", "work", "force", "--load", "ball", "--leg", "1", "--signed", "--limit", "60"}},
      {"error over a branch",
       kDriven,
       {"bound", "work", "error", "--freedom", "phi", "--limit", "0.01"}},
      {"speed over a branch",
       kDriven,
       {"bound", "work", "speed", "--freedom", "s", "--limit", "9"}},
      {"deflection over a branch",
       kDriven,
       {"bound", "work", "deflection", "--load", "pull", "--freedom", "s", "--limit", "0.5"}},
      {"condition over a branch", kDriven, {"bound", "work", "condition", "--limit", "90"}},
      {"determinant over a branch", kDriven, {"bound", "work", "determinant", "--limit", "0.1"}},
      {"speed that is met over a branch",
       kDriven,
       {"bound", "work", "speed", "--freedom", "s", "--limit", "0.5"}},
  };
}

std::vector<Base> of_solutions() {
  return {
      {"list", kLoop, {"solve", "here"}},
      {"list on a curve", kLoop, {"solve", "path"}},
      {"list around a turn", kTurn, {"solve", "here"}},
      {"no configuration", kLoop, {"solve", "nowhere"}},
      {"part of a list", kDouble, {"solve", "here"}},
      {"list in degrees", kDegrees, {"solve", "here"}},
      {"branch in degrees", kDegrees, {"check", "work"}},
      {"postures", kWrist, {"solve", "here"}},
      {"postures by the tool", kWrist, {"solve", "tool"}},
      {"postures beside a held joint", kElbow, {"solve", "here", "--hold", "q3"}},
  };
}

}  // namespace regulus::attack
