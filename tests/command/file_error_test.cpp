// SPDX-License-Identifier: GPL-3.0-or-later
// Tests full disks, files that vanish, folders without write permission, and two runs on one file.
// Each gives a message and exit code 74, and earlier files stay.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <csignal>
#include <thread>

#include "tests/support/cached_command.hpp"
#include "tests/support/interrupted_runs.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

class FileTrouble : public testing::Test {
 protected:
  /// Limits files to so many blocks of 512 bytes. This acts like a full disk for every user.
  [[nodiscard]] static CommandResult with_small_files(int blocks, std::vector<std::string> words) {
    words.insert(words.begin(),
                 {"/bin/sh", "-c", "ulimit -f " + std::to_string(blocks) + "; exec \"$0\" \"$@\"",
                  kCommand});
    return run_command(words);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return directory_.path() / name; }
  [[nodiscard]] bool exists(const std::string& name) const {
    return std::filesystem::exists(file(name));
  }
  /// Returns the words for a search of some thousand boxes.
  [[nodiscard]] std::vector<std::string> long_check(std::vector<std::string> more) const {
    more.insert(more.begin(), {"check", kRobot1, "table6_15_15", "--tolerance",
                               "base,platform=0.12", "--checkpoint", file("checkpoint")});
    return more;
  }
  static void expect_trouble(const CommandResult& result, const std::string& what) {
    EXPECT_EQ(result.exit_code, 74) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr(what));
    EXPECT_THAT(result.errors, testing::Not(HasSubstr("internal error")));
  }

  const TemporaryDirectory directory_;
};

constexpr const char* kNowhere = "/proc/self/nothing/can/be/made/here";

/// A full disk takes the proof, and not the answer.
TEST_F(FileTrouble, AnAnswerIsToldWithoutItsProof) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> questions = {
      {{"check", kRobot1, "table4_5"}, "NO SINGULARITY\n"},
      {{"check", kRobot1, "wide_40"}, "SINGULARITY\n"},
      {{"check", kRobot1, "T1"}, "NO SINGULARITY\n"},
      {{"margin", kRobot1, "table4_5", "--tolerance", "base=0.01:", "--gap", "0.9"}, "\n"},
      {{"bound", kRobot1, "table4_5", "sigma-min", "--gap", "0.9"}, "\n"},
  };
  for (auto [words, headline] : questions) {
    words.insert(words.end(), {"--certificate", file("proof"), "--no-cache"});
    const CommandResult told = with_small_files(1, words);
    expect_trouble(told, "cannot be written");
    EXPECT_THAT(told.errors, HasSubstr("proof      none"));
    EXPECT_THAT(told.output, testing::EndsWith(headline)) << words[0] << ' ' << words[2];
    words.emplace_back("--json");
    const CommandResult report = with_small_files(1, words);
    expect_trouble(report, "cannot be written");
    EXPECT_THAT(report.output, HasSubstr("\"verdict\":")) << report.output;
    EXPECT_THAT(report.output, HasSubstr("cannot be written")) << report.output;
    EXPECT_FALSE(exists("proof"));
  }
}

/// Every option that names a file to write, before anything is searched or renamed.
TEST_F(FileTrouble, AFolderInWhichNothingCanBeMadeIsSaidBeforeTheSearch) {
  const Words check = {"check", kPlanar, "regular"}, locate = {"locate", kPlanar, "regular"},
              margin = {"margin", kPlanar, "regular", "--tolerance", "base=0:0.1"},
              bound = {"bound", kPlanar, "regular", "determinant"},
              sheet = {"datasheet", model_path("orthoglide"), "cube"},
              solve = {"solve", model_path("rpr_6")};
  const std::vector<std::tuple<Words, std::string, std::string>> cases = {
      {check, "--certificate", ""},
      {check, "--checkpoint", ""},
      {check, "--page", ".html"},
      {locate, "--certificate", ""},
      {locate, "--checkpoint", ""},
      {locate, "--page", ".html"},
      {locate, "--output", ""},
      {locate, "--picture", ".svg"},
      {locate, "--picture", ".vtu"},
      {margin, "--certificate", ""},
      {margin, "--checkpoint", ""},
      {margin, "--page", ".html"},
      {bound, "--certificate", ""},
      {bound, "--checkpoint", ""},
      {bound, "--page", ".html"},
      {sheet, "--certificate", ""},
      {sheet, "--checkpoint", ""},
      {sheet, "--page", ".html"},
      {solve, "--certificate", ""},
      {solve, "--checkpoint", ""},
      {solve, "--page", ".html"},
      {{"report", kPlanar, "regular"}, "--output", ".html"},
      {{"generate", kPlanar, "regular", "--output", file("kernel")}, "--depfile", ".d"}};
  write_file(file("earlier.html"), "the one before");
  for (const auto& [words, option, ending] : cases)
    for (const std::string& place : {std::string(kNowhere), file("no/folder")}) {
      Words all = words;
      all.insert(all.end(), {option, place + ending});
      if (option == "--certificate") all.insert(all.end(), {"--page", file("earlier.html")});
      const CommandResult result = regulus(all);
      expect_trouble(result, option + ": " + place);
      expect_trouble(result, ending + " cannot be created: ");
      EXPECT_EQ(result.output, "") << words[0] << ' ' << option;
    }
  EXPECT_EQ(file_contents(file("earlier.html")), "the one before");
  expect_trouble(regulus({"generate", kPlanar, "regular", "--output", kNowhere}),
                 "cannot be written");
  write_file(file("a_file"), "");
  expect_trouble(regulus({"generate", kPlanar, "regular", "--output", file("a_file/kernel")}),
                 "cannot be written: Not a directory");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_.path()), {}), 2);
}

