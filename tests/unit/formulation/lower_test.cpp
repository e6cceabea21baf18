// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/interval_arithmetic.hpp"
#include "codegen/kernel/program/module_check.hpp"
#include "codegen/kernel/program/rational_arithmetic.hpp"
#include "codegen/kernel/symbolic/lowering.hpp"
#include "codegen/kernel/symbolic/print.hpp"
#include "tests/support/symbolic/exact_values.hpp"
#include "tests/support/symbolic/gough_model.hpp"

namespace regulus::detail::test {
namespace {

TEST(Lowering, ProgramsComputeTheirExpressions) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 300; ++i) {
    // This uses no angles: to the interpreter, their sines are not rational numbers.
    RandomExpressions expressions(random);
    const Expression raw = expressions.polynomial(3) * power(expressions.polynomial(2), -2) -
                           power(expressions.polynomial(2), -1);
    const Expression e = substitute(raw, [](const Expression& s) -> std::optional<Expression> {
      if (s.kind() == ExpressionKind::kCall) return variable("y");
      if (s.kind() == ExpressionKind::kNumberPi) return variable("z");
      return std::nullopt;
    });
    Lowering lowering(variable_names(), point_names());
    lowering.output(e);
    const Program program = std::move(lowering).finish();
    ExactValues values(random);
    std::vector<cl_RA> inputs, points;
    for (const std::string& name : variable_names()) inputs.push_back(values.symbol(name));
    for (const std::string& name : point_names()) points.push_back(values.symbol(name));
    RationalArithmetic arithmetic;
    try {
      const cl_RA expected = values(e);
      EXPECT_EQ(evaluate<RationalArithmetic>(program, std::span<const cl_RA>(inputs),
                                             std::span<const cl_RA>(points), arithmetic)[0],
                expected)
          << to_string(e);
    } catch (const std::domain_error&) {
      EXPECT_THROW(static_cast<void>(values(e)), std::domain_error) << to_string(e);
    }
  }
}

/// Makes a matrix that is regular for all x > 0, written with an operation undefined elsewhere.
Model model_with(const GiNaC::realsymbol& x, const GiNaC::ex& entry) {
  Model model;
  model.name = "partial";
  model.pose = {{x, "x", "1"}};
  model.matrix = GiNaC::matrix{{entry}};
  return model;
}

/// Returns true if the function is undefined somewhere in x ∈ [lo, hi], with K = 1.
bool undefined(const Module& module, const std::string& function, double lo, double hi) {
  const Program& program = module.find(function)->program;
  const std::vector<Interval> inputs = {{lo, hi}};
  const std::vector<Interval> points(program.points.size(), Interval(1));
  IntervalArithmetic arithmetic;
  static_cast<void>(evaluate<IntervalArithmetic>(program, std::span<const Interval>(inputs),
                                                 std::span<const Interval>(points), arithmetic));
  return arithmetic.undefined();
}

constexpr const char* kMatrixFunctions[] = {
    "matrix",        "matrix_derivatives", "left_product",           "left_derivatives",
    "right_product", "determinant",        "determinant_derivatives"};

/// Lowers all functions of the formulation.
Module lowered(const Model& model, const Motion& motion) {
  FormulationOptions options;
  options.determinant = true;
  return lower(formulate(model, motion, options));
}

TEST(Lower, DerivativesAreUndefinedWhereTheFunctionIs) {
  // The derivative of a logarithm, 1/x, is defined for negative x as well.
  const GiNaC::realsymbol x("x");
  const Model model = model_with(x, GiNaC::log(x));
  const Module module = lowered(model, box_motion(model));
  for (const char* function : kMatrixFunctions) {
    EXPECT_TRUE(undefined(module, function, -2, -1)) << function;
    EXPECT_FALSE(undefined(module, function, 1, 2)) << function;
  }
}

TEST(Lower, TheCutOfAtan2IsUndefinedInDerivatives) {
  const GiNaC::realsymbol x("x");
  const Model model = model_with(x, GiNaC::atan2(x, GiNaC::ex(-1)));
  const Module module = lowered(model, box_motion(model));
  for (const char* function : kMatrixFunctions)
    EXPECT_TRUE(undefined(module, function, -1, 1)) << function;
}

TEST(Lower, WhatCancelsInRewritingStillHasToBeDefined) {
  // (x - 1)/x - 1 + 1/x is 0 at every x where it is defined.
  const GiNaC::realsymbol x("x");
  const Model model = model_with(x, 3 + (x - 1) / x * (x - 1) - 1 / x * (x * (x - 2) + 1));
  const Module module = lowered(model, box_motion(model));
  for (const char* function : kMatrixFunctions) {
    EXPECT_TRUE(undefined(module, function, -1, 1)) << function;
    EXPECT_FALSE(undefined(module, function, 1, 2)) << function;
  }
}

