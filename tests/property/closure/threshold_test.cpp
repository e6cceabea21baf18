// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds over a branch. Of a four-bar linkage det Φ_p = bc·sin(φ − ψ), which a closed form gives at
// every angle of the crank.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "codegen/question/closure/paving_certificate.hpp"
#include "tests/property/closure/checked_way_values.hpp"
#include "tests/property/closure/paved_certificates.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using verifier::Outcome;

double determinant(const FourBar& f, double theta) {
  const FourBar::Angles at = f.at(theta);
  return f.b * f.c * std::sin(at.phi - at.psi);
}

/// The least |det| of the linkage at many places between these, and links at the ends of their tolerances.
double least_on(const FourBar& linkage, const std::vector<double>& places, double tolerance) {
  double least = INFINITY;
  for (const double da : {-tolerance, tolerance})
    for (const double db : {-tolerance, tolerance}) {
      FourBar other = linkage;
      other.a += da, other.b += db;
      for (std::size_t k = 0; k + 1 < places.size(); ++k)
        for (int i = 0; i <= 2000; ++i)
          least = std::fmin(least, std::fabs(determinant(
                                       other, places[k] + (places[k + 1] - places[k]) * i / 2000)));
    }
  return least;
}

/// A linkage and a motion on which it stays away from its toggles.
struct RegularMotion {
  FourBar linkage;
  std::vector<double> places;
  double tolerance = 0;
  double least = 0;  ///< of |det|

  [[nodiscard]] std::string model(double alpha) const {
    const auto [from, to] = std::ranges::minmax(places);
    return linkage.text(places[0], from, to, tolerance) + alpha_line(alpha);
  }
  static std::string alpha_line(double alpha) { return fmt::format("alpha = {:.17g}\n", alpha); }
};

/// `several`: way-points; otherwise the ends of a range, after its start.
std::vector<RegularMotion> regular_motions(unsigned seed, int wanted, bool several) {
  std::mt19937 random(seed);
  std::vector<RegularMotion> motions;
  for (int tries = 0; int(motions.size()) < wanted && tries < 1000; ++tries) {
    RegularMotion motion{random_four_bar(random), {}, tries % 3 == 0 ? 1e-3 : 0.0, 0};
    std::uniform_real_distribution<double> angle(-3, 3), reach(0.05, 0.6);
    const double start = angle(random);
    motion.places = {start, start + reach(random)};
    if (several)
      motion.places.insert(motion.places.end(), {start - reach(random), start + reach(random)});
    const auto [from, to] = std::ranges::minmax(motion.places);
    bool is_regular = true;
    for (int i = 0; i <= 40; ++i)
      is_regular =
          is_regular && motion.linkage.is_between_toggles(from + (to - from) * i / 40, 0.08);
    if (!is_regular) continue;
    motion.least = least_on(motion.linkage, motion.places, motion.tolerance);
    motions.push_back(motion);
  }
  EXPECT_EQ(int(motions.size()), wanted);
  return motions;
}

/// The witness is a configuration of the branch, and its determinant is that of the closed form.
void expect_below(const RegularMotion& motion, const std::optional<ThresholdFinding>& found,
                  double theta, double alpha) {
  ASSERT_TRUE(found && found->below);
  const PlaceBelow& below = *found->below;
  FourBar there = motion.linkage;
  if (motion.tolerance > 0) there.a = mid(below.place.at(1)), there.b = mid(below.place.at(2));
  EXPECT_LE(std::fabs(there.a - motion.linkage.a), motion.tolerance + 1e-12);
  EXPECT_LE(std::fabs(there.b - motion.linkage.b), motion.tolerance + 1e-12);
  const auto turned = [](double x) { return std::remainder(x, 2 * std::numbers::pi); };
  EXPECT_NEAR(turned(mid(below.unknowns.at(0)) - there.at(theta).phi), 0, 1e-9);
  EXPECT_NEAR(mid(below.determinant), determinant(there, theta), 1e-9);
  EXPECT_LE(std::fabs(determinant(there, theta)), alpha);
}

