// SPDX-License-Identifier: GPL-3.0-or-later
// The searches of a bracket, made by other workers or by an earlier run.
#include <gtest/gtest.h>

#include <atomic>

#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/engine/search_topic.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/question/margin/variety_attempts.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/simulated_workers.hpp"

namespace regulus::detail::test {
namespace {

/// Three rows for two freedoms: no determinant, so no witness is looked for.
constexpr const char* kTall = R"toml(regulus = 1
name = "tall"
[pose]
x = "m"
[geometry]
g = { value = 1, tolerance = 0.01, group = "g" }
[matrix]
rows = [["x - g", 0], [0, 1], [0, 1]]
[motion.m]
x = [2, 3]
)toml";

class Told final : public EarlierSearches {
 public:
  explicit Told(double safe_below) : safe_below_(safe_below) {}
  [[nodiscard]] std::optional<Result> find(const MarginValue& value, std::uint64_t) const override {
    if (value.approx >= safe_below_) return std::nullopt;
    Result result;
    result.verdict = Verdict::kNoSingularity;
    result.reason = Reason::kAllBoxesCertified;
    result.statistics.boxes = 1;
    return result;
  }
  void keep(const MarginValue&, std::uint64_t, const Result&) override {}
  [[noreturn]] void refuse(const MarginValue& value) const override {
    throw InputError::statement("saved", 0, value.text, "");
  }

 private:
  double safe_below_;
};

Margin margin_with(EarlierSearches* earlier) {
  ModelOptions options;
  options.path = "tall.toml";
  options.text = kTall;
  options.tolerances = {"g=0.1:2"};
  const MarginQuestion question = take_question(options, {});
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  PreparedMargin margin(question, read_request(options), 0, search, {});
  const OutputOptions output{.json = false, .quiet = true};
  VarietyAttempts attempts(margin, question, output);
  return close_bracket(attempts, question,
                       {.limits = limits_of(margin.settings, 0.01), .earlier = earlier});
}

/// Searches of a robot that is singular from `critical` on. Those nearer to it than `unsure` fail.
class KnownRobot final : public Attempts {
 public:
  explicit KnownRobot(double critical, double unsure = 0) : critical_(critical), unsure_(unsure) {}

  MarginStep at(const MarginValue& value, const PlannedAttempt& planned) override {
    tried.push_back(value.approx);
    MarginStep step{value, {}, "a claim"};
    Result& result = step.result;
    result.statistics.boxes = planned.boxes == kAnyBoxes ? 1 : 2;
    if (value.approx < critical_ - unsure_) {
      result.verdict = Verdict::kNoSingularity;
      result.reason = Reason::kAllBoxesCertified;
    } else if (value.approx >= critical_ + unsure_) {
      result.verdict = Verdict::kSingularity;
    } else {
      result.reason = Reason::kWidth;
    }
    return step;
  }
  [[nodiscard]] bool can_look() const noexcept override { return looks; }
  std::vector<MarginStep> near(const Result&, Refuted refuted) override {
    if (refuted && *refuted <= critical_) return {};
    MarginStep step{decimal_value(critical_), {}, "a witness"};
    step.result.verdict = Verdict::kSingularity;
    return {step};
  }

  std::vector<double> tried;
  bool looks = false;

