// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `regulus bound` and `regulus datasheet` as users see them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// J⁻¹ = [1 x; 0 1] with 0 ≤ x ≤ 2.
constexpr const char* kShear = R"toml(regulus = 1
name = "shear"
[pose]
x = "cm"
y = "cm"
[matrix]
rows = [["x + 3", "x*(x + 3)"], [0, 2]]
row_scale = ["1/(x + 3)", "1/2"]
[load.any]
force = [[-1, 1], [-1, 1]]
[load.other]
wrench = [1, 0]
[twist.along]
velocity = [1, 1]
[actuators]
force = [-2, 2]
speed = 4
error = 0.1
stiffness = 2
[motion.m]
x = [0, 2]
y = 0
)toml";

class BoundCommandTest : public testing::Test {
 protected:
  BoundCommandTest() { std::ofstream(model_) << kShear; }

  TemporaryDirectory folder_;
  std::string model_ = folder_.path() / "shear.toml";
};

TEST_F(BoundCommandTest, PrintsTheBracketTheLegAndThePose) {
  const CommandResult r = regulus({"bound", model_, "force", "--load", "any"});
  EXPECT_EQ(r.exit_code, 0) << r.errors;
  EXPECT_THAT(r.output,
              testing::MatchesRegex("BETWEEN 2\\.9[0-9]* AND 3(\\.0[0-9]*)? N \\(leg 2\\)\n"));
  EXPECT_THAT(r.errors, HasSubstr("attained   leg 2: x = 2"));
  EXPECT_THAT(r.errors, HasSubstr("every value of any"));
}

TEST_F(BoundCommandTest, TakesTheMotionOrTheOnlyOne) {
  EXPECT_EQ(regulus({"bound", model_, "m", "speed", "--quiet"}).output,
            regulus({"bound", model_, "speed", "--quiet"}).output);
}

/// det J⁻¹ = −2x for x from 1 to 3 has one sign, and the largest magnitude where it is least.
TEST_F(BoundCommandTest, KnowsTheLargestDeterminantAndItsSignedEnds) {
  std::ofstream(model_)
      << "regulus = 1\nname = \"m\"\n[pose]\nx = \"1\"\n[matrix]\nrows = [[\"0\", \"x\"], "
         "[\"1\", \"0\"]]\nrow_scale = [\"2\", \"1\"]\n[motion.m]\nx = [1, 3]\n";
  const auto expect_about = [&](double value, std::vector<std::string> quantity) {
    std::vector<std::string> words{"bound", model_, "--gap", "1e-4", "--quiet"};
    words.insert(words.begin() + 2, quantity.begin(), quantity.end());
    const CommandResult r = regulus(words);
    double lo = 0, hi = 0;
    ASSERT_EQ(std::sscanf(r.output.c_str(), "BETWEEN %lf AND %lf", &lo, &hi), 2) << r.output;
    EXPECT_LE(lo, value) << r.output;
    EXPECT_GE(hi, value) << r.output;
    EXPECT_NEAR(lo, hi, 1e-3);
  };
  expect_about(2, {"determinant"});
  expect_about(6, {"determinant-max"});
  expect_about(-6, {"determinant", "--min"});
  expect_about(-2, {"determinant", "--signed"});
  expect_about(-6, {"determinant-max", "--min"});
}

/// κ₂ = (1 + √2)² at x = 2.
TEST_F(BoundCommandTest, KnowsTheConditionNumberInTheTwoNorm) {
  const std::vector<std::string> question = {"bound", model_, "condition", "--norm", "2"};
  const auto with = [&](std::initializer_list<std::string> more) {
    std::vector<std::string> words = question;
    words.insert(words.end(), more);
    return regulus(words);
  };
  const CommandResult r = with({"--gap", "1e-6", "--json"});
  ASSERT_EQ(r.exit_code, 0) << r.errors;
  const json report = json::parse(r.output);
  const double value = std::pow(1 + std::sqrt(2.0), 2);
  EXPECT_LE(report["attained"], value);
  EXPECT_GE(report["proved"], value);
  EXPECT_NEAR(report["attained"], value, 1e-4);
  EXPECT_NEAR(report["proved"], value, 1e-4);
  EXPECT_EQ(report["quantity"]["kind"], "condition");
  EXPECT_EQ(report["quantity"]["norm"], "2");
  EXPECT_EQ(with({"--limit", "5.9"}).output, "WITHIN\n");
  EXPECT_EQ(with({"--limit", "5.8"}).exit_code, 1);
  EXPECT_EQ(regulus({"bound", model_, "condition", "--norm", "3"}).exit_code, 64);
  EXPECT_EQ(regulus({"bound", model_, "speed", "--norm", "2"}).exit_code, 64);
  const CommandResult margin = regulus({"margin", model_, "--scale", "0:1", "--quantity",
                                        "condition", "--norm", "2", "--limit", "9"});
  EXPECT_EQ(margin.exit_code, 64);
  EXPECT_THAT(margin.errors, HasSubstr("regulus bound --limit"));
}

