// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fstream>

#include "codegen/api/regulus.hpp"
#include "tests/support/random_hexapod.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::test {

struct Found {
  int robots = 0, singular = 0, regular = 0;
};

/// Checks hexapods whose tolerance contains a singular geometry at the pose: the part of the
/// tolerance that it takes to get there is from `least` to `most`.
inline Found find_planted(std::uint64_t seed, int robots, double least, double most,
                          const char* motion) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "hexapod.toml";
  SearchOptions options;
  options.engine = Engine::kInterpreted;
  options.max_boxes = 2000;
  RandomSource random(seed);
  Found found;
  while (found.robots < robots) {
    RandomHexapod robot(random);
    const double tolerance = std::exp(random.between(0.0, 2.5));
    const bool ball = random.one_in(2);
    if (!robot.plant_singularity(tolerance, random.between(least, most), ball)) continue;
    std::ofstream(path) << robot.model(tolerance, ball ? "ball" : "box");
    const Verdict verdict = check(Question::of_file(path, motion), options).verdict;
    ++found.robots;
    if (verdict == Verdict::kSingularity) ++found.singular;
    if (verdict == Verdict::kNoSingularity) ++found.regular;
  }
  return found;
}

}  // namespace regulus::test
