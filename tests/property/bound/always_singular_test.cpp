// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds of a robot that is singular at every pose: nothing that needs an inverse has one, and the least
// singular value is 0.
#include <gtest/gtest.h>

#include "codegen/question/bound/bound_run.hpp"
#include "tests/support/command.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test::always_singular {
namespace {

/// The model of the library, whose legs are dependent by an identity, with data for all quantities.
std::string model_text() {
  std::string text = file_contents(model_path("griffis_duffy"));
  text.insert(text.find("\n["), "\ncharacteristic_length = 5");
  return text +
         "\n[actuators]\nerror = 0.001\nspeed = 1\nstiffness = 100\n"
         "[load.push]\nforce = [10, 0, -20]\nmoment = [0, 0, 0]\n";
}

Bound bound_of(const std::string& quantity, const std::string& text, const ModelOptions& options) {
  const Request request = read_request(text, options);
  BoundSettings settings;
  settings.search.threads = 1;
  settings.output.quiet = true;
  return bound_quantity(request, quantity_of(request.model, {.quantity = quantity}), settings,
                        [](const ComponentBound&) {});
}

Bound bound_of(const std::string& quantity, const std::string& range) {
  ModelOptions options;
  options.motion = "turn";
  options.ranges = {range};
  return bound_of(quantity, model_text(), options);
}

void expect_unbounded(const std::string& quantity, const std::string& range) {
  for (const ComponentBound& c : bound_of(quantity, range).components) {
    EXPECT_TRUE(c.is_unbounded) << quantity << ", " << c.component.label;
    EXPECT_FALSE(c.proved || c.attained) << quantity << ", " << c.component.label;
    EXPECT_TRUE(c.place.has_value()) << quantity << ", " << c.component.label;
    EXPECT_EQ(c.reason, "") << quantity << ", " << c.component.label;
  }
}

void expect_least_singular_value_zero(const std::string& range) {
  const Bound bound = bound_of("sigma-min", range);
  const ComponentBound& c = bound.components.front();
  ASSERT_TRUE(c.attained.has_value());
  EXPECT_TRUE(c.attained->exact.is_zero());
  EXPECT_TRUE(c.is_closed);
  EXPECT_FALSE(c.proved.has_value());
}

/// At no double is the pose what the file says.
TEST(ARobotThatIsAlwaysSingular, HasNoBoundsAtOnePose) {
  for (const char* quantity : {"error", "force", "deflection", "condition"})
    expect_unbounded(quantity, "T=0.505");
  expect_least_singular_value_zero("T=0.505");
}

TEST(ARobotThatIsAlwaysSingular, HasNoBoundsOverARange) {
  for (const char* quantity : {"deflection", "condition"}) expect_unbounded(quantity, "T=0.25:0.3");
  expect_least_singular_value_zero("T=0.25:0.3");
}

/// It needs no inverse.
TEST(ARobotThatIsAlwaysSingular, HasALargestSingularValue) {
  const Bound bound = bound_of("sigma-max", "T=0.505");
  const ComponentBound& c = bound.components.front();
  ASSERT_TRUE(c.attained && c.proved);
  EXPECT_GT(c.attained->approx, 0);
  EXPECT_FALSE(c.is_unbounded);
}

/// At x = 0 the leg has no length: its row is 0, and J⁻¹, which is regular elsewhere, is undefined.
TEST(AMatrixWithoutAScale, IsNotSingular) {
  const std::string text =
      "regulus = 1\nname = \"leg of no length\"\n[pose]\nx = \"m\"\ny = \"m\"\n[matrix]\n"
      "rows = [[\"x\", \"0\"], [\"0\", \"5\"]]\nrow_scale = [\"1/sqrt(x^2)\", \"1/5\"]\n"
      "[motion.m]\nx = [-1, 1]\ny = 0\n";
  for (const char* quantity : {"sigma-min", "determinant", "condition"})
    for (const ComponentBound& c : bound_of(quantity, text, {}).components) {
      EXPECT_FALSE(c.is_unbounded) << quantity;
      EXPECT_FALSE(c.attains_zero()) << quantity;
    }
}

}  // namespace
}  // namespace regulus::detail::test::always_singular
