// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers are exact or refused. TOML that would exhaust its parser's stack is refused, too.
#include "codegen/model/file/toml_limits.hpp"
#include "tests/error/model/refusal.hpp"

namespace regulus::detail {
namespace {

using test::changed;
using test::expect_refused;
using test::expect_refused_change;
using test::kExample;

/// Returns `before`, then `text` so many times, then `after`.
std::string repeated(const char* before, const std::string& text, std::size_t count,
                     const std::string& after = {}) {
  std::string result(before);
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result += after;
}

TEST(NumberRefusal, WhatTomlCannotHoldIsToldToBeWrittenAsAString) {
  for (const char* number :
       {"1e400", "99999999999999999999", "0x1_0000_0000_0000_0000", "-9223372036854775809"})
    expect_refused_change("half = 0.5", std::string("half = ") + number, 21,
                          "a number that TOML cannot hold", "in a string");
  expect_refused_change("half = 0.5", "half = 0." + std::string(200, '3'), 21,
                        "a number that TOML cannot hold", "in a string");
  EXPECT_NO_THROW(static_cast<void>(parse_model(
      changed(kExample, "half = 0.5", "half = \"0." + std::string(900, '3') + "\""), "m.toml")));
}

TEST(NumberRefusal, AnExponentBeyondTheLimit) {
  expect_refused_change("half = 0.5", "half = 1e-1001", 21, "the number '1e-1001' for let.half",
                        "an exponent within ±1000");
  expect_refused_change("half = 0.5", "half = 0e5000", 21, "the number '0e5000' for let.half",
                        "at most 1000 digits");
}

TEST(NumberRefusal, InfinityAndDatesAreNoNumbers) {
  for (const char* text : {"inf", "-inf", "nan", "1979-05-27", "07:32:00", "true", "[1]", "{}"})
    expect_refused_change("half = 0.5", std::string("half = ") + text, 21, "for let.half",
                          "a finite number");
}

TEST(RangeRefusal, ReversedByLessThanDoublesCanTell) {
  expect_refused_change("y = [4, 5]", R"toml(y = ["sqrt(2)", "sqrt(2)*(1 - 1e-14)"])toml", 34,
                        "is empty", "lower end must not be above");
  expect_refused_change("y = [4, 5]", R"toml(y = ["1/3", "1/3 - 1e-14"])toml", 34, "is empty",
                        "lower end must not be above");
  expect_refused_change("y = [4, 5]", "y = [0.10000000000000001, 0.1]", 34, "is empty",
                        "lower end must not be above");
}

TEST(RangeRefusal, EndsWhoseOrderIsNotKnown) {
  expect_refused_change("y = [4, 5]", R"toml(y = ["sqrt(sqrt(2) + 1)*sqrt(sqrt(2) - 1)", 1])toml",
                        34, "4096 bits do not show which end is the lower one", "differ clearly");
}

TEST(RangeRefusal, NegativeByLessThanDoublesCanTell) {
  expect_refused_change("tolerance = 0.01", R"toml(tolerance = "-1e-13*sqrt(2)")toml", 12,
                        "the negative number", "a number ≥ 0");
  expect_refused_change("alpha = 0", R"toml(alpha = "1 - sqrt(sqrt(2) + 1)*sqrt(sqrt(2) - 1)")toml",
                        37, "4096 bits do not show its sign", "clearly above 0");
}

// Deep nesting, in every way that TOML offers.

TEST(TomlLimits, DottedKeys) {
  expect_refused_change("half = 0.5", repeated("", "a.", 40000, "a = 1"), 21,
                        "a key of too many parts", "at most 16 parts");
  expect_refused_change("half = 0.5", repeated("half = { ", "'a' . ", 40000, "a = 1 }"), 21,
                        "a key of too many parts", "at most 16 parts");
}

TEST(TomlLimits, TableHeaders) {
  expect_refused_change("[let]", repeated("[", "a.", 40000, "a]"), 17, "a key of too many parts",
                        "at most 16 parts");
  expect_refused_change("[let]", repeated("[[", "\"a#\".", 40000, "a]]"), 17,
                        "a key of too many parts", "at most 16 parts");
}

TEST(TomlLimits, ArraysAndInlineTables) {
  expect_refused_change("half = 0.5", repeated("half = ", "[", 100000), 21,
                        "values nested too deeply", "at most 32 levels");
  expect_refused_change("half = 0.5", repeated("half = ", "{a=", 100000), 21,
                        "values nested too deeply", "at most 32 levels");
  expect_refused_change("half = 0.5", repeated("half = ", "[\n{a=", 100000), 37,
                        "values nested too deeply", "at most 32 levels");
}

TEST(TomlLimits, DeepTablesInDeepTables) {
  // Each key and each value is within its limits.
  const std::string key = repeated("{", "a.", kMaxKeyParts - 1, "a = ");
  const std::string end = repeated("1", "}", kMaxTomlNesting);
  expect_refused_change("half = 0.5", repeated("half = ", key, kMaxTomlNesting, end), 21,
                        "a table for let.half", "a finite number");
}

TEST(TomlLimits, ManyTables) {
  std::string many;
  for (int i = 0; i < 30000; ++i) many.append("a").append(std::to_string(i)).append(".b.c = 1\n");
  expect_refused_change("half = 0.5", many, 21 + 6666, "too many dotted keys and tables",
                        "at most 20000 parts");
}

TEST(ModelLimits, ManyUsesOfALargeExpression) {
  const std::string large = repeated("q = \"", "sqrt(x + 1) + ", 4000, "1\"\n");
  const std::string row = repeated("[", "\"q\", ", 64, "],\n");
  expect_refused("regulus = 1\nname = \"a\"\n[pose]\nx = \"1\"\n[let]\n" + large +
                     repeated("[matrix]\nrows = [\n", row, 64, "]\n"),
                 13, "a model too large at matrix.rows[5]", "5 million operations");
}

TEST(TomlLimits, CountNothingInStringsCommentsAndNumbers) {
  const std::string marks = repeated("", ".[{", 50);
  // The model reader refuses the backslash as part of a label; the limits do not refuse it.
  const std::string source = "source = \"\"\"" + marks + "\\\\\"\"\"\"\"  # \" '" + marks;
  expect_refused_change("source = \"made up\"", source, 3, "for source", "control characters");
  const std::string comment = "a2 = 10 # \"\"\"" + marks;
  EXPECT_NO_THROW(static_cast<void>(parse_model(changed(kExample, "a2 = 10", comment), "m.toml")));
  std::string numbers = "regulus = 1\nname = '" + marks + "'\npose = { x = '1' }\n";
  numbers += repeated("matrix = { rows = [", "[0.5],", 60, "] }\n[geometry]\n");
  for (int i = 0; i < 21000; ++i) numbers.append("g").append(std::to_string(i)).append(" = 0.25\n");
  numbers += "[motion.m]\nx = 1\n";
  EXPECT_NO_THROW(static_cast<void>(parse_model(numbers, "m.toml")));
}

}  // namespace
}  // namespace regulus::detail
