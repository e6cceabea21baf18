// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of lists of poses in the plane: genuine ones are verified and compared with their files,
// forged ones are not.
#include <fmt/format.h>

#include <map>

#include "tests/property/solve/certified_lists.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {
namespace {

/// Writes the claim that belongs to the lines.
std::string with_planar_claim(const Lines& lines, const std::string& verdict) {
  return joined(claiming(lines, verdict, format::kOfThreeLegs, "pose", "poses"));
}

struct PlanarPlatform {
  std::array<std::array<double, 2>, 3> base{}, platform{};
  std::string motion;  ///< what the motion gives

  explicit PlanarPlatform(RandomSource& random) {
    for (std::size_t i = 0; i < 3; ++i)
      for (auto* anchor : {&base[i], &platform[i]})
        for (double& x : *anchor) x = std::round(random.between(-1e3, 1e3)) / 100;
  }

  [[nodiscard]] std::string text(const std::string& unit) const {
    std::string text = fmt::format(
        "regulus = 1\nname = \"planar\"\n[legs]\nangle_unit = \"{}\"\ntype = \"RPR\"\n", unit);
    for (std::size_t i = 0; i < 3; ++i)
      text += fmt::format("[[legs.leg]]\nbase = [{}, {}]\nplatform = [{}, {}]\n", base[i][0],
                          base[i][1], platform[i][0], platform[i][1]);
    return text + "[motion.m]\n" + motion;
  }
};

void expect_planar_forgeries_fail(const std::string& certificate) {
  const Lines genuine = lines_of(certificate);
  EXPECT_EQ(outcome(with_planar_claim(genuine, "INCOMPLETE")), Outcome::kVerified);
  const auto at = std::ptrdiff_t(first(genuine, "solution"));
  expect_each_line_is_needed(genuine, with_planar_claim);
  Lines more = genuine, other = genuine, turned = genuine;
  more.insert(more.begin() + at, genuine[std::size_t(at)]);
  other[first(other, "leg")] += " + 1";
  EXPECT_EQ(outcome(with_planar_claim(more, "COMPLETE")), Outcome::kRejected);
  EXPECT_NE(outcome(with_planar_claim(other, "COMPLETE")), Outcome::kVerified);
  // The same pose once more, a whole turn on.
  std::string& angle = turned[std::size_t(at)];
  const std::size_t space = angle.rfind(' '), colon = angle.find(':', space);
  const double turn = 2 * 3.14159265358979312;
  angle = angle.substr(0, space) + fmt::format(" {:a}:{:a}",
                                               std::stod(angle.substr(space + 1)) + turn - 1e-9,
                                               std::stod(angle.substr(colon + 1)) + turn + 1e-9);
  turned.insert(turned.begin() + at, genuine[std::size_t(at)]);
  EXPECT_NE(outcome(with_planar_claim(turned, "COMPLETE")), Outcome::kVerified);
  EXPECT_NE(outcome(with_planar_claim(turned, "INCOMPLETE")), Outcome::kVerified);
}

TEST(PosesInThePlane, AreVerifiedWithTheirFile) {
  const std::string model = library_model("rpr_6");
  const Certified made = certified(model);
  ASSERT_EQ(made.solutions.found.size(), 6U);
  const verifier::Verification v = verified(made.text, model);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.roots, 6U);
  EXPECT_EQ(v.claim,
            "a platform on three legs in the plane with these anchors and lengths has exactly 6 "
            "poses, one within each line 'solution'");
  expect_planar_forgeries_fail(made.text);
  const std::string plain = without_sum(made.text);
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"14.98", "14.99"},
                                                        {"[0, 10]", "[0, 11]"},
                                                        {"17.04", "17.05"},
                                                        {"0.8826031098", "0.8826031099"},
                                                        {"20.84*sin", "20.84*cos"},
                                                        {"\"RPR\"", "\"RRR\""}}) {
    std::string changed = model;
    changed.replace(changed.find(from), from.size(), to);
    EXPECT_NE(outcome(plain, changed), Outcome::kVerified) << from;
  }
}

TEST(PosesOfRandomPlanarPlatforms, AreVerifiedWithTheirFiles) {
  RandomSource random(5);
  std::map<std::size_t, int> counts;
  for (int round = 0; round < 40; ++round) {
    PlanarPlatform platform(random);
    const bool is_degrees = round % 2 == 1, is_at_pose = round % 3 != 0;
    const double turn = is_degrees ? 360 : 2 * 3.14159265358979;
    if (is_at_pose)  // the angle is sometimes near half a turn, where the solver's values begin again
      platform.motion = fmt::format(
          "x = {:.2f}\ny = {:.2f}\nphi = {:.4f}\n", random.between(-9, 9), random.between(-9, 9),
          round % 5 == 0 ? turn / 2 - 1e-3 : random.between(-turn / 2, turn / 2));
    else
      platform.motion = fmt::format("legs = [{:.3f}, {:.3f}, {:.3f}]\n", random.between(3, 20),
                                    random.between(3, 20), random.between(3, 20));
    const std::string model = platform.text(is_degrees ? "deg" : "rad");
    const Certified made = certified(model);
    ASSERT_TRUE(is_complete(made.solutions)) << model;
    const verifier::Verification v = verified(made.text, model);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v) << model << made.text;
    ++counts[made.solutions.found.size()];
    if (round % 4 == 0 && !made.solutions.found.empty()) expect_planar_forgeries_fail(made.text);
  }
  EXPECT_GE(counts[0], 2);
  EXPECT_GE(counts[2], 5);
  EXPECT_GE(counts[4] + counts[6], 1);
}

}  // namespace
}  // namespace regulus::detail::test
