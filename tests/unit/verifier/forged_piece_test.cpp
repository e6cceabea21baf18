// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates about other trajectories than that of the model file: each piece is compared in full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/support/certificate_texts.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;
using verifier::Verification;

/// A motion along way-points, and a certificate about its pieces.
struct Way {
  std::string file = "way.csv", text = "x\n1\n2\n3\n", entry = "x + z";
  std::string names = "x_c0 x_c1", first = "1 | 1", second = "2 | 1";
  std::string x = "x_c0 + x_c1*s", z = "5", stated_entry = "x + z", after_entry, more;

  [[nodiscard]] std::string certificate() const {
    return "regulus-certificate 1\n" + std::string(kFullRank1) +
           "model m\nsha256 -\nmotion way\nalpha 0\nparameter s in 0 : 1\npiecewise " + names +
           "\npiece " + first + "\npiece " + second + "\npose x = " + x + "\npose z = " + z +
           "\nmatrix 1 1\nentry " + stated_entry + "\n" + after_entry +
           "proof\ntree\nl 0 mean-value\ntree\nl 0 mean-value\nend 2\n";
  }
  /// About its first piece alone.
  [[nodiscard]] std::string certificate_of_piece() const {
    return "regulus-certificate 1\n" + std::string(kFullRank1) +
           "model m\nsha256 -\nmotion way\nalpha 0\nparameter s in 0 : 1\npose x = 1 + s\n"
           "pose z = 5\nmatrix 1 1\nentry x + z\nproof\nl 0 mean-value\nend 1\n";
  }
};

Verification verify(const Way& way, const std::string& certificate) {
  const TemporaryDirectory folder;
  std::ofstream(folder.path() / way.file) << way.text;
  verifier::Options options;
  options.model_name = (folder.path() / "model.toml").string();
  options.model_text =
      "regulus = 1\nname = \"m\"\n[pose]\nx = \"mm\"\nz = \"mm\"\n[matrix]\nrows = [[\"" +
      way.entry + "\"]]\n[motion.way]\nwaypoints = \"" + way.file + "\"\n" +
      (way.file == "way.csv" ? "z = 5\n" : "") + way.more;
  return verify_text(certificate, options);
}

void expect_verified(const Way& way) {
  const Verification v = verify(way, way.certificate());
  EXPECT_EQ(v.outcome, Outcome::kVerified) << v.reason;
}

void expect_rejected(const Way& way, const std::string& reason) {
  const Verification alone = verify_text(way.certificate());
  EXPECT_EQ(alone.outcome, Outcome::kVerified) << alone.reason;
  const Verification v = verify(way, way.certificate());
  EXPECT_EQ(v.outcome, Outcome::kRejected) << v.reason;
  EXPECT_THAT(v.reason, HasSubstr(reason));
}

TEST(ALaterPiece, HasTheHeldPosesOfTheFile) {
  Way way;
  expect_verified(way);
  way.names += " held", way.first += " | 5", way.second += " | 6", way.z = "held";
  expect_rejected(way, "motion.way.z is '5', but the certificate has 'held'");
}

TEST(ALaterPiece, HasTheEntriesOfTheFile) {
  Way way;
  way.names += " more", way.first += " | 0", way.second += " | 1/1000";
  way.stated_entry = "x + z + more";
  expect_rejected(way, "matrix.rows[0][0] is 'x + z', but the certificate has 'x + z + more'");
  way.stated_entry = "x + z", way.after_entry = "constraint more - 2\n";
  expect_rejected(way, "states 'constraint'");
}

TEST(ALaterPiece, IsThatOfTheTable) {
  Way way;
  way.second = "2 | 1001/1000";
  expect_rejected(way, "its piece 2 is not the way from line 3 to line 4, where x differs");
}

TEST(ALaterPiece, HasUnitsInEitherKindOfBrackets) {
  for (const std::string& heading : std::vector<std::string>{"x [cm]", "x (cm)", "x(cm)"}) {
    Way way;
    way.text = heading + "\n0.1\n0.2\n0.3\n";
    expect_verified(way);
    way.text = heading + "\n1\n2\n3\n";
    expect_rejected(way, "where x differs");
  }
}

/// With a pose parameter t the column t would be no time, and the spline another one.
TEST(ALaterPiece, HasNoPoseThatOnlyTheTableHas) {
  Way way;
  way.text = "t,x\n0,0\n1,2\n10,0\n", way.more = "interpolation = \"cubic\"\n";
  way.names = "a b c d", way.first = "3 | 0 | -1 | 0", way.second = "0 | -3 | 1 | 2";
  way.x = "a*s + b*s^2 + c*s^3 + d";
  expect_rejected(way, "where x differs");
  way.names += " e f g h", way.first += " | -1 | 0 | 2 | 0", way.second += " | 5 | 6 | -2 | 1";
  way.z += "\npose t = e*s + f*s^2 + g*s^3 + h";
  expect_rejected(way, "states 'pose' 'e*s + f*s^2 + g*s^3 + h', which the file does not have");
}

