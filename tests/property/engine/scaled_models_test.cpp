// SPDX-License-Identifier: GPL-3.0-or-later
// The units of a model do not matter. After scaling rows and columns by powers of two, exchanging
// them, renaming or moving variables, the verdict is the same; after scaling, the boxes are, too.
// Margins far below rounding errors are decided, or given up, after bounded work.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail {
namespace {

using test::RandomSource;
using Rows = std::vector<std::vector<std::string>>;

/// A matrix of `x` and `y` over a square around (cx, cy).
struct MatrixModel {
  Rows rows;
  std::string x = "x", y = "y";
  std::string x_range = "[1, 2]", y_range = "[-1, 1]";
  std::string more;  ///< lines of the motion
  std::string row_scale;

  [[nodiscard]] std::string text() const {
    std::string matrix;
    for (const auto& row : rows) {
      std::string entries;
      for (const std::string& entry : row)
        entries += fmt::format("{}\"{}\"", entries.empty() ? "" : ", ", entry);
      matrix += fmt::format("{}[{}]", matrix.empty() ? "" : ", ", entries);
    }
    return fmt::format(
        "regulus = 1\nname = \"scaled\"\n[pose]\n{0} = \"1\"\n{1} = \"1\"\n[matrix]\nrows = [{2}]\n"
        "{3}[motion.m]\n{0} = {4}\n{1} = {5}\n{6}",
        x, y, matrix, row_scale, x_range, y_range, more);
  }
};

struct Outcome {
  Verdict verdict;
  Reason reason;
  std::uint64_t boxes;
  Result result;
};

Outcome judge(const MatrixModel& model, SearchOptions search = {}) {
  ModelOptions options;
  options.path = "scaled.toml";
  options.text = model.text();
  search.use_cache = false;
  if (!search.isa) search.engine = Engine::kInterpreted;
  search.threads = 1;
  PreparedSearch preparation = prepare(options, search);
  Settings settings = settings_from(search);
  Result result = run_search(preparation, search, settings);
  return {result.verdict, result.reason, result.statistics.boxes, std::move(result)};
}

/// Returns 2^exponent, with exponents that a model may have.
std::string power_of_two_text(int exponent) {
  std::string text;
  for (; std::abs(exponent) > 100; exponent -= exponent > 0 ? 100 : -100)
    text += exponent > 0 ? "2^100*" : "2^(-100)*";
  return text + fmt::format("2^({})", exponent);
}

std::string times(int exponent, const std::string& entry) {
  return fmt::format("{}*({})", power_of_two_text(exponent), entry);
}

MatrixModel scaled(MatrixModel model, const std::vector<int>& rows,
                   const std::vector<int>& columns) {
  for (std::size_t i = 0; i < model.rows.size(); ++i)
    for (std::size_t j = 0; j < model.rows[i].size(); ++j)
      model.rows[i][j] = times(rows[i] + columns[j], model.rows[i][j]);
  return model;
}

std::vector<MatrixModel> base_models() {
  std::vector<MatrixModel> models(8);
  for (MatrixModel& model : models) model.x_range = "[0.01, 2]";
  models[0].rows = {{"x", "y"}, {"-y", "x"}};
  models[1].rows = {{"x + 2", "y", "1"}, {"y", "x + 3", "x*y"}, {"1", "y^2", "4 - x"}};
  models[2].rows = {{"x", "y", "0"}, {"x*y", "1", "x"}, {"2", "y", "x - y"}};
  models[3].rows = {{"cos(y)", "sin(y)"}, {"-sin(y)", "cos(y) + x"}};
  models[4].rows = {{"x^2 + y^2", "y"}, {"x - 3", "2 + y"}, {"1", "x"}};
  models[5].rows = {{"3*x", "y", "1"}, {"1", "5*x", "y"}, {"y", "1", "4*x + y"}};
  models[6].rows = {{"x", "y + x"}, {"y - x", "0.01 + y^2"}};
  models[7].rows = {
      {"x + 1", "sin(3*y)", "y"}, {"cos(2*x)", "x*y + 2", "1"}, {"y", "x^2", "3 + cos(y)"}};
  return models;
}

std::vector<int> random_exponents(RandomSource& random, std::size_t count) {
  std::vector<int> exponents;
  for (std::size_t k = 0; k < count; ++k) exponents.push_back(int(random.below(601)) - 300);
  return exponents;
}

TEST(ScaledModels, HaveTheSameVerdictAfterTheSameBoxes) {
  RandomSource random(31);
  for (const MatrixModel& model : base_models()) {
    const Outcome expected = judge(model);
    for (int k = 0; k < 4; ++k) {
      const auto rows = random_exponents(random, model.rows.size());
      const auto columns = random_exponents(random, model.rows[0].size());
      const MatrixModel other = scaled(model, rows, columns);
      const Outcome outcome = judge(other);
      EXPECT_EQ(outcome.verdict, expected.verdict) << other.text();
      // A left inverse weighs rows by their lengths, so by their scales, too.
      if (rows.size() != columns.size()) continue;
      EXPECT_EQ(outcome.boxes, expected.boxes) << other.text();
    }
  }
}

TEST(ScaledModels, HaveTheSameVerdictWithRowsAndColumnsExchanged) {
  RandomSource random(32);
  for (const MatrixModel& model : base_models()) {
    const Outcome expected = judge(model);
    MatrixModel other = scaled(model, random_exponents(random, model.rows.size()),
                               random_exponents(random, model.rows[0].size()));
    std::reverse(other.rows.begin(), other.rows.end());
    for (auto& row : other.rows) std::rotate(row.begin(), row.begin() + 1, row.end());
    EXPECT_EQ(judge(other).verdict, expected.verdict) << other.text();
  }
}

/// Replaces a variable. No function in the models has an x or a y in its name.
std::string replaced(const std::string& text, char name, const std::string& by) {
  std::string result;
  for (const char c : text) result += c == name ? by : std::string(1, c);
  return result;
}

TEST(ScaledModels, HaveTheSameVerdictWithVariablesRenamedAndMoved) {
  for (const MatrixModel& model : base_models()) {
    const Outcome expected = judge(model);
    MatrixModel other = model;
    other.x = "q", other.y = "p";
    other.x_range = "[\"1024 + 0.01\", 1026]";
    for (auto& row : other.rows)
      for (std::string& entry : row) entry = replaced(replaced(entry, 'x', "(q - 1024)"), 'y', "p");
    EXPECT_EQ(judge(other).verdict, expected.verdict) << other.text();
  }
}

TEST(ScaledModels, AreDecidedWhereOneEntryIsTiny) {
  MatrixModel model;
  model.rows = {{"1e-60", "y"}, {"0", "1"}};
  model.x_range = "1";
  const Outcome outcome = judge(model);
  EXPECT_EQ(outcome.verdict, Verdict::kNoSingularity);
  EXPECT_EQ(outcome.boxes, 1U);
  model.rows = {{"1e-400", "y"}, {"0", "1"}};
  EXPECT_EQ(judge(model).verdict, Verdict::kNoSingularity);
  model.rows = {{"1e-150", "0", "0"}, {"0", "1", "y"}, {"0", "0", "1e150"}};
  EXPECT_EQ(judge(model).verdict, Verdict::kNoSingularity);
}

/// |det J⁻¹| of diag(x·2^a, 2^b) with row scales 2^-a and 1 is x·2^b.
TEST(ScaledModels, ObeyThresholdsOfTheDeterminantAsWritten) {
  for (const int a : {0, 60, -250})
    for (const int b : {0, 90, -200}) {
      MatrixModel model;
      model.rows = {{times(a, "x"), "0"}, {"0", times(b, "1")}};
      model.row_scale = fmt::format("row_scale = [\"{}\", \"1\"]\n", power_of_two_text(-a));
      model.more = fmt::format("alpha = \"0.99*{}\"\n", power_of_two_text(b));
      EXPECT_EQ(judge(model).verdict, Verdict::kNoSingularity) << model.text();
      model.more = fmt::format("alpha = \"1.5*{}\"\n", power_of_two_text(b));
      const Outcome outcome = judge(model);
      ASSERT_EQ(outcome.verdict, Verdict::kSingularity) << model.text();
      const Interval determinant = outcome.result.witness->points[0].determinant;
      EXPECT_LE(mag(determinant), std::ldexp(1.5, b)) << model.text();
      EXPECT_GE(mig(determinant), std::ldexp(0.99, b)) << model.text();
    }
}

TEST(ScaledModels, ReportTheDeterminantAsWritten) {
  MatrixModel model;
  model.rows = {{times(200, "y"), "0"}, {"0", times(100, "x")}};
  model.y_range = "[-1, 0.7]";
  const Outcome outcome = judge(model);
  ASSERT_EQ(outcome.verdict, Verdict::kSingularity);
  ASSERT_EQ(outcome.result.witness->points.size(), 2U);
  for (const WitnessPoint& point : outcome.result.witness->points) {
    const Interval exact = times_power_of_two(point.variables[0] * point.variables[1], 300);
    EXPECT_TRUE(intersect(exact, point.determinant)) << model.text();
    EXPECT_LE(mag(point.determinant), 2 * mag(exact) + 1);
  }
}

/// A double root with a margin: bounds of the entries do not show it, their determinant does.
TEST(Margins, AreSeenByTheDeterminantWhereKIsOfNoUse) {
  for (const char* margin : {"1e-300", "1e-18"}) {
    MatrixModel model;
    model.x_range = "[\"123456 - 0.003\", \"123456 + 0.003\"]";
    model.rows = {{fmt::format("x^2 - (246912)*x + (15241383936) + {}", margin), "x", "1"},
                  {"0", "1", "x - 123450"},
                  {"0", "0", "1"}};
    const Outcome outcome = judge(model);
    EXPECT_EQ(outcome.verdict, Verdict::kNoSingularity) << model.text();
    EXPECT_LE(outcome.boxes, 64U);
  }
}

TEST(Margins, AreSeenByTheClosedFormWhereEntriesHideThem) {
  MatrixModel model;
  model.x_range = "[\"999.5 + 1/7\", \"1000.5 + 1/7\"]";
  model.y_range = "[999.5, 1000.5]";
  model.rows = {
      {"1", "1", "1"},
      {"0", "1", "2*x"},
      {"1000", "1000 + 3*x - 1", "1000 + (3*x - 1)*(2*x) + (x^2 - (2000)*x + (1000000) + 1e-300)"}};
  const Outcome outcome = judge(model);
  EXPECT_EQ(outcome.verdict, Verdict::kNoSingularity);
  EXPECT_LE(outcome.boxes, 20'000U);
}

/// The determinant touches 0. With K alone, only luck certified a box, and the search went on for
/// ever. Exact algebra knows the place.
TEST(Margins, ThatAreTouchedEndTheSearch) {
  MatrixModel model;
  model.x_range = "[\"2.5 + 1/7\", \"3.5 + 1/7\"]";
  model.rows = {{"1", "0", "2*x"}, {"0", "1", "2"}, {"0", "0", "x^2 - 6*x + 9"}};
  const Outcome outcome = judge(model);
  EXPECT_EQ(outcome.verdict, Verdict::kSingularity);
  EXPECT_LE(outcome.boxes, 20'000U);
}

/// Where an expression is undefined, engines leave different numbers, so no heuristic may read
/// them.
TEST(UndefinedLanes, AreTheSameForEveryEngine) {
  MatrixModel model;
  model.rows = {{"sqrt(x)", "y"}, {"x - 4", "y"}};
  model.x_range = "[0, 4]", model.y_range = "[1, 2]";
  const Outcome interpreted = judge(model);
  EXPECT_EQ(interpreted.verdict, Verdict::kNoSingularity);
  EXPECT_LE(interpreted.boxes, 64U);
  for (const Isa isa : {Isa::kAvx512, Isa::kAvx2, Isa::kPortable}) {
    if (!supported(isa)) continue;
    SearchOptions search;
    search.isa = isa;
    const Outcome compiled = judge(model, search);
    EXPECT_EQ(compiled.verdict, interpreted.verdict);
    EXPECT_EQ(compiled.boxes, interpreted.boxes) << name(isa);
  }
}

}  // namespace
}  // namespace regulus::detail
