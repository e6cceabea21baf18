// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the verifier's own reader of model files. It refuses a number that differs from the number
// in the certificate, whoever wrote the certificate.
#include <gtest/gtest.h>

#include "runtime/verifier/model/model_file.hpp"
#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;
using verifier::Verification;

/// A model file, and the text about it in a certificate.
struct WrittenTwice {
  std::string entry = "x + 3 + u", x = "[0, 1]", u = "{ value = 0.1, tolerance = 0.05 }", more;
  std::string stated_entry = "x + 3 + u", stated_x = "0 : 1", stated_u = "1/10 +- 1/20",
              stated_more, alpha = "0";
};

Verification compare(const WrittenTwice& p, const std::set<std::string>& overridden = {}) {
  verifier::Options options;
  options.model_name = "model.toml";
  options.model_text = "regulus = 1\nname = \"m\"\n[pose]\nx = \"m\"\n[geometry]\nu = " + p.u +
                       "\n[let]\nc = \"x + d\"\nd = \"3 + u\"\n[matrix]\nrows = [[\"" + p.entry +
                       "\"]]\n[motion.only]\nx = " + p.x + "\n" + p.more + "\n";
  options.overridden = overridden;
  const std::string quantities =
      p.stated_u.find("+-") != std::string::npos ? " and value of the 1 uncertain quantities" : "";
  const std::string claim = p.alpha == "0"
                                ? "the full 1x1 matrix of the model is defined and has full rank"
                                : "|det| of the full 1x1 matrix of the model exceeds alpha";
  return verify_text("regulus-certificate 1\nverdict NO SINGULARITY\nclaim " + claim +
                         " at every pose" + quantities + " of the variety\nmodel m\nsha256 -\n" +
                         "motion only\nalpha " + p.alpha + "\nparameter x in " + p.stated_x + "\n" +
                         (quantities.empty() ? "constant" : "uncertain") + " u = " + p.stated_u +
                         "\npose x = x\nmatrix 1 1\nentry " + p.stated_entry + "\n" +
                         p.stated_more + kOneLeaf,
                     options);
}

void expect_refused(const WrittenTwice& p, const std::string& number, const std::string& other) {
  const Verification v = compare(p);
  EXPECT_EQ(v.outcome, Outcome::kRejected) << number;
  for (const std::string& part :
       {std::string("not about model.toml: line "), number, other, std::string("in line ")})
    EXPECT_NE(v.reason.find(part), std::string::npos) << v.reason;
}

TEST(AModelFile, IsComparedValueByValue) {
  const Verification v = compare({});
  EXPECT_EQ(v.outcome, Outcome::kVerified) << v.reason;
  EXPECT_EQ(v.numbers, 5u);
}

/// The front end writes roots for the values of some angles, and other angles in the first quadrant.
TEST(AnAngleThatIsAPartOfATurn, HasTheValueThatItsOtherFormsHave) {
  WrittenTwice p;
  for (const auto& [ours, stated] :
       {std::pair("cos(108*deg)", "(1 - sqrt(5))/4"), std::pair("sin(54*deg)", "(sqrt(5) + 1)/4"),
        std::pair("cos(144*deg)", "-sqrt(5)/4 - 1/4"), std::pair("sin(-18*deg)", "1/4 - sqrt(5)/4"),
        std::pair("sin(108*deg)", "sin(2/5*pi)"), std::pair("cos(18*deg)", "sin(2/5*pi)"),
        std::pair("cos(200*deg)", "-cos(1/9*pi)"), std::pair("sin(290*deg)", "-cos(1/9*pi)")}) {
    p.entry = std::string("x + 3 + ") + ours, p.stated_entry = std::string("x + 3 + ") + stated;
    const Verification v = compare(p);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << ours << ": " << v.reason;
  }
  p.entry = "x + 3 + cos(108*deg)", p.stated_entry = "x + 3 + (1 + sqrt(5))/4";
  EXPECT_EQ(compare(p).outcome, Outcome::kRejected);
}

