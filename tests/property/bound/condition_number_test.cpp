// SPDX-License-Identifier: GPL-3.0-or-later
// Condition numbers in the 2-norm against closed forms, and against singular values of random
// matrices in boxes that come from a library of their own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "codegen/model/file/model_file.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/condition/condition_test.hpp"
#include "codegen/question/condition/singular_value_test.hpp"
#include "codegen/question/condition/stretched_vectors.hpp"
#include "codegen/support/decomposition.hpp"
#include "codegen/support/errors.hpp"
#include "tests/property/bound/condition_models.hpp"
#include "tests/support/certificates.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test::condition_number {
namespace {

Request request_of(const std::string& text) {
  Model model = parse_model(text, "model.toml");
  Motion motion = model.motions.front();
  return {std::move(model), std::move(motion)};
}

ComponentBound condition_of(const std::string& text, const BoundSettings& settings) {
  const Request request = request_of(text);
  Quantity quantity = quantity_of(request.model, {.quantity = "condition", .norm = "2"});
  return bound_quantity(request, std::move(quantity), settings, [](const ComponentBound&) {})
      .components.front();
}

void expect_bracket(const std::string& text, double value, double gap = 1e-9) {
  const ComponentBound bound = condition_of(text, settings_with(gap));
  ASSERT_TRUE(bound.attained && bound.proved) << text << bound.reason;
  EXPECT_TRUE(bound.is_closed) << text << bound.reason;
  EXPECT_LE(bound.attained->approx, value * (1 + 1e-14)) << text;
  EXPECT_GE(bound.proved->approx, value * (1 - 1e-14)) << text;
  EXPECT_NEAR(bound.attained->approx, value, 2 * gap * value) << text;
  EXPECT_NEAR(bound.proved->approx, value, 2 * gap * value) << text;
}

TEST(ConditionNumber, MeetsClosedForms) {
  expect_bracket(model_with(R"m([[1, "x"], [0, 1]])m", "x = [0, 2]\ny = 0"),
                 std::pow(1 + std::sqrt(2.0), 2));
  expect_bracket(model_with(R"m([["x", 0], [0, "y"]])m", "x = [1, 2]\ny = [3, 10]"), 10);
  expect_bracket(model_with(R"m([["x"]])m", "x = [1, 2]\ny = 0"), 1);
  // More rows than columns.
  expect_bracket(model_with(R"m([["x", 0], [0, "y"], [0, 1]])m", "x = [1, 2]\ny = [3, 10]"),
                 std::sqrt(101.0));
  // An uncertain quantity.
  expect_bracket(model_with(R"m([["a", 0], [0, 1]])m", "x = [0, 1]\ny = 0"), 2.5);
  // A length that an angle counts as.
  expect_bracket(model_with(R"m([[1, 0], [0, "x"]])m" + std::string("\ntwist = [\"v_x\", \"w\"]"),
                            "x = [8, 10]\ny = 0", "characteristic_length = 2"),
                 5);
  // Scales of rows, and of entries that are far apart.
  expect_bracket(
      model_with(R"m([["x*y", 0], [0, "3*x"]])m" + std::string("\nrow_scale = [\"1/x\", \"2/x\"]"),
                 "x = [1, 2]\ny = [1, 2]"),
      6);
  expect_bracket(model_with(R"m([["1e9*x", 0], [0, "1e9*y"]])m", "x = [1, 2]\ny = [1, 3]"), 3);
}

/// The kernel's rows are scaled by powers of two.
TEST(ConditionNumber, IsThatOfTheMatrixAsWritten) {
  BoundSettings settings = settings_with(0.01);
  settings.search.max_boxes = 2000;
  const ComponentBound bound = condition_of(
      model_with(R"m([["1e7*x", "1e7*y"], ["y", "-x"]])m", "x = [1, 2]\ny = [1, 3]"), settings);
  ASSERT_TRUE(bound.attained && bound.proved);
  EXPECT_NEAR(bound.attained->approx, 1e7, 1);
  EXPECT_GE(bound.proved->approx, 1e7);
  EXPECT_LE(bound.proved->approx, 1e8);
}

/// With so many quantities there is no expansion to second order.
TEST(ConditionNumber, TakesManyUncertainQuantities) {
  std::string text = model_with(R"m([["a + SUM", 0], [0, "x"]])m", "x = [1, 2]\ny = 0");
  std::string sum = "b_1";
  for (int i = 2; i <= 12; ++i) sum += fmt::format(" + b_{}", i);
  text.replace(text.find("SUM"), 3, sum);
  text.insert(text.find("[matrix]"),
              "b = { value = [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1], tolerance = 0.5 }\n");
  expect_bracket(text, 20.5);
}

/// An arm with two links of length 1: κ depends on the angle of the elbow alone.
TEST(ConditionNumber, IsThatOfAnArm) {
  const char* arm =
      R"m([["-sin(x) - sin(x + y)", "-sin(x + y)"], ["cos(x) + cos(x + y)", "cos(x + y)"]])m";
  const double trace = 3 + 2 * std::cos(0.5), determinant = std::sin(0.5);
  const double value =
      (trace + std::sqrt(trace * trace - 4 * determinant * determinant)) / (2 * determinant);
  expect_bracket(model_with(arm, "x = \"3/10\"\ny = [0.5, 1.5]"), value);
  expect_bracket(model_with(arm, "x = [0, 1]\ny = [0.5, 1.5]"), value, 1e-3);
  // Nothing varies, and the kernel has no variable.
  std::string fixed = model_with(arm, "x = 0.25\ny = 0.5");
  const std::string tolerance = ", tolerance = 0.5";
  expect_bracket(fixed.erase(fixed.find(tolerance), tolerance.size()), value);
}

TEST(ConditionNumber, KeepsToTheConstraints) {
  expect_bracket(
      model_with(R"m([["x", 0], [0, 1]])m", "x = [-2, 2]\ny = 0\nconstraints = [\"1/2 - x^2\"]"), 2,
      1e-6);
  const ComponentBound empty = condition_of(
      model_with(R"m([["x", 0], [0, 1]])m", "x = [1, 2]\ny = 0\nconstraints = [\"x + 1\"]"),
      settings_with(0.01));
  EXPECT_TRUE(empty.is_empty);
  EXPECT_FALSE(empty.proved || empty.attained || empty.is_closed);
  // Only small boxes are certainly outside; y may be a variable that only the constraints know.
  for (const char* rows : {R"m([["x", 0], [0, "y"]])m", R"m([["x", 0], [0, 1]])m"}) {
    const ComponentBound narrow = condition_of(
        model_with(rows, "x = [1, 2]\ny = [1, 2]\nconstraints = [\"x - y\", \"y - x + 1/10\"]"),
        settings_with(0.01));
    EXPECT_TRUE(narrow.is_empty);
    EXPECT_FALSE(narrow.proved || narrow.attained || narrow.is_closed);
    EXPECT_LT(narrow.boxes, 2000U) << rows;
  }
}

TEST(ConditionNumber, IsUnboundedWhereTheMatrixIsSingular) {
  for (const char* range : {"x = [-1, 1]\ny = 0", "x = [-1, 2.3]\ny = [0, 1]"}) {
    const ComponentBound bound =
        condition_of(model_with(R"([["x + y^2", 0], ["y", 1]])", range), settings_with(0.01));
    EXPECT_TRUE(bound.is_unbounded) << range;
    EXPECT_TRUE(bound.place) << range;
    EXPECT_FALSE(bound.proved || bound.is_closed) << range;
  }
}

TEST(ConditionNumber, ClaimsNothingWhereTheMatrixIsNotDefined) {
  BoundSettings settings = settings_with(0.01);
  settings.search.max_boxes = 5000;
  const ComponentBound bound = condition_of(
      model_with(R"m([["1 + 0*sqrt(x)", 0], [0, "1/x"]])m", "x = [0, 1]\ny = 0"), settings);
  EXPECT_FALSE(bound.proved);
  EXPECT_FALSE(bound.is_closed);
}

TEST(ConditionNumber, IsComparedWithALimit) {
  const auto verdict = [](const char* limit) {
    BoundSettings settings = settings_with(0.01);
    settings.limit = GiNaC::ex(limit, GiNaC::lst{});
    return condition_of(model_with(R"m([[1, "x"], [0, 1]])m", "x = [0, 2]\ny = 0"), settings)
        .verdict;
  };
  EXPECT_EQ(verdict("5829/1000"), LimitVerdict::kWithin);
  EXPECT_EQ(verdict("5828/1000"), LimitVerdict::kExceeded);
}

TEST(ConditionNumber, DoesNotDependOnThreads) {
  const std::string text = model_with(R"m([["x", "y*a"], ["y - x", "sin(x) + 2"]])m",
                                      "x = [1, 2]\ny = [\"-1/2\", \"1/2\"]");
  BoundSettings settings = settings_with(1e-3);
  const ComponentBound one = condition_of(text, settings);
  settings.search.threads = 3;
  const ComponentBound three = condition_of(text, settings);
  ASSERT_TRUE(one.proved && three.proved);
  EXPECT_TRUE(one.proved->exact.is_equal(three.proved->exact));
  EXPECT_TRUE(one.attained->exact.is_equal(three.attained->exact));
  EXPECT_EQ(one.place->pose, three.place->pose);
  EXPECT_EQ(one.boxes, three.boxes);
}

TEST(ConditionNumber, RefusesWhatItDoesNotHave) {
  const Request request = request_of(model_with(R"m([[1, 0], [0, 1]])m", "x = [0, 2]\ny = 0"));
  EXPECT_THROW(
      static_cast<void>(quantity_of(request.model, {.quantity = "condition", .norm = "3"})),
      UsageError);
  EXPECT_THROW(
      static_cast<void>(quantity_of(request.model, {.quantity = "sigma-max", .norm = "2"})),
      UsageError);
}

/// A random matrix with random slopes over a random box.
struct RandomBox {
  std::mt19937 random;
  std::size_t columns, rows, parameters;
  BoxMatrix box;

