// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of lists of poses: genuine ones are verified and compared with their files, forged ones
// are not.
#include <fmt/format.h>

#include "tests/property/solve/certified_lists.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

/// Writes the claim and the end that belong to the lines.
std::string with_claim(const Lines& lines, const std::string& verdict) {
  Lines text = claiming(lines, verdict, format::kOfSixLegs, "pose", "poses");
  text.back() = "end " + std::to_string(count_of(text, "root"));
  return joined(text);
}

const std::string& dietmaier() {
  static const std::string certificate = certified(library_model("dietmaier")).text;
  return certificate;
}

std::string point(const std::array<double, 3>& p) {
  return fmt::format("[{}, {}, {}]", p[0], p[1], p[2]);
}

struct RandomPlatform {
  std::array<std::array<double, 3>, 6> base{}, platform{};
  std::array<double, 6> length{};

  explicit RandomPlatform(RandomSource& random) {
    for (std::size_t i = 0; i < 6; ++i) {
      for (auto* anchor : {&base[i], &platform[i]})
        for (double& x : *anchor) x = std::round(random.between(-1e4, 1e4)) / 1e4;
      length[i] = std::round(random.between(5e3, 2e4)) / 1e4;
    }
  }

  [[nodiscard]] std::string text() const {
    std::string base_text, platform_text, legs;
    for (std::size_t i = 0; i < 6; ++i) {
      const char* comma = i == 0 ? "" : ", ";
      base_text += comma + point(base[i]);
      platform_text += comma + point(platform[i]);
      legs += comma + fmt::format("{}", length[i]);
    }
    return fmt::format(
        "regulus = 1\nname = \"random\"\n[gough]\norientation = \"roll-pitch-yaw\"\nbase = [{}]\n"
        "platform = [{}]\n[motion.m]\nlegs = [{}]\n",
        base_text, platform_text, legs);
  }
};

TEST(DietmaiersFortyPoses, AreVerifiedWithTheirFile) {
  const verifier::Verification v = verified(dietmaier(), library_model("dietmaier"));
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.roots, 40U);
  EXPECT_EQ(v.real_roots, 40U);
  EXPECT_EQ(v.numbers, 42U);
  EXPECT_EQ(
      v.claim,
      "a platform on six legs with these anchors and lengths has exactly 40 poses, one within "
      "each line 'solution'");
}

TEST(PosesOfARandomPlatform, AreVerifiedWithTheirFile) {
  RandomSource random(11);
  int none = 0, some = 0;
  for (int round = 0; round < trials(5, 14); ++round) {
    const std::string model = RandomPlatform(random).text();
    const Certified made = certified(model);
    if (!is_complete(made.solutions)) continue;
    const verifier::Verification v = verified(made.text, model);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v) << model;
    EXPECT_EQ(v.roots, 40U);
    EXPECT_EQ(v.real_roots, made.solutions.found.size());
    ++(made.solutions.found.empty() ? none : some);
    // A platform whose leg is another one.
    std::string other = model;
    other.replace(other.find("legs = [") + 8, 1, "3");
    EXPECT_EQ(outcome(made.text, other), Outcome::kRejected);
  }
  EXPECT_GE(none, trials(0, 1));
  EXPECT_GE(some, trials(1, 4));
}

TEST(SixteenPosesOfLegsInPairs, AreVerifiedAndProveNothingOfOtherLegs) {
  RandomSource random(5);
  int complete = 0;
  for (int round = 0; round < 8; ++round) {
    RandomPlatform robot(random);
    auto& anchors = round % 2 == 0 ? robot.platform : robot.base;
    for (std::size_t i = 0; i < 6; i += 2) anchors[i + 1] = anchors[i];
    const std::string model = robot.text();
    const Certified made = certified(model);
    if (!is_complete(made.solutions) || made.solutions.boxes > 0) continue;
    ++complete;
    const verifier::Verification v = verified(made.text, model);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
    EXPECT_EQ(v.roots, 16U);
    Lines lines = lines_of(made.text);
    std::string& leg = lines[first(lines, "leg")];
    const std::string last = leg.substr(leg.rfind(" | "));
    leg = leg.substr(0, leg.rfind(" | "));
    leg += " + 1/1000000000000000000000000000000";  // of a coordinate at the platform
    leg += last;
    std::string& base = lines[first(lines, "leg")];
    base.insert(4, "1/1000000000000000000000000000000 + ");
    EXPECT_EQ(outcome(joined(lines)), Outcome::kRejected);
  }
  EXPECT_GE(complete, 4);
}

