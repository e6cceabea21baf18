// SPDX-License-Identifier: GPL-3.0-or-later
// Tests pavings as users see them: streams, exit codes, and boxes against a known curve.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <thread>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test::locate {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

CommandResult locate(std::vector<std::string> words) { return regulus({"locate"}, words); }

/// The boxes are on standard output.
CommandResult locate_boxes(std::vector<std::string> words) {
  words.insert(words.end(), {"--output", "-"});
  return locate(std::move(words));
}

struct Paving {
  json header;
  std::vector<json> boxes;
  json summary;
};

Paving parse(const std::string& text) {
  Paving paving;
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line)) {
    json object = json::parse(line);
    if (object.contains("regulus_paving"))
      paving.header = object;
    else if (object.contains("summary"))
      paving.summary = object["summary"];
    else
      paving.boxes.push_back(object);
  }
  return paving;
}

bool holds(const json& range, double x, double margin = 0) {
  return range[0].get<double>() + margin <= x && x <= range[1].get<double>() - margin;
}

/// The planar 3-RPR by its three lines of force: this vanishes if they meet or are parallel. For a
/// fixed orientation it is a polynomial of degree 2 in x and in y.
class LinesOfForce {
 public:
  explicit LinesOfForce(double phi) : c_(std::cos(phi)), s_(std::sin(phi)) {}