TEST_F(BoundCommandTest, ComparesWithALimit) {
  const CommandResult within = regulus({"bound", model_, "speed", "--limit", "3.1"});
  EXPECT_EQ(within.output, "WITHIN\n");
  EXPECT_EQ(within.exit_code, 0);
  const CommandResult exceeded = regulus({"bound", model_, "speed", "--limit", "2.9"});
  EXPECT_EQ(exceeded.output, "EXCEEDED (leg 1)\n");
  EXPECT_EQ(exceeded.exit_code, 1);
  EXPECT_THAT(exceeded.errors, HasSubstr("exceeded   leg 1: x = "));
}

TEST_F(BoundCommandTest, GivesNumbersThatClaimNoMore) {
  const CommandResult r = regulus({"bound", model_, "speed", "--json", "--quiet"});
  const json report = json::parse(r.output);
  EXPECT_LE(report.at("attained").get<double>(), 3);
  EXPECT_GE(report.at("proved").get<double>(), 3);
  EXPECT_EQ(report.at("attained_by"), "leg 1");
  EXPECT_EQ(report.at("components").size(), 2u);
  EXPECT_TRUE(report.at("components")[0].at("place").contains("pose"));
}

TEST_F(BoundCommandTest, NamesTheTwistThatIsFastest) {
  std::string text = kShear;
  const std::string box = "velocity = [1, 1]";
  text.replace(text.find(box), box.size(), "velocity = { value = [0, 0], radius = 1 }");
  std::ofstream(model_, std::ios::trunc) << text;
  const json report = json::parse(
      regulus({"bound", model_, "speed", "--gap", "1e-6", "--leg", "1", "--json", "--quiet"})
          .output);
  EXPECT_LE(report.at("gap"), 1e-6);
  EXPECT_LE(report.at("attained").get<double>(), std::sqrt(5));
  EXPECT_GE(report.at("proved").get<double>(), std::sqrt(5));
  const json twist = report.at("components")[0].at("place").at("twist");
  EXPECT_NEAR(twist[0], 1 / std::sqrt(5), 1e-3);
  EXPECT_NEAR(twist[1], 2 / std::sqrt(5), 1e-3);
}

TEST_F(BoundCommandTest, WritesAProofOfEachEnd) {
  const std::string file = folder_.path() / "proof";
  ASSERT_EQ(regulus({"bound", model_, "speed", "--certificate", file}).exit_code, 0);
  for (const char* ending : {".leg_1.safe", ".leg_1.singular", ".leg_2.safe", ".leg_2.singular"})
    EXPECT_EQ(regulus({"verify", file + ending}).output, "VERIFIED\n") << ending;
}

/// The compiler's kernel takes over in the middle of the search, and a witness is found after it.
TEST_F(BoundCommandTest, SurvivesAKernelThatIsCompiledMeanwhile) {
  setenv("XDG_CACHE_HOME", (folder_.path() / "empty").c_str(), 1);
  const CommandResult r = regulus(
      {"bound", model_, "determinant", "--gap", "1e-9", "--time-limit", "4", "--threads", "1"});
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(r.exit_code, 2) << r.errors;
  EXPECT_THAT(r.output, HasSubstr("BETWEEN 0.99"));
}

struct Mistake {
  std::vector<std::string> words;
  std::string message;
};

