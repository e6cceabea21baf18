// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus report` from the outside; tests/page looks at its pages in a browser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The data of a page.
nlohmann::json data_of(const fs::path& file) {
  const std::string page = file_contents(file), begin = "data-sha256=\"";
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
  EXPECT_EQ(data["model"]["text"], file_contents(kModels + "robot_1.toml"));
  EXPECT_THAT(data["certificate"].get<std::string>(),
              HasSubstr(data["question"].get<std::string>()));
  EXPECT_THAT(data["question"].get<std::string>(), HasSubstr("parameter x in -1 : 1\n"));
  EXPECT_THAT(data["again"][0].get<std::string>(), HasSubstr("wide_15 --range x=-1:1"));
  EXPECT_EQ(data["drawing"]["parts"].size(), 8U);
}

TEST_F(AReport, SaysThatItIsNotCheckedUntilItsProgramHasProvedIt) {
  EXPECT_EQ(report({kModels + "orthoglide.toml", "cube", "--quiet"}).exit_code, 0);
  const std::string page = file_contents(page_);
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
  EXPECT_EQ(file_contents(page_ + ".old"), "earlier");
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

/// The page that --page of a question makes.
class APage : public AReport {
 protected:
  /// Returns the data of the page of a question, whose command ends with `exit_code`.
  nlohmann::json page_of(std::vector<std::string> words, int exit_code) {
    const CommandResult made = regulus(std::move(words), {"--page", page_});
    EXPECT_EQ(made.exit_code, exit_code) << made.errors;
    EXPECT_THAT(made.errors, HasSubstr("page       " + page_));
    headline_ = made.output.substr(0, made.output.find('\n'));
    return data_of(page_);
  }
  std::string headline_;
};

TEST_F(APage, OfACheckHasItsProofWithoutAFileOfIt) {
  const auto data = page_of({"check", kModels + "robot_1.toml", "wide_15"}, 0);
  EXPECT_EQ(data["kind"], "check");
  EXPECT_EQ(data["headline"], headline_);
  EXPECT_THAT(data["certificate"].get<std::string>(),
              HasSubstr(data["question"].get<std::string>()));
  EXPECT_FALSE(data["report"].contains("certificate"));
}

TEST_F(APage, HasItsCommandAsAShellReadsIt) {
  const std::string model = (folder_.path() / "it's 1.toml").string();
  fs::copy_file(kModels + "robot_1.toml", model);
  const std::string command = page_of({"check", model, "wide_15"}, 0)["command"];
  EXPECT_THAT(command, testing::StartsWith("regulus check 'it'\\''s 1.toml' wide_15"));
}

TEST_F(APage, OfACheckKeepsTheFileThatIsWanted) {
  const std::string proof = folder_.path() / "proof";
  const auto data =
      page_of({"check", kModels + "robot_1.toml", "wide_15", "--certificate", proof}, 0);
  EXPECT_EQ(data["certificate"], file_contents(proof));
}

TEST_F(APage, OfAPavingHasItsBoxes) {
  const auto data = page_of({"locate", kModels + "planar_3rpr.toml", "crossing", "--resolution",
                             "1/8", "--output", folder_.path() / "boxes"},
                            1);
  EXPECT_EQ(data["kind"], "paving");
  const auto tree = data["paving"]["tree"].get<std::string>();
  EXPECT_THAT(tree, HasSubstr("\nend "));
  EXPECT_EQ(data["report"]["verdict"], "singularity");
}

TEST_F(APage, OfABoundHasItsBars) {
  const auto data =
      page_of({"bound", kModels + "orthoglide.toml", "cube", "sigma-min", "--gap", "0.5"}, 0);
  EXPECT_EQ(data["headline"], headline_);
  EXPECT_EQ(data["bounds"].size(), 1U);
  EXPECT_EQ(data["bounds"][0]["bound"], "least singular value of J⁻¹");
  EXPECT_TRUE(data["certificate"].is_null());
}

TEST_F(APage, OfALimitAndOfAMarginHasTheirWords) {
  const auto limit =
      page_of({"bound", kModels + "orthoglide.toml", "cube", "sigma-min", "--limit", "0.4"}, 0);
  EXPECT_EQ(limit["headline"], "WITHIN");
  const auto margin =
      page_of({"margin", kModels + "orthoglide.toml", "factors_2", "--grow",
               "edge=0:", "--quantity", "sigma-max", "--limit", "2", "--gap", "0.5"},
              0);
  EXPECT_EQ(margin["margins"].size(), 1U);
  EXPECT_EQ(margin["headline"], headline_);
}

TEST_F(APage, OfALoadHasItsReport) {
  const auto data = page_of({"check", kModels + "cable_8.toml", "hall", "--load", "weight"}, 0);
  EXPECT_EQ(data["kind"], "load");
  EXPECT_EQ(data["headline"], "FEASIBLE");
  EXPECT_THAT(data["text"].get<std::string>(), HasSubstr("weight"));
}

TEST_F(APage, OfADatasheetHasARowOfBarsForEachQuantity) {
  const auto data = page_of({"datasheet", kModels + "orthoglide.toml", "cube", "--gap", "0.9"}, 0);
  EXPECT_EQ(data["bounds"].size(), data["report"]["bounds"].size());
  EXPECT_GT(data["bounds"].size(), 2U);
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
}  // namespace regulus::detail::test
