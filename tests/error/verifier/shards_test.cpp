// SPDX-License-Identifier: GPL-3.0-or-later
// A person who writes shards by hand, with the right hashes, cannot have a claim verified that the
// shards do not prove together.
#include "tests/support/shards.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;
using verifier::ShardProof;
using verifier::Verification;

class Shards : public testing::Test {
 protected:
  [[nodiscard]] Verification verify(const verifier::Options& options = {}) const {
    return proof_.verify_in((directory_.path() / "index").string(), options);
  }
  void expect_rejected(const std::string& why) const {
    const Verification v = verify();
    EXPECT_EQ(v.outcome, Outcome::kRejected);
    EXPECT_THAT(v.reason, HasSubstr(why));
  }

  const TemporaryDirectory directory_;
  /// x in [1, 9] is cut at 5, 3 and 7; the four leaves are in three shards.
  HandmadeShards proof_ = [] {
    HandmadeShards proof(scalar_question("x", "1 : 9"));
    proof.shards = {
        {"next 1\nopen 0\n", "s 0 0 0x5p+0\ns 1 0 0x3p+0\nl 3 mean-value\n", 1},
        {"next 5\nopen 4 0 0x3p+0 0x5p+0\nopen 2 0 0x5p+0 -\n", "l 4 mean-value\ns 2 0 0x7p+0\n",
         1},
        {"next 7\nopen 5 0 0x5p+0 0x7p+0\nopen 6 0 0x7p+0 -\n", "l 5 mean-value\nl 6 mean-value\n",
         2},
    };
    return proof;
  }();
};

TEST_F(Shards, ThatProveTheClaimTogetherAreVerified) {
  for (const unsigned threads : {1U, 3U}) {
    verifier::Options options;
    options.threads = threads;
    const Verification v = verify(options);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << v.reason;
    EXPECT_EQ(v.shards, 3U);
    EXPECT_EQ(v.leaves, 4U);
  }
}

TEST_F(Shards, OrderAndPlaceOfOpenBoxesDoNotMatter) {
  proof_.shards[1].open = "next 5\nopen 2 0 0x5p+0 0x9p+0\nopen 4 0 0x3p+0 0x5p+0\n";
  EXPECT_EQ(verify().outcome, Outcome::kVerified) << verify().reason;
}

TEST_F(Shards, ThatLackOneAreRejected) {
  proof_.shards.pop_back();
  expect_rejected("after the last shard there are boxes without a leaf");
}

TEST_F(Shards, ThatLackOneInBetweenAreRejected) {
  proof_.shards.erase(proof_.shards.begin() + 1);
  expect_rejected("shard 2: it does not begin where the shard before it ends");
}

TEST_F(Shards, ThatLackTheFirstAreRejected) {
  proof_.shards.erase(proof_.shards.begin());
  expect_rejected("shard 1: it does not begin where the shard before it ends");
}

TEST_F(Shards, InAnotherOrderAreRejected) {
  std::swap(proof_.shards[1], proof_.shards[2]);
  expect_rejected("shard 2: it does not begin where the shard before it ends");
}

TEST_F(Shards, OfWhichOneIsDoubledAreRejected) {
  proof_.shards.insert(proof_.shards.begin() + 1, proof_.shards[1]);
  expect_rejected("shard 3: it does not begin where the shard before it ends");
}

TEST_F(Shards, ThatForgetABoxAreRejected) {
  proof_.shards[1].open = "next 5\nopen 4 0 0x3p+0 0x5p+0\n";
  proof_.shards[1].lines = "l 4 mean-value\n";
  proof_.shards[2] = {"next 5\n", "", 0};
  expect_rejected("shard 2: it does not begin where the shard before it ends");
}

TEST_F(Shards, ThatMakeABoxSmallerAreRejected) {
  proof_.shards[1].open = "next 5\nopen 4 0 0x3.8p+0 0x5p+0\nopen 2 0 0x5p+0 -\n";
  expect_rejected("shard 2: it does not begin where the shard before it ends");
}

TEST_F(Shards, ThatNumberBoxesAnewAreRejected) {
  proof_.shards[2] = {"next 9\nopen 5 0 0x5p+0 0x7p+0\nopen 6 0 0x7p+0 -\n",
                      "l 5 mean-value\nl 6 mean-value\n", 2};
  expect_rejected("shard 3: it does not begin where the shard before it ends");
}

