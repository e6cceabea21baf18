// SPDX-License-Identifier: GPL-3.0-or-later
// Robots by their legs: the twins of those with a written matrix, and rows against the screws of each
// joint of a leg.
#include <fstream>
#include <sstream>

#include "tests/models/posed_leg.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test::legs {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  return (std::stringstream() << file.rdbuf()).str();
}

std::string motions_of(const std::string& model) {
  const std::string text = text_of(REGULUS_SOURCE_DIR "/models/" + model + ".toml");
  return text.substr(text.find("[motion."));
}

class Twins : public testing::TestWithParam<const char*> {};

TEST_P(Twins, HaveTheVerdictsOfTheWrittenMatrixInNoMoreBoxes) {
  const std::string name = GetParam();
  const ShippedModel written(name);
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "legs.toml";
  std::ofstream(path) << text_of(REGULUS_SOURCE_DIR "/tests/models/legs/" + name + ".toml")
                      << motions_of(name);
  for (const Motion& motion : written.model().motions) {
    const auto expected = written.check({motion.name});
    const auto got = nlohmann::json::parse(
        run_command({REGULUS_BINARY_DIR "/bin/regulus", "check", path, motion.name, "--json"})
            .output);
    EXPECT_EQ(got["verdict"], expected["verdict"]) << motion.name;
    EXPECT_LE(got["boxes"], expected["boxes"]) << motion.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Models, Twins,
                         testing::Values("planar_3rpr", "planar_3rrr", "tsai_3upu", "delta",
                                         "octahedral", "hexapod_6rus"),
                         [](const auto& twin) { return std::string(twin.param); });

/// The verifier reads the numbers of the legs itself.
TEST(Legs, OfACertificateAreThoseOfTheFile) {
  const TemporaryDirectory folder;
  const std::string model = folder.path() / "legs.toml", proof = folder.path() / "proof";
  const std::string text =
      text_of(REGULUS_SOURCE_DIR "/tests/models/legs/planar_3rrr.toml") + motions_of("planar_3rrr");
  std::ofstream(model) << text;
  ASSERT_EQ(run_command({REGULUS_BINARY_DIR "/bin/regulus", "check", model, "regular",
                         "--certificate", proof, "--quiet"})
                .exit_code,
            0);
  const std::vector<std::string> verify = {REGULUS_BINARY_DIR "/bin/regulus-verify", proof,
                                           "--model", model};
  const CommandResult same = run_command(verify);
  EXPECT_EQ(same.exit_code, 0) << same.output;
  EXPECT_EQ((same.output + same.errors).find("lines 'value'"), std::string::npos) << same.output;
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"crank = 25", "crank = 26"},
                                 {"base = [60, 0]", "base = [60, 1e-9]"},
                                 {"platform = [0, 10]", "platform = [0, 11]"},
                                 {"rod = 25", "rod = 25\nrod_tolerance = 1"}}) {
    std::string other = text;
    std::ofstream(model) << other.replace(other.find(from), from.size(), to);
    const CommandResult result = run_command(verify);
    EXPECT_EQ(result.exit_code, 1) << to;
    EXPECT_NE((result.output + result.errors).find("the certificate is not about"),
              std::string::npos)
        << to;
  }
}

const std::string kOtherPlanarLegs =
    "[[legs.leg]]\ntype = \"RPR\"\nbase = [3, 0]\nplatform = [1, 0]\n"
    "[[legs.leg]]\ntype = \"RPR\"\nbase = [0, 5]\nplatform = [0, 1]\n";

