// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus report` from the outside; tests/page looks at its pages in a browser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The data of a page.
nlohmann::json data_of(const fs::path& file) {
  const std::string page = text_of(file), begin = "data-sha256=\"";
  const std::size_t at = page.find('>', page.find(begin)) + 1;
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

/// Runs on the program of the build, if that has a page.
class AReport : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(REGULUS_BINARY_DIR "/share/regulus/page.html"))
      GTEST_SKIP() << "this build has no page: npm is missing";
  }

  CommandResult report(std::vector<std::string> words) {
    words.insert(words.end(), {"-o", page_});
    return regulus({"report"}, words);
  }

  TemporaryDirectory folder_;
  const std::string page_ = folder_.path() / "page.html";
};

TEST_F(AReport, HasTheVerdictTheProofAndTheModel) {
  const CommandResult made = report({kModels + "robot_1.toml", "wide_15", "--range", "x=-1:1"});
  EXPECT_EQ(made.exit_code, 0);
  EXPECT_EQ(made.output, "NO SINGULARITY\n");
  EXPECT_THAT(made.errors, HasSubstr("page       " + page_));
  const nlohmann::json data = data_of(page_);
  EXPECT_EQ(data["model"]["text"], text_of(kModels + "robot_1.toml"));
  EXPECT_THAT(data["certificate"].get<std::string>(),
              HasSubstr(data["question"].get<std::string>()));
  EXPECT_THAT(data["question"].get<std::string>(), HasSubstr("parameter x in -1 : 1\n"));
  EXPECT_THAT(data["again"][0].get<std::string>(), HasSubstr("wide_15 --range x=-1:1"));
  EXPECT_EQ(data["drawing"]["parts"].size(), 8U);
}

TEST_F(AReport, SaysThatItIsNotCheckedUntilItsProgramHasProvedIt) {
  EXPECT_EQ(report({kModels + "orthoglide.toml", "cube", "--quiet"}).exit_code, 0);
  const std::string page = text_of(page_);
  EXPECT_THAT(page, HasSubstr("<h1 id=\"verdict\" class=\"unchecked\">NO SINGULARITY</h1>"));
  EXPECT_THAT(page,
              HasSubstr(">Not checked yet: the proof in this page has not been run here.</p>"));
}

TEST_F(AReport, HasWhatElseIsAsked) {
  const CommandResult made = report({kModels + "planar_3rpr.toml", "crossing", "--paving",
                                     "--resolution", "1/8", "--bound", "determinant", "--gap",
                                     "0.5", "--margin", "base=0:0.1", "--time-limit", "5"});
  EXPECT_EQ(made.exit_code, 1) << made.errors;
  const nlohmann::json data = data_of(page_);
  EXPECT_EQ(data["bounds"].size(), 1U);
  EXPECT_EQ(data["margins"].size(), 1U);
  EXPECT_TRUE(data["margins"][0].contains("bracket"));
  std::istringstream tree(data["paving"]["tree"].get<std::string>());
  std::size_t leaves = 0, said = 0;
  for (std::string line; std::getline(tree, line);) {
    leaves += line.starts_with("l ") ? 1 : 0;
    if (line.starts_with("end ")) said = std::stoul(line.substr(4));
  }
  EXPECT_GT(leaves, 10U);
  EXPECT_EQ(leaves, said);
}

TEST_F(AReport, IsTheSameEachTimeButForTheTimes) {
  const auto without_times = [&] {
    EXPECT_EQ(report({kModels + "orthoglide.toml", "cube", "--quiet"}).exit_code, 0);
    nlohmann::json data = data_of(page_);
    for (const char* key : {"seconds", "cache", "engine_boxes"}) data["report"].erase(key);
    return data;
  };
  const nlohmann::json first = without_times();
  EXPECT_EQ(first, without_times());
}

TEST_F(AReport, PrintsTheReportOfCheckAsJson) {
  const CommandResult made = report({kModels + "orthoglide.toml", "cube", "--json"});
  const nlohmann::json printed = nlohmann::json::parse(made.output);
  EXPECT_EQ(printed["verdict"], "no-singularity");
  EXPECT_EQ(printed["page"], page_);
}

