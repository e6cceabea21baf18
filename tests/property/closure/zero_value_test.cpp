// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds over a branch of quantities that are 0, everywhere or where they are extreme. A claim that
// a magnitude is less than 0 would be false.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/closure/branch_bound.hpp"
#include "tests/property/closure/checked_closures.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail {
namespace {

using test::file_contents;

/// p = a·x·y, and r moves with no motor.
std::string model_with(const std::string& factor, const std::string& y) {
  return "regulus = 1\nname = \"product\"\n[pose]\nx = \"m\"\ny = \"m\"\n[closure]\n"
         "unknowns = { p = \"m\", r = \"m\" }\nequations = [\"p - " +
         factor +
         "*x*y\", \"r^2 - 2\"]\nstart = { x = 0, y = 0, p = 0, r = 1.4142 }\n[actuators]\n"
         "error = 0.01\nspeed = 3\nstiffness = 50\n[load.L]\nwrench = [2, [-1, 1]]\n[motion.m]\n"
         "x = [0, 2]\ny = " +
         y + "\nerror = { x = 0.125 }\n";
}

struct Zero {
  const char* quantity;
  std::size_t component;
  bool least = false;
  bool is_signed = false;
};

void PrintTo(const Zero& zero, std::ostream* out) { *out << zero.quantity << zero.component; }

class QuantityThatIsZero : public testing::TestWithParam<Zero> {
 protected:
  /// Brackets it, and lets the verifier prove each end.
  static ComponentBound bracket(const std::string& model) {
    const test::TemporaryDirectory directory;
    ModelOptions options;
    options.motion = "m";
    const Request request = read_request(model, options);
    BoundSettings settings;
    settings.search = test::usual_options();
    settings.over_branch = bounds_over_branch();
    settings.certificate = (directory.path() / "bound").string();
    QuantityOptions words;
    words.quantity = GetParam().quantity;
    words.least = GetParam().least;
    words.is_signed = GetParam().is_signed;
    words.is_finite = std::string(GetParam().quantity) == "finite";
    if (words.is_finite) words.quantity = "error";
    const Bound found = bound_quantity(request, quantity_of(request.model, words), settings,
                                       [](const ComponentBound&) {});
    const ComponentBound& c = found.components.at(GetParam().component);
    for (const EndProof& proof : {c.proofs.safe(), c.proofs.singular()}) {
      if (proof.file.empty()) continue;
      const verifier::Verification v = test::verified(file_contents(proof.file), model);
      EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << describe(v);
    }
    EXPECT_FALSE(c.proofs.safe().file.empty());
    EXPECT_EQ(c.attained.has_value(), !c.proofs.singular().file.empty());
    return c;
  }
};

TEST_P(QuantityThatIsZero, IsBracketedAndVerified) {
  for (const char* factor : {"1", "(1/3)", "(-7/5)"}) {
    const ComponentBound c = bracket(model_with(factor, "0"));
    EXPECT_TRUE(c.is_closed) << c.reason;
    ASSERT_TRUE(c.proved.has_value());
    const double sign = GetParam().least ? -1 : 1;
    EXPECT_GT(sign * c.proved->approx, 0);
    EXPECT_LT(sign * c.proved->approx, 1e-6);
    // That a magnitude attains 0 says nothing.
    EXPECT_EQ(c.attained.has_value(), GetParam().least || GetParam().is_signed);
    if (c.attained) {
      EXPECT_LT(sign * c.attained->approx, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    OfAllKinds, QuantityThatIsZero,
    testing::Values(Zero{"force", 0}, Zero{"force", 0, true}, Zero{"force", 0, false, true},
                    Zero{"error", 1}, Zero{"speed", 1}, Zero{"deflection", 1}, Zero{"finite", 1}),
    [](const auto& tested) {
      return std::string(tested.param.quantity) + (tested.param.least       ? "_least"
                                                   : tested.param.is_signed ? "_signed"
                                                                            : "");
    });

/// The least force 2·a·x of the second motor is 0 where x is, and is attained there.
TEST(QuantityThatIsZeroAtItsLeast, HasBothEnds) {
  ModelOptions options;
  options.motion = "m";
  const Request request = read_request(model_with("3", "[0, 1]"), options);
  BoundSettings settings;
  settings.search = test::usual_options();
  settings.over_branch = bounds_over_branch();
  QuantityOptions words;
  words.quantity = "force";
  words.least = true;
  const Bound found = bound_quantity(request, quantity_of(request.model, words), settings,
                                     [](const ComponentBound&) {});
  const ComponentBound& c = found.components.at(1);
  ASSERT_TRUE(c.is_closed && c.proved && c.attained) << c.reason;
  // With its error, x is at least −1/8.
  EXPECT_NEAR(c.proved->approx, -0.75, 0.01);
  EXPECT_LT(c.proved->approx, -0.75);
  EXPECT_GT(c.attained->approx, -0.75);
}

}  // namespace
}  // namespace regulus::detail
