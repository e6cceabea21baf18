// SPDX-License-Identifier: GPL-3.0-or-later
// The searches of a bracket, made by other workers or by an earlier run.
#include <gtest/gtest.h>

#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/bound/bracket_topic.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/simulated_workers.hpp"

namespace regulus::test {
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
  MarginCertificates certificates("", margin.request, margin.prepared.labels);
  OutputOptions output;
  output.quiet = true;
  MarginRun run(
      margin.prepared, question, margin.request, margin.search, output, margin.settings, 0.01,
      certificates, [](const MarginStep&) {}, earlier);
  return run.run();
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
  for (const std::optional<double> high : {std::optional(0.25), std::optional<double>()}) {
    const BracketTopic topic = read_topic(write_topic({3, -2.5, 0.125, high}));
    EXPECT_EQ(topic.component, 3U);
    EXPECT_EQ(topic.reference, -2.5);
    EXPECT_EQ(topic.low, 0.125);
    EXPECT_EQ(topic.high, high);
  }
}

TEST(ATopic, NamesItsKind) {
  for (const TopicKind kind :
       {TopicKind::kBracket, TopicKind::kExpandedMatrix, TopicKind::kMatrixWithSlopes}) {
    BracketTopic topic;
    topic.kind = kind;
    EXPECT_EQ(read_topic(write_topic(topic)).kind, kind);
  }
  BracketTopic unknown;
  unknown.kind = TopicKind(3);
  EXPECT_THROW(static_cast<void>(read_topic(write_topic(unknown))), cluster::MalformedMessage);
}

TEST(ATopic, ThatIsDamagedOrOfAnotherQuantityIsRefused) {
  const std::string bytes = write_topic({7, 0, 0, {}});
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(static_cast<void>(read_topic(bytes.substr(0, size))), cluster::MalformedMessage);
  EXPECT_THROW(static_cast<void>(read_topic(bytes + "x")), cluster::MalformedMessage);
  ModelOptions options;
  options.path = REGULUS_SOURCE_DIR "/models/robot_1.toml";
  options.motion = "table4_5";
  const Request request = read_request(options);
  const Quantity forces = quantity_of(request.model, {.quantity = "force"});
  EXPECT_THROW(static_cast<void>(prepare_topic(read_topic(bytes), request, forces, {}, {})),
               cluster::MalformedMessage);
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
}  // namespace regulus::test
