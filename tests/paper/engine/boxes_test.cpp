// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds the number of boxes of method `auto` in the paper's tables, with and without uncertain
// geometry. Each case has two figures: the first is reached here; the second is needed by an
// H-matrix test on mean-value bounds with uncertain rows taken whole.
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/settings.hpp"
#include "runtime/search/solver.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus {
namespace {

struct BoxCase {
  const char* model;
  const char* motion;
  const char* tolerance;  ///< of base and platform
  std::uint64_t reached;
  std::uint64_t mean_value;
};

const BoxCase kBoxCases[] = {
    {"robot_1", "table4_1", "0", 1, 1},
    {"robot_1", "table4_2", "0", 1, 1},
    {"robot_1", "table4_5", "0", 1, 1},
    {"robot_1", "wide_15", "0", 5, 9},
    {"robot_1", "T1", "0", 1, 1},
    {"robot_1", "T2", "0", 1, 1},
    {"robot_2", "table5_20", "0", 7, 19},
    {"robot_2", "table5_30", "0", 39, 125},
    {"robot_1", "table6_5_5", "0.05", 1, 1},
    {"robot_1", "table6_5_15", "0.05", 15, 31},
    {"robot_1", "table6_15_15", "0.05", 83, 227},
    {"robot_1", "table6_5_5", "0.1", 1, 5},
    {"robot_1", "table6_5_15", "0.1", 79, 751},
    {"robot_1", "table6_15_15", "0.1", 1023, 17295},
    {"robot_2", "table5_20", "5", 11, 23},
    {"robot_2", "table5_20", "10", 15, 35},
    {"robot_2", "table5_20", "15", 19, 53},
    {"robot_2", "table5_20", "20", 31, 75},
    {"robot_2", "table5_20", "30", 43, 145},
    {"robot_2", "table5_20", "40", 81, 321},
    {"robot_2", "table5_20", "50", 159, 1137},
    {"robot_1", "T1_errors", "0.05", 1, 1},
    {"robot_1", "T2_errors", "0.05", 7, 31},
};

Result solved(const std::string& path, const BoxCase& c) {
  ModelOptions model;
  model.path = path;
  model.motion = c.motion;
  model.tolerances = {std::string("base,platform=") + c.tolerance};
  const PreparedSearch preparation = prepare(model, {});
  return solve(preparation.problem(), settings_from({}));
}

std::string path_of(const BoxCase& c) {
  return std::string(REGULUS_SOURCE_DIR "/models/") + c.model + ".toml";
}

class Boxes : public testing::TestWithParam<BoxCase> {};

TEST_P(Boxes, AreAtMostThoseOfMeanValueBounds) {
  const BoxCase& c = GetParam();
  const Result result = solved(path_of(c), c);
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity);
  // Another instruction set rounds differently, and may split a few boxes more or fewer.
  EXPECT_LE(result.statistics.boxes, std::min(c.mean_value, c.reached + c.reached / 16 + 2));
}

std::string name_of(const testing::TestParamInfo<BoxCase>& info) {
  std::string name =
      std::string(info.param.model) + "_" + info.param.motion + "_" + info.param.tolerance;
  for (char& c : name)
    if (c == '.') c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Tables, Boxes, testing::ValuesIn(kBoxCases), name_of);

TEST(BoxesOfBalls, AreFewerThanOfTheBoxesAroundThem) {
  const BoxCase c{"robot_1", "table6_15_15", "0.1", 495, 1831};
  const test::TemporaryDirectory directory;
  std::ifstream original(path_of(c));
  std::string text{std::istreambuf_iterator<char>(original), {}};
  text.replace(text.find("unit ="), 0, "tolerance_shape = \"ball\"\n");
  const std::string path = directory.path() / "balls.toml";
  std::ofstream(path) << text;
  const Result result = solved(path, c);
  EXPECT_EQ(result.verdict, Verdict::kNoSingularity);
  EXPECT_LE(result.statistics.boxes, 550U);
}

}  // namespace
}  // namespace regulus