  [[nodiscard]] double at(double x, double y) const {
    const double u = (17.04 * 17.04 + 20.84 * 20.84 - 16.54 * 16.54) / (2 * 17.04);
    const double v = std::sqrt(20.84 * 20.84 - u * u);
    const double base[3][2] = {{0, 0}, {15.91, 0}, {0, 10}};
    const double platform[3][2] = {{0, 0}, {17.04, 0}, {u, v}};
    double m[3][3];
    for (int i = 0; i < 3; ++i) {
      m[i][0] = x + c_ * platform[i][0] - s_ * platform[i][1] - base[i][0];
      m[i][1] = y + s_ * platform[i][0] + c_ * platform[i][1] - base[i][1];
      m[i][2] = base[i][0] * m[i][1] - base[i][1] * m[i][0];
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }

  /// Returns the y of its zeros over x, from its values at three places.
  [[nodiscard]] std::vector<double> zeros_over(double x) const {
    const double below = at(x, -1), middle = at(x, 0), above = at(x, 1);
    const double a = (above + below) / 2 - middle, b = (above - below) / 2;
    const double d = b * b - 4 * a * middle;
    if (d < 0) return {};
    return {(-b - std::sqrt(d)) / (2 * a), (-b + std::sqrt(d)) / (2 * a)};
  }

 private:
  double c_, s_;
};

class PlanarSlice : public testing::Test {
 protected:
  static const Paving& paving() {
    static const Paving result =
        parse(locate_boxes({kPlanar, "crossing", "--range", "x=-20:20", "--range", "y=-15:25",
                            "--range", "phi=25*deg", "--resolution", "1/64"})
                  .output);
    return result;
  }
  const LinesOfForce curve_{25 * std::numbers::pi / 180};
};

TEST_F(PlanarSlice, HasNoPointOfTheCurveInAFreeBox) {
  int points = 0;
  for (int i = 0; i <= 4000; ++i) {
    const double x = -20 + 40 * (i + 0.37) / 4001;
    for (const double y : curve_.zeros_over(x)) {
      if (y < -15 || y > 25) continue;
      ++points;
      int found = 0;
      for (const json& box : paving().boxes) {
        found += holds(box["box"]["x"], x) && holds(box["box"]["y"], y);
        if (box["kind"] == "free") {
          ASSERT_FALSE(holds(box["box"]["x"], x, 1e-9) && holds(box["box"]["y"], y, 1e-9))
              << x << ' ' << y;
        }
      }
      EXPECT_GE(found, 1);
    }
  }
  EXPECT_GT(points, 3000);
}

TEST_F(PlanarSlice, HasTheCurveBetweenTwoPointsOfEverySingularBox) {
  int singular = 0;
  for (const json& box : paving().boxes) {
    if (box["kind"] != "singular") continue;
    ++singular;
    ASSERT_EQ(box["points"].size(), 2u);
    double sign = 1;
    for (const json& point : box["points"]) {
      const double x = point["parameters"]["x"][0], y = point["parameters"]["y"][0];
      EXPECT_TRUE(holds(box["box"]["x"], x) && holds(box["box"]["y"], y));
      EXPECT_TRUE(holds(point["determinant"], curve_.at(x, y), -1e-6)) << curve_.at(x, y);
      sign *= point["determinant"][0].get<double>() > 0 ? 1 : -1;
    }
    EXPECT_EQ(sign, -1);
  }
  EXPECT_GT(singular, 60);
}

TEST_F(PlanarSlice, ClosesInOnTheFirstSingularityItFound) {
  const json& witness = paving().summary["witness"];
  const json& near = witness["near"]["parameters"];
  const double x = near["x"][0], y = near["y"][0];
  EXPECT_NEAR(curve_.at(x, y), 0, 1e-9);
  EXPECT_EQ(witness["nullity"], 1);
  EXPECT_EQ(witness["rows"]["taking_part"].size(), 3u);
  for (const json& box : paving().boxes) {
    if (box["kind"] != "singular") continue;
    EXPECT_TRUE(holds(box["box"]["x"], x) && holds(box["box"]["y"], y));
    break;
  }
}

TEST_F(PlanarSlice, HasVolumesThatAddUpToItsOwn) {
  const json& summary = paving().summary;
  double lo = 0, hi = 0, boxes = 0;
  for (const char* kind : {"free", "singular", "undecided", "outside"}) {
    lo += summary[kind]["volume"][0].get<double>();
    hi += summary[kind]["volume"][1].get<double>();
    boxes += summary[kind]["boxes"].get<double>();
  }
  EXPECT_EQ(summary["volume"], json({1600.0, 1600.0}));
  EXPECT_EQ(lo, 1600);
  EXPECT_EQ(hi, 1600);
  EXPECT_EQ(boxes, paving().boxes.size());
  EXPECT_GT(summary["free"]["fraction"][0], 0.9);
}

TEST_F(PlanarSlice, IsSplitToItsResolutionAndNoFurther) {
  for (const json& box : paving().boxes)
    for (const char* axis : {"x", "y"}) {
      const double width = box["box"][axis][1].get<double>() - box["box"][axis][0].get<double>();
      EXPECT_GE(width, 40.0 / 64);
      if (box["kind"] != "free") {
        EXPECT_EQ(width, 40.0 / 64);
      }
    }
}

/// At the ends of phi the matrix is singular wherever the platform is, and no determinant changes its
/// sign: only algebra shows this, at one pose.
TEST(LocateCommand, SaysWhyTheBoxOfAWitnessIsUndecided) {
  const std::vector<std::string> turned = {
      kRobot1,        "wide_40", "--range", "z=48",    "--range",
      "psi=0",        "--range", "theta=0", "--range", "phi=-90*deg:90*deg",
      "--resolution", "1/8"};
  const CommandResult result = locate(turned);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.errors, HasSubstr("singular   0 %, 0 boxes"));
  EXPECT_THAT(result.errors,
              HasSubstr("note       algebra proved the witness after the ranges had been "
                        "divided, so its box stays undecided"));
  const CommandResult usual = locate({kPlanar, "crossing", "--resolution", "1/8"});
  EXPECT_THAT(usual.errors, testing::Not(HasSubstr("note ")));
}

TEST(Locate, BeginsWithAHeaderThatSaysWhatTheBoxesClaim) {
  const CommandResult result = locate_boxes({kPlanar, "regular", "--resolution", "1/4"});
  const Paving paving = parse(result.output);
  for (const char* key : {"regulus_paving", "model", "model_sha256", "motion", "parameters",
                          "alpha", "claims", "resolution"})
    EXPECT_TRUE(paving.header.contains(key)) << key;
  EXPECT_EQ(paving.header["parameters"][2]["unit"], "rad");
  EXPECT_EQ(paving.boxes.at(0)["kind"], "free");
  EXPECT_EQ(paving.boxes.at(0)["rule"], "h-matrix");
  EXPECT_EQ(paving.summary["verdict"], "no-singularity");
  EXPECT_TRUE(holds(paving.summary["free"]["fraction"], 1));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.errors,
              AllOf(HasSubstr("free       100 %"), testing::EndsWith("NO SINGULARITY\n")));
}

