// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs of the solutions at the places of a table: what is verified of them, and what is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "tests/support/command.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kSolver = REGULUS_BINARY_DIR "/bin/regulus";
constexpr const char* kChecker = REGULUS_BINARY_DIR "/bin/regulus-verify";
constexpr const char* kLengths =
    "t [ms], rho_1, rho_2, rho_3\n"
    "0, 14.98, 15.38, 12\n"
    "250, 14.9, 15.4, 12.1\n"
    "500, 100, 1, 1\n";

using Words = std::vector<std::string>;

class ProofOfATable : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }
  /// Solves, writes the certificate "proof", and returns the report.
  [[nodiscard]] json solve(Words words) const {
    words.insert(words.begin(), {kSolver, "solve"});
    words.insert(words.end(), {"--certificate", path("proof"), "--json", "--quiet"});
    const CommandResult found = run_command(words);
    return found.output.empty() ? json(found.errors) : json::parse(found.output);
  }
  /// Returns "VERIFIED\n", "REJECTED\n" or "UNFINISHED\n".
  [[nodiscard]] CommandResult verify(const std::string& proof, Words words) const {
    words.insert(words.begin(), {kChecker, path(proof)});
    return run_command(words);
  }

  TemporaryDirectory folder_;
};

/// The three proofs of kLengths, and what an enemy makes of them.
class ForgedTable : public ProofOfATable {
 protected:
  void SetUp() override {
    model_ = REGULUS_SOURCE_DIR "/models/rpr_6.toml";
    table_ = file("lengths.csv", kLengths);
    const json report = solve({model_, "--waypoints", table_});
    ASSERT_EQ(report["certificate"], path("proof"));
    std::istringstream text(text_of("proof"));
    for (std::string line; std::getline(text, line);) {
      if (line.starts_with("place "))
        parts_.emplace_back();
      else if (!parts_.empty() && !line.starts_with("places "))
        parts_.back() += line + '\n';
    }
    ASSERT_EQ(parts_.size(), 3U);
  }
  [[nodiscard]] std::string answer(const std::vector<std::string>& parts, Words words) const {
    std::string text = "regulus-certificate-places 1\n";
    for (std::size_t k = 0; k < parts.size(); ++k)
      text += "place " + std::to_string(k + 1) + '\n' + parts[k];
    static_cast<void>(file("forged", text + "places " + std::to_string(parts.size()) + '\n'));
    return verify("forged", std::move(words)).output;
  }
  [[nodiscard]] std::string with_model(const std::vector<std::string>& parts) const {
    return answer(parts, {"--model", model_, "--waypoints", table_});
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  }
  /// Without its first line `solution`.
  static std::string without_solution(std::string text) {
    const std::size_t at = text.find("\nsolution ");
    return text.erase(at, text.find('\n', at + 1) - at);
  }
  static std::string solutions_of(const std::string& part) {
    const std::size_t begin = part.find("solution "), end = part.find("proof\n");
    return part.substr(begin, end - begin);
  }

  std::string model_, table_;
  std::vector<std::string> parts_;
};

TEST_F(ForgedTable, IsVerifiedAsItIs) {
  EXPECT_EQ(with_model(parts_), "VERIFIED\n");
  const CommandResult told =
      verify("forged", {"--model", model_, "--waypoints", table_, "--allow-options"});
  EXPECT_EQ(told.output, "VERIFIED\n");
  EXPECT_THAT(told.errors, HasSubstr("COMPLETE at 2, NONE at 1; 12 solutions in all"));
  EXPECT_THAT(told.errors, HasSubstr("places     3, each with its own proof"));
}

TEST_F(ForgedTable, WithOtherPlacesIsRejected) {
  EXPECT_EQ(with_model({parts_[1], parts_[0], parts_[2]}), "REJECTED\n");
  EXPECT_EQ(with_model({parts_[0], parts_[0], parts_[2]}), "REJECTED\n");
  EXPECT_EQ(with_model({parts_[0], parts_[1]}), "REJECTED\n");
  EXPECT_EQ(with_model({parts_[0], parts_[1], parts_[2], parts_[2]}), "REJECTED\n");
  // Options do not change what the table says.
  for (const auto& parts :
       {std::vector{parts_[1], parts_[0], parts_[2]}, std::vector{parts_[0], parts_[1]}})
    EXPECT_EQ(answer(parts, {"--model", model_, "--waypoints", table_, "--allow-options"}),
              "REJECTED\n");
  // Without a table, these are true claims about some places.
  EXPECT_EQ(answer({parts_[1], parts_[0], parts_[2]}, {}), "VERIFIED\n");
}

