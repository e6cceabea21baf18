// SPDX-License-Identifier: GPL-3.0-or-later
// A hundred thousand damaged files of each format: each is a model that can be read, or is refused
// with the file's name, within seconds.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <string>

#include "codegen/model/import/import.hpp"
#include "codegen/support/errors.hpp"
#include "tests/property/import/damage.hpp"
#include "tests/support/robots/robot_file.hpp"

namespace regulus::detail::test {
namespace {

constexpr unsigned kFiles = 100'000;
constexpr double kLongest = 20;  ///< seconds for one file, on a busy machine

struct Counts {
  unsigned models = 0, refused = 0, with_line = 0, usage = 0;
  double longest = 0;
};

/// Any other exception escapes and fails the test.
void read(const std::string& text, Counts& counts) try {
  const Imported imported = import_robot(text, "damaged", {});
  ++counts.models;
  EXPECT_FALSE(imported.report().empty());
} catch (const InputError& error) {
  const std::string why = error.what();
  EXPECT_EQ(why.rfind("damaged", 0), 0U) << why;
  ++counts.refused;
  counts.with_line += why.rfind("damaged:", 0) == 0;
} catch (const UsageError&) {
  ++counts.usage;
}

/// Reads `count` damaged copies of the files, with the seeds from `first` on.
void read_damaged(const std::vector<std::string>& files, unsigned first = 0,
                  unsigned count = kFiles) {
  Counts counts;
  for (unsigned seed = first; seed < first + count; ++seed) {
    const std::string text = damaged_robot(seed, robot_text(files[seed % files.size()]));
    const auto start = std::chrono::steady_clock::now();
    read(text, counts);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    counts.longest = std::max(counts.longest, seconds.count());
    ASSERT_LT(seconds.count(), kLongest) << "seed " << seed << " of " << files[0];
  }
  EXPECT_EQ(counts.models + counts.refused + counts.usage, count);
  EXPECT_GT(counts.models, count / 20);
  EXPECT_GT(counts.with_line, count / 20);
  std::cout << files[0] << ": " << counts.models << " read, " << counts.refused << " refused, "
            << counts.with_line << " of them with a line, " << counts.usage
            << " need an option; at most " << counts.longest << " s\n";
}

TEST(AHundredThousandDamagedFiles, OfUrdfAreReadOrRefused) {
  read_damaged({"mh5.urdf", "ur5e.urdf", "panda.urdf", "hexapod.urdf"});
}

// Two tests, since a hexapod in this format takes long to read, and each test has a limit of time.
TEST(AHundredThousandDamagedFiles, OfMjcfAreReadOrRefused) {
  read_damaged({"arm.mjcf", "hexapod.mjcf"}, 0, kFiles / 2);
}

TEST(AHundredThousandDamagedFiles, OfMjcfAreReadOrRefusedToTheLast) {
  read_damaged({"arm.mjcf", "hexapod.mjcf"}, kFiles / 2, kFiles / 2);
}

TEST(AHundredThousandDamagedFiles, OfSdfAreReadOrRefused) {
  read_damaged({"arm.sdf", "hexapod.sdf"});
}

}  // namespace
}  // namespace regulus::detail::test
