// SPDX-License-Identifier: GPL-3.0-or-later
// How far errors move a configuration, against figures that were published and configurations in
// closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/closure/branch_bound.hpp"
#include "tests/property/closure/checked_closures.hpp"
#include "tests/property/closure/four_bars.hpp"

namespace regulus::detail::finite_error_test {
namespace {

using test::rpr;
using verifier::Outcome;

QuantityOptions finite(const std::string& freedom = "") {
  QuantityOptions words;
  words.quantity = "error", words.is_finite = true, words.freedom = freedom;
  return words;
}

Bound bound(const std::string& text, double gap = 0.01, const std::string& freedom = "",
            const std::string& certificate = "", const std::string& limit = "") {
  ModelOptions options;
  options.motion = "m";
  const Request request = read_request(text, options);
  BoundSettings settings;
  settings.gap = gap;
  settings.search = test::usual_options();
  settings.over_branch = bounds_over_branch();
  settings.certificate = certificate;
  Quantity quantity = quantity_of(request.model, finite(freedom));
  if (!limit.empty()) settings.limit = read_limit(limit, quantity);
  return bound_quantity(request, std::move(quantity), settings, [](const ComponentBound&) {});
}

std::string legs_within(const std::string& error, const std::string& more = "") {
  return rpr("l1 = \"sqrt(50)\"\nl2 = \"sqrt(26)\"\nl3 = 5\nerror = { l1 = " + error +
             ", l2 = " + error + ", l3 = " + error + " }\n" + more);
}

/// Published figures, which first order misses by a third.
TEST(FiniteError, MeetsThePublishedFiguresOfA3Rpr) {
  const struct {
    const char* spread;
    double errors[3];
  } cases[] = {{"0.01", {0.03330, 0.04744, 0.01605}},
               {"0.05", {0.17043, 0.24092, 0.08127}},
               {"0.2", {0.93150, 1.03156, 0.44133}}};
  for (const auto& [spread, errors] : cases) {
    const Bound found = bound(legs_within(spread));
    ASSERT_EQ(found.components.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      const ComponentBound& c = found.components[i];
      ASSERT_TRUE(c.is_closed && c.attained && c.proved) << c.component.label << c.reason;
      EXPECT_LE(c.attained->approx, errors[i] + 1e-5) << c.component.label;
      EXPECT_GE(c.proved->approx, errors[i] - 1e-5) << c.component.label;
      EXPECT_LE(c.proved->approx - c.attained->approx, 0.0101 * c.proved->approx);
    }
  }
}

/// The largest errors of the two angles of a four-bar that are seen, by its closed form.
std::array<double, 2> seen(const test::FourBar& linkage, double from, double to, double motor,
                           double links) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(from, to), part(-1, 1);
  std::array<double, 2> most{};
  for (int i = 0; i < 20000; ++i) {
    // Mostly corners: that is where errors are largest.
    const auto error = [&](double spread) {
      const double x = part(random);
      return spread * (random() % 4 == 0 ? x : x < 0 ? -1 : 1);
    };
    test::FourBar other = linkage;
    const double theta = place(random);
    other.a += error(links), other.b += error(links);
    const test::FourBar::Angles actual = other.at(theta + error(motor)),
                                nominal = linkage.at(theta);
    most[0] = std::fmax(most[0], std::fabs(actual.phi - nominal.phi));
    most[1] = std::fmax(most[1], std::fabs(actual.psi - nominal.psi));
  }
  return most;
}

constexpr test::FourBar kLinkage{0.2, 0.35355, 0.25, 0.45};

/// A four-bar that moves, with errors of the motor and of two lengths.
TEST(FiniteError, BoundsWhatTheClosedFormGivesOverAMotion) {
  const Bound found = bound(kLinkage.text(1, 0.5, 1.5, 0.002) + "error = { theta = 0.01 }\n", 0.05);
  const std::array<double, 2> most = seen(kLinkage, 0.5, 1.5, 0.01, 0.002);
  for (std::size_t i = 0; i < 2; ++i) {
    const ComponentBound& c = found.components.at(i);
    ASSERT_TRUE(c.is_closed && c.attained && c.proved) << c.reason;
    EXPECT_LE(most[i], c.proved->approx);
    EXPECT_GE(most[i], 0.97 * c.attained->approx);
  }
}

std::string text_of(const EndProof& proof) {
  std::ostringstream text;
  text << std::ifstream(proof.file).rdbuf();
  return text.str();
}

Outcome outcome(const std::string& proof, const std::string& model = "") {
  return test::verified(proof, model).outcome;
}

std::string with_other(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// Replaces the number of the bound, and in the claim.
std::string with_bound(std::string text, const std::string& other) {
  const std::size_t begin = text.find("\nbound ") + 7;
  const std::string number = text.substr(begin, text.find('\n', begin) - begin);
  for (std::size_t at = 0; (at = text.find(' ' + number, at)) != std::string::npos; ++at)
    text.replace(at + 1, number.size(), other);
  return text;
}

/// The verifier proves both ends, compares what they are about, and proves no number between them
/// as if it were another end.
TEST(FiniteError, IsVerifiedAndComparedWithItsModel) {
  const std::string model = kLinkage.text(1, 0.8, 1.2, 0.002) + "error = { theta = 0.01 }\n";
  for (const std::string unknown : {"phi", "psi"}) {
    const test::TemporaryDirectory directory;
    const Bound found = bound(model, 0.1, unknown, (directory.path() / "bound").string());
    const ComponentBound& c = found.components.at(0);
    ASSERT_TRUE(c.proved && c.attained) << c.reason;
    const std::string safe = text_of(c.proofs.safe()), attained = text_of(c.proofs.singular());
    for (const std::string& proof : {safe, attained}) {
      EXPECT_EQ(outcome(proof, model), Outcome::kVerified)
          << describe(test::verified(proof, model)) << proof.substr(0, 2000);
      for (const auto& [from, to] :
           {std::pair<std::string, std::string>{"theta = 0.01", "theta = 0.02"},
            {"tolerance = \"0.002\"", "tolerance = \"0.003\""},
            {"[\"0.8", "[\"0.7"}})
        EXPECT_EQ(outcome(proof, with_other(model, from, to)), Outcome::kRejected) << from;
    }
    // The largest error that is seen is at most what is proved, and the attained one is no bound.
    const double most = seen(kLinkage, 0.8, 1.2, 0.01, 0.002)[unknown == "psi"];
    EXPECT_LE(most, c.proved->approx);
    EXPECT_NE(outcome(with_bound(safe, std::to_string(0.9999 * most))), Outcome::kVerified);
    EXPECT_NE(outcome(with_bound(attained, std::to_string(c.proved->approx))), Outcome::kVerified);
    // The other unknown has another error.
    const std::string other = unknown == "phi" ? "2" : "1", own = unknown == "phi" ? "1" : "2";
    const std::string exchanged = with_other(with_other(safe, "unknown " + own, "unknown " + other),
                                             "column " + own, "column " + other);
    const double of_other = seen(kLinkage, 0.8, 1.2, 0.01, 0.002)[unknown == "phi"];
    if (of_other > c.proved->approx) {
      EXPECT_NE(outcome(exchanged), Outcome::kVerified);
    }
  }
}

/// A proof about smaller errors is none about these.
TEST(FiniteError, HasNoProofByTubesOfSmallerErrors) {
  const std::string model = kLinkage.text(1, 0.9, 1.1, 0.002) + "error = { theta = 0.01 }\n";
  const test::TemporaryDirectory directory;
  const Bound found = bound(model, 0.1, "psi", (directory.path() / "bound").string());
  const std::string safe = text_of(found.components.at(0).proofs.safe());
  EXPECT_NE(outcome(with_other(safe, "theta = theta +- 1/100", "theta = theta +- 1/50")),
            Outcome::kVerified);
  EXPECT_NE(outcome(with_other(safe, "+- 1/500", "+- 1/250")), Outcome::kVerified);
}

TEST(FiniteError, IsComparedWithALimit) {
  EXPECT_EQ(bound(legs_within("0.05"), 0.01, "x", "", "0.18").verdict(), LimitVerdict::kWithin);
  EXPECT_EQ(bound(legs_within("0.05"), 0.01, "x", "", "0.16").verdict(), LimitVerdict::kExceeded);
}

/// A constraint speaks of a pose parameter whose value the motion gives.
TEST(FiniteError, KeepsTheConstraintsOfTheMotion) {
  EXPECT_TRUE(bound(legs_within("0.01", "constraints = [\"l1 - 8\"]\n")).is_closed());
  EXPECT_THROW(
      static_cast<void>(bound(legs_within("0.01", "constraints = [\"7 - l1\", \"l1 - 7\"]\n"))),
      InputError);
}

TEST(FiniteError, SaysIfTheBranchIsNotCertain) {
  const ComponentBound c = bound(legs_within("1")).components.at(0);
  EXPECT_FALSE(c.proved);
  EXPECT_FALSE(c.attained);
  EXPECT_NE(c.reason, "");
}

/// The way to where the branch ends is finite, so no limit is shown to be exceeded.
TEST(FiniteError, EndsWithTheBranch) {
  const std::string model = kLinkage.text(1, 0.5, 2.4, 0.002) + "error = { theta = 0.01 }\n";
  const ComponentBound c = bound(model, 0.1, "psi").components.at(0);
  EXPECT_FALSE(c.proved);
  EXPECT_TRUE(c.is_unbounded);
  EXPECT_TRUE(c.place);
  EXPECT_EQ(bound(model, 0.1, "psi", "", "0.1").verdict(), LimitVerdict::kUndecided);
}

}  // namespace
}  // namespace regulus::detail::finite_error_test