void expect_rejected(const std::string& certificate, const std::string& model) {
  const verifier::Verification v = verified(certificate, model);
  EXPECT_EQ(v.outcome, Outcome::kRejected) << describe(v);
  EXPECT_THAT(v.reason, HasSubstr("alpha"));
}

TEST(AThresholdOfABranch, IsExceededAsTheClosedFormSays) {
  for (const RegularMotion& motion : regular_motions(11, trials(6, 60), false)) {
    const double below = 0.98 * motion.least, above = 1.02 * motion.least;
    SCOPED_TRACE(motion.model(below));
    const CheckedClosure safe = check_closure_text(motion.model(below), usual_options());
    ASSERT_EQ(safe.verdict(), Verdict::kNoSingularity) << reason_of(safe.found);
    const std::string proof = certified_closure(safe);
    const verifier::Verification v = verified(proof, motion.model(below));
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
    EXPECT_THAT(v.claim, HasSubstr("exceeds alpha, at every pose"));
    const CheckedClosure unsafe = check_closure_text(motion.model(above), usual_options());
    ASSERT_EQ(unsafe.verdict(), Verdict::kSingularity) << reason_of(unsafe.found);
    ASSERT_TRUE(unsafe.found.threshold && unsafe.found.threshold->below);
    expect_below(motion, unsafe.found.threshold, mid(unsafe.found.threshold->below->place[0]),
                 above);
    const std::string refutation = certified_closure(unsafe);
    const verifier::Verification w = verified(refutation, motion.model(above));
    EXPECT_EQ(w.outcome, Outcome::kVerified) << describe(w);
    EXPECT_THAT(w.claim, HasSubstr("is at most alpha, at some pose"));
    // A proof is about its own threshold.
    const std::string without = motion.model(0);
    for (const std::string& one : {proof, refutation}) expect_rejected(one, without);
    expect_rejected(proof, motion.model(0.97 * motion.least));
    expect_rejected(refutation, motion.model(1.03 * motion.least));
    expect_rejected(certified_closure(check_closure_text(without, usual_options())),
                    motion.model(below));
  }
}

/// Returns the line of the threshold of a certificate.
std::string alpha_of(const std::string& text) {
  const std::size_t at = text.find("\nalpha ");
  return text.substr(at, text.find('\n', at + 1) - at);
}

/// Each claim is false with the other threshold, so no proof of it is one.
TEST(AProofOfAThreshold, ShowsNoFalseClaim) {
  for (const RegularMotion& motion : regular_motions(12, trials(4, 30), false)) {
    const std::string safe =
        certified_closure(check_closure_text(motion.model(0.98 * motion.least), usual_options()));
    const std::string unsafe =
        certified_closure(check_closure_text(motion.model(1.02 * motion.least), usual_options()));
    ASSERT_THAT(safe, HasSubstr("\nverdict NO SINGULARITY\n"));
    ASSERT_THAT(unsafe, HasSubstr("\nvalue "));
    EXPECT_NE(verified(replaced(safe, alpha_of(safe), alpha_of(unsafe))).outcome,
              Outcome::kVerified);
    EXPECT_NE(verified(replaced(unsafe, alpha_of(unsafe), alpha_of(safe))).outcome,
              Outcome::kVerified);
    // Without a threshold the same tubes show less.
    EXPECT_EQ(verified(replaced(safe, alpha_of(safe), "\nalpha 0")).outcome, Outcome::kRejected);
    EXPECT_EQ(verified(replaced(unsafe, alpha_of(unsafe), "\nalpha 0")).outcome,
              Outcome::kRejected);
    EXPECT_EQ(verified(replaced(safe, alpha_of(safe), "\nalpha -1")).outcome, Outcome::kUnfinished);
    EXPECT_EQ(verified(replaced(safe, "\nproof\n", "\nquantity determinant\nproof\n")).outcome,
              Outcome::kRejected);
    // A place of the value that is none.
    const std::size_t at = unsafe.find("\nvalue ");
    const std::string line = unsafe.substr(at, unsafe.find('\n', at + 1) - at);
    EXPECT_EQ(verified(replaced(unsafe, line, "")).outcome, Outcome::kRejected);
    EXPECT_EQ(verified(replaced(unsafe, line, "\nreason fold")).outcome, Outcome::kRejected);
  }
}

