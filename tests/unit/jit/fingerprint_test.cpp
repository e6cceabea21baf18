// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/reader/fingerprint.hpp"

#include <gtest/gtest.h>

#include "regulus/codegen/jit/reader/parser.hpp"
#include "regulus/codegen/jit/reader/token.hpp"

namespace regulus::codegen::reader {
namespace {

std::string kernel_of(const std::string& functions) {
  return "#include \"regulus/kernel/pack.hpp\"\nnamespace {\nusing namespace regulus::pack;\n" +
         functions + "}\n";
}

const std::string kHead = "(const double* boxes, const double* points, double* out, I* shared) {\n";

std::string function(const std::string& name, const std::string& body) {
  return "unsigned " + name + kHead + "  unsigned undefined = 0;\n" + body +
         "  return undefined;\n}\n";
}

std::string symbol_of(const std::string& body) {
  const std::string text = kernel_of(function("f", body));
  return symbols_of(parse_kernel(text)).at("f");
}

const std::string kBody =
    "const I a = load(boxes, 0);\nconst I b = shared[3];\nconst I c = mul_add(a, P(2.0), b);\n"
    "shared[4] = c;\nstore(out, 1, a - c);\n";

TEST(Fingerprint, DoesNotDependOnNamesOrOnWhatElseThereIs) {
  std::string renamed = kBody;
  for (const auto& [from, to] :
       {std::pair("I a", "I t_7"), std::pair("(a,", "(t_7,"), std::pair("a - c", "t_7 - c")})
    renamed.replace(renamed.find(from), std::string(from).size(), to);
  EXPECT_EQ(symbol_of(renamed), symbol_of(kBody));
  const std::string other = kernel_of(function("g", "") + function("h", "// a remark\n" + kBody));
  EXPECT_EQ(symbols_of(parse_kernel(other)).at("h"), symbol_of(kBody));
}

TEST(Fingerprint, DependsOnEverythingThatIsComputed) {
  const std::pair<const char*, const char*> changes[] = {
      {"load(boxes, 0)", "load(boxes, 1)"},
      {"load(boxes", "load(points"},
      {"shared[3]", "shared[2]"},
      {"mul_add(a, P(2.0), b)", "mul_add(b, P(2.0), a)"},
      {"P(2.0)", "P(0x1.0000000000001p+1)"},
      {"P(2.0)", "P(-2.0)"},
      {"shared[4] = c", "shared[5] = c"},
      {"shared[4] = c", "shared[4] = a"},
      {"a - c", "a + c"},
      {"a - c", "c - a"},
      {"a - c", "-a - c"},
      {"store(out, 1", "store(out, 2"},
      {"store(out, 1, a - c);\n", ""},
      {"const I b = shared[3]", "const I b = sqr(a)"},
      {"shared[4] = c;\n", "undefined = 0;\n"}};
  for (const auto& [from, to] : changes) {
    std::string changed = kBody;
    ASSERT_NE(changed.find(from), std::string::npos) << from;
    changed.replace(changed.find(from), std::string(from).size(), to);
    EXPECT_NE(symbol_of(changed), symbol_of(kBody)) << to;
  }
}

/// A value of an operation's name hides nothing here: what is called is the operation.
TEST(Fingerprint, DependsOnTheOperationWhateverValuesAreCalled) {
  const auto body = [](const std::string& name) {
    return "const I " + name + " = load(boxes, 0);\nstore(out, 0, " + name + "(" + name + "));\n";
  };
  EXPECT_NE(symbol_of(body("sqr")), symbol_of(body("exp")));
}

TEST(Fingerprint, OfACallerDependsOnWhatItCalls) {
  const auto caller = [](const std::string& part) {
    const std::string text = kernel_of(
        function("f_1", part) + function("f", "undefined |= f_1(boxes, points, out, shared);\n"));
    return symbols_of(parse_kernel(text)).at("f");
  };
  EXPECT_EQ(caller(kBody), caller(kBody));
  EXPECT_NE(caller(kBody), caller(""));
}

TEST(Fingerprint, OfAnExportedFunctionIsItsName) {
  const std::string text =
      "#include \"regulus/kernel/pack.hpp\"\nusing namespace regulus::pack;\n"
      "extern \"C\" unsigned seen" +
      kHead + "  unsigned undefined = 0;\n  return undefined;\n}\n";
  EXPECT_EQ(symbols_of(parse_kernel(text)).at("seen"), "seen");
}

TEST(Fingerprint, NeedsOneFunctionOfAName) {
  const std::string text = kernel_of(function("f", "") + function("f", kBody));
  EXPECT_THROW(static_cast<void>(symbols_of(parse_kernel(text))), OutsideSubset);
}

}  // namespace
}  // namespace regulus::codegen::reader
