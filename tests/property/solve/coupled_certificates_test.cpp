// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of postures of arms with joints that follow others, and of arms that turn about one direction: genuine
// ones are verified and compared with their files, forged ones are not. The arms, and where their ends are, are those
// of coupled_arms.hpp, which shares nothing with the solver and the verifier.
#include <algorithm>

#include "tests/property/solve/coupled_arms.hpp"
#include "tests/property/solve/level_arms.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::coupled_arms {
namespace {

/// With the claim that belongs to the lines.
Lines with_claim(Lines lines, const std::string& verdict) {
  std::size_t free = 0, followers = 0;
  for (const std::string& line : lines) {
    free += line.starts_with("joint ") || line.starts_with("sliding-joint ");
    followers += line.starts_with("following-");
  }
  const bool has_turning_tool = count_of(lines, "turning-tool") > 0;
  free += has_turning_tool;
  const std::string robot = format::describe_arm(free, has_turning_tool, followers > 0,
                                                 count_of(lines, "joint-range") > 0);
  return claiming(std::move(lines), verdict, robot.c_str(), "posture", "postures");
}

std::string text_with_claim(const Lines& lines, const std::string& verdict) {
  return joined(with_claim(lines, verdict));
}

Lines parts_of(const std::string& line, const std::string& bar) {
  Lines parts;
  std::size_t begin = 0;
  for (std::size_t at; (at = line.find(bar, begin)) != std::string::npos; begin = at + bar.size())
    parts.push_back(line.substr(begin, at - begin));
  parts.push_back(line.substr(begin));
  return parts;
}

/// With another text in the place of a number of a line, from 0.
std::string with_number(const std::string& line, std::size_t number, const std::string& other) {
  const std::size_t space = line.find(' ') + 1;
  Lines parts = parts_of(line.substr(space), " | ");
  parts.at(number) = other;
  return line.substr(0, space) + fmt::format("{}", fmt::join(parts, " | "));
}

/// The verifier may search longer for what is false.
Outcome outcome_of(const std::string& text, const std::string& model = "") {
  verifier::Options options;
  options.max_boxes = 5'000;
  options.model_text = model;
  options.model_name = "model.toml";
  std::istringstream stream(text);
  return verifier::verify(stream, options).outcome;
}

/// Each line of the list left out, repeated, moved and joined with another.
void expect_only_this_list(const Lines& genuine) {
  const std::size_t at = first(genuine, "solution"), count = count_of(genuine, "solution");
  for (std::size_t k = 0; k < count; ++k) {
    Lines fewer = genuine;
    fewer.erase(fewer.begin() + std::ptrdiff_t(at + k));
    const std::string text = text_with_claim(fewer, count == 1 ? "NONE" : "COMPLETE");
    EXPECT_NE(outcome_of(text), Outcome::kVerified) << k;
  }
  Lines twice = genuine;
  twice.insert(twice.begin() + std::ptrdiff_t(at), genuine[at]);
  EXPECT_NE(outcome_of(text_with_claim(twice, "COMPLETE")), Outcome::kVerified);
  EXPECT_NE(outcome_of(text_with_claim(twice, "INCOMPLETE")), Outcome::kVerified);
  if (count < 2) return;
  const auto tubes = tubes_of(joined(genuine));
  std::string both = "solution";
  for (std::size_t i = 0; i < tubes[0].size(); ++i)
    both += fmt::format(" {:a}:{:a}", std::min(tubes[0][i].lo, tubes[1][i].lo),
                        std::max(tubes[0][i].hi, tubes[1][i].hi));
  Lines merged = genuine;
  merged[at] = both;
  merged.erase(merged.begin() + std::ptrdiff_t(at) + 1);
  EXPECT_NE(outcome_of(text_with_claim(merged, "COMPLETE")), Outcome::kVerified);
  EXPECT_NE(outcome_of(text_with_claim(merged, "INCOMPLETE")), Outcome::kVerified);
}

/// Another multiplier, offset, axis, frame, leader or kind of each line of a joint. `model`: the genuine certificate's.
void expect_only_this_arm(const Lines& genuine, const std::string& model) {
  for (std::size_t i = 0; i < genuine.size(); ++i) {
    const std::string& line = genuine[i];
    const std::string key = line.substr(0, line.find(' '));
    if (!key.ends_with("joint") || key.starts_with("no-")) continue;
    std::vector<std::string> others = {with_number(line, 9, "123/100"), with_number(line, 12, "-1"),
                                       with_number(line, 0, "-1")};
    if (key.starts_with("following-"))
      for (const auto& [number, other] :
           std::vector<std::pair<std::size_t, const char*>>{{15, "1"},
                                                            {15, "2"},
                                                            {15, "9"},
                                                            {15, "0"},
                                                            {15, "3/2"},
                                                            {16, "7/10"},
                                                            {16, "0"},
                                                            {16, "-3"},
                                                            {17, "7/100"}})
        others.push_back(with_number(line, number, other));
    others.push_back((key.find("sliding-") == std::string::npos
                          ? key.substr(0, key.size() - 5) + "sliding-joint"
                          : key.substr(0, key.size() - 13) + "joint") +
                     line.substr(key.size()));
    for (const std::string& other : others) {
      if (other == line) continue;
      Lines changed = genuine;
      changed[i] = other;
      // The place by values of the joints may move with the arm, so that this is a true claim about another one.
      const bool has_other_place = count_of(genuine, "joint-value") > 0;
      const std::string text = text_with_claim(changed, "COMPLETE");
      if (!has_other_place) {
        EXPECT_NE(outcome_of(text), Outcome::kVerified) << other;
      }
      EXPECT_NE(outcome_of(text, model), Outcome::kVerified) << other;
    }
  }
}

struct Counts {
  int complete = 0, with_proof = 0, verified = 0;
};

/// Solves, proves and compares. Returns the certificate if it is verified.
std::string proved(const std::string& model, Counts& counts, const std::string& motion = "",
                   std::uint64_t boxes = 20'000) {
  const Certified made = certified(model, {}, motion, boxes);
  if (!is_complete(made.solutions)) return "";
  ++counts.complete;
  if (made.text.empty()) ADD_FAILURE() << made.status.obstacle() << model;
  if (made.text.empty()) return "";
  ++counts.with_proof;
  const verifier::Verification v = verified(made.text, model);
  EXPECT_NE(v.outcome, Outcome::kRejected) << describe(v) << model;
  if (v.outcome != Outcome::kVerified) return "";
  ++counts.verified;
  return without_sum(made.text);
}

TEST(ListsOfAnArmWithFollowers, AreVerifiedWithTheirFiles) {
  RandomSource random(71);
  Counts counts;
  const int rounds = trials(3, 60);
  for (int round = 0; round < rounds; ++round) {
    const Arm arm = random_arm(random, 1 + std::size_t(round % 3 == 2));
    const std::string model = text_of(arm, random_values(random, arm));
    const std::string text = proved(model, counts);
    if (text.empty() || round > 0) continue;
    expect_only_this_list(lines_of(text));
    expect_only_this_arm(lines_of(text), model);
  }
  EXPECT_GE(counts.complete, rounds * 3 / 4);
  EXPECT_EQ(counts.with_proof, counts.complete);
  EXPECT_GE(counts.verified, rounds / 2);
}

/// The list of the verifier is that of Newton's method: one that lacks a posture is not verified.
TEST(ListsOfAnArmWithAParallelogram, AreVerifiedWithTheirFiles) {
  Counts counts;
  const int rounds = trials(4, 40);
  for (int round = 0; round < rounds; ++round) {
    RandomSource random(std::uint64_t(round) + 80);
    const Arm arm = usual_arm(random, true);
    const Numbers planted = random_values(random, arm);
    const std::string model = text_of(arm, planted), text = proved(model, counts);
    if (text.empty()) continue;
    const auto tubes = tubes_of(text);
    EXPECT_EQ(std::ranges::count_if(tubes,
                                    [&](const auto& tube) {
                                      Numbers q = planted;
                                      for (std::size_t i = 0; i < q.size(); ++i)
                                        q[i] +=
                                            std::round((mid(tube[i]) - q[i]) / 6.283185307179586) *
                                            6.283185307179586;
                                      return is_within(q, tube);
                                    }),
              1)
        << model;
    if (round > 1) continue;
    expect_only_this_list(lines_of(text));
    expect_only_this_arm(lines_of(text), model);
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"multiplier = -1", "multiplier = -0.99"},
             {"multiplier = -1", "multiplier = 1"},
             {"offset = 0", "offset = 0.001"},
             {"mimic = \"q2\"", "mimic = \"q1\""},
             {"mimic = \"q2\", multiplier = -1, offset = 0, type = \"revolute\"",
              "mimic = \"q2\", multiplier = -1, offset = 0, type = \"prismatic\""}})
      EXPECT_NE(outcome(text, replaced(model, from, to)), Outcome::kVerified) << to;
  }
  EXPECT_EQ(counts.verified, rounds);
}

