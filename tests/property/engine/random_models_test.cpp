// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/engine/random_models.hpp"

namespace regulus::detail::test {
namespace {

TEST(RandomModels, AreNeverJudgedWrongly) {
  RandomSource random(20070611);
  Judge judge(random);
  for (int model = 0; model < 100; ++model)
    judge.run(RandomModel(random).text(),
              random_variant(random, kMethods[model % std::size(kMethods)]));
  EXPECT_GT(judge.tally.leaves_by_rows, 0U);
  judge.tally.expect_leaves({Rule::kSecondOrder, Rule::kDeterminant, Rule::kElimination}, 5);
  judge.tally.expect_teeth(6);
}

TEST(AdversarialModels, AreNeverJudgedWrongly) {
  RandomSource random(20070612);
  Judge judge(random);
  for (int model = 0; model < 300; ++model)
    judge.run(AdversarialModel(random).text(),
              random_variant(random, kMethods[model % std::size(kMethods)]));
  judge.tally.expect_each_verdict(1);
  judge.tally.expect_leaves({Rule::kMeanValue, Rule::kSecondOrder, Rule::kDeterminant,
                             Rule::kElimination, Rule::kClosedForm, Rule::kMultiprecision},
                            5);
  judge.tally.expect_teeth(30);
}

TEST(RandomModels, AreNeverJudgedWronglyWithoutSomeIngredients) {
  RandomSource random(20070613);
  Judge judge(random);
  for (int model = 0; model < 60; ++model)
    judge.run(model % 2 == 0 ? RandomModel(random).text() : AdversarialModel(random).text(),
              random_variant_without(
                  random, model % 6 == 5 ? kMethods[model % std::size(kMethods)] : "auto"));
  EXPECT_GT(judge.tally.leaves_by_rows, 0U);
  judge.tally.expect_leaves({Rule::kHMatrix, Rule::kMeanValue, Rule::kSecondOrder}, 5);
}

}  // namespace
}  // namespace regulus::detail::test
