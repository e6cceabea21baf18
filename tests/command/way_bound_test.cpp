// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds, data sheets and loads along the way-points of a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// J⁻¹ = [1 x; 0 1] on 0 ≤ x ≤ 2, which the way covers in straight segments.
constexpr const char* kWayShear = R"toml(regulus = 1
name = "shear"
[pose]
x = "cm"
y = "cm"
[matrix]
rows = [["x + 3", "x*(x + 3)"], [0, 2]]
row_scale = ["1/(x + 3)", "1/2"]
[load.any]
force = [[-1, 1], [-1, 1]]
[twist.along]
velocity = [1, 1]
[actuators]
force = [-2, 2]
speed = 4
error = 0.1
stiffness = 2
[motion.m]
x = [0, 2]
y = 0
[motion.way]
waypoints = "way.csv"
y = 0
[motion.curve]
waypoints = "curve.csv"
interpolation = "cubic"
y = 0
)toml";

/// A cart on two cables: det J⁻¹ = 4y, and a wrench w needs the forces (w₁y − w₂(x − 4))/(4y) and
/// (w₂x − w₁y)/(4y).
constexpr const char* kCircleCart = R"toml(regulus = 1
name = "cart"
[pose]
x = "mm"
y = "mm"
[matrix]
twist = ["v_x", "v_y"]
rows = [["x", "y"], ["x - 4", "y"]]
[load.weight]
force = [1, -2]
[load.heavy]
force = [0, -9]
[actuators]
force = [-8, 8]
[motion.way]
waypoints = "circle.csv"
)toml";

constexpr const char* kMill = R"toml(regulus = 1
name = "mill"
[pose]
x = "mm"
y = "mm"
z = "mm"
[matrix]
rows = [["x", 0, 0], [0, "y", 0], [0, 0, 1]]
[motion.arc]
waypoints = "arc.gcode"
)toml";

constexpr int kCorners = 40;

struct Point {
  double x, y;
};

/// The way-points of the circle about (2, 2), as the file has them.
Point corner(int k) {
  const double angle = 2 * M_PI * k / kCorners;
  return {std::round(1e6 * (2 + std::cos(angle))) / 1e6,
          std::round(1e6 * (2 + 1.5 * std::sin(angle))) / 1e6};
}

/// The forces of the cart under [load.weight].
double largest_force(const Point& p) {
  const double first = (p.y + 2 * (p.x - 4)) / (4 * p.y), second = (-2 * p.x - p.y) / (4 * p.y);
  return std::max(std::abs(first), std::abs(second));
}

class WayBoundTest : public testing::Test {
 protected:
  WayBoundTest() {
    shear_ = file("shear.toml", kWayShear);
    cart_ = file("cart.toml", kCircleCart);
    file("way.csv", "t [s],x [cm]\n0,0\n1,0.5\n2,1\n3,1.25\n4,2\n");
    file("curve.csv", "t [s],x [cm]\n0,0\n1,0.5\n2,1\n3,1.5\n4,2\n");
    file("arc.gcode", "G21 G90\nG0 X3 Y2 Z0\nG3 X1 Y2 I-1 J0\nG1 X1 Y1\n");
    write_circle(-1);
  }