TEST_F(ForgedTable, WithAnotherListIsNotVerified) {
  const std::string of_other =
      replaced(parts_[1], solutions_of(parts_[1]), solutions_of(parts_[0]));
  EXPECT_EQ(with_model({parts_[0], of_other, parts_[2]}), "REJECTED\n");
  const std::string fewer = without_solution(parts_[1]);
  EXPECT_EQ(with_model({parts_[0], fewer, parts_[2]}), "REJECTED\n");
  const std::string counted = replaced(fewer, "exactly 6", "exactly 5");
  EXPECT_EQ(with_model({parts_[0], counted, parts_[2]}), "REJECTED\n");
  EXPECT_EQ(answer({parts_[0], counted, parts_[2]}, {}), "REJECTED\n");
  const std::string none = replaced(parts_[2], "has no pose", "has exactly 0 poses");
  EXPECT_EQ(with_model({parts_[0], parts_[1], none}), "REJECTED\n");
  std::string empty = replaced(counted, "verdict COMPLETE", "verdict NONE");
  empty = replaced(empty, solutions_of(empty), "");
  empty = replaced(empty, "has exactly 5 poses, one within each line 'solution'", "has no pose");
  EXPECT_EQ(with_model({parts_[0], empty, parts_[2]}), "REJECTED\n");
}

TEST_F(ForgedTable, WithAPartThatProvesNothingIsUnfinished) {
  EXPECT_EQ(with_model({parts_[0], "", parts_[2]}), "UNFINISHED\n");
  // A false part is told, also after an open one.
  EXPECT_EQ(with_model({"", parts_[0], parts_[2]}), "REJECTED\n");
}

TEST_F(ForgedTable, WithTheProofOfAnotherKindIsRejected) {
  ASSERT_EQ(run_command({kSolver, "check", "planar_3rpr", "regular", "--certificate", path("check"),
                         "--quiet"})
                .exit_code,
            0);
  EXPECT_EQ(answer({parts_[0], text_of("check"), parts_[2]}, {}), "REJECTED\n");
  EXPECT_EQ(answer({parts_[0], text_of("proof"), parts_[2]}, {}), "REJECTED\n");
}

TEST_F(ForgedTable, OfAnotherTableIsRejected) {
  const auto with_table = [&](const char* from, const char* to, bool allows = false) {
    Words words = {"--model", model_, "--waypoints",
                   file("other.csv", replaced(kLengths, from, to))};
    if (allows) words.emplace_back("--allow-options");
    return answer(parts_, words);
  };
  EXPECT_EQ(with_table("14.9,", "14.900,"), "VERIFIED\n");
  for (const bool allows : {false, true}) {
    EXPECT_EQ(with_table("14.9,", "14.9001,", allows), "REJECTED\n");
    EXPECT_EQ(with_table("14.9,", "-14.9,", allows), "REJECTED\n");
    EXPECT_EQ(with_table("rho_1, rho_2", "rho_2, rho_1", allows), "REJECTED\n");
    EXPECT_EQ(with_table("500, 100, 1, 1\n", "", allows), "REJECTED\n");
  }
  EXPECT_EQ(with_table("rho_3", "rho_3 [mm]"), "UNFINISHED\n");  // the model has no unit
  EXPECT_EQ(with_table("rho_1, rho_2, rho_3", "a, b, c"), "UNFINISHED\n");
}

TEST_F(ForgedTable, WithoutItsTableIsUnfinished) {
  EXPECT_EQ(answer(parts_, {"--model", model_}), "UNFINISHED\n");
  EXPECT_EQ(answer(parts_, {"--model", model_, "--allow-options"}), "VERIFIED\n");
  EXPECT_EQ(answer(parts_, {"--model", model_, "--waypoints", path("nowhere.csv")}),
            "UNFINISHED\n");
}

TEST_F(ForgedTable, IsNotThatOfOnePlace) {
  static_cast<void>(file("part", parts_[0]));
  EXPECT_EQ(verify("part", {}).output, "VERIFIED\n");
  EXPECT_EQ(verify("part", {"--model", model_, "--allow-options"}).output, "VERIFIED\n");
  EXPECT_EQ(verify("part", {"--model", model_, "--allow-options", "--waypoints", table_}).output,
            "REJECTED\n");
}