TEST_F(Shards, WhoseFirstDoesNotBeginWithBox0AreRejected) {
  proof_.shards[0].open = "next 1\nopen 0 0 0x2p+0 -\n";
  expect_rejected("shard 1: it does not begin where the shard before it ends");
}

TEST_F(Shards, WithDamagedLinesAreRejected) {
  const HandmadeShards whole = proof_;
  for (const char* open :
       {"next\nopen 0\n", "open 0\n", "next 1\nopen 0\nopen 0\n", "next 1\nopen 0 0 nan -\n",
        "next 1\nopen 0 0 inf -\n", "next 1\nopen 0 7 - -\n", "next 1\nopen 0 0 0x3p+0 0x2p+0\n",
        "next 1\nopen 0 0 -\n", "next 1\nopen\n", "next -1\nopen 0\n",
        "next 1\nopen 0 0 - -\n\n"}) {
    proof_ = whole;
    proof_.shards[0].open = open;
    EXPECT_EQ(verify().outcome, Outcome::kRejected) << open;
    EXPECT_THAT(verify().reason, HasSubstr("shard 1: line ")) << open;
  }
}

TEST_F(Shards, WithAWrongLeafNameShardAndLine) {
  proof_ = HandmadeShards(scalar_question("x - 6", "1 : 9"));
  proof_.shards = {{"next 1\nopen 0\n", "s 0 0 0x4p+0\nl 1 mean-value\n", 1},
                   {"next 3\nopen 2 0 0x4p+0 -\n", "l 2 mean-value\n", 1}};
  const Verification v = verify();
  EXPECT_EQ(v.outcome, Outcome::kRejected);
  EXPECT_THAT(v.reason, HasSubstr("shard 2: line 7: leaf of box 2 (mean-value): "));
}

TEST_F(Shards, OfAnotherSignAreRejectedTogether) {
  // Each shard alone is true; between them the determinant is 0.
  proof_ = HandmadeShards(scalar_question("x - 6", "1 : 9"));
  proof_.shards = {{"next 1\nopen 0\n", "s 0 0 0x4p+0\nl 1 mean-value\ns 2 0 0x6p+0\n", 1},
                   {"next 5\nopen 3 0 0x4p+0 0x6p+0\nopen 4 0 0x6p+0 -\n", "l 4 mean-value\n", 1}};
  EXPECT_NE(verify().outcome, Outcome::kVerified);
}

TEST_F(Shards, WithoutTheirFilesAreRejectedByName) {
  EXPECT_EQ(verify().outcome, Outcome::kVerified);
  const std::string path = (directory_.path() / "index").string();
  std::filesystem::remove(format::shard_file(path, 2));
  verifier::Options options;
  options.path = path;
  EXPECT_THAT(verify_text(proof_.index(), options).reason, HasSubstr("shard 2: it is missing"));
  std::filesystem::copy(format::shard_file(path, 3), format::shard_file(path, 2));
  EXPECT_THAT(verify_text(proof_.index(), options).reason,
              HasSubstr("shard 2: it is another shard: its line is 'shard 3'"));
  std::ofstream(format::shard_file(path, 2)) << proof_.text_of(1) << "l 0 mean-value\n";
  EXPECT_THAT(verify_text(proof_.index(), options).reason,
              HasSubstr("shard 2: its bytes are not those of the index"));
  HandmadeShards foreign(scalar_question("x + 1", "1 : 9"));
  foreign.shards = proof_.shards;
  std::ofstream(format::shard_file(path, 2)) << foreign.text_of(1);
  EXPECT_THAT(verify_text(proof_.index(), options).reason,
              HasSubstr("shard 2: it belongs to the proof of another question"));
  std::filesystem::remove(format::shard_file(path, 2));
  std::filesystem::create_directory(format::shard_file(path, 2));
  EXPECT_THAT(verify_text(proof_.index(), options).reason, HasSubstr("it is a directory"));
}

TEST_F(Shards, NeedThePathOfTheIndex) {
  EXPECT_THAT(verify_text(proof_.index()).reason,
              HasSubstr("the shards of an index need its path"));
}

