// SPDX-License-Identifier: GPL-3.0-or-later
// The emitted text, byte for byte. To accept a change:
//   REGULUS_UPDATE_GOLDEN=1 golden_emit
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "codegen/kernel/cpp/emit.hpp"
#include "tests/support/files.hpp"
#include "tests/support/sample_modules.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

constexpr const char* kOutputVariable = "REGULUS_EMIT_TO";

std::string emit_sample(const Module& module) {
  EmitOptions options;
  options.prefix = module.model;
  options.command = "regulus generate " + module.model + ".toml -o generated";
  options.operations_per_part = 24;
  options.manifest = true;
  const EmittedKernel kernel = emit(module, options);
  return kernel.source + kernel.manifest;
}

void expect_golden(const std::string& name, const std::string& text) {
  const std::filesystem::path path =
      std::filesystem::path(REGULUS_SOURCE_DIR) / "tests/golden/cpp" / (name + ".txt");
  if (std::getenv("REGULUS_UPDATE_GOLDEN") != nullptr)
    std::ofstream(path, std::ios::binary) << text;
  EXPECT_EQ(file_contents(path), text) << "to accept: REGULUS_UPDATE_GOLDEN=1 bin/golden_emit";
}

TEST(EmittedText, OfAPlanarArmIsAsRecorded) {
  expect_golden("planar", emit_sample(planar_module()));
}

TEST(EmittedText, OfEveryOperationIsAsRecorded) {
  expect_golden("everything", emit_sample(everything_module()));
}

TEST(EmittedText, OfAFunctionInPartsIsAsRecorded) {
  expect_golden("long", emit_sample(long_module(16)));
}

std::string emit_samples() {
  std::string text;
  for (const Module& module : {planar_module(), everything_module(), long_module(150)})
    text += emit_sample(module);
  return text;
}

/// Run by IsTheSameInEveryProcess in processes of their own, with the path to write to.
TEST(EmittedText, CanBeWrittenToAFile) {
  const TemporaryDirectory directory;
  const char* wanted = std::getenv(kOutputVariable);
  const std::filesystem::path path =
      wanted ? std::filesystem::path(wanted) : directory.path() / "0";
  std::ofstream(path, std::ios::binary) << emit_samples();
  EXPECT_EQ(file_contents(path), emit_samples());
}

bool run_in_another_process(const std::filesystem::path& output) {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe");
  const pid_t child = ::fork();
  if (child == 0) {
    ::setenv(kOutputVariable, output.c_str(), 1);
    const int quiet = ::dup2(::fileno(std::fopen("/dev/null", "w")), STDOUT_FILENO);
    ::execl(self.c_str(), self.c_str(), "--gtest_filter=EmittedText.CanBeWrittenToAFile",
            static_cast<char*>(nullptr));
    std::_Exit(quiet < 0 ? 1 : 2);
  }
  int status = 0;
  return child > 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) &&
         WEXITSTATUS(status) == 0;
}

TEST(EmittedText, IsTheSameInEveryProcess) {
  const TemporaryDirectory directory;
  const std::string expected = emit_samples();
  for (int i = 0; i < 20; ++i) {
    const std::filesystem::path output = directory.path() / std::to_string(i);
    ASSERT_TRUE(run_in_another_process(output));
    ASSERT_EQ(file_contents(output), expected);
  }
}

}  // namespace
}  // namespace regulus::detail::test