  explicit RandomBox(unsigned seed) : random(seed) {
    columns = 1 + random() % 5;
    rows = columns + random() % 3;
    parameters = random() % 5;
    for (std::size_t e = 0; e < rows * columns; ++e)
      box.center.push_back(around(uniform(-1, 1) + (e / columns == e % columns ? 2 : 0), 1e-6));
    for (std::size_t e = 0; e < parameters * rows * columns; ++e)
      box.slopes.push_back(around(uniform(-1, 1), uniform(0, 0.1)));
    const double size = std::pow(10, uniform(-4, -0.5));
    for (std::size_t k = 0; k < parameters; ++k) box.radius.push_back(uniform(0, size));
  }

  double uniform(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  }
  /// Often an end of the range.
  double pick(const Interval& range) {
    const unsigned where = random() % 4;
    return where == 0 ? range.lo : where == 1 ? range.hi : uniform(range.lo, range.hi);
  }
  static Interval around(double middle, double radius) {
    return {middle - radius, middle + radius};
  }

  Eigen::MatrixXd sample() {
    Eigen::MatrixXd A(rows, columns);
    std::vector<double> shift;
    for (const double r : box.radius) shift.push_back(pick({-r, r}));
    for (std::size_t e = 0; e < rows * columns; ++e) {
      double entry = pick(box.center[e]);
      for (std::size_t k = 0; k < parameters; ++k)
        entry += pick(box.slopes[k * rows * columns + e]) * shift[k];
      A(Eigen::Index(e / columns), Eigen::Index(e % columns)) = entry;
    }
    return A;
  }
};

TEST(ConditionNumber, OfNoMatrixInABoxIsBeyondItsBound) {
  int bounded = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    RandomBox random(seed);
    const auto rotated = rotate(random.box, random.rows, random.columns);
    ASSERT_TRUE(rotated);
    const double upper = bound_condition(*rotated).upper;
    bounded += std::isfinite(upper);
    for (int i = 0; i < 100; ++i)
      ASSERT_LE(condition(random.sample()), upper * (1 + 1e-12)) << seed;
  }
  EXPECT_GT(bounded, 200);
}

