// SPDX-License-Identifier: GPL-3.0-or-later
// A question beyond the verifier's limits leaves no certificate, and the report says why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

/// Returns x + u0 + u1 + …, where every u is known to 1/1000.
std::string sum_of_quantities(int count) {
  std::string text = "regulus = 1\nname = \"sum\"\n[pose]\nx = \"m\"\n[geometry]\n", entry = "x";
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    text += "u" + number + " = { value = 1, tolerance = 0.001 }\n";
    entry += " + u" + number;
  }
  return text + "[matrix]\nrows = [[\"" + entry + "\"]]\n[motion.only]\nx = [0, 1]\n";
}

TEST(AQuestionBeyondTheLimitsOfTheFormat, LeavesNoCertificate) {
  const TemporaryDirectory directory;
  const std::string model = directory.path() / "sum.toml", file = directory.path() / "proof";
  const auto check = [&](int count) {
    write_file(model, sum_of_quantities(count));
    return regulus({"check", model, "--certificate", file, "--engine", "interpreted"});
  };
  const CommandResult largest = check(127);  // 127 quantities and x
  EXPECT_EQ(largest.output, "NO SINGULARITY\n");
  EXPECT_THAT(largest.errors, HasSubstr("proof      " + file));
  EXPECT_EQ(regulus({"verify", file}).output, "VERIFIED\n");
  std::filesystem::remove(file);

  const CommandResult larger = check(128);
  EXPECT_EQ(larger.output, "NO SINGULARITY\n");
  EXPECT_THAT(larger.errors,
              HasSubstr("proof      none: the question is beyond the limits of the format: too "
                        "many variables"));
  EXPECT_FALSE(std::filesystem::exists(file));
  const auto report =
      nlohmann::json::parse(regulus({"check", model, "--certificate", file, "--json", "--quiet",
                                     "--engine", "interpreted"})
                                .output);
  EXPECT_TRUE(report["certificate"].is_null());
  EXPECT_THAT(std::string(report["certificate_obstacle"]), HasSubstr("too many variables"));
}

TEST(NumbersBeyondTheBoundsOfTheVerifier, AreAnnounced) {
  const TemporaryDirectory directory;
  const std::string model = directory.path() / "huge.toml", file = directory.path() / "proof";
  const auto check = [&](const std::string& factor, const std::string& range) {
    write_file(model, "regulus = 1\nname = \"huge\"\n[pose]\nx = \"m\"\n[matrix]\nrows = [[\"x*" +
                          factor + " - 1\"]]\n[motion.only]\nx = " + range + "\n");
    return nlohmann::json::parse(regulus({"check", model, "--certificate", file, "--json",
                                          "--quiet", "--engine", "interpreted"})
                                     .output);
  };
  EXPECT_FALSE(check("2^100", "[1, 2]").contains("certificate_note"));
  EXPECT_THAT(std::string(check("2^100*2^100*2", "[1, 2]")["certificate_note"]),
              HasSubstr("beyond 2^200"));
  EXPECT_FALSE(check("2^100*2^100*2", "[0, 2]").contains("certificate_note"))
      << "for points there are bits";
}

}  // namespace
}  // namespace regulus::detail::test
