// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of bounds: true ones are verified, and no false one is.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "runtime/verifier/verify.hpp"
#include "tests/support/trials.hpp"
#include "tests/unit/verifier/bound_claims.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

constexpr int kClaims = 350;
constexpr std::uint64_t kFewBoxes = 100;
constexpr double kTrue = 1.05;  ///< the sampled extreme is a little below the true one

/// More boxes would not make a false claim true.
verifier::Verification verified(const std::string& text, std::uint64_t most_boxes = 2000) {
  verifier::Options options;
  options.max_boxes = most_boxes;
  std::istringstream file(text);
  return verifier::verify(file, options);
}

/// Returns a text in which the first `from` after `begin` is `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// Swaps the signs of the two points.
std::string swapped(std::string text) {
  return replaced(replaced(replaced(std::move(text), "point +", "point ?"), "point -", "point +"),
                  "point ?", "point -");
}

Outcome verified_witness(const BoundClaim& claim, const Place& place) {
  const std::string head = head_of(claim, true), witness = witness_of(claim, place);
  const Outcome first = verified(head + witness).outcome;
  const bool has_signs = claim.kind != "condition-2";
  return first == Outcome::kVerified || !has_signs ? first
                                                   : verified(head + swapped(witness)).outcome;
}

/// Sets the bound `factor` times as far from the reference as the extreme; y is below the extreme.
void set_bound(BoundClaim& claim, double extreme, double factor) {
  const double q = claim.sign() * extreme;
  const bool may_have_reference = claim.side != "absolute" && claim.kind != "error" &&
                                  !claim.kind.starts_with("condition") &&
                                  !claim.kind.starts_with("sigma");
  claim.reference = may_have_reference ? std::floor(q) - 1 : 0;
  claim.bound = claim.is_direct()
                    ? extreme / factor
                    : claim.sign() * (claim.reference + factor * (q - claim.reference));
}

TEST(ABoundCertificate, IsVerifiedExactlyIfItIsTrue) {
  std::mt19937 random(7);
  int proved = 0, attained = 0, claims = 0, damaged = 0;
  for (int k = 0; k < trials(kClaims / 4, kClaims); ++k) {
    BoundClaim claim = random_claim(random);
    const Place place = extreme_place(claim);
    const double extreme = value_at(claim, place);
    if (std::abs(extreme) < 1e-3) continue;
    ++claims;
    set_bound(claim, extreme, kTrue);
    proved += verified(head_of(claim, false) + proof_of(claim)).outcome == Outcome::kVerified;
    EXPECT_NE(verified_witness(claim, place), Outcome::kVerified)
        << head_of(claim, true) << witness_of(claim, place);
    for (const double factor : {0.999, 0.9, 0.5}) {
      set_bound(claim, extreme, factor);
      EXPECT_NE(verified(head_of(claim, false) + proof_of(claim), kFewBoxes).outcome,
                Outcome::kVerified)
          << head_of(claim, false) << extreme;
      ++damaged;
    }
    set_bound(claim, extreme, 0.99);
    attained += verified_witness(claim, place) == Outcome::kVerified;
  }
  EXPECT_GT(damaged, trials(250, 1000));
  EXPECT_GT(proved, 0.97 * claims) << claims;
  EXPECT_GT(attained, 0.97 * claims) << claims;
}

/// A claim of one robot with the matrix, the set or the numbers of another one is another claim.
TEST(ABoundCertificate, OfAnotherRobotIsJudgedByItsOwnNumbers) {
  std::mt19937 random(11);
  int damaged = 0;
  for (int k = 0; k < kClaims; ++k) {
    BoundClaim claim = random_claim(random);
    set_bound(claim, value_at(claim, extreme_place(claim)), kTrue);
    const BoundClaim other = random_claim(random);
    for (const int part : {0, 1, 2, 3, 4, 5}) {
      BoundClaim mixed = claim;
      if (part == 0) mixed.a = other.a, mixed.d = other.d;
      if (part == 1) mixed.scale = other.scale;
      if (part == 2) mixed.spread = other.spread, mixed.middle = other.middle;
      if (part == 3) mixed.errors = other.errors, mixed.stiffness = other.stiffness;
      if (part == 4) mixed.row = 1 - claim.row, mixed.column = 1 - claim.column;
      if (part == 5) mixed.factor = other.factor, mixed.hi = other.hi;
      if (mixed.has_norms && mixed.side == "absolute") continue;
      const double extreme = value_at(mixed, extreme_place(mixed));
      const bool is_false = mixed.sign() * extreme > mixed.sign() * mixed.bound;
      if (!is_false) continue;
      ++damaged;
      EXPECT_NE(verified(head_of(mixed, false) + proof_of(mixed), kFewBoxes).outcome,
                Outcome::kVerified)
          << head_of(mixed, false) << extreme;
    }
  }
  EXPECT_GT(damaged, 200);
}

