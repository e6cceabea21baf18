// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs of a branch in shards, written by hand with the right hashes: of p² = 1 + x + y, whose two
// branches are ±√(1 + x + y). Each leaf is proved for either of them, so a claim about one branch is
// verified only if the links across shards are looked at.
#include "tests/support/branch_shards.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/support/temporary_directory.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::branch_shards_test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;
using verifier::ShardProof;
using verifier::Verification;

constexpr const char* kLines =
    "pose x = x\npose y = y\nunknown p = 1.4 +- 1/2\nstart 1/2\nstart 1/2\n"
    "equation p^2 - 1 - x - y\n";

std::string question(const std::string& lines = kLines, const std::string& more = "",
                     const std::string& claim = format::describe_closure_claim({1, 1}, false),
                     const char* verdict = "NO SINGULARITY") {
  return fmt::format(
      "regulus-certificate 1\nverdict {}\nclaim {}\nmodel by hand\nsha256 -\nmotion m\nalpha 0\n"
      "parameter x in 0 : 2\nparameter y in 0 : 2\n{}{}",
      verdict, claim, lines, more);
}

constexpr auto kUpper = [](const Place&) { return 1.0; };

class BranchShards : public testing::Test {
 protected:
  [[nodiscard]] Verification verify(const verifier::Options& options = {}) const {
    return proof_.verify_in((directory_.path() / "index").string(), options);
  }
  void expect(Outcome outcome, const std::string& why) const {
    const Verification v = verify();
    EXPECT_EQ(v.outcome, outcome) << describe(v);
    EXPECT_THAT(v.reason, HasSubstr(why));
  }
  void make(const BranchLines& lines, const std::vector<std::size_t>& sizes,
            const std::string& about = question()) {
    proof_ = HandmadeShards(about);
    proof_.shards = lines.cut(sizes);
  }

  const TemporaryDirectory directory_;
  HandmadeShards proof_{question()};
};

BranchLines square(int depth = 4) {
  BranchLines lines;
  lines.grow(0, depth, kUpper);
  return lines;
}

TEST_F(BranchShards, AreVerifiedAsTheProofInOneFile) {
  const BranchLines lines = square();
  const Verification one = verify_text(question() + "proof\n" + lines.text());
  ASSERT_EQ(one.outcome, Outcome::kVerified) << describe(one);
  ASSERT_EQ(one.leaves, 16U);
  EXPECT_EQ(one.links, 24U);
  for (const std::size_t size : {1U, 2U, 7U, 100U})
    for (const unsigned threads : {1U, 3U}) {
      make(lines, {size});
      verifier::Options options;
      options.threads = threads;
      const Verification v = verify(options);
      EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
      EXPECT_EQ(v.links, one.links);
      EXPECT_EQ(v.leaves, one.leaves);
      EXPECT_EQ(v.boxes, one.boxes);
      EXPECT_EQ(v.shards, (lines.size() + size - 1) / size);
    }
}

/// The tubes are made from known branches. So this test knows, without a verifier, if all are of the branch of
/// the start.
TEST_F(BranchShards, OfRandomTreesAreVerifiedIfAllTubesAreOfTheBranch) {
  std::mt19937 random(7);
  int verified = 0, refused = 0;
  for (int trial = 0; trial < trials(40, 400); ++trial) {
    const bool has_other = random() % 2 == 0;
    bool has_met_other = false;
    BranchLines lines;
    const auto sign = [&](const Place&) {
      const bool is_other = has_other && random() % 5 == 0;
      has_met_other |= is_other;
      return is_other ? -1.0 : 1.0;
    };
    std::vector<std::size_t> waiting{0};
    for (std::size_t splits = random() % 12; !waiting.empty();) {
      std::swap(waiting[random() % waiting.size()], waiting.back());
      const std::size_t number = waiting.back();
      waiting.pop_back();
      if (splits == 0) {
        lines.grow(number, 1 + int(random() % 2), sign);
        continue;
      }
      --splits;
      const std::size_t variable = random() % 2;
      const Range range = lines.box(number)[variable];
      const std::size_t lower =
          lines.split(number, variable, range[0] + (range[1] - range[0]) * (1 + random() % 7) / 8);
      waiting.insert(waiting.end(), {lower, lower + 1});
    }
    make(lines, {1 + random() % 9, 1 + random() % 5, 1 + random() % 20});
    const Verification v = verify();
    EXPECT_EQ(v.outcome == Outcome::kVerified, !has_met_other) << trial << describe(v);
    ++(has_met_other ? refused : verified);
  }
  EXPECT_GT(std::min(verified, refused), trials(40, 400) / 5);
}

