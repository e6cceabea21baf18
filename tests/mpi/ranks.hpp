// SPDX-License-Identifier: GPL-3.0-or-later
// Runs regulus by one thread and regulus-mpi by many ranks, on one machine.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/interrupted_runs.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/support/trials.hpp"
#include "tests/support/turn_model.hpp"

namespace regulus::detail::test {

inline Words joined(Words first, const Words& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Open MPI leaks from modules that it unloads, which no suppression can name. What leaks elsewhere, leaks in one process, too.
inline Words without_leaks() {
#if defined(__SANITIZE_ADDRESS__)
  return {"-x", "ASAN_OPTIONS=detect_leaks=0"};
#else
  return {};
#endif
}

/// Open MPI refuses more ranks than processors, and the superuser, unless it is told otherwise.
inline Words ranks(int count, const Words& command) {
  const Words start = joined({MPIEXEC, "--oversubscribe", "--allow-run-as-root"}, without_leaks());
  return joined(joined(start, {"-n", std::to_string(count), REGULUS_BINARY_DIR "/bin/regulus-mpi"}),
                command);
}

/// Several numbers of ranks; the fast tests have one of them, which is no power of two.
inline std::vector<int> numbers_of_ranks(std::vector<int> all) {
  return trials(0, 1) == 1 ? std::move(all) : std::vector<int>{3};
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

/// Writes ring.toml with the motions "way" and "dip", around and across the circle where
/// det J⁻¹ = x² + y² − 1 vanishes. A check has more than 16 384 boxes.
inline void write_ring(const std::filesystem::path& folder) {
  std::ofstream(folder / "ring.toml") << R"toml(regulus = 1
name = "ring"
[pose]
x = "m"
y = "m"
[matrix]
twist = ["v_x", "v_y"]
rows = [["x^2 + y^2 - 1", 0], [0, 1]]
[load.push]
wrench = [1, 0]
[actuators]
force = [-3000, 3000]
[motion.way]
waypoints = "way.csv"
[motion.dip]
waypoints = "dip.csv"
)toml";
  constexpr int kPoints = 8000, kDip = 6000;
  for (const char* name : {"way.csv", "dip.csv"}) {
    std::ofstream way(folder / name);
    way.precision(12);
    way << "x,y\n";
    for (int i = 0; i <= kPoints; ++i) {
      const double angle = 6.2 * i / kPoints;
      const double radius = name[0] == 'd' && i == kDip ? 0.9999 : 1.0003;
      way << radius * std::cos(angle) << ',' << radius * std::sin(angle) << '\n';
    }
  }
}

}  // namespace regulus::detail::test
