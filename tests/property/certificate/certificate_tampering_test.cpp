// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/certificate/certificate_tampering.hpp"

#include <algorithm>
#include <cctype>

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

/// Returns a proof for robot 2 with seven boxes or more; the question is true as asked.
const std::string& proof() {
  static const std::string text = certify(robot("robot_2", "table5_20", "20")).text;
  return text;
}
const std::string& witness() {
  static const std::string text = certify(robot("planar_3rpr", "crossing")).text;
  return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::vector<std::size_t> lines_with(const std::vector<std::string>& lines, const char* start) {
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].starts_with(start)) at.push_back(i);
  return at;
}

void expect_rejected(const std::string& text, const std::string& why) {
  const auto v = verify_text(text, little_effort());
  EXPECT_EQ(v.outcome, Outcome::kRejected);
  EXPECT_NE(v.reason.find(why), std::string::npos) << v.reason;
}

TEST(ACertificate, IsVerifiedAsItWasWritten) {
  for (const std::string& text : {proof(), witness()})
    EXPECT_EQ(verify_text(text).outcome, Outcome::kVerified) << verify_text(text).reason;
}

TEST(ALeaf, CannotBeLeftOut) {
  const auto lines = lines_of(proof());
  for (const std::size_t at : lines_with(lines, "l ")) {
    auto changed = lines;
    changed.erase(changed.begin() + std::ptrdiff_t(at));
    expect_rejected(joined(changed), "no leaf");
  }
}

TEST(ALeaf, CannotBeThereTwice) {
  const auto lines = lines_of(proof());
  for (const std::size_t at : lines_with(lines, "l ")) {
    auto changed = lines;
    changed.insert(changed.begin() + std::ptrdiff_t(at), lines[at]);
    expect_rejected(joined(changed), "is not open");
  }
}

TEST(ALeaf, CannotComeBeforeTheSplitThatMakesIt) {
  const auto lines = lines_of(proof());
  for (const std::size_t at : lines_with(lines, "l ")) {
    auto changed = lines;
    changed.erase(changed.begin() + std::ptrdiff_t(at));
    changed.insert(changed.begin() + std::ptrdiff_t(lines_with(lines, "s ").front()), lines[at]);
    expect_rejected(joined(changed), "is not open");
  }
}

TEST(ASplit, CannotBeLeftOutOrLieOutsideItsBox) {
  const auto lines = lines_of(proof());
  for (const std::size_t at : lines_with(lines, "s ")) {
    auto changed = lines;
    changed.erase(changed.begin() + std::ptrdiff_t(at));
    EXPECT_EQ(verify_text(joined(changed)).outcome, Outcome::kRejected);
    changed = lines;
    changed[at] = changed[at].substr(0, changed[at].rfind(' ')) + " 0x1p+40";
    expect_rejected(joined(changed), "not inside the box");
  }
}

/// The claim does not depend on the cuts: any cut within its box tiles the variety as well, so a
/// verified certificate has the claim that was proved.
TEST(ACut, ThatIsMovedByADigitLeavesTheClaimOrTheProofAsItIs) {
  const auto lines = lines_of(proof());
  const std::string claim = verify_text(proof()).claim;
  for (const std::size_t at : lines_with(lines, "s "))
    for (std::size_t i = lines[at].rfind("0x") + 2; i < lines[at].find('p'); ++i) {
      if (std::isxdigit(static_cast<unsigned char>(lines[at][i])) == 0) continue;
      auto changed = lines;
      changed[at][i] = changed[at][i] == '7' ? '3' : '7';
      const auto v = verify_text(joined(changed), little_effort());
      EXPECT_EQ(v.claim, claim);
      EXPECT_NE(v.outcome == Outcome::kVerified, !v.reason.empty());
    }
}

std::string replaced_everywhere(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

TEST(ALargerQuestion, IsNotProvedByASmallerOne) {
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"+- 20", "+- 900"},
           {"in -1/9*pi : 1/9*pi", "in -9/9*pi : 9/9*pi"},
           {"parameter z in 2800 : 3200", "parameter z in 0 : 3200"}}) {
    const std::string changed = replaced_everywhere(proof(), from, to);
    EXPECT_NE(changed, proof());
    EXPECT_NE(verify_text(changed, little_effort()).outcome, Outcome::kVerified) << from;
  }
}

TEST(AnotherExpression, IsNotProvedByTheTreeOfTheFirst) {
  const auto lines = lines_of(proof());
  // A matrix with a zero row is singular everywhere.
  const auto entries = lines_with(lines, "entry ");
  auto changed = lines;
  for (std::size_t j = 0; j < 6; ++j) changed[entries[j]] = "entry 0";
  EXPECT_NE(verify_text(joined(changed), little_effort()).outcome, Outcome::kVerified);
  // A matrix with two equal rows is singular, too.
  changed = lines;
  for (std::size_t j = 0; j < 6; ++j) changed[entries[j]] = lines[entries[6 + j]];
  EXPECT_NE(verify_text(joined(changed), little_effort()).outcome, Outcome::kVerified);
}

TEST(TheHeaderOfAnotherProof, IsNotProvedByThisTree) {
  const std::string other = certify(robot("robot_1", "wide_15")).text;
  const std::string wide = replaced(other, "in -1/12*pi : 1/12*pi", "in -2/9*pi : 2/9*pi");
  for (const std::string& header : {other, wide}) {
    const std::string mixed =
        header.substr(0, header.find("\nproof")) + proof().substr(proof().find("\nproof"));
    const auto v = verify_text(mixed, little_effort());
    if (v.outcome != Outcome::kVerified) continue;
    RandomSource random(1);
    EXPECT_EQ(ClaimRefutation(mixed, random).found(), "");
  }
}

TEST(AClaim, MustBeInTheWordsOfItsQuestion) {
  expect_rejected(replaced(proof(), "6x6", "5x5"), "the claim is not about");
  expect_rejected(replaced(proof(), "verdict NO SINGULARITY", "verdict SINGULARITY"),
                  "the claim is not about");
}

TEST(AWitness, MustLieInTheVarietyAndHaveTheSignsItStates) {
  const std::string& text = witness();
  expect_rejected(replaced(replaced(text, "point +", "point *"), "point *", "point -"), "point +");
  auto lines = lines_of(text);
  const auto points = lines_with(lines, "point ");
  ASSERT_EQ(points.size(), 2u);
  auto swapped = lines;
  swapped[points[0]] = "point +" + lines[points[1]].substr(7);
  swapped[points[1]] = "point -" + lines[points[0]].substr(7);
  expect_rejected(joined(swapped), "the other sign");
  auto outside = lines;
  outside[points[0]] = "point + 0x1p+9 0x1p+4 0x0p+0";
  expect_rejected(joined(outside), "outside the ranges");
}

TEST(RandomChanges, NeverLeadToAFalseClaimThatIsVerified) {
  RandomSource random(20261121);
  const int verified = judge_random_changes(proof(), 12, random);
  EXPECT_LT(verified, 9) << "labels, rules and cuts can be changed, but not most of the bytes";
  judge_random_changes(certify(robot("planar_3rpr", "regular", "0.2")).text, 30, random);
}

TEST(RandomChanges, OfAWitnessAreReadWithoutHarm) {
  RandomSource random(20261122);
  for (int change = 0; change < 300; ++change)
    EXPECT_NO_THROW((void)verify_text(with_one_byte_changed(witness(), random), little_effort()));
}

}  // namespace
}  // namespace regulus::detail::test