TEST(Locate, KeepsStandardOutputForOneThing) {
  const TemporaryDirectory folder;
  const std::string file = (folder.path() / "boxes.jsonl").string();
  const CommandResult to_file = locate({kPlanar, "crossing", "--output", file, "--quiet"});
  EXPECT_EQ(to_file.output, "SINGULARITY\n");
  EXPECT_EQ(to_file.errors, "");
  EXPECT_EQ(to_file.exit_code, 1);
  std::ifstream written(file);
  const Paving paving = parse({std::istreambuf_iterator<char>(written), {}});
  EXPECT_EQ(paving.summary["verdict"], "singularity");

  const CommandResult as_json = locate({kPlanar, "crossing", "--json", "--quiet"});
  EXPECT_EQ(json::parse(as_json.output)["singular"], paving.summary["singular"]);
  EXPECT_EQ(locate({kPlanar, "crossing", "--json", "--output", "-"}).exit_code, 64);
}

TEST(Locate, WritesBoxesOnlyIfAsked) {
  const CommandResult result = locate({kPlanar, "crossing", "--resolution", "1/8"});
  EXPECT_EQ(result.output, "SINGULARITY\n");
  EXPECT_THAT(result.errors, testing::Not(HasSubstr("map ")));
}

TEST(Locate, ListsWhatTheConstraintsExclude) {
  const Paving paving = parse(locate_boxes({kPlanar, "reach", "--range", "x=-4:4", "--range",
                                            "y=-2:14", "--range", "phi=0"})
                                  .output);
  double outside = 0;
  for (const json& box : paving.boxes) {
    if (box["kind"] != "outside") continue;
    ++outside;
    for (const json& x : box["box"]["x"])
      for (const json& y : box["box"]["y"])
        EXPECT_LT(std::hypot(x.get<double>(), y.get<double>()), 5);
  }
  EXPECT_GT(outside, 0);
  EXPECT_EQ(paving.summary["outside"]["boxes"], outside);
  EXPECT_THAT(paving.header["claims"]["free"], HasSubstr("that meets the constraints"));
}

TEST(Locate, ComparesWithAThreshold) {
  const CommandResult result =
      locate_boxes({kPlanar, "regular", "--range", "phi=0", "--alpha", "10"});
  const Paving paving = parse(result.output);
  EXPECT_EQ(paving.header["alpha"], 10.0);
  EXPECT_EQ(result.exit_code, 1);
  for (const json& box : paving.boxes) {
    if (box["kind"] != "singular") continue;
    ASSERT_EQ(box["points"].size(), 1u);
    EXPECT_LE(box["points"][0]["determinant"][1].get<double>(), 10);
    EXPECT_GE(box["points"][0]["determinant"][0].get<double>(), -10);
  }
}

TEST(Locate, CertifiesFreeBoxesForEveryUncertainValueAndSingularOnesForSome) {
  const std::vector<std::string> words{kPlanar,        "crossing", "--range", "phi=25*deg",
                                       "--range",      "x=-20:20", "--range", "y=-20:20",
                                       "--resolution", "1/32"};
  std::vector<std::string> tolerant = words;
  tolerant.insert(tolerant.end(), {"--tolerance", "base=0.3"});
  const Paving exact = parse(locate_boxes(words).output),
               loose = parse(locate_boxes(tolerant).output);
  EXPECT_LT(loose.summary["free"]["volume"][1], exact.summary["free"]["volume"][0]);
  EXPECT_GE(loose.summary["singular"]["boxes"], exact.summary["singular"]["boxes"]);
  EXPECT_EQ(loose.header["uncertain"].size(), 6u);
}

