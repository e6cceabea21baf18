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

#include "codegen/answer/ask.hpp"
#include "codegen/answer/certificate/verify_file.hpp"
#include "codegen/answer/refusals.hpp"
#include "codegen/use/api/regulus.hpp"
#include "runtime/files/sha256.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/verifier/input_file.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using verifier::Outcome;
using verifier::Verification;

constexpr std::size_t kLongestText = 1 << 24;
constexpr std::size_t kMostFiles = 2;  ///< of a datasheet
// In bytes: every line is a shard, or some forty lines are.
constexpr std::uint64_t kOneLine = 1, kManyLines = 600;

/// det J⁻¹ = cos h: regular up to a tolerance of π/2, in many boxes.
constexpr const char* kTurn = R"toml(regulus = 1
name = "turn"
[pose]
x = "m"
y = "m"
[geometry]
h = { value = 0, tolerance = 0, group = "base" }
[matrix]
twist = ["v_x", "v_y"]
rows = [["cos(x*y)", "sin(x*y)"], ["-sin(x*y + h)", "cos(x*y + h)"]]
[load.weight]
force = [[-1, 1], [-3, -1]]
[actuators]
force = [-5, 5]
error = 0.1
[motion.box]
x = [0, 1]
y = [0, 1]
[motion.way]
waypoints = "way.csv"
)toml";

constexpr const char* kWay = "x,y\n0.1,0.2\n1,0.5\n0.3,1\n";

SearchOptions interpreted() {
  SearchOptions options;
  options.engine = Engine::kInterpreted;
  return options;
}

/// Asks a kind of question about a variety or along way-points.
struct Claim {
  const char* name;
  Kind variety, along;
  Asked (*asked)(ModelOptions model);
  std::uint64_t shard_size = kOneLine;
  bool is_repeatable = true;  ///< its ends do not depend on the time that is left
};

Asked with_tolerance(ModelOptions model, const std::string& range) {
  model.tolerances = {"base=" + range};
  AskMargin asked{std::move(model), interpreted(), {}};
  asked.gap = "0.5";
  return asked;
}

QuantityOptions force() { return {.quantity = "force", .load = "weight", .row = "1"}; }

constexpr Claim kClaims[] = {
    {"Check", Kind::kCheck, Kind::kWayCheck,
     [](ModelOptions model) {
       model.tolerances = {"base=0.3"};
       return Asked(AskCheck{std::move(model), interpreted()});
     }},
    {"Paving", Kind::kPaving, Kind::kWayPaving,
     [](ModelOptions model) {
       return Asked(AskPaving{std::move(model), interpreted(), "1/4"});
     }},
    {"Margin", Kind::kMargin, Kind::kWayMargin,
     [](ModelOptions model) { return with_tolerance(std::move(model), "0.1:0.3"); }},
    {"LimitMargin", Kind::kLimitMargin, Kind::kWayLimitMargin,
     [](ModelOptions model) {
       auto asked = std::get<AskMargin>(with_tolerance(std::move(model), "0:0.3"));
       asked.quantity = force();
       asked.limit = "6";
       return Asked(asked);
     }},
    {"Bound", Kind::kBound, Kind::kWayBound,
     [](ModelOptions model) {
       return Asked(AskBound{std::move(model), interpreted(), force(), "", "0.1"});
     }},
    {"Condition2", Kind::kCondition2, Kind::kWayCondition2,
     [](ModelOptions model) {
       const QuantityOptions condition{.quantity = "condition", .norm = "2"};
       return Asked(AskBound{std::move(model), interpreted(), condition, "", "0.5"});
     }},
    {"Load", Kind::kLoad, Kind::kWayLoad,
     [](ModelOptions model) {
       return Asked(AskLoad{std::move(model), interpreted()});
     }},
    {"LoadPaving", Kind::kLoadPaving, Kind::kWayLoadPaving,
     [](ModelOptions model) {
       return Asked(AskLoadPaving{std::move(model), interpreted(), "", "1/8"});
     }},
    {"Datasheet", Kind::kDatasheet, Kind::kWayDatasheet,
     [](ModelOptions model) {
       return Asked(AskDatasheet{std::move(model), interpreted(), "0.5"});
     },
     kManyLines, false},
};

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
    index.erase(index.find("\nproof\n") + 7);
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

struct Case {
  const Claim& claim;
  bool is_along_way;
};

std::string name_of(const Case& one) {
  return one.claim.name + std::string(one.is_along_way ? "AlongWayPoints" : "");
}
void PrintTo(const Case& one, std::ostream* out) { *out << name_of(one); }

class Shards : public testing::TestWithParam<Case> {
 protected:
  Shards() {
    std::ofstream(model_) << kTurn;
    std::ofstream(folder_.path() / "way.csv") << kWay;
  }

  /// Answers the question with a proof; 0: in one file.
  void prove(const std::string& path, std::uint64_t shard_size) const {
    const auto& [claim, is_along_way] = GetParam();
    ModelOptions model;
    model.path = model_;
    model.motion = is_along_way ? "way" : "box";
    Services services;
    services.certificate = path;
    services.shard_size = shard_size;
    std::visit([&](const auto& asked) { static_cast<void>(ask(asked, services)); },
               claim.asked(std::move(model)));
  }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path() / name; }

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

  const TemporaryDirectory folder_;
  const std::string model_ = folder_.path() / "turn.toml";
};

/// Compares it with the proof in one file.
void expect_same_proof(const Cut& cut, const std::string& whole) {
  const Verification one = verify_there(whole), v = verify_there(cut.path);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << v.reason;
  EXPECT_EQ(v.shards, cut.shards.size());
  EXPECT_EQ(v.pieces, one.pieces);
  EXPECT_EQ(v.leaves, one.leaves);
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

/// The proof of a branch links its boxes with each other.
TEST(ShardsOfClaims, AreRefusedWhereThereIsNoProofABranchOrAList) {
  for (std::size_t k = 0; k < kKinds; ++k) {
    const bool is_branch = Kind(k) == Kind::kFiniteErrors || Kind(k) >= Kind::kClosureCheck;
    // Of a list of solutions the proof has as many lines as there are roots.
    const bool is_list = k % std::size_t(Kind::kWayCheck) == std::size_t(Kind::kSolve);
    EXPECT_EQ(refusal(Kind(k), Service::kShards).has_value(),
              is_branch || is_list || refusal(Kind(k), Service::kProof).has_value())
        << name(Kind(k));
  }
  // Closures, finite errors and lists of solutions are tried elsewhere.
  EXPECT_EQ((std::size(kClaims) + 2) * 4, kKinds);
}

}  // namespace
}  // namespace regulus::test