TEST_F(FileTrouble, ACertificateThatDoesNotFitLeavesNoneOfAnEarlierRun) {
  write_file(file("certificate"), "the one before");
  const std::vector<std::string> words = {"check", kPlanar, "regular", "--certificate",
                                          file("certificate")};
  const CommandResult full = with_small_files(1, words);
  expect_trouble(full, "cannot be written: File too large");
  EXPECT_EQ(full.output, "NO SINGULARITY\n");
  EXPECT_FALSE(exists("certificate"));
  EXPECT_EQ(file_contents(file("certificate.old")), "the one before");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_.path()), {}), 1);
}

TEST_F(FileTrouble, MarginCertificatesThatDoNotFitAreSaid) {
  expect_trouble(with_small_files(1, {"margin", kPlanar, "regular", "--tolerance", "base=0:0.1",
                                      "--certificate", file("ends")}),
                 "cannot be written: File too large");
  EXPECT_TRUE(std::filesystem::is_empty(directory_.path()));
}

TEST_F(FileTrouble, LinesAndPicturesThatDoNotFitAreSaid) {
  const std::vector<std::string> locate = {"locate", kPlanar, "crossing", "--quiet"};
  auto lines = locate;
  lines.insert(lines.end(), {"--output", "/dev/full"});
  expect_trouble(regulus(lines), "/dev/full cannot be written: No space left on device");
  std::filesystem::create_symlink("/dev/full", file("picture.svg"));
  auto picture = locate;
  picture.insert(picture.end(), {"--output", file("lines"), "--picture", file("picture.svg")});
  expect_trouble(regulus(picture), "picture.svg cannot be written: No space left on device");
}

/// However a run ends, its output names no longer hold the files of an earlier run.
TEST_F(FileTrouble, NoOutputOfAnEarlierRunStaysUnderItsName) {
  const auto expect_aside = [this](const std::vector<std::string>& words, int exit_code,
                                   const std::vector<std::string>& names) {
    for (const std::string& name : names) write_file(file(name), "the one before");
    const CommandResult result = regulus(words);
    EXPECT_EQ(result.exit_code, exit_code) << result.errors;
    for (const std::string& name : names) {
      EXPECT_FALSE(exists(name)) << name;
      EXPECT_EQ(file_contents(file(name + ".old")), "the one before") << name;
    }
  };
  const std::string proof = file("proof");
  expect_aside({"check", file("no_model.toml"), "--certificate", proof}, 74, {"proof"});
  expect_aside({"check", kPlanar, "no_motion", "--certificate", proof}, 64, {"proof"});
  expect_aside({"check", kRobot1, "wide_15", "--max-boxes", "1", "--certificate", proof}, 2,
               {"proof"});
  expect_aside(
      {"margin", kPlanar, "no_motion", "--tolerance", "base=0:0.1", "--certificate", proof}, 64,
      {"proof.safe", "proof.singular"});
  expect_aside({"locate", kPlanar, "no_motion", "--certificate", proof, "--output", file("lines"),
                "--picture", file("picture.svg")},
               64, {"proof", "lines", "picture.svg"});
  expect_trouble(regulus({"check", kPlanar, "regular", "--certificate", "/dev/null"}),
                 "is not a regular file; name another file to write");
  const std::string model = file("model.toml");
  std::filesystem::copy_file(kPlanar, model);
  EXPECT_EQ(regulus({"check", model, "regular", "--certificate", model}).exit_code, 64);
  EXPECT_EQ(file_contents(model), file_contents(kPlanar));
}

