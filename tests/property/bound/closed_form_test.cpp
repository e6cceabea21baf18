// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets of quantities whose extreme values are known in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "codegen/model/file/model_file.hpp"
#include "codegen/question/bound/bound_run.hpp"

namespace regulus::detail::test {
namespace {

/// J⁻¹ = [1 x; 0 1] with 0 ≤ x ≤ 2, written with a row scale.
constexpr const char* kShear = R"toml(regulus = 1
name = "shear"
[pose]
x = "cm"
y = "cm"
[geometry]
[matrix]
rows = [["x + 3", "x*(x + 3)"], [0, 2]]
row_scale = ["1/(x + 3)", "1/2"]
[load.push]
wrench = [1, 1]
[load.any]
force = [[-1, 1], [-1, 1]]
[load.round]
force = { value = [0, 0], radius = 1 }
[twist.along]
velocity = [1, 1]
[actuators]
error = 0.1
stiffness = 2
[motion.m]
x = [0, 2]
y = 0
)toml";

Request request_of(const char* text, const std::string& asked = "") {
  Model model = parse_model(text, "model.toml", asked);
  Motion motion = model.motions.front();
  return {std::move(model), std::move(motion)};
}

Bound bound_of(const Request& request, const QuantityOptions& options, double gap = 1e-9) {
  BoundSettings settings;
  settings.gap = gap;
  settings.search.engine = Engine::kAuto;
  settings.search.threads = 1;
  settings.search.time_limit = 60;
  settings.output.quiet = true;
  return bound_quantity(request, quantity_of(request.model, options), settings,
                        [](const ComponentBound&) {});
}

/// A quantity with its value, and a part of it that the bracket may have.
struct Known {
  QuantityOptions options;
  double value;
  double gap = 1e-9;
};

void PrintTo(const Known& known, std::ostream* out) { *out << known.options.quantity; }

class KnownBound : public testing::TestWithParam<Known> {};

TEST_P(KnownBound, IsBracketedToItsLastDigits) {
  const Known& known = GetParam();
  const std::string& word = known.options.quantity;
  const Request request = request_of(kShear, is_quantity(word) ? "" : word);
  const Bound bound = bound_of(request, known.options, known.gap);
  const ComponentBound *attained = bound.decisive_attained(), *proved = bound.decisive_proved();
  ASSERT_TRUE(attained && proved);
  const double scale = std::max(std::abs(known.value), 1e-3);
  EXPECT_NEAR(attained->attained->approx, known.value, 10 * known.gap * scale);
  EXPECT_NEAR(proved->proved->approx, known.value, 10 * known.gap * scale);
  const double a = attained->attained->approx, p = proved->proved->approx;
  EXPECT_TRUE(bound.quantity.is_least ? p <= a : a <= p) << a << " " << p;
}

const double kRoot2 = std::sqrt(2.0);

// F = (1, 1 − x) under (1, 1); δx = (1 − x + x², …)/2.
INSTANTIATE_TEST_SUITE_P(
    Shear, KnownBound,
    testing::Values(
        Known{{.quantity = "force", .load = "push", .row = "2"}, 1},
        Known{{.quantity = "force", .load = "push", .row = "2", .least = true}, -1},
        Known{{.quantity = "force", .load = "push", .row = "1", .least = true}, 1},
        Known{{.quantity = "force", .load = "push", .row = "2", .is_signed = true}, 1},
        Known{{.quantity = "force", .load = "any"}, 3},
        Known{{.quantity = "force", .load = "round"}, std::sqrt(5.0)},
        Known{{.quantity = "speed"}, 3}, Known{{.quantity = "error", .freedom = "x"}, 0.3},
        Known{{.quantity = "error", .freedom = "y"}, 0.1},
        Known{{.quantity = "deflection", .load = "push", .freedom = "x"}, 1.5},
        Known{{.quantity = "sigma-max"}, 1 + kRoot2}, Known{{.quantity = "sigma-min"}, kRoot2 - 1},
        Known{{.quantity = "condition"}, 9},
        // It is the same at every pose, so every box must be as small as the gap.
        Known{{.quantity = "determinant"}, 1, 1e-2}, Known{{.quantity = "x^2 - 7"}, -3},
        Known{{.quantity = "x^2 - 7", .least = true}, -7}, Known{{.quantity = "sin(x)"}, 1}));

TEST(ABound, OfTheNormOfAnErrorIsThatOfItsLongestVector) {
  const Request request = request_of(kShear);
  const Bound bound = bound_of(request, {.quantity = "error", .freedom = "position"}, 1e-3);
  ASSERT_TRUE(bound.decisive_proved());
  // The error is (δ₁ − xδ₂, δ₂).
  EXPECT_NEAR(bound.decisive_proved()->proved->approx, 0.1 * std::sqrt(10.0), 1e-3);
  EXPECT_LE(bound.decisive_attained()->attained->approx, 0.1 * std::sqrt(10.0) * (1 + 1e-9));
}

constexpr const char* kSingular = R"toml(regulus = 1
name = "singular"
[pose]
x = "1"
[matrix]
rows = [["x"]]
[load.one]
wrench = [1]
[motion.m]
x = [-1, 1]
)toml";

