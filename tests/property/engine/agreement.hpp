// SPDX-License-Identifier: GPL-3.0-or-later
// Compares all methods, with uncertain quantities kept whole and split, on the same problem.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "codegen/question/engine/choices.hpp"
#include "tests/property/engine/random_models.hpp"

namespace regulus::detail::test {

/// A motion of a shipped model; if `model` is empty, a random model from that seed.
struct AgreementCase {
  const char* model;
  const char* motion;
  const char* tolerance = "";
  std::uint64_t seed = 0;
  std::optional<Verdict> expected = {};
};

inline std::ostream& operator<<(std::ostream& out, const AgreementCase& of) {
  return out << of.model << ' ' << of.motion << ' ' << of.tolerance;
}

struct Effort {
  std::uint64_t max_boxes;
  double time_limit;  ///< seconds, for one search; 0: no limit
  std::uint64_t closed_form_terms;
};

class Agreement {
 public:
  explicit Agreement(const AgreementCase& problem) : problem_(problem) {
    if (*problem.model != 0) {
      options_.path = std::string(REGULUS_SOURCE_DIR "/models/") + problem.model + ".toml";
      options_.motion = problem.motion;
      if (*problem.tolerance != 0) options_.tolerances = {problem.tolerance};
      return;
    }
    RandomSource random(problem.seed);
    text_ = RandomModel(random).text().file();
    options_.path = (directory_.path() / "model.toml").string();
    std::ofstream(options_.path) << text_;
  }

  /// Ensures   no two verdicts contradict each other or the known facts about the problem.
  void expect_of_all(const Effort& effort) {
    for (const char* method : kMethods)
      for (const char* uncertainty : {"elements", "variables"}) {
        const std::optional<Verdict> verdict = verdict_of(method, uncertainty, effort);
        if (!verdict || *verdict == Verdict::kPossibleProblem) continue;
        ++decided;
        if (!first_) first_ = verdict, first_by_ = method;
        EXPECT_EQ(*verdict, *first_) << method << ' ' << uncertainty << " against " << first_by_
                                     << " on " << options_.path << ' ' << options_.motion << '\n'
                                     << text_;
        EXPECT_EQ(*verdict, problem_.expected.value_or(*verdict)) << method << ' ' << uncertainty;
      }
    EXPECT_TRUE(decided == 0 || empty == 0) << "a verdict about no pose\n" << text_;
  }

  int decided = 0;
  int empty = 0;  ///< searches that found no pose in the variety

 private:
  std::optional<Verdict> verdict_of(const char* method, const char* uncertainty,
                                    const Effort& effort) {
    SearchVariant variant;
    variant.search.method = choice_of<Method>("--method", method);
    variant.search.uncertainty = choice_of<Uncertainty>("--uncertainty", uncertainty);
    variant.search.engine = Engine::kInterpreted;
    variant.search.max_boxes = effort.max_boxes;
    variant.search.time_limit = effort.time_limit;
    variant.search.symbolic_budget = effort.closed_form_terms;
    try {
      const PreparedSearch preparation = prepare(options_, variant.search);
      const Problem problem = preparation.problem();
      const Result result = solve(problem, variant.settings());
      if (result.reason == Reason::kBadProblem) return std::nullopt;
      if (result.reason == Reason::kEmptyVariety) ++empty;
      return result.verdict;
    } catch (const ClosedFormError&) {
      return std::nullopt;
    }
  }

  const AgreementCase& problem_;
  test::TemporaryDirectory directory_;
  ModelOptions options_;
  std::string text_;
  std::optional<Verdict> first_;
  std::string first_by_;
};

}  // namespace regulus::detail::test