TEST_F(FileTrouble, ARunThatIsKilledLeavesNoProofOfAnEarlierOne) {
  write_file(file("proof"), "the one before");
  auto words = long_check({"--certificate", file("proof"), "--checkpoint-every", "0"});
  words.insert(words.begin(), kCommand);
  RunningCommand run(words);
  for (int i = 0; i < 10000 && !exists("checkpoint"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(run.pid(), SIGKILL);
  static_cast<void>(run.wait());
  EXPECT_FALSE(exists("proof"));
  EXPECT_TRUE(exists("proof.old"));
}

TEST_F(FileTrouble, GeneratedFilesAreReplacedByAWholeKernelOrNotAtAll) {
  const std::string folder = file("generated");
  const std::vector<std::string> generate = {"generate", kPlanar,  "regular", "-o",
                                             folder,     "--name", "planar",  "--quiet"};
  ASSERT_EQ(regulus(generate).exit_code, 0);
  ASSERT_TRUE(exists("generated/planar.cpp"));
  write_file(folder + "/mine.cpp", "not the command's");
  EXPECT_NE(
      regulus({"generate", file("no_model.toml"), "-o", folder, "--name", "planar"}).exit_code, 0);
  EXPECT_TRUE(exists("generated/planar.cpp"));
  EXPECT_TRUE(exists("generated/planar_kernel.inc"));
  EXPECT_TRUE(exists("generated/mine.cpp"));
  write_file(file("outside.cpp"), "not the command's");
  EXPECT_NE(
      regulus({"generate", kPlanar, "regular", "-o", folder, "--name", "../outside"}).exit_code, 0);
  EXPECT_TRUE(exists("outside.cpp"));
}

/// Tests endless devices, pipes without a writer, folders, and files of impossible size.
TEST_F(FileTrouble, WhatIsNoFileIsNotRead) {
  const std::string pipe = file("pipe"), sparse = file("sparse");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  write_file(sparse, "");
  std::filesystem::resize_file(sparse, std::uintmax_t{1} << 40);
  for (const std::string& other : {std::string("/dev/zero"), pipe, file(""), sparse}) {
    expect_trouble(regulus({"check", kPlanar, "regular", "--filter", other}), "cannot be read");
    EXPECT_NE(regulus({"check", other}).exit_code, 0);
    if (other == pipe) std::filesystem::remove(other + ".lock");
    expect_trouble(regulus({"check", kPlanar, "regular", "--checkpoint", other}), "checkpoint");
  }
}

TEST_F(FileTrouble, AFilterThatIsCutIsRefused) {
  const std::string whole = file_contents(REGULUS_BINARY_DIR "/filters/gershgorin.so");
  ASSERT_GT(whole.size(), 5000U);
  for (const std::size_t size :
       {std::size_t{4}, std::size_t{60}, std::size_t{200}, whole.size() / 2}) {
    write_file(file("cut.so"), whole.substr(0, size));
    const CommandResult cut = regulus({"check", kPlanar, "regular", "--filter", file("cut.so")});
    EXPECT_EQ(cut.exit_code, 65) << size;
    EXPECT_THAT(cut.errors, HasSubstr("it is incomplete"));
  }
}

/// The plugins cannot be opened, as if the address space were too small for LLVM.
TEST_F(FileTrouble, WithoutACompilerTheInterpreterAnswers) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer needs more address space than the limit";
#endif
  const auto without_compiler = [this](const std::string& engine) {
    return run_command({"/bin/sh", "-c",
                        "ulimit -v 170000; XDG_CACHE_HOME=\"$1\" exec \"$0\" check \"$2\" regular "
                        "--threads 1 --engine \"$3\"",
                        kCommand, file("cache"), kPlanar, engine});
  };
  const CommandResult by_itself = without_compiler("auto");
  EXPECT_EQ(by_itself.exit_code, 0) << by_itself.errors;
  EXPECT_THAT(by_itself.errors, HasSubstr("interpreted"));
  const CommandResult asked_for = without_compiler("jit");
  EXPECT_EQ(asked_for.exit_code, 74);
  EXPECT_THAT(asked_for.errors, HasSubstr("use --engine interpreted, which needs none"));
}

TEST_F(FileTrouble, AVerdictThatNobodyCanReadIsNone) {
  for (const char* words :
       {"check " REGULUS_SOURCE_DIR "/models/planar_3rpr.toml regular",
        "margin " REGULUS_SOURCE_DIR "/models/planar_3rpr.toml regular --tolerance base=0:0.1"})
    expect_trouble(run_command({"/bin/sh", "-c", kCommand + ' ' + words + " >/dev/full"}),
                   "cannot write standard output");
}

TEST_F(FileTrouble, AnOutputThatIsRemovedMeanwhileIsSaid) {
  for (const std::string option : {"--output", "--picture"}) {
    const std::string path = file("paving.svg");
    const auto temporary = [&] {
      for (const auto& entry : std::filesystem::directory_iterator(directory_.path()))
        if (entry.path().string().starts_with(path + '.')) return entry.path();
      return std::filesystem::path();
    };
    // It still runs when the file is removed, however late that is.
    RunningCommand run({kCommand, "locate", kRobot1, "wide_40", "--quiet", "--time-limit", "2",
                        "--engine", "interpreted", option, path});
    // A file that only tries the folder is gone again soon.
    std::filesystem::path seen;
    for (int i = 0; i < 1000 && (seen.empty() || temporary() != seen); ++i) {
      seen = temporary();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    std::filesystem::remove(seen);
    expect_trouble(run.wait(), path + " cannot be put in its place");
  }
}

TEST_F(FileTrouble, ACheckpointThatDoesNotFitLeavesTheOneThatWasThere) {
  ASSERT_EQ(regulus(long_check({"--max-boxes", "200"})).exit_code, 2);
  const std::string before = file_contents(file("checkpoint"));
  expect_trouble(with_small_files(1, long_check({"--max-boxes", "400"})),
                 "the checkpoint " + file("checkpoint") + " cannot be written: File too large");
  EXPECT_EQ(file_contents(file("checkpoint")), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_.path()), {}), 1);
  EXPECT_FALSE(exists("checkpoint.lock"));
}