TEST_F(BoundCommandTest, RefusesWhatItCannotBound) {
  const std::vector<Mistake> mistakes{
      {{"forces"}, "there is no 'forces'; did you mean 'force'?"},
      {{"force"}, "--load: the model has any, other; choose one"},
      {{"force", "--load", "ani"}, "did you mean 'any'"},
      {{"force", "--load", "any", "--leg", "3"}, "--leg: found '3', expected a number from 1 to 2"},
      {{"speed", "--freedom", "x"}, "--freedom: has no meaning for speed"},
      {{"determinant-max", "--leg", "1"}, "--leg: has no meaning for determinant-max"},
      // An expression has no legs, and no load.
      {{"x^2", "--leg", "1"}, "--leg: has no meaning for x^2"},
      {{"x^2", "--load", "any"}, "--load: has no meaning for x^2"},
      {{"x^2", "--norm", "2"}, "--norm: has no meaning for x^2"},
      {{"error", "--freedom", "z"}, "--freedom: there is no 'z'"},
      {{"speed", "--limit", "-1"}, "expected a positive number"},
      {{"speed", "--alpha", "1"}, "--alpha: a bound has no threshold"},
      {{"x +"}, "'x +'"},
  };
  for (const Mistake& mistake : mistakes) {
    std::vector<std::string> words{"bound", model_};
    words.insert(words.end(), mistake.words.begin(), mistake.words.end());
    const CommandResult r = regulus(words);
    EXPECT_EQ(r.exit_code, 64) << mistake.words[0] << r.errors;
    EXPECT_THAT(r.errors, HasSubstr(mistake.message));
  }
}

TEST_F(BoundCommandTest, RefusesTablesThatItCannotRead) {
  const auto refusal = [&](const std::string& table) {
    const std::string path = folder_.path() / "bad.toml";
    std::ofstream(path) << "regulus = 1\nname = \"bad\"\n[pose]\nx = \"cm\"\n[matrix]\n"
                           "rows = [[\"x\"]]\n"
                        << table << "\n[motion.m]\nx = [1, 2]\n";
    const CommandResult r = regulus({"bound", path, "speed"});
    EXPECT_EQ(r.exit_code, 65) << table << r.errors;
    return r.errors;
  };
  EXPECT_THAT(refusal("[load.a]\nwrench = [1, 2]"), HasSubstr("bad.toml:8"));
  EXPECT_THAT(refusal("[load.a]\nforces = [1]"), HasSubstr("forces"));
  EXPECT_THAT(refusal("[load.a]\nwrench = [[2, 1]]"), HasSubstr("bad.toml:8"));
  EXPECT_THAT(refusal("[load.a]\nwrench = { value = [1], radius = -1 }"), HasSubstr("bad.toml:8"));
  EXPECT_THAT(refusal("[actuators]\nspeed = 0"), HasSubstr("positive"));
  EXPECT_THAT(refusal("[actuators]\nerror = [1, 2]"), HasSubstr("2 values"));
  EXPECT_THAT(refusal("[actuators]\nunit = [\"m\", \"rad\"]"), HasSubstr("2 values"));
}

TEST_F(BoundCommandTest, HasTheUnitOfEachMotorAndTheSpeedZeroWhereNoTwistMovesIt) {
  const std::string path = folder_.path() / "units.toml";
  std::ofstream(path)
      << "regulus = 1\nname = \"slider and crank\"\n[pose]\nx = \"m\"\ny = \"m\"\n"
         "[matrix]\nrows = [[2, 0], [0, \"1 + x^2\"]]\n[twist.along]\nvelocity = [1, 0]\n"
         "[actuators]\nunit = [\"m\", \"rad\"]\n[motion.m]\nx = [0, 1]\ny = 0\n";
  const json bound = json::parse(regulus({"bound", path, "speed", "--json", "--quiet"}).output);
  const json& legs = bound.at("components");
  EXPECT_EQ(legs[0].at("unit"), "m/s");
  EXPECT_EQ(legs[1].at("unit"), "rad/s");
  EXPECT_EQ(legs[1].at("proved"), legs[1].at("attained"));
  EXPECT_EQ(legs[1].at("closed"), true);
}