TEST_F(ForgedTable, ThatIsCutIsRejected) {
  const std::string whole = text_of("proof");
  for (std::size_t end = whole.size() - 1; end > 0; end -= std::min<std::size_t>(end, 97)) {
    static_cast<void>(file("cut", whole.substr(0, whole.rfind('\n', end - 1) + 1)));
    EXPECT_EQ(verify("cut", {}).output, "REJECTED\n") << end;
  }
}

/// With tan(t/2) or two circles: the joint between coupler and rocker is on a circle about each of its
/// neighbours.
TEST_F(ProofOfATable, OfAFourBarLinkageHasTheClosedForm) {
  constexpr double kGround = 0.45, kCrank = 0.2, kCoupler = 0.35355, kRocker = 0.25,
                   kDegree = std::numbers::pi / 180;
  const std::string model = REGULUS_SOURCE_DIR "/models/four_bar.toml",
                    table = file("theta.csv", "theta [deg]\n60\n-30\n100\n135\n");
  const json report = solve({model, "--waypoints", table});
  ASSERT_EQ(report["places"].size(), 4U) << report;
  const std::array<double, 4> theta = {60, -30, 100, 135};
  for (std::size_t k = 0; k < theta.size(); ++k) {
    const double x = kCrank * std::cos(theta[k] * kDegree) - kGround,
                 y = kCrank * std::sin(theta[k] * kDegree), d = std::hypot(x, y);
    const double cosine = (d * d + kRocker * kRocker - kCoupler * kCoupler) / (2 * d * kRocker);
    const json& solutions = report["places"][k]["solutions"];
    ASSERT_EQ(solutions.size(), std::abs(cosine) > 1 ? 0U : 2U) << k;
    for (const json& solution : solutions) {
      const double psi = solution["values"]["psi"][0];
      EXPECT_NEAR(std::cos(psi - std::atan2(y, x)), cosine, 1e-12) << k;
    }
  }
  EXPECT_EQ(verify("proof", {"--model", model, "--waypoints", table}).output, "VERIFIED\n");
  const std::string other = file("other.csv", "theta [deg]\n60\n-30\n100.0001\n135\n");
  EXPECT_EQ(verify("proof", {"--model", model, "--waypoints", other}).output, "REJECTED\n");
  EXPECT_EQ(verify("proof", {"--model", model, "--waypoints", other, "--allow-options"}).output,
            "REJECTED\n");
}

/// The pose that gives the lengths is one of the poses with these lengths.
TEST_F(ProofOfATable, OfPosesHasThesePoses) {
  const std::string model = REGULUS_SOURCE_DIR "/models/rpr_6.toml";
  const std::array<std::array<double, 3>, 2> poses = {{{14.25, -1.5, 0.75}, {-3, 8.5, -1.25}}};
  const std::string table =
      file("poses.csv", "x, y, phi [rad]\n14.25, -1.5, 0.75\n-3, 8.5, -1.25\n");
  const json report = solve({model, "--waypoints", table});
  ASSERT_EQ(report["places"].size(), 2U) << report;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    std::size_t found = 0;
    for (const json& solution : report["places"][k]["solutions"]) {
      const json& values = solution["values"];
      const auto is = [&](const char* name, double expected) {
        return std::abs(double(values[name][0]) - expected) < 1e-9;
      };
      found += is("x", poses[k][0]) && is("y", poses[k][1]) && is("phi", poses[k][2]);
    }
    EXPECT_EQ(found, 1U) << k;
  }
  EXPECT_EQ(verify("proof", {"--model", model, "--waypoints", table}).output, "VERIFIED\n");
}

TEST_F(ProofOfATable, OfToolsOfAnArmIsInItsUnits) {
  const std::string model = REGULUS_SOURCE_DIR "/models/puma_560_serial.toml";
  const std::string table = file("tools.csv",
                                 "x [mm], y, z [m], roll, pitch [deg], yaw\n"
                                 "400, 0.1, 0.5, 0, 11.25, 1\n"
                                 "380, 0.1, 0.5, 0, 11.5, 1\n");
  const json report = solve({model, "--waypoints", table});
  ASSERT_EQ(report["places"].size(), 2U) << report;
  EXPECT_EQ(report["places"][1]["solutions"].size(), 8U);
  EXPECT_EQ(verify("proof", {"--model", model, "--waypoints", table}).output, "VERIFIED\n");
  const std::string other = file("other.csv",
                                 "x [mm], y, z [m], roll, pitch [rad], yaw\n"
                                 "400, 0.1, 0.5, 0, 11.25, 1\n"
                                 "380, 0.1, 0.5, 0, 11.5, 1\n");
  EXPECT_EQ(verify("proof", {"--model", model, "--waypoints", other}).output, "REJECTED\n");
}

