// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of random models: constraints, balls, control errors, thresholds, matrices that are
// not square, poles and roots.
#include "tests/property/engine/random_models.hpp"
#include "tests/support/certificates.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

struct Count {
  int verified = 0, unfinished = 0;
};

void judge_certificate(const ModelText& text, const SearchVariant& variant, Count& count) {
  SCOPED_TRACE(variant.describe() + '\n' + text.file());
  const test::TemporaryDirectory directory;
  ModelOptions options;
  options.path = (directory.path() / "model.toml").string();
  std::ofstream(options.path) << text.file();
  test::Certified certified;
  try {
    PreparedSearch preparation = prepare(options, variant.search);
    certified = test::certify(preparation, variant.search, variant.settings());
  } catch (const InputError&) {
    return;
  } catch (const ClosedFormError&) {
    return;
  }
  if (certified.text.empty()) return;
  verifier::Options effort;
  effort.max_boxes_per_leaf = 2000;
  const verifier::Verification v = test::verify_text(certified.text, effort);
  EXPECT_NE(v.outcome, Outcome::kRejected) << v.reason << '\n' << certified.text;
  (v.outcome == Outcome::kVerified ? count.verified : count.unfinished) += 1;
}

TEST(CertificatesOfRandomModels, AreVerifiedAlmostAlways) {
  RandomSource random(20261124);
  Count count;
  for (int model = 0; model < trials(50, 150); ++model)
    judge_certificate(RandomModel(random).text(),
                      random_variant(random, kMethods[model % std::size(kMethods)]), count);
  RecordProperty("verified", count.verified);
  EXPECT_GE(count.verified, trials(6, 20));
  EXPECT_GE(count.verified, 9 * count.unfinished);
}

TEST(CertificatesOfAdversarialModels, AreNeverRejected) {
  RandomSource random(20261125);
  Count count;
  for (int model = 0; model < trials(50, 150); ++model)
    judge_certificate(AdversarialModel(random).text(),
                      random_variant(random, kMethods[model % std::size(kMethods)]), count);
  EXPECT_GE(count.verified, trials(6, 20));
  EXPECT_GE(count.verified, 2 * count.unfinished);
}

}  // namespace
}  // namespace regulus::detail::test
