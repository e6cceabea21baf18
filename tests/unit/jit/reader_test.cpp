// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "regulus/codegen/jit/reader/parser.hpp"

namespace regulus::codegen::reader {
namespace {

using testing::HasSubstr;

std::string in_function(const std::string& statements) {
  return "#include \"regulus/kernel/pack.hpp\"\nnamespace {\nusing namespace regulus::pack;\n"
         "unsigned f(const double* __restrict boxes, const double*, double* out, I*) {\n" +
         statements + "}\n}\n";
}

/// With parentheses around every operation.
std::string tree(const Expression& e) {
  if (e.kind == Expression::Kind::kDouble) return std::to_string(e.number);
  if (e.kind == Expression::Kind::kInteger) return std::to_string(e.integer);
  if (e.kind == Expression::Kind::kElement)
    return std::string(e.name) + "[" + std::to_string(e.integer) + "]";
  std::string text(e.name);
  if (e.kind != Expression::Kind::kOperation) return text;
  for (const Expression& operand : e.operands) text += " " + tree(operand);
  return "(" + text + ")";
}

std::string tree_of(const std::string& expression) {
  const std::string text = in_function("const I x = " + expression + ";\n");
  return tree(parse_kernel(text).functions.at(0).body.at(0).expression);
}

TEST(KernelReader, OperatorsHaveThePrecedenceOfCxx) {
  EXPECT_EQ(tree_of("a + b * c"), "(+ a (* b c))");
  EXPECT_EQ(tree_of("a * b + c"), "(+ (* a b) c)");
  EXPECT_EQ(tree_of("-a * b"), "(* (- a) b)");
  EXPECT_EQ(tree_of("-(a * b)"), "(- (* a b))");
  EXPECT_EQ(tree_of("a * -b"), "(* a (- b))");
}

TEST(KernelReader, OperatorsOfOnePrecedenceGroupToTheLeft) {
  EXPECT_EQ(tree_of("a - b - c"), "(- (- a b) c)");
  EXPECT_EQ(tree_of("a - b + c"), "(+ (- a b) c)");
  EXPECT_EQ(tree_of("a - (b + c)"), "(- a (+ b c))");
  EXPECT_EQ(tree_of("a * b * c"), "(* (* a b) c)");
}

TEST(KernelReader, OperandsOfFunctionsAreExpressions) {
  EXPECT_EQ(tree_of("mul_add(-k, x - y, shared[3])"), "(mul_add (- k) (- x y) shared[3])");
  EXPECT_EQ(tree_of("pow(x, 5)"), "(pow x 5)");
}

double number_of(const std::string& literal) {
  const std::string text = in_function("const P x = " + literal + ";\n");
  const Expression e = parse_kernel(text).functions.at(0).body.at(0).expression;
  EXPECT_EQ(e.kind, Expression::Kind::kDouble) << literal;
  return e.number;
}

TEST(KernelReader, LiteralsAreTheDoublesThatCxxMakesOfThem) {
  EXPECT_EQ(number_of("0x1.5555555555556p-2"), 0x1.5555555555556p-2);
  EXPECT_EQ(number_of("-0x1p-1074"), -0x1p-1074);
  EXPECT_EQ(number_of("0.1"), 0.1);
  EXPECT_EQ(number_of("1e22"), 1e22);
  EXPECT_EQ(number_of("__builtin_huge_val()"), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::signbit(number_of("-0.0")));
}

TEST(KernelReader, TablesKeepTheirNamesNumbersAndStrings) {
  const KernelText kernel = parse_kernel(
      "const int rows[] = {-1, 2, };\nextern \"C\" {\nextern const T k;\n"
      "const T k = {3, nullptr, {&rows, \"id\"}, 0.5};\n}\n");
  ASSERT_EQ(kernel.tables.size(), 2u);
  EXPECT_TRUE(kernel.tables[0].array);
  EXPECT_EQ(kernel.tables[0].value.list.at(0).integer, -1);
  EXPECT_TRUE(kernel.tables[1].exported);
  const auto& fields = kernel.tables[1].value.list;
  ASSERT_EQ(fields.size(), 4u);
  EXPECT_EQ(fields[1].text, "nullptr");
  EXPECT_EQ(fields[2].list.at(0).text, "rows");
  EXPECT_EQ(fields[2].list.at(1).text, "id");
  EXPECT_EQ(fields[3].number, 0.5);
}

class Outside : public testing::TestWithParam<const char*> {};

TEST_P(Outside, IsLeftToACompiler) {
  const std::string text = in_function(GetParam());
  EXPECT_THROW((void)parse_kernel(text), OutsideSubset);
}

// Each is C++, or close to it, and would mean something else than the reader could make of it.
INSTANTIATE_TEST_SUITE_P(
    KernelReader, Outside,
    testing::Values("const I x = a / b;", "const I x = a % b;", "I x = a;", "const I x = +a;",
                    "const I x = a - --b;", "const I x = f<I>(a);", "const I x = a ? b : c;",
                    "if (a) return u;", "unsigned u = 1;", "u &= g(a);", "x[i] = a;",
                    "for (int e = 0; e < 3; ++e) store(out, e, a);",
                    "for (int e = 0; d <= 3; ++e) store(out, e, a);", "const I x = a, y = b;",
                    "const P x = 0x1e5f;", "const P x = 1.0f;", "const P x = 1'0.0;",
                    "const P x = 1e999;", "const I x = pow(a, 010);", "x[010] = a;",
                    "const I x = a; // \\\n const I x = b;", "/* */", "#define a b\n",
                    "const I x = \"a\";", "const I for = a;", "return u"));

TEST(KernelReader, OtherHeadersAreLeftToACompiler) {
  try {
    (void)parse_kernel("#include \"other.hpp\"\n");
    FAIL() << "accepted";
  } catch (const OutsideSubset& reason) {
    EXPECT_THAT(reason.what(), HasSubstr("another header"));
  }
}

}  // namespace
}  // namespace regulus::codegen::reader