/// The limit of a determinant is the same question.
TEST(AThresholdOfABranch, IsComparedAsTheLimitOfADeterminant) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> part(0.5, 1.5);
  int decided = 0;
  for (const RegularMotion& motion : regular_motions(14, trials(6, 60), false)) {
    const double alpha = part(random) * motion.least;
    const std::string model = motion.model(alpha);
    SCOPED_TRACE(model);
    const Verdict verdict = check_closure_text(model, usual_options()).verdict();
    AskedOnWay determinant_within;
    determinant_within.words = words_of("determinant");
    determinant_within.limit = fmt::format("{:.17g}", alpha);
    const LimitVerdict limit = bound_on_way(model, "", determinant_within).verdict;
    EXPECT_EQ(verdict == Verdict::kNoSingularity, limit == LimitVerdict::kWithin);
    EXPECT_EQ(verdict == Verdict::kSingularity, limit == LimitVerdict::kExceeded);
    decided += verdict != Verdict::kPossibleProblem;
  }
  EXPECT_GE(decided, 5);
}

/// A toggle has the determinant 0, so that it refutes each threshold, beyond each way to it.
TEST(AThresholdOfABranch, IsNotExceededAtAToggle) {
  std::mt19937 random(8);
  int proved = 0;
  for (int count = 0; count < 60 && proved < 4; ++count) {
    const FourBar linkage = random_four_bar(random);
    std::uniform_real_distribution<double> angle(-3, 3);
    const double start = angle(random);
    if (!linkage.is_between_toggles(start, 0.05)) continue;
    double toggle = start;
    while (toggle < start + 3 && linkage.is_between_toggles(toggle)) toggle += 1e-3;
    if (toggle >= start + 3) continue;
    const std::string model = linkage.text(start, start - 0.01, toggle + 0.2);
    const std::string with = model + RegularMotion::alpha_line(0.01);
    const CheckedClosure checked = check_closure_text(with, usual_options());
    if (checked.verdict() != Verdict::kSingularity) continue;
    ++proved;
    EXPECT_TRUE(checked.found.is_refuted());
    const std::string certificate = certified_closure(checked);
    ASSERT_THAT(certificate, HasSubstr("\nreason fold\n"));
    const verifier::Verification v = verified(certificate, with);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
    EXPECT_THAT(v.claim, HasSubstr("is at most alpha, at some pose"));
    expect_rejected(certificate, model);
    // Along way-points the toggle is on a later segment, too.
    for (const std::vector<double>& places :
         {std::vector{start, toggle + 0.2}, std::vector{start, start - 0.01, toggle + 0.2}}) {
      const WayFile file(table_of(places));
      const CheckedWay way = check_way_text(with, file.path());
      ASSERT_EQ(way.verdict(), Verdict::kSingularity) << way.claim();
      const verifier::Verification w = verified_way(certified_way(way), with, file.path());
      EXPECT_EQ(w.outcome, Outcome::kVerified) << describe(w);
      EXPECT_EQ(verified_way(certified_way(way), model, file.path()).outcome, Outcome::kRejected);
    }
  }
  EXPECT_EQ(proved, 4);
}

