// SPDX-License-Identifier: GPL-3.0-or-later
// Pavings, margins and bounds of a program: along way-points, and with the proofs that they write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "codegen/use/api/regulus.hpp"
#include "tests/support/temporary_directory.hpp"

namespace proofs_test {
namespace {

using regulus::Question;
using testing::HasSubstr;

/// det = x² + y² − h², singular on a circle of radius h.
Question circle(const std::string& motion) {
  return Question::of_text(R"toml(regulus = 1
name = "circle"
[pose]
x = "cm"
y = "cm"
[geometry]
h = { value = 1, tolerance = 0, group = "platform" }
[matrix]
rows = [["x - h", "y"], ["-y", "x + h"]]
[motion.outside]
x = [2, 3]
y = [2, 3]
[motion.across]
x = [-3, 3]
y = 0
)toml",
                           "circle", motion);
}

regulus::SearchOptions interpreted() {
  regulus::SearchOptions options;
  options.engine = regulus::Engine::kInterpreted;
  options.time_limit = 60;
  return options;
}

bool is_verified(const std::string& proof) {
  return regulus::verify(proof).outcome == regulus::ProofOutcome::kVerified;
}

class Proofs : public testing::Test {
 protected:
  regulus::detail::test::TemporaryDirectory folder_;
  std::string proof_ = folder_.path() / "proof";
};

/// The straight line crosses the circle at (1, 0) and (−1, 0): free, singular, free, singular, free.
TEST_F(Proofs, APavingOfAMotionAlongWayPointsHasStretchesInOrder) {
  const std::string way = folder_.path() / "way.csv";
  std::ofstream(way) << "t,x,y\n0,-3,0\n1,0,0\n2,3,0\n";
  bool has_boxes = false;
  regulus::LocateOptions options{.search = interpreted()};
  options.on_box = [&](regulus::Claim, std::span<const regulus::Interval>) { has_boxes = true; };
  const regulus::Paving paving = regulus::locate(circle("across").waypoints(way), options);
  EXPECT_EQ(paving.verdict, regulus::Verdict::kSingularity) << paving.report;
  EXPECT_FALSE(has_boxes);
  ASSERT_GE(paving.stretches.size(), 5U);
  const regulus::Stretch &first = paving.stretches.front(), &last = paving.stretches.back();
  EXPECT_EQ(first.claim, regulus::Claim::kFree);
  EXPECT_EQ(first.first_segment, 1U);
  EXPECT_EQ(first.begin, 0);
  EXPECT_EQ(last.last_segment, 2U);
  EXPECT_EQ(last.end, 1);
  for (std::size_t i = 1; i < paving.stretches.size(); ++i) {
    const regulus::Stretch &before = paving.stretches[i - 1], &here = paving.stretches[i];
    EXPECT_EQ(double(before.last_segment) + before.end, double(here.first_segment) + here.begin);
  }
  EXPECT_THAT(paving.json, HasSubstr("\"share\""));
  EXPECT_THAT(first.json, HasSubstr("\"kind\":\"free\""));
  EXPECT_EQ(paving.free.hi, 1);
}

TEST_F(Proofs, APavingWritesTheProofOfItsVerdict) {
  regulus::LocateOptions options{.search = interpreted(), .resolution = "1/4"};
  options.certificate = proof_;
  const regulus::Paving paving = regulus::locate(circle("outside"), options);
  EXPECT_EQ(paving.certificate, proof_) << paving.no_certificate;
  EXPECT_TRUE(is_verified(proof_));
  EXPECT_THAT(paving.json, HasSubstr("\"certificate\": \"" + proof_));
}

TEST_F(Proofs, AMarginWritesAProofOfEachEnd) {
  regulus::MarginOptions options;
  options.search = interpreted();
  options.tolerance = "platform=0:5";
  options.gap = "0.1";
  options.certificate = proof_;
  const regulus::MarginFinding found = regulus::margin(circle("outside"), options);
  ASSERT_EQ(found.certificates.size(), 2U) << found.report;
  EXPECT_TRUE(found.certificates[0].is_safe);
  EXPECT_EQ(found.certificates[0].certificate, proof_ + ".safe");
  EXPECT_EQ(found.certificates[1].certificate, proof_ + ".singular");
  for (const regulus::CertifiedEnd& end : found.certificates)
    EXPECT_TRUE(is_verified(end.certificate)) << end.certificate;
  EXPECT_THAT(found.json, HasSubstr("\"certificates\""));
}

TEST_F(Proofs, ABoundNamesTheProofOfEachEndOrTheReasonWhyThereIsNone) {
  regulus::BoundOptions options;
  options.search = interpreted();
  options.quantity.quantity = "x*y";
  options.gap = "0.1";
  options.certificate = proof_;
  const regulus::BoundFinding found = regulus::bound(circle("outside"), options);
  ASSERT_EQ(found.certificates.size(), 2U) << found.report;
  for (const regulus::CertifiedEnd& end : found.certificates)
    EXPECT_TRUE(is_verified(end.certificate)) << end.certificate << end.no_certificate;
  EXPECT_THAT(found.json, HasSubstr("\"safe\": \"" + proof_ + ".safe\""));
  options.limit = "100";
  const regulus::BoundFinding within = regulus::bound(circle("outside"), options);
  EXPECT_EQ(within.verdict, regulus::BoundVerdict::kWithin) << within.report;
  ASSERT_EQ(within.certificates.size(), 2U);
  EXPECT_TRUE(is_verified(within.certificates[0].certificate));
  EXPECT_EQ(within.certificates[1].certificate, "");
  EXPECT_EQ(within.certificates[1].no_certificate, "no pose exceeds the limit");
}

TEST_F(Proofs, MayBeInShards) {
  const Question turn = Question::of_text(R"toml(regulus = 1
name = "turn"
[pose]
x = "m"
y = "m"
[matrix]
rows = [["cos(x*y)", "sin(x*y)"], ["-sin(x*y)", "cos(x*y)"]]
[motion.box]
x = [0, 1]
y = [0, 1]
)toml",
                                          "turn");
  regulus::BoundOptions options;
  options.search = interpreted();
  options.quantity = {.quantity = "condition", .norm = "2"};
  options.gap = "0.05";
  options.certificate = proof_;
  options.shard_size = 4096;
  const regulus::BoundFinding found = regulus::bound(turn, options);
  EXPECT_EQ(found.certificates.at(0).certificate, proof_ + ".safe");
  EXPECT_TRUE(is_verified(proof_ + ".safe"));
  ASSERT_TRUE(std::filesystem::remove(proof_ + ".safe.shards/2"));
  EXPECT_FALSE(is_verified(proof_ + ".safe"));
}

TEST_F(Proofs, AreNotInShardsOfASizeThatHasNoMeaning) {
  const auto message = [](const std::string& certificate, std::uint64_t size) -> std::string {
    try {
      static_cast<void>(
          regulus::check(circle("outside"), interpreted(), nullptr, certificate, size));
    } catch (const regulus::UsageError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message("", 4096), HasSubstr("shard_size: there is no proof to cut"));
  EXPECT_THAT(message(proof_, 4095), HasSubstr("shard_size: found 4095, expected 4096"));
  EXPECT_EQ(message(proof_, 4096), "no error");
}

}  // namespace
}  // namespace proofs_test
