// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the hint after an unproved check, on models whose singular poses are known.
#include "codegen/question/analysis/least_singular.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// A matrix of two columns and three legs; the legs are parallel at x = 1/3, y = -2/3 only.
constexpr const char* kRedundantArm = R"toml(regulus = 1
name = "redundant"
[pose]
x = "m"
y = "m"
[geometry]
a = { value = 1, tolerance = 0, group = "a" }
[matrix]
rows = [["1", "x - 1/3"], ["y + 2/3", "sin(x - 1/3)"], ["a", "3*y + 2"]]
[motion.all]
x = [-1, 1]
y = [-1, 1]
[motion.beside]
x = [-1, 0]
y = [-1, 1]
constraints = ["-1.3 - x"]
[motion.path]
parameters = { T = [0, 1] }
x = "T"
y = "-T*2"
)toml";

class Redundant : public testing::Test {
 protected:
  Redundant() { std::ofstream(path_) << kRedundantArm; }

  [[nodiscard]] PreparedSearch prepared(const std::string& motion) const {
    ModelOptions model;
    model.path = path_;
    model.motion = motion;
    SearchOptions search;
    search.engine = Engine::kInterpreted;
    return prepare(model, search);
  }
  [[nodiscard]] CommandResult check(std::vector<std::string> words) const {
    words.insert(words.end(), {"--engine", "interpreted", "--max-boxes", "20000"});
    return regulus({"check", path_}, words);
  }

  TemporaryDirectory folder_;
  std::string path_ = folder_.path() / "redundant.toml";
};

TEST_F(Redundant, IsFoundNearlySingularWhereItIsSingular) {
  const auto nearest = approx_least_singular(prepared("all"), {});
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(mid(nearest->variables[0]), 1.0 / 3, 1e-8);
  EXPECT_NEAR(mid(nearest->variables[1]), -2.0 / 3, 1e-8);
  EXPECT_THAT(nearest->degeneracy.twists, testing::SizeIs(1));
  EXPECT_TRUE(nearest->degeneracy.rows.empty());
  EXPECT_EQ(nearest->degeneracy.twists[0], (std::vector<double>{0, 1}));
}

TEST_F(Redundant, IsLeftRegularWhereItIs) {
  const auto nearest = approx_least_singular(prepared("beside"), {});
  ASSERT_TRUE(nearest);
  EXPECT_TRUE(nearest->degeneracy.twists.empty());
  EXPECT_LE(nearest->variables[0].hi, 0);
  EXPECT_GE(nearest->variables[0].lo, -1);
}

TEST_F(Redundant, IsProvedSingularWithThePoseAndTheTwist) {
  const CommandResult result = check({"all", "--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.errors, AllOf(HasSubstr("its rank is less than 2 for some x, y within 3e-11"),
                                   HasSubstr("what is lost there is enclosed, too"),
                                   HasSubstr("twist      lost, approximately: (0, 1), an entry")));
  const json witness = json::parse(result.output)["witness"], point = witness["points"][0];
  EXPECT_EQ(witness["nullity"], 1);
  EXPECT_EQ(point["enclosed"], (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(point["null_vector"][1], (std::vector<double>{1, 1}));
  EXPECT_NEAR(point["null_vector"][0][0].get<double>(), 0, 1e-10);
  EXPECT_NEAR(point["parameters"]["x"][0].get<double>(), 1.0 / 3, 1e-10);
  EXPECT_NEAR(point["pose"]["y"][1].get<double>(), -2.0 / 3, 1e-10);
}

/// The rank is lost where a sum of two squares is 0: each small change of it leaves two poses or none.
TEST(TouchedSingularity, IsReportedWithThePoseAndTheTwist) {
  const TemporaryDirectory directory;
  const std::string path = directory.path() / "touched.toml";
  std::ofstream(path) << R"toml(regulus = 1
name = "touched"
[pose]
x = "m"
y = "m"
[matrix]
rows = [["1", "(x - 1/3)^2 + (y + 2/3)^2"], ["y + 2/3", "0"], ["1", "0"]]
[motion.all]
x = [-1, 1]
y = [-1, 1]
)toml";
  const CommandResult result =
      regulus({"check", path, "--json", "--engine", "interpreted", "--max-boxes", "20000"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors,
              AllOf(HasSubstr("nearest    x = 0.333"), HasSubstr("this proves nothing\n"),
                    HasSubstr("touched there, and not crossed, stays open"),
                    HasSubstr("twist      lost, approximately: (0, 1), an entry")));
  const json nearest = json::parse(result.output)["nearest_singular"];
  EXPECT_EQ(nearest["approximate"], true);
  EXPECT_EQ(nearest["nullity"], 1);
  EXPECT_TRUE(nearest["rows"].is_null());
  EXPECT_NEAR(nearest["pose"]["x"][0].get<double>(), 1.0 / 3, 1e-3);
  EXPECT_NEAR(nearest["parameters"]["y"][0].get<double>(), -2.0 / 3, 1e-3);
}

TEST_F(Redundant, HasNoSuchLinesWhereItIsCertified) {
  const CommandResult result = check({"beside", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_FALSE(json::parse(result.output).contains("nearest_singular"));
}

TEST_F(Redundant, OnAPathIsGivenInPoseParametersToo) {
  const auto nearest = approx_least_singular(prepared("path"), {});
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(mid(nearest->variables[0]), 1.0 / 3, 1e-8);
  ASSERT_EQ(nearest->pose.size(), 2U);
  EXPECT_NEAR(mid(nearest->pose[1]), -2.0 / 3, 1e-8);
}

/// |det| = x, and the rows have lengths of about 1.
TEST(AlmostSingular, IsNamedAfterNoSingularity) {
  const TemporaryDirectory directory;
  const std::string path = directory.path() / "near.toml";
  std::ofstream(path) << R"toml(regulus = 1
name = "near"
[pose]
x = "1"
[matrix]
rows = [["1", "x"], ["1", "0"]]
[motion.near]
x = [1e-8, 1]
[motion.far]
x = [0.1, 1]
)toml";
  const auto check = [&](const char* motion) { return regulus({"check", path, motion}); };
  const CommandResult near = check("near");
  EXPECT_EQ(near.output, "NO SINGULARITY\n");
  EXPECT_THAT(near.errors, AllOf(HasSubstr("nearest    x = "), HasSubstr("almost singular there")));
  const json report = json::parse(regulus({"check", path, "near", "--json", "--quiet"}).output);
  EXPECT_LT(report["nearest_singular"]["hadamard_share"], 1e-6);
  EXPECT_THAT(check("far").errors, testing::Not(HasSubstr("nearest")));
}

}  // namespace
}  // namespace regulus::detail::test
