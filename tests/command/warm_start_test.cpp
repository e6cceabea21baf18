// SPDX-License-Identifier: GPL-3.0-or-later
// A run that finds its problem in the cache gives the same answer as the run that stored it. No
// contents of the cache can change an answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::vector<std::string> kRegular = {"check", kPlanar, "regular"};
const std::vector<std::string> kCrossing = {"check", kPlanar, "crossing"};

/// Returns true if the run performed the stages that a start from the cache skips.
bool was_prepared_anew(const json& report) { return report["seconds"]["program"] != 0.0; }

class WarmCommand : public testing::Test {
 protected:
  std::string model_file(const std::string& text) {
    const std::string path = directory_.path() / "model.toml";
    write_file(path, text);
    return path;
  }
  json cold(const std::vector<std::string>& words) {
    command_.forget_forms();
    json report = command_.report(words);
    EXPECT_TRUE(was_prepared_anew(report));
    return report;
  }
  void expect_warm(const std::vector<std::string>& words, const json& expected) {
    const json report = command_.report(words);
    EXPECT_FALSE(was_prepared_anew(report));
    EXPECT_EQ(report["cache"], "hit");
    EXPECT_EQ(timeless(report), timeless(expected));
  }
  void expect_anew(const std::vector<std::string>& words, const json& expected) {
    const json report = command_.report(words);
    EXPECT_TRUE(was_prepared_anew(report));
    EXPECT_EQ(timeless(report), timeless(expected));
  }

  CachedCommand command_;
  TemporaryDirectory directory_;
};

std::string text_of_model(const std::string& matrix, const std::string& x, const std::string& y) {
  return "regulus = 1\nname = \"small\"\n[pose]\nx = \"cm\"\ny = \"cm\"\n"
         "[geometry]\nr = {value = 4, tolerance = 0.05, group = \"platform\"}\n"
         "[matrix]\nrows = [" +
         matrix + "]\n[motion.m]\nx = " + x + "\ny = " + y + "\n";
}

TEST_F(WarmCommand, ReportsWhatTheColdOneDid) {
  for (const char* motion : {"regular", "crossing", "circle", "reach"}) {
    const std::vector<std::string> words = {"check", kPlanar, motion};
    expect_warm(words, cold(words));
  }
}

TEST_F(WarmCommand, FindsOutWhatIsUndefinedAsTheColdOneDid) {
  const std::string model =
      model_file(text_of_model("[\"sqrt(x)\", \"0\"], [\"0\", \"r\"]", "[-1, -0.5]", "[0, 1]"));
  const json first = cold({"check", model});
  ASSERT_TRUE(first.contains("undefined"));
  expect_warm({"check", model}, first);
}

TEST_F(WarmCommand, RecognisesWhatIsAlwaysSingularAsTheColdOneDid) {
  const std::string model =
      model_file(text_of_model("[\"x\", \"r*x\"], [\"y\", \"r*y\"]", "[1, 2]", "[1, 2]"));
  const json first = cold({"check", model});
  ASSERT_EQ(first["verdict"], "singularity");
  expect_warm({"check", model}, first);
}

/// A pose that is exactly singular: the conclusion reads the model, which the cache left out before.
TEST_F(WarmCommand, CountsNoTimeTwice) {
  std::string sum = "sin(x + 1)";
  for (int k = 2; k < 60; ++k) {
    const std::string number = std::to_string(k);
    sum += " + sin(x + " + number + ")^2*cos(y*" + number + ")";
  }
  const std::string path = model_file(
      text_of_model("[\"(x - 1)*(" + sum + ")\", \"(y - 1)*r\"], [\"y\", \"x\"]", "1", "1"));
  for (const char* run : {"cold", "warm"}) {
    const json report = command_.report({"check", path});
    EXPECT_EQ(report["verdict"], "singularity");
    for (const auto& [stage, seconds] : report["seconds"].items())
      EXPECT_GE(seconds.get<double>(), 0) << stage << ", " << run;
  }
}

TEST_F(WarmCommand, LooksForTheNearestSingularityAsTheColdOneDid) {
  const std::string three_legs =
      R"toml(["1", "(x - 1/3)^2 + (y + 2/3)^2"], ["y + 2/3", "0"], ["r", "0"])toml";
  const std::string model = model_file(text_of_model(three_legs, "[-1, 1]", "[-1, 1]"));
  const std::vector<std::string> words = {"check", model, "--max-boxes", "50"};
  const json first = cold(words);
  ASSERT_EQ(first["verdict"], "possible-problem");
  ASSERT_TRUE(first.contains("nearest_singular"));
  expect_warm(words, first);
}

