// SPDX-License-Identifier: GPL-3.0-or-later
// How far errors move platforms on legs of variable length, against published figures and against
// poses that Newton's method finds in long doubles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <span>

#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/closure/branch_bound.hpp"
#include "codegen/question/quantity/platform_closure.hpp"
#include "tests/property/closure/checked_closures.hpp"
#include "tests/property/closure/deviated_platforms.hpp"
#include "tests/support/certificates.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::platform_error_test {
namespace {

using verifier::Outcome;

Bound bound(const std::string& text, const std::string& freedom, double gap,
            const std::string& certificate = "") {
  ModelOptions options;
  options.motion = "m";
  const Request request = closure_of_platform(read_request(text, options));
  QuantityOptions words;
  words.quantity = "error", words.is_finite = true, words.freedom = freedom;
  BoundSettings settings;
  settings.gap = gap;
  settings.search = test::usual_options();
  settings.over_branch = bounds_over_branch();
  settings.certificate = certificate;
  return bound_quantity(request, quantity_of(request.model, words), settings,
                        [](const ComponentBound&) {});
}

/// The 3-RPR of ALIAS by its anchors.
std::string planar(const std::string& error, const std::string& motion,
                   const std::string& more = "") {
  return test::Tripod::text(error, motion, more);
}

constexpr const char* kMiddle = "x = 5\ny = 5\nphi = 0\n";

/// The figures are those of the legs' lengths at this pose.
TEST(PlatformError, MeetsThePublishedFiguresOfA3Rpr) {
  const struct {
    const char* spread;
    double errors[3];
  } cases[] = {{"0.05", {0.17043, 0.24092, 0.08127}}, {"0.2", {0.93150, 1.03156, 0.44133}}};
  for (const auto& [spread, errors] : cases) {
    const Bound found = bound(planar(spread, kMiddle), "", 0.02);
    ASSERT_EQ(found.components.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      const ComponentBound& c = found.components[i];
      ASSERT_TRUE(c.is_closed && c.attained && c.proved) << c.component.label << c.reason;
      EXPECT_LE(c.attained->approx, errors[i] + 1e-5) << c.component.label;
      EXPECT_GE(c.proved->approx, errors[i] - 1e-5) << c.component.label;
    }
  }
}

/// Near a singular pose rounding moves Newton's corrections; the configurations are found again.
TEST(PlatformError, IsFoundWhereLegsHoldThePlatformBadly) {
  const std::string text = test::file_contents(REGULUS_SOURCE_DIR "/models/robot_1.toml") +
                           "\n[motion.m]\nparameters = { T = [0, 0.01] }\nx = \"8*cos(2*pi*T)\"\n"
                           "y = \"8*sin(2*pi*T)\"\nz = 55\npsi = 0\ntheta = 0\nphi = 0\n";
  const Bound found = bound(text, "y_deviation", 0.05);
  ASSERT_EQ(found.components.size(), 1U);
  const ComponentBound& y = found.components[0];
  ASSERT_TRUE(y.is_closed && y.attained && y.proved) << y.reason;
  EXPECT_LE(y.attained->approx, 0.7344);
  EXPECT_GE(y.proved->approx, 0.7284);
}

std::string hexapod(const std::string& more = "") {
  return test::Hexapod::text(
      "x = [-1, 1]\ny = 1\nz = 47\npsi = 0\ntheta = [-0.05, 0.05]\nphi = 0\n" + more);
}

/// Looks for the largest deviation, at corners of the errors.
test::Real largest_seen(std::size_t freedom, int tries) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  test::Real most = 0;
  for (int i = 0; i < tries; ++i) {
    test::Hexapod robot;
    robot.pose[0] = part(random), robot.pose[4] = 0.05 * part(random);
    most = std::fmax(most, robot.largest_at_corners(freedom, random));
  }
  return most;
}

TEST(PlatformError, BoundsWhatNewtonFindsForAHexapod) {
  const std::vector<std::pair<const char*, std::size_t>> all = {
      {"z_deviation", 2}, {"x_deviation", 0}, {"yaw_deviation", 5}};
  for (const auto& [name, freedom] : std::span(all).first(std::size_t(test::trials(1, 3)))) {
    const ComponentBound c = bound(hexapod(), name, 0.2).components.at(0);
    ASSERT_TRUE(c.attained && c.proved) << c.reason;
    EXPECT_TRUE(c.is_closed) << c.reason;
    const test::Real most = largest_seen(freedom, 20);
    EXPECT_LE(most, c.proved->approx) << name;
    EXPECT_GE(most, 0.95 * c.attained->approx) << name;
  }
}

