// SPDX-License-Identifier: GPL-3.0-or-later
// The verdicts of Tables IV, V and VII without uncertainty, from the model file to the verdict, on
// every engine. Numbers of boxes are budgets: at most twice those known for the H-matrix test.
#include <gtest/gtest.h>

#include "codegen/question/engine/arb_oracle.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/settings.hpp"
#include "runtime/search/solver.hpp"

namespace regulus {
namespace {

struct Case {
  const char* model;
  const char* motion;
  Verdict verdict;
  std::uint64_t max_boxes;
};

constexpr Verdict kNone = Verdict::kNoSingularity;
constexpr Verdict kSingular = Verdict::kSingularity;

const Case kCases[] = {
    {"robot_1", "table4_1", kNone, 1},     {"robot_1", "table4_2", kNone, 1},
    {"robot_1", "table4_5", kNone, 1},     {"robot_1", "wide_15", kNone, 19},
    {"robot_1", "wide_40", kSingular, 10}, {"robot_1", "T1", kNone, 8},
    {"robot_1", "T2", kNone, 8},           {"robot_2", "table5_20", kNone, 27},
    {"robot_2", "table5_30", kNone, 227},  {"robot_2", "table5_40", kSingular, 20},
};

constexpr const char* kEngines[] = {"avx512", "avx2", "portable", "interpreted"};

using Parameters = std::tuple<Case, const char*>;

class PaperVerdicts : public testing::TestWithParam<Parameters> {};

SearchOptions search_options(const std::string& engine) {
  SearchOptions options;
  if (engine == "interpreted")
    options.engine = Engine::kInterpreted;
  else
    options.isa = parse_isa(engine);
  return options;
}

bool available(const std::string& engine) {
  return engine == "interpreted" || supported(parse_isa(engine).value());
}

/// Returns the sign of det A at a witness point by Arb, without the code of the search.
int arb_sign(const PreparedSearch& preparation, const WitnessPoint& point) {
  ArbOracle oracle(preparation.stages->matrix(), preparation.stages->module().rows, 424);
  const auto determinant = oracle.enclose(point.variables);
  if (!determinant) return 0;
  return determinant->lo > 0 ? 1 : determinant->hi < 0 ? -1 : 0;
}

TEST_P(PaperVerdicts, AreReachedWithinTheBoxBudget) {
  const auto& [expected, engine] = GetParam();
  if (!available(engine)) GTEST_SKIP() << "this processor has no " << engine;
  ModelOptions model;
  model.path = std::string(REGULUS_SOURCE_DIR "/models/") + expected.model + ".toml";
  model.motion = expected.motion;
  const PreparedSearch preparation = prepare(model, search_options(engine));
  const Result result = solve(preparation.problem(), settings_from(search_options(engine)));

  EXPECT_EQ(result.verdict, expected.verdict) << describe(result.reason);
  EXPECT_LE(result.statistics.boxes, 2 * expected.max_boxes);
  if (expected.max_boxes == 1) {
    EXPECT_EQ(result.statistics.boxes, 1u);
  }
  if (expected.verdict != kSingular) return;
  ASSERT_TRUE(result.witness);
  ASSERT_EQ(result.witness->points.size(), 2u);
  EXPECT_EQ(arb_sign(preparation, result.witness->points[0]) *
                arb_sign(preparation, result.witness->points[1]),
            -1);
}

std::string case_name(const testing::TestParamInfo<Parameters>& info) {
  const Case& c = std::get<0>(info.param);
  return std::string(c.model) + "_" + c.motion + "_" + std::get<1>(info.param);
}

INSTANTIATE_TEST_SUITE_P(Tables, PaperVerdicts,
                         testing::Combine(testing::ValuesIn(kCases), testing::ValuesIn(kEngines)),
                         case_name);

/// §II-A: the value is −0.827…; doubles give −10²³, and intervals of doubles a width of 10²³.
class Rump : public testing::TestWithParam<const char*> {
 protected:
  PreparedSearch preparation = [] {
    ModelOptions model;
    model.path = REGULUS_SOURCE_DIR "/models/rump.toml";
    return prepare(model, search_options(GetParam()));
  }();
  Settings settings;

  void SetUp() override {
    if (!available(GetParam())) GTEST_SKIP() << "this processor has no " << GetParam();
  }
};

TEST_P(Rump, IsNotDecidedInDoubles) {
  EXPECT_EQ(solve(preparation.problem(), settings).verdict, Verdict::kPossibleProblem);
}

TEST_P(Rump, IsDecidedWithMoreBits) {
  ArbOracle oracle(preparation.stages->matrix(), 1, 1024);
  settings.oracle = &oracle;
  const Result result = solve(preparation.problem(), settings);
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity) << describe(result.reason);
  EXPECT_GT(oracle.bits(), 53);
}

TEST_P(Rump, StaysUndecidedWithTooFewBits) {
  ArbOracle oracle(preparation.stages->matrix(), 1, 106);
  settings.oracle = &oracle;
  EXPECT_EQ(solve(preparation.problem(), settings).verdict, Verdict::kPossibleProblem);
}

INSTANTIATE_TEST_SUITE_P(Section2A, Rump, testing::ValuesIn(kEngines));

}  // namespace
}  // namespace regulus
