// SPDX-License-Identifier: GPL-3.0-or-later
// Condition numbers in the 2-norm along way-points: against closed forms, and against singular values at
// many poses of the path that come from a library of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "tests/property/bound/condition_models.hpp"
#include "tests/support/certificates.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

struct Point {
  double x, y;
};

class ConditionAlongWay : public testing::Test {
 protected:
  /// The motion is through the points, in straight segments.
  ComponentBound condition_of(const std::string& text, const std::vector<Point>& points,
                              const std::vector<std::string>& tubes, BoundSettings settings) {
    std::ofstream way(file("way.csv"));
    way << "x,y\n";
    for (const Point& p : points) way << fmt::format("{},{}\n", p.x, p.y);
    way.close();
    ModelOptions model;
    model.path = "model.toml";
    model.motion = "m";
    model.text = text;
    model.waypoints = file("way.csv");
    model.tubes = tubes;
    const Request request = read_request(model);
    Quantity quantity = quantity_of(request.model, {.quantity = "condition", .norm = "2"});
    return bound_quantity(request, std::move(quantity), settings, [](const ComponentBound&) {})
        .components.front();
  }
  void expect_bracket(const std::string& rows, const std::vector<Point>& points,
                      const std::vector<std::string>& tubes, double value,
                      const std::string& more = "") {
    BoundSettings settings = settings_with(1e-6);
    settings.certificate = file("proof");
    const ComponentBound bound =
        condition_of(model_with(rows, "x = [0, 1]\ny = [0, 1]\n" + more), points, tubes, settings);
    ASSERT_TRUE(bound.attained && bound.proved) << rows << bound.reason;
    EXPECT_TRUE(bound.is_closed) << rows << bound.reason;
    EXPECT_LE(bound.attained->approx, value * (1 + 1e-14)) << rows;
    EXPECT_GE(bound.proved->approx, value * (1 - 1e-14)) << rows;
    EXPECT_NEAR(bound.proved->approx, value, 2e-6 * value) << rows;
    expect_proofs(rows);
  }
  void expect_proofs(const std::string& about) {
    for (const char* end : {".safe", ".singular"}) {
      const verifier::Verification v = verify_text(file_contents(file("proof") + end));
      EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << about << end << ' ' << v.reason;
    }
  }
  [[nodiscard]] std::string file(const std::string& name) const {
    return (folder_.path() / name).string();
  }

 private:
  TemporaryDirectory folder_;
};

constexpr const char* kStretch = R"m([["x", 0], [0, 1]])m";
/// κ is that of kStretch.
constexpr const char* kTurned = R"m([["x*cos(y)", "-sin(y)"], ["x*sin(y)", "cos(y)"]])m";

TEST_F(ConditionAlongWay, MeetsClosedForms) {
  for (const char* rows : {kStretch, kTurned}) {
    expect_bracket(rows, {{2, 0}, {5, 1}, {3, 2}}, {}, 5);
    expect_bracket(rows, {{2, 0}, {5, 0.5}}, {}, 5);
    expect_bracket(rows, {{0.25, 0}, {2, 0.5}, {0.5, 0}}, {}, 4);
    // Many segments, of which the number is no power of two.
    expect_bracket(rows, {{1, 0}, {2, 1}, {3, 0}, {4, 1}, {7, 0}, {6, 1}, {5, 0}, {2, 2}}, {}, 7);
    // With control errors. One tenth is no double.
    expect_bracket(rows, {{2, 0}, {5, 1}, {3, 2}}, {"x=0.1"}, 5.1);
    expect_bracket(rows, {{0.25, 0}, {2, 0.5}}, {"x=0.05", "y=0.3"}, 5);
  }
  // An uncertain quantity, of which κ does not grow alone.
  expect_bracket(R"m([["a*x", 0], [0, 1]])m", {{2, 0}, {5, 1}, {3, 2}}, {}, 12.5);
  // The path is in the middle of a box of which κ is larger.
  expect_bracket(R"m([["1 + x*y", 0], [0, 1]])m", {{0, 4}, {4, 0}}, {}, 5);
}

TEST_F(ConditionAlongWay, KeepsToTheConstraints) {
  expect_bracket(kStretch, {{2, 0}, {5, 1}, {3, 2}}, {}, 4, "constraints = [\"x - 4\"]");
  const ComponentBound empty =
      condition_of(model_with(kStretch, "x = [0, 1]\ny = [0, 1]\nconstraints = [\"x + 1\"]"),
                   {{1, 0}, {2, 0}, {3, 0}, {4, 1}}, {}, settings_with(0.01));
  EXPECT_TRUE(empty.is_empty);
  EXPECT_FALSE(empty.proved || empty.attained || empty.is_closed);
}

