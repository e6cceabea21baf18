// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs about the places of a table in shards, written by hand with the right hashes: p² = x has two
// solutions at each x > 0, and none at x < 0.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include "runtime/files/sha256.hpp"
#include "runtime/proof/format.hpp"
#include "tests/support/certificate_texts.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test::place_shards_test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;
using verifier::ShardProof;
using verifier::Verification;

/// The part about a place; `solutions`: how many of the two are listed.
std::string part(int x, std::size_t solutions = 2, const char* model = "by hand") {
  const std::size_t count = x < 0 ? 0 : solutions;
  const format::ClaimedSolutions claimed{x < 0 ? format::kNone : format::kComplete,
                                         format::kOfUnknowns,
                                         "configuration",
                                         "configurations",
                                         count,
                                         0};
  std::string text = fmt::format(
      "regulus-certificate 1\nverdict {}\nclaim {}\nmodel {}\nsha256 -\nmotion m\nalpha 0\n"
      "pose x = {}\nunknown p = 0 +- 10\nequation p^2 - x\n",
      claimed.verdict, format::describe_solutions_claim(claimed), model, x);
  const double root = std::sqrt(std::abs(double(x)));
  for (std::size_t i = 0; i < count; ++i)
    text += fmt::format("solution {:a}:{:a}\n", (i == 0 ? -root : root) - 1e-3,
                        (i == 0 ? -root : root) + 1e-3);
  return text + "proof\nend\n";
}

/// A shard: its parts with their numbers.
struct Shard {
  std::size_t first;  ///< number of the first part
  std::vector<std::string> parts;
};

class PlaceShards : public testing::Test {
 protected:
  [[nodiscard]] static std::string text_of(const Shard& shard, std::size_t number) {
    std::string text = fmt::format("{}\nshard {}\n", format::kPlacesShardMagic, number);
    for (std::size_t k = 0; k < shard.parts.size(); ++k)
      text += fmt::format("place {}\n{}", shard.first + k, shard.parts[k]);
    return text + fmt::format("places {}\n", shard.parts.size());
  }
  [[nodiscard]] std::string index() const {
    std::string text = std::string(format::kPlacesIndexMagic) + '\n';
    std::size_t all = 0;
    for (std::size_t i = 0; i < shards_.size(); ++i) {
      text += fmt::format("shard {} {} {}\n", i + 1, shards_[i].parts.size(),
                          sha256(text_of(shards_[i], i + 1)));
      all += shards_[i].parts.size();
    }
    return text + fmt::format("places {}\n", all);
  }
  [[nodiscard]] std::string path() const { return (directory_.path() / "index").string(); }
  void write() const {
    std::filesystem::create_directories(path() + format::kShardsEnding);
    for (std::size_t i = 0; i < shards_.size(); ++i)
      std::ofstream(format::shard_file(path(), i + 1), std::ios::binary)
          << text_of(shards_[i], i + 1);
  }
  [[nodiscard]] Verification verify(verifier::Options options = {}) const {
    write();
    options.path = path();
    return verify_text(index(), options);
  }
  void expect(Outcome outcome, const std::string& why) const {
    const Verification v = verify();
    EXPECT_EQ(v.outcome, outcome) << describe(v);
    EXPECT_THAT(v.reason, HasSubstr(why));
  }

  const TemporaryDirectory directory_;
  std::vector<Shard> shards_{{1, {part(4), part(-1)}}, {3, {part(9)}}, {4, {part(1), part(2)}}};
};

TEST_F(PlaceShards, AreVerifiedAsTheProofInOneFile) {
  std::string whole = std::string(format::kPlacesMagic) + '\n';
  std::size_t places = 0;
  for (const Shard& shard : shards_)
    for (const std::string& one : shard.parts) whole += fmt::format("place {}\n{}", ++places, one);
  const Verification one = verify_text(whole + "places 5\n");
  ASSERT_EQ(one.outcome, Outcome::kVerified) << describe(one);
  const Verification v = verify();
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.claim, one.claim);
  EXPECT_EQ(v.places, 5U);
  EXPECT_EQ(v.shards, 3U);
  EXPECT_EQ(v.boxes, one.boxes);
  EXPECT_EQ(v.model, "by hand");
}

struct Forgery {
  const char* name;
  void (*change)(std::vector<Shard>&);
  const char* why;
};

