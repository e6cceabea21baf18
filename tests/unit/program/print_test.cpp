// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/print.hpp"

#include <gtest/gtest.h>

namespace regulus::detail {
namespace {

Module small_module() {
  Module module;
  module.variables = {"x"};
  module.rows = module.columns = 1;
  ProgramBuilder builder(module.variables, {});
  builder.output(builder.power(builder.add(builder.input(0), builder.constant("1/3")), 3));
  module.functions.push_back({"matrix", "title", std::move(builder).finish(), 1, 1, {"comment"}});
  return module;
}

TEST(Print, WritesOneNodePerLine) {
  EXPECT_EQ(to_text(small_module().functions[0].program),
            "inputs 1 1:x\npoints 0\n"
            "%0 = input 0\n%1 = constant 1/3\n%2 = add %0 %1\n%3 = power %2 3\noutputs %3\n");
}

TEST(Print, IdentifiesWhatIsComputed) {
  const Module module = small_module();
  EXPECT_EQ(identity(module).size(), 64U);
  Module other = module;
  other.model = "renamed";
  other.functions[0].title = "another title";
  other.functions[0].output_comments = {};
  EXPECT_EQ(identity(other), identity(module));
}

TEST(Print, TellsDifferentModulesApart) {
  const Module module = small_module();
  Module exponent = module;
  exponent.functions[0].program.nodes.back().index = 4;
  Module constant = module;
  constant.functions[0].program.constants[0] = cln::cl_RA("1/4");
  Module shape = module;
  shape.motion_variables = 1;
  Module name = module;
  name.functions[0].name = "pose";
  for (const Module& other : {exponent, constant, shape, name})
    EXPECT_NE(identity(other), identity(module));
}

TEST(Print, IsTheSha256OfTheText) {
  // The digest of the empty module's text, computed by an independent implementation.
  EXPECT_EQ(
      to_text(Module{}),
      "variables 0\nmotion_variables 0\nrows 0\ncolumns 0\nconstraints 0\npose_parameters 0\n");
  EXPECT_EQ(identity(Module{}), "d90ffa5e2f0af27898addc44134c81bc424d5d524d384723ea80522c5130039c");
}

}  // namespace
}  // namespace regulus::detail