/// Each certificate has the shortest decimal of the double nearest to the number in the model.
TEST(AMisreadNumber, IsRefusedWithBothNumbers) {
  WrittenTwice p;
  p.entry = "x + 0.12345678901234567890123", p.stated_entry = "x + 0.12345678901234568";
  expect_refused(p, "0.12345678901234567890123", "0.12345678901234568");
  p = {};
  p.x = "[0.5, 1.00000000000000000001]", p.stated_x = "1/2 : 1";
  expect_refused(p, "1.00000000000000000001", "'1'");
  p.x = "[1e-400, 1]", p.stated_x = "0 : 1";
  expect_refused(p, "1e-400", "'0'");
  p.x = "[3e-324, 1]", p.stated_x = "5e-324 : 1";
  expect_refused(p, "3e-324", "5e-324");
  p.x = "[9007199254740993.0, 9007199254740995]",
  p.stated_x = "9007199254740992 : 9007199254740995";
  expect_refused(p, "9007199254740993.0", "9007199254740992");
  p.x = "[0.10000000000000001, 1]", p.stated_x = "1/10 : 1";
  expect_refused(p, "0.10000000000000001", "1/10");
  p = {};
  p.u = "{ value = 0.1, tolerance = 0.05000000000000000000001 }";
  expect_refused(p, "0.05000000000000000000001", "1/20");
  p.u = "{ value = 0.10000000000000000000001, tolerance = 0.05 }";
  expect_refused(p, "0.10000000000000000000001", "1/10");
  p = {};
  p.more = "alpha = 0.10000000000000000000001", p.alpha = "1/10";
  expect_refused(p, "0.10000000000000000000001", "1/10");
  p = {};
  p.more = "constraints = [\"x - 2.00000000000000000000001\"]",
  p.stated_more = "constraint x - 2\n";
  expect_refused(p, "2.00000000000000000000001", "x - 2");
}

TEST(AnError, IsRefusedWhereTheCertificateHasNone) {
  WrittenTwice p;
  p.more = "error = { x = 1e-400 }";
  const Verification v = compare(p);
  EXPECT_EQ(v.outcome, Outcome::kRejected);
  EXPECT_NE(v.reason.find("1e-400"), std::string::npos) << v.reason;
}

TEST(EveryWayToWriteANumber, MeansTheSame) {
  WrittenTwice p;
  p.stated_x = "-31 : 1000";
  p.stated_entry = "x + 35 + u";
  for (const char* x : {"[-31, 1_000]", "[-31.0, \"10^3\"]", "[-0x1F, 0b1111101000]",
                        "[\n  -3.1e+1, # a comment\n  0o1750,\n]", "['-31', '''1000''']"}) {
    p.x = x;
    p.entry = "x + 35 + u";
    EXPECT_EQ(compare(p).outcome, Outcome::kVerified) << x << compare(p).reason;
  }
}

TEST(AnExpression, IsTheSameHoweverItIsWritten) {
  WrittenTwice p;
  for (const char* entry : {"c", "3 + (x + u)", "d + x", "c*(sin(c)^2 + cos(c)^2)", "180*deg/pi*c",
                            "(c^2 - 1)/(c^2 + 1)*(1 + c^2)/4 + (5 - c^2)/4 + c - 1"}) {
    p.entry = entry;
    const Verification v = compare(p);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << entry << v.reason;
  }
  p.stated_more = "defined sqrt(x + u + 3)\n";
  for (const char* entry :
       {"(x + d)^(1/2)*(x + d)^0.5", "2*sqrt((3 + u + x)/4)*(2*c)^(1/2)/2^0.5"}) {
    p.entry = entry;
    EXPECT_EQ(compare(p).outcome, Outcome::kVerified) << entry << compare(p).reason;
  }
  p.stated_more = "defined 1/x\n", p.entry = "x*(x + 3 + u)/x";
  p.x = "[0.5, 1]", p.stated_x = "1/2 : 1";
  EXPECT_EQ(compare(p).outcome, Outcome::kVerified) << compare(p).reason;
  p = {};
  for (const char* entry : {"c + 1e-300", "x + 3", "3 + x - u", "c^2", "abs(c) + 0*x + 1e-99"}) {
    p.entry = entry;
    EXPECT_EQ(compare(p).outcome, Outcome::kRejected) << entry;
  }
}