TEST(Locate, NamesTheExpressionThatIsUndefinedInABox) {
  const TemporaryDirectory folder;
  const std::string path = (folder.path() / "model.toml").string();
  std::ofstream(path) << "regulus = 1\nname = \"pole\"\nsource = \"a test\"\n"
                         "[pose]\nx = \"m\"\n"
                         "[matrix]\nrows = [[\"2 + 1/(x - 1)^2\"]]\n"
                         "[motion.across]\nx = [0, 3]\n";
  const CommandResult result = locate_boxes({path, "--resolution", "1/8"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors, HasSubstr("undefined  1/(-x + 1)^2, where -x + 1 in ["));
  int undefined = 0;
  for (const json& box : parse(result.output).boxes) {
    EXPECT_EQ(box["kind"] == "free", !holds(box["box"]["x"], 1));
    if (!box.contains("undefined")) continue;
    ++undefined;
    EXPECT_EQ(box["undefined"]["expressions"][0]["expression"], "1/(-x + 1)^2");
    EXPECT_TRUE(box["determinant"].is_null());
  }
  EXPECT_GE(undefined, 1);
}

TEST(Locate, ListsWhatABudgetLeftUnseen) {
  const CommandResult result = locate_boxes({kPlanar, "crossing", "--max-boxes", "40"});
  const Paving paving = parse(result.output);
  EXPECT_EQ(result.exit_code, 1);  // one singular pose was found
  EXPECT_LE(paving.summary["boxes"], 40);
  EXPECT_GE(paving.summary["boxes"], 27);
  EXPECT_GT(paving.summary["unfinished"]["boxes"], 0);
  EXPECT_THAT(paving.summary["stopped_by"], HasSubstr("number of boxes"));
  double boxes = 0;
  for (const char* kind : {"free", "singular", "undecided", "outside"})
    boxes += paving.summary[kind]["boxes"].get<double>();
  EXPECT_EQ(boxes, paving.boxes.size());
}

TEST(Locate, EndsWithASummaryWhenInterrupted) {
  const TemporaryDirectory folder;
  const std::string file = (folder.path() / "boxes.jsonl").string();
  RunningCommand running({kCommand, "locate", kRobot1, "wide_40", "--resolution", "1/1024",
                          "--engine", "interpreted", "--json", "--output", file, "--quiet"});
  std::this_thread::sleep_for(std::chrono::seconds(2));
  kill(running.pid(), SIGINT);
  const CommandResult result = running.wait();
  const json summary = json::parse(result.output);
  EXPECT_THAT(summary["stopped_by"], HasSubstr("interrupted"));
  EXPECT_GT(summary["unfinished"]["boxes"], 0);
}

TEST(Locate, RefusesWrongUseWith64) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {kPlanar, "regular", "--resolution", "0"},
           {kPlanar, "regular", "--resolution", "2"},
           {kPlanar, "regular", "--resolution", "fine"},
           {kPlanar, "regular", "--axes", "x"},
           {kPlanar, "regular", "--axes", "x,x"},
           {kPlanar, "regular", "--axes", "x,z"},
           {kPlanar, "regular", "--axes", "x,phi", "--range", "phi=0"},
           {kPlanar, "regular", "--picture", "paving.gif"},
           {kPlanar, "regular", "--uncertainty", "variables"},
           {kPlanar, "regular", "--picture", "p.svg", "--range", "x=0", "--range", "y=15",
            "--range", "phi=0"},
       })
    EXPECT_EQ(locate(words).exit_code, 64) << testing::PrintToString(words);
}

TEST(Locate, RefusesAFileThatCannotBeWrittenWith74) {
  EXPECT_EQ(locate({kPlanar, "regular", "--output", "/no/such/folder/boxes"}).exit_code, 74);
  EXPECT_EQ(locate({kPlanar, "regular", "--picture", "/no/such/folder/p.svg"}).exit_code, 74);
  const CommandResult full = locate({kPlanar, "crossing", "--output", "/dev/full"});
  EXPECT_EQ(full.exit_code, 74);
  EXPECT_THAT(full.errors, HasSubstr("/dev/full cannot be written"));
}

TEST(Locate, DrewThePictureOfTheManual) {
  std::ifstream file(REGULUS_SOURCE_DIR "/models/planar_3rpr.svg");
  const std::string picture{std::istreambuf_iterator<char>(file), {}};
  for (const char* legend : {"free 98.90 %", "singular 1.04 %", "undecided 0.06 %"})
    EXPECT_THAT(picture, HasSubstr(legend));
  EXPECT_LT(picture.size(), 60000u);
}

TEST(Locate, PavesAVarietyOfOnePose) {
  const CommandResult result = locate_boxes(
      {kPlanar, "regular", "--range", "x=0", "--range", "y=15", "--range", "phi=5*deg"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(parse(result.output).boxes.size(), 1u);
}

}  // namespace
}  // namespace regulus::detail::test::locate