  std::string file(const std::string& name, const std::string& text) const {
    const std::string path = (folder_.path() / name).string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// Way-point `bad` is on the line of the winches.
  void write_circle(int bad) const {
    std::ostringstream text;
    text.precision(9);
    text << "t [s],x [mm],y [mm]\n";
    for (int k = 0; k <= kCorners; ++k)
      text << k << ',' << corner(k).x << ',' << (k == bad ? 0.0 : corner(k).y) << '\n';
    file("circle.csv", text.str());
  }

  static bool proves(const std::string& certificate) {
    return run_command({kVerify, certificate}).exit_code == 0;
  }
  static json bound(std::vector<std::string> words) {
    words.insert(words.begin(), "bound");
    words.insert(words.end(), {"--json", "--quiet", "--threads", "1"});
    const CommandResult r = regulus(words);
    EXPECT_NE(r.output, "") << r.errors;
    return json::parse(r.output);
  }

  std::string shear_, cart_;

 private:
  TemporaryDirectory folder_;
};

/// Both brackets contain the same number, and are as narrow as wanted.
TEST_F(WayBoundTest, AgreesWithTheBoxOfItsSegments) {
  const std::vector<std::vector<std::string>> quantities{{"force"},
                                                         {"force", "--min"},
                                                         {"force", "--signed", "--leg", "1"},
                                                         {"speed"},
                                                         {"error"},
                                                         {"sigma-min"},
                                                         {"sigma-max"},
                                                         {"condition"},
                                                         {"x^2"},
                                                         {"x - 7", "--min"},
                                                         {"-1 - x"},
                                                         {"determinant"},
                                                         {"deflection", "--freedom", "y"}};
  for (const auto& quantity : quantities) {
    std::vector<std::string> box{shear_, "m"}, way{shear_, "way"};
    box.insert(box.end(), quantity.begin(), quantity.end());
    way.insert(way.end(), quantity.begin(), quantity.end());
    const json a = bound(box), b = bound(way);
    ASSERT_TRUE(a["proved"].is_number() && b["proved"].is_number()) << quantity[0];
    const bool least = a["proved"] < a["attained"] || b["proved"] < b["attained"];
    const double sign = least ? -1 : 1;
    EXPECT_LE(sign * double(a["attained"]), sign * double(b["proved"])) << quantity[0];
    EXPECT_LE(sign * double(b["attained"]), sign * double(a["proved"])) << quantity[0];
    EXPECT_EQ(b["closed"], true) << quantity[0] << b.dump(1);
  }
}

TEST_F(WayBoundTest, NamesTheSegmentTheTimeAndThePose) {
  const CommandResult r = regulus({"bound", shear_, "way", "speed", "--leg", "1", "--gap", "1e-6"});
  EXPECT_EQ(r.exit_code, 0) << r.errors;
  EXPECT_THAT(r.output,
              testing::MatchesRegex("BETWEEN 2\\.9999[0-9]* AND 3(\\.0[0-9]*)? cm/s.*\n"));
  EXPECT_THAT(r.errors,
              testing::ContainsRegex("segment 4, t = 4 s \\(.*way.csv, lines 5 and 6\\)\n"));
  EXPECT_THAT(r.errors, HasSubstr("x = 2 cm, y = 0 cm\n"));
  const json place = bound({shear_, "way", "speed", "--leg", "1"})["components"][0]["place"];
  EXPECT_EQ(place["segment"]["segment"], 4);
  EXPECT_EQ(place["segment"]["lines"], json({5, 6}));
  EXPECT_FALSE(place["pose"].contains("r"));
}

TEST_F(WayBoundTest, BoundsSplines) {
  const json found = bound({shear_, "curve", "x", "--gap", "1e-5"});
  EXPECT_GE(double(found["proved"]), 2.0);
  EXPECT_LE(double(found["proved"]), 2.0001);
}

/// The arc is half a circle about (2, 2).
TEST_F(WayBoundTest, BoundsMovesInGCode) {
  const json found = bound({file("mill.toml", kMill), "arc", "x + y", "--gap", "1e-5"});
  EXPECT_GE(double(found["proved"]), 4 + std::sqrt(2.0));
  EXPECT_LE(double(found["proved"]), (4 + std::sqrt(2.0)) * 1.0001);
  EXPECT_EQ(found["components"][0]["place"]["segment"]["lines"], json({3, 3}));
}

TEST_F(WayBoundTest, NoSampleLeavesTheBracket) {
  const json found = bound({cart_, "way", "force", "--load", "weight"});
  double most = 0;
  for (int k = 0; k < kCorners; ++k)
    for (int i = 0; i <= 2500; ++i) {
      const double s = i / 2500.0;
      const Point a = corner(k), b = corner(k + 1);
      most = std::max(most, largest_force({a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)}));
    }
  EXPECT_LE(most, double(found["proved"]));
  EXPECT_GE(most, double(found["attained"]) * (1 - 1e-9));
  EXPECT_LE(double(found["proved"]), most * 1.011);
}