TEST(SingularValues, OfNoMatrixInABoxAreBeyondTheirBounds) {
  int below = 0, above = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    RandomBox random(seed);
    const auto rotated = rotate(random.box, random.rows, random.columns);
    ASSERT_TRUE(rotated);
    const double largest = bound_singular_value(*rotated, Extreme::kLargest).value;
    const double least = bound_singular_value(*rotated, Extreme::kLeast).value;
    double seen_largest = 0, seen_least = kInfinity;
    for (int i = 0; i < 100; ++i) {
      const Eigen::VectorXd values = singular_values(random.sample());
      seen_largest = std::max(seen_largest, values(0));
      seen_least = std::min(seen_least, values(values.size() - 1));
    }
    ASSERT_LE(seen_largest, largest * (1 + 1e-12)) << seed;
    ASSERT_GE(seen_least, least * (1 - 1e-12)) << seed;
    below += largest < 1.5 * seen_largest ? 1 : 0;
    above += least > seen_least / 1.5 ? 1 : 0;
  }
  EXPECT_GT(below, 200);
  EXPECT_GT(above, 150);
}

/// The bounds of one matrix are its singular values.
TEST(SingularValues, OfAMatrixAreBoundedAndShown) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    RandomBox random(seed);
    const Eigen::MatrixXd A = random.sample();
    const Eigen::VectorXd values = singular_values(A);
    BoxMatrix alone;
    for (Eigen::Index e = 0; e < A.size(); ++e)
      alone.center.emplace_back(A(e / A.cols(), e % A.cols()));
    const auto rotated = rotate(alone, random.rows, random.columns);
    ASSERT_TRUE(rotated);
    const AttainedValues shown = attained_values(alone.center, random.rows, random.columns);
    const double largest = values(0), least = values(values.size() - 1), room = 1e-10 * largest;
    EXPECT_LE(shown.largest, largest * (1 + 1e-12)) << seed;
    EXPECT_NEAR(shown.largest, largest, room) << seed;
    EXPECT_GE(shown.least, least - 1e-12 * largest) << seed;
    EXPECT_NEAR(shown.least, least, room) << seed;
    const double above = bound_singular_value(*rotated, Extreme::kLargest).value;
    EXPECT_GE(above, largest * (1 - 1e-12)) << seed;
    EXPECT_NEAR(above, largest, room) << seed;
    const double below = bound_singular_value(*rotated, Extreme::kLeast).value;
    EXPECT_LE(below, least + 1e-12 * largest) << seed;
    EXPECT_NEAR(below, least, room) << seed;
  }
}