constexpr Forgery kForgeries[] = {
    {"LackTheFirst", [](auto& s) { s.erase(s.begin()); }, "expected the line 'place 1'"},
    {"LackOne", [](auto& s) { s.erase(s.begin() + 1); }, "expected the line 'place 3'"},
    {"HaveOneTwice", [](auto& s) { s.insert(s.begin() + 1, s[1]); }, "expected the line 'place 4'"},
    {"Swapped", [](auto& s) { std::swap(s[1], s[2]); }, "expected the line 'place 3'"},
    {"HaveNoPlace", [](auto& s) { s[1].parts.clear(); }, "expected the next place"},
    {"NumberPlacesAnew", [](auto& s) { s[2].first = 1; }, "expected the line 'place 4'"},
    {"LackASolution", [](auto& s) { s[2].parts[1] = part(2, 1); }, "shard 3: line "},
    {"ClaimNone",
     [](auto& s) { s[0].parts[0].replace(s[0].parts[0].find("pose x = 4"), 10, "pose x = -4"); },
     "shard 1: line "},
    {"AreOfAnotherModel", [](auto& s) { s[1].parts[0] = part(9, 2, "another"); },
     "shard 2: it is about another model or motion than the first part"},
    {"AreOfAnotherModelInOneShard", [](auto& s) { s[0].parts[1] = part(-1, 0, "another"); },
     "it is about another model or motion than the first part"},
    {"HaveAPartOfAnotherKind", [](auto& s) { s[1].parts[0] = scalar_question("x") + kOneLeaf; },
     "a part about a place has no claim about all solutions"},
    {"HaveTextBehind", [](auto& s) { s[1].parts[0] += "end\n"; }, "shard 2: line "},
};

TEST_F(PlaceShards, ThatAreForgedAreRejected) {
  const std::vector<Shard> genuine = shards_;
  for (const Forgery& forgery : kForgeries) {
    SCOPED_TRACE(forgery.name);
    shards_ = genuine;
    ASSERT_EQ(verify().outcome, Outcome::kVerified);
    forgery.change(shards_);
    expect(Outcome::kRejected, forgery.why);
  }
}

TEST_F(PlaceShards, WithOtherBytesThanTheIndexSaysAreRejected) {
  write();
  verifier::Options options;
  options.path = path();
  const std::string listed = index();
  for (std::size_t size = 0; size < listed.size(); ++size)
    EXPECT_EQ(verify_text(listed.substr(0, size), options).outcome, Outcome::kRejected) << size;
  for (const char* more : {"shard 4 1 00\n", "places 5\n", "x\n"})
    EXPECT_EQ(verify_text(listed + more, options).outcome, Outcome::kRejected) << more;
  std::ofstream(format::shard_file(path(), 2)) << text_of({3, {part(16)}}, 2);
  EXPECT_THAT(verify_text(listed, options).reason,
              HasSubstr("shard 2: its bytes are not those of the index"));
  std::filesystem::copy_file(format::shard_file(path(), 3), format::shard_file(path(), 2),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(verify_text(listed, options).reason, HasSubstr("shard 2: it is another shard"));
  std::filesystem::remove(format::shard_file(path(), 2));
  EXPECT_THAT(verify_text(listed, options).reason, HasSubstr("shard 2: it is missing"));
  EXPECT_THAT(verify_text(listed).reason, HasSubstr("need its path"));
}

/// One that is false counts more than one that is open.
TEST_F(PlaceShards, WithAnEmptyPartAreUnfinished) {
  shards_[0].parts[1].clear();
  expect(Outcome::kUnfinished, "shard 1: place 2: it has no proof");
  shards_[2].parts[0] = part(1, 1);
  expect(Outcome::kRejected, "shard 3: ");
}

/// Verifies each shard in one of two processes, as ranks do. `change`: of what the second one says.
template <class Change>
Verification by_two(const std::string& index, const std::string& path, const Change& change) {
  std::vector<ShardProof> of_other;
  verifier::Options options;
  options.path = path;
  options.parts = 2, options.part = 1;
  options.exchange = [&](std::vector<ShardProof>& proofs) { of_other = proofs; };
  EXPECT_NE(verify_text(index, options).outcome, Outcome::kVerified);
  options.part = 0;
  options.exchange = [&](std::vector<ShardProof>& proofs) {
    for (std::size_t i = 1; i < proofs.size(); i += 2) proofs[i] = of_other.at(i);
    change(proofs);
  };
  return verify_text(index, options);
}

TEST_F(PlaceShards, AreProvedBySeveralProcesses) {
  const Verification one = verify();
  const Verification two = by_two(index(), path(), [](auto&) {});
  EXPECT_EQ(two.outcome, Outcome::kVerified);
  EXPECT_EQ(describe(two), describe(one));
  EXPECT_EQ(by_two(index(), path(), [](auto& proofs) { proofs[1] = {}; }).outcome,
            Outcome::kUnfinished);
  EXPECT_EQ(by_two(index(), path(), [](auto& proofs) { proofs[1].about.clear(); }).outcome,
            Outcome::kRejected);
  shards_[1].parts[0] = part(9, 1);
  write();
  const Verification refuted = by_two(index(), path(), [](auto&) {});
  EXPECT_EQ(refuted.outcome, Outcome::kRejected);
  EXPECT_EQ(refuted.reason, verify().reason);
}

TEST_F(PlaceShards, ShareTheLimitOfBoxes) {
  verifier::Options few;
  few.max_boxes = verify().boxes - 1;
  const Verification v = verify(few);
  EXPECT_EQ(v.outcome, Outcome::kUnfinished);
  EXPECT_THAT(v.reason, HasSubstr("boxes"));
}

}  // namespace
}  // namespace regulus::detail::test::place_shards_test
