// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `regulus margin --certificate FILE`: it proves each end of the bracket, and nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// det = a − x²/2: see margin_test.cpp. Critical: tolerance of a 1/2, scale √2, alpha 1/2.
constexpr const char* kProvedBowl = R"(regulus = 1
name = "bowl"
[pose]
x = "1"
[geometry]
a = { value = 1, tolerance = 0, group = "a" }
p = { value = [0, 0], radius = 0, group = "ball" }
[matrix]
rows = [["a", "x/2 + p_1"], ["x + p_2", "1"]]
[motion.small]
x = [-1, 1]
[motion.half]
x = [-1, 1]
constraints = ["x"]
)";

class MarginCertificate : public testing::Test {
 protected:
  MarginCertificate() { write_file(model_, kProvedBowl); }

  [[nodiscard]] CommandResult margin(std::vector<std::string> words) const {
    words.insert(words.end(), {"--engine", "interpreted", "--certificate", file("ends")});
    return regulus({"margin", model_}, words);
  }
  [[nodiscard]] json report(std::vector<std::string> words) const {
    words.emplace_back("--json");
    return json::parse(margin(words).output);
  }
  [[nodiscard]] json verified(const std::string& end) const {
    return json::parse(regulus({"verify", file("ends." + end), "--model", model_, "--allow-options",
                                "--json", "--quiet"})
                           .output);
  }
  /// Expects proofs of both ends, which differ from the model in `what`, in one place or at both ends of a range.
  void expect_both_ends(const std::vector<std::string>& words, const std::string& what) const {
    const json found = report(words);
    for (const auto& [end, claim] : {std::pair("safe", "certified"), {"singular", "refuted"}}) {
      EXPECT_EQ(found["certificates"][end], file(std::string("ends.") + end));
      const json proof = verified(end);
      EXPECT_EQ(proof["outcome"], "verified") << proof;
      const bool is_range = what.ends_with("[0] ");
      ASSERT_EQ(proof["differences"].size(), is_range ? 2U : 1U) << proof;
      EXPECT_THAT(std::string(proof["differences"][0]), HasSubstr(what)) << found[claim];
    }
    EXPECT_THAT(std::string(verified("singular")["claim"]), HasSubstr("at some pose"));
    EXPECT_THAT(std::string(verified("safe")["claim"]), HasSubstr("at every pose"));
  }

  [[nodiscard]] std::string file(const std::string& name) const { return directory_.path() / name; }
  [[nodiscard]] std::size_t files() const {
    const std::filesystem::directory_iterator begin(directory_.path());
    return std::size_t(std::distance(begin, {}));
  }

  TemporaryDirectory directory_;
  std::string model_ = directory_.path() / "bowl.toml";
};

/// det = x² + y², so the robot is singular without any error if the motion meets the origin.
TEST_F(MarginCertificate, ProvesTheEndsOfATubeAt0) {
  write_file(model_, R"(regulus = 1
name = "cart"
[pose]
x = "1"
y = "1"
[matrix]
rows = [["x", "y"], ["-y", "x"]]
[motion.crossing]
x = 0
y = [-1, 1]
[motion.beside]
x = 1
y = [-1, 1]
error = { y = 0.1 }
)");
  static_cast<void>(report({"crossing", "--tube", "x=0:1"}));
  EXPECT_EQ(verified("singular")["outcome"], "verified");
  EXPECT_EQ(run_command({kVerify, "--model", model_, file("ends.singular")}).output, "VERIFIED\n");
  static_cast<void>(report({"beside", "--tube", "x=0:1e-9", "--max-boxes", "1000"}));
  EXPECT_EQ(verified("safe")["outcome"], "verified");
}

TEST_F(MarginCertificate, ProvesBothEndsOfATolerance) {
  expect_both_ends({"small", "--tolerance", "a=0:0.9"}, "geometry.a.tolerance ");
  EXPECT_EQ(files(), 3U) << "the model and two certificates";
}

TEST_F(MarginCertificate, ProvesBothEndsOfATolerancePairInABall) {
  expect_both_ends({"small", "--tolerance", "ball=0:2"}, "geometry.p.radius ");
}

TEST_F(MarginCertificate, ProvesBothEndsOfAThreshold) {
  expect_both_ends({"small", "--alpha", "1/100:10"}, "motion.small.alpha ");
}

TEST_F(MarginCertificate, ProvesBothEndsOfAScale) {
  expect_both_ends({"small", "--scale", "0:2"}, "motion.small.x[0] ");
}

TEST_F(MarginCertificate, ProvesBothEndsBetweenConstraints) {
  expect_both_ends({"half", "--tolerance", "a=0:0.9"}, "geometry.a.tolerance ");
}

TEST_F(MarginCertificate, NamesTheFilesAndTheValuesInItsReport) {
  const CommandResult result = margin({"small", "--tolerance", "a=0:0.9"});
  EXPECT_THAT(result.errors, HasSubstr("proof      " + file("ends.safe") + ": safe at 0.4"));
  EXPECT_THAT(result.errors, HasSubstr(file("ends.singular") + ": singular at 0.5"));
}

TEST_F(MarginCertificate, IsNotWrittenForAnEndThatIsNotKnown) {
  write_file(file("ends.singular"), "of an earlier run");
  const json safe = report({"small", "--tolerance", "a=0:0.1"});
  EXPECT_EQ(safe["certificates"]["singular"], nullptr);
  EXPECT_FALSE(std::filesystem::exists(file("ends.singular")));
  EXPECT_EQ(file_contents(file("ends.singular") + ".old"), "of an earlier run");
  EXPECT_EQ(verified("safe")["outcome"], "verified");

  std::filesystem::remove(file("ends.safe"));
  const CommandResult singular = margin({"small", "--tolerance", "a=0.6:0.9"});
  EXPECT_EQ(singular.exit_code, 1);
  EXPECT_THAT(singular.errors, HasSubstr("none for the safe end"));
  EXPECT_FALSE(std::filesystem::exists(file("ends.safe")));
  EXPECT_EQ(verified("singular")["outcome"], "verified");
}

TEST_F(MarginCertificate, ThatCannotBeMadeIsSaidBeforeTheFirstSearch) {
  const CommandResult result = regulus({"margin", model_, "small", "--tolerance", "a=0:0.9",
                                        "--certificate", file("no/such/folder")});
  EXPECT_EQ(result.exit_code, 74);
  EXPECT_THAT(result.errors, HasSubstr("cannot be created"));
  EXPECT_THAT(result.errors, testing::Not(HasSubstr("boxes")));
}

}  // namespace
}  // namespace regulus::detail::test
