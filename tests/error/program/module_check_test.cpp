// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/module_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace regulus::detail {
namespace {

Module good_module() {
  Module module;
  module.variables = {"x"};
  module.motion_variables = 1;
  module.rows = module.columns = 1;
  ProgramBuilder builder(module.variables, {});
  builder.output(builder.power(builder.input(0), 2));
  module.functions.push_back({"matrix", "", std::move(builder).finish(), 1, 1, {}});
  return module;
}

void expect_refusal(const Module& module, const char* part_of_message) {
  try {
    check_module(module);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(part_of_message));
  }
}

TEST(CheckModule, AcceptsAWellFormedModule) { EXPECT_NO_THROW(check_module(good_module())); }

TEST(CheckModule, RefusesAnUnknownFunction) {
  Module module = good_module();
  module.functions[0].name = "matrices";
  expect_refusal(module, "function matrices: not a function of the kernel ABI");
}

TEST(CheckModule, RefusesTheWrongNumberOfOutputs) {
  Module module = good_module();
  module.functions[0].program.outputs.push_back(0);
  expect_refusal(module, "function matrix: has 2 outputs, expected 1");
}

TEST(CheckModule, RefusesAFunctionGivenTwice) {
  Module module = good_module();
  module.functions.push_back(module.functions[0]);
  expect_refusal(module, "function matrix: given twice");
}

TEST(CheckModule, RefusesOtherVariables) {
  Module module = good_module();
  module.functions[0].program.inputs = {"y"};
  expect_refusal(module, "must read the variables of its module");
}

TEST(CheckModule, RefusesAPartOfK) {
  Module module = good_module();
  module.functions[0].program.points = {"k_1_1", "k_1_2"};
  expect_refusal(module, "must read all entries of K or none");
}

TEST(CheckModule, RefusesARightProductOfATallMatrix) {
  Module module = good_module();
  module.rows = 2;
  module.functions[0].name = "right_product";
  expect_refusal(module, "needs a square matrix");
}

TEST(CheckModule, RefusesMoreColumnsThanRows) {
  Module module = good_module();
  module.columns = 2;
  expect_refusal(module, "at least as many rows as columns");
}

TEST(CheckModule, RefusesAnUndeclaredInput) {
  Module module = good_module();
  module.functions[0].program.nodes[0].index = 1;
  expect_refusal(module, "undeclared input");
}

TEST(CheckModule, RefusesAnOperandAfterItsUse) {
  Module module = good_module();
  module.functions[0].program.nodes[1].a = 1;
  expect_refusal(module, "operand after its use");
}

TEST(CheckModule, RefusesAnOutputThatIsNoNode) {
  Module module = good_module();
  module.functions[0].program.outputs[0] = 2;
  expect_refusal(module, "output is no node");
}

}  // namespace
}  // namespace regulus::detail
