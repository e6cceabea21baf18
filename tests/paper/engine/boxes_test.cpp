// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds the number of boxes of method `auto` for more uncertain geometry than the paper's tables have
// (table_rows.hpp). Each case has two figures: the first is reached here; the second is needed by an
// H-matrix test on mean-value bounds with uncertain rows taken whole.
#include <gtest/gtest.h>

#include <fstream>

#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/settings.hpp"
#include "runtime/search/solver.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

struct BoxCase {
  const char* model;
  const char* motion;
  const char* tolerance;  ///< of base and platform
  std::uint64_t reached;
  std::uint64_t mean_value;
};

const BoxCase kBoxCases[] = {
    {"robot_2", "table5_20", "40", 81, 321},
    {"robot_2", "table5_20", "50", 159, 1137},
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
}  // namespace regulus::detail