TEST_F(BranchShards, OfWhichOneHasTheOtherAssemblyModeAreRejected) {
  BranchLines lines;
  lines.grow(0, 4, [](const Place& at) { return at[0][0] >= 1 && at[1][0] >= 1 ? -1.0 : 1.0; });
  make(lines, {8});
  ASSERT_GT(proof_.shards.size(), 3U);
  expect(Outcome::kRejected, "different configurations where their boxes meet");
  EXPECT_THAT(
      verify().reason,
      testing::MatchesRegex("line [0-9]+: shard [0-9]: line [0-9]+: the tubes of lines [0-9]+ "
                            "of shard [0-9] and [0-9]+ of shard [0-9] have .*"));
}

TEST_F(BranchShards, OfTheOtherAssemblyModeAloneAreRejected) {
  BranchLines lines;
  lines.grow(0, 4, [](const Place&) { return -1.0; });
  make(lines, {5});
  expect(Outcome::kRejected, "the tube has another configuration than the start");
  EXPECT_THAT(verify().reason, HasSubstr("shard 1: line "));
}

TEST_F(BranchShards, WhoseTubesAreExchangedAreRejected) {
  BranchLines lines = square();
  std::string* first = nullptr;
  for (std::size_t i = 0; i < lines.size() && first == nullptr; ++i)
    if (lines.line(i)[0] == 'l') first = &lines.line(i);
  std::string& last = lines.line(lines.size() - 1);
  const auto tube = [](std::string& line) { return line.find(" tube"); };
  const std::string of_first = first->substr(tube(*first)), of_last = last.substr(tube(last));
  first->replace(tube(*first), std::string::npos, of_last);
  last.replace(tube(last), std::string::npos, of_first);
  make(lines, {4});
  expect(Outcome::kRejected, "the tube has no configuration");
}

TEST_F(BranchShards, ThatNoChainJoinsAreUnfinished) {
  const std::string wall = "constraint 1/100 - (x - 1)^2\n";
  for (const double beyond : {1.0, -1.0}) {
    BranchLines lines;
    const std::size_t left = lines.split(0, 0, 0.9375);
    const std::size_t middle = lines.split(left + 1, 0, 1.0625);
    lines.grow(left, 3, kUpper);
    lines.leave_outside(middle);
    lines.grow(middle + 1, 3, [beyond](const Place&) { return beyond; });
    make(lines, {6}, question(kLines, wall));
    expect(Outcome::kUnfinished, "no chain of neighbours joins the tube of line ");
    EXPECT_THAT(verify().reason, HasSubstr(" of shard 1 to this one"));
  }
}

struct Forgery {
  const char* name;
  void (*change)(std::vector<HandmadeShard>&);
  const char* why;
};