TEST(ABound, OfAForceIsUnboundedWhereTheRobotIsSingular) {
  const Bound bound = bound_of(request_of(kSingular), {.quantity = "force"});
  ASSERT_EQ(bound.components.size(), 1u);
  EXPECT_TRUE(bound.components[0].is_unbounded);
  EXPECT_FALSE(bound.decisive_proved());
  EXPECT_EQ(bound.components[0].place->pose, "x = 0");
}

/// At x = 0 the second row is not defined, although B would be regular there.
constexpr const char* kUndefined = R"toml(regulus = 1
name = "dead point"
[pose]
x = "1"
[matrix]
rows = [["1"]]
row_scale = ["1/sqrt(x)"]
[load.one]
wrench = [1]
[motion.m]
x = [0, 1]
)toml";

TEST(ABound, ClaimsNothingWhereTheModelIsNotDefined) {
  const Bound bound = bound_of(request_of(kUndefined), {.quantity = "force"});
  EXPECT_FALSE(bound.decisive_proved());
  EXPECT_FALSE(bound.is_closed());
}

/// Its names are those that B would give to r and to its uncertain values.
constexpr const char* kTakenNames = R"toml(regulus = 1
name = "taken"
[pose]
r = "1"
error_1 = "1"
[geometry]
y_1 = 3
[matrix]
rows = [["y_1", "r"], ["0", "3 + error_1"]]
[actuators]
error = [0.5, 0.25]
[motion.m]
r = [0, 2]
error_1 = [0, 1]
)toml";

TEST(ABound, TakesNoNameOfTheModel) {
  const Bound error = bound_of(request_of(kTakenNames), {.quantity = "error"}, 1e-3);
  // The second freedom: 0.25/(3 + error_1) at most.
  EXPECT_NEAR(error.components[1].proved->approx, 0.25 / 3, 1e-3);
  const Bound condition = bound_of(request_of(kTakenNames), {.quantity = "condition"}, 1e-2);
  ASSERT_TRUE(condition.decisive_proved());
  // (3 + 2)·(1/3 + 2/9) at r = 2, error_1 = 0.
  EXPECT_NEAR(condition.decisive_proved()->proved->approx, 25.0 / 9, 0.1);
}

constexpr const char* kOneSided = R"toml(regulus = 1
name = "hoop"
[pose]
x = "1"
y = "1"
[matrix]
rows = [["x", "y"], ["-y", "x"]]
[load.one]
wrench = [1, 0]
[motion.m]
x = [-2, 2]
y = [-2, 2]
constraints = ["1 - x^2 - y^2", "1/2 - x^2"]
)toml";

TEST(ABound, HoldsOverPosesThatConstraintsCutInTwo) {
  // F = (x, y)/(x² + y²), up to signs: the set of poses is not connected.
  const Bound bound = bound_of(request_of(kOneSided), {.quantity = "force", .row = "1"}, 1e-3);
  ASSERT_TRUE(bound.decisive_proved());
  EXPECT_GE(bound.decisive_proved()->proved->approx, 1);
  EXPECT_LE(bound.decisive_proved()->proved->approx, 1.01);
}