class ADamagedBound : public testing::Test {
 protected:
  ADamagedBound() {
    claim_.kind = "deflection";
    claim_.side = "absolute";
    claim_.scale = {0.5, 0.5};
    set_bound(claim_, value_at(claim_, extreme_place(claim_)), kTrue);
  }
  [[nodiscard]] std::string text() const { return head_of(claim_, false) + proof_of(claim_); }
  BoundClaim claim_;
};

TEST_F(ADamagedBound, IsVerifiedBeforeTheDamage) {
  EXPECT_EQ(verified(text()).outcome, Outcome::kVerified) << verified(text()).reason;
}

TEST_F(ADamagedBound, IsRejectedWithoutALine) {
  std::istringstream lines(text());
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  for (std::size_t left_out = 0; left_out < all.size(); ++left_out) {
    std::string rest;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (i != left_out) rest += all[i] + '\n';
    EXPECT_EQ(verified(rest).outcome, Outcome::kRejected) << all[left_out];
  }
}

TEST_F(ADamagedBound, MayCombineColumnsByARegularMatrixOnly) {
  const auto combined = [&](const std::string& rows) {
    return verified(replaced(text(), "reference", rows + "reference")).outcome;
  };
  EXPECT_EQ(combined("combined 1 1/2\ncombined -1/3 1\n"), Outcome::kVerified);
  EXPECT_EQ(combined("combined 1 2\ncombined 1/2 1\n"), Outcome::kRejected);
  EXPECT_EQ(combined("combined 1 2\n"), Outcome::kRejected);
  EXPECT_EQ(combined("combined 1 x\ncombined 1 1\n"), Outcome::kRejected);
  EXPECT_EQ(combined("combined 1 pi\ncombined 1 1\n"), Outcome::kRejected);
}

TEST_F(ADamagedBound, IsRejectedForWordsThatMeanNothing) {
  const std::vector<std::pair<std::string, std::string>> damages{
      {"side absolute", "side largest of all"},
      {"side absolute", "side none"},
      {"quantity deflection", "quantity bend"},
      {"column 1", "column 3"},
      {"column 1", "column 0"},
      {"column 1", "column 1 2"},
      {"load any", "load any| < 1 and |x"},
      {"wrench 0 +- 1", "wrench 0 +- -1"},
      {"wrench 0 +- 1", "wrench x +- 1"},
      {"stiffness 2", "stiffness x"},
      {"reference 0", "reference -1"},
      {"bound ", "bound -"},
      {"bound ", "unbounded "},
      {"alpha 0", "alpha 1/2"}};
  for (const auto& [from, to] : damages)
    EXPECT_EQ(verified(replaced(text(), from, to)).outcome, Outcome::kRejected) << to;
}

TEST_F(ADamagedBound, NeverHasAValueWhereTheModelIsSingular) {
  claim_.kind = "force";
  claim_.e = 0;  // the matrix is singular everywhere
  claim_.bound = 1;
  const std::string point = "reason small-determinant\npoint 0 0x1p+0 0x0p+0 0x0p+0 0x0p+0\nend\n";
  EXPECT_EQ(verified(head_of(claim_, true) + point).outcome, Outcome::kUnfinished);
}

TEST_F(ADamagedBound, OfAScaleOfNoSignUsesItsMagnitude) {
  claim_.kind = "speed";
  claim_.side = "largest";
  claim_.radius = 1;
  claim_.has_norms = true;
  claim_.scale = {-0.5, 1};
  set_bound(claim_, value_at(claim_, extreme_place(claim_)), kTrue);
  EXPECT_EQ(verified(text()).outcome, Outcome::kVerified) << text() << verified(text()).reason;
  set_bound(claim_, value_at(claim_, extreme_place(claim_)), 0.95);
  EXPECT_NE(verified(text()).outcome, Outcome::kVerified) << text();
}

TEST_F(ADamagedBound, HasNoNegativeRadius) {
  claim_.kind = "speed";
  claim_.side = "largest";
  claim_.has_norms = true;
  claim_.radius = 1;
  claim_.bound = 100;
  EXPECT_EQ(verified(text()).outcome, Outcome::kVerified) << verified(text()).reason;
  for (const char* radius : {"-1", "-1/3*sqrt(2)"})
    EXPECT_EQ(
        verified(replaced(text(), "wrench-ball 1 in", std::string("wrench-ball ") + radius + " in"))
            .outcome,
        Outcome::kRejected);
}