constexpr const char* kNotWhereItEnds = "it does not begin where the shard before it ends";
constexpr Forgery kForgeries[] = {
    {"LackTheLast", [](auto& s) { s.pop_back(); }, "there are boxes without a leaf"},
    {"LackTheFirst", [](auto& s) { s.erase(s.begin()); }, kNotWhereItEnds},
    {"LackOne", [](auto& s) { s.erase(s.begin() + 1); }, kNotWhereItEnds},
    {"HaveOneTwice", [](auto& s) { s.insert(s.begin() + 1, s[1]); }, kNotWhereItEnds},
    {"Swapped", [](auto& s) { std::swap(s[1], s[2]); }, kNotWhereItEnds},
    {"LackALeaf",
     [](auto& s) {
       const std::size_t leaf = s[1].lines.find("l ");
       s[1].lines.erase(leaf, s[1].lines.find('\n', leaf) + 1 - leaf);
       --s[1].leaves;
     },
     kNotWhereItEnds},
    {"MoveALeaf",
     [](auto& s) {
       const std::size_t leaf = s[1].lines.find("l ");
       const std::string line = s[1].lines.substr(leaf, s[1].lines.find('\n', leaf) + 1 - leaf);
       s[1].lines.erase(leaf, line.size());
       s[2].lines = line + s[2].lines;
       --s[1].leaves, ++s[2].leaves;
     },
     "is not open"},
    {"HaveNumbersTooFew",
     [](auto& s) { s[1].lines.erase(s[1].lines.rfind(' '), s[1].lines.size()) += '\n'; },
     "expected 6 numbers after the word 'tube'"},
    {"HaveARadiusOfZero",
     [](auto& s) { s[1].lines.erase(s[1].lines.rfind(' '), s[1].lines.size()) += " 0x0p+0\n"; },
     "a radius of a tube is not positive"},
    {"HaveATree", [](auto& s) { s[1].lines = "tree\n" + s[1].lines; }, "expected 's BOX"},
};

TEST_F(BranchShards, ThatAreForgedAreRejected) {
  for (const Forgery& forgery : kForgeries) {
    make(square(), {8, 8, 8, 7});
    SCOPED_TRACE(forgery.name);
    ASSERT_EQ(verify().outcome, Outcome::kVerified) << describe(verify());
    forgery.change(proof_.shards);
    expect(Outcome::kRejected, forgery.why);
  }
}

/// Verifies each shard in one of two processes, as ranks do. `change`: of what the second one says.
template <class Change>
Verification by_two(const HandmadeShards& proof, const std::string& path, const Change& change) {
  std::vector<ShardProof> of_other;
  verifier::Options options;
  options.parts = 2, options.part = 1;
  options.exchange = [&](std::vector<ShardProof>& proofs) { of_other = proofs; };
  EXPECT_NE(proof.verify_in(path, options).outcome, Outcome::kVerified);
  options.part = 0;
  options.exchange = [&](std::vector<ShardProof>& proofs) {
    for (std::size_t i = 1; i < proofs.size(); i += 2) proofs[i] = of_other[i];
    change(proofs);
  };
  return proof.verify_in(path, options);
}

TEST_F(BranchShards, AreLinkedByOneOfSeveralProcesses) {
  make(square(), {8});
  const std::string path = (directory_.path() / "index").string();
  const Verification v = by_two(proof_, path, [](auto&) {});
  EXPECT_EQ(describe(v), describe(verify()));
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  // Another process may have read another file.
  EXPECT_THAT(by_two(proof_, path, [](auto& proofs) { proofs[1].lines = sha256("others"); }).reason,
              HasSubstr("shard 2: its lines are not those whose leaves were proved"));
  EXPECT_EQ(by_two(proof_, path, [](auto& proofs) { proofs[1].lines.clear(); }).outcome,
            Outcome::kRejected);
  EXPECT_EQ(by_two(proof_, path, [](auto& proofs) { proofs[1].is_proved = false; }).outcome,
            Outcome::kUnfinished);
  // All leaves are proved, of one branch or the other.
  BranchLines mixed;
  mixed.grow(0, 4, [](const Place& at) { return at[0][0] >= 1 ? -1.0 : 1.0; });
  make(mixed, {8});
  EXPECT_EQ(by_two(proof_, path, [](auto&) {}).outcome, Outcome::kRejected);
}

