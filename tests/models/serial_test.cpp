// SPDX-License-Identifier: GPL-3.0-or-later
// Arms by their joints: the twin of one with a written matrix, and their known singular poses.
#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>

#include "tests/models/jacobian.hpp"
#include "tests/models/paving.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

Point joints(Poses& poses, const Model& model) {
  Point point;
  for (const PoseParameter& p : model.pose) point[p.name] = poses.between(-3, 3);
  return point;
}

TEST(SerialArms, HaveTheDeterminantOfTheirTwin) {
  const ShippedModel twin("puma_560"), arm("puma_560_serial");
  Poses poses;
  for (int trial = 0; trial < 50; ++trial) {
    const Point point = joints(poses, arm.model());
    EXPECT_NEAR(std::fabs(approx_determinant(arm.matrix(point))),
                std::fabs(approx_determinant(twin.matrix(point))), 1e-14);
  }
}

TEST(SerialArms, HaveTheVerdictsOfTheirTwin) {
  const ShippedModel twin("puma_560"), arm("puma_560_serial");
  for (const Motion& motion : twin.model().motions)
    EXPECT_EQ(arm.verdict({motion.name}), twin.verdict({motion.name})) << motion.name;
}

TEST(SerialArms, SayInTheirClaimWhichMatrixTheyMean) {
  const ShippedModel arm("puma_560_serial");
  const auto report = arm.check({"dexterous"});
  EXPECT_EQ(report["claim"],
            "the full 6×6 forward Jacobian has full rank for every pose of the motion");
  EXPECT_EQ(report["matrix"], "forward Jacobian");
  EXPECT_EQ(report["matrix_notes"].back(), "its rank does not depend on q1, q4, q6");
}

/// Of the arm with three parallel axes: elbow, wrist, shoulder.
/// No sign changes where the Jacobian of seven joints loses rank: exact algebra shows it.
TEST(SerialArms, OfSevenJointsAreSingularWithTheElbowStretched) {
  const ShippedModel arm("seven_joints");
  const TemporaryDirectory folder;
  const std::string proof = folder.path() / "proof.txt";
  const auto report = arm.check({"stretched", "--certificate", proof});
  EXPECT_EQ(report["verdict"], "singularity");
  const auto& point = report["witness"]["points"][0];
  EXPECT_EQ(point["parameters"]["q4"], (std::vector<double>{0, 0}));
  EXPECT_TRUE(point["determinant"].is_null());
  const std::string verify = REGULUS_BINARY_DIR "/bin/regulus-verify";
  EXPECT_EQ(run_command({verify, proof}).output, "VERIFIED\n");
  std::stringstream text;
  text << std::ifstream(proof).rdbuf();
  std::string other = text.str();
  other.replace(other.rfind("0x0p+0"), 6, "0x1p-99");
  std::ofstream(proof) << other;
  EXPECT_NE(run_command({verify, proof}).output, "VERIFIED\n");
  EXPECT_EQ(arm.report("locate", {"stretched"})["verdict"], "singularity");
}

/// Shoulder and wrist lose a direction together where q2 = q6 = 0.
TEST(SerialArms, OfSevenJointsAreSafeUpToTheirSingularPoses) {
  const ShippedModel arm("seven_joints");
  EXPECT_EQ(arm.verdict({"table", "--range", "q2=0:80*deg", "--range", "q6=0:120*deg"}),
            "singularity");
  EXPECT_EQ(arm.verdict({"table", "--range", "q2=1*deg:80*deg", "--range", "q6=0:120*deg"}),
            "no-singularity");
}

TEST(SerialArms, HaveTheFactorsOfThreeParallelAxes) {
  const ShippedModel arm("three_parallel_axes");
  Poses poses;
  for (int trial = 0; trial < 50; ++trial) {
    const Point q = joints(poses, arm.model());
    const double q2 = q.at("q2"), q23 = q2 + q.at("q3"), q234 = q23 + q.at("q4");
    const double shoulder = 0.42 * std::cos(q2) + 0.39 * std::cos(q23) - 0.1 * std::sin(q234);
    EXPECT_NEAR(std::fabs(approx_determinant(arm.matrix(q))),
                std::fabs(0.42 * 0.39 * std::sin(q.at("q3")) * std::sin(q.at("q5")) * shoulder),
                1e-14);
  }
}

TEST(SerialArms, AreSingularExactlyAtElbowAndShoulder) {
  const ShippedModel arm("three_parallel_axes");
  const Paving paving(arm,
                      {"elbow", "--range", "q2=-170*deg:-20*deg", "--range", "q3=-50*deg:130*deg",
                       "--resolution", "1/32"},
                      "q2", "q3");
  paving.expect_to_agree_with([](double q2, double q3) {
    return std::sin(q3) * (0.42 * std::cos(q2) + 0.39 * std::cos(q2 + q3) -
                           0.1 * std::sin(q2 + q3 - std::acos(-1.0) / 2));
  });
  EXPECT_GT(paving.count("singular"), 30U);
  EXPECT_GT(paving.fraction("free"), 0.8);
}

