// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/formulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "codegen/kernel/program/module_check.hpp"
#include "codegen/kernel/program/print.hpp"
#include "codegen/kernel/symbolic/derivative.hpp"
#include "codegen/kernel/symbolic/print.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/symbolic/exact_values.hpp"
#include "tests/support/symbolic/gough_model.hpp"

namespace regulus::detail::test {
namespace {

Occurrences added(const std::vector<EntryStatistics>& entries,
                  Occurrences EntryStatistics::*which) {
  Occurrences sum_of;
  for (const EntryStatistics& entry : entries)
    for (const auto& [name, count] : entry.*which) sum_of[name] += count;
  return sum_of;
}

std::uint64_t operations(const Program& program) {
  return static_cast<std::uint64_t>(
      std::count_if(program.nodes.begin(), program.nodes.end(), [](const Node& n) {
        return n.op != Op::kConstant && n.op != Op::kNumberPi && n.op != Op::kInput &&
               n.op != Op::kPoint;
      }));
}

std::size_t at(int row, int column, int columns) {
  return static_cast<std::size_t>(row * columns + column);
}

/// Compares K·A, A·K and ∂(K·A) exactly with the matrix as written.
void expect_exact_products(const Formulation& f, int points = 2) {
  std::mt19937_64 random(7);
  for (int repetition = 0; repetition < points; ++repetition) {
    ExactValues values(random);
    const auto k = [&](int i, int j) { return values(point(point_name(i + 1, j + 1))); };
    std::vector<cl_RA> a;
    for (const Expression& e : f.natural_matrix) a.push_back(values(e));
    for (std::size_t i = 0; i < f.matrix.size(); ++i) EXPECT_EQ(values(f.matrix[i]), a[i]);
    for (int r = 0; r < f.columns; ++r)
      for (int c = 0; c < f.columns; ++c) {
        cl_RA expected = 0;
        for (int j = 0; j < f.rows; ++j) expected = expected + k(r, j) * a[at(j, c, f.columns)];
        EXPECT_EQ(values(in_row(f.left_product.first[std::size_t(c)], r + 1)), expected)
            << r << " " << c;
      }
    if (f.rows != f.columns) continue;
    for (int r = 0; r < f.rows; ++r)
      for (int c = 0; c < f.rows; ++c) {
        cl_RA expected = 0;
        for (int j = 0; j < f.columns; ++j) expected = expected + a[at(r, j, f.columns)] * k(j, c);
        EXPECT_EQ(values(in_column(f.right_product.first[std::size_t(r)], c + 1)), expected)
            << r << " " << c;
      }
  }
}

void expect_exact_derivatives(const Formulation& f) {
  std::mt19937_64 random(11);
  ExactValues values(random);
  for (std::size_t v = 0; v < f.variables.size(); ++v) {
    Differentiator by(f.variables[v].name);
    std::vector<cl_RA> slopes;
    for (const Expression& e : f.natural_matrix) slopes.push_back(values(by.derivative(e)));
    for (std::size_t e = 0; e < slopes.size(); ++e)
      EXPECT_EQ(values(f.matrix_derivatives[v * slopes.size() + e]), slopes[e])
          << f.variables[v].name << " " << e;
    for (int r = 0; r < f.columns; ++r)
      for (int c = 0; c < f.columns; ++c) {
        cl_RA expected = 0;
        for (int j = 0; j < f.rows; ++j)
          expected =
              expected + values(point(point_name(r + 1, j + 1))) * slopes[at(j, c, f.columns)];
        const Expression& form = f.left_derivatives.first[at(static_cast<int>(v), c, f.columns)];
        EXPECT_EQ(values(in_row(form, r + 1)), expected)
            << f.variables[v].name << " " << r << " " << c;
      }
  }
}

TEST(Formulation, OccurrencesOfRobot1ReachTheFigures) {
  const Model model = robot_1();
  const Formulation f = formulate(model, box_motion(model));
  const Occurrences natural = added(f.statistics.at("left_product"), &EntryStatistics::natural);
  EXPECT_EQ(
      natural,
      (Occurrences{
          {"x", 108}, {"y", 108}, {"z", 108}, {"psi", 1440}, {"theta", 1080}, {"phi", 1800}}));
  Expressions all;
  for (int row = 1; row <= f.columns; ++row)
    for (const Expression& form : f.left_product.first) all.push_back(in_row(form, row));
  const Occurrences after = count_occurrences(all);
  EXPECT_EQ(after, added(f.statistics.at("left_product"), &EntryStatistics::rewritten));
  EXPECT_LE(after.at("x"), 24u);
  EXPECT_LE(after.at("y"), 24u);
  EXPECT_LE(after.at("z"), 18u);
  EXPECT_LE(after.at("psi"), 60u);
  EXPECT_LE(after.at("theta"), 54u);
  EXPECT_LE(after.at("phi"), 252u);
}

TEST(Formulation, OperationsOfRobot1StayInTheBudget) {
  const Model model = robot_1();
  const Module module = lower(formulate(model, box_motion(model)));
  EXPECT_LE(operations(module.find("left_product")->program), 680u);
  EXPECT_LE(operations(module.find("left_derivatives")->program), 820u);
}

TEST(Formulation, ProductsAndDerivativesOfRobot1AreExact) {
  const Model model = robot_1();
  const Formulation f = formulate(model, box_motion(model));
  EXPECT_EQ(f.variables.size(), 6u);
  expect_exact_products(f);
  expect_exact_derivatives(f);
}

TEST(Formulation, ProductsAndDerivativesOfRobot2AreExact) {
  const Model model = robot_2();
  const Formulation f = formulate(model, box_motion(model));
  expect_exact_products(f);
  expect_exact_derivatives(f);
}

TEST(Formulation, UncertainAnchorsBecomeVariables) {
  const Model model = robot_1({GiNaC::numeric(1, 20)});
  const Formulation f = formulate(model, box_motion(model));
  ASSERT_EQ(f.variables.size(), 42u);
  const Variable& anchor = f.variables[6];
  EXPECT_EQ(anchor.name, "A1_1");
  EXPECT_EQ(anchor.kind, VariableKind::kGeometry);
  EXPECT_TRUE(anchor.range.lo.is_equal(GiNaC::ex(-9) - GiNaC::numeric(1, 20)));
  EXPECT_TRUE(anchor.range.hi.is_equal(GiNaC::ex(-9) + GiNaC::numeric(1, 20)));
  EXPECT_EQ(f.left_derivatives.first.size(), 42u * 6u);
  expect_exact_products(f, 1);
  expect_exact_derivatives(f);
  check_module(lower(f));
}

TEST(Formulation, BallsGiveTheirRadiusToEveryAxis) {
  Model model = robot_1();
  model.balls.push_back({{0, 2, 4}, GiNaC::numeric(1, 8), "base"});
  for (const std::size_t member : model.balls[0].members) model.geometry[member].ball = 0;
  const Formulation f = formulate(model, box_motion(model));
  ASSERT_EQ(f.variables.size(), 9u);
  for (std::size_t i = 6; i < 9; ++i) {
    EXPECT_EQ(f.variables[i].ball, 0);
    EXPECT_TRUE((f.variables[i].range.hi - f.variables[i].range.lo).is_equal(GiNaC::numeric(1, 4)));
  }
}

TEST(Formulation, FixedPoseParametersDisappear) {
  const Model model = robot_1();
  Motion motion = box_motion(model);
  motion.parameters.erase(motion.parameters.begin() + 3, motion.parameters.end());
  motion.pose[3] = GiNaC::Pi / 2;
  motion.pose[4] = 0;
  motion.pose[5] = 0;
  const Formulation f = formulate(model, motion);
  EXPECT_EQ(f.variables.size(), 3u);
  // sin(pi/2) and cos(0) are already evaluated exactly.
  for (const Expression& e : f.left_product.first)
    EXPECT_EQ(to_string(e).find("sin"), std::string::npos);
  expect_exact_products(f);
}

Motion circle(const Model& model) {
  Motion motion;
  const GiNaC::realsymbol t("T");
  motion.name = "circle";
  motion.parameters.push_back({t, "T", "1", {0, 1}});
  motion.pose = {
      10 * GiNaC::cos(2 * GiNaC::Pi * t), 10 * GiNaC::sin(2 * GiNaC::Pi * t), 45, t, 0, 0};
  motion.error = {GiNaC::numeric(1, 100), 0, 0, GiNaC::Pi / 1800, 0, 0};
  motion.constraints = {model.pose[0].symbol + t - 5};
  return motion;
}

TEST(Formulation, TrajectoriesAndControlErrorsAreSubstituted) {
  const Model model = robot_1();
  const Formulation f = formulate(model, circle(model));
  ASSERT_EQ(f.variables.size(), 3u);
  EXPECT_EQ(f.variables[0].name, "T");
  EXPECT_EQ(f.variables[1].name, "x_error");
  EXPECT_EQ(f.variables[1].kind, VariableKind::kControl);
  EXPECT_TRUE(f.variables[1].range.lo.is_equal(-GiNaC::numeric(1, 100)));
  EXPECT_EQ(f.variables[2].name, "psi_error");
  EXPECT_EQ(to_string(f.pose[0]), "x_error + 10*cos(2*pi*T)");
  EXPECT_EQ(to_string(f.pose[3]), "T + psi_error");
  // The constraint concerns the commanded pose.
  EXPECT_EQ(to_string(f.constraints[0]), "T + 10*cos(2*pi*T) - 5");
  check_module(lower(f));
}

TEST(Formulation, NamesOfControlErrorsAvoidTheModelsNames) {
  Model model = robot_1();
  model.geometry[0].name = "x_error";
  const Formulation f = formulate(model, circle(model));
  EXPECT_EQ(f.variables[1].name, "x_error_");
}

/// Makes a model with two columns and three rows.
Model redundant_model() {
  Model model;
  model.name = "redundant";
  const GiNaC::realsymbol x("x"), y("y");
  model.pose = {{x, "x", "m"}, {y, "y", "m"}};
  model.matrix = GiNaC::matrix{{x * y, x + 1}, {GiNaC::pow(x, 2), y}, {x - y, 3}};
  return model;
}

TEST(Formulation, RedundantActuationHasNoRightProduct) {
  const Model model = redundant_model();
  const Formulation f = formulate(model, box_motion(model));
  EXPECT_EQ(f.left_product.first.size(), 2u);
  EXPECT_TRUE(f.right_product.empty());
  expect_exact_products(f);
  expect_exact_derivatives(f);
  const Module module = lower(f);
  check_module(module);
  EXPECT_EQ(module.find("left_product")->program.points.size(), 6u);
  EXPECT_EQ(module.find("matrix")->program.points.size(), 0u);
  EXPECT_EQ(module.find("right_product"), nullptr);
}

TEST(Formulation, LeftOutFunctionsAreNotFormed) {
  const Model model = robot_1();
  FormulationOptions options;
  options.derivatives = options.right_product = false;
  const Module module = lower(formulate(model, box_motion(model), options));
  EXPECT_NE(module.find("left_product"), nullptr);
  EXPECT_EQ(module.find("left_derivatives"), nullptr);
  EXPECT_EQ(module.find("right_product"), nullptr);
}

TEST(Formulation, IsTheSameWhateverTheOrderOfSymbolCreation) {
  const auto text = [](const GoughOptions& options) {
    const Model model = robot_1(options);
    return to_text(lower(formulate(model, box_motion(model))));
  };
  // The symbols of the first model are older, and GiNaC has used other serial numbers since.
  const std::string straight = text({0, true, false});
  EXPECT_EQ(straight, text({0, true, true}));
  EXPECT_EQ(text({GiNaC::numeric(1, 20), true, false}), text({GiNaC::numeric(1, 20), true, true}));
}

TEST(Formulation, RowScaleIsTheProductOfTheScales) {
  const Model model = robot_1({0, true, false});
  const Formulation f = formulate(model, box_motion(model));
  ASSERT_EQ(f.row_scale.size(), 1u);
  EXPECT_LE(total(count_occurrences(f.row_scale)), 120u);
  EXPECT_NE(lower(f).find("row_scale"), nullptr);
  EXPECT_EQ(lower(formulate(robot_1(), box_motion(robot_1()))).find("row_scale"), nullptr);
}

TEST(Formulation, RefusesMotionsOfAnotherModel) {
  const Model model = redundant_model();
  Motion motion = box_motion(model);
  motion.pose.pop_back();
  EXPECT_THROW(static_cast<void>(formulate(model, motion)), InputError);
  motion = box_motion(model);
  motion.pose[1] = GiNaC::realsymbol("stranger");
  EXPECT_THROW(static_cast<void>(formulate(model, motion)), InputError);
  Model wide = model;
  wide.matrix = GiNaC::matrix(1, 2);
  EXPECT_THROW(static_cast<void>(formulate(wide, box_motion(wide))), InputError);
}

}  // namespace
}  // namespace regulus::detail::test
