// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/emit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include "tests/support/sample_modules.hpp"

namespace regulus::detail {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Returns the text without comments: it removes everything after "//".
std::string code_of(const std::string& text) {
  std::string code;
  for (const std::string& line : lines_of(text)) code += line.substr(0, line.find("//")) + "\n";
  return code;
}

std::string constraint_text(const std::function<NodeId(ProgramBuilder&)>& expression,
                            const EmitOptions& options = {}) {
  Module m;
  m.variables = {"x", "y"};
  m.rows = m.columns = 1;
  m.constraints = 1;
  ProgramBuilder b(m.variables, {"k_1_1"});
  b.output(expression(b));
  m.functions.push_back({"constraint", "H", std::move(b).finish(), 1, 1, {}});
  return emit(m, options).source;
}

NodeId x(ProgramBuilder& b) { return b.input(0); }
NodeId y(ProgramBuilder& b) { return b.input(1); }
NodeId k(ProgramBuilder& b) { return b.point(0); }

TEST(Emit, PrintsSumsOfProductsWithoutNeedlessParentheses) {
  EXPECT_THAT(constraint_text(
                  [](auto& b) { return b.multiply(b.add(x(b), y(b)), b.subtract(x(b), y(b))); }),
              HasSubstr("store(out, 0, (v_x + v_y) * (v_x - v_y));"));
  EXPECT_THAT(constraint_text([](auto& b) { return b.subtract(x(b), b.subtract(y(b), k(b))); }),
              HasSubstr("store(out, 0, v_x - (v_y - k_1_1));"));
  EXPECT_THAT(constraint_text([](auto& b) { return b.subtract(b.subtract(x(b), y(b)), k(b)); }),
              HasSubstr("store(out, 0, v_x - v_y - k_1_1);"));
}

TEST(Emit, FusesAProductWithASum) {
  EXPECT_THAT(constraint_text([](auto& b) { return b.add(b.multiply(k(b), x(b)), y(b)); }),
              HasSubstr("mul_add(k_1_1, v_x, v_y)"));
  EXPECT_THAT(constraint_text([](auto& b) { return b.subtract(y(b), b.multiply(k(b), x(b))); }),
              HasSubstr("mul_add(-k_1_1, v_x, v_y)"));
  EXPECT_THAT(constraint_text([](auto& b) { return b.subtract(y(b), b.multiply(x(b), k(b))); }),
              HasSubstr("mul_add(v_x, -k_1_1, v_y)"));
  EXPECT_THAT(constraint_text(
                  [](auto& b) { return b.subtract(y(b), b.multiply(b.constant("3/2"), x(b))); }),
              HasSubstr("mul_add(P(-0x1.8p+0), v_x, v_y)"));
  EXPECT_THAT(constraint_text([](auto& b) { return b.add(b.multiply(k(b), x(b)), k(b)); }),
              HasSubstr("mul_add(k_1_1, v_x, thin(k_1_1))"));
}

/// Returns the text of H over a 2×2 matrix, with K's rows in the order of the ABI.
std::string text_over_two_rows(const std::function<NodeId(ProgramBuilder&)>& expression,
                               unsigned operations_per_part) {
  Module m;
  m.variables = {"x"};
  m.rows = m.columns = 2;
  ProgramBuilder b(m.variables, {"k_1_1", "k_1_2", "k_2_1", "k_2_2"});
  for (int i = 0; i < 4; ++i) b.output(expression(b));
  m.functions.push_back({"left_product", "K·A", std::move(b).finish(), 2, 2, {}});
  EmitOptions options;
  options.operations_per_part = operations_per_part;
  return emit(m, options).source;
}

NodeId row_sum(ProgramBuilder& b, unsigned first, unsigned second) {
  return b.add(b.multiply(b.constant(78), b.point(first)), b.point(second));
}

TEST(Emit, ComputesShortSumsOfARowOfKAsPoints) {
  const auto factor = [](auto& b) { return b.multiply(row_sum(b, 0, 1), b.call(Op::kSin, x(b))); };
  EXPECT_THAT(text_over_two_rows(factor, 64),
              HasSubstr("exact_mul_add(P(78.0), k_1_1, k_1_2) * sin_x"));
  const auto two_rows = [](auto& b) {
    return b.multiply(row_sum(b, 0, 2), b.call(Op::kSin, x(b)));
  };
  EXPECT_THAT(text_over_two_rows(two_rows, 64),
              HasSubstr("mul_add(P(78.0), k_1_1, thin(k_2_1)) * sin_x"));
}

TEST(Emit, KeepsPointsForLaterPartsAsThinIntervals) {
  const auto twice = [](auto& b) {
    const NodeId sum = row_sum(b, 0, 1);
    return b.add(b.multiply(sum, b.call(Op::kSin, x(b))), b.multiply(sum, b.call(Op::kCos, x(b))));
  };
  const std::string text = text_over_two_rows(twice, 1);
  EXPECT_THAT(text, HasSubstr("const P c_1 = exact_mul"));
  EXPECT_THAT(text, HasSubstr("] = thin(c_"));
  EXPECT_THAT(text, HasSubstr("= point_of(shared["));
}

TEST(Emit, TakesASignIntoWhatNothingElseReads) {
  EXPECT_THAT(constraint_text([](auto& b) { return b.negate(b.subtract(x(b), y(b))); }),
              HasSubstr("store(out, 0, v_y - v_x);"));
  EXPECT_THAT(constraint_text([](auto& b) { return b.multiply(b.constant(-7), x(b)); }),
              HasSubstr("store(out, 0, P(-7.0) * v_x);"));
  EXPECT_THAT(constraint_text([](auto& b) {
                const NodeId difference = b.subtract(x(b), y(b));
                return b.divide(b.negate(difference), b.call(Op::kExp, difference));
              }),
              HasSubstr("store(out, 0, -t_"));
}

TEST(Emit, SquaresInsteadOfMultiplying) {
  EXPECT_THAT(constraint_text([](auto& b) { return b.multiply(x(b), x(b)); }),
              HasSubstr("sqr(v_x)"));
  EXPECT_THAT(constraint_text([](auto& b) { return b.multiply(k(b), k(b)); }),
              HasSubstr("k_1_1 * k_1_1"));
}

TEST(Emit, CallsSineAndCosineOfOneArgumentOnce) {
  const std::string text = constraint_text(
      [](auto& b) { return b.add(b.call(Op::kSin, x(b)), b.call(Op::kCos, x(b))); });
  EXPECT_THAT(text, HasSubstr("sincos(v_x, sin_x, cos_x);"));
  EXPECT_THAT(text, HasSubstr("store(out, 0, sin_x + cos_x);"));
}

TEST(Emit, PrintsConstantsExactlyOrOnBothSides) {
  const std::string text = constraint_text([](auto& b) {
    return b.add(b.multiply(b.constant("1/3"), x(b)), b.multiply(b.constant("5/4"), y(b)));
  });
  EXPECT_THAT(text, HasSubstr("constant(0x1.5555555555555p-2, 0x1.5555555555556p-2);  // 1/3"));
  EXPECT_THAT(text, HasSubstr("P(0x1.4p+0)"));
}

TEST(Emit, ChecksWhatMayOverflowAndNothingElse) {
  EXPECT_THAT(code_of(constraint_text([](auto& b) { return b.power(x(b), 15); })),
              Not(HasSubstr("checked")));
  const std::string text = code_of(constraint_text([](auto& b) { return b.power(x(b), 17); }));
  EXPECT_THAT(text, HasSubstr("checked(sqr(t_"));
  EXPECT_THAT(text, Not(HasSubstr("pow(")));
}

TEST(Emit, ChecksConstantsThatNoDoubleBounds) {
  EXPECT_THAT(
      constraint_text([](auto& b) { return b.multiply(b.power(b.constant(2), 1100), x(b)); }),
      HasSubstr("checked(constant(0x1.fffffffffffffp+1023, __builtin_huge_val()), undefined)"));
}

TEST(Emit, KeepsLinesShort) {
  for (const Module& module :
       {test::planar_module(), test::everything_module(), test::long_module(90)})
    for (const std::string& line : lines_of(emit(module).source))
      EXPECT_LE(line.size(), 110U) << line;
}

TEST(Emit, CutsLongFunctionsIntoParts) {
  const EmittedKernel kernel = emit(test::long_module(150));
  EXPECT_THAT(kernel.source, HasSubstr("undefined |= pose_3("));
  EmitOptions one_part;
  one_part.operations_per_part = 100000;
  EXPECT_THAT(emit(test::long_module(150), one_part).source, Not(HasSubstr("pose_1")));
}

TEST(Emit, NamesTheKernelByItsPrefix) {
  EmitOptions options;
  options.prefix = "robot_1";
  const EmittedKernel kernel = emit(test::planar_module(), options);
  EXPECT_EQ(kernel.symbol, "robot_1_kernel");
  EXPECT_THAT(kernel.source, HasSubstr("const regulus_kernel robot_1_kernel = {"));
}

TEST(Emit, StartsWithTheCommandThatMadeIt) {
  EmitOptions options;
  options.command = "regulus generate planar.toml -o out";
  options.source = "a paper";
  const std::string text = emit(test::planar_module(), options).source;
  EXPECT_THAT(text, HasSubstr("// Command          regulus generate planar.toml -o out\n"));
  EXPECT_THAT(text, HasSubstr("// Model            planar\n"));
  EXPECT_THAT(text, HasSubstr("// Source           a paper\n"));
  EXPECT_THAT(text, HasSubstr("// SPDX-License-Identifier: Apache-2.0\n"));
}

TEST(Emit, KeepsHostileNamesInsideCommentsAndIdentifiers) {
  EmitOptions options;
  options.command = "x\nint evil;";
  options.source = "\\\nint evil;";
  const std::string text = emit(test::hostile_module(), options).source;
  const std::string code = code_of(text);
  EXPECT_THAT(code, Not(HasSubstr("evil")));
  EXPECT_THAT(code, Not(HasSubstr("/*")));
  EXPECT_THAT(code, Not(HasSubstr("main()")));
  EXPECT_THAT(code, Not(HasSubstr("passwd\"")));
  EXPECT_THAT(code, Not(HasSubstr("system(")));
  EXPECT_THAT(text, Not(HasSubstr("\\")));
  int includes = 0;
  for (const std::string& line : lines_of(text))
    if (line.starts_with("#")) ++includes;
  EXPECT_EQ(includes, 2);
}

TEST(Emit, DescribesTheKernelForOtherPrograms) {
  EmitOptions options;
  options.manifest = true;
  const EmittedKernel kernel = emit(test::planar_module(), options);
  EXPECT_THAT(kernel.manifest, HasSubstr("\"symbol\": \"generated_kernel\""));
  EXPECT_THAT(kernel.manifest, HasSubstr("\"identity\": \"" + kernel.identity + "\""));
  EXPECT_THAT(kernel.manifest, HasSubstr("\"name\": \"left_product\""));
  EXPECT_TRUE(emit(test::planar_module()).manifest.empty());
  EXPECT_NO_THROW((void)emit(test::hostile_module(), options));
}

TEST(Emit, LeavesOutFunctionsWithoutOutputs) {
  Module module = test::planar_module();
  module.functions.push_back(
      {"constraint", "", ProgramBuilder(module.variables, {}).finish(), 0, 1, {}});
  EXPECT_THAT(emit(module).source, HasSubstr("nullptr,  // constraint"));
}

}  // namespace
}  // namespace regulus::detail
