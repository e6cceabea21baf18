// SPDX-License-Identifier: GPL-3.0-or-later
// A six-legged platform that is written out as a matrix asks the same question.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/file/model_edit.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/evaluate.hpp"
#include "tests/support/example_model.hpp"

namespace regulus::detail {
namespace {

using test::changed;

double value(const Model& model, const GiNaC::ex& e) {
  test::Point point;
  double next = 1;
  for (const PoseParameter& p : model.pose) point[p.name] = next += 0.37;
  for (const GeometryParameter& g : model.geometry)
    if (!g.name.starts_with("anchor_")) point[g.name] = test::evaluate(g.value, {});
  for (const ToleranceBall& ball : model.balls)
    for (const std::size_t member : ball.members)
      point[model.geometry[member].name] = test::evaluate(model.geometry[member].value, {});
  return test::evaluate(e, point);
}

void expect_same_question(const std::string& text) {
  const Model legs = parse_model(text, "legs.toml");
  const std::string written = with_matrix_of_gough(text);
  EXPECT_FALSE(is_gough(written));
  const Model matrix = parse_model(written, "matrix.toml");
  ASSERT_EQ(matrix.matrix.rows(), 6U);
  for (unsigned i = 0; i < 6; ++i) {
    for (unsigned j = 0; j < 6; ++j)
      EXPECT_NEAR(value(matrix, matrix.matrix(i, j)), value(legs, legs.matrix(i, j)), 1e-9)
          << written;
    EXPECT_NEAR(value(matrix, matrix.row_scale[i]), value(legs, legs.row_scale[i]), 1e-9);
  }
  ASSERT_EQ(matrix.geometry.size(), legs.geometry.size());
  std::multiset<std::string> of_matrix, of_legs;
  for (const auto& [model, all] : {std::pair(&matrix, &of_matrix), std::pair(&legs, &of_legs)}) {
    for (const GeometryParameter& g : model->geometry)
      all->insert(formula_text(g.value) + " +- " + formula_text(g.tolerance) + " of " + g.group +
                  (g.ball < 0 ? g.name : " in a ball"));
    for (const ToleranceBall& ball : model->balls)
      all->insert(formula_text(ball.radius) + std::to_string(ball.members.size()));
  }
  EXPECT_EQ(of_matrix, of_legs);
  for (std::size_t j = 0; j < 6; ++j) EXPECT_EQ(matrix.twist[j].name, legs.twist[j].name);
  ASSERT_EQ(matrix.motions.size(), legs.motions.size());
  for (std::size_t i = 0; i < matrix.pose.size(); ++i) {
    EXPECT_EQ(matrix.pose[i].name, legs.pose[i].name);
    EXPECT_EQ(matrix.pose[i].unit, legs.pose[i].unit);
  }
}

TEST(AMatrixOfSixLegs, AsksTheSameQuestion) {
  expect_same_question(test::kExampleGough);
  expect_same_question(changed(test::kExampleGough, "\"box\"", "\"ball\""));
  expect_same_question(
      changed(test::kExampleGough, "[gough]\n", "[gough]\nangle_unit = \"deg\"\n"));
  const std::string named =
      changed(test::kExampleGough, "[-7, -1, 0]", "{ value = [-7, \"L\", 0], radius = 0.2 }");
  expect_same_question(named + "[geometry]\nL = 4\nP = [1, 2]\n[let]\nM = \"L\"\n");
  expect_same_question(named + "[let]\nM = \"L\"\n[geometry]\nL = { value = 4, tolerance = 0.5 }");
}

TEST(AMatrixOfSixLegs, HasEntriesToEdit) {
  const std::string text = with_matrix_of_gough(test::kExampleGough);
  const Model model = parse_model(with_entry(text, 2, 3, "x/7"), "edited.toml");
  EXPECT_EQ(formula_text(model.matrix(1, 2)), "(1/7)*x");
}

TEST(AMatrixOfSixLegs, IsNotMadeOfATableWithoutALine) {
  std::string text = changed(test::kExampleGough, "[-7, -1, 0]", "[-7, \"L\", 0]");
  text = changed(text, "name = ", "geometry.L = 4\nname = ");
  EXPECT_THROW(static_cast<void>(with_matrix_of_gough(text)), InputError);
}

}  // namespace
}  // namespace regulus::detail