TEST_F(ProofOfATable, OfAJointThatKeepsItsValueComparesThisValue) {
  const std::string model = REGULUS_SOURCE_DIR "/models/seven_joints.toml",
                    head = "x, y, z, roll, pitch, yaw, q3\n";
  const std::string table = file("tools.csv", head + "0.4, 0.1, 0.6, 2, 0.2, 1, 0.25\n");
  const json report = solve({model, "--waypoints", table});
  ASSERT_EQ(report["verdict"], "complete") << report;
  const auto answer = [&](const std::string& row) {
    return verify("proof", {"--model", model, "--waypoints", file("other.csv", head + row),
                            "--allow-options"})
        .output;
  };
  EXPECT_EQ(answer("0.4, 0.1, 0.6, 2, 0.2, 1, 1/4\n"), "UNFINISHED\n");  // no number of a table
  EXPECT_EQ(answer("0.4, 0.1, 0.6, 2, 0.2, 1, 0.250\n"), "VERIFIED\n");
  EXPECT_EQ(answer("0.4, 0.1, 0.6, 2, 0.2, 1, 0.26\n"), "REJECTED\n");
}

/// A motion along way-points is answered at these, and its model file names the table.
TEST_F(ProofOfATable, OfAMotionAlongWaypointsNeedsNoOtherFile) {
  std::ostringstream text;
  text << std::ifstream(REGULUS_SOURCE_DIR "/models/four_bar.toml").rdbuf();
  const std::string model =
      file("bar.toml", text.str() + "[motion.way]\nwaypoints = \"way.csv\"\n");
  static_cast<void>(file("way.csv", "t, theta\n0, 0.5\n1, 0.75\n2, 3\n"));
  const json report = solve({model, "way"});
  ASSERT_EQ(report["places"].size(), 3U) << report;
  EXPECT_EQ(report["motion"], "way");
  EXPECT_EQ(report["verdict"], "none");
  const CommandResult told = run_command({kSolver, "solve", model, "way"});
  EXPECT_EQ(told.output, "NONE at 1, COMPLETE at 2 of 3 places: 4 configurations\n");
  EXPECT_THAT(told.errors, HasSubstr("each for itself and nothing between them"));
  EXPECT_EQ(verify("proof", {"--model", model}).output, "VERIFIED\n");
  static_cast<void>(file("way.csv", "t, theta\n0, 0.5\n1, 0.5\n2, 3\n"));
  EXPECT_EQ(verify("proof", {"--model", model}).output, "REJECTED\n");
}

TEST_F(ProofOfATable, IsWrittenWhereSomePlaceHasNone) {
  // Two configurations meet where the bars are in line.
  const std::string model = REGULUS_SOURCE_DIR "/models/four_bar.toml",
                    table = file("theta.csv", "theta\n0.5\n2\n");
  const json report = solve({model, "--waypoints", table, "--max-boxes", "8"});
  ASSERT_EQ(report["verdict"], "incomplete") << report;
  if (report["certificate"].is_null()) {
    EXPECT_THAT(std::string(report["certificate_obstacle"]), HasSubstr("no solution is certain"));
    return;
  }
  EXPECT_THAT(report.value("certificate_note", ""), HasSubstr("the verifier"));
}

TEST_F(ProofOfATable, IsComparedInPartWhereOptionsGiveNumbers) {
  const std::string model = REGULUS_SOURCE_DIR "/models/rpr_6.toml",
                    table = file("two.csv", "rho_1,rho_2\n14.98,15.38\n");
  static_cast<void>(solve({model, "legs", "--at", "rho_3=12", "--waypoints", table}));
  // The motion of the file has the same number.
  EXPECT_EQ(verify("proof", {"--model", model, "--waypoints", table}).output, "VERIFIED\n");
  static_cast<void>(solve({model, "legs", "--at", "rho_3=12.1", "--waypoints", table}));
  EXPECT_EQ(verify("proof", {"--model", model, "--waypoints", table}).output, "REJECTED\n");
  EXPECT_EQ(verify("proof", {"--model", model, "--waypoints", table, "--allow-options"}).output,
            "UNFINISHED\n");
}

}  // namespace
}  // namespace regulus::detail::test
