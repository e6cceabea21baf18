// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what `regulus verify --model` confirms, reports and refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class VerifyModel : public testing::Test {
 protected:
  void certify(const std::string& model, std::vector<std::string> words) const {
    words.insert(words.begin(), {kCommand, "check", model});
    words.insert(words.end(), {"--certificate", certificate_, "--quiet"});
    const CommandResult result = run_command(words);
    ASSERT_LE(result.exit_code, 1) << result.errors;
  }
  [[nodiscard]] CommandResult verify(const std::string& model,
                                     const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {kCommand, "verify", certificate_, "--model", model};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }
  [[nodiscard]] json report(const std::string& model) const {
    return json::parse(verify(model, {"--json", "--quiet", "--allow-options"}).output);
  }
  /// Replaces some text, which must exist.
  void tamper(const std::string& from, const std::string& to) const {
    std::string text = file_contents(certificate_);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_file(certificate_, text.replace(at, from.size(), to));
  }
  void expect_refused(const std::string& model, const std::string& why) const {
    const CommandResult result = verify(model);
    EXPECT_EQ(result.output, "REJECTED\n");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.errors, HasSubstr("the certificate is not about " + model));
    EXPECT_THAT(result.errors, HasSubstr(why));
  }
  [[nodiscard]] bool is_verified_without_the_model() const {
    return regulus({"verify", certificate_}).output == "VERIFIED\n";
  }

  TemporaryDirectory directory_;
  std::string certificate_ = directory_.path() / "certificate";
};

/// Uncertain directions may put the rail oblique to the hinge: off_1 is measured from the carriage,
/// which both readings of [legs] must know.
TEST_F(VerifyModel, ReadsOffOfAnObliqueRailAsCheckDoes) {
  const std::string model = directory_.path() / "prs.toml";
  std::string text =
      "regulus = 1\nname = \"prs\"\n[legs]\ntype = \"PRS\"\norientation = \"roll-pitch-yaw\"\n"
      "axis_tolerance = 0.001\nrod = 2\nmode = \"-\"\n";
  for (const char* points :
       {"base = [2, 0, 0]\nplatform = [1, 0, 0]\nhinge = [0, 1, 0.1]\n",
        "base = [-1, 1.7, 0]\nplatform = [-0.5, 0.85, 0]\nhinge = [-1.7, -1, 0.1]\n",
        "base = [-1, -1.7, 0]\nplatform = [-0.5, -0.85, 0]\nhinge = [1.7, -1, 0.1]\n"})
    text += std::string("[[legs.leg]]\naxis = [0, 0.1, 1]\n") + points;
  text += "[motion.m]\nx = 0\ny = 0\nz = [2, 2.1]\nroll = 0\npitch = 0\nyaw = 0\n";
  // Of the first leg h·d is from 0.136 to 0.147 there, and h·e from 0.2 to 0.21.
  write_file(model, text + "constraints = [\"off_1 - 0.16\", \"0.1 - off_1\"]\n");
  certify(model, {});
  EXPECT_EQ(verify(model).output, "VERIFIED\n");
  EXPECT_EQ(json::parse(regulus({"check", model, "--json", "--quiet"}).output)["nonempty"], true);
  write_file(model, text + "constraints = [\"off_1 - 0.16\", \"0.11 - off_1\"]\n");
  expect_refused(model, "constraints");
}

TEST_F(VerifyModel, ConfirmsWhatTheFileSays) {
  for (const char* motion : {"regular", "crossing", "circle", "reach"}) {
    certify(kPlanar, {motion});
    const CommandResult result = verify(kPlanar);
    EXPECT_EQ(result.output, "VERIFIED\n") << motion << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("question   that of " + kPlanar + '\n'));
    EXPECT_TRUE(report(kPlanar)["differences"].empty());
  }
}

