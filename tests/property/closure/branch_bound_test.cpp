// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds over a branch, against differences of configurations in closed form.
#include "codegen/question/closure/branch_bound.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "codegen/question/bound/bound_question.hpp"
#include "tests/property/closure/checked_closures.hpp"
#include "tests/property/closure/four_bars.hpp"

namespace regulus::detail {
namespace {

using test::FourBar;

constexpr const char* kData =
    "[actuators]\nerror = 0.01\nspeed = 2\nstiffness = 50\n[load.L]\nwrench = [[-1, 3], 2]\n";

Bound bound(const std::string& text, const QuantityOptions& words, double gap = 0.02,
            const std::string& limit = "", const std::string& certificate = "") {
  ModelOptions options;
  options.motion = "m";
  const Request request = read_request(text, options);
  BoundSettings settings;
  settings.gap = gap;
  settings.search = test::usual_options();
  settings.over_branch = bounds_over_branch();
  settings.certificate = certificate;
  Quantity quantity = quantity_of(request.model, words);
  if (!limit.empty()) settings.limit = read_limit(limit, quantity);
  return bound_quantity(request, std::move(quantity), settings, [](const ComponentBound&) {});
}

QuantityOptions asked(const std::string& quantity) {
  QuantityOptions words;
  words.quantity = quantity;
  return words;
}

/// What the closed form and differences give at one angle.
struct OfFourBar {
  double J[2];     ///< of φ and ψ
  double A[2][2];  ///< the derivatives of the equations
  double det, condition;
};

OfFourBar values_at(const FourBar& f, double theta) {
  constexpr double h = 1e-6;
  const FourBar::Angles at = f.at(theta), above = f.at(theta + h), below = f.at(theta - h);
  const auto turned = [](double x) { return std::remainder(x, 2 * std::numbers::pi); };
  OfFourBar v{{turned(above.phi - below.phi) / (2 * h), turned(above.psi - below.psi) / (2 * h)},
              {{-f.b * std::sin(at.phi), f.c * std::sin(at.psi)},
               {f.b * std::cos(at.phi), -f.c * std::cos(at.psi)}},
              0,
              0};
  const auto& A = v.A;
  v.det = A[0][0] * A[1][1] - A[0][1] * A[1][0];
  const auto row = [](double x, double y) { return std::fabs(x) + std::fabs(y); };
  v.condition = std::fmax(row(A[0][0], A[0][1]), row(A[1][0], A[1][1])) *
                std::fmax(row(A[1][1], A[0][1]), row(A[1][0], A[0][0])) / std::fabs(v.det);
  return v;
}

/// A motion with the models of several links, all of which have the branch.
class BoundsOfAFourBar : public testing::Test {
 protected:
  /// Calls `test` for linkages with a motion that stays away from toggles.
  template <class Test>
  void for_linkages(unsigned seed, int wanted, double tolerance, const Test& test) {
    std::mt19937 random(seed);
    for (int tries = 0; wanted > 0 && tries < 400; ++tries) {
      const FourBar linkage = test::random_four_bar(random);
      std::uniform_real_distribution<double> angle(-3, 3), reach(0.05, 0.6);
      const double start = angle(random), from = start - reach(random), to = start + reach(random);
      bool is_regular = true;
      for (int i = 0; i <= 40; ++i)
        is_regular = is_regular && linkage.is_between_toggles(from + (to - from) * i / 40, 0.08);
      if (!is_regular) continue;
      --wanted;
      test(linkage, linkage.text(start, from, to, tolerance) + kData, from, to, random);
    }
    EXPECT_EQ(wanted, 0);
  }

  /// The largest value that the closed form has over the motion, and links within the tolerance.
  template <class Value>
  static double largest(const FourBar& linkage, double from, double to, double tolerance,
                        std::mt19937& random, const Value& value) {
    std::uniform_real_distribution<double> part(0, 1), spread(-tolerance, tolerance);
    double most = -INFINITY;
    for (int i = 0; i < 300; ++i) {
      FourBar other = linkage;
      other.a += spread(random), other.b += spread(random);
      const double at = i == 0 ? from : i == 1 ? to : part(random);
      most = std::fmax(most, value(values_at(other, i < 2 ? at : from + (to - from) * at)));
    }
    return most;
  }

