// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of lists of poses on six legs that a search has found: genuine ones are verified and
// compared with their files, forged ones are not.
#include <fmt/format.h>

#include <map>

#include "tests/property/solve/certified_lists.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

/// Writes the claim that belongs to the lines.
std::string with_claim_of_poses(const Lines& lines, const std::string& verdict) {
  return joined(claiming(lines, verdict, format::kOfSixLegs, "pose", "poses"));
}

/// The same line, with the other quaternion of its rotation.
std::string turned(const std::string& line) {
  std::istringstream stream(line);
  std::string text, word;
  for (std::size_t i = 0; stream >> word; ++i) {
    const std::size_t colon = word.find(':');
    if (i >= 4)
      word = fmt::format("{:a}:{:a}", -std::stod(word.substr(colon + 1)),
                         -std::stod(word.substr(0, colon)));
    text += (i == 0 ? "" : " ") + word;
  }
  return text;
}

void expect_forged_poses_fail(const std::string& certificate) {
  const Lines genuine = lines_of(certificate);
  EXPECT_EQ(genuine.back(), "end");
  EXPECT_EQ(outcome(with_claim_of_poses(genuine, "INCOMPLETE")), Outcome::kVerified);
  const auto at = std::ptrdiff_t(first(genuine, "solution"));
  expect_each_line_is_needed(genuine, with_claim_of_poses);
  for (std::size_t k = 0; k < count_of(genuine, "solution"); k += 5) {
    Lines more = genuine;
    more.push_back("");
    std::copy_backward(more.begin() + at, more.end() - 1, more.end());
    for (const std::string& again :
         {genuine[std::size_t(at) + k], turned(genuine[std::size_t(at) + k])}) {
      more[std::size_t(at)] = again;
      EXPECT_EQ(outcome(with_claim_of_poses(more, "COMPLETE")), Outcome::kRejected) << k;
    }
    Lines other = genuine;
    other[std::size_t(at) + k] = turned(genuine[std::size_t(at) + k]);
    EXPECT_EQ(outcome(joined(other)), Outcome::kVerified) << k;
  }
  Lines other = genuine;
  other[first(other, "leg")] += " + 1";
  EXPECT_NE(outcome(with_claim_of_poses(other, "COMPLETE")), Outcome::kVerified);
}

TEST(SearchedPosesOnSixLegs, AreVerifiedWithTheirFile) {
  const std::string model = library_model("robot_1") +
                            "[motion.here]\nx = 1\ny = 2\nz = 47\npsi = 0.1\ntheta = 0.12\n"
                            "phi = 0.05\n";
  const Certified made = certified(model, {}, "here");
  ASSERT_EQ(made.solutions.found.size(), 12U);
  const verifier::Verification v = verified(made.text, model);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v) << made.status.obstacle();
  EXPECT_EQ(v.roots, 12U);
  expect_forged_poses_fail(made.text);
  const std::string plain = without_sum(made.text);
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"z = 47\n", "z = 47.001\n"}, {"theta = 0.12\n", "theta = -0.12\n"}}) {
    std::string changed = model;
    changed.replace(changed.rfind(from), from.size(), to);
    EXPECT_EQ(outcome(plain, changed), Outcome::kRejected) << from;
  }
}

TEST(SearchedPosesOfFlatPlatforms, AreVerifiedWithTheirFiles) {
  RandomSource random(9);
  std::map<bool, int> counts;
  for (int round = 0; round < trials(4, 8); ++round) {
    std::string base, platform;
    const double spread = random.between(0.1, 0.9), other = random.between(0.1, 0.9);
    for (int i = 0; i < 6; ++i) {
      const double third = 2.0943951023931953 * (i / 2), side = i % 2 == 0 ? -1 : 1;
      const double a = third + side * spread, b = third + side * (1.0471975512 - other);
      base += fmt::format("[{:.6f}, {:.6f}, 0], ", 10 * std::cos(a), 10 * std::sin(a));
      platform += fmt::format("[{:.6f}, {:.6f}, 0], ", 6 * std::cos(b), 6 * std::sin(b));
    }
    std::string motion = "legs = [";
    for (int i = 0; i < 6; ++i) motion += fmt::format("{:.3f}, ", random.between(4, 9));
    motion += "]\n";
    if (round % 2 == 0)
      motion = fmt::format(
          "x = {:.3f}\ny = {:.3f}\nz = {:.3f}\npsi = {:.3f}\ntheta = {:.3f}\nphi = {:.3f}\n",
          random.between(-2, 2), random.between(-2, 2), random.between(7, 12),
          random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(-0.5, 0.5));
    const std::string model = fmt::format(
        "regulus = 1\nname = \"flat\"\n[gough]\nunit = \"cm\"\norientation = \"euler-zxz\"\nbase = "
        "[{}]\nplatform = [{}]\n"
        "[motion.m]\n{}",
        base, platform, motion);
    const Certified made = certified(model);
    ASSERT_TRUE(made.status.is_written()) << made.status.obstacle();
    const verifier::Verification v = verified(made.text, model);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v) << model << made.text;
    ++counts[made.solutions.found.empty()];
    if (round == 2) expect_forged_poses_fail(made.text);
  }
  EXPECT_GE(counts[false], trials(2, 3));
  EXPECT_GE(counts[true], trials(0, 1));
}

/// A flat hexagon and its mirror image at half its size.
TEST(PosesOfASimilarPlatform, AreVerifiedWithTheirFile) {
  const std::string model =
      "regulus = 1\nname = \"mirrored\"\n[gough]\norientation = \"roll-pitch-yaw\"\n"
      "base = [[100,0,0],[60,80,0],[-50,85,0],[-100,10,0],[-40,-80,0],[50,-90,0]]\n"
      "platform = [[50,0,0],[30,-40,0],[-25,-42.5,0],[-50,-5,0],[-20,40,0],[25,45,0]]\n"
      "[motion.at]\nx = 5\ny = 8\nz = 100\nroll = 0.2\npitch = -0.1\nyaw = 0.3\n";
  const Certified made = certified(model);
  ASSERT_EQ(made.solutions.found.size(), 8U);
  ASSERT_TRUE(is_complete(made.solutions)) << made.solutions.obstacle;
  EXPECT_EQ(verified(made.text, model).outcome, Outcome::kVerified);
  Lines fewer = lines_of(made.text);
  fewer.erase(fewer.begin() + std::ptrdiff_t(first(fewer, "solution")));
  std::string seven = joined(fewer);
  seven.replace(seven.find("exactly 8"), 9, "exactly 7");
  EXPECT_EQ(outcome(seven), Outcome::kRejected);
}

}  // namespace
}  // namespace regulus::detail::test
