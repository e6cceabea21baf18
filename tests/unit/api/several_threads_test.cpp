// SPDX-License-Identifier: GPL-3.0-or-later
// Tests work of several threads at once, from the oracle to whole searches; `make tsan` runs it
// under ThreadSanitizer.
#include "codegen/question/engine/arb_oracle.hpp"

// The threads of a search use the oracle, so nothing in it may belong to CLN or GiNaC.
#if defined(_CL_OBJECT_H) || defined(_CL_NUMBER_H) || defined(_CL_RATIONAL_H) || \
    defined(GINAC_EX_H) || defined(GINAC_BASIC_H)
#error "codegen/question/engine/arb_oracle.hpp includes CLN or GiNaC"
#endif

#include <gtest/gtest.h>

#include <thread>
#include <type_traits>

#include "codegen/question/engine/choices.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/use/api/check.hpp"

namespace regulus::detail {
namespace {

static_assert(std::is_same_v<decltype(BallProgram::constants), std::vector<FlintRational>>);
static_assert(std::is_same_v<decltype(PreparedSearch::matrix), std::optional<BallProgram>>);

/// Doubles cannot find the sign of the determinant, which is 1 beside products of 10^76, so each
/// box needs the oracle. The constants are long, so that CLN would count references to them.
constexpr const char* kUndecided = R"(
regulus = 1
name = "undecided"
[pose]
x = "1"
y = "1"
[matrix]
rows = [["123456789012345678901234567890123456789", "123456789012345678901234567890123456789 - x", "0"],
        ["123456789012345678901234567890123456789 + x", "123456789012345678901234567890123456789", "y"],
        ["0", "0", "1"]]
[motion.thin]
x = 1
y = ["1", "1 + 2^-44"]
)";

PreparedSearch prepared(const SearchOptions& search) {
  ModelOptions model;
  model.path = "undecided.toml";
  model.text = kUndecided;
  return prepare(model, search);
}

SearchOptions interpreted(unsigned threads) {
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  search.threads = threads;
  return search;
}

TEST(SeveralThreads, MayAskTheOracleAtOnce) {
  PreparedSearch preparation = prepared(interpreted(1));
  ASSERT_TRUE(preparation.matrix);
  ArbOracle oracle(*preparation.matrix, 3, 1024);
  const std::vector<Interval> at(preparation.matrix->inputs, Interval(1.0));
  const std::optional<Interval> expected = oracle.enclose(at);
  ASSERT_TRUE(expected && expected->lo > 0);
  std::vector<int> differences(8, 0);
  std::vector<std::thread> threads;
  for (int& difference : differences)
    threads.emplace_back([&] {
      for (int i = 0; i < 500; ++i)
        if (oracle.enclose(at) != expected) ++difference;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(differences, std::vector<int>(8, 0));
  EXPECT_GE(oracle.bits(), 106);
}

/// The oracle's program exists before the search: no thread makes one from GiNaC's objects.
TEST(SeveralThreads, SearchWhereOnlyTheOracleDecides) {
  for (const unsigned threads : {1U, 4U}) {
    const SearchOptions search = interpreted(threads);
    PreparedSearch preparation = prepared(search);
    const double before = preparation.stages->seconds();
    const Result result = run_search(preparation, search, settings_from(search));
    EXPECT_EQ(result.verdict, Verdict::kNoSingularity) << describe(result.reason);
    EXPECT_EQ(preparation.stages->seconds(), before);
    EXPECT_GT(preparation.bits, 53);
  }
}

Robot circle(const std::string& name) {
  Robot robot(name);
  const Formula x = robot.pose("x", "cm"), y = robot.pose("y", "cm");
  robot.matrix({{x, y}, {-y, x}});
  robot.motion("outside").range(x, 1, 2).range(y, -1, 1);
  return robot;
}

/// One thread makes the robots, others check them: the calls wait for each other.
TEST(SeveralThreads, MayCallCheckForRobotsThatAreMade) {
  std::vector<Robot> robots;
  for (int i = 0; i < 4; ++i) robots.push_back(circle("circle " + std::to_string(i)));
  std::vector<Verdict> verdicts(robots.size(), Verdict::kPossibleProblem);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < robots.size(); ++i)
    threads.emplace_back([&, i] {
      SearchOptions options;
      options.engine = Engine::kInterpreted;
      verdicts[i] = check(Question(robots[i], "outside"), options).verdict;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(verdicts, std::vector<Verdict>(robots.size(), Verdict::kNoSingularity));
}

TEST(SearchOptions, RefuseWhatIsNone) {
  const Robot robot = circle("circle");
  const auto refusal = [&robot](auto change) -> std::string {
    SearchOptions options;
    options.engine = Engine::kInterpreted;
    change(options);
    try {
      static_cast<void>(check(Question(robot, "outside"), options));
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal([](auto&) {}), "");
  EXPECT_NE(refusal([](auto& o) { o.without = {"movin"}; }).find("did you mean 'moving'?"),
            std::string::npos);
  EXPECT_NE(refusal([](auto& o) { o.method = Method(99); }), "");
  EXPECT_NE(refusal([](auto& o) { o.bisection = Bisection(99); }), "");
}

template <class Value>
class ChoicesOf : public testing::Test {};
using AllChoices = testing::Types<Method, Determinant, std::optional<Entries>, Bisection,
                                  Uncertainty, Engine, std::optional<Isa>>;
TYPED_TEST_SUITE(ChoicesOf, AllChoices);

TYPED_TEST(ChoicesOf, AreReadAsTheyAreWritten) {
  ASSERT_GE(choices<TypeParam>().size(), 2U);
  for (const Choice<TypeParam>& choice : choices<TypeParam>()) {
    EXPECT_EQ(choice_of<TypeParam>("--option", choice.word), choice.value);
    EXPECT_EQ(word_of(choice.value), choice.word);
  }
  EXPECT_THROW(static_cast<void>(choice_of<TypeParam>("--option", "nonsense")), UsageError);
  EXPECT_THROW(static_cast<void>(choice_of<TypeParam>("--option", "")), UsageError);
}

TEST(Choices, AreRefusedWithTheOneThatWasMeant) {
  try {
    static_cast<void>(choice_of<Method>("--method", "kj-numerc"));
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'kj-numeric'?"), std::string::npos);
  }
}

}  // namespace
}  // namespace regulus::detail
