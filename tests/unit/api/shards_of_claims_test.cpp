// SPDX-License-Identifier: GPL-3.0-or-later
// The proof of every claim may be in shards, and nothing but all of them is verified.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "codegen/answer/certificate/verify_file.hpp"
#include "runtime/files/sha256.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/verifier/input_file.hpp"
#include "tests/unit/api/claims_in_shards.hpp"

namespace regulus::detail::test::claims_in_shards {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using verifier::Outcome;
using verifier::Verification;

constexpr std::size_t kLongestText = 1 << 24;
constexpr std::size_t kMostFiles = 2;  ///< of a datasheet
std::string text_of(const fs::path& path) {
  return verifier::read_text(path.string(), kLongestText);
}

/// A proof in shards, in memory.
struct Cut {
  std::string path, index;
  std::vector<std::string> shards;

  static Cut read(const std::string& path) {
    Cut cut{path, text_of(path), {}};
    while (fs::exists(format::shard_file(path, cut.shards.size() + 1)))
      cut.shards.push_back(text_of(format::shard_file(path, cut.shards.size() + 1)));
    return cut;
  }
  /// Replaces the files.
  void write() const {
    fs::remove_all(path + format::kShardsEnding);
    fs::create_directory(path + format::kShardsEnding);
    std::ofstream(path, std::ios::binary) << index;
    for (std::size_t i = 0; i < shards.size(); ++i)
      std::ofstream(format::shard_file(path, i + 1), std::ios::binary) << shards[i];
  }
  /// Gives the shards their numbers, and the index their leaves and hashes.
  void sign() {
    index.erase(index.find("\nshard ", index.find("\nproof\n")) + 1);
    std::size_t leaves = 0;
    for (std::size_t i = 0; i < shards.size(); ++i) {
      std::string& text = shards[i];
      const std::size_t number = text.find("\nshard ") + 7;
      text.replace(number, text.find('\n', number) - number, std::to_string(i + 1));
      const std::string count =
          text.substr(text.rfind("end ") + 4, text.size() - 5 - text.rfind("end "));
      index += "shard " + std::to_string(i + 1) + ' ' + count + ' ' + sha256(text) + '\n';
      leaves += std::stoul(count);
    }
    index += "end " + std::to_string(leaves) + '\n';
  }
};

Verification verify_there(const std::string& path, unsigned threads = 1) {
  verifier::InputFile bytes(path);
  std::istream file(&bytes);
  verifier::Options options;
  options.path = path;
  options.threads = threads;
  return verifier::verify(file, options);
}

/// Leaves out the first leaf.
void forget_a_leaf(std::string& shard) {
  const std::size_t leaf = shard.find("\nl ");
  if (leaf == std::string::npos) return;
  shard.erase(leaf, shard.find('\n', leaf + 1) - leaf);
  const std::size_t end = shard.rfind("end ") + 4;
  shard.replace(end, std::string::npos, std::to_string(std::stoul(shard.substr(end)) - 1) + '\n');
}

struct Attack {
  const char* name;
  bool signs;  ///< with numbers and hashes that agree
  void (*change)(Cut& cut, const std::string& foreign);
};

constexpr Attack kAttacks[] = {
    {"missing", false, [](Cut& c, const std::string&) { c.shards.pop_back(); }},
    {"doubled", false, [](Cut& c, const std::string&) { c.shards[1] = c.shards[0]; }},
    {"swapped", false, [](Cut& c, const std::string&) { std::swap(c.shards[0], c.shards[1]); }},
    {"changed", false, [](Cut& c, const std::string&) { c.shards[1].back() = ' '; }},
    {"cut off", false,
     [](Cut& c, const std::string&) { c.shards[1].resize(c.shards[1].size() / 2); }},
    {"foreign", false, [](Cut& c, const std::string& other) { c.shards[0] = other; }},
    {"lack the last", true, [](Cut& c, const std::string&) { c.shards.pop_back(); }},
    {"lack the first", true, [](Cut& c, const std::string&) { c.shards.erase(c.shards.begin()); }},
    {"lack the second", true,
     [](Cut& c, const std::string&) { c.shards.erase(c.shards.begin() + 1); }},
    {"have one twice", true,
     [](Cut& c, const std::string&) { c.shards.insert(c.shards.begin() + 1, c.shards[1]); }},
    {"are in another order", true,
     [](Cut& c, const std::string&) { std::swap(c.shards[0], c.shards[1]); }},
    {"are of another proof", true, [](Cut& c, const std::string& other) { c.shards[0] = other; }},
    {"forget a leaf", true,
     [](Cut& c, const std::string&) {
       for (std::string& shard : c.shards) forget_a_leaf(shard);
     }},
};

class Shards : public AClaim {
 protected:
  /// Returns the indices that a question wrote, those with most shards first.
  [[nodiscard]] std::vector<Cut> cuts() const {
    std::vector<Cut> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path()))
      if (entry.path().filename().string().starts_with("cut") && entry.is_regular_file() &&
          text_of(entry.path()).starts_with(format::kIndexMagic))
        found.push_back(Cut::read(entry.path()));
    std::ranges::sort(found, [](const Cut& a, const Cut& b) {
      return std::tuple(a.shards.size(), a.path) > std::tuple(b.shards.size(), b.path);
    });
    return found;
  }
};