TEST_F(ConditionAlongWay, IsUnboundedWhereTheMatrixIsSingular) {
  BoundSettings settings = settings_with(0.01);
  settings.certificate = file("proof");
  const std::string text = model_with(kTurned, "x = [0, 1]\ny = [0, 1]");
  const ComponentBound bound = condition_of(text, {{3, 0}, {1, 1}, {-2, 2}}, {}, settings);
  EXPECT_TRUE(bound.is_unbounded);
  ASSERT_TRUE(bound.place);
  EXPECT_EQ(bound.place->json["segment"]["segment"], 2);
  EXPECT_FALSE(bound.proved || bound.is_closed);
  EXPECT_EQ(verify_text(file_contents(file("proof.singular"))).outcome,
            verifier::Outcome::kVerified);
  // Only with its control errors.
  EXPECT_TRUE(
      condition_of(text, {{3, 0}, {0.25, 1}, {2, 2}}, {"x=0.5"}, settings_with(0.01)).is_unbounded);
}

TEST_F(ConditionAlongWay, IsComparedWithALimit) {
  const std::string text = model_with(kTurned, "x = [0, 1]\ny = [0, 1]");
  for (const auto& [limit, verdict] : {std::pair{"5001/1000", LimitVerdict::kWithin},
                                       std::pair{"4999/1000", LimitVerdict::kExceeded}}) {
    BoundSettings settings = settings_with(0.01);
    settings.limit = GiNaC::ex(limit, GiNaC::lst{});
    settings.certificate = file("proof");
    EXPECT_EQ(condition_of(text, {{2, 0}, {5, 1}, {3, 2}}, {}, settings).verdict, verdict);
    const char* end = verdict == LimitVerdict::kWithin ? ".safe" : ".singular";
    EXPECT_EQ(verify_text(file_contents(file("proof") + end)).outcome,
              verifier::Outcome::kVerified);
  }
}

TEST_F(ConditionAlongWay, DoesNotDependOnThreadsOrAStop) {
  const std::string text =
      model_with(R"m([["x", "y*a"], ["y - x", "sin(x) + 2"]])m", "x = [0, 1]\ny = [0, 1]");
  const std::vector<Point> points{{1, -0.5}, {2, 0.5}, {1.5, 0}, {1, 0.25}};
  const auto run = [&](unsigned threads, std::uint64_t boxes, BracketCheckpoint* checkpoint) {
    BoundSettings settings = settings_with(1e-3);
    settings.search.threads = threads;
    settings.search.max_boxes = boxes;
    settings.checkpoint = checkpoint;
    settings.certificate = file("proof");
    const ComponentBound bound = condition_of(text, points, {"x=0.01"}, settings);
    EXPECT_TRUE(bound.proved && bound.attained);
    return fmt::format("{} {} {} {}\n{}{}", formula_text(bound.proved->exact),
                       formula_text(bound.attained->exact), bound.boxes, bound.place->pose,
                       file_contents(file("proof.safe")), file_contents(file("proof.singular")));
  };
  const std::string whole = run(1, 0, nullptr);
  EXPECT_EQ(run(3, 0, nullptr), whole);
  for (const std::uint64_t boxes : {40, 150}) {
    const nlohmann::ordered_json question = {{"test", boxes}};
    for (const std::uint64_t most : {boxes, std::uint64_t{0}}) {
      BracketCheckpoint checkpoint(file(fmt::format("state_{}", boxes)), question);
      const std::string found = run(2, most, &checkpoint);
      if (most == 0) {
        EXPECT_EQ(found, whole) << boxes;
      }
    }
  }
}

TEST_F(ConditionAlongWay, OfNoPoseOfARandomModelLeavesItsBracket) {
  int closed = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    RandomModel model(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Point> points;
    for (unsigned i = 0; i < 2 + seed % 5; ++i)
      points.push_back({std::round(64 * unit(model.random)) / 64,
                        std::round(128 * unit(model.random)) / 64 - 1});
    BoundSettings settings = settings_with(0.01);
    settings.certificate = file("proof");
    const ComponentBound bound = condition_of(model.text(), points, {"x=0.0625"}, settings);
    if (bound.is_unbounded) continue;
    ASSERT_TRUE(bound.proved && bound.attained) << seed << bound.reason;
    double most = 0;
    const auto end = [&] { return double(model.random() % 3) / 2; };
    for (int i = 0; i < 20000; ++i) {
      const std::size_t piece = model.random() % (points.size() - 1);
      const double s = i % 4 == 0 ? end() : unit(model.random);
      const Point &a = points[piece], &b = points[piece + 1];
      most = std::max(most, condition(model.at(a.x + s * (b.x - a.x) + 0.0625 * (2 * end() - 1),
                                               a.y + s * (b.y - a.y), 1.5 + end())));
    }
    EXPECT_LE(most, bound.proved->approx * (1 + 1e-12)) << seed;
    EXPECT_GE(bound.attained->approx, 0.98 * most) << seed;
    EXPECT_LE(bound.attained->approx, 1.02 * most) << seed;
    closed += bound.is_closed;
    expect_proofs(fmt::format("seed {}", seed));
    const std::string safe = file_contents(file("proof.safe"));
    verifier::Options effort;
    effort.max_boxes = 1000;
    for (const double part : {0.999, 0.9})
      EXPECT_NE(verify_text(with_number(safe, part * bound.attained->approx), effort).outcome,
                verifier::Outcome::kVerified);
  }
  EXPECT_GT(closed, 6);
}

}  // namespace
}  // namespace regulus::detail::test
