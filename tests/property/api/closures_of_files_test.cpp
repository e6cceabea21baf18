// SPDX-License-Identifier: GPL-3.0-or-later
// What a verdict about the [closure] of an imported robot means for the robot of the file: where there
// is no singularity, the motors can be anywhere in the motion, and nothing but idle links moves while
// they are locked.
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/answer/ask.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/loops/compared_closure.hpp"
#include "tests/support/loops/random_loops.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

std::optional<std::string> imported(const RandomLoops& loops) try {
  return import_robot(loops.text(), "loops.xml", loops.options()).model;
} catch (const InputError&) {
  return std::nullopt;
}

Verdict verdict_around_home(const std::string& model) {
  const TemporaryDirectory folder;
  AskCheck asked;
  asked.model.path = folder.path() / "model.toml";
  std::ofstream(asked.model.path) << model;
  asked.model.motion = "around_home";
  asked.search.engine = Engine::kInterpreted;
  asked.search.threads = 1;
  asked.search.max_boxes = 300;
  return ask(asked, {})->result.verdict;
}

TEST(ClosuresOfFiles, HaveVerdictsAboutTheRobotsOfTheFiles) {
  int proved = 0, open = 0;
  for (std::uint64_t seed = 500; seed < 500 + std::uint64_t(trials(12, 24)); ++seed) {
    const RandomLoops loops(seed);
    const auto text = imported(loops);
    if (!text) continue;
    if (verdict_around_home(*text) != Verdict::kNoSingularity) {
      ++open;
      continue;
    }
    ++proved;
    const Model model = parse_model(*text, "loops.toml");
    const ComparedClosure compared(loops.robot(), model);
    const auto motion = std::ranges::find(model.motions, "around_home", &Motion::name);
    RandomSource random(seed);
    auto at = compared.start(random, 1e-9);
    ASSERT_TRUE(at) << "seed " << seed;
    for (int drive = 0; drive < 10; ++drive) {
      ASSERT_TRUE(compared.drive(*at, compared.drives(*motion, random), 0.01))
          << "seed " << seed << '\n'
          << loops.describe() << *text;
      const ComparedClosure::Locked locked = compared.locked(*at);
      ASSERT_EQ(locked.freedoms, loops.idle()) << "seed " << seed << '\n'
                                               << loops.describe() << *text;
      ASSERT_LT(locked.moves_unknown, 1e-5) << "seed " << seed;
    }
  }
  EXPECT_GE(proved, trials(4, 10));
  EXPECT_LE(open, proved + trials(3, -1));
}

}  // namespace
}  // namespace regulus::detail::test
