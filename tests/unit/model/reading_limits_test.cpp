// SPDX-License-Identifier: GPL-3.0-or-later
// The reading of a model ends: by its own limits, by a time limit, or by an interrupt.
#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "codegen/model/file/model_file.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail::test {
namespace {

const char* const kGeneralTurns =
    "joints = [{ name = \"q1\", xyz = [0.1, 0.2, 0.3], rpy = [0.21, 0, 0.73] },\n"
    "{ name = \"q2\", xyz = [-0.4, 0.5, 0.6], rpy = [-0.52, 0, 0.91] },\n"
    "{ name = \"q3\", xyz = [0.7, -0.8, 0.9], rpy = [0.63, 0, -0.37] },\n"
    "{ name = \"q4\", xyz = [0.3, 0.2, -0.1], rpy = [-0.84, 0, 0.58] }]\n";

/// Exact elimination of its rows took minutes. None depends on others, and doubles show that.
TEST(AReading, EndsForAnArmWithGeneralTurns) {
  const Model model =
      parse_model("regulus = 1\nname = \"arm\"\n[serial]\n" + std::string(kGeneralTurns) +
                      "[motion.zero]\nq1 = 0\nq2 = 0\nq3 = 0\nq4 = 0\n",
                  "arm.toml");
  EXPECT_EQ(model.matrix.rows(), 6U);
}

TEST(AReading, IsStoppedByItsWatch) {
  const std::string serial = "[serial]\n" + std::string(kGeneralTurns);
  std::string let = "[pose]\nx = \"1\"\n[matrix]\nrows = [[\"a0*x\"]]\n[let]\na13 = \"x + 1\"\n";
  for (int i = 0; i < 13; ++i) {
    const std::string next = "a" + std::to_string(i + 1);
    let += "a" + std::to_string(i) + " = \"" + next + "*" + next + " + x\"\n";
  }
  const std::atomic<bool> interrupt{true};
  const FormingWatch late{.deadline = FormingWatch::Clock::now()};
  const FormingWatch interrupted{.interrupt = &interrupt};
  for (const std::string& section : {serial, let})
    for (const FormingWatch* watch : {&late, &interrupted}) {
      const std::string text = "regulus = 1\nname = \"m\"\n" + section;
      try {
        static_cast<void>(parse_model(text, "m.toml", {}, watch));
        ADD_FAILURE() << text;
      } catch (const FormingStopped& stopped) {
        EXPECT_EQ(stopped.interrupted, watch == &interrupted);
      } catch (const InputError& error) {
        ADD_FAILURE() << text << error.what();
      }
    }
}

TEST(AReading, OfASmallModelIsNotStopped) {
  const FormingWatch late{.deadline = FormingWatch::Clock::now()};
  const Model model = parse_model(
      "regulus = 1\nname = \"m\"\n[pose]\nx = \"1\"\n[matrix]\nrows = [[\"x\"]]\n[motion.m]\nx = "
      "0\n",
      "m.toml", {}, &late);
  EXPECT_EQ(model.matrix.rows(), 1U);
}

}  // namespace
}  // namespace regulus::detail::test