std::string text_of(const EndProof& proof) {
  std::ostringstream text;
  text << std::ifstream(proof.file).rdbuf();
  return text.str();
}

std::string with_other(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// Both ends are verified and compared with the file; another file has other proofs.
void expect_compared(const std::string& model, const std::string& freedom, double gap,
                     std::initializer_list<std::pair<const char*, const char*>> changes) {
  const test::TemporaryDirectory directory;
  const ComponentBound c =
      bound(model, freedom, gap, (directory.path() / "bound").string()).components.at(0);
  ASSERT_TRUE(c.attained && c.proved) << c.reason;
  for (const EndProof& proof : {c.proofs.safe(), c.proofs.singular()}) {
    const std::string text = text_of(proof);
    const verifier::Verification v = test::verified(text, model);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v) << text.substr(0, 4000);
    for (const auto& [from, to] : changes) {
      const verifier::Verification other = test::verified(text, with_other(model, from, to));
      EXPECT_EQ(other.outcome, Outcome::kRejected) << from << describe(other);
    }
  }
}

TEST(PlatformError, IsVerifiedAndComparedWithItsModel) {
  const std::string motion = "x = [4.9, 5.1]\ny = 5\nphi = \"1/10\"\n";
  expect_compared(planar("0.002", motion, "base_tolerance = 0.001\n"), "x_deviation", 0.1,
                  {{"error = 0.002", "error = 0.003"},
                   {"base = [3, 10]", "base = [3, 11]"},
                   {"platform = [2, 2]", "platform = [2, 1]"},
                   {"base_tolerance = 0.001", "base_tolerance = 0.002"},
                   {"x = [4.9", "x = [4.8"},
                   {"y = 5", "y = 4"},
                   {"\ny = 5", "\nerror = { x = \"1/1000\" }\ny = 5"}});
}

/// The equations are about the pose that is commanded, so a proof about one with errors is none.
TEST(PlatformError, HasNoErrorsOfThePose) {
  const std::string model =
      planar("0.002", "x = 5\ny = 5\nphi = \"1/10\"\n", "base_tolerance = 0.001\n");
  const test::TemporaryDirectory directory;
  const ComponentBound c =
      bound(model, "x_deviation", 0.1, (directory.path() / "bound").string()).components.at(0);
  ASSERT_TRUE(c.proved) << c.reason;
  std::string proof = text_of(c.proofs.safe());
  const std::size_t sum = proof.find("\nsha256 ") + 8;
  proof.replace(sum, proof.find('\n', sum) - sum, "-");  // or the file is another by its digest
  proof = with_other(proof, "\npose x = 5\n", "\npose x = 5 +- 1/1000\n");
  proof = with_other(proof, "of the 9 uncertain quantities", "of the 10 uncertain quantities");
  const verifier::Verification v =
      test::verified(proof, with_other(model, "\ny = 5", "\nerror = { x = \"1/1000\" }\ny = 5"));
  EXPECT_EQ(v.outcome, Outcome::kUnfinished) << describe(v);
  EXPECT_NE(describe(v).find("the pose has errors of its own"), std::string::npos) << describe(v);
}

TEST(PlatformError, OfAHexapodIsVerifiedAndComparedWithItsModel) {
  expect_compared(hexapod(), "z_deviation", 0.2,
                  {{"error = 0.001", "error = 0.003"},
                   {"[-9, 9, 0]", "[-9, 8, 0]"},
                   {"base_tolerance = 0.001", "base_tolerance = 0.002"},
                   {"z = 47", "z = 46"}});
}

TEST(PlatformError, IsThatOfLegsAndAnchors) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      ModelOptions options;
      options.motion = "m";
      (void)closure_of_platform(read_request(text, options));
    } catch (const UsageError& why) {
      return why.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(hexapod()), "");
  EXPECT_NE(refusal(hexapod("error = { x = 0.1 }\n")).find("leave the motion's error"),
            std::string::npos);
  EXPECT_NE(refusal("regulus = 1\nname = \"arm\"\n[serial]\njoints = [{ name = \"q\" }]\n"
                    "[motion.m]\nq = 0\n")
                .find("six telescopic legs"),
            std::string::npos);
}

}  // namespace
}  // namespace regulus::detail::platform_error_test
