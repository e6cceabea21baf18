// SPDX-License-Identifier: GPL-3.0-or-later
// A text that is not a certificate is rejected; the message has its line and a reason.
#include <gtest/gtest.h>

#include "runtime/proof/format.hpp"
#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {
namespace {

void expect_rejected(const std::string& text, const std::string& why) {
  const auto v = verify_text(text);
  EXPECT_EQ(v.outcome, verifier::Outcome::kRejected);
  EXPECT_NE(v.reason.find(why), std::string::npos) << v.reason;
  EXPECT_TRUE(v.reason.starts_with("line ")) << v.reason;
}

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

/// Returns x with very many repetitions before and after it.
std::string nested(const std::string& before, const std::string& after) {
  std::string text = repeated(before, 100000);
  text += 'x';
  text += repeated(after, 100000);
  return text;
}

TEST(AFile, MustBeginWithItsFormat) {
  expect_rejected("", "ends before");
  expect_rejected("regulus-certificate 2\n", "the first line is not");
  expect_rejected("regulus = 1\n", "the first line is not");
}

TEST(AFile, MustEndInAWholeLine) {
  expect_rejected(scalar_question("x") + "proof\nl 0 mean-value\nend 1", "no newline");
  expect_rejected(scalar_question("x") + "proof\nl 0 mean-value\n", "ends before");
  expect_rejected(scalar_question("x") + kOneLeaf + "\n", "text after the line 'end'");
}

TEST(AFile, HoldsTextOnly) {
  expect_rejected(scalar_question("x\t") + kOneLeaf, "control character");
  expect_rejected(scalar_question("x\xe2\x80\xae") + kOneLeaf, "control character");
  expect_rejected(std::string(format::kLongestLine + 2, 'x') + "\n", "too long");
}

TEST(AnExpression, IsArithmeticOnDeclaredNames) {
  for (const char* entry :
       {"",     "y",    "x +",   "x x",   "(x",    "x)",       "system(x)", "x^y",
        "x^-1", "x^0",  "x^1.5", "sin x", "sin()", "atan2(x)", "1e",        "1e9999999",
        ".",    "1..2", "x;",    "\"x\"", "0x1p",  "sin",      "--"})
    expect_rejected(scalar_question(entry) + kOneLeaf, "");
}

TEST(AnExpression, HasBoundedSizeAndDepth) {
  expect_rejected(scalar_question(nested("(", ")")) + kOneLeaf, "levels");
  expect_rejected(scalar_question(nested("-", "")) + kOneLeaf, "levels");
  expect_rejected(scalar_question(nested("", "+sin(x)")) + kOneLeaf, "more operations");
  expect_rejected(scalar_question("x^99999999999999999999") + kOneLeaf, "smaller exponent");
  expect_rejected(scalar_question(repeated("9", 5000)) + kOneLeaf, "digits");
}

TEST(AValueBeyondTheDoubles, IsNotProved) {
  EXPECT_EQ(verify_text(scalar_question("exp(exp(exp(exp(x))))") + kOneLeaf).outcome,
            verifier::Outcome::kUnfinished);
}

TEST(AName, IsDeclaredOnce) {
  const std::string text = scalar_question("x");
  const auto with = [&text](const std::string& before, const std::string& line) {
    std::string changed = text;
    return changed.insert(changed.find("\n" + before) + 1, line) + kOneLeaf;
  };
  expect_rejected(with("pose", "parameter x in 0 : 1\n"), "declared twice");
  expect_rejected(with("pose", "constant x = 1\n"), "declared twice");
  expect_rejected(with("matrix", "let x = 1\n"), "declared twice");
  expect_rejected(with("pose", "parameter pi in 0 : 1\n"), "cannot be a name");
  expect_rejected(with("pose", "parameter 1x in 0 : 1\n"), "cannot be a name");
}

TEST(ABall, IsMadeOfUncertainQuantitiesOfOneSpread) {
  const auto with = [](const std::string& lines) {
    std::string text = scalar_question("x");
    return text.insert(text.find("\npose") + 1, lines) + kOneLeaf;
  };
  expect_rejected(with("ball x\n"), "cannot be a coordinate");
  expect_rejected(with("uncertain a = 1 +- 1\nball a a\n"), "cannot be a coordinate");
  expect_rejected(with("uncertain a = 1 +- 1\nuncertain b = 1 +- 2\nball a b\n"),
                  "different radii");
  expect_rejected(with("constant a = 1\nball a\n"), "cannot be a coordinate");
}

TEST(ATree, NamesOpenBoxesAndVariablesThatExist) {
  const std::string question = scalar_question("x") + "proof\n";
  expect_rejected(question + "l 1 mean-value\nend 1\n", "box 1 is not open");
  expect_rejected(question + "s 0 1 0x1.8p+0\n", "no variable");
  expect_rejected(question + "s 0 0 0x1p+1\n", "not inside");
  expect_rejected(question + "s 0 0 nan\n", "not a number");
  expect_rejected(question + "s 0 0 inf\n", "not a number");
  expect_rejected(question + "s 0 0 0x1.8p+0x\n", "not a number");
  expect_rejected(question + "l 0 luck\n", "no rule");
  expect_rejected(question + "l 0 mean-value\nend 2\n", "a wrong number of leaves");
  expect_rejected(question + "l -1 mean-value\n", "");
  expect_rejected(question + "l 99999999999999999999999 mean-value\n", "");
  expect_rejected(question + "nonsense\n", "expected 's BOX");
}

TEST(AForgedIdentity, IsNoProof) {
  const auto claimed = [](const std::string& entry) {
    return verify_text(scalar_question(entry, "0 : 3", kSingular1) +
                       "proof\nreason always-singular\npoint 0 0x1p+0\nend\n");
  };
  for (const char* entry : {"x", "x - x + 1e-300", "sin(x)^2 + cos(x)^2 - 1 + 1e-30",
                            "(x + 1)^2 - x^2 - 2*x", "sqrt(2)*sqrt(3) - sqrt(5)"}) {
    const auto v = claimed(entry);
    EXPECT_NE(v.outcome, verifier::Outcome::kVerified) << entry;
    EXPECT_NE(v.reason.find("exact algebra"), std::string::npos) << v.reason;
  }
  expect_rejected(scalar_question("x - x", "0 : 3", kSingular1) +
                      "proof\nreason always-singular\npoint 0 0x1p+2\nend\n",
                  "outside the ranges");
  expect_rejected(scalar_question("x - x", "0 : 3", kSingular1) +
                      "proof\nreason always-singular\npoint 0 0x1p+0\nmore\n",
                  "expected 'end'");
}

TEST(AnEndOfARange, IsNoCoordinateOfASignOrOfABall) {
  const std::string question = scalar_question("x - 1", "0 : 3", kSingular1);
  expect_rejected(question + "proof\nreason opposite-signs\npoint + upper\n", "not a number");
  expect_rejected(question + "proof\nreason small-determinant\npoint 0 middle\n", "not a number");
  std::string ball = scalar_question("x - a", "0 : 3", kSingular1);
  ball.insert(ball.find(" of the variety"), " and value of the 1 uncertain quantities");
  ball.insert(ball.find("\npose") + 1, "uncertain a = 1 +- 1\nball a\n");
  expect_rejected(ball + "proof\nreason small-determinant\npoint 0 0x1p+0 upper\nend\n",
                  "a coordinate of a ball");
}

}  // namespace
}  // namespace regulus::detail::test
