// SPDX-License-Identifier: GPL-3.0-or-later
// Poses without a solution: their part of a paving, claims without them, and certificates.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/cached_command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Reaches the poses with x ≥ 0; its determinant is at least 2 there, and less than 0 nowhere.
const std::string kReachModel =
    "regulus = 1\nname = \"half\"\n[pose]\nx = \"m\"\ny = \"m\"\n"
    "[geometry]\nd = { value = 0, tolerance = 0, group = \"g\" }\n"
    "[matrix]\nrows = [[\"2 + sqrt(x + d)\", \"y\"], [0, 1]]\n"
    "[motion.all]\nx = [-1, 1]\ny = [0, 1]\n"
    "[motion.within]\nx = [-1, 1]\ny = [0, 1]\nwhere = \"reachable\"\n"
    "constraints = [\"0.1 - sqrt(x + d)\"]\n"
    "[motion.beyond]\nx = [-2, -1]\ny = [0, 1]\n"
    "[motion.none]\nx = [-2, -1]\ny = [0, 1]\nwhere = \"reachable\"\n";

class Reach : public testing::Test {
 protected:
  Reach() { write_file(model_, kReachModel); }

  CommandResult run(std::vector<std::string> words) const {
    words.insert(words.begin(), kCommand);
    words.insert(words.begin() + 2, model_);
    return run_command(words);
  }
  json report(std::vector<std::string> words) const {
    words.emplace_back("--json");
    return json::parse(run(std::move(words)).output);
  }
  void certify() const {
    ASSERT_EQ(run({"check", "within", "--certificate", proof_, "--quiet"}).exit_code, 0);
  }
  void tamper(const std::string& from, const std::string& to) const {
    std::string text = file_contents(proof_);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_file(proof_, text.replace(at, from.size(), to));
  }

  TemporaryDirectory folder_;
  std::string model_ = folder_.path() / "half.toml", proof_ = folder_.path() / "proof.txt";
};

TEST_F(Reach, IsPartOfTheQuestionUnlessTheMotionSaysOtherwise) {
  const json all = report({"check", "all"}), within = report({"check", "within"});
  EXPECT_EQ(all["verdict"], "possible-problem");
  EXPECT_EQ(all["where"], "");
  EXPECT_EQ(within["verdict"], "no-singularity");
  EXPECT_EQ(within["where"], "reachable");
  EXPECT_THAT(std::string(within["claim"]), HasSubstr("every reachable pose of the motion"));
  EXPECT_THAT(run({"check", "within"}).errors,
              HasSubstr("where      reachable: poses out of reach are no part of the claim"));
}

TEST_F(Reach, HoldsForEachValueOfTheUncertainQuantities) {
  const json within = report({"check", "within", "--tolerance", "g=0.004"});
  EXPECT_EQ(within["verdict"], "no-singularity");
  EXPECT_THAT(std::string(within["claim"]), HasSubstr("every reachable pose of the motion"));
}

TEST_F(Reach, LeavesNothingToClaimIfNoPoseIsReached) {
  const json none = report({"check", "none"});
  EXPECT_EQ(none["verdict"], "possible-problem");
  EXPECT_EQ(none["nonempty"], false);
}

TEST_F(Reach, IsAPartOfItsOwnInAPaving) {
  for (const char* motion : {"all", "within"}) {
    const json paving = report({"locate", motion, "--resolution", "1/64"});
    const auto fraction = paving["unreachable"]["fraction"];
    EXPECT_LE(fraction[0], 0.5) << motion;
    EXPECT_GE(fraction[1], 0.48) << motion;
    EXPECT_LT(paving["boxes"], 300) << motion;
  }
  EXPECT_EQ(report({"locate", "all"})["verdict"], "possible-problem");
  EXPECT_EQ(report({"locate", "within", "--resolution", "1e-4"})["verdict"], "no-singularity");
  EXPECT_THAT(run({"locate", "all", "--output", folder_.path() / "boxes"}).errors,
              HasSubstr("boxes, out of reach"));
  EXPECT_THAT(file_contents(folder_.path() / "boxes"), HasSubstr("{\"kind\":\"unreachable\""));
}

/// A paving of poses that are all out of reach claims as little as a check of them.
TEST_F(Reach, MakesNoPavingSafe) {
  for (const char* motion : {"beyond", "none"})
    EXPECT_EQ(report({"locate", motion})["verdict"], "possible-problem") << motion;
  EXPECT_EQ(report({"locate", "beyond"})["unreachable"]["fraction"], json({1.0, 1.0}));
}

TEST_F(Reach, IsInTheCertificate) {
  certify();
  const CommandResult verified = run_command({kVerify, proof_, "--model", model_});
  EXPECT_EQ(verified.exit_code, 0) << verified.output << verified.errors;
  EXPECT_THAT(verified.output + verified.errors,
              HasSubstr("is defined and has full rank at every reachable pose"));
  EXPECT_EQ(regulus({"verify", proof_, "--model", model_, "--quiet"}).output, "VERIFIED\n");
}

TEST_F(Reach, OfACertificateMustBeThatOfARootOfTheMatrix) {
  certify();
  tamper("\nreach ", "\nreach -1/2 + ");
  const CommandResult result = run_command({kVerify, proof_});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output + result.errors, HasSubstr("the model has no square root of"));
}

TEST_F(Reach, CannotBeHiddenInTheClaim) {
  certify();
  tamper("every reachable pose", "every pose");
  EXPECT_THAT(run_command({kVerify, proof_}).output, HasSubstr("REJECTED"));
}

TEST_F(Reach, OfACertificateMustBeInTheFile) {
  certify();
  write_file(model_, file_contents(model_).replace(kReachModel.find("where = \"reachable\"\ncons"),
                                                   19, "                   "));
  const CommandResult result = run_command({kVerify, proof_, "--model", model_});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output + result.errors, HasSubstr("the motion has no 'where'"));
}

TEST_F(Reach, IsListed) {
  EXPECT_THAT(regulus({"list", model_}).output, HasSubstr("where reachable"));
}

}  // namespace
}  // namespace regulus::detail::test
