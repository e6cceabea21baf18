// SPDX-License-Identifier: GPL-3.0-or-later
// §V-B2: "for T1, the determinant is constant, and for T2 it is a polynomial in sin(2πT),
// cos(2πT)"; and the verdicts by the closed form. Numbers of boxes are budgets.
#include <gtest/gtest.h>

#include "codegen/kernel/symbolic/print.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/settings.hpp"
#include "runtime/search/solver.hpp"

namespace regulus::detail {
namespace {

PreparedSearch closed_form(const std::string& model, const std::string& motion) {
  ModelOptions options;
  options.path = REGULUS_SOURCE_DIR "/models/" + model + ".toml";
  options.motion = motion;
  SearchOptions search;
  search.method = Method::kClosedForm;
  search.engine = Engine::kInterpreted;
  return prepare(options, search);
}

TEST(Section5B2, TheDeterminantOnT1IsConstant) {
  const Expression determinant = closed_form("robot_1", "T1").stages->formulation().determinant[0];
  ASSERT_EQ(determinant.kind(), ExpressionKind::kConstant);
  EXPECT_TRUE(determinant.value() == cln::cl_I("-43843140000"));
}

/// Returns true if T is only in sin(2πT) and cos(2πT), and these in no denominator or function.
bool is_polynomial_in_turns(const Expression& e) {
  if (!e.has_variables()) return true;
  if (e.kind() == ExpressionKind::kCall) {
    const std::string text = to_string(e);
    return text == "sin(2*pi*T)" || text == "cos(2*pi*T)";
  }
  if (e.kind() == ExpressionKind::kPower && e.exponent() < 0) return false;
  if (e.operands().empty()) return false;
  for (const Expression& operand : e.operands())
    if (!is_polynomial_in_turns(operand)) return false;
  return true;
}

TEST(Section5B2, TheDeterminantOnT2IsAPolynomialInSineAndCosine) {
  const Expression determinant = closed_form("robot_1", "T2").stages->formulation().determinant[0];
  EXPECT_TRUE(determinant.has_variables());
  EXPECT_TRUE(is_polynomial_in_turns(determinant)) << to_string(determinant);
  EXPECT_EQ(count_occurrences(determinant).at("T"), 8U);
}

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
    {"robot_1", "table4_5", kNone, 1},     {"robot_1", "wide_15", kNone, 200},
    {"robot_1", "wide_40", kSingular, 10}, {"robot_1", "T1", kNone, 1},
    {"robot_1", "T2", kNone, 1},           {"robot_1", "T1_errors", kNone, 1},
    {"robot_1", "T2_errors", kNone, 40},   {"robot_2", "table5_20", kNone, 150},
    {"robot_2", "table5_30", kNone, 850},  {"robot_2", "table5_40", kSingular, 20},
    {"planar_3rpr", "regular", kNone, 1},  {"planar_3rpr", "crossing", kSingular, 5},
    {"planar_3rpr", "circle", kNone, 5},   {"planar_3rpr", "reach", kNone, 1},
};

class ClosedFormVerdicts : public testing::TestWithParam<Case> {};

TEST_P(ClosedFormVerdicts, AreReachedWithinTheBoxBudget) {
  const PreparedSearch preparation = closed_form(GetParam().model, GetParam().motion);
  SearchOptions search;
  search.method = Method::kClosedForm;
  const Result result = solve(preparation.problem(), settings_from(search));
  EXPECT_EQ(result.verdict, GetParam().verdict) << describe(result.reason);
  EXPECT_LE(result.statistics.boxes, GetParam().max_boxes);
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  return std::string(info.param.model) + "_" + info.param.motion;
}

INSTANTIATE_TEST_SUITE_P(Tables, ClosedFormVerdicts, testing::ValuesIn(kCases), case_name);

}  // namespace
}  // namespace regulus::detail