TEST_F(WayBoundTest, ATrajectoryThroughASingularPoseIsUnbounded) {
  write_circle(7);
  const CommandResult r = regulus({"bound", cart_, "way", "force", "--load", "weight"});
  EXPECT_THAT(r.output, HasSubstr("UNBOUNDED"));
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_THAT(r.errors, testing::AnyOf(HasSubstr("segment 7,"), HasSubstr("segment 8,")));
}

TEST_F(WayBoundTest, ComparesWithALimit) {
  const CommandResult within = regulus({"bound", shear_, "way", "speed", "--limit", "3.1"});
  EXPECT_EQ(within.output, "WITHIN\n");
  EXPECT_EQ(within.exit_code, 0);
  const CommandResult exceeded =
      regulus({"bound", shear_, "way", "speed", "--limit", "2.9", "--leg", "1"});
  EXPECT_EQ(exceeded.exit_code, 1);
  EXPECT_THAT(exceeded.output, HasSubstr("EXCEEDED"));
  EXPECT_THAT(exceeded.errors, HasSubstr("segment 4, t = "));
}

TEST_F(WayBoundTest, KeepsTheControlErrorsOfATube) {
  const json found = bound({shear_, "way", "x", "--tube", "x=0.25", "--gap", "1e-5"});
  EXPECT_GE(double(found["proved"]), 2.25);
  EXPECT_LE(double(found["proved"]), 2.2501);
  EXPECT_GE(double(found["attained"]), 2.2499);
}

TEST_F(WayBoundTest, ProvesBothEndsInCertificates) {
  const std::string proof = path("proof");
  const CommandResult r = regulus({"bound", cart_, "way", "force", "--load", "weight", "--leg", "1",
                                   "--min", "--certificate", proof});
  EXPECT_EQ(r.exit_code, 0) << r.errors;
  EXPECT_THAT(r.errors, HasSubstr("proof.leg_1.safe: safe at"));
  EXPECT_TRUE(proves(proof + ".leg_1.safe"));
  EXPECT_TRUE(proves(proof + ".leg_1.singular"));
  EXPECT_EQ(regulus({"verify", proof + ".leg_1.safe"}).exit_code, 0);

  std::ifstream input(proof + ".leg_1.safe");
  const std::string text{std::istreambuf_iterator<char>(input), {}};
  const std::size_t line = text.find("\nbound ") + 7;
  ASSERT_NE(line, std::string::npos + 7);
  const std::string number = text.substr(line, text.find('\n', line) - line);
  std::string larger = text;
  larger.replace(line, number.size(), number + " + 1000");
  const std::size_t claim = larger.find("> " + number + " at every pose");
  ASSERT_NE(claim, std::string::npos);
  larger.replace(claim + 2, number.size(), number + " + 1000");
  EXPECT_FALSE(proves(file("larger", larger)));
  std::string shorter = text;
  const std::size_t leaf = shorter.rfind("\nl ");
  shorter.erase(leaf, shorter.find('\n', leaf + 1) - leaf);
  EXPECT_FALSE(proves(file("shorter", shorter)));
  const std::size_t last = text.rfind("\npiece ");
  std::string moved = text;
  moved.replace(last, text.find('\n', last + 1) - last, "\npiece 2 | 0 | 0 | 1");
  EXPECT_FALSE(proves(file("moved", moved)));
}

TEST_F(WayBoundTest, ProvesItsNumbers) {
  const std::string proof = path("number");
  const CommandResult r = regulus({"bound", cart_, "way", "sigma-min", "--certificate", proof});
  EXPECT_EQ(r.exit_code, 0) << r.errors;
  for (const char* end : {".safe", ".singular"}) {
    const CommandResult ours = regulus({"verify", proof + end, "--model", cart_});
    EXPECT_EQ(ours.exit_code, 0) << end << ours.errors;
    EXPECT_THAT(ours.errors, HasSubstr("bound      about"));
    const CommandResult other = run_command({kVerify, proof + end, "--model", cart_});
    EXPECT_EQ(other.exit_code, 0) << end << other.errors;
    EXPECT_THAT(other.errors, HasSubstr("least singular value"));
  }
}

