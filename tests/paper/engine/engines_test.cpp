// SPDX-License-Identifier: GPL-3.0-or-later
// Engines give the same bits, which property_jit tests of every operation, of C++ text too: so they
// decide the same boxes, and the other tests here take one of them.
#include <gtest/gtest.h>

#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/settings.hpp"
#include "runtime/search/solver.hpp"

namespace regulus::detail::engines {
namespace {

struct Case {
  const char* model;
  const char* motion;
  Verdict verdict;
};

Result solved(const Case& c, Isa isa, Engine engine) {
  ModelOptions model;
  model.path = std::string(REGULUS_SOURCE_DIR "/models/") + c.model + ".toml";
  model.motion = c.motion;
  SearchOptions search;
  search.isa = isa;
  search.engine = engine;
  const PreparedSearch preparation = prepare(model, search);
  return solve(preparation.problem(), settings_from(search));
}

void expect_the_same(const Result& result, const Result& expected) {
  EXPECT_EQ(result.verdict, expected.verdict);
  EXPECT_EQ(result.statistics.boxes, expected.statistics.boxes);
  EXPECT_EQ(result.statistics.leaves, expected.statistics.leaves);
  ASSERT_EQ(result.witness.has_value(), expected.witness.has_value());
  if (!result.witness) return;
  ASSERT_EQ(result.witness->points.size(), expected.witness->points.size());
  for (std::size_t k = 0; k < expected.witness->points.size(); ++k)
    EXPECT_EQ(result.witness->points[k].variables, expected.witness->points[k].variables);
}

TEST(Engines, DecideTheSameBoxes) {
  for (const Case& c : {Case{"robot_2", "table5_30", Verdict::kNoSingularity},
                        {"robot_1", "wide_40", Verdict::kSingularity}})
    for (const Isa isa : kAllIsas) {
      if (!supported(isa)) continue;
      const Result interpreted = solved(c, isa, Engine::kInterpreted);
      EXPECT_EQ(interpreted.verdict, c.verdict) << name(isa);
      EXPECT_LE(interpreted.statistics.boxes, 60U) << name(isa);
      expect_the_same(solved(c, isa, Engine::kJit), interpreted);
    }
}

}  // namespace
}  // namespace regulus::detail::engines
