// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a user's files stay: those of other programs, and those that a run which is killed, or
// has no room, was about to replace. What a run has proved is said, whatever happens to a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <functional>
#include <thread>

#include "tests/support/cached_command.hpp"

namespace regulus::detail::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class UserFiles : public testing::Test {
 protected:
  /// Runs the command after a command of the shell, such as a limit.
  [[nodiscard]] static CommandResult after(const std::string& before, Words words) {
    words.insert(words.begin(), {"/bin/sh", "-c", before + "; exec \"$0\" \"$@\"", kCommand});
    return run_command(words);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] bool exists(const std::string& name) const { return fs::exists(file(name)); }
  [[nodiscard]] auto files() const {
    return std::distance(fs::directory_iterator(folder_.path()), {});
  }
  /// True if a file whose name begins so has bytes.
  [[nodiscard]] bool has_begun(const std::string& name) const {
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      std::error_code gone;
      if (entry.path().filename().string().starts_with(name) && entry.file_size(gone) > 0 && !gone)
        return true;
    }
    return false;
  }
  /// Starts a run, and kills it when the condition holds.
  static void kill_when(Words words, const std::function<bool()>& condition) {
    words.insert(words.begin(), kCommand);
    RunningCommand run(words);
    for (int i = 0; i < 20000 && !condition(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(run.pid(), SIGKILL);
    EXPECT_EQ(run.wait().exit_code, -1) << "it ended too early";
  }
  /// Returns the words for a paving of many boxes.
  [[nodiscard]] static Words long_locate(const Words& more) {
    Words words = {"locate",   kRobot1,       "wide_40",     "--quiet",
                   "--engine", "interpreted", "--max-boxes", "10000000"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  const TemporaryDirectory folder_;
};

TEST_F(UserFiles, ALockOfAnotherProgramIsNotTakenForOurs) {
  write_file(file("poetry.lock"), "[[package]]\n");
  for (const Words& words : {Words{"check", kPlanar, "regular"},
                             Words{"bound", kPlanar, "regular", "determinant", "--quiet"}}) {
    Words with = words;
    with.insert(with.end(), {"--checkpoint", file("poetry")});
    const CommandResult result = regulus(with);
    EXPECT_EQ(result.exit_code, 74);
    EXPECT_THAT(result.errors, HasSubstr("poetry.lock is a file of another program"));
    EXPECT_EQ(file_contents(file("poetry.lock")), "[[package]]\n");
  }
}

TEST_F(UserFiles, AModelIsSavedWholeOrNotAtAll) {
  write_file(file("mine.toml"), "the one before");
  write_file(file("script"), "load '" + kPlanar + "'\nsave '" + file("mine.toml") + "'\n");
  const CommandResult full = run_command(
      {"/bin/sh", "-c", "ulimit -f 1; exec " + kCommand + " shell < " + file("script")});
  EXPECT_EQ(full.exit_code, 74);
  EXPECT_THAT(full.errors, HasSubstr("mine.toml cannot be written: File too large"));
  EXPECT_EQ(file_contents(file("mine.toml")), "the one before");
  EXPECT_EQ(files(), 2);
  ASSERT_EQ(run_command({"/bin/sh", "-c", kCommand + " shell < " + file("script")}).exit_code, 0);
  EXPECT_EQ(file_contents(file("mine.toml")), file_contents(kPlanar));
}

TEST_F(UserFiles, APavingThatDoesNotFitLeavesNoFileAndSaysWhy) {
  write_file(file("lines"), "the one before");
  const CommandResult full =
      after("ulimit -f 1", {"locate", kPlanar, "crossing", "--quiet", "--output", file("lines")});
  EXPECT_EQ(full.exit_code, 74);
  EXPECT_THAT(full.errors, HasSubstr("lines cannot be written: File too large"));
  EXPECT_FALSE(exists("lines"));
  EXPECT_EQ(file_contents(file("lines.old")), "the one before");
  EXPECT_EQ(files(), 1);
}

TEST_F(UserFiles, PavingsThatAreKilledLeaveTheEarlierOne) {
  write_file(file("lines"), "the one before");
  for (int kill = 0; kill < 2; ++kill) {
    kill_when(long_locate({"--output", file("lines")}), [this] { return has_begun("lines."); });
    EXPECT_FALSE(exists("lines"));
    EXPECT_EQ(file_contents(file("lines.old")), "the one before");
  }
  EXPECT_EQ(
      regulus({"locate", kPlanar, "crossing", "--quiet", "--output", file("lines")}).exit_code, 1);
  EXPECT_EQ(files(), 2) << "what the killed runs left is swept";
}

TEST_F(UserFiles, PicturesThatAreKilledLeaveTheEarlierOne) {
  write_file(file("p.svg"), "the one before");
  for (int kill = 0; kill < 2; ++kill) {
    kill_when(long_locate({"--picture", file("p.svg"), "--output", file("lines")}),
              [this] { return has_begun("lines."); });
    EXPECT_FALSE(exists("p.svg"));
    EXPECT_EQ(file_contents(file("p.svg.old")), "the one before");
  }
}

TEST_F(UserFiles, BracketsThatAreKilledLeaveNoProofOfAWeakerEnd) {
  for (int kill = 0; kill < 2; ++kill) {
    kill_when({"margin", kRobot1, "table6_5_5", "--tolerance", "base,platform=0:1", "--gap",
               "1e-12", "--certificate", file("ends"), "--quiet"},
              [this] { return has_begun("ends.singular"); });
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      EXPECT_THAT(entry.path().string(), testing::EndsWith(".regulus"));
  }
}

TEST_F(UserFiles, ABracketIsSaidAlthoughItsCheckpointCannotBeWritten) {
  const std::string orthoglide = REGULUS_SOURCE_DIR "/models/orthoglide.toml";
  for (const Words& quantity : {Words{"sigma-max"}, Words{"condition", "--norm", "2"}}) {
    Words words = {"bound", orthoglide, "cube"};
    words.insert(words.end(), quantity.begin(), quantity.end());
    words.insert(words.end(),
                 {"--threads", "1", "--quiet", "--gap", "0.01", "--checkpoint", file("state")});
    const CommandResult usual = regulus(words);
    fs::remove(file("state"));
    // Room for the question of the checkpoint, but for no search.
    const CommandResult full = after("ulimit -f 3", words);
    EXPECT_EQ(full.output, usual.output) << full.errors;
    EXPECT_EQ(full.exit_code, usual.exit_code);
    EXPECT_THAT(full.errors, HasSubstr("state cannot be written: File too large"));
    fs::remove(file("state"));
  }
}

/// An option that the question cannot have leaves the outputs of an earlier run where they are.
TEST_F(UserFiles, WhatAPavingCannotHaveIsRefusedBeforeAnythingIsMoved) {
  write_file(file("way.csv"), "x,y,phi\n0,14,0\n1,15,0\n");
  const Words paved = {"locate", kPlanar, "regular"};
  const Words along = {"locate", kPlanar, "regular", "--waypoints", file("way.csv")};
  const Words loaded = {"locate", model_path("cable_8"), "hall", "--load", "weight"};
  for (const auto& [asked, options, what] : {
           std::tuple(along, Words{"--picture", file("way.vtu")}, "boxes in space"),
           {along, {"--picture", file("z.svg"), "--axes", "x,y"}, "has no ranges"},
           {along, {"--resolution", "2"}, "expected a number above 0"},
           {paved, {"--picture", file("z.svg"), "--axes", "x,q"}, "'q' is not a parameter"},
           {paved, {"--picture", file("z.svg"), "--slices", "phi=1"}, "expected p=N"},
           {paved,
            {"--picture", file("z.vtu"), "--range", "x=0"},
            "this motion has ranges of y, phi; --range x=LO:HI"},
           {paved, {"--axes", "x,y"}, "--axes needs --picture"},
           {paved, {"--resolution", "0"}, "expected a number above 0"},
           {loaded, {"--picture", file("z.svg"), "--axes", "x,q"}, "'q' is not a parameter"},
       }) {
    for (const char* name : {"z", "z.svg", "way.vtu"}) write_file(file(name), name);
    Words words = asked;
    words.insert(words.end(), {"--certificate", file("z")});
    words.insert(words.end(), options.begin(), options.end());
    const CommandResult result = regulus(words);
    EXPECT_EQ(result.exit_code, 64) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr(what));
    for (const char* name : {"z", "z.svg", "way.vtu"})
      EXPECT_EQ(file_contents(file(name)), name) << what;
  }
}

TEST_F(UserFiles, TwoOutputsOfOneNameAreRefusedBeforeAnythingIsMoved) {
  const auto expect_refused = [this](const Words& words, const std::string& what) {
    for (const char* name : {"z", "z.old"}) write_file(file(name), name);
    const CommandResult result = regulus(words);
    EXPECT_EQ(result.exit_code, 64) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr(what));
    for (const char* name : {"z", "z.old"}) EXPECT_EQ(file_contents(file(name)), name);
  };
  const std::string z = file("z");
  const Words check = {"check", kPlanar, "regular"}, locate = {"locate", kPlanar, "regular"};
  const auto with = [](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  expect_refused(with(check, {"--certificate", z, "--checkpoint", z}),
                 "--certificate and --checkpoint: both would write " + z);
  expect_refused(with(check, {"--certificate", file("./z"), "--checkpoint", z}),
                 "--certificate and --checkpoint");
  expect_refused(with(locate, {"--certificate", z, "--output", z}),
                 "--certificate and --output: both would write " + z);
  expect_refused(with(locate, {"--certificate", z, "--output", z + ".old"}),
                 "--certificate and --output");
  fs::copy_file(kPlanar, file("model.old"));
  write_file(file("model"), "of an earlier run");
  expect_refused({"check", file("model.old"), "regular", "--certificate", file("model")},
                 "--certificate: this run reads " + file("model.old"));
  EXPECT_EQ(file_contents(file("model.old")), file_contents(kPlanar));
}

TEST_F(UserFiles, WhatIsNoFileIsWrittenToAndNotReplaced) {
  const Words locate = {"locate", kPlanar, "crossing", "--json", "--quiet", "--output"};
  const auto to = [&](const std::string& path) {
    Words words = locate;
    words.push_back(path);
    return regulus(words);
  };
  EXPECT_EQ(to("/dev/zero").exit_code, 1);
  EXPECT_TRUE(fs::is_character_file("/dev/zero"));
  const CommandResult printed = to("/dev/stdout");
  EXPECT_EQ(printed.exit_code, 1) << printed.errors;
  EXPECT_THAT(printed.output, HasSubstr("{\"summary\""));
  EXPECT_TRUE(fs::is_symlink("/dev/stdout"));
  const CommandResult folder = to(file(""));
  EXPECT_EQ(folder.exit_code, 74);
  EXPECT_THAT(folder.errors, HasSubstr("is not a regular file"));
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  const CommandResult through =
      run_command({"/bin/sh", "-c",
                   "cat \"$2\" & \"$0\" locate \"$1\" crossing --quiet --output \"$2\" >&2; wait",
                   kCommand, kPlanar, file("pipe")});
  EXPECT_THAT(through.output, HasSubstr("{\"summary\""));
  EXPECT_TRUE(fs::is_fifo(file("pipe")));
}

TEST_F(UserFiles, AnOutputMayBeALinkOrBeginWithAHyphen) {
  fs::create_symlink("target", file("link"));
  EXPECT_EQ(regulus({"locate", kPlanar, "crossing", "--quiet", "--output", file("link")}).exit_code,
            1);
  EXPECT_TRUE(fs::is_symlink(file("link")));
  EXPECT_THAT(file_contents(file("target")), HasSubstr("{\"summary\""));
  const CommandResult hyphen = after("cd " + folder_.path().string(),
                                     {"locate", kPlanar, "crossing", "--quiet", "--output=-lines"});
  EXPECT_EQ(hyphen.exit_code, 1) << hyphen.errors;
  EXPECT_TRUE(exists("-lines"));
}

/// A path need not be UTF-8, but JSON must be.
TEST_F(UserFiles, APathThatIsNotUtf8CostsNoVerdict) {
  const std::string model = file("r\xff\xfe.toml");
  fs::copy_file(kPlanar, model);
  const auto expect_json = [&](const Words& words, int exit_code) {
    const CommandResult result = regulus(words);
    EXPECT_EQ(result.exit_code, exit_code) << words[0] << ' ' << result.errors;
    EXPECT_TRUE(json::accept(result.output)) << words[0] << ' ' << result.output;
  };
  const std::string proof = file("proof\xff");
  expect_json({"check", model, "regular", "--json", "--certificate", proof}, 0);
  expect_json({"verify", proof, "--json", "--model", model}, 0);
  expect_json({"locate", model, "regular", "--json", "--output", file("lines\xff")}, 0);
  expect_json({"margin", model, "regular", "--json", "--tolerance", "base=0:0.1"}, 0);
  expect_json({"bound", model, "regular", "determinant", "--json", "--checkpoint", file("s\xff")},
              0);
  // Without npm the project has no page.
  const CommandResult page =
      regulus({"report", model, "regular", "--json", "--output", file("p\xff.html")});
  EXPECT_THAT(page.exit_code, testing::AnyOf(0, 74)) << page.errors;
  EXPECT_TRUE(json::accept(page.output)) << page.output;
  expect_json({"list", model, "--json"}, 0);
  expect_json({"explain", model, "regular", "--json"}, 0);
  const std::string arm = file("arm\xff.urdf");
  write_file(arm,
             "<robot name='a'><link name='l0'/><link name='l1'/><joint name='j' type='revolute'>"
             "<parent link='l0'/><child link='l1'/><axis xyz='0 0 1'/>"
             "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>");
  const CommandResult imported = regulus({"import", arm, "--json", "-o", file("out\xff.toml")});
  EXPECT_NE(imported.exit_code, 70) << imported.errors;
  EXPECT_TRUE(json::accept(imported.output)) << imported.output;
}

TEST_F(UserFiles, WhatATerminalWouldNotShowIsShownInPaths) {
  const std::string model = file("a\x1b[31m\xe2\x80\xae.toml");
  fs::copy_file(kPlanar, model);
  const CommandResult written =
      regulus({"check", model, "regular", "--certificate", file("proof\x1b[31m")});
  EXPECT_EQ(written.exit_code, 0) << written.errors;
  EXPECT_THAT(written.errors, AllOf(HasSubstr("proof\\x1b[31m"), Not(HasSubstr("\x1b"))));
  const CommandResult none = regulus({"check", file("none\x1b\xe2\x80\xae.toml")});
  EXPECT_THAT(none.errors, AllOf(HasSubstr("none\\x1b\\xe2\\x80\\xae.toml"), Not(HasSubstr("\x1b")),
                                 Not(HasSubstr("\xe2\x80\xae"))));
}

TEST_F(UserFiles, ANameThatTurnsTheDirectionOfWritingIsRefused) {
  std::string model = file_contents(kPlanar);
  const std::size_t name = model.find("name = \"");
  ASSERT_NE(name, std::string::npos);
  write_file(file("m.toml"), model.insert(name + 8, "\xe2\x80\xae"));
  const CommandResult result = regulus({"check", file("m.toml"), "regular"});
  EXPECT_EQ(result.exit_code, 65);
  EXPECT_THAT(result.errors, Not(HasSubstr("\xe2\x80\xae")));
}

TEST_F(UserFiles, ADepfileDoesNotNameAPathWithALineBreak) {
  const std::string model = file("a\nb.toml");
  fs::copy_file(kPlanar, model);
  const CommandResult result = regulus(
      {"generate", model, "regular", "-o", file("out"), "--name", "k", "--depfile", file("d")});
  EXPECT_EQ(result.exit_code, 74);
  EXPECT_THAT(result.errors, HasSubstr("--depfile: a rule cannot name a file whose path has a"));
  EXPECT_FALSE(exists("d"));
  EXPECT_FALSE(exists("out"));
}

TEST_F(UserFiles, ALimitOfMemoryEndsInASentence) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer needs more address space than any limit here";
#endif
  for (int limit = 60000; limit <= 320000; limit += 20000) {
    const CommandResult result =
        after("ulimit -v " + std::to_string(limit) + "; export XDG_CACHE_HOME=" + file("cache"),
              {"check", kRobot1, "wide_15", "--threads", "1", "--engine", "jit", "--quiet",
               "--max-boxes", "500", "--no-cache"});
    // The dynamic linker ends it with 127 if the program itself does not fit.
    EXPECT_THAT(result.exit_code, testing::AnyOf(0, 2, 74, 127)) << limit << ' ' << result.errors;
    EXPECT_THAT(result.errors, Not(HasSubstr("internal error"))) << limit;
  }
}

}  // namespace
}  // namespace regulus::detail::test