  static void expect_bracket(const ComponentBound& c, double seen, double sign = 1) {
    ASSERT_TRUE(c.proved && c.attained) << c.reason;
    EXPECT_TRUE(c.is_closed) << c.component.label << ' ' << c.reason;
    const double proved = sign * c.proved->approx, attained = sign * c.attained->approx;
    const double room = 1e-6 * (1 + std::fabs(proved));
    EXPECT_LE(attained, proved);
    EXPECT_LE(seen, proved + room) << c.component.label;
    // Samples need not come near the largest value.
    EXPECT_GE(proved + room, attained);
    EXPECT_GE(seen, attained - 0.1 * std::fabs(attained) - room) << c.component.label;
  }
};

TEST_F(BoundsOfAFourBar, HoldWhatItsConfigurationsGive) {
  for (const double tolerance : {0.0, 1e-3})
    for_linkages(
        5, 3, tolerance,
        [&](const FourBar& linkage, const std::string& model, double from, double to,
            std::mt19937& random) {
          SCOPED_TRACE(model);
          const auto most = [&](const auto& value) {
            return largest(linkage, from, to, tolerance, random, value);
          };
          const Bound error = bound(model, asked("error"));
          const Bound speed = bound(model, asked("speed"));
          for (const std::size_t i : {0, 1}) {
            const auto J = [i](const OfFourBar& v) { return std::fabs(v.J[i]); };
            expect_bracket(error.components.at(i), 0.01 * most(J));
            expect_bracket(speed.components.at(i), 2 * most(J));
          }
          expect_bracket(bound(model, asked("determinant")).components.at(0),
                         most([](const OfFourBar& v) { return -std::fabs(v.det); }), -1);
          expect_bracket(bound(model, asked("determinant-max")).components.at(0),
                         most([](const OfFourBar& v) { return std::fabs(v.det); }));
          expect_bracket(bound(model, asked("condition")).components.at(0),
                         most([](const OfFourBar& v) { return v.condition; }));
          const auto force = [](const OfFourBar& v) {
            return std::fabs(v.J[0] + 2 * v.J[1]) + 2 * std::fabs(v.J[0]);
          };
          expect_bracket(bound(model, asked("force")).components.at(0), most(force));
          QuantityOptions least = asked("force");
          least.least = true;
          expect_bracket(bound(model, least).components.at(0), most([](const OfFourBar& v) {
                           return -(v.J[0] + 2 * v.J[1]) + 2 * std::fabs(v.J[0]);
                         }),
                         -1);
          const auto deflection = [](const OfFourBar& v) {
            return std::fabs(v.J[1]) / 50 *
                   (std::fabs(v.J[0] + 2 * v.J[1]) + 2 * std::fabs(v.J[0]));
          };
          expect_bracket(bound(model, asked("deflection")).components.at(1), most(deflection));
        });
}

/// Data of a quantity, others, and their place in the file.
const std::map<std::string, std::array<std::string, 3>> kChanges{
    {"error", {"error = 0.01", "error = 0.02", "actuators.error"}},
    {"speed", {"speed = 2", "speed = 3", "actuators.speed"}},
    {"force", {"[-1, 3]", "[-1, 4]", "load.L"}},
    {"deflection", {"stiffness = 50", "stiffness = 60", "actuators.stiffness"}}};

std::string text_of(const EndProof& proof) {
  std::ostringstream text;
  text << std::ifstream(proof.file).rdbuf();
  return text.str();
}

/// The proof with the bound of another one.
std::string exchanged(std::string text, const std::string& by) {
  const auto bound_of = [](const std::string& proof) {
    const std::size_t at = proof.find("\nbound ") + 7;
    return proof.substr(at, proof.find('\n', at) - at);
  };
  const std::string number = bound_of(text), other = bound_of(by);
  for (std::size_t at = 0; (at = text.find(number, at)) != std::string::npos; at += other.size())
    text.replace(at, number.size(), other);
  return text;
}

/// A proof is verified, and not for a model with other data.
void expect_verified(const std::string& proof, const std::string& model,
                     const std::string& quantity) {
  const verifier::Verification v = test::verified(proof, model);
  EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << describe(v) << proof.substr(0, 2000);
  const auto data = kChanges.find(quantity);
  if (data == kChanges.end()) return;
  std::string other = model;
  const auto& [from, to, place] = data->second;
  other.replace(other.find(from), from.size(), to);
  const verifier::Verification changed = test::verified(proof, other);
  EXPECT_EQ(changed.outcome, verifier::Outcome::kRejected) << describe(changed);
  EXPECT_NE(changed.reason.find(place), std::string::npos) << describe(changed);
}

/// The verifier proves both ends, and no number beyond them.
TEST_F(BoundsOfAFourBar, AreVerifiedAndComparedWithTheirModel) {
  for_linkages(
      9, 2, 5e-4, [&](const FourBar&, const std::string& model, double, double, std::mt19937&) {
        for (const char* quantity : {"error", "speed", "force", "deflection", "determinant",
                                     "determinant-max", "condition"}) {
          SCOPED_TRACE(quantity + model);
          const test::TemporaryDirectory directory;
          QuantityOptions words = asked(quantity);
          if (std::string(quantity) == "error") words.freedom = "phi";
          const Bound found = bound(model, words, 0.1, "", (directory.path() / "bound").string());
          const ComponentBound& c = found.components.front();
          ASSERT_TRUE(c.proved && c.attained);
          const std::string safe = text_of(c.proofs.safe()),
                            attained = text_of(c.proofs.singular());
          for (const std::string& proof : {safe, attained}) expect_verified(proof, model, quantity);
          // The bound of one end is no bound of the other.
          for (const std::string& forged : {exchanged(safe, attained), exchanged(attained, safe)}) {
            const verifier::Verification v = test::verified(forged);
            EXPECT_NE(v.outcome, verifier::Outcome::kVerified) << describe(v);
          }
          // A tube that is elsewhere holds no configuration, or another one.
          std::string moved = safe;
          const std::size_t at = moved.rfind(" tube ") + 6, digit = moved.find("p", at);
          moved.insert(digit + 2, "1");
          EXPECT_NE(test::verified(moved).outcome, verifier::Outcome::kVerified);
        }
      });
}

TEST_F(BoundsOfAFourBar, AreComparedWithALimit) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  const std::string model = linkage.text(0, -1, 1) + kData;
  const ComponentBound c = bound(model, asked("condition"), 0.001).components.at(0);
  ASSERT_TRUE(c.is_closed);
  const auto verdict = [&](double limit) {
    return bound(model, asked("condition"), 0.01, std::to_string(limit)).verdict();
  };
  EXPECT_EQ(verdict(c.proved->approx * 1.01), LimitVerdict::kWithin);
  EXPECT_EQ(verdict(c.attained->approx * 0.99), LimitVerdict::kExceeded);
}

/// The boxes of a place are as narrow as they can be, and so are their tubes.
TEST_F(BoundsOfAFourBar, AtOnePlaceAreTheValuesThere) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  constexpr double kPlace = 0.3;
  const std::string model = linkage.text(kPlace, kPlace, kPlace) + kData;
  const OfFourBar v = values_at(linkage, kPlace);
  const auto expect_value = [&](const std::string& quantity, double value, double sign = 1) {
    expect_bracket(bound(model, asked(quantity)).components.at(0), sign * value, sign);
  };
  expect_value("error", 0.01 * std::fabs(v.J[0]));
  expect_value("speed", 2 * std::fabs(v.J[0]));
  expect_value("determinant", std::fabs(v.det), -1);
  expect_value("determinant-max", std::fabs(v.det));
  expect_value("condition", v.condition);
  expect_value("force", std::fabs(v.J[0] + 2 * v.J[1]) + 2 * std::fabs(v.J[0]));
}

/// Beyond the toggle there is no branch, and so no bound.
TEST_F(BoundsOfAFourBar, EndWithTheBranch) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  const Bound found = bound(linkage.text(0, -2.4, 2.4) + kData, asked("error"));
  for (const ComponentBound& c : found.components) {
    EXPECT_FALSE(c.proved.has_value());
    EXPECT_TRUE(c.is_unbounded);
  }
}

}  // namespace
}  // namespace regulus::detail
