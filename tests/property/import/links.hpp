// SPDX-License-Identifier: GPL-3.0-or-later
// Random robots with loops through every kind of file: the [closure] against the kinematics of the
// file, which the tests have of their own.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "codegen/model/import/import.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/loops/compared_closure.hpp"
#include "tests/support/loops/random_loops.hpp"

namespace regulus::detail::test {

struct Compared {
  int robots = 0, refused = 0, drives = 0, ends = 0;
};

constexpr int kMostRanks = 1000;  ///< that are compared: they are dear

/// The model's start is a configuration of the file; so is what Newton's method finds in the file for
/// random drives, for the model; and the matrix of the model is regular where only idle freedoms move
/// while the motors are locked.
inline void compare(const ComparedClosure& compared, const Model& model, std::size_t idle,
                    std::uint64_t seed, int drives, double tolerance, Compared& result) {
  RandomSource random(seed);
  const auto start = compared.start(random, tolerance);
  ASSERT_TRUE(start) << "the file has no configuration at the start";
  EXPECT_LT(compared.residual(*start), tolerance);
  const auto motion = std::ranges::find(model.motions, "around_home", &Motion::name);
  ASSERT_NE(motion, model.motions.end());
  Configuration at = *start;
  for (int drive = 0; drive < drives; ++drive) {
    if (!compared.drive(at, compared.drives(*motion, random), 0.02)) {
      ++result.ends;
      at = *start;
      continue;
    }
    ++result.drives;
    ASSERT_LT(compared.residual(at), tolerance) << "drive " << drive;
    if (drive >= kMostRanks) continue;
    const double least = compared.least_of_model(at);
    const ComparedClosure::Locked locked = compared.locked(at);
    if (least > 1e-5) {
      ASSERT_LT(locked.moves_unknown, 1e-4) << "drive " << drive << ", least " << least;
      ASSERT_EQ(locked.freedoms, idle) << "drive " << drive << ", least " << least;
    }
  }
}

inline void expect_closures(std::uint64_t first, int count, int drives, Compared& result) {
  for (std::uint64_t seed = first; seed < first + std::uint64_t(count); ++seed) {
    const RandomLoops loops(seed);
    Imported imported;
    try {
      imported = import_robot(loops.text(), "loops.xml", loops.options());
    } catch (const InputError&) {
      ++result.refused;
      continue;
    }
    ++result.robots;
    const Model model = parse_model(imported.model, "loops.toml");
    const ComparedClosure compared(loops.robot(), model);
    compare(compared, model, loops.idle(), seed, drives, 1e-9, result);
    if (testing::Test::HasFailure())
      FAIL() << "seed " << seed << '\n'
             << loops.describe() << '\n'
             << imported.report() << imported.model;
  }
}

}  // namespace regulus::detail::test