TEST(AThresholdAlongWayPoints, IsExceededAsTheClosedFormSays) {
  for (const RegularMotion& motion : regular_motions(15, trials(4, 40), true)) {
    const WayFile file(table_of(motion.places));
    for (const double part : {0.98, 1.02}) {
      const double alpha = part * motion.least;
      const std::string model = motion.model(alpha);
      SCOPED_TRACE(model);
      const CheckedWay checked = check_way_text(model, file.path());
      ASSERT_EQ(checked.verdict(), part < 1 ? Verdict::kNoSingularity : Verdict::kSingularity)
          << checked.claim();
      if (part > 1) {
        ASSERT_TRUE(checked.found.threshold && checked.found.threshold->below);
        const PlaceBelow& below = *checked.found.threshold->below;
        const double from = motion.places.at(below.piece), to = motion.places.at(below.piece + 1);
        RegularMotion at = motion;
        expect_below(at, checked.found.threshold, from + (to - from) * mid(below.place[0]), alpha);
      }
      const std::string certificate = certified_way(checked);
      const verifier::Verification v = verified_way(certificate, model, file.path());
      EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
      EXPECT_EQ(v.pieces, 3);
      EXPECT_EQ(verified_way(certificate, motion.model(0), file.path()).outcome,
                Outcome::kRejected);
      SearchOptions two = usual_options();
      two.threads = 2;
      EXPECT_EQ(certificate, certified_way(check_way_text(model, file.path(), two)));
      // With the other threshold the claim is false, although the model has it, too.
      const std::string other = motion.model((2 - part) * motion.least);
      const std::string forged =
          replaced(certificate, alpha_of(certificate),
                   alpha_of(certified_way(check_way_text(other, file.path()))));
      EXPECT_NE(verified_way(forged, other, file.path()).outcome, Outcome::kVerified);
    }
  }
}

/// Which boxes exceed it, and which do not.
TEST(APavingOfAThreshold, ClaimsOfEachBoxWhatTheClosedFormSays) {
  for (const RegularMotion& motion : regular_motions(16, trials(4, 40), false)) {
    const auto [from, to] = std::ranges::minmax(motion.places);
    double largest = 0;
    for (int i = 0; i <= 1000; ++i)
      largest =
          std::fmax(largest, std::fabs(determinant(motion.linkage, from + (to - from) * i / 1000)));
    const double alpha = (motion.least + largest) / 2;
    const std::string model = motion.model(alpha);
    SCOPED_TRACE(model);
    ModelOptions options;
    options.motion = "m";
    PreparedClosure prepared =
        prepare_closure(read_request(model, options), 0, usual_options(), {});
    const ClosureFinding found = pave_closure(prepared, usual_options(), 0x1p-7, {});
    EXPECT_EQ(check_result(prepared, found).verdict, Verdict::kSingularity);
    const std::string certificate =
        written([&](const std::string& path) { return certify_paving(path, prepared, found, {}); });
    const verifier::Verification v = verified(certificate, model);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
    expect_rejected(certificate, motion.model(0));
    const PavedTreeText tree(certificate, from, to);
    if (motion.tolerance > 0) continue;  // its boxes have other links, too
    for (const PavedLeaf& leaf : tree.leaves()) {
      for (const double part : {0.001, 0.5, 0.999}) {
        const double det =
            std::fabs(determinant(motion.linkage, leaf.lo + part * (leaf.hi - leaf.lo)));
        const bool is_true = leaf.word == "feasible"     ? det > alpha
                             : leaf.word == "infeasible" ? det <= alpha
                                                         : true;
        EXPECT_TRUE(is_true) << leaf.word << ' ' << det << ' ' << alpha;
      }
      if (leaf.word == "tube") continue;
      const char* const other = leaf.word == "feasible" ? "infeasible" : "feasible";
      EXPECT_EQ(verified(tree.with(leaf, other, leaf.tube)).outcome, Outcome::kRejected);
    }
    EXPECT_GT(tree.length("feasible"), 0);
    EXPECT_GT(tree.length("infeasible"), 0);
    EXPECT_LT(tree.length("tube"), 0.3 * (to - from));
  }
}

}  // namespace
}  // namespace regulus::detail::test