TEST_F(AReport, KeepsThePageOfAnEarlierRunAside) {
  std::ofstream(page_) << "earlier";
  EXPECT_EQ(report({kModels + "orthoglide.toml", "no-such-motion"}).exit_code, 64);
  EXPECT_FALSE(fs::exists(page_));
  EXPECT_EQ(text_of(page_ + ".old"), "earlier");
}

TEST_F(AReport, RefusesWhatItCannotShow) {
  const CommandResult gap = report({kModels + "orthoglide.toml", "cube", "--gap", "2"});
  EXPECT_EQ(gap.exit_code, 64);
  const CommandResult quantity = report({kModels + "orthoglide.toml", "cube", "--bound", "beauty"});
  EXPECT_EQ(quantity.exit_code, 64);
  EXPECT_FALSE(fs::exists(page_));
  const CommandResult no_file = regulus({"report", kModels + "orthoglide.toml", "cube"});
  EXPECT_EQ(no_file.exit_code, 64);
  EXPECT_THAT(no_file.errors, HasSubstr("--output"));
}

/// Reports and proofs of earlier runs about a part of a motion of robot 1.
class AReportOfEarlierRuns : public AReport {
 protected:
  void SetUp() override {
    AReport::SetUp();
    if (IsSkipped()) return;
    const CommandResult checked =
        regulus({"check", kRobot, "wide_15", "--range", "x=-1:1", "--tolerance", "base=0.01",
                 "--certificate", proof_, "--json", "--quiet"});
    std::ofstream(check_) << checked.output;
  }

  void expect_refused(std::vector<std::string> words, const std::string& message) {
    const CommandResult refused = report(std::move(words));
    EXPECT_EQ(refused.exit_code, 65) << message;
    EXPECT_THAT(refused.errors, HasSubstr(message));
    EXPECT_FALSE(fs::exists(page_));
  }
  void write(const std::string& file, const std::string& text) { std::ofstream(file) << text; }

  const std::string kRobot = kModels + "robot_1.toml";
  const std::string proof_ = folder_.path() / "proof.txt", check_ = folder_.path() / "check.json",
                    other_ = folder_.path() / "other";
};

TEST_F(AReportOfEarlierRuns, TakesTheQuestionOfTheFiles) {
  for (const auto& files : {std::vector{proof_}, {check_}, {check_, proof_}, {proof_, check_}}) {
    std::vector<std::string> words{kRobot};
    for (const std::string& file : files) words.insert(words.end(), {"--from", file});
    const CommandResult made = report(words);
    EXPECT_EQ(made.exit_code, 0) << made.errors;
    EXPECT_EQ(made.output, "NO SINGULARITY\n");
    const nlohmann::json data = data_of(page_);
    EXPECT_EQ(data["sources"].size(), files.size());
    EXPECT_THAT(data["question"].get<std::string>(), HasSubstr("parameter x in -1 : 1\n"));
    EXPECT_THAT(data["question"].get<std::string>(), HasSubstr(" +- 1/100\n"));
    EXPECT_EQ(data["certificate"].is_string(), files != std::vector{check_});
    EXPECT_THAT(data["again"][0].get<std::string>(), HasSubstr("--tolerance base=1/100"));
  }
}

TEST_F(AReportOfEarlierRuns, RefusesAnotherQuestion) {
  expect_refused({kRobot, "--from", check_, "--range", "x=-2:2"}, "--range x=-1:1");
  expect_refused({kRobot, "--from", proof_, "--range", "x=-2:2"}, "other ranges");
  expect_refused({kRobot, "table4_1", "--from", check_}, "about the motion \"wide_15\"");
  expect_refused({kModels + "robot_2.toml", "--from", check_}, "about the model \"robot 1\"");
  expect_refused({kModels + "robot_2.toml", "--from", proof_}, "SHA-256");
}

TEST_F(AReportOfEarlierRuns, RefusesADamagedProof) {
  std::string text = text_of(proof_);
  const std::size_t rule = text.rfind("\nl ");
  write(other_, text.substr(0, rule + 1) + text.substr(text.find('\n', rule + 1) + 1));
  expect_refused({kRobot, "--from", other_}, "this certificate is not verified");
  nlohmann::json forged = nlohmann::json::parse(text_of(check_));
  forged["verdict"] = "singularity";
  write(other_, forged.dump());
  expect_refused({kRobot, "--from", other_, "--from", proof_}, "verdict");
}