TEST_F(Shards, OfAnIndexThatIsDamagedAreRejected) {
  ASSERT_EQ(verify().outcome, Outcome::kVerified);
  const std::string index = proof_.index();
  verifier::Options options;
  options.path = (directory_.path() / "index").string();
  for (std::size_t size = 0; size < index.size(); ++size)
    EXPECT_EQ(verify_text(index.substr(0, size), options).outcome, Outcome::kRejected) << size;
  for (const char* more : {"shard 4 1 00\n", "end 4\n", "x\n"})
    EXPECT_EQ(verify_text(index + more, options).outcome, Outcome::kRejected) << more;
}

TEST_F(Shards, OfOneTreeHaveNoPiecesAndNoOtherTree) {
  const HandmadeShards whole = proof_;
  proof_.shards[0].open = "piece 1\nnext 1\nopen 0\n";
  expect_rejected("expected 'next BOX'");
  proof_ = whole;
  proof_.shards[2].lines += "tree\nl 0 mean-value\n";
  proof_.shards[2].leaves = 3;
  expect_rejected("expected 's BOX VARIABLE AT', 'l BOX RULE' or 'end LEAVES'");
}

/// Returns a question about the entry x along s, x = a + s, for each value of a.
std::string piecewise_question(const std::string& pieces) {
  return "regulus-certificate 1\n" + std::string(kFullRank1) +
         "model by hand\nsha256 -\nmotion way\nalpha 0\nparameter s in 0 : 1\npiecewise a\n" +
         pieces + "pose x = a + s\nmatrix 1 1\nentry x\n";
}

/// Three trees: the first is cut at 1/2, and in two shards, of which the second has another tree.
HandmadeShards three_trees(const std::string& pieces = "piece 1\npiece 2\npiece 3\n") {
  HandmadeShards proof(piecewise_question(pieces));
  proof.shards = {
      {"piece 1\nnext 1\nopen 0\n", "s 0 0 0x1p-1\nl 1 mean-value\n", 1},
      {"piece 1\nnext 3\nopen 2 0 0x1p-1 -\n", "l 2 mean-value\ntree\nl 0 mean-value\n", 2},
      {"piece 2\nnext 1\n", "tree\nl 0 mean-value\n", 1},
  };
  return proof;
}

TEST_F(Shards, OfTheTreesOfAllPiecesAreVerified) {
  proof_ = three_trees();
  for (const unsigned threads : {1U, 3U}) {
    verifier::Options options;
    options.threads = threads;
    const Verification v = verify(options);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << v.reason;
    EXPECT_EQ(v.pieces, 3U);
    EXPECT_EQ(v.shards, 3U);
    EXPECT_EQ(v.leaves, 4U);
  }
  proof_.shards[1].lines += "tree\n";  // it belongs to the one shard or to the other
  proof_.shards[2] = {"piece 3\nnext 1\nopen 0\n", "l 0 mean-value\n", 1};
  EXPECT_EQ(verify().outcome, Outcome::kVerified) << verify().reason;
}

TEST_F(Shards, OfPiecesWhoseDeterminantsHaveOtherSignsAreVerified) {
  proof_ = three_trees("piece -4\npiece 2\npiece -3\n");
  EXPECT_EQ(verify().outcome, Outcome::kVerified) << verify().reason;
}

TEST_F(Shards, OfAPieceThatIsSingularAreRejected) {
  for (const char* pieces : {"piece -1/4\npiece 2\npiece 3\n", "piece -3/4\npiece 2\npiece 3\n",
                             "piece 1\npiece -1/2\npiece 3\n", "piece 1\npiece 2\npiece -1\n"}) {
    proof_ = three_trees(pieces);
    EXPECT_NE(verify().outcome, Outcome::kVerified) << pieces;
  }
}

/// A change of shards of trees, with the right hashes.
struct Forgery {
  const char* name;
  void (*change)(std::vector<HandmadeShard>&);
  const char* why;
};