/// The disk is full when the search is saved. With space again, nothing of its proof is missing.
TEST_F(FileTrouble, ASearchThatDoesNotFitGoesOnWhenThereIsRoom) {
  const auto certified = [this](std::vector<std::string> more) {
    more.insert(more.end(), {"--certificate", file("certificate")});
    return long_check(more);
  };
  ASSERT_EQ(regulus(certified({"--max-boxes", "100"})).exit_code, 2);
  const std::string before = file_contents(file("checkpoint"));
  const auto blocks = std::filesystem::file_size(file("checkpoint")) / 512 + 1;
  expect_trouble(with_small_files(int(blocks), certified({"--max-boxes", "3000"})),
                 "the checkpoint " + file("checkpoint") + " cannot be written");
  EXPECT_EQ(file_contents(file("checkpoint")), before);
  EXPECT_EQ(regulus(certified({})).exit_code, 0);
  const CommandResult verified =
      regulus({"verify", file("certificate"), "--model", kRobot1, "--allow-options"});
  EXPECT_EQ(verified.output, "VERIFIED\n") << verified.errors;
}

TEST_F(FileTrouble, TwoRunsOnOneCheckpointAreKeptApart) {
  RunningCommand first([&] {
    auto words = long_check({"--checkpoint-every", "0", "--tolerance", "base,platform=0.13"});
    words.insert(words.begin(), kCommand);
    return words;
  }());
  for (int i = 0; i < 10000 && !is_search_saved(file("checkpoint")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  expect_trouble(regulus(long_check({})),
                 "is in use by another run (process " + std::to_string(first.pid()) + ")");
  ::kill(first.pid(), SIGKILL);
  static_cast<void>(first.wait());
  ASSERT_TRUE(exists("checkpoint.lock"));
  const CommandResult next =
      regulus(long_check({"--tolerance", "base,platform=0.13", "--max-boxes", "1"}));
  EXPECT_EQ(next.exit_code, 2) << next.errors;
  EXPECT_THAT(next.errors, HasSubstr("continued from"));
  EXPECT_FALSE(exists("checkpoint.lock"));
}

TEST_F(FileTrouble, ACheckpointIsRefusedWhereItWouldBeIgnored) {
  const CommandResult bound =
      regulus({"bound", kPlanar, "regular", "determinant", "--checkpoint-every", "1"});
  EXPECT_EQ(bound.exit_code, 64);
  EXPECT_THAT(bound.errors, HasSubstr("each search is saved"));
}

}  // namespace
}  // namespace regulus::detail::test
