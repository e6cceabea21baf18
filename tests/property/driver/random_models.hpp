// SPDX-License-Identifier: GPL-3.0-or-later
// Model files that nobody has looked at, through every stage, against Arb.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <string>

#include "regulus/codegen/driver/arb_oracle.hpp"
#include "regulus/codegen/driver/ingredients.hpp"
#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/codegen/driver/settings.hpp"
#include "regulus/codegen/model/errors.hpp"
#include "regulus/codegen/symbolic/determinant.hpp"
#include "regulus/search/solver.hpp"
#include "support/models/adversarial_model.hpp"
#include "support/models/random_model.hpp"
#include "support/models/refutation.hpp"
#include "support/temporary_directory.hpp"

namespace regulus::codegen::test {

using regulus::test::AdversarialModel;
using regulus::test::ModelOracle;
using regulus::test::ModelText;
using regulus::test::RandomModel;
using regulus::test::RandomSource;
using regulus::test::Refutation;

inline constexpr const char* kMethods[] = {"auto",       "reg",        "reg+rohn", "kj",
                                           "kj+rohn",    "jk",         "jk+rohn",  "kj-numeric",
                                           "jk-numeric", "closed-form"};

/// How often each outcome occurred, by method and by rule.
struct Tally {
  std::map<std::string, std::array<int, 3>> verdicts;  ///< in the order of Verdict
  std::array<std::uint64_t, kRules> leaves{};
  std::uint64_t leaves_by_rows = 0;  ///< kSecondOrder where some quantity touches one row only
  int refused = 0;                   ///< models that InputError or ClosedFormError refuses
  int refutable = 0, shown = 0;      ///< Arb refutes NO SINGULARITY; the search says SINGULARITY
  int segments = 0, certain_segments = 0;  ///< of witnesses; those that Arb certifies
  int known_unsafe = 0, known_unsafe_refuted = 0;

  [[nodiscard]] std::string describe() const {
    std::string text;
    for (const auto& [method, count] : verdicts)
      text += fmt::format("{:12} {} free, {} singular, {} open\n", method, count[0], count[1],
                          count[2]);
    for (std::size_t rule = 0; rule < kRules; ++rule)
      text += fmt::format("{}: {}\n", name(static_cast<Rule>(rule)), leaves[rule]);
    return text + fmt::format(
                      "{} by rows; {} refused; {} refutable, {} shown; {} segments, {} "
                      "certain; {} known unsafe, {} refuted\n",
                      leaves_by_rows, refused, refutable, shown, segments, certain_segments,
                      known_unsafe, known_unsafe_refuted);
  }

  void expect_each_verdict(int least) const {
    for (const auto& [method, count] : verdicts)
      for (const int verdict : count) EXPECT_GE(verdict, least) << method << '\n' << describe();
  }

  void expect_leaves(std::initializer_list<Rule> rules, std::uint64_t least) const {
    for (const Rule rule : rules)
      EXPECT_GE(leaves[static_cast<std::size_t>(rule)], least) << name(rule) << '\n' << describe();
  }

  /// Sampling has teeth, and the search finds most of what it finds.
  void expect_teeth(int least_refutable) const {
    EXPECT_GE(refutable, least_refutable) << describe();
    EXPECT_GE(3 * shown, 2 * refutable) << describe();
    EXPECT_GE(10 * certain_segments, 9 * segments) << describe();
  }
};

/// Settings that the command line offers, and what only the API does.
struct Road {
  SearchOptions search;
  unsigned batch = 8;
  std::uint64_t boxes_after_problem = 40;
  std::vector<std::string> without = {};  ///< of the search, beyond search.without

  [[nodiscard]] Settings settings() const {
    Settings settings = settings_from(search);
    settings.batch = batch;
    settings.boxes_after_problem = boxes_after_problem;
    leave_out(without, settings);
    return settings;
  }

