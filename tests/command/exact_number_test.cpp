// SPDX-License-Identifier: GPL-3.0-or-later
// A verdict is about the numbers as written, in the file and on the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

class ExactNumbers : public testing::Test {
 protected:
  /// Returns the verdict on the 1×1 matrix of that entry.
  std::string verdict(const std::string& entry, const std::string& range,
                      std::vector<std::string> options = {}) {
    write_file(model_, "regulus = 1\nname = \"one\"\n[pose]\nx = \"1\"\n[matrix]\nrows = [[" +
                           entry + "]]\n[motion.m]\nx = " + range + "\n");
    options.insert(options.begin(), {kCommand, "check", model_, "m", "--engine", "interpreted"});
    const CommandResult result = run_command(options);
    errors_ = result.errors;
    return result.output;
  }
  std::string certified(const std::string& entry, const std::string& range) {
    const std::string certificate = directory_.path() / "certificate";
    const std::string words = verdict(entry, range, {"--certificate", certificate});
    return words + regulus({"verify", certificate, "--model", model_}).output;
  }

  TemporaryDirectory directory_;
  std::string model_ = directory_.path() / "model.toml";
  std::string errors_;
};

constexpr const char* kNone = "NO SINGULARITY\n";
constexpr const char* kSome = "SINGULARITY\n";

TEST_F(ExactNumbers, OfMoreDigitsThanADoubleHas) {
  EXPECT_EQ(verdict("\"x - 0.12345678901234567890123\"", "0.12345678901234567890123"), kSome);
  EXPECT_EQ(verdict("\"x - 9007199254740993\"", "9007199254740993.0"), kSome);
  EXPECT_NE(verdict("\"x - 1.00000000000000000001\"", "[0.5, 1.00000000000000000001]"), kNone);
  EXPECT_NE(verdict("\"x - 0.1\"", "0.10000000000000001"), kSome);
  EXPECT_NE(verdict("\"x\"", "1e-400"), kSome);
  EXPECT_NE(verdict("\"x - 5e-324\"", "3e-324"), kSome);
  EXPECT_EQ(verdict("\"x - 9007199254740992\"", "9007199254740993.0"), kNone);
}

TEST_F(ExactNumbers, OfTheCommandLine) {
  const std::string entry = "\"x - 0.12345678901234567890123\"";
  EXPECT_NE(verdict(entry, "1", {"--range", "x=0.12345678901234567890123"}), kNone);
  EXPECT_NE(verdict("\"x - 0.1\"", "1", {"--range", "x=0.10000000000000001"}), kSome);
  // |det| = 1 is above the first threshold and not above the second.
  EXPECT_NE(verdict("\"x\"", "1", {"--alpha", "0.99999999999999999999"}), kSome);
  EXPECT_NE(verdict("\"x\"", "1", {"--alpha", "1.00000000000000000001"}), kNone);
  EXPECT_EQ(verdict("\"x\"", "1", {"--range", "x=sqrt(2):sqrt(2)*(1 - 1e-14)"}), "");
  EXPECT_THAT(errors_, HasSubstr("is empty"));
}

TEST_F(ExactNumbers, AreNotRoundedUpInAClaim) {
  EXPECT_EQ(verdict("\"x\"", "[1, 2]", {"--alpha", "0.1234567"}), kNone);
  EXPECT_THAT(errors_, HasSubstr("|det J⁻¹| > 0.1234567 for"));
  EXPECT_EQ(verdict("\"x\"", "[1, 2]", {"--alpha", "0.1"}), kNone);
  EXPECT_THAT(errors_, HasSubstr("|det J⁻¹| > 0.1 for"));
  EXPECT_EQ(verdict("\"x\"", "[1, 2]", {"--alpha", "1.2345671"}), kSome);
  EXPECT_THAT(errors_, HasSubstr("|det J⁻¹| ≤ 1.2345671"));
}

TEST_F(ExactNumbers, BareInTheMatrix) {
  EXPECT_NE(verdict("1e-400", "[0, 1]"), kSome);
  EXPECT_EQ(verdict("0x0", "[0, 1]"), kSome);
}

TEST_F(ExactNumbers, OfRationalExponentsAreProvedAndVerified) {
  const std::string proved = std::string(kNone) + "VERIFIED\n";
  EXPECT_EQ(certified("\"sqrt(sqrt(x)) - 1\"", "[1.5, 3]"), proved);
  EXPECT_EQ(certified("\"x^(1/4) + x^(1/8) - 2.1\"", "[2, 3]"), proved);
  EXPECT_EQ(certified("\"2 - x^(3/16)\"", "[0.5, 3]"), proved);
  EXPECT_EQ(certified("\"x^(-5/4)\"", "[1, 3]"), proved);
  EXPECT_EQ(certified("\"x^(1/6) + x^(2/3) - x^(7/16384)\"", "[2, 3]"), proved);
  EXPECT_EQ(certified("\"x^(1/4) - 1.1\"", "[1, 3]"), std::string(kSome) + "VERIFIED\n");
}

TEST_F(ExactNumbers, OfRationalExponentsAreUndefinedForNegativeBases) {
  EXPECT_EQ(verdict("\"x^(1/4) + 1\"", "[-1, 3]"), "POSSIBLE PROBLEM\n");
  EXPECT_EQ(verdict("\"x^(1/3) + 1\"", "[-1, 3]"), "POSSIBLE PROBLEM\n");
}

}  // namespace
}  // namespace regulus::detail::test