TEST(Lower, WhatTheModelSaysMustBeDefinedHasToBe) {
  const GiNaC::realsymbol x("x");
  Model model = model_with(x, x + 5);
  model.must_be_defined = {GiNaC::pow(x - 1, -1), GiNaC::sqrt(x)};
  const Module module = lowered(model, box_motion(model));
  for (const char* function : kMatrixFunctions) {
    EXPECT_TRUE(undefined(module, function, -2, -1)) << function;
    EXPECT_TRUE(undefined(module, function, 0, 1)) << function;
    EXPECT_FALSE(undefined(module, function, 2, 3)) << function;
  }
}

TEST(Lower, WhatTheMotionSaysMustBeDefinedHasToBe) {
  const GiNaC::realsymbol x("x"), t("T");
  const Model model = model_with(x, x);
  Motion motion;
  motion.parameters.push_back({t, "T", "1", {0, 1}});
  motion.pose = {t + 1};
  motion.constraints = {t - 5};
  motion.must_be_defined = {GiNaC::log(t)};
  const Module module = lowered(model, motion);
  for (const char* function : {"matrix", "left_product", "left_derivatives", "right_product",
                               "determinant", "determinant_derivatives", "constraint", "pose"})
    EXPECT_TRUE(undefined(module, function, -2, -1)) << function;
}

TEST(Lower, DefinednessIsNotEvaluatedTwice) {
  const GiNaC::realsymbol x("x");
  const Model model = model_with(x, GiNaC::sqrt(x));
  const Program program = lower(formulate(model, box_motion(model))).find("matrix")->program;
  EXPECT_EQ(program.nodes.size(), 2u);  // the input and its root
}

/// Lowers rows of K·A, each in its own entries of K.
Program lowered_row_by_row(const Formulation& f, const ProductForms& forms,
                           const std::vector<std::string>& points) {
  std::vector<std::string> names;
  for (const Variable& v : f.variables) names.push_back(v.name);
  Lowering lowering(names, points);
  for (std::size_t begin = 0; begin < forms.first.size(); begin += forms.block)
    for (int row = 1; row <= f.columns; ++row)
      for (std::size_t i = begin; i < begin + forms.block; ++i)
        lowering.output(in_row(forms.first[i], row));
  return std::move(lowering).finish();
}

TEST(Lower, RowsAreThoseOfTheirOwnEntriesOfK) {
  const Model model = robot_1({0, true, false});
  FormulationOptions options;
  options.expansion = ExpansionForm::kAtBox;
  const Formulation f = formulate(model, box_motion(model), options);
  const Module module = lower(f);
  const std::pair<const char*, const ProductForms*> functions[] = {
      {"left_product", &f.left_product},
      {"left_derivatives", &f.left_derivatives},
      {"expansion_second", &f.expansion.value().second.forms}};
  for (const auto& [name, forms] : functions) {
    ASSERT_NE(module.find(name), nullptr) << name;
    const Program& program = module.find(name)->program;
    const Program rows = lowered_row_by_row(f, *forms, program.points);
    EXPECT_EQ(rows.outputs, program.outputs) << name;
    EXPECT_EQ(rows.constants, program.constants) << name;
    ASSERT_EQ(rows.nodes.size(), program.nodes.size()) << name;
    for (std::size_t n = 0; n < rows.nodes.size(); ++n) {
      const Node &a = rows.nodes[n], &b = program.nodes[n];
      EXPECT_TRUE(a.op == b.op && a.a == b.a && a.b == b.b && a.index == b.index) << name << n;
    }
  }
}

TEST(Lower, ModulesBecomeKernels) {
  const Model model = robot_1({0, true, false});
  const Module module = lowered(model, box_motion(model));
  check_module(module);
  EXPECT_EQ(module.motion_variables, 6);
  EXPECT_EQ(module.rows, 6);
  EXPECT_EQ(module.columns, 6);
  EXPECT_EQ(module.pose_parameters, 6);
  for (const Function& function : module.functions) {
    EXPECT_EQ(function.output_comments.size(), function.program.outputs.size()) << function.name;
    EXPECT_FALSE(function.title.empty());
  }
  EXPECT_EQ(module.find("left_product")->output_comments[0],
            "(K·A)[0][0]: horner. Occurrences: phi 4 (natural 24), psi 2 (natural 24), theta 1 "
            "(natural 12), x 1 (natural 6)");
}

}  // namespace
}  // namespace regulus::detail::test
