// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `regulus generate` as its users see it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

CommandResult generate(std::vector<std::string> words) { return regulus({"generate"}, words); }

TEST(GenerateCommand, ListsWhatItWrote) {
  const TemporaryDirectory folder;
  const CommandResult result =
      generate({kPlanar, "regular", "-o", folder.path().string(), "--isa", "avx2,avx512"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  std::string expected;
  for (const char* end :
       {".h", ".hpp", ".cpp", "_kernel.inc", "_avx512.cpp", "_avx2.cpp", "_portable.cpp"}) {
    const fs::path file = folder.path() / ("planar_3rpr_regular" + std::string(end));
    expected += file.string() + "\n";
    EXPECT_THAT(file_contents(file), StartsWith("// SPDX-License-Identifier: Apache-2.0")) << file;
  }
  EXPECT_EQ(result.output, expected);
}

TEST(GenerateCommand, ListsTheFilesAsJson) {
  const TemporaryDirectory folder;
  const CommandResult result = generate({kPlanar, "regular", "-o", folder.path().string(), "--name",
                                         "arm", "--isa", "portable", "--json"});
  const auto list = nlohmann::json::parse(result.output);
  EXPECT_EQ(list["name"], "arm");
  ASSERT_EQ(list["files"].size(), 5U);
  for (const std::string file : list["files"]) EXPECT_TRUE(fs::exists(file)) << file;
}

/// The texts differ only in the name and in the command in the first lines.
TEST(GenerateCommand, WritesTheTextThatExplainShows) {
  const TemporaryDirectory folder;
  ASSERT_EQ(
      generate({kPlanar, "regular", "-o", folder.path().string(), "--name", "generated"}).exit_code,
      0);
  const auto body = [](const std::string& text) { return text.substr(text.find("// Model ")); };
  const CommandResult shown = regulus({"explain", kPlanar, "regular", "--stage", "text"});
  EXPECT_EQ(body(file_contents(folder.path() / "generated_kernel.inc")), body(shown.output));
}

/// Addresses differ from process to process, and the order of GiNaC's terms depends on them.
TEST(GenerateCommand, WritesTheSameTextInEveryProcess) {
  const std::string hexapod = REGULUS_SOURCE_DIR "/models/hexapod_6rus.toml";
  const auto text = [&hexapod] {
    return regulus({"explain", hexapod, "orbit", "--stage", "text"}).output;
  };
  const std::string first = text();
  EXPECT_THAT(first, HasSubstr("regulus_kernel"));
  for (int run = 0; run < trials(1, 2); ++run) EXPECT_TRUE(text() == first) << "in run " << run;
}

TEST(GenerateCommand, WritesADependencyFile) {
  const TemporaryDirectory folder;
  const std::string dependencies = (folder.path() / "kernel.d").string();
  EXPECT_EQ(generate({kPlanar, "regular", "-o", folder.path().string(), "--name", "arm",
                      "--depfile", dependencies})
                .exit_code,
            0);
  EXPECT_THAT(file_contents(dependencies), StartsWith((folder.path() / "arm.h").string() + " "));
  EXPECT_THAT(file_contents(dependencies), HasSubstr(": " + kPlanar + "\n"));
}

TEST(GenerateCommand, CompilesTheKernelForEachInstructionSet) {
  const TemporaryDirectory folder;
  EXPECT_EQ(generate({kPlanar, "regular", "-o", folder.path().string(), "--name", "arm", "--isa",
                      "avx2", "--object"})
                .exit_code,
            0);
  for (const char* object : {"arm_avx2.o", "arm_portable.o"}) {
    const std::string bytes = file_contents(folder.path() / object);
    EXPECT_THAT(bytes, StartsWith("\x7f"
                                  "ELF"));
    EXPECT_THAT(
        bytes, HasSubstr(std::string("arm_self_test_") + (object[4] == 'a' ? "avx2" : "portable")));
  }
  EXPECT_FALSE(fs::exists(folder.path() / "arm_avx512.o"));
}

/// A command that was copied elsewhere has no plugin beside it.
TEST(GenerateCommand, WritesNothingWithoutACompilerForTheObject) {
  const TemporaryDirectory folder;
  const std::string out = (folder.path() / "out").string(), copy = folder.path() / "regulus";
  fs::copy_file(kCommand, copy);
  const CommandResult result =
      run_command({copy, "generate", kPlanar, "regular", "-o", out, "--object"});
  EXPECT_EQ(result.exit_code, 64);
  EXPECT_THAT(result.errors, HasSubstr("leave the option out"));
  EXPECT_FALSE(fs::exists(out));
}

TEST(GenerateCommand, HasAnExitCodeForEachKindOfTrouble) {
  const TemporaryDirectory folder;
  const std::string out = (folder.path() / "out").string();
  std::ofstream(folder.path() / "file") << "regulus = 1\n";
  const std::string file = (folder.path() / "file").string();
  EXPECT_EQ(generate({kPlanar, "regular"}).exit_code, 64);
  EXPECT_EQ(generate({kPlanar, "irregular", "-o", out}).exit_code, 64);
  EXPECT_EQ(generate({kPlanar, "regular", "-o", out, "--name", "for"}).exit_code, 64);
  EXPECT_EQ(generate({kPlanar, "regular", "-o", out, "--isa", "sse2"}).exit_code, 64);
  EXPECT_EQ(generate({file, "regular", "-o", out}).exit_code, 65);
  EXPECT_EQ(generate({out + ".toml", "regular", "-o", out}).exit_code, 74);
  EXPECT_EQ(generate({kPlanar, "regular", "-o", file}).exit_code, 74);
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace regulus::detail::test