/// Also below a root, where a quotient has a form of its own.
TEST(AnExpression, IsTheSameWithAPowerOfAQuotientOrAQuotientOfPowers) {
  WrittenTwice p;
  p.entry = "c + sqrt((1/(x^2 + x + 2))^2*(x + 1) + 1)";
  p.stated_entry = "x + 3 + u + sqrt(1 + (x + 1)/(x^2 + x + 2)^2)";
  EXPECT_EQ(compare(p).outcome, Outcome::kVerified) << compare(p).reason;
  p.stated_entry = "x + 3 + u + sqrt(1 + (x + 1)/(x^2 + x + 2)^3)";
  EXPECT_EQ(compare(p).outcome, Outcome::kRejected) << compare(p).reason;
}

TEST(WhatAnOptionHasSet, IsListedAndNotRefused) {
  WrittenTwice p;
  p.stated_x = "0 : 2";
  EXPECT_EQ(compare(p).outcome, Outcome::kRejected);
  EXPECT_EQ(compare(p, {"range y"}).outcome, Outcome::kRejected);
  const Verification v = compare(p, {"range x"});
  EXPECT_EQ(v.outcome, Outcome::kVerified);
  ASSERT_EQ(v.differences.size(), 1u);
  EXPECT_NE(v.differences[0].find("motion.only.x[1] is '1', but the certificate has '2'"),
            std::string::npos)
      << v.differences[0];
}

TEST(WhatTheReaderDoesNotUnderstand, IsUnfinishedWithItsLine) {
  WrittenTwice p;
  p.entry = "x + unknown";
  const Verification v = compare(p);
  EXPECT_EQ(v.outcome, Outcome::kUnfinished);
  EXPECT_NE(v.reason.find("matrix.rows[0][0], line 11: the name unknown"), std::string::npos)
      << v.reason;
  p = {};
  p.more = "y = [1, 2";
  EXPECT_EQ(compare(p).outcome, Outcome::kUnfinished);
  p.more = std::string(100000, '[');
  p.more.insert(0, "y = ");
  EXPECT_EQ(compare(p).outcome, Outcome::kUnfinished);
}

TEST(TheReaderOfToml, KnowsEscapesInNamesAndStrings) {
  const auto values = verifier::read_model_values(
      "\"\\u0061b\" = \"\\u00e9\\U0001F916\\u20ac\"\n[\"\\U00000074\"]\n'q' = 1\n");
  EXPECT_EQ(values.at("ab").text, "\xc3\xa9\xf0\x9f\xa4\x96\xe2\x82\xac");
  EXPECT_EQ(values.at("t.q").text, "1");
  for (const char* text : {"a = \"\\u12g4\"\n", "a = \"\\ud800\"\n", "a = \"\\U00110000\"\n",
                           "\"a[0]\" = 1\n", "\"a.b\" = 1\n"})
    EXPECT_THROW(static_cast<void>(verifier::read_model_values(text)), verifier::Unfinished)
        << text;
}

TEST(TheReaderOfToml, KeepsTheBytesOfNumbers) {
  const auto values =
      verifier::read_model_values("a.b = 1_0.50 # c\n[t]\n\"q\" = [ 1e-5, { z = 'it' } ]\n");
  EXPECT_EQ(values.at("a.b").text, "1_0.50");
  EXPECT_EQ(values.at("t.q[0]").text, "1e-5");
  EXPECT_EQ(values.at("t.q[0]").line, 3u);
}

}  // namespace
}  // namespace regulus::detail::test