TEST_F(AReportOfEarlierRuns, RefusesFilesThatAreNoReports) {
  for (const char* text : {"", "hello", "{}", "[1]", R"({"verdict": 1})", "regulus-certificat"}) {
    write(other_, text);
    expect_refused({kRobot, "--from", other_}, "neither a certificate nor a report");
  }
  write(other_, R"({"verdict":)" + std::string(2000000, '['));
  expect_refused({kRobot, "--from", other_}, "neither a certificate nor a report");
  write(other_, R"({"error": {"message": "out of \u001b[31m memory"}})");
  expect_refused({kRobot, "--from", other_}, "ended with an error: \"out of \\u001b[31m memory");
  write(other_, "regulus-certificate 1\n");
  expect_refused({kRobot, "wide_15", "--from", other_}, "not verified");
}

TEST_F(AReportOfEarlierRuns, HasThePavingOfAFile) {
  const std::string planar = kModels + "planar_3rpr.toml";
  EXPECT_EQ(
      regulus({"locate", planar, "crossing", "--resolution", "1/8", "--output", other_, "--quiet"})
          .exit_code,
      1);
  EXPECT_EQ(report({planar, "--from", other_}).exit_code, 1);
  const nlohmann::json taken = data_of(page_)["paving"];
  EXPECT_EQ(report({planar, "crossing", "--paving", "--resolution", "1/8"}).exit_code, 1);
  const nlohmann::json made = data_of(page_)["paving"];
  EXPECT_EQ(taken["summary"]["free"], made["summary"]["free"]);
  const auto ending = [](const nlohmann::json& paving) {
    const auto text = paving["tree"].get<std::string>();
    return text.substr(text.rfind("end "));
  };
  EXPECT_EQ(ending(taken), ending(made));
  std::string text = text_of(other_);
  text.erase(text.find('\n') + 1, text.find('\n', text.find('\n') + 1) - text.find('\n'));
  write(other_, text);
  fs::remove(page_);
  expect_refused({planar, "--from", other_}, "do not cover the motion");
}

TEST_F(AReportOfEarlierRuns, RefusesAProofOfAModelThatTheShellHasChanged) {
  const std::string planar = kModels + "planar_3rpr.toml";
  EXPECT_EQ(regulus({"check", planar, "regular", "--certificate", other_, "--quiet"}).exit_code, 0);
  const auto in_shell = [&](const std::string& change) {
    return run_command({"/bin/sh", "-c",
                        "printf 'load " + planar + "\\nmotion regular\\n" + change +
                            "report --from " + other_ + " --output " + page_ + "\\n' | " +
                            kCommand + " shell"});
  };
  EXPECT_EQ(in_shell("").exit_code, 0);
  EXPECT_TRUE(fs::remove(page_));
  const CommandResult refused = in_shell("set let c cos(phi)+1\\n");
  EXPECT_EQ(refused.exit_code, 65);
  EXPECT_THAT(refused.errors, HasSubstr("SHA-256 differs"));
  EXPECT_FALSE(fs::exists(page_));
}

TEST_F(AReportOfEarlierRuns, KeepsItsFiles) {
  EXPECT_EQ(regulus({"report", kRobot, "--from", check_, "--output", check_}).exit_code, 64);
  EXPECT_THAT(text_of(check_), HasSubstr("no-singularity"));
}

TEST(AProgramWithoutThePage, SaysHowToGetIt) {
  const TemporaryDirectory folder;
  fs::create_directory(folder.path() / "bin");
  fs::copy_file(kCommand, folder.path() / "bin/regulus");
  const CommandResult refused =
      run_command({folder.path() / "bin/regulus", "report", kModels + "orthoglide.toml", "cube",
                   "-o", folder.path() / "page.html"});
  EXPECT_EQ(refused.exit_code, 74);
  EXPECT_THAT(refused.errors, HasSubstr("built without the page"));
  EXPECT_THAT(refused.errors, HasSubstr("apt-get install npm"));
  EXPECT_FALSE(fs::exists(folder.path() / "page.html"));
}

}  // namespace
}  // namespace regulus::test
