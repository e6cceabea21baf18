// SPDX-License-Identifier: GPL-3.0-or-later
// Runs regulus by one thread and regulus-mpi by many ranks, on one machine.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/support/turn_model.hpp"

namespace regulus::test {

inline Words joined(Words first, const Words& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Open MPI refuses more ranks than processors, and the superuser, unless it is told otherwise.
inline Words ranks(int count, const Words& command) {
  return joined({MPIEXEC, "--oversubscribe", "--allow-run-as-root", "-n", std::to_string(count),
                 REGULUS_BINARY_DIR "/bin/regulus-mpi"},
                command);
}

inline Words one_thread(const Words& command) {
  return joined(joined({REGULUS_BINARY_DIR "/bin/regulus"}, command), {"--threads", "1"});
}

inline std::string model(const std::string& name) {
  return REGULUS_SOURCE_DIR "/models/" + name + ".toml";
}

/// A bracket with searches of more than 16 384 boxes.
inline Words long_bound() {
  return {"bound", model("robot_1"), "table4_5", "error",        "--freedom",
          "w_x",   "--gap",          "0.03",     "--time-limit", "600"};
}

/// Writes the model to a file. Returns the search of its condition number, of more than 16 384 boxes.
inline Words long_condition(const std::string& file, const std::string& gap) {
  std::ofstream(file) << kTurn;
  return {"bound", file, "condition", "--norm", "2", "--gap", gap, "--time-limit", "600"};
}

/// A proof of 110 665 boxes.
inline Words long_check() { return {"check", model("robot_1"), "table4_5", "--method", "jk"}; }

}  // namespace regulus::test
