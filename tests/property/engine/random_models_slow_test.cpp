// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/engine/random_models.hpp"

namespace regulus::detail::test {
namespace {

TEST(RandomModels, OfAllMethodsAreNeverJudgedWrongly) {
  RandomSource random(1);
  Judge judge(random);
  for (int model = 0; model < 1000; ++model) {
    const char* method = kMethods[model % std::size(kMethods)];
    const SearchVariant variant = random_variant(random, method);
    if (model % 20 < 10)
      judge.run(RandomModel(random).text(), variant);
    else
      judge.run(AdversarialModel(random).text(), variant);
  }
  judge.tally.expect_each_verdict(8);
  judge.tally.expect_leaves(
      {Rule::kOutside, Rule::kHMatrix, Rule::kMeanValue, Rule::kSecondOrder, Rule::kDeterminant,
       Rule::kElimination, Rule::kRohn, Rule::kClosedForm},
      8);
  // Few boxes need it, since a box that is not split any more gets every other test before.
  judge.tally.expect_leaves({Rule::kMultiprecision}, 1);
  judge.tally.expect_teeth(150);
}

TEST(RandomModels, OfAutoAreNeverJudgedWrongly) {
  RandomSource random(2);
  Judge judge(random);
  for (int model = 0; model < 5000; ++model)
    judge.run(RandomModel(random).text(), random_variant(random, "auto"));
  judge.tally.expect_each_verdict(100);
  EXPECT_GT(judge.tally.leaves_by_rows, 500U) << judge.tally.describe();
  judge.tally.expect_leaves({Rule::kOutside, Rule::kMeanValue, Rule::kSecondOrder}, 50);
  judge.tally.expect_teeth(500);
}

TEST(RandomModels, AreNeverJudgedWronglyWithoutSomeIngredients) {
  RandomSource random(5);
  Judge judge(random);
  for (int model = 0; model < 2000; ++model)
    judge.run(model % 2 == 0 ? RandomModel(random).text() : AdversarialModel(random).text(),
              random_variant_without(random, "auto"));
  EXPECT_GT(judge.tally.leaves_by_rows, 100U) << judge.tally.describe();
  judge.tally.expect_leaves({Rule::kHMatrix, Rule::kMeanValue, Rule::kSecondOrder}, 50);
}

TEST(AdversarialModels, OfAutoAreNeverJudgedWrongly) {
  RandomSource random(3);
  Judge judge(random);
  for (int model = 0; model < 5000; ++model)
    judge.run(AdversarialModel(random).text(), random_variant(random, "auto"));
  judge.tally.expect_each_verdict(500);
  judge.tally.expect_leaves(
      {Rule::kHMatrix, Rule::kMeanValue, Rule::kSecondOrder, Rule::kMultiprecision}, 50);
  judge.tally.expect_teeth(1000);
}

TEST(RandomModels, AreNeverJudgedWronglyByCompiledKernels) {
  RandomSource random(4);
  Judge judge(random);
  for (int model = 0; model < 40; ++model) {
    SearchVariant variant = random_variant(random, kMethods[model % std::size(kMethods)]);
    variant.search.engine = Engine::kJit;
    variant.search.use_cache = false;
    if (model % 20 < 10)
      judge.run(RandomModel(random).text(), variant);
    else
      judge.run(AdversarialModel(random).text(), variant);
  }
}

}  // namespace
}  // namespace regulus::detail::test
