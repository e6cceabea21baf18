// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of a text report are those of the model file, and they determine a witness.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <string>

#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The matrix is singular where x = y.
constexpr const char* kModel = R"(regulus = 1
name = "r"
source = "a test"
[pose]
x = "1"
y = "1"
[geometry]
h = { value = 2, tolerance = 0.0001 }
[matrix]
rows = [["x", "y"], ["1", "h/2"]]
[motion.apart]
x = [0.1234567, 0.3]
y = [0.70000001, 1000000]
[motion.crossing]
x = [0.1234567, 0.3]
y = [0.2, 0.3]
[motion.angle]
x = ["10*deg", "20*deg"]
y = ["-20*deg", "-10*deg"]
)";

class ReportNumbers : public testing::Test {
 protected:
  ReportNumbers() {
    options_.path = directory_.path() / "model.toml";
    std::ofstream(options_.path) << kModel;
    search_.engine = Engine::kInterpreted;
    search_.use_cache = false;
  }

  std::string report_of(const std::string& motion) {
    options_.motion = motion;
    preparation_ = prepare(options_, search_);
    result_ = run_search(preparation_, search_, settings_from(search_));
    return text_report(preparation_, search_, result_);
  }

  const test::TemporaryDirectory directory_;
  ModelOptions options_;
  SearchOptions search_;
  PreparedSearch preparation_;
  Result result_;
};

TEST_F(ReportNumbers, OfAMotionAreThoseOfTheFile) {
  const std::string text = report_of("apart");
  EXPECT_THAT(text, HasSubstr("x in [0.1234567, 0.3]\n"));
  EXPECT_THAT(text, HasSubstr("y in [0.70000001, 1000000]\n"));
  EXPECT_THAT(text, HasSubstr("h in [1.9999, 2.0001]\n"));
}

TEST_F(ReportNumbers, OfAnOpenBoxAreThoseOfTheFileAtItsEnds) {
  search_.time_limit = 1e-9;
  EXPECT_THAT(report_of("apart"),
              HasSubstr("blocked    x in [0.1234567, 0.3], y in [0.70000001, 1000000]\n"));
}

TEST_F(ReportNumbers, OfAnAngleAreAsManyAsItTakes) {
  const std::string text = report_of("angle");
  EXPECT_THAT(text, HasSubstr("x in [0.17453292519943295, 0.3490658503988659]\n"));
  EXPECT_THAT(text, HasSubstr("y in [-0.3490658503988659, -0.17453292519943295]\n"));
}

TEST_F(ReportNumbers, OfAnAngleInRadiansAreInDegreesTooIfThoseAreShort) {
  std::ifstream file(options_.path);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const char* name : {"x = \"1\"", "y = \"1\""})
    text.replace(text.find(name), 7, std::string(1, *name) + " = \"rad\"");
  std::ofstream(options_.path) << text;
  EXPECT_THAT(report_of("angle"), AllOf(HasSubstr("0.3490658503988659] rad ([10, 20] deg)\n"),
                                        HasSubstr("-0.17453292519943295] rad ([-20, -10] deg)\n")));
  EXPECT_THAT(report_of("crossing"), HasSubstr("x in [0.1234567, 0.3] rad\n"));
}

TEST_F(ReportNumbers, OfAPointInABallAreAsFarAsItsRadius) {
  std::string text = kModel;
  text.insert(text.find("[matrix]"), "p = { value = [0, 1], radius = 0.05 }\n");
  text.replace(text.find("\"h/2\""), 5, "\"h/2 + p_1 + p_2\"");
  for (const char* radius : {"0.05", "0.07"}) {
    text.replace(text.find("radius = ") + 9, 4, radius);
    std::ofstream(options_.path) << text;
    EXPECT_THAT(report_of("apart"),
                HasSubstr(std::string("p_1 in [-") + radius + ", " + radius + "]\n"));
  }
  EXPECT_THAT(report_of("apart"), HasSubstr("p_2 in [0.93, 1.07]\n"));
}

TEST_F(ReportNumbers, DetermineTheWitness) {
  const std::string text = report_of("crossing");
  ASSERT_TRUE(result_.witness) << text;
  const WitnessPoint& point =
      result_.witness->near ? *result_.witness->near : result_.witness->points.front();
  EXPECT_EQ(point.variables[0].lo, point.variables[0].hi);
  const std::string start = "witness    x = ";
  const std::size_t place = text.find(start);
  ASSERT_NE(place, std::string::npos) << text;
  EXPECT_EQ(std::stod(text.substr(place + start.size())), point.variables[0].lo);
}

TEST(ProgressLine, HasABarPlainDigitsAndTheTimeLeft) {
  const SearchProgress progress{123456, 31, 0.5, 4, 60, ""};
  const std::string line = describe_progress(progress, 120);
  EXPECT_EQ(
      line,
      "[############------------] 50.00 % decided, 123 456 boxes, 31 waiting, 30 864 boxes/s, "
      "4.0 s, 56 s left");
}

TEST(ProgressLine, FitsIntoTheTerminal) {
  SearchProgress progress{123456, 31, 0.5, 4, std::numeric_limits<double>::infinity(), ""};
  EXPECT_EQ(describe_progress(progress, 70),
            "50.00 % decided, 123 456 boxes, 31 waiting, 30 864 boxes/s, 4.0 s");
  for (const double decided : {0.0, 0.999, 1.0, 1.5})
    for (std::size_t columns = 0; columns < 200; ++columns) {
      progress.decided = decided;
      EXPECT_LE(describe_progress(progress, columns).size(), columns);
    }
}

}  // namespace
}  // namespace regulus::detail