TEST_F(WarmCommand, PavesAsTheColdOneDid) {
  const std::vector<std::string> words = {"locate", kPlanar, "crossing", "--resolution", "1/8"};
  const CommandResult first = command_.run(words), second = command_.run(words);
  ASSERT_EQ(command_.problems().size(), 1U);
  EXPECT_EQ(timeless(first.errors), timeless(second.errors));
  EXPECT_EQ(std::count(first.output.begin(), first.output.end(), '\n'),
            std::count(second.output.begin(), second.output.end(), '\n'));
}

TEST_F(WarmCommand, WritesACertificateThatVerifies) {
  const std::string file = directory_.path() / "certificate";
  for (const auto& words : {kRegular, kCrossing}) {
    (void)cold(words);
    std::vector<std::string> with_certificate = words;
    with_certificate.insert(with_certificate.end(), {"--certificate", file});
    EXPECT_FALSE(was_prepared_anew(command_.report(with_certificate)));
    EXPECT_EQ(command_.run({"verify", file, "--model", kPlanar}).output, "VERIFIED\n");
  }
}

TEST_F(WarmCommand, AnswersTheModelAfterOneDigitOfItChanged) {
  const std::string matrix = "[\"x\", \"0\"], [\"0\", \"r\"]";
  const std::string model = model_file(text_of_model(matrix, "[0.1, 2]", "[0, 1]"));
  EXPECT_EQ(command_.report({"check", model})["verdict"], "no-singularity");
  (void)model_file(text_of_model(matrix, "[-0.1, 2]", "[0, 1]"));
  EXPECT_EQ(command_.report({"check", model})["verdict"], "singularity");
}

TEST_F(WarmCommand, MissesAfterAChangeOnTheCommandLine) {
  (void)cold(kCrossing);
  const std::vector<std::vector<std::string>> changes = {{"--tolerance", "base=0.01"},
                                                         {"--alpha", "0.5"},
                                                         {"--method", "reg"},
                                                         {"--isa", "portable"},
                                                         {"--without", "nesting"}};
  std::size_t expected = 1;
  for (const auto& change : changes) {
    std::vector<std::string> words = kCrossing;
    words.insert(words.end(), change.begin(), change.end());
    const json first = command_.report(words);
    EXPECT_TRUE(was_prepared_anew(first)) << change[1];
    EXPECT_EQ(command_.problems().size(), ++expected) << change[1];
    expect_warm(words, first);
  }
  std::vector<std::string> words = kCrossing;
  words.insert(words.end(), {"--engine", "interpreted"});
  EXPECT_EQ(command_.report(words)["cache"], "off");
  EXPECT_EQ(command_.problems().size(), expected);
}

TEST_F(WarmCommand, SaysWhatIsWrongWithACommandLineAsTheColdOneDid) {
  (void)cold(kRegular);
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--range", "q=0:1"},
                                                {"--tolerance", "nothing=1"},
                                                {"--filter", "/nonexistent.so"},
                                                {"--certificate", "/nonexistent/file"}}) {
    std::vector<std::string> words = kRegular;
    words.insert(words.end(), wrong.begin(), wrong.end());
    const CommandResult first = command_.run(words), second = command_.run(words);
    EXPECT_NE(first.exit_code, 0) << wrong[0];
    EXPECT_EQ(first.exit_code, second.exit_code) << wrong[0];
    EXPECT_EQ(first.errors, second.errors);
  }
}

TEST_F(WarmCommand, StartsAnewWhenTheObjectOfTheKernelIsGone) {
  const json first = cold(kCrossing);
  for (const auto& file : command_.objects()) std::filesystem::remove(file);
  const json second = command_.report(kCrossing);
  EXPECT_EQ(second["cache"], "miss");
  EXPECT_EQ(timeless(second), timeless(first));
  expect_warm(kCrossing, first);
}