/// A follower of half the speed is as before after two turns: postures that differ by one turn are two.
TEST(ListsOverTwoTurns, HaveThePosturesOfBoth) {
  RandomSource random(73);
  Counts counts;
  bool has_both = false;
  const int rounds = trials(3, 20);
  for (int round = 0; round < rounds; ++round) {
    Arm arm = usual_arm(random, true);
    arm[1].turns = 2, arm[2].multiplier = round % 2 == 0 ? -0.5 : 1.5;
    const std::string model = text_of(arm, random_values(random, arm)),
                      text = proved(model, counts);
    if (text.empty()) continue;
    const Lines genuine = lines_of(text);
    expect_only_this_list(genuine);
    Interval all = tubes_of(text).front()[1];
    for (const auto& tube : tubes_of(text)) all = hull(all, tube[1]);
    has_both = has_both || width_ru(all) > 6.3;
    EXPECT_NE(
        outcome(text, replaced(model, round % 2 == 0 ? "multiplier = -0.5" : "multiplier = 1.5",
                               "multiplier = -1")),
        Outcome::kVerified);
  }
  EXPECT_TRUE(has_both);
  EXPECT_GE(counts.verified, rounds - 1);
}

TEST(ListsWhereNoTurnBringsAllBack, AreThoseInTheRanges) {
  RandomSource random(74);
  Counts counts;
  struct Coupled {
    std::size_t leader;
    bool leader_slides, follower_slides;
    double multiplier;
  };
  const std::vector<Coupled> pairs = {{0, false, true, 0.1},      // a screw
                                      {2, true, true, 1},         // a telescope
                                      {3, true, false, 1.25},     // a rack
                                      {1, false, false, 0.123}};  // gears
  for (const Coupled& pair : pairs) {
    Arm arm = usual_arm(random, false);
    for (Joint& joint : arm) joint.xyz = random_vector(random);
    arm[pair.leader].turns = 0;
    arm[pair.leader].slides = pair.leader_slides;
    arm.insert(arm.begin() + std::ptrdiff_t(pair.leader) + 1, {.xyz = random_vector(random),
                                                               .axis = {0, 0, 1},
                                                               .slides = pair.follower_slides,
                                                               .leader = pair.leader,
                                                               .multiplier = pair.multiplier,
                                                               .offset = 0.2});
    const std::string model = text_of(arm, random_values(random, arm), kRange),
                      text = proved(model, counts, "at");
    if (text.empty()) continue;
    const Lines genuine = lines_of(text);
    ASSERT_EQ(count_of(genuine, "joint-range"), 1U);
    EXPECT_NE(genuine[first(genuine, "claim")].find("within the lines 'joint-range'"),
              std::string::npos);
    expect_only_this_list(genuine);
    const std::size_t at = first(genuine, "joint-range");
    const std::string number = std::to_string(pair.leader + 1);
    Lines without = genuine, other = genuine;
    without.erase(without.begin() + std::ptrdiff_t(at));
    EXPECT_EQ(outcome_of(text_with_claim(without, "COMPLETE")), Outcome::kRejected);
    other[at] = "joint-range " + number + " in -1/1000 : 1/1000";
    EXPECT_NE(outcome_of(text_with_claim(other, "COMPLETE"), model), Outcome::kVerified);
    for (const char* range : {"joint-range 7 in -1 : 1", "joint-range 0 in -1 : 1",
                              "joint-range 6 in -4 : 4", "joint-range 5 in 1 : -1"}) {
      other[at] = range;
      EXPECT_EQ(outcome_of(text_with_claim(other, "COMPLETE")), Outcome::kRejected) << range;
    }
    std::string wider = model;
    const std::size_t begin = wider.find("[-1.5, 1.5]");
    ASSERT_NE(begin, std::string::npos);
    EXPECT_EQ(outcome_of(text, wider.replace(begin, 11, "[-1.5, 1.6]")), Outcome::kRejected);
  }
  EXPECT_GE(counts.verified, 2);
}