TEST(ConditionNumber, OfAMatrixIsShownByItsVectors) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    RandomBox random(seed);
    const Eigen::MatrixXd A = random.sample();
    std::vector<Interval> entries;
    for (Eigen::Index e = 0; e < A.size(); ++e) entries.emplace_back(A(e / A.cols(), e % A.cols()));
    const double shown = attained_condition(entries, random.rows, random.columns).condition;
    EXPECT_LE(shown, condition(A) * (1 + 1e-12)) << seed;
    EXPECT_GE(shown, condition(A) * (1 - 1e-10)) << seed;
  }
}

TEST(ConditionNumber, OfNoPoseOfARandomModelLeavesItsBracket) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    RandomModel model(seed);
    const ComponentBound bound = condition_of(model.text(), settings_with(0.01));
    if (bound.is_unbounded) continue;
    ASSERT_TRUE(bound.proved && bound.attained) << seed;
    double most = 0;
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 10000; ++i) {
      const auto place = [&] {
        const unsigned where = model.random() % 3;
        return where < 2 ? double(where) : unit(model.random);
      };
      const double x = place(), y = 2 * place() - 1, a = 1.5 + place();
      most = std::max(most, condition(model.at(x, y, a)));
    }
    EXPECT_LE(most, bound.proved->approx * (1 + 1e-12)) << seed;
    EXPECT_GE(bound.attained->approx, 0.98 * most) << seed;
  }
}

TEST(ConditionNumber, OfARandomModelIsProvedByItsCertificates) {
  const TemporaryDirectory directory;
  verifier::Options effort;
  effort.max_boxes = 1000;
  int proved = 0, refused = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    BoundSettings settings = settings_with(0.01);
    settings.certificate = (directory.path() / "proof").string();
    const ComponentBound bound = condition_of(RandomModel(seed).text(), settings);
    const std::string attained = file_contents(settings.certificate + ".singular");
    EXPECT_EQ(verify_text(attained, effort).outcome, verifier::Outcome::kVerified) << seed;
    if (bound.is_unbounded) continue;
    const std::string safe = file_contents(settings.certificate + ".safe");
    const verifier::Verification v = verify_text(safe, effort);
    EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << seed << ' ' << v.reason;
    EXPECT_LE(v.boxes, 3 * v.leaves) << seed;
    proved += v.outcome == verifier::Outcome::kVerified;
    for (const double part : {1.0, 0.999, 0.9}) {
      refused += verify_text(with_number(safe, part * bound.attained->approx), effort).outcome !=
                 verifier::Outcome::kVerified;
      // A larger number than any pose has is not attained.
      refused += verify_text(with_number(attained, bound.proved->approx / part), effort).outcome !=
                 verifier::Outcome::kVerified;
    }
  }
  EXPECT_GT(proved, 6);
  EXPECT_EQ(refused, 6 * proved);
}

}  // namespace
}  // namespace regulus::detail::test::condition_number
