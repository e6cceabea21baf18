// SPDX-License-Identifier: GPL-3.0-or-later
// Runs one search by the command and kills it again and again, until it ends by itself.
#pragma once

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "tests/support/command.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {

/// True if a search is in the file of --checkpoint.
inline bool is_search_saved(const std::filesystem::path& file) {
  return file_contents(file).find("\"steps\"") != std::string::npos;
}

struct Interrupted {
  CommandResult last;
  std::string certificate;
  int continued = 0;  ///< runs that continued from a checkpoint
};

/// Runs the words with a checkpoint and a certificate, and kills each of the first `kills` runs
/// at a random moment.
inline Interrupted run_with_kills(const std::vector<std::string>& words, int kills, unsigned seed) {
  const TemporaryDirectory directory;
  const auto file = [&](const char* name) { return (directory.path() / name).string(); };
  std::vector<std::string> all = words;
  for (const std::string& word :
       {std::string("--checkpoint"), file("checkpoint"), std::string("--checkpoint-every"),
        std::string("0.002"), std::string("--certificate"), file("certificate")})
    all.push_back(word);
  std::mt19937 random(seed);
  Interrupted result;
  for (int kill = 0; kill < kills; ++kill) {
    result.continued += is_search_saved(file("checkpoint")) ? 1 : 0;
    RunningCommand run(all);
    // A kill before the search begins tests nothing; so it waits for the search, and a little more.
    for (int i = 0; i < 4000 && !is_search_saved(file("checkpoint")); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 60000));
    ::kill(run.pid(), SIGKILL);
    const CommandResult ended = run.wait();
    if (ended.exit_code < 0) continue;
    // The search had already ended; the next run starts from the beginning.
    EXPECT_EQ(ended.exit_code, 0) << ended.errors;
  }
  result.continued += is_search_saved(file("checkpoint")) ? 1 : 0;
  result.last = run_command(all);
  EXPECT_FALSE(std::filesystem::exists(file("checkpoint")));
  result.certificate = file_contents(file("certificate"));
  return result;
}

/// Expects from every continued run the verdict and certificate of a run without kills.
inline void expect_kills_change_nothing(int rounds, int kills_a_round) {
  const std::vector<std::string> words = {REGULUS_BINARY_DIR "/bin/regulus",
                                          "check",
                                          REGULUS_SOURCE_DIR "/models/robot_1.toml",
                                          "table6_15_15",
                                          "--tolerance",
                                          "base,platform=0.12"};
  const Interrupted undisturbed = run_with_kills(words, 0, 0);
  ASSERT_EQ(undisturbed.last.exit_code, 0) << undisturbed.last.errors;
  int continued = 0;
  for (int round = 0; round < rounds; ++round) {
    const Interrupted run =
        run_with_kills(words, kills_a_round, 1000U + static_cast<unsigned>(round));
    EXPECT_EQ(run.last.exit_code, 0) << run.last.errors;
    EXPECT_TRUE(run.certificate == undisturbed.certificate) << "round " << round;
    continued += run.continued;
  }
  EXPECT_GT(continued, 0);
}

}  // namespace regulus::detail::test