  [[nodiscard]] std::string describe() const {
    return search.method + ' ' + search.determinant + ' ' + search.entries + ' ' + search.bisect +
           ' ' + search.uncertainty + " batch " + std::to_string(batch) + " boxes " +
           std::to_string(search.max_boxes) +
           fmt::format(" without {}; and {}", fmt::join(search.without, ", "),
                       fmt::join(without, ", "));
  }
};

inline Road random_road(RandomSource& random, const std::string& method) {
  const auto pick = [&random](std::initializer_list<const char*> from) {
    return std::string(from.begin()[random.below(from.size())]);
  };
  Road road;
  road.search.method = method;
  road.search.determinant = pick({"both", "expansion", "gauss"});
  road.search.entries = pick({"auto", "natural", "derivatives"});
  road.search.bisect = pick({"impact", "widest", "weighted"});
  road.search.uncertainty = pick({"elements", "variables"});
  road.search.engine = Engine::kInterpreted;
  road.search.max_boxes = random.one_in(4) ? 30 : 300;
  road.search.symbolic_budget = 20000;
  road.batch = 1 + static_cast<unsigned>(random.below(8));
  return road;
}

/// A third of the ingredients left out; every other time the symbolic stage is not told.
inline Road random_road_without(RandomSource& random, const std::string& method) {
  Road road = random_road(random, method);
  std::vector<std::string>& without = random.one_in(2) ? road.search.without : road.without;
  for (const std::string& name : ingredient_names())
    if (random.one_in(3)) without.push_back(name);
  return road;
}

class Judge {
 public:
  explicit Judge(RandomSource& random) : random_(random) {}

  /// Runs the search; any claim that Arb or the model's own truth contradicts is a failure.
  void run(const ModelText& text, const Road& road) {
    SCOPED_TRACE(road.describe() + '\n' + text.file());
    const std::filesystem::path path = directory_.path() / "model.toml";
    std::ofstream(path) << text.file();
    ModelOptions options;
    options.path = path.string();
    try {
      judge(text, road, prepare(options, road.search));
    } catch (const InputError& error) {
      ++tally.refused;
      EXPECT_TRUE(text.kind == "pole" || text.kind == "root") << error.what();
    } catch (const ClosedFormError&) {
      ++tally.refused;
      EXPECT_EQ(road.search.method, "closed-form");
    }
  }

  Tally tally;

 private:
  void judge(const ModelText& text, const Road& road, const Preparation& preparation) {
    ArbOracle digits(preparation.stages->matrix(), preparation.stages->module().rows, 424);
    Settings settings = road.settings();
    if (preparation.subject.rows == preparation.subject.columns) settings.oracle = &digits;
    const Problem problem = preparation.problem();
    const Result result = solve(problem, settings);
    if (result.reason == Reason::kBadProblem) return expect_reason_to_refuse(problem, settings);
    ++tally.verdicts[road.search.method][static_cast<std::size_t>(result.verdict)];
    for (std::size_t rule = 0; rule < kRules; ++rule)
      tally.leaves[rule] += result.statistics.leaves[rule];
    if (has_row_quantity(preparation.stages->module()))
      tally.leaves_by_rows +=
          result.statistics.leaves[static_cast<std::size_t>(Rule::kSecondOrder)];
    expect_truth(text, preparation, result);
  }

  static bool has_row_quantity(const Module& module) {
    if (!module.expansion) return false;
    const std::vector<int>& rows = module.expansion->row_of_variable;
    return std::any_of(rows.begin(), rows.end(), [](int row) { return row != Expansion::kNoRow; });
  }

  void expect_reason_to_refuse(const Problem& problem, const Settings& settings) {
    ++tally.refused;
    EXPECT_TRUE(find_fault(problem, settings));
    EXPECT_NE(problem.kernel->rows, problem.kernel->columns)
        << find_fault(problem, settings).value_or("");
  }

  void expect_truth(const ModelText& text, const Preparation& preparation, const Result& result) {
    const Verdict verdict = result.verdict;
    EXPECT_FALSE(text.never_safe && verdict == Verdict::kNoSingularity) << "a wrong proof";
    EXPECT_FALSE(text.never_singular && verdict == Verdict::kSingularity) << "a wrong witness";
    const ModelOracle oracle(preparation.stages->request().model,
                             preparation.stages->request().motion,
                             preparation.stages->formulation().variables);
    const Refutation refutation(oracle, random_, 40);
    if (refutation.found()) {
      EXPECT_NE(verdict, Verdict::kNoSingularity) << *refutation.found();
      ++tally.refutable;
      tally.shown += verdict == Verdict::kSingularity ? 1 : 0;
    }
    if (text.never_safe) {
      ++tally.known_unsafe;
      tally.known_unsafe_refuted += refutation.found() ? 1 : 0;
    }
    if (verdict == Verdict::kSingularity) {
      EXPECT_EQ(fault_of_witness(oracle, result).value_or("none"), "none");
      if (result.reason == Reason::kOppositeSigns && result.witness) {
        ++tally.segments;
        tally.certain_segments += certain_segment(oracle, *result.witness) ? 1 : 0;
      }
    }
  }

  RandomSource& random_;
  regulus::test::TemporaryDirectory directory_;
};

}  // namespace regulus::codegen::test