 private:
  double critical_, unsure_;
};

MarginQuestion up_to(double high) {
  MarginQuestion question;
  question.low = decimal_value(0);
  question.high = decimal_value(high);
  return question;
}

TEST(ABracketOfAttempts, ClosesAroundTheCriticalValue) {
  KnownRobot robot(0.7);
  const Margin found = close_bracket(robot, up_to(2), {.limits = {.gap = 0.01}});
  ASSERT_TRUE(found.certified && found.refuted);
  EXPECT_LT(found.certified->value.approx, 0.7);
  EXPECT_GE(found.refuted->value.approx, 0.7);
  EXPECT_TRUE(found.closed);
  EXPECT_LE(*found.gap, 0.01);
  EXPECT_EQ(found.steps.size(), robot.tried.size());
}

TEST(ABracketOfAttempts, LooksNearASearchThatFails) {
  KnownRobot robot(0.7, 0.1);
  const Margin blind = close_bracket(robot, up_to(2), {.limits = {.gap = 0.01}});
  EXPECT_FALSE(blind.closed);
  KnownRobot seeing(0.7, 0.1);
  seeing.looks = true;
  const Margin found = close_bracket(seeing, up_to(2), {.limits = {.gap = 0.2}});
  EXPECT_TRUE(found.closed);
  EXPECT_EQ(found.refuted->value.approx, 0.7);
  EXPECT_EQ(found.refuted->claim, "a witness");
  // What was found without a search is a step, but no search.
  EXPECT_GT(found.steps.size(), seeing.tried.size());
}

TEST(ABracketOfAttempts, StopsWhenItIsInterrupted) {
  KnownRobot robot(0.7);
  std::atomic<bool> interrupt = false;
  const auto stop = [&](const MarginStep&) { interrupt = true; };
  const Margin found =
      close_bracket(robot, up_to(2), {.limits = {}, .interrupt = &interrupt, .listener = stop});
  EXPECT_EQ(robot.tried.size(), 1U);
  EXPECT_TRUE(found.interrupted);
  EXPECT_FALSE(found.closed);
}

TEST(ABracketOfAttempts, ClaimsNoEndThatThisRunHasNotSearched) {
  KnownRobot robot(0.7);
  Told told(0.6);
  std::atomic<bool> interrupt = false;
  const auto stop = [&](const MarginStep&) { interrupt = true; };
  const Margin found = close_bracket(
      robot, up_to(2), {.limits = {}, .interrupt = &interrupt, .listener = stop, .earlier = &told});
  ASSERT_EQ(robot.tried.size(), 1U);
  ASSERT_TRUE(found.certified);
  EXPECT_EQ(found.certified->value.approx, robot.tried[0]);
  EXPECT_EQ(found.certified->claim, "a claim");
}

TEST(EarlierSearches, LeadToTheSameEndWhichIsProvedAgain) {
  const Margin alone = margin_with(nullptr);
  ASSERT_TRUE(alone.certified);
  EXPECT_LT(alone.certified->value.approx, 1);
  Told honest(alone.certified->value.approx * (1 + 1e-9));
  const Margin continued = margin_with(&honest);
  ASSERT_TRUE(continued.certified);
  EXPECT_EQ(continued.certified->value.text, alone.certified->value.text);
  EXPECT_EQ(continued.steps.size(), alone.steps.size());
  // The boxes are those of a search, not the one box that the file claims.
  EXPECT_EQ(continued.certified->result.statistics.boxes, alone.certified->result.statistics.boxes);
  EXPECT_EQ(continued.certified->claim, alone.certified->claim);
}

TEST(EarlierSearches, ThatClaimASingularRobotSafeAreRefused) {
  Told lying(5);
  EXPECT_THROW(margin_with(&lying), InputError);
}

TEST(ATopic, ReadsAsItWasWritten) {
  for (const std::optional<double> number : {std::optional(0.25), std::optional<double>()}) {
    SearchTopic of{"error ", "leg 3", -2.5, 0.125, number};
    of.value = number;
    of.waypoints = "digest";
    if (number) of.piece = 7;
    const SearchTopic topic = read_topic(write_topic(of));
    EXPECT_EQ(topic.part, "error ");
    EXPECT_EQ(topic.component, "leg 3");
    EXPECT_EQ(topic.reference, -2.5);
    EXPECT_EQ(topic.low, 0.125);
    EXPECT_EQ(topic.high, number);
    EXPECT_EQ(topic.waypoints, "digest");
    EXPECT_EQ(topic.value, number);
    EXPECT_EQ(topic.piece, of.piece);
  }
}

TEST(ATopic, NamesItsKind) {
  for (const TopicKind kind :
       {TopicKind::kQuestion, TopicKind::kExpandedMatrix, TopicKind::kMatrixWithSlopes,
        TopicKind::kBranch, TopicKind::kBranchWithNominal}) {
    SearchTopic topic;
    topic.kind = kind;
    EXPECT_EQ(read_topic(write_topic(topic)).kind, kind);
  }
  SearchTopic unknown;
  unknown.kind = TopicKind(5);
  EXPECT_THROW(static_cast<void>(read_topic(write_topic(unknown))), cluster::MalformedMessage);
}

TEST(ATopic, ThatIsDamagedIsRefused) {
  const std::string bytes = write_topic({"", "leg 7"});
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(static_cast<void>(read_topic(bytes.substr(0, size))), cluster::MalformedMessage);
  EXPECT_THROW(static_cast<void>(read_topic(bytes + "x")), cluster::MalformedMessage);
}

TEST(ABracket, IsTheSameByAnyWorkers) {
  ModelOptions options;
  options.path = REGULUS_SOURCE_DIR "/models/robot_1.toml";
  options.motion = "table4_5";
  const Request request = read_request(options);
  const QuantityOptions error{.quantity = "error", .freedom = "w_x"};
  const auto bound_by = [&](cluster::Workers* workers) {
    BoundSettings settings;
    settings.gap = 0.03;
    settings.output.quiet = true;
    settings.search.threads = 1;
    settings.search.workers = workers;
    settings.search.time_limit = 1e6;
    return bound_quantity(request, quantity_of(request.model, error), settings,
                          [](const ComponentBound&) {});
  };
  const Bound one = bound_by(nullptr);
  ASSERT_TRUE(one.is_closed());
  ASSERT_GT(one.components[0].boxes, 20'000U) << "too few for the workers";
  KnownOutcomes known;
  std::size_t deaths = 0, losses = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    SimulatedWorkers workers(1 + 5 * seed, {0.2, 0.2, 0.05, 5}, seed, known);
    const Bound many = bound_by(&workers);
    const ComponentBound &a = one.components[0], &b = many.components[0];
    EXPECT_TRUE(b.attained->exact.is_equal(a.attained->exact)) << seed;
    EXPECT_TRUE(b.proved->exact.is_equal(a.proved->exact)) << seed;
    EXPECT_EQ(b.place->pose, a.place->pose) << seed;
    EXPECT_EQ(b.boxes, a.boxes) << seed;
    deaths += workers.deaths, losses += workers.losses;
  }
  EXPECT_GT(deaths + losses, 3U);
}

}  // namespace
}  // namespace regulus::detail::test