/// A planar leg with its first joint at A, rods of random lengths, and the platform at random.
Posed planar_leg(Poses& random, const std::string& type, int actuated) {
  const Vector<double> A = {random.between(-1, 1), random.between(-1, 1), 0};
  const Vector<double> b = {random.between(-1, 1), random.between(-1, 1), 0};
  const double first = random.between(1, 2), rod = random.between(1, 2);
  const double angle = random.between(0, 360), elbow = random.between(20, 160),
               phi = random.between(-180, 180);
  const bool bent_left = random.between(0, 1) < 0.5;
  const Vector<double> along = direction(angle), C = A + first * along;
  const Vector<double> B =
      type == "RPR" ? C : C + rod * direction(bent_left ? angle + elbow : angle - elbow);
  const Vector<double> X = B - turned(2, phi * kDegree, b);
  Posed posed;
  posed.pose = {{"x", X[0]}, {"y", X[1]}, {"phi", phi * kDegree}};
  const Row sliding = slide(along), at_A = turn(kZ, A, X), at_C = turn(kZ, C, X);
  posed.joints = {type == "PRR" ? sliding : at_A, type == "RPR" ? sliding : at_C, turn(kZ, B, X)};
  const double turned_by = bent_left ? elbow : -elbow;
  const double last = type == "RPR" ? phi - angle : phi - angle - turned_by;
  posed.values = {type == "PRR" ? first : angle * kDegree,
                  type == "RPR" ? first : turned_by * kDegree, last * kDegree};
  posed.leg = "type = \"" + type + "\"\nactuated = " + std::to_string(actuated) +
              "\nbase = " + list(A, 2) + "\nplatform = " + list(b, 2) + '\n';
  if (type == "RRR") posed.leg += key("crank", first);
  if (type != "RPR") posed.leg += key("rod", rod);
  if (type == "PRR") posed.leg += "axis = " + list(along, 2) + '\n';
  // A crank bent to the left of the rod's line turns clockwise from AB to it.
  if (type == "RRR") posed.leg += bent_left ? "mode = \"-\"\n" : "mode = \"+\"\n";
  if (type == "PRR") posed.leg += elbow > 90 ? "mode = \"+\"\n" : "mode = \"-\"\n";
  return posed;
}

TEST(Legs, InThePlaneHaveTheRatesOfEachJoint) {
  Poses random;
  for (const char* type : {"RPR", "RRR", "PRR"})
    for (int actuated = 1; actuated <= 3; ++actuated)
      for (int trial = 0; trial < 20; ++trial) {
        const Posed posed = planar_leg(random, type, actuated);
        const Model model = parsed(posed, "", kOtherPlanarLegs);
        expect_rate(row_of(model, 0, posed.pose), posed, std::size_t(actuated), true);
      }
}

bool is_within(const Model& model, Point point) {
  for (const GeometryParameter& g : model.geometry) point[g.name] = evaluate(g.value, point);
  const Motion& motion = model.motions.front();
  for (const GiNaC::ex& operand : motion.reach)
    if (evaluate(operand, point) < 0) return false;
  for (const GiNaC::ex& constraint : motion.constraints)
    if (!(evaluate(constraint, point) <= 0)) return false;
  return true;
}

/// The pose is within a range around the joint's value, and not within one beside it.
void expect_range(Posed posed, double value, const std::string& head, const std::string& others) {
  const std::string leg = posed.leg, where = "where = \"within-ranges\"\n";
  posed.leg = leg + "range = " + list({value - 0.3, value + 0.2, 0}, 2) + '\n';
  EXPECT_TRUE(is_within(parsed(posed, head, others, where), posed.pose)) << posed.leg;
  for (const double beside : {-0.3, 0.1}) {
    posed.leg = leg + "range = " + list({value + beside, value + beside + 0.2, 0}, 2) + '\n';
    EXPECT_FALSE(is_within(parsed(posed, head, others, where), posed.pose)) << posed.leg;
  }
}

TEST(Legs, InThePlaneHaveTheRangesOfEachJoint) {
  Poses random;
  for (const char* type : {"RPR", "RRR", "PRR"})
    for (std::size_t actuated = 1; actuated <= 3; ++actuated)
      for (int trial = 0; trial < 10; ++trial) {
        const Posed posed = planar_leg(random, type, int(actuated));
        expect_range(posed, posed.values[actuated - 1], "", kOtherPlanarLegs);
      }
}