/// det J⁻¹ is 0 with a scale, though the matrix in the file is regular.
TEST_F(ADamagedBound, OfADeterminantIsAboutItsScales) {
  claim_.kind = "determinant";
  claim_.side = "least";
  claim_.bound = 0;
  EXPECT_EQ(verified(text()).outcome, Outcome::kVerified) << verified(text()).reason;
  claim_.scale[1] = 0;
  EXPECT_NE(verified(text(), kFewBoxes).outcome, Outcome::kVerified);
}

/// det J⁻¹ = (2 + x)·2 from 4 to 6 has one sign; its opposite has none of its values.
TEST_F(ADamagedBound, OfADeterminantHasItsSign) {
  claim_.kind = "determinant-max";
  claim_.a = claim_.e = 2, claim_.b = 1, claim_.c = claim_.d = 0, claim_.scale = {1, 1};
  claim_.lo = 0, claim_.hi = 1;
  const auto outcome = [&](const char* side, double bound) {
    claim_.side = side;
    claim_.bound = bound;
    claim_.reference = claim_.side == "absolute" ? 0 : claim_.sign() * bound - 1;
    return verified(text()).outcome;
  };
  EXPECT_EQ(outcome("largest", 6.01), Outcome::kVerified);
  EXPECT_NE(outcome("largest", 5.99), Outcome::kVerified);
  EXPECT_EQ(outcome("least", 3.99), Outcome::kVerified);
  EXPECT_NE(outcome("least", 4.01), Outcome::kVerified);
  EXPECT_EQ(outcome("absolute", 6.01), Outcome::kVerified);
  EXPECT_NE(outcome("absolute", 5.99), Outcome::kVerified);
  claim_.e = -2;
  EXPECT_EQ(outcome("absolute", 6.01), Outcome::kVerified);
  EXPECT_NE(outcome("absolute", 5.99), Outcome::kVerified);
  EXPECT_EQ(outcome("least", -6.01), Outcome::kVerified);
  EXPECT_NE(outcome("least", -5.99), Outcome::kVerified);
  EXPECT_EQ(outcome("largest", -3.99), Outcome::kVerified);
  EXPECT_NE(outcome("largest", -4.01), Outcome::kVerified);
}

/// Earlier versions wrote the matrix of the bound alone.
/// x/y times a rotation: each vector has the same ratio, and no two vectors show it.
TEST(AConditionNumber, OfARotationIsOne) {
  const auto outcome = [](const std::string& entry, const std::string& bound) {
    return verified(
               "regulus-certificate 1\nverdict SINGULARITY\nclaim condition number in the 2-norm "
               "of "
               "J^-1 with the factors of its columns >= " +
               bound +
               " at some pose of the variety\n"
               "model rotation\nsha256 -\nmotion m\nalpha 0\nparameter x in 0 : 1\npose x = x\n"
               "let e1 = cos(x)\nlet e2 = sin(x)\nlet e3 = " +
               entry +
               "\nmatrix 2 2\nentry e1*e3\nentry e2*e3\nentry -e2*e3\nentry e1*e3\n"
               "quantity condition-2\nside largest\nfactor 1\nfactor 1\nreference 0\nbound " +
               bound + "\nproof\nreason ratio\npoint 0 0x1p-1\nend\n")
        .outcome;
  };
  EXPECT_EQ(outcome("1/3", "1"), Outcome::kVerified);
  EXPECT_EQ(outcome("1/3", "1/2"), Outcome::kVerified);
  EXPECT_NE(outcome("1/3", "1000001/1000000"), Outcome::kVerified);
  // The matrix 0 has none.
  EXPECT_NE(outcome("x - 1/2", "1"), Outcome::kVerified);
  EXPECT_NE(outcome("0", "1"), Outcome::kVerified);
}

TEST(AnOldBoundCertificate, ProvesNoNumber) {
  const verifier::Verification v = verified(
      "regulus-certificate 1\nverdict NO SINGULARITY\nclaim the full 1x1 matrix of the model is "
      "defined and has full rank at every pose of the variety\nmodel m\nsha256 -\nmotion m\n"
      "alpha 0\nparameter x in 0 : 1\nparameter r in 0 : 1/2\npose x = x\npose r = r\n"
      "matrix 1 1\nentry 1 - r*x\nproof\nl 0 h-matrix\nend 1\n");
  EXPECT_EQ(v.outcome, Outcome::kVerified);
  EXPECT_NE(describe(v).find("no number is proved"), std::string::npos);
}

}  // namespace
}  // namespace regulus::detail::test