/// Compares it with the proof in one file.
void expect_same_proof(const Cut& cut, const std::string& whole) {
  const Verification one = verify_there(whole), v = verify_there(cut.path);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << v.reason;
  EXPECT_EQ(v.shards, cut.shards.size());
  EXPECT_EQ(v.pieces, one.pieces);
  EXPECT_EQ(v.leaves, one.leaves);
  EXPECT_EQ(v.links, one.links);
  EXPECT_EQ(v.paved, one.paved);
  EXPECT_EQ(v.claim, one.claim);
  const std::string text = text_of(whole);
  const auto question = [](const std::string& from) {
    return from.substr(from.find('\n'), from.find("\nproof\n") - from.find('\n'));
  };
  EXPECT_EQ(question(cut.index), question(text));
  EXPECT_EQ(verify_there(cut.path, 3).boxes, v.boxes);
}

TEST_P(Shards, AreVerifiedTogetherAndOnlyTogether) {
  prove(path("cut"), GetParam().claim.shard_size);
  if (GetParam().claim.is_repeatable) prove(path("whole"), 0);
  std::vector<Cut> found = cuts();
  ASSERT_FALSE(found.empty());
  // Which bounds a datasheet proves, and so the lengths of its proofs, depend on time.
  std::ranges::stable_sort(found, std::greater{}, [](const Cut& cut) { return cut.shards.size(); });
  for (const Cut& cut : std::span(found).first(std::min(found.size(), kMostFiles))) {
    SCOPED_TRACE(cut.path);
    const std::string name = fs::path(cut.path).filename();
    if (GetParam().claim.is_repeatable) expect_same_proof(cut, path("whole" + name.substr(3)));
    VerificationRequest request{cut.path, model_, "", true, {}};
    const Verification v = verify_file(request);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << v.reason;
    EXPECT_GT(v.numbers, 0U);
  }
  const Cut& genuine = found[0];
  if (!GetParam().claim.is_repeatable && genuine.shards.size() < 3)
    GTEST_SKIP() << "this run has short proofs alone";
  ASSERT_GE(genuine.shards.size(), 3U);
  const std::string foreign = std::string(format::kShardMagic) + "\nquestion " + sha256("another") +
                              genuine.shards[0].substr(genuine.shards[0].find("\nshard "));
  for (const Attack& attack : kAttacks) {
    SCOPED_TRACE(attack.name);
    Cut attacked = genuine;
    attack.change(attacked, foreign);
    if (attack.signs) attacked.sign();
    attacked.write();
    const Verification v = verify_there(attacked.path);
    EXPECT_EQ(v.outcome, Outcome::kRejected) << v.reason;
    EXPECT_FALSE(v.reason.empty());
  }
  Cut signed_again = genuine;
  signed_again.sign();
  signed_again.write();
  EXPECT_EQ(verify_there(genuine.path).outcome, Outcome::kVerified);
}

std::vector<Case> claims_with_shards() {
  std::vector<Case> all;
  for (const Claim& claim : kClaims)
    for (const bool is_along_way : {false, true})
      if (const Kind kind = is_along_way ? claim.along : claim.variety;
          !refusal(kind, Service::kShards))
        all.push_back({claim, is_along_way});
  return all;
}

INSTANTIATE_TEST_SUITE_P(OfEachClaim, Shards, testing::ValuesIn(claims_with_shards()),
                         [](const auto& which) { return name_of(which.param); });

TEST(ShardsOfClaims, AreRefusedWhereThereIsNoProof) {
  for (std::size_t k = 0; k < kKinds; ++k)
    EXPECT_EQ(refusal(Kind(k), Service::kShards).has_value(),
              refusal(Kind(k), Service::kProof).has_value())
        << name(Kind(k));
  // Lists of solutions are tried elsewhere.
  EXPECT_EQ((std::size(kClaims) + 2) * 2, kKinds);
}

}  // namespace
}  // namespace regulus::detail::test::claims_in_shards