constexpr const char* kNotWhereItEnds = "it does not begin where the shard before it ends";
constexpr Forgery kForgeries[] = {
    {"LackTheLast", [](auto& s) { s.pop_back(); },
     "after the last shard there are boxes without a leaf, or pieces without a tree"},
    {"LackTheFirst", [](auto& s) { s.erase(s.begin()); }, kNotWhereItEnds},
    {"LackOne", [](auto& s) { s.erase(s.begin() + 1); }, kNotWhereItEnds},
    {"Doubled", [](auto& s) { s.push_back(s.back()); }, kNotWhereItEnds},
    {"Swapped", [](auto& s) { std::swap(s[1], s[2]); }, kNotWhereItEnds},
    {"SkipAPiece",
     [](auto& s) {
       s[1] = {"piece 2\nnext 1\nopen 0\n", "l 0 mean-value\n", 1};
     },
     kNotWhereItEnds},
    {"ProveAPieceTwice",
     [](auto& s) {
       s[2] = {"piece 2\nnext 1\nopen 0\n", "l 0 mean-value\n", 1};
     },
     kNotWhereItEnds},
    {"EndBehindAnEarlierPiece",
     [](auto& s) {
       s[2] = {"piece 2\nnext 1\n", "", 0};
     },
     "boxes without a leaf, or pieces without a tree"},
    {"ClaimTheLastPiece",
     [](auto& s) {
       s[2] = {"piece 3\nnext 1\n", "", 0};
     },
     kNotWhereItEnds},
    {"LeaveABoxOfATree",
     [](auto& s) {
       s[1] = {s[1].open, "tree\nl 0 mean-value\n", 1};
     },
     "1 box has no leaf, for example box 2"},
    {"BeginTheNextTreeWithABoxOfThis",
     [](auto& s) {
       s[1] = {"piece 1\nnext 3\n", "tree\nl 0 mean-value\n", 1};
     },
     kNotWhereItEnds},
    {"HaveATreeTooMany", [](auto& s) { s[2].lines += "tree\nl 0 mean-value\n", ++s[2].leaves; },
     "there are more trees than pieces"},
    {"HaveNoPiece", [](auto& s) { s[0].open = "next 1\nopen 0\n"; }, "expected 'piece NUMBER'"},
    {"HaveThePiece0", [](auto& s) { s[0].open = "piece 0\nnext 1\nopen 0\n"; },
     "pieces are numbered from 1"},
    {"HaveThePiece4", [](auto& s) { s[0].open = "piece 4\nnext 1\nopen 0\n"; },
     "expected a number up to 3"},
    {"BeginWithATreeTooMany", [](auto& s) { s[0].lines = "tree\n" + s[0].lines; },
     "1 box has no leaf, for example box 0"},
};

TEST_F(Shards, OfTreesThatAreForgedAreRejected) {
  for (const Forgery& forgery : kForgeries) {
    proof_ = three_trees();
    forgery.change(proof_.shards);
    SCOPED_TRACE(forgery.name);
    expect_rejected(forgery.why);
  }
}

TEST_F(Shards, OfAWitnessAreRejected) {
  proof_ = HandmadeShards(scalar_question("x - 3/2", "1 : 2", kSingular1));
  proof_.shards = {{"next 1\nopen 0\n", "l 0 mean-value\n", 1}};
  expect_rejected("an index is for the proof of a claim about all poses");
}

TEST_F(Shards, ProvedElsewhereCountOnlyForTheSameQuestion) {
  for (const char* question : {"", "this"}) {
    verifier::Options options;
    options.parts = 2;
    options.exchange = [&](std::vector<ShardProof>& proofs) {
      EXPECT_TRUE(proofs[0].is_proved && !proofs[1].is_proved && proofs[2].is_proved);
      proofs[1].is_proved = true;
      proofs[1].question = *question != 0 ? proof_.question_hash() : question;
      proofs[1].before = proofs[0].after;
      proofs[1].after = proofs[2].before;
    };
    const Verification v = verify(options);
    EXPECT_EQ(v.outcome == Outcome::kVerified, *question != 0) << v.reason;
  }
}

TEST_F(Shards, ThatNoProcessHasProvedAreNotVerified) {
  verifier::Options options;
  options.parts = 2;
  options.exchange = [](std::vector<ShardProof>&) {};
  EXPECT_EQ(verify(options).outcome, Outcome::kUnfinished);
}

}  // namespace
}  // namespace regulus::detail::test