TEST_F(WayBoundTest, ThreadsAndCheckpointsChangeNothing) {
  const auto answer = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{"bound", cart_, "way", "force", "--load", "weight", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    const CommandResult r = regulus(words);
    EXPECT_EQ(r.exit_code, 0) << r.errors;
    json report = json::parse(r.output);
    for (const char* key : {"seconds", "question", "threads", "options"}) report.erase(key);
    for (json& component : report["components"]) component.erase("seconds");
    return report.dump(1);
  };
  const std::string once = answer({"--threads", "1"});
  EXPECT_EQ(answer({"--threads", "2"}), once);
  const std::string saved = path("saved");
  EXPECT_EQ(answer({"--checkpoint", saved}), once);
  EXPECT_EQ(answer({"--checkpoint", saved}), once);
  write_circle(3);
  const CommandResult other =
      regulus({"bound", cart_, "way", "force", "--load", "weight", "--checkpoint", saved});
  EXPECT_NE(other.exit_code, 0);
  EXPECT_THAT(other.errors, HasSubstr("another question"));
}

TEST_F(WayBoundTest, HasADatasheet) {
  const CommandResult r = regulus({"datasheet", shear_, "way", "--threads", "1"});
  EXPECT_THAT(r.output, HasSubstr("speed of the motors for along"));
  EXPECT_THAT(r.output, HasSubstr("least |det J⁻¹|"));
  EXPECT_THAT(r.output, HasSubstr("kept"));
}

TEST_F(WayBoundTest, HoldsALoadAlongTheWay) {
  const std::string proof = path("proof");
  const CommandResult held =
      regulus({"check", cart_, "way", "--load", "weight", "--certificate", proof});
  EXPECT_EQ(held.output, "FEASIBLE\n") << held.errors;
  EXPECT_EQ(held.exit_code, 0);
  EXPECT_THAT(held.errors, HasSubstr("at every pose of the 40 segments"));
  EXPECT_TRUE(proves(proof));
  std::ifstream input(proof);
  std::string text{std::istreambuf_iterator<char>(input), {}};
  text.replace(text.find("\nlimits -8 : 8"), 14, "\nlimits -1 : 1");
  EXPECT_FALSE(proves(file("weaker", text)));
}

/// At y = 0.5, on the lowest way-point, a cable needs 9·2/(4·0.5) = 9.
TEST_F(WayBoundTest, ShowsTheSegmentThatDoesNotHoldALoad) {
  const std::string proof = path("proof");
  const CommandResult lost =
      regulus({"check", cart_, "way", "--load", "heavy", "--certificate", proof});
  EXPECT_EQ(lost.output, "INFEASIBLE\n") << lost.errors;
  EXPECT_EQ(lost.exit_code, 1);
  EXPECT_THAT(lost.errors, testing::ContainsRegex("at         segment (2[6-9]|3[0-4]), t = "));
  EXPECT_TRUE(proves(proof));
  const json report =
      json::parse(regulus({"check", cart_, "way", "--load", "heavy", "--json", "--quiet"}).output);
  EXPECT_EQ(report["verdict"], "infeasible");
  EXPECT_TRUE(report["segment"]["segment"].is_number());
}

TEST_F(WayBoundTest, SaysThatTheConstraintsLeaveNoPose) {
  std::string text = kWayShear;
  text.replace(text.find("waypoints = \"way.csv\"\n"), 0, "constraints = [\"x + 1\"]\n");
  const std::string model = file("empty.toml", text);
  const CommandResult r = regulus({"bound", model, "way", "speed", "--leg", "1"});
  EXPECT_EQ(r.output, "NO POSE REMAINS\n") << r.errors;
  EXPECT_EQ(r.exit_code, 2);
}

/// The largest speed of leg 1 is 1 + x, and the constraint ends at x = 1.5, on the last segment.
TEST_F(WayBoundTest, LeavesOutPosesThatTheConstraintsExclude) {
  std::string text = kWayShear;
  text.replace(text.find("waypoints = \"way.csv\"\n"), 0, "constraints = [\"x - 1.5\"]\n");
  const json found =
      bound({file("part.toml", text), "way", "speed", "--leg", "1", "--gap", "1e-4"});
  EXPECT_GE(double(found["proved"]), 2.5);
  EXPECT_LE(double(found["proved"]), 2.501);
}

}  // namespace
}  // namespace regulus::detail::test