/// A leg in space that ends in a spherical joint.
Posed spatial_leg(Poses& random, const std::string& type) {
  const Vector<double> A = random_vector(random, 1), b = random_vector(random, 1);
  const Frame frame = random_frame(random), rods = random_frame(random);
  const double first = random.between(1, 2), rod = random.between(1, 2);
  const double roll = random.between(-1, 1), pitch = random.between(-1, 1),
               yaw = random.between(-1, 1);
  const Vector<double> C = A + first * (type[0] == 'P' ? frame.n : frame.f);
  const Vector<double> B = type[1] == 'P' ? C : C + rod * rods.n;
  const Vector<double> X = B - turned(2, yaw, turned(1, pitch, turned(0, roll, b)));
  Posed posed;
  posed.pose = {{"x", X[0]},    {"y", X[1]},      {"z", X[2]},
                {"roll", roll}, {"pitch", pitch}, {"yaw", yaw}};
  for (const Vector<double>& axis : {kX, kY, kZ}) posed.passive.push_back(turn(axis, B, X));
  const Vector<double>& centre = type[1] == 'P' ? A : C;
  for (const Vector<double>& axis : {kX, kY, kZ})
    if (type[1] != 'P' || std::fabs(dot(axis, frame.f)) < 2)
      posed.passive.push_back(turn(axis, centre, X));
  posed.joints = {type[1] == 'P'   ? slide(frame.f)
                  : type[0] == 'P' ? slide(frame.n)
                                   : turn(frame.n, A, X)};
  posed.leg = "type = \"" + type + "\"\nbase = " + list(A, 3) + "\nplatform = " + list(b, 3) + '\n';
  posed.values = {first};
  if (type[1] == 'P') return posed;
  // Longer than a unit vector: only its direction counts.
  posed.leg += "axis = " + list(1.5 * frame.n, 3) + '\n' + key("rod", rod);
  if (type[0] == 'R') posed.leg += key("crank", first);
  const Vector<double> AB = B - A;
  const bool plus =
      type[0] == 'R' ? dot(cross(AB, frame.f), frame.n) > 0 : dot(AB, frame.n) < first;
  posed.leg += plus ? "mode = \"+\"\n" : "mode = \"-\"\n";
  if (type[0] == 'P') return posed;
  const double angle = random.between(-3, 3);
  const Vector<double> zero = std::cos(angle) * frame.f - std::sin(angle) * frame.g;
  posed.values = {angle};
  posed.leg += "zero = " + list(zero + 0.3 * frame.n, 3) + '\n';
  return posed;
}

TEST(Legs, InSpaceHaveTheRangesOfTheirMotors) {
  Poses random;
  for (const char* head : {"", "axis_tolerance = 0\n"})
    for (const char* type : {"UPS", "RUS", "PUS"})
      for (int trial = 0; trial < 10; ++trial) {
        const Posed posed = spatial_leg(random, type);
        expect_range(posed, posed.values.front(),
                     "orientation = \"roll-pitch-yaw\"\n" + std::string(head),
                     other_legs("type = \"UPS\"\n"));
      }
}

TEST(Legs, InSpaceHaveTheRatesOfTheirMotors) {
  Poses random;
  for (const char* head : {"", "axis_tolerance = 0\n"})
    for (const char* type : {"UPS", "SPS", "RUS", "RSS", "PUS", "PSS"})
      for (int trial = 0; trial < 20; ++trial) {
        const Posed posed = spatial_leg(random, type);
        const Model model = parsed(posed, "orientation = \"roll-pitch-yaw\"\n" + std::string(head),
                                   other_legs("type = \"UPS\"\n"));
        expect_rate(row_of(model, 0, posed.pose), posed, 1, false);
      }
}

Model level_robot(const Posed& posed, const std::string& head, const std::string& others) {
  return parsed(posed, "orientation = \"fixed\"\n" + head, others);
}

/// UPU, delta or linear-delta: outer axes along t, platform parallel to the base.
Posed level_leg(Poses& random, const std::string& type) {
  const Vector<double> A = random_vector(random, 1), b = random_vector(random, 1);
  const Frame frame = random_frame(random), rods = random_frame(random);
  const double first = random.between(1, 2), rod = random.between(1, 2);
  const Vector<double> t = frame.n;
  const Vector<double> C = A + first * frame.f;
  const Vector<double> B = type == "UPU" ? C + 0.5 * frame.n : C + rod * rods.n;
  const Vector<double> X = B - b, AB = B - A, d = B - C;
  Posed posed;
  posed.pose = {{"x", X[0]}, {"y", X[1]}, {"z", X[2]}};
  posed.leg = "type = \"" + type + "\"\nbase = " + list(A, 3) + "\nplatform = " + list(b, 3) + '\n';
  if (type == "UPU") {
    const Vector<double> inner = cross(t, AB);
    posed.joints = {slide((1 / norm(AB)) * AB)};
    posed.passive = {turn(t, A, X), turn(inner, A, X), turn(inner, B, X), turn(t, B, X)};
    posed.leg += "axis = " + list(t, 3) + '\n';
    return posed;
  }
  const bool turns = type == "delta";
  posed.joints = {turns ? turn(t, A, X) : slide(frame.f)};
  posed.passive = {slide(cross(t, d)), slide(cross(d, cross(t, d))), turn(t, B, X)};
  posed.leg += key("rod", rod) + "axis = " + list(turns ? t : frame.f, 3) + '\n';
  posed.leg += turns ? key("crank", first) : "bar = " + list(t, 3) + '\n';
  const bool plus = turns ? dot(cross(AB, frame.f), t) > 0 : dot(AB, frame.f) < first;
  posed.leg += plus ? "mode = \"+\"\n" : "mode = \"-\"\n";
  return posed;
}

