// SPDX-License-Identifier: GPL-3.0-or-later
// The solver's certificates about closures, proved by the verifier and compared with their models.
#include <gtest/gtest.h>

#include "tests/property/closure/checked_closures.hpp"
#include "tests/property/closure/four_bars.hpp"

namespace regulus::detail {
namespace {

using test::FourBar;
using test::verified;

/// Returns the certificate of a model; empty if nothing is proved.
std::string certified(const std::string& model) {
  return test::certified_closure(test::check_closure_text(model, test::usual_options()));
}

TEST(ACertificateOfAFourBar, IsVerifiedAndComparedWithItsModel) {
  std::mt19937 random(3);
  int proved = 0;
  for (int count = 0; count < 25; ++count) {
    const FourBar linkage = test::random_four_bar(random);
    std::uniform_real_distribution<double> angle(-3, 3), reach(0.1, 1.5);
    const double start = angle(random);
    if (!linkage.is_between_toggles(start, 0.05)) continue;
    const double tolerance = count % 3 == 0 ? 0.001 : 0;
    const std::string model =
        linkage.text(start, start - reach(random), start + reach(random), tolerance);
    const std::string certificate = certified(model);
    if (certificate.empty()) continue;
    ++proved;
    const verifier::Verification v = verified(certificate, model);
    EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << model << describe(v);
    // The mirrored linkage has the same equations, and another start.
    FourBar mirror = linkage;
    mirror.is_open = !mirror.is_open;
    const std::string other = mirror.text(start, start - 1e-3, start + 1e-3, tolerance);
    EXPECT_EQ(verified(certificate, other).outcome, verifier::Outcome::kRejected);
    const auto start_of = [](const std::string& text) {
      const std::size_t at = text.find("\nunknown ");
      return text.substr(at, text.find("\nstart ") - at);
    };
    std::string forged = certificate;
    const std::string mirrored = certified(other);
    if (mirrored.empty()) continue;
    forged.replace(forged.find(start_of(forged)), start_of(forged).size(), start_of(mirrored));
    EXPECT_NE(verified(forged).outcome, verifier::Outcome::kVerified) << forged;
  }
  EXPECT_GE(proved, 6);
}

/// A motion beyond a toggle has a proof that the branch reaches it. It is no proof for a motion that ends
/// before, nor for the mirrored linkage.
TEST(ACertificateOfAToggle, IsVerifiedAndComparedWithItsModel) {
  std::mt19937 random(8);
  int proved = 0;
  for (int count = 0; count < 60 && proved < 12; ++count) {
    const FourBar linkage = test::random_four_bar(random);
    std::uniform_real_distribution<double> angle(-3, 3);
    const double start = angle(random);
    if (!linkage.is_between_toggles(start, 0.05)) continue;
    double toggle = start;
    while (toggle < start + 3 && linkage.is_between_toggles(toggle)) toggle += 1e-3;
    if (toggle >= start + 3) continue;
    const double tolerance = count % 3 == 0 ? 0.001 : 0;
    const std::string model = linkage.text(start, start - 0.01, toggle + 0.2, tolerance);
    const test::CheckedClosure checked = test::check_closure_text(model, test::usual_options());
    if (checked.verdict() != Verdict::kSingularity) continue;
    ++proved;
    const std::string certificate = test::certified_closure(checked);
    const verifier::Verification v = verified(certificate, model);
    EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << model << certificate << describe(v);
    // The same by a formula, which turns back at the end.
    const std::string by_formula =
        model.substr(0, model.find("theta = [")) +
        fmt::format("parameters = {{ T = [0, 3] }}\ntheta = \"{:.17g} + {:.17g}*sin(T)\"\n", start,
                    toggle + 0.2 - start);
    const test::CheckedClosure along = test::check_closure_text(by_formula, test::usual_options());
    EXPECT_EQ(along.verdict(), Verdict::kSingularity) << by_formula;
    const std::string of_formula = test::certified_closure(along);
    EXPECT_EQ(verified(of_formula, by_formula).outcome, verifier::Outcome::kVerified) << of_formula;
    EXPECT_EQ(verified(of_formula, model).outcome, verifier::Outcome::kRejected);
    const std::string before = linkage.text(start, start - 0.01, toggle - 0.05, tolerance);
    EXPECT_EQ(verified(certificate, before).outcome, verifier::Outcome::kRejected);
    FourBar mirror = linkage;
    mirror.is_open = !mirror.is_open;
    const std::string other = mirror.text(start, start - 0.01, toggle + 0.2, tolerance);
    EXPECT_EQ(verified(certificate, other).outcome, verifier::Outcome::kRejected);
    // The same proof with the range of the shorter motion.
    const std::string short_range = certified(before);
    if (short_range.empty()) continue;
    const auto range_of = [](const std::string& text) {
      const std::size_t at = text.find("\nparameter ");
      return text.substr(at, text.find('\n', at + 1) - at);
    };
    std::string forged = certificate;
    forged.replace(forged.find(range_of(forged)), range_of(forged).size(), range_of(short_range));
    EXPECT_NE(verified(forged).outcome, verifier::Outcome::kVerified) << forged;
  }
  EXPECT_GE(proved, 8);
}

/// The way to the toggle must have a value all along, also where the equations do not need it.
TEST(ACertificateOfAToggle, LeadsThroughNoPoseThatTheMotionLeavesUndefined) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};  // toggle at 132.6 degrees
  const std::string model = linkage.text(0, -0.1, 0.1);
  const auto verdict = [&](const std::string& theta) {
    const std::string text = model.substr(0, model.find("theta = [")) +
                             "parameters = { T = [0, 3] }\ntheta = \"" + theta + "\"\n";
    return test::check_closure_text(text, test::usual_options()).verdict();
  };
  EXPECT_EQ(verdict("T"), Verdict::kSingularity);
  for (const char* hole : {"0/(T - 1)", "0*sqrt((T - 1)^2 - 1/100)", "0*log(abs(T - 2))"})
    EXPECT_EQ(verdict("T + " + std::string(hole)), Verdict::kPossibleProblem) << hole;
  EXPECT_EQ(verdict("T + 0/(T + 1)"), Verdict::kSingularity);
}

/// A driver in degrees, by its own name, by a parameter, or by a formula.
TEST(ACertificateOfABranch, MayBeOfADriverInDegrees) {
  const auto model = [](const std::string& start, const std::string& motion) {
    return "regulus = 1\nname = \"slider\"\n[pose]\ntheta = \"deg\"\n[closure]\nunknowns = { p = "
           "\"m\" }\nequations = [\"p - 2 - sin(theta)/2\"]\nstart = { theta = " +
           start + ", p = 2.25 }\n[motion.m]\n" + motion;
  };
  for (const char* motion : {"theta = [20, 40]\n", "parameters = { T = [20, 40] }\ntheta = \"T\"\n",
                             "parameters = { T = [0, 1] }\ntheta = \"30 + 20*T\"\n"}) {
    const std::string text = model("30", motion), certificate = certified(text);
    const verifier::Verification v = verified(certificate, text);
    EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << motion << describe(v);
    EXPECT_EQ(verified(certificate, model("31", motion)).outcome, verifier::Outcome::kRejected)
        << motion;
  }
}

}  // namespace
}  // namespace regulus::detail
