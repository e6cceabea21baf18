// SPDX-License-Identifier: GPL-3.0-or-later
// Judges of boxes in threads and as workers.
#include "runtime/search/box_judges.hpp"

#include <gtest/gtest.h>

#include "runtime/search/thread_workers.hpp"

namespace regulus::detail::test {
namespace {

struct MiddleQuestion {
  const Problem& problem;
  double forbidden = -1;  ///< memory runs out where the middle is that
};

/// Says where the middle of the first range is, beyond the horizon.
class Middle {
 public:
  using Question = MiddleQuestion;
  using Finding = double;

  explicit Middle(const MiddleQuestion& question) : question_(question) {}
  void judge(std::span<const std::vector<Interval>> boxes, std::span<double> findings,
             double horizon) {
    EXPECT_LE(boxes.size(), kLanes);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      findings[i] = mid(boxes[i][0]) - horizon;
      if (mid(boxes[i][0]) == question_.forbidden) throw std::bad_alloc();
    }
  }
  static void put(cluster::ByteWriter& to, const double& finding) { to.put(finding); }
  static double take(cluster::ByteReader& from, const MiddleQuestion&) {
    return from.take<double>();
  }

 private:
  const MiddleQuestion question_;
};

class BoxJudgesTest : public testing::Test {
 protected:
  BoxJudgesTest() {
    problem_.outer = {{0, 1000}};
    for (int i = 0; i < 517; ++i) boxes_.push_back({{double(i), double(i + 1)}});
  }

  /// Returns the findings; nullopt if memory ran out.
  [[nodiscard]] std::optional<std::vector<double>> judged(unsigned threads,
                                                          cluster::Workers* workers,
                                                          double forbidden = -1) const {
    BoxSharing sharing;
    sharing.workers = workers;
    sharing.boxes_before = 0;
    BoxJudges<Middle> judges({problem_, forbidden}, threads, boxes_.size(), sharing);
    std::vector<double> findings(boxes_.size());
    if (!judges.judge(boxes_, findings, 0.25)) return std::nullopt;
    return findings;
  }

  Problem problem_;
  std::vector<std::vector<Interval>> boxes_;
};

TEST_F(BoxJudgesTest, SayTheSameInThreadsAndAsWorkers) {
  std::vector<double> expected;
  for (int i = 0; i < 517; ++i) expected.push_back(i + 0.25);
  for (const unsigned threads : {1U, 2U, 200U}) {
    ThreadWorkers workers(threads % 7);
    EXPECT_EQ(judged(threads, nullptr), expected);
    EXPECT_EQ(judged(1, &workers), expected);
  }
}

TEST_F(BoxJudgesTest, TellThatMemoryRanOut) {
  ThreadWorkers workers(2);
  EXPECT_EQ(judged(2, nullptr, 300.5), std::nullopt);
  EXPECT_EQ(judged(1, &workers, 300.5), std::nullopt);
}

TEST_F(BoxJudgesTest, RefuseUnitsOfOtherProblems) {
  const auto judge = unit_judges<Middle>({problem_})();
  const cluster::Unit two{{0, 0}, {{0, 1}, {1, 2}}, 0.5};
  std::vector<double> findings(2);
  const std::string outcome = judge->decide(two).value();
  read_findings<Middle>(cluster::read_outcome(outcome).events, {problem_}, findings);
  EXPECT_EQ(findings, (std::vector<double>{0, 1}));
  const cluster::Unit wide{{0}, {{0, 1}, {0, 1}}},
      many{std::vector<std::uint32_t>(9), std::vector<Interval>(9)};
  for (const cluster::Unit& wrong : {wide, many})
    EXPECT_THROW(static_cast<void>(judge->decide(wrong)), cluster::MalformedMessage);
  EXPECT_THROW(read_findings<Middle>("1234", {problem_}, findings), cluster::MalformedMessage);
}

TEST(Unit, KeepsItsHorizonInAMessage) {
  for (const double horizon : {0.0, 5.5, std::numeric_limits<double>::infinity()}) {
    const cluster::Unit unit{{3, 4}, {{0, 1}, {1, 2}}, horizon};
    cluster::ByteWriter bytes;
    put(bytes, unit);
    cluster::ByteReader reader(bytes.bytes());
    EXPECT_EQ(take_unit(reader), unit);
    EXPECT_TRUE(reader.at_end());
  }
}

}  // namespace
}  // namespace regulus::detail::test
