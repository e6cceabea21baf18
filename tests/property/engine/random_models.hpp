// SPDX-License-Identifier: GPL-3.0-or-later
// Runs random model files through every stage and compares the results with Arb.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <string>

#include "codegen/kernel/symbolic/determinant.hpp"
#include "codegen/question/engine/arb_oracle.hpp"
#include "codegen/question/engine/choices.hpp"
#include "codegen/question/engine/ingredients.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/search/solver.hpp"
#include "tests/support/models/adversarial_model.hpp"
#include "tests/support/models/random_model.hpp"
#include "tests/support/models/refutation.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {

using test::AdversarialModel;
using test::ModelOracle;
using test::ModelText;
using test::RandomModel;
using test::RandomSource;
using test::Refutation;

inline constexpr const char* kMethods[] = {"auto",       "reg",        "reg+rohn", "kj",
                                           "kj+rohn",    "jk",         "jk+rohn",  "kj-numeric",
                                           "jk-numeric", "closed-form"};

/// Counts each outcome by method and by rule.
struct Tally {
  std::map<std::string, std::array<int, 3>> verdicts;  ///< in the order of Verdict
  std::array<std::uint64_t, kRules> leaves{};
  std::uint64_t leaves_by_rows = 0;  ///< kSecondOrder, where some quantity touches one row only
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

  /// Expects that sampling refutes enough models, and that the search finds most of these.
  void expect_teeth(int least_refutable) const {
    EXPECT_GE(refutable, least_refutable) << describe();
    EXPECT_GE(3 * shown, 2 * refutable) << describe();
    EXPECT_GE(10 * certain_segments, 9 * segments) << describe();
  }
};

/// Settings that the command line offers, and those that only the API offers.
struct SearchVariant {
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
    return word_of(search.method) + ' ' + word_of(search.determinant) + ' ' +
           word_of(search.entries) + ' ' + word_of(search.bisection) + ' ' +
           word_of(search.uncertainty) + " batch " + std::to_string(batch) + " boxes " +
           std::to_string(search.max_boxes) +
           fmt::format(" without {}; and {}", fmt::join(search.without, ", "),
                       fmt::join(without, ", "));
  }
};

inline SearchVariant random_variant(RandomSource& random, const std::string& method) {
  const auto pick = [&random](std::initializer_list<const char*> from) {
    return std::string(from.begin()[random.below(from.size())]);
  };
  SearchVariant variant;
  variant.search.method = choice_of<Method>("--method", method);
  variant.search.determinant =
      choice_of<Determinant>("--determinant", pick({"both", "expansion", "gauss"}));
  variant.search.entries =
      choice_of<std::optional<Entries>>("--entries", pick({"auto", "natural", "derivatives"}));
  variant.search.bisection =
      choice_of<Bisection>("--bisect", pick({"impact", "widest", "weighted"}));
  variant.search.uncertainty =
      choice_of<Uncertainty>("--uncertainty", pick({"elements", "variables"}));
  variant.search.engine = Engine::kInterpreted;
  variant.search.max_boxes = random.one_in(4) ? 30 : 300;
  variant.search.symbolic_budget = 20000;
  variant.batch = 1 + static_cast<unsigned>(random.below(8));
  return variant;
}

/// Omits a third of the ingredients; in half of the cases the symbolic stage does not know this.
inline SearchVariant random_variant_without(RandomSource& random, const std::string& method) {
  SearchVariant variant = random_variant(random, method);
  std::vector<std::string>& without = random.one_in(2) ? variant.search.without : variant.without;
  for (const std::string& name : ingredient_names())
    if (random.one_in(3)) without.push_back(name);
  return variant;
}

class Judge {
 public:
  explicit Judge(RandomSource& random) : random_(random) {}

  /// Runs the search; fails if Arb or the known truth of the model contradicts a claim.
  void run(const ModelText& text, const SearchVariant& variant) {
    SCOPED_TRACE(variant.describe() + '\n' + text.file());
    const std::filesystem::path path = directory_.path() / "model.toml";
    std::ofstream(path) << text.file();
    ModelOptions options;
    options.path = path.string();
    try {
      judge(text, variant, prepare(options, variant.search));
    } catch (const InputError& error) {
      ++tally.refused;
      EXPECT_TRUE(text.kind == "pole" || text.kind == "root") << error.what();
    } catch (const ClosedFormError&) {
      ++tally.refused;
      EXPECT_EQ(variant.search.method, Method::kClosedForm);
    }
  }

  Tally tally;

 private:
  void judge(const ModelText& text, const SearchVariant& variant,
             const PreparedSearch& preparation) {
    ArbOracle digits(preparation.stages->matrix(), preparation.stages->module().rows, 424);
    Settings settings = variant.settings();
    if (preparation.labels.rows == preparation.labels.columns) settings.oracle = &digits;
    const Problem problem = preparation.problem();
    const Result result = solve(problem, settings);
    if (result.reason == Reason::kBadProblem) return expect_reason_to_refuse(problem, settings);
    ++tally.verdicts[word_of(variant.search.method)][static_cast<std::size_t>(result.verdict)];
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

  void expect_truth(const ModelText& text, const PreparedSearch& preparation,
                    const Result& result) {
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
  test::TemporaryDirectory directory_;
};

}  // namespace regulus::detail::test
