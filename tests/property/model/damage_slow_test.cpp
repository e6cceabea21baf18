// SPDX-License-Identifier: GPL-3.0-or-later
// A hundred thousand damaged models of arms and of legs: each is a model, or is refused with its
// file and, if it is about the text, its line.
#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <vector>

#include "codegen/model/file/model_file.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/damage.hpp"

namespace regulus::detail::test {
namespace {

constexpr unsigned kFiles = 100'000;

const std::vector<std::string> kModels = {
    R"(regulus = 1
name = "two joints, by parameters of Denavit and Hartenberg"
[serial]
unit = "m"
convention = "standard-dh"
length_tolerance = 0.001
joints = [
  { name = "q1", d = 0.4, a = 0.3, alpha = "-pi/2" },
  { name = "q2", d = 0, a = 0.2, alpha = 0 },
]
tool = { xyz = [0, 0, 0.1] }
[motion.work]
q1 = [0, 1]
q2 = ["20*deg", "60*deg"]
)",
    R"(regulus = 1
name = "three joints, by origins"
[serial]
unit = "m"
joints = [
  { name = "q1", xyz = [0, 0, 0.16], axis = [0, 0, 1] },
  { name = "q2", type = "prismatic", xyz = [0, 0, 0.2], rpy = ["-pi/2", 0, 0] },
  { mimic = "q1", multiplier = 2, xyz = [0, -0.2, 0], rpy = ["pi/2", 0, 0] },
]
[motion.work]
q1 = [0, 1]
q2 = [0.1, 0.2]
)"};

const std::vector<std::string> kSplices = {"\"",
                                           "[",
                                           "]",
                                           "{",
                                           "}",
                                           "=",
                                           ".",
                                           ",",
                                           "(",
                                           ")",
                                           "^",
                                           "/",
                                           "-",
                                           "0",
                                           "nan",
                                           "inf",
                                           "1e999",
                                           "q1",
                                           "q2",
                                           "xyz",
                                           "rpy",
                                           "axis",
                                           "alpha",
                                           "theta",
                                           "mimic",
                                           "prismatic",
                                           "fixed",
                                           "modified",
                                           "\n",
                                           "\xff",
                                           "\\",
                                           "#",
                                           "'''",
                                           "true",
                                           "sqrt(",
                                           "pi",
                                           "deg",
                                           "10°",
                                           "1/0",
                                           "[serial]",
                                           "joints = []",
                                           "[0, 0, 0]",
                                           "tolerance = 1",
                                           "value",
                                           "limits",
                                           "d = 1",
                                           "x/(x-x)"};

/// Any exception but InputError escapes and fails the test.
TEST(AHundredThousandDamagedModels, OfArmsAreReadOrRefused) {
  unsigned models = 0, refused = 0, with_line = 0;
  for (unsigned seed = 0; seed < kFiles; ++seed) {
    const std::string text = Damage(seed, kSplices).done_to(kModels[seed % kModels.size()]);
    SCOPED_TRACE(text);
    try {
      const Model model = parse_model(text, "damaged");
      ASSERT_GE(model.matrix.rows(), model.matrix.cols());
      ASSERT_FALSE(model.pose.empty());
      ++models;
    } catch (const InputError& error) {
      const std::string why = error.what();
      ASSERT_EQ(why.rfind("damaged", 0), 0U) << why;
      ++refused;
      with_line += why.rfind("damaged:", 0) == 0;
    }
  }
  EXPECT_EQ(models + refused, kFiles);
  EXPECT_GT(models, kFiles / 50);
  EXPECT_GT(with_line, kFiles / 2);
  std::cout << models << " read, " << refused << " refused, " << with_line
            << " of them with a line\n";
}

}  // namespace
}  // namespace regulus::detail::test