TEST(AForgedListOfPoses, IsRejected) {
  const Lines genuine = lines_of(dietmaier());
  const std::size_t root = first(genuine, "root"), solution = first(genuine, "solution");
  const auto forged = [&](const auto& change, const char* verdict) {
    Lines lines = genuine;
    change(lines);
    return outcome(with_claim(lines, verdict));
  };
  const auto left_out = [&](Lines& lines) { lines.erase(lines.begin() + std::ptrdiff_t(root)); };
  EXPECT_EQ(forged([](Lines&) {}, "COMPLETE"), Outcome::kVerified);
  EXPECT_EQ(forged(left_out, "COMPLETE"), Outcome::kRejected);
  EXPECT_EQ(
      forged([&](Lines& lines) { lines.insert(lines.begin() + std::ptrdiff_t(root), lines[root]); },
             "COMPLETE"),
      Outcome::kRejected);
  EXPECT_EQ(forged([&](Lines& lines) { lines[root] = lines[root + 1]; }, "COMPLETE"),
            Outcome::kRejected);
  // One pose fewer, one more, and none.
  EXPECT_EQ(forged([&](Lines& lines) { lines.erase(lines.begin() + std::ptrdiff_t(solution)); },
                   "COMPLETE"),
            Outcome::kRejected);
  EXPECT_EQ(forged(
                [&](Lines& lines) {
                  lines.insert(lines.begin() + std::ptrdiff_t(solution), lines[solution]);
                },
                "COMPLETE"),
            Outcome::kRejected);
  EXPECT_EQ(forged(
                [&](Lines& lines) {
                  std::erase_if(lines,
                                [](const std::string& l) { return l.starts_with("solution "); });
                },
                "NONE"),
            Outcome::kRejected);
  // At least these: a weaker claim, which is true, and one whose pose has no root.
  EXPECT_EQ(forged([](Lines&) {}, "INCOMPLETE"), Outcome::kVerified);
  EXPECT_EQ(forged(left_out, "INCOMPLETE"), Outcome::kRejected);
  // A pose that is none.
  EXPECT_EQ(forged(
                [&](Lines& lines) {
                  lines[solution] = "solution 0:0x1p-40 0:0x1p-40 1:1 1:1 0:0 0:0 0:0";
                },
                "COMPLETE"),
            Outcome::kRejected);
}

/// Rejected, and never verified, if a number of the legs is another one.
TEST(AForgedListOfPoses, IsNotOfOtherLegs) {
  RandomSource random(2);
  const Lines genuine = lines_of(dietmaier());
  for (const char* change : {" + 1/1000", " + 1/1000000000", " - 1/10"})
    for (std::size_t leg = 0; leg < 6; ++leg) {
      Lines lines = genuine;
      std::string& line = lines[first(genuine, "leg") + leg];
      std::size_t at = line.size();
      for (std::uint64_t i = random.below(4); i > 0; --i) at = line.rfind(" | ", at - 1);
      line.insert(at, change);
      EXPECT_EQ(outcome(joined(lines)), Outcome::kRejected) << line;
    }
}

TEST(AListOfPoses, IsNotVerifiedWithoutOneOfItsLines) {
  const Lines genuine = lines_of(dietmaier());
  for (std::size_t i = 0; i < genuine.size(); ++i) {
    Lines without = genuine, twice = genuine;
    without.erase(without.begin() + std::ptrdiff_t(i));
    twice.insert(twice.begin() + std::ptrdiff_t(i), genuine[i]);
    EXPECT_NE(outcome(joined(without)), Outcome::kVerified) << genuine[i];
    EXPECT_NE(outcome(joined(twice)), Outcome::kVerified) << genuine[i];
  }
}