constexpr const char* kLegModel = R"toml(regulus = 1
name = "m"
[legs]
type = "RPR"
orientation = "point"
[[legs.leg]]
base = [0, 0]
[[legs.leg]]
base = [4, 0]
[motion.way]
waypoints = "way.csv"
constraints = ["rho_1 - 5"]
)toml";

std::string certificate_of_legs(const std::string& names, const std::string& rho,
                                const std::string& second_leaf) {
  return "regulus-certificate 1\nverdict NO SINGULARITY\nclaim the full 2x2 matrix of the model is "
         "defined and has full rank at every pose of the variety\nmodel m\nsha256 -\nmotion way\n"
         "alpha 0\nparameter s in 0 : 1\n" +
         names +
         "pose x = x0 + x1*s\npose y = y0 + y1*s\nmatrix 2 2\nentry x\nentry y\nentry x - 4\n"
         "entry y\nscale 1/sqrt(x^2 + y^2)\nscale 1/sqrt((x - 4)^2 + y^2)\n"
         "defined 1/sqrt(x^2 + y^2)\ndefined 1/sqrt((x - 4)^2 + y^2)\nconstraint " +
         rho + " - 5\nproof\ntree\nl 0 mean-value\ntree\nl 0 " + second_leaf + "\nend 2\n";
}

/// The file means the length of its leg, which a certificate's own name of a number is not.
TEST(ALaterPiece, GivesNoMeaningToANameOfTheFile) {
  const TemporaryDirectory folder;
  std::ofstream(folder.path() / "way.csv") << "x,y\n1,1\n2,2\n3,1\n";
  verifier::Options options;
  options.model_name = (folder.path() / "model.toml").string();
  options.model_text = kLegModel;
  const std::string names = "piecewise x0 x1 y0 y1", one = "\npiece 1 | 1 | 1 | 1",
                    two = "\npiece 2 | 1 | 2 | -1";
  const Verification genuine = verify_text(
      certificate_of_legs(names + one + two + '\n', "sqrt(x^2 + y^2)", "mean-value"), options);
  EXPECT_EQ(genuine.outcome, Outcome::kVerified) << genuine.reason;
  const std::string by_pieces = names + " rho_1" + one + " | 0" + two + " | 9\n";
  const std::string forged = certificate_of_legs(by_pieces, "rho_1", "outside");
  EXPECT_EQ(verify_text(forged).outcome, Outcome::kVerified);
  EXPECT_EQ(verify_text(forged, options).outcome, Outcome::kRejected);
  const std::string by_parameter = "parameter rho_1 in 0 : 1\n" + names + one + two + '\n';
  const std::string other = certificate_of_legs(by_parameter, "rho_1", "mean-value");
  EXPECT_EQ(verify_text(other).outcome, Outcome::kVerified) << verify_text(other).reason;
  EXPECT_EQ(verify_text(other, options).outcome, Outcome::kRejected);
}

TEST(AMoveOfAProgram, IsComparedAtEveryPoint) {
  Way way;
  way.file = "way.nc", way.text = "G0 X1 Y0 Z5\nG1 X2\nG1 X3\n";
  expect_verified(way);
  way.x += " + s/16";
  for (int k = 1; k <= 16; ++k) way.x += "*(s - " + std::to_string(k) + "/16)";
  expect_rejected(way, "its piece 1 is not the move of line 2, where x differs");
}

TEST(AnArcOfAProgram, IsComparedByExactAlgebra) {
  for (const auto& [end, turn] :
       {std::pair("X-3 Y4", "pi - atan(4/3)"), std::pair("X0 Y5", "1/2*pi"),
        std::pair("X4 Y3", "atan(3/4)"), std::pair("X-5 Y0", "pi"), std::pair("X0 Y-5", "3/2*pi"),
        std::pair("X4 Y-3", "2*pi - atan(3/4)"), std::pair("X-4 Y-3", "pi + atan(3/4)")}) {
    Way way;
    way.file = "way.nc";
    way.text = "G0 X5 Y0 Z5\nG3 " + std::string(end) + " I-5\nG1 X5 Y0 Z5\nG3 " + end + " I-5\n";
    way.text = way.text.substr(0, way.text.find("G1")) + "M2\n";
    std::string certificate = way.certificate_of_piece();
    certificate.replace(certificate.find("1 + s"), 5, "5*cos((" + std::string(turn) + ")*s)");
    certificate.replace(certificate.find("entry x + z"), 11, "entry x + 20");
    way.entry = "x + 20";
    const Verification v = verify(way, certificate);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << end << v.reason;
  }
}

TEST(AClaimAboutOnePiece, IsNotOneAboutTheTrajectory) {
  Way way;
  EXPECT_EQ(verify_text(way.certificate_of_piece()).outcome, Outcome::kVerified);
  const Verification v = verify(way, way.certificate_of_piece());
  EXPECT_EQ(v.outcome, Outcome::kRejected);
  EXPECT_THAT(v.reason, HasSubstr("it is about one piece, and the file has 2"));
  way.text = "x\n1\n2\n";
  EXPECT_EQ(verify(way, way.certificate_of_piece()).outcome, Outcome::kVerified);
}

}  // namespace
}  // namespace regulus::detail::test
