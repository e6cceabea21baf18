// SPDX-License-Identifier: GPL-3.0-or-later
// A search of a condition number whose boxes are decided by workers.
#include <atomic>
#include <memory>
#include <vector>

#include "runtime/search/thread_workers.hpp"
#include "tests/support/simulated_workers.hpp"
#include "tests/unit/bound/condition_matrix.hpp"

namespace regulus::detail::test {
namespace {

/// Long enough for rounds that workers share.
ConditionSettings long_settings() {
  ConditionSettings settings = settings_with_gap(0);
  settings.max_boxes = 12000;
  return settings;
}

ConditionSettings shared_by(cluster::Workers& workers) {
  ConditionSettings settings = long_settings();
  settings.workers = &workers;
  settings.boxes_before_workers = 0;
  return settings;
}

TEST(SharedConditionSearch, EndsLikeOneOfOneThread) {
  for (const auto& [method, entries] :
       {std::pair{Method::kReg, Entries::kDerivatives}, {Method::kAuto, Entries::kNatural}}) {
    const TestMatrix matrix(kTurned, method, entries);
    const Ended alone = matrix.run(long_settings());
    ASSERT_GE(alone.result.boxes, 12000U);
    for (const unsigned threads : {1U, 3U}) {
      ThreadWorkers workers(threads);
      expect_same(matrix.run(shared_by(workers)), alone);
    }
  }
}

TEST(SharedConditionSearch, EndsTheSameWhateverBecomesOfMessages) {
  const TestMatrix matrix(kTurned);
  const Ended alone = matrix.run(long_settings());
  KnownOutcomes known;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Troubles troubles;
    if (seed % 2 == 1) troubles = {0.02, 0.05, 0.01, 40};
    SimulatedWorkers workers(1 + seed % 7, troubles, seed, known);
    expect_same(matrix.run(shared_by(workers)), alone);
  }
  EXPECT_GT(known.size(), 400U) << "workers decided too few units";
}

TEST(SharedConditionSearch, IsContinuedByOthers) {
  const TestMatrix matrix(kTurned);
  const Ended alone = matrix.run(long_settings());
  ThreadWorkers workers(2);
  ConditionSettings until = shared_by(workers);
  until.max_boxes = 9000;
  const Ended stopped = matrix.run(until);
  expect_same(matrix.run(long_settings(), &stopped.saved), alone);
  until = long_settings();
  until.max_boxes = 5000;
  const Ended early = matrix.run(until);
  expect_same(matrix.run(shared_by(workers), &early.saved), alone);
}

/// The user interrupts while no worker answers.
class SilentWorkers final : public cluster::Workers {
 public:
  explicit SilentWorkers(std::atomic<bool>& interrupt) : interrupt_(interrupt) {}
  void begin(const Problem&, const Settings&, const cluster::Learned&,
             const cluster::MakeDecider& make) override {
    EXPECT_TRUE(make);
    ++begun;
  }
  void end() noexcept override { ++ended; }
  [[nodiscard]] std::size_t count() const override { return 2; }
  [[nodiscard]] double seconds_of_grant() const override { return 0.1; }
  void send(std::size_t, std::string) override {}
  [[nodiscard]] std::optional<cluster::Received> receive() override {
    if (++asked_ == 5) interrupt_ = true;
    return std::nullopt;
  }
  [[nodiscard]] double now() const override { return 0; }

  int begun = 0, ended = 0;

 private:
  std::atomic<bool>& interrupt_;
  int asked_ = 0;
};

TEST(SharedConditionSearch, EndsARoundAloneIfItIsInterrupted) {
  const TestMatrix matrix(kTurned);
  const Ended alone = matrix.run(long_settings());
  std::atomic<bool> interrupt = false;
  SilentWorkers workers(interrupt);
  ConditionSettings settings = shared_by(workers);
  settings.interrupt = &interrupt;
  const Ended stopped = matrix.run(settings);
  EXPECT_EQ(stopped.result.reason, Reason::kInterrupted);
  EXPECT_EQ(workers.begun, 1);
  EXPECT_EQ(workers.ended, 1);
  expect_same(matrix.run(long_settings(), &stopped.saved), alone);
}

class ConditionUnits : public testing::Test {
 protected:
  [[nodiscard]] std::string decided(double attained) {
    const std::vector<BoxJudge::Box> boxes = {problem_.outer, {{0, 0.5}, {0, 0.5}, {0, 1}}};
    return unit_judges<BoxJudge>(question_)()->decide(unit_of(boxes, attained)).value();
  }
  [[nodiscard]] std::vector<BoxFinding> read(const std::string& outcome) const {
    std::vector<BoxFinding> findings(2);
    read_findings<BoxJudge>(cluster::read_outcome(outcome).events, question_, findings);
    return findings;
  }
  /// Returns the outcome with other findings.
  [[nodiscard]] static std::string with(const std::string& outcome, const std::string& findings) {
    cluster::Outcome changed = cluster::read_outcome(outcome);
    changed.events = findings;
    return write_outcome(changed);
  }

  const TestMatrix matrix_{kTurned};
  const Problem problem_ = matrix_.problem();
  const ConditionQuestion question_{problem_, matrix_.scaling()};
};

TEST_F(ConditionUnits, BringTheFindingsOfAJudge) {
  for (const double attained : {0.0, 5.1, kInfinity}) {
    const std::vector<BoxFinding> brought = read(decided(attained));
    BoxJudge judge(question_);
    std::vector<BoxFinding> own(2);
    judge.judge(std::vector<BoxJudge::Box>{problem_.outer, {{0, 0.5}, {0, 0.5}, {0, 1}}}, own,
                attained);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(brought[i].bound.upper, own[i].bound.upper);
      EXPECT_EQ(brought[i].bound.impact, own[i].bound.impact);
      ASSERT_EQ(brought[i].attained.has_value(), own[i].attained.has_value());
      if (!own[i].attained) continue;
      EXPECT_EQ(brought[i].attained->variables, own[i].attained->variables);
      EXPECT_EQ(brought[i].attained->shown.condition, own[i].attained->shown.condition);
      EXPECT_EQ(brought[i].attained->shown.most, own[i].attained->shown.most);
      EXPECT_EQ(brought[i].attained->shown.least, own[i].attained->shown.least);
    }
  }
}

TEST_F(ConditionUnits, DamagedOnesAreRefused) {
  const std::string outcome = decided(0);
  const std::string findings = cluster::read_outcome(outcome).events;
  for (std::size_t size = 0; size < findings.size(); ++size)
    EXPECT_THROW(static_cast<void>(read(with(outcome, findings.substr(0, size)))),
                 cluster::MalformedMessage)
        << size;
  EXPECT_THROW(static_cast<void>(read(with(outcome, findings + '\0'))), cluster::MalformedMessage);
  EXPECT_THROW(static_cast<void>(read(with(outcome, '\2' + findings.substr(1)))),
               cluster::MalformedMessage);
  // A list of another length.
  std::string other = findings;
  other[2 + sizeof(double)] = 2;
  EXPECT_THROW(static_cast<void>(read(with(outcome, other))), cluster::MalformedMessage);
  const std::unique_ptr<cluster::UnitDecider> decider = unit_judges<BoxJudge>(question_)();
  for (const cluster::Unit& wrong :
       {cluster::Unit{{0}, {{0, 1}, {0, 1}}}, {std::vector<std::uint32_t>(9), {}}})
    EXPECT_THROW(static_cast<void>(decider->decide(wrong)), cluster::MalformedMessage);
}

}  // namespace
}  // namespace regulus::detail::test
