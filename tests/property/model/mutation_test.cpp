// SPDX-License-Identifier: GPL-3.0-or-later
// A damaged model file gives a model or an InputError, and nothing else.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "codegen/model/file/model_file.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/example_model.hpp"

namespace regulus::detail {
namespace {

const std::vector<std::string> kSplices = {
    "\"",    "[",   "]",    "{",          "}",          "=",      ".",     ",",
    "(",     ")",   "^",    "/",          "-",          "0",      "nan",   "inf",
    "1e999", "x",   "phi",  "[gough]",    "[[matrix]]", "\n",     "\xff",  "\\",
    "#",     "'''", "true", "1979-05-27", "sqrt(",      "a2",     "rho_1", "regulus = 1\n",
    "value", "^-1", "/0",   "\"1/x\"",    "pi",         "x/(x-x)"};

/// Returns whether the text was accepted; any other exception escapes and fails the test.
bool accepted(const std::string& text) try {
  const Model model = parse_model(text, "mutant");
  EXPECT_GE(model.matrix.rows(), model.matrix.cols());
  EXPECT_FALSE(model.pose.empty());
  for (const Motion& motion : model.motions) {
    EXPECT_EQ(motion.pose.size(), model.pose.size());
    EXPECT_EQ(motion.error.size(), model.pose.size());
  }
  return true;
} catch (const InputError& error) {
  EXPECT_EQ(std::string(error.what()).rfind("mutant", 0), 0U) << error.what();
  return false;
}

void expect_only_input_errors(const std::string& text, unsigned trials) {
  unsigned models = 0;
  for (unsigned seed = 0; seed < trials; ++seed) {
    const std::string mutant = test::Damage(seed, kSplices).done_to(text);
    SCOPED_TRACE(mutant);
    EXPECT_NO_THROW(models += accepted(mutant));
  }
  EXPECT_GT(models, trials / 200);
  EXPECT_LT(models, trials);
}

std::string file(const std::string& name) {
  std::stringstream text;
  const std::string path = std::string(REGULUS_SOURCE_DIR).append("/models/").append(name);
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(DamagedModel, ExampleGivesAModelOrAnInputError) {
  expect_only_input_errors(test::kExample, 6000);
}

TEST(DamagedModel, GoughPlatformGivesAModelOrAnInputError) {
  expect_only_input_errors(test::kExampleGough, 2000);
}

TEST(DamagedModel, PlanarRobotGivesAModelOrAnInputError) {
  expect_only_input_errors(file("planar_3rpr.toml"), 2000);
}

TEST(DamagedModel, SerialArmGivesAModelOrAnInputError) {
  expect_only_input_errors(file("scara.toml"), 2000);
  expect_only_input_errors(file("seven_joints.toml"), 500);
}

TEST(DamagedModel, NoiseGivesAnInputError) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text;
    for (int i = 0; i < 200; ++i) text += static_cast<char>(random() % 256);
    EXPECT_FALSE(accepted(text));
  }
}

}  // namespace
}  // namespace regulus::detail