TEST(ALimit, IsKeptExceededOrTouched) {
  const Request request = request_of(kShear);
  const auto verdict = [&](const char* limit) {
    BoundSettings settings;
    settings.limit = GiNaC::ex(limit, GiNaC::lst{});
    settings.search.threads = 1;
    settings.search.engine = Engine::kAuto;
    settings.search.time_limit = 20;
    settings.output.quiet = true;
    return bound_quantity(request, quantity_of(request.model, {.quantity = "speed"}), settings,
                          [](const ComponentBound&) {})
        .verdict();
  };
  EXPECT_EQ(verdict("30001/10000"), LimitVerdict::kWithin);
  EXPECT_EQ(verdict("29999/10000"), LimitVerdict::kExceeded);
  EXPECT_NE(verdict("3"), LimitVerdict::kWithin);  // it is attained
}

/// The second leg holds nothing of the load.
TEST(KnownBound, OfAForceThatIsZeroIsNarrowBesideTheLoad) {
  std::string text = kShear;
  text.replace(text.find("\"x*(x + 3)\""), 11, "0");
  text.replace(text.find("wrench = [1, 1]"), 15, "wrench = [8, 0]");
  for (const bool is_signed : {false, true}) {
    const Bound bound =
        bound_of(request_of(text.c_str()),
                 {.quantity = "force", .load = "push", .row = "2", .is_signed = is_signed}, 0.01);
    const ComponentBound& leg = bound.components.front();
    EXPECT_TRUE(leg.is_closed);
    EXPECT_EQ(leg.reason, "");
    ASSERT_TRUE(leg.proved.has_value());
    EXPECT_GT(leg.proved->approx, 0);
    EXPECT_LT(leg.proved->approx, 1e-6);
    EXPECT_EQ(leg.attained.has_value(), is_signed);
  }
}

/// The least magnitude is 0 at x = −3, where the first row is singular; no end is missing.
TEST(KnownBound, OfAMagnitudeThatAttainsZeroIsClosed) {
  std::string text = kShear;
  text.replace(text.find("row_scale = [\"1/(x + 3)\", \"1/2\"]"), 32, "");
  text.replace(text.find("x = [0, 2]"), 10, "x = [-4, 2]");
  for (const char* quantity : {"sigma-min", "determinant"}) {
    const ComponentBound least =
        bound_of(request_of(text.c_str()), {.quantity = quantity}, 0.01).components.front();
    EXPECT_TRUE(least.is_closed && least.is_singular()) << quantity;
    EXPECT_EQ(least.reason, "");
    ASSERT_TRUE(least.attained.has_value());
    EXPECT_TRUE(least.attained->exact.is_zero());
  }
  const ComponentBound negative =
      bound_of(request_of(text.c_str()), {.quantity = "determinant", .least = true}, 0.01)
          .components.front();
  EXPECT_TRUE(negative.is_closed);
  EXPECT_FALSE(negative.is_singular());
}

/// The first row has the scale 1/(x + 3), which must be defined; the second one is not moved at all.
TEST(KnownBound, IsZeroForARowThatNoTwistMoves) {
  std::string text = kShear;
  text.replace(text.find("velocity = [1, 1]"), 17, "velocity = [1, 0]");
  const Bound bound = bound_of(request_of(text.c_str()), {.quantity = "speed", .row = "2"}, 0.01);
  ASSERT_EQ(bound.components.size(), 1U);
  const ComponentBound& speed = bound.components.front();
  ASSERT_TRUE(speed.proved && speed.attained && speed.place);
  EXPECT_EQ(speed.proved->approx, 0);
  EXPECT_EQ(speed.attained->approx, 0);
  EXPECT_TRUE(speed.is_closed);
  EXPECT_EQ(speed.place->pose, "every pose");
  // With x = -3 among the poses, nothing is claimed.
  text.replace(text.find("x = [0, 2]"), 10, "x = [-3, 2]");
  const Bound none = bound_of(request_of(text.c_str()), {.quantity = "speed", .row = "2"}, 0.01);
  EXPECT_FALSE(none.components.front().proved);
}

}  // namespace
}  // namespace regulus::detail::test