TEST_F(WarmCommand, StartsAnewFromADamagedProblem) {
  const json first = cold(kCrossing);
  ASSERT_EQ(command_.problems().size(), 1U);
  const auto file = command_.problems().front();
  const std::string bytes = file_contents(file);
  for (const std::size_t at :
       {std::size_t{3}, std::size_t{70}, std::size_t{200}, bytes.size() - 2}) {
    std::string damaged = bytes;
    damaged[at] ^= 1;
    write_file(file, damaged);
    expect_anew(kCrossing, first);
    expect_warm(kCrossing, first);
  }
  write_file(file, bytes.substr(0, bytes.size() / 2));
  expect_anew(kCrossing, first);
  write_file(file, "");
  expect_anew(kCrossing, first);
  EXPECT_THAT(command_.run(kCrossing).errors, testing::Not(HasSubstr("damaged")));
  write_file(file, bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(command_.run(kCrossing).errors, HasSubstr("cache entry is damaged"));
}

TEST_F(WarmCommand, DoesNotTakeTheProblemOfAnotherQuestion) {
  const json singular = cold(kCrossing);
  const auto of_crossing = command_.problems().front();
  (void)command_.report({"check", kPlanar, "crossing", "--tolerance", "base=0.01"});
  ASSERT_EQ(command_.problems().size(), 2U);
  for (const auto& file : command_.problems())
    if (file != of_crossing)
      std::filesystem::copy_file(file, of_crossing,
                                 std::filesystem::copy_options::overwrite_existing);
  expect_anew(kCrossing, singular);
}

TEST_F(WarmCommand, DoesNotTakeAProblemThatOthersMayWrite) {
  const json first = cold(kCrossing);
  std::filesystem::permissions(command_.problems().front(), std::filesystem::perms::others_write,
                               std::filesystem::perm_options::add);
  expect_anew(kCrossing, first);
}

TEST_F(WarmCommand, KeepsNothingUnlessItMay) {
  (void)command_.run({"check", kPlanar, "regular", "--no-cache"});
  EXPECT_TRUE(command_.problems().empty());
  (void)cold(kRegular);
  std::vector<std::string> words = kRegular;
  words.emplace_back("--no-cache");
  EXPECT_TRUE(was_prepared_anew(command_.report(words)));
}

class SharedForms : public WarmCommand {
 protected:
  /// Expects that the question takes the forms of an earlier one, and gets the answer that it gets
  /// alone.
  void expect_shared(const std::vector<std::string>& words) {
    const json alone = CachedCommand().report(words);
    const json shared = command_.report(words);
    EXPECT_FALSE(was_prepared_anew(shared));
    EXPECT_EQ(command_.problems().size(), 1U);
    EXPECT_EQ(timeless(shared), timeless(alone));
    expect_warm(words, shared);
  }
};

std::vector<std::string> with(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(SharedForms, AreTakenForOtherRangesAndTolerances) {
  const std::vector<std::string> words = with(kRegular, {"--tolerance", "base,platform=0.01"});
  (void)cold(words);
  for (const char* tolerance : {"base=0.0101", "platform=0.0102", "base,platform=0.0099"})
    expect_shared(with(words, {"--tolerance", tolerance}));
  expect_shared(with(words, {"--range", "x=-1.99:3.99"}));
}

TEST_F(SharedForms, AreTakenAfterAnEditThatDoesNotChangeThem) {
  const std::string matrix = R"toml(["x", "r*y"], ["0", "r"])toml";
  const std::string model = model_file(text_of_model(matrix, "[0.1, 2]", "[0, 1]"));
  const json first = cold({"check", model});
  EXPECT_EQ(first["verdict"], "no-singularity");
  (void)model_file("# an edit\n" + text_of_model(matrix, "[0.1001, 2]", "[0, 1]"));
  const json second = command_.report({"check", model});
  EXPECT_FALSE(was_prepared_anew(second));
  EXPECT_NE(second["model_sha256"], first["model_sha256"]);
}

TEST_F(SharedForms, AreNotTakenForAnotherMatrix) {
  const std::string range = "[0.1, 2]";
  const std::string before = R"toml(["x", "r*y"], ["0", "r"])toml";
  const std::string model = model_file(text_of_model(before, range, range));
  EXPECT_EQ(cold({"check", model})["verdict"], "no-singularity");
  for (const char* after :
       {R"toml(["x - 1", "r*y"], ["0", "r"])toml", R"toml(["x", "r*y"], ["0", "r - 4"])toml",
        R"toml(["x - y", "0"], ["0", "r"])toml"}) {
    (void)model_file(text_of_model(after, range, range));
    const json report = command_.report({"check", model});
    EXPECT_TRUE(was_prepared_anew(report)) << after;
    EXPECT_EQ(report["verdict"], "singularity") << after;
  }
}

TEST_F(SharedForms, AreNotTakenForOtherUncertainQuantitiesOrConstants) {
  const std::string matrix = R"toml(["x", "r*y"], ["0", "r"])toml";
  std::string text = text_of_model(matrix, "[0.1, 2]", "[0, 1]");
  const std::string model = model_file(text);
  (void)cold({"check", model});
  EXPECT_TRUE(was_prepared_anew(command_.report({"check", model, "--tolerance", "platform=0"})));
  text.replace(text.find("value = 4"), 9, "value = 3");
  (void)model_file(text);
  EXPECT_TRUE(was_prepared_anew(command_.report({"check", model})));
  EXPECT_TRUE(was_prepared_anew(command_.report({"check", model, "--alpha", "0.1"})));
}

TEST_F(WarmCommand, MayRunTwiceAtOnce) {
  std::vector<std::string> words = CachedCommand::words(kCrossing);
  words.emplace_back("--json");
  RunningCommand one(words), two(words);
  const json first = json::parse(one.wait().output), second = json::parse(two.wait().output);
  EXPECT_EQ(timeless(first), timeless(second));
  EXPECT_EQ(command_.problems().size(), 1U);
  expect_warm(kCrossing, first);
}

}  // namespace
}  // namespace regulus::detail::test