TEST_F(BranchShards, ThatChangeMeanwhileAreRejected) {
  make(square(), {8});
  const std::string path = (directory_.path() / "index").string();
  const auto change = [&](auto& proofs) {
    HandmadeShards other = proof_;
    other.shards[1].lines.replace(other.shards[1].lines.find("tube"), 4, "fake");
    std::ofstream(format::shard_file(path, 2), std::ios::binary) << other.text_of(1);
    ASSERT_TRUE(proofs[1].is_proved);
  };
  const Verification v = by_two(proof_, path, change);
  EXPECT_EQ(v.outcome, Outcome::kRejected);
  EXPECT_THAT(v.reason, HasSubstr("shard 2: its bytes are not those of the index"));
}

format::ClaimedBound speed_below(const char* bound) {
  format::ClaimedBound words;
  words.quantity = "speed", words.side = "absolute", words.columns = "1", words.bound = bound;
  words.is_of_closure = true;
  return words;
}

TEST_F(BranchShards, OfABoundAreVerifiedIfItIsKept) {
  // dp/dx = 1/(2p) is at most 1/2, and so is dp/dy.
  for (const auto& [bound, is_kept] : {std::pair("21/20", true), std::pair("19/20", false)}) {
    const format::ClaimedBound words = speed_below(bound);
    make(square(), {5},
         question(kLines,
                  "quantity speed\nside absolute\ncolumn 1\nmotor-speed 1\nmotor-speed 1\nbound " +
                      std::string(bound) + '\n',
                  format::describe_bound_claim({1, 1}, words, false)));
    const Verification v = verify();
    EXPECT_EQ(v.outcome == Outcome::kVerified, is_kept) << describe(v);
  }
}

/// Along s on each piece x = a + s, and y as before.
HandmadeShards way(const std::string& pieces, std::array<double, 3> signs,
                   const std::vector<std::size_t>& sizes, const std::string& more = "",
                   const std::string& claim = format::describe_closure_claim({1, 1}, false),
                   const char* verdict = "NO SINGULARITY") {
  BranchLines lines({{{0, 1}, {0, 2}}}, 1);
  for (std::size_t k = 0; k < 3; ++k) {
    if (k > 0) lines.tree();
    lines.grow(
        0, 4, [&](const Place&) { return signs[k]; }, double(k));
  }
  HandmadeShards proof(fmt::format(
      "regulus-certificate 1\nverdict {}\nclaim {}\nmodel by hand\nsha256 -\nmotion m\nalpha 0\n"
      "parameter s in 0 : 1\nparameter y in 0 : 2\npiecewise a\n{}pose x = a + s\npose y = y\n"
      "unknown p = 1.2 +- 1/2\nstart 0\nstart 1/2\nequation p^2 - 1 - x - y\n{}",
      verdict, claim, pieces, more));
  proof.shards = lines.cut(sizes);
  return proof;
}

constexpr const char* kPieces = "piece 0\npiece 1\npiece 2\n";

TEST_F(BranchShards, OfAWayAreVerified) {
  for (const std::size_t size : {1U, 9U, 31U, 40U, 1000U}) {
    proof_ = way(kPieces, {1, 1, 1}, {size});
    const Verification v = verify();
    EXPECT_EQ(v.outcome, Outcome::kVerified) << size << describe(v);
    EXPECT_EQ(v.pieces, 3U);
    EXPECT_EQ(v.leaves, 48U);
    EXPECT_EQ(v.links, 3U * 24 + 2 * 4);
  }
}

TEST_F(BranchShards, OfAWayOnAnotherBranchAfterAWayPointAreRejected) {
  for (const auto& signs : {std::array{1.0, -1.0, -1.0}, std::array{1.0, 1.0, -1.0}}) {
    proof_ = way(kPieces, signs, {10});
    expect(Outcome::kRejected, "different configurations where their boxes meet");
  }
  proof_ = way(kPieces, {-1, -1, -1}, {10});
  expect(Outcome::kRejected, "the tube has another configuration than the start");
}

