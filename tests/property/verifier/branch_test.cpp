// SPDX-License-Identifier: GPL-3.0-or-later
// Judges the verifier's test of a tube by systems whose roots are known, and compares it with the
// solver's.
#include "runtime/verifier/branch_test.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "runtime/proof/format.hpp"
#include "tests/support/planted_system.hpp"

namespace regulus::detail::test {
namespace {

verifier::Question question_about(const PlantedSystem& system) {
  const std::size_t n = system.unknowns(), m = system.variables();
  std::string text = "regulus-certificate 1\nverdict NO SINGULARITY\nclaim " +
                     format::describe_closure_claim({n, n}, false) +
                     "\nmodel m\nsha256 -\nmotion m\nalpha 0\n";
  const auto lines = [&](std::size_t count, const std::string& before, const std::string& after) {
    for (std::size_t k = 0; k < count; ++k) text += before + std::to_string(k) + after + '\n';
  };
  lines(m, "parameter x", " in -4 : 4");
  for (std::size_t k = 0; k < m; ++k)
    text += "pose x" + std::to_string(k) + " = x" + std::to_string(k) + '\n';
  lines(n, "unknown p", " = 0 +- 1");
  for (std::size_t k = 0; k < m; ++k) text += "start 0\n";
  for (const std::string& equation : system.equations()) text += "equation " + equation + '\n';
  std::istringstream stream(text + "proof\n");
  verifier::Lines read(stream);
  verifier::Question question;
  verifier::read_question(read, question);
  question.graph.end_of_file();
  return question;
}

verifier::TubeNumbers numbers_of(const BranchTube& tube) {
  verifier::TubeNumbers numbers = tube.at;
  for (const auto* part : {&tube.center, &tube.slopes, &tube.radius})
    numbers.insert(numbers.end(), part->begin(), part->end());
  return numbers;
}

TEST(TubesOfTheVerifier, HaveExactlyOnePlantedRootIfItSaysSo) {
  RandomSource random(11);
  std::size_t ones = 0, nones = 0, others = 0;
  for (int round = 0; round < 300; ++round) {
    const PlantedSystem system(random, 1 + random.below(3), random.below(4));
    verifier::Question question = question_about(system);
    verifier::BranchTest test(question);
    for (int attempt = 0; attempt < 10; ++attempt) {
      std::vector<Interval> box;
      const BranchTube tube = system.random_tube(random, box);
      const verifier::TubeNumbers numbers = numbers_of(tube);
      verifier::Box places;
      for (const Interval x : box) places.push_back({x.lo, x.hi});
      const bool is_one = test.has_one_solution(places, numbers);
      const bool is_none = test.has_no_solution(places, numbers);
      ++(is_one ? ones : is_none ? nones : others);
      ASSERT_TRUE(!is_one || system.is_regular());
      for (int sample = 0; sample < 4; ++sample) {
        std::vector<double> x;
        for (const Interval range : box) x.push_back(point_of(random, range));
        const auto count = system.count_roots(tube, x);
        if (!count) continue;
        ASSERT_TRUE(!is_one || *count == 1) << round << ": " << *count << " roots";
        ASSERT_TRUE(!is_none || *count == 0) << round << ": " << *count << " roots";
      }
    }
  }
  EXPECT_GT(ones, 300U);
  EXPECT_GT(nones, 100U);
  EXPECT_GT(others, 300U);
}

/// A small box of a solution has one root, which the tube holds as it says.
TEST(TubesOfTheVerifier, HoldTheRootsThatNewtonsMethodFinds) {
  RandomSource random(12);
  std::size_t inside = 0, outside = 0;
  for (int round = 0; round < 300; ++round) {
    const PlantedSystem system(random, 1 + random.below(3), random.below(4));
    verifier::Question question = question_about(system);
    verifier::BranchTest test(question);
    for (int attempt = 0; attempt < 5; ++attempt) {
      std::vector<Interval> box;
      const BranchTube tube = system.random_tube(random, box);
      std::vector<double> x;
      verifier::Box place;
      for (const Interval range : box) {
        x.push_back(point_of(random, range));
        place.push_back(verifier::point(x.back()));
      }
      const auto solution = test.solution_near(place, tube.center, tube.radius);
      if (!solution) continue;
      const BranchTube small{x, solution->middle,
                             std::vector<double>(system.unknowns() * system.variables()),
                             solution->radius};
      const auto one = system.count_roots(small, x), all = system.count_roots(tube, x);
      if (!one || !all) continue;
      ASSERT_EQ(*one, 1U) << round;
      const verifier::Place where = test.place_of(*solution, numbers_of(tube), place);
      ASSERT_TRUE(where != verifier::Place::kInside || *all >= 1) << round;
      inside += where == verifier::Place::kInside;
      outside += where == verifier::Place::kOutside;
      const bool is_one = test.has_one_solution(place, numbers_of(tube));
      ASSERT_TRUE(!is_one || *all == 1) << round;
    }
  }
  EXPECT_GT(inside, 100U);
  EXPECT_GT(outside, 10U);
}

}  // namespace
}  // namespace regulus::detail::test