/// Slides one behind the other are nowhere else, and the claim needs no range of them.
TEST(ListsOfAnArmOnRails, AreVerifiedWithTheirFiles) {
  RandomSource random(81);
  Counts counts;
  const int rounds = trials(3, 20);
  for (int round = 0; round < rounds; ++round) {
    Arm arm;
    do {
      arm = usual_arm(random, false);
      for (Joint& joint : arm) joint.xyz = random_vector(random);
      arm[0].axis = {1, 2, 2}, arm[1].axis = {0, 3, 4}, arm[2].axis = {0, 0, 1};
      for (std::size_t i = 0; i < 2 + std::size_t(round % 2); ++i) arm[i].slides = true;
    } while (std::fabs(determinant(arm, random_values(random, arm))) < 1e-2);
    const std::string model = text_of(arm, random_values(random, arm)),
                      text = proved(model, counts, "", 100'000);
    if (text.empty()) continue;
    EXPECT_EQ(text.find("joint-range"), std::string::npos);
    expect_only_this_list(lines_of(text));
    if (round < 2) expect_only_this_arm(lines_of(text), model);
    for (const char* pair : {"none", "1 2", "4 5", "1 1", "6 7"}) {
      Lines other = lines_of(text);
      other[first(other, "left-out")] = fmt::format("left-out {}", pair);
      other.erase(other.begin() + std::ptrdiff_t(first(other, "solution")));
      const char* verdict = count_of(other, "solution") == 0 ? "NONE" : "COMPLETE";
      EXPECT_NE(outcome_of(text_with_claim(other, verdict)), Outcome::kVerified) << pair;
    }
  }
  EXPECT_EQ(counts.verified, rounds);
}

TEST(ListsOfALevelArm, AreVerifiedWithTheirFiles) {
  RandomSource random(75);
  Counts counts;
  const int rounds = trials(6, 100);
  for (int round = 0; round < rounds; ++round) {
    const Arm arm = round % 2 == 0 ? palletizer(random) : scara(random);
    const std::string model = text_of(arm, random_values(random, arm)),
                      text = proved(model, counts);
    if (text.empty() || round > 5) continue;
    expect_only_this_list(lines_of(text));
    expect_only_this_arm(lines_of(text), model);
  }
  EXPECT_EQ(counts.verified, rounds);
}

/// Any two joints may be left out that nothing follows, and none: the list is the same.
TEST(ListsOfALevelArm, AreProvedWithoutAnyTwoJoints) {
  RandomSource random(76);
  Counts counts;
  Arm arm = scara(random);
  const std::string model = text_of(arm, random_values(random, arm)), text = proved(model, counts);
  ASSERT_FALSE(text.empty());
  int verified = 0;
  for (std::size_t a = 1; a <= 4; ++a)
    for (std::size_t b = 1; b <= 5; ++b) {
      Lines lines = lines_of(text);
      lines[first(lines, "left-out")] = fmt::format("left-out {} {}", a, b);
      const Outcome found = outcome_of(joined(lines));
      if (a == b || b == 5) {
        EXPECT_EQ(found, Outcome::kRejected);
      }
      verified += found == Outcome::kVerified;
      Lines fewer = lines;
      fewer.erase(fewer.begin() + std::ptrdiff_t(first(lines, "solution")));
      const char* verdict = count_of(fewer, "solution") == 0 ? "NONE" : "COMPLETE";
      EXPECT_NE(outcome_of(text_with_claim(fewer, verdict)), Outcome::kVerified) << a << b;
    }
  EXPECT_GE(verified, 6);
}

/// An arm of four joints that do not turn about one direction has no such proof.
TEST(AnArmOfFourJoints, IsNotTakenForALevelOne) {
  RandomSource random(77);
  Counts counts;
  const Arm arm = palletizer(random);
  const std::string text = proved(text_of(arm, random_values(random, arm)), counts);
  ASSERT_FALSE(text.empty());
  const Lines genuine = lines_of(text);
  for (std::size_t i = 0, seen = 0; i < genuine.size(); ++i) {
    if (!genuine[i].starts_with("following-joint ") || ++seen > 2) continue;
    for (const char* multiplier : {"-1 + 1e-30", "1", "-2", "-sqrt(2)"}) {
      Lines changed = genuine;
      changed[i] = with_number(genuine[i], 16, multiplier);
      EXPECT_EQ(outcome_of(text_with_claim(changed, "COMPLETE")), Outcome::kUnfinished)
          << multiplier;
    }
  }
}

TEST(APlaceThatALevelArmIsTurnedAwayFrom, IsVerifiedToBeNone) {
  RandomSource random(78);
  const Arm arm = palletizer(random);
  const std::string all = text_of(arm, {0, 0, 0, 0}),
                    head = all.substr(0, all.find("[motion.")) + "[motion.there]\ntool = ";
  Counts counts;
  const std::string away = proved(head + "[0.5, 0.2, 0.3, 1e-9, 0, 0.3]\n", counts);
  ASSERT_FALSE(away.empty());
  EXPECT_NE(away.find("verdict NONE"), std::string::npos);
  EXPECT_EQ(outcome(away, head + "[0.5, 0.2, 0.3, 0, 0, 0.3]\n"), Outcome::kRejected);
  Lines level = lines_of(away);
  std::string& tool = level[first(level, "tool")];
  tool = replaced(tool, parts_of(tool, " | ")[3], "0");
  EXPECT_EQ(lines_of(away).size(), level.size());
  // A place so near that the arm reaches it has postures; one that is far away has none, by a search.
  const std::string far = proved(head + "[9, 0.2, 0.3, 0, 0, 0.3]\n", counts);
  ASSERT_FALSE(far.empty());
  EXPECT_EQ(counts.verified, 2);
}

TEST(ListsWithTolerances, AreVerifiedForArmsWithFollowers) {
  RandomSource random(79);
  Counts counts;
  for (int round = 0; round < trials(2, 10); ++round) {
    const Arm arm = round % 2 == 0 ? palletizer(random) : usual_arm(random, true);
    std::string model = text_of(arm, random_values(random, arm));
    model.insert(model.find("joints ="), "length_tolerance = 1e-6\n");
    const std::string text = proved(model, counts);
    if (text.empty()) continue;
    EXPECT_NE(outcome(text, replaced(model, "1e-6", "1e-5")), Outcome::kVerified);
    expect_only_this_list(lines_of(text));
  }
  EXPECT_GE(counts.verified, 1);
}

}  // namespace
}  // namespace regulus::detail::test::coupled_arms