/// The factors of the determinant of the Puma, with the largest lengths of their gradients.
struct KnownFactor {
  std::function<double(const Point&)> value;
  double steepest;
};
const std::vector<KnownFactor> kPumaFactors = {
    {[](const Point& q) { return std::sin(q.at("q5")); }, 1},
    {[](const Point& q) { return 0.0203 * std::sin(q.at("q3")) + 0.4331 * std::cos(q.at("q3")); },
     std::hypot(0.0203, 0.4331)},
    {[](const Point& q) {
       const double q23 = q.at("q2") + q.at("q3");
       return 0.4318 * std::cos(q.at("q2")) - 0.0203 * std::cos(q23) + 0.4331 * std::sin(q23);
     },
     0.4318 + std::sqrt(2) * std::hypot(0.0203, 0.4331)}};

/// The free boxes of a region of all six joints.
std::vector<nlohmann::json> free_boxes_of_puma() {
  const std::vector<std::string> words = {REGULUS_BINARY_DIR "/bin/regulus",
                                          "locate",
                                          ShippedModel("puma_560_serial").path(),
                                          "dexterous",
                                          "--range",
                                          "q2=-180*deg:0",
                                          "--range",
                                          "q3=-40*deg:130*deg",
                                          "--range",
                                          "q5=-90*deg:100*deg",
                                          "--resolution",
                                          "1/64",
                                          "--threads",
                                          "1",
                                          "--output",
                                          "-"};
  std::istringstream lines(run_command(words).output);
  std::vector<nlohmann::json> boxes;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("{\"kind\":\"free\"")) boxes.push_back(nlohmann::json::parse(line)["box"]);
  return boxes;
}

bool holds(const std::vector<nlohmann::json>& boxes, const Point& q) {
  return std::ranges::any_of(boxes, [&q](const nlohmann::json& box) {
    return std::ranges::all_of(q, [&box](const auto& x) {
      return box[x.first][0] < x.second && x.second < box[x.first][1];
    });
  });
}

TEST(SerialArms, AreCertifiedFartherThanFiveDegreesFromTheirSingularPoses) {
  const std::vector<nlohmann::json> boxes = free_boxes_of_puma();
  ASSERT_FALSE(boxes.empty());
  for (const nlohmann::json& box : boxes)
    for (const char* idle : {"q1", "q4", "q6"})
      ASSERT_GT(box[idle][1].get<double>() - box[idle][0].get<double>(), 4.8) << "never split";
  Poses poses;
  constexpr double kDegree = 0.017453292519943295;
  int far = 0, certified = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Point q = {{"q2", poses.between(-180, 0) * kDegree},
               {"q3", poses.between(-40, 130) * kDegree},
               {"q5", poses.between(-90, 100) * kDegree}};
    const bool is_far = std::ranges::all_of(kPumaFactors, [&q](const KnownFactor& f) {
      return std::fabs(f.value(q)) > 5 * kDegree * f.steepest;
    });
    far += is_far ? 1 : 0;
    certified += is_far && holds(boxes, q) ? 1 : 0;
    Point wrist = q, elbow = q;
    wrist["q5"] = 0;
    elbow["q3"] = std::atan2(0.4331, -0.0203);
    EXPECT_FALSE(holds(boxes, wrist));
    EXPECT_FALSE(holds(boxes, elbow));
  }
  EXPECT_GT(far, 200);
  EXPECT_GE(certified, 0.99 * far);
}

/// Four axes are parallel if the sines and cosines of the twists are known exactly; the Jacobian then
/// loses a row at no pose.
std::string four_parallel_axes(const std::string& twist) {
  const std::string axis = ", axis = [0, \"sin(" + twist + ")\", \"cos(" + twist + ")\"] },\n",
                    twice = ", axis = [0, \"sin(2*" + twist + ")\", \"cos(2*" + twist + ")\"] },\n";
  const std::string turned = ", rpy = [\"" + twist + "\", 0, 0]";
  return "regulus = 1\nname = \"arm\"\n[serial]\njoints = [\n"
         "{ name = \"q1\", xyz = [0, 0, 0.4]" +
         turned + axis + "{ name = \"q2\", xyz = [0.3, 0, 0]" + axis +
         "{ name = \"q3\", xyz = [0.25, 0, 0]" + turned + twice +
         "{ name = \"q4\", xyz = [0.15, 0, 0]" + twice +
         "{ name = \"q5\", xyz = [0.1, 0, 0], axis = [0, 1, 0] },\n"
         "{ name = \"q6\", xyz = [0.1, 0, 0], axis = [1, 0, 0] },\n]\n[motion.m]\n"
         "q1 = [0.2, 0.4]\nq2 = [0.5, 0.7]\nq3 = [0.5, 0.7]\nq4 = [0.5, 0.7]\n"
         "q5 = [0.5, 0.7]\nq6 = [0.2, 0.3]\n";
}

TEST(SerialArms, WithTwistsThatAreTenthsOfHalfATurnAreComparedWithTheirFile) {
  const TemporaryDirectory folder;
  const std::string file = (folder.path() / "arm.toml").string(),
                    proof = (folder.path() / "proof").string();
  for (const char* twist : {"18*deg", "30*deg", "36*deg", "72*deg", "108*deg"}) {
    std::ofstream(file) << four_parallel_axes(twist);
    const CommandResult checked = run_command(
        {REGULUS_BINARY_DIR "/bin/regulus", "check", file, "m", "--certificate", proof});
    EXPECT_EQ(checked.output, "NO SINGULARITY\n") << twist << checked.errors;
    EXPECT_NE(checked.errors.find("6×5"), std::string::npos) << checked.errors;
    EXPECT_EQ(run_command({kVerify, proof, "--model", file}).output, "VERIFIED\n") << twist;
  }
}

}  // namespace
}  // namespace regulus::detail::test