TEST_F(BoundCommandTest, ClaimsNoSpeedWhereTheScaleOfARowIsUndefined) {
  const std::string path = folder_.path() / "undefined.toml";
  std::ofstream(path) << "regulus = 1\nname = \"dead point\"\n[pose]\nx = \"m\"\ny = \"m\"\n"
                         "[matrix]\nrows = [[2, 0], [0, 1]]\nrow_scale = [1, \"1/x\"]\n"
                         "[twist.along]\nvelocity = [1, 0]\n[motion.m]\nx = [-1, 1]\ny = 0\n";
  const CommandResult r = regulus({"bound", path, "speed", "--leg", "2", "--time-limit", "1"});
  EXPECT_EQ(r.exit_code, 2) << r.output;
}

/// The time is not the reason.
TEST_F(BoundCommandTest, SaysWhyNothingIsKnownWhereTheMatrixIsUndefined) {
  const auto ask = [&](const char* entry, const char* range) {
    std::ofstream(model_) << fmt::format(
        "regulus = 1\nname = \"m\"\n[pose]\nx = \"1\"\n[matrix]\nrows = "
        "[[\"{}\"]]\n[motion.m]\nx = {}\n",
        entry, range);
    return regulus({"bound", model_, "sigma-max"});
  };
  const CommandResult part = ask("sqrt(x)", "[-1, 3]");
  EXPECT_EQ(part.exit_code, 2) << part.output;
  EXPECT_THAT(part.errors, HasSubstr("an expression is undefined in or near a pose"));
  for (const char* entry : {"sqrt(x)", "sqrt(x)*sqrt(x - 1)", "abs(sqrt(x))", "log(x + 1)"}) {
    const CommandResult nowhere = ask(entry, "-1");
    EXPECT_EQ(nowhere.exit_code, 65) << nowhere.output;
    EXPECT_THAT(nowhere.errors, HasSubstr("is undefined at every pose of the motion")) << entry;
  }
}

TEST_F(BoundCommandTest, MakesADatasheetThatComparesLimits) {
  const CommandResult r = regulus({"datasheet", model_});
  EXPECT_EQ(r.exit_code, 1) << r.errors;  // a force exceeds its limit
  EXPECT_THAT(r.output, HasSubstr("EXCEEDED"));
  EXPECT_THAT(r.output, HasSubstr("kept"));
  const CommandResult markdown = regulus({"datasheet", model_, "--markdown", "--quiet"});
  EXPECT_THAT(markdown.output, HasSubstr("| quantity"));
  EXPECT_THAT(markdown.output, HasSubstr("Attained at:"));
  EXPECT_THAT(markdown.output, HasSubstr("```text\nmodel "));
  EXPECT_THAT(markdown.output, HasSubstr("\nuncertain "));
  EXPECT_THAT(markdown.output, HasSubstr("| least \\|det J⁻¹\\| "));
  const json report = json::parse(regulus({"datasheet", model_, "--json", "--quiet"}).output);
  EXPECT_GE(report.at("bounds").size(), 8u);
}

TEST_F(BoundCommandTest, MakesADatasheetOfOnePose) {
  const std::string path = folder_.path() / "fixed.toml";
  std::ofstream(path)
      << "regulus = 1\nname = \"arm\"\n[pose]\nx = \"m\"\ny = \"m\"\n[matrix]\n"
         "rows = [[\"x + 2\", \"y\"], [\"x*y\", 1]]\n[motion.m]\nx = 0.25\ny = 0.5\n";
  const CommandResult r = regulus({"datasheet", path});
  EXPECT_EQ(r.exit_code, 0) << r.errors;
  EXPECT_THAT(r.output, HasSubstr("condition number of J⁻¹ in the 2-norm"));
}