TEST(AListOfPoses, IsComparedWithItsFile) {
  const std::string model = library_model("dietmaier");
  const std::string certificate = without_sum(dietmaier());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = model;
    changed.replace(changed.find(from), from.size(), to);
    return outcome(certificate, changed);
  };
  EXPECT_EQ(with("1.107915", "1.107915"), Outcome::kVerified);
  EXPECT_EQ(with("1.107915", "1.107914"), Outcome::kRejected);
  EXPECT_EQ(with("1.402538", "1.40253800000000000000000001"), Outcome::kRejected);
  EXPECT_EQ(with("0.771071]", "0.771072]"), Outcome::kRejected);
  EXPECT_EQ(with("0.771071]", "\"771071/1000000\"]"), Outcome::kVerified);
  EXPECT_EQ(with("0.771071]", "0.771071, 1]"), Outcome::kRejected);
  EXPECT_EQ(with("[motion.legs]", "[motion.other]"), Outcome::kRejected);
  EXPECT_EQ(with("Dietmaier's platform\"", "Another platform\""), Outcome::kRejected);
  EXPECT_EQ(with("[motion.legs]", "[motion.legs]\nfriction = 1"), Outcome::kUnfinished);
  EXPECT_EQ(with("[motion.legs]", "[load.x]\nforce = [0, 0, 1]\n[motion.legs]"),
            Outcome::kVerified);
  EXPECT_EQ(with("[gough]", "[matrix]\nrows = [[1]]\n[gough]"), Outcome::kUnfinished);
  // The claim is about one platform.
  EXPECT_EQ(with("[gough]", "[gough]\nbase_tolerance = 0.01"), Outcome::kUnfinished);
  EXPECT_EQ(with("[gough]", "[gough]\nbase_tolerance = 0.0"), Outcome::kVerified);
}

constexpr const char* kAtPose = R"toml(regulus = 1
name = "at a pose"
[geometry]
h = { value = 0.125, tolerance = 0 }
[let]
twice = "2*h"
[legs]
orientation = "euler-zxz"
angle_unit = "deg"
type = "UPS"
[[legs.leg]]
base = [0, 0, "h"]
platform = [0.1, 0, 0]
[[legs.leg]]
base = [1.107915, 0, 0]
platform = [0.542805, 0, "twice"]
[[legs.leg]]
base = [0.549094, 0.756063, 0]
platform = [0.956919, -0.528915, 0]
[[legs.leg]]
base = [0.735077, -0.223935, 0.525991]
platform = [0.665885, -0.353482, 1.402538]
[[legs.leg]]
base = [0.514188, -0.526063, -0.368418]
platform = [0.478359, 1.158742, 0.107672]
[[legs.leg]]
base = [0.590473, 0.094733, -0.205018]
platform = [-0.137087, -0.235121, 0.353913]
[motion.here]
x = "1/3"
y = 0.2
z = 1
psi = 10
theta = "25*deg"
phi = 5
)toml";

/// The lengths are those at a pose: of a motion, or of an option.
TEST(AListOfPoses, IsComparedWithThePlaceOfTheMotion) {
  const std::string model = kAtPose;
  const Certified made = certified(model);
  ASSERT_TRUE(made.status.is_written()) << made.status.obstacle();
  const verifier::Verification v = verified(made.text, model);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  const std::string plain = without_sum(made.text);
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"tolerance = 0 ", "tolerance = 0.001 "},
           {"base = [0.549094, 0.756063, 0]",
            "base = { value = [0.549094, 0.756063, 0], tolerance = 0.02 }"},
           {"phi = 5", "phi = 5\nerror = { x = 0.001 }"}}) {
    std::string changed = model;
    changed.replace(changed.find(from), from.size(), to);
    EXPECT_EQ(outcome(plain, changed), Outcome::kUnfinished) << from;
  }
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"25*deg", "26*deg"}, {"0.125", "0.25"}, {"psi = 10", "psi = 11"}, {"2*h", "3*h"}}) {
    std::string changed = model;
    changed.replace(changed.find(from), from.size(), to);
    EXPECT_EQ(outcome(plain, changed), Outcome::kRejected) << from;
  }
  const Certified by_option = certified(model, {"x=0.25"}, "here");
  ASSERT_TRUE(by_option.status.is_written()) << by_option.status.obstacle();
  EXPECT_EQ(outcome(by_option.text, model), Outcome::kRejected);
  const verifier::Verification allowed = verified(by_option.text, model, true);
  EXPECT_EQ(allowed.outcome, Outcome::kVerified) << describe(allowed);
  EXPECT_FALSE(allowed.differences.empty());
}

}  // namespace
}  // namespace regulus::detail::test