TEST_F(BranchShards, OfAWayThatJumpsAreRejected) {
  proof_ = way("piece 0\npiece 1\npiece 2.0001\n", {1, 1, 1}, {10});
  expect(Outcome::kRejected, "piece 3 does not begin where piece 2 ends");
  proof_ = way(kPieces, {1, 1, 1}, {31});
  ASSERT_EQ(proof_.shards.size(), 4U);
  for (std::size_t lacking = 0; lacking < 4; ++lacking) {
    const std::vector<HandmadeShard> all = proof_.shards;
    proof_.shards.erase(proof_.shards.begin() + std::ptrdiff_t(lacking));
    EXPECT_EQ(verify().outcome, Outcome::kRejected) << lacking;
    proof_.shards = all;
  }
}

struct Attained {
  const char *value, *why;  ///< why it is not verified
  [[nodiscard]] Outcome outcome() const {
    if (*why == '\0') return Outcome::kVerified;
    return std::string(why).starts_with("it was not") ? Outcome::kUnfinished : Outcome::kRejected;
  }
};

std::pair<std::string, std::string> attained_bound(const char* bound) {
  const format::ClaimedBound words = speed_below(bound);
  return {"quantity speed\nside absolute\ncolumn 1\nmotor-speed 1\nmotor-speed 1\nbound " +
              std::string(bound) + '\n',
          format::describe_bound_claim({1, 1}, words, true)};
}

TEST_F(BranchShards, OfABoundThatIsAttainedHaveItsPlaceInTheIndex) {
  const auto [lines, claim] = attained_bound("19/20");  // 1/p is 1 at x = y = 0
  for (const Attained& attained :
       {Attained{"value 0x0p+0 0x0p+0\n", ""}, Attained{"", "expected the word 'value'"},
        Attained{"value 0x1p+0 0x0p+0\n", "it was not shown that the value is attained"},
        Attained{"value 0x0p+0 -0x1p+0\n", "the place of the value is outside"},
        Attained{"value 0x0p+0 0x0p+0\nvalue 0x0p+0 0x0p+0\n", "expected 'shard NUMBER"}}) {
    make(square(), {5}, question(kLines, lines, claim, "SINGULARITY"));
    proof_.value = attained.value;
    expect(attained.outcome(), attained.why);
  }
}

TEST_F(BranchShards, OfABoundThatIsAttainedOnAWayNameThePiece) {
  const auto [lines, claim] = attained_bound("2/3");  // 1/p is √2/2 at x = 1, y = 0
  for (const Attained& attained :
       {Attained{"value 1 0x1p+0 0x0p+0\n", ""}, Attained{"value 2 0x0p+0 0x0p+0\n", ""},
        Attained{"value 3 0x0p+0 0x0p+0\n", "it was not shown that the value is attained"},
        Attained{"", "there is no line 'value'"},
        Attained{"value 4 0x0p+0 0x0p+0\n", "expected a number up to 3"}}) {
    proof_ = way(kPieces, {1, 1, 1}, {12}, lines, claim, "SINGULARITY");
    proof_.value = attained.value;
    expect(attained.outcome(), attained.why);
  }
  proof_ = way(kPieces, {1, 1, 1}, {12});
  proof_.value = "value 1 0x0p+0 0x0p+0\n";
  expect(Outcome::kRejected, "a line 'value' is for a bound over a branch that is attained");
}

TEST_F(BranchShards, OfAWayToASingularConfigurationAreRejected) {
  const std::string claim = format::describe_closure_claim({1, 1}, true);
  make(square(), {5}, question(kLines, "", claim, "SINGULARITY"));
  expect(Outcome::kRejected, "an index is for the proof of a claim about all poses");
  proof_ = way(kPieces, {1, 1, 1}, {12}, "", claim, "SINGULARITY");
  expect(Outcome::kRejected, "an index is for the proof of a claim about all poses");
}

}  // namespace
}  // namespace regulus::detail::test::branch_shards_test
