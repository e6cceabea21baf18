// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "codegen/question/engine/arb_oracle.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/search/solver.hpp"

namespace regulus::detail {
namespace {

/// §II-A: the value is −0.827…; doubles give −10²³, and intervals of doubles a width of 10²³.
class Rump : public testing::Test {
 protected:
  PreparedSearch preparation = [] {
    ModelOptions model;
    model.path = REGULUS_SOURCE_DIR "/models/rump.toml";
    return prepare(model, {});
  }();
  Settings settings;
};

TEST_F(Rump, IsNotDecidedInDoubles) {
  EXPECT_EQ(solve(preparation.problem(), settings).verdict, Verdict::kPossibleProblem);
}

TEST_F(Rump, IsDecidedWithMoreBits) {
  ArbOracle oracle(preparation.stages->matrix(), 1, 1024);
  settings.oracle = &oracle;
  const Result result = solve(preparation.problem(), settings);
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity) << describe(result.reason);
  EXPECT_GT(oracle.bits(), 53);
}

TEST_F(Rump, StaysUndecidedWithTooFewBits) {
  ArbOracle oracle(preparation.stages->matrix(), 1, 106);
  settings.oracle = &oracle;
  EXPECT_EQ(solve(preparation.problem(), settings).verdict, Verdict::kPossibleProblem);
}

}  // namespace
}  // namespace regulus::detail