TEST_F(BoundCommandTest, ADatasheetHasProofsAndContinues) {
  const std::string proof = folder_.path() / "proof", saved = folder_.path() / "saved";
  const auto ask = [&](const std::string& certificate) {
    return regulus({"datasheet", model_, "--threads", "1", "--json", "--checkpoint", saved,
                    "--certificate", certificate});
  };
  const CommandResult first = ask(proof);
  const json sheet = json::parse(first.output);
  int proved = 0;
  for (const json& bound : sheet.at("bounds"))
    for (const json& component : bound.at("components"))
      for (const char* end : {"safe", "singular"}) {
        const json& file = component.at("certificates").at(end);
        if (file.is_null()) continue;
        ++proved;
        EXPECT_EQ(run_command({REGULUS_BINARY_DIR "/bin/regulus-verify", file}).exit_code, 0)
            << file;
      }
  EXPECT_GT(proved, 20);
  EXPECT_THAT(first.errors, HasSubstr("proof.force_any.leg_1.safe: safe at "));
  const json again = json::parse(ask(folder_.path() / "again").output);
  ASSERT_EQ(again.at("bounds").size(), sheet.at("bounds").size());
  for (std::size_t i = 0; i < sheet["bounds"].size(); ++i)
    EXPECT_EQ(again["bounds"][i]["result"], sheet["bounds"][i]["result"]);
  const CommandResult other =
      regulus({"datasheet", model_, "--checkpoint", saved, "--tolerance", "no=0.1"});
  EXPECT_NE(other.exit_code, 0);
}

class BoundCheckpointTest : public BoundCommandTest {
 protected:
  CommandResult ask(std::vector<std::string> more) {
    std::vector<std::string> words{"bound", model_,         "force", "--load",
                                   "any",   "--gap",        "1e-4",  "--threads",
                                   "1",     "--checkpoint", file_,   "--certificate",
                                   proof_,  "--time-limit", "600"};
    words.insert(words.end(), more.begin(), more.end());
    return regulus(words);
  }
  [[nodiscard]] nlohmann::ordered_json saved() const {
    return nlohmann::ordered_json::parse(std::ifstream(file_));
  }
  [[nodiscard]] std::string proofs() const {
    std::ostringstream all;
    for (const char* end : {".leg_1.safe", ".leg_1.singular", ".leg_2.safe", ".leg_2.singular"})
      all << std::ifstream(proof_ + end).rdbuf() << end;
    return all.str();
  }

  const std::string file_ = folder_.path() / "saved", proof_ = folder_.path() / "proof";
};

// As if the run had been killed after each of its searches.
TEST_F(BoundCheckpointTest, LeadsToTheSameReportAndProofs) {
  const json whole = json::parse(ask({"--json"}).output);
  const std::string proofs_of_whole = proofs();
  const auto file = saved();
  const auto& all = file.at("known").at("brackets");
  std::size_t searches = 0;
  for (auto bracket = all.begin(); bracket != all.end(); ++bracket)
    for (std::size_t kept = 0; kept <= bracket->size(); kept += 3, ++searches) {
      auto part = file;
      auto& brackets = part.at("known").at("brackets");
      for (auto later = std::next(bracket); later != all.end(); ++later)
        brackets.erase(later.key());
      auto& some = brackets[bracket.key()] = json::object();
      std::size_t count = 0;
      for (auto entry = bracket->begin(); count < kept && entry != bracket->end(); ++entry, ++count)
        some[entry.key()] = *entry;
      std::ofstream(file_) << part.dump();
      const json report = json::parse(ask({"--json"}).output);
      for (const char* key : {"result", "boxes"}) EXPECT_EQ(report.at(key), whole.at(key)) << key;
      EXPECT_EQ(report.at("components").size(), 2U);
      EXPECT_TRUE(proofs() == proofs_of_whole) << bracket.key() << ", " << kept << " searches";
    }
  EXPECT_GT(searches, 4U);
}

TEST_F(BoundCheckpointTest, OfAnotherQuestionOrDamagedIsRefused) {
  ASSERT_EQ(ask({}).exit_code, 0);
  EXPECT_EQ(ask({"--leg", "1"}).exit_code, 65);
  EXPECT_EQ(ask({"--limit", "9"}).exit_code, 64);
  std::ofstream(file_) << "{";
  const CommandResult damaged = ask({});
  EXPECT_EQ(damaged.exit_code, 65);
  EXPECT_THAT(damaged.errors, HasSubstr("not a checkpoint of such a question, or it is damaged"));
}

}  // namespace
}  // namespace regulus::detail::test