TEST(Legs, ThatKeepThePlatformLevelHaveRowsOfMotorAndConstraint) {
  Poses random;
  const std::string upu = "type = \"UPU\"\naxis = [1, 2, 3]\n";
  for (const char* head : {"", "axis_tolerance = 0\n"})
    for (const char* type : {"UPU", "delta", "linear-delta"})
      for (int trial = 0; trial < 20; ++trial) {
        const Posed posed = level_leg(random, type);
        const Model model = level_robot(posed, head, other_legs(upu));
        expect_rate(row_of(model, 0, posed.pose), posed, 1, false);
        // The first constraint follows the six motors; no joint of the leg moves against it.
        expect_rate(row_of(model, 6, posed.pose), posed, 0, false);
        EXPECT_GT(std::fabs(row_of(model, 6, posed.pose)[3]), 0);
      }
}

TEST(Legs, WithoutAMotorOnlyHaveTheirConstraint) {
  Poses random;
  Posed posed = level_leg(random, "UPU");
  posed.leg += "actuated = \"none\"\n";
  const Model model = level_robot(posed, "", other_legs("type = \"UPU\"\naxis = [1, 2, 3]\n"));
  ASSERT_EQ(model.matrix.rows(), 11U);
  expect_rate(row_of(model, 5, posed.pose), posed, 0, false);
}

TEST(Legs, OfSeveralTypesCarryOnePlatform) {
  const Model model = parse_model(
      "regulus = 1\nname = \"mixed\"\n[legs]\norientation = \"euler-zxz\"\ncrank_tolerance = 0.1\n"
      "[[legs.leg]]\ntype = \"RUS\"\nbase = [1, 0, 0]\nplatform = [1, 0, 0]\naxis = [0, 1, 0]\n"
      "crank = 1\nrod = 3\nmode = \"+\"\n"
      "[[legs.leg]]\ntype = \"PUS\"\nbase = [1, 0, 0]\nplatform = [1, 0, 0]\naxis = [0, 0, 1]\n"
      "rod = 3\nmode = \"-\"\n" +
          other_legs("type = \"UPS\"\n") + "[motion.here]\nx = 0\ny = 0\nz = 1\n" +
          "psi = 0\ntheta = 0\nphi = 0\n",
      "mixed.toml");
  EXPECT_EQ(model.matrix.rows(), 7U);
  EXPECT_EQ(model.matrix_notes.front(), "7 legs: 1 PUS, 1 RUS, 5 UPS; rows of 7 motors");
  for (const GeometryParameter& g : model.geometry)
    EXPECT_EQ(GiNaC::ex(g.tolerance).is_equal(GiNaC::numeric(1, 10)), g.group == "cranks")
        << g.name;
}

TEST(Legs, ThatEndInAPointHaveColumnsOfVelocityAlone) {
  const Model model = parse_model(
      "regulus = 1\nname = \"five-bar\"\n[legs]\norientation = \"point\"\ntype = \"RRR\"\n"
      "crank = 1\nrod = 2\nmode = \"+\"\n[[legs.leg]]\nbase = [0, 0]\n"
      "[[legs.leg]]\nbase = [1, 0]\nmode = \"-\"\n[motion.here]\nx = 0\ny = 2\n",
      "five_bar.toml");
  EXPECT_EQ(model.matrix.rows(), 2U);
  EXPECT_EQ(model.matrix.cols(), 2U);
  EXPECT_EQ(model.twist.size(), 2U);
}

}  // namespace
}  // namespace regulus::detail::test::legs