/// The proof is about the whole variety: it is free, or it contains a singular pose.
TEST_F(VerifyModel, ConfirmsTheProofOfAPaving) {
  for (const auto& [motion, claim] :
       {std::pair("regular", "is defined and has full rank at every pose"),
        {"reach", "is defined and has full rank at every pose"},
        {"crossing", "is singular at some pose"}}) {
    const CommandResult paved = regulus({"locate", kPlanar, motion, "--resolution", "1/4",
                                         "--quiet", "--certificate", certificate_});
    EXPECT_LE(paved.exit_code, 1) << paved.errors;
    const json proof = report(kPlanar);
    EXPECT_EQ(proof["outcome"], "verified") << proof;
    EXPECT_THAT(std::string(proof["claim"]), HasSubstr(claim));
  }
}

TEST_F(VerifyModel, ReportsWhatOptionsHaveChanged) {
  certify(kPlanar, {"regular", "--tolerance", "base=0.1", "--range", "x=-1:2", "--alpha", "1/50"});
  const json changed = report(kPlanar);
  EXPECT_EQ(changed["outcome"], "verified") << changed;
  const auto is = [](const std::string& place, const std::string& now) {
    return AllOf(HasSubstr(place), HasSubstr("but the certificate has '" + now + '\''));
  };
  EXPECT_THAT(changed["differences"],
              AllOf(SizeIs(6), Contains(is("motion.regular.alpha is '0'", "1/50")),
                    Contains(is("motion.regular.x[0] is '-2'", "-1")),
                    Contains(is("motion.regular.x[1] is '4'", "2")),
                    Contains(is("geometry.a3.tolerance is '0'", "1/10"))));
  EXPECT_THAT(verify(kPlanar, {"--allow-options"}).errors,
              HasSubstr("differs    motion.regular.alpha is '0'"));
}

/// The singular poses of the file are outside of the range of the proof.
TEST_F(VerifyModel, RefusesWhatOptionsHaveChangedUnlessItMayDiffer) {
  certify(kPlanar, {"crossing", "--range", "phi=-1/4:-1/8"});
  EXPECT_TRUE(is_verified_without_the_model());
  expect_refused(kPlanar,
                 "but the certificate has '-1/4' in line 10; the option allow-options takes");
  EXPECT_EQ(verify(kPlanar, {"--quiet"}).output, "REJECTED\n");
  EXPECT_EQ(verify(kPlanar, {"--quiet", "--allow-options"}).output, "VERIFIED\n");
}

TEST_F(VerifyModel, ConfirmsAParameterThatAnOptionSetFree) {
  certify(kRobot1, {"table4_1", "--range", "x=0", "--range", "psi=-1*deg:2*deg"});
  EXPECT_EQ(report(kRobot1)["outcome"], "verified");
  certify(kPlanar, {"circle", "--range", "phi=-4*deg:-3*deg"});
  EXPECT_THAT(report(kPlanar)["differences"],
              ElementsAre(HasSubstr("the certificate has '-1/45*pi'"),
                          HasSubstr("the certificate has '-1/60*pi'")));
}

/// After each change the certificate is consistent, true, and verified by itself.
TEST_F(VerifyModel, RefusesAnotherRobotUnderTheSameHash) {
  const std::array<const char*, 3> changes[] = {
      {"constant a2_1 = 1591/100", "constant a2_1 = 1590/100", "geometry.a2.value[0] is '15.91'"},
      {"constant side_12 = 426/25", "constant side_12 = 427/25", "geometry.side_12"},
      {"model planar 3-RPR", "model planar 3-PRR", "name is 'planar 3-RPR'"},
      {"entry 0", "entry 1/1000000", "matrix.rows"},
      {"\nproof\n", "\nconstraint x - 3\nproof\n", "states 'constraint'"},
  };
  for (const auto& [from, to, place] : changes) {
    certify(kPlanar, {"regular"});
    tamper(from, to);
    EXPECT_TRUE(is_verified_without_the_model()) << to;
    expect_refused(kPlanar, place);
  }
}

