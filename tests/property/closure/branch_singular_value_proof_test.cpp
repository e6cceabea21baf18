// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs of condition numbers in the 2-norm and of singular values over a branch: as they are, damaged, and
// about other models.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/property/closure/known_singular_values.hpp"

namespace regulus::detail::test::singular_values_over_a_branch {
namespace {

std::string text_of(const EndProof& proof) {
  std::ostringstream text;
  text << std::ifstream(proof.file).rdbuf();
  return text.str();
}

/// Both proofs of a bracket.
struct Proofs {
  Proofs(const std::string& model, const QuantityOptions& words, Asked asked = {}) {
    const TemporaryDirectory directory;
    asked.certificate = (directory.path() / "bound").string();
    found = bound(model, words, asked);
    safe = text_of(found.proofs.safe()), attained = text_of(found.proofs.singular());
  }
  ComponentBound found;
  std::string safe, attained;
};

TEST(ProofsOfSingularValues, AreTheSameForAnyNumberOfThreads) {
  const std::string model = FiveBar::text("0.001");
  for (const QuantityOptions& words : {kCondition, kLargest, kLeast}) {
    const Proofs one(model, words, {.gap = 0.005}), two(model, words, {.gap = 0.005, .threads = 2});
    EXPECT_EQ(one.found.boxes, two.found.boxes);
    EXPECT_GT(one.safe.size(), 1000U);
    EXPECT_EQ(one.safe, two.safe);
    EXPECT_EQ(one.attained, two.attained);
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The proof with another bound, in its claim and in its line.
std::string with_bound(std::string proof, const std::string& other) {
  const std::size_t at = proof.find("\nbound ") + 7;
  const std::string number = proof.substr(at, proof.find('\n', at) - at);
  for (std::size_t i = 0; (i = proof.find(number, i)) != std::string::npos; i += other.size())
    proof.replace(i, number.size(), other);
  return proof;
}

void expect_outcome(const std::string& proof, const std::string& model, verifier::Outcome outcome,
                    const std::string& why = "") {
  const verifier::Verification v = verified(proof, model);
  EXPECT_EQ(v.outcome, outcome) << describe(v) << proof.substr(0, 1500);
  EXPECT_NE(describe(v).find(why), std::string::npos) << describe(v);
}

void expect_not_verified(const std::string& proof, const std::string& model = "") {
  const verifier::Verification v = verified(proof, model);
  EXPECT_NE(v.outcome, verifier::Outcome::kVerified) << describe(v) << proof.substr(0, 1500);
}

TEST(ProofsOfSingularValues, AreVerifiedAndComparedWithTheirModel) {
  using enum verifier::Outcome;
  const std::string model = slider("[-2, 2]", "4"), bars = FiveBar::text("0.001");
  for (const QuantityOptions& words : {kCondition, kLargest, kLeast}) {
    SCOPED_TRACE(words.quantity);
    const Proofs of_slider(model, words), of_bars(bars, words), fine(model, words, {.gap = 1e-5});
    for (const Proofs& proofs : {of_slider, fine})
      for (const std::string& proof : {proofs.safe, proofs.attained}) {
        expect_outcome(proof, model, kVerified);
        expect_outcome(proof, slider("[-2, 2]", "3"), kRejected, "characteristic_length");
        expect_outcome(proof, slider("[-2, 2.5]", "4"), kRejected);
        expect_outcome(proof, replaced(model, "phi = 0, s", "phi = 0.1, s"), kRejected);
        expect_outcome(proof, replaced(model, "- 2*cos", "- 3*cos"), kRejected);
      }
    for (const std::string& proof : {of_bars.safe, of_bars.attained}) {
      expect_outcome(proof, bars, kVerified);
      expect_outcome(proof, replaced(bars, "\"0.001\"", "\"0.002\""), kRejected, "crank");
    }
    // The bound of one end is no bound of the other.
    expect_not_verified(with_bound(fine.safe, std::to_string(fine.found.attained->approx)));
    expect_not_verified(with_bound(fine.attained, std::to_string(fine.found.proved->approx)));
    // Another word, another factor, another tube.
    for (const char* other : {"condition-2", "sigma-max", "sigma-min", "condition"})
      if (fine.safe.find(std::string("quantity ") + other + '\n') == std::string::npos)
        for (const std::string& proof : {fine.safe, fine.attained})
          expect_not_verified(
              replaced(proof,
                       proof.substr(proof.find("\nquantity "),
                                    proof.find("\nside ") - proof.find("\nquantity ")),
                       std::string("\nquantity ") + other));
    expect_not_verified(replaced(fine.safe, "factor 1/4", "factor 1/3"), model);
    std::string moved = of_bars.safe;
    const std::size_t at = moved.rfind(" tube ") + 6;
    moved.insert(moved.find("p", at) + 2, "1");
    expect_not_verified(moved);
  }
}

/// One equation has one singular value, whose ratio to itself is 1.
TEST(ProofsOfSingularValues, AreOfOneEquation) {
  const std::string crank =
      "regulus = 1\nname = \"crank\"\n[pose]\nx = \"m\"\n[closure]\nunknowns = { phi = \"rad\" }\n"
      "equations = [\"x - 2*sin(phi)\"]\nstart = { x = 0, phi = 0 }\n[motion.m]\nx = [-1, 1]\n";
  const auto check = [&](const QuantityOptions& words, double value) {
    SCOPED_TRACE(words.quantity);
    const Proofs proofs(crank, words, {.gap = 1e-3});
    ASSERT_TRUE(proofs.found.is_closed) << proofs.found.reason;
    EXPECT_NEAR(proofs.found.proved->approx, value, 2e-3 * value);
    for (const std::string& proof : {proofs.safe, proofs.attained})
      expect_outcome(proof, crank, verifier::Outcome::kVerified);
    if (value == 1) expect_not_verified(with_bound(proofs.safe, "1"));
  };
  check(kCondition, 1);
  check(kLargest, 2);
  check(kLeast, std::sqrt(3.0));
}

/// At one place the values are known: an end that is beyond the truth by 1e-9 is not verified, and one that
/// is as far from it on the other side is.
TEST(ProofsOfSingularValues, HaveNoProofBeyondTheTruth) {
  const std::string here =
      replaced(slider("\"0.5\"", "4"), "theta = 0, phi = 0, s = 3 }",
               "theta = \"0.5\", phi = -0.242069983, s = 2.81927027 }\n[closure.radius]\nphi = "
               "\"1e-3\"\ns = \"1e-3\"");
  const Values truth = of_slider(0.5, 4);
  const auto check = [&](const QuantityOptions& words, double value, double beyond) {
    SCOPED_TRACE(words.quantity);
    const Proofs proofs(here, words, {.gap = 1e-6});
    ASSERT_TRUE(proofs.found.is_closed) << proofs.found.reason;
    const auto at = [&](double part) {
      return fmt::format("{:.17g}", value * (1 + part * beyond));
    };
    for (const double part : {1e-9, 1e-7}) {
      expect_outcome(with_bound(proofs.safe, at(part)), here, verifier::Outcome::kVerified);
      expect_not_verified(with_bound(proofs.safe, at(-part)), here);
      expect_not_verified(with_bound(proofs.attained, at(part)), here);
    }
    expect_outcome(with_bound(proofs.attained, at(-1e-9)), here, verifier::Outcome::kVerified);
  };
  check(kCondition, truth.condition, 1);
  check(kLargest, truth.largest, 1);
  check(kLeast, truth.least, -1);
}

}  // namespace
}  // namespace regulus::detail::test::singular_values_over_a_branch
