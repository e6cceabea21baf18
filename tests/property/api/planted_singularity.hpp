// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fstream>

#include "codegen/use/api/regulus.hpp"
#include "tests/support/random_hexapod.hpp"
#include "tests/support/random_plant.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {

struct Found {
  int robots = 0, singular = 0, regular = 0;
  std::vector<std::string> others = {};  ///< models for which none was found
};

struct Decided {
  int certified = 0, refuted = 0;
};

/// Checks hexapods with tolerances from 1 to 27 mm.
inline Decided decide_hexapods(std::uint64_t seed, int robots, const char* shape,
                               const char* motion) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "hexapod.toml";
  SearchOptions options;
  options.engine = Engine::kInterpreted;
  options.max_boxes = 2000;
  RandomSource random(seed);
  Decided decided;
  for (int i = 0; i < robots; ++i) {
    const RandomHexapod robot(random);
    std::ofstream(path) << robot.model(std::exp(random.between(0.0, 3.3)), shape);
    const Verdict verdict = check(Question::of_file(path, motion), options).verdict;
    if (verdict == Verdict::kNoSingularity) ++decided.certified;
    if (verdict == Verdict::kSingularity) ++decided.refuted;
  }
  return decided;
}

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

/// The same for the models of random_plant.hpp: the pose and the uncertain quantities are that part
/// of their way to the ends of their ranges; with `alpha`, |det| is that part of α there.
template <class Plant>
Found find_plants(std::uint64_t seed, int robots, double least, double most, const char* motion,
                  bool alpha = false) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "plant.toml";
  SearchOptions options;
  options.engine = Engine::kInterpreted;
  options.max_boxes = 2000;
  RandomSource random(seed);
  Found found;
  while (found.robots < robots) {
    const double part = random.between(least, most);
    const Plant plant(random, {part, random.one_in(2), alpha ? 1.0 : 0.0});
    const std::string model = plant.model();
    if (model.empty()) continue;
    std::ofstream(path) << model;
    const Verdict verdict = check(Question::of_file(path, motion), options).verdict;
    ++found.robots;
    if (verdict == Verdict::kSingularity) ++found.singular;
    if (verdict == Verdict::kNoSingularity) ++found.regular;
    if (verdict != Verdict::kSingularity) found.others.push_back(model);
  }
  return found;
}

}  // namespace regulus::detail::test