TEST_F(VerifyModel, RefusesAMotionWithLessControlErrorOrFewerConstraints) {
  certify(kPlanar, {"circle"});
  tamper("+- 1/100", "+- 1/1000");
  EXPECT_TRUE(is_verified_without_the_model());
  expect_refused(kPlanar, "motion.circle.error.x is ");

  certify(kPlanar, {"reach"});
  std::string text = file_contents(certificate_);
  const std::size_t at = text.find("\nconstraint ");
  text.erase(at, text.find('\n', at + 1) - at);
  write_file(certificate_, text);
  expect_refused(kPlanar, "motion.reach.constraints[0] is");
}

/// An option sets a whole group.
TEST_F(VerifyModel, RefusesAToleranceThatOneOfAGroupDoesNotHave) {
  const char* const of_one = "uncertain a3_2 = 10 +- 1/10";
  for (const auto& [to, quantities] :
       {std::pair("constant a3_2 = 10", "5"), {"uncertain a3_2 = 10 +- 1/20", "6"}}) {
    certify(kPlanar, {"regular", "--tolerance", "base=0.1"});
    EXPECT_EQ(verify(kPlanar, {"--quiet", "--allow-options"}).output, "VERIFIED\n");
    tamper(of_one, to);
    tamper("value of the 6 uncertain", std::string("value of the ") + quantities + " uncertain");
    EXPECT_TRUE(is_verified_without_the_model());
    EXPECT_THAT(std::string(report(kPlanar)["reason"]),
                HasSubstr("and another value for others of the same group"));
  }
}

/// The form that `margin` writes at the lower end of a tolerance.
TEST_F(VerifyModel, TakesAQuantityOfNoSpreadForAConstant) {
  certify(kPlanar, {"regular"});
  tamper("constant a1_1 = 0", "uncertain a1_1 = 0 +- 0");
  tamper("at every pose of", "at every pose and value of the 1 uncertain quantities of");
  const json proof = report(kPlanar);
  EXPECT_EQ(proof["outcome"], "verified") << proof;
  EXPECT_TRUE(proof["differences"].empty());
}

TEST_F(VerifyModel, RefusesAMotionThatTheModelDoesNotHave) {
  certify(kPlanar, {"regular"});
  tamper("motion regular", "motion regulax");
  expect_refused(kPlanar, "the file has no motion 'regulax'");
}

TEST_F(VerifyModel, RefusesAnotherFile) {
  certify(kPlanar, {"regular"});
  expect_refused(kRobot1, "SHA-256");
  // The same values, and another comment.
  const std::string copy = directory_.path() / "copy.toml";
  write_file(copy, file_contents(kPlanar) + "# later\n");
  expect_refused(copy, "SHA-256");
}

TEST_F(VerifyModel, SaysWhatIsWrongWithFiles) {
  certify(kPlanar, {"regular"});
  EXPECT_EQ(verify(directory_.path() / "missing.toml").exit_code, 74);
  write_file(directory_.path() / "bad.toml", "regulus = 2");
  EXPECT_EQ(verify(directory_.path() / "bad.toml").exit_code, 65);
  write_file(certificate_, "nothing of the kind\n");
  EXPECT_EQ(verify(kPlanar).output, "REJECTED\n");
  write_file(certificate_, "");
  EXPECT_EQ(verify(kPlanar).output, "REJECTED\n");
}

TEST_F(VerifyModel, PrintsNoControlCharactersOfAForeignFile) {
  certify(kPlanar, {"regular"});
  tamper("model planar", "model \x1b[2Jplanar");
  const CommandResult result = verify(kPlanar);
  EXPECT_EQ(result.output, "REJECTED\n");
  EXPECT_EQ(result.errors.find('\x1b'), std::string::npos);
  certify(kPlanar, {"regular"});
  tamper("model planar", "model \xff planar");
  EXPECT_EQ(report(kPlanar)["outcome"], "rejected");
}

TEST_F(VerifyModel, ReadsACertificateFromAPipe) {
  certify(kPlanar, {"regular"});
  const CommandResult piped = run_command(
      {"/bin/sh", "-c",
       "cat " + certificate_ + " | " + kCommand + " verify /dev/stdin --model " + kPlanar});
  EXPECT_EQ(piped.output, "VERIFIED\n") << piped.errors;
}

}  // namespace
}  // namespace regulus::detail::test
